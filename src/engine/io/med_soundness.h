// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace femscalpel {

/// Whether MED-fichier can be let at a file. To be asked before the library reads anything: it copies link names and
/// attributes into buffers of fixed size without looking at their length, so a damaged file could overwrite memory.
/// And HDF5 itself crashes on some damaged files of the format it had before 1.8 (superblock 0 or 1), whose metadata
/// have no checksums: MED 2 wrote such, and meshio does. These are looked at by a program of its own first, which may.
class MedSoundness {
public:
    explicit MedSoundness(std::string path) : path_(std::move(path)) {}

    /// Of what a mesh is read from. The caller holds lock_libraries(). Throws Cancelled, and ReadError if the program
    /// for old files cannot be run.
    bool of_mesh();

    /// The same of what fields are read from.
    bool of_fields();

private:
    void ask_program();

    std::string path_;
    std::optional<bool> mesh_, fields_;
};

/// Whether the file is of HDF5's format before 1.8, without checksums; false also of what is no HDF5 file.
bool is_old_hdf5(const std::string& path);

/// Path of the program that looks at old files; see helper_program(). Throws Error if it is nowhere.
std::string check_med_program();

}  // namespace femscalpel
