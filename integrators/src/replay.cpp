#include <koksma/film/film.h>
#include <koksma/integrators/float_mode.h>
#include <koksma/integrators/replay.h>
#include <koksma/integrators/volume_path.h>

#include <fmt/format.h>

#include <iterator>

namespace koksma {

namespace {

std::string text(Vec3f v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z); }

/// Writes down every step of a path.
class Teller {
public:
    explicit Teller(const Scene& scene) : scene_(scene) {}

    void camera(const Ray& ray) {
        line("camera      origin {} direction {} t in [{:.9g}, {:.9g}] time {:.9g}", text(ray.o), text(ray.d), ray.t_near, ray.t_far,
             ray.time);
    }
    void met(const Ray&, Hit) {}
    void shadow(const Ray&, bool) {}
    void vertex(const Surface& s, Hit hit, Vec3f wo, Vec3f beta) {
        const Shape& shape = shape_of(scene_.description, hit.geometry);
        line("vertex {:<4} geometry {} ({}) primitive {}{}", vertex_++, hit.geometry, shape.where.text(), hit.primitive,
             hit.instance == Hit::kNone
                 ? std::string()
                 : fmt::format(" through instance {} ({})", hit.instance, scene_.description.instances[hit.instance].where.text()));
        line("            p {} +- {}", text(s.p), text(s.p_error));
        line("            ng {} n {} uv ({:.9g}, {:.9g}) cos(wo) {:.9g}", text(s.ng), text(s.n), s.uv.x, s.uv.y, dot(wo, s.n));
        line("            beta {}", text(beta));
    }
    void passed(Vec3f beta) { line("  passes on -> beta {}", text(beta)); }
    void collision(Vec3f p, Vec3f wo, Vec3f beta) {
        line("vertex {:<4} in a medium", vertex_++);
        line("            p {} wo {}", text(p), text(wo));
        line("            beta {}", text(beta));
    }
    void escaped(Vec3f d, Vec3f contribution, float weight) {
        line("environment direction {} MIS weight {:.9g} adds {}", text(d), weight, text(contribution));
    }
    void emission(Vec3f contribution, float weight) { line("  emission  MIS weight {:.9g} adds {}", weight, text(contribution)); }
    void direct_light(std::uint32_t light, const LightSample& s, Vec3f contribution, float weight, bool visible) {
        line("  light     #{} wi {} pdf {:.9g} /sr{} MIS weight {:.9g} {} {}", light, text(s.wi), s.pdf_w, s.delta ? " (delta)" : "", weight,
             visible ? "adds" : "is hidden, would add", text(contribution));
    }
    void bounce(const BsdfSample& s, Vec3f wi, Vec3f beta) {
        line("  bsdf      wi {} pdf {:.9g}{} weight {} -> beta {}", text(wi), s.pdf_w, s.delta ? " (delta)" : " /sr", text(s.weight), text(beta));
    }
    void roulette(float u, float survival, bool survives) {
        line("  roulette  u {:.9g} survival {:.9g}: {}", u, survival, survives ? "goes on" : "ends here");
    }
    [[nodiscard]] std::string take() { return std::move(out_); }

private:
    template <class... Args>
    void line(fmt::format_string<Args...> format, Args&&... args) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
        out_ += '\n';
    }
    const Scene& scene_;
    std::string out_;
    int vertex_ = 0;
};

void tell_numbers(std::string& out, std::string_view title, const SampleSource& source, SlotRun run, const SampleId& id) {
    if (run.empty()) return;
    std::vector<float> u(dimension_count(run));
    source.fill({&id, 1}, run, u.data(), 1);
    out += fmt::format("{:<12}", title);
    for (const Slot& s : run)
        for (int k = 0; k < s.arity; ++k)
            out += fmt::format("{}{}[{}] {:.9g}", &s == run.data() && k == 0 ? "" : "  ", name(s.role), s.dimension + static_cast<std::uint32_t>(k),
                               u[s.dimension - run.front().dimension + static_cast<std::uint32_t>(k)]);
    out += '\n';
}

}  // namespace

std::string replay(const Scene& scene, const RenderPlan& plan, const SampleSource& source, SampleId id) {
    const FlushDenormals flush;
    std::string out = fmt::format("pixel ({}, {}) sample {} seed {}\n", id.pixel.x, id.pixel.y, id.index, source.seed());
    tell_numbers(out, "u camera", source, plan.layout.camera(), id);
    Draws draws(plan, source);
    draws.begin({&id, 1}, false);
    draws.select(0);
    RayCounts rays;
    Teller teller(scene);
    const Vec3f radiance = trace_volume_path<EffectSet::all()>(scene, plan, draws, rays, teller);
    for (std::size_t b = 0; b < plan.layout.bounce_count() && b < rays.closest; ++b)
        tell_numbers(out, fmt::format("u bounce {}", b), source, plan.layout.bounce(b), id);
    out += teller.take();
    InvalidSample::Kind kind{};
    out += fmt::format("radiance    {}{}\n", text(radiance), is_invalid(radiance, kind) ? fmt::format("  INVALID: {}", name(kind)) : "");
    return out + fmt::format("rays        {} closest, {} shadow\n", rays.closest, rays.shadow);
}

}  // namespace koksma
