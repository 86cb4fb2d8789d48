// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/med_soundness.h"

#include <array>
#include <cstring>
#include <fstream>

#include "cancel.h"
#include "error.h"
#include "helper_process.h"
#include "io/med_structure.h"
#include "utf8.h"

namespace femscalpel {
namespace {

constexpr double check_seconds = 60;

}  // namespace

bool is_old_hdf5(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    // Signature, then the superblock's version: at the beginning, or behind a block of the user's whose size is a power
    // of two from 512 on (HDF5 File Format Specification, section II.A).
    for (std::streamoff at = 0; file.seekg(at); at = at == 0 ? 512 : 2 * at) {
        std::array<char, 9> start{};
        if (!file.read(start.data(), start.size())) return false;
        if (std::memcmp(start.data(), "\x89HDF\r\n\x1a\n", 8) == 0) return start[8] == 0 || start[8] == 1;
    }
    return false;
}

std::string check_med_program() {
    return helper_program("femscalpel-check-med", "the program that looks at old MED files");
}

bool MedSoundness::of_mesh() {
    if (!mesh_) {
        if (is_old_hdf5(path_))
            ask_program();
        else
            mesh_ = is_sound_structure(path_, MedPart::mesh, MedLook::structure);
    }
    return *mesh_;
}

bool MedSoundness::of_fields() {
    if (!fields_) {
        if (is_old_hdf5(path_))
            ask_program();
        else
            fields_ = is_sound_structure(path_, MedPart::fields, MedLook::structure);
    }
    return *fields_;
}

void MedSoundness::ask_program() {
    try {
        const std::string program = check_med_program();
        HelperProcess process(program, {path_}, check_seconds);
        const auto says = [&](char expected) {
            char word = 0;
            return process.receive_all(&word, 1) && word == expected;
        };
        if (!says(check_med_protocol::begun)) throw Error("cannot start " + program + ": it ends at once");
        mesh_ = says(check_med_protocol::sound_mesh);
        fields_ = *mesh_ && says(check_med_protocol::sound_fields);
    } catch (const Cancelled&) {
        throw;
    } catch (const Error& error) {
        throw ReadError(shown_path(path_) + ": " + error.what());
    }
}

}  // namespace femscalpel
