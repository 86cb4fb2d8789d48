// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <functional>
#include <limits>
#include <vector>

#include "cutting/merging.h"
#include "cutting/workpiece.h"
#include "deformation/curved_shape.h"

namespace femscalpel {

/// Keeps the elements of a band that is deformed far in shape: bisects edges that have become long against those of the
/// input, merges nodes where they have become short, and works on poor elements as improve() does. Other than there,
/// nodes of the input inside the material, in flat faces, on straight edges and on the wall may go, too, where nothing
/// of the mesh means them alone.
class Remesher {
public:
    /// Nodes that `slides(node)` move for better shape. `f` must be as the input is; all must outlive this.
    Remesher(Workpiece& f, const Mesh& mesh, std::function<bool(int)> slides);

    /// Bisects and merges by length, then improves elements worse than `goal`.
    void run(double goal);

    /// Nodes that may move for better shape.
    std::vector<int> movable() const;

    /// Of them, those of elements that have become less than good.
    std::vector<int> strained() const;

    /// Smallest mean ratio of the band's elements, negative when one is inverted, and where that one is in the input.
    struct Worst {
        double mean_ratio;
        Vec3 at;
    };
    Worst worst() const;

    /// The input's nodes that were merged away.
    int taken_out() const { return taken_out_; }

private:
    struct Edge {
        double excess;  ///< length over that wanted
        int a, b;
    };
    struct Poor {
        double quality;
        std::array<int, 4> nodes;  ///< -1 in the last place for a shell
        auto operator<=>(const Poor&) const = default;
    };

    std::vector<Edge> edges(bool shortest, auto counts) const;
    double wanted(int a, int b, bool shortest) const;
    double was(BandElement element) const;
    bool split(int a, int b);
    int merge(int node);
    bool split_long();
    bool merge_short();
    std::vector<Poor> poor_elements(double goal) const;
    bool merge_poor(double goal);
    bool split_poor(double limit);
    double shortfall(double limit) const;
    void relax_touched();
    void find_removable(const Mesh& mesh);
    bool may_go(int node) const;
    bool exists(int a, int b) const;

    Workpiece& f_;
    Deformable& d_;
    BandMesh& band_;
    NodeMerger merger_;
    std::function<bool(int)> slides_;
    std::vector<double> size_;                   // by node: length of edges there in the input
    std::vector<Vec3> material_;                 // by node: where in the input what is there now was
    std::vector<double> tetra_was_, shell_was_;  // by slot of the input's element: its mean ratio
    std::vector<char> removable_;                // by input node: nothing means it alone
    std::vector<int> touched_;                   // nodes born, and those others were merged into
    int taken_out_ = 0;
};

}  // namespace femscalpel
