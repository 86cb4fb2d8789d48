// SPDX-License-Identifier: LGPL-2.1-or-later
#include "lip_checks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

namespace femscalpel::checks {
namespace {

class LipChecker {
public:
    LipChecker(const Model& model, const CrackSurface& surface, const Result& result)
        : model_(model), surface_(surface), before_(model.mesh), after_(result.mesh), report_(result.report) {}

    std::vector<std::string> run() {
        try {
            after_.validate();
        } catch (const std::exception& e) {
            say("valid", e.what());
            return out_;
        }
        numbers();
        shapes();
        measures();
        lips();
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

    const Vec3& at(Index n) const { return after_.points[n]; }
    double tolerance() const { return 1e-9 * model_.size; }

    /// What the report counts is what changed; old numbers are kept, and new ones are above them.
    void numbers() {
        std::map<Index, Index> now;
        for (Index n = 0; n < after_.node_count(); ++n) now.emplace(after_.node_ids[n], n);
        Index moved = 0, fresh = 0;
        for (Index n = 0; n < after_.node_count(); ++n) {
            const auto old = model_.node_index.find(after_.node_ids[n]);
            if (old != model_.node_index.end())
                moved += before_.points[old->second] != at(n);
            else if (++fresh; after_.node_ids[n] <= model_.largest_node)
                say("number", "new node ", after_.node_ids[n], " is not above the largest in use");
        }
        for (const auto& [id, n] : model_.node_index)
            if (!now.contains(id)) say("number", "node ", id, " is gone");
        if (moved != report_.nodes_moved) say("report", moved, " nodes moved, reported ", report_.nodes_moved);
        if (fresh != report_.nodes_added) say("report", fresh, " nodes new, reported ", report_.nodes_added);
    }

    void shapes() {
        for (const CellBlock& b : after_.blocks())
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                const bool tetra = b.type == CellType::tetra || b.type == CellType::tetra10,
                           triangle = b.type == CellType::triangle || b.type == CellType::triangle6;
                if (tetra && !(tetra_shape(at(n[0]), at(n[1]), at(n[2]), at(n[3])) > 1e-6))
                    say("inverted", "element ", b.ids[c]);
                if (!model_.solid && triangle && !(triangle_shape(at(n[0]), at(n[1]), at(n[2])) > 1e-6))
                    say("flat", "element ", b.ids[c]);
            }
    }

    /// Groups of the mesh's dimension are as large as before; so are groups of faces that the crack does not open.
    void measures() {
        const std::vector<GroupSum> sums = group_sums(after_);
        for (std::size_t g = 0; g < before_.groups.size(); ++g) {
            const GroupSum& was = model_.sums[g];
            if (after_.groups[g].name != before_.groups[g].name) {
                say("group", before_.groups[g].name, " is lost");
                continue;
            }
            if (was.count > 0 && sums[g].count == 0) say("group", before_.groups[g].name, " became empty");
            if (before_.groups[g].hidden || was.dimension != (model_.solid ? 3 : 2) ||
                before_.groups[g].kind != GroupKind::element)
                continue;
            const double slack = model_.flat ? 1e-9 * was.measure + model_.group_slack[g] : 1e-2 * was.measure;
            if (std::abs(sums[g].measure - was.measure) > slack)
                say("measure", before_.groups[g].name, " ", was.measure, " -> ", sums[g].measure, ", allowed ", slack);
        }
    }

