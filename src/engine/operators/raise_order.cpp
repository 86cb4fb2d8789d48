// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/raise_order.h"

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <unordered_set>

#include "cutting/numbering.h"
#include "cutting/simplify.h"
#include "deck/carry_over.h"
#include "deck/edge_ties.h"
#include "deck/mark_deck.h"
#include "deck/solver_sets.h"
#include "mesh/middles.h"
#include "mesh/order.h"
#include "operators/simplify_first.h"

namespace femscalpel {
namespace {

using Chosen = std::array<std::vector<char>, cell_type_count>;

/// The tetrahedra and pyramids of first order whose numbers the input has not, or has for others.
std::vector<CellRef> converted_ones(const Mesh& input, const Mesh& mesh) {
    const NumberIndex numbers(input);
    std::vector<CellRef> out;
    for (const CellType type : {CellType::tetra, CellType::pyramid}) {
        const CellBlock& b = mesh.block(type);
        for (Index c = 0; c < b.size(); ++c)
            if (const auto was = numbers.cell(b.ids[c]); !was || was->type != type) out.push_back({type, c});
    }
    return out;
}

/// Prisms and tetrahedra given as hexahedra with a node twice. With mid-side nodes their triangles do not fit those of
/// others.
bool is_collapsed(std::span<const Index> nodes) {
    for (std::size_t k = 0; k < nodes.size(); ++k)
        if (std::ranges::find(nodes.subspan(k + 1), nodes[k]) != nodes.end()) return true;
    return false;
}

/// Elements with a node of some, but for collapsed ones, and what lies on their faces and edges, if of first order.
/// Springs are whole, and beams from node to node their own.
Chosen with_a_ring(const Mesh& mesh, const std::vector<CellRef>& some) {
    std::vector<char> near(mesh.points.size(), 0);
    std::unordered_set<std::uint64_t> edges;
    for (const CellRef& c : some)
        for (const Index n : mesh.block(c.type).nodes(c.cell)) near[n] = 1;
    Chosen out;
    for (const CellBlock& b : mesh.blocks()) {
        std::vector<char>& list = out[static_cast<int>(b.type)];
        list.assign(b.ids.size(), 0);
        if (traits(b.type).dimension < 3 || traits(b.type).quadratic) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            if (is_collapsed(n)) continue;
            if (std::ranges::none_of(n, [&](Index v) { return near[v] != 0; })) continue;
            list[static_cast<std::size_t>(c)] = 1;
            for (const auto& e : traits(b.type).edges) edges.insert(mesh_edge_key(n[e[0]], n[e[1]]));
        }
    }
    // Faces and edges of solids that all belong to those.
    std::vector<char> elsewhere(mesh.points.size(), 0);
    for (const CellBlock& b : mesh.blocks())
        if (traits(b.type).dimension == 3)
            for (Index c = 0; c < b.size(); ++c)
                if (!out[static_cast<int>(b.type)][static_cast<std::size_t>(c)])
                    for (const Index v : b.nodes(c)) elsewhere[v] = 1;
    const std::vector<char> whole = families_of_whole_elements(mesh);
    for (const CellBlock& b : mesh.blocks()) {
        const CellTraits& t = traits(b.type);
        if (t.dimension < 1 || t.dimension > 2 || t.quadratic) continue;
        for (Index c = 0; c < b.size(); ++c) {
            const auto n = b.nodes(c);
            if (!whole.empty() && whole[b.families[c]]) continue;
            const bool on_them =
                std::ranges::all_of(t.edges,
                                    [&](const auto& e) { return edges.contains(mesh_edge_key(n[e[0]], n[e[1]])); }) &&
                std::ranges::any_of(n, [&](Index v) { return elsewhere[v] == 0; });
            out[static_cast<int>(b.type)][static_cast<std::size_t>(c)] = on_them;
        }
    }
    return out;
}

/// Edges between the orders are to be kept straight.
void tie_orders(Mesh& mesh) {
    auto deck = std::make_shared<SolverInput>(*solver_input(mesh));
    deck->set_ties_orders(true);
    mesh.companion = std::move(deck);
}

/// The second report's groups have what the first's had before.
void join(Report& report, const Refined& raised, bool strict) {
    report.nodes_added += raised.report.nodes_added;
    report.nodes_split += raised.report.nodes_added;
    for (GroupRecord& r : report.groups)
        for (const GroupRecord& now : raised.report.groups)
            if (now.name == r.name && now.kind == r.kind) {
                r.count_after = now.count_after;
                r.measure_after = now.measure_after;
                if (r.status == "untouched" && r.count_after != r.count_before) r.status = now.status;
            }
    std::ranges::move(warnings_of(raised.trace.deck, strict), std::back_inserter(report.warnings));
}

Result raise_near(const Mesh& input, Result result, const OperatorOptions& options) {
    if (!options.second_order || options.band_only || result.report.converted.empty()) return result;
    const std::vector<CellRef> converted = converted_ones(input, result.mesh);
    if (converted.empty()) return result;
    if (!solver_input(result.mesh))
        throw ToolError(
            "second_order needs the mesh of a CalculiX deck: an *EQUATION card has to tie the new nodes where elements "
            "of first order are beside them",
            "second_order");
    const DeckMarks marks = mark_deck(result.mesh);
    const Mesh& marked = marks.mesh ? *marks.mesh : result.mesh;
    RaisedOrder second = to_second_order(marked, with_a_ring(marked, converted), next_numbers(marked).node);
    Simplified parts;
    parts.mesh = std::move(second.mesh);
    parts.before = std::move(second.before);
    parts.after = std::move(second.after);
    parts.nodes_added = static_cast<Index>(second.made.size());
    for (const auto& [node, a, b] : second.made)
        parts.changes.born.push_back({node, {std::min(a, b), std::max(a, b)}, {{a, 0.5}, {b, 0.5}}});
    Refined out = with_parts(result.mesh, std::move(parts), marks, {});
    tie_orders(out.mesh);
    std::erase_if(result.report.warnings, is_about_stiffness);
    join(result.report, out, options.strict);
    result.stages.push_back(std::move(out.trace.changes));
    result.mesh = std::move(out.mesh);
    return result;
}

}  // namespace

Result with_order_raised(const Mesh& input, Result result, const OperatorOptions& options) {
    Result out = raise_near(input, std::move(result), options);
    if (!options.band_only) tell_of_ties(input, options.strict, out);
    return out;
}

void tell_of_ties(const Mesh& input, bool strict, Result& result) {
    std::vector<std::string> problems = problems_of_ties(result.mesh);
    if (problems.empty()) return;
    const std::vector<std::string> before = problems_of_ties(input);
    Remarks remarks;
    for (const std::string& problem : problems)
        if (std::ranges::find(before, problem) == before.end()) remarks.add_problem(problem);
    std::ranges::move(warnings_of(remarks, strict), std::back_inserter(result.report.warnings));
}

}  // namespace femscalpel
