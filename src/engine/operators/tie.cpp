// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/tie.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include "cutting/touching_faces.h"
#include "deck/adopt_sections.h"
#include "deck/solver_input.h"
#include "deck/tie_cards.h"
#include "groups/group_report.h"
#include "mesh/stopwatch.h"
#include "operators/merge_checks.h"
#include "operators/sections.h"
#include "operators/unite.h"

namespace femscalpel {
namespace {

/// CalculiX is given so much more than the distance there is.
constexpr double margin = 1.01;

[[noreturn]] void fail_untouched(const Mesh& mesh, const Mesh& addition) {
    throw ToolError(
        "the addition does not touch the mesh: no face of the one is near one of the other, and no edge of a shell "
        "stands on one. " +
            extents_text(mesh, addition) + ". Move the addition, or give a larger tolerance",
        "other");
}

/// Facets join a group; those that have groups already are not repeated.
void add_facets(Mesh& mesh, const std::vector<Facet>& facets, const std::string& name) {
    const GroupIndex group = mesh.add_group(name, GroupKind::facet);
    const auto key = [](const Facet& f) { return std::tuple(f.type, f.cell, f.face); };
    std::map<decltype(key(facets.front())), std::size_t> known;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) known.emplace(key(mesh.facets[f]), f);
    for (const Facet& f : facets) {
        const auto [found, fresh] = known.emplace(key(f), mesh.facets.size());
        if (fresh) mesh.facets.push_back(f);
        FamilyIndex& family = mesh.facets[found->second].family;
        family = mesh.families.with(family, group);
    }
    std::ranges::sort(mesh.facets, {}, key);
}

/// How the deck ties the two, and what is to be told of it.
void tie_up(Mesh& mesh, const TouchingFaces& touching, const MergeOptions& options, const std::string (&names)[2],
            Report& report) {
    const std::size_t master = touching.edges[1]                             ? 0
                               : touching.edges[0]                           ? 1
                               : touching.size[1] > touching.size[0] * 1.001 ? 1
                                                                             : 0;
    Tie tie{options.name + "_TIE", names[1 - master], names[master], touching.tolerance};
    std::ostringstream text;
    bool known = true;
    for (const std::size_t m : {0U, 1U}) {
        if (touching.edges[m]) continue;
        const auto half = half_thickness(mesh, *mesh.find_group(names[m], GroupKind::facet));
        known = known && half;
        tie.tolerance += half.value_or(0);
    }
    tie.tolerance *= margin;
    if (solver_input(mesh)) {
        add_tie(mesh, tie);
        if (known) return;
        text << "the deck's *TIE '" << tie.name
             << "' has a POSITION TOLERANCE without half the thickness of the shells there, of which the deck says "
                "nothing: add that";
    } else {
        text << "nothing holds the two together but what the solver is told. In CalculiX: " << tie_card(tie);
        if (!known) text << "with half the thickness of shells added to the tolerance";
    }
    std::string words = text.str();
    while (words.ends_with('\n')) words.pop_back();
    report.warnings.push_back(std::move(words));
}

}  // namespace

Result tie(const Mesh& mesh, const Mesh& other, const MergeOptions& options) {
    const Stopwatch::Time started = Stopwatch::now();
    Mesh addition = other;
    const TouchingFaces touching = touching_faces(mesh, addition, options.tolerance);
    if (touching.facets[0].empty()) fail_untouched(mesh, addition);
    const std::string added = options.name + "_ADDED",
                      names[2] = {options.name + "_TIE_MESH", options.name + "_TIE_ADDED"};
    const std::vector<std::string> reduced = reduce_to_sections(mesh, addition);
    Result out;
    out.mesh = mesh;
    std::array<Index, cell_type_count> first{};
    for (const CellBlock& b : mesh.blocks()) first[static_cast<int>(b.type)] = b.size();
    out.mesh.add_group(added, GroupKind::element);
    unite(out.mesh, addition, std::vector<Index>(addition.points.size(), -1), added, names_of(options));
    std::vector<Facet> of_addition = touching.facets[1];
    for (Facet& f : of_addition) f.cell += first[static_cast<int>(f.type)];
    add_facets(out.mesh, touching.facets[0], names[0]);
    add_facets(out.mesh, of_addition, names[1]);

    Report& report = out.report;
    report.operation = "merge";
    report.name = options.name;
    report.method = "tie";
    report.groups = compare_groups(mesh, family_totals(mesh), out.mesh, family_totals(out.mesh));
    report.warnings = reduced;
    report.nodes_added = addition.node_count();
    report.elements_added = addition.cell_count();
    warn_of_sections(mesh, out.mesh, added, report);
    if (options.join_groups) warn_of_joined_groups(mesh, addition, report);
    tie_up(out.mesh, touching, options, names, report);
    report.seconds = {{"merge", Stopwatch::since(started)}};
    return out;
}

}  // namespace femscalpel
