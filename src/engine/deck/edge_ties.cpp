// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/edge_ties.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <unordered_set>

#include "deck/bound_nodes.h"
#include "deck/card_edits.h"
#include "deck/card_numbers.h"
#include "deck/supported_nodes.h"
#include "deck/tied_edges.h"
#include "deck/turned_nodes.h"

namespace femscalpel {
namespace {

constexpr std::string_view pyramid_mark = "** straight edges where pyramids (C3D20 with one upper node) meet triangles";
constexpr std::string_view order_mark = "** straight edges between elements of second and of first order";
constexpr std::string_view set_mark = "** without the middles of straight edges";
constexpr std::string_view replaced_mark = "** without the middles of straight edges: ";
constexpr std::string_view left_out_mark = "** left out, the middle of a straight edge: ";

/// One summand of an equation.
struct TieTerm {
    Index node;
    int freedom;
    double factor;
};

/// CalculiX reads four terms per line.
std::string equation_text(const std::vector<TieTerm>& terms) {
    std::string out = std::to_string(terms.size());
    for (std::size_t k = 0; k < terms.size(); ++k)
        out += (k % 4 == 0 ? "\n" : ", ") + std::to_string(terms[k].node) + ", " + std::to_string(terms[k].freedom) +
               ", " + number_text(terms[k].factor);
    return out + "\n";
}

/// The order in which equations of a turned node in these local directions find a global degree of freedom each, as
/// CalculiX takes one: the first that is free, from that of the direction's number on.
std::vector<int> order_to_eliminate(std::vector<int> directions, const Eigen::Matrix3d& axes) {
    std::vector<int> unordered = directions;
    std::ranges::sort(directions);
    do {
        std::set<int> taken;
        for (const int d : directions)
            for (int k = 0; k < 3; ++k)
                if (const int global = (d - 1 + k) % 3;
                    std::abs(axes(global, d - 1)) >= 1e-5 && !taken.contains(global)) {
                    taken.insert(global);
                    break;
                }
        if (taken.size() == directions.size()) return directions;
    } while (std::ranges::next_permutation(directions).found);
    return unordered;
}

/// Makes the equations.
class TieMaker {
public:
    explicit TieMaker(const Mesh& mesh)
        : mesh_(mesh), of_pyramids_(edges_of_pyramids(mesh)), between_orders_(edges_between_orders(mesh)) {
        std::set<Index> there;
        for (const TiedEdge& e : of_pyramids_) there.insert(e.middle);
        std::erase_if(between_orders_, [&](const TiedEdge& e) { return there.contains(e.middle); });
        if (is_empty()) return;
        turned_.emplace(mesh);
        if (!solver_input(mesh)) return;
        deck_.emplace(mesh);
        std::unordered_set<Index> nodes;
        for (const auto* edges : {&of_pyramids_, &between_orders_})
            for (const TiedEdge& e : *edges) nodes.insert({e.middle, e.a, e.b});
        held_.emplace(*deck_, nodes);
    }

    bool is_empty() const { return of_pyramids_.empty() && between_orders_.empty(); }

    EdgeTies make() {
        EdgeTies out;
        const BoundNodes bound(mesh_);
        const std::vector<int> freedoms = computed_freedoms(mesh_);
        std::vector<std::vector<int>> tied;
        for (const auto* edges : {&of_pyramids_, &between_orders_})
            for (const TiedEdge& e : *edges) {
                tied.push_back(tied_freedoms(e, freedoms, bound));
                // Two are enough to find another.
                if (dependent_.size() < 2 && (tied.back().size() == freedoms.size() || !turned_->contains(e.middle)))
                    for (const int f : tied.back())
                        if (f <= 3) dependent_[e.middle] = f;
            }
        std::string equations;
        auto of_edge = tied.begin();
        const auto add = [&](const std::vector<TiedEdge>& edges, std::string_view mark) {
            std::string text;
            for (const TiedEdge& e : edges) text += tie(e, *of_edge++);
            if (!text.empty()) equations += "*EQUATION\n" + std::string(mark) + "\n" + text;
        };
        add(of_pyramids_, pyramid_mark);
        add(between_orders_, order_mark);
        if (!leaving_.empty()) replace_supports(freedoms, out);
        out.text += equations;
        return out;
    }

