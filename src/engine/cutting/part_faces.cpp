// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/part_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>

#include "cancel.h"
#include "mesh/chains.h"
#include "mesh/facet_element.h"
#include "mesh/union_find.h"

namespace femscalpel {
namespace {

/// Corners of a face or edge, ascending, each once; then -1.
using Key = std::array<Index, 4>;

Key key_of(std::span<const Index> corners) {
    std::vector<Index> nodes(corners.begin(), corners.end());
    std::ranges::sort(nodes);
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    Key out{-1, -1, -1, -1};
    std::copy_n(nodes.begin(), std::min<std::size_t>(nodes.size(), 4), out.begin());
    return out;
}

/// A face as one of the elements at it has it.
struct Owner {
    CellRef cell;
    int face;  // Facet::face
};

struct Face {
    std::vector<Owner> owners;
    std::optional<CellRef> element;  // that lies on it
    int reference = 0;               // 1: the first owner is on the negative side, as what covers it says; -1: not
    int sense = 0;                   // the same when it is known
};

class Parter {
public:
    Parter(const Mesh& mesh, GroupIndex group, const Numbering& numbering)
        : mesh_(mesh), group_(group), dimension_(mesh.dimension()), next_(numbering) {}

    Parter(const Mesh& mesh, const std::vector<double>& distance, double rounding, const Numbering& numbering)
        : Parter(mesh, -1, numbering) {
        distance_ = &distance;
        rounding_ = rounding;
    }

    /// To be called first.
    bool finds_faces() {
        find_wanted();
        find_owners();
        return !faces_.empty();
    }

