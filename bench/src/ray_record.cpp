#include "ray_record.h"

#include <koksma/integrators/float_mode.h>
#include <koksma/integrators/path.h>

#include <fmt/format.h>

#include <algorithm>

namespace koksma {

/// Watches a path for its rays.
struct RayRecorder : NoObserver {
    const Scene& scene;
    RayRecord& record;
    RayRecorder(const Scene& s, RayRecord& r) : scene(s), record(r) {}
    void met(const Ray& ray, Hit hit) {
        record.add(ray, false);
        // What the accelerator says, without what closest_hit() makes of it.
        if (hit.instance != Hit::kNone) hit.geometry -= scene.instances[hit.instance].first_geometry;
        record.answers_.met(hit);
    }
    void shadow(const Ray& ray, bool visible) {
        record.add(ray, true);
        record.answers_.shadow(!visible);
    }
};

RayRecord::RayRecord(const Scene& scene, const RenderPlan& plan, const SampleSource& source, const WorkItem& work,
                     std::uint64_t most_bytes) {
    constexpr std::int32_t kTile = 8;
    if (plan.effects.has(Effect::medium) || plan.effects.has(Effect::null_boundary))
        throw Error("rays of paths through media cannot be recorded");
    const FlushDenormals flush;
    Draws draws(plan, source);
    std::vector<SampleId> ids;
    RayRecorder recorder(scene, *this);
    const PixelRect r = work.rect;
    const std::uint64_t end = work.first + work.count;
    for (std::int32_t tile_y = r.y; tile_y < r.y + r.height; tile_y += kTile)
        for (std::int32_t tile_x = r.x; tile_x < r.x + r.width; tile_x += kTile)
            for (std::uint64_t at = work.first; at < end; at += ids.size())
                for (std::int32_t y = tile_y; y < std::min(tile_y + kTile, r.y + r.height); ++y)
                    for (std::int32_t x = tile_x; x < std::min(tile_x + kTile, r.x + r.width); ++x) {
                        ids.clear();
                        for (std::uint64_t i = at; i < std::min(end, (at / Film::kChunk + 1) * Film::kChunk); ++i)
                            ids.push_back({{x, y}, i});
                        draws.begin(ids, false);
                        for (std::size_t i = 0; i < ids.size(); ++i) {
                            draws.select(i);
                            static_cast<void>(trace_path<EffectSet::all()>(scene, plan.integrator, draws, rays_, recorder));
                        }
                        if (blocks_.size() * sizeof(Block) > most_bytes)
                            throw Error(fmt::format("the rays of {} paths need more than {} GB; lower --spp or use --crop",
                                                    work.count * static_cast<std::uint64_t>(r.area()), most_bytes >> 30));
                    }
}

void RayRecord::add(const Ray& ray, bool shadow) {
    if (blocks_.empty() || blocks_.back()->size == kBlock) blocks_.push_back(std::make_unique<Block>());
    Block& b = *blocks_.back();
    b.rays[b.size] = ray;
    b.shadow[b.size++] = shadow;
}

double RayRecord::replay(const Accelerator& accelerator, Answers& answers) const noexcept {
    const FlushDenormals flush;
    const double start = thread_seconds();
    for (const auto& b : blocks_)
        for (std::size_t i = 0; i < b->size; ++i) {
            if (b->shadow[i])
                answers.shadow(accelerator.occluded(b->rays[i]));
            else
                answers.met(accelerator.intersect(b->rays[i]));
        }
    return thread_seconds() - start;
}

namespace {

constexpr std::size_t kRows = 9;  // of a packet: o, t_near, d, time, t_far

}  // namespace

void PacketRecord::add(const PacketQuery& q, std::uint64_t most_bytes) {
    const std::size_t numbers = kRows * static_cast<std::size_t>(q.width);
    if ((rays_.size() + numbers) * sizeof(float) > most_bytes) {
        ++dropped_;
        return;
    }
    width_ = q.width;
    std::uint32_t active = 0;
    for (int i = 0; i < q.width; ++i)
        if (q.valid[i] != 0) active |= 1u << i;
    headers_.push_back({rays_.size(), active, q.shadow, q.coherence});
    rays_.insert(rays_.end(), q.rays, q.rays + numbers);
}

double PacketRecord::replay(const Accelerator& accelerator, Answers& answers) const {
    switch (width_) {
        case 4:
            return replay_width<4>(accelerator, answers);
        case 8:
            return replay_width<8>(accelerator, answers);
        case 16:
            return replay_width<16>(accelerator, answers);
        default:
            throw Error(fmt::format("packets of {} rays cannot be replayed", width_));
    }
}

template <int N>
double PacketRecord::replay_width(const Accelerator& accelerator, Answers& answers) const {
    constexpr std::size_t kTogether = 128;  // of 16: 180 kB, in a core's own cache beside the BVH's upper levels
    struct alignas(4 * N) Valid {
        std::int32_t lane[N];
    };
    const FlushDenormals flush;
    std::vector<RayPacket<N>> packets(kTogether);
    std::vector<Valid> valid(kTogether);
    double seconds = 0.0;
    for (std::size_t first = 0; first < headers_.size(); first += kTogether) {
        const std::size_t n = std::min(kTogether, headers_.size() - first);
        for (std::size_t k = 0; k < n; ++k) {
            const Header& h = headers_[first + k];
            RayPacket<N>& p = packets[k];
            p = {};
            std::copy_n(&rays_[h.at], kRows * N, p.o_x);
            for (int i = 0; i < N; ++i) {
                p.mask[i] = ~0u;
                p.geometry[i] = Hit::kNone;
                valid[k].lane[i] = (h.active >> i) & 1u ? -1 : 0;
            }
        }
        const double start = thread_seconds(), clock = thread_seconds() - start;  // what looking at the clock takes
        for (std::size_t k = 0; k < n; ++k) {
            const Header& h = headers_[first + k];
            if (h.shadow)
                accelerator.occluded(packets[k], valid[k].lane, h.coherence);
            else
                accelerator.intersect(packets[k], valid[k].lane, h.coherence);
        }
        seconds += thread_seconds() - start - 2.0 * clock;
        for (std::size_t k = 0; k < n; ++k)
            for (int i = 0; i < N; ++i) {
                if (valid[k].lane[i] == 0) continue;
                if (headers_[first + k].shadow)
                    answers.blocked += packets[k].t_far[i] < 0.0f;
                else
                    answers.closest_hits += packets[k].geometry[i] != Hit::kNone;
            }
    }
    return seconds;
}

}  // namespace koksma
