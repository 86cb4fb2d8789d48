// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Reads a CalculiX 2.20 / Abaqus input deck (.inp), plain or gzip'd, with its includes.
///
/// What becomes what:
/// - *NODE and *ELEMENT: nodes and elements. Each such card is also a hidden group ("*NODE#1",
///   "*ELEMENT#3"), so that what an operator makes of a card's elements stays under that card.
/// - *NSET, NSET= and *SURFACE, TYPE=NODE: node groups. Where a node set and a node surface have the same
///   name, the surface's group is called NAME_SURFACE.
/// - *ELSET, ELSET=: element groups.
/// - *SURFACE, TYPE=ELEMENT: facet groups; S1, S2, ... of plane and axisymmetric elements are edges and
///   become faces 3, 4, ... of Facet.
/// - C3D8 and C3D20 whose upper nodes are one: pyramids; what write_inp() added for them goes.
/// - User elements, network elements without an end node (0), element numbers of a submodel's global
///   model, surface faces of beams: kept beside the mesh (OtherElement, DeckSet::unheld).
/// - Everything else is kept verbatim, in place, in Mesh::companion, a SolverInput. Includes are resolved, also lines
/// of
///   data that stand in a file (*NODE, INPUT=), and decks of parts put together (flatten_parts.h).
///
/// Names compare as in CalculiX: case and blanks do not count. A group has the first spelling.
/// Sets may name numbers the deck does not define; as in CalculiX this is only a warning
/// (SolverInput::warnings()).
///
/// Throws ReadError "file:line: ..." when a file is missing or truncated, includes itself, a number is
/// not a number, an element names a missing node, has too few nodes or a type CalculiX does not know, a
/// number is used twice (a node repeated with the same coordinates is accepted), a set names an
/// undefined set, a surface names a face the element has not, or when there are no nodes.
Mesh read_inp(const std::filesystem::path& path);

/// Writes a CalculiX deck, gzip'd if `path` ends in ".gz".
///
/// A mesh read from a deck goes back into its deck. Cards keep their order, place and text; lines of
/// *NODE and *ELEMENT change only where a node or element did, further members follow the last one, and
/// a set is listed anew (at its first card) only when its cards would no longer give its members. A set
/// that became empty stays defined, by an empty *NODE, NSET= or *ELEMENT, ELSET= card, or a *SURFACE card without
/// lines, so that CalculiX goes on where cards name it; where it would forget these, a set of one node comes before all
/// others (last_set.h), and goes where the deck is read. Sets whose group is gone from the
/// mesh go. New things come after the deck's last mesh card.
///
/// Elements that stand under no *ELEMENT card (made by an operator; all elements of a mesh from another
/// format) are written by what they are, because an element in the deck always adds stiffness:
/// - solids: C3D4, C3D10, C3D6, C3D15, C3D8, C3D20; pyramids as C3D8 and C3D20 whose upper nodes are one (and an
///   *EQUATION card with these, see edge_ties.h);
/// - triangles and quadrangles that are faces of a solid: not as elements; their groups become *SURFACE,
///   TYPE=ELEMENT (between two solids: the face of the one with the lower number) and *NSET. Others: shells
///   S3, S6, S4, S8;
/// - segments that are edges of an element: not as elements; their groups become *NSET and, on plane or
///   shell elements, *SURFACE, TYPE=ELEMENT. Others, and those that an operator laid there as beams (edge_beams.h):
///   beams B31, B32;
/// - points: not as elements; their groups become *NSET.
/// The *NSET of such a group is left out if a node group has that name. Elements in no group that are not
/// written as elements are not written at all.
///
/// Edges between elements of second and of first order that an operator made get *EQUATION cards, too. Lines of
/// *BOUNDARY may name sets without the middles of such edges; reading puts back what was there (edge_ties.h).
///
/// CalculiX reads at most 20 characters of a coordinate. Most values fit exactly; of those that do not
/// (16 or 17 significant digits below 0.1, or with an exponent) the closest that fits is written: at least
/// 15 significant digits; 14 where the exponent has three digits, and of negative values also where it is -86 or less.
/// What is not changed in a deck keeps its text.
///
/// Throws WriteError for element types CalculiX does not have (those with face or volume centre nodes), names over 80
/// characters or with commas, two groups of a kind whose names differ only in case or blanks, a mesh without nodes,
/// elements that take the number or lack the node of an OtherElement, and when the file cannot be written; the file is
/// then as it was before.
void write_inp(const Mesh& mesh, const std::filesystem::path& path);

/// What of a mesh a deck does not hold, a line each: elements that are faces, edges or points and so are not written as
/// elements (of a mesh that has a deck only those in no group), the unit, and the new names of groups that the deck's
/// cards go on naming by their sets' names.
std::vector<std::string> inp_losses(const Mesh& mesh);

}  // namespace femscalpel
