#include <koksma/integrators/lecture/recursive.h>
#include <koksma/integrators/lecture/roulette.h>
#include <koksma/integrators/path.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace koksma {

namespace {

constexpr EffectSet kEffects = kLectureEffects;

/// A path that is neither lost nor absorbed ends here, as truncated: between perfect mirrors it would go on for ever.
constexpr std::uint32_t kMostBounces = 1000;

/// Numbers of one bounce: no layout has more.
constexpr std::size_t kMostNumbers = 16;

Vec3f not_a_number() noexcept { return Vec3f(std::numeric_limits<float>::quiet_NaN()); }

}  // namespace

/// Filled at once from the sequence, or one by one from the tail beyond the layout.
struct RecursiveEstimator::Numbers {
    float light_choice = 0.0f, lobe = 0.0f, roulette = 0.0f;
    Vec2f light_position{}, direction{};

    Numbers(const RenderPlan& plan, const SampleSource& source, SampleId id, std::uint32_t bounce) noexcept {
        float u[kMostNumbers] = {};
        const SlotRun run = plan.layout.bounce(bounce);
        const bool laid_out = bounce < plan.bounces.size();
        if (laid_out && !run.empty()) source.fill({&id, 1}, run, u, 1);
        const auto number = [&](SlotRole role, std::int16_t BounceSlots::* member, int k = 0) {
            if (!laid_out) return tail_sample(source.seed(), id, bounce, role, static_cast<std::uint32_t>(k));
            const std::int16_t offset = plan.bounces[bounce].*member;
            return offset < 0 ? 0.0f : u[offset + k];
        };
        light_choice = number(SlotRole::light_choice, &BounceSlots::light_choice);
        light_position = {number(SlotRole::light_position, &BounceSlots::light_position),
                          number(SlotRole::light_position, &BounceSlots::light_position, 1)};
        lobe = number(SlotRole::lobe, &BounceSlots::lobe);
        direction = {number(SlotRole::direction, &BounceSlots::direction), number(SlotRole::direction, &BounceSlots::direction, 1)};
        roulette = number(SlotRole::roulette, &BounceSlots::roulette);
    }
};

NeumannSeries RecursiveEstimator::sample(SampleId id) noexcept {
    pixel_ = id.pixel;
    float u[kMostNumbers] = {};
    source_.fill({&id, 1}, plan_.layout.camera(), u, 1);
    const Vec2f lens = plan_.lens < 0 ? Vec2f{} : Vec2f{u[plan_.lens], u[plan_.lens + 1]};
    const auto camera = camera_ray<float>(scene_.camera, film_point(scene_.camera, id.pixel.x, id.pixel.y, {u[0], u[1]}), lens);
    Branch first;
    first.ray = Ray{camera.o, camera.d, camera.t_near, camera.t_far};
    first.number = id.index;
    ++ledger_.samples;
    return plan_.integrator.max_depth == 0 ? NeumannSeries{} : arriving(first);
}

/// The recursion: L(ray) = Le + (1 / B) sum over B draws of [direct light + weight x L(continued ray)].
NeumannSeries RecursiveEstimator::arriving(const Branch& along) noexcept {
    NeumannSeries light;
    if (!is_traceable(along.ray.o, along.ray.d)) {
        light.term[0] = not_a_number();
        return light;
    }
    ++ledger_.rays.closest;
    const Hit hit = scene_.accelerator.intersect(along.ray);
    if (!hit.valid()) {
        light.term[0] = environment(along);
        return light;
    }
    Vertex at{surface_at<kEffects>(scene_, along.ray, hit), {}, {}};
    light.term[0] = emission(along, hit, at.surface);
    if ((plan_.integrator.max_depth >= 0 && along.depth + 1 >= static_cast<std::uint32_t>(plan_.integrator.max_depth)) ||
        along.depth >= kMostBounces) {
        truncate(along.throughput, along.depth);
        return light;
    }
    at.local = bsdf_at<kEffects>(scene_, at.surface, -along.ray.d);
    at.wo = at.local.frame.to_local(-along.ray.d);
    ++ledger_.vertices;
    const float share = 1.0f / static_cast<float>(settings_.branching);
    for (std::uint32_t k = 0; k < settings_.branching; ++k) {
        Numbers u(plan_, source_, {pixel_, along.number * settings_.branching + k}, along.depth);
        if (settings_.light != Technique::bsdf) light.term[1] += direct_light(at, u) * share;
        if (std::optional<Continued> next = continuation(along, at, u)) {
            next->branch.number = along.number * settings_.branching + k;
            light.add_scattered(next->weight * share, arriving(next->branch));
        }
    }
    return light;
}

