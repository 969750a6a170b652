// Media, phase functions and volumes as files have them.

#include "scene_files.h"

#include <koksma_catch.h>

#include <cstring>
#include <limits>

using namespace koksma;
using namespace koksma::testing;

namespace {

void check_error(const std::string& error, const std::string& words) {
    INFO(error);
    CHECK(error.find(words) != std::string::npos);
}

/// A .vol file of version 3.
std::string vol(std::array<std::int32_t, 3> size, std::int32_t channels, const std::vector<float>& values, std::uint8_t version = 3,
                std::int32_t encoding = 1) {
    std::string out = "VOL";
    const auto put = [&](const auto& v) { out.append(reinterpret_cast<const char*>(&v), sizeof v); };
    put(version), put(encoding), put(size), put(channels), put(std::array<float, 6>{-1, -2, -3, 1, 0, 3});
    for (const float v : values) put(v);
    return out;
}
std::string medium(const std::string& type, const std::string& inside) {
    return "<medium type=\"" + type + "\" id=\"m\">" + inside + "</medium><shape type=\"sphere\"><ref name=\"interior\" id=\"m\"/></shape>";
}
std::string number(const std::string& name, const std::string& value) { return "<float name=\"" + name + "\" value=\"" + value + "\"/>"; }

}  // namespace

TEST_CASE("media have Mitsuba's defaults and take its parameters", "[unit][scene]") {
    const SceneFiles files;
    const auto load = [&](const std::string& type, const std::string& inside) { return files.load(medium(type, inside)).media.at(0); };
    const Medium plain = load("homogeneous", "");
    CHECK_FALSE(plain.heterogeneous);
    CHECK(std::get<ConstantVolume>(plain.sigma_t).value == Rgb(1.0f));
    CHECK(std::get<ConstantVolume>(plain.albedo).value == Rgb(0.75f));
    CHECK((plain.scale == 1.0 && plain.g == 0.0 && plain.sample_emitters));
    const Medium full = load("heterogeneous",
                             number("scale", "3") + R"(<rgb name="sigma_t" value=".1,2,3"/><rgb name="albedo" value=".5"/><phase type="hg"/>
        <boolean name="sample_emitters" value="false"/><boolean name="has_spectral_extinction" value="false"/>)");
    CHECK(full.heterogeneous);
    CHECK(std::get<ConstantVolume>(full.sigma_t).value == Rgb(0.1f, 2.0f, 3.0f));
    CHECK((full.scale == 3.0 && full.g == 0.8 && !full.sample_emitters));
    CHECK(load("homogeneous", "<phase type=\"isotropic\"/>").g == 0.0);
    CHECK(load("homogeneous", "<phase type=\"hg\">" + number("g", "-0.3") + "</phase>").g == -0.3);
}

TEST_CASE("shapes and sensors refer to media, once read for all", "[unit][scene]") {
    const SceneFiles files;
    const auto d = files.load_text(
        R"(<scene version="3.0.0"><integrator type="volpath"/><medium type="homogeneous" id="m"/><medium type="homogeneous" id="unused"/>
        <sensor type="perspective"><ref id="m"/><film type="hdrfilm"><rfilter type="box"/></film></sensor>
        <shape type="sphere"><ref name="interior" id="m"/><medium name="exterior" type="heterogeneous"/></shape><shape type="cube"/></scene>)");
    CHECK(d.media.size() == 2);
    CHECK(d.camera.medium == 0u);
    CHECK(d.shapes.at(0).interior == 0u);
    CHECK(d.shapes.at(0).exterior == 1u);
    CHECK_FALSE(d.shapes.at(1).interior.has_value());
    CHECK(d.integrator.volumetric);
}

