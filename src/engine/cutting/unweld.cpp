// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/unweld.h"

#include <algorithm>
#include <map>
#include <set>

#include "cutting/weld_sides.h"

namespace femscalpel {
namespace {

class Unwelder {
public:
    Unwelder(const Mesh& input, const Welded& welded, Mesh& mesh, Changes& changes, Numbering next)
        : input_(input),
          welded_(welded),
          mesh_(mesh),
          changes_(changes),
          next_(next),
          sides_(input, welded, mesh, changes) {
        place_ = sides_.places();
        births_of_single_ = changes.born;
        for (std::size_t k = 0; k < changes.born.size(); ++k) births_.emplace(changes.born[k].node, k);
    }

    Unwelded run() {
        out_.joined = sides_.joined();
        const std::vector<WeldSides::Guest> guests = sides_.guests();
        for (std::size_t k = 0; k < sides_.nodes().size(); ++k) take_apart(k);
        for (const WeldSides::Guest& g : guests) place(g);
        finish_nodes();
        out_.springs = put_back_springs(input_, welded_, pairs_, mesh_, changes_, next_.cell);
        return std::move(out_);
    }

private:
    void take_apart(std::size_t k) {
        const Index w = sides_.nodes()[k];
        const std::vector<Index> from = sides_.ancestors(mesh_.node_ids[w]);
        const FamilyIndex family = mesh_.node_families[w];
        const std::vector<WeldSide>& sides = sides_.sides()[k];
        std::vector<Index> numbers;
        numbers.reserve(sides.size());
        // The side of the first nodes keeps a node that is new.
        for (const WeldSide& side : sides)
            numbers.push_back(mesh_.node_ids[give(w, numbers.empty(), family, from, side)]);
        for (const auto& [a, b] : sides_.facing()[k]) {
            const auto one = static_cast<std::size_t>(a), other = static_cast<std::size_t>(b);
            changes_.facing.push_back({numbers[one], numbers[other]});
            if (!welded_.aside.empty())
                pairs_.push_back({numbers[one], numbers[other], sides[one].label, sides[other].label});
        }
    }

    /// An element on others has the nodes of those on its side. What the operation made on shells, a lip, all shells
    /// on each other get for themselves.
    void place(const WeldSides::Guest& guest) {
        const auto [type, cell] = guest.cell;
        const auto count = static_cast<std::size_t>(traits(type).nodes);
        const auto own = mesh_.block(type).nodes(cell);
        const std::vector<Index> before(own.begin(), own.end());
        std::vector<std::vector<Index>> images;  // the best first
        int most = 0;
        for (const auto& [host, at] : guest.hosts) {
            const auto n = mesh_.block(host.type).nodes(host.cell);
            std::vector<Index> image;
            int votes = 0;
            for (std::size_t k = 0; k < count; ++k) {
                image.push_back(n[at[k]]);
                if (const auto label = labels_.find(image[k]); label != labels_.end())
                    votes += sides_.votes(guest.cell, mesh_.node_ids[before[k]], label->second);
            }
            if (std::ranges::find(images, image) != images.end()) continue;
            const bool best = images.empty() || votes > most;
            images.insert(best ? images.begin() : images.end(), std::move(image));
            if (best) most = votes;
        }
        std::ranges::copy(images.front(), mesh_.block(type).connectivity.begin() + cell * static_cast<Index>(count));
        if (sides_.is_old(guest.cell) || traits(guest.hosts.front().first.type).dimension != 2) return;
        for (std::size_t k = 1; k < images.size(); ++k) {
            out_.segments.push_back(next_.cell);
            mesh_.add_cell(type, images[k], next_.cell++, mesh_.block(type).families[cell]);
        }
    }

    /// The groups of `family` that those of this side are in; groups of the operation stay.
    FamilyIndex of_side(FamilyIndex family, const WeldLabel& label) {
        std::vector<GroupIndex> out;
        for (const GroupIndex g : mesh_.families.groups(family)) {
            const bool old = g < static_cast<GroupIndex>(input_.groups.size());
            if (!old || std::ranges::all_of(label, [&](Index n) {
                    return n < 0 || input_.families.contains(input_.node_families[n], g);
                }))
                out.push_back(g);
        }
        return mesh_.families.intern(out);
    }

    /// Gives the elements of a side of node w their own node.
    Index give(Index w, bool first, FamilyIndex family, const std::vector<Index>& from, const WeldSide& side) {
        const Index number = mesh_.node_ids[w];
        Index node = w;
        if (!sides_.is_born(number)) {
            const Index original = side.label.front();
            if (claimed_.insert(original).second)
                node = node_of(original, w);
            else if (!first || number == input_.node_ids[sides_.set_of(original)->front()])
                node = copy(w, input_.node_ids[original]);
            else
                descend_from(number, input_.node_ids[original]);
        } else {
            node = give_born(w, first, from, side.label);
        }
        mesh_.node_families[node] = of_side(family, side.label);
        used_.insert(node);
        labels_[node] = side.label;
        if (node == w) return node;
        out_.partners[number].push_back(mesh_.node_ids[node]);
        for (const CellRef& c : side.cells) {
            CellBlock& b = mesh_.block(c.type);
            const auto count = static_cast<std::size_t>(traits(c.type).nodes);
            for (Index& v : std::span(b.connectivity).subspan(static_cast<std::size_t>(c.cell) * count, count))
                if (v == w) v = node;
        }
        return node;
    }

