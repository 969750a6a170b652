// Plugins of scene files: transforms, materials, textures, emitters, shapes, sensors, films, samplers.

#include "scene_files.h"

#include <koksma_catch.h>

#include <glm/matrix.hpp>

#include <cmath>

using namespace koksma;
using namespace koksma::testing;

#define CHECK_ERROR(expression, ...)              \
    do {                                          \
        const std::string message = (expression); \
        INFO(message);                            \
        CHECK(has(message, {__VA_ARGS__}));       \
    } while (false)

namespace {

std::string cube(const std::string& steps) { return "<shape type=\"cube\"><transform name=\"to_world\">" + steps + "</transform></shape>"; }

/// The matrix by rows, to compare with what one writes on paper.
bool equals(const glm::dmat4& m, const std::array<double, 12>& rows, double tolerance = 0.0) {
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 4; ++c)
            if (!(std::abs(m[c][r] - rows[static_cast<std::size_t>(4 * r + c)]) <= tolerance)) return false;
    return m[0][3] == 0 && m[1][3] == 0 && m[2][3] == 0 && m[3][3] == 1;
}

glm::dmat4 matrix_of(const SceneFiles& files, const std::string& steps) { return files.load(cube(steps)).shapes.at(0).to_world; }

std::string sensor_scene(const std::string& sensor, const std::string& film = {}, const std::string& type = "perspective") {
    return "<scene version=\"3.0.0\">\n<sensor type=\"" + type + "\">" + sensor + "\n<film type=\"hdrfilm\">" + film +
           "<rfilter type=\"box\"/></film></sensor></scene>";
}
std::string number(const std::string& name, const std::string& value) { return "<float name=\"" + name + "\" value=\"" + value + "\"/>"; }
std::string integer(const std::string& name, const std::string& value) {
    return "<integer name=\"" + name + "\" value=\"" + value + "\"/>";
}
std::string text(const std::string& name, const std::string& value) { return "<string name=\"" + name + "\" value=\"" + value + "\"/>"; }
std::string rgb(const std::string& name, const std::string& value) { return "<rgb name=\"" + name + "\" value=\"" + value + "\"/>"; }

Material material_of(const SceneFiles& files, const std::string& bsdf) {
    const auto scene = files.load("<shape type=\"cube\">" + bsdf + "</shape>");
    return scene.materials.at(scene.shapes.at(0).material);
}
std::string bsdf(const std::string& type, const std::string& contents = {}) {
    return "<bsdf type=\"" + type + "\">" + contents + "</bsdf>";
}

}  // namespace

TEST_CASE("the steps of a transform are applied in the order of the file", "[unit][scene]") {
    const SceneFiles files;
    CHECK(equals(matrix_of(files, R"(<translate x="1"/><rotate z="1" angle="90"/>)"), {0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}));
    CHECK(equals(matrix_of(files, R"(<scale value="2"/><translate value="1, 2 3"/>)"), {2, 0, 0, 1, 0, 2, 0, 2, 0, 0, 2, 3}));
    CHECK(equals(matrix_of(files, R"(<scale x="2"/><scale value="1,3,4"/>)"), {2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0}));
    const double h = std::sqrt(3.0) / 2;
    CHECK(equals(matrix_of(files, R"(<rotate y="1" angle="30"/>)"), {h, 0, .5, 0, 0, 1, 0, 0, -.5, 0, h, 0}, 1e-15));
}

TEST_CASE("matrices are written by rows, with 16 or 9 numbers", "[unit][scene]") {
    const SceneFiles files;
    CHECK(equals(matrix_of(files, R"(<matrix value="1 2 0 4 0 1 7 8 9 0 1 12 0 0 0 1"/>)"), {1, 2, 0, 4, 0, 1, 7, 8, 9, 0, 1, 12}));
    CHECK(equals(matrix_of(files, R"(<matrix value="1 0 0 0 1 0 2 0 1"/>)"), {1, 0, 0, 0, 0, 1, 0, 0, 2, 0, 1, 0}));
    CHECK_ERROR(files.error_of(cube(R"(<matrix value="1 2 3"/>)")), "16 or 9 numbers, found 3");
    CHECK_ERROR(files.error_of(cube(R"(<matrix value="1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1"/>)")), "last row", "0 0 0 1");
}

TEST_CASE("lookat looks along +z with +x to the left", "[unit][scene]") {
    const SceneFiles files;
    CHECK(equals(matrix_of(files, R"(<lookat origin="1,2,3" target="1,2,4" up="0,1,0"/>)"), {1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3}));
    // the next three as Mitsuba 3.9.1 gives them
    CHECK(equals(matrix_of(files, R"(<lookat origin="0,0,0" target="0.3,0.5,1" up="0,2,0"/>)"),
                 {0.957826, -0.124115, 0.259161, 0, 0, 0.901905, 0.431934, 0, -0.287348, -0.413718, 0.863868, 0}, 1e-6));
    CHECK(equals(matrix_of(files, R"(<lookat origin="1,2,3" target="4,2,4"/>)"),
                 {0, 0.316228, 0.948683, 1, -1, 0, 0, 2, 0, -0.948683, 0.316228, 3}, 1e-6));
    CHECK(equals(matrix_of(files, R"(<lookat origin="1,2,3" target="1,5,3"/>)"), {0, 1, 0, 1, 0, 0, 1, 2, 1, 0, 0, 3}, 1e-15));
    CHECK_ERROR(files.error_of(cube(R"(<lookat origin="0,0,0" target="0,1,0" up="0,1,0"/>)")), "up vector");
    CHECK_ERROR(files.error_of(cube(R"(<lookat origin="0,0,0" target="0,0,0" up="0,1,0"/>)")), "target at its origin");
}

