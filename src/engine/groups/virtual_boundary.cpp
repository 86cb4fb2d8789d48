// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/virtual_boundary.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <string>

#include "cancel.h"
#include "groups/entity_table.h"

namespace femscalpel {
namespace {

constexpr Index none = -1;
using Edge = std::array<Index, 2>;
using Face = std::array<Index, 4>;

/// Things in rows: those of row r are items[start[r]] to items[start[r + 1]].
template <class T>
struct RowTable {
    std::vector<Index> start;
    std::vector<T> items;
    std::span<const T> operator[](Index row) const {
        return {items.data() + start[row], items.data() + start[static_cast<std::size_t>(row) + 1]};
    }
};

/// Rows from a function that calls its argument with every (row, item); it is run twice.
template <class T, class Generate>
RowTable<T> make_rows(Index rows, Generate generate) {
    RowTable<T> out;
    out.start.assign(static_cast<std::size_t>(rows) + 1, 0);
    SparseCheck check(1 << 16);
    generate([&](Index row, const T&) {
        check();
        ++out.start[static_cast<std::size_t>(row) + 1];
    });
    std::partial_sum(out.start.begin(), out.start.end(), out.start.begin());
    out.items.resize(static_cast<std::size_t>(out.start.back()));
    std::vector<Index> fill(out.start.begin(), out.start.end() - 1);
    generate([&](Index row, const T& item) {
        check();
        out.items[static_cast<std::size_t>(fill[row]++)] = item;
    });
    return out;
}

/// An element in eight bytes, in mesh order.
constexpr int type_shift = 56;
Index pack(CellType type, Index cell) { return (static_cast<Index>(type) << type_shift) | cell; }
CellRef unpack(Index packed) {
    return {static_cast<CellType>(packed >> type_shift), packed & ((Index{1} << type_shift) - 1)};
}

/// Centre nodes of second-order elements: local node, and the corners of the face it is the centre of.
struct Centre {
    CellType type;
    int node;
    Face corners;
};
constexpr Centre face_centres[] = {
    {CellType::triangle7, 6, {0, 1, 2, none}},  {CellType::quad9, 8, {0, 1, 2, 3}},
    {CellType::wedge18, 15, {0, 1, 4, 3}},      {CellType::wedge18, 16, {1, 2, 5, 4}},
    {CellType::wedge18, 17, {2, 0, 3, 5}},      {CellType::hexahedron27, 20, {0, 4, 7, 3}},
    {CellType::hexahedron27, 21, {1, 2, 6, 5}}, {CellType::hexahedron27, 22, {0, 1, 5, 4}},
    {CellType::hexahedron27, 23, {3, 2, 6, 7}}, {CellType::hexahedron27, 24, {0, 1, 2, 3}},
    {CellType::hexahedron27, 25, {4, 5, 6, 7}},
};

}  // namespace

struct VirtualBoundaryFinder::Tables {
    const Mesh& mesh;
    int dimension;
    RowTable<Index> around;                // packed elements of dimension 1 to 3 at each corner node, in mesh order
    RowTable<FamilyIndex> families;        // of each group
    RowTable<Index> nodes, cells, facets;  // of each family: node, packed element, index in Mesh::facets

    explicit Tables(const Mesh& m) : mesh(m), dimension(m.dimension()) {
        around = make_rows<Index>(mesh.node_count(), [&](auto put) {
            for (const CellBlock& b : mesh.blocks()) {
                const CellTraits& t = traits(b.type);
                if (t.dimension == 0) continue;
                const Index* n = b.connectivity.data();
                for (Index c = 0; c < b.size(); ++c, n += t.nodes)
                    for (int k = 0; k < t.corners; ++k)
                        if (std::find(n, n + k, n[k]) == n + k) put(n[k], pack(b.type, c));
            }
        });
        families = make_rows<FamilyIndex>(static_cast<Index>(mesh.groups.size()), [&](auto put) {
            for (FamilyIndex f = 0; f < mesh.families.size(); ++f)
                for (const GroupIndex g : mesh.families.groups(f)) put(g, f);
        });
        const Index family_count = mesh.families.size();
        nodes = make_rows<Index>(family_count, [&](auto put) {
            for (Index n = 0; n < mesh.node_count(); ++n) put(mesh.node_families[n], n);
        });
        cells = make_rows<Index>(family_count, [&](auto put) {
            for (const CellBlock& b : mesh.blocks())
                for (Index c = 0; c < b.size(); ++c) put(b.families[c], pack(b.type, c));
        });
        facets = make_rows<Index>(family_count, [&](auto put) {
            for (std::size_t f = 0; f < mesh.facets.size(); ++f) put(mesh.facets[f].family, static_cast<Index>(f));
        });
    }
};

namespace {

template <class Tables>
class Search {
public:
    Search(const Tables& tables, GroupIndex group) : t_(tables), mesh_(tables.mesh), group_(group) {}

