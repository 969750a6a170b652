#include <koksma/plan/plan.h>
#include <koksma/sampling/error.h>

#include <algorithm>
#include <string>

namespace koksma {

namespace {

/// Effects that only the volumetric path integrator knows.
constexpr Effect kVolumetric[] = {Effect::medium, Effect::heterogeneous, Effect::null_boundary, Effect::mask};

/// Vertices at which a path may go on: at the last one of max_depth only emission counts.
std::int32_t bounce_limit(const IntegratorSettings& settings) {
    return settings.max_depth < 0 ? kMaxLaidOutBounces : std::clamp(settings.max_depth - 1, 0, kMaxLaidOutBounces);
}

/// Roulette is played after bounce b when the path then has rr_depth vertices or more (Mitsuba's meaning).
bool roulette_at(std::int32_t bounce, const IntegratorSettings& settings) { return bounce + 1 >= settings.rr_depth; }

BounceSlots offsets(SlotRun run) {
    const auto at = [&](SlotRole role) {
        const Slot* slot = DimensionLayout::find(run, role);
        return static_cast<std::int16_t>(slot == nullptr ? -1 : static_cast<int>(slot->dimension - run.front().dimension));
    };
    return {at(SlotRole::light_choice), at(SlotRole::light_position), at(SlotRole::lobe),      at(SlotRole::direction),
            at(SlotRole::roulette),     at(SlotRole::distance),       at(SlotRole::collision), at(SlotRole::passage)};
}

/// What is decided on the way to a vertex.
void add_way(DimensionLayout& layout, EffectSet effects) {
    if (effects.has(Effect::medium)) layout.add_bounce(SlotRole::distance, 1);
    if (effects.has(Effect::heterogeneous)) layout.add_bounce(SlotRole::collision, 1);
    if (effects.has(Effect::mask)) layout.add_bounce(SlotRole::passage, 1);
}

}  // namespace

DimensionLayout make_layout(EffectSet effects, const IntegratorSettings& settings) {
    DimensionLayout layout;
    layout.add_camera(SlotRole::film, 2);
    if (effects.has(Effect::lens)) layout.add_camera(SlotRole::lens, 2);
    if (effects.has(Effect::motion)) layout.add_camera(SlotRole::time, 1);
    const bool smooth = effects.has(Effect::diffuse) || effects.has(Effect::glossy) || effects.has(Effect::medium);
    const bool light_has_extent = effects.has(Effect::area_light) || effects.has(Effect::environment);
    for (std::int32_t b = 0; b < bounce_limit(settings); ++b) {
        layout.begin_bounce();
        add_way(layout, effects);
        if (smooth && effects.has(Effect::light_choice)) layout.add_bounce(SlotRole::light_choice, 1);
        if (smooth && light_has_extent) layout.add_bounce(SlotRole::light_position, 2);
        if (effects.has(Effect::lobe)) layout.add_bounce(SlotRole::lobe, 1);
        if (smooth) layout.add_bounce(SlotRole::direction, 2);
        if (effects.has(Effect::roulette) && roulette_at(b, settings)) layout.add_bounce(SlotRole::roulette, 1);
    }
    // Where only emission counts, a path still has to get there.
    if ((effects.has(Effect::medium) || effects.has(Effect::mask)) && settings.max_depth > 0 && settings.max_depth <= kMaxLaidOutBounces) {
        layout.begin_bounce();
        add_way(layout, effects);
    }
    return layout;
}

EffectSet needed_effects(const Scene& scene, const IntegratorSettings& settings) {
    if (settings.max_depth < -1) throw Error("max_depth is " + std::to_string(settings.max_depth) + "; expected -1 (no limit), 0 or more");
    if (settings.rr_depth < 0) throw Error("rr_depth is " + std::to_string(settings.rr_depth) + "; expected 0 or more");
    EffectSet effects = scene.effects;
    if (!settings.volumetric)
        for (const Effect e : kVolumetric) effects = effects.without(e);
    if (settings.technique != Technique::mis) effects |= {Effect::one_technique};
    if (settings.max_depth < 0 || settings.max_depth - 1 >= std::max(settings.rr_depth, 1)) effects |= {Effect::roulette};
    return effects;
}

RenderPlan make_plan(const Scene& scene, const IntegratorSettings& settings) { return make_plan(scene, settings, needed_effects(scene, settings)); }

RenderPlan make_plan(const Scene& scene, const IntegratorSettings& settings, EffectSet forced) {
    const EffectSet needed = needed_effects(scene, settings);
    if (!forced.contains(needed)) {
        std::string missing;
        for (const std::string& e : EffectSet(needed.bits & ~forced.bits).names()) missing += (missing.empty() ? "" : ", ") + e;
        throw Error("the effects lack what the scene calls for: " + missing);
    }
    RenderPlan plan;
    plan.effects = forced;
    plan.integrator = settings;
    plan.layout = make_layout(plan.effects, settings);
    if (const Slot* lens = DimensionLayout::find(plan.layout.camera(), SlotRole::lens))
        plan.lens = static_cast<std::int16_t>(lens->dimension);
    if (const Slot* time = DimensionLayout::find(plan.layout.camera(), SlotRole::time))
        plan.time = static_cast<std::int16_t>(time->dimension);
    for (std::size_t b = 0; b < plan.layout.bounce_count(); ++b) {
        const SlotRun run = plan.layout.bounce(b);
        plan.bounces.push_back(run.empty() ? BounceSlots{} : offsets(run));
    }
    return plan;
}

}  // namespace koksma
