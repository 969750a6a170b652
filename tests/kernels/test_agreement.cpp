// The kernels against each other, path by path. The two families trace the same paths by the same formulas; they may differ
// only where Embree's single rays and its packets answer differently: where a ray passes an edge within rounding.

#include "traced.h"

#include <koksma/sampling/error.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

constexpr std::uint64_t kSpp = 16;

/// Adds up the scenes and holds their sum to 99.99 %.
class Pool {
public:
    void add(const std::string& scene, const Agreement& a) {
        paths_ += a.paths;
        other_ += a.met_something_else;
        text_ += scene + ": " + std::to_string(a.met_something_else) + " of " + std::to_string(a.paths) + " paths met something else\n";
        INFO(scene);
        CHECK(a.same_way_other_radiance == 0);
    }
    void check() const {
        INFO(text_ << "all: " << other_ << " of " << paths_);
        CHECK(paths_ > 500'000);
        CHECK(static_cast<double>(other_) <= 1e-4 * static_cast<double>(paths_));
    }

private:
    std::uint64_t paths_ = 0, other_ = 0;
    std::string text_;
};

}  // namespace

TEST_CASE("a comparison of paths sees other paths and other radiance", "[kernels]") {
    const Ready ready(hills(true));
    const Kernel& kernel = *family(ready.plan.effects, true).front();
    const Traced one = trace_all(ready, kernel, kSpp, 3);
    const Agreement other_seed = compare(one, trace_all(ready, kernel, kSpp, 4));
    CHECK(other_seed.met_something_else > other_seed.paths / 2);
    Traced touched = one;
    touched.radiance[5].y = std::nextafter(touched.radiance[5].y, 2.0f);
    CHECK(compare(one, touched).same_way_other_radiance == 1);
}

TEST_CASE("all variants of a kernel give the same bytes", "[kernels]") {
    std::vector<std::string> targets = simd::targets();
    if (targets.empty()) targets.emplace_back();
    for (const NamedScene& s : kernel_scenes()) {
        const Ready ready(s.description);
        for (const Kernel& kernel : kernels())
            if (!kernel.effects.contains(ready.plan.effects)) CHECK_THROWS_AS(find_kernel(kernel.name, ready.plan.effects), Error);
        for (const bool batch : {false, true})
            for (const std::string& target : batch ? targets : std::vector<std::string>{""}) {
                const Target use(target);
                const std::vector<const Kernel*> variants = family(ready.plan.effects, batch);
                if (batch && variants.empty()) continue;  // the reference kernel's alone
                REQUIRE(!variants.empty());
                const auto film = [&](const Kernel* k) {
                    RenderOptions o;
                    o.kernel = k;
                    const RenderResult r = ready.render(kSobol, 5, 11, o);
                    CHECK(r.stats.invalid_samples == 0);
                    CHECK(r.stats.kernel == k->name);
                    return r.film;
                };
                const Traced most = trace_all(ready, *variants.back(), 4, 11);
                const Film image = film(variants.back());
                CHECK(image.mean().y > 0.0);
                for (const Kernel* k : variants) {
                    INFO(s.name << " with " << k->name << " on " << target);
                    const Agreement a = compare(most, trace_all(ready, *k, 4, 11));
                    CHECK(a.met_something_else == 0);
                    CHECK(a.same_way_other_radiance == 0);
                    CHECK(same_bytes(image, film(k)));
                }
            }
    }
}

TEST_CASE("the batch kernel takes the paths of the reference kernel, with every instruction set", "[kernels]") {
    for (const std::string& target : simd::targets()) {
        const Target use(target);
        INFO(target);
        Pool pool;
        for (const NamedScene& s : kernel_scenes()) {
            const Ready ready(s.description);
            if (family(ready.plan.effects, true).empty()) continue;
            const Traced reference = trace_all(ready, *family(ready.plan.effects, false).front(), kSpp, 3);
            const Traced batch = trace_all(ready, *family(ready.plan.effects, true).front(), kSpp, 3);
            pool.add(s.name, compare(reference, batch));
            const auto near = [](std::uint64_t a, std::uint64_t b) {
                return std::fabs(static_cast<double>(a) - static_cast<double>(b)) <= 1e-4 * static_cast<double>(b);
            };
            INFO(s.name << " closest " << batch.rays.closest << " against " << reference.rays.closest << ", shadow " << batch.rays.shadow << " against "
                        << reference.rays.shadow);
            CHECK(near(batch.rays.closest, reference.rays.closest));
            CHECK(near(batch.rays.shadow, reference.rays.shadow));
        }
        pool.check();
    }
}

