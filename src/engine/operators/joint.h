// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "cutting/meeting_lines.h"
#include "operators/options.h"
#include "operators/prepared.h"
#include "operators/report.h"
#include "operators/seam.h"
#include "tools/ribbon.h"

namespace femscalpel {

/// A line in which the two meshes meet, and which nodes it has of each by now.
struct JointLine {
    std::array<std::unique_ptr<Ribbon>, 2> standing;  ///< through the meeting's points, on the surface of each
    bool closed = false;
    /// Places where both are to have a node, along the line, and the nodes there, or -1.
    struct Stop {
        Vec3 at;
        std::array<Index, 2> node;
        bool bound = false;  ///< a border, line or group holds the first mesh's node on its surface
    };
    std::vector<Stop> stops;
};

/// The ribbon through a meeting's points, on the surface of mesh m (0 or 1).
std::unique_ptr<Ribbon> ribbon_of(const MeetingLine& meeting, std::size_t m);

/// A line of a meeting, with stops at its ends, where it bends, and where one of the meshes has a node; of places that
/// are nearer to each other than edges there should be, one. `mesh`: the first.
JointLine line_of(const MeetingLine& meeting, const Mesh& mesh);

/// Two meshes that are given the same edges and nodes along lines: each by turns, with the nodes the other has there.
class Joint {
public:
    /// All must outlive this.
    Joint(const Mesh& mesh, const Mesh& addition, std::vector<JointLine> lines, const OperatorOptions& options);

    /// Does it. `known` is what is known of the mesh. Throws as imprint_seam() does, and QualityError when the two come
    /// to no end.
    void run(const Prepared& known);

    /// The mesh (0) and the addition (1), once done.
    Mesh& mesh(std::size_t m) { return results_[m].mesh; }
    /// The lines; their stops are the nodes that both have there.
    const std::vector<JointLine>& lines() const { return lines_; }
    /// What was done to each.
    Report& report(std::size_t m) { return results_[m].report; }

private:
    bool imprint(std::size_t m, const Prepared& known);
    void put_together();
    void bend();
    Mesh with_nodes_in_place(const Mesh& mesh, std::size_t m) const;
    const Ribbon* ribbon_through_stops(const JointLine& line, std::size_t m);

    std::array<const Mesh*, 2> mesh_;
    std::vector<JointLine> lines_;
    OperatorOptions options_;
    std::array<Result, 2> results_;
    std::array<bool, 2> done_{};
    std::vector<std::unique_ptr<Ribbon>> ribbons_;
};

}  // namespace femscalpel