    /// The same where w was born, or is a copy of a node born: the first of each side is born, others are its copies.
    Index give_born(Index w, bool first, const std::vector<Index>& from, const WeldLabel& label) {
        const Index number = mesh_.node_ids[w];
        const Index like = sides_.source(number);
        Index& owner = owners_[{like, label}];
        if (first && number == like) {
            owner = number;
            Changes::Born& born = changes_.born[births_.at(number)];
            born = on_side(born, number, from, label);
            return w;
        }
        if (first) {
            if (owner > 0) {
                descend_from(number, owner);
                return w;
            }
            std::erase_if(changes_.copies, [&](const Changes::Copy& c) { return c.node == number; });
            add_birth(number, like, from, label);
            owner = number;
            return w;
        }
        if (owner > 0) return copy(w, owner);
        owner = next_.node++;
        add_birth(owner, like, from, label);
        const Vec3 at = mesh_.points[w];
        return mesh_.add_node(at, owner);
    }

    /// A node of the input, at the place of w.
    Index node_of(Index original, Index w) {
        const auto place = place_.find(original);
        if (place == place_.end()) {
            const Index made = mesh_.add_node(mesh_.points[w], input_.node_ids[original]);
            place_[original] = made;
            return made;
        }
        const Vec3 at = mesh_.points[w];
        if (place->second != w) {
            out_.moved += mesh_.points[place->second] != at;
            mesh_.points[place->second] = at;
        }
        return place->second;
    }

    Index copy(Index w, Index source) {
        ++out_.doubled;
        changes_.copies.push_back({next_.node, source});
        const Vec3 at = mesh_.points[w];
        return mesh_.add_node(at, next_.node++);
    }

    /// A copy is that of another side's node.
    void descend_from(Index copy, Index source) {
        for (Changes::Copy& c : changes_.copies)
            if (c.node == copy) c.source = source;
    }

    /// A node is born as the node `like` is, but on the side `label`.
    void add_birth(Index number, Index like, const std::vector<Index>& from, const WeldLabel& label) {
        ++out_.born;
        changes_.born.push_back(on_side(births_of_single_[births_.at(like)], number, from, label));
    }

    Changes::Born on_side(const Changes::Born& like, Index number, const std::vector<Index>& from,
                          const WeldLabel& label) const {
        const auto own = [&](Index ancestor) {
            const auto k = std::ranges::find_if(from, [&](Index n) { return input_.node_ids[n] == ancestor; });
            if (k == from.end()) return ancestor;
            const Index there = label[static_cast<std::size_t>(k - from.begin())];
            return there < 0 ? ancestor : input_.node_ids[there];
        };
        Changes::Born made{number, {}, {}};
        for (const Index a : like.ancestors) made.ancestors.push_back(own(a));
        for (const auto& [node, share] : like.shares) made.shares.emplace_back(own(node), share);
        std::ranges::sort(made.ancestors);
        return made;
    }

    /// Nodes that were single and have another number now, and partners without an element, go.
    void finish_nodes() {
        std::vector<char> gone(mesh_.points.size(), 0);
        bool any = false;
        const auto drop = [&](Index n) {
            if (used_.contains(n)) return;
            gone[n] = 1;
            any = true;
        };
        for (const Index w : sides_.nodes()) drop(w);
        for (const auto& [original, place] : place_) drop(place);
        for (const CellBlock& b : mesh_.blocks())
            for (const Index n : b.connectivity) gone[n] = 0;
        if (!any) return;
        std::set<Index> numbers;
        std::vector<Index> place(gone.size(), -1);
        Index kept = 0;
        for (std::size_t n = 0; n < gone.size(); ++n) {
            if (gone[n]) {
                numbers.insert(mesh_.node_ids[n]);
                out_.removed += sides_.is_of_input(mesh_.node_ids[n]);
                out_.born -= births_.contains(mesh_.node_ids[n]);
                continue;
            }
            mesh_.points[kept] = mesh_.points[n];
            mesh_.node_ids[kept] = mesh_.node_ids[n];
            mesh_.node_families[kept] = mesh_.node_families[n];
            place[n] = kept++;
        }
        mesh_.points.resize(static_cast<std::size_t>(kept));
        mesh_.node_ids.resize(static_cast<std::size_t>(kept));
        mesh_.node_families.resize(static_cast<std::size_t>(kept));
        for (CellBlock& b : mesh_.blocks())
            for (Index& n : b.connectivity) n = place[n];
        std::erase_if(changes_.copies, [&](const Changes::Copy& c) { return numbers.contains(c.node); });
    }

    const Mesh& input_;
    const Welded& welded_;
    Mesh& mesh_;
    Changes& changes_;
    Numbering next_;
    std::vector<WeldPair> pairs_;
    WeldSides sides_;
    Unwelded out_;
    std::vector<Changes::Born> births_of_single_;    // of the nodes before they were taken apart
    std::unordered_map<Index, std::size_t> births_;  // places there and in changes_.born, by number
    std::unordered_map<Index, Index> place_;         // in the result, of welded nodes of the input
    std::unordered_map<Index, WeldLabel> labels_;    // of the side that a node of the result was given to
    std::set<Index> claimed_;                        // nodes of the input that a side has
    std::set<Index> used_;                           // nodes of the result that elements have
    /// Number of the node that stands for a side of a node born, by that one's number and the side.
    std::map<std::pair<Index, WeldLabel>, Index> owners_;
};

}  // namespace

Unwelded unweld(const Mesh& input, const Welded& welded, Mesh& mesh, Changes& changes, Numbering next) {
    return Unwelder(input, welded, mesh, changes, next).run();
}

}  // namespace femscalpel
