#include "commands.h"
#include "scene_setup.h"

#include <koksma/film/exr.h>
#include <koksma/integrators/replay.h>

#include <fmt/format.h>

#include <charconv>
#include <sstream>

namespace koksma {

namespace {

/// Settings of an image, where the command line does not give them.
SceneArguments with_settings_of(SceneArguments a, const ExrImage& image, const std::string& file) {
    const auto get = [&](const char* key) {
        const auto it = image.attributes.find(std::string("koksma:") + key);
        if (it == image.attributes.end()) throw Error(fmt::format("{} was not rendered by koksma: it has no attribute koksma:{}", file, key));
        return it->second;
    };
    if (a.scene.empty()) a.scene = get("scene");
    if (!a.sampler) a.sampler = get("sampler");
    const auto number = [&]<class T>(const char* key, std::optional<T>& value) {
        if (value) return;
        const std::string text = get(key);
        T parsed{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), parsed);
        if (error != std::errc{} || end != text.data() + text.size())
            throw Error(fmt::format("{}: its attribute koksma:{} is '{}', expected an integer; give the value on the command line", file, key, text));
        value = parsed;
    };
    if (const auto it = image.attributes.find("koksma:technique"); a.technique.empty() && it != image.attributes.end())
        a.technique = it->second;
    number("spp", a.spp);
    number("seed", a.seed);
    number("max_depth", a.max_depth);
    number("rr_depth", a.rr_depth);
    if (a.defines.empty()) {
        std::istringstream lines(get("defines"));
        for (std::string line; std::getline(lines, line);) a.defines.push_back(line);
    }
    return a;
}

}  // namespace

int run_replay(const ReplayCommand& command, const Registry& registry) {
    SceneArguments arguments = command.scene;
    std::string wanted_hash;
    if (!command.from.empty()) {
        const ExrImage image = read_exr(command.from);
        arguments = with_settings_of(arguments, image, command.from.string());
        const auto hash = image.attributes.find("koksma:scene_hash");
        if (hash == image.attributes.end()) throw Error(fmt::format("{} was not rendered by koksma: it has no attribute koksma:scene_hash", command.from.string()));
        wanted_hash = hash->second;
    }
    if (arguments.scene.empty()) throw UsageError("replay needs a scene, or --from an image that koksma rendered");
    const SceneSetup setup = set_up(arguments, registry);
    const std::string hash = fmt::format("{:016x}", setup.scene.description.hash);
    if (!wanted_hash.empty() && hash != wanted_hash)
        throw Error(fmt::format("{} was rendered from another scene: its hash is {}, that of {} is {}", command.from.string(), wanted_hash, arguments.scene.string(), hash));
    const Pixel pixel{command.pixel[0], command.pixel[1]};
    if (pixel.x < 0 || pixel.y < 0 || pixel.x >= setup.scene.film.width || pixel.y >= setup.scene.film.height)
        throw UsageError(fmt::format("--pixel {},{} is not on the film of {}x{} pixels", pixel.x, pixel.y, setup.scene.film.width, setup.scene.film.height));
    if (setup.sampler->info().kind == SamplerKind::set && command.sample >= setup.spp)
        throw UsageError(fmt::format("--sample {}: sampler {} has samples 0 to {}", command.sample, setup.sampler->name(), setup.spp - 1));
    const std::unique_ptr<SampleSource> source = setup.bind();
    fmt::print("scene {} sampler {} spp {}\n{}", setup.scene.description.file, setup.sampler->name(), setup.spp,
               replay(setup.scene, setup.plan, *source, {pixel, command.sample}));
    return 0;
}

}  // namespace koksma
