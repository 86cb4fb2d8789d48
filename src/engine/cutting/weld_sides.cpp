// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/weld_sides.h"

#include <algorithm>
#include <numeric>

#include "cancel.h"
#include "mesh/union_find.h"

namespace femscalpel {
namespace {

bool is_known(const WeldLabel& label) {
    return std::ranges::any_of(label, [](Index n) { return n >= 0; });
}

bool conflict(const WeldLabel& a, const WeldLabel& b) {
    for (std::size_t k = 0; k < a.size(); ++k)
        if (a[k] >= 0 && b[k] >= 0 && a[k] != b[k]) return true;
    return false;
}

bool go_together(const WeldLabel& a, const WeldLabel& b) {
    for (std::size_t k = 0; k < a.size(); ++k)
        if (a[k] >= 0 && a[k] == b[k]) return !conflict(a, b);
    return false;
}

int dimension(const CellRef& c) { return traits(c.type).dimension; }

}  // namespace

WeldSides::WeldSides(const Mesh& input, const Welded& welded, const Mesh& mesh, const Changes& changes)
    : input_(input), welded_(welded), mesh_(mesh), numbers_(input) {
    for (const auto& set : welded.sets)
        for (const Index n : set) set_of_[n] = &set;
    for (const Changes::Part& p : changes.parts) parents_.emplace(p.element, p.parent);
    for (const Changes::Copy& c : changes.copies) sources_.emplace(c.node, c.source);
    for (const Changes::Born& b : changes.born) births_.emplace(b.node, b.ancestors);
    find_bodies();
    find_nodes();
    find_cells();
    find_faces();
    find_sides();
}

const std::vector<Index>* WeldSides::set_of(Index node) const {
    const auto found = set_of_.find(node);
    return found == set_of_.end() ? nullptr : found->second;
}

bool WeldSides::is_born(Index number) const { return births_.contains(source(number)); }

Index WeldSides::source(Index number) const {
    const auto found = sources_.find(number);
    return found == sources_.end() ? number : found->second;
}

std::vector<Index> WeldSides::ancestors(Index number) const {
    number = source(number);
    std::vector<Index> out;
    if (const auto birth = births_.find(number); birth != births_.end()) {
        for (const Index a : birth->second)
            if (const auto n = numbers_.node(a)) out.push_back(*n);
    } else if (const auto n = numbers_.node(number)) {
        out.push_back(*n);
    }
    return out;
}

/// Welded nodes that elements of the input join are on one side.
void WeldSides::find_bodies() {
    body_.assign(input_.points.size(), -1);
    dimension_at_.assign(input_.points.size(), 0);
    for (const CellBlock& b : input_.blocks())
        for (const Index n : b.connectivity)
            dimension_at_[n] = std::max(dimension_at_[n], static_cast<std::int8_t>(traits(b.type).dimension));
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
                for (const Index m : b.nodes(c))
                    if (m != n && set_of_.contains(m)) linked_[n].insert(m);
            }
        }
    }
    for (const auto& [n, set] : set_of_) body_[n] = bodies.find(static_cast<int>(n));
    for (const auto& set : welded_.sets)  // such as lips around the crack's front: no two sides
        for (const Index n : set)
            for (const Index m : set)
                if (n != m && body_[n] == body_[m]) mixed_.insert(body_[n]);
}

void WeldSides::find_nodes() {
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

void WeldSides::find_cells() {
    // Solids first, as what lies on their faces goes with them.
    for (int d = 3; d >= 0; --d)
        for (const CellBlock& b : mesh_.blocks()) {
            if (traits(b.type).dimension != d) continue;
            SparseCheck check;
            for (Index c = 0; c < b.size(); ++c) {
                check();
                for (const Index v : b.nodes(c))
                    if (is_single_[v] && std::ranges::find(cells_[v], CellRef{b.type, c}) == cells_[v].end())
                        cells_[v].push_back({b.type, c});
            }
        }
}

void WeldSides::find_faces() {
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
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        faces_.insert(std::move(corners));
    }
}

