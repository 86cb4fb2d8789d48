// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh/quality.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>

#include "cancel.h"

namespace femscalpel {
namespace {

struct GaussPoint {
    Vec3 at;
    double weight;
};

// 5-point rule of degree 3 on the reference tetrahedron: exact for the Jacobian determinant of TETRA10.
const std::vector<GaussPoint>& tetra_rule() {
    static const std::vector<GaussPoint> rule = [] {
        std::vector<GaussPoint> r{{{0.25, 0.25, 0.25}, -4.0 / 5 / 6}};
        const double a = 1.0 / 6, b = 0.5;
        for (const Vec3& p : {Vec3(a, a, a), Vec3(b, a, a), Vec3(a, b, a), Vec3(a, a, b)})
            r.push_back({p, 9.0 / 20 / 6});
        return r;
    }();
    return rule;
}

// 7-point rule of degree 5 on the reference triangle.
const std::vector<GaussPoint>& triangle_rule() {
    static const std::vector<GaussPoint> rule = [] {
        const double s = std::sqrt(15.0);
        const double a = (6 - s) / 21, b = (6 + s) / 21, wa = (155 - s) / 2400, wb = (155 + s) / 2400;
        std::vector<GaussPoint> r{{{1.0 / 3, 1.0 / 3, 0}, 9.0 / 80}};
        for (const auto& [p, w] : {std::pair{a, wa}, std::pair{b, wb}}) {
            r.push_back({{p, p, 0}, w});
            r.push_back({{1 - 2 * p, p, 0}, w});
            r.push_back({{p, 1 - 2 * p, 0}, w});
        }
        return r;
    }();
    return rule;
}

const std::vector<std::pair<double, double>>& line_rule() {
    static const double a = std::sqrt(0.6);
    static const std::vector<std::pair<double, double>> rule{{-a, 5.0 / 9}, {0, 8.0 / 9}, {a, 5.0 / 9}};
    return rule;
}

std::vector<GaussPoint> tensor_rule(int dimension) {
    std::vector<GaussPoint> r;
    for (const auto& [x, wx] : line_rule())
        for (const auto& [y, wy] : line_rule())
            for (const auto& [z, wz] : line_rule()) {
                if (dimension == 3) r.push_back({{x, y, z}, wx * wy * wz});
                if (dimension == 2 && z == 0) r.push_back({{x, y, 0}, wx * wy});
                if (dimension == 1 && z == 0 && y == 0) r.push_back({{x, 0, 0}, wx});
            }
    return r;
}

std::vector<GaussPoint> wedge_rule() {
    std::vector<GaussPoint> r;
    for (const GaussPoint& t : triangle_rule())
        for (const auto& [z, w] : line_rule()) r.push_back({{t.at.x(), t.at.y(), z}, t.weight * w});
    return r;
}

/// The reference coordinates of an element's nodes.
std::vector<Vec3> reference_nodes(CellType type) {
    static const Vec3 simplex[4] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const Vec3 cube[8] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                 {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    static const Vec3 wedge[6] = {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    const CellTraits& t = traits(type);
    std::vector<Vec3> nodes;
    for (int k = 0; k < t.corners; ++k) {
        if (t.corners == 8)
            nodes.push_back(cube[k]);
        else if (t.corners == 6)
            nodes.push_back(wedge[k]);
        else if (t.dimension == 2 && t.corners == 4)
            nodes.push_back({cube[k].x(), cube[k].y(), 0});
        else if (t.dimension == 1)
            nodes.push_back({k == 0 ? -1.0 : 1.0, 0, 0});
        else
            nodes.push_back(simplex[k]);
    }
    return nodes;
}

/// Gradients of the shape functions of `type` at a reference point, found as the polynomials of the
/// type's own monomial space that are 1 at one node and 0 at the others.
class ShapeGradients {
public:
    explicit ShapeGradients(CellType type) {
        const CellTraits& t = traits(type);
        std::vector<Vec3> nodes = reference_nodes(type);
        if (t.quadratic) {
            for (const auto& e : t.edges) nodes.push_back((nodes[e[0]] + nodes[e[1]]) / 2);
            const auto centre = [&](std::initializer_list<int> corners) {
                Vec3 c = Vec3::Zero();
                for (int k : corners) c += nodes[k];
                nodes.push_back(c / static_cast<double>(corners.size()));
            };
            if (type == CellType::quad9) centre({0, 1, 2, 3});
            if (type == CellType::wedge18)
                for (auto f : {std::initializer_list<int>{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}) centre(f);
            if (type == CellType::hexahedron27) {
                for (auto f : {std::initializer_list<int>{0, 4, 7, 3},
                               {1, 2, 6, 5},
                               {0, 1, 5, 4},
                               {3, 7, 6, 2},
                               {0, 3, 2, 1},
                               {4, 5, 6, 7}})
                    centre(f);
                centre({0, 1, 2, 3, 4, 5, 6, 7});
            }
        }
        choose_monomials(type);
        const auto n = static_cast<Eigen::Index>(nodes.size());
        Eigen::MatrixXd vandermonde(n, n);
        for (Eigen::Index i = 0; i < n; ++i)
            for (Eigen::Index j = 0; j < n; ++j) vandermonde(i, j) = monomial(powers_[j], nodes[i]);
        coefficients_ = vandermonde.inverse();
    }

    /// The functions themselves, by node.
    Eigen::VectorXd values_at(const Vec3& x) const {
        Eigen::RowVectorXd monomials(static_cast<Eigen::Index>(powers_.size()));
        for (std::size_t j = 0; j < powers_.size(); ++j)
            monomials(static_cast<Eigen::Index>(j)) = monomial(powers_[j], x);
        return (monomials * coefficients_).transpose();
    }

    /// 3 x nodes.
    Eigen::Matrix3Xd at(const Vec3& x) const {
        Eigen::Matrix3Xd out = Eigen::Matrix3Xd::Zero(3, coefficients_.cols());
        for (std::size_t j = 0; j < powers_.size(); ++j)
            for (int axis = 0; axis < 3; ++axis)
                if (powers_[j][axis] > 0) {
                    std::array<int, 3> p = powers_[j];
                    --p[axis];
                    out.row(axis) +=
                        powers_[j][axis] * monomial(p, x) * coefficients_.row(static_cast<Eigen::Index>(j));
                }
        return out;
    }

private:
    static double monomial(const std::array<int, 3>& p, const Vec3& x) {
        return std::pow(x.x(), p[0]) * std::pow(x.y(), p[1]) * std::pow(x.z(), p[2]);
    }

    void choose_monomials(CellType type) {
        const CellTraits& t = traits(type);
        const bool tensor = t.corners == 8 || (t.dimension == 2 && t.corners == 4);
        const bool full = type == CellType::quad9 || type == CellType::hexahedron27;
        for (int k = 0; k < 4; ++k)
            for (int j = 0; j < 4; ++j)
                for (int i = 0; i < 4; ++i) {
                    if ((t.dimension < 3 && k > 0) || (t.dimension < 2 && j > 0)) continue;
                    const int order = t.quadratic ? 2 : 1;
                    // Serendipity: total degree counting only exponents above one stays below "order".
                    const int superlinear = (i > 1 ? i : 0) + (j > 1 ? j : 0) + (k > 1 ? k : 0);
                    bool in = false;
                    if (tensor && full)
                        in = std::max({i, j, k}) <= 2;
                    else if (tensor)
                        in = std::max({i, j, k}) <= order && superlinear <= (order == 2 ? 2 : 0);
                    else if (t.corners == 6) {
                        const int ij = i + j;
                        if (type == CellType::wedge18)
                            in = ij <= 2 && k <= 2;
                        else if (order == 1)
                            in = ij <= 1 && k <= 1;
                        else
                            in = (ij <= 2 && k <= 1) || (ij <= 1 && k == 2);
                    } else
                        in = i + j + k <= order;
                    if (in) powers_.push_back({i, j, k});
                }
    }

    std::vector<std::array<int, 3>> powers_;
    Eigen::MatrixXd coefficients_;  // monomials x nodes
};

struct Integrator {
    std::vector<Eigen::VectorXd> values;
    std::vector<Eigen::Matrix3Xd> gradients;
    std::vector<double> weights;
};

const Integrator& integrator(CellType type) {
    static const std::array<Integrator, cell_type_count> all = [] {
        std::array<Integrator, cell_type_count> out;
        for (const CellTraits& t : all_cell_types()) {
            if (t.dimension == 0 || t.corners == 5) continue;
            std::vector<GaussPoint> rule;
            if (t.dimension == 3 && t.corners == 4)
                rule = tetra_rule();
            else if (t.dimension == 2 && t.corners == 3)
                rule = triangle_rule();
            else if (t.corners == 6)
                rule = wedge_rule();
            else
                rule = tensor_rule(t.dimension);
            // The seventh node of a triangle is taken to lie where the other six put it.
            const ShapeGradients shape(t.type == CellType::triangle7 ? CellType::triangle6 : t.type);
            for (const GaussPoint& g : rule) {
                out[static_cast<int>(t.type)].values.push_back(shape.values_at(g.at));
                out[static_cast<int>(t.type)].gradients.push_back(shape.at(g.at));
                out[static_cast<int>(t.type)].weights.push_back(g.weight);
            }
        }
        return out;
    }();
    return all[static_cast<int>(type)];
}

/// Volume of a second-order element with faces of six and eight nodes, by the divergence theorem.
double volume_by_faces(const CellTraits& t, auto at) {
    const Vec3& origin = at(0);
    double sum = 0;
    for (const auto& face : t.faces) {
        const int corners = face[3] < 0 ? 3 : 4;
        std::array<Vec3, 8> nodes;
        for (int k = 0; k < corners; ++k) {
            const std::int8_t a = face[k], b = face[(k + 1) % corners];
            const auto edge = std::ranges::find_if(
                t.edges, [&](const auto& e) { return std::minmax(e[0], e[1]) == std::minmax(a, b); });
            nodes[k] = at(a) - origin;
            nodes[corners + k] = at(t.corners + static_cast<int>(edge - t.edges.begin())) - origin;
        }
        const Integrator& rule = integrator(corners == 3 ? CellType::triangle6 : CellType::quad8);
        for (std::size_t g = 0; g < rule.weights.size(); ++g) {
            Vec3 x = Vec3::Zero(), along = x, across = x;
            for (int k = 0; k < 2 * corners; ++k) {
                x += rule.values[g][k] * nodes[k];
                along += rule.gradients[g](0, k) * nodes[k];
                across += rule.gradients[g](1, k) * nodes[k];
            }
            sum += rule.weights[g] * x.dot(along.cross(across));
        }
    }
    return -sum / 3;  // the faces' normals point into the element
}

/// Volume of an element with straight edges, exact for its shape functions: by the divergence theorem, as quadrangles,
/// on which they are bilinear, cut off as much as their two pairs of triangles do on average.
double straight_volume(const CellTraits& t, auto at) {
    const Vec3& origin = at(0);
    double sum = 0;
    for (const auto& face : t.faces) {
        const Vec3 a = at(face[0]) - origin, b = at(face[1]) - origin, c = at(face[2]) - origin;
        if (face[3] < 0) {
            sum += 2 * a.dot(b.cross(c));
            continue;
        }
        const Vec3 d = at(face[3]) - origin;
        const Vec3 cd = c.cross(d), ab = a.cross(b);
        sum += ab.dot(c) + ab.dot(d) + cd.dot(a) + cd.dot(b);
    }
    return -sum / 12;  // the faces' normals point into the element
}

}  // namespace

namespace {

double squared_edges(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return (b - a).squaredNorm() + (c - a).squaredNorm() + (d - a).squaredNorm() + (c - b).squaredNorm() +
           (d - b).squaredNorm() + (d - c).squaredNorm();
}

}  // namespace

double mean_ratio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double volume = signed_volume(a, b, c, d);
    const double sum = squared_edges(a, b, c, d);
    if (!(sum > 0)) return 0;
    const double size = std::abs(3 * volume);
    return std::copysign(12 * size * inverse_cube_root(size) / sum, volume);
}

bool mean_ratio_below(double limit, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const double six = (b - a).cross(c - a).dot(d - a);
    // Cubed, the mean ratio is 432 (6V)^2 / sum^3. What is clearly above needs no root.
    const double bound = limit * (1 + 1e-9) * squared_edges(a, b, c, d);
    if (six > 0 && 432 * six * six > bound * bound * bound) return false;
    return !(mean_ratio(a, b, c, d) >= limit);
}

double mean_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double twice_area = (b - a).cross(c - a).norm();
    const double sum = (b - a).squaredNorm() + (c - a).squaredNorm() + (c - b).squaredNorm();
    return sum > 0 ? 2 * std::sqrt(3.0) * twice_area / sum : 0;
}

namespace {

/// Whether two corners of a quadrangle turn against the other two; where one does, it has a corner that points inwards.
bool crosses_itself(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const Vec3 normal = (b - a).cross(d - a);
    const int turned = (normal.dot((c - b).cross(a - b)) < 0) + (normal.dot((d - c).cross(b - c)) < 0) +
                       (normal.dot((a - d).cross(c - d)) < 0);
    return turned == 2;
}

}  // namespace

double mean_ratio(const Mesh& mesh, CellType type, Index cell) {
    const CellTraits& t = traits(type);
    const auto n = mesh.block(type).nodes(cell);
    const auto at = [&](int k) -> const Vec3& { return mesh.points[n[k]]; };
    if (t.dimension < 2) return 1;
    if (t.dimension == 3 && t.corners == 4) return mean_ratio(at(0), at(1), at(2), at(3));
    if (t.dimension == 2 && t.corners == 3) return mean_ratio(at(0), at(1), at(2));
    // The value of the regular element's corner: a right corner of the cube, a square, a prism or pyramid.
    double worst = 1;
    if (t.dimension == 2) {
        const double regular = mean_ratio(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
        for (int k = 0; k < 4; ++k)
            worst = std::min(worst, mean_ratio(at(k), at((k + 1) % 4), at((k + 3) % 4)) / regular);
        return crosses_itself(at(0), at(1), at(2), at(3)) ? -worst : worst;
    }
    if (t.corners == 8) {
        static const int corner[8][4] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                         {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};
        const double regular = mean_ratio(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1));
        for (const auto& c : corner)
            worst = std::min(worst, mean_ratio(at(c[0]), at(c[1]), at(c[2]), at(c[3])) / regular);
    } else if (t.corners == 6) {
        static const int corner[6][4] = {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5},
                                         {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}};
        const double h = std::sqrt(3.0) / 2;
        const double regular = mean_ratio(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, h, 0), Vec3(0, 0, 1));
        for (const auto& c : corner)
            worst = std::min(worst, mean_ratio(at(c[0]), at(c[1]), at(c[2]), at(c[3])) / regular);
    } else {
        static const int corner[4][4] = {{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}};
        const double regular = mean_ratio(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0.5, 0.5, std::sqrt(0.5)));
        for (const auto& c : corner)
            worst = std::min(worst, mean_ratio(at(c[0]), at(c[1]), at(c[2]), at(c[3])) / regular);
    }
    return worst;
}

