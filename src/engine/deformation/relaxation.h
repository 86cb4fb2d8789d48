// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <vector>

#include "deformation/deformable.h"

namespace femscalpel {

/// How long relax() goes on.
struct RelaxationOptions {
    double target = 0.55;  ///< nodes all of whose elements are better than this are left alone
    int sweeps = 8;        ///< at most, for each exponent
};

/// Moves nodes for better shape (resources/docs/architecture.md, "relax"): minimises the sum of (1 / mean ratio)^p over
/// the elements around each node, node after node, by a safeguarded Newton step in the node's tangent space, p = 8 and
/// then 16. Inverse mean ratio and block coordinate descent as in Munson, "Mesh shape-quality optimization using the
/// inverse mean-ratio metric", Math. Program. 110 (2007).
///
/// Only `movable` nodes move, only near elements worse than the target, and no step makes a node's
/// objective worse, so nothing inverts. Returns the number of node moves.
long relax(Deformable& d, const std::vector<int>& movable, const RelaxationOptions& options = {});

/// The same after a change: begins at the movable nodes near it and spreads to others as far as nodes move.
long relax_from(Deformable& d, const std::vector<int>& near, const std::vector<int>& movable,
                const RelaxationOptions& options = {});

}  // namespace femscalpel
