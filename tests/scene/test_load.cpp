// The frame of scene files: XML, parameters, includes, ids, comments.

#include "scene_files.h"

#include <koksma_catch.h>

#include <cstdlib>

using namespace koksma;
using namespace koksma::testing;

#define CHECK_ERROR(expression, ...)              \
    do {                                          \
        const std::string message = (expression); \
        INFO(message);                            \
        CHECK(has(message, {__VA_ARGS__}));       \
    } while (false)

TEST_CASE("a scene with only a sensor has Mitsuba's defaults", "[unit][scene]") {
    const SceneFiles files;
    const auto scene = files.load("");
    CHECK(scene.film.width == 768);
    CHECK(scene.film.height == 576);
    CHECK(scene.film.crop_width == 0);
    CHECK(scene.integrator.max_depth == -1);
    CHECK(scene.integrator.rr_depth == 5);
    CHECK(!scene.integrator.hide_emitters);
    CHECK(scene.camera.near_clip == 1e-2);
    CHECK(scene.camera.far_clip == 1e4);
    CHECK(scene.spp == 4);
    CHECK(scene.sampler.empty());
    CHECK(scene.materials.size() == 1);
    CHECK(std::get<Rgb>(std::get<Diffuse>(scene.materials[0].front).reflectance) == Rgb(0.5f));
}

TEST_CASE("malformed XML is reported with its line and column", "[unit][scene]") {
    const SceneFiles files;
    CHECK_ERROR(files.error_of_text("<scene version=\"3.0.0\">\n  <shape type=\"cube>\n</scene>"), "scene.xml:", "not well-formed");
    CHECK_ERROR(files.error_of_text("<scene version=\"3.0.0\">\n  </shape>\n</scene>"), "scene.xml:2:", "not well-formed");
    CHECK_ERROR(files.error_of_text(""), "scene.xml:1:1", "not well-formed");
    CHECK_ERROR(files.error_of_text("<mitsuba/>"), "scene.xml:1:1", "<scene>", "<mitsuba>");
    CHECK_ERROR(files.error_of_text("<scene/>"), "scene.xml:1:1", "version");
    CHECK_ERROR(files.error_of_text("<scene version=\"1.0.0\"/>"), "scene.xml:1:1", "1.0.0", "3.x.y");
    CHECK_ERROR(files.error_of("words"), "text 'words'");
}

TEST_CASE("a file that is not there is named", "[unit][scene]") {
    CHECK_ERROR(error_from([] { (void)load_scene("no/such/scene.xml"); }), "no/such/scene.xml", "cannot be opened");
    const SceneFiles files;
    CHECK_ERROR(files.error_of(R"(<shape type="ply"><string name="filename" value="gone.ply"/></shape>)"), "scene.xml:2:19", "gone.ply",
                "tried");
}

TEST_CASE("unknown elements, types, parameters and attributes are refused with the supported names", "[unit][scene]") {
    const SceneFiles files;
    CHECK_ERROR(files.error_of("  <fog type=\"homogeneous\"/>"), "scene.xml:2:3", "<fog>", "supported:", "shape", "emitter");
    CHECK_ERROR(files.error_of("<shape type=\"spere\"/>"), "scene.xml:2:1", "'spere'", "did you mean 'sphere'?", "rectangle, disk");
    CHECK_ERROR(files.error_of("<shape type=\"sphere\">\n <float name=\"radios\" value=\"1\"/></shape>"), "scene.xml:3:2", "'radios'",
                "did you mean 'radius'?", "center");
    CHECK_ERROR(files.error_of("<shape type=\"cube\" colour=\"red\"/>"), "scene.xml:2:1", "'colour'", "type, id, name");
    CHECK_ERROR(files.error_of("<shape/>"), "scene.xml:2:1", "needs the attribute 'type'");
    CHECK_ERROR(files.error_of("<shape type=\"cube\"><float value=\"1\"/></shape>"), "needs the attribute 'name'");
    CHECK_ERROR(files.error_of("<shape type=\"cube\"><texture type=\"checkerboard\"/></shape>"), "takes no texture here", "bsdf, emitter");
    CHECK_ERROR(files.error_of("<integrator type=\"ptracer\"/>"), "scene.xml:2:1", "'ptracer'", "supported: path, direct");
    CHECK_ERROR(files.error_of("<float name=\"x\" value=\"1\"/>"), "scene.xml:2:1", "<float> is not supported in <scene>");
}

TEST_CASE("a parameter given twice is refused with both places", "[unit][scene]") {
    const SceneFiles files;
    CHECK_ERROR(
        files.error_of("<shape type=\"sphere\">\n<float name=\"radius\" value=\"1\"/>\n<float name=\"radius\" value=\"2\"/></shape>"),
        "scene.xml:4:1", "twice", "scene.xml:3:1");
}

