// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <memory>

#include "cutting/bisection.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// What refining a mesh will come to, told before it is done.
///
/// Each element is counted as if it were bisected alone; that elements beside it have to follow is a measured part.
struct RefinementEstimate {
    double size = 0;            ///< longest edge wanted, in the mesh's unit
    Index elements_before = 0;  ///< of every type
    Index elements_after = 0;   ///< likewise; most cases are within a quarter of it
    bool is_more = false;       ///< counting ended at `elements_after`: there would be more

    /// The smallest length, rounded up to two digits, to which the mesh can be refined in the same place with at most
    /// `limit` elements; longer than its longest edge where the mesh alone has more. Throws std::logic_error once the
    /// call is over that the estimate was made for.
    double size_for(Index limit) const;

    /// Elements for another size, counted up to a limit; set while size_for() can be called.
    std::shared_ptr<std::function<Index(double size, Index limit)>> count;
};

/// Told of a refinement before it is done; what it throws ends the call.
using BeforeRefining = std::function<void(const RefinementEstimate&)>;

/// Most elements that are counted.
constexpr Index most_counted = 10'000'000;

/// Elements that a mesh would have if each of its triangles and tetrahedra were bisected alone, at most `limit` and
/// one: it will have no fewer.
Index count_refined(const Mesh& mesh, const SizeField& field, Index limit);

/// The same with those that have to follow.
Index with_followers(Index before, Index counted);

}  // namespace femscalpel
