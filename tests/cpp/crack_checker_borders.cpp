// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include "crack_checker.h"

namespace femscalpel::checks {

void CrackChecker::solid_conformity() {
    const std::vector<std::string> names = family_names(out_, made_);
    AreaByPlane skin;
    if (model_.flat) skin = planes_of(model_.skin).emptied();
    const auto corners = [&](const TetraFace& f) {
        return std::array<Vec3, 3>{out_.points[f.outward[0]], out_.points[f.outward[1]], out_.points[f.outward[2]]};
    };
    std::set<Index> on_skin, on_borders;
    const auto note = [&](const TetraFace& f, std::set<Index>& nodes) {
        for (const Index n : f.outward) nodes.insert(n);
        for (const Index n : f.mid)
            if (n >= 0) nodes.insert(n);
    };
    runs(faces_, [&](auto first, auto last) {
        const auto hosts = last - first;
        if (hosts > 2)
            bad_.add("conformity", "face ", id(first->key[0]), " ", id(first->key[1]), " ", id(first->key[2]),
                     " belongs to ", hosts, " tetrahedra");
        if (hosts == 2) {
            const auto family = [&](const TetraFace& f) { return out_.block(f.cell.type).families[f.cell.cell]; };
            if (names[family(*first)] == names[family(*(first + 1))]) return;
            note(*first, on_borders);
            return;
        }
        if (lip_keys().contains(first->key)) return;
        if (model_.flat) skin.add(corners(*first), model_.size);
        note(*first, on_skin);
    });
    if (model_.flat) {
        if (const std::string text = skin.differs(planes_of(model_.skin), model_.size, 0); !text.empty())
            bad_.add("skin", text);
        compare_borders();
        return;
    }
    nodes_stay(on_skin, model_.skin, "skin");
    nodes_stay(on_borders, model_.borders, "border");
}

void CrackChecker::compare_borders() {
    const auto areas = [&](const Mesh& mesh, const std::vector<TetraFace>& faces) {
        const std::vector<std::string> names = family_names(mesh, made_);
        std::map<std::string, double> sums;
        runs(faces, [&](auto first, auto last) {
            if (last - first != 2) return;
            const std::string &a = names[mesh.block(first->cell.type).families[first->cell.cell]],
                              &b = names[mesh.block((first + 1)->cell.type).families[(first + 1)->cell.cell]];
            const std::array<Vec3, 3> c{mesh.points[first->key[0]], mesh.points[first->key[1]],
                                        mesh.points[first->key[2]]};
            if (a == b ||
                std::ranges::all_of(c, [&](const Vec3& x) { return std::abs(plane_.distance(x)) <= tolerance(); }))
                return;
            sums[std::min(a, b) + "|" + std::max(a, b)] += flat_area(c);
            if (&mesh == &out_ && edges_away((c[0] + c[1] + c[2]) / 3, model_.borders, 1.0) > 1e-8)
                bad_.add("border", "a face between '", a, "' and '", b, "' left the border");
        });
        return sums;
    };
    auto before = areas(in_, tetra_faces(in_)), after = areas(out_, faces_);
    for (const auto& [pair, area] : before)
        if (std::abs(after[pair] - area) > rounding * area)
            bad_.add("border", "area between ", pair, ": ", area, " -> ", after[pair]);
    for (const auto& [pair, area] : after)
        if (!before.contains(pair)) bad_.add("border", "new border of area ", area, " between ", pair);
}

AreaByPlane CrackChecker::planes_of(const std::vector<Model::Face>& faces) const {
    AreaByPlane out;
    for (const Model::Face& f : faces) out.add(f.corner, model_.size);
    return out;
}

void CrackChecker::straightened() {
    const auto said = static_cast<std::size_t>(report_.straightened.count);
    if (beside_.size() > said)
        bad_.add("straightened", beside_.size(), " mid-side nodes are beside their surfaces, the report says ", said);
    if (said > 0 && std::ranges::none_of(report_.warnings, [](const std::string& w) {
            return w.find("in the middle of straight edges") != std::string::npos;
        }))
        bad_.add("straightened", "no warning says so");
}

const std::set<Index>& CrackChecker::mid_nodes() {
    if (mids_known_) return mid_nodes_;
    mids_known_ = true;
    // A mid-side node of the input may have become a corner where its edge was split.
    std::set<Index> corners;
    for (const CellBlock& b : out_.blocks())
        for (Index c = 0; c < b.size(); ++c)
            corners.insert(b.nodes(c).begin(), b.nodes(c).begin() + corners_of(b.type));
    for (const Mesh* mesh : {&in_, &out_})
        for (const CellBlock& b : mesh->blocks())
            if (is_second_order(b.type))
                for (Index c = 0; c < b.size(); ++c)
                    for (const Index n : b.nodes(c).subspan(static_cast<std::size_t>(corners_of(b.type))))
                        if (const Index k = index_.at(mesh->node_ids[n]); !corners.contains(k)) mid_nodes_.insert(k);
    return mid_nodes_;
}

void CrackChecker::shell_conformity() {
    std::set<Key2> opened, opening;
    for (const char* suffix : {"_P", "_N"})
        for (const CellRef& c : lip(suffix)) {
            const auto n = out_.block(c.type).nodes(c.cell);
            if (is_line(c.type)) opened.insert(ascending(Key2{n[0], n[1]}));
        }
    runs(edges_of(in_, is_triangle), [&](auto first, auto last) {
        const bool in_plane = std::ranges::all_of(
            first->key, [&](Index n) { return std::abs(plane_.distance(in_.points[n])) <= tolerance(); });
        if (in_plane && last - first > 1) opening.insert(first->key);
    });
    const auto after = border_lengths(
        out_, [&](const Key2& e) { return opened.contains(e); }, made_, nullptr);
    const auto before = border_lengths(
        in_, [&](const Key2& e) { return opening.contains(e); }, {}, nullptr);
    for (const auto& [what, length] : before) {
        const auto found = after.find(what);
        const double now = found == after.end() ? 0 : found->second;
        if (report_.held.largest <= rounding * model_.size &&
            std::abs(now - length) >
                rounding * std::max(length, 1e-3 * model_.size) + model_.curved_slack.at(what).length)
            bad_.add("border", "length of ", what, ": ", length, " -> ", now);
    }
    for (const auto& [what, length] : after)
        if (!before.contains(what)) bad_.add("border", "new border of length ", length, " between ", what);
    AreaByPlane areas = planes_of(model_.skin);
    AreaByPlane now = areas.emptied();
    for_each_cell(out_, is_triangle, [&](CellType, Index, std::span<const Index> n) {
        now.add({out_.points[n[0]], out_.points[n[1]], out_.points[n[2]]}, model_.size);
    });
    if (const std::string text = now.differs(areas, model_.size, model_.area_slack); !text.empty())
        bad_.add("skin", text);
}

void CrackChecker::attached() {
    if (model_.solid) {
        std::map<Key3, int> seen;
        const std::vector<std::string> names = family_names(out_, made_);
        for_each_cell(out_, is_triangle, [&](CellType type, Index c, std::span<const Index> n) {
            const Index number = out_.block(type).ids[c];
            if (model_.mixed && model_.loose_kinds.contains(names[out_.block(type).families[c]])) return;
            const Key3 key = ascending(Key3{n[0], n[1], n[2]});
            const auto host = std::ranges::lower_bound(faces_, key, {}, [](const TetraFace& f) { return f.key; });
            if (host == faces_.end() || host->key != key) {
                bad_.add("attached", "triangle ", number, " is on no tetrahedron's face");
                return;
            }
            if (is_second_order(type))
                for (int k = 0; k < 3; ++k) {
                    const int at = static_cast<int>(std::ranges::find(host->outward, n[k]) - host->outward.begin());
                    const bool forward = host->outward[(at + 1) % 3] == n[(k + 1) % 3];
                    if (host->mid[forward ? at : (at + 2) % 3] != n[3 + k])
                        bad_.add("attached", "triangle ", number, " has another mid-side node than its tetrahedron");
                }
            if (++seen[key] > 1 && !input_repeats())
                bad_.add("attached", "two triangles in one place, second is ", number);
        });
    }
    std::set<Key2> edges;
    std::vector<Key2> lines;
    std::vector<Index> numbers;
    for_each_cell(out_, is_line, [&](CellType type, Index c, std::span<const Index> n) {
        if (model_.loose_cells.contains(out_.block(type).ids[c])) return;
        lines.push_back(ascending(Key2{n[0], n[1]}));
        numbers.push_back(out_.block(type).ids[c]);
    });
    if (lines.empty()) return;
    const std::set<Key2> wanted(lines.begin(), lines.end());
    const auto collect = [&](CellType type, Index, std::span<const Index> n) {
        for (int a = 0; a < corners_of(type); ++a)
            for (int b = 0; b < a; ++b)
                if (const Key2 key = ascending(Key2{n[a], n[b]}); wanted.contains(key)) edges.insert(key);
    };
    // Only elements around the lines' nodes matter; the set look-up is what costs.
    std::vector<char> ends(out_.points.size(), 0);
    for (const Key2& l : lines) ends[l[0]] = ends[l[1]] = 1;
    const auto look = [&](CellType type, Index c, std::span<const Index> n) {
        int count = 0;
        for (int k = 0; k < corners_of(type); ++k) count += ends[n[k]];
        if (count >= 2) collect(type, c, n);
    };
    if (model_.solid) for_each_cell(out_, is_tetra, look);
    if (!model_.solid || model_.mixed) for_each_cell(out_, is_triangle, look);
    for (std::size_t k = 0; k < lines.size(); ++k)
        if (!edges.contains(lines[k])) bad_.add("attached", "segment ", numbers[k], " is on no element's edge");
}

bool CrackChecker::input_repeats() const {
    std::set<Key3> seen;
    bool repeats = false;
    for_each_cell(in_, is_triangle, [&](CellType, Index, std::span<const Index> n) {
        repeats = !seen.insert(ascending(Key3{n[0], n[1], n[2]})).second || repeats;
    });
    return repeats;
}

}  // namespace femscalpel::checks
