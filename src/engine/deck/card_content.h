// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "deck/solver_input.h"

namespace femscalpel {

/// Which nodes and elements the lines of a card can name by number (or set), and to what end.
enum class CardContent : std::uint8_t {
    nothing,          ///< none; or sets and surfaces only, which follow the mesh's groups
    mesh,             ///< *NODE, *ELEMENT and sets: written from the mesh
    nodal_dofs,       ///< node, first degree of freedom, last, value: *BOUNDARY
    nodal_dof,        ///< node, degree of freedom, value: initial displacements, velocities
    nodal_values,     ///< node, values: *TEMPERATURE, initial temperatures, thicknesses
    nodal_list,       ///< node: *SUBMODEL
    node_loads,       ///< node, degree of freedom, value; a sum counts, not a field: *CLOAD, *CFLUX
    node_weights,     ///< as node_loads: *DISTRIBUTING COUPLING, *RETAINED NODAL DOFS
    element_loads,    ///< element, label of a face or of a load on all of it, ...: *DLOAD, *FILM, ...
    element_values,   ///< element, ...: *DISTRIBUTION, initial stresses
    element_list,     ///< elements: *MODEL CHANGE
    element_normals,  ///< element, node, ...: *NORMAL
    equation,         ///< *EQUATION and its like
    face_equation,    ///< *EQUATIONF: terms of element, face, degree of freedom, coefficient
    mpc,              ///< *MPC
    foreign_results,  ///< results of the old mesh are read: *RESTART, READ
};

/// What a card's lines name, by CalculiX 2.20's manual; none for a keyword CalculiX does not have.
/// REF NODE=, ROT NODE=, NODE= and ELEMENT= on the keyword line are not covered.
std::optional<CardContent> card_content(const Card& card);

/// The second entry of a distributed load ("P3", "EDNOR2", "F1FC", "GRAV", "SPOS") taken apart.
struct LoadLabel {
    std::string prefix;
    int number = 0;  ///< of the face or edge, 0 for a load on the whole element or a whole side of a shell
    std::string suffix;

    explicit LoadLabel(std::string_view label);

    /// Facet::face the label means on an element of `type`; 0 if it names none that element has.
    int face(CellType type, bool plane) const;
    /// The label for another face (as face() counts).
    std::string with_face(int face, bool plane) const;

private:
    bool is_edge_load() const { return prefix == "EDNOR"; }
};

}  // namespace femscalpel