/// The element of the input that an element descends from.
std::optional<CellRef> WeldSides::root(const CellRef& cell) const {
    const Index number = mesh_.block(cell.type).ids[cell.cell];
    const auto parent = parents_.find(number);
    return numbers_.cell(parent == parents_.end() ? number : parent->second);
}

/// The body of an element by any welded node it had; -1 if it had none, or that tells no side.
Index WeldSides::body_of(const CellRef& cell) const {
    const auto old = root(cell);
    if (!old) return -1;
    for (const Index n : input_.block(old->type).nodes(old->cell))
        if (set_of_.contains(n)) return mixed_.contains(body_[n]) ? -1 : body_[n];
    return -1;
}

WeldLabel WeldSides::label_of(const CellRef& cell, const std::vector<Index>& from) const {
    WeldLabel out(from.size(), -1);
    const auto old = root(cell);
    if (!old) return out;
    const auto n = input_.block(old->type).nodes(old->cell);
    for (std::size_t k = 0; k < from.size(); ++k) {
        const std::vector<Index>* set = set_of(from[k]);
        if (!set) continue;
        const auto own = std::ranges::find_if(*set, [&](Index v) { return std::ranges::find(n, v) != n.end(); });
        if (own != set->end()) out[k] = *own;
    }
    return out;
}

std::span<const Index> WeldSides::corners(const CellRef& c) const {
    return mesh_.block(c.type).nodes(c.cell).first(static_cast<std::size_t>(traits(c.type).corners));
}

/// Corners, ascending, of the faces of a solid (edges of a shell) that have the node.
std::vector<std::vector<Index>> WeldSides::faces_at(const CellRef& c, Index node) const {
    const CellTraits& t = traits(c.type);
    const auto n = mesh_.block(c.type).nodes(c.cell);
    // Of a mid-side node, those that have both ends of its edge; of others in the middle, all.
    std::vector<Index> needed;
    if (std::ranges::find(corners(c), node) != corners(c).end()) needed.push_back(node);
    for (std::size_t e = 0; needed.empty() && t.quadratic && e < t.edges.size(); ++e)
        if (n[t.corners + static_cast<int>(e)] == node) needed = {n[t.edges[e][0]], n[t.edges[e][1]]};
    std::vector<std::vector<Index>> out;
    const auto add = [&](const auto& face) {
        std::vector<Index> key;
        for (const std::int8_t k : face)
            if (k >= 0) key.push_back(n[k]);
        std::ranges::sort(key);
        key.erase(std::unique(key.begin(), key.end()), key.end());
        if (std::ranges::all_of(needed, [&](Index v) { return std::ranges::binary_search(key, v); }))
            out.push_back(std::move(key));
    };
    if (t.dimension == 3)
        for (const auto& face : t.faces) add(face);
    else
        for (const auto& edge : t.edges) add(edge);
    return out;
}

bool WeldSides::are_layers(const CellRef& a, const CellRef& b) const {
    return std::ranges::is_permutation(corners(a), corners(b));
}

/// Elements at a node in parts.
struct WeldSides::Pieces {
    std::vector<CellRef> cells;
    std::vector<int> part_of;  // of each
    std::vector<WeldSide> parts;
    AtFace at_face;  // places in `cells`, by corners of the faces they have
    /// Parts that lie on each other, with a welded face between them or as layers of shells.
    std::set<std::pair<int, int>> across;
};

