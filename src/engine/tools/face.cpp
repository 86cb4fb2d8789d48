// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tools/face.h"

#include <Standard_Failure.hxx>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "error.h"
#include "tools/cad_file.h"
#include "tools/face_border.h"
#include "tools/face_surface.h"

namespace femscalpel {

struct Face::Geometry {
    FaceSurface surface;
    FaceBorder border;

    explicit Geometry(const TopoDS_Shape& shape) : surface(shape), border(shape, surface.size()) {}

    /// Signed distance from a point on the surface to the chains that count; positive beyond them.
    double beyond(const FacePlace& foot, const ChainSet& counted) const {
        const FaceBorder::Foot closest = border.foot(foot, counted);
        const double out = closest.beyond(foot.at);
        if (out >= 0 || !counted.has(border.foot(foot, ChainSet::all()).chain)) return out;
        // Far round a curved surface directions do not tell. What is inside is on the picture, too.
        return surface.is_off_picture(foot.at) ? -out : out;
    }
};

/// The surface that stands on a face along a chain of its border.
class Face::Side final : public Tool {
public:
    Side(std::shared_ptr<const Geometry> geometry, int chain) : geometry_(std::move(geometry)), chain_(chain) {}

    std::string kind() const override { return "face border"; }
    double distance(const Eigen::Vector3d& x) const override {
        const FaceSurface& surface = geometry_->surface;
        if (surface.is_far(x)) return surface.box().exteriorDistance(x);
        const FacePlace foot = surface.level_foot(x);
        const FaceBorder::Foot to = closest(foot);
        return (to.at - foot.at).dot(to.left.normalized());
    }
    Eigen::Vector3d normal(const Eigen::Vector3d& x) const override {
        return -closest(geometry_->surface.level_foot(x)).left.normalized();
    }
    double feature_size() const override { return geometry_->border.chains()[chain_].least_radius; }

private:
    FaceBorder::Foot closest(const FacePlace& foot) const {
        return geometry_->border.foot(foot, ChainSet::only(chain_));
    }
    std::shared_ptr<const Geometry> geometry_;
    int chain_;
};

Face::Face(std::shared_ptr<const Geometry> geometry) : geometry_(std::move(geometry)) {}
Face::~Face() = default;

Face Face::read(const std::filesystem::path& path) {
    try {
        return from_shape(read_cad_file(path));
    } catch (const Standard_Failure& e) {
        throw ReadError("'" + path.string() + "': OpenCASCADE says: " + e.GetMessageString(), "source");
    }
}

Face Face::from_brep(const std::string& text) {
    try {
        return from_shape(shape_from_brep(text, "face"));
    } catch (const Standard_Failure& e) {
        throw ToolError(std::string("face: OpenCASCADE says: ") + e.GetMessageString(), "source");
    }
}

Face Face::from_shape(const TopoDS_Shape& shape) { return Face(std::make_shared<const Geometry>(shape)); }

double Face::distance(const Eigen::Vector3d& x) const {
    const FaceSurface& s = geometry_->surface;
    if (s.is_far(x)) return std::copysign(s.box().exteriorDistance(x), s.mean_normal().dot(x - s.box().center()));
    const FacePlace foot = s.foot(x);
    return foot.normal.dot(x - foot.at);
}

Eigen::Vector3d Face::normal(const Eigen::Vector3d& x) const { return geometry_->surface.foot(x).normal; }

Eigen::Vector3d Face::project(const Eigen::Vector3d& x) const {
    const FacePlace foot = geometry_->surface.foot(x);
    return x - foot.normal.dot(x - foot.at) * foot.normal;
}

double Face::feature_size() const { return geometry_->surface.feature_size(); }

bool Face::bounded() const { return !geometry_->border.empty(); }

double Face::beyond(const Eigen::Vector3d& x) const {
    if (!bounded()) return -std::numeric_limits<double>::infinity();
    const FaceSurface& s = geometry_->surface;
    if (s.is_far(x)) return s.box().exteriorDistance(x);
    return geometry_->beyond(s.level_foot(x), ChainSet::all());
}

std::vector<int> Face::chains_before(const Eigen::Vector3d& x, double clearance) const {
    const FaceBorder& border = geometry_->border;
    const FacePlace foot = geometry_->surface.level_foot(x);
    const FaceBorder::Foot nearest = border.foot(foot, ChainSet::all());
    std::vector<int> there{nearest.chain}, out;
    for (const FaceBorder::Joint& j : border.joints())
        if ((j.at - nearest.at).norm() <= 1e-6 * geometry_->surface.size())
            there.insert(there.end(), {j.before, j.after});
    std::ranges::sort(there);
    there.erase(std::unique(there.begin(), there.end()), there.end());
    for (const int c : there)
        if (border.foot(foot, ChainSet::only(c)).beyond(foot.at) > clearance) out.push_back(c);
    return out;
}

Patch Face::within(const std::vector<int>& chains) const {
    Patch patch;
    std::vector<char> counts(geometry_->border.chains().size(), 0);
    for (const int c : chains) counts[c] = 1;
    std::vector<int> side_of(counts.size(), -1);
    for (const int c : chains) {
        side_of[c] = static_cast<int>(patch.sides.size());
        patch.sides.push_back(std::make_unique<Side>(geometry_, c));
        patch.feature_size = std::min(patch.feature_size, patch.sides.back()->feature_size());
    }
    for (const FaceBorder::Joint& j : geometry_->border.joints()) {
        if (!counts[j.before] || !counts[j.after]) continue;
        if (j.before == j.after) {
            std::ostringstream message;
            message << "face: its border has a single corner, at (" << j.at.transpose()
                    << "). Divide the edge there into two, so that the corner is between two edges";
            throw ToolError(message.str(), "tool");
        }
        patch.corners.push_back({j.at, {side_of[j.before], side_of[j.after]}});
    }
    const ChainSet counted = ChainSet::marked(counts);
    patch.distance = [g = geometry_, counted](const Eigen::Vector3d& x) {
        if (g->surface.is_far(x)) return g->surface.box().exteriorDistance(x);
        return g->beyond(g->surface.level_foot(x), counted);
    };
    patch.side = [g = geometry_, counted, side_of](const Eigen::Vector3d& x) {
        return side_of[g->border.foot(g->surface.level_foot(x), counted).chain];
    };
    return patch;
}

int Face::face_count() const { return geometry_->surface.face_count(); }

}  // namespace femscalpel
