// SPDX-License-Identifier: LGPL-2.1-or-later
#include "crack_checks.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <numeric>
#include <sstream>
#include <unordered_map>

namespace femscalpel::checks {
namespace {

using Key2 = std::array<Index, 2>;
using Key3 = std::array<Index, 3>;

constexpr int outward_faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
constexpr int edges_of_tetra[6][2] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}};

/// An element is degenerate below this mean ratio: a height of about a thousandth of its length.
constexpr double degenerate = 1e-4;
constexpr double rounding = 1e-9;

int corners_of(CellType type) {
    switch (type) {
        case CellType::vertex:
            return 1;
        case CellType::line:
        case CellType::line3:
            return 2;
        case CellType::triangle:
        case CellType::triangle6:
            return 3;
        default:
            return 4;
    }
}

/// Position of the mid-side node of the edge between two local corners.
int mid_of(CellType type, int a, int b) {
    if (type == CellType::line3) return 2;
    if (type == CellType::triangle6) return a + b == 1 ? 3 : a + b == 3 ? 4 : 5;
    for (int k = 0; k < 6; ++k)
        if (std::minmax(edges_of_tetra[k][0], edges_of_tetra[k][1]) == std::minmax(a, b)) return 4 + k;
    return -1;
}

bool is_tetra(CellType t) { return t == CellType::tetra || t == CellType::tetra10; }
bool is_triangle(CellType t) { return t == CellType::triangle || t == CellType::triangle6; }
bool is_line(CellType t) { return t == CellType::line || t == CellType::line3; }
bool is_second_order(CellType t) { return t == CellType::tetra10 || t == CellType::triangle6 || t == CellType::line3; }

template <class Visit>
void for_each_cell(const Mesh& mesh, bool (*wanted)(CellType), Visit visit) {
    for (const CellBlock& b : mesh.blocks())
        if (wanted(b.type))
            for (Index c = 0; c < b.size(); ++c) visit(b.type, c, b.nodes(c));
}

template <std::size_t N>
std::array<Index, N> ascending(std::array<Index, N> nodes) {
    std::ranges::sort(nodes);
    return nodes;
}

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).cross(c - a).dot(d - a) / 6;
}

/// Jacobian determinant of a ten-node tetrahedron.
double jacobian(const std::array<Vec3, 10>& p, double r, double s, double t) {
    const double u = 1 - r - s - t;
    // Derivatives of u(2u-1), r(2r-1), s(2s-1), t(2t-1), 4ur, 4rs, 4su, 4ut, 4rt, 4st.
    const double dr[10] = {1 - 4 * u, 4 * r - 1, 0, 0, 4 * (u - r), 4 * s, -4 * s, -4 * t, 4 * t, 0};
    const double ds[10] = {1 - 4 * u, 0, 4 * s - 1, 0, -4 * r, 4 * r, 4 * (u - s), -4 * t, 0, 4 * t};
    const double dt[10] = {1 - 4 * u, 0, 0, 4 * t - 1, -4 * r, 0, -4 * s, 4 * (u - t), 4 * r, 4 * s};
    Vec3 x = Vec3::Zero(), y = Vec3::Zero(), z = Vec3::Zero();
    for (int k = 0; k < 10; ++k) {
        x += dr[k] * p[k];
        y += ds[k] * p[k];
        z += dt[k] * p[k];
    }
    return x.cross(y).dot(z);
}

/// Point and derivatives of a six-node triangle.
struct OnFace {
    Vec3 at, du, dv;
};
OnFace on_face(const std::array<Vec3, 3>& c, const std::array<Vec3, 3>& m, double u, double v) {
    const double w = 1 - u - v;
    return {w * (2 * w - 1) * c[0] + u * (2 * u - 1) * c[1] + v * (2 * v - 1) * c[2] + 4 * u * w * m[0] +
                4 * u * v * m[1] + 4 * v * w * m[2],
            (1 - 4 * w) * c[0] + (4 * u - 1) * c[1] + 4 * (w - u) * m[0] + 4 * v * m[1] - 4 * v * m[2],
            (1 - 4 * w) * c[0] + (4 * v - 1) * c[2] - 4 * u * m[0] + 4 * u * m[1] + 4 * (w - v) * m[2]};
}

double flat_area(const std::array<Vec3, 3>& c) { return (c[1] - c[0]).cross(c[2] - c[0]).norm() / 2; }

/// Area vector and area of a triangle element, by Gauss points where it is curved.
std::pair<Vec3, double> face_area(const std::array<Vec3, 3>& c, const std::array<Vec3, 3>& m, bool curved) {
    if (!curved) {
        const Vec3 n = (c[1] - c[0]).cross(c[2] - c[0]) / 2;
        return {n, n.norm()};
    }
    // Dunavant's rule of degree 4.
    static const double a = 0.445948490915965, b = 0.091576213509771, wa = 0.223381589678011 / 2,
                        wb = 0.109951743655322 / 2;
    Vec3 vector = Vec3::Zero();
    double area = 0;
    for (const auto& [p, weight] : {std::pair{a, wa}, std::pair{b, wb}})
        for (const auto& [u, v] : {std::pair{p, p}, std::pair{1 - 2 * p, p}, std::pair{p, 1 - 2 * p}}) {
            const OnFace x = on_face(c, m, u, v);
            const Vec3 n = x.du.cross(x.dv);
            vector += weight * n;
            area += weight * n.norm();
        }
    return {vector, area};
}

double segment_length(const Vec3& a, const Vec3& b, const Vec3& mid, bool curved) {
    if (!curved) return (b - a).norm();
    double length = 0;
    for (const auto& [x, weight] :
         {std::pair{-std::sqrt(0.6), 5.0 / 9}, std::pair{0.0, 8.0 / 9}, std::pair{std::sqrt(0.6), 5.0 / 9}})
        length += weight * ((x - 0.5) * a + (x + 0.5) * b - 2 * x * mid).norm();
    return length;
}

double tetra_volume(const Mesh& mesh, CellType type, std::span<const Index> n) {
    std::array<Vec3, 10> p;
    for (std::size_t k = 0; k < n.size(); ++k) p[k] = mesh.points[n[k]];
    if (type == CellType::tetra) return volume(p[0], p[1], p[2], p[3]);
    // Five points, degree 3: exact for this Jacobian.
    double sum = -0.8 * jacobian(p, 0.25, 0.25, 0.25);
    const double a = 1.0 / 6, b = 0.5;
    for (const auto& [r, s, t] : {std::array{a, a, a}, std::array{b, a, a}, std::array{a, b, a}, std::array{a, a, b}})
        sum += 0.45 * jacobian(p, r, s, t);
    return sum / 6;
}

Model::Face make_face(const Mesh& mesh, const Key3& corner, const Key3& mid) {
    Model::Face f;
    f.curved = mid[0] >= 0;
    f.centre = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
        f.corner[k] = mesh.points[corner[k]];
        f.centre += f.corner[k] / 3;
    }
    for (int k = 0; k < 3; ++k) {
        f.mid[k] = f.curved ? mesh.points[mid[k]] : Vec3((f.corner[k] + f.corner[(k + 1) % 3]) / 2);
        f.edge += (f.corner[k] - f.corner[(k + 1) % 3]).norm() / 3;
    }
    for (int k = 0; k < 3; ++k)
        f.radius = std::max({f.radius, (f.corner[k] - f.centre).norm(), (f.mid[k] - f.centre).norm()});
    if (f.curved) f.radius *= 1.5;
    f.normal = (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]).normalized();
    return f;
}

double curved_area(const Model::Face& f) { return face_area(f.corner, f.mid, f.curved).second; }

/// Distance of a point to a flat triangle (Ericson, Real-Time Collision Detection, 5.1.5).
double distance_to(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp), d5 = ab.dot(cp), d6 = ac.dot(cp);
    if (d1 <= 0 && d2 <= 0) return ap.norm();
    if (d3 >= 0 && d4 <= d3) return bp.norm();
    if (d6 >= 0 && d5 <= d6) return cp.norm();
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).norm();
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).norm();
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return (bp - (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b)).norm();
    const double sum = va + vb + vc;
    return (ap - vb / sum * ab - vc / sum * ac).norm();
}

