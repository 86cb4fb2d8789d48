// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/conversion.h"

#include <algorithm>

#include "cancel.h"

namespace femscalpel {
namespace {

using QuadSet = QuadTable<char>;

bool has_middles(CellType type) { return type == CellType::hexahedron27 || type == CellType::wedge18; }

class Planner {
public:
    Planner(const Mesh& mesh, std::span<const CellRef> unfit, std::vector<PyramidRule> rules)
        : mesh_(mesh), unfit_(unfit), rules_(std::move(rules)) {
        for (const CellBlock& b : mesh.blocks())
            if (!traits(b.type).simplex)
                chosen_[static_cast<int>(b.type)].assign(static_cast<std::size_t>(b.size()), 0);
    }

    Conversion run(const std::vector<std::int8_t>& level, const Adjacency* adjacency) {
        std::vector<CellRef> reached;
        const CellLists near = elements_near(mesh_, level, adjacency);
        for (const CellBlock& b : mesh_.blocks())
            if (!traits(b.type).simplex)
                for (const Index c : near[static_cast<int>(b.type)]) choose({b.type, c}, reached);
        if (reached.empty()) return {};
        Conversion out;
        // Those across from what was reached; of them, those in front of whose faces no pyramid can stand.
        std::vector<CellRef> beside, whole = reached;
        while (!whole.empty()) {
            const QuadSet faces = outer_quads_of(whole);
            std::vector<CellRef> next;
            for_each_at(faces, 3, [&](const CellRef& cell) {
                choose(cell, has_no_room(cell) ? next : beside);
                reached.push_back(cell);
            });
            whole = std::move(next);
        }
        const QuadSet rim = outer_quads_of(beside);
        for_each_at(rim, 3, [&](const CellRef& cell) {
            for (const ElementFace& f : faces_of(mesh_, cell))
                if (f.count == 4 && rim.contains(quad_key(f.corners))) out.bases.emplace(quad_key(f.corners), 1);
        });
        if (has_quadrangles()) {
            const QuadSet cut = quads_of(reached, [&](const QuadKey& q) { return !out.bases.contains(q); });
            for_each_at(cut, 2, [&](const CellRef& cell) { choose(cell, reached); });
        }
        for (std::size_t t = 0; t < chosen_.size(); ++t)
            for (std::size_t c = 0; c < chosen_[t].size(); ++c)
                if (chosen_[t][c]) out.cells[t].push_back(static_cast<Index>(c));
        out.rules = std::move(rules_);
        return out;
    }

private:
    /// For pyramids.
    bool has_no_room(const CellRef& cell) const {
        const CellTraits& t = traits(cell.type);
        return has_middles(cell.type) || std::ranges::find(unfit_, cell) != unfit_.end() ||
               (t.quadratic && !rules_.empty() &&
                std::ranges::any_of(
                    mesh_.block(cell.type).nodes(cell.cell).subspan(static_cast<std::size_t>(t.corners)),
                    [&](Index n) { return rules_[n] == PyramidRule::no_tip_nor_base; }));
    }

    char& chosen(const CellRef& cell) {
        return chosen_[static_cast<int>(cell.type)][static_cast<std::size_t>(cell.cell)];
    }

    void choose(const CellRef& cell, std::vector<CellRef>& list) {
        chosen(cell) = 1;
        list.push_back(cell);
    }

    bool has_quadrangles() const {
        return std::ranges::any_of(mesh_.blocks(), [](const CellBlock& b) {
            const CellTraits& t = traits(b.type);
            return t.dimension == 2 && t.corners == 4 && b.size() > 0;
        });
    }

    /// The quadrangular faces of some solids that `counts` takes.
    QuadSet quads_of(const std::vector<CellRef>& cells, auto counts) const {
        QuadSet out;
        for (const CellRef& c : cells)
            if (traits(c.type).dimension == 3)
                for (const ElementFace& f : faces_of(mesh_, c))
                    if (f.count == 4)
                        if (const QuadKey key = quad_key(f.corners); counts(key)) out.emplace(key, 1);
        return out;
    }

