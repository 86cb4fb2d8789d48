// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "operators/refine_estimate.h"

namespace femscalpel {

class CadShape;

/// Whether elements near the tool are bisected before the operation (refine_first.h).
struct RefineFirst {
    enum class When {
        automatic,  ///< where the tool is finer than the mesh: edges are longer than half its radius; not for method
                    ///< `deform`
        never,
        to_size,  ///< where edges are longer than `size`
    };
    When when = When::automatic;
    double size = 0;
};

/// How element faces are brought onto the tool (resources/docs/architecture.md, "cut").
enum class Method {
    snap,    ///< move near nodes onto the tool, split what still crosses; succeeds on any sound mesh
    deform,  ///< the paper's: choose element faces near the tool, then move their nodes; may end in QualityError
};

/// Method of that name ("snap" or "deform"); throws ToolError otherwise.
Method method_from_name(const std::string& name);
/// "snap" or "deform".
std::string_view to_string(Method method);

/// What every operator lets the user choose.
struct OperatorOptions {
    std::string name;  ///< prefix of the new groups
    Method method = Method::snap;
    /// The i-th neighbourhood of the interface that may move (the paper's bandwidth i, 3.1.2), 1 to 20. When absent:
    /// for `deform` as in the paper, the largest distance of an interface node from the tool over the mean edge length,
    /// at least 2; for `snap`, which moves nodes by less than an edge and splits the rest, 2, as more rings do not make
    /// better elements (resources/docs/paper.md).
    std::optional<int> transition;
    double feature_angle = 30;  ///< degrees; a skin edge sharper than this is a feature line
    /// Names of the groups whose boundary keeps its shape, the others' may drift; all are kept when absent.
    std::optional<std::vector<std::string>> preserve;
    /// The shape the mesh was made from: nodes of the skin that move or are born are put on its faces and edges.
    const CadShape* skin = nullptr;
    bool strict = false;  ///< Error instead of warnings where the solver's input cannot follow (carry_over.h)
    /// The result's mesh is only the elements near the tool, as the whole operation would make them: same numbers,
    /// coordinates, groups; without what was refined or converted farther off. The report is that of the whole
    /// operation, but for what carrying the solver's input over has to say; the mesh has none. For previews: costs the
    /// band and a pass over the mesh that finds it.
    bool band_only = false;
    RefineFirst refine;
    /// Told what refining first will come to, each time before that is done; may throw.
    BeforeRefining before_refining;
    /// What is made of first-order solids becomes second order, with a ring of elements around (raise_order.h).
    bool second_order = false;
};

}  // namespace femscalpel
