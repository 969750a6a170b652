// What a batch's paths have brought, for everyone who adds to it. Read once for each instruction set (no guard).

KOKSMA_MATHS_BEGIN

/// The radiance of each path, and a hash of all that it met. Lanes name their paths by slots.
struct PathSums {
    std::span<Vec3f> radiance;
    std::span<std::uint64_t> hashes;  ///< empty where none are wanted

    void clear() {
        for (Vec3f& l : radiance) l = Vec3f(0.0f);
        for (std::uint64_t& h : hashes) h = 0;
    }
    void add(std::int32_t slot, Vec3f what) { radiance[static_cast<std::size_t>(slot)] += what; }
    void hash(std::int32_t slot, std::uint64_t what) {
        std::uint64_t& h = hashes[static_cast<std::size_t>(slot)];
        h = path_hash(h, what);
    }
    /// To be counted as an invalid sample.
    void spoil(std::int32_t slot) {
        constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
        radiance[static_cast<std::size_t>(slot)] = {kNan, kNan, kNan};
    }
};

KOKSMA_MATHS_END
