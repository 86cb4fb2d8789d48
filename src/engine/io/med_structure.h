// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

/// What the engine and the program for old files (src/med_checker) share: a look at the structure of a MED file by
/// HDF5, without MED-fichier. Callers go through MedSoundness.
namespace femscalpel {

/// What of a MED file is looked at.
enum class MedPart {
    mesh,   ///< what MED-fichier reads a mesh from
    fields  ///< what it reads fields from, whose text attributes have at most longest_med_attribute bytes
};

/// How well.
enum class MedLook {
    structure,  ///< names, attributes and headers
    everything  ///< the data, too, which have no checksums in files of HDF5 before 1.8, nor have the others there
};

/// Whether it can be walked and fits MED-fichier's buffers. HDF5 may crash on what MedLook::structure finds in a
/// damaged file whose metadata have no checksums. HDF5 is to be kept quiet, and to be used by no other thread.
bool is_sound_structure(const std::string& path, MedPart part, MedLook look);

/// In bytes; names of a field's components are the longest.
inline constexpr std::size_t longest_med_attribute = 65536;

/// No array in a file of so many bytes can have more than these; what says that it has is damaged. Compressed files
/// shrink at most so much.
constexpr std::uint64_t largest_med_array(std::uint64_t file_size) { return 1000 * (file_size + 1024); }

/// What the program says by single characters, in this order, until it finds damage, crashes or has looked at all.
namespace check_med_protocol {
inline constexpr char begun = 'b';         ///< it runs
inline constexpr char sound_mesh = 'm';    ///< MedPart::mesh is sound
inline constexpr char sound_fields = 'f';  ///< and so is MedPart::fields
}  // namespace check_med_protocol

}  // namespace femscalpel