TEST_CASE("transforms that mean nothing are refused", "[unit][scene]") {
    const SceneFiles files;
    CHECK_ERROR(files.error_of(cube("\n<shear/>")), "scene.xml:3:1", "<shear>", "translate, scale, rotate, matrix, lookat");
    CHECK_ERROR(files.error_of(cube(R"(<rotate angle="3"/>)")), "axis", "zero");
    CHECK_ERROR(files.error_of(cube(R"(<rotate x="1" y="1" angle="3"/>)")), "length 1.41421", "x=\"0.707106781\"");
    CHECK_ERROR(files.error_of(cube(R"(<rotate x="1"/>)")), "'angle'");
    CHECK_ERROR(files.error_of(cube(R"(<translate value="1,2,3" x="2"/>)")), "both 'value' and 'x'");
    CHECK_ERROR(files.error_of(cube(R"(<translate x="1 2"/>)")), "must have 1 numbers");
    CHECK_ERROR(files.error_of(cube(R"(<scale x="0"/>)")), "cannot be inverted");
    CHECK_ERROR(files.error_of(cube(R"(<translate x="1e19"/>)")), "reaches beyond 1e+18");
}

TEST_CASE("materials have Mitsuba's defaults and take its parameters", "[unit][scene]") {
    const SceneFiles files;
    const auto glass = std::get<Dielectric>(material_of(files, bsdf("dielectric")).front);
    CHECK(glass.int_ior == 1.5046f);
    CHECK(glass.ext_ior == 1.000277f);
    const auto water =
        std::get<Dielectric>(material_of(files, bsdf("dielectric", text("int_ior", "water") + number("ext_ior", "1"))).front);
    CHECK(water.int_ior == 1.333f);
    CHECK(water.ext_ior == 1.0f);
    CHECK(std::get<Conductor>(material_of(files, bsdf("conductor")).front).perfect);
    const auto metal = std::get<Conductor>(material_of(files, bsdf("conductor", rgb("eta", "1, 2, 3"))).front);
    CHECK(!metal.perfect);
    CHECK(metal.eta == Rgb(1, 2, 3));
    CHECK(metal.k == Rgb(1.0f));
    const auto rough = std::get<RoughConductor>(material_of(files, bsdf("roughconductor")).front);
    CHECK(rough.distribution == RoughConductor::Distribution::beckmann);
    CHECK(std::get<Rgb>(rough.alpha_u) == Rgb(0.1f));
    const auto brushed = std::get<RoughConductor>(
        material_of(files, bsdf("roughconductor", text("distribution", "ggx") + number("alpha_u", ".2") + number("alpha_v", ".3"))).front);
    CHECK(brushed.distribution == RoughConductor::Distribution::ggx);
    CHECK(std::get<Rgb>(brushed.alpha_v) == Rgb(0.3f));
    const auto both = material_of(files, bsdf("twosided", bsdf("diffuse") + bsdf("conductor")));
    CHECK(both.two_sided);
    CHECK(std::holds_alternative<Conductor>(both.back.value()));
    CHECK(std::holds_alternative<Diffuse>(material_of(files, bsdf("twosided", bsdf("diffuse"))).back.value()));
    CHECK(!material_of(files, bsdf("diffuse")).two_sided);
}

TEST_CASE("layered materials have Mitsuba's defaults and take its parameters", "[unit][scene]") {
    const SceneFiles files;
    const auto of = [&](const std::string& type, const std::string& contents = {}) { return material_of(files, bsdf(type, contents)).front; };
    CHECK(std::get<ThinDielectric>(of("thindielectric")).int_ior == 1.5046f);
    const auto glass = std::get<RoughDielectric>(of("roughdielectric", text("distribution", "ggx") + number("alpha_u", ".2") + number("alpha_v", ".3")));
    CHECK(glass.distribution == Facets::ggx);
    CHECK(std::get<Rgb>(glass.alpha_v) == Rgb(0.3f));
    const auto plastic = std::get<Plastic>(of("plastic", rgb("diffuse_reflectance", ".1 .2 .3")));
    CHECK(plastic.int_ior == 1.49f);
    CHECK(!plastic.nonlinear);
    CHECK(std::get<Rgb>(plastic.diffuse_reflectance) == Rgb(0.1f, 0.2f, 0.3f));
    const auto rough = std::get<RoughPlastic>(of("roughplastic", R"(<boolean name="nonlinear" value="true"/>)"));
    CHECK((rough.nonlinear && rough.alpha == 0.1f && rough.distribution == Facets::beckmann));
    CHECK(std::get<Principled>(of("principled")).eta == Approx(1.5f));
    CHECK(std::get<Principled>(of("principled", number("eta", "1.7") + number("spec_trans", "1"))).eta == 1.7f);
    CHECK(std::get<Principled>(of("principled", number("specular", "0") + number("spec_trans", "1"))).eta > 1.01f);
    const auto blend = std::get<Blend>(of("blendbsdf", number("weight", ".25") + bsdf("twosided", bsdf("diffuse")) + bsdf("plastic")));
    CHECK(blend.nested.size() == 2);
    CHECK((blend.nested[0].two_sided && !blend.nested[1].two_sided));
    const auto mask = std::get<Mask>(of("mask", bsdf("blendbsdf", number("weight", ".25") + bsdf("diffuse") + bsdf("null"))));
    CHECK(std::get<Rgb>(mask.opacity) == Rgb(0.5f));
    CHECK(std::holds_alternative<Null>(std::get<Blend>(mask.nested.at(0).front).nested.at(1).front));
    const auto bump = std::get<BumpMap>(of("bumpmap", R"(<texture type="checkerboard" name="anything"/>)" + number("scale", "3") + bsdf("diffuse")));
    CHECK((bump.scale == 3.0f && bump.bending.flip_invalid_normals && bump.bending.use_shadowing_function));
    CHECK(std::holds_alternative<NormalMap>(of("twosided", bsdf("normalmap", rgb("normalmap", ".5 .5 1") + bsdf("diffuse")))));
    const auto gold = std::get<Conductor>(of("conductor", text("material", "Au")));
    CHECK((!gold.perfect && gold.eta.b > 1.4f && gold.k.r > 3.9f));
}