/// Distance to a three-node segment, as 64 straight pieces: their sagitta is 1/4096 of its own.
double distance_to_arc(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& mid) {
    double best = std::numeric_limits<double>::infinity();
    Vec3 from = a;
    for (int k = 1; k <= 64; ++k) {
        const double x = k / 32.0 - 1;
        const Vec3 to = x * (x - 1) / 2 * a + x * (x + 1) / 2 * b + (1 - x * x) * mid;
        const double t = std::clamp((p - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
        best = std::min(best, (p - from - t * (to - from)).norm());
        from = to;
    }
    return best;
}

double distance_to(const Vec3& p, const Model::Face& f) {
    if (!f.curved) return distance_to(p, f.corner[0], f.corner[1], f.corner[2]);
    // Gauss-Newton from the nearest of a few points, kept inside the triangle.
    double best = std::numeric_limits<double>::infinity(), u = 0, v = 0;
    for (int i = 0; i <= 4; ++i)
        for (int j = 0; i + j <= 4; ++j)
            if (const double d = (on_face(f.corner, f.mid, i / 4.0, j / 4.0).at - p).norm(); d < best) {
                best = d;
                u = i / 4.0;
                v = j / 4.0;
            }
    for (int round = 0; round < 30; ++round) {
        const OnFace x = on_face(f.corner, f.mid, u, v);
        const Vec3 r = p - x.at;
        best = std::min(best, r.norm());
        const double a = x.du.dot(x.du), b = x.du.dot(x.dv), c = x.dv.dot(x.dv), e = x.du.dot(r), g = x.dv.dot(r);
        const double determinant = a * c - b * b;
        double next_u = u + (c * e - b * g) / determinant, next_v = v + (a * g - b * e) / determinant;
        next_u = std::clamp(next_u, 0.0, 1.0);
        next_v = std::clamp(next_v, 0.0, 1.0);
        if (const double over = next_u + next_v - 1; over > 0) {
            next_u = std::clamp(next_u - over / 2, 0.0, 1.0);
            next_v = 1 - next_u;
        }
        if (std::abs(next_u - u) + std::abs(next_v - v) < 1e-12) break;
        u = next_u;
        v = next_v;
    }
    // The steps may stop short on the triangle's own edges, where feet of points beside a seam are.
    for (int k = 0; k < 3; ++k) best = std::min(best, distance_to_arc(p, f.corner[k], f.corner[(k + 1) % 3], f.mid[k]));
    return best;
}

/// Smallest of distance / mean edge length over a set of faces, as far as it is below `limit`; otherwise `limit`.
double edges_away(const Vec3& p, const std::vector<Model::Face>& faces, double limit) {
    double best = limit;
    for (const Model::Face& f : faces) {
        if ((p - f.centre).norm() - f.radius > best * f.edge) continue;
        best = std::min(best, distance_to(p, f) / f.edge);
    }
    return best;
}

double edges_away(const Vec3& p, const std::vector<Model::Segment>& segments, double limit) {
    double best = limit;
    for (const Model::Segment& s : segments) {
        const double length = (s.end[1] - s.end[0]).norm();
        const Vec3 middle = (s.end[0] + s.end[1]) / 2;
        if ((p - middle).norm() > length + best * length) continue;
        best = std::min(best, distance_to_arc(p, s.end[0], s.end[1], s.mid) / length);
    }
    return best;
}

/// The visible groups of each family as one text, without those in `without`.
std::vector<std::string> family_names(const Mesh& mesh, const std::set<std::string>& without = {}) {
    std::vector<std::string> names(static_cast<std::size_t>(mesh.families.size()));
    for (FamilyIndex f = 0; f < mesh.families.size(); ++f) {
        std::vector<std::string> in;
        for (const GroupIndex g : mesh.families.groups(f))
            if (!mesh.groups[g].hidden && !without.contains(mesh.groups[g].name)) in.push_back(mesh.groups[g].name);
        std::ranges::sort(in);
        for (const std::string& n : in) names[f] += n + ';';
    }
    return names;
}

struct Edge {
    Key2 key;
    CellRef cell;
};

std::vector<Edge> edges_of(const Mesh& mesh, bool (*wanted)(CellType)) {
    std::vector<Edge> edges;
    for_each_cell(mesh, wanted, [&](CellType type, Index c, std::span<const Index> n) {
        const int corners = corners_of(type);
        for (int a = 0; a < corners; ++a)
            for (int b = 0; b < a; ++b) edges.push_back({ascending(Key2{n[a], n[b]}), {type, c}});
    });
    std::ranges::sort(edges, {}, [](const Edge& e) { return e.key; });
    return edges;
}

/// Calls visit(first, last) for every run of equal keys.
template <class List, class Visit>
void runs(const List& list, Visit visit) {
    for (auto first = list.begin(); first != list.end();) {
        auto last = first + 1;
        while (last != list.end() && last->key == first->key) ++last;
        visit(first, last);
        first = last;
    }
}

/// Length of the edges of a shell mesh by what meets there: number of shells and their groups. Edges inside a plate do
/// not count, nor do those that `skip` names.
std::map<std::string, double> border_lengths(const Mesh& mesh, const std::function<bool(const Key2&)>& skip,
                                             const std::set<std::string>& without,
                                             std::vector<Model::Segment>* segments) {
    std::set<Key2> line_elements;
    for_each_cell(mesh, is_line, [&](CellType, Index, std::span<const Index> n) {
        line_elements.insert(ascending(Key2{n[0], n[1]}));
    });
    const std::vector<std::string> names = family_names(mesh, without);
    std::map<std::string, double> lengths;
    const auto normal = [&](const CellRef& c) {
        const auto n = mesh.block(c.type).nodes(c.cell);
        return Vec3((mesh.points[n[1]] - mesh.points[n[0]]).cross(mesh.points[n[2]] - mesh.points[n[0]]).normalized());
    };
    runs(edges_of(mesh, is_triangle), [&](auto first, auto last) {
        if (skip(first->key)) return;
        std::multiset<std::string> meeting;
        std::vector<Vec3> plates;
        for (auto e = first; e != last; ++e) {
            meeting.insert(names[mesh.block(e->cell.type).families[e->cell.cell]]);
            plates.push_back(normal(e->cell));
        }
        const bool crease = plates.size() == 2 && plates[0].cross(plates[1]).norm() > 1e-6;
        const bool inside = plates.size() == 2 && !crease && *meeting.begin() == *meeting.rbegin();
        if (inside && !(segments && line_elements.contains(first->key))) return;
        std::string key = crease ? "crease " : "";
        for (const std::string& m : meeting) key += "[" + m + "]";
        const Vec3 &a = mesh.points[first->key[0]], &b = mesh.points[first->key[1]];
        if (!inside) lengths[key] += (a - b).norm();
        if (segments) segments->push_back({{a, b}, (a + b) / 2, plates, {}, key, 0});
    });
    return lengths;
}

/// Area by plane, of faces that lie in a few planes.
class AreaByPlane {
public:
    void add(const std::array<Vec3, 3>& c, double size) {
        Vec3 normal = (c[1] - c[0]).cross(c[2] - c[0]);
        const double area = normal.norm() / 2;
        normal /= 2 * area;
        // Thin faces have inexact normals, so a plane is known by its distance to all three corners.
        Plane* found = nullptr;
        for (Plane& p : planes_) {
            const bool in = std::ranges::all_of(
                c, [&](const Vec3& x) { return std::abs(p.normal.dot(x) - p.offset) <= rounding * size; });
            if (in && normal.dot(p.normal) > 0.9) {
                found = &p;
                break;
            }
        }
        if (!found) {
            planes_.push_back({normal, normal.dot(c[0]), 0});
            found = &planes_.back();
        }
        found->area += area;
    }

    /// The same planes without their areas: faces of another mesh can be added.
    AreaByPlane emptied() const {
        AreaByPlane copy = *this;
        for (Plane& p : copy.planes_) p.area = 0;
        return copy;
    }

    /// What differs from `before`, whose planes come first, or nothing.
    std::string differs(const AreaByPlane& before, double size, double slack) const {
        std::ostringstream text;
        text.precision(12);
        for (std::size_t k = 0; k < planes_.size(); ++k) {
            const double old = k < before.planes_.size() ? before.planes_[k].area : 0;
            if (std::abs(planes_[k].area - old) <= rounding * std::max(old, 1e-3 * size * size) + slack) continue;
            text << "area " << old << " -> " << planes_[k].area << " in the plane of normal ("
                 << planes_[k].normal.transpose() << ") at " << planes_[k].offset << "; ";
        }
        return text.str();
    }

private:
    struct Plane {
        Vec3 normal;
        double offset;
        double area;
    };
    std::vector<Plane> planes_;
};

/// Collects failures: the first offender of each kind is described, the others counted.
class Findings {
public:
    template <class... Parts>
    void add(const std::string& keyword, const Parts&... parts) {
        auto& [count, first] = found_[keyword];
        if (count++ > 0) return;
        std::ostringstream text;
        text.precision(12);
        (text << ... << parts);
        first = text.str();
    }

    std::vector<std::string> lines() const {
        std::vector<std::string> out;
        for (const auto& [keyword, found] : found_)
            out.push_back(keyword + ": " + found.second +
                          (found.first > 1 ? " (" + std::to_string(found.first) + " in all)" : ""));
        return out;
    }

private:
    std::map<std::string, std::pair<int, std::string>> found_;
};

class CrackCheck {
public:
    CrackCheck(const Model& model, const CutPlane& plane, const Result& result, const std::string& name)
        : model_(model),
          in_(model.mesh),
          out_(result.mesh),
          report_(result.report),
          plane_(plane),
          name_(name),
          made_{name + "_P", name + "_N", name + "_FRONT"} {}

    std::vector<std::string> run() {
        try {
            out_.validate();
        } catch (const Error& e) {
            bad_.add("invalid", e.what());
            return bad_.lines();
        }
        index();
        faces_ = tetra_faces(out_);
        if (!numbers_and_nodes()) return bad_.lines();
        far_elements();
        shapes();
        sides();
        if (model_.solid)
            solid_conformity();
        else
            shell_conformity();
        attached();
        lips();
        section();
        groups();
        node_groups();
        report();
        return bad_.lines();
    }

private:
    /// Nodes that are held beside the plane may be as far off it as the report says.
    double tolerance() const { return rounding * model_.size + report_.held.largest; }
    bool on_plane(Index n) const { return std::abs(distance_[n]) <= tolerance(); }
    Index id(Index n) const { return out_.node_ids[n]; }
    using Place = std::array<double, 3>;
    Place place(Index n) const { return {out_.points[n].x(), out_.points[n].y(), out_.points[n].z()}; }
    bool is_input_node(Index n) const { return id(n) <= model_.largest_node; }
    bool same_place(Index n) const {
        return is_input_node(n) &&
               std::memcmp(out_.points[n].data(), in_.points[model_.node_index.at(id(n))].data(), sizeof(Vec3)) == 0;
    }

    void index() {
        for (std::size_t n = 0; n < out_.node_ids.size(); ++n) {
            index_.emplace(out_.node_ids[n], static_cast<Index>(n));
            distance_.push_back(plane_.distance(out_.points[n]));
        }
        for (const auto& [set, ids] : report_.node_sets)
            for (const Index i : ids) {
                if (!index_.contains(i))
                    bad_.add("node sets", set, " names node ", i, ", which the mesh does not have");
                if (!in_sets_.insert(i).second) bad_.add("node sets", "node ", i, " is named twice");
            }
        for (const char* set : {"ICN", "ECN"})
            if (report_.node_sets.contains(set))
                for (const Index i : report_.node_sets.at(set))
                    if (const auto n = index_.find(i); n != index_.end()) interface_places_.insert(place(n->second));
    }

    bool numbers_and_nodes() {
        if (index_.size() != out_.node_ids.size()) bad_.add("numbers", "node numbers are not unique");
        std::set<Index> cells;
        for (const CellBlock& b : out_.blocks())
            for (const Index i : b.ids)
                if (!cells.insert(i).second) bad_.add("numbers", "element number ", i, " is used twice");
        bool complete = true;
        for (const auto& [number, before] : model_.node_index) {
            const auto after = index_.find(number);
            if (after == index_.end()) {
                bad_.add("numbers", "node ", number, " is gone");
                complete = false;
            } else if (!in_sets_.contains(number) &&
                       std::memcmp(in_.points[before].data(), out_.points[after->second].data(), sizeof(Vec3)) != 0) {
                bad_.add("far node", "node ", number, " is in no node set but moved by ",
                         (in_.points[before] - out_.points[after->second]).norm());
            }
        }
        for (const Index n : model_.isolated_nodes)
            if (complete && !same_place(index_.at(in_.node_ids[n])))
                bad_.add("isolated node", "node ", in_.node_ids[n], " moved");
        std::vector<char> used(out_.points.size(), 0);
        for (const CellBlock& b : out_.blocks())
            for (const Index n : b.connectivity) used[n] = 1;
        std::vector<char> was_used(in_.points.size(), 0);
        for (const CellBlock& b : in_.blocks())
            for (const Index n : b.connectivity) was_used[n] = 1;
        for (std::size_t n = 0; n < used.size(); ++n) {
            if (used[n]) continue;
            const auto before = model_.node_index.find(out_.node_ids[n]);
            if (before == model_.node_index.end())
                bad_.add("orphan", "new node ", out_.node_ids[n], " belongs to no element");
            else if (was_used[before->second])
                bad_.add("orphan", "node ", out_.node_ids[n], " belongs to no element any more");
        }
        return complete;
    }

    void far_elements() {
        const NumberIndexByHand after(out_);
        const std::vector<std::string> names_in = family_names(in_), names_out = family_names(out_, made_);
        for (const CellBlock& b : in_.blocks())
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                const auto found = after.cells.find(b.ids[c]);
                const bool near = std::any_of(n.begin(), n.begin() + corners_of(b.type),
                                              [&](Index k) { return in_sets_.contains(in_.node_ids[k]); });
                if (found == after.cells.end()) {
                    ++gone_;
                    if (!near)
                        bad_.add("far element", "element ", b.ids[c],
                                 " is gone, though none of its nodes is in a node set");
                    continue;
                }
                const auto& [type, cell] = found->second;
                if (type != b.type) {
                    bad_.add("far element", "element ", b.ids[c], " changed its type");
                    continue;
                }
                if (names_in[b.families[c]] != names_out[out_.block(type).families[cell]])
                    bad_.add("element groups", "element ", b.ids[c], " was in '", names_in[b.families[c]], "', is in '",
                             names_out[out_.block(type).families[cell]], "'");
                if (near) continue;
                const auto m = out_.block(type).nodes(cell);
                for (std::size_t k = 0; k < n.size(); ++k)
                    if (in_.node_ids[n[k]] != id(m[k])) {
                        bad_.add("far element", "element ", b.ids[c], " has other nodes, though none is in a node set");
                        break;
                    }
            }
    }

    struct NumberIndexByHand {
        explicit NumberIndexByHand(const Mesh& mesh) {
            for (const CellBlock& b : mesh.blocks())
                for (Index c = 0; c < b.size(); ++c) cells.emplace(b.ids[c], CellRef{b.type, c});
        }
        std::unordered_map<Index, CellRef> cells;
    };

    /// Whether a triangle of a mesh with solids stands on its own.
    bool is_shell(std::span<const Index> n) const {
        if (!model_.mixed || n.size() == 4 || n.size() == 10) return false;
        const auto host = std::ranges::lower_bound(faces_, ascending(Key3{n[0], n[1], n[2]}), {},
                                                   [](const TetraFace& f) { return f.key; });
        return host == faces_.end() || host->key != ascending(Key3{n[0], n[1], n[2]});
    }

    void shapes() {
        std::map<Key2, Index> mids;
        const auto look = [&](CellType type, Index c, std::span<const Index> n) {
            const auto at = [&](int k) -> const Vec3& { return out_.points[n[k]]; };
            const Index number = out_.block(type).ids[c];
            const double q =
                is_tetra(type) ? tetra_shape(at(0), at(1), at(2), at(3)) : triangle_shape(at(0), at(1), at(2));
            const int corners = corners_of(type);
            if (is_tetra(type) == model_.solid || is_shell(n)) {
                if (!(q > 0))
                    bad_.add("inverted", "element ", number, ", mean ratio ", q);
                else if (q < degenerate)
                    bad_.add("degenerate", "element ", number, ", mean ratio ", q);
                if (std::any_of(n.begin(), n.begin() + corners, [&](Index k) {
                        return in_sets_.contains(id(k)) || interface_places_.contains(place(k));
                    })) {
                    ++band_count_;
                    band_minimum_ = std::min(band_minimum_, q);
                }
            }
            if (!is_second_order(type)) return;
            for (int i = 0; i < corners; ++i)
                for (int j = 0; j < i; ++j) {
                    const Index mid = n[mid_of(type, i, j)];
                    const auto [known, fresh] = mids.emplace(ascending(Key2{n[i], n[j]}), mid);
                    if (known->second != mid)
                        bad_.add("mid-side", "edge ", id(n[i]), "-", id(n[j]), " has two mid-side nodes");
                    if (fresh && (out_.points[mid] - (at(i) + at(j)) / 2).norm() > 0.25 * (at(i) - at(j)).norm())
                        bad_.add("mid-side", "node ", id(mid), " is far from the middle of its edge");
                }
            if (!is_tetra(type)) return;
            std::array<Vec3, 10> p;
            for (int k = 0; k < 10; ++k) p[k] = at(k);
            const double a = (5 - std::sqrt(5.0)) / 20, b = (5 + 3 * std::sqrt(5.0)) / 20;
            for (const auto& [r, s, t] :
                 {std::array{a, a, a}, std::array{b, a, a}, std::array{a, b, a}, std::array{a, a, b}})
                if (!(jacobian(p, r, s, t) > 0))
                    bad_.add("jacobian", "element ", number, " has Jacobian ", jacobian(p, r, s, t),
                             " at an integration point");
        };
        for_each_cell(out_, is_tetra, look);
        for_each_cell(out_, is_triangle, look);
        std::set<Index> seen;
        for (const auto& [edge, mid] : mids)
            if (!seen.insert(mid).second) bad_.add("mid-side", "node ", id(mid), " is in the middle of two edges");
    }

    /// Every element is on one side of the plane; the sides share no node; each part is on one side.
    void sides() {
        std::vector<char> side(out_.points.size(), 0);  // bit 1: of a positive element, bit 2: of a negative one
        std::vector<Index> part(out_.points.size());
        std::iota(part.begin(), part.end(), Index{0});
        const auto root = [&](Index n) {
            while (part[n] != n) n = part[n] = part[part[n]];
            return n;
        };
        for_each_cell(
            out_, model_.solid ? is_tetra : is_triangle, [&](CellType type, Index c, std::span<const Index> n) {
                double low = 0, high = 0;
                for (int k = 0; k < corners_of(type); ++k) {
                    low = std::min(low, distance_[n[k]]);
                    high = std::max(high, distance_[n[k]]);
                }
                if (low < -tolerance() && high > tolerance())
                    bad_.add("crossed", "element ", out_.block(type).ids[c], " reaches from ", low, " to ", high);
                if (high > tolerance() || low < -tolerance())
                    for (const Index k : n) side[k] |= high > -low ? 1 : 2;
                for (const Index k : n) part[root(k)] = root(n[0]);
            });
        std::set<Index> front;
        if (const auto g = out_.find_group(name_ + "_FRONT", GroupKind::node)) {
            const auto members = group_members(out_, *g).ids;
            front.insert(members.begin(), members.end());
        }
        for (std::size_t n = 0; n < side.size(); ++n)
            if (side[n] == 3 && !front.contains(out_.node_ids[n]))
                bad_.add("still joined", "node ", out_.node_ids[n], " belongs to elements of both sides");
        if (!front.empty())
            bad_.add("front", "an infinite plane left ", front.size(), " front node(s), first ", *front.begin());
        std::map<Index, int> parts;
        for (std::size_t n = 0; n < side.size(); ++n)
            if (side[n]) parts[root(static_cast<Index>(n))] |= side[n];
        if (parts.size() < 2) bad_.add("parts", "the mesh did not come apart");
        for (const auto& [r, s] : parts)
            if (s == 3 && front.empty()) bad_.add("parts", "a part reaches to both sides");
    }

    void solid_conformity() {
        const std::vector<std::string> names = family_names(out_, made_);
        AreaByPlane skin;
        if (model_.flat) skin = planes_of(model_.skin).emptied();
        const auto corners = [&](const TetraFace& f) {
            return std::array<Vec3, 3>{out_.points[f.outward[0]], out_.points[f.outward[1]], out_.points[f.outward[2]]};
        };
        std::set<Index> on_skin, on_borders;
        const auto note = [&](const TetraFace& f, std::set<Index>& nodes) {
            for (const Index n : f.outward) nodes.insert(n);
            for (const Index n : f.mid)
                if (n >= 0) nodes.insert(n);
        };
        runs(faces_, [&](auto first, auto last) {
            const auto hosts = last - first;
            if (hosts > 2)
                bad_.add("conformity", "face ", id(first->key[0]), " ", id(first->key[1]), " ", id(first->key[2]),
                         " belongs to ", hosts, " tetrahedra");
            if (hosts == 2) {
                const auto family = [&](const TetraFace& f) { return out_.block(f.cell.type).families[f.cell.cell]; };
                if (names[family(*first)] == names[family(*(first + 1))]) return;
                note(*first, on_borders);
                return;
            }
            if (lip_keys().contains(first->key)) return;
            if (model_.flat) skin.add(corners(*first), model_.size);
            note(*first, on_skin);
        });
        if (model_.flat) {
            if (const std::string text = skin.differs(planes_of(model_.skin), model_.size, 0); !text.empty())
                bad_.add("skin", text);
            compare_borders();
            return;
        }
        nodes_stay(on_skin, model_.skin, "skin");
        nodes_stay(on_borders, model_.borders, "border");
    }

    /// Area between tetrahedra of different groups. What lay in the plane is now two lips.
    void compare_borders() {
        const auto areas = [&](const Mesh& mesh, const std::vector<TetraFace>& faces) {
            const std::vector<std::string> names = family_names(mesh, made_);
            std::map<std::string, double> sums;
            runs(faces, [&](auto first, auto last) {
                if (last - first != 2) return;
                const std::string &a = names[mesh.block(first->cell.type).families[first->cell.cell]],
                                  &b = names[mesh.block((first + 1)->cell.type).families[(first + 1)->cell.cell]];
                const std::array<Vec3, 3> c{mesh.points[first->key[0]], mesh.points[first->key[1]],
                                            mesh.points[first->key[2]]};
                if (a == b ||
                    std::ranges::all_of(c, [&](const Vec3& x) { return std::abs(plane_.distance(x)) <= tolerance(); }))
                    return;
                sums[std::min(a, b) + "|" + std::max(a, b)] += flat_area(c);
                if (&mesh == &out_ && edges_away((c[0] + c[1] + c[2]) / 3, model_.borders, 1.0) > 1e-8)
                    bad_.add("border", "a face between '", a, "' and '", b, "' left the border");
            });
            return sums;
        };
        auto before = areas(in_, tetra_faces(in_)), after = areas(out_, faces_);
        for (const auto& [pair, area] : before)
            if (std::abs(after[pair] - area) > rounding * area)
                bad_.add("border", "area between ", pair, ": ", area, " -> ", after[pair]);
        for (const auto& [pair, area] : after)
            if (!before.contains(pair)) bad_.add("border", "new border of area ", area, " between ", pair);
    }

    AreaByPlane planes_of(const std::vector<Model::Face>& faces) const {
        AreaByPlane out;
        for (const Model::Face& f : faces) out.add(f.corner, model_.size);
        return out;
    }

    template <class Shapes>
    void nodes_stay(const std::set<Index>& nodes, const std::vector<Shapes>& shapes, const std::string& what) {
        for (const Index n : nodes) {
            if (same_place(n)) continue;
            const double away = edges_away(out_.points[n], shapes, 0.5);
            const bool corner = !mid_nodes().contains(n);
            if (away > 1e-3)
                bad_.add(what + (corner ? "" : " mid-side"), "node ", id(n), is_input_node(n) ? "" : " (new)", " is ",
                         away, " edge lengths off the old ", what);
        }
    }

    const std::set<Index>& mid_nodes() {
        if (mids_known_) return mid_nodes_;
        mids_known_ = true;
        // A mid-side node of the input may have become a corner where its edge was split.
        std::set<Index> corners;
        for (const CellBlock& b : out_.blocks())
            for (Index c = 0; c < b.size(); ++c)
                corners.insert(b.nodes(c).begin(), b.nodes(c).begin() + corners_of(b.type));
        for (const Mesh* mesh : {&in_, &out_})
            for (const CellBlock& b : mesh->blocks())
                if (is_second_order(b.type))
                    for (Index c = 0; c < b.size(); ++c)
                        for (const Index n : b.nodes(c).subspan(static_cast<std::size_t>(corners_of(b.type))))
                            if (const Index k = index_.at(mesh->node_ids[n]); !corners.contains(k))
                                mid_nodes_.insert(k);
        return mid_nodes_;
    }

    void shell_conformity() {
        std::set<Key2> opened, opening;
        for (const char* suffix : {"_P", "_N"})
            for (const CellRef& c : lip(suffix)) {
                const auto n = out_.block(c.type).nodes(c.cell);
                if (is_line(c.type)) opened.insert(ascending(Key2{n[0], n[1]}));
            }
        runs(edges_of(in_, is_triangle), [&](auto first, auto last) {
            const bool in_plane = std::ranges::all_of(
                first->key, [&](Index n) { return std::abs(plane_.distance(in_.points[n])) <= tolerance(); });
            if (in_plane && last - first > 1) opening.insert(first->key);
        });
        const auto after = border_lengths(
            out_, [&](const Key2& e) { return opened.contains(e); }, made_, nullptr);
        const auto before = border_lengths(
            in_, [&](const Key2& e) { return opening.contains(e); }, {}, nullptr);
        for (const auto& [what, length] : before) {
            const auto found = after.find(what);
            const double now = found == after.end() ? 0 : found->second;
            if (report_.held.largest <= rounding * model_.size &&
                std::abs(now - length) >
                    rounding * std::max(length, 1e-3 * model_.size) + model_.curved_slack.at(what).length)
                bad_.add("border", "length of ", what, ": ", length, " -> ", now);
        }
        for (const auto& [what, length] : after)
            if (!before.contains(what)) bad_.add("border", "new border of length ", length, " between ", what);
        AreaByPlane areas = planes_of(model_.skin);
        AreaByPlane now = areas.emptied();
        for_each_cell(out_, is_triangle, [&](CellType, Index, std::span<const Index> n) {
            now.add({out_.points[n[0]], out_.points[n[1]], out_.points[n[2]]}, model_.size);
        });
        if (const std::string text = now.differs(areas, model_.size, model_.area_slack); !text.empty())
            bad_.add("skin", text);
    }

    /// Elements of lower dimension still lie on faces and edges of others, with their mid-side nodes.
    void attached() {
        if (model_.solid) {
            std::map<Key3, int> seen;
            const std::vector<std::string> names = family_names(out_, made_);
            for_each_cell(out_, is_triangle, [&](CellType type, Index c, std::span<const Index> n) {
                const Index number = out_.block(type).ids[c];
                if (model_.mixed && model_.loose_kinds.contains(names[out_.block(type).families[c]])) return;
                const Key3 key = ascending(Key3{n[0], n[1], n[2]});
                const auto host = std::ranges::lower_bound(faces_, key, {}, [](const TetraFace& f) { return f.key; });
                if (host == faces_.end() || host->key != key) {
                    bad_.add("attached", "triangle ", number, " is on no tetrahedron's face");
                    return;
                }
                if (is_second_order(type))
                    for (int k = 0; k < 3; ++k) {
                        const int at = static_cast<int>(std::ranges::find(host->outward, n[k]) - host->outward.begin());
                        const bool forward = host->outward[(at + 1) % 3] == n[(k + 1) % 3];
                        if (host->mid[forward ? at : (at + 2) % 3] != n[3 + k])
                            bad_.add("attached", "triangle ", number,
                                     " has another mid-side node than its tetrahedron");
                    }
                if (++seen[key] > 1 && !input_repeats())
                    bad_.add("attached", "two triangles in one place, second is ", number);
            });
        }
        std::set<Key2> edges;
        std::vector<Key2> lines;
        std::vector<Index> numbers;
        for_each_cell(out_, is_line, [&](CellType type, Index c, std::span<const Index> n) {
            if (model_.loose_cells.contains(out_.block(type).ids[c])) return;
            lines.push_back(ascending(Key2{n[0], n[1]}));
            numbers.push_back(out_.block(type).ids[c]);
        });
        if (lines.empty()) return;
        const std::set<Key2> wanted(lines.begin(), lines.end());
        const auto collect = [&](CellType type, Index, std::span<const Index> n) {
            for (int a = 0; a < corners_of(type); ++a)
                for (int b = 0; b < a; ++b)
                    if (const Key2 key = ascending(Key2{n[a], n[b]}); wanted.contains(key)) edges.insert(key);
        };
        // Only elements around the lines' nodes matter; the set look-up is what costs.
        std::vector<char> ends(out_.points.size(), 0);
        for (const Key2& l : lines) ends[l[0]] = ends[l[1]] = 1;
        const auto look = [&](CellType type, Index c, std::span<const Index> n) {
            int count = 0;
            for (int k = 0; k < corners_of(type); ++k) count += ends[n[k]];
            if (count >= 2) collect(type, c, n);
        };
        if (model_.solid) for_each_cell(out_, is_tetra, look);
        if (!model_.solid || model_.mixed) for_each_cell(out_, is_triangle, look);
        for (std::size_t k = 0; k < lines.size(); ++k)
            if (!edges.contains(lines[k])) bad_.add("attached", "segment ", numbers[k], " is on no element's edge");
    }

    bool input_repeats() const {
        std::set<Key3> seen;
        bool repeats = false;
        for_each_cell(in_, is_triangle, [&](CellType, Index, std::span<const Index> n) {
            repeats = !seen.insert(ascending(Key3{n[0], n[1], n[2]})).second || repeats;
        });
        return repeats;
    }

    /// Elements of a lip.
    std::vector<CellRef> lip(const char* suffix) const {
        std::vector<CellRef> cells;
        const auto g = out_.find_group(name_ + suffix, GroupKind::element);
        if (!g) return cells;
        for (const CellBlock& b : out_.blocks())
            for (Index c = 0; c < b.size(); ++c)
                if (out_.families.contains(b.families[c], *g)) cells.push_back({b.type, c});
        return cells;
    }

    const std::set<Key3>& lip_keys() {
        if (lip_keys_known_) return lip_keys_;
        lip_keys_known_ = true;
        for (const char* suffix : {"_P", "_N"})
            for (const CellRef& c : lip(suffix)) {
                const auto n = out_.block(c.type).nodes(c.cell);
                if (n.size() >= 3) lip_keys_.insert(ascending(Key3{n[0], n[1], n[2]}));
            }
        return lip_keys_;
    }

    void lips() {
        const std::vector<CellRef> positive = lip("_P"), negative = lip("_N");
        if (positive.empty() || negative.empty()) {
            bad_.add("lips", "there are none");
            return;
        }
        std::map<std::vector<Place>, int> faces;
        std::map<Place, std::set<Index>> nodes[2];
        for (int side = 0; side < 2; ++side)
            for (const CellRef& c : side ? positive : negative) {
                const auto n = out_.block(c.type).nodes(c.cell);
                const bool wanted =
                    (model_.solid && is_triangle(c.type)) || ((!model_.solid || model_.mixed) && is_line(c.type));
                const Index number = out_.block(c.type).ids[c.cell];
                if (!wanted) bad_.add("lips", "element ", number, " is of the wrong type");
                std::vector<Place> key;
                for (const Index k : n) {
                    key.push_back(place(k));
                    nodes[side][key.back()].insert(k);
                    if (!on_plane(k)) bad_.add("lip node", "node ", id(k), " is ", distance_[k], " off the plane");
                }
                std::ranges::sort(key);
                faces[key] += side ? 1 : -1;
                if (!is_triangle(c.type)) continue;
                const auto host = std::ranges::lower_bound(faces_, ascending(Key3{n[0], n[1], n[2]}), {},
                                                           [](const TetraFace& f) { return f.key; });
                if (host == faces_.end() || host->key != ascending(Key3{n[0], n[1], n[2]}))
                    continue;  // found by attached()
                if ((host + 1) != faces_.end() && (host + 1)->key == host->key)
                    bad_.add("lips", "element ", number, " is not on the outside");
                double depth = 0;
                for (const Index k : out_.block(host->cell.type).nodes(host->cell.cell)) depth += distance_[k];
                if ((depth > 0) != (side == 1))
                    bad_.add("lips", "element ", number, " is on the other side's tetrahedron");
                const Vec3 normal =
                    (out_.points[n[1]] - out_.points[n[0]]).cross(out_.points[n[2]] - out_.points[n[0]]);
                // Only faces the crack made have a direction of their own.
                if (number > model_.largest_cell && (normal.dot(plane_.normal) < 0) != (side == 1) &&
                    !same_name_twin(c))
                    bad_.add("lips", "element ", number, " points into the material");
            }
        for (const auto& [key, balance] : faces)
            if (balance != 0) {
                bad_.add("lips", "a face of one lip has no partner on the other at (", key[0][0], ", ", key[0][1], ", ",
                         key[0][2], ")");
            }
        // Both copies of a node are in the same groups.
        const std::vector<std::string> names = family_names(out_, made_);
        for (const auto& [at, twins] : nodes[1]) {
            const auto other = nodes[0].find(at);
            if (other == nodes[0].end()) continue;
            for (const Index p : twins)
                for (const Index n : other->second) {
                    if (p == n) bad_.add("lips", "node ", id(p), " is on both lips");
                    if (names[out_.node_families[p]] != names[out_.node_families[n]])
                        bad_.add("node groups", "nodes ", id(p), " and ", id(n), ", doubles, are in '",
                                 names[out_.node_families[p]], "' and '", names[out_.node_families[n]], "'");
                }
        }
        // The interface nodes of the report are the originals of the lips' corner nodes.
        std::set<Index> named;
        for (const char* set : {"ICN", "ECN"})
            if (report_.node_sets.contains(set))
                named.insert(report_.node_sets.at(set).begin(), report_.node_sets.at(set).end());
        for (const Index i : named)
            if (const auto n = index_.find(i); n != index_.end() && !on_plane(n->second))
                bad_.add("node sets", "interface node ", i, " is ", distance_[n->second], " off the plane");
        std::set<Place> places, named_places;
        for (const auto& side : nodes)
            for (const auto& [at, those] : side)
                for (const Index n : those)
                    if (!mid_nodes().contains(n)) places.insert(at);
        // And of those mid-side nodes of the lips that moved.
        std::size_t corners = 0;
        for (const Index i : named) {
            if (!index_.contains(i)) continue;
            const Index n = index_.at(i);
            if (!mid_nodes().contains(n)) {
                named_places.insert(place(n));
                ++corners;
            } else if (same_place(n) || !is_input_node(n)) {
                bad_.add("node sets", "mid-side node ", i, " is an interface node, but did not move");
            }
        }
        if (places != named_places || corners != named_places.size())
            bad_.add("node sets", "ICN and ECN name ", corners, " corner nodes in ", named_places.size(),
                     " places, the lips have ", places.size());
        if (const auto count = report_.constraints.find("plane");
            count == report_.constraints.end() || count->second != static_cast<Index>(named.size()))
            bad_.add("constraints", "plane constraints are not as many as interface nodes");
    }

    /// Whether a lip element is the double of an element the input had there, whose direction it keeps.
    bool same_name_twin(const CellRef& c) const {
        return out_.families.groups(out_.block(c.type).families[c.cell]).size() > 1;
    }

    void section() {
        if (report_.held.largest > rounding * model_.size) return;  // it goes through nodes beside the plane
        const double wanted = section_measure(model_, plane_);
        for (const char* suffix : {"_P", "_N"}) {
            double measure = 0;
            for (const CellRef& c : lip(suffix)) {
                const auto n = out_.block(c.type).nodes(c.cell);
                if (is_triangle(c.type))
                    measure += flat_area({out_.points[n[0]], out_.points[n[1]], out_.points[n[2]]});
                else if (is_line(c.type) && !model_.solid)
                    measure += (out_.points[n[1]] - out_.points[n[0]]).norm();
            }
            const double allowed =
                rounding * std::max(wanted, model_.solid ? 1e-3 * model_.size * model_.size : 1e-3 * model_.size);
            if (std::abs(measure - wanted) > allowed + model_.section_slack(plane_))
                bad_.add("section", "lip ", name_, suffix, " has measure ", measure, ", the plane cuts ", wanted);
        }
    }

    void groups() {
        sums_ = group_sums(out_);
        for (std::size_t g = 0; g < in_.groups.size(); ++g) {
            if (in_.groups[g].hidden || in_.groups[g].kind == GroupKind::node) continue;
            if (g >= out_.groups.size() || out_.groups[g].name != in_.groups[g].name ||
                out_.groups[g].kind != in_.groups[g].kind) {
                bad_.add("group", "'", in_.groups[g].name, "' is gone or has moved");
                continue;
            }
            const GroupSum &a = model_.sums[g], &b = sums_[g];
            // What lies in the crack is there twice.
            const double twice = doubled_measure(static_cast<GroupIndex>(g));
            const double allowed = (model_.flat ? rounding : 0.01) * a.measure + model_.group_slack[g];
            if (std::abs(b.measure - a.measure - twice) > allowed)
                bad_.add("group", "'", in_.groups[g].name, "': measure ", a.measure, " -> ", b.measure);
            if (twice == 0 && (b.normal_area - a.normal_area).norm() > allowed)
                bad_.add("group", "'", in_.groups[g].name, "': faces turned round");
            if (a.count > 0 && b.count == 0) bad_.add("group", "'", in_.groups[g].name, "' became empty");
            if (model_.flat || in_.groups[g].kind != GroupKind::element) continue;
            std::set<Index> on_faces, on_lines;
            for (const CellBlock& block : out_.blocks())
                for (Index c = 0; c < block.size(); ++c)
                    if ((is_triangle(block.type) || is_line(block.type)) &&
                        out_.families.contains(block.families[c], static_cast<GroupIndex>(g)))
                        for (const Index n : block.nodes(c)) (is_line(block.type) ? on_lines : on_faces).insert(n);
            nodes_stay(on_faces, model_.group_faces[g], "face group");
            nodes_stay(on_lines, model_.group_segments[g], "line group");
        }
    }

    /// Measure of what a group has twice in one place: faces and segments on the crack, one copy per side.
    double doubled_measure(GroupIndex g) const {
        if (in_.groups[g].kind != GroupKind::element || model_.sums[g].dimension == 3) return 0;
        std::set<std::vector<std::array<double, 3>>> places;
        double measure = 0;
        for (const CellBlock& b : out_.blocks())
            for (Index c = 0; c < b.size(); ++c) {
                const auto n = b.nodes(c);
                if (!out_.families.contains(b.families[c], g) ||
                    !std::ranges::all_of(n, [&](Index k) { return on_plane(k); }))
                    continue;
                std::vector<std::array<double, 3>> place;
                for (const Index k : n) place.push_back({out_.points[k].x(), out_.points[k].y(), out_.points[k].z()});
                std::ranges::sort(place);
                if (places.insert(place).second) continue;
                if (is_line(b.type) && model_.sums[g].dimension == 1)
                    measure +=
                        segment_length(out_.points[n[0]], out_.points[n[1]], out_.points[n.back()], n.size() == 3);
                else if (is_triangle(b.type) && n.size() == 3)
                    measure += flat_area({out_.points[n[0]], out_.points[n[1]], out_.points[n[2]]});
                else if (is_triangle(b.type))
                    measure += curved_area(make_face(out_, {n[0], n[1], n[2]}, {n[3], n[4], n[5]}));
            }
        return measure;
    }

    void node_groups() {
        for (std::size_t g = 0; g < in_.groups.size(); ++g) {
            if (in_.groups[g].hidden || in_.groups[g].kind != GroupKind::node) continue;
            const auto group = static_cast<GroupIndex>(g);
            std::set<Index> now;
            for (std::size_t n = 0; n < out_.points.size(); ++n)
                if (out_.families.contains(out_.node_families[n], group)) now.insert(static_cast<Index>(n));
            for (std::size_t n = 0; n < in_.points.size(); ++n) {
                const Index after = index_.at(in_.node_ids[n]);
                if (in_.families.contains(in_.node_families[n], group) != now.contains(after))
                    bad_.add("node groups", "node ", in_.node_ids[n], now.contains(after) ? " joined '" : " left '",
                             in_.groups[g].name, "'");
            }
            if (model_.group_twin[g] < 0) continue;
            std::set<Index> of_elements;
            for (const CellBlock& b : out_.blocks())
                for (Index c = 0; c < b.size(); ++c)
                    if (out_.families.contains(b.families[c], model_.group_twin[g]))
                        for (const Index n : b.nodes(c)) of_elements.insert(n);
            for (const Index n : of_elements)
                if (!now.contains(n))
                    bad_.add("node groups", "node ", id(n), is_input_node(n) ? "" : " (new)", " of elements of '",
                             in_.groups[g].name, "' is not in the node group");
            if (!model_.group_planar[g]) continue;
            // A doubled node stays a member on both sides, also where the group's elements are all on one.
            for (const Index n : now)
                if (!of_elements.contains(n) && !on_plane(n))
                    bad_.add("node groups", "node ", id(n), is_input_node(n) ? "" : " (new)", " is in node group '",
                             in_.groups[g].name, "' but off its elements");
        }
    }

    void report() {
        const auto expect = [&](const char* what, auto reported, auto counted) {
            if (reported != counted) bad_.add("report", what, " is ", reported, ", counted ", counted);
        };
        const Index fresh = out_.node_count() - in_.node_count();
        expect("nodes_added", report_.nodes_added, fresh);
        expect("nodes_split + nodes_doubled", report_.nodes_split + report_.nodes_doubled, fresh);
        expect("elements_removed", report_.elements_removed, gone_);
        expect("elements_added", report_.elements_added, out_.cell_count() - in_.cell_count() + gone_);
        Index moved = 0;
        double farthest = 0;
        for (std::size_t n = 0; n < out_.points.size(); ++n)
            if (is_input_node(static_cast<Index>(n)) && !same_place(static_cast<Index>(n))) {
                ++moved;
                farthest =
                    std::max(farthest, (out_.points[n] - in_.points[model_.node_index.at(out_.node_ids[n])]).norm());
            }
        expect("nodes_moved", report_.nodes_moved, moved);
        if (std::abs(report_.max_displacement - farthest) > tolerance())
            expect("max_displacement", report_.max_displacement, farthest);
        expect("quality_after.count", report_.quality_after.count, band_count_);
        if (std::abs(report_.quality_after.minimum - band_minimum_) > rounding)
            expect("quality_after.minimum", report_.quality_after.minimum, band_minimum_);
        std::size_t record = 0;
        for (std::size_t g = 0; g < out_.groups.size(); ++g) {
            if (out_.groups[g].hidden) continue;
            if (record >= report_.groups.size()) {
                bad_.add("report", "has no record of group '", out_.groups[g].name, "'");
                return;
            }
            const GroupRecord& r = report_.groups[record++];
            const GroupSum was = g < in_.groups.size() ? model_.sums[g] : GroupSum{};
            const std::string text = "group '" + r.name + "': ";
            if (r.name != out_.groups[g].name || r.kind != out_.groups[g].kind)
                bad_.add("report", "record of '", r.name, "' where '", out_.groups[g].name, "' was expected");
            expect((text + "count_before").c_str(), r.count_before, was.count);
            expect((text + "count_after").c_str(), r.count_after, sums_[g].count);
            if (r.kind == GroupKind::element && sums_[g].count > 0)
                expect((text + "dimension").c_str(), r.dimension, sums_[g].dimension);
            // Six-node faces have no exact rule: two good ones differ in the last digits that matter.
            const double allowed = is_flat_measure(r) ? rounding : 1e-4;
            if (std::abs(r.measure_before - was.measure) > allowed * was.measure)
                expect((text + "measure_before").c_str(), r.measure_before, was.measure);
            if (std::abs(r.measure_after - sums_[g].measure) > allowed * std::max(was.measure, sums_[g].measure))
                expect((text + "measure_after").c_str(), r.measure_after, sums_[g].measure);
            // Shortcuts of a node group through the material may drift.
            if (!(r.kind == GroupKind::node && model_.solid) &&
                r.boundary_drift > (model_.flat ? rounding * model_.size : 1e-3 * model_.size))
                bad_.add("report", text, "boundary drift ", r.boundary_drift);
        }
        if (record != report_.groups.size())
            bad_.add("report", "has ", report_.groups.size(), " group records, there are ", record, " groups");
    }

    bool is_flat_measure(const GroupRecord& r) const {
        return r.kind == GroupKind::node || r.dimension == 3 ||
               (in_.block(CellType::triangle6).size() == 0 && in_.block(CellType::line3).size() == 0 &&
                in_.block(CellType::tetra10).size() == 0);
    }

    const Model& model_;
    const Mesh& in_;
    const Mesh& out_;
    const Report& report_;
    const CutPlane& plane_;
    std::string name_;
    std::set<std::string> made_;
    Findings bad_;
    std::unordered_map<Index, Index> index_;  // node number -> index in out_
    std::vector<double> distance_;
    std::set<Index> in_sets_;
    std::set<Place> interface_places_;  ///< of the named interface nodes, and so of their doubles
    std::set<Index> mid_nodes_;
    bool mids_known_ = false;
    std::vector<TetraFace> faces_;
    std::set<Key3> lip_keys_;
    bool lip_keys_known_ = false;
    std::vector<GroupSum> sums_;
    Index gone_ = 0;
    Index band_count_ = 0;
    double band_minimum_ = 1;
};

}  // namespace

