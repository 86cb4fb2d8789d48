// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/related_nodes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_set>

#include "mesh/rounding.h"

namespace femscalpel {
namespace {

/// Shares of two new nodes that differ by no more are the same place.
constexpr double same_share = 1e-6;
/// Relations by which lengths change by a larger part are not those of two sides that match.
constexpr double same_length = 1e-3;
/// Ways to combine the equations of the nodes around a new one that are tried.
constexpr std::size_t most_ways = 4096;

/// Degrees of freedom and factors, and the term a node is in.
struct Role {
    std::vector<std::pair<Index, double>> shape;
    std::size_t term;
    auto operator<=>(const Role&) const = default;
};

class Relation {
public:
    Relation(const std::vector<NodeEquation>& equations, const Mesh& before, const NumberIndex& numbers,
             const NodeOrigins& origins, const Changes& changes)
        : equations_(equations), before_(before), numbers_(numbers), origins_(origins) {
        for (std::size_t e = 0; e < equations.size(); ++e) {
            Role role;
            for (const NodeEquation::Term& t : equations[e].terms) role.shape.emplace_back(t.dof, t.factor);
            for (role.term = 0; role.term < role.shape.size(); ++role.term)
                roles_[equations[e].terms[role.term].node][role].push_back(e);
        }
        std::unordered_set<Index> born;
        for (const Changes::Born& b : changes.born) born.insert(b.node);
        for (std::size_t k = 0; k < origins.nodes().size(); ++k) {
            const NodeOrigins::Node& n = origins.nodes()[k];
            if (!born.contains(n.number) ||
                !std::ranges::all_of(n.ancestors, [&](Index a) { return roles_.contains(a); }))
                continue;
            between_.push_back(k);
            for (const NodeOrigins::Share& s : origins.shares(k)) between_at_[s.node].push_back(k);
        }
        out_.copies_follow.assign(equations.size(), 0);
        find_pairs(changes);
    }

    RelatedNodes run() {
        for (const auto& [node, other] : facing_) relate_pair(node, other);
        for (const std::size_t k : between_) relate(k);
        relate_copies();
        return std::move(out_);
    }

private:
    /// Where double nodes are followed: which equations are those of two nodes that were one of their pairs.
    void find_pairs(const Changes& changes) {
        of_pair_.assign(equations_.size(), 0);
        if (changes.facing.empty()) return;
        same_place_ = same_place(before_.points, coordinate_rounding(before_.points));
        std::unordered_map<Index, std::vector<Index>> from;
        for (const Changes::Born& b : changes.born) from.emplace(b.node, b.ancestors);
        for (const Changes::Copy& c : changes.copies) {
            const auto birth = from.find(c.source);
            from.emplace(c.node, birth == from.end() ? std::vector<Index>{c.source} : birth->second);
        }
        const auto ancestors = [&](Index n) {
            const auto found = from.find(n);
            return found == from.end() ? std::vector<Index>{n} : found->second;
        };
        std::set<std::pair<Index, Index>> could;
        for (const Changes::Facing& f : changes.facing) {
            const std::vector<Index> of_one = ancestors(f.node), of_other = ancestors(f.other);
            for (const Index a : of_one)
                for (const Index b : of_other) could.insert(std::minmax(a, b));
            if (from.contains(f.node) || from.contains(f.other))
                facing_.push_back({{f.node, of_one}, {f.other, of_other}});
        }
        for (std::size_t e = 0; e < equations_.size(); ++e) {
            if (equations_[e].terms.size() != 2) continue;
            const std::pair<Index, Index> nodes = std::minmax(equations_[e].terms[0].node, equations_[e].terms[1].node);
            if (!could.contains(nodes) || !is_one_place(nodes.first, nodes.second)) continue;
            of_pair_[e] = 1;
            of_nodes_[nodes].push_back(e);
            tied_to_[nodes.first].insert(nodes.second);
            tied_to_[nodes.second].insert(nodes.first);
        }
    }

