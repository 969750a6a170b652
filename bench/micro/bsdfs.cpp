// BSDFs: sampled and evaluated one by one and in packs, with the code of all kinds compiled in.

#include "bsdfs.h"
#include "render.h"

#include <koksma/sampling/bits.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace koksma::micro {

namespace {

BsdfRows& rows() {
    static const std::unique_ptr<BsdfRows> all = [] {
        auto r = std::make_unique<BsdfRows>();
        const auto number = [](std::uint32_t what, std::size_t i) { return unit_float(keyed_hash({what, 5}, static_cast<std::uint32_t>(i))); };
        for (std::size_t i = 0; i < kBsdfInputs; ++i) {
            const Vec3f wo = square_to_cosine_hemisphere(Vec2f{number(0, i), number(1, i)}), wi = square_to_cosine_hemisphere(Vec2f{number(2, i), number(3, i)});
            r->wo_x[i] = wo.x;
            r->wo_y[i] = wo.y;
            r->wo_z[i] = wo.z;
            r->wi_x[i] = wi.x;
            r->wi_y[i] = wi.y;
            r->wi_z[i] = wi.z;
            r->u_lobe[i] = number(4, i);
            r->u_x[i] = number(5, i);
            r->u_y[i] = number(6, i);
        }
        return r;
    }();
    return *all;
}

void sample_singles(const Bsdf& b, BsdfRows& r) {
    for (std::size_t i = 0; i < kBsdfInputs; ++i) {
        const BsdfSample s = sample_bsdf<EffectSet::all()>(b, Vec3f{r.wo_x[i], r.wo_y[i], r.wo_z[i]}, r.u_lobe[i], Vec2f{r.u_x[i], r.u_y[i]});
        r.out[i] = sum(s.wi) + sum(s.weight) + s.pdf_w + s.eta;
    }
}
void eval_singles(const Bsdf& b, BsdfRows& r) {
    for (std::size_t i = 0; i < kBsdfInputs; ++i) {
        const BsdfValue v = eval_bsdf<EffectSet::all()>(b, Vec3f{r.wo_x[i], r.wo_y[i], r.wo_z[i]}, Vec3f{r.wi_x[i], r.wi_y[i], r.wi_z[i]});
        r.out[i] = sum(v.f_cos) + v.pdf_w;
    }
}

std::vector<std::pair<std::string, Bsdf>> kinds() {
    Bsdf diffuse, glass, mirror, gold, ggx;
    diffuse.kind = BsdfKind::diffuse;
    diffuse.reflectance = Vec3f(0.5f);
    glass.kind = BsdfKind::dielectric;
    glass.reflectance = glass.transmittance = Vec3f(1.0f);
    glass.eta = Vec3f(1.5f);
    mirror.kind = BsdfKind::conductor;
    mirror.perfect = true;
    mirror.reflectance = Vec3f(1.0f);
    gold = mirror;
    gold.perfect = false;
    gold.eta = {0.14f, 0.37f, 1.44f};
    gold.k = {3.98f, 2.38f, 1.60f};
    ggx = gold;
    ggx.kind = BsdfKind::rough_conductor;
    ggx.facets = {0.2f, 0.2f, true};
    Bsdf beckmann = ggx;
    beckmann.facets = {0.2f, 0.2f, false};
    return {{"diffuse", diffuse}, {"dielectric", glass}, {"mirror", mirror}, {"conductor", gold}, {"rough-ggx", ggx}, {"rough-beckmann", beckmann}};
}

}  // namespace

void register_bsdfs() {
    using Function = void (*)(const Bsdf&, BsdfRows&);
    constexpr std::pair<const char*, Function> kForms[] = {
        {"bsdf/sample/single/", sample_singles}, {"bsdf/sample/pack/", sample_packs}, {"bsdf/eval/single/", eval_singles}, {"bsdf/eval/pack/", eval_packs}};
    for (const auto& [form, function] : kForms)
        for (const auto& [kind, bsdf] : kinds()) {
            if (std::string(form).starts_with("bsdf/eval") && !has_smooth_lobe(bsdf)) continue;
            benchmark::RegisterBenchmark((form + kind).c_str(), [function = function, bsdf = bsdf](benchmark::State& state) {
                for ([[maybe_unused]] auto iteration : state) {
                    function(bsdf, rows());
                    benchmark::DoNotOptimize(rows().out);
                    benchmark::ClobberMemory();
                }
                count(state, kBsdfInputs, "per_direction");
            });
        }
}

}  // namespace koksma::micro
