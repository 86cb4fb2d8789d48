// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "elements_by_hand.h"

namespace femscalpel::checks {

struct CutPlane {
    Vec3 origin = Vec3::Zero();
    Vec3 normal = Vec3::UnitX();  ///< of unit length

    double distance(const Vec3& x) const { return normal.dot(x - origin); }
};

/// What a group holds. `measure` is the length, area or volume of its elements of highest dimension, `normal_area`
/// the sum of their area vectors (faces only): it tells a face that was turned round or folded.
struct GroupSum {
    Index count = 0;
    int dimension = 0;
    double measure = 0;
    Vec3 normal_area = Vec3::Zero();
};

/// One entry per group, hidden ones included.
std::vector<GroupSum> group_sums(const Mesh& mesh);

/// An input mesh and what is known of it before anything is done: skin, borders, measures.
class Model {
public:
    /// `flat`: every skin and border is made of a few planes, so that measures must survive to rounding; otherwise
    /// nodes have to stay within 1e-3 local edge lengths of the discrete surface and measures within a per cent.
    Model(Mesh mesh, bool flat);

    Mesh mesh;
    bool flat;
    bool solid;       ///< tetrahedra; otherwise triangles
    double size = 0;  ///< diagonal of the bounding box
    Vec3 low, high;   ///< bounding box

    /// A face of the skin or of a border between groups, or, in a shell mesh, a triangle.
    struct Face {
        std::array<Vec3, 3> corner;
        std::array<Vec3, 3> mid;
        bool curved = false;
        Vec3 normal;
        Vec3 centre;
        double radius = 0;
        double edge = 0;  ///< mean edge length
    };
    /// A line element, or, in a shell mesh, an edge of a border, crease or junction.
    struct Segment {
        std::array<Vec3, 2> end;
        Vec3 mid = Vec3::Zero();
        std::vector<Vec3> plates;  ///< unit normals of the shells (skin faces) that meet here
        std::vector<Vec3> inward;  ///< unit directions from here into those faces
        std::string kind;          ///< shells: what meets here
        double bend = 0;           ///< shells: angle to the next segment of a curved line, radian
    };
    std::vector<Face> skin;      ///< outside of the tetrahedra, or all shells
    std::vector<Face> borders;   ///< between tetrahedra of different groups
    std::vector<Segment> lines;  ///< line elements; in shells, edges that are not inside a plate

    std::vector<GroupSum> sums;
    std::vector<std::vector<Face>> group_faces;        ///< by group: its triangles (solid meshes)
    std::vector<std::vector<Segment>> group_segments;  ///< by group: its line elements
    std::vector<int> group_twin;        ///< node group: element group of the same name with just these nodes, or -1
    std::vector<char> group_planar;     ///< by group: all nodes in one plane, or a group of volumes
    std::vector<Index> isolated_nodes;  ///< indices of members of a node group that have no neighbour in it
    bool mixed = false;                 ///< a solid mesh with shells of their own
    std::set<std::string> loose_kinds;  ///< the groups such shells are in, as one text
    std::set<Index> loose_cells;        ///< numbers of line elements that are on no other element's edge
    std::map<Index, Index> node_index;  ///< index of each node number
    Index largest_node = 0, largest_cell = 0;

    /// What curved lines of a flat shell (the rim of a hole) and curved skins allow measures to change by.
    struct Slack {
        double length = 0, area = 0;
    };
    std::map<std::string, Slack> curved_slack;  ///< by Segment::kind
    std::vector<double> group_slack;            ///< by group
    double area_slack = 0;                      ///< of all together
    double section_slack(const CutPlane& plane) const;

private:
    void find_bends();
};

/// The face of these nodes; `mid`: of its edges 01, 12, 20, -1 when it is flat.
Model::Face make_face(const Mesh& mesh, const Key3& corner, const Key3& mid);

/// Length of the edges of a shell mesh by what meets there: number of shells and their groups. Edges inside a plate do
/// not count, nor do those that `skip` names.
std::map<std::string, double> border_lengths(const Mesh& mesh, const std::function<bool(const Key2&)>& skip,
                                             const std::set<std::string>& without,
                                             std::vector<Model::Segment>* segments);

}  // namespace femscalpel::checks