TEST_CASE("numbers are whole, finite and in range", "[unit][scene]") {
    const SceneFiles files;
    const auto radius = [&](const std::string& v) {
        return files.error_of("<shape type=\"sphere\"><float name=\"radius\" value=\"" + v + "\"/></shape>");
    };
    CHECK(radius(" +1.5e0 ") == "no error");
    CHECK_ERROR(radius("1,5"), "scene.xml:2:22", "'1,5' is not a number");
    CHECK_ERROR(radius("1x"), "not a number");
    CHECK_ERROR(radius(""), "not a number");
    CHECK_ERROR(radius("nan"), "finite");
    CHECK_ERROR(radius("inf"), "finite");
    CHECK_ERROR(radius("1e39"), "fit a float");
    CHECK_ERROR(radius("0"), "positive");
    const auto depth = [&](const std::string& v) {
        return files.error_of("<integrator type=\"path\"><integer name=\"max_depth\" value=\"" + v + "\"/></integrator>");
    };
    CHECK(depth("0") == "no error");
    CHECK_ERROR(depth("3.5"), "not an integer");
    CHECK_ERROR(depth("99999999999999999999"), "not an integer of at most 64 bits");
    CHECK_ERROR(depth("99999999999"), "[-1, 2147483647]");
    CHECK_ERROR(depth("-2"), "[-1, 2147483647]");
    CHECK_ERROR(files.error_of("<integrator type=\"path\"><boolean name=\"hide_emitters\" value=\"yes\"/></integrator>"), "true or false");
    CHECK_ERROR(files.error_of("<integrator type=\"path\"><float name=\"max_depth\" value=\"3\"/></integrator>"), "must be an <integer>",
                "<float>");
}

TEST_CASE("defaults are substituted and overridden from outside", "[unit][scene]") {
    const SceneFiles files;
    const std::string text = R"(<default name="r" value="2"/><default name="r" value="9"/><default name="kind" value="here"/>
        <default name="again" value="$r"/>
        <shape type="sp$kind"><float name="radius" value="$again"/></shape>)";
    const auto radius = [](const SceneDescription& s) { return std::get<SphereShape>(s.shapes.at(0).geometry).radius; };
    CHECK(radius(files.load(text)) == 2.0);
    CHECK(radius(files.load(text, {{"r", "5"}})) == 5.0);
    CHECK_ERROR(files.error_of(text, {{"kid", "x"}}), "'kid'", "did you mean 'kind'?", "again, kind, r");
    CHECK_ERROR(files.error_of("<shape type=\"$shap\"/>\n"), "scene.xml:2:1", "'$shap'", "-D shap=");
    CHECK_ERROR(files.error_of("<shape type=\"$t\"/><default name=\"t\" value=\"cube\"/>"), "'$t' has no value");
}

TEST_CASE("the longest parameter name that fits is meant", "[unit][scene]") {
    const SceneFiles files;
    const auto scene = files.load(
        R"(<default name="a" value="cu"/><default name="ab" value="disk"/><shape type="$ab"/><shape type="$abe"/>)", {{"abe", "cube"}});
    CHECK(std::holds_alternative<DiskShape>(scene.shapes.at(0).geometry));
    CHECK(std::holds_alternative<CubeShape>(scene.shapes.at(1).geometry));
}

TEST_CASE("includes are found beside the including file, then beside the scene", "[unit][scene]") {
    const SceneFiles files;
    files.write("parts/a.xml", R"(<scene version="3.0.0"><default name="r" value="7"/><include filename="b.xml"/></scene>)");
    files.write("parts/b.xml", R"(<scene version="3.0.0"><shape type="sphere"><float name="radius" value="$r"/></shape>
        <shape type="obj"><string name="filename" value="t.obj"/></shape></scene>)");
    files.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto scene = files.load("<include filename=\"parts/a.xml\"/>");
    REQUIRE(scene.shapes.size() == 2);
    CHECK(std::get<SphereShape>(scene.shapes[0].geometry).radius == 7.0);
    CHECK(scene.shapes[0].where.file == (files.directory() / "parts/b.xml").string());
    CHECK(scene.shapes[1].where.line == 2);
    CHECK_ERROR(files.error_of("<include filename=\"none.xml\"/>"), "scene.xml:2:1", "none.xml", "tried");
    CHECK_ERROR(files.error_of("<include filename=\"scene.xml\"/>"), "scene.xml:2:1", "15 deep");
    CHECK_ERROR(files.error_of("<shape type=\"cube\"><include filename=\"parts/a.xml\"/></shape>"),
                "<include> is only supported directly in <scene>");
}

