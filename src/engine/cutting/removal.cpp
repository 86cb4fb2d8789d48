// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/removal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "cancel.h"
#include "deck/solver_sets.h"
#include "deformation/curved_shape.h"
#include "error.h"
#include "mesh/quality.h"
#include "words.h"

namespace femscalpel {
namespace {

bool holds(const auto& nodes, int node) { return std::ranges::find(nodes, node) != nodes.end(); }

/// Length, area or volume of a segment, triangle or tetrahedron of the band as it is.
double measure_now(const Deformable& d, const auto& corners, CellType type) {
    std::array<Vec3, 10> nodes;
    std::size_t count = 0;
    for (const int v : corners) nodes[count++] = d.band.nodes[v].at;
    if (const CellTraits& t = traits(type); t.quadratic)
        for (const auto& e : t.edges) nodes[count++] = mid_side(d, corners[e[0]], corners[e[1]]).at;
    return cell_measure(type, {nodes.data(), count});
}

class Remover {
public:
    Remover(Workpiece& f, std::span<const Tool* const> tools, int first_tag)
        : f_(f), band_(f.d.band), tools_(tools), first_tag_(first_tag) {
        value_.resize(tools.size());
        for (std::size_t k = 0; k < tools.size(); ++k)
            for (int v = 0; v < band_.size(); ++v) value_[k].push_back(f.value(v, *tools[k]));
    }

    int run() {
        check_cancelled();
        std::vector<int> tetras, shells;
        for (int t = 0; t < band_.tetras.size(); ++t)
            if (band_.tetras.alive(t) && is_inside(band_.tetras[t])) tetras.push_back(t);
        for (int t = 0; t < band_.triangles.size(); ++t)
            if (band_.triangles.alive(t) && is_shell(t) && is_inside(band_.triangles[t])) shells.push_back(t);
        drop_tags(band_.cut_faces);
        drop_tags(band_.cut_edges);
        make_walls(tetras, shells);
        const int beams = take_beams();
        take_out(tetras, shells);
        return static_cast<int>(tetras.size() + shells.size()) + beams;
    }

    /// Beams inside, which were divided at the walls.
    int take_beams() {
        int count = 0;
        for (int l = 0; l < band_.lines.size(); ++l) {
            if (!band_.lines.alive(l) || !is_beam(l) || !is_inside(band_.lines[l])) continue;
            for (const int v : band_.lines[l]) {
                const auto nearest = std::ranges::min_element(
                    value_, {}, [&](const std::vector<double>& value) { return std::abs(value[v]); });
                f_.beam_ends.push_back({v, first_tag_ + static_cast<int>(nearest - value_.begin())});
            }
            take(band_.lines, band_.line_cells, l);
            ++count;
        }
        return count;
    }

    /// Takes these out, whose place is filled.
    void take_out(const std::vector<int>& tetras, const std::vector<int>& shells) {
        for (const int t : tetras) take(band_.tetras, band_.tetra_cells, t);
        for (const int t : shells) take(band_.triangles, band_.triangle_cells, t);
        take_what_they_carried();
    }

private:
    bool is_shell(int t) const { return f_.d.constraints.is_shell(band_.triangles.origin(t)); }

    bool is_beam(int l) const { return f_.d.constraints.is_beam(band_.lines.origin(l)); }

    /// On the negative side of every tool. Where all nodes lie on a (curved) tool, and of beams where it is farther
    /// off, the middle decides.
    bool is_inside(const auto& nodes) const {
        for (std::size_t k = 0; k < tools_.size(); ++k) {
            double furthest = 0;
            for (const int v : nodes)
                if (std::abs(value_[k][v]) > std::abs(furthest)) furthest = value_[k][v];
            constexpr bool beam = std::tuple_size_v<std::remove_cvref_t<decltype(nodes)>> == 2;
            if (beam || std::abs(furthest) <= f_.tolerance) {
                const double inside = tools_[k]->distance(middle(nodes));
                if (std::abs(inside) > std::abs(furthest)) furthest = inside;
            }
            if (furthest > 0) return false;
        }
        return true;
    }

