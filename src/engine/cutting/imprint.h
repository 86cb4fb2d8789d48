// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "cutting/workpiece.h"
#include "tools/plane.h"
#include "tools/ribbon.h"

namespace femscalpel {

/// A line that is to become edges of a mesh's surface: of shells, or of the skin of solids.
struct ImprintLine {
    /// What stands on the surface along the line.
    const Ribbon* ribbon = nullptr;
    /// Lengths along the line, ascending, at which there have to be nodes. They begin with 0, and of an open line end
    /// with its length.
    std::vector<double> stops;
    /// For each stop, where its node has to be.
    std::vector<Vec3> places;
    /// For each stop, the node of the mesh that it is, whatever holds that; or -1.
    std::vector<Index> known;
    /// Only its stops become nodes; there are no edges along it. They may then be anywhere.
    bool only_stops = false;
};

/// A line as the edges it became.
struct ImprintedLine {
    std::vector<int> nodes;    ///< of the band, along the line; of a closed one the first is there once
    std::vector<int> at_stop;  ///< for each stop the node there, which may be a little beside its place
};

/// Makes edges of the surface lie along lines: nodes near a line are moved onto it along the surface, nearest first;
/// edges of the surface that still cross it are split on it, longest first; then its stops become nodes, by moving
/// those near them or by splitting edges of the line. Nothing is relaxed. The edges are put into BandMesh::cut_edges,
/// each under the index of its line as tag.
///
/// Nodes at stops come to lie at their places, or, if they are held or the surface is elsewhere, a little beside; with
/// `exact` in any case at their places, bit by bit, even a little off the surface.
class Imprint {
public:
    /// Holds the planes that keep nodes at stops; must outlive the workpieces, as must the ribbons.
    Imprint(std::vector<ImprintLine> lines, bool exact) : lines_(std::move(lines)), exact_(exact) {}

    /// Puts the edges between known nodes, where lines have them already, into Workpiece::kept_edges. Those that are
    /// curved stay so, though the line is straight there; halves of one would not be on it.
    void keep_edges(Workpiece& f) const;

    /// Throws QualityError that names the place where a line cannot be made edges.
    void run(Workpiece& f);

    /// The lines as edges of a workpiece after run(); relaxing and improving may have moved and merged nodes between
    /// stops. Throws QualityError as run() does.
    std::vector<ImprintedLine> result(const Workpiece& f) const;

    std::span<const ImprintLine> lines() const { return lines_; }

    /// Gives a line other known nodes: the mesh to be worked on is another.
    void know(std::size_t line, std::vector<Index> known) { lines_[line].known = std::move(known); }

private:
    std::vector<ImprintLine> lines_;
    bool exact_;
    std::vector<std::unique_ptr<Plane>> planes_;  // across lines, at stops
};

}  // namespace femscalpel
