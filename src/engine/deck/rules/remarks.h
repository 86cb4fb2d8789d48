// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// How much a remark matters: with `strict`, problems make an error.
enum class Weight : std::uint8_t { note, problem };

/// What a line of a deck names.
struct Entity {
    enum class Kind : std::uint8_t { node, element, set };
    Kind kind = Kind::node;
    Index number = 0;  ///< of a node or an element
    std::string type;  ///< of a set: "set", "node set", ...
    std::string name;  ///< of a set

    /// "node 7", "set 'NAME'".
    std::string text() const;
    /// Two that are the same have the same key, however they are written.
    std::tuple<Kind, Index, std::string> key() const { return {kind, number, deck_key(name)}; }
};

/// A node by its number.
inline Entity the_node(Index number) { return {Entity::Kind::node, number, {}, {}}; }
/// An element by its number.
inline Entity the_element(Index number) { return {Entity::Kind::element, number, {}, {}}; }
/// A set, or what else `type` says that is known by a name.
inline Entity the_set(const std::string& name, const std::string& type = "set") {
    return {Entity::Kind::set, 0, type, name};
}

/// What is to be told of a deck that followed a change.
class Remarks {
public:
    /// None, on no deck.
    Remarks() = default;
    /// `deck` must outlive the calls of add().
    explicit Remarks(const SolverInput& deck) : deck_(&deck) {}

    /// Says `what` ("was removed") about `entity` on the line `where` ("deck.inp:12: ") of a card; equal remarks on one
    /// card become one that counts the entities.
    void add(std::size_t card, Weight weight, const std::string& where, const Entity& entity, const std::string& what);
    /// A problem in words of its own.
    void add_problem(const std::string& text) { problems_.push_back({text, {}, {}}); }
    /// A note in words of its own.
    void add_note(const std::string& text) { problems_.push_back({text, {}, {}, Weight::note}); }
    /// A problem of nodes (numbers) that the change made: `where` ("deck.inp:12: *MPC: "), and `what` of them ("lie
    /// between...").
    void add_new_nodes(const std::string& where, const std::set<Index>& nodes, const std::string& what) {
        problems_.push_back({where, nodes, what});
    }
    /// A card names the set `made` in place of `set`.
    void add_replaced(const std::string& set, const std::string& made) { replaced_.emplace(deck_key(made), set); }

    bool empty() const { return remarks_.empty() && problems_.empty(); }

    /// Problems: those in words of their own in the order they were added, then remarks by card.
    std::vector<std::string> problems() const;
    /// Notes: those in words of their own in the order they were added, then remarks by card.
    std::vector<std::string> notes() const;

private:
    friend class JoinedRemarks;

    struct Problem {
        std::string text;
        std::set<Index> new_nodes;
        std::string what;
        Weight weight = Weight::problem;
    };
    struct Place {
        std::string where;
        Entity entity;
    };
    struct Remark {
        std::string keyword;
        std::vector<Place> places;
    };
    std::vector<std::string> texts(Weight weight) const;

    const SolverInput* deck_ = nullptr;
    std::map<std::tuple<std::size_t, Weight, std::string>, Remark> remarks_;
    std::vector<Problem> problems_;
    std::map<std::string, std::string> replaced_;  // key of the set that is named now -> the set named before
};

}  // namespace femscalpel
