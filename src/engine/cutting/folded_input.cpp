// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/folded_input.h"

#include <algorithm>
#include <set>
#include <sstream>

#include "cutting/mend_curved.h"
#include "deformation/curved_shape.h"
#include "words.h"

namespace femscalpel {
namespace {

/// Elements are mended until they are as good as operators want second-order elements to be.
constexpr double goal = curved_limit;
constexpr int rounds = 6;
/// A smaller gain does not count.
constexpr double least_gain = 1e-3;
/// So many elements at most are straightened for the sake of one.
constexpr std::size_t most_straightened = 100;
/// Numbers of elements (nodes) a message has at most.
constexpr std::size_t most_named = 40;

const Workpiece::FoldedElement* folded_origin(const Workpiece& f, BandElement e) {
    const auto found = f.folded_input.find({e.triangle, e.origin(f.d.band)});
    return found == f.folded_input.end() ? nullptr : &found->second;
}

std::string listed(std::vector<Index> numbers, const char* one) {
    std::ranges::sort(numbers);
    std::ostringstream text;
    text << one << (numbers.size() == 1 ? "" : "s");
    for (std::size_t k = 0; k < numbers.size() && k < most_named; ++k) text << (k ? ", " : " ") << numbers[k];
    if (numbers.size() > most_named) text << ", ...";
    return text.str();
}

/// Ends of the edges of an element.
std::vector<std::array<int, 2>> edges_of(const BandMesh& band, BandElement e) {
    std::vector<std::array<int, 2>> out;
    const auto nodes = e.nodes(band);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) out.push_back({nodes[i], nodes[j]});
    return out;
}

/// Moves mid-side nodes for the sake of folded elements.
class Unfolder {
public:
    explicit Unfolder(Deformable& d) : d_(d), band_(d.band) {}

    /// Straightens an element, and those around it that get worse by that; false, and all is as it was, if that does
    /// not help.
    bool straighten(BandElement folded) {
        std::vector<BandElement> chosen{folded};
        std::vector<std::pair<std::array<int, 2>, State>> moved;
        std::map<std::pair<bool, int>, double> wanted;  // of all elements around moved edges
        bool sound = true;
        for (std::size_t k = 0; k < chosen.size() && sound; ++k) {
            sound = chosen.size() <= most_straightened;
            std::vector<std::array<int, 2>> edges;
            for (const auto& ends : edges_of(band_, chosen[k]))
                if (may_move(ends) && !d_.mids.bulge(ends[0], ends[1]).isZero(0)) edges.push_back(ends);
            for (const auto& [a, b] : edges)
                for_second_order_at_edge(d_, a, b, [&](BandElement e) {
                    wanted.try_emplace({e.triangle, e.slot}, std::min(curved_shape(d_, e), goal));
                });
            for (const auto& ends : edges) {
                moved.push_back({ends, state(ends)});
                if (!move(ends, 1)) moved.pop_back();
            }
            if (k + 1 < chosen.size()) continue;
            for (const auto& [key, ratio] : wanted) {
                const BandElement e{key.first, key.second};
                if (curved_shape(d_, e) >= (e == folded ? std::min(goal, ratio + 0.05) : ratio)) continue;
                sound = sound && std::ranges::find(chosen, e) == chosen.end();
                chosen.push_back(e);
            }
        }
        if (sound && curved_shape(d_, folded) >= goal) return true;
        for (auto it = moved.rbegin(); it != moved.rend(); ++it) restore(it->first, it->second);
        return false;
    }

    /// Moves a single mid-side node as far as that helps the elements around it, and spoils none; true if it did.
    bool move_one(const std::array<int, 2>& ends) {
        if (!may_move(ends)) return false;
        std::vector<std::pair<BandElement, double>> around;
        for_second_order_at_edge(d_, ends[0], ends[1], [&](BandElement e) {
            around.push_back({e, std::min(curved_shape(d_, e), goal)});
        });
        const State was = state(ends);
        double best = 0, best_gain = least_gain;
        for (const double part : {1.0, 0.5, 0.25, 0.125}) {
            if (move(ends, part)) {
                double gain = 0;
                for (const auto& [e, before] : around) {
                    const double now = std::min(curved_shape(d_, e), goal);
                    gain = now < before ? -std::numeric_limits<double>::infinity() : gain + now - before;
                }
                if (gain > best_gain) {
                    best_gain = gain;
                    best = part;
                }
            }
            restore(ends, was);
        }
        return best > 0 && move(ends, best);
    }

private:
    struct State {
        Vec3 bulge;
        bool mended;
    };

