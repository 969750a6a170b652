#include "scene_hash.h"

#include <bit>
#include <map>
#include <type_traits>

namespace koksma::loader {
namespace {

/// Mixes 64 bits at a time with the finaliser of splitmix64 (Steele, Lea & Flood 2014, "Fast Splittable Pseudorandom Number Generators").
/// Works on values, so it is the same on every machine; 0 and -0 are the same value.
class Hasher {
public:
    void word(std::uint64_t w) {
        h_ += w + 0x9E3779B97F4A7C15u;
        h_ = (h_ ^ (h_ >> 30)) * 0xBF58476D1CE4E5B9u;
        h_ = (h_ ^ (h_ >> 27)) * 0x94D049BB133111EBu;
        h_ ^= h_ >> 31;
    }
    void text(const std::string& s) {
        word(s.size());
        for (const char c : s) word(static_cast<unsigned char>(c));
    }
    void number(double v) { word(std::bit_cast<std::uint64_t>(v + 0.0)); }
    void floats(float a, float b) {
        word(std::uint64_t{std::bit_cast<std::uint32_t>(a + 0.0f)} << 32 | std::bit_cast<std::uint32_t>(b + 0.0f));
    }
    void vec(const glm::vec3& v) { floats(v.x, v.y), floats(v.z, 0.0f); }
    void vec(const glm::dvec3& v) { number(v.x), number(v.y), number(v.z); }
    template <int N>
    void matrix(const glm::mat<N, N, double, glm::defaultp>& m) {
        for (int c = 0; c < N; ++c)
            for (int r = 0; r < N; ++r) number(m[c][r]);
    }
    [[nodiscard]] std::uint64_t value() const noexcept { return h_; }

private:
    std::uint64_t h_ = 0;
};

class SceneHasher {
public:
    explicit SceneHasher(const SceneDescription& scene) : scene_(scene) {}

    std::uint64_t run() {
        h_.word(scene_.shapes.size());
        for (const Shape& s : scene_.shapes) add(s);
        h_.word(scene_.point_lights.size());
        for (const PointLight& l : scene_.point_lights) h_.vec(l.position), h_.vec(l.intensity);
        h_.word(scene_.environment ? 1 + scene_.environment->index() : 0);
        if (scene_.environment) std::visit([this](const auto& e) { add(e); }, *scene_.environment);
        // What came later is in the hash only where it is used, so that the hash of an older scene stays.
        for (const DeltaLight& l : scene_.delta_lights)
            h_.word(0x64656C7461u + l.index()), std::visit([this](const auto& e) { add(e); }, l);
        if (!scene_.film.filter.is_pixel()) add(scene_.film.filter);
        for (const ShapeGroup& g : scene_.groups) {
            h_.word(0x67726F7570u), h_.word(g.shapes.size());
            for (const Shape& s : g.shapes) add(s);
        }
        for (const Instance& i : scene_.instances) h_.word(0x696E7374u), h_.word(i.group), h_.matrix<4>(i.to_world), add(i.animation);
        add(scene_.camera);
        h_.word(static_cast<std::uint64_t>(scene_.film.width)), h_.word(static_cast<std::uint64_t>(scene_.film.height));
        h_.word(static_cast<std::uint64_t>(std::int64_t{scene_.integrator.max_depth}));
        h_.word(scene_.integrator.hide_emitters);
        if (scene_.integrator.volumetric) {
            h_.word(0x766F6C);
            if (scene_.camera.medium) add(scene_.media.at(*scene_.camera.medium));
        }
        return h_.value();
    }

private:
    void add(const Shape& s) {
        h_.word(s.geometry.index());
        std::visit([this](const auto& g) { add(g); }, s.geometry);
        h_.matrix<4>(s.to_world);
        h_.word(s.flip_normals), h_.word(s.face_normals);
        add(scene_.materials.at(s.material));
        h_.word(s.emission.has_value());
        if (s.emission) add(s.emission->radiance);
        if (scene_.integrator.volumetric) {
            if (s.interior) h_.word(0x696E74), add(scene_.media.at(*s.interior));
            if (s.exterior) h_.word(0x657874), add(scene_.media.at(*s.exterior));
        }
        add(s.animation);
    }
    void add(const Medium& m) {
        h_.word(m.heterogeneous), h_.word(m.sample_emitters), h_.number(m.scale), h_.number(m.g);
        for (const Volume* v : {&m.sigma_t, &m.albedo}) h_.word(v->index()), std::visit([this](const auto& x) { add(x); }, *v);
    }
    void add(const ConstantVolume& v) { h_.vec(v.value), h_.matrix<4>(v.to_world); }
    void add(const GridVolume& v) {
        h_.word(once(v.grid.get(), [&](Hasher& h) {
            for (const std::int32_t n : v.grid->size) h.word(static_cast<std::uint64_t>(n));
            h.word(static_cast<std::uint64_t>(v.grid->channels));
            for (const float x : v.grid->values) h.number(static_cast<double>(x));
        }));
        h_.word(static_cast<std::uint64_t>(v.filter)), h_.word(static_cast<std::uint64_t>(v.wrap)), h_.matrix<4>(v.to_world);
    }
    void add(const Animation& animation) {
        if (animation.empty()) return;
        h_.word(animation.size()), h_.number(scene_.camera.shutter_open), h_.number(scene_.camera.shutter_close);
        for (const Keyframe& k : animation) h_.number(k.time), h_.matrix<4>(k.to_world);
    }
    void add(const RectangleShape&) {}
    void add(const DiskShape&) {}
    void add(const CubeShape&) {}
    void add(const SphereShape& s) { h_.vec(s.center), h_.number(s.radius); }
    void add(const CylinderShape& c) { h_.vec(c.p0), h_.vec(c.p1), h_.number(c.radius); }
    void add(const MeshShape& s) {
        h_.word(once(s.data.get(), [&](Hasher& h) { add_mesh(h, *s.data); }));
    }