TEST_CASE("references reach everything with an id, before or after", "[unit][scene]") {
    const SceneFiles files;
    const auto scene = files.load(R"(<shape type="cube"><ref id="red"/></shape>
        <bsdf type="diffuse" id="red"><ref id="tiles" name="reflectance"/></bsdf>
        <texture type="checkerboard" id="tiles"/><alias id="red" as="rouge"/>
        <shape type="disk"><ref id="rouge"/></shape>
        <bsdf type="conductor" id="unused"/>)");
    CHECK(scene.shapes[0].material == scene.shapes[1].material);
    REQUIRE(scene.materials.size() == 2);  // the default and red: what nothing uses is not there
    CHECK(scene.materials[1].id == "red");
    CHECK(std::holds_alternative<CheckerboardTexture>(std::get<Diffuse>(scene.materials[1].front).reflectance));
    CHECK_ERROR(files.error_of(R"(<bsdf type="diffuse" id="white"/><shape type="cube"><ref id="withe"/></shape>)"), "scene.xml:2:53",
                "'withe'", "did you mean 'white'?");
    CHECK_ERROR(files.error_of("<bsdf type=\"diffuse\" id=\"a\"/>\n<bsdf type=\"diffuse\" id=\"a\"/>"), "scene.xml:3:1",
                "'a' is used twice", "scene.xml:2:1");
    CHECK_ERROR(files.error_of(R"(<shape type="cube" id="c"/><shape type="disk"><ref id="c"/></shape>)"), "takes no shape here");
    CHECK_ERROR(files.error_of(
                    R"(<bsdf type="diffuse" id="a"/><bsdf type="diffuse" id="b"/><shape type="cube"><ref id="a"/><ref id="b"/></shape>)"),
                "takes one bsdf");
}

TEST_CASE("mistakes in objects that nothing uses are found", "[unit][scene]") {
    const SceneFiles files;
    CHECK_ERROR(files.error_of("<bsdf type=\"velvet\" id=\"p\"/>"), "scene.xml:2:1", "'velvet'");
    CHECK_ERROR(files.error_of("<texture type=\"noise\" id=\"p\"/>"), "scene.xml:2:1", "'noise'");
    CHECK_ERROR(files.error_of("<emitter type=\"area\"/>"), "scene.xml:2:1", "not attached");
}

TEST_CASE("one sensor and one integrator are needed at most, and a sensor at least", "[unit][scene]") {
    const SceneFiles files;
    CHECK_ERROR(files.error_of_text("<scene version=\"3.0.0\"/>"), "scene.xml:1:1", "no sensor");
    CHECK_ERROR(files.error_of(kSensor), "scene.xml:3:1", "one sensor", "scene.xml:2:1");
    CHECK_ERROR(files.error_of("<integrator type=\"path\"/>\n<integrator type=\"path\"/>"), "scene.xml:3:1", "one integrator");
}

TEST_CASE("purpose and expectation come from the first comment", "[unit][scene]") {
    const SceneFiles files;
    const std::string scene = "<scene version=\"3.0.0\">" + kSensor + "<!-- purpose: not this --></scene>";
    const auto first = files.load_text(
        "<!--\n  purpose: caustic of a sphere,\n    seen from above\n  expect: slow at first\n  note: nothing\n-->\n" + scene);
    CHECK(first.purpose == "caustic of a sphere, seen from above");
    CHECK(first.expect == "slow at first");
    CHECK(files.load_text(scene).purpose.empty());
    CHECK(files.load_text("<scene version=\"3.0.0\"><!-- purpose: inside -->" + kSensor + "</scene>").purpose == "inside");
}

TEST_CASE("a byte order mark and carriage returns do no harm", "[unit][scene]") {
    const SceneFiles files;
    CHECK_ERROR(files.error_of_text("\xEF\xBB\xBF<scene version=\"3.0.0\">\r\n <shape type=\"x\"/>\r\n" + kSensor + "</scene>"),
                "scene.xml:2:2", "'x'");
}

TEST_CASE("source locations print as much as they know", "[unit][scene]") {
    CHECK(SourceLocation{"a.xml", 3, 4}.text() == "a.xml:3:4");
    CHECK(SourceLocation{"a.ply", 3, 0}.text() == "a.ply:3");
    CHECK(SourceLocation{"a.ply", 0, 0}.text() == "a.ply");
}

TEST_CASE("the Cornell box of Mitsuba's gallery loads", "[unit][scene]") {
    const char* root = std::getenv("KOKSMA_PEER_SCENES");
    if (!root) {
        WARN("skipped: KOKSMA_PEER_SCENES does not name a directory with scenes/cbox/cbox-rgb.xml");
        return;
    }
    const auto scene = load_scene(std::filesystem::path(root) / "scenes/cbox/cbox-rgb.xml", {{"res", "64"}});
    CHECK(scene.shapes.size() == 8);
    CHECK(scene.film.width == 64);
    CHECK(scene.spp == 256);
    CHECK(scene.sampler == "random");
    CHECK(scene.integrator.max_depth == 6);
    REQUIRE(scene.shapes[0].emission.has_value());
    CHECK(std::get<Rgb>(scene.shapes[0].emission->radiance) == Rgb(18.387f, 10.9873f, 2.75357f));
    CHECK(scene.shapes[0].to_world[3][1] == -0.5);
}
