// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/opening.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "cancel.h"
#include "cutting/node_parts.h"
#include "deformation/curved_shape.h"
#include "mesh/chains.h"
#include "words.h"

namespace femscalpel {
namespace {

/// Sine of the angle between a triangle and the tool up to which the triangle lies along it.
constexpr double along_tool = 0.5;

class Opener {
public:
    explicit Opener(const Workpiece& f)
        : f_(f),
          band_(f.d.band),
          is_interface_(static_cast<std::size_t>(band_.size()), 0),
          doubled_(is_interface_.size(), 0),
          first_item_(3 * is_interface_.size()) {}

    Opening open() {
        out_.tetras.resize(static_cast<std::size_t>(band_.tetras.size()));
        for (int t = 0; t < band_.tetras.size(); ++t) out_.tetras[t] = band_.tetras[t];
        out_.triangles.resize(static_cast<std::size_t>(band_.triangles.size()));
        for (int t = 0; t < band_.triangles.size(); ++t) out_.triangles[t] = band_.triangles[t];
        out_.lines.resize(static_cast<std::size_t>(band_.lines.size()));
        for (int l = 0; l < band_.lines.size(); ++l) out_.lines[l] = band_.lines[l];
        out_.vertices.resize(static_cast<std::size_t>(band_.vertices.size()));
        for (int p = 0; p < band_.vertices.size(); ++p) out_.vertices[p] = band_.vertices[p];
        find_open_faces();
        place_flat_shells();
        find_open_edges();
        for (const int v : out_.interface_nodes) part_node(v);
        place_attached();
        place_flat_beams();
        for (const int v : f_.beam_nodes) part_beams(v);
        make_lips();
        if (f_.patched) chain_front();
        return std::move(out_);
    }

private:
    bool on_tool(int v) const { return static_cast<bool>(f_.d.contact[v]); }

    template <std::size_t N>
    int side(const std::array<int, N>& nodes) const {
        // A node off the interface can still lie in its plane, beyond the front, or beside that by rounding: the
        // farthest tells.
        double farthest = 0;
        for (const int v : nodes)
            if (!on_tool(v) && std::abs(f_.distance[v]) > std::abs(farthest)) farthest = f_.distance[v];
        if (std::abs(farthest) > f_.d.rounding) return farthest > 0 ? 1 : -1;
        if constexpr (N < 3) return 0;
        // All corners lie on a curved tool: the element fills a bulge of it, and its middle tells on which side. A
        // triangle may also lie along the tool.
        Vec3 middle = Vec3::Zero();
        for (const int v : nodes) middle += band_.nodes[v].at / static_cast<double>(N);
        const double distance = f_.tool->distance(middle);
        if (std::abs(distance) <= f_.tolerance) return 0;
        if constexpr (N == 3) {
            const Vec3 &a = band_.nodes[nodes[0]].at, &b = band_.nodes[nodes[1]].at, &c = band_.nodes[nodes[2]].at;
            if ((b - a).cross(c - a).normalized().cross(f_.tool->normal(middle)).norm() < along_tool) return 0;
        }
        return distance > 0 ? 1 : -1;
    }