    /// Those of problems_of_ties().
    std::vector<std::string> problems() const {
        std::vector<std::string> out;
        std::map<std::string, std::set<Index>> unreadable;
        for (const auto* edges : {&of_pyramids_, &between_orders_})
            for (const TiedEdge& e : *edges)
                for (const Index n : {e.middle, e.a, e.b})
                    if (!turned_->axes(n) && turned_->contains(n)) unreadable[turned_->where(n)].insert(n);
        out.reserve(unreadable.size() + 1);
        for (const auto& [where, nodes] : unreadable)
            out.push_back(where + "*TRANSFORM gives no directions that can be told: the equations that keep edges at " +
                          some(nodes) + " straight are left out");
        if (deck_) {
            tell_removed(out);
            tell_held_alone(out);
        }
        return out;
    }

private:
    static std::string some(const std::set<Index>& nodes) {
        return "node " + std::to_string(*nodes.begin()) +
               (nodes.size() > 1 ? " and " + std::to_string(nodes.size() - 1) + " more" : "");
    }

    /// Whether the mid-side node is to be left out of supports: what holds it does so in some steps, and its ends with
    /// it.
    bool leaves_supports(const TiedEdge& e, const std::vector<int>& freedoms) const {
        if (!held_) return false;
        bool at_times = false;
        for (const int f : freedoms) {
            if (!held_->is_held(e.middle, f)) continue;
            if (!held_->is_held_with(e.middle, e.a, f) || !held_->is_held_with(e.middle, e.b, f)) return false;
            at_times = at_times || !held_->is_always_held(e.middle, f);
        }
        return at_times;
    }

    /// Those that get an equation; whether the mid-side node leaves supports is noted.
    std::vector<int> tied_freedoms(const TiedEdge& e, const std::vector<int>& freedoms, const BoundNodes& bound) {
        const bool leaves = leaves_supports(e, freedoms);
        std::vector<int> tied;
        for (const int f : freedoms)
            if (!bound.is_dependent(e.middle, f) && (leaves || !held_ || !held_->is_held(e.middle, f)))
                tied.push_back(f);
        if (!is_readable(e)) std::erase_if(tied, [](int f) { return f <= 3; });
        if (leaves && !tied.empty()) leaving_.insert(e.middle);
        return tied;
    }

    bool is_readable(const TiedEdge& e) const {
        return turned_->axes(e.middle) && turned_->axes(e.a) && turned_->axes(e.b);
    }

    std::string tie(const TiedEdge& e, const std::vector<int>& freedoms) {
        std::vector<int> left = freedoms, motions;
        std::string out;
        if (turned_->contains(e.middle) || turned_->contains(e.a) || turned_->contains(e.b)) {
            std::ranges::copy_if(freedoms, std::back_inserter(motions), [](int f) { return f <= 3; });
            std::erase_if(left, [](int f) { return f <= 3; });
            if (!motions.empty()) out = turned_tie(e, motions);
        }
        for (const int f : left) out += equation_text({{e.middle, f, 1}, {e.a, f, -0.5}, {e.b, f, -0.5}});
        return out;
    }

    /// In the directions of the mid-side node, those of the ends in theirs.
    std::string turned_tie(const TiedEdge& e, const std::vector<int>& directions) {
        const Eigen::Matrix3d middle = *turned_->axes(e.middle);
        std::string out;
        for (const int d : turned_->contains(e.middle) ? order_to_eliminate(directions, middle) : directions) {
            std::vector<TieTerm> terms{{e.middle, d, 1}};
            bool is_repeated = false;
            for (const Index end : {e.a, e.b}) {
                const Eigen::Matrix3d axes = *turned_->axes(end);
                const std::size_t before = terms.size();
                for (int k = 0; k < 3; ++k)
                    if (const double factor = -0.5 * middle.col(d - 1).dot(axes.col(k)); std::abs(factor) > 1e-14)
                        terms.push_back({end, k + 1, factor});
                is_repeated = is_repeated || (turned_->contains(end) && terms.size() > before + 1);
            }
            if (is_repeated)
                if (const auto other = other_dependent(e.middle)) terms.push_back({other->first, other->second, 0});
            out += equation_text(terms);
        }
        return out;
    }

    /// A dependent degree of freedom of another mid-side node. CalculiX resolves the terms of a turned node into global
    /// ones, and adds up those that are then there more than once only where it replaces a dependent term.
    std::optional<std::pair<Index, int>> other_dependent(Index middle) const {
        for (const auto& [node, freedom] : dependent_)
            if (node != middle) return std::pair(node, freedom);
        return {};
    }