    Vec3 middle(const auto& nodes) const {
        if constexpr (std::tuple_size_v<std::remove_cvref_t<decltype(nodes)>> == 2)
            return mid_side(f_.d, nodes[0], nodes[1]).at;
        Vec3 sum = Vec3::Zero();
        for (const int v : nodes) sum += band_.nodes[v].at;
        return sum / static_cast<double>(nodes.size());
    }

    /// The tool a wall face lies on.
    int tag_of(const auto& nodes) const {
        int best = -1;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < tools_.size(); ++k) {
            if (!std::ranges::all_of(nodes, [&](int v) { return std::abs(value_[k][v]) <= f_.tolerance; })) continue;
            const double off = std::abs(tools_[k]->distance(middle(nodes)));
            if (off >= nearest) continue;
            nearest = off;
            best = first_tag_ + static_cast<int>(k);
        }
        if (best < 0) {
            std::ostringstream message;
            message << "the elements around (" << middle(nodes).transpose()
                    << ") cannot be parted from what is to be removed: the mesh is too coarse for the "
                    << tools_[0]->kind() << " there. Refine it near the tool first";
            throw QualityError(message.str());
        }
        return best;
    }

    /// Faces collected on the way: of them only the walls count.
    void drop_tags(auto& list) {
        for (int s = 0; s < list.size(); ++s)
            if (list.alive(s) && list.tag(s) >= first_tag_ &&
                list.tag(s) < first_tag_ + static_cast<int>(tools_.size()))
                list.remove(s);
    }

    void make_walls(const std::vector<int>& tetras, const std::vector<int>& shells) {
        std::vector<char> out(static_cast<std::size_t>(band_.tetras.size()), 0),
            shells_out(static_cast<std::size_t>(band_.triangles.size()), 0);
        for (const int t : tetras) out[t] = 1;
        for (const int t : shells) shells_out[t] = 1;
        SparseCheck check(64);
        for (const int t : tetras)
            for (const auto& face : outward_faces) {
                check();
                const auto& n = band_.tetras[t];
                // Turned round: out of the material that stays.
                const std::array<int, 3> nodes{n[face[0]], n[face[2]], n[face[1]]};
                for (const int s : band_.tetras.around(nodes[0]))
                    if (!out[s] && holds(band_.tetras[s], nodes[1]) && holds(band_.tetras[s], nodes[2]))
                        band_.cut_faces.add(nodes, tag_of(nodes));
            }
        for (const int t : shells)
            for (int k = 0; k < 3; ++k) {
                const std::array<int, 2> nodes{band_.triangles[t][k], band_.triangles[t][(k + 1) % 3]};
                if (band_.cut_edges.find(nodes) >= 0) continue;
                for (const int s : band_.triangles.around(nodes[0]))
                    if (is_shell(s) && !shells_out[s] && holds(band_.triangles[s], nodes[1])) {
                        band_.cut_edges.add(nodes, tag_of(nodes));
                        break;
                    }
            }
    }

    /// Notes what is taken of an element of the input.
    void note_taken(const auto& list, const std::vector<CellRef>& cells, int s) {
        f_.taken.push_back({cells[list.origin(s)], measure_now(f_.d, list[s], cells[list.origin(s)].type)});
    }

    template <std::size_t N>
    void take(SimplexList<N>& list, const std::vector<CellRef>& cells, int s) {
        note_taken(list, cells, s);
        for (const int v : list[s]) touched_[v] = 1;
        list.remove(s);
    }

    template <std::size_t N>
    bool has_host(const std::array<int, N>& nodes, bool volumes_only) const {
        const auto in = [&](const auto& list) {
            return std::ranges::any_of(list.around(nodes[0]), [&](int s) {
                return std::ranges::all_of(nodes, [&](int v) { return holds(list[s], v); });
            });
        };
        return in(band_.tetras) || (!volumes_only && in(band_.triangles));
    }