    void find_open_faces() {
        struct Seen {
            std::array<int, 3> key;  // sorted
            int tetra;
            std::array<int, 3> nodes;
        };
        std::vector<Seen> faces;
        for (int v = 0; v < band_.size(); ++v) {
            if (!on_tool(v)) continue;
            for (const int t : band_.tetras.around(v)) {
                const auto& n = band_.tetras[t];
                for (const auto& f : outward_faces) {
                    const std::array<int, 3> nodes{n[f[0]], n[f[1]], n[f[2]]};
                    if (!std::ranges::all_of(nodes, [&](int w) { return on_tool(w); })) continue;
                    std::array<int, 3> key = nodes;
                    std::ranges::sort(key);
                    if (key[0] != v) continue;  // each face once, from its smallest node
                    faces.push_back({key, t, nodes});
                }
            }
        }
        std::ranges::stable_sort(faces, {}, &Seen::key);
        std::unordered_map<std::uint64_t, int> faces_at;
        for (std::size_t i = 0; i + 1 < faces.size(); ++i) {
            const Seen &one = faces[i], &other = faces[i + 1];
            if (one.key != other.key || side(band_.tetras[one.tetra]) * side(band_.tetras[other.tetra]) >= 0) continue;
            if (f_.patched && band_.cut_faces.find(one.key) < 0) continue;
            for (const Seen* s : {&one, &other}) open_faces_.push_back({s->nodes, s->tetra});
            for (int k = 0; k < 3; ++k) ++faces_at[edge_key(one.key[k], one.key[(k + 1) % 3])];
            face_keys_.push_back(one.key);
            for (const int v : one.key) is_interface_[v] = 1;
        }
        // Around an edge of the front the elements hang together, on the far side of it.
        for (const auto& [edge, count] : faces_at) {
            const int a = static_cast<int>(edge >> 32), b = static_cast<int>(edge & 0xffffffffu);
            if (!f_.patched || count > 1 || f_.d.constraints.is_skin_edge(band_, a, b)) open_edges_.insert(edge);
        }
    }

    /// The shells that lie in the tool's surface belong to one side, a sheet of them at a time: the negative, or the
    /// positive if others hang on it only on the negative, so that a crack parts a plate from what stands on it.
    void place_flat_shells() {
        flat_side_.assign(static_cast<std::size_t>(band_.triangles.size()), 0);
        hangs_between_.assign(flat_side_.size(), 0);
        const auto is_flat = [&](int t) { return is_shell(t) && side(band_.triangles[t]) == 0; };
        for (int start = 0; start < band_.triangles.size(); ++start) {
            if (!band_.triangles.alive(start) || flat_side_[start] != 0 || !is_flat(start)) continue;
            std::vector<int> sheet{start};
            flat_side_[start] = -1;
            bool positive = false, negative = false;
            for (std::size_t k = 0; k < sheet.size(); ++k) {
                const auto& n = band_.triangles[sheet[k]];
                for (int e = 0; e < 3; ++e)
                    for (const int t : band_.triangles.around(n[e])) {
                        if (t == sheet[k] || !is_shell(t) || !holds(band_.triangles[t], n[(e + 1) % 3])) continue;
                        const int s = side(band_.triangles[t]);
                        positive = positive || s > 0;
                        negative = negative || s < 0;
                        if (s != 0 || flat_side_[t] != 0) continue;
                        flat_side_[t] = -1;
                        sheet.push_back(t);
                    }
            }
            for (const int t : sheet) {
                hangs_between_[t] = positive && negative;
                if (negative && !positive) flat_side_[t] = 1;
            }
        }
    }

    static bool holds(const auto& nodes, int v) { return std::ranges::find(nodes, v) != nodes.end(); }

    /// The side a shell belongs to; 0 for none.
    int shell_side(int t) const { return flat_side_[t] != 0 ? flat_side_[t] : side(band_.triangles[t]); }

    /// Whether a shell off the tool stands on it, rather than runs into it smoothly.
    bool stands(int t) const {
        if (flat_side_[t] != 0) return false;
        Vec3 middle = Vec3::Zero();
        for (const int v : band_.triangles[t]) middle += band_.nodes[v].at / 3;
        const Vec3 &a = band_.nodes[band_.triangles[t][0]].at, &b = band_.nodes[band_.triangles[t][1]].at,
                   &c = band_.nodes[band_.triangles[t][2]].at;
        return (b - a).cross(c - a).normalized().cross(f_.tool->normal(middle)).norm() >= along_tool;
    }