    bool is_one_place(Index a, Index b) const {
        const auto n = numbers_.node(a), m = numbers_.node(b);
        if (!n || !m) return false;
        return (before_.points[*n] - before_.points[*m]).norm() <= same_place_;
    }

    struct Side {
        Index node;
        std::vector<Index> ancestors;
    };

    /// What an equation of two terms says of the first node's degree of freedom and the other's, and their ratio.
    struct Tie {
        Index dof, other;
        double ratio;
        auto operator<=>(const Tie&) const = default;
    };
    /// Ties, and an equation that has each, if there is one and not several that say it together.
    using Ties = std::map<Tie, std::optional<std::size_t>>;

    /// From a node to another: by their own equations, or over a third to which both are tied.
    Ties ties_between(Index a, Index b) const {
        Ties out = own_ties(a, b);
        const auto partners = tied_to_.find(a);
        if (partners == tied_to_.end()) return out;
        for (const Index c : partners->second)
            for (const auto& [first, e] : own_ties(a, c))
                for (const auto& [second, f] : own_ties(c, b))
                    if (first.other == second.dof)
                        out.try_emplace({first.dof, second.other, -first.ratio * second.ratio}, std::nullopt);
        return out;
    }

    Ties own_ties(Index a, Index b) const {
        Ties out;
        const auto found = of_nodes_.find(std::minmax(a, b));
        if (found == of_nodes_.end()) return out;
        for (const std::size_t e : found->second) {
            const auto& terms = equations_[e].terms;
            const std::size_t one = terms[0].node == a ? 0 : 1;
            out.try_emplace({terms[one].dof, terms[1 - one].dof, terms[1 - one].factor / terms[one].factor}, e);
        }
        return out;
    }

    /// The ties that all pairs have which two nodes come from, and an equation for each. `any`: some pair has some.
    Ties common_ties(const Side& one, const Side& other, bool& any) const {
        Ties out;
        bool first = true;
        for (const Index a : one.ancestors) {
            if (std::ranges::find(other.ancestors, a) != other.ancestors.end()) continue;  // not double
            Ties here;
            for (const Index b : other.ancestors) here.merge(ties_between(a, b));
            any = any || !here.empty();
            if (first) {
                out = std::move(here);
            } else {
                std::erase_if(out, [&](const auto& t) { return !here.contains(t.first); });
                for (auto& [tie, e] : out)
                    if (!e) e = here.at(tie);
            }
            first = false;
        }
        return out;
    }

    void relate_pair(const Side& one, const Side& other) {
        bool any = false, made = false;
        for (const auto& [tie, e] : common_ties(one, other, any)) {
            made = true;
            if (!e) continue;  // by what it and the other have with a third
            const bool turned = is_turned(*e, tie);
            add(*e, turned ? std::vector{other.node, one.node} : std::vector{one.node, other.node});
        }
        if (!any || made) return;
        for (const Index a : one.ancestors)
            if (const auto there = roles_.find(a); there != roles_.end()) {
                out_.missed.push_back({there->second.begin()->second.front(), one.node});
                return;
            }
    }

    /// Whether the equation's first term is that of the tie's other node.
    bool is_turned(std::size_t e, const Tie& tie) const {
        const auto& terms = equations_[e].terms;
        return !(terms[0].dof == tie.dof && terms[1].dof == tie.other &&
                 terms[1].factor / terms[0].factor == tie.ratio);
    }