    /// Removes those of `list` at touched nodes that `goes` picks.
    template <std::size_t N>
    void drop(SimplexList<N>& list, auto goes) {
        SparseCheck check(64);
        for (int v = 0; v < band_.size(); ++v) {
            if (!touched_[v]) continue;
            check();
            const auto slots = list.around(v);
            for (const int s : std::vector<int>(slots.begin(), slots.end()))
                if (goes(s)) list.remove(s);
        }
    }

    void take_what_they_carried() {
        drop(band_.triangles, [&](int s) {
            if (is_shell(s) || has_host(band_.triangles[s], true)) return false;
            note_taken(band_.triangles, band_.triangle_cells, s);
            return true;
        });
        drop(band_.skin, [&](int s) { return !has_host(band_.skin[s], false); });
        drop(band_.cut_faces, [&](int s) { return !has_host(band_.cut_faces[s], true); });
        drop(band_.cut_edges, [&](int s) { return !has_host(band_.cut_edges[s], false); });
        drop(band_.creases, [&](int s) { return !has_host(band_.creases[s], false); });
        int loose = 0, points = 0;
        drop(band_.lines, [&](int s) {
            if (has_host(band_.lines[s], false)) return false;
            if (!f_.d.constraints.is_loose(band_.lines.origin(s))) {
                note_taken(band_.lines, band_.line_cells, s);
                return true;
            }
            // A spring goes if what carries one of its ends does.
            const bool goes = (tools_.empty() || !is_beam(s)) && std::ranges::any_of(band_.lines[s], [&](int v) {
                                  return touched_[v] != 0 && bare(v) && is_inside(std::array{v});
                              });
            loose += goes;
            return goes;
        });
        drop(band_.vertices, [&](int s) {
            const bool goes = bare(band_.vertices[s][0]) && band_.lines.around(band_.vertices[s][0]).empty();
            points += goes;
            return goes;
        });
        drop(band_.facet_faces, [&](int s) { return !has_outward_host(band_.facet_faces[s]); });
        drop(band_.facet_edges, [&](int s) { return !has_host(band_.facet_edges[s], false); });
        for (int v = 0; v < band_.size(); ++v) {
            if (!touched_[v]) continue;
            if (!bare(v) || !band_.lines.around(v).empty() || !band_.vertices.around(v).empty()) continue;
            band_.nodes[v].gone = true;
            f_.d.contact[v] = {};
        }
        if (loose > 0)
            f_.warnings.push_back(counted(loose, "segment element") +
                                  " (spring, gap) with an end inside what is removed: removed with it");
        if (points > 0)
            f_.warnings.push_back(counted(points, "point element") + " inside what is removed: removed with it");
    }

    bool bare(int v) const { return band_.tetras.around(v).empty() && band_.triangles.around(v).empty(); }

    /// Whether the tetrahedron of whose face the facet is still stands.
    bool has_outward_host(const std::array<int, 3>& nodes) const {
        return std::ranges::any_of(band_.tetras.around(nodes[0]), [&](int s) {
            for (const auto& f : outward_faces) {
                const auto& n = band_.tetras[s];
                const std::array<int, 3> face{n[f[0]], n[f[1]], n[f[2]]};
                for (int turn = 0; turn < 3; ++turn)
                    if (nodes[0] == face[turn] && nodes[1] == face[(turn + 1) % 3] && nodes[2] == face[(turn + 2) % 3])
                        return true;
            }
            return false;
        });
    }

    Workpiece& f_;
    BandMesh& band_;
    std::span<const Tool* const> tools_;
    int first_tag_;
    std::vector<std::vector<double>> value_;                                                    // by tool and node
    std::vector<char> touched_ = std::vector<char>(static_cast<std::size_t>(band_.size()), 0);  // nodes
};

template <std::size_t N>
std::array<int, N> sorted(std::array<int, N> nodes) {
    std::ranges::sort(nodes);
    return nodes;
}

}  // namespace

