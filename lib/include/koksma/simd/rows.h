// Rows of memory, one a lane, turned into packs. No include guard: read anew for each instruction set, after pack.h.

HWY_BEFORE_NAMESPACE();
namespace koksma::HWY_NAMESPACE {

namespace rows_detail {

#if HWY_TARGET != HWY_SCALAR
/// Four words of each fourth lane's row: those of the lanes first, first + 4, ..., one in each block of 16 bytes.
template <class D>
[[nodiscard]] HWY_INLINE hn::VFromD<D> fours(D d, const float* base, const std::int32_t* index, std::size_t stride, int first) {
    if constexpr (hn::MaxLanes(D()) == 4) {
        return hn::LoadU(d, base + stride * static_cast<std::size_t>(index[first]));
    } else {
        const hn::Half<D> half;
        constexpr int kFurther = static_cast<int>(hn::MaxLanes(D()) / 2);
        return hn::Combine(d, fours(half, base, index, stride, first + kFurther), fours(half, base, index, stride, first));
    }
}
#endif

}  // namespace rows_detail

/// The first words of each lane's row. Reads each row as a whole, which takes a third of the time of gathering its words.
/// @tparam words  a multiple of four
/// @param base    rows of `stride` words; the row of lane i begins at base + stride * index[i]
/// @param index   aligned; all lanes must be readable
template <int words>
HWY_INLINE void load_rows(const float* base, std::size_t stride, const std::int32_t* index, Float (&out)[words]) {
    static_assert(words % 4 == 0);
#if HWY_TARGET == HWY_SCALAR
    for (int w = 0; w < words; ++w) out[w] = Float(base[stride * static_cast<std::size_t>(index[0]) + static_cast<std::size_t>(w)]);
#else
    const Tag<float> d;
    const hn::Repartition<double, Tag<float>> pairs;
    for (int w = 0; w < words; w += 4) {
        const auto row0 = rows_detail::fours(d, base + w, index, stride, 0), row1 = rows_detail::fours(d, base + w, index, stride, 1);
        const auto row2 = rows_detail::fours(d, base + w, index, stride, 2), row3 = rows_detail::fours(d, base + w, index, stride, 3);
        const auto low01 = hn::BitCast(pairs, hn::InterleaveLower(d, row0, row1)), low23 = hn::BitCast(pairs, hn::InterleaveLower(d, row2, row3));
        const auto high01 = hn::BitCast(pairs, hn::InterleaveUpper(d, row0, row1)), high23 = hn::BitCast(pairs, hn::InterleaveUpper(d, row2, row3));
        out[w] = hn::BitCast(d, hn::InterleaveLower(pairs, low01, low23));
        out[w + 1] = hn::BitCast(d, hn::InterleaveUpper(pairs, low01, low23));
        out[w + 2] = hn::BitCast(d, hn::InterleaveLower(pairs, high01, high23));
        out[w + 3] = hn::BitCast(d, hn::InterleaveUpper(pairs, high01, high23));
    }
#endif
}

template <int words>
HWY_INLINE void load_rows(const float* base, std::int32_t stride, Int32 index, Float (&out)[words]) {
    alignas(64) std::int32_t rows[kLanes];
    index.store(rows);
    load_rows(base, static_cast<std::size_t>(stride), rows, out);
}

}  // namespace koksma::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
