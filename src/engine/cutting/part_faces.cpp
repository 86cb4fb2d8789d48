// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/part_faces.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>

#include "cancel.h"
#include "cutting/face_cover.h"
#include "mesh/chains.h"
#include "mesh/union_find.h"

namespace femscalpel {
namespace {

using Key = FaceCover::Key;
using Face = FaceCover::Face;
using Owner = FaceCover::Owner;

Key key_of(std::span<const Index> corners) { return FaceCover::key_of(corners); }

class Parter {
public:
    Parter(const Mesh& mesh, const FaceCover& cover, const Numbering& numbering)
        : mesh_(mesh), cover_(cover), dimension_(cover.dimension()), next_(numbering), faces_(cover.faces()) {}

    Parted run(const PartedNames& names) {
        find_parts();
        out_.mesh = mesh_;
        negative_ = out_.mesh.add_group(names.negative, GroupKind::element);
        positive_ = out_.mesh.add_group(names.positive, GroupKind::element);
        give_copies();
        place_others();
        make_lips();
        make_front(names.front);
        return std::move(out_);
    }

private:
    /// At each node which elements hang together.
    void find_parts() {
        for (const auto& [key, face] : faces_)
            for (const Owner& o : face.owners)
                for (const Index n : FaceCover::nodes_of(mesh_, o)) at_node_[n];
        cover_.for_each_of(dimension_, [&](const CellRef& c) {
            for (const Index n : mesh_.block(c.type).nodes(c.cell))
                if (const auto there = at_node_.find(n); there != at_node_.end())
                    if (there->second.empty() || !(there->second.back() == c)) there->second.push_back(c);
        });
        for (const auto& [node, cells] : at_node_)
            if (is_corner(node, cells.front())) part(node, cells);
        for (const auto& [node, cells] : at_node_)
            if (!is_corner(node, cells.front())) part_middle(node, cells);
        if (parts_.empty())
            cover_.refuse("has all its " + cover_.what() + "s where the crack would end: none could be opened");
    }

    bool is_corner(Index node, const CellRef& cell) const {
        return std::ranges::find(cover_.corners(cell), node) != cover_.corners(cell).end();
    }

    /// A node in the middle of an edge or face is one for all elements that have the same corners there.
    void part_middle(Index node, const std::vector<CellRef>& cells) {
        std::map<std::vector<int>, std::vector<std::size_t>> classes;  // by the copies that the corners get
        for (std::size_t k = 0; k < cells.size(); ++k) {
            std::vector<int> copies;
            for (const Index corner : corners_beside(node, cells[k])) {
                const auto parts = parts_.find(corner);
                if (parts == parts_.end()) continue;
                const std::vector<CellRef>& there = at_node_.at(corner);
                copies.push_back(
                    parts->second[static_cast<std::size_t>(std::ranges::find(there, cells[k]) - there.begin())]);
            }
            classes[copies].push_back(k);
        }
        if (classes.size() < 2) return;
        std::vector<int>& of_cells = parts_[node];
        of_cells.assign(cells.size(), -1);
        int copy = -1;  // those with the originals (all -1) come first, and keep the node
        for (const auto& [copies, members] : classes) {
            for (const std::size_t k : members) of_cells[k] = copy;
            ++copy;
        }
    }

    /// The corners, ascending, of the smallest edge or face of an element that a node is in the middle of.
    std::vector<Index> corners_beside(Index node, const CellRef& c) const {
        const CellTraits& t = traits(c.type);
        const auto n = mesh_.block(c.type).nodes(c.cell);
        std::vector<Index> out;
        for (std::size_t e = 0; t.quadratic && e < t.edges.size(); ++e)
            if (n[t.corners + static_cast<int>(e)] == node) out = {n[t.edges[e][0]], n[t.edges[e][1]]};
        for (int f = 0; out.empty() && f < cover_.face_count(c.type); ++f) {
            const std::vector<Index> all = FaceCover::nodes_of(mesh_, cover_.owner(c.type, c.cell, f));
            if (std::ranges::find(all, node) != all.end()) out = cover_.corners_of(cover_.owner(c.type, c.cell, f));
        }
        std::ranges::sort(out);
        return out;
    }