    static void add_mesh(Hasher& h, const MeshData& m) {
        h.word(m.positions.size()), h.word(m.normals.size()), h.word(m.uvs.size()), h.word(m.triangles.size());
        for (const auto& p : m.positions) h.vec(p);
        for (const auto& n : m.normals) h.vec(n);
        for (const auto& uv : m.uvs) h.floats(uv.x, uv.y);
        for (const auto& t : m.triangles) h.word(std::uint64_t{t[0]} << 32 | t[1]), h.word(t[2]);
        for (const MeshAttribute& a : m.attributes) {
            h.text(a.name), h.word(a.values.size());
            for (const Rgb& v : a.values) h.vec(v);
        }
    }

    void add(const Image& image) {
        h_.word(once(&image, [&](Hasher& h) {
            h.word(static_cast<std::uint64_t>(image.width)), h.word(static_cast<std::uint64_t>(image.height));
            for (const Rgb& t : image.texels) h.vec(t);
        }));
    }
    void add(const Texture& t) {
        h_.word(t.index());
        std::visit([this](const auto& v) { add(v); }, t);
    }
    void add(const Rgb& c) { h_.vec(c); }
    void add(const BitmapTexture& t) {
        add(*t.image);
        h_.word(static_cast<std::uint64_t>(t.filter)), h_.word(static_cast<std::uint64_t>(t.wrap));
        h_.matrix<3>(t.to_uv);
    }
    void add(const CheckerboardTexture& t) { h_.vec(t.color0), h_.vec(t.color1), h_.matrix<3>(t.to_uv); }

    void add(const MeshAttributeTexture& t) { h_.text(t.name), h_.floats(t.scale, 0.0f); }

    void add(const Material& m) {
        h_.word(m.two_sided);
        add(m.front);
        h_.word(m.back.has_value());
        if (m.back) add(*m.back);
    }
    void add(const OneSidedMaterial& m) {
        h_.word(m.index());
        std::visit([this](const auto& v) { add(v); }, m);
    }
    void add(const Diffuse& d) { add(d.reflectance); }
    void add(const Dielectric& d) { h_.floats(d.int_ior, d.ext_ior), h_.vec(d.specular_reflectance), h_.vec(d.specular_transmittance); }
    void add(const Conductor& c) { h_.word(c.perfect), h_.vec(c.eta), h_.vec(c.k), h_.vec(c.specular_reflectance); }
    void add(const RoughConductor& r) {
        add(r.base);
        h_.word(static_cast<std::uint64_t>(r.distribution));
        add(r.alpha_u), add(r.alpha_v);
    }

