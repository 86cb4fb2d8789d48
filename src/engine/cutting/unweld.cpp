// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/unweld.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "cancel.h"
#include "mesh/union_find.h"

namespace femscalpel {
namespace {

/// Which of each set of welded nodes an element has, by ancestor of the node looked at; -1: none, or not welded.
using Label = std::vector<Index>;

bool is_known(const Label& label) {
    return std::ranges::any_of(label, [](Index n) { return n >= 0; });
}

bool go_together(const Label& a, const Label& b) {
    bool common = false;
    for (std::size_t k = 0; k < a.size(); ++k) {
        if (a[k] < 0 || b[k] < 0) continue;
        if (a[k] != b[k]) return false;
        common = true;
    }
    return common;
}

/// The elements at a node that are on one side.
struct Part {
    Label label;
    std::vector<CellRef> cells;
};

class Unwelder {
public:
    Unwelder(const Mesh& input, const Welded& welded, Mesh& mesh, Changes& changes, Index number)
        : input_(input), welded_(welded), mesh_(mesh), changes_(changes), next_(number), numbers_(input) {
        for (const auto& set : welded.sets)
            for (const Index n : set) set_of_[n] = &set;
        find_bodies();
        for (const Changes::Part& p : changes.parts) parents_.emplace(p.element, p.parent);
        for (const Changes::Copy& c : changes.copies) sources_.emplace(c.node, c.source);
        for (std::size_t k = 0; k < changes.born.size(); ++k) births_.emplace(changes.born[k].node, k);
    }

    Unwelded run() {
        find_nodes();
        find_cells();
        find_faces();
        for (const Index w : nodes_) take_apart(w);
        finish_nodes();
        return std::move(out_);
    }

private:
    /// Welded nodes that elements of the input join are on one side.
    void find_bodies() {
        body_.assign(input_.points.size(), -1);
        UnionFind bodies(input_.points.size());
        for (const CellBlock& b : input_.blocks()) {
            if (traits(b.type).dimension < 2) continue;
            SparseCheck check;
            for (Index c = 0; c < b.size(); ++c) {
                check();
                Index first = -1;
                for (const Index n : b.nodes(c)) {
                    if (!set_of_.contains(n)) continue;
                    if (first < 0) first = n;
                    bodies.unite(static_cast<int>(first), static_cast<int>(n));
                }
            }
        }
        for (const auto& [n, set] : set_of_) body_[n] = bodies.find(static_cast<int>(n));
        for (const auto& set : welded_.sets)  // such as lips around the crack's front: no two sides
            for (const Index n : set)
                for (const Index m : set)
                    if (n != m && body_[n] == body_[m]) mixed_.insert(body_[n]);
    }

    /// The body of an element by any welded node it had; -1 if it had none, or that tells no side.
    Index body_of(const CellRef& cell) const {
        const auto old = root(cell);
        if (!old) return -1;
        for (const Index n : input_.block(old->type).nodes(old->cell))
            if (set_of_.contains(n)) return mixed_.contains(body_[n]) ? -1 : body_[n];
        return -1;
    }

    /// Nodes of the input (indices) that a node of the result comes from.
    std::vector<Index> ancestors(Index number) const {
        if (const auto source = sources_.find(number); source != sources_.end()) number = source->second;
        if (const auto birth = births_.find(number); birth != births_.end()) {
            std::vector<Index> out;
            for (const Index a : changes_.born[birth->second].ancestors)
                if (const auto n = numbers_.node(a)) out.push_back(*n);
            return out;
        }
        if (const auto n = numbers_.node(number)) return {*n};
        return {};
    }

    /// Single nodes of the result, those that kept their number first, and where partners are that have no element.
    void find_nodes() {
        is_single_.assign(mesh_.points.size(), 0);
        std::vector<Index> others;
        SparseCheck check;
        for (Index w = 0; w < mesh_.node_count(); ++w) {
            check();
            const Index number = mesh_.node_ids[w];
            const bool is_new = sources_.contains(number) || births_.contains(number);
            if (!is_new) {
                const auto n = numbers_.node(number);
                if (!n || !set_of_.contains(*n)) continue;
                place_[*n] = w;
                if (set_of_.at(*n)->front() != *n) continue;
                nodes_.push_back(w);
            } else {
                if (std::ranges::none_of(ancestors(number), [&](Index n) { return set_of_.contains(n); })) continue;
                others.push_back(w);
            }
            is_single_[w] = 1;
        }
        std::ranges::stable_partition(others, [&](Index w) { return births_.contains(mesh_.node_ids[w]); });
        nodes_.insert(nodes_.end(), others.begin(), others.end());
    }

