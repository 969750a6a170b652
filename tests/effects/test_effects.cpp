// One scene for each effect: what it needs is planned, and a replay tells what a render did.

#include "effect_scenes.h"

#include <scenes/render_scene.h>

#include <koksma/integrators/replay.h>
#include <koksma/sampling/error.h>

using namespace koksma;
using namespace koksma::testing;

TEST_CASE("a scene's effects are found and give the path its slots", "[effects]") {
    int seen = 0;
    for (const EffectScene& s : effect_scenes()) {
        const Ready ready(s.description);
        INFO(name(s.effect));
        CHECK(ready.plan.effects.has(s.effect));
        seen |= 1 << static_cast<int>(s.effect);
        const auto has_slot = [&](SlotRole role) {
            for (const Slot& slot : ready.plan.layout.slots())
                if (slot.role == role) return true;
            return false;
        };
        const EffectSet e = ready.plan.effects;
        CHECK(has_slot(SlotRole::film));
        CHECK(has_slot(SlotRole::lens) == e.has(Effect::lens));
        CHECK(has_slot(SlotRole::time) == e.has(Effect::motion));
        CHECK(has_slot(SlotRole::light_choice) == e.has(Effect::light_choice));
        CHECK(has_slot(SlotRole::lobe) == e.has(Effect::lobe));
        CHECK(has_slot(SlotRole::roulette) == e.has(Effect::roulette));
        CHECK(has_slot(SlotRole::distance) == e.has(Effect::medium));
        CHECK(has_slot(SlotRole::collision) == e.has(Effect::heterogeneous));
        CHECK(has_slot(SlotRole::passage) == e.has(Effect::mask));
        CHECK(has_slot(SlotRole::light_position) == (e.has(Effect::area_light) || e.has(Effect::environment)));
    }
    CHECK(seen == (1 << kEffectCount) - 1);
}

TEST_CASE("a replayed path has the radiance that the render added", "[effects]") {
    for (const EffectScene& s : effect_scenes()) {
        SceneDescription d = s.description;
        const Ready ready(d);
        const RenderResult r = ready.render(kSobol, 1, 13);
        const auto source = samplers().make(kSobol)->bind(sampling_plan(ready.scene, ready.plan, 1, 13));
        for (const Pixel p : {Pixel{4, 3}, Pixel{2, 5}}) {
            const std::string text = replay(ready.scene, ready.plan, *source, {p, 0});
            char expected[128];
            const Vec3d m = r.film.mean(p);
            std::snprintf(expected, sizeof expected, "radiance    (%.9g, %.9g, %.9g)", m.x, m.y, m.z);
            INFO(name(s.effect) << "\n" << text << "\n" << expected);
            CHECK(text.find(expected) != std::string::npos);
        }
    }
}

TEST_CASE("a larger set of effects has its layout and the same picture, a smaller one is refused", "[effects]") {
    for (const EffectScene& s : effect_scenes()) {
        Ready ready(s.description);
        INFO(name(s.effect));
        const EffectSet needed = ready.plan.effects;
        CHECK_THROWS_AS(make_plan(ready.scene, s.description.integrator, needed.without(s.effect)), Error);
        const Measured with_needed = measure(ready, 16);
        ready.plan = make_plan(ready.scene, s.description.integrator, largest_effects(needed));
        CHECK(ready.plan.effects.contains(needed));
        CHECK(ready.plan.lens >= 0);
        CHECK(ready.plan.time >= 0);
        const Measured with_all = measure(ready, 16);
        INFO(with_needed.mean << " +- " << with_needed.standard_error << " against " << with_all.mean << " +- " << with_all.standard_error);
        CHECK(std::fabs(with_needed.mean - with_all.mean) <= with_needed.noise() + with_all.noise());
        const EffectSet both = EffectSet::all();
        const RenderOptions reference{.kernel = &find_kernel("reference/all", both)};
        // The layout follows the plan: with the reference kernel the paths are the same.
        const double mean = ready.render(kSobol, 16, 1).film.mean().y;
        CHECK(std::fabs(ready.render(kSobol, 16, 1, reference).film.mean().y - mean) <= 1e-3 * mean);
    }
}

TEST_CASE("a material that no shape uses calls for no effect", "[effects]") {
    SceneDescription d = floor_scene();
    static_cast<void>(add_material(d, Dielectric{}));
    CHECK_FALSE(Ready(d).plan.effects.has(Effect::dielectric));
}

TEST_CASE("the surface integrator knows neither media nor crossings", "[effects]") {
    for (const EffectScene& s : effect_scenes()) {
        SceneDescription d = s.description;
        d.integrator.volumetric = false;
        const Ready ready(d);
        for (const Effect e : {Effect::medium, Effect::heterogeneous, Effect::null_boundary, Effect::mask}) CHECK_FALSE(ready.plan.effects.has(e));
    }
}

TEST_CASE("a path has slots for the way to where only emission counts", "[effects]") {
    for (const EffectScene& s : effect_scenes()) {
        if (s.effect != Effect::medium && s.effect != Effect::mask) continue;
        const Ready ready(s.description);
        const SlotRun last = ready.plan.layout.bounce(ready.plan.layout.bounce_count() - 1);
        CHECK(ready.plan.layout.bounce_count() == static_cast<std::size_t>(s.description.integrator.max_depth));
        CHECK(dimension_count(last) == 1);
        CHECK(last.front().role == (s.effect == Effect::medium ? SlotRole::distance : SlotRole::passage));
    }
}

TEST_CASE("who called for an effect is known", "[effects]") {
    SceneDescription d = effect_scenes().back().description;
    d.materials.back().where = {"leaf.xml", 7, 3};
    const Ready ready(d);
    REQUIRE(ready.scene.called_for.contains(Effect::mask));
    CHECK(ready.scene.called_for.at(Effect::mask).text() == "leaf.xml:7:3");
}
