// Makes samplers/data/lattice_cbc18.inc: the generating vector of an extensible rank-1 lattice in base 2, for 2^4 to 2^18 points.
//
//   g++ -std=c++20 -O2 samplers/tools/make_lattice.cpp -o make_lattice && ./make_lattice > samplers/data/lattice_cbc18.inc
//
// Component by component, each the best of kCandidates odd numbers below 2^18 drawn at random. The criterion is after Cools,
// Kuo and Nuyens 2006, "Constructing embedded lattice rules for multivariate integration", SIAM J. Sci. Comput. 28(6): the
// least value of the largest ratio, over m, of the squared worst-case error with 2^m points to the least at this m (here: the
// least of the candidates). The error is the shift-averaged one of the unanchored Sobolev space, with kernel B2(x) = x^2 - x +
// 1/6 (Dick, Kuo and Sloan 2013, "High-dimensional integration: the quasi-Monte Carlo way", Acta Numerica 22), and weights that
// are products of 1/sqrt(j) over up to three dimensions j, zero for more: interactions of low order matter in rendering,
// between late dimensions too; hence no steeper decay.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace {

constexpr int kFirst = 4, kLast = 18, kDimensions = 256, kCandidates = 2048;
constexpr std::uint32_t kPoints = 1u << kLast;

std::uint64_t next(std::uint64_t& state) {  // SplitMix64
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

}  // namespace

int main() {
    std::vector<float> kernel(kPoints);  // B2(k / N)
    for (std::uint32_t k = 0; k < kPoints; ++k) {
        const double x = static_cast<double>(k) / kPoints;
        kernel[k] = static_cast<float>(x * x - x + 1.0 / 6);
    }
    // Elementary symmetric sums of the weighted kernels at point k of the dimensions so far, orders 1 and 2. k and N - k are equal.
    constexpr std::uint32_t kHalf = kPoints / 2 + 1;
    std::vector<float> one(kHalf, 0), two(kHalf, 0), weight(kHalf);
    std::vector<double> error(kLast + 1, 0);  // sum over the kernel's terms with N = 2^m, so far
    std::uint64_t state = 2006;
    std::printf("// Made by make_lattice.cpp: an embedded lattice for 2^%d to 2^%d points.\n", kFirst, kLast);
    for (int d = 0, column = 0; d < kDimensions; ++d) {
        const double gamma = 1 / std::sqrt(d + 1.0);
        for (std::uint32_t k = 0; k < kHalf; ++k) weight[k] = static_cast<float>(gamma) * (1 + one[k] + two[k]);
        std::vector<std::uint32_t> candidates{1};
        while (d > 0 && candidates.size() < kCandidates + 1) candidates.push_back(static_cast<std::uint32_t>(next(state) % kPoints) | 1u);
        if (d > 0) candidates.erase(candidates.begin());
        // added[c][m]: what candidate c adds to the squared error with 2^m points, those k that are multiples of 2^(18-m).
        std::vector<std::vector<double>> added(candidates.size(), std::vector<double>(kLast + 1));
        std::vector<double> least(kLast + 1, 1e300);
        for (std::size_t c = 0; c < candidates.size(); ++c) {
            std::vector<double>& sum = added[c];
            const std::uint32_t z = candidates[c];
            double running = 0;
            for (int m = 0; m <= kLast; ++m) {
                const std::uint32_t step = kPoints >> m;
                if (m == 0) running = weight[0] * kernel[0];
                if (m == 1) running += weight[kPoints / 2] * kernel[(kPoints / 2) * z & (kPoints - 1)];
                double fresh = 0;
                if (m >= 2)
                    for (std::uint32_t k = step; k < kPoints / 2; k += 2 * step) fresh += weight[k] * kernel[k * z & (kPoints - 1)];
                running += 2 * fresh;
                sum[m] = running / static_cast<double>(1u << m);
                least[m] = std::min(least[m], error[m] + sum[m]);
            }
        }
        std::size_t best = 0;
        double best_ratio = 1e300;
        for (std::size_t c = 0; c < candidates.size(); ++c) {
            double ratio = 0;
            for (int m = kFirst; m <= kLast; ++m) ratio = std::max(ratio, (error[m] + added[c][m]) / least[m]);
            if (ratio < best_ratio) {
                best_ratio = ratio;
                best = c;
            }
        }
        for (int m = 0; m <= kLast; ++m) error[m] += added[best][m];
        for (std::uint32_t k = 0; k < kHalf; ++k) {
            const float w = static_cast<float>(gamma) * kernel[k * candidates[best] & (kPoints - 1)];
            two[k] += w * one[k];
            one[k] += w;
        }
        if (d < 8 || d % 32 == 31) std::fprintf(stderr, "dimension %d: z = %u, ratio %.3f\n", d, candidates[best], best_ratio);
        column += std::printf("%u,", candidates[best]);
        if (column > 118) column = (std::printf("\n"), 0);
    }
    std::printf("\n");
}