    void find_cells() {
        // Solids first, as what lies on their faces goes with them.
        for (int dimension = 3; dimension >= 0; --dimension)
            for (const CellBlock& b : mesh_.blocks()) {
                if (traits(b.type).dimension != dimension) continue;
                SparseCheck check;
                for (Index c = 0; c < b.size(); ++c) {
                    check();
                    const auto n = b.nodes(c);
                    // A spring or gap of no length kept its two nodes.
                    for (const Index v : n)
                        if (is_single_[v] && std::ranges::find(cells_[v], CellRef{b.type, c}) == cells_[v].end())
                            cells_[v].push_back({b.type, c});
                }
            }
    }

    /// Corners of the faces that were welded.
    void find_faces() {
        for (const Facet& f : mesh_.facets) {
            if (!mesh_.families.contains(f.family, welded_.faces)) continue;
            const CellTraits& t = traits(f.type);
            const auto n = mesh_.block(f.type).nodes(f.cell);
            std::vector<Index> corners;
            if (t.dimension == 3)
                for (const std::int8_t k : t.faces[f.face - 1]) {
                    if (k >= 0) corners.push_back(n[k]);
                }
            else if (f.face >= 3)
                for (const std::int8_t k : t.edges[f.face - 3]) corners.push_back(n[k]);
            std::ranges::sort(corners);
            faces_.insert(std::move(corners));
        }
    }

    std::optional<CellRef> root(const CellRef& cell) const {
        Index number = mesh_.block(cell.type).ids[cell.cell];
        if (const auto parent = parents_.find(number); parent != parents_.end()) number = parent->second;
        return numbers_.cell(number);
    }

    Label label_of(const CellRef& cell, const std::vector<Index>& from) const {
        Label out(from.size(), -1);
        const auto old = root(cell);
        if (!old) return out;
        const auto n = input_.block(old->type).nodes(old->cell);
        for (std::size_t k = 0; k < from.size(); ++k) {
            const auto set = set_of_.find(from[k]);
            if (set == set_of_.end()) continue;
            // A spring or gap between two of them kept both, of which the first is the single one.
            for (const Index v : *set->second)
                if (std::ranges::find(n, v) != n.end()) {
                    out[k] = v;
                    break;
                }
        }
        return out;
    }

    std::vector<Index> common_corners(const CellRef& a, const CellRef& b) const {
        std::vector<Index> out;
        const auto m = corners(b);
        for (const Index v : corners(a))
            if (std::ranges::find(m, v) != m.end()) out.push_back(v);
        std::ranges::sort(out);
        return out;
    }

    std::span<const Index> corners(const CellRef& c) const {
        return mesh_.block(c.type).nodes(c.cell).first(static_cast<std::size_t>(traits(c.type).corners));
    }

    /// Puts an element that had none of these nodes with those of its body.
    bool put_by_body(const CellRef& cell, const std::vector<Index>& from, std::vector<Part>& parts) const {
        const Index body = body_of(cell);
        if (body < 0) return false;
        Label label(from.size(), -1);
        for (std::size_t k = 0; k < from.size(); ++k)
            if (const auto set = set_of_.find(from[k]); set != set_of_.end())
                for (const Index n : *set->second)
                    if (body_[n] == body) label[k] = n;
        if (!is_known(label)) return false;
        const auto part = std::ranges::find_if(parts, [&](const Part& p) { return go_together(p.label, label); });
        if (part == parts.end())
            parts.push_back({std::move(label), {cell}});
        else
            part->cells.push_back(cell);
        return true;
    }

    /// What an element of which nothing was at the weld goes with: the one with which it has most corners in common,
    /// not across a welded face.
    Part* beside(const CellRef& cell, std::vector<Part>& parts) const {
        Part* best = nullptr;
        std::size_t most = 1;
        for (Part& p : parts)
            for (const CellRef& other : p.cells) {
                const std::vector<Index> common = common_corners(cell, other);
                if (common.size() <= most || faces_.contains(common)) continue;
                most = common.size();
                best = &p;
            }
        return best;
    }

    void take_apart(Index w) {
        const Index number = mesh_.node_ids[w];
        const std::vector<Index> from = ancestors(number);
        std::vector<Part> parts;
        std::vector<CellRef> rest;
        for (const CellRef& cell : cells_[w]) {
            Label label = label_of(cell, from);
            if (!is_known(label)) {
                rest.push_back(cell);
                continue;
            }
            const auto part = std::ranges::find_if(parts, [&](const Part& p) { return go_together(p.label, label); });
            if (part == parts.end()) {
                parts.push_back({std::move(label), {cell}});
            } else {
                for (std::size_t k = 0; k < label.size(); ++k) part->label[k] = std::max(part->label[k], label[k]);
                part->cells.push_back(cell);
            }
        }
        std::erase_if(rest, [&](const CellRef& cell) { return put_by_body(cell, from, parts); });
        // Some may be known only by others of them.
        while (!rest.empty()) {
            const std::size_t before = rest.size();
            std::erase_if(rest, [&](const CellRef& cell) {
                Part* part = beside(cell, parts);
                if (part) part->cells.push_back(cell);
                return part != nullptr;
            });
            if (rest.size() < before) continue;
            if (!parts.empty()) parts.front().cells.insert(parts.front().cells.end(), rest.begin(), rest.end());
            break;
        }
        // The side of the first nodes keeps a node that is new.
        std::ranges::stable_sort(parts, {}, [&](const Part& p) { return is_first_side(p.label) ? 0 : 1; });
        const FamilyIndex family = mesh_.node_families[w];
        for (std::size_t k = 0; k < parts.size(); ++k) give(w, k == 0, family, from, parts[k]);
    }

