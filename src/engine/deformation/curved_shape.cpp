// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/curved_shape.h"

#include <algorithm>

#include "mesh/cell_type.h"

namespace femscalpel {
namespace {

/// What an edge is on, and how it bulges.
struct EdgeShape {
    NodeConstraint constraint;
    Contact tools;
    Vec3 bulge;
    double held;  ///< how far it may be off the tools, as its ends are: Deformable::held_off
};

MidSide fit(const Deformable& d, const Vec3& a, const Vec3& b, const EdgeShape& shape) {
    const Vec3 chord = (a + b) / 2;
    MidSide mid{chord + shape.bulge, true};
    const bool curved_tool = std::ranges::any_of(shape.tools.tools(), [](const Tool* t) { return std::isfinite(t->feature_size()); });
    if (shape.bulge.isZero(0) && !curved_tool && d.constraints.is_straight(shape.constraint)) return mid;
    const double reach = 0.2 * (b - a).norm();
    Vec3 x = mid.at;
    if (d.constraints.project(shape.constraint, shape.tools, x, shape.held) && (x - chord).norm() < reach) {
        mid.at = x;
        return mid;
    }
    const double close = 1e-9 * (b - a).norm();
    if (shape.held > 0 && Deformable::off_tools(shape.tools, mid.at, shape.held) <= close && d.constraints.distance(shape.constraint, mid.at) <= std::max(close, d.rounding))
        return mid;
    // On its tools at least, for the lips; whoever made the edge has to look for another.
    mid.fits = false;
    x = chord;
    if (shape.tools && d.constraints.project(NodeConstraint{}, shape.tools, x) && (x - chord).norm() < reach) mid.at = x;
    else mid.at = chord;
    return mid;
}

/// Whether elements of both sides of the barrier share the edge a-b.
bool is_between_sides(const Deformable& d, int a, int b) {
    bool positive = false, negative = false;
    const auto look = [&](const auto& list) {
        for (const int s : list.around(a))
            if (std::ranges::find(list[s], b) != list[s].end())
                for (const int v : list[s]) (d.side[v] > 0 ? positive : negative) |= d.side[v] != 0;
    };
    look(d.band.tetras);
    look(d.band.triangles);
    return positive && negative;
}

EdgeShape shape_of(const Deformable& d, int a, int b) {
    return {d.constraints.on_edge(d.band, a, b), edge_tools(d, a, b), d.mids.bulge(a, b), d.held_between(a, b)};
}

bool is_second_order(const Deformable& d, int tetra) { return d.band.tetra_cells[d.band.tetras.origin(tetra)].type == CellType::tetra10; }

/// curved_ratio() of the tetrahedron with these corners, or 1 if it is straight, -1 if a mid-side node does not fit.
/// `mid(k)`: of edge k.
double ratio(const std::array<Vec3, 4>& corner, auto mid) {
    std::array<Vec3, 10> x;
    std::ranges::copy(corner, x.begin());
    bool straight = true;
    const auto& edges = traits(CellType::tetra10).edges;
    for (std::size_t k = 0; k < edges.size(); ++k) {
        const int i = edges[k][0], j = edges[k][1];
        const MidSide m = mid(k);
        if (!m.fits) return -1;
        x[4 + k] = m.at;
        straight = straight && m.at == (corner[i] + corner[j]) / 2;
    }
    return straight ? 1 : curved_ratio(x);
}

/// For ratio(), from a function of the places of an edge's ends among the corners.
auto by_ends(auto mid) {
    return [mid](std::size_t k) {
        const auto& e = traits(CellType::tetra10).edges[k];
        return mid(e[0], e[1]);
    };
}

}  // namespace

Contact edge_tools(const Deformable& d, int a, int b) {
    const Contact tools = d.edge_contact(a, b);
    if (!tools.has(d.barrier) || d.constraints.is_straight(d.constraints.on_edge(d.band, a, b)) || is_between_sides(d, a, b)) return tools;
    return tools.without(d.barrier);
}

MidSide mid_side(const Deformable& d, int a, int b) {
    const BandNode &na = d.band.nodes[a], &nb = d.band.nodes[b];
    const bool untouched = !d.band.is_new(a) && !d.band.is_new(b) && na.at == na.start && nb.at == nb.start;
    if (untouched && !d.contact[a].common(d.contact[b])) return {(na.at + nb.at) / 2 + d.mids.bulge(a, b), true};
    return fit(d, na.at, nb.at, shape_of(d, a, b));
}

CurvedStar::CurvedStar(Deformable& d, int node) : d_(d), node_(node) {}

void CurvedStar::gather() {
    gathered_ = true;
    if (!d_.mids.any()) return;
    std::vector<std::uint64_t> across;
    const auto place = [](auto& list, const auto& wanted) {
        const auto it = std::ranges::find(list, wanted);
        if (it != list.end()) return static_cast<int>(it - list.begin());
        list.push_back(wanted);
        return static_cast<int>(list.size()) - 1;
    };
    const auto& edges = traits(CellType::tetra10).edges;
    for (const int t : d_.band.tetras.around(node_)) {
        if (!is_second_order(d_, t)) continue;
        Element e{d_.band.tetras[t], {}};
        for (std::size_t k = 0; k < edges.size(); ++k) {
            const int a = e.corner[edges[k][0]], b = e.corner[edges[k][1]];
            e.mid[k] = a == node_ || b == node_ ? place(spokes_, a == node_ ? b : a) : -1 - place(across, edge_key(a, b));
        }
        elements_.push_back(e);
    }
    mids_.resize(spokes_.size());
    found_.resize(spokes_.size());
    for (const std::uint64_t key : across) mids_.push_back(mid_side(d_, static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu)));
    for (Element& e : elements_)
        for (int& m : e.mid)
            if (m < 0) m = static_cast<int>(spokes_.size()) - 1 - m;
}

