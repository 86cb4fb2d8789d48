// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <set>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "mesh/triangle_crossing.h"

namespace femscalpel {

/// A line in which the surfaces of two meshes meet: one smooth piece, between corners and junctions.
struct MeetingLine {
    /// A point of it.
    struct Point {
        Vec3 at;
        std::array<Vec3, 2> normal;  ///< unit normals of the two surfaces there, turned alike along the line
        std::array<Index, 2> node;   ///< the node of each mesh that lies there, or -1
        std::array<double, 2> size;  ///< mean edge length of the two surfaces' faces there
    };
    std::vector<Point> points;
    bool closed = false;  ///< then the last point is joined to the first, which may be a corner
};

/// Puts the segments in which two surfaces meet together to lines. What is nearer to each other than twice the
/// tolerance is one point.
class MeetingLines {
public:
    explicit MeetingLines(double tolerance) : tolerance_(tolerance) {}

    /// Makes a point where a node of a mesh is that lies in the meeting. To be called before add(), so that what is
    /// near is that point; for the first mesh first, whose nodes stay where they are.
    void add_node(const Vec3& at, std::size_t mesh, Index node);
    void add_point(const Vec3& at) { point(at); }

    /// What is known of the surfaces along a segment.
    struct Sides {
        std::array<Vec3, 2> normal;
        std::array<double, 2> size;  ///< mean edge length of the two faces
    };
    /// Adds a segment. With `reach` it goes through all points that are as near to it, which must be there by now.
    void add(const Span& span, const Sides& sides, double reach = 0);

    /// Takes out loose ends shorter than this, where others go on.
    void prune(double length);

    /// The lines, in smooth pieces.
    std::vector<MeetingLine> pieces();

private:
    using Cell = std::array<std::int64_t, 3>;
    using Normals = std::array<Vec3, 2>;

    Cell cell_of(const Vec3& x) const;
    int find(const Vec3& x) const;
    int point(const Vec3& x);
    void join(int p, int q);
    void add_piece(int p, int q, const Sides& sides);
    std::vector<int> points_on(int p, int q, double reach) const;
    void bridge();
    void thin();
    Vec3 direction(int p, int q) const;
    bool is_end(int p) const;
    MeetingLine walk(int from, int to);

    double tolerance_;
    std::vector<MeetingLine::Point> points_;
    std::map<Cell, std::vector<int>> cells_;
    std::map<std::pair<int, int>, Normals> normals_;  // of edges, by their ends in order
    std::map<int, std::set<int>> next_;
    std::set<int> stops_;  // where pieces end
};

}  // namespace femscalpel
