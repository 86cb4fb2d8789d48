// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/merge_refining.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
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

/// There is no tool here, nor an option to refine.
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

void MergeRefining::run(const std::vector<MeetingLine>& meeting, double longer, const std::array<Prepared, 2>& known) {
    for (const std::size_t m : {0U, 1U}) {
        std::vector<std::unique_ptr<Ribbon>> ribbons;
        std::vector<RefineZone> zones;
        for (const MeetingLine& line : meeting) {
            double sum = 0;
            for (const MeetingLine::Point& p : line.points) sum += p.size[1 - m];
            ribbons.push_back(ribbon_of(line, m));
            const Ribbon& ribbon = *ribbons.back();
            zones.push_back(
                {[&ribbon](const Vec3& x) { return std::hypot(ribbon.distance(x), std::max(0.0, ribbon.beyond(x))); },
                 std::min(longer * sum / static_cast<double>(line.points.size()),
                          ribbon.closed() ? of_length * ribbon.length() : HUGE_VAL)});
        }
        const Mesh& mesh = *meshes_[m];
        std::optional<Refined> simple = simplify(mesh, zones, known[m]);
        refined_[m] = refine_first(simple ? simple->mesh : mesh, zones, options_);
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
