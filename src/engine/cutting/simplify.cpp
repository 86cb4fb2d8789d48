// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/simplify.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "cancel.h"
#include "cutting/better_diagonals.h"
#include "cutting/quad_cuts.h"
#include "cutting/solid_parts.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

/// Pyramids poorer than this are avoided where what they stand on can be converted, too.
constexpr double poor_pyramid = 0.1;
/// Parts poorer than this, and than a tenth of the whole, are an error.
constexpr double too_poor = 0.02;
/// For solids with parts poorer than this, other diagonals of their faces are tried.
constexpr double poor_parts = 0.15;

class Simplifier {
public:
    Simplifier(const Mesh& input, const Conversion& conversion, const Numbering& numbering, bool tell_unfit)
        : input_(input),
          conversion_(conversion),
          tell_unfit_(tell_unfit),
          next_node_(numbering.node),
          next_cell_(numbering.cell) {
        out_.mesh = input;
    }

    Simplified run() {
        QuadCuts cuts(
            out_.mesh, conversion_.cells,
            [&](const Blend& at, const std::array<Index, 4>& corners) { return add_node(at, corners); },
            conversion_.diagonals);
        cuts_ = &cuts;
        for (const CellTraits& t : all_cell_types()) {
            const std::vector<Index>& cells = conversion_.cells[static_cast<int>(t.type)];
            out_.converted[static_cast<int>(t.type)] = static_cast<Index>(cells.size());
            for (const Index c : cells) {
                check_();
                start({t.type, c});
                if (t.dimension == 3)
                    cut_up_solid({t.type, c});
                else
                    cut_up_shell({t.type, c});
            }
        }
        children_from_.push_back(out_.after.size());
        move_facets();
        remove_cells();
        remove_middles();
        return std::move(out_);
    }

    /// Solids with poor parts, and the quality of these; the least of all.
    const std::vector<std::pair<double, CellRef>>& poor() const { return poor_; }
    double worst() const {
        return poor_.empty() ? poor_parts : std::ranges::min(poor_, {}, &std::pair<double, CellRef>::first).first;
    }

    /// Throws for an element that has no sound parts.
    void refuse_too_poor() const {
        if (too_poor_) refuse(*too_poor_);
    }

private:
    void start(const CellRef& cell) {
        out_.before.push_back(cell);
        children_from_.push_back(out_.after.size());
        parent_ = cell;
        number_kept_ = false;
    }

    Index add_node(const Blend& at, std::span<const Index> corners) {
        Mesh& mesh = out_.mesh;
        FamilyIndex family = mesh.node_families[corners.front()];
        Changes::Born born{next_node_, {}};
        for (const Index n : corners) {
            family = mesh.families.intersect(family, mesh.node_families[n]);
            born.ancestors.push_back(mesh.node_ids[n]);
        }
        std::ranges::sort(born.ancestors);
        born.ancestors.erase(std::unique(born.ancestors.begin(), born.ancestors.end()), born.ancestors.end());
        for (const auto& [node, weight] : on_input(at)) born.shares.emplace_back(mesh.node_ids[node], weight);
        out_.changes.born.push_back(std::move(born));
        ++out_.nodes_added;
        const Index made = mesh.add_node(place_of(mesh, at), next_node_++, family);
        blends_.push_back(on_input(at));
        return made;
    }

    /// The same place by nodes of the input.
    Blend on_input(const Blend& at) const {
        Blend out;
        for (const auto& [node, weight] : at)
            if (node < input_.node_count())
                add(out, {{node, 1}}, weight);
            else
                add(out, blends_[static_cast<std::size_t>(node - input_.node_count())], weight);
        return out;
    }

    void add_part(CellType type, std::span<const Index> corners) {
        Mesh& mesh = out_.mesh;
        const CellTraits& t = traits(type);
        std::vector<Index> nodes(corners.begin(), corners.end());
        if (t.quadratic)
            for (const auto& e : t.edges) nodes.push_back(cuts_->middle(corners[e[0]], corners[e[1]]));
        const CellBlock& block = mesh.block(parent_.type);
        const Index parent = block.ids[parent_.cell];
        const FamilyIndex family = block.families[parent_.cell];
        if (number_kept_) out_.changes.parts.push_back({next_cell_, parent});
        out_.after.push_back({type, mesh.add_cell(type, nodes, number_kept_ ? next_cell_++ : parent, family)});
        number_kept_ = true;
    }

    void cut_up_shell(const CellRef& cell) {
        const CellTraits& t = traits(cell.type);
        const CellType part = t.quadratic ? CellType::triangle6 : CellType::triangle;
        std::vector<Index> corners;
        for (const Index n : out_.mesh.block(cell.type).nodes(cell.cell).first(static_cast<std::size_t>(t.corners)))
            if (std::ranges::find(corners, n) == corners.end()) corners.push_back(n);
        if (corners.size() < 3) refuse(cell);
        if (corners.size() == 3) return add_part(part, corners);
        for (const auto& triangle : cuts_->triangles({corners[0], corners[1], corners[2], corners[3]}))
            add_part(part, triangle);
    }

