// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "fields/field.h"
#include "io/med_library.h"
#include "io/med_soundness.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// An open MED file that a mesh was read from.
struct MedFieldSource {
    med_idt fid = -1;
    std::string path;
    std::string mesh;                 ///< the mesh's name in the file
    bool old = false;                 ///< of a version before 3
    std::uint64_t largest_array = 0;  ///< in bytes; what says that it is larger is damaged
    MedSoundness& sound;              ///< of the file
};

/// The fields on a mesh whose nodes and elements are in the file's order; null if there are none. What cannot be read,
/// or is on other entities than nodes and elements, is named in the mesh's remarks. The caller holds lock_libraries().
std::shared_ptr<const Fields> read_med_fields(const MedFieldSource& source, Mesh& mesh);

/// What the fields of a mesh are written to.
struct MedFieldTarget {
    med_idt fid = -1;
    const char* mesh = "";  ///< its name in the file
    /// How many elements of a type the file has, if more than the mesh's block.
    std::function<Index(CellType)> count;
    /// Called with what was being written where that fails; throws.
    std::function<void(const std::string&)> fail;
};

/// Writes the fields of a mesh that has been written. The caller holds lock_libraries().
void write_med_fields(const Mesh& mesh, const MedFieldTarget& target);

}  // namespace femscalpel
