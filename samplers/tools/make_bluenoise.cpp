// make_bluenoise: chooses the keys of a tile for the sampler `bluenoise`, by simulated annealing.
//
// The estimates of two pixels with keys a, b see the same Sobol' points under digital shifts a and b and one Owen scramble.
// Their covariance over scrambles depends on a ^ b alone. By the gain of nested scrambling (Owen 1997, "Monte Carlo variance
// of scrambled net quadrature"), with variance rho^k1 rho^k2 of the integrand at levels (k1, k2) and the N = 2^m first points,
//     K_m(a ^ b) = 1/N sum_i A(x_i ^ a_x ^ b_x) A(y_i ^ a_y ^ b_y) - 1,   A(z) = sum_{k <= l} rho^k - rho^(l+1),
// l the number of leading zeros of z. Linearity makes the double sum over both points a single one.
// The sum of squares of the image of errors after a Gaussian filter of deviation sigma is, up to a constant,
//     E = sum over pairs of pixels of exp(-distance^2 / (4 sigma^2)) sum_m K_m / K_m(0),
// the m being log2(least), .. log2(samples). E is what is minimised: one key at a time is redrawn, or has one digit flipped.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace {

/// Dimension 1 of the Sobol' sequence, bit-reversed: Pascal's triangle modulo 2. Dimension 0 is the index itself.
constexpr std::uint32_t second_rev(std::uint32_t index) {
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    return index ^ (index >> 16);
}

/// sum_m K_m(d) / K_m(0), indexed by d_x | d_y << digits.
std::vector<float> make_kernel(std::uint32_t digits, std::uint32_t least, std::uint32_t samples, double rho) {
    const auto levels = static_cast<std::size_t>(digits);
    std::vector<double> agree(levels + 1);  // A for l = 0 .. digits - 1; then all digits agree, and the rest are random
    double sum = 1, power = 1;
    for (std::size_t l = 0; l <= levels; ++l) {
        agree[l] = l == levels ? sum : sum - power * rho;
        power *= rho;
        sum += power;
    }
    const double self = 1 / (1 - rho);
    std::vector<double> weight(samples, 0.0);  // of point i: sum over the counts that have it
    double constant = 0;
    for (std::uint32_t n = least; n <= samples; n *= 2) {
        double variance = self * self;
        for (std::uint32_t i = 1; i < n; ++i)
            variance += agree[std::min<std::size_t>(levels, static_cast<std::size_t>(std::countr_zero(i)))] *
                        agree[std::min<std::size_t>(levels, static_cast<std::size_t>(std::countr_zero(second_rev(i))))];
        variance = variance / n - 1;
        constant += 1 / variance;
        for (std::uint32_t i = 0; i < n; ++i) weight[i] += 1 / (n * variance);
    }
    const std::uint32_t side = 1u << digits;
    std::vector<float> kernel(std::size_t{side} * side);
    const auto level = [&](std::uint32_t z) { return std::min<std::size_t>(levels, static_cast<std::size_t>(std::countr_zero(z))); };
    for (std::uint32_t dy = 0; dy < side; ++dy)
        for (std::uint32_t dx = 0; dx < side; ++dx) {
            double k = -constant;
            for (std::uint32_t i = 0; i < samples; ++i)
                k += weight[i] * agree[level(i ^ dx)] * agree[level(second_rev(i) ^ dy)];
            kernel[dx | (dy << digits)] = static_cast<float>(k);
        }
    return kernel;
}

struct Neighbour {
    std::uint32_t dx, dy;  // modulo the tile
    float weight;
};

class Annealer {
public:
    Annealer(std::uint32_t side, std::uint32_t digits, std::uint32_t least, std::uint32_t samples, double sigma, double rho, std::uint64_t seed)
        : side_(side), digits_(digits), kernel_(make_kernel(digits, least, samples, rho)), random_(seed), keys_(std::size_t{side} * side) {
        const int radius = std::min(static_cast<int>(std::ceil(4 * sigma)), static_cast<int>(side / 2) - 1);
        for (int y = -radius; y <= radius; ++y)
            for (int x = -radius; x <= radius; ++x)
                if (x != 0 || y != 0)
                    around_.push_back({static_cast<std::uint32_t>(x) & (side - 1), static_cast<std::uint32_t>(y) & (side - 1),
                                       static_cast<float>(std::exp(-(x * x + y * y) / (4 * sigma * sigma)))});
        for (std::uint32_t& k : keys_) k = draw() & mask();
    }

    /// Energy per pixel.
    [[nodiscard]] double energy() const {
        double sum = 0;
        for (std::uint32_t p = 0; p < keys_.size(); ++p) sum += local(p, keys_[p]);
        return sum / 2 / static_cast<double>(keys_.size());
    }