/// Parts that are joined by faces (shells: edges), but for welded ones.
void WeldSides::join_by_faces(std::span<const CellRef> cells, const AtFace& at_face, const std::vector<Index>& from,
                              Pieces& out) const {
    std::vector<WeldLabel> labels;
    for (const CellRef& c : cells) labels.push_back(label_of(c, from));
    const auto were_together = [&](int a, int b) {
        if (conflict(labels[a], labels[b])) return false;
        if (go_together(labels[a], labels[b])) return true;
        const Index body = body_of(cells[a]), other = body_of(cells[b]);
        return body < 0 || other < 0 || body == other;
    };
    UnionFind joined(cells.size());
    for (const auto& [face, there] : at_face) {
        if (faces_.contains(face)) continue;
        // Of shells on each other, what is on one side is only known from what they were.
        const bool alone = there.size() == 2 && !are_layers(cells[there[0]], cells[there[1]]);
        for (const int a : there)
            for (const int b : there)
                if (a < b && (alone || were_together(a, b))) joined.unite(a, b);
    }
    const std::size_t first = out.parts.size();
    std::map<int, int> place;
    for (int k = 0; k < static_cast<int>(cells.size()); ++k) {
        const auto [it, fresh] = place.emplace(joined.find(k), static_cast<int>(out.parts.size()));
        if (fresh) out.parts.push_back({});
        out.parts[static_cast<std::size_t>(it->second)].cells.push_back(cells[k]);
        out.part_of.push_back(it->second);
    }
    for (std::size_t k = first; k < out.parts.size(); ++k) out.parts[k].label = usual_label(out.parts[k].cells, from);
}

/// Adds elements of one dimension.
void WeldSides::find_pieces(std::span<const CellRef> cells, Index node, const std::vector<Index>& from,
                            Pieces& out) const {
    AtFace at_face;
    for (std::size_t k = 0; k < cells.size(); ++k)
        for (std::vector<Index>& face : faces_at(cells[k], node))
            at_face[std::move(face)].push_back(static_cast<int>(k));
    const int first = static_cast<int>(out.cells.size());
    join_by_faces(cells, at_face, from, out);
    out.cells.insert(out.cells.end(), cells.begin(), cells.end());
    for (auto& [face, there] : at_face) {
        std::vector<int>& all = out.at_face[face];
        for (const int k : there) all.push_back(k + first);
    }
}

void WeldSides::find_layers(Pieces& pieces) const {
    const auto put = [&](int a, int b) {
        const int one = pieces.part_of[a], other = pieces.part_of[b];
        if (one == other) return;
        pieces.across.insert({one, other});
        pieces.across.insert({other, one});
    };
    for (const auto& [face, there] : pieces.at_face)
        for (const int a : there)
            for (const int b : there)
                if (faces_.contains(face) || are_layers(pieces.cells[a], pieces.cells[b])) put(a, b);
    // Shells of their own on the faces of solids.
    for (int k = 0; k < static_cast<int>(pieces.cells.size()); ++k) {
        if (dimension(pieces.cells[k]) == dimension(pieces.cells.front())) continue;
        std::vector<Index> face(corners(pieces.cells[k]).begin(), corners(pieces.cells[k]).end());
        std::ranges::sort(face);
        if (const auto there = pieces.at_face.find(face); there != pieces.at_face.end())
            for (const int other : there->second) put(k, other);
    }
}

/// Whether a shell had welded nodes that no solid had.
bool WeldSides::is_own(const CellRef& cell) const {
    const auto old = root(cell);
    if (!old || dimension(cell) < 2) return false;
    return std::ranges::any_of(input_.block(old->type).nodes(old->cell),
                               [&](Index n) { return set_of_.contains(n) && dimension_at_[n] == dimension(cell); });
}

/// What most of the elements say; by their bodies where they had none of the nodes.
WeldLabel WeldSides::usual_label(const std::vector<CellRef>& cells, const std::vector<Index>& from) const {
    std::vector<std::map<Index, int>> votes(from.size());
    for (const CellRef& c : cells) {
        const WeldLabel label = label_of(c, from);
        for (std::size_t k = 0; k < from.size(); ++k)
            if (label[k] >= 0) ++votes[k][label[k]];
    }
    const std::vector<std::map<Index, int>> direct = votes;
    for (const CellRef& c : cells) {
        const Index body = body_of(c);
        if (body < 0) continue;
        for (std::size_t k = 0; k < from.size(); ++k)
            if (const std::vector<Index>* set = set_of(from[k]); set && direct[k].empty())
                for (const Index n : *set)
                    if (body_[n] == body) ++votes[k][n];
    }
    WeldLabel out(from.size(), -1);
    for (std::size_t k = 0; k < from.size(); ++k)
        if (!votes[k].empty())
            out[k] = std::ranges::max_element(votes[k], {}, [](const auto& v) { return v.second; })->first;
    return out;
}