double CurvedStar::worst(const Vec3& x, double enough) {
    if (!gathered_) gather();
    if (elements_.empty()) return 1;
    Vec3& at = d_.band.nodes[node_].at;
    const Vec3 home = at;
    at = x;
    std::ranges::fill(found_, 0);
    double worst = 1;
    for (std::size_t i = 0; i < elements_.size() && worst >= enough; ++i) {
        const Element& e = elements_[i];
        std::array<Vec3, 4> corner;
        for (int k = 0; k < 4; ++k) corner[k] = d_.band.nodes[e.corner[k]].at;
        worst = std::min(worst, ratio(corner, [&](std::size_t k) {
            const auto m = static_cast<std::size_t>(e.mid[k]);
            if (m < found_.size() && !found_[m]) {
                found_[m] = 1;
                mids_[m] = mid_side(d_, node_, spokes_[m]);
            }
            return mids_[m];
        }));
        // It is likely to be the one that fails at the next place, too.
        if (worst < enough) std::swap(elements_[0], elements_[i]);
    }
    at = home;
    return worst;
}

bool CurvedStar::stays_sound(const Vec3& x) {
    if (worst(x, curved_limit) >= curved_limit) return true;
    const Vec3& home = d_.band.nodes[node_].at;
    if (!home_ || *home_ != home) {
        at_home_ = worst(home);
        home_ = home;
    }
    return at_home_ < curved_limit && worst(x, at_home_) >= at_home_;
}

double curved_shape(const Deformable& d, int tetra) {
    if (!is_second_order(d, tetra)) return 1;
    const auto& v = d.band.tetras[tetra];
    const auto& n = d.band.nodes;
    return ratio({n[v[0]].at, n[v[1]].at, n[v[2]].at, n[v[3]].at}, by_ends([&](int i, int j) { return mid_side(d, v[i], v[j]); }));
}

bool keeps_curved_shape(Deformable& d, int node, const Vec3& x) { return CurvedStar(d, node).stays_sound(x); }

double curved_children(const Deformable& d, int a, int b, const Vec3& at, const Contact& tools) {
    if (!d.mids.any()) return 1;
    const BandMesh& band = d.band;
    const double t = fraction(band.nodes[a].at, band.nodes[b].at, at);
    const NodeConstraint along = d.constraints.on_edge(band, a, b);
    const double held = d.held_between(a, b);
    double worst = 1;
    for (const int s : band.tetras.around(a)) {
        const auto& v = band.tetras[s];
        if (std::ranges::find(v, b) == v.end() || !is_second_order(d, s)) continue;
        for (const int replaced : {a, b}) {
            std::array<Vec3, 4> corner;
            for (int k = 0; k < 4; ++k) corner[k] = v[k] == replaced ? at : band.nodes[v[k]].at;
            worst = std::min(worst, ratio(corner, by_ends([&](int i, int j) {
                if (v[i] != replaced && v[j] != replaced) return mid_side(d, v[i], v[j]);
                const int other = v[i] == replaced ? v[j] : v[i];
                const Contact both = tools.common(d.contact[other]);
                if (other == a) return fit(d, corner[i], corner[j], {along, both, t * t * d.mids.bulge(a, b), held});
                if (other == b) return fit(d, corner[i], corner[j], {along, both, (1 - t) * (1 - t) * d.mids.bulge(a, b), held});
                return fit(d, corner[i], corner[j], {d.constraints.on_face(band, a, b, other), both, d.mids.bulge_across(a, b, other, t), std::max(held, d.held_off[other])});
            })));
        }
    }
    return worst;
}

double curved_merged(const Deformable& d, int p, int t) {
    if (!d.mids.any()) return 1;
    const BandMesh& band = d.band;
    double worst = 1;
    for (const int s : band.tetras.around(p)) {
        const auto& v = band.tetras[s];
        if (std::ranges::find(v, t) != v.end() || !is_second_order(d, s)) continue;
        std::array<Vec3, 4> corner;
        for (int k = 0; k < 4; ++k) corner[k] = band.nodes[v[k] == p ? t : v[k]].at;
        worst = std::min(worst, ratio(corner, by_ends([&](int i, int j) {
            if (v[i] != p && v[j] != p) return mid_side(d, v[i], v[j]);
            const int other = v[i] == p ? v[j] : v[i];
            return fit(d, corner[i], corner[j], {d.constraints.on_edge(band, p, other), d.contact[t].common(d.contact[other]), Vec3::Zero(), d.held_between(t, other)});
        })));
    }
    return worst;
}

}  // namespace femscalpel