std::uint64_t Random::bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

double Random::uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
}

Vec3 Random::direction() {
    const double z = uniform(-1, 1), angle = uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    return Vec3(r * std::cos(angle), r * std::sin(angle), z).normalized();
}

double tetra_shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double v = volume(a, b, c, d);
    const double sum = (a - b).squaredNorm() + (a - c).squaredNorm() + (a - d).squaredNorm() + (b - c).squaredNorm() +
                       (b - d).squaredNorm() + (c - d).squaredNorm();
    return std::copysign(12 * std::pow(3 * std::abs(v), 2.0 / 3) / sum, v);
}

double triangle_shape(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = (b - a).cross(c - a).norm() / 2;
    return 4 * std::sqrt(3.0) * area / ((a - b).squaredNorm() + (b - c).squaredNorm() + (c - a).squaredNorm());
}

std::vector<GroupSum> group_sums(const Mesh& mesh) {
    std::vector<std::array<double, 4>> measures(mesh.groups.size(), std::array<double, 4>{});
    std::vector<std::array<Vec3, 4>> vectors(
        mesh.groups.size(), std::array<Vec3, 4>{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()});
    std::vector<GroupSum> sums(mesh.groups.size());
    for (const FamilyIndex f : mesh.node_families)
        for (const GroupIndex g : mesh.families.groups(f)) sums[g].count += mesh.groups[g].kind == GroupKind::node;
    const auto add = [&](GroupIndex g, int dimension, double measure, const Vec3& vector) {
        ++sums[g].count;
        sums[g].dimension = std::max(sums[g].dimension, dimension);
        measures[g][dimension] += measure;
        vectors[g][dimension] += vector;
    };
    const auto face = [&](std::array<Index, 3> c, std::array<Index, 3> m) {
        const Model::Face f = make_face(mesh, c, m);
        return face_area(f.corner, f.mid, f.curved);
    };
    for (const CellBlock& b : mesh.blocks())
        for (Index c = 0; c < b.size(); ++c) {
            const auto groups = mesh.families.groups(b.families[c]);
            if (groups.empty()) continue;
            const auto n = b.nodes(c);
            double measure = 0;
            Vec3 vector = Vec3::Zero();
            int dimension = 0;
            if (is_tetra(b.type)) {
                dimension = 3;
                measure = tetra_volume(mesh, b.type, n);
            } else if (is_triangle(b.type)) {
                dimension = 2;
                std::tie(vector, measure) =
                    face({n[0], n[1], n[2]}, n.size() == 6 ? Key3{n[3], n[4], n[5]} : Key3{-1, -1, -1});
            } else if (is_line(b.type)) {
                dimension = 1;
                measure = segment_length(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n.back()],
                                         b.type == CellType::line3);
            } else if (b.type != CellType::vertex) {
                continue;
            }
            for (const GroupIndex g : groups)
                if (mesh.groups[g].kind == GroupKind::element) add(g, dimension, measure, vector);
        }
    for (const Facet& f : mesh.facets) {
        const auto n = mesh.block(f.type).nodes(f.cell);
        double measure;
        Vec3 vector = Vec3::Zero();
        if (is_tetra(f.type)) {
            static constexpr int faces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};
            const auto& k = faces[f.face - 1];
            std::tie(vector, measure) = face({n[k[0]], n[k[1]], n[k[2]]}, {-1, -1, -1});
        } else if (f.face <= 2) {
            std::tie(vector, measure) = face({n[0], n[1], n[2]}, {-1, -1, -1});
        } else {
            measure = (mesh.points[n[f.face - 3]] - mesh.points[n[(f.face - 2) % 3]]).norm();
        }
        for (const GroupIndex g : mesh.families.groups(f.family)) add(g, 2, measure, vector);
    }
    for (std::size_t g = 0; g < sums.size(); ++g) {
        if (mesh.groups[g].kind == GroupKind::node) continue;
        sums[g].measure = measures[g][sums[g].dimension];
        sums[g].normal_area = vectors[g][sums[g].dimension];
    }
    return sums;
}

