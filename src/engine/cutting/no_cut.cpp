// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/no_cut.h"

#include "cutting/locate.h"
#include "words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace femscalpel {
namespace {

/// Parts of an element smaller than this, in the tool's radii, are not searched for it.
constexpr double finest = 0.02;

/// Elements named in a message.
class Named {
public:
    void add(const CellTraits& t, Index id) {
        if (count_++ < 5)
            text_ << (count_ > 1 ? ", " : "") << id << (t.simplex ? "" : " (" + std::string(t.name) + ")");
    }
    bool any() const { return count_ > 0; }
    std::string text() const {
        return (count_ == 1 ? "element " : "elements ") + text_.str() + (count_ > 5 ? ", ..." : "");
    }

private:
    int count_ = 0;
    std::ostringstream text_;
};

/// Looks for a point of an element on the other side of a tool than all its corners.
class InsideSearch {
public:
    InsideSearch(const Mesh& mesh, const Blade& blade) : mesh_(mesh), tool_(*blade.tool), blade_(blade) {}

    bool passes_inside(const CellTraits& t, const Index* n, double side) {
        side_ = side;
        const auto at = [&](int k) -> const Vec3& { return mesh_.points[n[k]]; };
        if (t.dimension == 2)
            return reaches(std::array{at(0), at(1), at(2)}) ||
                   (t.corners == 4 && reaches(std::array{at(0), at(2), at(3)}));
        if (t.simplex) return reaches(std::array{at(0), at(1), at(2), at(3)});
        Vec3 centre = Vec3::Zero();
        for (int k = 0; k < t.corners; ++k) centre += at(k) / t.corners;
        return std::ranges::any_of(t.faces, [&](const auto& f) {
            return reaches(std::array{at(f[0]), at(f[1]), at(f[2]), centre}) ||
                   (f[3] >= 0 && reaches(std::array{at(f[0]), at(f[2]), at(f[3]), centre}));
        });
    }

private:
    template <std::size_t N>
    bool reaches(const std::array<Vec3, N>& corner) const {
        Vec3 centre = Vec3::Zero();
        for (const Vec3& x : corner) centre += x / static_cast<double>(N);
        double radius = 0;
        for (const Vec3& x : corner) radius = std::max(radius, (x - centre).norm());
        const double distance = tool_.distance(centre) * side_;
        if (distance > radius || (blade_.bound && blade_.bound(centre) > radius)) return false;
        if (distance < 0 && !(blade_.bound && blade_.bound(centre) > 0)) return true;
        if (radius < finest * tool_.feature_size()) return false;
        std::size_t a = 0, b = 1;
        for (std::size_t i = 0; i < N; ++i)
            for (std::size_t j = 0; j < i; ++j)
                if ((corner[i] - corner[j]).squaredNorm() > (corner[a] - corner[b]).squaredNorm()) {
                    a = i;
                    b = j;
                }
        std::array<Vec3, N> one = corner, other = corner;
        one[a] = other[b] = (corner[a] + corner[b]) / 2;
        return reaches(one) || reaches(other);
    }

    const Mesh& mesh_;
    const Tool& tool_;
    const Blade& blade_;
    double side_ = 1;
};

double longest_edge(const Mesh& mesh, const CellTraits& t, const Index* n) {
    double longest = 0;
    for (int a = 0; a < t.corners; ++a)
        for (int b = 0; b < a; ++b) longest = std::max(longest, (mesh.points[n[a]] - mesh.points[n[b]]).squaredNorm());
    return std::sqrt(longest);
}

/// What a tool that parts no element's corners meets instead.
struct Survey {
    Named inside, curved, segments;
    double before = std::numeric_limits<double>::infinity(),
           behind = before;  // nearest nodes of elements on either side
};

Survey survey(const Mesh& mesh, const Blade& blade, std::span<const double> distance, double tolerance) {
    Survey out;
    InsideSearch search(mesh, blade);
    const bool bent = std::isfinite(blade.tool->feature_size());
    const auto wanted = [&](const CellTraits& t, const Index* n) {
        return !blade.bound || std::any_of(n, n + t.nodes, [&](Index v) { return blade.bound(mesh.points[v]) <= 0; });
    };
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        const Index* n = b.connectivity.data();
        for (Index c = 0; c < b.size(); ++c, n += t.nodes) {
            double low = std::numeric_limits<double>::infinity(), high = -low;
            for (int k = 0; k < t.corners; ++k) {
                low = std::min(low, distance[n[k]]);
                high = std::max(high, distance[n[k]]);
            }
            if (high > 0) out.before = std::min(out.before, std::max(low, 0.0));
            if (low < 0) out.behind = std::min(out.behind, std::max(-high, 0.0));
            const bool crossed = low < -tolerance && high > tolerance;
            if (t.dimension == 1 && crossed && wanted(t, n)) out.segments.add(t, b.ids[c]);
            if (t.dimension < 2 || crossed) continue;
            const double side = high > tolerance ? 1 : -1;
            if (std::any_of(n + t.corners, n + t.nodes, [&](Index v) { return distance[v] * side < -tolerance; }) &&
                wanted(t, n)) {
                out.curved.add(t, b.ids[c]);
            } else if (bent && std::min(std::abs(low), std::abs(high)) < longest_edge(mesh, t, n) &&
                       search.passes_inside(t, n, side)) {
                out.inside.add(t, b.ids[c]);
            }
        }
    }
    return out;
}

