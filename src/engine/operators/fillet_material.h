// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "cutting/cavity.h"
#include "cutting/workpiece.h"
#include "operators/fillet_path.h"

namespace femscalpel {

/// An edge being rounded, and how far from it elements are replaced.
struct FilletReach {
    const FilletPath* path;
    double reach;
    /// At each end, the one other edge with which it meets there, in a plane.
    std::array<const FilletPath*, 2> next = {};
};

/// The elements that a fillet replaces, and what bounds them. They fall into domains: parts between the borders of
/// groups and other surfaces that are kept.
class FilletMaterial {
public:
    /// A face, and the domain of the element that it is a face of.
    struct Face {
        Triangle nodes;
        int domain;
    };
    /// A face between domains, its normal out of the first.
    struct Border {
        Triangle nodes;
        std::array<int, 2> domain;
    };

    /// Collects the elements between the walls of each path, joined to the edge through faces, but for domains that
    /// have no skin beside the edges: these stay. Throws QualityError when there are none.
    FilletMaterial(Workpiece& workpiece, const Mesh& mesh, std::span<const FilletReach> edges);

    /// Faces whose normals differ by less are in one plane, in radians.
    static constexpr double plane_angle = 1.4e-3;

    /// Throws QualityError: "the edge cannot be rounded near ...: text".
    [[noreturn]] static void refuse(const std::string& text, const Vec3& near);

    Workpiece& workpiece() const { return f_; }
    const Vec3& at(int v) const { return f_.d.band.nodes[v].at; }
    /// The unit normal of a face.
    Vec3 normal(const Triangle& t) const { return (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).normalized(); }
    /// By how much that may be off, in radians.
    double normal_slack(const Triangle& t) const { return slack_.normal(at(t[0]), at(t[1]), at(t[2])); }
    /// Whether the normal of a face is another, or the opposite, but for so much and what its own may be off, in
    /// radians.
    bool is_parallel(const Triangle& t, const Vec3& to, double off) const {
        const Vec3 own = normal(t);
        return std::min((own - to).norm(), (own + to).norm()) <= off + normal_slack(t);
    }
    const CoordinateSlack& slack() const { return slack_; }
    Vec3 middle(const Triangle& t) const { return (at(t[0]) + at(t[1]) + at(t[2])) / 3; }

    /// Whether a node is in what is rounded off a convex edge.
    bool is_rounded_off(int v) const;
    const std::vector<int>& removed() const { return removed_; }
    int domains() const { return domains_; }
    /// The element that is nearest, of a domain if not -1; of one that is about so, far from all.
    int parent(const Vec3& x, int domain) const;
    /// The nodes of the element that is nearest, of those with a node off the edges.
    std::array<int, 4> nodes_near(const Vec3& x) const;
    const FilletReach& edge(std::size_t place) const { return edges_[place]; }
    /// The skin that goes, beside an edge, by its place and face. Edges that meet share some.
    const std::vector<Face>& strip(std::size_t edge, int side) const { return strips_[edge][side]; }
    /// Whether an edge is one of the skin that goes beside the edges, in this direction.
    bool is_strip_edge(int a, int b) const { return strip_edges_.contains({a, b}); }
    /// How many edges there are.
    std::size_t edges() const { return strips_.size(); }

    std::vector<Border> borders;  ///< not yet taken as part of a surface across an edge
    std::vector<Face> kept;       ///< boundary that stays, out of the domains
    std::vector<Face> skin;       ///< that goes, other than strips, and not yet taken

private:
    void collect(std::span<const FilletReach> edges);
    bool take_wedges(std::span<const FilletReach> edges);
    std::vector<Triangle> outer_faces() const;
    void find_domains();
    void join_domains(const std::vector<std::vector<int>>& joined);
    void find_boundary(std::span<const FilletReach> edges);
    bool is_skin(const Triangle& face) const;
    bool is_strip(const Triangle& face, const FilletReach& edge, int side) const;
    bool is_within_ends(const Vec3& x, const FilletReach& edge, int side) const;
    bool meets_end(int tetra, std::span<const FilletReach> edges) const;
    void leave_untouched(std::span<const FilletReach> edges);
    int nearest(const Vec3& x, const std::function<bool(int)>& counts) const;
    void sort_centres();
    std::array<long, 3> cube(const Vec3& x) const;

    /// What is farther than this from a surface is beside it.
    double close() const { return std::max(f_.tolerance, f_.d.rounding); }

    Workpiece& f_;
    const Mesh& mesh_;
    CoordinateSlack slack_;
    std::vector<FilletReach> edges_;
    std::vector<int> removed_;
    std::vector<int> domain_;  // of removed_
    int domains_ = 0;
    std::vector<std::array<std::vector<Face>, 2>> strips_;
    std::set<DirectedEdge> strip_edges_;
    std::vector<Vec3> centres_;                             // of removed_
    std::vector<char> on_edges_;                            // of removed_: with all nodes
    double cell_ = 0;                                       // side of the cubes of near_
    std::map<std::array<long, 3>, std::vector<int>> near_;  // places in centres_, by cube
};

}  // namespace femscalpel
