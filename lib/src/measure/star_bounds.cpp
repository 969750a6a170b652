#include <koksma/measure/point_set.h>

#include <koksma/sampling/error.h>

#include <algorithm>
#include <queue>
#include <string>
#include <vector>

namespace koksma {

namespace {

/// All boxes [0, z) with low <= z <= high.
struct Bracket {
    std::vector<double> low, high;
    double most = 0;  ///< no box of it has a larger discrepancy
    friend bool operator<(const Bracket& a, const Bracket& b) noexcept { return a.most < b.most; }
};

class Search {
public:
    explicit Search(const PointSet& points) : points_(points), coordinates_(points.dimensions) {
        for (std::size_t d = 0; d < points.dimensions; ++d) {
            for (std::size_t i = 0; i < points.size(); ++i) coordinates_[d].push_back(points[i][d]);
            std::sort(coordinates_[d].begin(), coordinates_[d].end());
        }
        push({std::vector<double>(points.dimensions, 0.0), std::vector<double>(points.dimensions, 1.0)});
    }
    StarBounds run(std::size_t boxes) {
        for (std::size_t n = 0; n < boxes && !queue_.empty() && queue_.top().most > found_; ++n) {
            const Bracket widest = queue_.top();
            queue_.pop();
            split(widest);
        }
        return {found_, queue_.empty() ? found_ : std::max(found_, queue_.top().most)};
    }

private:
    static double volume(const std::vector<double>& z) noexcept {
        double v = 1;
        for (const double x : z) v *= x;
        return v;
    }
    [[nodiscard]] double share(const std::vector<double>& z, bool closed) const noexcept {
        std::size_t inside = 0;
        for (std::size_t i = 0; i < points_.size(); ++i) {
            bool in = true;
            for (std::size_t d = 0; in && d < z.size(); ++d) in = closed ? points_[i][d] <= z[d] : points_[i][d] < z[d];
            inside += in;
        }
        return static_cast<double>(inside) / static_cast<double>(points_.size());
    }
    /// Discrepancies near a corner: the smallest closed and the largest open box with as many points.
    void look_at(const std::vector<double>& z, double closed, double open) {
        std::vector<double> least = z, largest = z;
        for (std::size_t d = 0; d < z.size(); ++d) {
            const std::vector<double>& c = coordinates_[d];
            const auto above = std::upper_bound(c.begin(), c.end(), z[d]);
            least[d] = above == c.begin() ? 0.0 : *(above - 1);
            const auto next = std::lower_bound(c.begin(), c.end(), z[d]);
            largest[d] = next == c.end() ? 1.0 : *next;
        }
        found_ = std::max({found_, closed - volume(least), volume(largest) - open});
    }
    void push(Bracket b) {
        const double closed = share(b.high, true), open = share(b.low, false);
        look_at(b.high, closed, share(b.high, false));
        b.most = std::max(closed - volume(b.low), volume(b.high) - open);
        if (b.most > found_) queue_.push(std::move(b));
    }
    /// In half, along the side that its volume depends on most.
    void split(const Bracket& b) {
        std::size_t along = 0;
        const auto weight = [&](std::size_t d) { return std::pair(1.0 - b.low[d] / b.high[d], b.high[d] - b.low[d]); };
        for (std::size_t d = 1; d < b.low.size(); ++d)
            if (weight(d) > weight(along)) along = d;
        const double middle = 0.5 * (b.low[along] + b.high[along]);
        if (!(b.low[along] < middle && middle < b.high[along])) return;
        Bracket lower = b, upper = b;
        lower.high[along] = upper.low[along] = middle;
        push(std::move(lower));
        push(std::move(upper));
    }
    PointSet points_;
    std::vector<std::vector<double>> coordinates_;
    std::priority_queue<Bracket> queue_{};
    double found_ = 0;
};

}  // namespace

StarBounds star_discrepancy_bounds(const PointSet& points, std::size_t boxes) {
    if (points.size() == 0 || points.dimensions == 0) throw Error("a star discrepancy is of one point or more; there are none");
    return Search(points).run(boxes);
}

}  // namespace koksma
