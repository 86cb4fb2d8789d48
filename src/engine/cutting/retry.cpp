// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/retry.h"

#include <cmath>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>

#include "cancel.h"
#include "cutting/folded_input.h"
#include "cutting/mend_curved.h"
#include "cutting/straighten.h"
#include "cutting/workpiece.h"
#include "deformation/curved_shape.h"
#include "mesh/quality.h"

namespace femscalpel {
namespace {

/// The part for is_beside() where elements came out poor enough to try again; where that is not enough, far_beside.
constexpr double poor_beside = 2e-3;
/// A new node may be this many edge lengths off the curved surface or curve it was born on.
constexpr double largest_misfit = 5e-4;
/// Elements below this mean ratio are refined before another try.
constexpr double poor_quality = 0.1;
/// The same in second-order meshes, where mending curved elements costs their corners' shape.
constexpr double second_order_quality = 0.27;
/// Elements below this would be an error, or need one's attention: poor.h. Their nodes are rather held beside the tool.
constexpr double hold_quality = 0.02;
/// After so many tries with sound elements the best is taken; while that is below poor_quality, after so many.
constexpr int polishings = 5, hard_polishings = 8;
/// Beside a curved tool, whose walls come out better where it was refined, nodes are held farther only after so many.
constexpr int tries_before_far = 2;
/// A band is refined to so many times its elements at most, and by so many times the mesh's: it would grow for ever
/// along a wall too thin for elements, and what is cut in the end should not be another mesh.
constexpr double largest_growth = 4, largest_part = 1;
/// The same of dividing elements for better ones after the cut.
constexpr double largest_part_after = 2.75;
/// All tries together may move nodes so often, and so many times more for each element of the band: some seconds, where
/// second-order elements make it slow.
constexpr double fewest_visits = 1.5e5, visits_per_element = 2.5;
/// The last resort is taken though there is a result if it is so many times as good.
constexpr double much_better = 1.5;
/// For that, mid-side nodes may be so many edge lengths beside their surface where elements are worse than half of
/// poor_quality otherwise, and any where they would be an error.
constexpr double little_straightened = 0.035;
/// A curved mesh with elements below this is returned only if nothing better is found; below the other never.
constexpr double degenerate_quality = 0.01, flat = 1e-6;

/// Elements of the input, by slot, and where in them something went wrong.
struct Slots {
    std::vector<int> tetras, triangles;
    std::vector<Vec3> places;