    VirtualBoundary run() {
        if (mesh_.groups[static_cast<std::size_t>(group_)].kind == GroupKind::node)
            collect_node_group();
        else
            collect_elements();
        check_cancelled();
        std::ranges::sort(area_);
        area_.erase(std::unique(area_.begin(), area_.end()), area_.end());
        bound_area();
        cover_edges();
        write();
        return std::move(out_);
    }

private:
    std::span<const Index> corners(Index packed) const {
        const CellRef c = unpack(packed);
        return mesh_.block(c.type).nodes(c.cell).first(static_cast<std::size_t>(traits(c.type).corners));
    }

    static const CellTraits& traits_of(Index packed) { return traits(unpack(packed).type); }

    /// Face `k` of a volume element, normal outwards: the table has it inwards.
    static Face face_of(const CellTraits& t, std::span<const Index> n, std::size_t k) {
        const auto& f = t.faces[k];
        if (f[3] < 0) return {n[f[0]], n[f[2]], n[f[1]], none};
        return {n[f[0]], n[f[3]], n[f[2]], n[f[1]]};
    }

    /// A triangle or quadrangle as a face.
    static Face face_of(std::span<const Index> n) { return {n[0], n[1], n[2], n.size() > 3 ? n[3] : none}; }

    template <class Visit>
    static void for_each_edge(const Face& f, Visit visit) {
        const int n = f[3] == none ? 3 : 4;
        for (int k = 0; k < n; ++k) visit(Edge{f[k], f[(k + 1) % n]});
    }

    template <class Nodes>
    static bool holds(const Nodes& nodes, Index node) {
        return std::ranges::find(nodes, node) != nodes.end();
    }

    void collect_node_group() {
        std::vector<char> family(static_cast<std::size_t>(mesh_.families.size()), 0);
        for (const FamilyIndex f : t_.families[group_]) family[f] = 1;
        const auto in = [&](Index n) { return n == none || family[mesh_.node_families[n]] != 0; };
        std::vector<Index> covered;  // mid-side and centre nodes
        SparseCheck check;
        const auto look = [&](Index element) {
            check();
            const CellTraits& t = traits_of(element);
            const auto n = corners(element);
            const bool all = std::ranges::all_of(n, in);
            if (all && t.dimension == t_.dimension && t.dimension >= 2) area_.push_back(element);
            if (t.dimension == 3 && !all) {
                for (std::size_t k = 0; k < t.faces.size(); ++k) {
                    const Face face = face_of(t, n, k);
                    if (std::ranges::all_of(face, in)) faces_.insert(face).belongs = true;
                }
            } else if (t.dimension == 2 && all && t_.dimension == 3) {
                faces_.insert(face_of(n)).belongs = true;
            }
            // Of the edges only those that no face (area) of this element covers: the others cannot be in LE.
            for (const auto& e : t.edges)
                if (in(n[e[0]]) && in(n[e[1]]) && !covers_edge(t, n, e, in))
                    edges_.insert({n[e[0]], n[e[1]]}).belongs = true;
            if (t.quadratic) cover_middle_nodes(element, in, all, covered);
        };
        Index size = 0;
        for (const FamilyIndex f : t_.families[group_]) size += static_cast<Index>(t_.nodes[f].size());
        if (8 * size > mesh_.node_count()) {
            // A large group: elements in mesh order, which is kinder to memory.
            for (const CellBlock& b : mesh_.blocks())
                if (traits(b.type).dimension > 0)
                    for (Index c = 0; c < b.size(); ++c)
                        if (const Index element = pack(b.type, c); std::ranges::any_of(corners(element), in))
                            look(element);
        } else {
            // Each once, from its first group node.
            for (const FamilyIndex f : t_.families[group_])
                for (const Index v : t_.nodes[f])
                    for (const Index element : t_.around[v])
                        if (*std::ranges::find_if(corners(element), in) == v) look(element);
        }
        std::ranges::sort(covered);
        for (const FamilyIndex f : t_.families[group_])
            for (const Index v : t_.nodes[f]) {
                check();
                const bool linked = std::ranges::any_of(t_.around[v], [&](Index element) {
                    const auto n = corners(element);
                    return std::ranges::any_of(traits_of(element).edges, [&](const auto& e) {
                        return (n[e[0]] == v && in(n[e[1]])) || (n[e[1]] == v && in(n[e[0]]));
                    });
                });
                if (!linked && !std::ranges::binary_search(covered, v)) out_.isolated.nodes.push_back(v);
            }
        std::ranges::sort(out_.isolated.nodes);
    }