    void find_open_edges() {
        for (int v = 0; v < band_.size(); ++v) {
            if (!on_tool(v)) continue;
            std::map<int, std::vector<int>> edges;  // other end -> shells
            for (const int t : band_.triangles.around(v))
                if (is_shell(t))
                    for (const int w : band_.triangles[t])
                        if (w > v && on_tool(w)) edges[w].push_back(t);
            for (const auto& [w, shells] : edges) {
                bool positive = false, negative = false;
                const bool junction = std::ranges::any_of(shells, [&](int t) { return stands(t); });
                for (const int t : shells) {
                    if (flat_side_[t] != 0 && !hangs_between_[t] && !junction) continue;
                    positive = positive || shell_side(t) > 0;
                    negative = negative || shell_side(t) < 0;
                }
                if (!positive || !negative || (f_.patched && band_.cut_edges.find({v, w}) < 0)) continue;
                open_edges_.insert(edge_key(v, w));
                shell_edges_.push_back({v, w});
                is_interface_[v] = is_interface_[w] = 1;
            }
        }
        for (int v = 0; v < band_.size(); ++v)
            if (is_interface_[v]) out_.interface_nodes.push_back(v);
    }

    bool is_shell(int t) const { return f_.d.constraints.is_shell(band_.triangles.origin(t)); }

    /// Parts of the elements around an interface node; gives all but one a copy.
    void part_node(int v) {
        // Items: tetrahedra first, then shells.
        std::vector<int> items;
        const auto& tetras = band_.tetras.around(v);
        items.insert(items.end(), tetras.begin(), tetras.end());
        const int shells_from = static_cast<int>(items.size());
        for (const int t : band_.triangles.around(v))
            if (is_shell(t)) items.push_back(t);
        const int count = static_cast<int>(items.size());
        NodeParts parts(count);
        for (int i = 0; i < count; ++i)
            if (i < shells_from)
                join(parts, i, v, band_.tetras[items[i]], side(band_.tetras[items[i]]));
            else
                join(parts, i, v, band_.triangles[items[i]], shell_side(items[i]));
        parts.sum_up();
        std::map<int, int> copy;
        for (const auto& [part, positive] : parts.parted()) {
            copy[part] = band_.size() + static_cast<int>(out_.copy_of.size());
            out_.copy_of.push_back(v);
            if (positive) positive_copy_.emplace(v, copy[part]);
        }
        if (copy.empty()) {
            out_.front_nodes.push_back(v);
            return;
        }
        doubled_[v] = 1;
        for (int i = 0; i < count; ++i) {
            const auto it = copy.find(parts.goes_with(i));
            if (it == copy.end()) continue;
            if (i < shells_from)
                std::ranges::replace(out_.tetras[items[i]], v, it->second);
            else
                std::ranges::replace(out_.triangles[items[i]], v, it->second);
        }
    }

    /// The side a segment lies on: of a beam, that of its end or middle farthest from the tool.
    int line_side(int l) const {
        const auto& n = band_.lines[l];
        if (!f_.d.constraints.is_beam(band_.lines.origin(l))) return side(n);
        double farthest = f_.tool->distance(mid_side(f_.d, n[0], n[1]).at);
        for (const int v : n)
            if (std::abs(f_.distance[v]) > std::abs(farthest)) farthest = f_.distance[v];
        return std::abs(farthest) <= std::max(f_.tolerance, f_.d.rounding) ? 0 : farthest > 0 ? 1 : -1;
    }

    /// Elements that share an edge at v belong together, unless the edge is open and they are on different sides of it.
    void join(NodeParts& parts, int item, int v, const auto& nodes, int where) {
        const int half = where > 0 ? 1 : -1;
        bool touches = false;
        for (const int w : nodes) {
            if (w == v) continue;
            const bool open = on_tool(w) && open_edges_.contains(edge_key(v, w));
            touches = touches || open;
            // First item met with this neighbour, on this side if the edge is open.
            FirstItem& first = first_item_[3 * static_cast<std::size_t>(w) + (open ? half + 1 : 1)];
            if (first.around == v)
                parts.unite(item, first.item);
            else
                first = {v, item};
        }
        parts.describe(item, half, touches);
    }

