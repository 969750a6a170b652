#include "judge.h"

#include "reference_store.h"

#include <koksma/measure/seeds.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>

namespace koksma {

std::vector<unsigned char> visible_emitters(const BenchScene& s, const Registry& registry, int threads) {
    constexpr std::uint64_t kSamples = 64;
    const PixelRect& crop = s.what.crop;
    const int x0 = std::max(0, crop.x - 1), y0 = std::max(0, crop.y - 1);
    const PixelRect wider{x0, y0, std::min(s.scene.film.width, crop.x + crop.width + 1) - x0, std::min(s.scene.film.height, crop.y + crop.height + 1) - y0};
    IntegratorSettings emission_only = s.scene.description.integrator;
    emission_only.max_depth = 1;
    const RenderPlan plan = make_plan(s.scene, emission_only);
    const auto source = registry.make(registry.contains("stratified") ? "stratified" : "random")->bind(sampling_plan(s.scene, plan, kSamples, 0));
    RenderOptions options;
    options.threads = threads;
    const std::vector<float> seen = render(s.scene, plan, *source, {wider, 0, kSamples}, options).film.image();
    const auto shines = [&](int x, int y) {
        if (x < wider.x || y < wider.y || x >= wider.x + wider.width || y >= wider.y + wider.height) return false;
        const float* rgb = &seen[3 * (static_cast<std::size_t>(y - wider.y) * static_cast<std::size_t>(wider.width) + static_cast<std::size_t>(x - wider.x))];
        return rgb[0] > 0 || rgb[1] > 0 || rgb[2] > 0;
    };
    std::vector<unsigned char> mask;
    for (int y = crop.y; y < crop.y + crop.height; ++y)
        for (int x = crop.x; x < crop.x + crop.width; ++x) {
            bool near = false;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) near = near || shines(x + dx, y + dy);
            mask.push_back(near ? 1 : 0);
        }
    return mask;
}

namespace {

std::string content_of(const Reference& reference) {
    std::uint64_t h = 0;
    for (const std::vector<float>* image : {&reference.mean, &reference.variance})
        for (const float v : *image) h = hash_combine(h, std::bit_cast<std::uint32_t>(v));
    return fmt::format("{:016x}", h);
}

}  // namespace

Judge::Judge(const BenchScene& scene, const Reference& reference, const Registry& registry, int threads)
    : reference_(&reference),
      content_(content_of(reference)),
      flip_(reference.mean, reference.key.rect.width, reference.key.rect.height),
      emitters_(visible_emitters(scene, registry, threads)) {}

Judge::Verdict Judge::judge(std::span<const float> image, bool with_flip) const {
    const std::vector<float> map = with_flip ? flip_.map(image) : std::vector<float>{};
    const auto errors = [&](std::span<const unsigned char> skip) {
        const ReferenceError e = compare_to_reference(image, reference_->mean, reference_->variance, skip);
        return Errors{e.pixels, e.mse, e.mse_raw, e.relmse, e.relmse_raw, e.mae, e.smape, mean_of_map(map, skip)};
    };
    return {errors({}), errors(emitters_)};
}

Errors Judge::between_halves() const {
    const ReferenceHalf &a = reference_->halves[0], &b = reference_->halves[1];
    const ReferenceError e = compare_to_reference(a.mean, b.mean, {});
    const double flip = HdrFlip(b.mean, reference_->key.rect.width, reference_->key.rect.height).mean(a.mean);
    return {e.pixels, e.mse, e.mse_raw, e.relmse, e.relmse_raw, e.mae, e.smape, flip};
}

std::int64_t Judge::emitter_pixels() const noexcept { return std::count(emitters_.begin(), emitters_.end(), static_cast<unsigned char>(1)); }

}  // namespace koksma