    /// Whether a face of this element that belongs holds its edge `e`.
    template <class In>
    static bool covers_edge(const CellTraits& t, std::span<const Index> n, const std::array<std::int8_t, 2>& e,
                            const In& in) {
        if (t.dimension == 2) return std::ranges::all_of(n, in);
        return std::ranges::any_of(t.faces, [&](const auto& f) {
            return holds(f, e[0]) && holds(f, e[1]) && std::ranges::all_of(f, [&](int k) { return k < 0 || in(n[k]); });
        });
    }

    template <class In>
    void cover_middle_nodes(Index element, const In& in, bool all, std::vector<Index>& covered) const {
        const CellRef c = unpack(element);
        const CellTraits& t = traits(c.type);
        const auto n = mesh_.block(c.type).nodes(c.cell);
        for (std::size_t k = 0; k < t.edges.size(); ++k)
            if (in(n[t.edges[k][0]]) && in(n[t.edges[k][1]]))
                covered.push_back(n[static_cast<std::size_t>(t.corners) + k]);
        for (const Centre& centre : face_centres)
            if (centre.type == c.type &&
                std::ranges::all_of(centre.corners, [&](Index k) { return k == none || in(n[k]); }))
                covered.push_back(n[centre.node]);
        if (all) covered.insert(covered.end(), n.begin() + t.corners, n.end());
    }

    void collect_elements() {
        SparseCheck check;
        for (const FamilyIndex f : t_.families[group_]) {
            for (const Index element : t_.cells[f]) {
                check();
                const auto n = corners(element);
                const int dimension = traits_of(element).dimension;
                if (dimension >= 2 && dimension == t_.dimension)
                    area_.push_back(element);
                else if (dimension == 2)
                    faces_.insert(face_of(n)).belongs = true;
                else if (dimension == 1)
                    edges_.insert({n[0], n[1]}).belongs = true;
                else
                    points_.push_back(n[0]);
            }
            for (const Index facet : t_.facets[f]) {
                const Facet& at = mesh_.facets[static_cast<std::size_t>(facet)];
                const Index element = pack(at.type, at.cell);
                const CellTraits& t = traits(at.type);
                const auto n = corners(element);
                if (t.dimension == 3)
                    faces_.insert(face_of(t, n, static_cast<std::size_t>(at.face - 1))).belongs = true;
                else if (at.face > 2)
                    edges_.insert({n[t.edges[at.face - 3][0]], n[t.edges[at.face - 3][1]]}).belongs = true;
                else if (t_.dimension == 2)
                    area_.push_back(element);
                else
                    faces_.insert(face_of(n)).belongs = true;
            }
        }
        close_faces();
        close_area();
    }

    bool belong_all_edges(const Face& face) {
        bool all = true;
        for_each_edge(face, [&](const Edge& e) { all = all && edges_.find(e) != nullptr; });
        return all;
    }

    /// Faces all of whose edges belong.
    void close_faces() {
        SparseCheck check;
        for (const auto& entry : edges_.entries()) {
            check();
            const auto [a, b] = entry.nodes();
            for (const Index element : t_.around[a]) {
                const CellTraits& t = traits_of(element);
                const auto n = corners(element);
                if (t.dimension < 2 || !holds(n, b)) continue;
                if (t.dimension == 2) {
                    if (!belong_all_edges(face_of(n))) continue;
                    if (t_.dimension == 2)
                        area_.push_back(element);
                    else
                        faces_.insert(face_of(n)).belongs = true;
                    continue;
                }
                for (std::size_t k = 0; k < t.faces.size(); ++k)
                    if (const Face face = face_of(t, n, k); holds(face, a) && holds(face, b) && belong_all_edges(face))
                        faces_.insert(face).belongs = true;
            }
        }
    }

    /// Volume elements all of whose faces belong.
    void close_area() {
        SparseCheck check;
        for (const auto& entry : faces_.entries())
            for (const Index element : t_.around[entry.nodes()[0]]) {
                check();
                const CellTraits& t = traits_of(element);
                if (t.dimension < 3) continue;
                const auto n = corners(element);
                bool all = true;
                for (std::size_t k = 0; k < t.faces.size() && all; ++k) all = faces_.find(face_of(t, n, k)) != nullptr;
                if (all) area_.push_back(element);
            }
    }