    void relate(std::size_t k) {
        const NodeOrigins::Node& node = origins_.nodes()[k];
        const auto& of_first = roles_.at(node.ancestors.front());
        bool any_shape = false;
        for (const auto& [role, first] : of_first) {
            if (std::ranges::all_of(first, [&](std::size_t e) { return of_pair_[e] != 0; })) return;
            if (!std::ranges::all_of(node.ancestors, [&](Index a) { return roles_.at(a).contains(role); })) continue;
            any_shape = true;
            if (!relate_in(role, k)) out_.missed.push_back({first.front(), node.number});
        }
        if (any_shape) return;
        // Ends in different terms, as on an edge from one side to the other, are not related to a third.
        for (const auto& [role, first] : of_first)
            if (std::ranges::all_of(node.ancestors, [&](Index a) {
                    return std::ranges::any_of(roles_.at(a), [&](const auto& r) { return r.first.term == role.term; });
                })) {
                out_.missed.push_back({first.front(), node.number});
                return;
            }
    }

    /// Makes the equations of a new node in one role. False if there is one for which a node is wanting.
    bool relate_in(const Role& role, std::size_t k) {
        const auto& shares = origins_.shares(k);
        std::vector<const std::vector<std::size_t>*> options;
        std::size_t ways = 1;
        for (const NodeOrigins::Share& s : shares) {
            const auto at = roles_.find(s.node);
            if (at == roles_.end() || !at->second.contains(role)) return false;
            options.push_back(&at->second.at(role));
            ways *= options.back()->size();
        }
        if (shares.empty() || ways > most_ways) return false;
        std::map<std::size_t, bool>
            wanted;  // equations of the first node that match the others', and whether one was made
        bool any = false;
        std::vector<std::size_t> way(shares.size());
        for (std::size_t w = 0; w < ways; ++w) {
            std::size_t rest = w;
            for (std::size_t i = 0; i < way.size(); ++i) {
                way[i] = (*options[i])[rest % options[i]->size()];
                rest /= options[i]->size();
            }
            const bool made = make(role, k, way);
            any = any || made;
            if (made || lengths_match(shares, role, way)) wanted[way[0]] = wanted[way[0]] || made;
        }
        return any && std::ranges::all_of(wanted, [](const auto& w) { return w.second; });
    }

    /// The equation that nodes()[k] gets when the nodes around it have those of `way`; false if a partner is wanting.
    bool make(const Role& role, std::size_t k, const std::vector<std::size_t>& way) {
        std::vector<Index> nodes;
        for (std::size_t t = 0; t < role.shape.size(); ++t) {
            const Index first = equations_[way[0]].terms[t].node;
            if (t == role.term) {
                nodes.push_back(origins_.nodes()[k].number);
            } else if (std::ranges::all_of(way, [&](std::size_t e) { return equations_[e].terms[t].node == first; })) {
                nodes.push_back(first);
            } else if (const auto partner = partner_of(k, way, t)) {
                nodes.push_back(*partner);
            } else {
                return false;
            }
        }
        add(way[0], std::move(nodes));
        return true;
    }

    std::optional<Index> partner_of(std::size_t k, const std::vector<std::size_t>& way, std::size_t term) const {
        std::map<Index, double> wanted;
        const auto& shares = origins_.shares(k);
        for (std::size_t i = 0; i < way.size(); ++i) wanted[equations_[way[i]].terms[term].node] += shares[i].weight;
        const auto largest = std::ranges::max_element(wanted, {}, [](const auto& w) { return std::abs(w.second); });
        const auto near = between_at_.find(largest->first);
        if (near == between_at_.end()) return {};
        for (const std::size_t m : near->second) {
            std::map<Index, double> left = wanted;
            for (const NodeOrigins::Share& s : origins_.shares(m)) left[s.node] -= s.weight;
            if (m != k && std::ranges::all_of(left, [](const auto& l) { return std::abs(l.second) <= same_share; }))
                return origins_.nodes()[m].number;
        }
        return {};
    }

