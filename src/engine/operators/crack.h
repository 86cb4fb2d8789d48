// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/mesh.h"
#include "operators/interface.h"
#include "operators/report.h"
#include "tools/tool.h"

namespace femscalpel {

struct CrackOptions {
    std::string name = "CRACK";     ///< prefix of the new groups NAME_P, NAME_N, NAME_FRONT
    Method method = Method::snap;
    std::optional<int> transition;  ///< i-th neighbourhood that may move; computed when absent
    double feature_angle = 30;      ///< degrees; a skin edge sharper than this is a feature line
    /// Names of the groups whose boundary keeps its shape, the others' may drift; all are kept when absent.
    std::optional<std::vector<std::string>> preserve;
    bool strict = false;            ///< Error instead of warnings where the solver's input cannot follow (carry_over.h)
};

/// Cracks `mesh` along the whole of `tool` (paper, 3.1): makes element faces lie on the tool, then gives
/// each side its own copy of the interface nodes. Lips are coincident. The input is not changed.
///
/// New groups: NAME_P and NAME_N, the lip faces on the tool's positive and negative side (triangles of a
/// volume mesh, segments of a shell mesh). The original nodes stay with the negative side. Where the two
/// sides hang together at interface nodes, these are the front: node group NAME_FRONT.
///
/// Free segments (beams, springs: edges of no triangle or tetrahedron) are not cut; they bridge the crack.
///
/// Throws ToolError (bad name, `preserve` names no group, tool misses the mesh), UnsupportedElementError (the band reaches
/// elements other than triangles and tetrahedra), QualityError (no valid mesh can be made).
Result crack(const Mesh& mesh, const Tool& tool, const CrackOptions& options = {});

}  // namespace femscalpel
