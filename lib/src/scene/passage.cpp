#include <koksma/scene/bsdf/passage.h>

#include <koksma/scene/bsdf/layered_parts.h>
#include <koksma/scene/scene.h>
#include <koksma/scene/surface.h>

#include <algorithm>

namespace koksma {

namespace {

struct Passing {
    const Scene& scene;
    LayeredPoint at;
    Vec3f wo;

    [[nodiscard]] Passage of(std::uint32_t side) const noexcept {
        LayeredPoint there = at;
        there.side = side;
        return passage_at(scene, there, wo);
    }
    [[nodiscard]] float share(const TextureRef& ref) const noexcept {
        if (ref.index < 0) return std::clamp(ref.constant.x, 0.0f, 1.0f);
        return std::clamp(luminance(texture_value<EffectSet::all()>(scene, ref, at.uv)), 0.0f, 1.0f);
    }
    static Passage mixed(const Passage& a, const Passage& b, float w) noexcept {
        return {a.transmittance * (1.0f - w) + b.transmittance * w, a.probability * (1.0f - w) + b.probability * w};
    }

    /// What refracts, reflects or bends normals lets nothing pass (as in Mitsuba 3).
    template <class Part>
    Passage operator()(const Part&) const noexcept {
        return {};
    }
    Passage operator()(const NullPart&) const noexcept { return {Vec3f(1.0f), 1.0f}; }
    Passage operator()(const MaskPart& part) const noexcept { return mixed({Vec3f(1.0f), 1.0f}, of(part.nested), share(part.opacity)); }
    Passage operator()(const BlendPart& part) const noexcept { return mixed(of(part.first), of(part.second), share(part.weight)); }
};

}  // namespace

Passage passage_at(const Scene& scene, const LayeredPoint& at, Vec3f wo) noexcept {
    const MaterialSide& side = scene.sides[at.side];
    if (side.layered >= 0) return std::visit(Passing{scene, at, wo}, scene.layered->parts[static_cast<std::size_t>(side.layered)]);
    if (side.kind != BsdfKind::thin_dielectric || wo.z == 0.0f) return {};
    const float once = fresnel_dielectric(std::fabs(wo.z), side.eta.x).reflectance;
    const float passes = once < 1.0f ? 1.0f - 2.0f * once / (1.0f + once) : 0.0f;  // as sample_bsdf has it
    return {side.transmittance * passes, passes};
}

}  // namespace koksma