    void part(Index node, const std::vector<CellRef>& cells) {
        std::map<Key, std::vector<int>> at_face;
        for (std::size_t k = 0; k < cells.size(); ++k)
            for (int f = 0; f < cover_.face_count(cells[k].type); ++f) {
                const Owner o = cover_.owner(cells[k].type, cells[k].cell, f);
                const std::vector<Index> all = FaceCover::nodes_of(mesh_, o);
                const Key key = key_of(cover_.corners_of(o));
                if (!cover_.is_degenerate(key) && std::ranges::find(all, node) != all.end())
                    at_face[key].push_back(static_cast<int>(k));
            }
        UnionFind before(cells.size()), after(cells.size());
        std::vector<int> score(cells.size(), 0);
        for (const auto& [key, there] : at_face) {
            const auto face = faces_.find(key);
            for (const int a : there) {
                before.unite(a, there[0]);
                if (face == faces_.end()) after.unite(a, there[0]);
            }
            if (face == faces_.end()) continue;
            for (std::size_t o = 0; o < face->second.owners.size(); ++o)
                for (const int a : there)
                    if (cells[static_cast<std::size_t>(a)] == face->second.owners[o].cell)
                        score[static_cast<std::size_t>(a)] += FaceCover::side(face->second, o);
        }
        // Of each piece that was one, the part that is most on the negative side, then the largest, keeps the node.
        std::map<int, std::map<int, std::pair<int, int>>> pieces;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            auto& [total, size] = pieces[before.find(static_cast<int>(k))][after.find(static_cast<int>(k))];
            total += score[k];
            ++size;
        }
        std::map<int, int> copy_of;  // part: which copy
        for (const auto& [piece, parts] : pieces) {
            const auto kept = std::ranges::max_element(parts, {}, [](const auto& p) { return p.second; });
            for (const auto& p : parts)
                if (p.first != kept->first) copy_of.emplace(p.first, static_cast<int>(copy_of.size()));
        }
        if (copy_of.empty()) return;
        std::vector<int>& of_cells = parts_[node];
        for (std::size_t k = 0; k < cells.size(); ++k) {
            const auto copy = copy_of.find(after.find(static_cast<int>(k)));
            of_cells.push_back(copy == copy_of.end() ? -1 : copy->second);
        }
    }

    void give_copies() {
        std::set<std::pair<CellType, Index>> changed;
        for (const auto& [node, of_cells] : parts_) {
            out_.doubled.push_back(node);
            std::vector<Index> copies(static_cast<std::size_t>(std::ranges::max(of_cells)) + 1);
            for (Index& copy : copies) {
                out_.changes.copies.push_back({next_.node, mesh_.node_ids[node]});
                copy = out_.mesh.add_node(mesh_.points[node], next_.node++, mesh_.node_families[node]);
            }
            const std::vector<CellRef>& cells = at_node_.at(node);
            for (std::size_t k = 0; k < cells.size(); ++k) {
                if (of_cells[k] < 0) continue;
                changed.emplace(cells[k].type, cells[k].cell);
                for (Index& v : nodes_in(cells[k]))
                    if (v == node) v = copies[static_cast<std::size_t>(of_cells[k])];
            }
        }
        for (const auto& [type, cell] : changed) out_.changed.push_back({type, cell});
    }

    std::span<Index> nodes_in(const CellRef& c) {
        const auto count = static_cast<std::size_t>(traits(c.type).nodes);
        return std::span(out_.mesh.block(c.type).connectivity).subspan(static_cast<std::size_t>(c.cell) * count, count);
    }

    /// Nodes of a lower element as an element that has them all has them now.
    std::optional<std::vector<Index>> image(const CellRef& cell, const CellRef& host) {
        const auto was = mesh_.block(host.type).nodes(host.cell);
        const auto now = nodes_in(host);
        std::vector<Index> out;
        for (const Index n : mesh_.block(cell.type).nodes(cell.cell)) {
            const auto at = std::ranges::find(was, n);
            if (at == was.end()) return {};
            out.push_back(now[static_cast<std::size_t>(at - was.begin())]);
        }
        return out;
    }

