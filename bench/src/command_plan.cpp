#include "commands.h"
#include "scene_setup.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace koksma {

namespace {

/// The first dimension that comes from the tail instead of the sampler; the layout's size if none does.
std::uint32_t first_tail_dimension(const DimensionLayout& layout, const SamplerInfo& info) {
    for (const Slot& s : layout.slots())
        if (s.dimension + s.arity > info.max_dimensions) return s.dimension;
    return layout.dimensions();
}

std::string run_text(SlotRun run) {
    std::string out;
    for (const Slot& s : run) {
        out += out.empty() ? "" : ", ";
        out += s.arity == 1 ? fmt::format("{} [{}]", name(s.role), s.dimension) : fmt::format("{} [{}-{}]", name(s.role), s.dimension, s.dimension + s.arity - 1);
    }
    return out.empty() ? "none" : out;
}

bool same_shape(SlotRun a, SlotRun b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a[i].role != b[i].role) return false;
    return true;
}

void print_bounces(const DimensionLayout& layout) {
    for (std::size_t b = 0; b < layout.bounce_count();) {
        std::size_t end = b + 1;
        while (end < layout.bounce_count() && same_shape(layout.bounce(b), layout.bounce(end))) ++end;
        const std::string which = end - b == 1 ? fmt::format("bounce {}", b) : fmt::format("bounces {}-{}", b, end - 1);
        fmt::print("  {:<14} {}{}\n", which, run_text(layout.bounce(b)),
                   end - b == 1 ? "" : fmt::format("  (of bounce {}; {} dimensions each)", b, dimension_count(layout.bounce(b))));
        b = end;
    }
}

nlohmann::ordered_json origins_json(const SceneSetup& setup) {
    nlohmann::ordered_json out = nlohmann::ordered_json::object();
    for (const auto& [effect, where] : setup.scene.called_for)
        if (setup.plan.effects.has(effect)) out[std::string(name(effect))] = where.text();
    return out;
}

nlohmann::ordered_json plan_json(const SceneSetup& setup, std::uint32_t tail) {
    nlohmann::ordered_json slots = nlohmann::ordered_json::array();
    const auto add = [&](SlotRun run, int bounce) {
        for (const Slot& s : run) slots.push_back({{"role", name(s.role)}, {"bounce", bounce}, {"dimension", s.dimension}, {"arity", s.arity}});
    };
    add(setup.plan.layout.camera(), -1);
    for (std::size_t b = 0; b < setup.plan.layout.bounce_count(); ++b) add(setup.plan.layout.bounce(b), static_cast<int>(b));
    return {{"scene", setup.scene.description.file},
            {"effects", setup.plan.effects.names()},
            {"called_for", origins_json(setup)},
            {"kernel", choose_kernel(setup.plan.effects).name},
            {"sampler", setup.sampler->name()},
            {"dimensions", setup.plan.layout.dimensions()},
            {"tail_dimension", tail},
            {"tail_bounce", setup.plan.layout.bounce_count()},
            {"slots", slots}};
}

}  // namespace

int run_plan(const PlanCommand& command, const Registry& registry) {
    const SceneSetup setup = set_up(command.scene, registry);
    const RenderPlan& plan = setup.plan;
    const std::uint32_t tail = first_tail_dimension(plan.layout, setup.sampler->info());
    if (command.json) {
        fmt::print("{}\n", plan_json(setup, tail).dump(2));
        return 0;
    }
    std::string effects;
    for (const std::string& e : plan.effects.names()) effects += (effects.empty() ? "" : ", ") + e;
    std::size_t triangles = setup.scene.triangles.size();
    fmt::print("scene          {}\n", setup.scene.description.file);
    const Scene& scene = setup.scene;
    fmt::print("geometry       {} triangles, {} spheres, {} disks, {} cylinders{}; {} lights, {} media\n", triangles, scene.spheres.size(),
               scene.disks.size(), scene.cylinders.size(),
               scene.instances.empty() ? "" : fmt::format(", in {} groups with {} instances what moves or is repeated", scene.groups.size(), scene.instances.size()),
               scene.lights.size(), plan.effects.has(Effect::medium) ? scene.media.size() : 0);
    fmt::print("max_depth      {}, rr_depth {}\n", plan.integrator.max_depth, plan.integrator.rr_depth);
    fmt::print("effects        {}\n", effects.empty() ? "none" : effects);
    for (const auto& [effect, where] : setup.scene.called_for)
        if (plan.effects.has(effect)) fmt::print("  {:<14} {}\n", name(effect), where.text());
    fmt::print("kernel         {} (admissible:", choose_kernel(plan.effects).name);
    for (const Kernel& k : kernels())
        if (k.effects.contains(plan.effects)) fmt::print(" {}", k.name);
    fmt::print(")\n");
    fmt::print("slots          {} dimensions a path\n", plan.layout.dimensions());
    fmt::print("  {:<14} {}\n", "camera", run_text(plan.layout.camera()));
    print_bounces(plan.layout);
    const bool endless = plan.integrator.max_depth < 0 || plan.integrator.max_depth - 1 > kMaxLaidOutBounces;
    fmt::print("tail           {}{}\n",
               tail < plan.layout.dimensions() ? fmt::format("from dimension {} on: {} has {} dimensions", tail, setup.sampler->name(), setup.sampler->info().max_dimensions)
                                               : "not reached within the laid-out bounces",
               endless ? fmt::format("; bounces from {} on draw from it", plan.layout.bounce_count()) : "");
    return 0;
}

}  // namespace koksma
