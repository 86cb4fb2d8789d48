// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deformation/fitted_tool.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "tools/cylinder.h"
#include "tools/plane.h"
#include "tools/sphere.h"

namespace femscalpel {
namespace {

/// Fewer points than these fit anything.
constexpr std::size_t enough_for_cylinder = 8, enough_for_sphere = 7;

Vec3 mean_of(std::span<const Vec3> points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) sum += p;
    return sum / static_cast<double>(points.size());
}

/// `normal` is that of the plane where all points are on one line.
std::unique_ptr<Tool> fitted_plane(std::span<const Vec3> points, Vec3 normal, double tolerance,
                                   const Similarity& moved) {
    const Vec3 origin = mean_of(points);
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vec3& p : points) spread += (p - origin) * (p - origin).transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    if (axes.eigenvalues()[1] > 1e-6 * axes.eigenvalues()[2]) normal = axes.eigenvectors().col(0);
    for (const Vec3& p : points)
        if (std::abs(normal.dot(p - origin)) > tolerance) return nullptr;
    return std::make_unique<Plane>(moved(origin), normal);
}

std::unique_ptr<Tool> fitted_sphere(std::span<const Vec3> points, double tolerance, const Similarity& moved) {
    if (points.size() < enough_for_sphere) return nullptr;
    const Vec3 middle = mean_of(points);
    Eigen::MatrixXd a(points.size(), 4);
    Eigen::VectorXd b(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec3 p = points[k] - middle;
        a.row(static_cast<Eigen::Index>(k)) << 2 * p.transpose(), 1;
        b[static_cast<Eigen::Index>(k)] = p.squaredNorm();
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
    if (qr.rank() < 4) return nullptr;
    const Eigen::Vector4d x = qr.solve(b);
    const Vec3 centre = middle + x.head<3>();
    const double radius = std::sqrt(std::max(0.0, x[3] + x.head<3>().squaredNorm()));
    for (const Vec3& p : points)
        if (!(std::abs((p - centre).norm() - radius) <= tolerance)) return nullptr;
    return std::make_unique<Sphere>(moved(centre), moved.factor * radius);
}

/// A cylinder that is being fitted.
struct Round {
    Vec3 origin, axis;
    double radius = 0;

    Vec3 from_axis(const Vec3& p) const { return p - origin - axis * axis.dot(p - origin); }

    /// One step towards the least sum of squared distances; false when it cannot be told.
    bool improve(std::span<const Vec3> points) {
        const Vec3 u = axis.unitOrthogonal(), v = axis.cross(u);
        Eigen::MatrixXd a(points.size(), 5);
        Eigen::VectorXd b(points.size());
        for (std::size_t k = 0; k < points.size(); ++k) {
            const Vec3 r = from_axis(points[k]);
            const double length = r.norm(), along = axis.dot(points[k] - origin);
            if (!(length > 0)) return false;
            const double cu = r.dot(u) / length, cv = r.dot(v) / length;
            a.row(static_cast<Eigen::Index>(k)) << -cu, -cv, -cu * along, -cv * along, -1;
            b[static_cast<Eigen::Index>(k)] = radius - length;
        }
        const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
        if (qr.rank() < 5) return false;
        const Eigen::VectorXd step = qr.solve(b);
        origin += step[0] * u + step[1] * v;
        axis = (axis + step[2] * u + step[3] * v).normalized();
        radius += step[4];
        return step.allFinite();
    }
};

std::unique_ptr<Tool> fitted_cylinder(std::span<const Vec3> points, const Vec3& axis, double tolerance,
                                      const Similarity& moved) {
    if (points.size() < enough_for_cylinder) return nullptr;
    // The circle through the points seen along the axis.
    const Vec3 middle = mean_of(points), u = axis.unitOrthogonal(), v = axis.cross(u);
    Eigen::MatrixXd a(points.size(), 3);
    Eigen::VectorXd b(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        const double x = u.dot(points[k] - middle), y = v.dot(points[k] - middle);
        a.row(static_cast<Eigen::Index>(k)) << 2 * x, 2 * y, 1;
        b[static_cast<Eigen::Index>(k)] = x * x + y * y;
    }
    const Eigen::Vector3d circle = a.colPivHouseholderQr().solve(b);
    Round round{middle + circle[0] * u + circle[1] * v, axis,
                std::sqrt(std::max(0.0, circle[2] + circle.head<2>().squaredNorm()))};
    const auto off = [&] {
        double largest = 0;
        for (const Vec3& p : points) largest = std::max(largest, std::abs(round.from_axis(p).norm() - round.radius));
        return largest;
    };
    for (int k = 0; k < 30 && off() > 1e-3 * tolerance; ++k)
        if (!round.improve(points)) break;
    if (!(off() <= tolerance) || !(round.radius > 10 * tolerance)) return nullptr;
    return std::make_unique<Cylinder>(moved(round.origin), round.axis, moved.factor * round.radius);
}

}  // namespace

std::unique_ptr<Tool> fitted_tool(std::span<const Vec3> given, std::span<const Vec3> normals, double tolerance,
                                  const Similarity& moved) {
    if (given.empty() || normals.empty()) return nullptr;
    std::vector<Vec3> points(given.begin(), given.end());
    std::ranges::sort(
        points, [](const Vec3& a, const Vec3& b) { return std::tie(a[0], a[1], a[2]) < std::tie(b[0], b[1], b[2]); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const Vec3& n : normals) spread += n * n.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
    if (auto plane = fitted_plane(points, axes.eigenvectors().col(2), tolerance, moved)) return plane;
    if (auto cylinder = fitted_cylinder(points, axes.eigenvectors().col(0), tolerance, moved)) return cylinder;
    return fitted_sphere(points, tolerance, moved);
}

}  // namespace femscalpel