TEST_CASE("layered materials out of range are refused", "[unit][scene]") {
    const SceneFiles files;
    CHECK_ERROR(files.error_of(bsdf("plastik")), "did you mean 'plastic'?", "principled");
    CHECK_ERROR(files.error_of(bsdf("plastic", number("alpha", ".1"))), "no parameter 'alpha'", "nonlinear");
    CHECK_ERROR(files.error_of(bsdf("roughplastic", number("alpha", "-.1"))), "negative");
    CHECK_ERROR(files.error_of(bsdf("principled", number("eta", "1.5") + number("specular", ".5"))), "'eta' or 'specular'");
    CHECK_ERROR(files.error_of(bsdf("principled", number("metallic", "1.5"))), "[0, 1]");
    CHECK_ERROR(files.error_of(bsdf("principled", number("diffuse_reflectance_sampling_rate", "0"))), "must be positive");
    CHECK_ERROR(files.error_of(bsdf("blendbsdf", bsdf("diffuse") + bsdf("diffuse"))), "'weight'");
    CHECK_ERROR(files.error_of(bsdf("blendbsdf", number("weight", "1") + bsdf("diffuse"))), "takes 2 bsdfs; found 1");
    CHECK_ERROR(files.error_of(bsdf("mask", number("opacity", "1"))), "takes 1 bsdf; found 0");
    CHECK_ERROR(files.error_of(bsdf("null", number("opacity", "1"))), "no parameter 'opacity'");
    CHECK_ERROR(files.error_of(bsdf("normalmap", bsdf("diffuse"))), "'normalmap' needs a <texture");
    CHECK_ERROR(files.error_of(bsdf("bumpmap", bsdf("diffuse"))), "needs a <texture>");
    for (const std::string& inside : {bsdf("thindielectric"), bsdf("roughdielectric"), bsdf("null"), bsdf("mask", bsdf("diffuse")), bsdf("principled", number("spec_trans", ".1"))})
        CHECK_ERROR(files.error_of(bsdf("twosided", inside)), "lets light through");
    CHECK_ERROR(files.error_of(R"(<shape type="cube"><bsdf type="mask" id="a"><ref id="a"/></bsdf></shape>)"), "nested more than 8 deep");
}