    bool empty() const { return tetras.empty() && triangles.empty(); }
    void tidy() {
        for (std::vector<int>* list : {&tetras, &triangles}) {
            std::ranges::sort(*list);
            list->erase(std::unique(list->begin(), list->end()), list->end());
        }
    }
};

Vec3 middle_of(const BandMesh& band, const auto& nodes) {
    Vec3 sum = Vec3::Zero();
    for (const int v : nodes) sum += band.nodes[v].at;
    return sum / static_cast<double>(nodes.size());
}

/// Those in which new nodes are off their tools or the curved skin they were born on, or parts came out as folded
/// second-order elements.
Slots misfits(const Workpiece& f) {
    const BandMesh& band = f.d.band;
    Slots found;
    for (const BandElement e : newly_folded(f, folded_elements(f, least_curved))) {
        (e.triangle ? found.triangles : found.tetras).push_back(e.origin(band));
        found.places.push_back(middle_of(band, e.nodes(band)));
    }
    for (int v = band.original_nodes(); v < band.size(); ++v) {
        if (!band.in_use(v)) continue;
        const NodeConstraint& c = f.d.constraints[v];
        const double allowed = f.d.constraints.is_straight(c) ? std::max(10 * f.tolerance, f.d.rounding)
                                                              : largest_misfit * band.mean_edge_length(v);
        const bool on_shape = f.d.constraints.distance(c, band.nodes[v].at) <= allowed;
        if (on_shape && f.d.off_tools(v) <= 10 * f.tolerance) continue;
        found.places.push_back(band.nodes[v].at);
        for (const int t : band.tetras.around(v)) found.tetras.push_back(band.tetras.origin(t));
        for (const int t : band.triangles.around(v)) found.triangles.push_back(band.triangles.origin(t));
    }
    found.tidy();
    return found;
}

/// The smallest mean ratio of the tetrahedra and shells that were changed, and those that have parts below `limit`.
double poorest(const Workpiece& f, double limit, Slots& poor) {
    const BandMesh& band = f.d.band;
    double worst = 1;
    SparseCheck check;
    const auto look = [&](const auto& list, std::vector<int>& origins, auto quality_of) {
        for (int s = 0; s < list.size(); ++s) {
            if (!list.alive(s) || !band.is_changed(list, s)) continue;
            check();
            const double quality = quality_of(s);
            worst = std::min(worst, quality);
            if (quality >= limit) continue;
            origins.push_back(list.origin(s));
            poor.places.push_back(middle_of(band, list[s]));
        }
    };
    look(band.tetras, poor.tetras, [&](int t) { return tetra_quality(f.d, t); });
    look(band.triangles, poor.triangles,
         [&](int t) { return f.d.constraints.is_shell(band.triangles.origin(t)) ? shell_quality(f.d, t) : 1.0; });
    poor.tidy();
    return worst;
}

/// Calls visit(nodes) for the parts of some elements.
void for_parts(const BandMesh& band, const Slots& slots, auto visit) {
    const auto look = [&](const auto& list, const std::vector<int>& origins) {
        if (origins.empty()) return;
        for (int s = 0; s < list.size(); ++s)
            if (list.alive(s) && std::ranges::binary_search(origins, list.origin(s))) visit(list[s]);
    };
    look(band.tetras, slots.tetras);
    look(band.triangles, slots.triangles);
}

/// How many face and line elements with a node held beside the tool lie on it between two sides of the material: lips
/// would have each twice, and with it what it carries.
int elements_laid_flat(const Workpiece& f) {
    const BandMesh& band = f.d.band;
    const auto touches = [&](int v) { return f.d.contact[v].has(f.tool); };
    const auto is_parted = [&](const auto& nodes) {
        bool positive = false, negative = false;
        const auto look = [&](const auto& list, int s) {
            const auto& own = list[s];
            if (!std::ranges::all_of(nodes, [&](int v) { return std::ranges::find(own, v) != own.end(); })) return;
            for (const int v : own) {
                positive = positive || (!touches(v) && f.distance[v] > 0);
                negative = negative || (!touches(v) && f.distance[v] < 0);
            }
        };
        for (const int s : band.tetras.around(nodes[0])) look(band.tetras, s);
        for (const int s : band.triangles.around(nodes[0]))
            if (f.d.constraints.is_shell(band.triangles.origin(s))) look(band.triangles, s);
        return positive && negative;
    };
    int count = 0;
    const auto look = [&](const auto& list, auto counts) {
        for (int s = 0; s < list.size(); ++s)
            if (list.alive(s) && counts(s) && std::ranges::all_of(list[s], touches) &&
                std::ranges::any_of(list[s], [&](int v) { return f.d.held_off[v] > 0; }))
                count += is_parted(list[s]);
    };
    look(band.lines, [](int) { return true; });
    look(band.triangles, [&](int s) { return !f.d.constraints.is_shell(band.triangles.origin(s)); });
    return count;
}

int element_count(const BandMesh& band) { return band.tetras.size() + band.triangles.size(); }

/// Bisects the edges of some elements, longest first; of those already divided, the parts at the places only. Halves
/// bulge a quarter as far, so that a tool finds room between a curved skin and its chords where it found none. The band
/// grows to about `most_elements`.
void refine(Workpiece& f, const Slots& slots, double most_elements) {
    BandMesh& band = f.d.band;
    std::vector<std::tuple<double, int, int>> edges;
    for_parts(band, slots, [&](const auto& nodes) {
        const Vec3 middle = middle_of(band, nodes);
        double longest = 0;
        for (const int a : nodes)
            for (const int b : nodes) longest = std::max(longest, (band.nodes[a].at - band.nodes[b].at).squaredNorm());
        const bool divided = std::ranges::any_of(nodes, [&](int v) { return band.is_new(v); });
        if (divided &&
            std::ranges::none_of(slots.places, [&](const Vec3& x) { return (x - middle).squaredNorm() <= longest; }))
            return;
        for (const int a : nodes)
            for (const int b : nodes)
                if (a < b && (band.nodes[a].movable() || band.nodes[b].movable()))
                    edges.push_back({-(band.nodes[a].at - band.nodes[b].at).norm(), a, b});
    });
    std::ranges::sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [length, a, b] : edges) {
        if (element_count(band) >= most_elements) break;
        // With both ends on the tool the halves would have to be, too.
        if (f.d.contact[a].common(f.d.contact[b]) || f.d.constraints.has_fixed_middle(a, b)) continue;
        if (f.kept_edges.contains({a, b})) continue;
        const Deformable::SplitPoint point = f.d.fitted_split(a, b, f.d.along_edge(a, b, 0.5), {});
        if (!point.fits || !(point.worst > 0.1)) continue;
        f.split_edge(a, b, point.at, {});
    }
}

/// Lets the nodes of poor elements be held where the tool passed them by up to `part`; false if there are none.
bool allow_to_hold(Workpiece& start, const Workpiece& cut, double part) {
    Slots poor;
    poorest(cut, poor_quality, poor);
    start.may_hold.assign(static_cast<std::size_t>(start.d.band.size()), 0);
    bool any = false;
    for_parts(start.d.band, poor, [&](const auto& nodes) {
        for (const int v : nodes) {
            start.may_hold[v] = part;
            const auto passed = cut.passed.find(v);
            any = any || (passed != cut.passed.end() && passed->second <= part);
        }
    });
    if (!any) start.may_hold.clear();
    return any;
}

[[noreturn]] void fail_at(const Workpiece& f, const Slots& slots) {
    std::optional<Vec3> place;
    bool skin = false;
    for_parts(f.d.band, slots, [&](const auto& nodes) {
        if (!place) place = f.d.band.nodes[nodes[0]].start;
        skin = skin || std::ranges::any_of(nodes, [&](int v) { return f.d.constraints.is_exterior(v); });
    });
    std::ostringstream text;
    text << "no sound elements were found where the " << f.tool->kind()
         << (skin ? " meets the skin" : " passes inside the material");
    if (place) text << " near (" << place->transpose() << ")";
    text << ": the mesh is too coarse there, or only a thin layer of material is left"
         << (skin ? "" : " between it and a border") << ". Move the " << f.tool->kind()
         << " a little, or refine the mesh";
    throw QualityError(text.str());
}

/// One call of cut_soundly().
class Tries {
public:
    Tries(Workpiece& f, const std::function<void(Workpiece&)>& cut, Index mesh_elements, int attempts, bool whole_tool)
        : f_(f),
          cut_(cut),
          mesh_elements_(static_cast<double>(mesh_elements)),
          attempts_(attempts),
          lips_of_node_(whole_tool ? 4 : 0),
          plain_(whole_tool && !f.d.mids.any() && !f.d.constraints.any_curved() &&
                 !std::isfinite(f.tool->feature_size())),
          best_quality_(plain_ ? -std::numeric_limits<double>::infinity() : degenerate_quality) {
        // Deformable::visits counts on from one try to the next.
        f.most_visits = f.d.visits + static_cast<long>(fewest_visits + visits_per_element * elements_);
        f.most_elements = elements_ + largest_part_after * mesh_elements_;
        start_ = f;
    }

