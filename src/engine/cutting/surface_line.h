// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cutting/imprint.h"

namespace femscalpel {

/// "(x y z)", for messages.
std::string point_text(const Vec3& x);

/// Whether a face of BandMesh::skin is one of the surface, not of a border inside the material.
bool is_surface_face(const Deformable& d, int skin);

/// Whether there is an edge of the surface between two nodes of the band.
bool are_joined(const Deformable& d, int a, int b);

/// The nodes on a line, along it; `at_stop` as Workpiece::at_stop. Throws QualityError when two in a row are not joined
/// by an edge of the surface.
std::vector<int> line_nodes(const Workpiece& f, const ImprintLine& line, const std::vector<int>& at_stop);

/// A line on the surface of a workpiece, as far as it has become nodes: what Imprint works with.
class SurfaceLine {
public:
    /// As far as a surface that a line runs on may be off it, in its edges.
    static constexpr double off_line = 0.6;

    /// `planes` gets those that keep nodes at stops.
    SurfaceLine(Workpiece& f, const ImprintLine& line, bool exact, std::vector<std::unique_ptr<Plane>>& planes)
        : f_(f), d_(f.d), band_(f.d.band), line_(line), ribbon_(*line.ribbon), exact_(exact), planes_(planes) {}

    bool is_surface(int skin) const;
    const Vec3& at(int v) const;
    double length(int a, int b) const;
    /// Mean length of the surface's edges at a node.
    double surface_edge(int v) const;
    /// Where the node at a stop has to be.
    const Vec3& wanted(std::size_t stop) const;
    /// Keeps a node at a stop from now on.
    void hold(int v, std::size_t stop);
    /// Whether a node must not be moved.
    bool is_held(int v) const;
    /// Moves a node to a point on its surface (line), or to the closest there is on that, if that is as near as
    /// `close`.
    bool move(int v, Vec3 target, double enough, double close);
    /// The face of the surface that is closest to a point, and the point of it.
    std::pair<int, Vec3> face_at(const Vec3& x) const;
    /// Measures nodes born since.
    void extend_values();
    /// Signed distance of a node to the ribbon.
    double value_of(int v) const;
    /// Signed distances to the ribbon; what lies on it but for rounding is on it.
    void measure();
    /// Whether a point is beside the line, not beyond its ends.
    bool within_ends(const Vec3& x) const;
    /// Whether the line runs over a face, or along its border: it lies there, and reaches both sides of the ribbon.
    bool carries_line(int s) const;
    /// Whether a face lies where the line is, as the surface it runs on does.
    bool lies_there(int s) const;
    /// The faces of the surface that the line runs over: those joined to where it begins.
    std::vector<int> region() const;
    /// The edges of the region that cross the line, longest first.
    std::vector<std::pair<int, int>> crossing_edges() const;
    /// Where an edge crosses the line.
    Vec3 crossing(int a, int b) const;

    /// The nodes on the line, along it.
    std::vector<int> chain() const { return line_nodes(f_, line_, at_stop_); }

protected:
    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    const ImprintLine& line_;
    const Ribbon& ribbon_;
    bool exact_;
    std::vector<std::unique_ptr<Plane>>& planes_;
    std::vector<int> at_stop_;   // by stop: the node there, or -1
    std::vector<double> value_;  // signed distance to the ribbon by band node, once measured
    bool measured_ = false;
};

}  // namespace femscalpel