    void cut_up_solid(const CellRef& cell) {
        const CellTraits& t = traits(cell.type);
        SolidParts parts = cut_solid(out_.mesh, cell, conversion_, *cuts_);
        const bool unfit = parts.quality < poor_pyramid && has_base(cell);
        if (unfit) out_.unfit.push_back(cell);
        if (parts.quality < poor_parts) poor_.emplace_back(parts.quality, cell);
        if (!(unfit && tell_unfit_) && !too_poor_ && is_too_poor(parts, cell)) too_poor_ = cell;
        const auto all = input_.block(cell.type).nodes(cell.cell).first(static_cast<std::size_t>(t.corners));
        Index centre = parts.centre_node;
        if (centre < 0 && !parts.centre.empty()) centre = add_node(parts.centre, all);
        for (const auto& [edge, at] : parts.middles)
            cuts_->set_middle(edge[0], edge[1] < 0 ? centre : edge[1], add_node(at, all));
        for (SolidPart& part : parts.parts) {
            std::ranges::replace(part.corners, Index{-1}, centre);
            const bool pyramid = part.count == 5;
            out_.pyramids += pyramid;
            add_part(pyramid       ? (t.quadratic ? CellType::pyramid13 : CellType::pyramid)
                     : t.quadratic ? CellType::tetra10
                                   : CellType::tetra,
                     std::span(part.corners).first(static_cast<std::size_t>(part.count)));
        }
    }

    bool has_base(const CellRef& cell) const {
        return std::ranges::any_of(faces_of(input_, cell), [&](const ElementFace& f) {
            return f.count == 4 && conversion_.bases.contains(quad_key(f.corners));
        });
    }

    bool is_too_poor(const SolidParts& parts, const CellRef& cell) const {
        if (parts.parts.empty()) return true;
        const double whole = mean_ratio(input_, cell.type, cell.cell);
        return whole > 0 && parts.quality < std::min(too_poor, whole / 10);
    }

    [[noreturn]] void refuse(const CellRef& cell) const {
        throw UnsupportedElementError(
            "the tool's band reaches element " + std::to_string(input_.block(cell.type).ids[cell.cell]) + ", a " +
            std::string(traits(cell.type).name) +
            " that cannot be split into sound triangles or tetrahedra; its shape is too poor. "
            "Choose a smaller transition, move the tool, or mend the element first");
    }

    /// The place of an element among those that were converted, or none.
    std::optional<std::size_t> converted_place(const CellRef& cell) const {
        std::size_t before = 0;
        for (int t = 0; t < static_cast<int>(cell.type); ++t) before += conversion_.cells[t].size();
        const std::vector<Index>& list = conversion_.cells[static_cast<int>(cell.type)];
        const auto at = std::ranges::lower_bound(list, cell.cell);
        if (at == list.end() || *at != cell.cell) return {};
        return before + static_cast<std::size_t>(at - list.begin());
    }

    void move_facets() {
        std::vector<Facet> kept;
        for (const Facet& f : out_.mesh.facets) {
            const auto place = converted_place({f.type, f.cell});
            if (!place) {
                kept.push_back(f);
                continue;
            }
            for (std::size_t k = children_from_[*place]; k < children_from_[*place + 1]; ++k) {
                const CellRef& part = out_.after[k];
                for (const int face : traits(f.type).dimension == 3 ? pieces_of_face(f, part) : pieces_of_side(f, part))
                    kept.push_back({part.type, static_cast<std::int8_t>(face), f.family, part.cell});
            }
        }
        out_.mesh.facets = std::move(kept);
    }

    /// Faces of a part on one of the old solid's.
    std::vector<int> pieces_of_face(const Facet& f, const CellRef& part) const {
        std::vector<Index> whole;
        const auto n = out_.mesh.block(f.type).nodes(f.cell);
        for (const std::int8_t k : traits(f.type).faces[f.face - 1])
            if (k >= 0) whole.push_back(n[k]);
        std::vector<int> out;
        for (const ElementFace& piece : faces_of(out_.mesh, part)) {
            const auto corners = std::span(piece.corners).first(static_cast<std::size_t>(piece.count));
            if (std::ranges::all_of(corners, [&](Index v) { return std::ranges::find(whole, v) != whole.end(); }))
                out.push_back(piece.number);
        }
        return out;
    }