void note_slivers(Workpiece& f, std::span<const Tool* const> tool_of_tag, int sign) {
    const BandMesh& band = f.d.band;
    const auto look = [&](const auto& walls, const auto& hosts, const std::vector<CellRef>& cells, auto size,
                          double share) {
        for (int s = 0; s < walls.size(); ++s) {
            if (!walls.alive(s)) continue;
            const Tool& tool = *tool_of_tag[walls.tag(s)];
            const auto& nodes = walls[s];
            const auto around = hosts.around(nodes[0]);
            const auto host = std::ranges::find_if(
                around, [&](int t) { return std::ranges::all_of(nodes, [&](int v) { return holds(hosts[t], v); }); });
            if (!std::isfinite(tool.feature_size()) || host == around.end()) continue;
            const CellRef& cell = cells[hosts.origin(*host)];
            if (traits(cell.type).quadratic) continue;  // its faces are as curved as the tool
            // Distances grow as squares from the nodes, which are on the tool: their mean over a face is that at its
            // edges' middles.
            double depth = 0;
            int edges = 0;
            for (std::size_t i = 0; i < nodes.size(); ++i)
                for (std::size_t j = 0; j < i; ++j, ++edges)
                    depth -= tool.distance((band.nodes[nodes[i]].at + band.nodes[nodes[j]].at) / 2);
            f.taken.push_back({cell, sign * share * size(nodes) * depth / edges});
        }
    };
    const auto at = [&](int v) -> const Vec3& { return band.nodes[v].at; };
    look(
        band.cut_faces, band.tetras, band.tetra_cells,
        [&](const auto& n) { return (at(n[1]) - at(n[0])).cross(at(n[2]) - at(n[0])).norm() / 2; }, 1);
    look(
        band.cut_edges, band.triangles, band.triangle_cells,
        [&](const auto& n) { return (at(n[1]) - at(n[0])).norm(); }, 2.0 / 3);
}

int remove_inside(Workpiece& f, std::span<const Tool* const> tools, int first_tag) {
    return Remover(f, tools, first_tag).run();
}

void remove_elements(Workpiece& f, const std::vector<int>& tetras) { Remover(f, {}, 0).take_out(tetras, {}); }

void remove_shells(Workpiece& f, const std::vector<int>& triangles) { Remover(f, {}, 0).take_out({}, triangles); }

void release_all_but_walls(Workpiece& f, std::span<const Tool* const> tool_of_tag) {
    const BandMesh& band = f.d.band;
    for (int v = 0; v < band.size(); ++v) {
        if (!f.d.contact[v]) continue;
        Contact on;
        const auto meet = [&](const auto& list) {
            for (const int s : list.around(v))
                if (const Tool* t = tool_of_tag[list.tag(s)]; f.d.contact[v].has(t)) on = on.with(t);
        };
        meet(band.cut_faces);
        meet(band.cut_edges);
        f.d.contact[v] = on;
        if (!on) f.d.held_off[v] = 0;
    }
}

