// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "deck/solver_input.h"

namespace femscalpel {

/// Writes what Abaqus/CAE writes and CalculiX does not read as CalculiX reads it: sets of one node where it wants the
/// node's number (reference nodes, terms of equations), keyword lines of several lines, supports by name (ENCASTRE,
/// PINNED, XSYMM...), *KINEMATIC without lines or of rotations, *RIGID BODY of TIE NSET= and PIN NSET=, loads without a
/// set (GRAV). `cards` is a whole flat deck; what stays unreadable is told in `warnings`.
void fit_to_calculix(std::vector<Card>& cards, std::vector<std::string>& warnings);

}  // namespace femscalpel
