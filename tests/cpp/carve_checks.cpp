// SPDX-License-Identifier: LGPL-2.1-or-later
#include "carve_checks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace femscalpel::checks {
namespace {

class Checker {
public:
    Checker(const Model& model, const Carved& carved, const Result& result)
        : model_(model), carved_(carved), before_(model.mesh), after_(result.mesh), report_(result.report) {}

    std::vector<std::string> run() {
        for (Index n = 0; n < after_.node_count(); ++n) index_.emplace(after_.node_ids[n], n);
        try {
            after_.validate();
        } catch (const std::exception& e) {
            say("valid", e.what());
            return out_;
        }
        numbers();
        shapes();
        if (model_.solid)
            faces();
        else
            edges();
        attached();
        no_orphans();
        memberships();
        return out_;
    }

private:
    template <class... Parts>
    void say(const char* what, const Parts&... parts) {
        if (++said_[what] > 3) return;
        std::ostringstream text;
        text << what << ": ";
        (text << ... << parts);
        out_.push_back(text.str());
    }

    void for_each(auto wanted, auto visit) const {
        for (const CellBlock& b : after_.blocks())
            if (wanted(b.type))
                for (Index c = 0; c < b.size(); ++c) visit(b, c, b.nodes(c));
    }
    static bool is_tetra(CellType t) { return t == CellType::tetra || t == CellType::tetra10; }
    static bool is_triangle(CellType t) { return t == CellType::triangle || t == CellType::triangle6; }
    static bool is_line(CellType t) { return t == CellType::line || t == CellType::line3; }
    const Vec3& at(Index n) const { return after_.points[n]; }
    bool untouched(Index n) const {
        const auto old = model_.node_index.find(after_.node_ids[n]);
        return old != model_.node_index.end() && before_.points[old->second] == at(n);
    }
    template <std::size_t N>
    static std::array<Index, N> ascending(std::array<Index, N> key) {
        std::ranges::sort(key);
        return key;
    }

    void numbers() {
        Index moved = 0, kept = 0;
        for (Index n = 0; n < after_.node_count(); ++n) {
            const auto old = model_.node_index.find(after_.node_ids[n]);
            if (old == model_.node_index.end()) {
                if (after_.node_ids[n] <= model_.largest_node)
                    say("number", "new node ", after_.node_ids[n], " is not above the largest in use");
                continue;
            }
            ++kept;
            moved += before_.points[old->second] != at(n);
        }
        if (moved != report_.nodes_moved) say("report", moved, " nodes moved, reported ", report_.nodes_moved);
        if (before_.node_count() - kept != report_.nodes_removed)
            say("report", before_.node_count() - kept, " nodes gone, reported ", report_.nodes_removed);
        if (after_.node_count() - kept != report_.nodes_added)
            say("report", after_.node_count() - kept, " nodes new, reported ", report_.nodes_added);
        std::set<Index> old_cells;
        for (const CellBlock& b : before_.blocks()) old_cells.insert(b.ids.begin(), b.ids.end());
        Index cells_kept = 0;
        for (const CellBlock& b : after_.blocks())
            for (const Index id : b.ids) cells_kept += old_cells.contains(id);
        const Index gone = static_cast<Index>(old_cells.size()) - cells_kept;
        if (gone != report_.elements_removed)
            say("report", gone, " elements gone, reported ", report_.elements_removed);
        if (after_.cell_count() - cells_kept != report_.elements_added)
            say("report", after_.cell_count() - cells_kept, " elements new, reported ", report_.elements_added);
    }

    void shapes() {
        for_each([](CellType t) { return is_tetra(t); },
                 [&](const CellBlock& b, Index c, std::span<const Index> n) {
                     if (!(tetra_shape(at(n[0]), at(n[1]), at(n[2]), at(n[3])) > 1e-6))
                         say("inverted", "element ", b.ids[c]);
                     inside("element", b.ids[c], n.first(4));
                 });
        if (model_.solid) return;
        for_each([](CellType t) { return is_triangle(t); },
                 [&](const CellBlock& b, Index c, std::span<const Index> n) {
                     if (!(triangle_shape(at(n[0]), at(n[1]), at(n[2])) > 1e-6)) say("flat", "element ", b.ids[c]);
                     inside("element", b.ids[c], n.first(3));
                 });
    }

    /// The middle of an element that is left must not lie in what was to be removed, but for the chords of a curved
    /// wall.
    void inside(const char* what, Index id, std::span<const Index> n) {
        Vec3 middle = Vec3::Zero();
        double longest = 0;
        for (const Index v : n) {
            middle += at(v) / static_cast<double>(n.size());
            for (const Index w : n) longest = std::max(longest, (at(v) - at(w)).norm());
        }
        const double depth = carved_.depth(middle);
        if (depth < -(1e-9 * model_.size + carved_.sag * longest * longest))
            say("left inside", what, " ", id, " by ", -depth, ", size ", longest);
    }