std::vector<TetraFace> tetra_faces(const Mesh& mesh) {
    std::vector<TetraFace> faces;
    for_each_cell(mesh, is_tetra, [&](CellType type, Index c, std::span<const Index> n) {
        for (const auto& f : outward_faces) {
            TetraFace face{{}, {n[f[0]], n[f[1]], n[f[2]]}, {-1, -1, -1}, {type, c}};
            face.key = ascending(face.outward);
            if (type == CellType::tetra10)
                for (int k = 0; k < 3; ++k) face.mid[k] = n[mid_of(type, f[k], f[(k + 1) % 3])];
            faces.push_back(face);
        }
    });
    std::ranges::sort(faces, {}, [](const TetraFace& f) { return std::pair(f.key, f.cell.cell); });
    return faces;
}

Model::Model(Mesh input, bool is_flat) : mesh(std::move(input)), flat(is_flat) {
    solid = mesh.block(CellType::tetra).size() + mesh.block(CellType::tetra10).size() > 0;
    low = high = mesh.points.front();
    for (std::size_t n = 0; n < mesh.points.size(); ++n) {
        low = low.cwiseMin(mesh.points[n]);
        high = high.cwiseMax(mesh.points[n]);
        node_index.emplace(mesh.node_ids[n], static_cast<Index>(n));
        largest_node = std::max(largest_node, mesh.node_ids[n]);
    }
    size = (high - low).norm();
    for (const CellBlock& b : mesh.blocks())
        for (const Index i : b.ids) largest_cell = std::max(largest_cell, i);

    std::set<Key3> host_faces;
    const std::vector<std::string> names = family_names(mesh);
    if (solid) {
        const std::vector<TetraFace> faces = tetra_faces(mesh);
        runs(faces, [&](auto first, auto last) {
            host_faces.insert(first->key);
            const auto family = [&](const TetraFace& f) { return mesh.block(f.cell.type).families[f.cell.cell]; };
            if (last - first == 1)
                skin.push_back(make_face(mesh, first->outward, first->mid));
            else if (names[family(*first)] != names[family(*(first + 1))])
                borders.push_back(make_face(mesh, first->outward, first->mid));
        });
    }
    for_each_cell(mesh, is_triangle, [&](CellType type, Index c, std::span<const Index> n) {
        if (solid && !host_faces.contains(ascending(Key3{n[0], n[1], n[2]}))) {
            mixed = true;
            loose_kinds.insert(names[mesh.block(type).families[c]]);
        }
        if (!solid)
            skin.push_back(
                make_face(mesh, {n[0], n[1], n[2]}, n.size() == 6 ? Key3{n[3], n[4], n[5]} : Key3{-1, -1, -1}));
    });
    std::set<Key2> neighbours;
    for (const Edge& e : edges_of(mesh, [](CellType t) { return is_tetra(t) || is_triangle(t); }))
        neighbours.insert(e.key);
    const auto segment = [&](std::span<const Index> n) {
        Segment s{{mesh.points[n[0]], mesh.points[n[1]]}, (mesh.points[n[0]] + mesh.points[n[1]]) / 2, {}, {}, {}, 0};
        if (n.size() == 3) s.mid = mesh.points[n[2]];
        return s;
    };
    for_each_cell(mesh, is_line, [&](CellType type, Index c, std::span<const Index> n) {
        if (!neighbours.contains(ascending(Key2{n[0], n[1]}))) loose_cells.insert(mesh.block(type).ids[c]);
    });
    if (!solid) {
        border_lengths(
            mesh, [](const Key2&) { return false; }, {}, &lines);
        find_bends();
    } else {
        // Feature lines: edges where skin faces meet at more than 30 degrees, and edges where a border ends in the
        // skin.
        std::map<Key2, std::vector<Vec3>> meeting, inward;
        runs(tetra_faces(mesh), [&](auto first, auto last) {
            const auto family = [&](const TetraFace& f) { return mesh.block(f.cell.type).families[f.cell.cell]; };
            const bool outside = last - first == 1;
            if (!outside && names[family(*first)] == names[family(*(first + 1))]) return;
            for (int k = 0; k < 3; ++k) {
                const Key2 key = ascending(Key2{first->outward[k], first->outward[(k + 1) % 3]});
                meeting[key].push_back(make_face(mesh, first->outward, first->mid).normal);
                const Vec3 &a = mesh.points[key[0]], along = mesh.points[key[1]] - a;
                const Vec3 across = mesh.points[first->outward[(k + 2) % 3]] - a;
                inward[key].push_back((across - across.dot(along) / along.squaredNorm() * along).normalized());
            }
        });
        for (const auto& [key, normals] : meeting) {
            bool feature = normals.size() != 2;
            for (const Vec3& n : normals) feature = feature || n.dot(normals[0]) < std::cos(std::numbers::pi / 6);
            if (feature)
                lines.push_back({{mesh.points[key[0]], mesh.points[key[1]]},
                                 (mesh.points[key[0]] + mesh.points[key[1]]) / 2,
                                 normals,
                                 inward.at(key),
                                 {},
                                 0});
        }
    }

    sums = group_sums(mesh);
    group_slack.assign(mesh.groups.size(), 0);
    for (const auto& [kind, slack] : curved_slack)
        for (std::size_t g = 0; g < mesh.groups.size(); ++g)
            if (kind.find(mesh.groups[g].name + ';') != std::string::npos) group_slack[g] += slack.area;
    group_faces.resize(mesh.groups.size());
    group_segments.resize(mesh.groups.size());
    group_twin.assign(mesh.groups.size(), -1);
    group_planar.assign(mesh.groups.size(), 0);
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
        const auto group = static_cast<GroupIndex>(g);
        if (mesh.groups[g].hidden) continue;
        if (mesh.groups[g].kind == GroupKind::element && !flat) {
            for_each_cell(mesh, is_triangle, [&](CellType type, Index c, std::span<const Index> n) {
                if (mesh.families.contains(mesh.block(type).families[c], group))
                    group_faces[g].push_back(
                        make_face(mesh, {n[0], n[1], n[2]}, n.size() == 6 ? Key3{n[3], n[4], n[5]} : Key3{-1, -1, -1}));
            });
            for_each_cell(mesh, is_line, [&](CellType type, Index c, std::span<const Index> n) {
                if (mesh.families.contains(mesh.block(type).families[c], group))
                    group_segments[g].push_back(segment(n));
            });
        }
        if (mesh.groups[g].kind != GroupKind::node) continue;
        std::set<Index> members;
        for (std::size_t n = 0; n < mesh.points.size(); ++n)
            if (mesh.families.contains(mesh.node_families[n], group)) members.insert(static_cast<Index>(n));
        std::set<Index> accompanied;
        for (const Key2& e : neighbours)
            if (members.contains(e[0]) && members.contains(e[1])) accompanied.insert(e.begin(), e.end());
        std::set<Index> corners;
        for (const CellBlock& b : mesh.blocks())
            for (Index c = 0; c < b.size(); ++c)
                corners.insert(b.nodes(c).begin(), b.nodes(c).begin() + corners_of(b.type));
        for (const Index n : members)
            if (!accompanied.contains(n) && corners.contains(n)) isolated_nodes.push_back(n);
        const auto twin = mesh.find_group(mesh.groups[g].name, GroupKind::element);
        if (!twin) continue;
        std::set<Index> of_elements;
        for (const CellBlock& b : mesh.blocks())
            for (Index c = 0; c < b.size(); ++c)
                if (mesh.families.contains(b.families[c], *twin))
                    of_elements.insert(b.nodes(c).begin(), b.nodes(c).end());
        if (of_elements != members) continue;
        group_twin[g] = *twin;
        if (sums[*twin].dimension == 3) {
            group_planar[g] = 1;
            continue;
        }
        // The plane of three members far apart, if all others are in it.
        const std::vector<Index> list(members.begin(), members.end());
        Vec3 normal = Vec3::Zero();
        for (const Index n : list) {
            const Vec3 candidate = (mesh.points[list.back()] - mesh.points[list.front()])
                                       .cross(mesh.points[n] - mesh.points[list.front()]);
            if (candidate.norm() > normal.norm()) normal = candidate;
        }
        if (normal.norm() > 1e-6 * size * size) normal.normalize();
        group_planar[g] = std::ranges::all_of(list, [&](Index n) {
            return std::abs(normal.dot(mesh.points[n] - mesh.points[list[0]])) < rounding * size;
        });
    }
}