    /// Whether all elements at the edge are here, and nothing holds its mid-side node.
    bool may_move(const std::array<int, 2>& ends) const {
        return (band_.nodes[ends[0]].movable() || band_.nodes[ends[1]].movable()) &&
               !d_.constraints.has_fixed_middle(ends[0], ends[1]);
    }

    State state(const std::array<int, 2>& ends) const {
        return {d_.mids.bulge(ends[0], ends[1]), d_.mids.is_mended(ends[0], ends[1])};
    }

    void restore(const std::array<int, 2>& ends, const State& was) {
        if (was.mended)
            d_.mids.mend(ends[0], ends[1], was.bulge);
        else
            d_.mids.put_back(ends[0], ends[1]);
    }

    /// By a part of the way to the middle of the edge, on the surface or curve it is on; false if there is no such
    /// place.
    bool move(const std::array<int, 2>& ends, double part) {
        const Vec3 chord = (band_.nodes[ends[0]].at + band_.nodes[ends[1]].at) / 2;
        const NodeConstraint on = d_.constraints.on_edge(band_, ends[0], ends[1]);
        Vec3 x = chord + (1 - part) * d_.mids.bulge(ends[0], ends[1]);
        if (!d_.constraints.is_straight(on) && !d_.constraints.project(on, {}, x)) return false;
        d_.mids.mend(ends[0], ends[1], x - chord);
        return true;
    }

    Deformable& d_;
    const BandMesh& band_;
};

/// Whether an element is not what it was, its mid-side nodes apart.
bool is_touched(const Deformable& d, BandElement e) {
    const BandMesh& band = d.band;
    return e.is_changed(band) || std::ranges::any_of(edges_of(band, e), [&](const auto& ends) {
               return static_cast<bool>(d.edge_contact(ends[0], ends[1]));
           });
}

/// Which mid-side nodes that were moved have to stay so.
class MiddleChooser {
public:
    explicit MiddleChooser(Deformable& d) : d_(d) {
        for (const auto& [key, before] : d.mids.mended()) {
            const std::array<int, 2> ends{static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffffu)};
            moved_.push_back({ends, d.mids.bulge(ends[0], ends[1])});
        }
        std::ranges::sort(moved_, {}, &Moved::ends);
        std::vector<BandElement> around;
        for (const Moved& m : moved_)
            for_second_order_at_edge(d, m.ends[0], m.ends[1], [&](BandElement e) {
                if (std::ranges::find(around, e) == around.end()) around.push_back(e);
            });
        for (const BandElement e : around) elements_.push_back({e, std::min(curved_shape(d, e), goal)});
    }

    void run() {
        for (const Moved& m : moved_) d_.mids.put_back(m.ends[0], m.ends[1]);
        // An untouched element need not be better than it was.
        for (Element& e : elements_)
            if (!is_touched(d_, e.element)) e.wanted = std::min(e.wanted, curved_shape(d_, e.element));
        for (bool any = true; any;) {
            any = false;
            for (const Element& e : elements_)
                if (curved_shape(d_, e.element) < e.wanted) any = move_again(e.element) || any;
        }
    }

private:
    struct Moved {
        std::array<int, 2> ends;
        Vec3 bulge;
    };
    struct Element {
        BandElement element;
        double wanted;
    };

    bool move_again(BandElement e) {
        bool any = false;
        const auto nodes = e.nodes(d_.band);
        for (const Moved& m : moved_) {
            if (std::ranges::any_of(m.ends, [&](int v) { return std::ranges::find(nodes, v) == nodes.end(); }) ||
                d_.mids.is_mended(m.ends[0], m.ends[1]))
                continue;
            d_.mids.mend(m.ends[0], m.ends[1], m.bulge);
            any = true;
        }
        return any;
    }

    Deformable& d_;
    std::vector<Moved> moved_;
    std::vector<Element> elements_;
};

}  // namespace

