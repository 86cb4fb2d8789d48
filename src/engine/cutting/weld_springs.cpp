// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/weld_springs.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>

namespace femscalpel {
namespace {

class Springs {
public:
    Springs(const Mesh& input, Mesh& mesh, Changes& changes, Index number)
        : input_(input), mesh_(mesh), changes_(changes), next_(number), numbers_(mesh) {}

    WeldSprings run(const std::vector<CellRef>& aside, const std::vector<WeldPair>& pairs) {
        for (const CellRef& c : aside) put_back(c);
        for (const WeldPair& p : pairs) {
            relate(p);
            relate({p.other, p.node, p.of_other, p.of_node});
        }
        for (const CellType type : types_) sort(type);
        return std::move(out_);
    }

private:
    std::span<const Index> nodes(const CellRef& c) const { return input_.block(c.type).nodes(c.cell); }
    FamilyIndex family(const CellRef& c) const { return input_.block(c.type).families[c.cell]; }

    void put_back(const CellRef& c) {
        std::vector<Index> now;
        for (const Index n : nodes(c))
            if (const auto there = numbers_.node(input_.node_ids[n])) now.push_back(*there);
        of_pair_[{nodes(c)[0], nodes(c)[1]}].push_back(c);
        if (now.size() < nodes(c).size())
            out_.removed.push_back(c);
        else
            add(c, now, input_.block(c.type).ids[c.cell]);
    }

    Index add(const CellRef& like, const std::vector<Index>& at, Index number) {
        types_.insert(like.type);
        return mesh_.add_cell(like.type, at, number, mesh_.families.intern(input_.families.groups(family(like))));
    }

    /// What all pairs that this one comes from have, from its first node to the other.
    void relate(const WeldPair& pair) {
        std::vector<CellRef> common;
        bool first = true;
        for (std::size_t k = 0; k < pair.of_node.size(); ++k) {
            const Index from = pair.of_node[k], to = pair.of_other[k];
            if (from < 0 || to < 0) continue;
            if (input_.node_ids[from] == pair.node && input_.node_ids[to] == pair.other) return;  // not new
            const auto there = of_pair_.find({from, to});
            if (there == of_pair_.end()) return;
            if (first) common = there->second;
            first = false;
            std::erase_if(common, [&](const CellRef& c) {
                return std::ranges::none_of(there->second, [&](const CellRef& other) {
                    return other.type == c.type && family(other) == family(c);
                });
            });
        }
        const auto a = numbers_.node(pair.node), b = numbers_.node(pair.other);
        if (!a || !b) return;
        for (const CellRef& like : common) {
            if (traits(like.type).nodes != 2) continue;
            changes_.parts.push_back({next_, input_.block(like.type).ids[like.cell]});
            out_.made.push_back({like.type, add(like, {*a, *b}, next_++)});
        }
    }

    /// Those of the input in its order, then what is new.
    void sort(CellType type) {
        CellBlock& block = mesh_.block(type);
        const std::vector<Index>& old = input_.block(type).ids;
        std::unordered_map<Index, std::size_t> place;
        for (std::size_t c = 0; c < old.size(); ++c) place.emplace(old[c], c);
        const CellBlock was = block;
        std::vector<std::size_t> order(was.ids.size());
        std::iota(order.begin(), order.end(), 0);
        std::ranges::stable_sort(order, {}, [&](std::size_t c) {
            const auto found = place.find(was.ids[c]);
            return found == place.end() ? old.size() : found->second;
        });
        const auto count = static_cast<std::size_t>(traits(type).nodes);
        std::vector<Index> now(order.size());
        for (std::size_t c = 0; c < order.size(); ++c) {
            const auto nodes = std::span(was.connectivity).subspan(order[c] * count, count);
            std::ranges::copy(nodes, block.connectivity.begin() + static_cast<std::ptrdiff_t>(c * count));
            block.ids[c] = was.ids[order[c]];
            block.families[c] = was.families[order[c]];
            now[order[c]] = static_cast<Index>(c);
        }
        for (CellRef& c : out_.made)
            if (c.type == type) c.cell = now[static_cast<std::size_t>(c.cell)];
    }

    const Mesh& input_;
    Mesh& mesh_;
    Changes& changes_;
    Index next_;
    NumberIndex numbers_;
    std::map<std::pair<Index, Index>, std::vector<CellRef>> of_pair_;  // by their nodes
    std::set<CellType> types_;
    WeldSprings out_;
};

}  // namespace

WeldSprings put_back_springs(const Mesh& input, const Welded& welded, const std::vector<WeldPair>& pairs, Mesh& mesh,
                             Changes& changes, Index number) {
    if (welded.aside.empty()) return {};
    return Springs(input, mesh, changes, number).run(welded.aside, pairs);
}

}  // namespace femscalpel
