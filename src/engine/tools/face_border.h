// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <BRepAdaptor_Curve.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shape.hxx>

#include <Eigen/Core>
#include <array>
#include <limits>
#include <vector>

#include "tools/face_surface.h"

namespace femscalpel {

/// Some of the chains of a border: all, one, or those that are marked.
class ChainSet {
public:
    static ChainSet all() { return {}; }
    static ChainSet only(int chain);
    static ChainSet marked(std::vector<char> marks);
    bool has_all() const { return marks_.empty() && only_ < 0; }
    bool has(int chain) const { return marks_.empty() ? only_ < 0 || chain == only_ : marks_[chain] != 0; }

private:
    int only_ = -1;
    std::vector<char> marks_;
};

/// The border of the faces of a CAD shape: the edges that only one face has, in chains that meet in its corners.
class FaceBorder {
public:
    /// Edges of the border that follow each other without a corner.
    struct Chain {
        /// Its ends, with the direction of the border there; none if it is closed.
        struct End {
            Eigen::Vector3d at, tangent;
            int neighbour;  ///< the chain that goes on there, or -1
        };
        std::vector<End> ends;  ///< where it begins, where it ends
        double least_radius = std::numeric_limits<double>::infinity();
    };

    /// A corner of the border.
    struct Joint {
        Eigen::Vector3d at;
        int before, after;  ///< chains
    };

    /// The point of a border closest to some point of the surface.
    struct Foot {
        Eigen::Vector3d at = Eigen::Vector3d::Zero();
        Eigen::Vector3d left = Eigen::Vector3d::Zero();  ///< to the side the surface is on
        double distance = std::numeric_limits<double>::infinity();
        int chain = -1;

        /// Signed distance of that point; positive beyond the border.
        double beyond(const Eigen::Vector3d& x) const { return (x - at).dot(left) >= 0 ? -distance : distance; }
    };

    /// Of all faces of `shape`, which are of this size. Throws ToolError when faces meet at an angle: the surface would
    /// fold there.
    FaceBorder(const TopoDS_Shape& shape, double size);

    /// The point of the border closest to a point on the surface. Of the chains in `counted`; where one of them meets
    /// one that does not count, it goes on straight.
    Foot foot(const FacePlace& place, const ChainSet& counted) const;

    bool empty() const { return pieces_.empty(); }
    const std::vector<Chain>& chains() const { return chains_; }
    const std::vector<Joint>& joints() const { return joints_; }

private:
    /// A piece of an edge, from parameter `from` to `to`.
    struct Piece {
        int edge;
        double from, to;
        Eigen::Vector3d start, end;
    };
    /// The ends of an edge, first and last in the border's direction.
    struct End {
        Eigen::Vector3d at, tangent;
    };
    using Ends = std::array<End, 2>;

    void add_edge(const TopoDS_Edge& edge);
    void find_chains();
    std::vector<Ends> ends() const;
    void follow(const std::vector<int>& next, const std::vector<int>& previous, const std::vector<char>& smooth);
    void find_radii();

    double size_;
    std::vector<BRepAdaptor_Curve> edges_;
    std::vector<char> reversed_;  // by edge
    std::vector<int> chain_of_;   // by edge
    std::vector<Chain> chains_;
    std::vector<Joint> joints_;
    std::vector<Piece> pieces_;
};

}  // namespace femscalpel
