// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/merge_refining.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "cutting/locate.h"
#include "deck/carry_over.h"
#include "operators/joint.h"
#include "operators/simplify_first.h"
#include "tools/ribbon.h"

namespace femscalpel {
namespace {

/// And no longer than this part of a closed line.
constexpr double of_length = 0.12;
/// What a mesh may become whatever its growth.
constexpr Index few_elements = 20'000;

/// A refinement passes its bound; no Error, which refine_first() would make a warning of.
class TooMany final : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// There is no tool here but two meshes; how much finer is told without advice, which would be about a tool.
void speak_of_meshes(std::string& warning, std::size_t m) {
    const std::string tool = "the tool is finer than the mesh", option = " elements. refine=";
    const std::size_t end = warning.find(option);
    if (!warning.starts_with(tool) || end == std::string::npos) return;
    const std::string finer = m == 0 ? "the addition is finer than the mesh" : "the mesh is finer than the addition";
    warning = finer + warning.substr(tool.size(), end + 9 - tool.size());
    if (const std::size_t near = warning.find("near the tool"); near != std::string::npos)
        warning.replace(near, 13, "where they meet");
}

}  // namespace

MergeRefining::MergeRefining(const Mesh& mesh, const Mesh& addition, const OperatorOptions& options)
    : meshes_{&mesh, &addition}, options_(options) {
    // Elements are divided to fit each other.
    options_.skin = nullptr;
}

/// Where the meshes meet. The zones refer to the ribbons.
std::vector<RefineZone> MergeRefining::zones(const std::vector<MeetingLine>& meeting, std::size_t m, double longer,
                                             std::vector<std::unique_ptr<Ribbon>>& ribbons) const {
    std::vector<RefineZone> out;
    if (options_.refine.when == RefineFirst::When::never) return out;
    for (const MeetingLine& line : meeting) {
        double sum = 0;
        for (const MeetingLine::Point& p : line.points) sum += p.size[1 - m];
        ribbons.push_back(ribbon_of(line, m));
        const Ribbon& ribbon = *ribbons.back();
        const double automatic = std::min(longer * sum / static_cast<double>(line.points.size()),
                                          ribbon.closed() ? of_length * ribbon.length() : HUGE_VAL);
        out.push_back(
            {[&ribbon](const Vec3& x) { return std::hypot(ribbon.distance(x), std::max(0.0, ribbon.beyond(x))); },
             options_.refine.when == RefineFirst::When::to_size ? options_.refine.size : automatic});
    }
    return out;
}

/// With the bound on what becomes of mesh m.
OperatorOptions MergeRefining::options_for(std::size_t m, double growth) const {
    OperatorOptions out = options_;
    if (options_.refine.when != RefineFirst::When::automatic) return out;
    out.before_refining = [this, m, growth](const RefinementEstimate& e) {
        const Index most = std::max(
            few_elements, static_cast<Index>(std::llround(growth * static_cast<double>(meshes_[m]->cell_count()))));
        if (e.elements_after > most) {
            std::ostringstream text;
            text.precision(3);
            text << (m == 0 ? "the addition is so much finer than the mesh that this"
                            : "the mesh is so much finer than the addition that this")
                 << " would be refined from " << e.elements_before << " to " << (e.is_more ? "more than " : "some ")
                 << e.elements_after << " elements, with edges of " << e.size
                 << " where they meet. Give refine=" << e.size_for(most)
                 << ", a longer edge there, or False for none; or mesh the finer one coarser, or add it as a shell";
            throw TooMany(text.str());
        }
        if (options_.before_refining) options_.before_refining(e);
    };
    return out;
}

void MergeRefining::run(const std::vector<MeetingLine>& meeting, double longer, double growth,
                        const std::array<Prepared, 2>& known) {
    for (const std::size_t m : {0U, 1U}) {
        std::vector<std::unique_ptr<Ribbon>> ribbons;
        const std::vector<RefineZone> zones = this->zones(meeting, m, longer, ribbons);
        const Mesh& mesh = *meshes_[m];
        std::optional<Refined> simple = simplify(mesh, zones, known[m]);
        try {
            refined_[m] = refine_first(simple ? simple->mesh : mesh, zones, options_for(m, growth));
        } catch (const TooMany& error) {
            throw ToolError(error.what(), "refine");
        }
        if (!simple) continue;
        if (refined_[m] && refined_[m]->tried_in_vain) {
            std::ranges::move(refined_[m]->report.warnings, std::back_inserter(simple->report.warnings));
            refined_[m].reset();
        }
        refined_[m] = refined_[m] ? joined(*simple, std::move(*refined_[m]), options_.strict) : std::move(simple);
    }
}

void MergeRefining::join(std::size_t m, Report& report) const {
    if (!refined_[m]) return;
    const Report& first = refined_[m]->report;
    report.warnings.insert(report.warnings.begin(), first.warnings.begin(), first.warnings.end());
    for (std::string& warning : report.warnings) speak_of_meshes(warning, m);
    if (!is_refined(m)) return;
    std::ranges::move(warnings_of(refined_[m]->trace.deck, options_.strict), std::back_inserter(report.warnings));
    report.refinement = refined_[m]->summary;
    report.nodes_added += first.nodes_added;
    report.nodes_split += first.nodes_split;
    report.nodes_removed += first.nodes_removed;
    report.elements_added += first.elements_added;
    for (const auto& [type, count] : first.converted) report.converted[type] += count;
}

/// Only simplices can be bisected.
std::optional<Refined> MergeRefining::simplify(const Mesh& mesh, std::span<const RefineZone> zones,
                                               const Prepared& known) const {
    if (has_simplices_alone(mesh)) return {};
    std::vector<std::int8_t> level = levels_to_refine(mesh, zones, options_);
    spread_levels(mesh, level, rings_to_refine, known.adjacency);
    return simplify_first(mesh, level, known);
}

}  // namespace femscalpel
