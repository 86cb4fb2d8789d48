// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/poor.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "cancel.h"
#include "cutting/weld.h"
#include "mesh/quality.h"
#include "words.h"

namespace femscalpel {
namespace {

/// Mean ratio below which no element may be without a word, and the part of the input's worst that is as bad.
constexpr double poor_ratio = 0.02, part_of_worst = 0.1;
/// What was said of an element holds as long as it is no worse than this part of that.
constexpr double as_said = 0.99;

/// Elements between the tool and what is so many edge lengths away have no reason to be poor.
constexpr double roomy = 0.15;

/// A node that is held this far beside the tool, in edge lengths, is worth a warning.
constexpr double worth_a_word = 1e-5;

/// So many elements and groups are named.
constexpr std::size_t named = 5;

/// What keeps nodes from moving freely.
struct Holders {
    std::set<std::string> groups;
    std::set<std::string> features;

    bool any() const { return !groups.empty() || !features.empty(); }
    auto operator<=>(const Holders&) const = default;
};

void add_holders(const Workpiece& f, const Mesh& mesh, int node, Holders& out) {
    const NodeConstraints& constraints = f.d.constraints;
    if (f.d.contact[node].count() > 1) out.features.insert("an edge of the tool");
    const NodeFreedom freedom = constraints[node].freedom;
    if (freedom == NodeFreedom::free) return;
    const std::size_t before = out.groups.size() + out.features.size();
    for (const GroupIndex g : constraints.groups_at(f.d.band, node)) {
        const Group& group = mesh.groups[g];
        if (!group.hidden)
            out.groups.insert(group.name);
        else if (group.name == weld_group || group.name == weld_rim_group)
            out.features.insert("double nodes");
        else
            out.features.insert("a card of the solver's input");
    }
    const std::size_t lines = f.d.band.creases.around(node).size();
    if (constraints.is_on_skin(f.d.band, node))
        out.features.insert(lines == 0 ? "the skin" : lines == 2 ? "a feature line" : "a corner");
    if (out.groups.size() + out.features.size() == before) out.features.insert("the elements around them");
}

std::string join(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t k = 0; k < words.size() && k < named; ++k) text += (k ? ", " : "") + words[k];
    if (words.size() > named) text += ", ... (" + std::to_string(words.size()) + " in all)";
    return text;
}

/// "the skin, a corner, and the borders of A, B"
std::string describe(const Holders& holders) {
    std::vector<std::string> groups;
    groups.reserve(holders.groups.size());
    for (const std::string& g : holders.groups) groups.push_back("'" + g + "'");
    std::string text = join({holders.features.begin(), holders.features.end()});
    if (!groups.empty()) text += (text.empty() ? "the border of " : " and the border of ") + join(groups);
    return text;
}

std::vector<std::string> listed(const std::set<std::string>& words) { return {words.begin(), words.end()}; }

struct PoorElement {
    double quality;
    Index id;
    std::array<int, 4> nodes;  ///< the last is -1 for a triangle
};

std::vector<PoorElement> elements_below(double limit, const Workpiece& f, const Mesh& mesh) {
    const BandMesh& band = f.d.band;
    std::vector<PoorElement> out;
    for (int t = 0; t < band.tetras.size(); ++t)
        if (band.tetras.alive(t) && tetra_is_below(limit, f.d, t)) {
            const CellRef& c = band.tetra_cells[band.tetras.origin(t)];
            out.push_back({tetra_quality(f.d, t), mesh.block(c.type).ids[c.cell], band.tetras[t]});
        }
    for (int t = 0; t < band.triangles.size(); ++t) {
        if (!band.triangles.alive(t)) continue;
        const auto& n = band.triangles[t];
        const bool shell = f.d.constraints.is_shell(band.triangles.origin(t));
        // Faces of a solid with elements of their own: those that have changed.
        if (!shell && !band.is_changed(band.triangles, t)) continue;
        const auto at = [&](int k) -> const Vec3& { return band.nodes[n[k]].at; };
        const double quality = shell ? shell_quality(f.d, t) : mean_ratio(at(0), at(1), at(2));
        if (!(quality < limit)) continue;
        const CellRef& c = band.triangle_cells[band.triangles.origin(t)];
        out.push_back({quality, mesh.block(c.type).ids[c.cell], {n[0], n[1], n[2], -1}});
    }
    std::ranges::sort(out, {}, [](const PoorElement& e) { return std::pair(e.quality, e.id); });
    return out;
}

/// What is to be said of the place where a poor element is, and what holds its nodes.
PoorPlace look_at(const PoorElement& e, const Workpiece& f, const Mesh& mesh, Holders& holders) {
    PoorPlace out;
    Vec3 middle = Vec3::Zero();
    double gap = 0, edge = 0;
    int count = 0;
    for (const int v : e.nodes) {
        if (v < 0) continue;
        add_holders(f, mesh, v, holders);
        middle += f.d.band.nodes[v].at;
        edge += f.d.band.mean_edge_length(v);
        gap = std::max(gap, std::abs(f.tool->distance(f.d.band.nodes[v].at)));
        ++count;
    }
    out.mean_ratio = e.quality;
    out.place = middle / count;
    out.gap = gap;
    out.room = roomy * edge / count;
    out.groups = listed(holders.groups);
    out.features = listed(holders.features);
    return out;
}

std::string advice(const PoorPlace& place, const Holders& holders, const std::string& tool) {
    std::ostringstream text;
    text.precision(3);
    text << "poor elements, with a mean ratio down to " << place.mean_ratio << ", near (" << place.place.transpose()
         << ")";
    const bool between = place.gap <= place.room;
    if (between)
        text << ", between the " << tool << " and " << describe(holders) << ", which leave no room for better ones. ";
    else
        text << ", up to " << place.gap << " from the " << tool << ", held by " << describe(holders) << ". ";
    if (!place.groups.empty()) text << "Leave " << join(place.groups) << " out of preserve, or ";
    if (between)
        text << (place.groups.empty() ? "Move" : "move") << " the " << tool << " there by " << place.gap
             << " towards it or by " << place.room - place.gap << " away from it";
    else
        text << (place.groups.empty() ? "Refine" : "refine") << " the mesh there first";
    return text.str();
}

}  // namespace