void find_folded_input(Workpiece& f, const Mesh& mesh) {
    const BandMesh& band = f.d.band;
    std::vector<Index> at_integration_points;
    for (const bool triangle : {false, true})
        for (int s = 0; s < (triangle ? band.triangles.size() : band.tetras.size()); ++s) {
            const BandElement e{triangle, s};
            if (!is_second_order(f.d, e)) continue;
            const CellRef& c = e.cell(band);
            const auto nodes = mesh.block(c.type).nodes(c.cell);
            std::array<Vec3, 10> x;
            std::ranges::transform(nodes, x.begin(), [&](Index n) { return mesh.points[n]; });
            const auto points = std::span<const Vec3>(x).first(nodes.size());
            const double ratio = curved_ratio(points);
            if (ratio >= goal) continue;
            const Index id = mesh.block(c.type).ids[c.cell];
            if (!(integration_ratio(points) > 0))
                at_integration_points.push_back(id);
            else
                f.folded_input[{triangle, s}] = {id, ratio, false};
        }
    if (at_integration_points.empty()) return;
    throw QualityError(
        "the mesh already has " + counted(static_cast<Index>(at_integration_points.size()), "second-order element") +
        " near the tool, folded (" + listed(at_integration_points, "element") +
        ") where solvers integrate: move their mid-side nodes nearer to the middle of their edges first");
}

void mend_folded_input(Workpiece& f) {
    Unfolder unfolder(f.d);
    const auto is_bad = [&](const auto& key) { return curved_shape(f.d, {key.first, key.second}) < goal; };
    bool any = true;
    for (int round = 0; round < rounds && any; ++round) {
        any = false;
        for (const auto& [key, folded] : f.folded_input) {
            const BandElement e{key.first, key.second};
            if (is_bad(key)) any = unfolder.straighten(e) || any;
            for (const auto& ends : edges_of(f.d.band, e))
                if (is_bad(key)) any = unfolder.move_one(ends) || any;
        }
    }
    for (auto& [key, folded] : f.folded_input)
        folded.mended = curved_shape(f.d, {key.first, key.second}) >= least_curved;
}

void put_back_middles(Workpiece& f, const Mesh& mesh) {
    if (f.folded_input.empty()) return;
    MiddleChooser(f.d).run();
    std::vector<Index> moved;
    for (const auto& [key, bulge] : f.d.mids.mended())
        if (const auto mid = f.d.band.mid_nodes.find(key); mid != f.d.band.mid_nodes.end())
            moved.push_back(mesh.node_ids[mid->second]);
    std::vector<Index> numbers;
    for (const auto& [key, folded] : f.folded_input)
        if (folded.ratio < least_curved) numbers.push_back(folded.id);
    std::ostringstream text;
    const std::string moves =
        moved.empty() ? ""
                      : counted(static_cast<Index>(moved.size()), "mid-side node was", "mid-side nodes were") +
                            " moved towards the middle of their edges (" + listed(moved, "node") + ")";
    if (!numbers.empty()) {
        text << "the mesh already has " << counted(static_cast<Index>(numbers.size()), "second-order element")
             << " near the tool, folded at a corner, or nearly, though not where "
                "solvers integrate ("
             << listed(numbers, "element") << "): ";
        if (moved.empty())
            text << "those that were not cut stay as they are";
        else
            text << "where they changed, " << moves << "; the others stay as they are";
    } else if (!moved.empty()) {
        text << moves << ", where strongly curved second-order elements changed";
    } else
        return;
    f.warnings.push_back(text.str());
}

std::vector<BandElement> newly_folded(const Workpiece& f, std::vector<BandElement> elements) {
    if (f.folded_input.empty()) return elements;
    constexpr double rounding = 1e-9;
    std::erase_if(elements, [&](BandElement e) {
        const auto* folded = folded_origin(f, e);
        return folded && curved_shape(f.d, e) >= folded->ratio - rounding &&
               curved_shape(f.d, e, ShapeAt::integration_points) > 0;
    });
    return elements;
}

void check_folded_input(const Workpiece& f, std::span<const BandElement> elements) {
    std::set<Index> numbers;
    for (const BandElement e : elements)
        if (const auto* folded = folded_origin(f, e); folded && !folded->mended) numbers.insert(folded->id);
    if (numbers.empty()) return;
    throw QualityError("the mesh already has " + counted(static_cast<Index>(numbers.size()), "second-order element") +
                       " in the way of the tool, folded at a corner (" +
                       listed({numbers.begin(), numbers.end()}, "element") +
                       ") and cannot be changed as they are: move their mid-side nodes nearer to the middle of their "
                       "edges first (meshers can: Gmsh calls it high-order optimisation), or take them out of the "
                       "groups and cards that hold them, if any do");
}

}  // namespace femscalpel