float RecursiveEstimator::weight_of_met(const Branch& along, float pdf_light) const noexcept {
    if (along.delta || settings_.light == Technique::bsdf) return 1.0f;
    return settings_.light == Technique::light ? 0.0f : power_heuristic(along.pdf, pdf_light);
}

Vec3f RecursiveEstimator::environment(const Branch& along) const noexcept {
    if (scene_.environment_light < 0 || (along.depth == 0 && plan_.integrator.hide_emitters)) return Vec3f{0.0f};
    const EnvironmentValue sky = environment_value(scene_, along.ray.d);
    const float pdf = along.delta ? 0.0f
                                  : sky.pdf_w * choice_probability<kEffects>(scene_, static_cast<std::uint32_t>(scene_.environment_light),
                                                                             kWholeLight, along.from, along.from_normal);
    return sky.radiance * weight_of_met(along, pdf);
}

Vec3f RecursiveEstimator::emission(const Branch& along, Hit hit, const Surface& surface) const noexcept {
    const Vec3f le = emitted<kEffects>(scene_, surface, -along.ray.d);
    if (!(max_component(le) > 0.0f) || (along.depth == 0 && plan_.integrator.hide_emitters)) return Vec3f{0.0f};
    float pdf = 0.0f;
    if (!along.delta) {
        const auto index = static_cast<std::uint32_t>(scene_.geometries[surface.geometry].light);
        const std::uint32_t triangle = chosen_triangle<kEffects>(scene_, index, hit.primitive);
        pdf = light_pdf<kEffects>(scene_, scene_.lights[index], along.from, surface, along.ray.d, triangle) *
              choice_probability<kEffects>(scene_, index, triangle, along.from, along.from_normal);
    }
    return le * weight_of_met(along, pdf);
}

bool RecursiveEstimator::draws_uniformly(const Vertex& at) const noexcept {
    const BsdfKind kind = at.local.bsdf.kind;
    return settings_.direction == DirectionStrategy::uniform && (kind == BsdfKind::diffuse || kind == BsdfKind::rough_conductor);
}

Vec3f RecursiveEstimator::direct_light(const Vertex& at, const Numbers& u) noexcept {
    const LocalBsdf& local = at.local;
    const Surface& surface = at.surface;
    if (!has_smooth_lobe(local.bsdf) || !(scene_.light_choice.total() > 0.0)) return Vec3f{0.0f};
    LightChoice choice;
    if (plan_.effects.has(Effect::light_choice))
        choice = choose_light<kEffects>(scene_, surface.p, lit_normal_of<kEffects>(local, at.wo), u.light_choice);
    const LightSample light = sample_light<kEffects>(scene_, scene_.lights[choice.light], surface.p, u.light_position, choice.triangle);
    if (!(light.pdf_w > 0.0f && choice.probability > 0.0f)) return Vec3f{0.0f};
    const Vec3f wi = local.frame.to_local(light.wi);
    const BsdfValue value = eval_local<kEffects>(scene_, local, at.wo, wi);
    const float pdf_light = light.pdf_w * choice.probability;
    float weight = 1.0f;
    if (settings_.light == Technique::mis && !light.delta)
        weight = power_heuristic(pdf_light, draws_uniformly(at) ? (at.wo.z > 0.0f && wi.z > 0.0f ? 0.5f * kInvPi : 0.0f) : value.pdf_w);
    const Vec3f contribution = value.f_cos * light.radiance * (weight / pdf_light);
    if (sum(contribution) <= 0.0f) return Vec3f{0.0f};  // a NaN goes on, to be counted
    Ray shadow;
    shadow.o = offset_origin(surface.p, surface.p_error, surface.ng, light.wi);
    shadow.d = light.at_infinity ? light.wi : light.target - shadow.o;
    shadow.t_far = light.at_infinity ? kInfinity : 1.0f;
    if (!is_traceable(shadow.o, shadow.d)) return not_a_number();
    ++ledger_.rays.shadow;
    return scene_.accelerator.occluded(shadow) ? Vec3f{0.0f} : contribution;
}

