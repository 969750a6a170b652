#pragma once
// A scene ready to be rendered: immutable, in float, re-centred on its camera.

#include <koksma/plan/effect.h>
#include <koksma/scene/accelerator.h>
#include <koksma/scene/bsdf/bsdf.h>
#include <koksma/scene/bsdf/layered.h>
#include <koksma/scene/camera.h>
#include <koksma/scene/description.h>
#include <koksma/scene/distribution.h>
#include <koksma/scene/environment_map.h>
#include <koksma/scene/light_tree.h>
#include <koksma/scene/medium/medium_record.h>
#include <koksma/scene/placement.h>
#include <koksma/scene/texture.h>
#include <koksma/scene/triangle_rows.h>

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace koksma {

/// One side of a material.
struct MaterialSide {
    BsdfKind kind = BsdfKind::none;
    bool perfect = false, ggx = false;
    TextureRef reflectance, alpha_u, alpha_v;
    Vec3f transmittance{1.0f}, eta{1.0f}, k{0.0f};
    std::int32_t layered = -1;  ///< index into Scene::layered's parts
};

/// Indices into Scene::sides. A two-sided material shows `back` from behind; the others show `front` to both sides
/// (which, for all that do not transmit, is black from behind).
struct MaterialSides {
    std::uint32_t front = 0, back = 0;
    bool two_sided = false;
    bool anisotropic = false;  ///< either side
};

enum class GeometryKind : std::uint8_t { mesh, sphere, disk, cylinder };

/// Where the values of a texture over mesh attributes lie.
struct AttributeSlot {
    std::int32_t index = -1;  ///< in Scene::attributes
    bool per_face = false;
    float scale = 1.0f;
};

/// One per shape: those of the description, then those of its groups.
struct GeometryRecord {
    GeometryKind kind = GeometryKind::mesh;
    bool flip = false;  ///< normals point the other way
    bool has_normals = false, has_uvs = false;
    std::uint32_t first = 0;  ///< mesh: its first entry in Scene::triangles; otherwise the index in spheres or disks
    std::uint32_t material = 0;
    std::int32_t light = -1;  ///< index into Scene::lights
};

/// Geometries in a space of their own.
struct GroupRecord {
    std::uint32_t first_geometry = 0, geometry_count = 0;
    Vec3d origin;         ///< of its own space, in that of the description: the middle of the shapes
    double radius = 0.0;  ///< of a ball about the own origin that holds them
};

/// A group seen somewhere. It moves if it has more than one placement.
struct InstanceRecord {
    std::uint32_t first_geometry = 0;                        ///< the group's
    std::uint32_t first_placement = 0, placement_count = 1;  ///< in Scene::placements, at equal distances in the time of the shutter
    Placement to_own;                                        ///< inverse of the placement, at rest
    PlacementError error;                                    ///< at all times
};

enum class LightKind : std::int32_t { mesh, parallelogram, sphere, disk, point, environment, cylinder, spot, projector, directional };

/// What a spot or a projector is besides a position.
struct Beam {
    Vec3f right, up, forward;                     ///< rows of world to light: their dot products with a direction are its own x, y, z
    Vec3f axis;                                   ///< unit, world: where it shines
    float half_width = 1.0f, half_height = 1.0f;  ///< of the picture at distance 1
    float cutoff = 0.0f, cos_cutoff = 1.0f, cos_beam = 1.0f, inverse_transition = 0.0f;  ///< of a spot; radians
    bool pictured = false;                                                               ///< the spot has a texture
};

struct Light {
    LightKind kind = LightKind::point;
    std::uint32_t geometry = 0;  ///< of surfaces; of spots and projectors, the index in Scene::beams
    TextureRef radiance;         ///< or intensity, or constant environment
    Vec3f corner, edge_u,
        edge_v;  ///< parallelogram; `corner` is also the position of a point, spot or projector, or the unit vector to a directional light
    float area = 0.0f;               ///< m^2
    DiscreteDistribution triangles;  ///< of a mesh, by area

    /// m^2 of a triangle of a mesh, or of the whole.
    [[nodiscard]] float area_of(std::uint32_t triangle) const noexcept {
        return triangle == kWholeLight ? area : area * triangles.probability(triangle);
    }
};

/// Everything that a kernel reads. Built by compile(); nothing changes it afterwards.
struct Scene {
    SceneDescription description;  ///< meshes and images are shared with it, not copied
    CompiledCamera camera;
    FilmSettings film;
    EffectSet effects;  ///< what it calls for, roulette and settings aside

    std::vector<Texture> textures;
    std::vector<MaterialSide> sides;
    std::shared_ptr<const LayeredParts> layered;  ///< null without layered materials
    std::vector<MaterialSides> materials;

    std::vector<GeometryRecord> geometries;
    std::vector<GroupRecord> groups;
    std::vector<InstanceRecord> instances;
    std::uint32_t first_instance = 0;   ///< its id in the accelerator
    std::vector<Placement> placements;  ///< own space of a group to the scene's; entries are floats
    std::vector<Vec3f> positions, normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices into positions, normals and uvs alike
    LargeVector<TriangleRow> triangle_rows;  ///< the same, as packs read them
    LargeVector<ShadingRow> shading_rows;
    std::vector<AnalyticSphere> spheres;
    std::vector<AnalyticDisk> disks;
    std::vector<AnalyticCylinder> cylinders;
    std::vector<std::vector<Vec3f>> attributes;  ///< by AttributeSlot: by vertex as positions are, or by triangle
    std::vector<AttributeSlot> attribute_slots;  ///< by texture; -1 for other textures
    Accelerator accelerator;

    std::vector<MediumRecord> media;
    std::vector<MediumBoundary> boundaries;  ///< by geometry; empty without media
    std::int32_t camera_medium = -1;         ///< that the camera is in

    std::vector<Light> lights;
    std::vector<Beam> beams;
    DiscreteDistribution light_choice;  ///< by power
    LightTree light_tree;               ///< instead, where there are many; otherwise empty
    std::int32_t environment_light = -1;
    std::optional<EnvironmentMap> environment_map;
    float bounding_radius = 1.0f;

    std::map<Effect, SourceLocation> called_for;  ///< who called first for an effect, where that is known
    void call_for(EffectSet set, const SourceLocation& where) {
        effects |= set;
        for (int i = 0; i < kEffectCount; ++i)
            if (set.has(static_cast<Effect>(i))) called_for.try_emplace(static_cast<Effect>(i), where);
    }
};

/// The shape of an entry of Scene::geometries.
[[nodiscard]] const Shape& shape_of(const SceneDescription& compiled, std::uint32_t geometry) noexcept;

/// Checks, re-centres, flattens and builds the BVH.
/// @throws Error "file:line:column: ..." for what cannot be rendered
[[nodiscard]] Scene compile(const SceneDescription& description);

}  // namespace koksma
