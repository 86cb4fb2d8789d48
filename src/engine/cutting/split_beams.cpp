// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/split_beams.h"

#include <algorithm>
#include <array>
#include <map>

#include "cancel.h"
#include "deck/mark_deck.h"
#include "mesh/shape_blend.h"

namespace femscalpel {
namespace {

class BeamSplitter {
public:
    BeamSplitter(const Mesh& mesh, const Numbering& numbering)
        : input_(mesh), next_node_(numbering.node), next_cell_(numbering.cell) {
        out_.mesh = mesh;
        for (const CellType type : {CellType::line, CellType::line3})
            for (Index c = 0; c < mesh.block(type).size(); ++c) {
                const auto n = mesh.block(type).nodes(c);
                ends_[n[0]].push_back(n[1]);
                ends_[n[1]].push_back(n[0]);
            }
    }

    Simplified run(const BeamCuts& cuts) {
        for (const BeamCut& c : cuts.cuts) {
            check_();
            divide(c);
        }
        return std::move(out_);
    }

private:
    static Blend blend(std::span<const Index> n, double t) {
        Blend out;
        if (n.size() == 2) {
            add(out, {{n[0], 1}}, 1 - t);
            add(out, {{n[1], 1}}, t);
        } else {
            add(out, {{n[0], 1}}, (1 - t) * (1 - 2 * t));
            add(out, {{n[1], 1}}, t * (2 * t - 1));
            add(out, {{n[2], 1}}, 4 * t * (1 - t));
        }
        return out;
    }

    bool is_in(GroupIndex group, Index node) const {
        return input_.families.contains(input_.node_families[node], group);
    }

    /// Whether a group goes along a beam with both ends in it: over its middle, or on to another beam, or everywhere.
    /// Two supports at the ends of a beam are none between them.
    bool goes_along(GroupIndex group, std::span<const Index> beam) const {
        const Group& g = input_.groups[static_cast<std::size_t>(group)];
        if (g.hidden && !g.name.starts_with(mark_prefix)) return true;
        if (beam.size() == 3) return is_in(group, beam[2]);
        return std::ranges::any_of(beam,
                                   [&](Index end) {
                                       return std::ranges::any_of(ends_.at(end), [&](Index far) {
                                           return far != beam[0] && far != beam[1] && is_in(group, far);
                                       });
                                   }) ||
               (ends_.size() > 2 && std::ranges::all_of(ends_, [&](const auto& e) { return is_in(group, e.first); }));
    }

    FamilyIndex family(std::span<const Index> beam) {
        Mesh& mesh = out_.mesh;
        const auto common =
            mesh.families.groups(mesh.families.intersect(mesh.node_families[beam[0]], mesh.node_families[beam[1]]));
        FamilyIndex out = 0;
        marked_ = false;
        for (const GroupIndex g : std::vector<GroupIndex>(common.begin(), common.end()))  // with() makes others
            if (goes_along(g, beam)) {
                out = mesh.families.with(out, g);
                marked_ = marked_ || mesh.groups[static_cast<std::size_t>(g)].name.starts_with(mark_prefix);
            }
        return out;
    }

    Index add_node(std::span<const Index> beam, double t) {
        Mesh& mesh = out_.mesh;
        const Blend at = blend(beam, t);
        Changes::Born born{next_node_, {mesh.node_ids[beam[0]], mesh.node_ids[beam[1]]}};
        std::ranges::sort(born.ancestors);
        for (const auto& [node, share] : at) born.shares.emplace_back(mesh.node_ids[node], share);
        const FamilyIndex groups = family(beam);
        born.spans = !marked_;
        out_.changes.born.push_back(std::move(born));
        ++out_.nodes_added;
        return mesh.add_node(place_of(mesh, at), next_node_++, groups);
    }

    void divide(const BeamCut& c) {
        Mesh& mesh = out_.mesh;
        const auto count = static_cast<std::size_t>(traits(c.beam.type).nodes);
        const auto all = mesh.block(c.beam.type).nodes(c.beam.cell);
        const std::vector<Index> beam(all.begin(), all.end());
        const bool quadratic = beam.size() == 3;
        std::vector<double> stops = c.at;
        if (quadratic && std::ranges::find(stops, 0.5) == stops.end()) stops.push_back(0.5);
        std::ranges::sort(stops);
        stops.push_back(1);
        out_.before.push_back(c.beam);
        out_.beams_cut += static_cast<Index>(c.at.size());
        const FamilyIndex family = mesh.block(c.beam.type).families[c.beam.cell];
        const Index number = mesh.block(c.beam.type).ids[c.beam.cell];
        double from = 0;
        Index first = beam[0];
        for (const double to : stops) {
            const Index last = to == 1 ? beam[1] : quadratic && to == 0.5 ? beam[2] : add_node(beam, to);
            if (std::ranges::find(c.at, to) != c.at.end()) out_.stops.push_back(mesh.node_ids[last]);
            std::array<Index, 3> part{first, last, quadratic ? add_node(beam, (from + to) / 2) : -1};
            if (from == 0) {
                std::copy_n(part.begin(), count,
                            mesh.block(c.beam.type).connectivity.begin() +
                                static_cast<std::ptrdiff_t>(c.beam.cell * static_cast<Index>(count)));
                out_.after.push_back(c.beam);
            } else {
                out_.changes.parts.push_back({next_cell_, number});
                out_.after.push_back(
                    {c.beam.type, mesh.add_cell(c.beam.type, std::span(part).first(count), next_cell_++, family)});
            }
            from = to;
            first = last;
        }
    }

    const Mesh& input_;
    std::map<Index, std::vector<Index>> ends_;  // of all segments, by node the other ends
    bool marked_ = false;                       // whether the last node is in what cards name by number
    Simplified out_;
    Index next_node_, next_cell_;
    SparseCheck check_;
};

}  // namespace

Simplified split_beams(const Mesh& mesh, const BeamCuts& cuts, const Numbering& numbering) {
    return BeamSplitter(mesh, numbering).run(cuts);
}

}  // namespace femscalpel