bool coincide(std::vector<Vec3>& a, std::vector<Vec3>& b, double tolerance) {
    const auto key = [](const Vec3& x) { return x[0]; };
    std::ranges::sort(b, {}, key);
    return std::ranges::any_of(a, [&](const Vec3& x) {
        for (auto at = std::ranges::lower_bound(b, x[0] - tolerance, {}, key);
             at != b.end() && (*at)[0] <= x[0] + tolerance; ++at)
            if ((*at - x).norm() <= tolerance) return true;
        return false;
    });
}

}  // namespace

std::string why_missed(const Mesh& mesh, const Blade& blade, std::span<const double> distance, double tolerance,
                       bool beyond) {
    const Survey found = survey(mesh, blade, distance, tolerance);
    const std::string tool = "the " + blade.tool->kind();
    if (found.inside.any())
        return tool + " lies inside " + found.inside.text() +
               ", between their nodes, and parts none of them: it is smaller than the elements there. Refine the mesh "
               "there first";
    if (found.curved.any())
        return tool + " only grazes the mesh: it passes through the curved sides of " + found.curved.text() +
               ", but between none of their corners. Move the " + blade.tool->kind() + " into the material";
    if (beyond)
        return tool + " meets the mesh only outside the part of it that is to cut. Move that part into the material";
    std::ostringstream message;
    message << tool << " misses the mesh: ";
    if (found.segments.any())
        message << "it passes only through segments (" << found.segments.text()
                << "), which cannot be divided (springs, dashpots, gaps, frames)";
    else if (std::isfinite(found.before) && std::isfinite(found.behind))
        message << "it passes between parts of the mesh, through no element; the nearest nodes are at distance "
                << found.behind << " on its negative side and " << found.before << " on its positive side";
    else if (std::isfinite(found.before) || std::isfinite(found.behind))
        message << "the whole mesh lies on its " << (std::isfinite(found.before) ? "positive" : "negative")
                << " side, the nearest node at distance " << std::min(found.before, found.behind);
    else
        message << "it has no elements";
    message << ". Move the " << blade.tool->kind() << " or turn it";
    return message.str();
}

bool lies_inside_elements(const Mesh& mesh, const Blade& blade) {
    std::vector<double> distance;
    distance.reserve(mesh.points.size());
    for (const Vec3& x : mesh.points) distance.push_back(blade.tool->distance(x));
    return survey(mesh, blade, distance, reach_of_rounding(mesh).tolerance).inside.any();
}

bool is_smaller_than_elements(const Workpiece& f, const Tool& tool) {
    if (!std::isfinite(tool.feature_size())) return false;
    const BandMesh& band = f.d.band;
    const double near = 10 * f.tolerance + tool.feature_size();
    for (int v = 0; v < band.size(); ++v)
        if (band.in_use(v) && std::abs(tool.distance(band.nodes[v].at)) <= near &&
            band.mean_edge_length(v) > tool.feature_size())
            return true;
    return false;
}

std::string why_too_small(const Tool& tool) {
    return "the " + tool.kind() +
           " is smaller than the elements there, and parts none of them. Refine the mesh there first, or move the " +
           tool.kind() + " into the material";
}

std::string why_nothing_parts(const Workpiece& f, const Blade& blade, const std::string& otherwise) {
    const BandMesh& band = f.d.band;
    std::vector<Vec3> behind, before;  // nodes of faces, and edges of shells, on the tool
    int shells = 0;
    const auto look = [&](const auto& nodes_of, bool shell) {
        std::vector<int> on;
        double side = 0;
        for (const int v : nodes_of) {
            if (f.distance[v] == 0 && !(blade.bound && blade.bound(band.nodes[v].at) > f.tolerance))
                on.push_back(v);
            else
                side = f.distance[v];
        }
        if (on.size() == nodes_of.size()) shells += shell;
        if (on.size() + 1 != nodes_of.size() || side == 0) return;
        for (const int v : on) (side < 0 ? behind : before).push_back(band.nodes[v].at);
    };
    for (int t = 0; t < band.tetras.size(); ++t)
        if (band.tetras.alive(t)) look(band.tetras[t], false);
    for (int t = 0; t < band.triangles.size(); ++t)
        if (band.triangles.alive(t) && f.d.constraints.is_shell(band.triangles.origin(t)))
            look(band.triangles[t], true);
    const std::string tool = "the " + blade.tool->kind();
    const std::string advice = ". Move the " + blade.tool->kind() + " into the material";
    if (!behind.empty() && !before.empty() && coincide(behind, before, 10 * f.tolerance))
        return tool +
               " lies on faces that are open already: the elements on its two sides have nodes of their own there (a "
               "contact, or an earlier crack), and there is "
               "nothing to part" +
               advice;
    if (shells > 0)
        return counted(shells, "shell element lies", "shell elements lie") + " in the " + blade.tool->kind() +
               ", and nothing stands on them that it could part from them" + advice;
    if (is_smaller_than_elements(f, *blade.tool)) return why_too_small(*blade.tool);
    if (!behind.empty() || !before.empty()) {
        const std::string side = before.empty()   ? "all elements there are on its negative side"
                                 : behind.empty() ? "all elements there are on its positive side"
                                                  : "wherever it does, the elements are on one side of it only";
        return tool + " only touches the mesh, on its outside: " + side + ", and there is nothing to part" + advice;
    }
    return otherwise;
}

}  // namespace femscalpel
