// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// How much a remark matters: with `strict`, problems make an error.
enum class Weight : std::uint8_t { note, problem };

/// What is to be told of a deck that followed a change.
class Remarks {
public:
    /// `deck` must outlive this.
    explicit Remarks(const SolverInput& deck) : deck_(deck) {}

    /// Says `what` ("was removed") about `entity` ("node 7") on the line `where` ("deck.inp:12: ") of a card; equal
    /// remarks on one card become one that counts.
    void add(std::size_t card, Weight weight, const std::string& where, const std::string& entity,
             const std::string& what);
    /// A problem in words of its own.
    void add_problem(std::string text) { problems_.push_back(std::move(text)); }

    /// Problems: those in words of their own in the order they were added, then remarks by card.
    std::vector<std::string> problems() const;
    /// Notes, by card.
    std::vector<std::string> notes() const { return texts(Weight::note); }

private:
    struct Remark {
        std::string where, entity;
        Index count = 0;
    };
    std::vector<std::string> texts(Weight weight) const;

    const SolverInput& deck_;
    std::map<std::tuple<std::size_t, Weight, std::string>, Remark> remarks_;
    std::vector<std::string> problems_;
};

/// "node 7".
inline std::string node_text(Index number) { return "node " + std::to_string(number); }
/// "element 7".
inline std::string element_text(Index number) { return "element " + std::to_string(number); }
/// "set 'NAME'".
inline std::string named_set(const std::string& name) { return "set '" + name + "'"; }

}  // namespace femscalpel