    std::vector<const Carved::Wall*> walls_of(FamilyIndex family) const {
        std::vector<const Carved::Wall*> out;
        for (const Carved::Wall& w : carved_.walls) {
            const auto g = after_.find_group(w.group, GroupKind::element);
            if (g && after_.families.contains(family, *g)) out.push_back(&w);
        }
        return out;
    }

    /// Each face of a single tetrahedron is in a wall group, on that wall, or else on the old skin.
    void faces() {
        std::map<Key3, std::vector<const Carved::Wall*>> wall;
        std::map<Key3, std::array<Index, 3>> turned;
        std::map<Key3, bool> is_new;  // an element that was there, or part of one, keeps its own direction
        for_each([](CellType t) { return is_triangle(t); },
                 [&](const CellBlock& b, Index c, std::span<const Index> n) {
                     const auto walls = walls_of(b.families[c]);
                     if (walls.empty()) return;
                     wall[ascending(Key3{n[0], n[1], n[2]})] = walls;
                     turned[ascending(Key3{n[0], n[1], n[2]})] = {n[0], n[1], n[2]};
                     is_new[ascending(Key3{n[0], n[1], n[2]})] = std::ranges::none_of(
                         after_.families.groups(b.families[c]),
                         [&](GroupIndex g) { return static_cast<std::size_t>(g) < before_.groups.size(); });
                     for (const Index v : n)
                         if (v == n[0] || v == n[1] || v == n[2])
                             for (const auto* w : walls)
                                 if (std::abs(w->distance(at(v))) > 1e-9 * model_.size + report_.held.largest)
                                     say("off the wall", w->group, " node ", after_.node_ids[v], " by ",
                                         w->distance(at(v)));
                 });
        const std::vector<TetraFace> all = tetra_faces(after_);
        std::size_t met = 0;
        for (std::size_t i = 0; i < all.size();) {
            std::size_t end = i;
            while (end < all.size() && all[end].key == all[i].key) ++end;
            if (end - i > 2) say("conforming", "a face of ", end - i, " elements");
            const auto w = wall.find(all[i].key);
            if (end - i == 1) {
                if (w != wall.end()) {
                    ++met;
                    const auto& o = all[i].outward;
                    const auto& t = turned.at(all[i].key);
                    const bool same = (t[0] == o[0] && t[1] == o[1]) || (t[0] == o[1] && t[1] == o[2]) ||
                                      (t[0] == o[2] && t[1] == o[0]);
                    if (!same && is_new.at(all[i].key)) ++wrong_way_;
                } else if (std::ranges::any_of(all[i].key, [&](Index n) { return !untouched(n); })) {
                    on_old_skin(all[i].key);
                }
            } else if (w != wall.end()) {
                say("wall", "a wall face has material on both sides");
            }
            i = end;
        }
        if (met != wall.size()) say("wall", wall.size() - met, " wall faces are not on the surface");
        if (wrong_way_ > 0) say("wall", wrong_way_, " wall faces are turned the wrong way");
    }

    void on_old_skin(const Key3& face) {
        if (!model_.flat) return;
        const Vec3 middle = (at(face[0]) + at(face[1]) + at(face[2])) / 3;
        double nearest = 1e300;
        for (const Model::Face& f : model_.skin)
            if ((middle - f.centre).norm() <= 2 * f.radius)
                nearest = std::min(nearest, std::abs(f.normal.dot(middle - f.corner[0])));
        if (nearest > 1e-9 * model_.size)
            say("skin", "a new surface face at ", middle.transpose(), " is in no wall group and ", nearest,
                " off the old skin");
    }

    /// Each edge of a single shell is in a wall group, or else was one.
    void edges() {
        std::map<Key2, std::vector<const Carved::Wall*>> wall;
        for_each([](CellType t) { return is_line(t); },
                 [&](const CellBlock& b, Index c, std::span<const Index> n) {
                     const auto walls = walls_of(b.families[c]);
                     if (walls.empty()) return;
                     wall[ascending(Key2{n[0], n[1]})] = walls;
                     for (const Index v : n.first(2))
                         for (const auto* w : walls)
                             if (std::abs(w->distance(at(v))) > 1e-9 * model_.size + report_.held.largest)
                                 say("off the wall", w->group, " node ", after_.node_ids[v], " by ",
                                     w->distance(at(v)));
                 });
        std::map<Key2, int> count, old_count;
        for_each([](CellType t) { return is_triangle(t); },
                 [&](const CellBlock&, Index, std::span<const Index> n) {
                     for (int k = 0; k < 3; ++k) ++count[ascending(Key2{n[k], n[(k + 1) % 3]})];
                 });
        for (const auto& [key, w] : wall)
            if (!count.contains(key)) say("wall", "a wall segment is on no shell");
        std::map<std::string, int> lonely;
        for (const auto& [key, shells] : count)
            if (shells == 1 && !wall.contains(key) &&
                std::ranges::any_of(key, [&](Index n) { return !untouched(n); })) {
                const Vec3 middle = (at(key[0]) + at(key[1])) / 2;
                double nearest = 1e300, edge = (at(key[0]) - at(key[1])).norm();
                for (const Model::Segment& s : model_.lines) {
                    const Vec3 along = s.end[1] - s.end[0];
                    const double t = std::clamp(along.dot(middle - s.end[0]) / along.squaredNorm(), 0.0, 1.0);
                    nearest = std::min(nearest, (middle - s.end[0] - t * along).norm());
                }
                // Where the old rim is a polygon, its nodes may dent it a little.
                if (model_.flat && nearest > 0.15 * edge)
                    say("rim", "an edge of one shell at ", middle.transpose(), " is in no wall group and ", nearest,
                        " off any old rim");
            }
    }

