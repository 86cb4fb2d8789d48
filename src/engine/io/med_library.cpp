// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/med_library.h"

#include <vector>

#include "cancel.h"

namespace femscalpel {
namespace {

std::timed_mutex library_mutex;

// In the order of CellType. MED numbers corners of volumes such that the normal of the base points out of
// the element, ours point in; mid-side nodes follow the edges of the same scheme in both (for an edge
// scheme see CellTraits::edges), so they are permuted as the corners demand. MED's face centres of a
// HEXA27 are base, the sides along the base's edges, top; VTK's are x-, x+, y-, y+, z-, z+.
constexpr MedType med_types[cell_type_count] = {
    {MED_POINT1, "POINT1", {0}},
    {MED_SEG2, "SEG2", {0, 1}},
    {MED_SEG3, "SEG3", {0, 1, 2}},
    {MED_TRIA3, "TRIA3", {0, 1, 2}},
    {MED_TRIA6, "TRIA6", {0, 1, 2, 3, 4, 5}},
    {MED_TRIA7, "TRIA7", {0, 1, 2, 3, 4, 5, 6}},
    {MED_QUAD4, "QUAD4", {0, 1, 2, 3}},
    {MED_QUAD8, "QUAD8", {0, 1, 2, 3, 4, 5, 6, 7}},
    {MED_QUAD9, "QUAD9", {0, 1, 2, 3, 4, 5, 6, 7, 8}},
    {MED_TETRA4, "TETRA4", {0, 2, 1, 3}},
    {MED_TETRA10, "TETRA10", {0, 2, 1, 3, 6, 5, 4, 7, 9, 8}},
    {MED_PYRA5, "PYRA5", {0, 3, 2, 1, 4}},
    {MED_PYRA13, "PYRA13", {0, 3, 2, 1, 4, 8, 7, 6, 5, 9, 12, 11, 10}},
    {MED_PENTA6, "PENTA6", {0, 2, 1, 3, 5, 4}},
    {MED_PENTA15, "PENTA15", {0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13}},
    {MED_PENTA18, "PENTA18", {0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13, 17, 16, 15}},
    {MED_HEXA8, "HEXA8", {0, 3, 2, 1, 4, 7, 6, 5}},
    {MED_HEXA20, "HEXA20", {0, 3, 2, 1, 4, 7, 6, 5, 11, 10, 9, 8, 15, 14, 13, 12, 16, 19, 18, 17}},
    {MED_HEXA27, "HEXA27", {0,  3,  2,  1,  4,  7,  6,  5,  11, 10, 9,  8,  15, 14,
                            13, 12, 16, 19, 18, 17, 21, 23, 24, 22, 20, 25, 26}},
};

constexpr unsigned leftovers = H5F_OBJ_DATASET | H5F_OBJ_GROUP | H5F_OBJ_DATATYPE | H5F_OBJ_ATTR | H5F_OBJ_LOCAL;

}  // namespace

std::unique_lock<std::timed_mutex> lock_libraries() {
    std::unique_lock lock(library_mutex, std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(20))) check_cancelled();
    return lock;
}

const MedType& med_type(CellType type) { return med_types[static_cast<int>(type)]; }

std::size_t size_of_dataset(med_idt file, const std::string& path) {
    const hid_t dataset = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
    if (dataset < 0) return 0;
    const hid_t space = H5Dget_space(dataset);
    const hssize_t size = H5Sget_simple_extent_npoints(space);
    H5Sclose(space);
    H5Dclose(dataset);
    return size < 0 ? 0 : static_cast<std::size_t>(size);
}

bool MedFile::close() {
    if (id_ < 0) return true;
    const ssize_t open = H5Fget_obj_count(id_, leftovers);
    if (open > 0) {
        std::vector<hid_t> ids(static_cast<std::size_t>(open));
        const ssize_t found = H5Fget_obj_ids(id_, leftovers, ids.size(), ids.data());
        for (ssize_t i = 0; i < found; ++i) H5Idec_ref(ids[static_cast<std::size_t>(i)]);
    }
    const bool good = MEDfileClose(id_) >= 0;
    id_ = -1;
    return good;
}

}  // namespace femscalpel