TEST_CASE("materials out of range are refused", "[unit][scene]") {
    const SceneFiles files;
    CHECK_ERROR(files.error_of(bsdf("diffuse", "\n" + rgb("reflectance", "1.5"))), "scene.xml:3:1", "'reflectance'", "[0, 1]");
    CHECK_ERROR(files.error_of(bsdf("diffuse", rgb("reflectance", "-.5, 0, 0"))), "negative");
    CHECK_ERROR(files.error_of(bsdf("diffuse", rgb("reflectance", "nan"))), "finite");
    CHECK_ERROR(files.error_of(bsdf("diffuse", rgb("reflectance", "1, 2"))), "not a colour");
    CHECK_ERROR(files.error_of(bsdf("diffuse", rgb("reflectance", "#ff8000"))), "hexadecimal");
    CHECK_ERROR(files.error_of(bsdf("diffuse", R"(<spectrum name="reflectance" value="400:1"/>)")), "at least two points");
    CHECK_ERROR(files.error_of(bsdf("diffuse", R"(<spectrum name="reflectance" value="400:1, 300:.5"/>)")), "must increase");
    CHECK_ERROR(files.error_of(bsdf("diffuse", R"(<spectrum name="reflectance" value="400:1, 700:2"/>)")), "[0, 1]");
    CHECK_ERROR(files.error_of(bsdf("diffuse", R"(<spectrum name="reflectance" value="400:1, 700"/>)")), "wavelength:value");
    CHECK_ERROR(files.error_of(bsdf("diffuse", R"(<spectrum name="reflectance" filename="a.spd"/>)")), "no file 'a.spd'");
    CHECK_ERROR(files.error_of(bsdf("diffuse", R"(<texture name="reflectance" type="mesh_attribute"/>)")), "<string name=\"name\"");
    CHECK_ERROR(files.error_of(bsdf("diffuse", R"(<texture name="reflectance" type="mesh_attribute"><string name="name" value="colour"/></texture>)")), "vertex_ or face_");
    CHECK_ERROR(files.error_of(bsdf("dielectric", text("int_ior", "diamant"))), "did you mean 'diamond'?", "bk7");
    CHECK_ERROR(files.error_of(bsdf("dielectric", number("int_ior", "-1"))), "positive");
    CHECK_ERROR(files.error_of(bsdf("conductor", text("material", "Aq"))), "'Aq'", "did you mean", "Au", "eta", "none");
    CHECK_ERROR(files.error_of(bsdf("conductor", text("material", "Au") + rgb("k", "1, 1, 1"))), "'material', or 'eta' and 'k'");
    CHECK_ERROR(files.error_of(bsdf("conductor", rgb("eta", "-1,0,0"))), "negative");
    CHECK_ERROR(files.error_of(bsdf("conductor", R"(<texture name="eta" type="checkerboard"/>)")), "one colour");
    CHECK_ERROR(files.error_of(bsdf("roughconductor", number("alpha_u", ".2"))), "alpha_v");
    CHECK_ERROR(files.error_of(bsdf("roughconductor", number("alpha", "-.2"))), "negative");
    CHECK_ERROR(files.error_of(bsdf("roughconductor", "<boolean name=\"sample_visible\" value=\"false\"/>")), "must be true");
    CHECK_ERROR(files.error_of(bsdf("roughconductor", text("distribution", "phong"))), "'phong'", "beckmann, ggx");
    CHECK_ERROR(files.error_of(bsdf("twosided")), "one bsdf, or two");
    CHECK_ERROR(files.error_of(bsdf("twosided", bsdf("dielectric"))), "dielectric");
    CHECK_ERROR(files.error_of(bsdf("twosided", bsdf("twosided", bsdf("diffuse")))), "inside 'twosided'");
}

TEST_CASE("a flat spectrum is a grey reflectance but, as light, the equal-energy white", "[unit][scene]") {
    const SceneFiles files;
    const auto grey = std::get<Diffuse>(material_of(files, bsdf("diffuse", R"(<spectrum name="reflectance" value="0.25"/>)")).front);
    CHECK(std::get<Rgb>(grey.reflectance) == Rgb(0.25f));
    const auto scene = files.load(
        R"(<emitter type="point"><spectrum name="intensity" value="10"/></emitter><emitter type="point"><float name="intensity" value="2"/></emitter>)");
    const Rgb light = scene.point_lights.at(0).intensity;  // Mitsuba 3.9.1, rgb: 12.0479, 9.48291, 9.08916
    CHECK(std::abs(light.r - 12.0479f) < 1e-4f);
    CHECK(std::abs(light.g - 9.48291f) < 1e-4f);
    CHECK(std::abs(light.b - 9.08916f) < 1e-4f);
    CHECK(scene.point_lights.at(1).intensity == Rgb(2.0f));
}

TEST_CASE("spectra by wavelength become the colours that Mitsuba gives them", "[unit][scene]") {
    const SceneFiles files;
    files.write("s.spd", "# nm value\n400 0.1\n500 0.2  # blue\n\n600 0.78\n700 0.78\n");
    const auto check = [](Rgb got, Rgb wanted) {
        INFO(got.r << ' ' << got.g << ' ' << got.b);
        for (int i = 0; i < 3; ++i) CHECK(std::abs(got[i] - wanted[i]) <= 1e-5f * wanted[i] + 1e-6f);
    };
    const auto reflectance = [&](const std::string& table) {
        return std::get<Rgb>(std::get<Diffuse>(material_of(files, bsdf("diffuse", "<spectrum name=\"reflectance\" " + table + "/>")).front).reflectance);
    };
    // Mitsuba 3.9.1, rgb, as mi.traverse shows them
    check(reflectance("value=\"400:0.78, 500:0.78, 600:0.78, 700:0.78\""), {0.7763668f, 0.77981f, 0.7760291f});
    check(reflectance("value=\"400:0.1, 500:0.2, 600:0.78, 700:0.78\""), {0.91300154f, 0.43979964f, 0.10732156f});
    check(reflectance("filename=\"s.spd\""), {0.91300154f, 0.43979964f, 0.10732156f});
    check(reflectance("value=\"550:1, 551:1\""), {0.0f, 0.01333565f, 0.0f});
    const auto lamp = files.load(R"(<emitter type="point"><spectrum name="intensity" value="400:0, 500:8, 600:15.6, 700:18.4"/></emitter>)");
    check(lamp.point_lights.at(0).intensity, {20.710836f, 10.854634f, 2.771152f});
    const auto metal = std::get<Conductor>(material_of(files, bsdf("conductor", R"(<spectrum name="eta" value="400:0, 500:8, 600:15.6, 700:18.4"/>)")).front);
    check(metal.eta, {17.714712f, 11.354429f, 3.3045077f});
}

