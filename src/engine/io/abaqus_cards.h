// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string_view>
#include <vector>

#include "deck/solver_input.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// Whether INPUT= of such a card names, in Abaqus, the file that holds its lines of data. (Of *SUBMODEL and *VIEWFACTOR
/// it names results.)
bool has_data_in_file(std::string_view keyword);

/// Throws ReadError "file:line: ..." for cards by which Abaqus makes part of the mesh while it reads the deck, or puts
/// it elsewhere, so that without them another mesh were read: *NGEN, *ELGEN and kin, *IMPORT, surfaces put together of
/// others, and, where the deck has no instances (flatten_parts() works them out), *SYSTEM, coordinates that are not x,
/// y, z, and GENERATE cut short (GEN), which Abaqus takes for the word and CalculiX for nothing.
void refuse_generated_mesh(const std::vector<Card>& cards);

/// Lists the nodes of the elements in the card where *NSET names an element set (ELSET=), which CalculiX passes over,
/// and warns of it. The nodes and elements of `mesh` are all read, its groups and `input`'s sets declared. Throws
/// ReadError for an element set that is not there.
void list_nodes_of_element_sets(const Mesh& mesh, SolverInput& input);

/// Warns of constraints that Abaqus has and CalculiX passes over without an error: *KINEMATIC without lines, *RIGID
/// BODY without a set that CalculiX knows.
void warn_of_idle_constraints(SolverInput& input);

/// Warns of cards that CalculiX 2.20 does not have and a later one has, with its version: a solver that is older passes
/// over them.
void warn_of_newer_cards(SolverInput& input);

/// Whether a parameter is GENERATE, cut short as Abaqus lets one do.
bool is_short_generate(std::string_view parameter);

}  // namespace femscalpel
