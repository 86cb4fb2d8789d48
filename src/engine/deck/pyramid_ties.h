// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "deck/solver_input.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// The *EQUATION card that pyramids of second order need in CalculiX, or nothing. There they are C3D20 with one upper
/// node, whose shape functions on a side differ from those of a triangle of six nodes by as much as the edge at the
/// base bends (Newton, "Degeneration of brick-type isoparametric elements", Int. J. Numer. Meth. Engng. 7 (1973)).
/// Where a tetrahedron or prism is across, that edge is kept straight: its mid-side node in the mean of its ends. Then
/// both fit; a linear displacement is exact, which it is not without. The card is no part of the deck: it is left out
/// where a deck is read (remove_pyramid_ties()), and made anew where it is written.
///
/// Left out are BoundNodes: degrees of freedom that *BOUNDARY sets, and nodes that another relation may set.
std::string pyramid_ties(const Mesh& mesh);

/// Takes such cards out; comments behind them go to the card before.
void remove_pyramid_ties(std::vector<Card>& cards);

}  // namespace femscalpel
