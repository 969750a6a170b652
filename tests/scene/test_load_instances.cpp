// Groups, instances and animations in scene files.

#include "scene_files.h"

#include <koksma_catch.h>

using namespace koksma;
using namespace koksma::testing;

namespace {

const std::string kGroup = "<shape type=\"shapegroup\" id=\"g\"><shape type=\"sphere\"/><shape type=\"cube\"/></shape>";
const std::string kShown = "<shape type=\"instance\"><ref id=\"g\"/></shape>";

void check_error(const std::string& contents, const std::string& line, const std::string& what) {
    const SceneFiles files;
    const std::string message = files.error_of(contents);
    INFO(message);
    CHECK(message.find("scene.xml:" + line + ":") != std::string::npos);
    CHECK(message.find(what) != std::string::npos);
}

}  // namespace

TEST_CASE("a group is read once and seen through its instances alone", "[scene]") {
    const SceneFiles files;
    const SceneDescription d = files.load(kGroup + kShown + "<shape type=\"instance\"><ref id=\"g\"/><transform name=\"to_world\"><scale x=\"-2\"/></transform></shape>");
    CHECK(d.shapes.empty());
    REQUIRE(d.groups.size() == 1);
    CHECK(d.groups[0].id == "g");
    CHECK(d.groups[0].shapes.size() == 2);
    REQUIRE(d.instances.size() == 2);
    CHECK(d.instances[1].group == 0);
    CHECK(d.instances[1].to_world[0][0] == -2.0);
    CHECK(d.instances[1].animation.empty());
    CHECK(files.load(kGroup).groups.empty());  // nobody shows it
    CHECK(files.load("<shape type=\"instance\">" + kGroup + "</shape>").groups.size() == 1);
    CHECK(d.hash != files.load(kGroup + kShown).hash);
}

TEST_CASE("what a group or an instance cannot be is refused with its line", "[scene]") {
    check_error("<shape type=\"shapegroup\">\n<shape type=\"instance\"/></shape>", "3", "groups are not nested");
    check_error("<shape type=\"shapegroup\" id=\"g\">\n<shape type=\"shapegroup\"><shape type=\"cube\"/></shape></shape>" + kShown, "3", "groups are not nested");
    check_error("<shape type=\"shapegroup\" id=\"g\"><shape type=\"cube\">\n<emitter type=\"area\"/></shape></shape>" + kShown, "3", "cannot emit");
    check_error("<shape type=\"shapegroup\" id=\"g\"/>" + kShown, "2", "needs a shape");
    check_error(kGroup + "\n<shape type=\"instance\"/>", "3", "needs a shapegroup");
    check_error(kGroup + "\n<shape type=\"instance\"><shape type=\"cube\"/></shape>", "3", "found 'cube'");
    check_error(kGroup + "<shape type=\"instance\"><ref id=\"g\"/>\n<bsdf type=\"diffuse\"/></shape>", "3", "takes no bsdf");
    check_error(kGroup + "<shape type=\"instance\"><ref id=\"g\"/>\n<transform name=\"to_world\"><scale x=\"0\"/></transform></shape>", "3", "cannot be inverted");
    check_error("<shape type=\"shapegroup\" id=\"g\"><shape type=\"cube\">\n<animation name=\"to_world\"><transform time=\"0\"/></animation></shape></shape>" + kShown, "3",
                "cannot move on its own");
    check_error(kGroup.substr(0, kGroup.size() - 8) + "\n<transform name=\"to_world\"/></shape>" + kShown, "3", "no parameter 'to_world'");
}

TEST_CASE("an animation is keyframes in order of time", "[scene]") {
    const SceneFiles files;
    const auto cube = [](const std::string& keys) { return "<shape type=\"cube\">\n<animation name=\"to_world\">\n" + keys + "</animation></shape>"; };
    const SceneDescription d = files.load(cube("<transform time=\"-1\"><translate x=\"1\"/></transform><transform time=\"2.5\"><translate x=\"3\"/></transform>"));
    REQUIRE(d.shapes.at(0).animation.size() == 2);
    CHECK(d.shapes[0].animation[0].time == -1.0);
    CHECK(d.shapes[0].animation[1].to_world[3].x == 3.0);
    CHECK(d.shapes[0].to_world[3].x == 1.0);
    CHECK(files.load(cube("<transform time=\"1\"/>")).shapes.at(0).animation.empty());
    check_error(cube(""), "3", "needs a <transform");
    check_error(cube("<transform/>"), "4", "'time'");
    check_error(cube("<transform time=\"1\"/>\n<transform time=\"1\"/>"), "5", "must increase");
    check_error(cube("<transform time=\"1\"/>\n<transform time=\"2\"><scale y=\"0\"/></transform>"), "5", "cannot be inverted");
    check_error(cube("<scale x=\"1\"/>"), "4", "in <animation>");
    // Only shapes and instances move.
    const std::string still = "<animation name=\"to_world\"><transform time=\"0\"/></animation>";
    const std::string message = files.error_of_text("<scene version=\"3.0.0\"><sensor type=\"perspective\"><film type=\"hdrfilm\"/>\n" + still + "</sensor></scene>");
    INFO(message);
    CHECK(message.find("scene.xml:2:") != std::string::npos);
    CHECK(message.find("<animation>") != std::string::npos);
    check_error("<emitter type=\"spot\">\n" + still + "</emitter>", "3", "<animation>");
}