/// Lines that turn a little from segment to segment are curves to the mesh's author: nodes slide along them, and what
/// they bound changes by the little areas between chords.
void Model::find_bends() {
    std::map<std::pair<std::string, std::array<double, 3>>, std::vector<Segment*>> ends;
    for (Segment& s : lines)
        for (const Vec3& e : s.end) ends[{s.kind, {e.x(), e.y(), e.z()}}].push_back(&s);
    for (const auto& [end, meeting] : ends) {
        if (meeting.size() != 2) continue;
        const auto direction = [](const Segment& s) { return Vec3((s.end[1] - s.end[0]).normalized()); };
        const double bend = std::asin(std::min(1.0, direction(*meeting[0]).cross(direction(*meeting[1])).norm()));
        if (bend < 1e-6 || bend > std::numbers::pi / 6) continue;
        for (Segment* s : meeting) s->bend = std::max(s->bend, bend);
    }
    for (const Segment& s : lines) {
        const double length = (s.end[1] - s.end[0]).norm();
        Slack& slack = curved_slack[s.kind];
        slack.length += length * s.bend * s.bend / 8;
        slack.area += length * length * s.bend / 4;
        area_slack += length * length * s.bend / 4;
    }
}

double Model::section_slack(const CutPlane& plane) const {
    double slack = 0;
    if (!flat)
        // New faces of the skin are chords of the old: up to the sagitta off it, more in a plane that meets it at a
        // slant.
        for (const Face& f : skin) {
            std::vector<Vec3> ends;
            for (int k = 0; k < 3; ++k) {
                const double a = plane.distance(f.corner[k]), b = plane.distance(f.corner[(k + 1) % 3]);
                if (a * b < 0) ends.push_back(f.corner[k] + a / (a - b) * (f.corner[(k + 1) % 3] - f.corner[k]));
            }
            if (ends.size() == 2)
                slack += (ends[1] - ends[0]).norm() * f.edge / 8 / std::max(0.05, f.normal.cross(plane.normal).norm());
        }
    for (const Segment& s : lines)
        if (s.bend > 0 && plane.distance(s.end[0]) * plane.distance(s.end[1]) <= 0)
            for (const Vec3& plate : s.plates)
                slack += (s.end[1] - s.end[0]).norm() * s.bend / 4 / std::max(0.05, plate.cross(plane.normal).norm());
    return slack;
}