TEST_CASE("spots, directional lights and projectors take Mitsuba's parameters", "[unit][scene]") {
    const SceneFiles files;
    const auto scene = files.load(R"(<emitter type="spot"/>
        <emitter type="spot"><float name="cutoff_angle" value="30"/><float name="beam_width" value="5"/><rgb name="intensity" value="1, 2, 3"/>
            <texture name="texture" type="checkerboard"/></emitter>
        <emitter type="directional"><vector name="direction" value="0, 0, -2"/><rgb name="irradiance" value="4"/></emitter>
        <emitter type="directional"><transform name="to_world"><rotate y="1" angle="90"/></transform></emitter>
        <emitter type="projector"><float name="fov" value="40"/><float name="scale" value="2"/></emitter>)");
    REQUIRE(scene.delta_lights.size() == 5);
    const auto& plain = std::get<SpotLight>(scene.delta_lights[0]);
    CHECK(plain.cutoff_degrees == 20.0);
    CHECK(plain.beam_degrees == 15.0);
    CHECK(!plain.texture);
    const auto& slide = std::get<SpotLight>(scene.delta_lights[1]);
    CHECK(slide.beam_degrees == 5.0);
    CHECK(slide.intensity == Rgb(1, 2, 3));
    CHECK(std::holds_alternative<CheckerboardTexture>(slide.texture.value()));
    CHECK(std::get<DirectionalLight>(scene.delta_lights[2]).direction == glm::dvec3(0, 0, -2));
    CHECK(std::abs(std::get<DirectionalLight>(scene.delta_lights[3]).direction.x - 1.0) < 1e-12);
    CHECK(std::get<ProjectorLight>(scene.delta_lights[4]).fov_x_degrees == 40.0);
    const auto error = [&](const std::string& type, const std::string& contents) { return files.error_of("<emitter type=\"" + type + "\">" + contents + "</emitter>"); };
    CHECK_ERROR(error("spot", number("cutoff_angle", "0")), "scene.xml:2:22", "'cutoff_angle'", "(0, 180]");
    CHECK_ERROR(error("spot", number("beam_width", "30")), "'beam_width'", "[0, cutoff_angle = 20]");
    CHECK_ERROR(error("spot", rgb("texture", "1")), "must vary");
    CHECK_ERROR(error("spot", number("fov", "1")), "'fov'", "cutoff_angle", "texture");
    CHECK_ERROR(error("directional", "<vector name=\"direction\" value=\"0,0,0\"/>"), "no length");
    CHECK_ERROR(error("directional", "<vector name=\"direction\" value=\"0,0,1\"/><transform name=\"to_world\"/>"), "not both");
    CHECK_ERROR(error("projector", number("scale", "-1")), "negative");
    CHECK_ERROR(error("projector", "<transform name=\"to_world\"><scale value=\"2\"/></transform>"), "must not scale");
    CHECK_ERROR(error("projector", R"(<texture name="irradiance" type="mesh_attribute"><string name="name" value="vertex_color"/></texture>)"), "not supported as light");
}

TEST_CASE("integrators are path, direct, volpath, and moment around one of them", "[unit][scene]") {
    const SceneFiles files;
    const auto load = [&](const std::string& text) { return files.load("<integrator type=" + text + "</integrator>").integrator; };
    CHECK(load("\"direct\">").max_depth == 2);
    CHECK(load("\"volpath\">" + integer("max_depth", "7")).max_depth == 7);
    CHECK(load("\"path\">").moments.empty());
    const auto moment = load("\"moment\"><integrator type=\"direct\" name=\"img\"><boolean name=\"hide_emitters\" value=\"true\"/></integrator>");
    CHECK(moment.moments == "img");
    CHECK(moment.max_depth == 2);
    CHECK(moment.hide_emitters);
    CHECK(load("\"moment\"><integrator type=\"path\"/>").moments == "_arg_0");
    const auto error = [&](const std::string& text) { return files.error_of("<integrator type=" + text + "</integrator>"); };
    CHECK(load("\"direct\">").technique == Technique::mis);
    CHECK(load("\"direct\">" + integer("bsdf_samples", "0")).technique == Technique::light);
    CHECK(load("\"direct\">" + integer("emitter_samples", "0")).technique == Technique::bsdf);
    CHECK_ERROR(error("\"direct\">" + integer("bsdf_samples", "0") + integer("emitter_samples", "0")), "both 0");
    CHECK_ERROR(error("\"direct\">" + integer("bsdf_samples", "2")), "'bsdf_samples' is 2", "more samples per pixel");
    CHECK_ERROR(error("\"direct\">" + integer("shading_samples", "0")), "'shading_samples' is 0", "only 1");
    CHECK_ERROR(error("\"direct\">" + integer("max_depth", "3")), "'max_depth'", "shading_samples");
    CHECK_ERROR(error("\"moment\">"), "takes one integrator");
    CHECK_ERROR(error("\"ptracer\">"), "'ptracer'", "path, direct, volpath, volpathmis, moment");
    CHECK_FALSE(load("\"path\">").volumetric);
    CHECK_FALSE(load("\"direct\">").volumetric);
    CHECK(load("\"volpathmis\">").volumetric);
    CHECK(load("\"moment\"><integrator type=\"volpath\"/>").volumetric);
}