    /// The nodes, copies in place, that the hosts of an attached element give it: one entry per side.
    template <std::size_t N>
    std::vector<std::array<int, N>> images(const std::array<int, N>& nodes) const {
        std::vector<std::array<int, N>> out;
        const auto look = [&](const auto& list, const auto& placed, auto skip) {
            for (const int s : list.around(nodes[0])) {
                if (skip(s)) continue;
                std::array<int, N> image;
                bool host = true;
                for (std::size_t k = 0; k < N; ++k) {
                    const auto at = std::ranges::find(list[s], nodes[k]);
                    host = host && at != list[s].end();
                    if (host) image[k] = placed[s][at - list[s].begin()];
                }
                if (host && std::ranges::find(out, image) == out.end()) out.push_back(image);
            }
        };
        look(band_.tetras, out_.tetras, [](int) { return false; });
        look(band_.triangles, out_.triangles, [&](int s) { return !is_shell(s); });
        // The original nodes first.
        std::ranges::stable_sort(out, {}, [&](const auto& image) { return image != nodes; });
        return out;
    }

    template <std::size_t N>
    bool any_doubled(const std::array<int, N>& nodes) const {
        return std::ranges::any_of(nodes, [&](int v) { return doubled_[v] != 0; });
    }

    /// Number of elements at a node on the positive side less those on the negative.
    int balance(int v) const {
        int sum = 0;
        for (const int t : band_.tetras.around(v)) sum += side(band_.tetras[t]);
        for (const int t : band_.triangles.around(v))
            if (is_shell(t)) sum += shell_side(t);
        return sum;
    }

    void move_to_positive(auto& nodes) const {
        for (int& v : nodes)
            if (const auto copy = positive_copy_.find(v); copy != positive_copy_.end()) v = copy->second;
    }

    void place_attached() {
        check_cancelled();
        for (int t = 0; t < band_.triangles.size(); ++t) {
            if (!band_.triangles.alive(t) || is_shell(t) || !any_doubled(band_.triangles[t])) continue;
            const auto found = images(band_.triangles[t]);
            if (found.empty()) continue;
            out_.triangles[t] = found[0];
            for (std::size_t k = 1; k < found.size(); ++k) out_.triangle_twins.push_back({t, found[k]});
        }
        int loose = 0, points = 0, points_positive = 0;
        for (int l = 0; l < band_.lines.size(); ++l) {
            if (!band_.lines.alive(l) || !any_doubled(band_.lines[l])) continue;
            if (f_.d.constraints.is_loose(band_.lines.origin(l))) {
                // A beam or spring follows its other end's side.
                int where = line_side(l);
                loose += where == 0 || !f_.d.constraints.is_beam(band_.lines.origin(l));
                if (where == 0)
                    for (const int v : band_.lines[l]) where += balance(v);
                if (where > 0) move_to_positive(out_.lines[l]);
                continue;
            }
            const auto found = images(band_.lines[l]);
            if (found.empty()) continue;
            out_.lines[l] = found[0];
            for (std::size_t k = 1; k < found.size(); ++k) out_.line_twins.push_back({l, found[k]});
        }
        for (int p = 0; p < band_.vertices.size(); ++p) {
            if (!band_.vertices.alive(p) || !any_doubled(band_.vertices[p])) continue;
            const bool positive = balance(band_.vertices[p][0]) > 0;
            if (positive) move_to_positive(out_.vertices[p]);
            ++points;
            points_positive += positive;
        }
        if (loose > 0)
            out_.warnings.push_back(counted(loose, "segment element") +
                                    " (springs, gaps, beams in the tool) with an end on doubled nodes; each "
                                    "stays on the side it lies on, or on that with more elements there");
        if (points > 0)
            out_.warnings.push_back(counted(points, "point element") +
                                    " (mass, spring to ground) on doubled nodes; each stays whole "
                                    "on the side with more elements there: " +
                                    std::to_string(points - points_positive) + " on the negative side, " +
                                    std::to_string(points_positive) + " on the positive");
        for (const int where : {-1, 1})
            if (const auto flat = std::ranges::count(flat_side_, where); flat > 0)
                out_.warnings.push_back(counted(flat, "shell element lies", "shell elements lie") +
                                        " in the tool's surface, and " + (flat == 1 ? "stays" : "stay") + " on the " +
                                        (where < 0 ? "negative" : "positive") + " side");
    }

