// Packs: as many floats or 32-bit integers as a register of the instruction set holds (at most 16), with the operations of
// scalar.h. The one wrapper of the SIMD library (Google Highway); seen through each_target.h only, which reads it once for
// each instruction set (so it has no guard). No pack crosses a public
// boundary: kernels read and write plain arrays.
//
// All arithmetic is IEEE, one rounding an operation, no reciprocal estimates, no fused multiply-add: a lane computes what
// a float computes, bit for bit.

#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace koksma::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
using Tag = hn::CappedTag<T, 16>;
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag<float>()));

/// Which lanes.
struct Mask {
    using Raw = decltype(hn::FirstN(Tag<float>(), std::size_t{1}));
    Raw raw;
    Mask() = default;  // `Mask{}`: no lane
    HWY_INLINE Mask(Raw r) : raw(r) {}  // NOLINT: a pack is its register
    /// The first n lanes.
    [[nodiscard]] static HWY_INLINE Mask first(std::size_t n) { return hn::FirstN(Tag<float>(), n); }
    friend HWY_INLINE Mask operator&(Mask a, Mask b) { return hn::And(a.raw, b.raw); }
    friend HWY_INLINE Mask operator|(Mask a, Mask b) { return hn::Or(a.raw, b.raw); }
    friend HWY_INLINE Mask operator&&(Mask a, Mask b) { return hn::And(a.raw, b.raw); }
    friend HWY_INLINE Mask operator||(Mask a, Mask b) { return hn::Or(a.raw, b.raw); }
    friend HWY_INLINE Mask operator!(Mask a) { return hn::Not(a.raw); }
    friend HWY_INLINE Mask operator==(Mask a, Mask b) { return hn::Not(hn::Xor(a.raw, b.raw)); }
    friend HWY_INLINE Mask operator!=(Mask a, Mask b) { return hn::Xor(a.raw, b.raw); }
};
[[nodiscard]] HWY_INLINE bool any(Mask m) { return !hn::AllFalse(Tag<float>(), m.raw); }
[[nodiscard]] HWY_INLINE bool all(Mask m) { return hn::AllTrue(Tag<float>(), m.raw); }
[[nodiscard]] HWY_INLINE int count(Mask m) { return static_cast<int>(hn::CountTrue(Tag<float>(), m.raw)); }
/// One bit a lane.
[[nodiscard]] HWY_INLINE std::uint32_t lane_bits(Mask m) {
    alignas(8) std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag<float>(), m.raw, bytes);
    return static_cast<std::uint32_t>(bytes[0] | (bytes[1] << 8)) & ((1u << kLanes) - 1u);
}

/// What float, int32_t and uint32_t packs have in common.
template <class Self, class T>
struct PackBase {
    using Raw = hn::VFromD<Tag<T>>;
    Raw raw;

