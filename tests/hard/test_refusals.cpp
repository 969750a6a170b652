// Numbers without meaning in a scene: refused at load, with the place.

#include <scene/scene_files.h>

#include <koksma/scene/scene.h>

#include <koksma_catch.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

std::string parameter(const std::string& type, const std::string& name, const std::string& value) {
    return "<" + type + " name=\"" + name + "\" value=\"" + value + "\"/>";
}

}  // namespace

TEST_CASE("D10: radiance, reflectance, roughness and indices that are no number or negative are refused with their place", "[hard]") {
    const SceneFiles files;
    const auto bsdf = [](const std::string& plugin) { return "<shape type=\"sphere\"><bsdf type=\"" + plugin + "\">"; };
    const std::pair<std::string, std::vector<std::string>> materials[] = {
        {"diffuse", {"rgb reflectance"}},
        {"plastic", {"rgb diffuse_reflectance", "rgb specular_reflectance", "float int_ior"}},
        {"roughplastic", {"rgb diffuse_reflectance", "float alpha", "float ext_ior"}},
        {"dielectric", {"rgb specular_transmittance", "float int_ior"}},
        {"thindielectric", {"rgb specular_reflectance"}},
        {"roughdielectric", {"rgb specular_reflectance", "float alpha", "float int_ior"}},
        {"conductor", {"rgb specular_reflectance", "rgb eta"}},
        {"roughconductor", {"float alpha", "rgb k"}},
        {"principled",
         {"rgb base_color", "float roughness", "float metallic", "float spec_trans", "float clearcoat", "float sheen", "float eta"}}};
    const std::pair<std::string, std::vector<std::string>> lights[] = {{"constant", {"rgb radiance"}},
                                                                       {"point", {"rgb intensity"}},
                                                                       {"spot", {"rgb intensity", "float cutoff_angle"}},
                                                                       {"directional", {"rgb irradiance"}},
                                                                       {"projector", {"rgb irradiance", "float scale"}}};
    for (const char* bad : {"nan", "inf", "-0.1", "1e39"}) {
        const auto check = [&](const std::string& before, const std::string& what, const std::string& after) {
            const auto space = what.find(' ');
            const std::string error = files.error_of(before + parameter(what.substr(0, space), what.substr(space + 1), bad) + after);
            INFO(before << " " << what << " = " << bad << ": " << error);
            CHECK(error.find("scene.xml:2:") != std::string::npos);
        };
        for (const auto& [plugin, parameters] : materials)
            for (const std::string& what : parameters) check(bsdf(plugin), what, "</bsdf></shape>");
        for (const auto& [plugin, parameters] : lights)
            for (const std::string& what : parameters) check("<emitter type=\"" + plugin + "\">", what, "</emitter>");
        check("<shape type=\"sphere\"><emitter type=\"area\">", "rgb radiance", "</emitter></shape>");
    }
}

TEST_CASE("D10: reflectances of vertices that are no number, negative or above 1 are refused with the vertex", "[hard]") {
    const SceneFiles files;
    for (const char* bad : {"nan", "inf", "-0.5", "1.5"}) {
        files.write(
            "mesh.ply",
            std::string("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float r\n"
                        "property float g\nproperty float b\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                        "0 0 0 0 0 0\n1 0 0 0 ") +
                bad + " 0\n0 1 0 0 0 0\n3 0 1 2\n");
        const SceneDescription d = files.load(
            "<shape type=\"ply\"><string name=\"filename\" value=\"mesh.ply\"/><bsdf type=\"diffuse\">"
            "<texture name=\"reflectance\" type=\"mesh_attribute\"><string name=\"name\" "
            "value=\"vertex_color\"/></texture></bsdf></shape>");
        std::string error = "none";
        try {
            (void)compile(d);
        } catch (const Error& e) {
            error = e.what();
        }
        INFO(bad << ": " << error);
        CHECK(error.find("scene.xml:2:") != std::string::npos);
        CHECK(error.find("vertex 1") != std::string::npos);
    }
}