    void run() {
        for (int attempt = 1;; ++attempt) {
            check_cancelled();
            cut_(f_);
            start_->d.visits = f_.d.visits;
            Slots bad = misfits(f_);
            // What could not be mended before does not get better by trying again; once, a plane may pass beside it.
            if (attempt > 1) check_folded_input(f_, newly_folded(f_, folded_elements(f_, least_curved)));
            bool sound = bad.empty();
            if (sound) {
                const Verdict verdict = judge(bad);
                if (verdict == Verdict::good) return;
                if (verdict == Verdict::settled) break;
            }
            const bool in_vain = before_held_ && (!sound || !is_best_);
            if (before_held_) {
                if (in_vain) {  // goes on as if it had not been tried
                    std::tie(bad, sound) = std::move(*before_held_);
                    start_->may_hold.clear();
                    if (!sound) {  // nor cost anything
                        --attempt;
                        start_->most_visits += start_->d.visits - visits_before_held_;
                    }
                }
                before_held_.reset();
            }
            if (attempt >= attempts_ || is_exhausted()) {
                if (!in_vain && try_to_hold(bad, sound, true)) continue;
                if (!best_) try_straight(sound);
                if (!best_ && !resort_) fail_at(f_, bad);
                break;
            }
            if (!in_vain && try_to_hold(bad, sound, false)) continue;
            if (!choose_otherwise(bad, sound, attempt)) break;
            f_ = *start_;
        }
        if (best_ && best_quality_ < poor_quality) try_straight(true);
        take_best();
    }

private:
    enum class Verdict { good, settled, again };

