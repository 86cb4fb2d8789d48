// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <med.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <string>

#include "mesh/cell_type.h"

/// What reading and writing MED share: MED-fichier and HDF5 kept in order, and MED's element types.
namespace femscalpel {

/// Waits for the libraries, neither of which is thread-safe, and keeps other threads out while the lock is held. Throws
/// Cancelled.
std::unique_lock<std::timed_mutex> lock_libraries();

/// An enumeration's value as the library has read it: in a damaged file any number, which C++ does not let us load as
/// what it is declared.
template <class Enumeration>
int as_number(const Enumeration& value) {
    static_assert(sizeof(Enumeration) == sizeof(int));
    int out = 0;
    std::memcpy(&out, &value, sizeof out);
    return out;
}

/// An element type as MED knows it.
struct MedType {
    med_geometry_type geometry;
    const char* name;
    /// Node k of our element is node order[k] of MED's.
    std::array<std::int8_t, 27> order;
};

/// MED's for one of ours.
const MedType& med_type(CellType type);

/// Entries of a data set of an open file; 0 without one.
std::size_t size_of_dataset(med_idt file, const std::string& path);

/// An open MED file. MED-fichier leaves HDF5 objects open when it fails, which would keep the file open
/// and let a later read of the same path see stale data; so all of them are closed here.
class MedFile {
public:
    /// `id`: of MEDfileOpen() or H5Fopen(); negative where that failed, nothing is closed then.
    explicit MedFile(med_idt id) : id_(id) {}
    ~MedFile() { close(); }
    MedFile(const MedFile&) = delete;
    MedFile& operator=(const MedFile&) = delete;

    med_idt id() const { return id_; }

    /// False when closing failed, and what was written is not on the disk.
    bool close();

private:
    med_idt id_;
};

}  // namespace femscalpel
