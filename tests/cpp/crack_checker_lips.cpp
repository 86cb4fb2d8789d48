// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include "crack_checker.h"
#include "crack_geometry.h"

namespace femscalpel::checks {

std::vector<CellRef> CrackChecker::lip(const char* suffix) const {
    std::vector<CellRef> cells;
    const auto g = out_.find_group(name_ + suffix, GroupKind::element);
    if (!g) return cells;
    for (const CellBlock& b : out_.blocks())
        for (Index c = 0; c < b.size(); ++c)
            if (out_.families.contains(b.families[c], *g)) cells.push_back({b.type, c});
    return cells;
}

const std::set<Key3>& CrackChecker::lip_keys() {
    if (lip_keys_known_) return lip_keys_;
    lip_keys_known_ = true;
    for (const char* suffix : {"_P", "_N"})
        for (const CellRef& c : lip(suffix)) {
            const auto n = out_.block(c.type).nodes(c.cell);
            if (n.size() >= 3) lip_keys_.insert(ascending(Key3{n[0], n[1], n[2]}));
        }
    return lip_keys_;
}

void CrackChecker::lips() {
    if (lip("_P").empty() || lip("_N").empty()) {
        bad_.add("lips", "there are none");
        return;
    }
    std::map<std::vector<Place>, int> faces;
    LipNodes nodes;
    for (int side = 0; side < 2; ++side)
        for (const CellRef& c : lip(side ? "_P" : "_N")) {
            std::vector<Place> key;
            for (const Index k : out_.block(c.type).nodes(c.cell)) {
                key.push_back(place(k));
                nodes[side][key.back()].insert(k);
                if (!on_plane(k)) bad_.add("lip node", "node ", id(k), " is ", distance_[k], " off the plane");
            }
            std::ranges::sort(key);
            faces[key] += side ? 1 : -1;
            lip_element(c, side == 1);
        }
    for (const auto& [key, balance] : faces)
        if (balance != 0)
            bad_.add("lips", "a face of one lip has no partner on the other at (", key[0][0], ", ", key[0][1], ", ",
                     key[0][2], ")");
    lip_twins(nodes);
    interface_nodes(nodes);
}

void CrackChecker::lip_element(const CellRef& c, bool positive) {
    const auto n = out_.block(c.type).nodes(c.cell);
    const bool wanted = (model_.solid && is_triangle(c.type)) || ((!model_.solid || model_.mixed) && is_line(c.type));
    const Index number = out_.block(c.type).ids[c.cell];
    if (!wanted) bad_.add("lips", "element ", number, " is of the wrong type");
    if (!is_triangle(c.type)) return;
    const auto host = std::ranges::lower_bound(faces_, ascending(Key3{n[0], n[1], n[2]}), {},
                                               [](const TetraFace& f) { return f.key; });
    if (host == faces_.end() || host->key != ascending(Key3{n[0], n[1], n[2]})) return;  // found by attached()
    if ((host + 1) != faces_.end() && (host + 1)->key == host->key)
        bad_.add("lips", "element ", number, " is not on the outside");
    double depth = 0;
    for (const Index k : out_.block(host->cell.type).nodes(host->cell.cell)) depth += distance_[k];
    if ((depth > 0) != positive) bad_.add("lips", "element ", number, " is on the other side's tetrahedron");
    const Vec3 normal = (out_.points[n[1]] - out_.points[n[0]]).cross(out_.points[n[2]] - out_.points[n[0]]);
    // Only faces the crack made have a direction of their own.
    if (number > model_.largest_cell && (normal.dot(plane_.normal) < 0) != positive && !same_name_twin(c))
        bad_.add("lips", "element ", number, " points into the material");
}

void CrackChecker::lip_twins(const LipNodes& nodes) {
    const std::vector<std::string> names = family_names(out_, made_);
    for (const auto& [at, twins] : nodes[1]) {
        const auto other = nodes[0].find(at);
        if (other == nodes[0].end()) continue;
        for (const Index p : twins)
            for (const Index n : other->second) {
                if (p == n) bad_.add("lips", "node ", id(p), " is on both lips");
                if (names[out_.node_families[p]] != names[out_.node_families[n]])
                    bad_.add("node groups", "nodes ", id(p), " and ", id(n), ", doubles, are in '",
                             names[out_.node_families[p]], "' and '", names[out_.node_families[n]], "'");
            }
    }
}

void CrackChecker::interface_nodes(const LipNodes& nodes) {
    std::set<Index> named;
    for (const char* set : {"ICN", "ECN"})
        if (report_.node_sets.contains(set))
            named.insert(report_.node_sets.at(set).begin(), report_.node_sets.at(set).end());
    for (const Index i : named)
        if (const auto n = index_.find(i); n != index_.end() && !on_plane(n->second))
            bad_.add("node sets", "interface node ", i, " is ", distance_[n->second], " off the plane");
    std::set<Place> places, named_places;
    for (const auto& side : nodes)
        for (const auto& [at, those] : side)
            for (const Index n : those)
                if (!mid_nodes().contains(n)) places.insert(at);
    // And of those mid-side nodes of the lips that moved.
    std::size_t corners = 0;
    for (const Index i : named) {
        if (!index_.contains(i)) continue;
        const Index n = index_.at(i);
        if (!mid_nodes().contains(n)) {
            named_places.insert(place(n));
            ++corners;
        } else if (same_place(n) || !is_input_node(n)) {
            bad_.add("node sets", "mid-side node ", i, " is an interface node, but did not move");
        }
    }
    if (places != named_places || corners != named_places.size())
        bad_.add("node sets", "ICN and ECN name ", corners, " corner nodes in ", named_places.size(),
                 " places, the lips have ", places.size());
    if (const auto count = report_.constraints.find("plane");
        count == report_.constraints.end() || count->second != static_cast<Index>(named.size()))
        bad_.add("constraints", "plane constraints are not as many as interface nodes");
}

bool CrackChecker::same_name_twin(const CellRef& c) const {
    return out_.families.groups(out_.block(c.type).families[c.cell]).size() > 1;
}

void CrackChecker::section() {
    if (report_.held.largest > rounding * model_.size) return;  // it goes through nodes beside the plane
    const double wanted = section_measure(model_, plane_);
    for (const char* suffix : {"_P", "_N"}) {
        double measure = 0;
        for (const CellRef& c : lip(suffix)) {
            const auto n = out_.block(c.type).nodes(c.cell);
            if (is_triangle(c.type))
                measure += flat_area({out_.points[n[0]], out_.points[n[1]], out_.points[n[2]]});
            else if (is_line(c.type) && !model_.solid)
                measure += (out_.points[n[1]] - out_.points[n[0]]).norm();
        }
        const double allowed =
            rounding * std::max(wanted, model_.solid ? 1e-3 * model_.size * model_.size : 1e-3 * model_.size);
        if (std::abs(measure - wanted) > allowed + model_.section_slack(plane_))
            bad_.add("section", "lip ", name_, suffix, " has measure ", measure, ", the plane cuts ", wanted);
    }
}

}  // namespace femscalpel::checks