    /// What was cut last.
    const Workpiece& made() const { return is_best_ ? *best_ : f_; }

    /// Of sound elements: whether they are good enough, or the best there are. Where they are `poor` goes there.
    Verdict judge(Slots& poor) {
        const double enough = f_.d.mids.any() ? second_order_quality : poor_quality;
        const double quality = poorest(f_, std::max(1.5 * poor_quality, enough), poor);
        const bool too_far = best_ && held_far_ && cuts_less(f_);
        if (quality >= enough && !too_far) return Verdict::good;
        is_best_ =
            quality > best_quality_ && !too_far && !(grows_too_far(f_) && best_ && best_quality_ >= hold_quality);
        if (is_best_) {
            best_quality_ = quality;
            best_ = std::move(f_);
        } else {
            if (!best_) keep_resort(Workpiece(f_), quality);
            start_->may_hold.clear();
        }
        // Among flat surfaces a plane's geometry limits the quality, but for nodes that it passes too closely.
        if (plain_ && quality >= poor_quality) return Verdict::settled;
        const int enough_tries = best_quality_ < poor_quality ? hard_polishings : polishings;
        if (!before_held_) ++polished_;
        return polished_ >= enough_tries && best_ ? Verdict::settled : Verdict::again;
    }

    /// Whether the tool still passes through the mesh: of a corner cut off, all may have been held.
    static bool has_two_sides(const Workpiece& f) {
        bool positive = false, negative = false;
        for (int v = 0; v < f.d.band.size(); ++v) {
            if (!f.d.band.in_use(v)) continue;
            positive = positive || f.distance[v] > 0;
            negative = negative || f.distance[v] < 0;
        }
        return positive && negative;
    }

    /// Whether nodes were held so far beside the tool that it no longer cuts what the best one cuts.
    bool cuts_less(const Workpiece& f) const {
        return !has_two_sides(f) || elements_laid_flat(f) > elements_laid_flat(*best_);
    }

    bool grows_too_far(const Workpiece& f) const {
        const double lips = lips_of_node_ * static_cast<double>(f.nodes.size());
        return element_count(f.d.band) + lips - elements_ > (largest_growth - 1) * mesh_elements_;
    }

    bool is_exhausted() const {
        return element_count(start_->d.band) >= most_elements_ || start_->d.visits >= start_->most_visits;
    }

    /// First the nodes of `bad` elements are not put on the tool, then the elements are refined; a curved tool would
    /// get farther into elements whose nodes are not put on it. False when nothing else is to be tried.
    bool choose_otherwise(const Slots& bad, bool sound, int attempt) {
        std::vector<char>& off_tool = start_->d.off_tool;
        if (plain_ && sound) {
            return false;
        } else if (attempt % 2 == 1 && !sound && !std::isfinite(start_->tool->feature_size())) {
            for_parts(start_->d.band, bad, [&](const auto& nodes) {
                for (const int v : nodes) off_tool[v] = 1;
            });
        } else {
            refine(*start_, bad, most_elements_);
            std::ranges::fill(off_tool, 0);
        }
        is_best_ = false;
        return true;
    }

    /// Lets nodes of poor elements be held beside the tool: once near ones, once farther ones; beside a curved tool
    /// those only where refining was tried and did not help, or as the `last` thing to try. False when there are none
    /// for it.
    bool try_to_hold(const Slots& bad, bool sound, bool last) {
        if ((!sound && !start_->d.mids.any()) || best_quality_ >= poor_quality) return false;
        const double nearest = best_quality_ < hold_quality && (sound || last) ? along_beside : poor_beside;
        bool& near = sound || last ? held_near_ : held_folded_;
        for (const auto& [part, tried] : {std::pair(nearest, &near), std::pair(far_beside, &held_far_)}) {
            if (*tried || (tried == &held_far_ && !last && !may_hold_far())) continue;
            if (!allow_to_hold(*start_, made(), part)) continue;
            *tried = true;
            if (tried != &held_near_) before_held_ = {bad, sound};
            visits_before_held_ = start_->d.visits;
            is_best_ = false;
            if (last) start_->most_visits = start_->d.visits + static_cast<long>(fewest_visits / 3);
            f_ = *start_;
            return true;
        }
        return false;
    }