    /// Triangles and segments that were on something still are.
    void attached() {
        if (!model_.solid || model_.mixed) return;
        std::set<Key3> host;
        std::set<Key2> host_edges;
        for (const TetraFace& f : tetra_faces(after_)) {
            host.insert(f.key);
            for (int k = 0; k < 3; ++k) host_edges.insert(ascending(Key2{f.outward[k], f.outward[(k + 1) % 3]}));
        }
        for_each([](CellType t) { return is_triangle(t); },
                 [&](const CellBlock& b, Index c, std::span<const Index> n) {
                     if (!host.contains(ascending(Key3{n[0], n[1], n[2]})))
                         say("attached", "triangle ", b.ids[c], " is on no tetrahedron");
                 });
        for_each([](CellType t) { return is_line(t); },
                 [&](const CellBlock& b, Index c, std::span<const Index> n) {
                     if (!model_.loose_cells.contains(b.ids[c]) && !host_edges.contains(ascending(Key2{n[0], n[1]})))
                         say("attached", "segment ", b.ids[c], " is on no tetrahedron");
                 });
    }

    /// No node is left without an element that had one.
    void no_orphans() {
        std::vector<char> used(after_.points.size(), 0), was(before_.points.size(), 0);
        for (const CellBlock& b : after_.blocks())
            for (const Index n : b.connectivity) used[n] = 1;
        for (const CellBlock& b : before_.blocks())
            for (const Index n : b.connectivity) was[n] = 1;
        for (Index n = 0; n < after_.node_count(); ++n) {
            const auto old = model_.node_index.find(after_.node_ids[n]);
            if (!used[n] && (old == model_.node_index.end() || was[old->second]))
                say("orphan", "node ", after_.node_ids[n]);
        }
        for (const auto& [id, old] : model_.node_index)
            if (!was[old] && !index_.contains(id)) say("orphan", "node ", id, ", which never had an element, is gone");
    }

    /// Elements that are left keep their groups; so do nodes. Every group is still there.
    void memberships() {
        for (std::size_t g = 0; g < before_.groups.size(); ++g) {
            const Group& group = before_.groups[g];
            if (!after_.find_group(group.name, group.kind, group.hidden)) say("group", group.name, " is lost");
        }
        const auto same = [&](FamilyIndex was, FamilyIndex is) {
            std::set<std::string> a, b;
            for (const GroupIndex g : before_.families.groups(was)) a.insert(before_.groups[g].name);
            for (const GroupIndex g : after_.families.groups(is))
                if (static_cast<std::size_t>(g) < before_.groups.size()) b.insert(after_.groups[g].name);
            return a == b;
        };
        std::map<Index, FamilyIndex> old;
        for (const CellBlock& b : before_.blocks())
            for (Index c = 0; c < b.size(); ++c) old.emplace(b.ids[c], b.families[c]);
        for (const CellBlock& b : after_.blocks())
            for (Index c = 0; c < b.size(); ++c)
                if (const auto it = old.find(b.ids[c]); it != old.end() && !same(it->second, b.families[c]))
                    say("group", "element ", b.ids[c], " changed groups");
        for (Index n = 0; n < after_.node_count(); ++n)
            if (const auto it = model_.node_index.find(after_.node_ids[n]);
                it != model_.node_index.end() && !same(before_.node_families[it->second], after_.node_families[n]))
                say("group", "node ", after_.node_ids[n], " changed groups");
        // Where a group of solids does not meet the tool, nothing of it may change.
        const std::vector<GroupSum> sums = group_sums(after_);
        for (std::size_t g = 0; g < before_.groups.size(); ++g) {
            const double was = model_.sums[g].measure, is = sums[g].measure;
            if (model_.flat && !before_.groups[g].hidden && is > was * (1 + 1e-9) + 1e-12 + model_.group_slack[g])
                say("measure", before_.groups[g].name, " grew from ", was, " to ", is);
        }
    }

    const Model& model_;
    const Carved& carved_;
    const Mesh &before_, &after_;
    const Report& report_;
    std::map<Index, Index> index_;
    std::map<std::string, int> said_;
    int wrong_way_ = 0;
    std::vector<std::string> out_;
};

}  // namespace

std::vector<std::string> check_carved(const Model& model, const Carved& carved, const Result& result) {
    return Checker(model, carved, result).run();
}

double measure_of(const Mesh& mesh, const std::string& group) {
    const auto g = mesh.find_group(group, GroupKind::element);
    return g ? group_sums(mesh)[*g].measure : 0;
}

}  // namespace femscalpel::checks