    /// The same for shells: both sides are those of the whole, an edge is one part's.
    std::vector<int> pieces_of_side(const Facet& f, const CellRef& part) const {
        if (f.face <= 2) return {f.face};
        const auto n = out_.mesh.block(f.type).nodes(f.cell);
        const auto& whole = traits(f.type).edges[f.face - 3];
        const auto own = out_.mesh.block(part.type).nodes(part.cell);
        for (std::size_t e = 0; e < traits(part.type).edges.size(); ++e) {
            const auto& edge = traits(part.type).edges[e];
            if (own[edge[0]] == n[whole[0]] && own[edge[1]] == n[whole[1]]) return {static_cast<int>(e) + 3};
        }
        return {};
    }

    void remove_cells() {
        for (CellBlock& block : out_.mesh.blocks()) {
            const std::vector<Index>& gone = conversion_.cells[static_cast<int>(block.type)];
            if (gone.empty()) continue;
            std::vector<Index> place(static_cast<std::size_t>(block.size()), 0);
            for (const Index c : gone) place[c] = -1;
            Index kept = 0;
            const int n = traits(block.type).nodes;
            for (Index c = 0; c < block.size(); ++c) {
                if (place[c] < 0) continue;
                place[c] = kept;
                std::copy_n(block.connectivity.begin() + c * n, n, block.connectivity.begin() + kept * n);
                block.ids[kept] = block.ids[c];
                block.families[kept] = block.families[c];
                ++kept;
            }
            block.connectivity.resize(static_cast<std::size_t>(kept * n));
            block.ids.resize(static_cast<std::size_t>(kept));
            block.families.resize(static_cast<std::size_t>(kept));
            for (Facet& f : out_.mesh.facets)
                if (f.type == block.type) f.cell = place[f.cell];
            for (CellRef& c : out_.after)
                if (c.type == block.type) c.cell = place[c.cell];
        }
        std::ranges::stable_sort(out_.mesh.facets, {},
                                 [](const Facet& f) { return std::tuple(f.type, f.cell, f.face); });
    }

    /// Drops nodes in the middle of elements and faces that no element has any more.
    void remove_middles() {
        Mesh& mesh = out_.mesh;
        std::vector<char> gone(mesh.points.size(), 0);
        for (const CellTraits& t : all_cell_types()) {
            const int on_edges = t.corners + static_cast<int>(t.edges.size());
            if (!t.quadratic || t.nodes == on_edges) continue;
            for (const Index c : conversion_.cells[static_cast<int>(t.type)])
                for (const Index n : input_.block(t.type).nodes(c).last(static_cast<std::size_t>(t.nodes - on_edges)))
                    gone[n] = 1;
        }
        if (std::ranges::find(gone, 1) == gone.end()) return;
        for (const CellBlock& b : mesh.blocks())
            for (const Index n : b.connectivity) gone[n] = 0;
        std::vector<Index> place(gone.size(), -1);
        Index kept = 0;
        for (std::size_t n = 0; n < gone.size(); ++n) {
            if (gone[n]) continue;
            mesh.points[kept] = mesh.points[n];
            mesh.node_ids[kept] = mesh.node_ids[n];
            mesh.node_families[kept] = mesh.node_families[n];
            place[n] = kept++;
        }
        out_.nodes_removed = static_cast<Index>(gone.size()) - kept;
        mesh.points.resize(static_cast<std::size_t>(kept));
        mesh.node_ids.resize(static_cast<std::size_t>(kept));
        mesh.node_families.resize(static_cast<std::size_t>(kept));
        for (CellBlock& b : mesh.blocks())
            for (Index& n : b.connectivity) n = place[n];
    }

    const Mesh& input_;
    const Conversion& conversion_;
    const bool tell_unfit_;
    Index next_node_, next_cell_;
    Simplified out_;
    QuadCuts* cuts_ = nullptr;
    CellRef parent_{};
    bool number_kept_ = false;
    std::vector<std::size_t> children_from_;  // first in `after`, by place in `before`; then where the last ones end
    std::vector<Blend> blends_;               // of new nodes, by nodes of the input
    std::vector<std::pair<double, CellRef>> poor_;
    std::optional<CellRef> too_poor_;
    SparseCheck check_;
};

}  // namespace

Simplified simplify(const Mesh& mesh, const Conversion& conversion, const Numbering& numbering, bool tell_unfit) {
    Simplifier simplifier(mesh, conversion, numbering, tell_unfit);
    Simplified out = simplifier.run();
    if (simplifier.poor().empty()) return out;
    Conversion other = conversion;
    other.diagonals = better_diagonals(mesh, conversion, simplifier.poor());
    Simplifier again(mesh, other, numbering, tell_unfit);
    if (Simplified better = again.run(); again.worst() > simplifier.worst()) {
        again.refuse_too_poor();
        return better;
    }
    simplifier.refuse_too_poor();
    return out;
}

}  // namespace femscalpel