    bool may_hold_far() const { return polished_ >= tries_before_far || !std::isfinite(start_->tool->feature_size()); }

    /// What there is when no try gives sound elements that are good enough: the best of those that are not, or of those
    /// with straight edges where curved ones are folded.
    void keep_resort(Workpiece made, double quality) {
        if (!(quality > flat) || quality <= resort_quality_) return;
        resort_ = std::move(made);
        resort_quality_ = quality;
    }

    void keep_straightened(Workpiece made) {
        if (!straighten_folded(made)) return;
        Slots poor;
        const double quality = poorest(made, 0, poor);
        keep_resort(std::move(made), quality);
    }

    /// Where curved elements were folded each time, or poor: straightens them; and cuts as if all were straight, where
    /// corners find places that are not looked for among curved elements, to straighten only what is folded then.
    void try_straight(bool sound) {
        if (!start_->d.mids.any()) return;
        if (!sound) keep_straightened(f_);
        if (!best_ && resort_quality_ >= poor_quality) return;
        std::ranges::fill(start_->d.off_tool, 0);
        for (const bool held : {false, true}) {
            check_cancelled();
            Workpiece made = *start_;
            made.most_visits = made.d.visits + static_cast<long>(fewest_visits / 3);
            made.d.mids.ignore(true);
            cut_(made);
            made.d.mids.ignore(false);
            Slots poor;
            const bool again =
                !held && poorest(made, 0, poor) < poor_quality && allow_to_hold(*start_, made, along_beside);
            keep_straightened(std::move(made));
            if (!again) break;
        }
    }

    /// Whether corners found by far better places when curved elements were not looked at, and none had to be
    /// straightened then, or little beside elements that are so poor otherwise.
    bool is_resort_better() const {
        return resort_ && resort_quality_ > much_better * best_quality_ &&
               (resort_->straightened == 0 || best_quality_ < hold_quality ||
                (resort_->straightened_part <= little_straightened && best_quality_ < poor_quality / 2)) &&
               !cuts_less(*resort_) && !grows_too_far(*resort_);
    }

    void take_best() {
        if (!best_ || is_resort_better()) {
            best_ = std::move(resort_);
            best_quality_ = resort_quality_;
        }
        f_ = std::move(*best_);
        if (best_quality_ >= poor_quality || plain_) return;
        std::ostringstream text;
        text.precision(2);
        text << "the " << f_.tool->kind()
             << " meets surfaces and borders so that elements there come out with a mean ratio of " << best_quality_
             << " at best: refine the mesh there for better ones";
        f_.warnings.push_back(text.str());
    }

    Workpiece& f_;
    const std::function<void(Workpiece&)>& cut_;
    const double mesh_elements_;
    const int attempts_;
    const double lips_of_node_;  // elements that lips will be: about twice as many on either side as nodes on the tool
    const bool plain_;           // flat tool, flat surfaces, straight elements
    const double elements_ = element_count(f_.d.band);
    const double most_elements_ = std::min(largest_growth * elements_, elements_ + largest_part * mesh_elements_);
    std::optional<Workpiece> start_;  // what the next try begins with
    std::optional<Workpiece> best_;
    double best_quality_;
    std::optional<Workpiece> resort_;  // taken if there is no best one
    double resort_quality_ = 0;
    bool is_best_ = false;  // the last one is: f_ was moved there
    // Bad elements of the last try, and whether they were sound, when this one holds nodes that may not help.
    std::optional<std::pair<Slots, bool>> before_held_;
    long visits_before_held_ = 0;
    bool held_folded_ = false, held_near_ = false, held_far_ = false;  // was tried
    int polished_ = 0;
};

}  // namespace

void cut_soundly(Workpiece& f, const std::function<void(Workpiece&)>& cut, Index mesh_elements, int attempts,
                 bool whole_tool) {
    Tries(f, cut, mesh_elements, attempts, whole_tool).run();
}

}  // namespace femscalpel