double poor_limit(double worst_before) { return std::min(poor_ratio, part_of_worst * worst_before); }

PoorestElement poorest_at(const Mesh& mesh, const std::vector<Index>& nodes) {
    std::vector<char> looked_at(mesh.points.size(), 0);
    for (const Index n : nodes) looked_at[n] = 1;
    const int dimension = mesh.dimension() == 3 ? 3 : 2;
    PoorestElement out;
    CellRef worst{};
    SparseCheck check;
    for (const CellBlock& b : mesh.blocks()) {
        if (traits(b.type).dimension < dimension) continue;
        for (Index c = 0; c < b.size(); ++c) {
            check();
            if (std::ranges::none_of(b.nodes(c), [&](Index n) { return looked_at[n] != 0; })) continue;
            const double quality = mean_ratio(mesh, b.type, c);
            if (quality >= out.mean_ratio) continue;
            out.mean_ratio = quality;
            out.id = b.ids[c];
            worst = {b.type, c};
        }
    }
    if (out.id < 0) return out;
    const CellTraits& t = traits(worst.type);
    const auto n = mesh.block(worst.type).nodes(worst.cell);
    for (int k = 0; k < t.corners; ++k) out.place += mesh.points[n[k]] / t.corners;
    return out;
}

void check_poorest(const PoorestElement& poorest, double worst_before, const std::vector<PoorPlace>& said,
                   const std::string& advice, const char* parameter) {
    double known = 1;
    for (const PoorPlace& p : said) known = std::min(known, p.mean_ratio);
    if (poorest.id < 0 || poorest.mean_ratio >= poor_limit(worst_before) || poorest.mean_ratio >= as_said * known)
        return;
    std::ostringstream text;
    text.precision(3);
    text << "an element near (" << poorest.place.transpose() << ") would have a mean ratio of " << poorest.mean_ratio
         << ". " << advice;
    throw QualityError(text.str(), parameter);
}

HeldNodes find_held_nodes(Workpiece& f, const Mesh& mesh) {
    HeldNodes out;
    Holders holders;
    bool seen = false;
    for (int v = 0; v < f.d.band.size(); ++v) {
        if (f.d.held_off[v] == 0 || !f.d.band.in_use(v)) continue;
        // Nodes made where a seam's lines end are where they belong.
        if (f.d.band.is_new(v) && f.d.contact[v].count() > 1) continue;
        ++out.count;
        out.largest = std::max(out.largest, f.d.held_off[v]);
        seen = seen || f.d.held_off[v] > worth_a_word * f.d.band.mean_edge_length(v);
        add_holders(f, mesh, v, holders);
    }
    out.groups = listed(holders.groups);
    out.features = listed(holders.features);
    if (out.largest <= std::max(f.tolerance, f.d.rounding) || !seen) return out;
    std::ostringstream text;
    text << "the " << f.tool->kind() << " passes " << counted(out.count, "node") << ", held by " << describe(holders)
         << ", at up to " << out.largest
         << ": it goes through them where they are, or ends there, as elements in between would be too flat";
    f.warnings.push_back(text.str());
    return out;
}

std::vector<PoorPlace> find_poor_places(Workpiece& f, const Mesh& mesh, double worst_before) {
    std::map<Holders, PoorPlace> places;
    for (const PoorElement& e : elements_below(poor_limit(worst_before), f, mesh)) {
        Holders holders;
        PoorPlace place = look_at(e, f, mesh, holders);
        if (!holders.any()) {
            std::ostringstream text;
            text << "an element near (" << place.place.transpose() << "), part of element " << e.id
                 << ", would have a mean ratio of " << e.quality << " though nothing there holds its nodes. Move the "
                 << f.tool->kind() << " a little, or refine the mesh there";
            throw QualityError(text.str());
        }
        // The worst comes first, and stands for all.
        std::vector<Index>& elements = places.try_emplace(std::move(holders), std::move(place)).first->second.elements;
        if (std::ranges::find(elements, e.id) == elements.end()) elements.push_back(e.id);
    }
    std::vector<std::pair<PoorPlace, Holders>> found;
    found.reserve(places.size());
    for (auto& [holders, place] : places) found.push_back({std::move(place), holders});
    std::ranges::sort(found, {}, [](const auto& p) { return p.first.mean_ratio; });
    std::vector<PoorPlace> out;
    out.reserve(found.size());
    for (auto& [place, holders] : found) {
        f.warnings.push_back(advice(place, holders, f.tool->kind()));
        out.push_back(std::move(place));
    }
    return out;
}

}  // namespace femscalpel