    void lips() {
        std::array<std::set<std::vector<Index>>, 2> faces;
        std::array<std::multiset<std::vector<std::array<double, 3>>>, 2> corners;
        for (int side = 0; side < 2; ++side) {
            const auto g = after_.find_group(side ? "CRACK_N" : "CRACK_P", GroupKind::element);
            if (!g) {
                say("lips", "a lip's group is missing");
                return;
            }
            for (const CellBlock& b : after_.blocks())
                for (Index c = 0; c < b.size(); ++c) {
                    if (!after_.families.contains(b.families[c], *g)) continue;
                    const auto n = b.nodes(c).first(static_cast<std::size_t>(traits(b.type).corners));
                    for (const Index v : n) {
                        // What is held beside the tool is reported.
                        if (std::abs(surface_.distance(at(v))) > tolerance() + report_.held.largest)
                            say("off the tool", "node ", after_.node_ids[v], " by ", surface_.distance(at(v)));
                        if (surface_.border && surface_.border(at(v)) > 1e3 * tolerance() + report_.held.largest)
                            say("beyond the front", "node ", after_.node_ids[v], " by ", surface_.border(at(v)));
                    }
                    std::vector<Index> key(n.begin(), n.end());
                    std::ranges::sort(key);
                    std::vector<std::array<double, 3>> places;
                    for (const Index v : n) places.push_back({at(v)[0], at(v)[1], at(v)[2]});
                    std::ranges::sort(places);
                    faces[side].insert(key);
                    corners[side].insert(places);
                }
        }
        if (faces[0].empty()) say("lips", "there are none");
        // Two faces of the same nodes do not open.
        for (const auto& key : faces[0])
            if (faces[1].contains(key)) say("closed", "a face (edge) of the crack has the same nodes on both lips");
        if (corners[0] != corners[1])
            say("lips", "are not coincident: ", corners[0].size(), " against ", corners[1].size(), " faces");
        conforming(faces);
        front(faces);
    }

    /// Away from the lips faces are shared as before: what is free of a neighbour is skin or lip.
    void conforming(const std::array<std::set<std::vector<Index>>, 2>& lips) {
        if (!model_.solid) return;
        double skin = 0, wanted = 0;
        const std::vector<TetraFace> all = tetra_faces(after_);
        for (std::size_t i = 0, end = 0; i < all.size(); i = end) {
            for (end = i; end < all.size() && all[end].key == all[i].key;) ++end;
            if (end - i > 2) say("conforming", "a face of ", end - i, " elements");
            const std::vector<Index> key(all[i].key.begin(), all[i].key.end());
            if (end - i == 1 && !lips[0].contains(key) && !lips[1].contains(key))
                skin += (at(key[1]) - at(key[0])).cross(at(key[2]) - at(key[0])).norm() / 2;
        }
        for (const Model::Face& f : model_.skin)
            wanted += (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]).norm() / 2;
        if (std::abs(skin - wanted) > (model_.flat ? 1e-9 : 1e-2) * wanted) say("skin", "area ", wanted, " -> ", skin);
    }

    /// The front is single, on the border, and in order.
    void front(const std::array<std::set<std::vector<Index>>, 2>& lips) {
        if (!surface_.border || !model_.solid) return;
        // Edges of one face of a lip that both lips have: there the crack ends.
        std::map<std::array<Index, 2>, int> edges[2];
        for (int side = 0; side < 2; ++side)
            for (const auto& f : lips[side])
                for (int a = 0; a < 3; ++a)
                    for (int b = a + 1; b < 3; ++b) ++edges[side][{f[a], f[b]}];
        std::set<std::array<Index, 2>> expected, named;
        for (const auto& [e, count] : edges[0])
            if (count == 1 && edges[1].contains(e)) expected.insert(e);
        const auto g = after_.find_group("CRACK_FRONT", GroupKind::element);
        if (!g) {
            if (!expected.empty()) say("front", "its group is missing");
            return;
        }
        for (const CellBlock& b : after_.blocks())
            for (Index c = 0; c < b.size(); ++c) {
                if (!after_.families.contains(b.families[c], *g)) continue;
                const auto n = b.nodes(c);
                named.insert({std::min(n[0], n[1]), std::max(n[0], n[1])});
                for (const Index v : n.first(2))
                    if (std::abs(surface_.border(at(v))) > 1e3 * tolerance())
                        say("front", "node ", after_.node_ids[v], " is ", surface_.border(at(v)), " off the border");
            }
        if (named != expected) say("front", named.size(), " segments, the lips part along ", expected.size());
    }

    const Model& model_;
    const CrackSurface& surface_;
    const Mesh &before_, &after_;
    const Report& report_;
    std::map<std::string, int> said_;
    std::vector<std::string> out_;
};

}  // namespace

std::vector<std::string> check_lips(const Model& model, const CrackSurface& surface, const Result& result) {
    return LipChecker(model, surface, result).run();
}

