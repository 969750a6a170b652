// Packs from the scene's arrays and from queues. Read once for each instruction set (no guard).

KOKSMA_MATHS_BEGIN

using FloatLanes = float[kLanes];
using IntLanes = std::int32_t[kLanes];

template <std::size_t kRow>
[[nodiscard]] Vec3<Float> load(const detail::VectorRowsOf<kRow>& rows, std::size_t at) {
    return {Float::load(rows.x + at), Float::load(rows.y + at), Float::load(rows.z + at)};
}
template <std::size_t kRow>
[[nodiscard]] Vec3<Float> gather(const detail::VectorRowsOf<kRow>& rows, Int32 index) {
    return {gather(rows.x, index), gather(rows.y, index), gather(rows.z, index)};
}
template <std::size_t kRow>
void store(const Vec3<Float>& v, detail::VectorRowsOf<kRow>& rows, std::size_t at) {
    v.x.store(rows.x + at);
    v.y.store(rows.y + at);
    v.z.store(rows.z + at);
}
template <std::size_t kRow>
void compress_store(const Vec3<Float>& v, Mask m, detail::VectorRowsOf<kRow>& rows, std::size_t at) {
    v.x.compress_store(m, rows.x + at);
    v.y.compress_store(m, rows.y + at);
    v.z.compress_store(m, rows.z + at);
}

/// A 32-bit member of the records that an index selects. @param offset  offsetof the member
template <class Record>
[[nodiscard]] Int32 gather_int(const Record* base, std::size_t offset, Int32 index) {
    static_assert(sizeof(Record) % 4 == 0);
    return gather(reinterpret_cast<const std::int32_t*>(reinterpret_cast<const char*>(base) + offset), index * Int32(static_cast<std::int32_t>(sizeof(Record) / 4)));
}
template <class Record>
[[nodiscard]] Float gather_float(const Record* base, std::size_t offset, Int32 index) {
    return real_of(gather_int(base, offset, index));
}
/// A Vec3f member.
template <class Record>
[[nodiscard]] Vec3<Float> gather_vector(const Record* base, std::size_t offset, Int32 index) {
    return {gather_float(base, offset, index), gather_float(base, offset + 4, index), gather_float(base, offset + 8, index)};
}

/// A pack that is taken apart and put together lane by lane, for what is computed one path at a time.
struct VectorLanes {
    alignas(4 * kLanes) FloatLanes x, y, z;
    VectorLanes() = default;
    explicit VectorLanes(const Vec3<Float>& v) {
        v.x.store(x);
        v.y.store(y);
        v.z.store(z);
    }
    [[nodiscard]] Vec3f operator[](int lane) const { return {x[lane], y[lane], z[lane]}; }
    void set(int lane, Vec3f v) {
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
    [[nodiscard]] Vec3<Float> pack() const { return {Float::load(x), Float::load(y), Float::load(z)}; }
};
struct alignas(4 * kLanes) NumberLanes {
    FloatLanes x;
    NumberLanes() = default;
    explicit NumberLanes(Float v) { v.store(x); }
    [[nodiscard]] Float pack() const { return Float::load(x); }
};

/// Calls f(lane) for the lanes of a mask.
template <class F>
void for_lanes(Mask m, F&& f) {
    for (std::uint32_t bits = lane_bits(m); bits != 0; bits &= bits - 1) f(std::countr_zero(bits));
}

/// Has the addresses base + index of some lanes fetched into the cache.
template <class T>
void prefetch(const T* base, Mask m, Int32 index) {
    alignas(4 * kLanes) IntLanes lanes;
    index.store(lanes);
    for_lanes(m, [&](int i) { __builtin_prefetch(base + lanes[i]); });
}

/// The value of the first lane of a mask, in all lanes. @pre any(m)
[[nodiscard]] inline Int32 first_lane(Mask m, Int32 v) {
    alignas(4 * kLanes) IntLanes lanes;
    v.store(lanes);
    return Int32(lanes[std::countr_zero(lane_bits(m)) & (kLanes - 1)]);  // some compilers see the mask that cannot be
}

/// A mask made of bits.
[[nodiscard]] inline Mask mask_of(std::uint32_t bits) {
    alignas(4 * kLanes) IntLanes lanes;
    for (int i = 0; i < kLanes; ++i) lanes[i] = static_cast<std::int32_t>((bits >> i) & 1u);
    return Int32::load(lanes) != Int32(0);
}

KOKSMA_MATHS_END
