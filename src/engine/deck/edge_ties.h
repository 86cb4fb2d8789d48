// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "deck/solver_input.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// What is written into a CalculiX deck so that edges stay straight.
struct EdgeTies {
    std::string text;                      ///< *EQUATION cards, and *NSET cards that the supports name
    std::map<std::size_t, Card> supports;  ///< by card of the deck: the *BOUNDARY cards to write in place of it
};

/// Edges stay straight whose mid-side nodes *EQUATION cards put in the mean of their ends:
///
/// - Pyramids of second order are C3D20 with one upper node in CalculiX, whose shape functions on a side differ from
///   those of a triangle of six nodes by as much as the edge at the base bends (Newton, "Degeneration of brick-type
///   isoparametric elements", Int. J. Numer. Meth. Engng. 7 (1973)). Where a tetrahedron or prism is across, that edge
///   is kept straight. Then both fit; a linear displacement is exact, which it is not without.
/// - Edges between elements of second and of first order, if the deck says so (SolverInput::ties_orders()).
///
/// Left out are degrees of freedom that other cards make dependent (BoundNodes), and those that *BOUNDARY sets in all
/// steps. What *BOUNDARY sets in some steps stays tied in all: where it sets the ends of the edge with the mid-side
/// node, that is left out there, by a set without it in place of the one named; else the equation is left out. Nodes
/// turned by *TRANSFORM have the terms in their directions; where these cannot be told, the equation is left out
/// (problems_of_ties()).
///
/// All that is no part of the deck: it is taken out where a deck is read (remove_edge_ties()), and made anew where it
/// is written.
EdgeTies edge_ties(const Mesh& mesh);

/// Takes what edge_ties() made out of a deck's cards; comments behind its cards go to the card before. Whether edges
/// between elements of second and of first order were tied.
bool remove_edge_ties(std::vector<Card>& cards);

/// What does not work out with the ties in a mesh: nodes turned by a *TRANSFORM that cannot be evaluated, and ends of
/// edges all whose elements *MODEL CHANGE removes. "deck.inp:12: ...".
std::vector<std::string> problems_of_ties(const Mesh& mesh);

}  // namespace femscalpel
