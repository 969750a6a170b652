#include <koksma/film/exr.h>
#include <koksma/measure/reference.h>
#include <koksma/measure/seeds.h>
#include <koksma/sampling/error.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <istream>
#include <ostream>

namespace koksma {

namespace {

double average(const std::vector<float>& v) {
    double sum = 0.0;
    for (const float x : v) sum += x;
    return v.empty() ? 0.0 : sum / static_cast<double>(v.size());
}

void put_planes(ExrImage& exr, const std::string& prefix, const std::vector<float>& interleaved) {
    const char* names[3] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<float>& plane = exr.channels[prefix + "." + names[c]];
        plane.resize(interleaved.size() / 3);
        for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = interleaved[3 * i + c];
    }
}

std::vector<float> get_planes(const ExrImage& exr, const std::string& prefix) {
    const char* names[3] = {"R", "G", "B"};
    std::vector<float> out(3 * static_cast<std::size_t>(exr.width) * static_cast<std::size_t>(exr.height));
    for (std::size_t c = 0; c < 3; ++c) {
        const auto it = exr.channels.find(prefix + "." + names[c]);
        if (it == exr.channels.end()) throw Error("it has no channel " + prefix + "." + names[c]);
        for (std::size_t i = 0; i < it->second.size(); ++i) out[3 * i + c] = it->second[i];
    }
    return out;
}

const std::string& attribute(const ExrImage& exr, const std::string& name) {
    const auto it = exr.attributes.find(name);
    if (it == exr.attributes.end()) throw Error("it has no attribute " + name);
    return it->second;
}

std::string describe(const ReferenceKey& key) {
    return fmt::format("scene {} ({:016x}), pixels {}x{}+{}+{}, max_depth {}, rr_depth {}, hide_emitters {}, estimator version {}", key.scene, key.scene_hash,
                       key.rect.width, key.rect.height, key.rect.x, key.rect.y, key.integrator.max_depth, key.integrator.rr_depth,
                       key.integrator.hide_emitters, key.estimator_version);
}

}  // namespace

std::string ReferenceKey::digest() const {
    std::uint64_t h = scene_hash;
    for (const std::int64_t v : {std::int64_t{rect.x}, std::int64_t{rect.y}, std::int64_t{rect.width}, std::int64_t{rect.height},
                                 std::int64_t{integrator.max_depth}, std::int64_t{integrator.rr_depth}, std::int64_t{integrator.hide_emitters},
                                 std::int64_t{estimator_version}})
        h = hash_combine(h, static_cast<std::uint64_t>(v));
    return fmt::format("{:016x}", h);
}

void HalfAccumulator::add(std::span<const float> image) {
    if (n_ == 0) {
        // Sums are taken about the first image: squares of the means themselves would cancel.
        shift_.assign(image.begin(), image.end());
        sum_.assign(image.size(), 0.0);
        sum_of_squares_.assign(image.size(), 0.0);
    }
    if (image.size() != sum_.size()) throw Error("replicates of a reference differ in size");
    for (std::size_t i = 0; i < image.size(); ++i) {
        const double d = image[i] - shift_[i];
        sum_[i] += d;
        sum_of_squares_[i] += d * d;
    }
    ++n_;
}

ReferenceHalf HalfAccumulator::finish(std::string sampler, std::uint64_t spp) const {
    if (n_ < 2) throw Error("a reference needs two replicates or more to know its error; it has " + std::to_string(n_));
    ReferenceHalf half{std::move(sampler), n_, spp, {}, {}};
    for (std::size_t i = 0; i < sum_.size(); ++i) {
        const double mean = sum_[i] / n_;
        const double variance = std::max(0.0, (sum_of_squares_[i] - sum_[i] * mean) / (n_ - 1)) / n_;
        half.mean.push_back(static_cast<float>(shift_[i] + mean));
        half.variance.push_back(static_cast<float>(variance));
    }
    return half;
}