    [[nodiscard]] static HWY_INLINE Self load(const T* aligned) { return hn::Load(Tag<T>(), aligned); }
    [[nodiscard]] static HWY_INLINE Self load_any(const T* p) { return hn::LoadU(Tag<T>(), p); }
    HWY_INLINE void store(T* aligned) const { hn::Store(raw, Tag<T>(), aligned); }
    HWY_INLINE void store_any(T* p) const { hn::StoreU(raw, Tag<T>(), p); }
    /// Stores the first n lanes and touches nothing behind them.
    HWY_INLINE void store_first(std::size_t n, T* p) const {
        if (n >= static_cast<std::size_t>(kLanes)) return store_any(p);
#if HWY_TARGET == HWY_AVX3
        hn::BlendedStore(raw, hn::FirstN(Tag<T>(), n), Tag<T>(), p);
#else
        alignas(64) T lanes[kLanes];
        store(lanes);
        for (std::size_t i = 0; i < n; ++i) p[i] = lanes[i];
#endif
    }
    /// Stores the lanes of the mask one after the other. May write up to a whole pack: leave room.
    HWY_INLINE std::size_t compress_store(Mask m, T* p) const {
        return hn::CompressStore(raw, hn::RebindMask(Tag<T>(), m.raw), Tag<T>(), p);
    }
    friend HWY_INLINE Self operator+(Self a, Self b) { return hn::Add(a.raw, b.raw); }
    friend HWY_INLINE Self operator-(Self a, Self b) { return hn::Sub(a.raw, b.raw); }
    friend HWY_INLINE Self operator*(Self a, Self b) { return hn::Mul(a.raw, b.raw); }
    friend HWY_INLINE Mask operator==(Self a, Self b) { return hn::RebindMask(Tag<float>(), hn::Eq(a.raw, b.raw)); }
    friend HWY_INLINE Mask operator!=(Self a, Self b) { return hn::RebindMask(Tag<float>(), hn::Ne(a.raw, b.raw)); }
    friend HWY_INLINE Mask operator<(Self a, Self b) { return hn::RebindMask(Tag<float>(), hn::Lt(a.raw, b.raw)); }
    friend HWY_INLINE Mask operator>(Self a, Self b) { return hn::RebindMask(Tag<float>(), hn::Gt(a.raw, b.raw)); }
    HWY_INLINE Self& operator+=(Self b) { return self() = self() + b; }
    HWY_INLINE Self& operator-=(Self b) { return self() = self() - b; }
    HWY_INLINE Self& operator*=(Self b) { return self() = self() * b; }
    friend HWY_INLINE Self select(Mask m, Self yes, Self no) {
        return hn::IfThenElse(hn::RebindMask(Tag<T>(), m.raw), yes.raw, no.raw);
    }
    friend HWY_INLINE void assign(Mask m, Self& dst, const Self& src) { dst = select(m, src, dst); }

private:
    HWY_INLINE Self& self() { return static_cast<Self&>(*this); }
};

// Constructors are written out in each: GCC gives inherited ones no instruction set. Trivial default: `Float{}` is zero.
struct Float : PackBase<Float, float> {
    Float() = default;
    HWY_INLINE Float(Raw r) : PackBase{r} {}                         // NOLINT: a pack is its register,
    HWY_INLINE Float(float x) : PackBase{hn::Set(Tag<float>(), x)} {}  // NOLINT: and a number is a pack of equal lanes
    friend HWY_INLINE Float operator/(Float a, Float b) { return hn::Div(a.raw, b.raw); }
    friend HWY_INLINE Mask operator<=(Float a, Float b) { return hn::Le(a.raw, b.raw); }
    friend HWY_INLINE Mask operator>=(Float a, Float b) { return hn::Ge(a.raw, b.raw); }
    friend HWY_INLINE Float operator-(Float a) { return hn::Neg(a.raw); }
};

/// 32-bit integers, signed or not; arithmetic wraps.
template <class Self, class T>
struct IntegerBase : PackBase<Self, T> {
    friend HWY_INLINE Mask operator<=(Self a, Self b) { return !(a > b); }
    friend HWY_INLINE Mask operator>=(Self a, Self b) { return !(a < b); }
    friend HWY_INLINE Self operator&(Self a, Self b) { return hn::And(a.raw, b.raw); }
    friend HWY_INLINE Self operator|(Self a, Self b) { return hn::Or(a.raw, b.raw); }
    friend HWY_INLINE Self operator^(Self a, Self b) { return hn::Xor(a.raw, b.raw); }
};
struct Int32 : IntegerBase<Int32, std::int32_t> {
    Int32() = default;
    HWY_INLINE Int32(Raw r) : IntegerBase{{r}} {}                                  // NOLINT
    HWY_INLINE Int32(std::int32_t x) : IntegerBase{{hn::Set(Tag<std::int32_t>(), x)}} {}  // NOLINT
};
struct UInt32 : IntegerBase<UInt32, std::uint32_t> {
    UInt32() = default;
    HWY_INLINE UInt32(Raw r) : IntegerBase{{r}} {}                                  // NOLINT
    HWY_INLINE UInt32(std::uint32_t x) : IntegerBase{{hn::Set(Tag<std::uint32_t>(), x)}} {}  // NOLINT
};

using koksma::select;
using koksma::any;
using koksma::all;
using koksma::assign;