void WeldSides::find_sides() {
    for (const Index n : nodes_) sides_.push_back(at(n, facing_.emplace_back()));
    for (const std::vector<Index>& face : faces_) {
        const bool reached = std::ranges::any_of(face, [&](Index n) { return is_single_[n] != 0; });
        joined_ += !reached || (met_.contains(face) && !parted_.contains(face));
    }
}

std::vector<WeldSide> WeldSides::at(Index node, std::set<std::pair<int, int>>& facing) {
    if (!cells_.contains(node)) return {};
    const std::vector<Index> from = ancestors(mesh_.node_ids[node]);
    const std::vector<CellRef>& all = cells_.at(node);
    const auto lower = std::ranges::find_if(all, [&](const CellRef& c) { return dimension(c) < dimension(all[0]); });
    Pieces pieces;
    find_pieces(std::span(all.begin(), lower), node, from, pieces);
    std::vector<CellRef> own;
    std::copy_if(lower, all.end(), std::back_inserter(own), [&](const CellRef& c) { return is_own(c); });
    if (!own.empty()) find_pieces(own, node, from, pieces);
    find_layers(pieces);
    std::vector<WeldSide> sides;
    std::vector<std::vector<int>> members;  // of the parts, by side
    std::vector<int> side_of;               // by part
    for (int k = 0; k < static_cast<int>(pieces.parts.size()); ++k) {
        // Parts of one side that hang together at an edge or at the node only.
        const auto may_join = [&](std::size_t at) {
            return std::ranges::none_of(members[at], [&](int m) { return pieces.across.contains({m, k}); });
        };
        WeldSide& part = pieces.parts[static_cast<std::size_t>(k)];
        std::size_t at = 0;
        while (at < sides.size() && !(may_join(at) && go_together(sides[at].label, part.label))) ++at;
        if (at == sides.size()) {
            sides.push_back({part.label, {}});
            members.emplace_back();
        }
        side_of.push_back(static_cast<int>(at));
        members[at].push_back(k);
        sides[at].cells.insert(sides[at].cells.end(), part.cells.begin(), part.cells.end());
        for (std::size_t i = 0; i < from.size(); ++i)
            if (sides[at].label[i] < 0) sides[at].label[i] = part.label[i];
    }
    std::vector<std::pair<int, int>> opposite;
    for (const auto& [one, other] : pieces.across)
        if (side_of[one] != side_of[other]) opposite.emplace_back(side_of[one], side_of[other]);
    for (const auto& [face, there] : pieces.at_face) {
        if (!faces_.contains(face) || there.size() < 2) continue;
        met_.insert(face);
        const auto side = [&](int cell) { return side_of[pieces.part_of[cell]]; };
        if (std::ranges::any_of(there, [&](int c) { return side(c) != side(there[0]); })) parted_.insert(face);
    }
    complete(sides, from, opposite);
    for (auto cell = lower; cell != all.end(); ++cell)
        if (!is_own(*cell) && guest(*cell, all).hosts.empty()) add_lone(*cell, from, sides);
    std::vector<int> order(sides.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](int s) { return is_first(sides[s].label) ? 0 : 1; });
    std::vector<WeldSide> out;
    std::vector<int> place(order.size());
    for (const int s : order) {
        place[s] = static_cast<int>(out.size());
        out.push_back(std::move(sides[s]));
    }
    for (const auto& [one, other] : opposite) facing.insert(std::minmax(place[one], place[other]));
    return out;
}

WeldSides::Guest WeldSides::guest(const CellRef& cell, std::span<const CellRef> others) const {
    Guest out{cell, {}};
    const auto own = mesh_.block(cell.type).nodes(cell.cell);
    for (const CellRef& other : others) {  // the highest dimension first
        if (dimension(other) <= dimension(cell)) break;
        if (!out.hosts.empty() && dimension(other) < dimension(out.hosts.front().first)) break;
        const auto n = mesh_.block(other.type).nodes(other.cell);
        std::vector<int> at;
        for (const Index v : own)
            if (const auto k = std::ranges::find(n, v); k != n.end()) at.push_back(static_cast<int>(k - n.begin()));
        if (at.size() == own.size()) out.hosts.emplace_back(other, std::move(at));
    }
    return out;
}