    /// What is on faces and edges goes with the solids there; what is on opened faces is the lips' (make_lips()).
    void place_others() {
        for (int d = 0; d < dimension_; ++d)
            cover_.for_each_of(d, [&](const CellRef& c) {
                const auto nodes = mesh_.block(c.type).nodes(c.cell);
                const auto doubled = std::ranges::find_if(nodes, [&](Index n) { return parts_.contains(n); });
                if (doubled == nodes.end()) return;
                if (d == dimension_ - 1 && faces_.contains(key_of(cover_.corners(c)))) return;
                std::vector<std::vector<Index>> images;
                for (const CellRef& host : at_node_.at(*doubled))
                    if (auto found = image(c, host); found && std::ranges::find(images, *found) == images.end())
                        images.push_back(std::move(*found));
                if (images.size() != 1) {
                    ++out_.whole;
                    out_.bridges += d == 2;
                    return;
                }
                if (std::ranges::equal(images.front(), nodes)) return;
                std::ranges::copy(images.front(), nodes_in(c).begin());
                out_.changed.push_back(c);
            });
    }

    void make_lips() {
        for (const auto& [key, face] : faces_) {
            std::vector<std::vector<Index>> sides;
            sides.reserve(face.owners.size());
            for (const Owner& o : face.owners) sides.push_back(FaceCover::nodes_of(out_.mesh, o));
            for (std::vector<Index>& nodes : sides) std::ranges::sort(nodes);
            if (std::ranges::all_of(sides, [&](const auto& nodes) { return nodes == sides[0]; })) {
                ++out_.closed;
                keep_on(face);
                continue;
            }
            opened_.push_back(&face);
            for (std::size_t o = 0; o < face.owners.size(); ++o) {
                // Of shells at a junction, some may stay joined, and have one lip.
                if (std::find(sides.begin(), sides.begin() + static_cast<std::ptrdiff_t>(o), sides[o]) !=
                    sides.begin() + static_cast<std::ptrdiff_t>(o))
                    continue;
                make_lip(face, face.owners[o], FaceCover::side(face, o) > 0 ? negative_ : positive_,
                         FaceCover::side(face, o) > 0);
            }
        }
        if (opened_.empty())
            cover_.refuse("has all its " + cover_.what() + "s where the crack would end: none could be opened");
    }

    /// Elements on a face that stays closed go with the elements there.
    void keep_on(const Face& face) {
        for (const CellRef& own : face.elements) {
            const auto nodes = image(own, face.owners[0].cell);
            if (!nodes || std::ranges::equal(*nodes, nodes_in(own))) continue;
            std::ranges::copy(*nodes, nodes_in(own).begin());
            out_.changed.push_back(own);
        }
    }

    /// Of elements on the face, each side gets one; the first is the lip.
    void make_lip(const Face& face, const Owner& o, GroupIndex group, bool negative) {
        FamilyTable& families = out_.mesh.families;
        if (face.elements.empty()) add_lip(o, families.with(0, group));
        for (const CellRef& own : face.elements) {
            const std::optional<std::vector<Index>> nodes = image(own, o.cell);
            if (!nodes) continue;
            FamilyIndex family = mesh_.block(own.type).families[own.cell];
            if (own == face.elements.front()) family = families.with(family, group);
            if (negative) {
                out_.changed.push_back(own);
                std::ranges::copy(*nodes, nodes_in(own).begin());
                out_.mesh.block(own.type).families[own.cell] = family;
                continue;
            }
            out_.changes.parts.push_back({next_.cell, mesh_.block(own.type).ids[own.cell]});
            add(own.type, *nodes, family);
        }
    }