    bool is_first_side(const Label& label) const {
        return std::ranges::all_of(label, [&](Index n) { return n < 0 || set_of_.at(n)->front() == n; });
    }

    /// The groups of `family` that those of this side are in; groups of the operation stay.
    FamilyIndex of_side(FamilyIndex family, const Label& label) {
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
    void give(Index w, bool first, FamilyIndex family, const std::vector<Index>& from, const Part& part) {
        const Index number = mesh_.node_ids[w];
        const bool born =
            births_.contains(number) || (sources_.contains(number) && births_.contains(sources_.at(number)));
        Index node = w;
        if (!born) {
            const Index original = part.label.front();
            if (claimed_.insert(original).second)
                node = node_of(original, w);
            else if (!first || number == input_.node_ids[set_of_.at(original)->front()])
                node = copy(w, input_.node_ids[original]);
            else
                descend_from(number, input_.node_ids[original]);
        } else {
            node = give_born(w, first, from, part.label);
        }
        mesh_.node_families[node] = of_side(family, part.label);
        used_.insert(node);
        if (node == w) return;
        out_.partners[number].push_back(mesh_.node_ids[node]);
        for (const CellRef& c : part.cells) {
            CellBlock& b = mesh_.block(c.type);
            const auto count = static_cast<std::size_t>(traits(c.type).nodes);
            for (Index& v : std::span(b.connectivity).subspan(static_cast<std::size_t>(c.cell) * count, count))
                if (v == w) v = node;
        }
    }

    /// The same where w was born, or is a copy of a node born: the first of each side is born, others are its copies.
    Index give_born(Index w, bool first, const std::vector<Index>& from, const Label& label) {
        const Index number = mesh_.node_ids[w];
        const Index like = sources_.contains(number) ? sources_.at(number) : number;
        Index& owner = owners_[{like, *std::ranges::find_if(label, [](Index n) { return n >= 0; })}];
        if (first && number == like) {
            owner = number;
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
        owner = next_++;
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
        changes_.copies.push_back({next_, source});
        const Vec3 at = mesh_.points[w];
        return mesh_.add_node(at, next_++);
    }

    /// A copy is that of another side's node.
    void descend_from(Index copy, Index source) {
        for (Changes::Copy& c : changes_.copies)
            if (c.node == copy) c.source = source;
    }

    /// A node is born as the node `like` is, but on the side `label`.
    void add_birth(Index number, Index like, const std::vector<Index>& from, const Label& label) {
        ++out_.born;
        const Changes::Born model = changes_.born[births_.at(like)];
        const auto on_side = [&](Index ancestor) {
            const auto n = numbers_.node(ancestor);
            const auto k = n ? std::ranges::find(from, *n) : from.end();
            if (k == from.end()) return ancestor;
            const Index there = label[static_cast<std::size_t>(k - from.begin())];
            return there < 0 ? ancestor : input_.node_ids[there];
        };
        Changes::Born made{number, {}, {}};
        for (const Index a : model.ancestors) made.ancestors.push_back(on_side(a));
        for (const auto& [node, share] : model.shares) made.shares.emplace_back(on_side(node), share);
        std::ranges::sort(made.ancestors);
        changes_.born.push_back(std::move(made));
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
        for (const Index w : nodes_) drop(w);
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
    Index next_;
    NumberIndex numbers_;
    Unwelded out_;
    std::unordered_map<Index, const std::vector<Index>*> set_of_;  // by node of the input
    std::vector<Index> body_;  // of welded nodes of the input: the first of those on their side
    std::set<Index> mixed_;    // bodies that are on both sides of a weld
    std::unordered_map<Index, Index> parents_, sources_;  // numbers
    std::unordered_map<Index, std::size_t> births_;       // in changes_.born, by number
    std::vector<char> is_single_;
    std::vector<Index> nodes_;                // of the result, that may have to be taken apart
    std::unordered_map<Index, Index> place_;  // in the result, of welded nodes of the input
    std::unordered_map<Index, std::vector<CellRef>> cells_;
    std::set<std::vector<Index>> faces_;
    std::set<Index> claimed_;  // nodes of the input that a side has
    std::set<Index> used_;     // nodes of the result that elements have
    /// Number of the node that stands for a side of a node born, by that one's number and a node of the side.
    std::map<std::pair<Index, Index>, Index> owners_;
};

}  // namespace

Unwelded unweld(const Mesh& input, const Welded& welded, Mesh& mesh, Changes& changes, Index number) {
    return Unwelder(input, welded, mesh, changes, number).run();
}

}  // namespace femscalpel