std::vector<WeldSides::Guest> WeldSides::guests() const {
    std::vector<Guest> out;
    std::set<Index> seen;  // numbers
    for (const Index node : nodes_) {
        if (!cells_.contains(node)) continue;
        const std::vector<CellRef>& cells = cells_.at(node);
        for (const CellRef& c : cells) {
            if (dimension(c) == dimension(cells.front()) || is_own(c) ||
                !seen.insert(mesh_.block(c.type).ids[c.cell]).second)
                continue;
            if (Guest made = guest(c, cells); !made.hosts.empty()) out.push_back(std::move(made));
        }
    }
    return out;
}

int WeldSides::votes(const CellRef& cell, Index number, const WeldLabel& label) const {
    const WeldLabel own = label_of(cell, ancestors(number));
    int out = 0;
    for (std::size_t k = 0; k < own.size() && k < label.size(); ++k)
        if (own[k] >= 0 && label[k] >= 0) out += own[k] == label[k] ? 1 : -1;
    return out;
}

/// How many nodes of a side share elements with a node of the input.
int WeldSides::ties(const WeldLabel& label, Index node) const {
    const auto linked = linked_.find(node);
    if (linked == linked_.end()) return 0;
    return static_cast<int>(std::ranges::count_if(label, [&](Index n) { return linked->second.contains(n); }));
}

/// Each side gets nodes of its own: those that no element tells, or that another side has, from what is left. Of that,
/// what faced the nodes of the side opposite, then what was most with its other nodes.
void WeldSides::complete(std::vector<WeldSide>& sides, const std::vector<Index>& from,
                         const std::vector<std::pair<int, int>>& opposite) const {
    for (std::size_t i = 0; i < from.size(); ++i) {
        const std::vector<Index>* set = set_of(from[i]);
        if (!set) continue;
        std::set<Index> taken;
        for (WeldSide& s : sides)
            if (s.label[i] >= 0 && !taken.insert(s.label[i]).second) s.label[i] = -1;
        const auto rank = [&](int side, Index n) {
            const bool faces = std::ranges::any_of(opposite, [&](const auto& pair) {
                if (pair.first != side) return false;
                const Index other = sides[static_cast<std::size_t>(pair.second)].label[i];
                return std::ranges::binary_search(welded_.facing, std::array{std::min(n, other), std::max(n, other)});
            });
            return std::pair(faces, ties(sides[static_cast<std::size_t>(side)].label, n));
        };
        for (;;) {
            std::pair<bool, int> most{false, -1};
            int best = -1;
            Index node = -1;
            for (int s = 0; s < static_cast<int>(sides.size()); ++s)
                for (const Index n : *set)
                    if (sides[static_cast<std::size_t>(s)].label[i] < 0 && !taken.contains(n) && rank(s, n) > most) {
                        most = rank(s, n);
                        best = s;
                        node = n;
                    }
            if (best < 0) break;
            taken.insert(sides[static_cast<std::size_t>(best)].label[i] = node);
        }
    }
    for (WeldSide& s : sides)
        if (!is_known(s.label))
            for (std::size_t i = 0; i < from.size(); ++i)
                if (const std::vector<Index>* set = set_of(from[i])) s.label[i] = set->front();
}

/// An element beside those that make the sides, of which none has all its nodes: it goes with the side it was on.
void WeldSides::add_lone(const CellRef& cell, const std::vector<Index>& from, std::vector<WeldSide>& sides) const {
    const WeldLabel label = label_of(cell, from);
    const auto side = std::ranges::find_if(sides, [&](const WeldSide& s) { return go_together(s.label, label); });
    if (side != sides.end())
        side->cells.push_back(cell);
    else if (is_known(label))
        sides.push_back({label, {cell}});
    else
        sides.front().cells.push_back(cell);
}

bool WeldSides::is_first(const WeldLabel& label) const {
    return std::ranges::all_of(label, [&](Index n) { return n < 0 || set_of_.at(n)->front() == n; });
}

}  // namespace femscalpel
