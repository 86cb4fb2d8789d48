// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fields/reference_element.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace femscalpel {
namespace {

/// Corners of the reference elements, in our order.
std::vector<Vec3> reference_corners(CellType linear) {
    switch (linear) {
        case CellType::vertex:
            return {Vec3::Zero()};
        case CellType::line:
            return {{-1, 0, 0}, {1, 0, 0}};
        case CellType::triangle:
            return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
        case CellType::quad:
            return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
        case CellType::tetra:
            return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        case CellType::pyramid:
            return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
        case CellType::wedge:
            return {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
        default:
            return {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
    }
}

/// Corners whose middles the nodes in faces and in the volume are, in the order of the nodes.
std::vector<std::vector<int>> middle_corners(CellType type) {
    switch (type) {
        case CellType::triangle7:
            return {{0, 1, 2}};
        case CellType::quad9:
            return {{0, 1, 2, 3}};
        case CellType::wedge18:
            return {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
        case CellType::hexahedron27:
            return {{0, 3, 7, 4},
                    {1, 2, 6, 5},
                    {0, 1, 5, 4},
                    {3, 2, 6, 7},
                    {0, 1, 2, 3},
                    {4, 5, 6, 7},
                    {0, 1, 2, 3, 4, 5, 6, 7}};
        default:
            return {};
    }
}

double power(double x, int n) {
    double out = 1;
    for (int k = 0; k < n; ++k) out *= x;
    return out;
}

}  // namespace

ReferenceElement::ReferenceElement(CellType type) {
    const CellTraits& t = traits(type);
    std::vector<Vec3> at = reference_corners(t.linear);
    if (t.quadratic)
        for (const auto& e : t.edges) at.push_back((at[e[0]] + at[e[1]]) / 2);
    for (const std::vector<int>& corners : middle_corners(type)) {
        Vec3 sum = Vec3::Zero();
        for (const int c : corners) sum += at[c];
        at.push_back(sum / static_cast<double>(corners.size()));
    }
    nodes_.resize(t.dimension, t.nodes);
    for (int k = 0; k < t.nodes; ++k) nodes_.col(k) = at[static_cast<std::size_t>(k)].head(t.dimension);

    const int order = t.quadratic ? 2 : 1;
    const auto add_all = [&](auto wanted) {
        for (int c = 0; c <= (t.dimension > 2 ? 2 : 0); ++c)
            for (int b = 0; b <= (t.dimension > 1 ? 2 : 0); ++b)
                for (int a = 0; a <= (t.dimension > 0 ? 2 : 0); ++a)
                    if (wanted(a, b, c)) terms_.push_back({a, b, c, 0});
    };
    if (t.linear == CellType::pyramid) {
        form_ = Form::pyramid;
        add_all([&](int a, int b, int c) { return a + b + c <= order; });
        if (order == 1)
            terms_.push_back({1, 1, 0, 1});
        else
            for (const Term& term : {Term{2, 1, 0, 1}, Term{1, 2, 0, 1}, Term{1, 1, 1, 1}}) terms_.push_back(term);
    } else if (t.linear == CellType::wedge) {
        form_ = Form::prism;
        const bool full = type == CellType::wedge18;
        add_all([&](int a, int b, int c) {
            return a + b <= order && c <= order && (full || order == 1 || a + b < 2 || c < 2);
        });
    } else if (t.linear == CellType::line || t.linear == CellType::quad || t.linear == CellType::hexahedron) {
        form_ = Form::product;
        const bool full = type == CellType::quad9 || type == CellType::hexahedron27 || type == CellType::line3;
        // Of the products of second order only those with one square, where there are no nodes inside.
        add_all([&](int a, int b, int c) {
            return std::max({a, b, c}) <= order && (full || order == 1 || (a == 2) + (b == 2) + (c == 2) <= 1);
        });
    } else {
        add_all([&](int a, int b, int c) { return a + b + c <= order; });
        if (type == CellType::triangle7) {
            // The bubble x y (1 - x - y), of whose parts the first is one of the terms already.
            terms_.push_back({1, 1, 1, 0});
        }
    }
    Eigen::MatrixXd all(t.nodes, std::ssize(terms_));
    for (int k = 0; k < t.nodes; ++k) all.row(k) = terms(nodes_.col(k));
    coefficients_ = all.fullPivLu().inverse();
}

const ReferenceElement& ReferenceElement::of(CellType type) {
    static const auto all = [] {
        std::array<std::unique_ptr<const ReferenceElement>, cell_type_count> out;
        for (const CellTraits& t : all_cell_types())
            out[static_cast<std::size_t>(t.type)].reset(new ReferenceElement(t.type));
        return out;
    }();
    return *all[static_cast<std::size_t>(type)];
}

// In a triangle the third coordinate stands for that of the third corner, x0 = 1 - x - y, which makes bubbles products.
Eigen::VectorXd ReferenceElement::terms(const Eigen::VectorXd& at) const {
    const double x = at.size() > 0 ? at[0] : 0, y = at.size() > 1 ? at[1] : 0;
    const double z = at.size() > 2 ? at[2] : 1 - x - y;
    // At the tip the products over 1 - z are 0 on every way to it that stays inside.
    const double over = form_ == Form::pyramid && z != 1 ? 1 / (1 - z) : 0;
    Eigen::VectorXd out(std::ssize(terms_));
    for (std::size_t k = 0; k < terms_.size(); ++k) {
        const Term& t = terms_[k];
        out[static_cast<Eigen::Index>(k)] = power(x, t.a) * power(y, t.b) * power(z, t.c) * power(over, t.d);
    }
    return out;
}

Eigen::MatrixXd ReferenceElement::term_derivatives(const Eigen::VectorXd& at) const {
    const Eigen::Index n = at.size();
    const double x = n > 0 ? at[0] : 0, y = n > 1 ? at[1] : 0, z = n > 2 ? at[2] : 1 - x - y;
    const double over = form_ == Form::pyramid && z != 1 ? 1 / (1 - z) : 0;
    const auto slope = [](double v, int e) { return e == 0 ? 0. : e * power(v, e - 1); };
    Eigen::MatrixXd out(std::ssize(terms_), n);
    for (std::size_t k = 0; k < terms_.size(); ++k) {
        const Term& t = terms_[k];
        const double px = power(x, t.a), py = power(y, t.b), pz = power(z, t.c), po = power(over, t.d);
        const double dz = (slope(z, t.c) + t.d * over * pz) * px * py * po;
        const auto row = static_cast<Eigen::Index>(k);
        if (n > 0) out(row, 0) = slope(x, t.a) * py * pz * po - (n == 2 ? dz : 0);
        if (n > 1) out(row, 1) = px * slope(y, t.b) * pz * po - (n == 2 ? dz : 0);
        if (n > 2) out(row, 2) = dz;
    }
    return out;
}

Eigen::VectorXd ReferenceElement::values(const Eigen::VectorXd& at) const {
    return coefficients_.transpose() * terms(at);
}

Eigen::MatrixXd ReferenceElement::derivatives(const Eigen::VectorXd& at) const {
    return coefficients_.transpose() * term_derivatives(at);
}

double ReferenceElement::inside(const Eigen::VectorXd& at) const {
    const auto within = [](double x) { return (1 - std::abs(x)) / 2; };
    double out = 1;
    switch (form_) {
        case Form::simplex:
            for (const double x : at) out = std::min(out, x);
            return std::min(out, 1 - at.sum());
        case Form::product:
            for (const double x : at) out = std::min(out, within(x));
            return out;
        case Form::prism:
            return std::min({at[0], at[1], 1 - at[0] - at[1], within(at[2])});
        default:
            return std::min({at[2], (1 - at[2] - std::abs(at[0])) / 2, (1 - at[2] - std::abs(at[1])) / 2});
    }
}

Eigen::VectorXd ReferenceElement::clamped(Eigen::VectorXd at) const {
    const auto into_simplex = [](auto part) {
        for (double& x : part) x = std::clamp(x, 0., 1.);
        if (const double sum = part.sum(); sum > 1) part /= sum;
    };
    switch (form_) {
        case Form::simplex:
            into_simplex(at.head(at.size()));
            break;
        case Form::product:
            for (double& x : at) x = std::clamp(x, -1., 1.);
            break;
        case Form::prism:
            into_simplex(at.head(2));
            at[2] = std::clamp(at[2], -1., 1.);
            break;
        default:
            at[2] = std::clamp(at[2], 0., 1.);
            for (int k = 0; k < 2; ++k) at[k] = std::clamp(at[k], at[2] - 1, 1 - at[2]);
    }
    return at;
}

namespace {

Eigen::MatrixXd places(const Mesh& mesh, std::span<const Index> nodes) {
    Eigen::MatrixXd out(3, std::ssize(nodes));
    for (std::size_t k = 0; k < nodes.size(); ++k) out.col(static_cast<Eigen::Index>(k)) = mesh.points[nodes[k]];
    return out;
}

/// Newton's method from `at` on; false where it does not end.
bool find_foot(const ReferenceElement& element, const Eigen::MatrixXd& nodes, const Vec3& point, Eigen::VectorXd& at) {
    constexpr int most_steps = 50;
    constexpr double far_off = 1e3;
    for (int step = 0; step < most_steps; ++step) {
        const Eigen::MatrixXd slopes = nodes * element.derivatives(at);
        const Vec3 off = point - Vec3(nodes * element.values(at));
        const auto solver = slopes.colPivHouseholderQr();
        if (solver.rank() < slopes.cols()) return false;
        const Eigen::VectorXd way = solver.solve(off);
        at += way;
        if (!(at.norm() < far_off)) return false;
        if (way.norm() < 1e-14) return true;
    }
    // Rounding alone keeps it from standing still.
    const Eigen::MatrixXd slopes = nodes * element.derivatives(at);
    const Vec3 off = point - Vec3(nodes * element.values(at));
    return Eigen::VectorXd(slopes.colPivHouseholderQr().solve(off)).norm() < 1e-10;
}

/// In a simplex of first order, whose corners are at 0 and 1: false if it has no size.
template <int dimension>
bool find_in_simplex(const Mesh& mesh, std::span<const Index> nodes, const Vec3& point, InElement& out) {
    using Edges = Eigen::Matrix<double, 3, dimension>;
    Edges edges;
    for (int k = 0; k < dimension; ++k) edges.col(k) = mesh.points[nodes[k + 1]] - mesh.points[nodes[0]];
    const Vec3 way = point - mesh.points[nodes[0]];
    const Eigen::ColPivHouseholderQR<Edges> solver(edges);
    if (solver.rank() < dimension) return false;
    Eigen::Matrix<double, dimension, 1> at = solver.solve(way);
    at += solver.solve(way - edges * at);
    if (!at.allFinite()) return false;
    out.at = at;
    out.cornered.resize(dimension + 1);
    out.cornered << 1 - at.sum(), at;
    out.inside = std::min(1.0, out.cornered.minCoeff());
    out.shares = out.cornered;
    return true;
}

}  // namespace

std::optional<InElement> find_in_element(const Mesh& mesh, CellRef cell, const Vec3& point) {
    const CellTraits& t = traits(cell.type);
    if (t.dimension == 0) return {};
    const auto numbers = mesh.block(cell.type).nodes(cell.cell);
    InElement out;
    const bool tetra = t.linear == CellType::tetra, simplex = tetra || t.linear == CellType::triangle;
    if (simplex) {
        if (!(tetra ? find_in_simplex<3>(mesh, numbers, point, out) : find_in_simplex<2>(mesh, numbers, point, out)))
            return {};
        if (t.nodes == t.corners) return out;
    }
    const ReferenceElement& element = ReferenceElement::of(cell.type);
    const Eigen::MatrixXd nodes = places(mesh, numbers);
    Eigen::VectorXd at;
    if (!simplex) {
        const ReferenceElement& straight = ReferenceElement::of(t.linear);
        at = straight.nodes().rowwise().mean();
        if (!find_foot(straight, nodes.leftCols(t.corners), point, at)) return {};
        out.cornered = straight.values(at);
        out.at = at;
    }
    at = out.at;
    if (t.nodes > t.corners && find_foot(element, nodes, point, at)) out.at = at;
    out.inside = element.inside(out.at);
    out.shares = element.values(out.at);
    return out;
}

InElement held_inside(const InElement& found, CellType type) {
    const CellTraits& t = traits(type);
    InElement out;
    out.at = ReferenceElement::of(type).clamped(found.at);
    out.inside = found.inside;
    out.shares = ReferenceElement::of(type).values(out.at);
    out.cornered = ReferenceElement::of(t.linear).values(out.at);
    return out;
}

}  // namespace femscalpel
