// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <span>
#include <unordered_map>
#include <unordered_set>

#include "mesh/band_mesh.h"

namespace femscalpel {

/// The shape of second-order edges while a band is worked on by its corners: how far each edge's mid-side node is off
/// its chord. An edge keeps that when its ends move.
///
/// A split edge and the edges born in the faces and elements around it get what the parent's own shape functions
/// say: subdivision of a quadratic element is exact, so a split alone changes neither geometry nor volume.
class MidSides {
public:
    /// A mid-side node within `rounding` of the middle of its chord makes a straight edge.
    MidSides(const BandMesh& band, const Mesh& mesh, double rounding = 0);

    /// Whether the band has second-order elements at all, that are not to be ignored.
    bool any() const { return any_ && !ignored_; }

    /// Whether elements are to be changed as if all were linear; how edges bulge is known all the same.
    void ignore(bool ignored) { ignored_ = ignored; }

    /// Mid-side node minus middle of the chord of the edge a-b; zero for a straight edge.
    Vec3 bulge(int a, int b) const {
        const auto it = bulges_.find(edge_key(a, b));
        return it == bulges_.end() ? Vec3(Vec3::Zero()) : it->second;
    }

    /// Whether the edge a-b may have one: quicker, and true for some straight edges.
    bool may_bulge(int a, int b) const { return ends_bulge(a) && ends_bulge(b); }

    /// Bulges of the edges between node `p`, at the fraction t of the edge a-b, and a third node c of a face a-b-c.
    Vec3 bulge_across(int a, int b, int c, double t) const {
        return (1 - t) * bulge(a, c) + t * bulge(b, c) - t * (1 - t) * bulge(a, b);
    }

    /// The edge a-b is about to be split at node p, at the fraction t of its length.
    void split(const BandMesh& band, int a, int b, int p, double t);

    void set_bulge(int a, int b, const Vec3& bulge) {
        if (bulge.isZero(0))
            bulges_.erase(edge_key(a, b));
        else {
            bulges_[edge_key(a, b)] = bulge;
            mark_ends(a, b);
        }
    }

    /// Moves the mid-side node of an edge of the input: it is to be written although the edge's ends stay.
    void mend(int a, int b, const Vec3& bulge) {
        mended_.emplace(edge_key(a, b), this->bulge(a, b));
        set_bulge(a, b, bulge);
    }

    /// Takes that back.
    void put_back(int a, int b) {
        const auto it = mended_.find(edge_key(a, b));
        if (it == mended_.end()) return;
        set_bulge(a, b, it->second);
        mended_.erase(it);
    }

    bool is_mended(int a, int b) const { return mended_.contains(edge_key(a, b)); }

    /// Makes the edge a-b straight though the surface or curve it is on is not; mend() included.
    void straighten(int a, int b) {
        mend(a, b, Vec3::Zero());
        straightened_.insert(edge_key(a, b));
    }

    bool is_straightened(int a, int b) const { return straightened_.contains(edge_key(a, b)); }

    /// Makes it straight though it is on curved tools, too.
    void straighten_off_tools(int a, int b) {
        straighten(a, b);
        off_tools_.insert(edge_key(a, b));
    }

    bool is_off_tools(int a, int b) const { return off_tools_.contains(edge_key(a, b)); }

    /// The edge a-b is what it was, though both its ends are on a tool that it is beside.
    void keep(int a, int b) { kept_.insert(edge_key(a, b)); }

    bool is_kept(int a, int b) const { return kept_.contains(edge_key(a, b)); }

    /// The input's bulges of the edges that mend() was called for, by edge.
    const std::unordered_map<std::uint64_t, Vec3>& mended() const { return mended_; }

private:
    bool ends_bulge(int node) const {
        return node < static_cast<int>(end_of_bulge_.size()) && end_of_bulge_[node] != 0;
    }
    void mark_ends(int a, int b) {
        end_of_bulge_.resize(std::max(end_of_bulge_.size(), static_cast<std::size_t>(std::max(a, b)) + 1), 0);
        end_of_bulge_[a] = end_of_bulge_[b] = 1;
    }

    bool any_ = false, ignored_ = false;
    std::vector<char> end_of_bulge_;  // by node
    std::unordered_map<std::uint64_t, Vec3> bulges_, mended_;
    std::unordered_set<std::uint64_t> straightened_, off_tools_, kept_;
};

/// How far along from a to b the point `at` is, as a fraction of the chord.
inline double fraction(const Vec3& a, const Vec3& b, const Vec3& at) {
    const Vec3 chord = b - a;
    return std::clamp(chord.dot(at - a) / chord.squaredNorm(), 0.0, 1.0);
}

/// Smallest Jacobian determinant of a second-order simplex at its integration points and its corners, over that of the
/// straight element with the same corners: 1 if it is straight, not positive if it is folded. `nodes`: ten points in
/// the order of CellType::tetra10, or six in that of CellType::triangle6. A triangle in space counts as seen along the
/// normal of its corners'.
double curved_ratio(std::span<const Vec3> nodes);

/// The same at the integration points alone, those of solvers: four in a tetrahedron (C3D10, TETRA10), three in a
/// triangle.
double integration_ratio(std::span<const Vec3> nodes);

}  // namespace femscalpel