Tangency::Tangency(const Model& model) : model_(model) {
    std::map<std::array<std::array<double, 3>, 2>, std::vector<Vec3>> normals;
    for (const auto* faces : {&model.skin, &model.borders})
        for (const Model::Face& f : *faces)
            for (int k = 0; k < 3; ++k) {
                std::array<std::array<double, 3>, 2> key;
                for (int e = 0; e < 2; ++e)
                    for (int a = 0; a < 3; ++a) key[e][a] = f.corner[(k + e) % 3][a];
                std::ranges::sort(key);
                normals[key].push_back(f.normal);
            }
    for (const auto& [key, n] : normals) {
        if (n.size() == 2 && n[0].cross(n[1]).norm() < std::sin(20 * std::numbers::pi / 180)) continue;
        Model::Segment s;
        for (int e = 0; e < 2; ++e) s.end[e] = Vec3(key[e][0], key[e][1], key[e][2]);
        creases_.push_back(s);
    }
    if (!model.solid) creases_.insert(creases_.end(), model.lines.begin(), model.lines.end());
}

bool Tangency::of(const std::function<double(const Vec3&)>& distance, double radius) const {
    const double sine = std::sin(5 * std::numbers::pi / 180);
    const auto gradient = [&](const Vec3& x) {
        const double h = 1e-6 * model_.size;
        Vec3 g;
        for (int a = 0; a < 3; ++a)
            g[a] = (distance(x + h * Vec3::Unit(a)) - distance(x - h * Vec3::Unit(a))) / (2 * h);
        return Vec3(g.normalized());
    };
    // Refined elements are half a radius long.
    const auto near = [&](double d, double edge) { return std::abs(d) < 0.15 * std::min(edge, radius / 2); };
    const auto samples = [&](double edge) { return std::clamp(static_cast<int>(edge / (0.08 * radius)) + 2, 2, 16); };
    for (const auto* faces : {&model_.skin, &model_.borders})
        for (const Model::Face& f : *faces) {
            if (std::abs(distance(f.centre)) > 1.5 * f.edge) continue;
            const int n = samples(f.edge);
            for (int i = 0; i <= n; ++i)
                for (int j = 0; i + j <= n; ++j) {
                    const Vec3 x =
                        f.corner[0] + (f.corner[1] - f.corner[0]) * i / n + (f.corner[2] - f.corner[0]) * j / n;
                    if (near(distance(x), f.edge) && gradient(x).cross(f.normal).norm() < sine) return true;
                }
        }
    for (const Model::Segment& s : creases_) {
        const double edge = (s.end[1] - s.end[0]).norm();
        if (std::abs(distance((s.end[0] + s.end[1]) / 2)) > edge) continue;
        const int n = samples(edge);
        for (int i = 0; i <= n; ++i) {
            const Vec3 x = s.end[0] + (s.end[1] - s.end[0]) * i / n;
            if (near(distance(x), edge) && std::abs(gradient(x).dot(s.end[1] - s.end[0])) < sine * edge) return true;
        }
    }
    return false;
}

bool Tangency::of_curve(const std::vector<Vec3>& points, double radius) const {
    const double sine = std::sin(5 * std::numbers::pi / 180);
    std::vector<std::pair<Vec3, Vec3>> places;  // and directions
    for (std::size_t k = 1; k < points.size(); ++k) {
        const Vec3 along = points[k] - points[k - 1];
        const int n = std::clamp(static_cast<int>(along.norm() / (0.01 * model_.size)), 1, 200);
        for (int i = 0; i < n; ++i) places.emplace_back(points[k - 1] + along * (i + 0.5) / n, along.normalized());
    }
    for (const auto* faces : {&model_.skin, &model_.borders})
        for (const Model::Face& f : *faces) {
            const Vec3 low = f.corner[0].cwiseMin(f.corner[1]).cwiseMin(f.corner[2]).array() - f.edge / 2,
                       high = f.corner[0].cwiseMax(f.corner[1]).cwiseMax(f.corner[2]).array() + f.edge / 2;
            for (const auto& [x, along] : places)
                if ((x.array() >= low.array()).all() && (x.array() <= high.array()).all() &&
                    std::abs(f.normal.dot(x - f.corner[0])) < 0.15 * std::min(f.edge, radius / 2) &&
                    std::abs(along.dot(f.normal)) < sine)
                    return true;
        }
    return false;
}

}  // namespace femscalpel::checks
