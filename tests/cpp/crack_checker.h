// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "area_by_plane.h"
#include "crack_model.h"
#include "distances_by_hand.h"
#include "elements_by_hand.h"
#include "findings.h"
#include "operators/report.h"

namespace femscalpel::checks {

/// Looks at one crack, see check_crack().
class CrackChecker {
public:
    CrackChecker(const Model& model, const CutPlane& plane, const Result& result, const std::string& name)
        : model_(model),
          in_(model.mesh),
          out_(result.mesh),
          report_(result.report),
          plane_(plane),
          name_(name),
          made_{name + "_P", name + "_N", name + "_FRONT"} {}

    /// All that does not hold; to be called once.
    std::vector<std::string> run();

private:
    /// Nodes that are held beside the plane may be as far off it as the report says.
    double tolerance() const { return rounding * model_.size + report_.held.largest; }
    bool on_plane(Index n) const { return std::abs(distance_[n]) <= tolerance(); }
    Index id(Index n) const { return out_.node_ids[n]; }
    using Place = std::array<double, 3>;
    Place place(Index n) const { return {out_.points[n].x(), out_.points[n].y(), out_.points[n].z()}; }
    bool is_input_node(Index n) const { return id(n) <= model_.largest_node; }
    bool same_place(Index n) const {
        return is_input_node(n) &&
               std::memcmp(out_.points[n].data(), in_.points[model_.node_index.at(id(n))].data(), sizeof(Vec3)) == 0;
    }

    void index();
    bool numbers_and_nodes();
    void far_elements();
    /// Whether a triangle of a mesh with solids stands on its own.
    bool is_shell(std::span<const Index> n) const;
    void shapes();
    /// Every element is on one side of the plane; the sides share no node; each part is on one side.
    void sides();
    void solid_conformity();
    /// Area between tetrahedra of different groups. What lay in the plane is now two lips.
    void compare_borders();

    AreaByPlane planes_of(const std::vector<Model::Face>& faces) const;
    /// Nodes that are not where they were lie on the old surfaces or lines, but for the middles of straight edges,
    /// which may be as far beside them as the report says.
    template <class Shapes>
    void nodes_stay(const std::set<Index>& nodes, const std::vector<Shapes>& shapes, const std::string& what) {
        for (const Index n : nodes) {
            if (same_place(n)) continue;
            const double away = edges_away(out_.points[n], shapes, 0.5);
            const bool corner = !mid_nodes().contains(n);
            if (away <= 1e-3) continue;
            if (!corner && distance_away(out_.points[n], shapes) <= 1.01 * report_.straightened.largest)
                beside_.insert(place(n));
            else
                bad_.add(what + (corner ? "" : " mid-side"), "node ", id(n), is_input_node(n) ? "" : " (new)", " is ",
                         away, " edge lengths off the old ", what);
        }
    }

    /// No more mid-side nodes are beside their surface than the report and a warning say.
    void straightened();
    const std::set<Index>& mid_nodes();
    void shell_conformity();
    /// Elements of lower dimension still lie on faces and edges of others, with their mid-side nodes.
    void attached();
    bool input_repeats() const;

    /// Elements of a lip.
    std::vector<CellRef> lip(const char* suffix) const;
    const std::set<Key3>& lip_keys();
    void lips();
    void lip_element(const CellRef& c, bool positive);
    /// Nodes of the negative lip and of the positive.
    using LipNodes = std::array<std::map<Place, std::set<Index>>, 2>;
    /// Both copies of a node are in the same groups.
    void lip_twins(const LipNodes& nodes);
    /// The interface nodes of the report are the originals of the lips' corner nodes.
    void interface_nodes(const LipNodes& nodes);
    /// Whether a lip element is the double of an element the input had there, whose direction it keeps.
    bool same_name_twin(const CellRef& c) const;
    void section();

    void groups();
    /// Measure of what a group has twice in one place: faces and segments on the crack, one copy per side.
    double doubled_measure(GroupIndex g) const;
    void node_groups();
    void report();
    bool is_flat_measure(const GroupRecord& r) const;

    const Model& model_;
    const Mesh& in_;
    const Mesh& out_;
    const Report& report_;
    const CutPlane& plane_;
    std::string name_;
    std::set<std::string> made_;
    Findings bad_;
    std::set<Place> beside_;  ///< mid-side nodes that are not on their surface; both copies in one place
    std::unordered_map<Index, Index> index_;  // node number -> index in out_
    std::vector<double> distance_;
    std::set<Index> in_sets_;
    std::set<Place> interface_places_;  ///< of the named interface nodes, and so of their doubles
    std::set<Index> mid_nodes_;
    bool mids_known_ = false;
    std::vector<TetraFace> faces_;
    std::set<Key3> lip_keys_;
    bool lip_keys_known_ = false;
    std::vector<GroupSum> sums_;
    Index gone_ = 0;
    Index band_count_ = 0;
    double band_minimum_ = 1;
};

}  // namespace femscalpel::checks