Opening open_walls(const Workpiece& f) {
    check_cancelled();
    const BandMesh& band = f.d.band;
    Opening out;
    out.removes = true;
    for (int t = 0; t < band.tetras.size(); ++t) out.tetras.push_back(band.tetras[t]);
    for (int t = 0; t < band.triangles.size(); ++t) out.triangles.push_back(band.triangles[t]);
    for (int l = 0; l < band.lines.size(); ++l) out.lines.push_back(band.lines[l]);
    for (int p = 0; p < band.vertices.size(); ++p) out.vertices.push_back(band.vertices[p]);
    // Elements that already lie on a wall join its group; the first one met per place.
    std::map<std::array<int, 3>, int> triangle_at;
    std::map<std::array<int, 2>, int> line_at;
    for (int s = 0; s < band.cut_faces.size(); ++s)
        if (band.cut_faces.alive(s))
            for (const int t : band.triangles.around(band.cut_faces[s][0]))
                triangle_at.emplace(sorted(band.triangles[t]), t);
    for (int s = 0; s < band.cut_edges.size(); ++s)
        if (band.cut_edges.alive(s))
            for (const int l : band.lines.around(band.cut_edges[s][0])) line_at.emplace(sorted(band.lines[l]), l);
    for (const auto& [node, tag] : f.beam_ends)
        if (!band.lines.around(node).empty()) out.ends.push_back({node, tag});
    std::set<int> nodes;
    SparseCheck check(64);
    for (int s = 0; s < band.cut_faces.size(); ++s) {
        if (!band.cut_faces.alive(s)) continue;
        auto face = band.cut_faces[s];
        const auto around = band.tetras.around(face[0]);
        const auto host = std::ranges::find_if(
            around, [&](int t) { return holds(band.tetras[t], face[1]) && holds(band.tetras[t], face[2]); });
        check();
        // Merging nodes may have turned it over.
        for (const auto& f : outward_faces) {
            const auto& n = band.tetras[*host];
            const std::array<int, 3> outward{n[f[0]], n[f[1]], n[f[2]]};
            if (sorted(outward) == sorted(face)) face = outward;
        }
        const auto at = triangle_at.find(sorted(face));
        out.faces.push_back({face, band.cut_faces.tag(s), at == triangle_at.end() ? Opening::fresh : at->second,
                             band.tetra_cells[band.tetras.origin(*host)].type == CellType::tetra10});
        nodes.insert(face.begin(), face.end());
    }
    for (int s = 0; s < band.cut_edges.size(); ++s) {
        if (!band.cut_edges.alive(s)) continue;
        const auto& edge = band.cut_edges[s];
        const auto around = band.triangles.around(edge[0]);
        const auto host = std::ranges::find_if(around, [&](int t) { return holds(band.triangles[t], edge[1]); });
        const auto at = line_at.find(sorted(edge));
        out.edges.push_back({edge, band.cut_edges.tag(s), at == line_at.end() ? Opening::fresh : at->second,
                             band.triangle_cells[band.triangles.origin(*host)].type == CellType::triangle6});
        nodes.insert(edge.begin(), edge.end());
    }
    out.interface_nodes.assign(nodes.begin(), nodes.end());
    return out;
}

std::vector<CellRef> deep_inside(const Mesh& mesh, const std::vector<std::int8_t>& level,
                                 std::span<const std::function<double(const Vec3&)>> depths) {
    std::vector<CellRef> out;
    const std::vector<char> whole = families_of_whole_elements(mesh);
    // Which body a node is in; one bit each, in as many rounds as there are bodies.
    std::vector<char> in(mesh.points.size());
    for (const auto& depth : depths) {
        bool any = false;
        SparseCheck check(256);
        for (std::size_t n = 0; n < in.size(); ++n, check()) {
            in[n] = level[n] < 0 && depth(mesh.points[n]) < 0;
            any = any || in[n];
        }
        if (!any) continue;
        for (const CellBlock& b : mesh.blocks()) {
            const CellTraits& t = traits(b.type);
            const Index* n = b.connectivity.data();
            const auto is_in = [&](Index v) { return in[v] != 0; };
            for (Index c = 0; c < b.size(); ++c, n += t.nodes) {
                const bool spring = t.dimension == 1 && !whole.empty() && whole[b.families[c]];
                if (spring ? std::any_of(n, n + t.corners, is_in) : std::all_of(n, n + t.corners, is_in))
                    out.push_back({b.type, c});
            }
        }
    }
    std::ranges::sort(out, {}, [](const CellRef& c) { return std::pair(c.type, c.cell); });
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

}  // namespace femscalpel