namespace {

constexpr std::uint64_t kHalfMagic = 0x31666c61686b736bull;  // "kskhalf1"

template <class T>
void put(std::ostream& out, const T* values, std::size_t count) {
    out.write(reinterpret_cast<const char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
}
template <class T>
void get(std::istream& in, T* values, std::size_t count) {
    in.read(reinterpret_cast<char*>(values), static_cast<std::streamsize>(count * sizeof(T)));
    if (!in) throw Error("the sums of a reference end too early");
}

}  // namespace

void HalfAccumulator::write(std::ostream& out) const {
    const std::uint64_t head[3] = {kHalfMagic, static_cast<std::uint64_t>(n_), sum_.size()};
    put(out, head, 3);
    for (const std::vector<double>* v : {&shift_, &sum_, &sum_of_squares_}) put(out, v->data(), v->size());
}

HalfAccumulator HalfAccumulator::read(std::istream& in) {
    std::uint64_t head[3] = {};
    get(in, head, 3);
    constexpr std::uint64_t kMost = 1u << 30;
    if (head[0] != kHalfMagic || head[1] > kMost || head[2] > kMost) throw Error("not the sums of a reference");
    HalfAccumulator half;
    half.n_ = static_cast<int>(head[1]);
    for (std::vector<double>* v : {&half.shift_, &half.sum_, &half.sum_of_squares_}) {
        v->resize(head[2]);
        get(in, v->data(), v->size());
    }
    return half;
}

void Reference::combine() {
    // One weight for the whole image: per-pixel precisions from a few replicates would be noise themselves.
    const double va = average(halves[0].variance), vb = average(halves[1].variance);
    const double wa = va + vb > 0.0 ? vb / (va + vb) : 0.5, wb = 1.0 - wa;
    mean.resize(halves[0].mean.size());
    variance.resize(mean.size());
    for (std::size_t i = 0; i < mean.size(); ++i) {
        mean[i] = static_cast<float>(wa * halves[0].mean[i] + wb * halves[1].mean[i]);
        variance[i] = static_cast<float>(wa * wa * halves[0].variance[i] + wb * wb * halves[1].variance[i]);
    }
}

std::uint64_t Reference::spp_total() const noexcept {
    return static_cast<std::uint64_t>(halves[0].replicates) * halves[0].spp + static_cast<std::uint64_t>(halves[1].replicates) * halves[1].spp;
}

double Reference::standard_error() const noexcept { return std::sqrt(average(variance)); }

std::string reference_file_name(const ReferenceKey& key) { return key.scene + "-" + key.digest() + ".exr"; }

void save_reference(const std::filesystem::path& file, const Reference& reference) {
    ExrImage exr;
    exr.width = reference.key.rect.width;
    exr.height = reference.key.rect.height;
    for (int i = 0; i < 2; ++i) {
        const ReferenceHalf& h = reference.halves[i];
        const std::string prefix = i == 0 ? "a" : "b";
        put_planes(exr, prefix + ".mean", h.mean);
        put_planes(exr, prefix + ".variance", h.variance);
        exr.attributes["koksma:" + prefix + ".sampler"] = h.sampler;
        exr.attributes["koksma:" + prefix + ".replicates"] = std::to_string(h.replicates);
        exr.attributes["koksma:" + prefix + ".spp"] = std::to_string(h.spp);
    }
    exr.attributes["koksma:digest"] = reference.key.digest();
    exr.attributes["koksma:key"] = describe(reference.key);
    write_exr(file, exr);
}

Reference load_reference(const std::filesystem::path& file, const ReferenceKey& key) {
    const ExrImage exr = read_exr(file);
    try {
        if (attribute(exr, "koksma:digest") != key.digest())
            throw Error(fmt::format("it answers [{}], asked was [{}]; remake it with 'koksma reference'", attribute(exr, "koksma:key"), describe(key)));
        Reference reference{key, {}, {}, {}};
        for (int i = 0; i < 2; ++i) {
            const std::string prefix = i == 0 ? "a" : "b";
            ReferenceHalf& h = reference.halves[i];
            h.sampler = attribute(exr, "koksma:" + prefix + ".sampler");
            h.replicates = std::atoi(attribute(exr, "koksma:" + prefix + ".replicates").c_str());
            h.spp = std::strtoull(attribute(exr, "koksma:" + prefix + ".spp").c_str(), nullptr, 10);
            h.mean = get_planes(exr, prefix + ".mean");
            h.variance = get_planes(exr, prefix + ".variance");
        }
        reference.combine();
        return reference;
    } catch (const Error& e) {
        throw Error(fmt::format("reference {}: {}", file.string(), e.what()));
    }
}

}  // namespace koksma
