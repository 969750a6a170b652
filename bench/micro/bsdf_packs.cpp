#include "bsdfs.h"

#define KOKSMA_SHARED_MATHS <koksma/scene/all_maths.h>
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bsdf_packs.cpp"
#include <koksma/simd/each_target.h>

KOKSMA_MATHS_BEGIN

inline BsdfOf<Float> pack_of(const Bsdf& b) {
    const auto vector = [](Vec3f v) { return Vec3<Float>{Float(v.x), Float(v.y), Float(v.z)}; };
    BsdfOf<Float> out;
    out.kind = Int32(static_cast<std::int32_t>(b.kind));
    out.perfect = b.perfect ? Mask::first(static_cast<std::size_t>(kLanes)) : Mask::first(0);
    out.reflectance = vector(b.reflectance);
    out.transmittance = vector(b.transmittance);
    out.eta = vector(b.eta);
    out.k = vector(b.k);
    out.facets.alpha_u = Float(b.facets.alpha_u);
    out.facets.alpha_v = Float(b.facets.alpha_v);
    out.facets.ggx = b.facets.ggx ? Mask::first(static_cast<std::size_t>(kLanes)) : Mask::first(0);
    return out;
}

void sample_all(const Bsdf& bsdf, micro::BsdfRows& r) {
    const BsdfOf<Float> b = pack_of(bsdf);
    for (std::size_t i = 0; i < micro::kBsdfInputs; i += static_cast<std::size_t>(kLanes)) {
        const Vec3<Float> wo{Float::load(r.wo_x + i), Float::load(r.wo_y + i), Float::load(r.wo_z + i)};
        const BsdfSampleOf<Float> s = sample_bsdf<EffectSet::all()>(b, wo, Float::load(r.u_lobe + i), Vec2<Float>{Float::load(r.u_x + i), Float::load(r.u_y + i)});
        (sum(s.wi) + sum(s.weight) + s.pdf_w + s.eta).store(r.out + i);
    }
}

void eval_all(const Bsdf& bsdf, micro::BsdfRows& r) {
    const BsdfOf<Float> b = pack_of(bsdf);
    for (std::size_t i = 0; i < micro::kBsdfInputs; i += static_cast<std::size_t>(kLanes)) {
        const Vec3<Float> wo{Float::load(r.wo_x + i), Float::load(r.wo_y + i), Float::load(r.wo_z + i)};
        const Vec3<Float> wi{Float::load(r.wi_x + i), Float::load(r.wi_y + i), Float::load(r.wi_z + i)};
        const BsdfValueOf<Float> v = eval_bsdf<EffectSet::all()>(b, wo, wi);
        (sum(v.f_cos) + v.pdf_w).store(r.out + i);
    }
}

KOKSMA_MATHS_END

#if HWY_ONCE
namespace koksma {
HWY_EXPORT(sample_all);
HWY_EXPORT(eval_all);
void micro::sample_packs(const Bsdf& bsdf, BsdfRows& rows) { HWY_DYNAMIC_DISPATCH(sample_all)(bsdf, rows); }
void micro::eval_packs(const Bsdf& bsdf, BsdfRows& rows) { HWY_DYNAMIC_DISPATCH(eval_all)(bsdf, rows); }
}  // namespace koksma
#endif