[[nodiscard]] HWY_INLINE Float abs(Float x) { return hn::Abs(x.raw); }
[[nodiscard]] HWY_INLINE Float sqrt(Float x) { return hn::Sqrt(x.raw); }
[[nodiscard]] HWY_INLINE Float floor(Float x) { return hn::Floor(x.raw); }
[[nodiscard]] HWY_INLINE Float copysign(Float magnitude, Float sign) { return hn::CopySign(magnitude.raw, sign.raw); }
[[nodiscard]] HWY_INLINE Int32 to_int(Float x) { return hn::ConvertTo(Tag<std::int32_t>(), x.raw); }
[[nodiscard]] HWY_INLINE Float to_real(Int32 x) { return hn::ConvertTo(Tag<float>(), x.raw); }
[[nodiscard]] HWY_INLINE Int32 bits_of(Float x) { return hn::BitCast(Tag<std::int32_t>(), x.raw); }
[[nodiscard]] HWY_INLINE Float real_of(Int32 x) { return hn::BitCast(Tag<float>(), x.raw); }
[[nodiscard]] HWY_INLINE UInt32 as_uint(Int32 x) { return hn::BitCast(Tag<std::uint32_t>(), x.raw); }
[[nodiscard]] HWY_INLINE Int32 as_int(UInt32 x) { return hn::BitCast(Tag<std::int32_t>(), x.raw); }
template <int n>
[[nodiscard]] HWY_INLINE Int32 shift_left(Int32 x) {
    return hn::ShiftLeft<n>(x.raw);
}
template <int n>
[[nodiscard]] HWY_INLINE Int32 shift_right(Int32 x) {
    return hn::ShiftRight<n>(x.raw);
}
template <int n>
[[nodiscard]] HWY_INLINE UInt32 shift_left(UInt32 x) {
    return hn::ShiftLeft<n>(x.raw);
}
template <int n>
[[nodiscard]] HWY_INLINE UInt32 shift_right(UInt32 x) {
    return hn::ShiftRight<n>(x.raw);
}
/// 16-bit numbers from any place on.
[[nodiscard]] HWY_INLINE UInt32 load_widened(const std::uint16_t* p) {
    const Tag<std::uint32_t> d;
    return hn::PromoteTo(d, hn::LoadU(hn::Rebind<std::uint16_t, Tag<std::uint32_t>>(), p));
}
/// The high words of the products.
[[nodiscard]] HWY_INLINE UInt32 product_high(UInt32 a, UInt32 b) {
#if HWY_TARGET == HWY_SCALAR
    return static_cast<std::uint32_t>((std::uint64_t{hn::GetLane(a.raw)} * hn::GetLane(b.raw)) >> 32);
#else
    const Tag<std::uint32_t> words;
    const auto even = hn::BitCast(words, hn::MulEven(a.raw, b.raw));
    const auto odd = hn::BitCast(words, hn::MulEven(hn::Shuffle2301(a.raw), hn::Shuffle2301(b.raw)));
    return hn::OddEven(odd, hn::Shuffle2301(even));
#endif
}
/// base[index] in the low and base[index + 1] in the high half of each lane; the index is below 2^30.
[[nodiscard]] HWY_INLINE UInt32 gather_two(const std::uint16_t* base, UInt32 index) {
    const Tag<std::int32_t> d;
    const auto two = hn::GatherOffset(d, reinterpret_cast<const std::int32_t*>(base), hn::BitCast(d, hn::Add(index.raw, index.raw)));
    return hn::BitCast(Tag<std::uint32_t>(), two);
}
/// x >> n, all lanes by one number.
[[nodiscard]] HWY_INLINE UInt32 shift_right(UInt32 x, int n) { return hn::ShiftRightSame(x.raw, n); }
/// x >> n, each lane by its own number, below 32.
[[nodiscard]] HWY_INLINE UInt32 shift_right(UInt32 x, UInt32 n) { return hn::Shr(x.raw, n.raw); }
[[nodiscard]] HWY_INLINE UInt32 shift_left(UInt32 x, UInt32 n) { return hn::Shl(x.raw, n.raw); }
[[nodiscard]] HWY_INLINE UInt32 min(UInt32 a, UInt32 b) { return hn::Min(a.raw, b.raw); }
/// table[index] of each lane, from one pack to another. Every index is below kLanes.
[[nodiscard]] HWY_INLINE UInt32 lookup(UInt32 table, UInt32 index) {
    return hn::TableLookupLanes(table.raw, hn::IndicesFromVec(Tag<std::uint32_t>(), index.raw));
}
/// Reverses the order of the bits of each lane; and the same, shifted right by 8.
#if HWY_TARGET == HWY_SCALAR
[[nodiscard]] HWY_INLINE UInt32 reverse_bits(UInt32 x) {
    std::uint32_t bits = hn::GetLane(x.raw), reversed = 0;
    for (int i = 0; i < 32; ++i, bits >>= 1) reversed = (reversed << 1) | (bits & 1u);
    return reversed;
}
[[nodiscard]] HWY_INLINE UInt32 reverse_bits_24(UInt32 x) { return shift_right<8>(reverse_bits(x)); }
#else
namespace pack_detail {
/// The same 16 bytes in every block of 16.
[[nodiscard]] HWY_INLINE hn::VFromD<Tag<std::uint32_t>> blocks(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    alignas(16) const std::uint32_t words[4] = {a, b, c, d};
    return hn::LoadDup128(Tag<std::uint32_t>(), words);
}
/// @param bytes  where each byte comes from, within its block of 16; 0x80: zero
[[nodiscard]] HWY_INLINE UInt32 reverse_bits(UInt32 x, hn::VFromD<Tag<std::uint32_t>> bytes) {
    const auto low = hn::Set(Tag<std::uint32_t>(), 0x0f0f0f0fu), moved = hn::TableLookupBytes(x.raw, bytes);
    // The reversals of the numbers 0 .. 15, as high and as low halves of a byte.
    const auto high_of_low = blocks(0xc0408000u, 0xe060a020u, 0xd0509010u, 0xf070b030u);
    const auto low_of_high = blocks(0x0c040800u, 0x0e060a02u, 0x0d050901u, 0x0f070b03u);
    return hn::Or(hn::TableLookupBytes(high_of_low, hn::And(moved, low)),
                  hn::TableLookupBytes(low_of_high, hn::And(hn::ShiftRight<4>(moved), low)));
}
}  // namespace pack_detail
[[nodiscard]] HWY_INLINE UInt32 reverse_bits(UInt32 x) {
    return pack_detail::reverse_bits(x, pack_detail::blocks(0x00010203u, 0x04050607u, 0x08090a0bu, 0x0c0d0e0fu));
}
[[nodiscard]] HWY_INLINE UInt32 reverse_bits_24(UInt32 x) {
    return pack_detail::reverse_bits(x, pack_detail::blocks(0x80000102u, 0x80040506u, 0x8008090au, 0x800c0d0eu));
}
#endif
/// first, first + 1, ...
[[nodiscard]] HWY_INLINE Int32 iota(std::int32_t first) { return hn::Iota(Tag<std::int32_t>(), first); }