std::optional<RecursiveEstimator::Continued> RecursiveEstimator::continuation(const Branch& along, const Vertex& at, Numbers& u) noexcept {
    const LocalBsdf& local = at.local;
    const bool plays = plays_roulette(settings_.end) && along.depth + 1 >= static_cast<std::uint32_t>(plan_.integrator.rr_depth);
    float boost = 1.0f;

    // I_roulette: survival is known before the direction, and the direction's number decides.
    const bool rescales = plays && settings_.number == RouletteNumber::rescaled && local.bsdf.kind == BsdfKind::diffuse;
    if (rescales) {
        const Vec3f expected = along.throughput * local.bsdf.reflectance;
        const float survival = settings_.end == PathEnd::constant      ? static_cast<float>(settings_.end_value)
                               : settings_.end == PathEnd::reflectance ? max_component(local.bsdf.reflectance)
                                                                       : max_component(expected) * along.eta_scale;
        if (!(survival > 0.0f)) return std::nullopt;
        if (survival < 1.0f) {
            const RescaledNumber game = rescaled(u.direction.x, survival);
            boost = play(survival, game.survives, expected, along.depth + 1);
            if (boost == 0.0f) return std::nullopt;
            u.direction.x = game.u;
        }
    }

    BsdfSample drawn;
    if (draws_uniformly(at)) {
        const Vec3f wi = square_to_cone(u.direction, 1.0f);
        if (at.wo.z > 0.0f && wi.z > 0.0f)
            drawn = {wi, eval_local<kEffects>(scene_, local, at.wo, wi).f_cos * (2.0f * kPi), 0.5f * kInvPi, 1.0f, false};
    } else {
        drawn = sample_local<kEffects>(scene_, local, at.wo, chooses_lobe(local.bsdf) ? u.lobe : 0.0f, u.direction);
    }
    if (drawn.pdf_w <= 0.0f || sum(drawn.weight) <= 0.0f) return std::nullopt;

    Continued next{along, drawn.weight * boost};
    Branch& b = next.branch;
    b.throughput = along.throughput * next.weight;
    b.eta_scale *= drawn.eta * drawn.eta;
    b.pdf = drawn.pdf_w;
    b.delta = drawn.delta;
    b.from = at.surface.p;
    b.from_normal = lit_normal_of<kEffects>(local, at.wo);
    const Vec3f wi = local.frame.to_world(drawn.wi);
    b.ray = Ray{offset_origin(at.surface.p, at.surface.p_error, at.surface.ng, wi), wi};
    ++b.depth;

    if (settings_.end == PathEnd::threshold && max_component(b.throughput) < static_cast<float>(settings_.end_value)) {
        truncate(b.throughput, b.depth);
        return std::nullopt;
    }
    if (plays && !rescales) {
        float survival = settings_.end == PathEnd::constant      ? static_cast<float>(settings_.end_value)
                         : settings_.end == PathEnd::reflectance ? max_component(drawn.weight) * drawn.eta * drawn.eta
                                                                 : max_component(b.throughput) * b.eta_scale;
        b.lossless = survival < 1.0f ? 0 : b.lossless + 1;
        if (b.lossless > kLosslessBounces) survival = 0.9f;
        if (survival < 1.0f) {
            boost = play(survival, u.roulette < survival, b.throughput, b.depth);
            if (boost == 0.0f) return std::nullopt;
            next.weight *= boost;
            b.throughput *= boost;
        }
    }
    return next;
}

double RecursiveEstimator::weight_of(Vec3f throughput, std::uint32_t depth) const noexcept {
    return static_cast<double>(sum(throughput)) / 3.0 * std::pow(static_cast<double>(settings_.branching), -static_cast<double>(depth));
}

float RecursiveEstimator::play(float survival, bool survives, Vec3f throughput, std::uint32_t depth) noexcept {
    const double weight = weight_of(throughput, depth), boost = 1.0 / static_cast<double>(survival);
    ++ledger_.roulette.played;
    ledger_.roulette.excess += weight * weight * (boost - 1.0);
    ledger_.roulette.largest_boost = std::max(ledger_.roulette.largest_boost, boost);
    if (survives) return 1.0f / survival;
    ++ledger_.roulette.lost;
    ledger_.roulette.weight_lost += weight;
    return 0.0f;
}

void RecursiveEstimator::truncate(Vec3f throughput, std::uint32_t depth) noexcept {
    ++ledger_.truncated.rays;
    ledger_.truncated.weight += weight_of(throughput, depth);
}

}  // namespace koksma
