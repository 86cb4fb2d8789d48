// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/fillet_vertex.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "operators/coordinate_slack.h"

namespace femscalpel {
namespace {

[[noreturn]] void refuse(const Vec3& at, const std::string& text) {
    std::ostringstream message;
    message << "along: edges meet at (" << at.transpose() << "), " << text;
    throw ToolError(message.str(), "along");
}

/// Of faces at a node: those of one plane once.
struct Planes {
    std::vector<Vec3> normals;
    std::vector<double> off;  // by how much they may be off, in radians
};

Planes planes_at(const Mesh& mesh, Index node, const std::vector<std::array<Index, 3>>& around,
                 const SkinPlanes* known) {
    const CoordinateSlack slack(mesh);
    Planes out;
    auto& [normals, offs] = out;
    for (const auto& f : around) {
        const Vec3 &a = mesh.points[f[0]], &b = mesh.points[f[1]], &c = mesh.points[f[2]];
        const auto plane = known ? known->of(f) : std::nullopt;
        const Vec3 n = plane ? plane->normal : (b - a).cross(c - a).normalized();
        const double off = plane ? 0 : slack.normal(a, b, c);
        std::size_t k = 0;
        while (k < normals.size() && (normals[k] - n).norm() >= 1e-3 + off + offs[k]) ++k;
        if (k == normals.size()) {
            normals.push_back(n);
            offs.push_back(off);
        } else if (off < offs[k]) {
            normals[k] = n;
            offs[k] = off;
        }
        if (normals.size() > 3)
            refuse(mesh.points[node],
                   "where more than three faces do, or one that is not plane; only corners of "
                   "three plane faces are rounded. Round the edges one after the other");
    }
    if (normals.size() < 3) refuse(mesh.points[node], "where there are less than three faces");
    return out;
}

}  // namespace

std::vector<FilletVertex> find_vertices(const Mesh& mesh, std::span<const FeatureLine> lines,
                                        const std::vector<std::array<Index, 3>>& skin, const SkinPlanes* planes) {
    std::map<Index, std::vector<FilletVertex::Member>> ends;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        if (lines[k].closed) continue;
        ends[lines[k].nodes.front()].push_back({k, 0});
        ends[lines[k].nodes.back()].push_back({k, 1});
    }
    std::erase_if(ends, [](const auto& end) { return end.second.size() < 2; });
    std::map<Index, std::vector<std::array<Index, 3>>> around;
    for (const auto& f : skin)
        for (const Index n : f)
            if (ends.contains(n)) around[n].push_back(f);
    const CoordinateSlack slack(mesh);
    std::vector<FilletVertex> out;
    for (auto& [node, members] : ends) {
        const Planes found = planes_at(mesh, node, around[node], planes);
        Eigen::Matrix3d faces;
        for (int k = 0; k < 3; ++k) faces.row(k) = found.normals[k];
        if (std::abs(faces.determinant()) < 0.1)
            refuse(mesh.points[node], "where the faces are too nearly in one plane for a ball to touch all three");
        if (members.size() > 3) refuse(mesh.points[node], "more than three");
        const Vec3 to_centre = faces.inverse() * Vec3::Ones();
        // Planes that are known are off by less than what triangles tell of them.
        double off = 1e-6;
        for (const auto& f : around[node])
            off = std::max(off, 1e-6 + 2 * slack.normal(mesh.points[f[0]], mesh.points[f[1]], mesh.points[f[2]]));
        const bool right_angled =
            (faces * faces.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= off;
        out.push_back({mesh.points[node], to_centre, std::move(members), right_angled});
    }
    return out;
}

void FilletVertex::join(const std::vector<const FilletPath*>& paths) {
    std::vector<Vec3> away;
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    Vec3 right = Vec3::Zero();
    const FilletPath& first = *paths[members[0].edge];
    for (const auto& [edge, which] : members) {
        const FilletPath& path = *paths[edge];
        if (path.convex() != first.convex())
            refuse(at, "a convex and a concave one: these cannot be rounded at once. Round one after the other");
        const Vec3 begin = path.at(path.begin(), path.centre()), end = path.at(path.end(), path.centre());
        away.push_back((which == 0 ? end - begin : begin - end).normalized());
        const Eigen::Matrix3d off = Eigen::Matrix3d::Identity() - away.back() * away.back().transpose();
        sum += off;
        right += off * begin;
    }
    centre = sum.inverse() * right;
    if (!is_mitre()) {
        across = away;
        sphere = std::make_shared<Sphere>(centre, first.radius());
        return;
    }
    const FilletPath& second = *paths[members[1].edge];
    if (std::abs(first.arc_angle() - second.arc_angle()) > 1e-6 + 2 * (first.face_slack() + second.face_slack()))
        refuse(at,
               "between faces at different angles, and the third edge there is not rounded: the two do not meet in "
               "a plane. Round all three, or one after the other");
    const Vec3 normal = (away[0] - away[1]).normalized();
    across = {normal, normal};
}

}  // namespace femscalpel
