// What the batch kernel asks Embree, and how.

#include "traced.h"

using namespace koksma;
using namespace koksma::testing;

namespace {

struct Asked {
    std::uint64_t paths = 0, coherent = 0, incoherent = 0;  ///< rays that look for the closest hit, by how packets of them went
};

Asked asked(const SceneDescription& description) {
    Ready ready(description);
    Asked out;
    ready.scene.accelerator.watch([&](const PacketQuery& q) {
        if (q.shadow) return;
        const auto rays = static_cast<std::uint64_t>(std::count_if(q.valid, q.valid + q.width, [](std::int32_t v) { return v != 0; }));
        (q.coherence == Coherence::coherent ? out.coherent : out.incoherent) += rays;
    });
    const Traced traced = trace_all(ready, *family(ready.plan.effects, true).front(), 4, 9);
    out.paths = traced.radiance.size();
    CHECK(out.coherent + out.incoherent == traced.rays.closest);
    return out;
}

}  // namespace

TEST_CASE("rays that the camera rays' first glass sends on are asked as coherent, those of diffuse surfaces and of later glass are not", "[kernels]") {
    const Asked diffuse = asked(hills(false));
    CHECK(diffuse.coherent == diffuse.paths);
    CHECK(diffuse.incoherent > 0);
    SceneDescription both = hills(true);
    const Asked glass = asked(both);
    CHECK(glass.coherent > glass.paths * 5 / 4);
    CHECK(glass.incoherent > 0);
    both.integrator.max_depth = 2;  // camera rays, and one more: those of the glass, and those of the diffuse stripes beside it
    const Asked second = asked(both);
    CHECK(second.coherent == glass.coherent);
    CHECK(second.incoherent > 0);
}
