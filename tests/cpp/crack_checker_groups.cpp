// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>

#include "crack_checker.h"

namespace femscalpel::checks {
namespace {

double curved_area(const Model::Face& f) { return face_area(f.corner, f.mid, f.curved).second; }

}  // namespace

void CrackChecker::groups() {
    sums_ = group_sums(out_);
    for (std::size_t g = 0; g < in_.groups.size(); ++g) {
        if (in_.groups[g].hidden || in_.groups[g].kind == GroupKind::node) continue;
        if (g >= out_.groups.size() || out_.groups[g].name != in_.groups[g].name ||
            out_.groups[g].kind != in_.groups[g].kind) {
            bad_.add("group", "'", in_.groups[g].name, "' is gone or has moved");
            continue;
        }
        const GroupSum &a = model_.sums[g], &b = sums_[g];
        // What lies in the crack is there twice.
        const double twice = doubled_measure(static_cast<GroupIndex>(g));
        const double allowed = (model_.flat ? rounding : 0.01) * a.measure + model_.group_slack[g];
        if (std::abs(b.measure - a.measure - twice) > allowed)
            bad_.add("group", "'", in_.groups[g].name, "': measure ", a.measure, " -> ", b.measure);
        if (twice == 0 && (b.normal_area - a.normal_area).norm() > allowed)
            bad_.add("group", "'", in_.groups[g].name, "': faces turned round");
        if (a.count > 0 && b.count == 0) bad_.add("group", "'", in_.groups[g].name, "' became empty");
        if (model_.flat || in_.groups[g].kind != GroupKind::element) continue;
        std::set<Index> on_faces, on_lines;
        for (const CellBlock& block : out_.blocks())
            for (Index c = 0; c < block.size(); ++c)
                if ((is_triangle(block.type) || is_line(block.type)) &&
                    out_.families.contains(block.families[c], static_cast<GroupIndex>(g)))
                    for (const Index n : block.nodes(c)) (is_line(block.type) ? on_lines : on_faces).insert(n);
        nodes_stay(on_faces, model_.group_faces[g], "face group");
        nodes_stay(on_lines, model_.group_segments[g], "line group");
    }
}

double CrackChecker::doubled_measure(GroupIndex g) const {
    if (in_.groups[g].kind != GroupKind::element || model_.sums[g].dimension == 3) return 0;
    std::set<std::vector<std::array<double, 3>>> places;
    double measure = 0;
    for (const CellBlock& b : out_.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            if (!out_.families.contains(b.families[c], g) ||
                !std::ranges::all_of(n, [&](Index k) { return on_plane(k); }))
                continue;
            std::vector<std::array<double, 3>> place;
            for (const Index k : n) place.push_back({out_.points[k].x(), out_.points[k].y(), out_.points[k].z()});
            std::ranges::sort(place);
            if (places.insert(place).second) continue;
            if (is_line(b.type) && model_.sums[g].dimension == 1)
                measure += segment_length(out_.points[n[0]], out_.points[n[1]], out_.points[n.back()], n.size() == 3);
            else if (is_triangle(b.type) && n.size() == 3)
                measure += flat_area({out_.points[n[0]], out_.points[n[1]], out_.points[n[2]]});
            else if (is_triangle(b.type))
                measure += curved_area(make_face(out_, {n[0], n[1], n[2]}, {n[3], n[4], n[5]}));
        }
    return measure;
}

void CrackChecker::node_groups() {
    for (std::size_t g = 0; g < in_.groups.size(); ++g) {
        if (in_.groups[g].hidden || in_.groups[g].kind != GroupKind::node) continue;
        const auto group = static_cast<GroupIndex>(g);
        std::set<Index> now;
        for (std::size_t n = 0; n < out_.points.size(); ++n)
            if (out_.families.contains(out_.node_families[n], group)) now.insert(static_cast<Index>(n));
        for (std::size_t n = 0; n < in_.points.size(); ++n) {
            const Index after = index_.at(in_.node_ids[n]);
            if (in_.families.contains(in_.node_families[n], group) != now.contains(after))
                bad_.add("node groups", "node ", in_.node_ids[n], now.contains(after) ? " joined '" : " left '",
                         in_.groups[g].name, "'");
        }
        if (model_.group_twin[g] < 0) continue;
        std::set<Index> of_elements;
        for (const CellBlock& b : out_.blocks())
            for (Index c = 0; c < b.size(); ++c)
                if (out_.families.contains(b.families[c], model_.group_twin[g]))
                    for (const Index n : b.nodes(c)) of_elements.insert(n);
        for (const Index n : of_elements)
            if (!now.contains(n))
                bad_.add("node groups", "node ", id(n), is_input_node(n) ? "" : " (new)", " of elements of '",
                         in_.groups[g].name, "' is not in the node group");
        if (!model_.group_planar[g]) continue;
        // A doubled node stays a member on both sides, also where the group's elements are all on one.
        for (const Index n : now)
            if (!of_elements.contains(n) && !on_plane(n))
                bad_.add("node groups", "node ", id(n), is_input_node(n) ? "" : " (new)", " is in node group '",
                         in_.groups[g].name, "' but off its elements");
    }
}

void CrackChecker::report() {
    const auto expect = [&](const char* what, auto reported, auto counted) {
        if (reported != counted) bad_.add("report", what, " is ", reported, ", counted ", counted);
    };
    const Index fresh = out_.node_count() - in_.node_count();
    expect("nodes_added", report_.nodes_added, fresh);
    expect("nodes_split + nodes_doubled", report_.nodes_split + report_.nodes_doubled, fresh);
    expect("elements_removed", report_.elements_removed, gone_);
    expect("elements_added", report_.elements_added, out_.cell_count() - in_.cell_count() + gone_);
    Index moved = 0;
    double farthest = 0;
    for (std::size_t n = 0; n < out_.points.size(); ++n)
        if (is_input_node(static_cast<Index>(n)) && !same_place(static_cast<Index>(n))) {
            ++moved;
            farthest = std::max(farthest, (out_.points[n] - in_.points[model_.node_index.at(out_.node_ids[n])]).norm());
        }
    expect("nodes_moved", report_.nodes_moved, moved);
    if (std::abs(report_.max_displacement - farthest) > tolerance())
        expect("max_displacement", report_.max_displacement, farthest);
    expect("quality_after.count", report_.quality_after.count, band_count_);
    if (std::abs(report_.quality_after.minimum - band_minimum_) > rounding)
        expect("quality_after.minimum", report_.quality_after.minimum, band_minimum_);
    std::size_t record = 0;
    for (std::size_t g = 0; g < out_.groups.size(); ++g) {
        if (out_.groups[g].hidden) continue;
        if (record >= report_.groups.size()) {
            bad_.add("report", "has no record of group '", out_.groups[g].name, "'");
            return;
        }
        const GroupRecord& r = report_.groups[record++];
        const GroupSum was = g < in_.groups.size() ? model_.sums[g] : GroupSum{};
        const std::string text = "group '" + r.name + "': ";
        if (r.name != out_.groups[g].name || r.kind != out_.groups[g].kind)
            bad_.add("report", "record of '", r.name, "' where '", out_.groups[g].name, "' was expected");
        expect((text + "count_before").c_str(), r.count_before, was.count);
        expect((text + "count_after").c_str(), r.count_after, sums_[g].count);
        if (r.kind == GroupKind::element && sums_[g].count > 0)
            expect((text + "dimension").c_str(), r.dimension, sums_[g].dimension);
        // Six-node faces have no exact rule: two good ones differ in the last digits that matter.
        const double allowed = is_flat_measure(r) ? rounding : 1e-4;
        if (std::abs(r.measure_before - was.measure) > allowed * was.measure)
            expect((text + "measure_before").c_str(), r.measure_before, was.measure);
        if (std::abs(r.measure_after - sums_[g].measure) > allowed * std::max(was.measure, sums_[g].measure))
            expect((text + "measure_after").c_str(), r.measure_after, sums_[g].measure);
        // Shortcuts of a node group through the material may drift.
        if (!(r.kind == GroupKind::node && model_.solid) &&
            r.boundary_drift > (model_.flat ? rounding * model_.size : 1e-3 * model_.size))
            bad_.add("report", text, "boundary drift ", r.boundary_drift);
    }
    if (record != report_.groups.size())
        bad_.add("report", "has ", report_.groups.size(), " group records, there are ", record, " groups");
}

bool CrackChecker::is_flat_measure(const GroupRecord& r) const {
    return r.kind == GroupKind::node || r.dimension == 3 ||
           (in_.block(CellType::triangle6).size() == 0 && in_.block(CellType::line3).size() == 0 &&
            in_.block(CellType::tetra10).size() == 0);
}

}  // namespace femscalpel::checks