/// base[index] of each lane. Every lane's index must be readable, also where a mask will drop the value.
[[nodiscard]] HWY_INLINE Float gather(const float* base, Int32 index) { return hn::GatherIndex(Tag<float>(), base, index.raw); }
[[nodiscard]] HWY_INLINE Int32 gather(const std::int32_t* base, Int32 index) { return hn::GatherIndex(Tag<std::int32_t>(), base, index.raw); }

/// As many doubles as there are lanes, in two registers.
struct Double {
    using Raw = hn::VFromD<Tag<double>>;
#if HWY_TARGET == HWY_SCALAR
    Raw low;
    static HWY_INLINE Double of(double x) { return {hn::Set(Tag<double>(), x)}; }
    static HWY_INLINE Double of(Int32 x) { return {hn::PromoteTo(Tag<double>(), x.raw)}; }
    HWY_INLINE Int32 truncated() const { return hn::DemoteTo(Tag<std::int32_t>(), low); }
    static HWY_INLINE Double of(Float x) { return {hn::PromoteTo(Tag<double>(), x.raw)}; }
    HWY_INLINE Float rounded() const { return hn::DemoteTo(Tag<float>(), low); }
    friend HWY_INLINE Double operator+(Double a, Double b) { return {hn::Add(a.low, b.low)}; }
    friend HWY_INLINE Double operator-(Double a, Double b) { return {hn::Sub(a.low, b.low)}; }
    friend HWY_INLINE Double operator*(Double a, Double b) { return {hn::Mul(a.low, b.low)}; }
    friend HWY_INLINE Double operator/(Double a, Double b) { return {hn::Div(a.low, b.low)}; }
    friend HWY_INLINE Mask operator<=(Double a, Double b) { return Double{hn::IfThenElse(hn::Le(a.low, b.low), of(1.0).low, of(0.0).low)}.truncated() != Int32(0); }
    static HWY_INLINE Double gather(const double* base, Int32 index) { return of(base[hn::GetLane(index.raw)]); }
#else
    using Half = hn::Half<Tag<std::int32_t>>;
    Raw low, high;
    static HWY_INLINE Double of(double x) { return {hn::Set(Tag<double>(), x), hn::Set(Tag<double>(), x)}; }
    static HWY_INLINE Double of(Int32 x) {
        return {hn::PromoteTo(Tag<double>(), hn::LowerHalf(Half(), x.raw)), hn::PromoteTo(Tag<double>(), hn::UpperHalf(Half(), x.raw))};
    }
    /// Of numbers that fit into 32 bits.
    HWY_INLINE Int32 truncated() const { return hn::Combine(Tag<std::int32_t>(), hn::DemoteTo(Half(), high), hn::DemoteTo(Half(), low)); }
    static HWY_INLINE Double of(Float x) {
        const hn::Half<Tag<float>> half;
        return {hn::PromoteTo(Tag<double>(), hn::LowerHalf(half, x.raw)), hn::PromoteTo(Tag<double>(), hn::UpperHalf(half, x.raw))};
    }
    HWY_INLINE Float rounded() const {
        const hn::Half<Tag<float>> half;
        return hn::Combine(Tag<float>(), hn::DemoteTo(half, high), hn::DemoteTo(half, low));
    }
    friend HWY_INLINE Double operator+(Double a, Double b) { return {hn::Add(a.low, b.low), hn::Add(a.high, b.high)}; }
    friend HWY_INLINE Double operator-(Double a, Double b) { return {hn::Sub(a.low, b.low), hn::Sub(a.high, b.high)}; }
    friend HWY_INLINE Double operator*(Double a, Double b) { return {hn::Mul(a.low, b.low), hn::Mul(a.high, b.high)}; }
    friend HWY_INLINE Double operator/(Double a, Double b) { return {hn::Div(a.low, b.low), hn::Div(a.high, b.high)}; }
    friend HWY_INLINE Mask operator<=(Double a, Double b) {
        const auto one = of(1.0).low, zero = of(0.0).low;
        return Double{hn::IfThenElse(hn::Le(a.low, b.low), one, zero), hn::IfThenElse(hn::Le(a.high, b.high), one, zero)}.truncated() != Int32(0);
    }
    /// base[index] of each lane.
    static HWY_INLINE Double gather(const double* base, Int32 index) {
        const hn::Rebind<std::int64_t, Tag<double>> wide;
        return {hn::GatherIndex(Tag<double>(), base, hn::PromoteTo(wide, hn::LowerHalf(Half(), index.raw))),
                hn::GatherIndex(Tag<double>(), base, hn::PromoteTo(wide, hn::UpperHalf(Half(), index.raw)))};
    }
#endif
    static HWY_INLINE Double of(UInt32 x) { return of(as_int(x ^ UInt32(0x80000000u))) + of(0x1p31); }
};

template <class Real>
struct Lanes;
template <>
struct Lanes<Float> {
    using Mask = HWY_NAMESPACE::Mask;
    using Int = HWY_NAMESPACE::Int32;
    static constexpr int kCount = kLanes;
};
template <class Real>
using MaskOf = typename Lanes<Real>::Mask;
template <class Real>
using IntOf = typename Lanes<Real>::Int;

}  // namespace koksma::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
