// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/surface_sets.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include "deck/solver_element.h"
#include "deck/solver_sets.h"

namespace femscalpel {
namespace {

bool has_name(std::string_view line) {
    return std::ranges::any_of(line,
                               [](char c) { return c == '_' || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); });
}

bool is_element_surface(const Card& card) {
    if (card.keyword != "SURFACE") return false;
    const auto set = set_of_card(card);
    return set && set->first == DeckSetType::element_surface;
}

/// By key of an element set: the surface lines that name it.
using Uses = std::map<std::string, std::vector<std::pair<GroupIndex, int>>>;

Uses named_by_surfaces(const Mesh& mesh, const SolverInput& input, const DeckSetIndex& index) {
    Uses uses;
    for (const Card& card : input.cards()) {
        if (!is_element_surface(card)) continue;
        const auto s = index.find(DeckSetType::element_surface, set_of_card(card)->second);
        const auto surface = s ? mesh.find_group(input.sets()[*s].group, GroupKind::facet) : std::nullopt;
        if (!surface) continue;
        CardReader line(card);
        while (line.next_data_line()) {
            Index number = 0;
            if (line.integer(number)) continue;
            const std::string name = deck_key(line.field());
            if (const int label = label_from_name(line.field()); label > 0) uses[name].emplace_back(*surface, label);
        }
    }
    return uses;
}

/// Takes out what anything but a surface's line names.
void erase_used_elsewhere(const SolverInput& input, Uses& uses) {
    for (const Card& card : input.cards()) {
        for (const CardParameter& p : card.parameters) {
            const bool defines =
                (card.keyword == "ELSET" && p.name == "ELSET") || (card.keyword == "SURFACE" && p.name == "NAME");
            if (!defines) uses.erase(deck_key(p.value));
        }
        if (card.keyword == "NODE" || card.keyword == "ELEMENT") continue;
        const bool by_face = is_element_surface(card);
        CardReader line(card);
        while (line.next_data_line()) {
            if (!has_name(line.line())) continue;
            if (by_face) {
                const std::string name = line.field();
                if (label_from_name(line.field()) == 0) uses.erase(deck_key(name));
                continue;
            }
            while (!line.at_end()) uses.erase(deck_key(line.field()));
        }
        if (uses.empty()) return;
    }
}

}  // namespace

std::vector<SurfaceSet> surface_sets(const Mesh& mesh) {
    const SolverInput* const deck = solver_input(mesh);
    if (!deck) return {};
    const SolverInput& input = *deck;
    const DeckSetIndex index(input.sets());
    Uses uses = named_by_surfaces(mesh, input, index);
    if (!uses.empty()) erase_used_elsewhere(input, uses);
    std::vector<SurfaceSet> out;
    for (auto& [name, faces] : uses) {
        const auto s = index.find(DeckSetType::elset, name);
        if (!s || !input.sets()[*s].unheld.empty()) continue;
        if (const auto group = mesh.find_group(input.sets()[*s].group, GroupKind::element))
            out.push_back({*group, std::move(faces)});
    }
    return out;
}

std::vector<bool> groups_of(std::span<const SurfaceSet> sets, const Mesh& mesh) {
    if (sets.empty()) return {};
    std::vector<bool> out(mesh.groups.size(), false);
    for (const SurfaceSet& s : sets) out[s.group] = true;
    return out;
}

void renew_surface_sets(Mesh& mesh, std::span<const SurfaceSet> sets, const SolverInput& input,
                        std::span<const CellRef> changed) {
    if (sets.empty()) return;
    std::map<std::pair<GroupIndex, int>, std::vector<GroupIndex>> sets_for;  // by surface and label
    std::map<GroupIndex, std::set<GroupIndex>> surfaces_of;                  // by set
    std::set<GroupIndex> surfaces;
    for (const SurfaceSet& set : sets)
        for (const auto& [surface, label] : set.faces) {
            sets_for[{surface, label}].push_back(set.group);
            surfaces_of[set.group].insert(surface);
            surfaces.insert(surface);
        }
    const auto place = [](const Facet& f) { return std::pair(f.type, f.cell); };
    std::vector<Facet> facets;
    std::ranges::copy_if(mesh.facets, std::back_inserter(facets), [&](const Facet& f) {
        return std::ranges::any_of(mesh.families.groups(f.family), [&](GroupIndex g) { return surfaces.contains(g); });
    });
    std::ranges::sort(facets, {}, place);
    const std::vector<char> planes = plane_families(mesh, input);
    for (const CellRef& cell : changed) {
        if (traits(cell.type).dimension < 2) continue;  // beams have no faces here
        FamilyIndex& family = mesh.block(cell.type).families[cell.cell];
        std::vector<GroupIndex> inherited, wanted;
        for (const GroupIndex g : mesh.families.groups(family))
            if (surfaces_of.contains(g)) inherited.push_back(g);
        if (inherited.empty()) continue;
        const bool plane = planes[family] != 0;
        for (const Facet& f : std::ranges::equal_range(facets, std::pair(cell.type, cell.cell), {}, place))
            for (const GroupIndex surface : mesh.families.groups(f.family)) {
                const auto found = sets_for.find({surface, label_from_face(f.face, f.type, plane)});
                // Elements that the surface names by number stay so.
                if (found == sets_for.end() ||
                    std::ranges::none_of(inherited, [&](GroupIndex g) { return surfaces_of[g].contains(surface); }))
                    continue;
                const std::size_t before = wanted.size();
                for (const GroupIndex g : found->second)
                    if (std::ranges::find(inherited, g) != inherited.end()) wanted.push_back(g);
                if (wanted.size() == before) wanted.push_back(found->second.front());
            }
        FamilyIndex now = family;
        for (const GroupIndex g : inherited) now = mesh.families.without(now, g);
        for (const GroupIndex g : wanted) now = mesh.families.with(now, g);
        family = now;
    }
}

}  // namespace femscalpel