    void add(const ThinDielectric& d) { h_.floats(d.int_ior, d.ext_ior), h_.vec(d.specular_reflectance), h_.vec(d.specular_transmittance); }
    void add(const RoughDielectric& r) {
        h_.floats(r.int_ior, r.ext_ior), h_.word(static_cast<std::uint64_t>(r.distribution));
        add(r.alpha_u), add(r.alpha_v), add(r.specular_reflectance), add(r.specular_transmittance);
    }
    void add(const Plastic& p) {
        h_.floats(p.int_ior, p.ext_ior), h_.word(p.nonlinear);
        add(p.diffuse_reflectance), add(p.specular_reflectance);
    }
    void add(const RoughPlastic& p) {
        h_.floats(p.int_ior, p.ext_ior), h_.floats(p.alpha, 0.0f), h_.word(p.nonlinear),
            h_.word(static_cast<std::uint64_t>(p.distribution));
        add(p.diffuse_reflectance), add(p.specular_reflectance);
    }
    void add(const Principled& p) {
        h_.floats(p.eta, 0.0f);  // sampling rates change no expected image
        for (const Texture* t : {&p.base_color, &p.roughness, &p.anisotropic, &p.metallic, &p.spec_trans, &p.spec_tint, &p.sheen,
                                 &p.sheen_tint, &p.flatness, &p.clearcoat, &p.clearcoat_gloss})
            add(*t);
    }
    void add(const Bending& b) { h_.word(b.flip_invalid_normals), h_.word(b.use_shadowing_function), add(b.nested); }
    void add(const NormalMap& m) { add(m.normals), add(m.bending); }
    void add(const BumpMap& m) { h_.floats(m.scale, 0.0f), add(m.height), add(m.bending); }
    void add(const Blend& b) { add(b.weight), add(b.nested); }
    void add(const Mask& m) { add(m.opacity), add(m.nested); }
    void add(const Null&) {}
    void add(const std::vector<Material>& nested) {
        h_.word(nested.size());
        for (const Material& m : nested) add(m);
    }

    void add(const SpotLight& s) {
        h_.matrix<4>(s.to_world), h_.vec(s.intensity), h_.number(s.cutoff_degrees), h_.number(s.beam_degrees);
        h_.word(s.texture.has_value());
        if (s.texture) add(*s.texture);
    }
    void add(const DirectionalLight& d) { h_.vec(d.direction), h_.vec(d.irradiance); }
    void add(const ProjectorLight& p) {
        h_.matrix<4>(p.to_world), add(p.irradiance), h_.number(p.scale), h_.number(p.fov_x_degrees), h_.number(p.aspect);
    }
    void add(const ReconstructionFilter& f) {
        h_.word(1 + static_cast<std::uint64_t>(f.kind)), h_.number(f.radius), h_.number(f.stddev), h_.word(f.beyond_film);
    }
    void add(const ConstantEnvironment& e) { h_.vec(e.radiance); }
    void add(const MapEnvironment& e) {
        add(*e.image);
        h_.floats(e.scale, 0.0f), h_.matrix<4>(e.to_world);
    }
    void add(const Camera& c) {
        h_.matrix<4>(c.to_world);
        h_.number(c.fov_x_degrees), h_.number(c.near_clip), h_.number(c.far_clip);
        h_.number(c.aperture_radius);
        h_.number(c.aperture_radius > 0.0 ? c.focus_distance : 0.0);  // a pinhole has no focus
        if (c.orthographic) h_.word(0x6F7274686Fu);
        h_.number(c.principal_point_offset.x), h_.number(c.principal_point_offset.y);
    }

    /// The hash of something shared, computed on first sight.
    template <class F>
    std::uint64_t once(const void* shared, F&& add_contents) {
        const auto [it, is_new] = known_.try_emplace(shared, 0);
        if (is_new) {
            Hasher h;
            add_contents(h);
            it->second = h.value();
        }
        return it->second;
    }

    const SceneDescription& scene_;
    Hasher h_;
    std::map<const void*, std::uint64_t> known_;
};

}  // namespace

std::uint64_t scene_hash(const SceneDescription& scene) { return SceneHasher(scene).run(); }

}  // namespace koksma::loader
