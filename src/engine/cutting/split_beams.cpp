// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/split_beams.h"

#include <algorithm>
#include <array>

#include "cancel.h"
#include "mesh/shape_blend.h"

namespace femscalpel {
namespace {

class BeamSplitter {
public:
    BeamSplitter(const Mesh& mesh, const Numbering& numbering)
        : next_node_(numbering.node), next_cell_(numbering.cell) {
        out_.mesh = mesh;
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

    Index add_node(std::span<const Index> beam, double t) {
        Mesh& mesh = out_.mesh;
        const Blend at = blend(beam, t);
        Changes::Born born{next_node_, {mesh.node_ids[beam[0]], mesh.node_ids[beam[1]]}};
        std::ranges::sort(born.ancestors);
        for (const auto& [node, share] : at) born.shares.emplace_back(mesh.node_ids[node], share);
        out_.changes.born.push_back(std::move(born));
        ++out_.nodes_added;
        return mesh.add_node(place_of(mesh, at), next_node_++,
                             mesh.families.intersect(mesh.node_families[beam[0]], mesh.node_families[beam[1]]));
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

    Simplified out_;
    Index next_node_, next_cell_;
    SparseCheck check_;
};

}  // namespace

Simplified split_beams(const Mesh& mesh, const BeamCuts& cuts, const Numbering& numbering) {
    return BeamSplitter(mesh, numbering).run(cuts);
}

}  // namespace femscalpel