TEST_CASE("folders of <path> are searched first", "[unit][scene]") {
    const SceneFiles files;
    files.write("common/part.xml", "<scene version=\"2.1.0\"><shape type=\"cube\"/></scene>");
    CHECK(files.load("<path value=\"common\"/><include filename=\"part.xml\"/>").shapes.size() == 1);
    CHECK_ERROR(files.error_of("<path value=\"nowhere\"/>"), "scene.xml:2:1", "nowhere");
    CHECK_ERROR(files.error_of("<include filename=\"part.xml\"/>"), "part.xml");
}

TEST_CASE("emitters of every kind load", "[unit][scene]") {
    const SceneFiles files;
    const auto scene = files.load(R"(
        <shape type="rectangle"><emitter type="area"><rgb name="radiance" value="3, 2, 1"/></emitter></shape>
        <shape type="cube"><ref id="lamp"/><bsdf type="diffuse"/></shape><emitter type="area" id="lamp"/>
        <emitter type="point"><point name="position" x="1" y="2" z="3"/></emitter>
        <emitter type="point"><transform name="to_world"><translate value="4, 5, 6"/></transform></emitter>
        <emitter type="constant"><rgb name="radiance" value="0.5"/></emitter>)");
    CHECK(std::get<Rgb>(scene.shapes[0].emission.value().radiance) == Rgb(3, 2, 1));
    CHECK(std::get<Rgb>(scene.shapes[1].emission.value().radiance) == Rgb(1.0f));
    const auto& black = std::get<Diffuse>(scene.materials.at(scene.shapes[0].material).front);
    CHECK(std::get<Rgb>(black.reflectance) == Rgb(0.0f));  // Mitsuba: a light without a BSDF reflects nothing
    CHECK(scene.shapes[1].material != scene.shapes[0].material);
    CHECK(scene.point_lights[0].position == glm::dvec3(1, 2, 3));
    CHECK(scene.point_lights[1].position == glm::dvec3(4, 5, 6));
    CHECK(std::get<ConstantEnvironment>(scene.environment.value()).radiance == Rgb(0.5f));
}

TEST_CASE("emitters out of range or out of place are refused", "[unit][scene]") {
    const SceneFiles files;
    CHECK_ERROR(files.error_of(R"(<emitter type="constant"><rgb name="radiance" value="-1"/></emitter>)"), "scene.xml:2:26", "'radiance'",
                "negative");
    CHECK_ERROR(files.error_of(R"(<emitter type="point"><rgb name="intensity" value="inf"/></emitter>)"), "finite");
    CHECK_ERROR(files.error_of(R"(<emitter type="point"><point name="position" x="1"/></emitter>)"), "needs the attribute 'y'");
    CHECK_ERROR(files.error_of(R"(<emitter type="point"><point name="position" value="1 2 3"/><transform name="to_world"/></emitter>)"),
                "not both");
    CHECK_ERROR(files.error_of("<emitter type=\"constant\"/>\n<emitter type=\"constant\"/>"), "scene.xml:3:1", "one environment",
                "scene.xml:2:1");
    CHECK_ERROR(files.error_of(R"(<shape type="cube"><emitter type="point"/></shape>)"), "cannot be inside a shape");
    CHECK_ERROR(
        files.error_of(R"(<emitter type="area" id="e"/><shape type="cube"><ref id="e"/></shape><shape type="cube"><ref id="e"/></shape>)"),
        "two shapes");
    CHECK_ERROR(files.error_of(R"(<emitter type="sunsky"/>)"), "'sunsky'", "area, point, spot, directional, projector, constant, envmap");
}

TEST_CASE("analytic shapes keep their transform and flags", "[unit][scene]") {
    const SceneFiles files;
    const auto scene = files.load(R"(<shape type="sphere"><point name="center" x="1" y="2" z="3"/><float name="radius" value="2"/>
            <transform name="to_world"><scale value="3"/></transform><boolean name="flip_normals" value="true"/></shape>
        <shape type="rectangle"><boolean name="face_normals" value="true"/></shape>)");
    const auto& sphere = std::get<SphereShape>(scene.shapes[0].geometry);
    CHECK(sphere.center == glm::dvec3(1, 2, 3));
    CHECK(sphere.radius == 2.0);
    CHECK(scene.shapes[0].to_world[0][0] == 3.0);
    CHECK(scene.shapes[0].flip_normals);
    CHECK(scene.shapes[1].face_normals);
    CHECK_ERROR(files.error_of(R"(<shape type="sphere"><transform name="to_world"><scale x="2"/></transform></shape>)"),
                "scale all axes alike");
    CHECK_ERROR(files.error_of(R"(<shape type="disk"><boolean name="face_normals" value="true"/></shape>)"), "'face_normals'",
                "flip_normals");
    const auto tube = std::get<CylinderShape>(files.load(R"(<shape type="cylinder"><point name="p1" x="1" y="2" z="3"/><float name="radius" value=".5"/></shape>)").shapes[0].geometry);
    CHECK(tube.p0 == glm::dvec3(0.0));
    CHECK(tube.p1 == glm::dvec3(1, 2, 3));
    CHECK(tube.radius == 0.5);
    CHECK_ERROR(files.error_of(R"(<shape type="cylinder"><point name="p1" x="0" y="0" z="0"/></shape>)"), "needs a length");
    CHECK_ERROR(files.error_of(R"(<shape type="cylinder"><transform name="to_world"><scale z="2"/></transform></shape>)"), "scale all axes alike");
}