    Parted run(const PartedNames& names) {
        orient();
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
    [[noreturn]] void refuse(const std::string& why) const {
        if (distance_) throw ToolError("what lies on the tool " + why, "tool");
        throw ToolError("group '" + mesh_.groups[group_].name + "' " + why, "group");
    }
    std::string what() const { return dimension_ == 3 ? "face" : "edge"; }
    bool has(FamilyIndex family) const { return mesh_.families.contains(family, group_); }
    std::span<const Index> corners(const CellRef& c) const {
        return mesh_.block(c.type).nodes(c.cell).first(static_cast<std::size_t>(traits(c.type).corners));
    }
    int face_count(CellType type) const {
        return static_cast<int>(dimension_ == 3 ? traits(type).faces.size() : traits(type).edges.size());
    }
    Facet facet(const Owner& o) const { return {o.cell.type, static_cast<std::int8_t>(o.face), 0, o.cell.cell}; }
    /// All nodes of a face, corners first, turned out of its owner.
    std::vector<Index> nodes_of(const Mesh& mesh, const Owner& o) const {
        const FacetElement f = facet_element(mesh, facet(o));
        return {f.nodes.begin(), f.nodes.begin() + f.size};
    }
    std::vector<Index> corners_of(const Owner& o) const {
        const FacetElement f = facet_element(mesh_, facet(o));
        return {f.nodes.begin(), f.nodes.begin() + traits(f.type).corners};
    }
    Owner owner(CellType type, Index cell, int k) const { return {{type, cell}, dimension_ == 3 ? k + 1 : k + 3}; }

    /// Faces that the group covers; nodes that they have.
    void find_wanted() {
        reached_.assign(mesh_.points.size(), 0);
        const auto want = [&](std::span<const Index> nodes) -> Face& {
            for (const Index n : nodes) reached_[n] = 1;
            return faces_[key_of(nodes)];
        };
        if (distance_) {
            for (std::size_t n = 0; n < reached_.size(); ++n) reached_[n] = std::abs((*distance_)[n]) <= rounding_;
            return;
        }
        const GroupKind kind = mesh_.groups[group_].kind;
        if (kind == GroupKind::node) {
            for (std::size_t n = 0; n < reached_.size(); ++n) reached_[n] = has(mesh_.node_families[n]);
        } else if (kind == GroupKind::facet) {
            for (const Facet& f : mesh_.facets)
                if (has(f.family) && traits(f.type).dimension == dimension_ && (dimension_ == 3 || f.face > 2)) {
                    const Owner o{{f.type, f.cell}, f.face};
                    told_.emplace(key_of(corners_of(o)), o.cell);
                    want(corners_of(o));
                }
        } else {
            for (const CellBlock& b : mesh_.blocks())
                for (Index c = 0; c < b.size(); ++c) {
                    if (!has(b.families[c])) continue;
                    if (traits(b.type).dimension == dimension_)
                        refuse("has " + std::string(traits(b.type).name) + " elements; give a group of " + what() +
                               "s between them");
                    if (traits(b.type).dimension == dimension_ - 1) want(corners({b.type, c}));
                }
        }
        if (kind != GroupKind::node && faces_.empty()) refuse("covers no " + what());
        for_each_of(dimension_ - 1, [&](const CellRef& c) {
            if (const auto face = faces_.find(key_of(corners(c))); face != faces_.end()) face->second.element = c;
        });
    }

    void for_each_of(int dimension, auto visit) const {
        SparseCheck check;
        for (const CellBlock& b : mesh_.blocks()) {
            if (traits(b.type).dimension != dimension) continue;
            for (Index c = 0; c < b.size(); ++c) {
                check();
                visit(CellRef{b.type, c});
            }
        }
    }

    void find_owners() {
        const bool by_nodes = distance_ || mesh_.groups[group_].kind == GroupKind::node;
        for_each_of(dimension_, [&](const CellRef& c) {
            if (std::ranges::count_if(corners(c), [&](Index n) { return reached_[n] != 0; }) < dimension_) return;
            for (int k = 0; k < face_count(c.type); ++k) {
                const Owner o = owner(c.type, c.cell, k);
                const std::vector<Index> nodes = corners_of(o);
                if (!std::ranges::all_of(nodes, [&](Index n) { return reached_[n] != 0; })) continue;
                const Key key = key_of(nodes);
                if (key[static_cast<std::size_t>(dimension_) - 1] < 0) continue;  // of a degenerate element
                if (by_nodes)
                    faces_[key].owners.push_back(o);
                else if (const auto face = faces_.find(key); face != faces_.end())
                    face->second.owners.push_back(o);
            }
        });
        const bool any = !faces_.empty();
        std::erase_if(faces_, [](const auto& f) { return f.second.owners.size() < 2; });
        if (!any && !distance_) refuse("covers no " + what() + ": no element has all corners of one in it");
        if (faces_.empty() && !distance_)
            refuse("covers no " + what() +
                   " between two elements: it lies on the outside, or is open there already; nothing could be parted");
        if (by_nodes)
            for_each_of(dimension_ - 1, [&](const CellRef& c) {
                if (const auto face = faces_.find(key_of(corners(c))); face != faces_.end()) face->second.element = c;
            });
        for (auto& [key, face] : faces_) {
            if (face.owners.size() > 2 && dimension_ == 3)
                refuse("has a face of " + std::to_string(face.owners.size()) +
                       " elements: the mesh does not fit there");
            ask(key, face);
        }
    }

    /// What the group's element or facet says.
    void ask(const Key& key, Face& face) const {
        if (distance_) {
            for (const Index n : corners(face.owners[0].cell))
                if (std::abs((*distance_)[n]) > rounding_) face.reference = (*distance_)[n] < 0 ? 1 : -1;
            return;
        }
        if (const auto told = told_.find(key); told != told_.end())
            face.reference = told->second == face.owners[0].cell ? 1 : -1;
        if (!face.element || mesh_.groups[group_].kind != GroupKind::element) return;
        const auto own = corners(*face.element);
        const std::vector<Index> out = corners_of(face.owners[0]);
        const auto at = std::ranges::find(out, own[0]);
        const bool same = dimension_ == 2 ? out[0] == own[0] : *(at + 1 == out.end() ? out.begin() : at + 1) == own[1];
        face.reference = same ? 1 : -1;
    }

    /// Faces that go on smoothly have one negative side.
    void orient() {
        std::map<Key, std::vector<std::pair<Face*, bool>>> at_border;  // of each edge (node): which way it runs
        for (auto& [key, face] : faces_) {
            const std::vector<Index> n = corners_of(face.owners[0]);
            if (dimension_ == 2) {
                at_border[key_of(std::span(n).first(1))].emplace_back(&face, true);
                at_border[key_of(std::span(n).subspan(1, 1))].emplace_back(&face, false);
                continue;
            }
            for (std::size_t k = 0; k < n.size(); ++k) {
                const std::array<Index, 2> edge{n[k], n[(k + 1) % n.size()]};
                if (edge[0] != edge[1]) at_border[key_of(edge)].emplace_back(&face, edge[0] < edge[1]);
            }
        }
        std::map<Face*, std::vector<std::pair<Face*, int>>> beside;
        for (const auto& [edge, there] : at_border)
            if (there.size() == 2) {
                const int turned = there[0].second == there[1].second ? -1 : 1;
                beside[there[0].first].emplace_back(there[1].first, turned);
                beside[there[1].first].emplace_back(there[0].first, turned);
            }
        for (auto& [key, face] : faces_) {
            if (face.sense != 0) continue;
            std::vector<Face*> patch{&face};
            face.sense = 1;
            for (std::size_t k = 0; k < patch.size(); ++k)
                for (const auto& [other, turned] : beside[patch[k]])
                    if (other->sense == 0) {
                        other->sense = patch[k]->sense * turned;
                        patch.push_back(other);
                    }
            if (is_turned(patch))
                for (Face* f : patch) f->sense = -f->sense;
        }
    }

    bool is_turned(const std::vector<Face*>& patch) const {
        int votes = 0;
        Vec3 normal = Vec3::Zero();
        for (const Face* f : patch) {
            votes += f->reference * f->sense;
            const std::vector<Index> n = corners_of(f->owners[0]);
            const Vec3 &a = mesh_.points[n[0]], &b = mesh_.points[n[1]], &c = mesh_.points[n.back()];
            const Vec3 way = dimension_ == 3 ? (b - a).cross(c - a) : b - a;
            normal += f->sense * way;
        }
        if (votes != 0) return votes < 0;
        Eigen::Index largest = 0;
        normal.cwiseAbs().maxCoeff(&largest);
        return normal[largest] < 0;
    }

    /// 1 on the negative side, -1 on the positive.
    static int side(const Face& face, std::size_t owner) { return owner == 0 ? face.sense : -face.sense; }

    /// At each node which elements hang together.
    void find_parts() {
        for (const auto& [key, face] : faces_)
            for (const Owner& o : face.owners)
                for (const Index n : nodes_of(mesh_, o)) at_node_[n];
        for_each_of(dimension_, [&](const CellRef& c) {
            for (const Index n : mesh_.block(c.type).nodes(c.cell))
                if (const auto there = at_node_.find(n); there != at_node_.end())
                    if (there->second.empty() || !(there->second.back() == c)) there->second.push_back(c);
        });
        for (const auto& [node, cells] : at_node_)
            if (is_corner(node, cells.front())) part(node, cells);
        for (const auto& [node, cells] : at_node_)
            if (!is_corner(node, cells.front())) part_middle(node, cells);
        if (parts_.empty()) refuse("has all its " + what() + "s where the crack would end: none could be opened");
    }

    bool is_corner(Index node, const CellRef& cell) const {
        return std::ranges::find(corners(cell), node) != corners(cell).end();
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
        for (int f = 0; out.empty() && f < face_count(c.type); ++f) {
            const std::vector<Index> all = nodes_of(mesh_, owner(c.type, c.cell, f));
            if (std::ranges::find(all, node) != all.end()) out = corners_of(owner(c.type, c.cell, f));
        }
        std::ranges::sort(out);
        return out;
    }

    void part(Index node, const std::vector<CellRef>& cells) {
        std::map<Key, std::vector<int>> at_face;
        for (std::size_t k = 0; k < cells.size(); ++k)
            for (int f = 0; f < face_count(cells[k].type); ++f) {
                const Owner o = owner(cells[k].type, cells[k].cell, f);
                const std::vector<Index> all = nodes_of(mesh_, o);
                if (std::ranges::find(all, node) != all.end())
                    at_face[key_of(corners_of(o))].push_back(static_cast<int>(k));
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
                        score[static_cast<std::size_t>(a)] += side(face->second, o);
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
            for_each_of(d, [&](const CellRef& c) {
                const auto nodes = mesh_.block(c.type).nodes(c.cell);
                const auto doubled = std::ranges::find_if(nodes, [&](Index n) { return parts_.contains(n); });
                if (doubled == nodes.end()) return;
                if (d == dimension_ - 1 && faces_.contains(key_of(corners(c)))) return;
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
            for (const Owner& o : face.owners) sides.push_back(nodes_of(out_.mesh, o));
            const auto is_first = [&](std::vector<Index> nodes) {
                std::ranges::sort(nodes);
                std::vector<Index> first = sides[0];
                std::ranges::sort(first);
                return nodes == first;
            };
            if (std::ranges::all_of(sides, is_first)) {
                ++out_.closed;
                keep_on(face);
                continue;
            }
            opened_.push_back(&face);
            for (std::size_t o = 0; o < face.owners.size(); ++o)
                make_lip(face, face.owners[o], side(face, o) > 0 ? negative_ : positive_, side(face, o) > 0);
        }
        if (opened_.empty()) refuse("has all its " + what() + "s where the crack would end: none could be opened");
    }

    /// An element on a face that stays closed goes with the elements there.
    void keep_on(const Face& face) {
        if (!face.element) return;
        const auto nodes = image(*face.element, face.owners[0].cell);
        if (!nodes || std::ranges::equal(*nodes, nodes_in(*face.element))) return;
        std::ranges::copy(*nodes, nodes_in(*face.element).begin());
        out_.changed.push_back(*face.element);
    }

    void make_lip(const Face& face, const Owner& o, GroupIndex group, bool negative) {
        FamilyTable& families = out_.mesh.families;
        if (!face.element) {
            const FacetElement f = facet_element(out_.mesh, facet(o));
            const std::span<const Index> nodes(f.nodes.data(), static_cast<std::size_t>(f.size));
            add(f.type, nodes, families.with(0, group));
            return;
        }
        const CellRef& own = *face.element;
        std::optional<std::vector<Index>> nodes = image(own, o.cell);
        if (!nodes) return;
        const FamilyIndex family = families.with(mesh_.block(own.type).families[own.cell], group);
        if (negative) {
            out_.changed.push_back(own);
            std::ranges::copy(*nodes, nodes_in(own).begin());
            out_.mesh.block(own.type).families[own.cell] = family;
            return;
        }
        out_.changes.parts.push_back({next_.cell, mesh_.block(own.type).ids[own.cell]});
        add(own.type, *nodes, family);
    }

    void add(CellType type, std::span<const Index> nodes, FamilyIndex family) {
        out_.added.push_back({type, out_.mesh.add_cell(type, nodes, next_.cell++, family)});
    }

    /// Edges of one opened face whose ends have no copies; of shells, nodes of opened edges without.
    void make_front(const std::string& name) {
        std::map<Key, std::pair<int, std::vector<Index>>> edges;  // how many faces have it; its nodes
        std::set<Index> tips;
        for (const Face* face : opened_) {
            const FacetElement f = facet_element(mesh_, facet(face->owners[0]));
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
        for_each_of(1, [&](const CellRef& c) {
            if (const Key key = key_of(corners(c)); edges.contains(key)) there.emplace(key, c);
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
    const GroupIndex group_;
    const int dimension_;
    Numbering next_;
    Parted out_;
    const std::vector<double>* distance_ = nullptr;  // in place of a group: from a surface
    double rounding_ = 0;
    GroupIndex negative_ = 0, positive_ = 0;
    std::vector<char> reached_;                                // nodes of wanted faces
    std::map<Key, Face> faces_;                                // those to be opened
    std::map<Key, CellRef> told_;                              // the element whose facet it is
    std::unordered_map<Index, std::vector<CellRef>> at_node_;  // elements of the mesh's dimension, at their nodes
    std::map<Index, std::vector<int>> parts_;                  // of these, which copy each gets (-1: none)
    std::vector<const Face*> opened_;
};

}  // namespace

Parted part_along(const Mesh& mesh, GroupIndex group, const PartedNames& names, const Numbering& numbering) {
    Parter parter(mesh, group, numbering);
    (void)parter.finds_faces();
    return parter.run(names);
}

std::optional<Parted> part_along(const Mesh& mesh, const std::vector<double>& distance, double rounding,
                                 const PartedNames& names, const Numbering& numbering) {
    Parter parter(mesh, distance, rounding, numbering);
    if (!parter.finds_faces()) return {};
    return parter.run(names);
}

}  // namespace femscalpel
