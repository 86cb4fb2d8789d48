// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/better_diagonals.h"

#include <algorithm>
#include <array>
#include <bit>
#include <map>
#include <numeric>
#include <utility>

#include "cancel.h"
#include "cutting/quad_cuts.h"
#include "cutting/solid_parts.h"

namespace femscalpel {
namespace {

/// Solids looked at; there are few but in meshes that are poor all over.
constexpr std::size_t most_solids = 100;
/// Parts as good as this need no better diagonals.
constexpr double good_parts = 0.3;

/// The type of the same shape without mid-side nodes.
CellType linear_type(CellType type) { return traits(type).linear; }

class Chooser {
public:
    Chooser(const Mesh& mesh, const Conversion& conversion) : mesh_(mesh), conversion_(conversion) {
        corners_.points = mesh.points;
        corners_.node_ids = mesh.node_ids;
        corners_.node_families.assign(mesh.points.size(), 0);
        out_ = conversion.diagonals;
    }

    QuadTable<QuadDiagonal> run(std::vector<std::pair<double, CellRef>> poor) {
        std::ranges::stable_sort(poor, {}, &std::pair<double, CellRef>::first);
        if (poor.size() > most_solids) poor.resize(most_solids);
        find_neighbours(poor);
        for (const auto& [quality, cell] : poor) {
            check_cancelled();
            improve(cell);
        }
        return std::move(out_);
    }

private:
    struct Face {
        std::array<Index, 4> corners;
        std::vector<CellRef> solids;  // of corners_, that have it
    };

    /// The poor solids and those across their faces, by their corners.
    void find_neighbours(const std::vector<std::pair<double, CellRef>>& poor) {
        for (const auto& [quality, cell] : poor)
            for (const ElementFace& f : faces_of(mesh_, cell))
                if (f.count == 4 && !conversion_.bases.contains(quad_key(f.corners)))
                    faces_[quad_key(f.corners)] = {f.corners, {}};
        for (const CellTraits& t : all_cell_types()) {
            if (t.dimension != 3) continue;
            for (const Index c : conversion_.cells[static_cast<int>(t.type)]) {
                std::vector<Face*> met;
                for (const ElementFace& f : faces_of(mesh_, {t.type, c}))
                    if (const auto found = faces_.find(quad_key(f.corners)); f.count == 4 && found != faces_.end())
                        met.push_back(&found->second);
                if (met.empty()) continue;
                const auto n = mesh_.block(t.type).nodes(c).first(static_cast<std::size_t>(t.corners));
                const CellType type = linear_type(t.type);
                const CellRef own{type, corners_.add_cell(type, n, mesh_.block(t.type).ids[c], 0)};
                own_[{t.type, c}] = own;
                for (Face* face : met) face->solids.push_back(own);
            }
        }
    }

    /// The quality of a solid of corners_ with the diagonals of out_, but others for some faces.
    double quality(const CellRef& cell, const QuadTable<QuadDiagonal>& diagonals) {
        QuadCuts cuts(corners_, {}, {}, diagonals);
        return cut_solid(corners_, cell, conversion_, cuts).quality;
    }

    void improve(const CellRef& poor) {
        const auto own = own_.find({poor.type, poor.cell});
        if (own == own_.end()) return;  // all of its quadrangles stay
        const CellRef cell = own->second;
        double best = quality(cell, out_);
        if (best >= good_parts) return;
        std::vector<const Face*> faces;
        std::vector<QuadDiagonal> others;
        for (const ElementFace& f : faces_of(mesh_, poor)) {
            const auto found = faces_.find(quad_key(f.corners));
            if (f.count != 4 || found == faces_.end()) continue;
            faces.push_back(&found->second);
            others.push_back(other_diagonal(f.corners));
        }
        // The fewer are changed the better.
        std::vector<unsigned> choices((1U << faces.size()) - 1);
        std::iota(choices.begin(), choices.end(), 1U);
        std::ranges::stable_sort(choices, {}, [](unsigned c) { return std::popcount(c); });
        QuadTable<QuadDiagonal> chosen = out_;
        for (const unsigned choice : choices) {
            QuadTable<QuadDiagonal> tried = out_;
            for (std::size_t k = 0; k < faces.size(); ++k)
                if (choice >> k & 1U) tried.emplace(quad_key(faces[k]->corners), others[k]).first = others[k];
            double worst = quality(cell, tried);
            for (std::size_t k = 0; k < faces.size() && worst > best; ++k)
                if (choice >> k & 1U)
                    for (const CellRef& beside : faces[k]->solids)
                        if (!(beside == cell)) worst = std::min(worst, quality(beside, tried));
            if (worst <= best) continue;
            best = worst;
            chosen = std::move(tried);
            if (best >= good_parts) break;
        }
        out_ = std::move(chosen);
    }

    QuadDiagonal other_diagonal(const std::array<Index, 4>& corners) {
        QuadCuts cuts(corners_, {}, {}, out_);
        const std::array<Index, 2> ends = cuts.diagonal(corners);
        std::array<Index, 2> other{};
        std::size_t count = 0;
        for (const Index n : corners)
            if (std::ranges::find(ends, n) == ends.end()) other[count++] = n;
        return {static_cast<std::int32_t>(other[0]), static_cast<std::int32_t>(other[1])};
    }

    const Mesh& mesh_;
    const Conversion& conversion_;
    Mesh corners_;
    std::map<QuadKey, Face> faces_;
    std::map<std::pair<CellType, Index>, CellRef> own_;  // by solid of the mesh, that of corners_
    QuadTable<QuadDiagonal> out_;
};

}  // namespace

QuadTable<QuadDiagonal> better_diagonals(const Mesh& mesh, const Conversion& conversion,
                                         std::vector<std::pair<double, CellRef>> poor) {
    return Chooser(mesh, conversion).run(std::move(poor));
}

}  // namespace femscalpel
