// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "cutting/weld.h"
#include "mesh/changes.h"

namespace femscalpel {

/// Which of each set of welded nodes a side has, by ancestor of the node looked at (node of the input); -1: not welded.
using WeldLabel = std::vector<Index>;

/// The elements at a node that are on one side of the weld.
struct WeldSide {
    WeldLabel label;
    std::vector<CellRef> cells;
};

/// Tells which elements of what an operation made of Welded::mesh are on which side of the weld. At a node these are
/// the elements that hang together by faces (shells: edges) that were not welded, so that nothing comes apart inside a
/// body and the welded faces are open wherever they end up; which of the sides is which is told by the elements of
/// `input` that theirs descend from.
class WeldSides {
public:
    /// `changes`: those between `input` and `mesh` (in_one()). All must outlive this, unchanged but for `changes`.
    WeldSides(const Mesh& input, const Welded& welded, const Mesh& mesh, const Changes& changes);

    /// Nodes of the result (indices) that may have to be taken apart: those that kept their number first, then those
    /// born, then copies.
    const std::vector<Index>& nodes() const { return nodes_; }

    /// Nodes of the input (indices) that a node of the result, by its number, comes from.
    std::vector<Index> ancestors(Index number) const;

    /// The sides at each of nodes(), that of the first nodes first. Their labels are by ancestors().
    const std::vector<std::vector<WeldSide>>& sides() const { return sides_; }

    /// The sides (places in sides()) at each of nodes() that lie on each other there, each pair once.
    const std::vector<std::set<std::pair<int, int>>>& facing() const { return facing_; }

    /// Welded faces that have the same nodes on both sides, as all are where the weld ends: they would be joined.
    Index joined() const { return joined_; }

    /// An element on a face or edge of others, such as a lip, a load's face, a beam on a shell's border.
    struct Guest {
        CellRef cell;
        /// Those that have all its nodes, of the highest dimension, with the places of its nodes in theirs.
        std::vector<std::pair<CellRef, std::vector<int>>> hosts;
    };
    /// Those at nodes(), which are in none of sides(). Shells that had nodes of their own are no guests.
    std::vector<Guest> guests() const;

    /// How much of what an element was on says that the node of a side with this label, of the node `number`, is its:
    /// below 0 if it says the contrary.
    int votes(const CellRef& cell, Index number, const WeldLabel& label) const;

    /// Whether an element descends from one of the input.
    bool is_old(const CellRef& cell) const { return root(cell).has_value(); }

    /// Where welded nodes of the input are in the result, by their indices there.
    const std::unordered_map<Index, Index>& places() const { return place_; }

    /// The set that a node of the input was made one with; none if it was not welded.
    const std::vector<Index>* set_of(Index node) const;

    /// Whether the node of this number was born, or is a copy of one that was.
    bool is_born(Index number) const;

    /// Whether the input has a node of this number.
    bool is_of_input(Index number) const { return numbers_.node(number).has_value(); }

    /// The node (number) that the node of this number is a copy of, or itself.
    Index source(Index number) const;

private:
    void find_bodies();
    void find_nodes();
    void find_cells();
    void find_faces();
    void find_sides();
    std::vector<WeldSide> at(Index node, std::set<std::pair<int, int>>& facing);
    struct Pieces;
    void find_pieces(std::span<const CellRef> cells, Index node, const std::vector<Index>& from, Pieces& out) const;
    void find_layers(Pieces& pieces) const;
    bool is_own(const CellRef& cell) const;
    std::optional<CellRef> root(const CellRef& cell) const;
    Index body_of(const CellRef& cell) const;
    WeldLabel label_of(const CellRef& cell, const std::vector<Index>& from) const;
    std::span<const Index> corners(const CellRef& cell) const;
    bool are_layers(const CellRef& a, const CellRef& b) const;
    std::vector<std::vector<Index>> faces_at(const CellRef& cell, Index node) const;
    using AtFace = std::map<std::vector<Index>, std::vector<int>>;  // elements by corners of the faces they have
    void join_by_faces(std::span<const CellRef> cells, const AtFace& at_face, const std::vector<Index>& from,
                       Pieces& out) const;
    WeldLabel usual_label(const std::vector<CellRef>& cells, const std::vector<Index>& from) const;
    void complete(std::vector<WeldSide>& sides, const std::vector<Index>& from,
                  const std::vector<std::pair<int, int>>& opposite) const;
    int ties(const WeldLabel& label, Index node) const;
    void add_lone(const CellRef& cell, const std::vector<Index>& from, std::vector<WeldSide>& sides) const;
    Guest guest(const CellRef& cell, std::span<const CellRef> others) const;
    bool is_first(const WeldLabel& label) const;

    const Mesh& input_;
    const Welded& welded_;
    const Mesh& mesh_;
    NumberIndex numbers_;
    std::unordered_map<Index, const std::vector<Index>*> set_of_;  // by node of the input
    std::vector<Index> body_;  // of welded nodes of the input: the first of those on their side
    std::set<Index> mixed_;    // bodies that are on both sides of a weld
    std::unordered_map<Index, std::set<Index>> linked_;     // welded nodes of the input that share elements
    std::unordered_map<Index, Index> parents_, sources_;    // numbers
    std::unordered_map<Index, std::vector<Index>> births_;  // ancestors of nodes born, numbers
    std::vector<char> is_single_;
    std::vector<Index> nodes_;
    std::unordered_map<Index, Index> place_;
    std::unordered_map<Index, std::vector<CellRef>> cells_;
    std::vector<std::int8_t> dimension_at_;      // of the largest elements at nodes of the input
    std::set<std::vector<Index>> faces_;         // corners of welded ones
    std::set<std::vector<Index>> met_, parted_;  // of these, those of two elements, and of elements on two sides
    std::vector<std::vector<WeldSide>> sides_;   // at each of nodes_
    std::vector<std::set<std::pair<int, int>>> facing_;
    Index joined_ = 0;
};

}  // namespace femscalpel
