// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/merge_report.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "cancel.h"
#include "groups/group_report.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

/// The shape of the elements of two and three dimensions for which `wanted` is true.
template <class Wanted>
std::vector<ElementQuality> qualities(const Mesh& mesh, Wanted wanted) {
    std::vector<ElementQuality> out;
    SparseCheck check;
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).dimension < 2) continue;
        for (Index c = 0; c < b.size(); ++c, check())
            if (wanted(b, c)) out.push_back({b.ids[c], mean_ratio(mesh, b.type, c)});
    }
    return out;
}

/// Which elements of a result are those of the input, with the same nodes where they were.
class Unchanged {
public:
    Unchanged(const Mesh& input, const Mesh& result) : input_(input) {
        std::unordered_map<Index, Index> known;
        known.reserve(input.points.size());
        for (Index n = 0; n < input.node_count(); ++n) known.emplace(input.node_ids[n], n);
        for (Index n = 0; n < result.node_count(); ++n) {
            const auto found = known.find(result.node_ids[n]);
            const bool same = found != known.end() && input.points[found->second] == result.points[n];
            was_.push_back(same ? found->second : -1);
        }
    }

    bool is(const CellBlock& block, Index cell) const {
        const CellBlock& before = input_.block(block.type);
        const Index row = row_of(before, block.ids[cell], cell);
        return row >= 0 && std::ranges::equal(block.nodes(cell), before.nodes(row),
                                              [&](Index now, Index then) { return was_[now] == then; });
    }

private:
    /// Where the element with a number is in a block of the input, most often in the place `guess`; -1 if it is not.
    Index row_of(const CellBlock& block, Index number, Index guess) const {
        if (guess < block.size() && block.ids[guess] == number) return guess;
        std::unordered_map<Index, Index>& rows = rows_[static_cast<std::size_t>(block.type)];
        if (rows.empty())
            for (Index c = 0; c < block.size(); ++c) rows.emplace(block.ids[c], c);
        const auto found = rows.find(number);
        return found == rows.end() ? -1 : found->second;
    }

    const Mesh& input_;
    std::vector<Index> was_;                                                      // by node of the result; or -1
    mutable std::array<std::unordered_map<Index, Index>, cell_type_count> rows_;  // by number, once needed
};

/// How bad a warning of warn_of_grazing() is, and what kind of warning; nothing if it is another.
std::optional<std::pair<std::string, double>> grazing(const std::string& warning) {
    for (const auto& [kind, sign] : {std::pair("the seam meets a surface or group border at ", -1.0),
                                     std::pair("the seam runs along a feature line or border line at ", -1.0),
                                     std::pair("the seam runs within 0.15 edge lengths of a nearly parallel surface or "
                                               "group border at ",
                                               1.0)}) {
        const std::size_t found = warning.find(kind);
        if (found == std::string::npos) continue;
        const std::string rest = warning.substr(found + std::string_view(kind).size());
        // "less than 0.1 degrees"
        const double value =
            std::isdigit(static_cast<unsigned char>(rest.front())) ? std::strtod(rest.c_str(), nullptr) : 0;
        return std::pair(warning.substr(0, found) + kind, sign * value);
    }
    return {};
}

}  // namespace

void join_warnings_about_the_seam(std::vector<std::string>& warnings) {
    std::vector<std::string> out;
    std::map<std::string, std::pair<std::size_t, double>> worst;  // by kind: which of `out`, and how bad
    for (std::string& warning : warnings) {
        const auto of = grazing(warning);
        if (!of) {
            if (std::ranges::find(out, warning) == out.end()) out.push_back(std::move(warning));
            continue;
        }
        const auto [known, fresh] = worst.try_emplace(of->first, out.size(), of->second);
        if (fresh) {
            out.push_back(std::move(warning));
        } else if (of->second > known->second.second) {
            known->second.second = of->second;
            out[known->second.first] = std::move(warning);
        }
    }
    warnings = std::move(out);
}

std::vector<GroupRecord> merged_records(const Mesh& input, const Mesh& result, const std::vector<GroupRecord>& known) {
    std::vector<GroupRecord> records = compare_groups(input, family_totals(input), result, family_totals(result));
    for (GroupRecord& r : records)
        for (const GroupRecord& was : known)
            if (was.name == r.name && was.kind == r.kind) {
                const GroupRecord now = r;
                // What is known may be of the last step alone.
                r = was;
                r.count_before = now.count_before;
                r.count_after = now.count_after;
                r.measure_before = now.measure_before;
                r.measure_after = now.measure_after;
                if (was.status == "untouched" && now.count_after != now.count_before) r.status = now.status;
            }
    return records;
}

void describe_joined(const Mesh& input, const Mesh& addition, const Mesh& result, const std::string& added,
                     Report& report) {
    const GroupIndex group = *result.find_group(added, GroupKind::element);
    const bool solid = result.dimension() == 3;
    const Unchanged unchanged(input, result);
    std::vector<Index> untouched;
    report.quality_after = summarise(qualities(result, [&](const CellBlock& b, Index c) {
        if (result.families.contains(b.families[c], group)) return true;
        if (solid && traits(b.type).dimension == 2) return false;
        if (!unchanged.is(b, c)) return true;
        untouched.push_back(b.ids[c]);
        return false;
    }));
    std::ranges::sort(untouched);
    std::vector<ElementQuality> before = qualities(addition, [](const CellBlock&, Index) { return true; });
    std::ranges::copy(qualities(input,
                                [&](const CellBlock& b, Index c) {
                                    return !(solid && traits(b.type).dimension == 2) &&
                                           !std::ranges::binary_search(untouched, b.ids[c]);
                                }),
                      std::back_inserter(before));
    report.quality_before = summarise(std::move(before));
}

std::vector<Index> shared_nodes(const Mesh& mesh, const std::string& name) {
    const GroupIndex added = *mesh.find_group(name, GroupKind::element);
    std::vector<char> in_added(mesh.points.size(), 0), in_others(mesh.points.size(), 0);
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).dimension < 2) continue;
        for (Index c = 0; c < b.size(); ++c) {
            std::vector<char>& in = mesh.families.contains(b.families[c], added) ? in_added : in_others;
            for (const Index n : b.nodes(c)) in[n] = 1;
        }
    }
    std::vector<Index> out;
    for (Index n = 0; n < mesh.node_count(); ++n)
        if (in_added[n] && in_others[n]) out.push_back(n);
    return out;
}

void add_seam(Mesh& mesh, const std::string& name, const std::vector<Index>& nodes) {
    const GroupIndex group = mesh.add_group(name + "_SEAM", GroupKind::node);
    for (const Index n : nodes) mesh.node_families[n] = mesh.families.with(mesh.node_families[n], group);
}

Report joined(const Report& before, Report after) {
    after.quality_before = before.quality_before;
    after.nodes_added += before.nodes_added;
    after.nodes_split += before.nodes_split;
    after.nodes_moved = std::max(after.nodes_moved, before.nodes_moved);
    after.elements_added += before.elements_added;
    for (const auto& [type, count] : before.converted) after.converted[type] += count;
    after.warnings.insert(after.warnings.begin(), before.warnings.begin(), before.warnings.end());
    after.poor.insert(after.poor.begin(), before.poor.begin(), before.poor.end());
    return after;
}

}  // namespace femscalpel
