// SPDX-License-Identifier: LGPL-2.1-or-later
#include "crack_geometry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace femscalpel::checks {
namespace {

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

}  // namespace

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

}  // namespace femscalpel::checks
