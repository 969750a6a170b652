// Two packs of numbers below 2^16 in one register. No include guard: read anew for each instruction set, after each_target.h.

HWY_BEFORE_NAMESPACE();
namespace koksma::HWY_NAMESPACE {

/// The first pack is in the low halves of the lanes, the second in the high ones. Arithmetic is that of 16 bits, it wraps; one
/// multiplication takes a quarter of the time of two of 32 bits.
struct HalfWords {
#if HWY_TARGET == HWY_SCALAR
    UInt32 low, high;
    [[nodiscard]] static HWY_INLINE HalfWords of(UInt32 x, UInt32 y) { return {x & UInt32(0xffffu), y & UInt32(0xffffu)}; }
    [[nodiscard]] static HWY_INLINE HalfWords of_doubled(UInt32 x, UInt32 y) { return of(x, y); }
    [[nodiscard]] HWY_INLINE UInt32 first() const { return low; }
    [[nodiscard]] HWY_INLINE UInt32 second() const { return high; }
    friend HWY_INLINE HalfWords operator+(HalfWords a, HalfWords b) { return of(a.low + b.low, a.high + b.high); }
    friend HWY_INLINE HalfWords operator*(HalfWords a, HalfWords b) { return of(a.low * b.low, a.high * b.high); }
    friend HWY_INLINE HalfWords operator&(HalfWords a, HalfWords b) { return {a.low & b.low, a.high & b.high}; }
    friend HWY_INLINE HalfWords operator^(HalfWords a, HalfWords b) { return {a.low ^ b.low, a.high ^ b.high}; }
    friend HWY_INLINE HalfWords shift_right(HalfWords x, int n) { return {koksma::HWY_NAMESPACE::shift_right(x.low, n), koksma::HWY_NAMESPACE::shift_right(x.high, n)}; }
#else
    using Words = hn::Repartition<std::uint16_t, Tag<std::uint32_t>>;
    hn::VFromD<Words> raw;

    [[nodiscard]] static HWY_INLINE HalfWords of(UInt32 x, UInt32 y) { return {hn::BitCast(Words(), (x | shift_left<16>(y)).raw)}; }
    /// The same of numbers that are in both halves of their lanes.
    [[nodiscard]] static HWY_INLINE HalfWords of_doubled(UInt32 x, UInt32 y) {
        return {hn::OddEven(hn::BitCast(Words(), y.raw), hn::BitCast(Words(), x.raw))};
    }
    [[nodiscard]] HWY_INLINE UInt32 first() const { return lanes() & UInt32(0xffffu); }
    [[nodiscard]] HWY_INLINE UInt32 second() const { return shift_right<16>(lanes()); }
    friend HWY_INLINE HalfWords operator+(HalfWords a, HalfWords b) { return {hn::Add(a.raw, b.raw)}; }
    friend HWY_INLINE HalfWords operator*(HalfWords a, HalfWords b) { return {hn::Mul(a.raw, b.raw)}; }
    friend HWY_INLINE HalfWords operator&(HalfWords a, HalfWords b) { return {hn::And(a.raw, b.raw)}; }
    friend HWY_INLINE HalfWords operator^(HalfWords a, HalfWords b) { return {hn::Xor(a.raw, b.raw)}; }
#if HWY_TARGET == HWY_AVX3
    // A count in a register of lanes is one operation, a common count is two.
    friend HWY_INLINE HalfWords shift_right(HalfWords x, int n) { return {hn::Shr(x.raw, hn::Set(Words(), static_cast<std::uint16_t>(n)))}; }
#else
    friend HWY_INLINE HalfWords shift_right(HalfWords x, int n) { return {hn::ShiftRightSame(x.raw, n)}; }
#endif

private:
    [[nodiscard]] HWY_INLINE UInt32 lanes() const { return hn::BitCast(Tag<std::uint32_t>(), raw); }
#endif
};

}  // namespace koksma::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
