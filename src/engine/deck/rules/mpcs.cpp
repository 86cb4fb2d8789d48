// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/mpcs.h"

#include <algorithm>
#include <set>

#include "deck/rules/absent_numbers.h"
#include "deck/rules/carrying.h"
#include "deck/rules/marking.h"

namespace femscalpel {
namespace {

/// A new node with all its ancestors in `nodes` (ascending).
bool is_born_between(const NodeOrigins::Node& node, const std::vector<Index>& nodes) {
    return node.is_new &&
           std::ranges::all_of(node.ancestors, [&](Index a) { return std::ranges::binary_search(nodes, a); });
}

}  // namespace

std::vector<Mpcs::Mpc> Mpcs::read(const Card& card) {
    std::vector<Mpc> out;
    CardReader line(card);
    bool more = line.next_data_line();
    while (more) {
        const auto starts_with_number = [&] {
            Index number = 0;
            CardReader probe = line;
            return probe.integer(number);
        };
        Mpc& mpc = out.emplace_back();
        if (!starts_with_number()) mpc.type = deck_key(line.field());
        do {
            mpc.lines.push_back({line, read_entries(line)});
            more = line.next_data_line();
        } while (more && starts_with_number());
    }
    return out;
}

/// Ascending; those with a number that a node can have.
std::vector<Index> Mpcs::Mpc::nodes() const {
    std::vector<Index> out;
    for (const Line& line : lines)
        for (const NumberOrSet& what : line.entries)
            if (what.is_number() && what.number > 0) out.push_back(what.number);
    std::ranges::sort(out);
    return out;
}

void Mpcs::list_numbers(const Card& card, AbsentNumbers& numbers) const {
    for (const Mpc& mpc : read(card))
        for (const Line& line : mpc.lines)
            for (const NumberOrSet& what : line.entries)
                if (what.is_number()) numbers.name_node(line.line, what.number);
}

void Mpcs::mark(std::size_t /*c*/, const Card& card, Marking& marking) {
    for (const Mpc& mpc : read(card))
        for (const Index node : mpc.nodes()) marking.pin(node);
}

void Mpcs::carry(std::size_t c, const Card& card, Carrying& carrying) {
    for (const Mpc& mpc : read(card)) {
        for (const Line& line : mpc.lines) carry_line(c, mpc, line, carrying);
        if (mpc.is_list())
            add_new_nodes(c, mpc, carrying);
        else
            tell_not_joining(mpc, carrying);
    }
}

void Mpcs::carry_line(std::size_t c, const Mpc& mpc, const Line& line, Carrying& carrying) {
    const auto tell = [&](Index node, const std::string& what) {
        carrying.remarks().add(c, Weight::problem, line.line.where(), the_node(node), what);
    };
    std::string left = &line == &mpc.lines.front() ? mpc.type : "";
    bool gone = false;
    for (const NumberOrSet& what : line.entries) {
        if (what.is_number() && what.number > 0) {
            if (carrying.node_gone(what.number)) {
                tell(what.number, mpc.is_list() ? "was removed, and leaves the list" : "was removed");
                gone = true;
                continue;
            }
            if (!mpc.is_list() && carrying.origins().is_doubled(what.number))
                tell(what.number,
                     "the crack doubled; the " + mpc.type + " MPC stays with the original, on the negative side");
        }
        left += (left.empty() ? "" : ", ") + (what.is_number() ? std::to_string(what.number) : what.set);
    }
    if (!gone || !mpc.is_list()) return;
    if (left.empty())
        carrying.edits(c).drop(line.line);
    else
        carrying.edits(c).replace(line.line, left);
}

void Mpcs::add_new_nodes(std::size_t c, const Mpc& mpc, Carrying& carrying) {
    const std::vector<Index> nodes = mpc.nodes();
    const CardReader& last = mpc.lines.back().line;
    std::string added;
    int count = 0;
    for (const NodeOrigins::Node& n : carrying.origins().nodes()) {
        if (!is_born_between(n, nodes)) continue;
        added += ", " + std::to_string(n.number);
        if (++count % 15 != 0) continue;
        carrying.edits(c).add_after(last, "0" + added);
        added.clear();
    }
    if (!added.empty()) carrying.edits(c).add_after(last, "0" + added);
}

void Mpcs::tell_not_joining(const Mpc& mpc, Carrying& carrying) {
    const std::vector<Index> nodes = mpc.nodes();
    std::set<Index> between;
    for (const NodeOrigins::Node& n : carrying.origins().nodes())
        if (n.ancestors.size() > 1 && is_born_between(n, nodes)) between.insert(n.number);
    if (!between.empty())
        carrying.remarks().add_new_nodes(mpc.lines.back().line.where() + "*MPC: ", between,
                                         "lie between nodes of this " + mpc.type + " MPC and do not join it");
}

}  // namespace femscalpel
