// A scene file from beginning to end.

#include "bsdfs.h"
#include "context.h"
#include "emitters.h"
#include "fail.h"
#include "header_comment.h"
#include "media.h"
#include "scene_hash.h"
#include "sensor.h"
#include "shapes.h"
#include "textures.h"
#include "xml_document.h"

#include <koksma/scene/load.h>

#include <algorithm>

namespace koksma {
namespace loader {
namespace {

/// The sensor or the integrator. @throws Error for two
const Element* only(const XmlDocument& document, std::string_view tag) {
    const Element* found = nullptr;
    for (const Element& e : document.elements) {
        if (e.tag != tag) continue;
        if (found) fail(e.where, "a scene takes one {}; the first is at {}", tag, found->where.text());
        found = &e;
    }
    return found;
}

void check_tags(const XmlDocument& document) {
    const std::vector<std::string> tags{"default", "include", "path",  "alias",  "integrator", "sensor", "bsdf",
                                        "texture", "medium",  "phase", "volume", "shape",      "emitter"};
    for (const Element& e : document.elements)
        if (std::find(tags.begin(), tags.end(), e.tag) == tags.end())
            fail(e.where, "<{}> is not supported in <scene>; {}supported: {}", e.tag, did_you_mean(e.tag, tags), list_of(tags));
}

/// What no shape uses is read all the same, so that its mistakes are found; it is not added to the scene.
void check_unused(const XmlDocument& document, Context& context) {
    for (const Element& e : document.elements) {
        if (e.tag == "bsdf" && !context.materials.contains(&e)) (void)parse_material(e, context);
        if (e.tag == "texture") (void)parse_texture(e, ColorUse::any, context);
        check_medium_object(e, context);
        if (e.tag == "shape" && e.required("type") == "shapegroup" && !context.groups.contains(&e)) (void)parse_group(e, context);
        if (e.tag == "emitter" && e.required("type") == "area" && !context.attached_emitters.contains(&e))
            fail(e.where, "this area emitter is not attached to a shape; put it, or a <ref> to it, in a <shape>");
    }
}

}  // namespace
}  // namespace loader

SceneDescription load_scene(const std::filesystem::path& file, const SceneParameters& parameters) {
    using namespace loader;
    const XmlDocument document = read_xml(file, parameters);
    SceneDescription scene;
    scene.file = file.string();
    scene.materials.emplace_back();
    read_header_comment(document.comment, scene);

    Context context{scene, {}, document.search, {}, {}, {}, {}, {}, {}};
    check_tags(document);
    collect_ids(document.elements, context.ids);
    if (const Element* integrator = only(document, "integrator")) read_integrator(*integrator, context);
    const Element* sensor = only(document, "sensor");
    if (!sensor) fail(document.where, "the scene has no sensor; add <sensor type=\"perspective\"> with a film");
    read_sensor(*sensor, context);
    for (const Element& e : document.elements) {
        if (e.tag == "shape") read_shape(e, context);
        if (e.tag == "emitter") read_emitter(e, context);
    }
    check_unused(document, context);
    scene.hash = scene_hash(scene);
    return scene;
}

}  // namespace koksma
