// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "deck/rules/card_rule.h"
#include "deck/rules/carrying.h"

namespace femscalpel {

/// Base of the rules for cards whose lines give values to nodes or node sets, later lines over earlier ones: copies of
/// a node have what the node has; a node born on an edge has it if both ends have. Values that differ from node to node
/// are interpolated in the old elements at the new node's place, also for nodes that moved. Cards of one step with
/// equal parameters are as one; the last of them gets new lines.
class NodalRule : public CardRule {
public:
    void list_numbers(const Card& card, AbsentNumbers& numbers) const override;
    void carry(std::size_t c, const Card& card, Carrying& carrying) override;
    void end_carrying(Carrying& carrying) override;

protected:
    /// By degree of freedom, or by column.
    using Values = std::map<int, double>;

    /// Reads what a line says after its node; none if the line is left as it is.
    virtual std::optional<Values> read_values(CardReader& line, const Card& card, Remarks& remarks) const = 0;
    /// The lines that give node `number` what is `wanted` where it is not `given` yet.
    virtual std::vector<std::string> lines(Index number, const Values& wanted, const Values& given) const = 0;

    /// Whether new nodes of beams have what both ends have, in between.
    virtual bool is_along_beams() const { return true; }

    /// Whether it is told that new nodes got values that no node had.
    virtual bool tells_of_made(const Card& /*card*/) const { return false; }

    /// Whether a value is there, but for rounding.
    static bool has(const Values& given, int key, double value);
    static bool has_all(const Values& given, const Values& wanted);

private:
    struct Line {
        std::optional<GroupIndex> before, after;  // of a set
        Values values;
    };
    /// Lines of equal cards.
    struct Pool {
        std::vector<Line> lines;
        std::unordered_map<Index, std::vector<std::size_t>> of_node;
        std::vector<std::size_t> of_sets;
    };
    Pool read_pool(const std::vector<std::size_t>& cards, Carrying& carrying) const;
    static Values values_of(const Pool& pool, const Mesh& mesh, bool is_old, const NumberIndex& numbers, Index number);
    static Values wanted_values(const Pool& pool, const Carrying& carrying, std::size_t which);

    std::map<std::string, std::vector<std::size_t>> pools_;  // cards by step and parameters
};

}  // namespace femscalpel
