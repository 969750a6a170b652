#include <koksma/integrators/lecture/estimator.h>
#include <koksma/sampling/error.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include <fmt/format.h>

namespace koksma {

namespace {

constexpr std::array<std::string_view, 3> kTechnique{"mis", "light", "bsdf"};
constexpr std::array<std::string_view, 2> kDirection{"bsdf", "uniform"};
constexpr std::array<std::string_view, 2> kNumber{"own", "rescaled"};
constexpr std::array<std::string_view, 6> kEnd{"none", "depth", "threshold", "constant", "reflectance", "throughput"};

constexpr bool takes_value(PathEnd end) noexcept { return end == PathEnd::depth || end == PathEnd::threshold || end == PathEnd::constant; }

template <class Enum, std::size_t N>
Enum one_of(const std::array<std::string_view, N>& names, std::string_view text, const char* what) {
    const auto at = std::find(names.begin(), names.end(), text);
    if (at == names.end()) throw Error(fmt::format("{} '{}'; expected {}", what, text, fmt::join(names, ", ")));
    return static_cast<Enum>(at - names.begin());
}

}  // namespace

std::string_view name(Technique s) noexcept { return kTechnique[static_cast<std::size_t>(s)]; }
std::string_view name(DirectionStrategy s) noexcept { return kDirection[static_cast<std::size_t>(s)]; }
std::string_view name(RouletteNumber n) noexcept { return kNumber[static_cast<std::size_t>(n)]; }

std::string text_of_end(const EstimatorSettings& s) {
    const std::string_view end = kEnd[static_cast<std::size_t>(s.end)];
    return takes_value(s.end) ? fmt::format("{}={:g}", end, s.end_value) : std::string(end);
}

Technique technique_of(std::string_view text) { return one_of<Technique>(kTechnique, text, "technique"); }
DirectionStrategy direction_strategy_of(std::string_view text) { return one_of<DirectionStrategy>(kDirection, text, "direction strategy"); }
RouletteNumber roulette_number_of(std::string_view text) { return one_of<RouletteNumber>(kNumber, text, "roulette number"); }

void set_end(EstimatorSettings& settings, std::string_view text) {
    const std::size_t equals = std::min(text.find('='), text.size());
    settings.end = one_of<PathEnd>(kEnd, text.substr(0, equals), "path end");
    settings.end_value = 0.0;
    if (takes_value(settings.end) != (equals < text.size()))
        throw Error(
            fmt::format("path end '{}': {}", text,
                        takes_value(settings.end) ? "expected a value, as in depth=4, threshold=0.1, constant=0.5" : "it takes no value"));
    if (equals == text.size()) return;
    const std::string_view value = text.substr(equals + 1);
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), settings.end_value);
    if (error != std::errc{} || end != value.data() + value.size())
        throw Error(fmt::format("path end '{}': '{}' is not a number", text, value));
}

RenderPlan make_plan(const Scene& scene, const IntegratorSettings& integrator, const EstimatorSettings& s) {
    const auto refuse = [&](const char* expected) { throw Error(fmt::format("path end '{}': expected {}", text_of_end(s), expected)); };
    if (s.end == PathEnd::depth &&
        !(s.end_value >= 1.0 && s.end_value <= 1e6 && s.end_value == static_cast<double>(static_cast<int>(s.end_value))))
        refuse("a whole number of vertices, 1 or more");
    if (s.end == PathEnd::threshold && !(s.end_value > 0.0 && s.end_value < 1e30)) refuse("a threshold above 0");
    if (s.end == PathEnd::constant && !(s.end_value > 0.0 && s.end_value <= 1.0)) refuse("a survival in (0, 1]");
    if (s.branching < 1) throw Error("branching is 0; expected 1 or more");

    IntegratorSettings settings = integrator;
    if (s.end == PathEnd::depth && (settings.max_depth < 0 || settings.max_depth > static_cast<std::int32_t>(s.end_value)))
        settings.max_depth = static_cast<std::int32_t>(s.end_value);
    if (!plays_roulette(s.end)) settings.rr_depth = std::numeric_limits<std::int32_t>::max();
    if (settings.max_depth < 0 && s.end == PathEnd::none) throw Error("path end 'none' without a max_depth: paths would never end");
    if (settings.max_depth < 0 && s.branching > 1)
        throw Error(fmt::format("branching {} without a max_depth: the tree of rays would have no end", s.branching));
    RenderPlan plan = make_plan(scene, settings);
    if (!kLectureEffects.contains(plan.effects))
        throw Error("the scene calls for an effect that the lecture's estimators do not know; `koksma plan` lists its effects");
    if (s.light == Technique::bsdf && plan.effects.has(Effect::point_light))
        throw Error("technique 'bsdf' cannot meet a light without extent (point, spot, directional, projector)");
    return plan;
}

}  // namespace koksma