/// Best mean ratio of a triangle with this angle: the isosceles one.
double triangle_bound(double angle) {
    return angle > std::numbers::pi / 3 ? 1 : std::sqrt(3.0) * std::sin(angle) / (2 - std::cos(angle));
}

/// Best mean ratio of a tetrahedron whose apex has these three unit directions.
double needle_bound(const Vec3& a, const Vec3& b, const Vec3& c) {
    double best = 0;
    for (double x = 0.3; x < 3; x *= 1.1)
        for (double y = 0.3; y < 3; y *= 1.1)
            best = std::max(best, std::abs(tetra_shape(Vec3::Zero(), a, x * b, y * c)));
    return best;
}

/// Best mean ratio of a tetrahedron one face of which has this angle: symmetric about the angle's bisector.
double sliver_bound(double angle) {
    const Vec3 a(std::cos(angle / 2), std::sin(angle / 2), 0), b(std::cos(angle / 2), -std::sin(angle / 2), 0);
    double best = 0;
    for (double x = -1; x < 2; x += 0.05)
        for (double z = 0.2; z < 2; z += 0.05)
            best = std::max(best, std::abs(tetra_shape(Vec3::Zero(), a, b, Vec3(x, 0, z))));
    return best;
}

Grazing grazing(const Model& model, const CutPlane& plane) {
    const double sine = std::sin(5 * std::numbers::pi / 180);
    Grazing out;
    const auto look = [&](const Model::Face& f) {
        if (f.normal.cross(plane.normal).norm() > sine) return;
        double low = plane.distance(f.corner[0]), high = low;
        for (int k = 1; k < 3; ++k) {
            low = std::min(low, plane.distance(f.corner[k]));
            high = std::max(high, plane.distance(f.corner[k]));
        }
        if (low < 0.15 * f.edge && high > -0.15 * f.edge) out.surface = true;
    };
    for (const Model::Face& f : model.skin) look(f);
    for (const Model::Face& f : model.borders) look(f);
    for (const Model::Segment& s : model.lines) {
        const Vec3 along = (s.end[1] - s.end[0]).normalized();
        const double length = (s.end[1] - s.end[0]).norm();
        const bool crossed = plane.distance(s.end[0]) * plane.distance(s.end[1]) < 0;
        for (const Vec3& plate : s.plates) {
            const double steep = plate.cross(plane.normal).norm();
            if (steep < sine) continue;
            // Within the plate: the angle of the plane's trace with the segment, and how far from it the trace runs.
            const double trace = std::min(1.0, std::abs(along.dot(plane.normal)) / steep);
            const double a = plane.distance(s.end[0]) / steep, b = plane.distance(s.end[1]) / steep;
            if (trace <= sine && std::min(a, b) < 0.15 * length && std::max(a, b) > -0.15 * length) out.line = true;
            if (crossed && !model.solid) out.bound = std::min(out.bound, triangle_bound(std::asin(trace)));
        }
        if (crossed && model.solid && s.plates.size() == 2) {
            // Directions from the segment into its two faces, then the plane's traces on them.
            std::array<Vec3, 2> trace;
            std::array<double, 2> turn;
            for (int k = 0; k < 2; ++k) {
                trace[k] = plane.normal.cross(s.plates[k]);
                if (trace[k].dot(s.inward[k]) < 0) trace[k] = -trace[k];
                turn[k] = trace[k].normalized().dot(along);
                const double angle = std::acos(std::min(1.0, std::abs(turn[k])));
                if (angle < 0.1 && s.plates[k].cross(plane.normal).norm() >= sine)
                    out.bound = std::min(out.bound, sliver_bound(angle));
            }
            // Both traces lean the same way: a needle is cut off along the segment.
            if (turn[0] * turn[1] > 0)
                out.bound = std::min(out.bound, needle_bound((turn[0] > 0 ? 1 : -1) * along, trace[0].normalized(),
                                                             trace[1].normalized()));
        }
    }
    return out;
}

