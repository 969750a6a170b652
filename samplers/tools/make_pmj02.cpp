// Makes samplers/data/pmj02_best.inc: tables of progressive multi-jittered (0,2) samples with best candidates.
//
//   g++ -std=c++20 -O2 samplers/tools/make_pmj02.cpp -o make_pmj02 && ./make_pmj02 > samplers/data/pmj02_best.inc
//
// Source: Christensen, Kensler and Kilpatrick 2018, "Progressive multi-jittered sample sequences", Computer Graphics Forum
// 37(4): pmj02, with best candidates. The first 2^m points of a table, for every m, put one point into each elementary interval of
// area 2^-m. Of kCandidates random places that this leaves for a point, it takes the one farthest from all points before (on the
// torus). Coordinates have 16 bits.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

constexpr int kTables = 8, kLog2Points = 12, kCandidates = 64, kBits = 16;

struct Random {  // SplitMix64
    std::uint64_t state;
    std::uint64_t operator()() {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(((*this)() >> 32) * n >> 32); }
};

struct Point {
    std::uint32_t x, y;
};

/// Which elementary intervals of area 2^-m hold a point.
class Occupied {
public:
    explicit Occupied(int m) : m_(m), taken_(static_cast<std::size_t>(m + 1) << m) {}
    bool free(Point p) const {
        for (int a = 0; a <= m_; ++a)
            if (taken_[at(p, a)]) return false;
        return true;
    }
    void add(Point p) {
        for (int a = 0; a <= m_; ++a) taken_[at(p, a)] = true;
    }

private:
    std::size_t at(Point p, int a) const {
        return (static_cast<std::size_t>(a) << m_) + ((p.x >> (kBits - a)) << (m_ - a)) + (p.y >> (kBits - (m_ - a)));
    }
    int m_;
    std::vector<bool> taken_;
};

std::int64_t squared_distance(Point a, Point b) {
    const auto torus = [](std::uint32_t u, std::uint32_t v) {
        const std::int64_t d = std::abs(static_cast<std::int64_t>(u) - static_cast<std::int64_t>(v));
        return std::min(d, (std::int64_t{1} << kBits) - d);
    };
    const std::int64_t x = torus(a.x, b.x), y = torus(a.y, b.y);
    return x * x + y * y;
}

/// Appends the best of the free places in a square, or returns false if there is none.
/// @param corner,log2_side  the square: where elementary intervals of area 2^-m are 2^-m wide, it is 2^-log2_side wide
bool add_in_square(std::vector<Point>& points, Occupied& occupied, Point corner, int log2_side, int m, Random& random) {
    std::vector<Point> places;
    const std::uint32_t step = 1u << (kBits - m), count = 1u << (m - log2_side);
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t j = 0; j < count; ++j)
            if (const Point p{corner.x + i * step, corner.y + j * step}; occupied.free(p)) places.push_back(p);
    if (places.empty()) return false;
    Point best{};
    std::int64_t best_distance = -1;
    for (int c = 0; c < kCandidates; ++c) {
        Point p = places[random.below(static_cast<std::uint32_t>(places.size()))];
        p.x += random.below(step);
        p.y += random.below(step);
        std::int64_t nearest = std::int64_t{1} << 40;
        for (const Point& q : points) nearest = std::min(nearest, squared_distance(p, q));
        if (nearest > best_distance) {
            best_distance = nearest;
            best = p;
        }
    }
    occupied.add(best);
    points.push_back(best);
    return true;
}

/// From 4^k to 2 * 4^k points: a point goes into the quadrant diagonally opposite to that of each point before, within the
/// cell of the 2^k x 2^k grid. From there to 4^(k+1): into the two quadrants that are left, one after the other.
bool extend(std::vector<Point>& points, int m, Random& random) {
    const bool diagonal = m % 2 == 1;
    const int k = (m - 1) / 2, log2_quadrant = k + 1;
    const std::size_t cells = std::size_t{1} << (2 * k);
    Occupied occupied(m);
    for (const Point& p : points) occupied.add(p);
    const std::uint32_t half = 1u << (kBits - log2_quadrant);
    const auto corner = [&](Point p, std::uint32_t flip_x, std::uint32_t flip_y) {
        return Point{((p.x / half) ^ flip_x) * half, ((p.y / half) ^ flip_y) * half};
    };
    std::vector<std::uint32_t> flip(cells, 1);
    if (diagonal) {
        for (std::size_t j = 0; j < cells; ++j)
            if (!add_in_square(points, occupied, corner(points[j], 1, 1), log2_quadrant, m, random)) return false;
        return true;
    }
    for (std::size_t j = 0; j < cells; ++j) {
        flip[j] = random.below(2);
        if (add_in_square(points, occupied, corner(points[j], flip[j], flip[j] ^ 1u), log2_quadrant, m, random)) continue;
        flip[j] ^= 1u;
        if (!add_in_square(points, occupied, corner(points[j], flip[j], flip[j] ^ 1u), log2_quadrant, m, random)) return false;
    }
    for (std::size_t j = 0; j < cells; ++j)
        if (!add_in_square(points, occupied, corner(points[j], flip[j] ^ 1u, flip[j]), log2_quadrant, m, random)) return false;
    return true;
}

std::vector<Point> make_table(Random& random) {
    std::vector<Point> points{{random.below(1u << kBits), random.below(1u << kBits)}};
    for (int m = 1; m <= kLog2Points;) {
        std::vector<Point> longer = points;
        int tries = 1;
        for (; !extend(longer, m, random); ++tries) longer = points;  // a choice of quadrants may leave no place: choose again
        std::fprintf(stderr, "2^%d points after %d tries\n", m, tries);
        points = longer;
        ++m;
    }
    return points;
}

}  // namespace

int main() {
    std::printf("// Made by make_pmj02.cpp: %d tables of %d points, x and y in units of 2^-%d.\n", kTables, 1 << kLog2Points, kBits);
    Random random{2018};
    int column = 0;
    for (int t = 0; t < kTables; ++t)
        for (const Point& p : make_table(random)) {
            column += std::printf("%u,%u,", p.x, p.y);
            if (column > 118) column = (std::printf("\n"), 0);
        }
    std::printf("\n");
}