    /// Counts the area on both sides of its faces (edges).
    void bound_area() {
        SparseCheck check;
        for (const Index element : area_) {
            check();
            const CellTraits& t = traits_of(element);
            const auto n = corners(element);
            const auto count = [&](auto& entry, const auto& nodes) {
                if (entry.areas == 0) entry.turn(nodes);
                Index smallest = none;
                for (const Index v : n)
                    if (!holds(nodes, v) && (smallest == none || v < smallest)) smallest = v;
                const auto apex = static_cast<std::uint32_t>(smallest);
                if (entry.areas > 0 && entry.apex == apex) return;  // a coincident element
                entry.areas = entry.areas == 0 ? 1 : 2;
                entry.apex = apex;
            };
            if (t.dimension == 3)
                for (std::size_t k = 0; k < t.faces.size(); ++k) {
                    const Face face = face_of(t, n, k);
                    count(faces_.insert(face), face);
                }
            else
                for_each_edge(face_of(n), [&](const Edge& e) { count(edges_.insert(e), e); });
        }
    }

    void cover_edges() {
        if (t_.dimension != 3) return;
        SparseCheck check;
        for (const auto& face : faces_.entries())
            for_each_edge(face.nodes(), [&](const Edge& e) {
                check();
                if (auto* entry = edges_.find(e)) entry->covered = true;
            });
    }

    /// The element of dimension `dimension` on these corners, the group's own first.
    CellRef element_on(std::span<const Index> nodes, int dimension) const {
        CellRef found{CellType::vertex, none};
        for (const Index element : t_.around[nodes[0]]) {
            const CellTraits& t = traits_of(element);
            if (t.dimension > dimension) break;  // in mesh order dimensions rise
            const auto n = corners(element);
            if (t.dimension < dimension || n.size() != nodes.size()) continue;
            if (!std::ranges::all_of(n, [&](Index v) { return holds(nodes, v); })) continue;
            const CellRef c = unpack(element);
            if (mesh_.families.contains(mesh_.block(c.type).families[c.cell], group_)) return c;
            if (found.cell == none) found = c;
        }
        return found;
    }

    void write() {
        SparseCheck check;
        const auto put_face = [&](BoundaryPart& part, const auto& entry) {
            check();
            part.faces.push_back(entry.nodes());
            const std::span<const Index> nodes(part.faces.back());
            part.face_elements.push_back(element_on(nodes.first(nodes[3] == none ? 3 : 4), 2));
        };
        const auto put_edge = [&](BoundaryPart& part, const auto& entry) {
            check();
            part.edges.push_back(entry.nodes());
            part.edge_elements.push_back(element_on(part.edges.back(), 1));
        };
        if (t_.dimension == 3)
            for (const auto& face : faces_.entries()) {
                if (face.areas == 1)
                    put_face(out_.bounding, face);
                else if (face.areas == 0 && face.belongs)
                    put_face(out_.linking, face);
            }
        for (const auto& edge : edges_.entries()) {
            if (edge.areas == 1)
                put_edge(out_.bounding, edge);
            else if (edge.areas == 0 && edge.belongs && !edge.covered)
                put_edge(out_.linking, edge);
        }
        isolate_points();
        for (const Index element : area_) {
            check();
            out_.enclosed.push_back(unpack(element));
        }
    }

    void isolate_points() {
        if (points_.empty()) return;
        std::vector<Index> covered;
        for (const Index element : area_)
            covered.insert(covered.end(), corners(element).begin(), corners(element).end());
        for (const auto& face : faces_.entries())
            for (const Index v : face.nodes()) covered.push_back(v);
        for (const auto& edge : edges_.entries())
            for (const Index v : edge.nodes()) covered.push_back(v);
        std::ranges::sort(covered);
        std::ranges::sort(points_);
        points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
        std::ranges::set_difference(points_, covered, std::back_inserter(out_.isolated.nodes));
    }

    const Tables& t_;
    const Mesh& mesh_;
    GroupIndex group_;
    EntityTable<4> faces_;
    EntityTable<2> edges_;
    std::vector<Index> area_;    // packed elements
    std::vector<Index> points_;  // nodes of point elements
    VirtualBoundary out_;
};

}  // namespace

VirtualBoundaryFinder::VirtualBoundaryFinder(const Mesh& mesh) : tables_(std::make_unique<Tables>(mesh)) {}
VirtualBoundaryFinder::~VirtualBoundaryFinder() = default;
VirtualBoundaryFinder::VirtualBoundaryFinder(VirtualBoundaryFinder&&) noexcept = default;

VirtualBoundary VirtualBoundaryFinder::find(GroupIndex group) const {
    const auto count = tables_->mesh.groups.size();
    if (group < 0 || static_cast<std::size_t>(group) >= count)
        throw Error("the mesh has no group with index " + std::to_string(group) + "; it has " + std::to_string(count) +
                    " groups");
    return Search(*tables_, group).run();
}

VirtualBoundary virtual_boundary(const Mesh& mesh, GroupIndex group) { return VirtualBoundaryFinder(mesh).find(group); }

}  // namespace femscalpel