    /// Whether the partners are as far from each other as the nodes.
    bool lengths_match(const std::vector<NodeOrigins::Share>& shares, const Role& role,
                       const std::vector<std::size_t>& way) const {
        const auto place = [&](Index number) { return before_.points[*numbers_.node(number)]; };
        for (std::size_t t = 0; t < role.shape.size(); ++t)
            for (std::size_t i = 1; i < way.size(); ++i) {
                const Index a = equations_[way[0]].terms[t].node, b = equations_[way[i]].terms[t].node;
                if (a == b || !numbers_.node(a) || !numbers_.node(b)) continue;
                const double length = (place(shares[0].node) - place(shares[i].node)).norm();
                if (std::abs((place(a) - place(b)).norm() - length) > same_length * length) return false;
            }
        return true;
    }

    bool add(std::size_t like, std::vector<Index> nodes) {
        std::vector<std::pair<Index, double>> shape;
        for (const NodeEquation::Term& t : equations_[like].terms) shape.emplace_back(t.dof, t.factor);
        if (!known_.emplace(std::move(shape), nodes).second) return false;
        out_.made.push_back({like, std::move(nodes)});
        return true;
    }

    void relate_copies() {
        const std::size_t born = out_.made.size();
        for (std::size_t e = 0; e < equations_.size(); ++e) {
            if (of_pair_[e]) {
                out_.copies_follow[e] = 1;
                continue;
            }
            std::vector<Index> nodes;
            for (const NodeEquation::Term& t : equations_[e].terms) nodes.push_back(t.node);
            out_.copies_follow[e] = relate_copies_of(e, nodes);
        }
        for (std::size_t k = 0; k < born; ++k) {
            const RelatedNodes::Made made = out_.made[k];
            if (of_pair_[made.like]) continue;
            if (!relate_copies_of(made.like, made.nodes)) out_.one_sided.push_back({made.like, made.nodes.front()});
        }
    }

    /// False if nodes are doubled and others that should be are not.
    bool relate_copies_of(std::size_t like, const std::vector<Index>& nodes) {
        std::vector<Index> copies;
        bool any = false;
        for (const Index n : nodes) {
            const auto& of_node = origins_.copies_of(n);
            any = any || !of_node.empty();
            copies.push_back(of_node.empty() ? n : of_node.front());
        }
        if (!any) return true;
        for (const Index n : nodes)
            if (origins_.copies_of(n).size() > 1 || (origins_.copies_of(n).empty() && !is_reference(n))) return false;
        add(like, std::move(copies));
        return true;
    }

    /// A node that no element has: what holds it is told by cards alone.
    bool is_reference(Index number) {
        if (in_elements_.empty()) {
            in_elements_.assign(before_.points.size(), 0);
            for (const CellBlock& b : before_.blocks())
                for (const Index n : b.connectivity) in_elements_[n] = 1;
        }
        const auto node = numbers_.node(number);
        return node && !in_elements_[*node];
    }

    const std::vector<NodeEquation>& equations_;
    const Mesh& before_;
    const NumberIndex& numbers_;
    const NodeOrigins& origins_;
    std::map<Index, std::map<Role, std::vector<std::size_t>>> roles_;  // by node
    std::vector<std::size_t> between_;  // places in origins_.nodes(): born between nodes of equations
    std::map<Index, std::vector<std::size_t>> between_at_;  // the same by old node that has a share
    std::set<std::pair<std::vector<std::pair<Index, double>>, std::vector<Index>>> known_;
    std::vector<char> in_elements_;
    std::vector<std::pair<Side, Side>> facing_;  // with a new node
    double same_place_ = 0;
    std::vector<char> of_pair_;  // by equation: that of two double nodes that are followed
    std::map<std::pair<Index, Index>, std::vector<std::size_t>> of_nodes_;  // these equations
    std::map<Index, std::set<Index>> tied_to_;                              // by them
    RelatedNodes out_;
};

}  // namespace

RelatedNodes relate_new_nodes(const std::vector<NodeEquation>& equations, const Mesh& before,
                              const NumberIndex& numbers, const NodeOrigins& origins, const Changes& changes) {
    if (equations.empty()) return {};
    return Relation(equations, before, numbers, origins, changes).run();
}

}  // namespace femscalpel
