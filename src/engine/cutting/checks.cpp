// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/checks.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <sstream>

#include "cancel.h"
#include "cutting/folded_input.h"
#include "cutting/mend_curved.h"
#include "deformation/curved_shape.h"
#include "mesh/quality.h"
#include "words.h"

namespace femscalpel {
namespace {

struct Bad {
    Index id;
    double quality;
};

/// Elements of the band worse than `limit`, by number.
std::vector<Bad> worse_than(double limit, const Workpiece& f, const Mesh& mesh) {
    std::vector<Bad> bad;
    const auto note = [&](const CellRef& c, double q) { bad.push_back({mesh.block(c.type).ids[c.cell], q}); };
    const BandMesh& band = f.d.band;
    check_cancelled();
    for (int t = 0; t < band.tetras.size(); ++t)
        if (band.tetras.alive(t) && tetra_is_below(limit, f.d, t))
            note(band.tetra_cells[band.tetras.origin(t)], tetra_quality(f.d, t));
    for (int t = 0; t < band.triangles.size(); ++t) {
        if (!band.triangles.alive(t) || !f.d.constraints.is_shell(band.triangles.origin(t))) continue;
        if (const double q = shell_quality(f.d, t); !(q >= limit))
            note(band.triangle_cells[band.triangles.origin(t)], q);
    }
    std::ranges::sort(bad, {}, [](const Bad& b) { return std::pair(b.id, b.quality); });
    return bad;
}

std::string name_them(const std::vector<Bad>& bad) {
    std::ostringstream text;
    text << (bad.size() == 1 ? "element" : "elements");
    for (std::size_t k = 0; k < bad.size() && k < 5; ++k) text << (k ? ", " : " ") << bad[k].id;
    if (bad.size() > 5) text << ", ...";
    return text.str();
}

/// Mean ratio below which an element counts as flat.
constexpr double flat = 1e-6;

}  // namespace

void check_contacts(const Workpiece& f) {
    int count = 0;
    double worst = 0;
    for (const int v : f.nodes) {
        const double off = f.d.off_tools(v);
        count += off > 10 * f.tolerance;
        worst = std::max(worst, off);
    }
    if (count == 0) return;
    std::ostringstream message;
    message << counted(count, "node") << " cannot be brought onto the " << f.tool->kind() << " (off by up to " << worst
            << "): the mesh is too coarse for it there. Refine the mesh near the tool first";
    throw QualityError(message.str());
}

void check_extent(const Mesh& mesh) {
    if (mesh.points.empty()) return;
    // Squares of volumes are to be numbers, too.
    constexpr double smallest = 1e-30, largest = 1e30;
    // Times the size of the mesh: beyond, coordinates are rounded by more than what counts as the same place.
    constexpr double farthest = 4e6;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Vec3& x : mesh.points) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    const double size = (high - low).stableNorm(),
                 off = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    std::ostringstream message;
    if (size > 0 && (size < smallest || off > largest))
        message << "the mesh is " << size << " across, with coordinates up to " << off << ": lengths must be between "
                << smallest << " and " << largest << " to be computed with. Give it in another unit";
    else if (size > 0 && off > farthest * size)
        message << "the mesh is " << size << " across, but has coordinates up to " << off
                << ", which double precision rounds by up to " << off * std::numeric_limits<double>::epsilon() / 2
                << ": too much for its elements. Move it to the origin first";
    else
        return;
    throw QualityError(message.str(), "mesh");
}

void check_input_shape(Workpiece& f, const Mesh& mesh) {
    const std::vector<Bad> poor = worse_than(0.1, f, mesh);
    std::vector<Bad> bad;
    std::ranges::copy_if(poor, std::back_inserter(bad), [](const Bad& b) { return !(b.quality >= flat); });
    if (!bad.empty())
        throw QualityError("the mesh already has " +
                           counted(static_cast<Index>(bad.size()), "flat or inverted element") + " near the tool (" +
                           name_them(bad) + "); repair the mesh first");
    find_folded_input(f, mesh);
    mend_folded_input(f);
    if (!poor.empty())
        f.warnings.push_back("the mesh already has " + counted(static_cast<Index>(poor.size()), "element") +
                             " with mean ratio below 0.1 near the tool (" + name_them(poor) + ")");
}

std::optional<Vec3> double_nodes(const Mesh& mesh, const Eigen::AlignedBox3d& box, const Vec3& near) {
    std::set<std::array<double, 3>> places;
    std::optional<Vec3> out;
    for (const Vec3& x : mesh.points)
        if (box.contains(x) && !places.insert({x[0], x[1], x[2]}).second &&
            (!out || (x - near).norm() < (*out - near).norm()))
            out = x;
    return out;
}

void check_skin(Workpiece& f) {
    const NodeConstraints::ShapeMatch& match = f.d.constraints.shape_match();
    if (match.off == 0) return;
    if (match.off == match.faces)
        throw ToolError(
            "skin: none of the " + std::to_string(match.faces) +
                " faces of the mesh's skin near the tool lies on the shape; it is not the shape the mesh was "
                "made from, or has another place or unit",
            "skin");
    f.warnings.push_back(std::to_string(match.off) + " of " + std::to_string(match.faces) +
                         " faces of the mesh's skin near the tool lie on no face of the given shape; there the skin "
                         "stays what its triangles are");
}

void check_shape(const Workpiece& f, const Mesh& mesh) {
    const std::vector<Bad> bad = worse_than(flat, f, mesh);
    if (!bad.empty())
        throw QualityError(counted(static_cast<Index>(bad.size()), "element") + " would be flat or inverted (" +
                           name_them(bad) +
                           "): the tool passes too close to a corner or crease there. Move it a little");
    const std::vector<BandElement> elements = newly_folded(f, folded_elements(f, 0));
    check_folded_input(f, elements);
    std::vector<Bad> folded;
    for (const BandElement e : elements) {
        const CellRef& c = e.cell(f.d.band);
        folded.push_back({mesh.block(c.type).ids[c.cell], 0});
    }
    if (!folded.empty())
        throw QualityError(
            counted(static_cast<Index>(folded.size()), "second-order element") + " would be folded (" +
            name_them(folded) +
            "): the mesh is too coarse for its curvature there. Move the tool a little, or refine the mesh");
}

}  // namespace femscalpel