TEST_CASE("instruction sets take the same paths", "[kernels]") {
    const std::vector<std::string> targets = simd::targets();
    for (std::size_t t = 1; t < targets.size(); ++t) {
        INFO(targets[t] << " against " << targets[0]);
        Pool pool;
        for (const NamedScene& s : kernel_scenes()) {
            const Ready ready(s.description);
            if (family(ready.plan.effects, true).empty()) continue;
            const auto on = [&](const std::string& target) {
                const Target use(target);
                return trace_all(ready, *family(ready.plan.effects, true).front(), kSpp, 5);
            };
            pool.add(s.name, compare(on(targets[0]), on(targets[t])));
        }
        pool.check();
    }
}

// Where a path meets something else its radiance is another, but neither is the wrong one: over the film nothing may show.
TEST_CASE("batch and reference kernels have the same mean", "[kernels]") {
    for (const NamedScene& s : kernel_scenes()) {
        const Ready ready(s.description);
        if (family(ready.plan.effects, true).empty()) continue;
        const auto means = [&](bool batch, std::uint64_t first_seed) {
            RenderOptions o;
            o.kernel = family(ready.plan.effects, batch).front();
            std::vector<double> out;
            for (std::uint64_t r = 0; r < 8; ++r) out.push_back(ready.render(kSobol, 4, first_seed + r, o).film.mean().y);
            return measured(out);
        };
        const Measured reference = means(false, 1), same_seeds = means(true, 1), other_seeds = means(true, 1001);
        INFO(s.name << ": reference " << reference.mean << " batch " << same_seeds.mean << ", with other seeds " << other_seeds.mean << " +- "
                    << other_seeds.standard_error);
        // One path in 10^4 that differs by as much as all of its radiance.
        CHECK(std::fabs(same_seeds.mean - reference.mean) <= 1e-4 * reference.mean);
        CHECK(std::fabs(other_seeds.mean - reference.mean) <= reference.noise() + other_seeds.noise());
    }
}

// A hollow cube of perfect mirrors with a grey ball and a gap: paths stay for hundreds of bounces, each with its own count of those that lost nothing.
TEST_CASE("both kernels count the bounces that lose nothing alike, while other paths leave", "[kernels]") {
    SceneDescription d = empty_scene();
    const std::uint32_t mirror = add_material(d, Conductor{}, true), grey = add_diffuse(d, 0.5f);
    for (const Matrix& turn : {Matrix(1.0), rotated({1, 0, 0}, 90), rotated({1, 0, 0}, 180), rotated({1, 0, 0}, 270), rotated({0, 1, 0}, 90)})
        add_shape(d, RectangleShape{}, turn * translated({0, 0, -1}), mirror);
    add_shape(d, RectangleShape{}, rotated({0, 1, 0}, 270) * translated({0, 0, -1}) * scaled({0.95, 1, 1}), mirror);
    add_shape(d, SphereShape{}, translated({0.3, -0.2, -0.4}) * scaled(0.1), grey);
    d.environment = ConstantEnvironment{Rgb(1.0f), {}};
    d.film.width = d.film.height = 16;
    d.integrator.max_depth = -1;
    const Ready ready(d);
    const Traced reference = trace_all(ready, *family(ready.plan.effects, false).front(), kSpp, 3);
    CHECK(reference.rays.closest > 100 * reference.radiance.size());
    const Agreement a = compare(reference, trace_all(ready, *family(ready.plan.effects, true).front(), kSpp, 3));
    CHECK(a.met_something_else <= a.paths / 1000);  // hundreds of chances each to pass an edge within rounding
    CHECK(a.same_way_other_radiance == 0);
}
