#pragma once
// A scene as plain values: what a file says, nothing computed from it. Made by load_scene() or by hand; compiled by compile().

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace koksma {

/// Where something was written; line and column count from 1, 0 when unknown.
struct SourceLocation {
    std::string file;
    int line = 0, column = 0;
    /// "file:line:column", or as much of it as is known.
    [[nodiscard]] std::string text() const;
};

using Rgb = glm::vec3;  ///< linear sRGB primaries

// ------------------------------------------------------------------------------------------------ textures

/// Pixels of a bitmap, linear. Row 0 is the top of the picture and spans v in [0, 1/height): v counts downwards, as in Mitsuba
/// (load_scene() turns the v of OBJ files over, which counts upwards).
struct Image {
    int width = 0, height = 0;
    std::vector<Rgb> texels;  ///< (height, width)
};

struct BitmapTexture {
    enum class Filter : std::uint8_t { bilinear, nearest };
    enum class Wrap : std::uint8_t { repeat, mirror, clamp };
    std::shared_ptr<const Image> image;
    Filter filter = Filter::bilinear;
    Wrap wrap = Wrap::repeat;
    glm::dmat3 to_uv{1.0};
};

struct CheckerboardTexture {
    Rgb color0{0.4f}, color1{0.2f};
    glm::dmat3 to_uv{1.0};
};

/// Values that a mesh brings along, per vertex or per face.
struct MeshAttributeTexture {
    std::string name;  ///< "vertex_color", "face_color" ...
    float scale = 1.0f;
    bool reflectance = false;  ///< values times scale must not exceed 1
};

/// A value per point of a surface; a constant is the common case.
using Texture = std::variant<Rgb, BitmapTexture, CheckerboardTexture, MeshAttributeTexture>;

// ------------------------------------------------------------------------------------------------ materials

struct Diffuse {
    Texture reflectance = Rgb(0.5f);
};
struct Dielectric {
    float int_ior = 1.5046f, ext_ior = 1.000277f;
    Rgb specular_reflectance{1.0f}, specular_transmittance{1.0f};
};
/// Two interfaces so close that what is transmitted goes straight on.
struct ThinDielectric {
    float int_ior = 1.5046f, ext_ior = 1.000277f;
    Rgb specular_reflectance{1.0f}, specular_transmittance{1.0f};
};
/// eta = k = 0 with `perfect` set is a mirror that reflects everything (material "none").
struct Conductor {
    bool perfect = true;
    Rgb eta{0.0f}, k{1.0f};
    Rgb specular_reflectance{1.0f};
};
enum class Facets : std::uint8_t { beckmann, ggx };
struct RoughConductor {
    using Distribution = Facets;
    Conductor base;
    Distribution distribution = Distribution::beckmann;
    Texture alpha_u = Rgb(0.1f), alpha_v = Rgb(0.1f);
};
struct RoughDielectric {
    float int_ior = 1.5046f, ext_ior = 1.000277f;
    Facets distribution = Facets::beckmann;
    Texture alpha_u = Rgb(0.1f), alpha_v = Rgb(0.1f);
    Texture specular_reflectance = Rgb(1.0f), specular_transmittance = Rgb(1.0f);
};
/// A diffuse base under a smooth coat.
struct Plastic {
    float int_ior = 1.49f, ext_ior = 1.000277f;
    Texture diffuse_reflectance = Rgb(0.5f), specular_reflectance = Rgb(1.0f);
    bool nonlinear = false;
};
/// A diffuse base under a rough coat.
struct RoughPlastic {
    float int_ior = 1.49f, ext_ior = 1.000277f;
    Facets distribution = Facets::beckmann;
    float alpha = 0.1f;
    Texture diffuse_reflectance = Rgb(0.5f), specular_reflectance = Rgb(1.0f);
    bool nonlinear = false;
};
/// Mitsuba's parameters; those that are numbers are textures of one number.
struct Principled {
    Texture base_color = Rgb(0.5f), roughness = Rgb(0.5f), anisotropic = Rgb(0.0f), metallic = Rgb(0.0f), spec_trans = Rgb(0.0f);
    Texture spec_tint = Rgb(0.0f), sheen = Rgb(0.0f), sheen_tint = Rgb(0.0f), flatness = Rgb(0.0f);
    Texture clearcoat = Rgb(0.0f), clearcoat_gloss = Rgb(0.0f);
    float eta = 1.5f;  ///< inside / outside; `specular` of a file is turned into it
    float main_specular_sampling_rate = 1.0f, clearcoat_sampling_rate = 1.0f, diffuse_reflectance_sampling_rate = 1.0f;
};
struct Material;
/// weight 0: the first of two materials, 1: the second.
struct Blend {
    Texture weight = Rgb(0.5f);
    std::vector<Material> nested;
};
/// opacity 1: the one nested material, 0: nothing.
struct Mask {
    Texture opacity = Rgb(0.5f);
    std::vector<Material> nested;
};
/// Lets everything pass.
struct Null {};
/// How a nested material with other normals stays with its surface: normals that look away from the camera are turned, and light near the
/// horizon fades as on a rough surface.
struct Bending {
    bool flip_invalid_normals = true, use_shadowing_function = true;
    std::vector<Material> nested;  ///< one
};
/// Normals out of a texture: (n + 1) / 2 in the frame of the surface.
struct NormalMap {
    Texture normals = Rgb(0.5f, 0.5f, 1.0f);
    Bending bending;
};
/// Normals as if a texture times `scale` moved the surface along its normal.
struct BumpMap {
    Texture height = Rgb(0.0f);
    float scale = 1.0f;
    Bending bending;
};
using OneSidedMaterial = std::variant<Diffuse, Dielectric, Conductor, RoughConductor, ThinDielectric, RoughDielectric, Plastic,
                                      RoughPlastic, Principled, Blend, Mask, Null, NormalMap, BumpMap>;

/// A BSDF. With `two_sided`, `back` is seen from below; without, `back` is empty.
struct Material {
    std::string id;
    OneSidedMaterial front;
    std::optional<OneSidedMaterial> back;
    bool two_sided = false;
    SourceLocation where;
};

// ------------------------------------------------------------------------------------------------ media

/// Values of the cells of a box, which is the unit cube before any transform.
struct VolumeGrid {
    std::array<std::int32_t, 3> size{1, 1, 1};  ///< cells along x, y, z
    std::int32_t channels = 1;                  ///< 1 or 3
    std::vector<float> values;                  ///< (z, y, x, channels)
    glm::vec3 low{0.0f}, high{1.0f};            ///< the box that the file names
};
struct GridVolume {
    enum class Filter : std::uint8_t { trilinear, nearest };
    enum class Wrap : std::uint8_t { clamp, repeat, mirror };
    std::shared_ptr<const VolumeGrid> grid;
    Filter filter = Filter::trilinear;
    Wrap wrap = Wrap::clamp;
    glm::dmat4 to_world{1.0};  ///< of the unit cube
};
struct ConstantVolume {
    Rgb value{1.0f};
    glm::dmat4 to_world{1.0};  ///< where a heterogeneous medium of this extinction ends: at the unit cube
};
/// A value per point of space.
using Volume = std::variant<ConstantVolume, GridVolume>;

/// What absorbs and scatters light within a volume.
struct Medium {
    bool heterogeneous = false;                                   ///< varies in space, and ends at the box around its extinction
    Volume sigma_t = ConstantVolume{};                            ///< extinction, m^-1; of a homogeneous medium constant
    Volume albedo = ConstantVolume{Rgb(0.75f), glm::dmat4(1.0)};  ///< what of the extinction is scattered, [0, 1]
    double scale = 1.0;                                           ///< of the extinction
    double g = 0.0;               ///< mean cosine of the Henyey-Greenstein phase function, (-1, 1); 0: isotropic
    bool sample_emitters = true;  ///< false: light reaches its points by phase function sampling alone
    SourceLocation where;
};

// ------------------------------------------------------------------------------------------------ motion

/// Where something is at an instant, in the time of the camera's shutter.
struct Keyframe {
    double time = 0.0;
    glm::dmat4 to_world{1.0};
};
/// Placements in order of time; empty: at rest. In between, translation and stretch change linearly and the rotation takes the shortest
/// way at a constant rate; before the first and after the last nothing moves (koksma/scene/animation.h).
using Animation = std::vector<Keyframe>;

// ------------------------------------------------------------------------------------------------ shapes

/// Colours, or numbers as greys, of vertices or faces.
struct MeshAttribute {
    std::string name;         ///< begins with "vertex_" or "face_"
    std::vector<Rgb> values;  ///< per vertex, or per triangle
    [[nodiscard]] bool per_face() const noexcept { return name.starts_with("face_"); }
};

/// A triangle mesh in its own space.
struct MeshData {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;  ///< per vertex, or empty: faceted (load_scene() computes smooth ones where a file has none)
    std::vector<glm::vec2> uvs;      ///< per vertex, or empty
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<MeshAttribute> attributes{};
    bool faceted = false;  ///< the file asks for no normals
};
struct MeshShape {
    std::shared_ptr<const MeshData> data;
};
struct RectangleShape {};  ///< [-1, 1]^2 in z = 0, normal +z
struct DiskShape {};       ///< unit disk in z = 0, normal +z
struct CubeShape {};       ///< [-1, 1]^3
struct SphereShape {
    glm::dvec3 center{0.0};
    double radius = 1.0;
};
/// A tube without caps.
struct CylinderShape {
    glm::dvec3 p0{0.0}, p1{0.0, 0.0, 1.0};
    double radius = 1.0;
};
using Geometry = std::variant<MeshShape, RectangleShape, DiskShape, CubeShape, SphereShape, CylinderShape>;

/// One-sided diffuse emission of a surface.
struct AreaEmission {
    Texture radiance = Rgb(1.0f);  ///< W sr^-1 m^-2
    SourceLocation where;
};

struct Shape {
    std::string id;
    Geometry geometry;
    glm::dmat4 to_world{1.0};
    Animation animation{};  ///< instead of to_world
    bool flip_normals = false;
    bool face_normals = false;
    std::uint32_t material = 0;  ///< index into SceneDescription::materials
    std::optional<AreaEmission> emission;
    std::optional<std::uint32_t> interior, exterior;  ///< indices into SceneDescription::media; with either, the shape is where media end
    SourceLocation where;
};

/// Shapes that are seen through instances alone; none of them emits or moves on its own.
struct ShapeGroup {
    std::string id;
    std::vector<Shape> shapes;
    SourceLocation where;
};
/// A group shown somewhere.
struct Instance {
    std::uint32_t group = 0;  ///< index into SceneDescription::groups
    glm::dmat4 to_world{1.0};
    Animation animation{};  ///< instead of to_world
    SourceLocation where;
};

// ------------------------------------------------------------------------------------------------ emitters

struct PointLight {
    glm::dvec3 position{0.0};
    Rgb intensity{1.0f};  ///< W sr^-1
    SourceLocation where;
};
/// A point that shines along its own +z, fully within the beam's half angle, then falling off linearly in the angle to the cutoff.
struct SpotLight {
    glm::dmat4 to_world{1.0};
    Rgb intensity{1.0f};                                ///< W sr^-1, within the beam
    double cutoff_degrees = 20.0, beam_degrees = 15.0;  ///< half angles
    std::optional<Texture> texture;                     ///< a factor; its unit square spans the cone of the cutoff
    SourceLocation where;
};
/// Parallel light from infinity.
struct DirectionalLight {
    glm::dvec3 direction{0.0, 0.0, 1.0};  ///< that the light travels in; any length
    Rgb irradiance{1.0f};                 ///< W m^-2, of a surface that faces the light
    SourceLocation where;
};
/// A perspective camera that shines: it gives the plane at distance 1 the irradiance pi scale irradiance(u, v), as in Mitsuba.
struct ProjectorLight {
    glm::dmat4 to_world{1.0};
    Texture irradiance = Rgb(1.0f);
    double scale = 1.0;
    double fov_x_degrees = 50.0;
    double aspect = 1.0;  ///< width / height of the picture
    SourceLocation where;
};
/// Lights without extent besides points.
using DeltaLight = std::variant<SpotLight, DirectionalLight, ProjectorLight>;

/// Radiance from all directions.
struct ConstantEnvironment {
    Rgb radiance{1.0f};
    SourceLocation where;
};
/// A latitude-longitude map; +y is up in its own space.
struct MapEnvironment {
    std::shared_ptr<const Image> image;
    float scale = 1.0f;
    glm::dmat4 to_world{1.0};
    SourceLocation where;
};
using Environment = std::variant<ConstantEnvironment, MapEnvironment>;

// ------------------------------------------------------------------------------------------------ camera, film, settings

struct Camera {
    glm::dmat4 to_world{1.0};     ///< camera looks along its +z, +x is left in the image (Mitsuba's frame)
    double fov_x_degrees = 50.0;  ///< horizontal, of the full film (fov_axis is resolved by the loader)
    bool orthographic = false;    ///< parallel rays from [-1, 1] x [-1, 1] height / width of the camera's own plane; to_world may scale
    double near_clip = 1e-2, far_clip = 1e4;  ///< distances along the camera's z
    double aperture_radius = 0.0;             ///< 0: pinhole
    double focus_distance = 1e4;              ///< distance along z of the plane in focus
    std::optional<std::uint32_t> medium;      ///< that the camera is in, index into SceneDescription::media
    glm::dvec2 principal_point_offset{
        0.0};  ///< in fractions of the full film: film position (x, y) sees what (x, y) + offset saw without it
    double shutter_open = 0.0, shutter_close = 0.0;  ///< instants; equal: everything stands where it is then
    SourceLocation where;
};

/// Where in and around its pixel a sample lies. Positions are drawn from the filter, so every sample has weight one.
struct ReconstructionFilter {
    enum class Kind : std::uint8_t { box, tent, gaussian } kind = Kind::box;
    double radius = 0.5;  ///< pixels, of box and tent; a gaussian ends at four standard deviations
    double stddev = 0.5;  ///< pixels, of the gaussian
    /// True: samples of the outermost pixels may lie beyond the film; false: the part of the filter there is cut off.
    bool beyond_film = false;
    /// Every sample lies in its own pixel, uniformly.
    [[nodiscard]] bool is_pixel() const noexcept { return kind == Kind::box && radius == 0.5; }
};

struct FilmSettings {
    std::int32_t width = 768, height = 576;
    std::int32_t crop_x = 0, crop_y = 0, crop_width = 0, crop_height = 0;  ///< crop_width 0: the whole film
    ReconstructionFilter filter{};
};

/// How light that reaches a surface straight from a light is estimated: by both ways, weighted by the power heuristic, or by one of
/// them, for comparisons. Each is right by itself wherever it can make the direction at all (mirrors are left to the BSDF, points to
/// light sampling), and noisy elsewhere.
enum class Technique : std::uint8_t { mis, light, bsdf };

struct IntegratorSettings {
    std::int32_t max_depth = -1;  ///< longest path in vertices after the camera; 1: emission seen directly; -1: no limit
    std::int32_t rr_depth = 5;    ///< roulette from this depth on
    bool hide_emitters = false;   ///< directly visible emitters are black
    /// Mitsuba's volpath: there are media, and surfaces that let light pass straight on are no vertices of a path. False: its path, for
    /// which there is vacuum everywhere and passing on is a bounce.
    bool volumetric = false;
    Technique technique = Technique::mis;
    std::string moments;  ///< name under which moments of the samples are written beside the image; empty: none are kept
};

/// The whole of a scene file.
struct SceneDescription {
    std::string file;
    std::vector<Material> materials;  ///< [0] is the default diffuse of reflectance 0.5
    std::vector<Medium> media;
    std::vector<Shape> shapes;
    std::vector<ShapeGroup> groups;
    std::vector<Instance> instances;
    std::vector<PointLight> point_lights;
    std::vector<DeltaLight> delta_lights;
    std::optional<Environment> environment;
    Camera camera;
    FilmSettings film;
    IntegratorSettings integrator;
    std::string sampler;    ///< our name of the sampler that the file asks for; empty when it names none of ours
    std::uint64_t spp = 4;  ///< sample_count of the file
    std::uint64_t seed = 0;
    std::uint64_t hash =
        0;  ///< of everything that can change the expected image, film size too; not of crop, rr_depth, sampler, spp or seed
    std::string purpose, expect;  ///< from the header comment of built-in scenes ("purpose: ...", "expect: ..."); may be empty
};

}  // namespace koksma
