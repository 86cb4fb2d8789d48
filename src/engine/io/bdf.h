// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Reads the mesh of a Nastran deck (.bdf, .nas, .dat): whole, or bulk data alone.
///
/// Cards are in small, large or free field, with continuation lines that follow them. GRID, also with GRDSET, in the
/// coordinate systems of CORD1R, CORD2R, CORD1C, CORD2C, CORD1S, CORD2S, as places in the basic system. Elements: CROD,
/// CTUBE, CBAR, CBEAM, CBEND, CONROD (line), CBEAM3 (line3), CTRIA3, CTRIAR, CTRIA6, CQUAD4, CQUADR, CSHEAR, CQUAD8,
/// CQUAD, CTETRA, CPYRAM, CPENTA, CHEXA, the last four of either order. Axisymmetric and plane elements of nonlinear
/// analysis, and elements some of whose mid-side nodes are left out, throw UnsupportedElementError.
///
/// Groups: elements of a property PID_3, or as comments of HyperMesh, ANSA or Femap call it; those of CONROD
/// CONROD. Sets of case control SET_7, or as HyperMesh's comments call them: of nodes or elements as its comments or
/// the output requests say, else a group of each kind whose numbers the mesh has. Nodes of SPC1 and SPC cards
/// SPC_1_123456, by set and components.
///
/// Mesh::remarks tells what is not in the mesh: other cards (springs, masses, rigid elements, loads, properties), by
/// name; displacement systems, orientations, offsets; case control.
///
/// Throws ReadError with file and line: file missing, contradictory, INCLUDE, superelements.
Mesh read_bdf(const std::filesystem::path& path);

/// Writes a Nastran deck of a mesh alone: GRID cards in large field, elements in small field, groups as sets of case
/// control, named by comments as HyperMesh's are. All elements have property 1, which stands for no group.
///
/// bdf_losses() says what is left out. Written by way of AtomicFile. The mesh must be valid (Mesh::validate).
/// Throws WriteError: no nodes; points, triangle7, wedge18, hexahedron27, which the format has not; numbers over
/// 99999999; a group's name with a quotation mark or control characters; path not writable; disk full.
void write_bdf(const Mesh& mesh, const std::filesystem::path& path);

/// What of this mesh write_bdf() leaves out, a line each: facet groups by name, digits of coordinates that fields of 16
/// characters do not hold, a deck's cards, the mesh's name and unit.
std::vector<std::string> bdf_losses(const Mesh& mesh);

}  // namespace femscalpel
