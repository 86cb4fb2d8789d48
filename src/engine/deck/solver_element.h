// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// What the TYPE of an *ELEMENT card says about its elements.
struct DeckElementType {
    CellType cell = CellType::tetra;
    /// Plane stress, plane strain and axisymmetric elements count their edges S1, S2, ... and call their
    /// faces SN and SP; shells count negative and positive side first.
    bool plane = false;
    bool whole = false;  ///< a spring, dashpot, gap or fluid pipe, whose parts would be something else
};

/// Element types CalculiX 2.20 knows, and C3D5; suffixes for integration and formulation (R, I, T, H,
/// ...), heat transfer (DC3D8, DCAX4, ...) and fluid (F3D8) variants included; and those of Abaqus that are triangles,
/// quadrangles, solids or segments like them (STRI3, S4R5, B33, R3D4, SFM3D3, SC8R, CONN3D2, ...). None for
/// others.
/// CalculiX and VTK number the nodes of all of them alike, except that three-node lines (B32, T3D3, D)
/// have their middle node second.
std::optional<DeckElementType> deck_element_type(std::string_view label);

/// Whether elements of a type can stand under a card that says this. CalculiX has no pyramids: one is a C3D8 or C3D20
/// whose upper nodes are one, and is read as a pyramid again. (Exact for linear displacements in CalculiX 2.20.)
bool holds(const DeckElementType& said, CellType type);

/// The label for elements of `type` that are parts of one with the label `written`: of the same family (shells,
/// membranes, plane strain, heat transfer, ...), without the formulation (R, I, ...) if the number of nodes is another,
/// and for pyramids of first order. Throws UnsupportedElementError for continuum shells, of which there are no smaller
/// ones.
std::string deck_label_for(std::string_view written, CellType type);

/// The label for elements that no card says more about: solids C3D*, shells S*, beams B*; empty for
/// types CalculiX has not.
std::string_view default_deck_label(CellType type);

/// Exchanges CalculiX's and the mesh's node order in place; its own inverse.
void swap_node_order(CellType type, std::span<Index> nodes);

/// The nodes of an element in the form of the type `as` (holds()): its own, but for pyramids as hexahedra.
std::vector<Index> deck_nodes(CellType type, std::span<const Index> nodes, CellType as);

/// If the nodes of a C3D8 or C3D20 are those of a pyramid: that type, and its nodes.
std::optional<std::pair<CellType, std::vector<Index>>> pyramid_from_deck(CellType type, std::span<const Index> nodes);

/// Mesh face number (Facet::face) of surface label S1 to S6, given as 1 to 6, of an element of a type; SN is 5 and SP
/// is
/// 6. 0 if the element has no such face.
int face_from_label(int label, CellType type, bool plane);
/// The inverse of face_from_label().
int label_from_face(int face, CellType type, bool plane);
/// The label as CalculiX writes it: "S3", "SPOS" (shells), "SN" (plane elements).
std::string_view label_name(int label, CellType type, bool plane);
/// Label number of "S3", "SNEG", "SPOS", "SN" or "SP"; 0 for anything else.
int label_from_name(std::string_view name);

}  // namespace femscalpel