    /// On which sides there is something: negative, positive.
    using Sides = std::array<bool, 2>;

    static void note(Sides& sides, int side) {
        if (side != 0) sides[side > 0] = true;
    }

    void note_others(int v, Sides& sides) const {
        for (const int t : band_.tetras.around(v)) note(sides, side(band_.tetras[t]));
        for (const int t : band_.triangles.around(v))
            if (is_shell(t)) note(sides, shell_side(t));
    }

    bool is_beam(int l) const { return f_.d.constraints.is_beam(band_.lines.origin(l)); }

    /// Beams that lie in the tool go with one side, all that hang together: the positive if nothing is on the negative.
    void place_flat_beams() {
        for (const int from : f_.beam_nodes) {
            std::vector<int> nodes{from};
            std::set<int> met{from};
            std::vector<int> flat;
            Sides sides{};
            for (std::size_t k = 0; k < nodes.size(); ++k) {
                note_others(nodes[k], sides);
                for (const int l : band_.lines.around(nodes[k])) {
                    if (!is_beam(l) || flat_beams_.contains(l)) continue;
                    if (const int where = line_side(l); where != 0) {
                        note(sides, where);
                        continue;
                    }
                    flat.push_back(l);
                    for (const int v : band_.lines[l])
                        if (met.insert(v).second) nodes.push_back(v);
                }
            }
            for (const int l : flat) flat_beams_.emplace(l, sides[1] && !sides[0] ? 1 : -1);
        }
    }

    int beam_side(int l) const {
        const auto flat = flat_beams_.find(l);
        return flat == flat_beams_.end() ? line_side(l) : flat->second;
    }

    void part_beams(int v) {
        Sides others{}, beams{};
        note_others(v, others);
        for (const int l : band_.lines.around(v))
            if (is_beam(l)) note(beams, beam_side(l));
        if (doubled_[v]) return list_ends(v);
        if (others[0] && others[1]) return;  // where a crack ends, what it does not reach holds them together
        const bool positive_goes = !others[1];
        if (!beams[positive_goes] || !(beams[!positive_goes] || others[!positive_goes])) return;
        const int copy = band_.size() + static_cast<int>(out_.copy_of.size());
        out_.copy_of.push_back(v);
        for (const int l : band_.lines.around(v))
            if (f_.d.constraints.is_loose(band_.lines.origin(l)) && beam_side(l) == (positive_goes ? 1 : -1))
                std::ranges::replace(out_.lines[l], v, copy);
        list_ends(v);
    }

    /// The ends of beams in a node and its copies.
    void list_ends(int v) {
        for (const int l : band_.lines.around(v)) {
            const int where = line_side(l);
            if (where == 0 || !is_beam(l)) continue;
            const std::size_t place = band_.lines[l][0] == v ? 0 : 1;
            out_.ends.push_back({out_.lines[l][place], where > 0});
        }
    }