std::vector<double> mean_ratios(const Mesh& mesh, CellType type) {
    std::vector<double> out(static_cast<std::size_t>(mesh.block(type).size()));
    SparseCheck check;
    for (std::size_t c = 0; c < out.size(); ++c, check()) out[c] = mean_ratio(mesh, type, static_cast<Index>(c));
    return out;
}

namespace {

/// `at`: node of an element by its place.
double measure_of(CellType type, auto at) {
    const CellTraits& t = traits(type);
    switch (type) {
        case CellType::vertex:
            return 0;
        case CellType::line:
            return (at(1) - at(0)).norm();
        case CellType::triangle:
            return (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
        case CellType::tetra:
            return signed_volume(at(0), at(1), at(2), at(3));
        case CellType::pyramid13:
            return volume_by_faces(t, at);
        case CellType::pyramid:
        case CellType::wedge:
        case CellType::hexahedron:
            return straight_volume(t, at);
        default:
            break;
    }
    const Integrator& rule = integrator(type);
    double measure = 0;
    for (std::size_t g = 0; g < rule.weights.size(); ++g) {
        Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();  // column a: derivative along reference axis a
        for (int k = 0; k < rule.gradients[g].cols(); ++k) jacobian += at(k) * rule.gradients[g].col(k).transpose();
        if (t.dimension == 3)
            measure += rule.weights[g] * jacobian.determinant();
        else if (t.dimension == 2)
            measure += rule.weights[g] * jacobian.col(0).cross(jacobian.col(1)).norm();
        else
            measure += rule.weights[g] * jacobian.col(0).norm();
    }
    return measure;
}

}  // namespace

double cell_measure(const Mesh& mesh, CellType type, Index cell) {
    const auto n = mesh.block(type).nodes(cell);
    return measure_of(type, [&](int k) -> const Vec3& { return mesh.points[n[k]]; });
}

double cell_measure(CellType type, std::span<const Vec3> nodes) {
    return measure_of(type, [&](int k) -> const Vec3& { return nodes[k]; });
}

}  // namespace femscalpel
