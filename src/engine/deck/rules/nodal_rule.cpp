// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/nodal_rule.h"

#include <algorithm>
#include <cmath>

#include "cancel.h"
#include "deck/rules/absent_numbers.h"
#include "words.h"

namespace femscalpel {

void NodalRule::list_numbers(const Card& card, AbsentNumbers& numbers) const { numbers.name_nodes_first(card); }

void NodalRule::carry(std::size_t c, const Card& card, Carrying& carrying) {
    pools_[std::to_string(carrying.old().step(c)) + parameters_key(card)].push_back(c);
}

void NodalRule::end_carrying(Carrying& carrying) {
    for (const auto& [key, cards] : pools_) {
        const Pool pool = read_pool(cards, carrying);
        if (pool.lines.empty()) continue;
        const std::size_t last = cards.back();
        const Card& card = carrying.old().cards()[last];
        const auto& nodes = carrying.origins().nodes();
        std::vector<Index> made;
        for (std::size_t k = 0; k < nodes.size(); ++k) {
            check_cancelled();
            if (nodes[k].spans && !is_along_beams()) continue;
            const Values wanted = wanted_values(pool, carrying, k);
            if (wanted.empty()) continue;
            const Values given = values_of(pool, carrying.after(), false, carrying.new_numbers(), nodes[k].number);
            const std::vector<std::string> added = lines(nodes[k].number, wanted, given);
            for (const std::string& line : added) carrying.edits(last).append(card, line);
            if (!added.empty() && nodes[k].ancestors.size() > 1) made.push_back(nodes[k].number);
        }
        if (!made.empty() && tells_of_made(card))
            carrying.remarks().add_note(card.where() + ": *" + card.keyword + ", TYPE=" + type_of(card) + ": " +
                                        counted(static_cast<std::int64_t>(made.size()), "new node") +
                                        ", the first is " + std::to_string(std::ranges::min(made)) +
                                        ", with values between those of the nodes around");
    }
}

bool NodalRule::has(const Values& given, int key, double value) {
    const auto it = given.find(key);
    return it != given.end() && std::abs(it->second - value) <= 1e-12 * std::abs(value);
}

bool NodalRule::has_all(const Values& given, const Values& wanted) {
    return std::ranges::all_of(wanted, [&](const auto& v) { return has(given, v.first, v.second); });
}

NodalRule::Pool NodalRule::read_pool(const std::vector<std::size_t>& cards, Carrying& carrying) const {
    Pool pool;
    for (const std::size_t c : cards) {
        const Card& card = carrying.old().cards()[c];
        CardReader line(card);
        while (const auto what = next_entry(line)) {
            auto values = read_values(line, card, carrying.remarks());
            if (!values) continue;
            Line out{{}, {}, std::move(*values)};
            if (what->is_number()) {
                if (carrying.node_gone(what->number)) {
                    carrying.remarks().add(c, Weight::problem, line.where(), the_node(what->number), "was removed");
                    carrying.edits(c).drop(line);
                }
                pool.of_node[what->number].push_back(pool.lines.size());
            } else {
                out.before = carrying.old().group(DeckSetType::nset, what->set);
                out.after = carrying.closed_sets().group_now(what->set);
                pool.of_sets.push_back(pool.lines.size());
            }
            pool.lines.push_back(std::move(out));
        }
    }
    return pool;
}

NodalRule::Values NodalRule::values_of(const Pool& pool, const Mesh& mesh, bool is_old, const NumberIndex& numbers,
                                       Index number) {
    std::vector<std::size_t> lines;
    if (const auto it = pool.of_node.find(number); it != pool.of_node.end()) lines = it->second;
    const auto node = numbers.node(number);
    for (const std::size_t l : pool.of_sets) {
        const auto group = is_old ? pool.lines[l].before : pool.lines[l].after;
        if (group && node && mesh.families.contains(mesh.node_families[*node], *group)) lines.push_back(l);
    }
    std::ranges::sort(lines);
    Values out;
    for (const std::size_t l : lines)
        for (const auto& [key, value] : pool.lines[l].values) out[key] = value;
    return out;
}

/// What a node of the result should have: all that its ancestors have in common, interpolated.
NodalRule::Values NodalRule::wanted_values(const Pool& pool, const Carrying& carrying, std::size_t which) {
    const NodeOrigins::Node& node = carrying.origins().nodes()[which];
    const auto old_values = [&](Index number) {
        return values_of(pool, carrying.before(), true, carrying.old().numbers(), number);
    };
    std::vector<Values> of_ancestors, of_shares;
    for (const Index a : node.ancestors) {
        of_ancestors.push_back(old_values(a));
        if (of_ancestors.back().empty()) return {};
    }
    const std::vector<NodeOrigins::Share>& shares = carrying.origins().shares(which);
    for (const NodeOrigins::Share& s : shares) of_shares.push_back(old_values(s.node));
    Values out;
    for (const auto& [key, first] : of_ancestors.front()) {
        if (!std::ranges::all_of(of_ancestors, [&](const Values& v) { return v.contains(key); })) continue;
        const bool inside =
            !of_shares.empty() && std::ranges::all_of(of_shares, [&](const Values& v) { return v.contains(key); });
        const std::vector<Values>& sources = inside ? of_shares : of_ancestors;
        const double any = sources.front().at(key);
        double value = 0;
        for (std::size_t k = 0; k < sources.size(); ++k)
            value += sources[k].at(key) * (inside ? shares[k].weight : 1 / static_cast<double>(sources.size()));
        const bool equal = std::ranges::all_of(sources, [&](const Values& v) { return v.at(key) == any; });
        out[key] = equal ? any : value;
    }
    return out;
}

}  // namespace femscalpel