TEST_CASE("the field of view is horizontal whatever axis it was given for", "[unit][scene]") {
    const SceneFiles files;
    const auto fov = [&](const std::string& s, const std::string& f) { return files.load_text(sensor_scene(s, f)).camera.fov_x_degrees; };
    const std::string wide = integer("width", "200") + integer("height", "100"), tall = integer("width", "100") + integer("height", "200");
    const std::string crop =
        integer("crop_offset_x", "10") + integer("crop_width", "40") + integer("crop_offset_y", "20") + integer("crop_height", "30");
    struct Row {
        std::string axis;
        double wide, tall;
    };
    // Mitsuba 3.9.1, fov 40, x_fov as mi.traverse shows it
    for (const Row& r :
         {Row{"x", 40, 40}, Row{"y", 72.10477447509766, 20.628210067749023}, Row{"diagonal", 36.064788818359375, 18.49018669128418},
          Row{"smaller", 72.10477447509766, 40}, Row{"larger", 40, 20.628210067749023}}) {
        const std::string s = number("fov", "40") + text("fov_axis", r.axis);
        CHECK(std::abs(fov(s, wide) - r.wide) < 1e-5);
        CHECK(std::abs(fov(s, wide + crop) - r.wide) < 1e-5);
        CHECK(std::abs(fov(s, tall) - r.tall) < 1e-5);
    }
    CHECK(std::abs(fov("", wide) - 42.31171417236328) < 1e-5);  // 50 mm
    CHECK(fov(text("focal_length", "50mm"), wide) == fov(text("focal_length", "50"), wide));
}

TEST_CASE("sensors take their parameters and refuse the impossible", "[unit][scene]") {
    const SceneFiles files;
    const auto error = [&](const std::string& s, const std::string& type = "perspective") {
        return files.error_of_text(sensor_scene(s, {}, type));
    };
    const auto lens =
        files.load_text(sensor_scene(number("fov", "30") + number("aperture_radius", ".1") + number("far_clip", "28"), {}, "thinlens"))
            .camera;
    CHECK(lens.aperture_radius == 0.1);
    CHECK(lens.focus_distance == 28.0);  // Mitsuba: far_clip
    const auto shifted =
        files.load_text(sensor_scene(number("principal_point_offset_x", ".1") + number("principal_point_offset_y", ".2"))).camera;
    CHECK(shifted.principal_point_offset == glm::dvec2(0.1, 0.2));
    CHECK(error(number("shutter_open", ".1") + number("shutter_close", ".1")) == "no error");
    CHECK(error(number("shutter_close", ".1")) == "no error");
    CHECK_ERROR(error(number("shutter_close", "-.1")), "shutter", "before it opens");
    CHECK_ERROR(error("", "thinlens"), "scene.xml:2:1", "aperture_radius");
    CHECK_ERROR(error(number("aperture_radius", ".1") + number("principal_point_offset_x", ".1"), "thinlens"), "principal_point_offset_x");
    CHECK_ERROR(error(number("fov", "180")), "(0, 180)");
    CHECK_ERROR(error(number("fov", "20") + text("fov_axis", "z")), "x, y, diagonal, smaller, larger");
    CHECK_ERROR(error(number("fov", "20") + text("focal_length", "20mm")), "not both");
    CHECK_ERROR(error(text("focal_length", "20cm")), "50mm");
    CHECK_ERROR(error(text("fov_axis", "x")), "fov_axis");
    CHECK_ERROR(error(number("near_clip", "0")), "positive");
    CHECK_ERROR(error(number("near_clip", "3") + number("far_clip", "2")), "beyond near_clip");
    CHECK_ERROR(error("<transform name=\"to_world\"><scale value=\"2\"/></transform>"), "must not scale");
    CHECK(error("<transform name=\"to_world\"><scale x=\"-1\"/></transform>") == "no error");
    const auto parallel = files.load_text(sensor_scene("<transform name=\"to_world\"><scale x=\"3\" y=\"2\"/></transform>", {}, "orthographic")).camera;
    CHECK(parallel.orthographic);
    CHECK(parallel.to_world[0][0] == 3.0);
    CHECK_ERROR(error(number("fov", "30"), "orthographic"), "'fov'", "near_clip");
    CHECK_ERROR(error("", "fisheye"), "'fisheye'", "perspective, thinlens, orthographic");
}