    void make_lips() {
        // Elements that already lie on a lip join its group; the first one met per place.
        std::map<std::array<int, 3>, int> triangle_at;
        for (int t = 0; t < band_.triangles.size(); ++t)
            if (band_.triangles.alive(t) && std::ranges::binary_search(face_keys_, sorted(band_.triangles[t])))
                triangle_at.emplace(sorted(out_.triangles[t]), t);
        for (std::size_t k = 0; k < out_.triangle_twins.size(); ++k)
            triangle_at.emplace(sorted(out_.triangle_twins[k].nodes), -1 - static_cast<int>(k));
        SparseCheck check;
        for (const auto& [nodes, tetra] : open_faces_) {
            check();
            std::array<int, 3> image;
            for (int k = 0; k < 3; ++k)
                image[k] =
                    out_.tetras[tetra][std::ranges::find(band_.tetras[tetra], nodes[k]) - band_.tetras[tetra].begin()];
            const auto at = triangle_at.find(sorted(image));
            out_.faces.push_back({image, side(band_.tetras[tetra]) > 0,
                                  at == triangle_at.end() ? Opening::fresh : at->second,
                                  band_.tetra_cells[band_.tetras.origin(tetra)].type == CellType::tetra10});
        }
        const auto closed = std::ranges::count_if(open_faces_, [&](const auto& f) {
            return side(band_.tetras[f.second]) > 0 &&
                   std::ranges::none_of(f.first, [&](int v) { return doubled_[v] != 0; });
        });
        if (closed > 0)
            out_.warnings.push_back(counted(closed, "face of the crack has", "faces of the crack have") +
                                    " all nodes on its front and cannot open: refine the mesh there");
        std::map<std::array<int, 2>, int> line_at;
        for (int l = 0; l < band_.lines.size(); ++l)
            if (band_.lines.alive(l)) line_at.emplace(sorted(out_.lines[l]), l);
        for (std::size_t k = 0; k < out_.line_twins.size(); ++k)
            line_at.emplace(sorted(out_.line_twins[k].nodes), -1 - static_cast<int>(k));
        for (const auto& edge : shell_edges_) {
            std::set<std::array<int, 2>> seen;
            for (const int t : band_.triangles.around(edge[0])) {
                if (!is_shell(t) || std::ranges::find(band_.triangles[t], edge[1]) == band_.triangles[t].end())
                    continue;
                const int s = shell_side(t);
                std::array<int, 2> image;
                for (int k = 0; k < 2; ++k)
                    image[k] =
                        out_.triangles[t][std::ranges::find(band_.triangles[t], edge[k]) - band_.triangles[t].begin()];
                if (!seen.insert(image).second) continue;
                const auto at = line_at.find(sorted(image));
                out_.edges.push_back({image, s > 0, at == line_at.end() ? Opening::fresh : at->second,
                                      band_.triangle_cells[band_.triangles.origin(t)].type == CellType::triangle6});
            }
        }
    }

    /// Edges of one open face only, but for those in the skin, put in order.
    void chain_front() {
        check_cancelled();
        std::map<std::array<int, 2>, int> faces_at;
        for (const auto& key : face_keys_)
            for (int k = 0; k < 3; ++k) ++faces_at[sorted(std::array{key[k], key[(k + 1) % 3]})];
        std::vector<std::array<int, 2>> edges;
        for (const auto& [edge, faces] : faces_at)
            if (faces == 1 && !f_.d.constraints.is_skin_edge(band_, edge[0], edge[1])) edges.push_back(edge);
        out_.front_chains = chains_of(edges);
    }

    template <std::size_t N>
    static std::array<int, N> sorted(std::array<int, N> nodes) {
        std::ranges::sort(nodes);
        return nodes;
    }

    const Workpiece& f_;
    const BandMesh& band_;
    Opening out_;
    std::vector<std::pair<std::array<int, 3>, int>> open_faces_;  // both sides of each: nodes outwards, tetrahedron
    std::vector<std::array<int, 2>> shell_edges_;
    std::unordered_set<std::uint64_t> open_edges_;
    std::vector<std::array<int, 3>> face_keys_;  // ascending
    std::vector<char> is_interface_, doubled_;   // by node
    std::vector<signed char> flat_side_;         // by triangle: side of a shell in the tool's surface, 0 for others
    std::vector<char> hangs_between_;            // of them: with shells on both sides of its sheet
    struct FirstItem {
        int around = -1;
        int item = -1;
    };
    std::vector<FirstItem> first_item_;  // of part_node(), by neighbour and side
    std::unordered_map<int, int> positive_copy_;
    std::map<int, int> flat_beams_;  // beams that lie in the tool, and the side they go with
};

}  // namespace

Opening open_lips(const Workpiece& workpiece) { return Opener(workpiece).open(); }

Opening no_opening(const BandMesh& band) {
    Opening opening;
    for (int t = 0; t < band.tetras.size(); ++t) opening.tetras.push_back(band.tetras[t]);
    for (int t = 0; t < band.triangles.size(); ++t) opening.triangles.push_back(band.triangles[t]);
    for (int l = 0; l < band.lines.size(); ++l) opening.lines.push_back(band.lines[l]);
    return opening;
}

}  // namespace femscalpel
