// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/refine_estimate.h"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "cancel.h"

namespace femscalpel {
namespace {

/// How many more elements are made than if each were bisected alone: an edge is only bisected with all elements around
/// it, of which some would not have needed it. Half the refinements of the test meshes have more than 0.11,
/// four in five 0.03 to 0.4; few elements at a point up to 1.4, which then are few.
constexpr double followers = 0.15;

/// Counts what elements are bisected into, up to a limit.
class Counter {
public:
    Counter(const SizeField& field, double limit) : field_(field), limit_(limit) {}

    /// Adds the parts of a simplex with `Corners` corners beyond the one that it is.
    template <std::size_t Corners>
    void add(const std::array<Vec3, Corners>& at, const std::array<double, Corners>& distance) {
        check_();
        if (is_full()) return;
        std::size_t a = 0, b = 1;
        double longest = -1;
        bool is_long = false;
        for (std::size_t i = 0; i < Corners; ++i)
            for (std::size_t j = i + 1; j < Corners; ++j) {
                const double length = (at[i] - at[j]).squaredNorm();
                is_long = is_long || field_.exceeded(at[i], at[j], distance[i], distance[j]);
                if (length <= longest) continue;
                longest = length;
                a = i;
                b = j;
            }
        if (!is_long) return;
        more_ += 1;
        const Vec3 middle = (at[a] + at[b]) / 2;
        // Below the digits of its coordinates an edge has no middle.
        if (middle == at[a] || middle == at[b]) return;
        const double of_middle = field_.distance(middle);
        for (const std::size_t end : {a, b}) {
            auto part = at;
            auto part_distance = distance;
            part[end] = middle;
            part_distance[end] = of_middle;
            add(part, part_distance);
        }
    }

    bool is_full() const { return more_ > limit_; }
    double more() const { return more_; }

private:
    const SizeField& field_;
    const double limit_;
    double more_ = 0;
    SparseCheck check_{1024};
};

template <std::size_t Corners>
void add_block(const Mesh& mesh, const CellBlock& block, const std::vector<double>& distance, Counter& counter) {
    for (Index c = 0; c < block.size() && !counter.is_full(); ++c) {
        std::array<Vec3, Corners> at;
        std::array<double, Corners> off;
        const auto nodes = block.nodes(c);
        for (std::size_t k = 0; k < Corners; ++k) {
            at[k] = mesh.points[nodes[k]];
            off[k] = distance[nodes[k]];
        }
        counter.add(at, off);
    }
}

/// The next length of two digits that is not smaller.
double rounded_up(double length) {
    if (!(length > 0) || !std::isfinite(length)) return length;
    const double digit = std::pow(10.0, std::floor(std::log10(length)) - 1);
    return std::ceil(length / digit * (1 - 1e-9)) * digit;
}

}  // namespace

Index count_refined(const Mesh& mesh, const SizeField& field, Index limit) {
    const Index before = mesh.cell_count();
    if (before > limit) return limit + 1;
    std::vector<double> distance(mesh.points.size());
    SparseCheck check(256);
    for (std::size_t n = 0; n < distance.size(); ++n, check()) distance[n] = field.distance(mesh.points[n]);
    Counter counter(field, static_cast<double>(limit - before));
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (!t.simplex) continue;
        if (t.dimension == 3) add_block<4>(mesh, b, distance, counter);
        if (t.dimension == 2) add_block<3>(mesh, b, distance, counter);
    }
    return counter.is_full() ? limit + 1 : before + static_cast<Index>(std::llround(counter.more()));
}

Index with_followers(Index before, Index counted) {
    return counted + std::llround(followers * static_cast<double>(counted - before));
}

double RefinementEstimate::size_for(Index most) const {
    if (!count || !*count) throw std::logic_error("the refinement was decided on; ask before it is");
    if (elements_before > most) return std::numeric_limits<double>::infinity();
    const Index limit =
        elements_before + static_cast<Index>(static_cast<double>(most - elements_before) / (1 + followers));
    double low = size, high = size;
    constexpr int doublings = 60;  // far beyond any mesh's length
    int k = 0;
    for (; k < doublings && (*count)(high, limit) > limit; ++k) {
        low = high;
        high *= 2;
    }
    if (k == doublings) return std::numeric_limits<double>::infinity();
    while (high > 1.08 * low) {
        const double middle = std::sqrt(low * high);
        ((*count)(middle, limit) > limit ? low : high) = middle;
    }
    return rounded_up(high);
}

}  // namespace femscalpel