    /// Those that solids which are not chosen may have, too: they have all of their nodes.
    QuadSet outer_quads_of(const std::vector<CellRef>& cells) const {
        std::vector<char> outer(mesh_.points.size(), 0);
        for (const CellBlock& b : mesh_.blocks()) {
            const CellTraits& t = traits(b.type);
            if (t.simplex || t.dimension != 3) continue;
            SparseCheck check(1 << 12);
            for (Index c = 0; c < b.size(); ++c) {
                check();
                if (chosen_[static_cast<int>(b.type)][static_cast<std::size_t>(c)]) continue;
                for (const Index n : b.nodes(c).first(static_cast<std::size_t>(t.corners))) outer[n] = 1;
            }
        }
        return quads_of(cells, [&](const QuadKey& q) {
            return std::ranges::all_of(q, [&](std::int32_t n) { return outer[n] != 0; });
        });
    }

    /// Visits the elements of a dimension that are not chosen yet and have (or are) one of some quadrangles.
    template <class Visit>
    void for_each_at(const QuadSet& quads, int dimension, Visit visit) {
        if (quads.empty()) return;
        std::vector<char> near(mesh_.points.size(), 0);
        quads.for_each([&](const QuadKey& q, char) {
            for (const std::int32_t n : q) near[n] = 1;
        });
        for (const CellBlock& b : mesh_.blocks()) {
            const CellTraits& t = traits(b.type);
            if (t.simplex || t.dimension != dimension || t.corners < 4) continue;
            SparseCheck check(1 << 12);
            const Index* n = b.connectivity.data();
            for (Index c = 0; c < b.size(); ++c, n += t.nodes) {
                check();
                int count = 0;
                for (int k = 0; k < t.corners; ++k) count += near[n[k]];
                const CellRef cell{b.type, c};
                if (count < 4 || chosen(cell)) continue;
                bool there = dimension == 2 && quads.contains(quad_key({n[0], n[1], n[2], n[3]}));
                if (dimension == 3)
                    there = std::ranges::any_of(faces_of(mesh_, cell), [&](const ElementFace& f) {
                        return f.count == 4 && quads.contains(quad_key(f.corners));
                    });
                if (there) visit(cell);
            }
        }
    }

    const Mesh& mesh_;
    std::span<const CellRef> unfit_;
    std::vector<PyramidRule> rules_;
    std::array<std::vector<char>, cell_type_count> chosen_;
};

}  // namespace

std::vector<ElementFace> faces_of(const Mesh& mesh, const CellRef& cell) {
    const CellTraits& t = traits(cell.type);
    const auto n = mesh.block(cell.type).nodes(cell.cell);
    std::vector<ElementFace> out;
    out.reserve(t.faces.size());
    for (std::size_t f = 0; f < t.faces.size(); ++f) {
        ElementFace face;
        face.number = static_cast<int>(f) + 1;
        for (const std::int8_t k : t.faces[f]) {
            if (k < 0) continue;
            const auto known = std::span(face.corners).first(static_cast<std::size_t>(face.count));
            if (std::ranges::find(known, n[k]) == known.end()) face.corners[face.count++] = n[k];
        }
        if (face.count >= 3) out.push_back(face);
    }
    return out;
}

bool Conversion::empty() const {
    return std::ranges::all_of(cells, [](const std::vector<Index>& list) { return list.empty(); });
}

Conversion plan_conversion(const Mesh& mesh, const std::vector<std::int8_t>& level, const Adjacency* adjacency,
                           std::span<const CellRef> unfit, std::vector<PyramidRule> rules) {
    return Planner(mesh, unfit, std::move(rules)).run(level, adjacency);
}

}  // namespace femscalpel