    void run(std::uint32_t sweeps) {
        constexpr double kHot = 2.0, kCold = 0.005;  // energies of one pixel are of order 1
        for (std::uint32_t sweep = 0; sweep < sweeps; ++sweep) {
            const double temperature = kHot * std::pow(kCold / kHot, sweep / (sweeps - 1.0));
            for (std::size_t step = 0; step < keys_.size(); ++step) {
                const std::uint32_t bits = draw(), p = draw() & static_cast<std::uint32_t>(keys_.size() - 1);
                const std::uint32_t changed = bits & 1u ? (bits >> 1) & mask() : keys_[p] ^ (1u << ((bits >> 1) % (2 * digits_)));
                const double change = local(p, changed) - local(p, keys_[p]);
                if (change <= 0 || std::exp(-change / temperature) * 0x1p32 > draw()) keys_[p] = changed;
            }
        }
    }

    /// The key of a pixel as the sampler stores it.
    [[nodiscard]] std::uint32_t key(std::size_t p) const { return (keys_[p] & ((1u << digits_) - 1)) | ((keys_[p] >> digits_) << 16); }
    [[nodiscard]] std::size_t size() const { return keys_.size(); }

private:
    [[nodiscard]] std::uint32_t draw() { return static_cast<std::uint32_t>(random_() >> 32); }
    [[nodiscard]] std::uint32_t mask() const { return (1u << (2 * digits_)) - 1; }
    [[nodiscard]] double local(std::uint32_t p, std::uint32_t key) const {
        const std::uint32_t x = p & (side_ - 1), y = p / side_;
        float sum = 0;
        for (const Neighbour& n : around_)
            sum += n.weight * kernel_[key ^ keys_[((y + n.dy) & (side_ - 1)) * side_ + ((x + n.dx) & (side_ - 1))]];
        return sum;
    }
    std::uint32_t side_, digits_;
    std::vector<float> kernel_;
    std::mt19937_64 random_;
    std::vector<std::uint32_t> keys_;
    std::vector<Neighbour> around_;
};

[[noreturn]] void usage(const std::string& problem) {
    std::fprintf(stderr, "%s\nusage: make_bluenoise FILE [side=64] [layers=1] [digits=10] [least=1] [samples=64] [sigma=1] [rho=0.5] [sweeps=2000] [seed=1]\n",
                 problem.c_str());
    std::exit(2);
}

}  // namespace

int main(int argc, char** argv) {
    std::map<std::string, double> option{{"side", 64}, {"layers", 1}, {"digits", 10}, {"least", 1}, {"samples", 64}, {"sigma", 1}, {"rho", 0.5}, {"sweeps", 2000}, {"seed", 1}};
    if (argc < 2) usage("no file is named");
    for (int i = 2; i < argc; ++i) {
        const std::string given = argv[i];
        const auto equals = given.find('=');
        char* end = nullptr;
        const double value = equals == std::string::npos ? 0 : std::strtod(argv[i] + equals + 1, &end);
        if (!option.contains(given.substr(0, equals)) || end == nullptr || *end != 0) usage("'" + given + "' is not understood");
        option[given.substr(0, equals)] = value;
    }
    const auto whole = [&](const char* name, std::uint32_t least, std::uint32_t most) {
        const double v = option[name];
        if (!(v >= least && v <= most) || v != std::floor(v)) usage(std::string(name) + " is a whole number from " + std::to_string(least) + " to " + std::to_string(most));
        return static_cast<std::uint32_t>(v);
    };
    const std::uint32_t side = whole("side", 4, 1024), layers = whole("layers", 1, 64), digits = whole("digits", 1, 12),
                        samples = whole("samples", 1, 4096), least = whole("least", 1, samples), sweeps = whole("sweeps", 2, 1000000), seed = whole("seed", 0, 0xffffffffu);
    const double sigma = option["sigma"], rho = option["rho"];
    if (!std::has_single_bit(side) || !std::has_single_bit(samples) || !std::has_single_bit(least)) usage("side, least and samples are powers of two");
    if (!(sigma > 0 && rho > 0 && rho < 1)) usage("sigma is positive, rho between 0 and 1");

    std::ofstream out(argv[1]);
    if (!out) usage(std::string(argv[1]) + " cannot be written");
    out << "// Made by make_bluenoise side=" << side << " layers=" << layers << " digits=" << digits << " least=" << least << " samples=" << samples << " sigma=" << sigma
        << " rho=" << rho << " sweeps=" << sweeps << " seed=" << seed
        << "\n// version, width, height, layers, digits, samples; then a key a pixel, rows from the top\n1," << side << "," << side << "," << layers << ","
        << digits << "," << samples << ",";
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
        Annealer annealer(side, digits, least, samples, sigma, rho, (std::uint64_t{seed} << 32) | layer);
        const double before = annealer.energy();
        annealer.run(sweeps);
        std::printf("layer %u: energy a pixel %.4f, random keys %.4f\n", layer, annealer.energy(), before);
        for (std::size_t p = 0; p < annealer.size(); ++p) out << (p % 16 == 0 ? "\n" : "") << annealer.key(p) << ",";
    }
    out << "\n";
    out.close();
    if (!out) usage(std::string(argv[1]) + " could not be written to its end");
    return 0;
}