double section_measure(const Model& model, const CutPlane& plane) {
    double sum = 0;
    std::map<std::vector<Index>, int> met;  // faces (edges) in the plane, bit 1: from above, bit 2: from below
    const auto crossing = [&](const Mesh& mesh, Index a, Index b) {
        const double da = plane.distance(mesh.points[a]), db = plane.distance(mesh.points[b]);
        return Vec3(mesh.points[a] + da / (da - db) * (mesh.points[b] - mesh.points[a]));
    };
    for_each_cell(model.mesh, model.solid ? is_tetra : is_triangle,
                  [&](CellType type, Index, std::span<const Index> n) {
                      std::vector<Index> above, below, on;
                      for (int k = 0; k < corners_of(type); ++k) {
                          const double d = plane.distance(model.mesh.points[n[k]]);
                          if (std::abs(d) <= rounding * model.size)
                              on.push_back(n[k]);
                          else
                              (d > 0 ? above : below).push_back(n[k]);
                      }
                      std::vector<Vec3> polygon;
                      for (const Index a : above)
                          for (const Index b : below) polygon.push_back(crossing(model.mesh, a, b));
                      // A face in the plane opens where it is met from both sides, and counts once.
                      if (above.empty() || below.empty()) {
                          if (on.size() != (model.solid ? 3 : 2)) return;
                          std::ranges::sort(on);
                          int& sides = met[on];
                          const int before = sides;
                          sides |= above.empty() ? 2 : 1;
                          if (before == sides || sides != 3) return;
                      }
                      // Two above, two below: 0-0, 0-1, 1-0, 1-1; around the quadrangle the last two change places.
                      if (polygon.size() == 4) std::swap(polygon[2], polygon[3]);
                      for (const Index k : on) polygon.push_back(model.mesh.points[k]);
                      if (model.solid) {
                          if (polygon.size() < 3) return;
                          Vec3 area = Vec3::Zero();
                          for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
                              area += (polygon[k] - polygon[0]).cross(polygon[k + 1] - polygon[0]) / 2;
                          sum += area.norm();
                      } else if (polygon.size() == 2) {
                          sum += (polygon[1] - polygon[0]).norm();
                      }
                  });
    return sum;
}