TEST_CASE("grid volumes are read with their box, filter and wrapping", "[unit][scene]") {
    const SceneFiles files;
    files.write("a.vol", vol({2, 1, 3}, 1, {0, 1, 2, 3, 4, 5}));
    files.write("c.vol", vol({1, 1, 2}, 3, {0, 0.1f, 0.2f, 0.3f, 0.4f, 1.0f}));
    const Medium m =
        files
            .load(medium(
                "heterogeneous",
                R"(<volume name="sigma_t" type="gridvolume"><string name="filename" value="a.vol"/><string name="wrap_mode" value="mirror"/>
        <boolean name="use_grid_bbox" value="true"/><transform name="to_world"><translate x="5"/></transform></volume>
        <volume name="albedo" type="gridvolume"><string name="filename" value="c.vol"/><string name="filter_type" value="nearest"/></volume>)"))
            .media.at(0);
    const auto& sigma = std::get<GridVolume>(m.sigma_t);
    const auto& albedo = std::get<GridVolume>(m.albedo);
    CHECK(sigma.grid->size == std::array<std::int32_t, 3>{2, 1, 3});
    CHECK(sigma.grid->values == std::vector<float>{0, 1, 2, 3, 4, 5});
    CHECK((sigma.wrap == GridVolume::Wrap::mirror && sigma.filter == GridVolume::Filter::trilinear));
    CHECK(glm::dvec3(sigma.to_world * glm::dvec4(0, 0, 0, 1)) == glm::dvec3(4, -2, -3));
    CHECK(glm::dvec3(sigma.to_world * glm::dvec4(1, 1, 1, 1)) == glm::dvec3(6, 0, 3));
    CHECK((albedo.grid->channels == 3 && albedo.filter == GridVolume::Filter::nearest));
    CHECK(albedo.to_world == glm::dmat4(1.0));
}

TEST_CASE("a mistake in a volume file is reported with what is wrong", "[unit][scene]") {
    const SceneFiles files;
    const auto error = [&](const std::string& bytes) {
        files.write("a.vol", bytes);
        return files.error_of(
            medium("heterogeneous", R"(<volume name="sigma_t" type="gridvolume"><string name="filename" value="a.vol"/></volume>)"));
    };
    check_error(error("VOL"), "too short");
    check_error(error(vol({1, 1, 1}, 1, {1}, 2)), "version 2");
    check_error(error(vol({1, 1, 1}, 1, {1}, 3, 4)), "encoding 4");
    check_error(error(vol({1, 1, 1}, 6, {1, 1, 1, 1, 1, 1})), "6 channels");
    check_error(error(vol({1, 0, 1}, 1, {})), "1 x 0 x 1");
    check_error(error(vol({1, -1, 1}, 1, {1})), "1 x -1 x 1");
    check_error(error(vol({2, 1, 1}, 1, {1})), "do not fit");
    check_error(error(vol({1, 1, 1}, 1, {1, 2})), "do not fit");
    check_error(error(vol({2147483647, 2147483647, 2147483647}, 3, {1})), "do not fit");
    check_error(error(vol({1, 1, 1}, 1, {std::numeric_limits<float>::quiet_NaN()})), "must be finite");
    check_error(error(vol({1, 1, 1}, 1, {-1})), "must not be negative");
    std::string other = vol({1, 1, 1}, 1, {1});
    other[0] = 'W';
    check_error(error(other), "begin with VOL");
}

TEST_CASE("media that are not supported are refused by name", "[unit][scene]") {
    const SceneFiles files;
    files.write("a.vol", vol({1, 1, 1}, 1, {2}));
    const std::string grid = R"( type="gridvolume"><string name="filename" value="a.vol"/>)";
    const auto error = [&](const std::string& type, const std::string& inside) { return files.error_of(medium(type, inside)); };
    check_error(error("homogeneous", number("emission", "1")), "no parameter 'emission'");
    check_error(error("homogeneous", "<volume name=\"emission\"" + grid + "</volume>"), "'emission'");
    check_error(error("homogeneous", "<volume name=\"sigma_t\"" + grid + "</volume>"), "must be constant");
    check_error(error("homogeneous", number("sigma_s", "1")), "'sigma_s'");
    check_error(error("homogeneous", "<phase type=\"rayleigh\"/>"), "'rayleigh' is not supported; supported: isotropic, hg");
    check_error(error("homogeneous", "<phase type=\"hg\">" + number("g", "1") + "</phase>"), "'g' is 1");
    check_error(error("homogeneous", "<rgb name=\"albedo\" value=\"1.1\"/>"), "[0, 1]");
    check_error(error("heterogeneous", "<volume name=\"albedo\"" + grid + "</volume>"), "must be in [0, 1]");
    check_error(error("heterogeneous", "<volume name=\"sigma_t\"" + grid + number("max_value", "1.5") + "</volume>"), "'max_value' is 1.5");
    check_error(error("homogeneous", number("scale", "-1")), "'scale' is -1");
    check_error(error("homogeneous", "<texture name=\"albedo\" type=\"checkerboard\"/>"), "a colour or a volume");
    check_error(files.error_of("<medium type=\"fog\"/>"), "'fog' is not supported; supported: homogeneous, heterogeneous");
    check_error(files.error_of("<shape type=\"sphere\"><medium type=\"homogeneous\"/></shape>"), "takes no medium here");
    check_error(files.error_of("<shape type=\"sphere\"><bsdf name=\"interior\" type=\"diffuse\"/></shape>"), "must be a medium");
    check_error(files.error_of("<volume type=\"gridvolume\"/>"), "filename");
}

TEST_CASE("the hash follows media where the integrator knows them", "[unit][scene]") {
    const SceneFiles files;
    const auto hash = [&](const std::string& integrator, const std::string& inside) {
        return files.load("<integrator type=\"" + integrator + "\"/>" + medium("homogeneous", inside)).hash;
    };
    CHECK(hash("volpath", "") != hash("volpath", number("scale", "2")));
    CHECK(hash("volpath", "") == hash("volpathmis", ""));
    CHECK(hash("path", "") == hash("path", number("scale", "2")));
    CHECK(hash("path", "") != hash("volpath", ""));
}
