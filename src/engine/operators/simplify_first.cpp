// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/simplify_first.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "cutting/locate.h"
#include "cutting/no_cut.h"
#include "deck/carry_over.h"
#include "deck/fit_cards.h"
#include "deck/solver_element.h"
#include "groups/group_report.h"

namespace femscalpel {
namespace {

/// Rings beside the band to which it may grow when the mesh was refined, or with it its width is found anew.
constexpr int spare_rings = 2;

/// So often what is to be converted grows where pyramids come out poor.
constexpr int rounds_for_pyramids = 4;

/// Level >= 0 at the nodes around which there have to be simplices alone.
std::vector<std::int8_t> levels_to_work_on(const Mesh& mesh, std::span<const Blade> blades,
                                           std::span<const RefineZone> zones, const OperatorOptions& options,
                                           const Prepared& known) {
    const Adjacency* adjacency = known.adjacency;
    int width = options.transition.value_or(2);
    std::vector<std::int8_t> longer(mesh.points.size(), -1);
    if (!zones.empty()) longer = levels_to_refine(mesh, zones, options);
    const bool refines = std::ranges::find(longer, 0) != longer.end();
    Location location;
    try {
        location = locate(mesh, blades, width, adjacency, known.beam_stops);
    } catch (const ToolError&) {
        // What lies between the nodes of these elements may part those that refining makes of them.
        if (!refines || std::ranges::none_of(blades, [&](const Blade& b) { return lies_inside_elements(mesh, b); }))
            throw;
        spread_levels(mesh, longer, rings_to_refine, adjacency);
        return longer;
    }
    if (!options.transition && options.method == Method::deform)
        width = bandwidth(location, mesh) + spare_rings;
    else if (refines)
        width += spare_rings;
    else
        return std::move(location.level);
    for (std::int8_t& level : location.level) level = level > 0 ? -1 : level;
    spread_levels(mesh, location.level, width, adjacency);
    if (refines) spread_levels(mesh, longer, rings_to_refine, adjacency);
    for (std::size_t n = 0; n < longer.size(); ++n)
        if (location.level[n] < 0) location.level[n] = longer[n];
    return std::move(location.level);
}

std::vector<PyramidRule> pyramid_rules(const Mesh& mesh, const DeckMarks& marks) {
    if (marks.no_tips.empty()) return {};
    std::vector<PyramidRule> rules(mesh.points.size(), PyramidRule::any);
    for (const Index n : marks.no_tips) rules[n] = PyramidRule::no_tip;
    for (const Index n : marks.no_bases) rules[n] = PyramidRule::no_tip_nor_base;
    return rules;
}

constexpr std::string_view stiff_tetrahedra =
    " first-order hexahedra, prisms or pyramids near the tool became first-order tetrahedra, which are stiffer in "
    "bending";

std::string stiffness_warning(Index count) {
    return std::to_string(count) + std::string(stiff_tetrahedra) +
           "; meshes of second order have no such weakness, nor has the option second_order with a CalculiX deck";
}

/// What the deck calls first-order quadrangles among these elements, and what it calls their triangles: "S4 to S3, CAX4
/// to CAX3".
std::string labels_of_quads(const Mesh& before, const SolverInput& deck, const std::vector<CellRef>& cells) {
    std::set<FamilyIndex> families;
    for (const CellRef& cell : cells)
        if (cell.type == CellType::quad) families.insert(before.block(cell.type).families[cell.cell]);
    std::set<std::string> labels;
    for (const Card& card : deck.cards()) {
        if (card.keyword != "ELEMENT" || card.group.empty()) continue;
        const auto group = before.find_group(card.group, GroupKind::element, true);
        if (group && std::ranges::any_of(families, [&](FamilyIndex f) { return before.families.contains(f, *group); }))
            labels.insert(deck_key(*card.parameter("TYPE")));
    }
    if (labels.empty()) labels.insert(std::string(default_deck_label(CellType::quad)));
    std::string out;
    for (const std::string& label : labels)
        out += (out.empty() ? "" : ", ") + label + " to " + deck_label_for(label, CellType::triangle);
    return out;
}

/// What solvers make of it.
std::vector<std::string> warnings_about(const Mesh& before, const Simplified& simplified) {
    std::vector<std::string> out;
    Index stiff = 0;
    for (const CellType type : {CellType::hexahedron, CellType::wedge, CellType::pyramid})
        stiff += simplified.converted[static_cast<int>(type)];
    if (stiff > 0) out.push_back(stiffness_warning(stiff));
    const SolverInput* deck = solver_input(before);
    if (const Index quads = simplified.converted[static_cast<int>(CellType::quad)]; quads > 0 && deck)
        out.push_back(std::to_string(quads) + " first-order quadrangles near the tool became first-order triangles (" +
                      labels_of_quads(before, *deck, simplified.before) +
                      "), which are far stiffer in bending in CalculiX; those of second order are not");
    return out;
}

Report report_of(const Mesh& before, const FamilyTotals& totals, const Simplified& simplified) {
    FamilyTotals now = totals;
    count_cells(now, before, simplified.before, -1);
    count_cells(now, simplified.mesh, simplified.after, +1);
    recount_nodes_and_facets(now, simplified.mesh);
    Report report;
    report.operation = "convert";
    report.groups = compare_groups(before, totals, simplified.mesh, now);
    report.nodes_added = report.nodes_split = simplified.nodes_added;
    report.nodes_removed = simplified.nodes_removed;
    report.beams_cut = simplified.beams_cut;
    report.elements_added = static_cast<Index>(simplified.after.size() - simplified.before.size());
    for (const CellTraits& t : all_cell_types())
        if (const Index count = simplified.converted[static_cast<int>(t.type)]; count > 0)
            report.converted[std::string(t.name)] = count;
    report.warnings = warnings_about(before, simplified);
    return report;
}

}  // namespace

bool has_simplices_alone(const Mesh& mesh) {
    return std::ranges::all_of(mesh.blocks(),
                               [](const CellBlock& b) { return traits(b.type).simplex || b.size() == 0; });
}

std::optional<Refined> simplify_first(const Mesh& mesh, std::span<const Blade> blades,
                                      std::span<const RefineZone> zones, const OperatorOptions& options,
                                      const Prepared& known) {
    if (has_simplices_alone(mesh)) return {};
    return simplify_first(mesh, levels_to_work_on(mesh, blades, zones, options, known), known);
}

std::optional<Refined> simplify_first(const Mesh& mesh, const DistanceField& distance, const BisectionOptions& options,
                                      const Prepared& known) {
    if (has_simplices_alone(mesh)) return {};
    const std::vector<std::int8_t> others = corners_of_long_edges(mesh, distance, options, true);
    if (std::ranges::find(others, 0) == others.end()) return {};
    std::vector<std::int8_t> level = corners_of_long_edges(mesh, distance, options);
    spread_levels(mesh, level, rings_to_refine);
    return simplify_first(mesh, level, known);
}

std::optional<Refined> simplify_first(const Mesh& mesh, const std::vector<std::int8_t>& level, const Prepared& known) {
    std::vector<CellRef> unfit;
    DeckMarks own;
    if (!known.marks) own = mark_deck(mesh);
    const DeckMarks& marks = known.marks ? *known.marks : own;
    const std::vector<PyramidRule> rules = pyramid_rules(mesh, marks);
    Conversion conversion = plan_conversion(mesh, level, known.adjacency, {}, rules);
    if (conversion.empty()) return {};
    const Mesh& marked = marks.mesh ? *marks.mesh : mesh;
    const Numbering numbering = next_numbers(mesh);
    Simplified simplified = simplify(marked, conversion, numbering, true);
    for (int round = 1; round <= rounds_for_pyramids && !simplified.unfit.empty(); ++round) {
        std::ranges::copy(simplified.unfit, std::back_inserter(unfit));
        conversion = plan_conversion(mesh, level, known.adjacency, unfit, rules);
        simplified = simplify(marked, conversion, numbering, round < rounds_for_pyramids);
    }
    return with_parts(mesh, std::move(simplified), marks, known);
}

Refined with_parts(const Mesh& mesh, Simplified simplified, const DeckMarks& marks, const Prepared& known) {
    const Mesh& marked = marks.mesh ? *marks.mesh : mesh;
    Refined out;
    out.numbering = next_numbers(mesh);
    out.deck = solver_input(mesh);
    if (!marks.surface_sets.empty() && solver_input(mesh))
        renew_surface_sets(simplified.mesh, marks.surface_sets, *solver_input(mesh), simplified.after);
    out.trace.deck = carry_deck(marked, simplified.mesh, simplified.changes);
    out.trace.quality = changed_quality(marked, simplified.before, simplified.mesh, simplified.after);
    out.report = report_of(marked, known.totals ? *known.totals : family_totals(marked), simplified);
    out.mesh = std::move(simplified.mesh);
    out.trace.changes = std::move(simplified.changes);
    fit_cards(out.mesh, simplified.after);
    remove_marks(out.mesh);
    return out;
}

bool is_about_stiffness(const std::string& warning) { return warning.find(stiff_tetrahedra) != std::string::npos; }

void join_warnings_about_stiffness(std::vector<std::string>& warnings) {
    Index count = 0;
    for (const std::string& w : warnings)
        if (is_about_stiffness(w)) count += std::stoll(w.substr(w.find_first_of("0123456789")));
    if (count == 0) return;
    std::erase_if(warnings, is_about_stiffness);
    warnings.push_back(stiffness_warning(count));
}

void add_conversion(const Refined& converted, bool strict, Report& report) {
    const Report& first = converted.report;
    const auto add = [](auto& to, const auto& from) {
        for (const auto& [type, count] : from) to[type] += count;
    };
    std::vector<std::string> warnings = first.warnings;
    std::ranges::move(warnings_of(converted.trace.deck, strict), std::back_inserter(warnings));
    std::ranges::move(report.warnings, std::back_inserter(warnings));
    report.warnings = std::move(warnings);
    add(report.converted, first.converted);
    report.beams_cut += first.beams_cut;
    report.nodes_added += first.nodes_added;
    report.nodes_split += first.nodes_split;
    report.nodes_removed += first.nodes_removed;
    report.elements_added += first.elements_added;
    for (std::size_t g = 0; g < first.groups.size(); ++g) {
        report.groups[g].count_before = first.groups[g].count_before;
        report.groups[g].measure_before = first.groups[g].measure_before;
        if (report.groups[g].status == "untouched" && first.groups[g].count_before != first.groups[g].count_after)
            report.groups[g].status = first.groups[g].status;
    }
}

namespace {

/// Of a first change and a second one of its result, as of one.
ChangedQuality joined(const ChangedQuality& first, ChangedQuality second) {
    const auto numbers = [](const std::vector<ElementQuality>& list) {
        std::unordered_set<Index> out;
        for (const ElementQuality& q : list) out.insert(q.id);
        return out;
    };
    const std::unordered_set<Index> made = numbers(first.after), gone = numbers(second.before);
    std::erase_if(second.before, [&](const ElementQuality& q) { return made.contains(q.id); });
    std::ranges::copy(first.before, std::back_inserter(second.before));
    std::ranges::copy_if(first.after, std::back_inserter(second.after),
                         [&](const ElementQuality& q) { return !gone.contains(q.id); });
    return second;
}

}  // namespace

Refined joined(const Refined& converted, Refined refined, bool strict) {
    refined.trace.quality = joined(converted.trace.quality, std::move(refined.trace.quality));
    add_conversion(converted, strict, refined.report);
    std::unordered_map<Index, Index> parents;
    Changes changes = converted.trace.changes;
    for (const Changes::Part& p : changes.parts) parents.emplace(p.element, p.parent);
    for (const Changes::Part& p : refined.trace.changes.parts) {
        const auto parent = parents.find(p.parent);
        changes.parts.push_back({p.element, parent == parents.end() ? p.parent : parent->second});
    }
    std::ranges::move(refined.trace.changes.born, std::back_inserter(changes.born));
    refined.trace.changes = std::move(changes);
    refined.numbering = converted.numbering;
    refined.deck = converted.deck;
    refined.converting = converted.converting;
    return refined;
}

}  // namespace femscalpel