std::vector<std::string> check_crack(const Model& model, const CutPlane& plane, const Result& result,
                                     const std::string& name) {
    return CrackCheck(model, plane, result, name).run();
}

bool identical(const Mesh& a, const Mesh& b) {
    const auto same_points = [](const std::vector<Vec3>& x, const std::vector<Vec3>& y) {
        return x.size() == y.size() && (x.empty() || std::memcmp(x.data(), y.data(), x.size() * sizeof(Vec3)) == 0);
    };
    if (!same_points(a.points, b.points) || a.node_ids != b.node_ids || a.name != b.name || a.unit != b.unit ||
        a.companion != b.companion)
        return false;
    for (std::size_t k = 0; k < a.blocks().size(); ++k)
        if (a.blocks()[k].connectivity != b.blocks()[k].connectivity || a.blocks()[k].ids != b.blocks()[k].ids)
            return false;
    if (a.groups.size() != b.groups.size() || a.facets.size() != b.facets.size()) return false;
    for (std::size_t g = 0; g < a.groups.size(); ++g)
        if (a.groups[g].name != b.groups[g].name || a.groups[g].kind != b.groups[g].kind ||
            a.groups[g].hidden != b.groups[g].hidden)
            return false;
    const auto same_family = [&](FamilyIndex x, FamilyIndex y) {
        return std::ranges::equal(a.families.groups(x), b.families.groups(y));
    };
    for (std::size_t n = 0; n < a.node_families.size(); ++n)
        if (!same_family(a.node_families[n], b.node_families[n])) return false;
    for (std::size_t k = 0; k < a.blocks().size(); ++k)
        for (std::size_t c = 0; c < a.blocks()[k].families.size(); ++c)
            if (!same_family(a.blocks()[k].families[c], b.blocks()[k].families[c])) return false;
    for (std::size_t k = 0; k < a.facets.size(); ++k)
        if (a.facets[k].type != b.facets[k].type || a.facets[k].face != b.facets[k].face ||
            a.facets[k].cell != b.facets[k].cell || !same_family(a.facets[k].family, b.facets[k].family))
            return false;
    return true;
}

}  // namespace femscalpel::checks