    /// A triangle where two corners of the face are one.
    void add_lip(const Owner& o, FamilyIndex family) {
        const FacetElement f = facet_element(out_.mesh, FaceCover::facet(o));
        std::vector<Index> nodes(f.nodes.begin(), f.nodes.begin() + f.size);
        const auto count = static_cast<std::size_t>(traits(f.type).corners);
        CellType type = f.type;
        for (std::size_t k = 0; k < count && dimension_ == 3; ++k) {
            if (nodes[k] != nodes[(k + 1) % count]) continue;
            const bool quadratic = traits(f.type).quadratic;
            type = quadratic ? CellType::triangle6 : CellType::triangle;
            nodes.resize(quadratic ? 2 * count : count);
            if (quadratic) nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(count + k));
            nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(k));
            break;
        }
        add(type, nodes, family);
    }

    void add(CellType type, std::span<const Index> nodes, FamilyIndex family) {
        out_.added.push_back({type, out_.mesh.add_cell(type, nodes, next_.cell++, family)});
    }

    /// Edges of one opened face whose ends have no copies; of shells, nodes of opened edges without.
    void make_front(const std::string& name) {
        std::map<Key, std::pair<int, std::vector<Index>>> edges;  // how many faces have it; its nodes
        std::set<Index> tips;
        for (const Face* face : opened_) {
            const FacetElement f = facet_element(mesh_, FaceCover::facet(face->owners[0]));
            const auto count = static_cast<std::size_t>(traits(f.type).corners);
            for (std::size_t k = 0; k < count; ++k) {
                if (!parts_.contains(f.nodes[k])) tips.insert(f.nodes[k]);
                std::vector<Index> nodes{f.nodes[k], f.nodes[(k + 1) % count]};
                if (traits(f.type).quadratic && dimension_ == 3) nodes.push_back(f.nodes[count + k]);
                auto& [times, found] = edges[key_of(std::span(nodes).first(2))];
                ++times;
                found = nodes;
            }
        }
        if (tips.empty()) return;
        if (dimension_ == 2) {
            const GroupIndex group = out_.mesh.add_group(name, GroupKind::node);
            for (const Index n : tips)
                out_.mesh.node_families[n] = out_.mesh.families.with(out_.mesh.node_families[n], group);
            return;
        }
        std::erase_if(edges, [&](const auto& e) {
            return e.second.first != 1 ||
                   std::ranges::any_of(e.second.second, [&](Index n) { return parts_.contains(n); });
        });
        if (!edges.empty()) write_chains(edges, out_.mesh.add_group(name, GroupKind::element));
    }

    /// Segments in order; one that is there already joins the group.
    void write_chains(const std::map<Key, std::pair<int, std::vector<Index>>>& edges, GroupIndex group) {
        std::map<Key, CellRef> there;
        cover_.for_each_of(1, [&](const CellRef& c) {
            if (const Key key = key_of(cover_.corners(c)); edges.contains(key)) there.emplace(key, c);
        });
        std::vector<std::array<Index, 2>> ends;
        ends.reserve(edges.size());
        for (const auto& [key, edge] : edges) ends.push_back({key[0], key[1]});
        for (const std::vector<Index>& chain : chains_of(ends))
            for (std::size_t k = 0; k + 1 < chain.size(); ++k) {
                const Key key = key_of(std::span(chain).subspan(k, 2));
                if (const auto old = there.find(key); old != there.end()) {
                    FamilyIndex& family = out_.mesh.block(old->second.type).families[old->second.cell];
                    family = out_.mesh.families.with(family, group);
                    continue;
                }
                std::vector<Index> nodes = edges.at(key).second;
                if (nodes[0] != chain[k]) std::swap(nodes[0], nodes[1]);
                add(nodes.size() == 3 ? CellType::line3 : CellType::line, nodes, out_.mesh.families.with(0, group));
            }
    }

    const Mesh& mesh_;
    const FaceCover& cover_;
    const int dimension_;
    Numbering next_;
    const std::map<Key, Face>& faces_;
    Parted out_;
    GroupIndex negative_ = 0, positive_ = 0;
    std::unordered_map<Index, std::vector<CellRef>> at_node_;  // elements of the mesh's dimension, at their nodes
    std::map<Index, std::vector<int>> parts_;                  // of these, which copy each gets (-1: none)
    std::vector<const Face*> opened_;
};

}  // namespace

Parted part_along(const Mesh& mesh, GroupIndex group, const PartedNames& names, const Numbering& numbering) {
    FaceCover cover(mesh, group);
    (void)cover.find();
    return Parter(mesh, cover, numbering).run(names);
}

std::optional<Parted> part_along(const Mesh& mesh, const std::vector<double>& distance, double rounding,
                                 const PartedNames& names, const Numbering& numbering) {
    FaceCover cover(mesh, distance, rounding);
    if (!cover.find()) return {};
    return Parter(mesh, cover, numbering).run(names);
}

}  // namespace femscalpel
