// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "mesh/mesh.h"

namespace femscalpel {

/// Throws Error that names the card where the mesh's deck, if it has one, has what K by interaction_integrals() would
/// be wrong for: temperatures with thermal expansion, forces in the volume, or a load on the surfaces of the lips
/// `name`_P and `name`_N by their names.
void check_deck_for_fracture(const Mesh& mesh, const std::string& name);

}  // namespace femscalpel