    /// Makes *BOUNDARY cards without the nodes that leave them.
    void replace_supports(const std::vector<int>& freedoms, EdgeTies& out) {
        std::map<std::string, std::string> names;  // by key of the set: that without these nodes, or nothing
        for (std::size_t c = 0; c < deck_->cards().size(); ++c) {
            const Card& card = deck_->cards()[c];
            if (card.keyword != "BOUNDARY") continue;
            CardEdits edits;
            CardReader line(card);
            while (const auto what = next_entry(line)) {
                const SupportedNodes::Line read = SupportedNodes::read_line(*deck_, leaving_, *what, line);
                if (read.nodes.empty() ||
                    std::ranges::none_of(freedoms, [&](int f) { return read.first <= f && f <= read.last; }))
                    continue;
                std::string name;
                if (!what->is_number()) {
                    const auto [it, fresh] = names.try_emplace(deck_key(what->set));
                    if (fresh) it->second = make_set(what->set, read.nodes, out.text);
                    name = it->second;
                }
                std::string_view whole = line.line();
                while (whole.ends_with('\r')) whole.remove_suffix(1);
                edits.replace(line, std::string(name.empty() ? left_out_mark : replaced_mark) + std::string(whole));
                std::string_view rest = line.rest();
                while (rest.ends_with('\r')) rest.remove_suffix(1);
                if (!name.empty()) edits.add_after(line, name + "," + std::string(rest));
            }
            if (edits.empty()) continue;
            edits.apply(out.supports.emplace(c, card).first->second);
        }
    }

    /// Writes a set without some nodes, and returns its name; nothing if none are left.
    std::string make_set(const std::string& set, const std::vector<Index>& without, std::string& text) const {
        const std::unordered_set<Index> gone(without.begin(), without.end());
        std::string rows;
        int count = 0;
        for (const Index n : deck_->members(*deck_->group(DeckSetType::nset, set)))
            if (!gone.contains(n)) rows += std::to_string(n) + (++count % 12 == 0 ? ",\n" : ", ");
        if (rows.empty()) return "";
        while (rows.ends_with(' ') || rows.ends_with(',') || rows.ends_with('\n')) rows.pop_back();
        const DeckSetIndex sets(deck_->input().sets());
        int k = 1;
        const auto name = [&] { return set + "_NOT_TIED" + std::to_string(k); };
        while (sets.find(DeckSetType::nset, name())) ++k;
        text += "*NSET, NSET=" + name() + "\n" + std::string(set_mark) + "\n" + rows + ",\n";
        return name();
    }

    /// Mid-side nodes that are held in some steps, while an end of their edge is not, in its own directions: in the
    /// other steps nothing keeps the edge straight, as no equation can do that in some steps only.
    void tell_held_alone(std::vector<std::string>& out) const {
        const std::vector<int> freedoms = computed_freedoms(mesh_);
        std::set<Index> alone;
        for (const auto* edges : {&of_pyramids_, &between_orders_})
            for (const TiedEdge& e : *edges)
                if (!leaves_supports(e, freedoms) && std::ranges::any_of(freedoms, [&](int f) {
                        return held_->is_held(e.middle, f) && !held_->is_always_held(e.middle, f);
                    }))
                    alone.insert(e.middle);
        if (!alone.empty())
            out.push_back(
                "*BOUNDARY holds " + some(alone) +
                ", in the middle of edges that equations keep straight, in some steps, and not the ends of "
                "these edges in the same degrees of freedom: there is no equation in that direction, so in the "
                "other steps elements come apart a little there. Hold the ends with it, or it in all steps, "
                "or move the tool");
    }

    /// Ends of edges that no element is left of.
    void tell_removed(std::vector<std::string>& out) const {
        std::unordered_set<Index> removed;
        std::string where;
        for (const Card& card : deck_->cards()) {
            if (card.keyword != "MODELCHANGE" || !card.parameter("REMOVE") || type_of(card) != "ELEMENT") continue;
            if (where.empty()) where = card.where() + ": ";
            CardReader line(card);
            while (line.next_data_line())
                for (const NumberOrSet& what : read_entries(line))
                    if (what.is_number())
                        removed.insert(what.number);
                    else if (const auto group = deck_->group(DeckSetType::elset, what.set))
                        removed.insert(deck_->members(*group).begin(), deck_->members(*group).end());
        }
        if (removed.empty()) return;
        std::vector<char> stays(mesh_.points.size(), 0);
        for (const CellBlock& b : mesh_.blocks())
            if (traits(b.type).dimension == 3)
                for (Index c = 0; c < b.size(); ++c)
                    if (!removed.contains(b.ids[c]))
                        for (const Index n : b.nodes(c)) stays[n] = 1;
        std::set<Index> ends;
        for (const auto* edges : {&of_pyramids_, &between_orders_})
            for (const TiedEdge& e : *edges)
                for (const Index n : {e.a, e.b})
                    if (!stays[*deck_->numbers().node(n)]) ends.insert(n);
        if (!ends.empty())
            out.push_back(where + "*MODEL CHANGE removes all elements of " + some(ends) +
                          ", the ends of edges that equations keep straight beside the elements that were changed: "
                          "CalculiX fails where these have no stiffness; move the tool or keep these elements");
    }