TEST_CASE("films have a size, a crop inside it, and a filter", "[unit][scene]") {
    const SceneFiles files;
    const auto error = [&](const std::string& f) { return files.error_of_text(sensor_scene("", f)); };
    const auto film = files
                          .load_text(sensor_scene("", integer("width", "20") + integer("height", "10") + integer("crop_offset_x", "15") +
                                                          integer("crop_width", "5")))
                          .film;
    CHECK(film.crop_x == 15);
    CHECK(film.crop_width == 5);
    CHECK(film.crop_height == 10);
    CHECK_ERROR(error(integer("width", "0")), "scene.xml:3:22", "'width' is 0");
    CHECK_ERROR(error(integer("crop_offset_x", "100")), "reaches out of the film", "768 x 576");
    CHECK_ERROR(error(integer("crop_width", "0")), "'crop_width' is 0");
    CHECK_ERROR(error(text("pixel_format", "luminance")), "rgb, rgba");
    CHECK(files.load_text(sensor_scene("", "<boolean name=\"sample_border\" value=\"true\"/>")).film.filter.beyond_film);
    CHECK(film.filter.is_pixel());
    CHECK(error(text("pixel_format", "rgba") + text("component_format", "float32") + text("file_format", "openexr")) == "no error");
    CHECK_ERROR(files.error_of_text("<scene version=\"3.0.0\"><sensor type=\"perspective\"/></scene>"), "needs a <film");
    const auto filter = [](const std::string& contents) {
        return "<scene version=\"3.0.0\"><sensor type=\"perspective\"><film type=\"hdrfilm\">" + contents + "</film></sensor></scene>";
    };
    const auto none = files.load_text(filter("")).film.filter;  // Mitsuba's default
    CHECK(none.kind == ReconstructionFilter::Kind::gaussian);
    CHECK(none.stddev == 0.5);
    const auto tent = files.load_text(filter("<rfilter type=\"tent\"/>")).film.filter;
    CHECK(tent.kind == ReconstructionFilter::Kind::tent);
    CHECK(tent.radius == 1.0);
    CHECK_ERROR(files.error_of_text(filter("<rfilter type=\"mitchell\"/>")), "'mitchell'", "supported: box, tent, gaussian");
    CHECK_ERROR(files.error_of_text(filter("<rfilter type=\"tent\">" + number("radius", "0") + "</rfilter>")), "'radius' is 0");
    CHECK_ERROR(files.error_of_text(filter("<rfilter type=\"tent\">" + number("stddev", "1") + "</rfilter>")), "'stddev'");
}

TEST_CASE("samplers become names of ours, with options", "[unit][scene]") {
    const SceneFiles files;
    const auto load = [&](const std::string& type, const std::string& contents = {}) {
        return files.load_text(sensor_scene("<sampler type=\"" + type + "\">" + contents + "</sampler>"));
    };
    CHECK(load("independent").sampler == "random");
    CHECK(load("stratified").sampler == "stratified");
    CHECK(load("multijitter", integer("sample_count", "64") + "<boolean name=\"jitter\" value=\"false\"/>").sampler.empty());
    CHECK(load("ldsampler", integer("sample_count", "64")).spp == 64);
    CHECK(load("sobol", text("randomize", "owen") + text("pixels", "shared") + integer("seed", "3")).sampler ==
          "sobol:randomize=owen,pixels=shared");
    CHECK(load("sobol", integer("seed", "3")).seed == 3);
    const auto error = [&](const std::string& contents, const std::string& type) {
        return files.error_of_text(sensor_scene("<sampler type=\"" + type + "\">" + contents + "</sampler>"));
    };
    CHECK_ERROR(error(integer("sample_count", "0"), "independent"), "'sample_count' is 0");
    CHECK_ERROR(error(integer("seed", "-1"), "independent"), "'seed' is -1");
    CHECK_ERROR(error("<boolean name=\"jitter\" value=\"false\"/>", "stratified"), "must be true");
}

TEST_CASE("the hash covers what can change the expected image and nothing else", "[unit][scene]") {
    const SceneFiles files;
    const std::string shape = R"(<bsdf type="diffuse" id="a"/><shape type="sphere"><ref id="a"/></shape>)";
    const auto hash = [&](const std::string& contents, const std::string& sensor = {}, const std::string& film = {}) {
        return files.load_text("<scene version=\"3.0.0\">" + contents + sensor_scene(sensor, film).substr(23)).hash;
    };
    const auto base = hash(shape);
    CHECK(hash(shape) == base);
    CHECK(hash(R"(<!-- purpose: x --><shape type="sphere" id="s"><bsdf type="diffuse"/></shape>)") == base);
    CHECK(hash(shape, "<sampler type=\"sobol\">" + integer("sample_count", "99") + integer("seed", "1") + "</sampler>") == base);
    CHECK(hash(shape, {}, integer("crop_width", "10")) == base);
    CHECK(hash("<integrator type=\"path\">" + integer("rr_depth", "9") + "</integrator>" + shape) == base);
    CHECK(hash(shape, {}, integer("width", "10")) != base);
    CHECK(hash("<integrator type=\"path\">" + integer("max_depth", "9") + "</integrator>" + shape) != base);
    CHECK(hash(shape, number("fov", "33")) != base);
    CHECK(hash(shape + "<emitter type=\"constant\"/>") != base);
    CHECK(hash(R"(<shape type="sphere"><bsdf type="diffuse"><float name="reflectance" value=".4"/></bsdf></shape>)") != base);
    CHECK(hash(R"(<shape type="sphere"><boolean name="flip_normals" value="true"/></shape>)") != base);
    CHECK(hash(shape + "<emitter type=\"spot\"/>") != base);
    CHECK(hash(shape + "<emitter type=\"spot\"/>") != hash(shape + "<emitter type=\"spot\">" + number("beam_width", "1") + "</emitter>"));
    CHECK(hash(shape + "<emitter type=\"directional\"/>") != hash(shape + "<emitter type=\"projector\"/>"));
}