    const Mesh& mesh_;
    std::vector<TiedEdge> of_pyramids_, between_orders_;
    std::optional<TurnedNodes> turned_;
    std::optional<DeckView> deck_;
    std::optional<SupportedNodes> held_;
    SupportedNodes::Numbers leaving_;
    std::map<Index, int> dependent_;  // some mid-side nodes with one of their dependent degrees of freedom
};

/// What stands behind a card's keyword line.
bool has_mark(const Card& card, std::string_view keyword, std::string_view mark) {
    return card.keyword == keyword && card.text.front().text.substr(card.head).starts_with(mark);
}

/// Puts the lines of a support back that edge_ties() replaced.
void restore_supports(Card& card) {
    if (std::ranges::none_of(card.text, [](const DeckText& piece) {
            return piece.text.find(replaced_mark) != piece.text.npos ||
                   piece.text.find(left_out_mark) != piece.text.npos;
        }))
        return;
    std::vector<DeckText> out;
    for (const DeckText& piece : card.text) {
        std::string_view rest = piece.text;
        Index number = piece.line;
        std::size_t at = 0;
        const auto put = [&](std::size_t bytes) {
            if (bytes > 0) out.push_back({piece.file, rest.substr(0, bytes), number});
        };
        const auto go_on = [&](std::size_t bytes) {
            number += std::count(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(bytes), '\n');
            rest.remove_prefix(bytes);
            at = 0;
        };
        const auto line_end = [&](std::size_t from) { return std::min(rest.find('\n', from), rest.size() - 1) + 1; };
        while (at < rest.size()) {
            const std::size_t end = line_end(at);
            const std::string_view line = rest.substr(at, end - at);
            const bool replaced = line.starts_with(replaced_mark);
            if (!replaced && !line.starts_with(left_out_mark)) {
                at = end;
                continue;
            }
            put(at);
            go_on(at);
            const std::size_t mark = (replaced ? replaced_mark : left_out_mark).size(), one = line_end(0);
            out.push_back({piece.file, rest.substr(mark, one - mark), number});
            go_on(replaced && one < rest.size() ? line_end(one) : one);
        }
        put(rest.size());
    }
    card.text = std::move(out);
}

}  // namespace

EdgeTies edge_ties(const Mesh& mesh) {
    TieMaker maker(mesh);
    return maker.is_empty() ? EdgeTies{} : maker.make();
}

std::vector<std::string> problems_of_ties(const Mesh& mesh) {
    const TieMaker maker(mesh);
    return maker.is_empty() ? std::vector<std::string>{} : maker.problems();
}

bool remove_edge_ties(std::vector<Card>& cards) {
    bool ties_orders = false;
    for (std::size_t c = 0; c < cards.size();) {
        if (cards[c].keyword == "BOUNDARY") restore_supports(cards[c]);
        const bool is_of_orders = has_mark(cards[c], "EQUATION", order_mark);
        if (c == 0 ||
            !(is_of_orders || has_mark(cards[c], "EQUATION", pyramid_mark) || has_mark(cards[c], "NSET", set_mark))) {
            ++c;
            continue;
        }
        ties_orders = ties_orders || is_of_orders;
        CardReader line(cards[c]);
        line.next_line();
        while (line.next_line()) {
            if (line.is_data()) continue;
            const DeckText& piece = cards[c].text.front();
            const std::size_t from = static_cast<std::size_t>(line.raw().data() - piece.text.data());
            cards[c - 1].text.push_back({piece.file, piece.text.substr(from),
                                         piece.line + std::ranges::count(piece.text.substr(0, from), '\n')});
            break;
        }
        cards.erase(cards.begin() + static_cast<std::ptrdiff_t>(c));
    }
    return ties_orders;
}

}  // namespace femscalpel
