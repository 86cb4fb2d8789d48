// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/med.h"

#include <med.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <unordered_map>
#include <vector>

#include "cancel.h"
#include "error.h"
#include "io/atomic_file.h"

namespace femscalpel {
namespace {

// Neither library is thread-safe.
std::timed_mutex library_mutex;

/// Waits for the libraries.
std::unique_lock<std::timed_mutex> lock_libraries() {
    std::unique_lock lock(library_mutex, std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(20))) check_cancelled();
    return lock;
}

/// Keeps HDF5 from printing its error stack. MED-fichier does so too, with an older call that leaves HDF5
/// confused when it closes at the end of the program; hence once more at the end.
struct QuietHdf5 {
    QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }
    ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }
};

/// An element type as MED knows it.
struct MedType {
    med_geometry_type geometry;
    const char* name;
    /// Node k of our element is node order[k] of MED's.
    std::array<std::int8_t, 27> order;
};

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

const MedType& med_type(CellType type) { return med_types[static_cast<int>(type)]; }

using MedInts = std::unique_ptr<med_int[]>;

/// Text of a fixed-width field: up to the first NUL, without trailing blanks.
std::string trimmed(const char* field, std::size_t width) {
    std::size_t n = 0;
    while (n < width && field[n] != '\0') ++n;
    while (n > 0 && field[n - 1] == ' ') --n;
    return {field, n};
}

/// An open MED file. MED-fichier leaves HDF5 objects open when it fails, which would keep the file open
/// and let a later read of the same path see stale data; so all of them are closed here.
class MedFile {
public:
    explicit MedFile(med_idt id) : id_(id) {}
    ~MedFile() { close(); }
    MedFile(const MedFile&) = delete;
    MedFile& operator=(const MedFile&) = delete;

    med_idt id() const { return id_; }

    bool close() {
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

private:
    static constexpr unsigned leftovers =
        H5F_OBJ_DATASET | H5F_OBJ_GROUP | H5F_OBJ_DATATYPE | H5F_OBJ_ATTR | H5F_OBJ_LOCAL;
    med_idt id_;
};

// ---------------------------------------------------------------------------------------------------
// What MED-fichier takes on trust. It copies link names and attributes into buffers of fixed size
// without looking at their length, so a damaged file could overwrite memory. Before the library reads
// anything, everything it will touch is checked here.

/// Longest path below the file's root that MED-fichier's buffers hold.
constexpr std::size_t longest_path = 200;

herr_t check_attribute(hid_t object, const char* name, const H5A_info_t*, void*) {
    const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    if (attribute < 0) return -1;
    const hid_t space = H5Aget_space(attribute);
    const bool single = space >= 0 && H5Sget_simple_extent_npoints(space) == 1;
    if (space >= 0) H5Sclose(space);
    H5Aclose(attribute);
    return single ? 0 : -1;
}

bool check_dataset(hid_t object) {
    const hid_t space = H5Dget_space(object);
    if (space < 0) return false;
    const bool good = H5Sget_simple_extent_ndims(space) == 1;
    H5Sclose(space);
    return good;
}

herr_t visit_link(hid_t, const char*, const H5L_info_t*, void*) { return 0; }

/// MED-fichier finds families by the order they were made in, an index that can be damaged by itself.
bool check_creation_order(hid_t group) {
    const hid_t properties = H5Gget_create_plist(group);
    if (properties < 0) return false;
    unsigned order = 0;
    const bool known = H5Pget_link_creation_order(properties, &order) >= 0;
    H5Pclose(properties);
    if (!known) return false;
    hsize_t first = 0;
    return !(order & H5P_CRT_ORDER_INDEXED) ||
           H5Literate(group, H5_INDEX_CRT_ORDER, H5_ITER_NATIVE, &first, visit_link, nullptr) >= 0;
}

herr_t check_object(hid_t root, const char* path, const H5O_info_t* info, void*) {
    const char* slash = std::strrchr(path, '/');
    if (std::strlen(slash ? slash + 1 : path) > MED_NAME_SIZE || std::strlen(path) > longest_path) return -1;
    const bool family_list = slash && (std::strcmp(slash, "/ELEME") == 0 || std::strcmp(slash, "/NOEUD") == 0);
    if (info->num_attrs == 0 && info->type != H5O_TYPE_DATASET && !family_list) return 0;
    const hid_t object = H5Oopen(root, path, H5P_DEFAULT);
    if (object < 0) return -1;
    hsize_t first = 0;
    bool good = H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, &first, check_attribute, nullptr) >= 0;
    if (good && info->type == H5O_TYPE_DATASET) good = check_dataset(object);
    if (good && family_list) good = check_creation_order(object);
    H5Oclose(object);
    return good ? 0 : -1;
}

/// Whether the parts of the file MED-fichier reads a mesh from can be walked and fit its buffers.
bool sound(const std::string& path) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) return false;
    MedFile closer(file);
    for (const char* part : {"INFOS_GENERALES", "ENS_MAA", "FAS"}) {
        const htri_t there = H5Lexists(file, part, H5P_DEFAULT);
        if (there < 0) return false;
        if (there == 0) continue;
        const hid_t group = H5Gopen2(file, part, H5P_DEFAULT);
        if (group < 0) return false;
        const herr_t walked =
            H5Ovisit2(group, H5_INDEX_NAME, H5_ITER_NATIVE, check_object, nullptr, H5O_INFO_BASIC | H5O_INFO_NUM_ATTRS);
        H5Gclose(group);
        if (walked < 0) return false;
    }
    return true;
}

// ---------------------------------------------------------------------------------------------------

/// A family as the file declares it.
struct FileFamily {
    med_int number = 0;
    std::vector<std::string> names;
    bool nodes = false;     // used by nodes
    bool elements = false;  // used by elements
    FamilyIndex as_nodes = 0;
    FamilyIndex as_elements = 0;
};

/// Family number to position in the list; a flat table, since numbers are dense in practice.
class FamilyNumbers {
public:
    void build(const std::vector<FileFamily>& families) {
        low_ = 0;
        med_int high = 0;
        for (const FileFamily& f : families) {
            low_ = std::min(low_, f.number);
            high = std::max(high, f.number);
        }
        const std::int64_t range = std::int64_t{high} - low_ + 1;
        if (range <= 16 * static_cast<std::int64_t>(families.size()) + 65536) {
            flat_.assign(static_cast<std::size_t>(range), -1);
            for (std::size_t i = 0; i < families.size(); ++i)
                flat_[static_cast<std::size_t>(std::int64_t{families[i].number} - low_)] = static_cast<std::int32_t>(i);
        } else {
            for (std::size_t i = 0; i < families.size(); ++i)
                sparse_.emplace(families[i].number, static_cast<std::int32_t>(i));
        }
    }

    std::int32_t find(med_int number) const {
        if (!flat_.empty()) {
            const std::int64_t at = std::int64_t{number} - low_;
            return at >= 0 && at < static_cast<std::int64_t>(flat_.size()) ? flat_[static_cast<std::size_t>(at)] : -1;
        }
        const auto it = sparse_.find(number);
        return it == sparse_.end() ? -1 : it->second;
    }

private:
    med_int low_ = 0;
    std::vector<std::int32_t> flat_;
    std::unordered_map<med_int, std::int32_t> sparse_;
};

class Reader {
public:
    explicit Reader(const std::filesystem::path& path) : path_(path.string()) {}

    Mesh read() {
        std::error_code error;
        const auto status = std::filesystem::status(path_, error);
        if (!std::filesystem::exists(status)) fail("there is no such file");
        if (!std::filesystem::is_regular_file(status)) fail("not a file");
        file_size_ = std::filesystem::file_size(path_, error);
        if (error) fail("cannot be read: " + error.message());
        if (std::FILE* probe = std::fopen(path_.c_str(), "rb"))
            std::fclose(probe);
        else
            fail(std::string("cannot be read: ") + std::strerror(errno));

        if (H5Fis_hdf5(path_.c_str()) <= 0) fail("not a MED file (nor any HDF5 file)");
        if (!sound(path_)) fail("truncated or damaged: its structure cannot be read");
        med_bool hdf_good = MED_FALSE, med_good = MED_FALSE;
        if (MEDfileCompatibility(path_.c_str(), &hdf_good, &med_good) < 0) damaged("its MED version");
        if (!med_good) fail("not a MED file, or one of a MED version this library (" MED_VERSION_STR ") cannot read");

        check_cancelled();
        MedFile file(MEDfileOpen(path_.c_str(), MED_ACC_RDONLY));
        fid_ = file.id();
        if (fid_ < 0) damaged("the file");
        find_mesh();
        read_families();
        read_nodes();
        read_elements();
        make_families();
        number_elements();
        try {
            mesh_.validate();
        } catch (const Cancelled&) {
            throw;
        } catch (const Error& e) {
            fail(std::string("contradictory or damaged: ") + e.what());
        }
        return std::move(mesh_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw ReadError(path_ + ": " + what); }
    [[noreturn]] void damaged(const std::string& what) const { fail("truncated or damaged: cannot read " + what); }

    void find_mesh() {
        const med_int meshes = MEDnMesh(fid_);
        if (meshes < 0) damaged("the list of meshes");
        if (meshes == 0) fail("contains no mesh");
        for (int i = 1; i <= meshes; ++i) {
            const med_int axes = MEDmeshnAxis(fid_, i);
            if (axes < 0) damaged("the number of axes of mesh " + std::to_string(i));
            if (axes < 1 || axes > 3) fail("mesh " + std::to_string(i) + " has " + std::to_string(axes) + " axes");
            char description[MED_COMMENT_SIZE + 1] = "", dt_unit[MED_SNAME_SIZE + 1] = "";
            char axis_names[3 * MED_SNAME_SIZE + 1] = "", axis_units[3 * MED_SNAME_SIZE + 1] = "";
            med_int space_dimension = 0, mesh_dimension = 0, steps = 0;
            med_mesh_type type = MED_UNDEF_MESH_TYPE;
            med_sorting_type sorting = MED_SORT_UNDEF;
            med_axis_type axis_type = MED_UNDEF_AXIS_TYPE;
            if (MEDmeshInfo(fid_, i, name_, &space_dimension, &mesh_dimension, &type, description, dt_unit, &sorting,
                            &steps, &axis_type, axis_names, axis_units) < 0)
                damaged("the description of mesh " + std::to_string(i));
            if (type != MED_UNSTRUCTURED_MESH) continue;
            if (axis_type != MED_CARTESIAN)
                fail("mesh '" + std::string(name_) +
                     "' has cylindrical or spherical coordinates; convert it to Cartesian ones");
            if (space_dimension != axes) damaged("the dimension of mesh '" + std::string(name_) + "'");
            med_float time = 0;
            if (steps < 1 || MEDmeshComputationStepInfo(fid_, name_, 1, &step_, &iteration_, &time) < 0)
                fail("mesh '" + std::string(name_) + "' is declared but has no nodes, or the file is damaged");
            dimension_ = static_cast<int>(axes);
            mesh_.name = name_;
            mesh_.unit = trimmed(axis_units, MED_SNAME_SIZE);
            return;
        }
        fail("contains structured grids only; convert the grid to an unstructured mesh");
    }

    void read_families() {
        const med_int count = MEDnFamily(fid_, name_);
        if (count < 0) damaged("the list of families");
        families_.emplace_back();  // family 0 is there, declared or not
        std::vector<char> names;
        for (int i = 1; i <= count; ++i) {
            const med_int groups = MEDnFamilyGroup(fid_, name_, i);
            const auto bytes = static_cast<std::uint64_t>(std::max<med_int>(groups, 0)) * MED_LNAME_SIZE;
            if (groups < 0 || bytes > largest_array()) damaged("the groups of family " + std::to_string(i));
            names.assign(bytes + 1, '\0');
            char family_name[MED_NAME_SIZE + 1] = "";
            FileFamily family;
            if (MEDfamilyInfo(fid_, name_, i, family_name, &family.number, names.data()) < 0)
                damaged("family " + std::to_string(i));
            if (family.number == 0) continue;
            for (med_int g = 0; g < groups; ++g) {
                std::string group =
                    trimmed(names.data() + static_cast<std::size_t>(g) * MED_LNAME_SIZE, MED_LNAME_SIZE);
                if (!group.empty()) family.names.push_back(std::move(group));
            }
            families_.push_back(std::move(family));
        }
        numbers_.build(families_);
        for (std::size_t i = 0; i < families_.size(); ++i)
            if (numbers_.find(families_[i].number) != static_cast<std::int32_t>(i))
                fail("contradictory or damaged: family number " + std::to_string(families_[i].number) +
                     " is declared twice");
    }

    /// No array can be larger than this; a larger count is damage. Compressed files shrink at most so much.
    std::uint64_t largest_array() const { return 1000 * (file_size_ + 1024); }

    Index count(med_entity_type entity, med_geometry_type geometry, med_data_type data,
                med_connectivity_mode mode = MED_NODAL) const {
        med_bool changed = MED_FALSE, transformed = MED_FALSE;
        return MEDmeshnEntity(fid_, name_, step_, iteration_, entity, geometry, data, mode, &changed, &transformed);
    }

    MedInts ints(Index n, const std::string& what) const {
        if (static_cast<std::uint64_t>(n) * sizeof(med_int) > largest_array()) damaged(what);
        return std::make_unique_for_overwrite<med_int[]>(static_cast<std::size_t>(n));
    }

    /// Family positions of `n` entities; all 0 where the file has none.
    std::vector<FamilyIndex> family_positions(med_entity_type entity, med_geometry_type geometry, Index n,
                                              const std::string& who) {
        std::vector<FamilyIndex> out(static_cast<std::size_t>(n), 0);
        const Index stored = count(entity, geometry, MED_FAMILY_NUMBER);
        if (stored < 0) damaged("the families of " + who);
        if (stored == 0) return out;
        if (stored != n)
            fail("contradictory or damaged: " + std::to_string(n) + " " + who + ", but " + std::to_string(stored) +
                 " family numbers");
        const MedInts raw = ints(n, "the families of " + who);
        check_cancelled();
        if (MEDmeshEntityFamilyNumberRd(fid_, name_, step_, iteration_, entity, geometry, raw.get()) < 0)
            damaged("the families of " + who);
        med_int last = 0;
        std::int32_t position = 0;
        SparseCheck check(1 << 16);
        for (Index i = 0; i < n; ++i, check()) {
            if (raw[i] != last) {
                last = raw[i];
                position = numbers_.find(last);
                if (position < 0)
                    fail("contradictory or damaged: some " + who + " are in family " + std::to_string(last) +
                         ", which the file does not declare");
            }
            out[static_cast<std::size_t>(i)] = position;
            FileFamily& family = families_[static_cast<std::size_t>(position)];
            (entity == MED_NODE ? family.nodes : family.elements) = true;
        }
        return out;
    }

    /// The optional numbers of `n` entities; empty where the file has none.
    std::vector<Index> optional_numbers(med_entity_type entity, med_geometry_type geometry, Index n,
                                        const std::string& who) {
        const Index stored = count(entity, geometry, MED_NUMBER);
        if (stored < 0) damaged("the numbers of " + who);
        if (stored == 0) return {};
        if (stored != n)
            fail("contradictory or damaged: " + std::to_string(n) + " " + who + ", but " + std::to_string(stored) +
                 " numbers");
        const MedInts raw = ints(n, "the numbers of " + who);
        check_cancelled();
        if (MEDmeshEntityNumberRd(fid_, name_, step_, iteration_, entity, geometry, raw.get()) < 0)
            damaged("the numbers of " + who);
        return {raw.get(), raw.get() + n};
    }

    void read_nodes() {
        const Index n = count(MED_NODE, MED_NONE, MED_COORDINATE, MED_NO_CMODE);
        if (n < 0) damaged("the number of nodes");
        if (n == 0) fail("mesh '" + mesh_.name + "' has no nodes");
        const auto values = static_cast<std::uint64_t>(n) * static_cast<std::uint64_t>(dimension_);
        if (values * sizeof(med_float) > largest_array()) damaged("the coordinates");
        const auto raw = std::make_unique_for_overwrite<med_float[]>(values);
        check_cancelled();
        // Coordinate by coordinate, as they lie in the file: HDF5 interleaves many times slower than we do.
        if (MEDmeshNodeCoordinateRd(fid_, name_, step_, iteration_, MED_NO_INTERLACE, raw.get()) < 0)
            damaged("the coordinates");
        check_cancelled();
        mesh_.points.resize(static_cast<std::size_t>(n));
        for (Index i = 0; i < n; ++i) {
            Vec3& p = mesh_.points[static_cast<std::size_t>(i)];
            p.setZero();
            for (int a = 0; a < dimension_; ++a) p[a] = raw[a * n + i];
        }
        mesh_.node_ids = optional_numbers(MED_NODE, MED_NONE, n, "nodes");
        if (mesh_.node_ids.empty()) {
            mesh_.node_ids.resize(static_cast<std::size_t>(n));
            for (Index i = 0; i < n; ++i) mesh_.node_ids[static_cast<std::size_t>(i)] = i + 1;
        }
        mesh_.node_families = family_positions(MED_NODE, MED_NONE, n, "nodes");
    }

    [[noreturn]] void unsupported(Index n, const std::string& what) const {
        throw UnsupportedElementError(path_ + ": mesh '" + mesh_.name + "' has " + std::to_string(n) + " " + what +
                                      ", which FemScalpel cannot hold; remove or convert them");
    }

    void refuse_unsupported() const {
        struct Kind {
            med_geometry_type geometry;
            const char* name;
            med_data_type counted;
            int extra;  // index arrays hold one entry more than there are elements
        };
        constexpr Kind kinds[] = {{MED_SEG4, "SEG4 elements", MED_CONNECTIVITY, 0},
                                  {MED_OCTA12, "OCTA12 elements", MED_CONNECTIVITY, 0},
                                  {MED_POLYGON, "polygons (MED_POLYGON)", MED_INDEX_NODE, 1},
                                  {MED_POLYGON2, "quadratic polygons (MED_POLYGON2)", MED_INDEX_NODE, 1},
                                  {MED_POLYHEDRON, "polyhedra (MED_POLYHEDRON)", MED_INDEX_FACE, 1}};
        for (const Kind& k : kinds)
            if (const Index n = count(MED_CELL, k.geometry, k.counted); n > 0) unsupported(n - k.extra, k.name);
        if (const Index n = count(MED_STRUCT_ELEMENT, MED_GEO_ALL, MED_CONNECTIVITY); n > 0)
            unsupported(n, "types of structure elements (MED_STRUCT_ELEMENT)");
        for (const CellTraits& t : all_cell_types())
            if (count(MED_CELL, med_type(t.type).geometry, MED_CONNECTIVITY, MED_NODAL) <= 0)
                if (const Index n = count(MED_CELL, med_type(t.type).geometry, MED_CONNECTIVITY, MED_DESCENDING); n > 0)
                    unsupported(n, std::string(med_type(t.type).name) + " elements with descending connectivity");
    }

    void read_elements() {
        refuse_unsupported();
        for (const CellTraits& t : all_cell_types()) {
            const MedType& type = med_type(t.type);
            const std::string who = std::string(type.name) + " elements";
            const Index n = count(MED_CELL, type.geometry, MED_CONNECTIVITY);
            if (n < 0) damaged("the number of " + who);
            if (n == 0) continue;
            CellBlock& block = mesh_.block(t.type);
            read_connectivity(t, n, block.connectivity);
            block.ids = optional_numbers(MED_CELL, type.geometry, n, who);
            if (block.ids.empty()) {
                all_numbered_ = false;
                block.ids.resize(static_cast<std::size_t>(n));
            }
            block.families = family_positions(MED_CELL, type.geometry, n, who);
        }
    }

    void read_connectivity(const CellTraits& t, Index n, std::vector<Index>& out) const {
        const MedType& type = med_type(t.type);
        const std::string what = std::string("the connectivity of ") + type.name;
        const MedInts raw = ints(n * t.nodes, what);
        check_cancelled();
        if (MEDmeshElementConnectivityRd(fid_, name_, step_, iteration_, MED_CELL, type.geometry, MED_NODAL,
                                         MED_NO_INTERLACE, raw.get()) < 0)
            damaged(what);
        out.resize(static_cast<std::size_t>(n * t.nodes));
        const med_int* columns[27];
        for (int k = 0; k < t.nodes; ++k) columns[k] = raw.get() + n * type.order[static_cast<std::size_t>(k)];
        Index* target = out.data();
        SparseCheck check(1 << 16);
        for (Index c = 0; c < n; ++c, check())
            for (int k = 0; k < t.nodes; ++k) *target++ = Index{columns[k][c]} - 1;
        const Index nodes = mesh_.node_count();
        const auto bad = std::ranges::find_if(out, [nodes](Index i) { return i < 0 || i >= nodes; });
        if (bad != out.end())
            fail("contradictory or damaged: " + std::string(type.name) + " element " +
                 std::to_string((bad - out.begin()) / t.nodes + 1) + " of that type refers to node " +
                 std::to_string(*bad + 1) + " of " + std::to_string(nodes));
    }

    /// Groups and family table from the file's families, then positions to family indices.
    void make_families() {
        std::array<std::unordered_map<std::string, GroupIndex>, 2> known;
        const auto family_of = [&](const std::vector<std::string>& names, GroupKind kind) {
            std::vector<GroupIndex> set;
            for (const std::string& name : names) {
                auto& of_kind = known[static_cast<std::size_t>(kind)];
                const auto [it, added] = of_kind.try_emplace(name, static_cast<GroupIndex>(mesh_.groups.size()));
                if (added) mesh_.groups.push_back({name, kind, false});
                set.push_back(it->second);
            }
            std::ranges::sort(set);
            set.erase(std::unique(set.begin(), set.end()), set.end());
            return set.empty() ? 0 : mesh_.families.intern(set);
        };
        for (FileFamily& f : families_) {
            check_cancelled();
            const bool used = f.nodes || f.elements;
            if (f.elements || (!used && f.number < 0)) f.as_elements = family_of(f.names, GroupKind::element);
            if (f.nodes || (!used && f.number > 0)) f.as_nodes = family_of(f.names, GroupKind::node);
        }
        for (FamilyIndex& f : mesh_.node_families) f = families_[static_cast<std::size_t>(f)].as_nodes;
        for (CellBlock& block : mesh_.blocks())
            for (FamilyIndex& f : block.families) f = families_[static_cast<std::size_t>(f)].as_elements;
        compact_families(mesh_);
    }

    /// Numbers of all elements differ.
    bool numbers_differ() const {
        const Index count = mesh_.cell_count(), largest = mesh_.largest_cell_id();
        if (largest <= 64 * count + 65536) {
            std::vector<bool> seen(static_cast<std::size_t>(largest) + 1);
            for (const CellBlock& block : mesh_.blocks())
                for (Index id : block.ids) {
                    if (id < 0) return true;  // left to validate(), which names it
                    if (seen[static_cast<std::size_t>(id)]) return false;
                    seen[static_cast<std::size_t>(id)] = true;
                }
            return true;
        }
        std::vector<Index> ids;
        for (const CellBlock& block : mesh_.blocks()) ids.insert(ids.end(), block.ids.begin(), block.ids.end());
        std::ranges::sort(ids);
        return std::ranges::adjacent_find(ids) == ids.end();
    }

    void number_elements() {
        if (all_numbered_ && numbers_differ()) return;
        Index next = 1;
        for (CellBlock& block : mesh_.blocks())
            for (Index& id : block.ids) id = next++;
    }

    std::string path_;
    std::uintmax_t file_size_ = 0;
    med_idt fid_ = -1;
    char name_[MED_NAME_SIZE + 1] = "";
    med_int step_ = MED_NO_DT;
    med_int iteration_ = MED_NO_IT;
    int dimension_ = 3;
    bool all_numbered_ = true;
    std::vector<FileFamily> families_;
    FamilyNumbers numbers_;
    Mesh mesh_;
};

// ---------------------------------------------------------------------------------------------------

/// Node in the middle of a face of VTK's HEXA27 or PENTA18, by CalculiX's face number minus one.
constexpr std::int8_t hexahedron27_face_node[] = {24, 25, 22, 21, 23, 20};
constexpr std::int8_t wedge18_face_node[] = {-1, -1, 15, 16, 17};

/// The element that covers a facet.
struct FacetElement {
    CellType type = CellType::triangle;
    int size = 0;
    std::array<Index, 9> nodes{};
};

FacetElement facet_element(const Mesh& mesh, const Facet& facet) {
    const CellTraits& t = traits(facet.type);
    const std::span<const Index> nodes = mesh.block(facet.type).nodes(facet.cell);
    FacetElement out;
    const auto push = [&](int local) {
        out.nodes[static_cast<std::size_t>(out.size++)] = nodes[static_cast<std::size_t>(local)];
    };
    const auto push_middle = [&](int a, int b) {
        for (std::size_t e = 0; e < t.edges.size(); ++e)
            if ((t.edges[e][0] == a && t.edges[e][1] == b) || (t.edges[e][0] == b && t.edges[e][1] == a))
                return push(t.corners + static_cast<int>(e));
    };
    if (t.dimension == 2 && facet.face > 2) {
        const auto& edge = t.edges[static_cast<std::size_t>(facet.face) - 3];
        out.type = t.quadratic ? CellType::line3 : CellType::line;
        push(edge[0]);
        push(edge[1]);
        if (t.quadratic) push_middle(edge[0], edge[1]);
        return out;
    }

    // The corners, in the order that turns the normal outwards: CellTraits::faces turn it inwards.
    std::array<int, 4> corners{};
    int count = 0;
    int centre = -1;
    if (t.dimension == 3) {
        const auto& face = t.faces[static_cast<std::size_t>(facet.face) - 1];
        while (count < 4 && face[static_cast<std::size_t>(count)] >= 0) ++count;
        for (int k = 0; k < count; ++k)
            corners[static_cast<std::size_t>(k)] = face[static_cast<std::size_t>((count - k) % count)];
        if (facet.type == CellType::hexahedron27) centre = hexahedron27_face_node[facet.face - 1];
        if (facet.type == CellType::wedge18) centre = wedge18_face_node[facet.face - 1];
    } else {
        count = t.corners;
        const bool turn = facet.face == 1;
        for (int k = 0; k < count; ++k) corners[static_cast<std::size_t>(k)] = turn ? (count - k) % count : k;
        if (t.nodes == 2 * count + 1) centre = 2 * count;
    }
    for (int k = 0; k < count; ++k) push(corners[static_cast<std::size_t>(k)]);
    if (t.quadratic)
        for (int k = 0; k < count; ++k)
            push_middle(corners[static_cast<std::size_t>(k)], corners[static_cast<std::size_t>((k + 1) % count)]);
    if (centre >= 0) push(centre);
    for (CellType type : {CellType::triangle, CellType::triangle6, CellType::triangle7, CellType::quad, CellType::quad8,
                          CellType::quad9})
        if (traits(type).corners == count && traits(type).nodes == out.size) out.type = type;
    return out;
}

class Writer {
public:
    Writer(const Mesh& mesh, const std::filesystem::path& path) : mesh_(mesh), path_(path.string()) {}

    void write() {
        if (mesh_.points.empty()) fail("a MED mesh needs nodes");
        collect_facets();
        name_groups();
        collect_families();
        AtomicFile target(path_);
        MedFile file(MEDfileOpen(target.temporary().c_str(), MED_ACC_CREAT));
        fid_ = file.id();
        check(fid_, "the file");
        write_mesh();
        write_families();
        write_nodes();
        for (const CellTraits& t : all_cell_types()) write_elements(t);
        check_cancelled();
        if (!file.close()) fail("closing it failed; the disk may be full");
        target.commit();
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw WriteError(path_ + ": cannot be written: " + what); }

    template <class Result>
    void check(Result result, const char* what) const {
        if (result < 0) fail(std::string("the MED library could not write ") + what + "; the disk may be full");
    }

    med_int med_number(Index number) const {
        if constexpr (sizeof(med_int) < sizeof(Index))
            if (number > std::numeric_limits<med_int>::max())
                fail("number " + std::to_string(number) + " is larger than a MED file can hold (" +
                     std::to_string(std::numeric_limits<med_int>::max()) + ")");
        return static_cast<med_int>(number);
    }

    void collect_facets() {
        Index next = mesh_.largest_cell_id();
        SparseCheck check;
        for (const Facet& f : mesh_.facets) {
            check();
            const FacetElement e = facet_element(mesh_, f);
            CellBlock& block = facets_.block(e.type);
            block.connectivity.insert(block.connectivity.end(), e.nodes.begin(), e.nodes.begin() + e.size);
            block.ids.push_back(++next);
            block.families.push_back(f.family);
        }
    }

    void name_groups() {
        std::unordered_map<std::string, int> taken;
        for (const Group& g : mesh_.groups)
            if (!g.hidden && g.kind == GroupKind::element) taken.emplace(g.name, 0);
        for (const Group& g : mesh_.groups) {
            std::string name = g.name;
            if (g.hidden) {
                names_.emplace_back();
                continue;
            }
            if (g.kind == GroupKind::facet)
                while (!taken.emplace(name, 0).second) name += "_SURF";
            const std::string who = std::string(to_string(g.kind)) + " group '" + name + "'";
            if (name.empty() || name.back() == ' ' || name.find('\0') != std::string::npos)
                fail("the name of " + who + " is empty or ends in a blank; rename the group");
            if (name.size() > MED_LNAME_SIZE)
                fail("the name of " + who + " has " + std::to_string(name.size()) + " bytes, MED allows " +
                     std::to_string(MED_LNAME_SIZE) + "; rename the group");
            names_.push_back(std::move(name));
        }
    }

    /// The families of one kind of entity: sets of groups, numbered 1, 2, 3... with the kind's sign.
    struct Families {
        std::vector<std::vector<GroupIndex>> sets;
        std::vector<med_int> number;  // by FamilyIndex of the mesh
    };

    template <class Wanted>
    Families families_of(const std::vector<char>& used, med_int sign, Wanted wanted) const {
        std::map<std::vector<GroupIndex>, std::vector<FamilyIndex>> by_set;
        std::vector<char> has_members(mesh_.groups.size(), 0);
        for (FamilyIndex f = 0; f < mesh_.families.size(); ++f) {
            if (!used[static_cast<std::size_t>(f)]) continue;
            std::vector<GroupIndex> set;
            for (GroupIndex g : mesh_.families.groups(f))
                if (wanted(mesh_.groups[static_cast<std::size_t>(g)])) {
                    set.push_back(g);
                    has_members[static_cast<std::size_t>(g)] = 1;
                }
            if (!set.empty()) by_set[std::move(set)].push_back(f);
        }
        for (std::size_t g = 0; g < mesh_.groups.size(); ++g)
            if (wanted(mesh_.groups[g]) && !has_members[g]) by_set[{static_cast<GroupIndex>(g)}];

        // Small sets first: most groups then appear in the file in the order they have in the mesh.
        std::vector<decltype(by_set)::const_iterator> order;
        for (auto it = by_set.cbegin(); it != by_set.cend(); ++it) order.push_back(it);
        std::ranges::stable_sort(order, {}, [](const auto& it) { return it->first.size(); });
        Families out;
        out.number.assign(static_cast<std::size_t>(mesh_.families.size()), 0);
        for (const auto& it : order) {
            out.sets.push_back(it->first);
            for (FamilyIndex f : it->second)
                out.number[static_cast<std::size_t>(f)] = sign * static_cast<med_int>(out.sets.size());
        }
        return out;
    }

    void collect_families() {
        std::vector<char> used(static_cast<std::size_t>(mesh_.families.size()), 0);
        for (FamilyIndex f : mesh_.node_families) used[static_cast<std::size_t>(f)] = 1;
        nodes_ = families_of(used, 1, [](const Group& g) { return !g.hidden && g.kind == GroupKind::node; });
        std::ranges::fill(used, 0);
        for (const Mesh* source : {&mesh_, static_cast<const Mesh*>(&facets_)})
            for (const CellBlock& block : source->blocks())
                for (FamilyIndex f : block.families) used[static_cast<std::size_t>(f)] = 1;
        elements_ = families_of(used, -1, [](const Group& g) { return !g.hidden && g.kind != GroupKind::node; });
    }

    void write_mesh() {
        std::string name = mesh_.name.substr(0, MED_NAME_SIZE);
        // Do not cut through a UTF-8 character.
        if (name.size() < mesh_.name.size())
            while (!name.empty() && (static_cast<unsigned char>(mesh_.name[name.size()]) & 0xC0) == 0x80)
                name.pop_back();
        for (char& c : name)
            if (c == '/' || c == '\0') c = '_';
        while (!name.empty() && name.back() == ' ') name.pop_back();
        if (name.empty() || name == ".") name = "mesh";
        std::copy(name.begin(), name.end(), name_);

        std::string axes, units;
        for (const char* axis : {"X", "Y", "Z"}) {
            axes += axis;
            units += mesh_.unit.substr(0, MED_SNAME_SIZE);
            axes.resize((axes.size() + MED_SNAME_SIZE - 1) / MED_SNAME_SIZE * MED_SNAME_SIZE, ' ');
            units.resize(axes.size(), ' ');
        }
        const med_int dimension = std::max({mesh_.dimension(), facets_.dimension(), 0});
        check(MEDmeshCr(fid_, name_, 3, dimension, MED_UNSTRUCTURED_MESH, "Written by FemScalpel", "", MED_SORT_DTIT,
                        MED_CARTESIAN, axes.c_str(), units.c_str()),
              "the description of the mesh");
    }

    void write_families() const {
        check(MEDfamilyCr(fid_, name_, "FAMILLE_ZERO", 0, 0, MED_NO_GROUP), "the families");
        for (const auto& [families, sign] : {std::pair{&nodes_, 1}, std::pair{&elements_, -1}})
            for (std::size_t i = 0; i < families->sets.size(); ++i) {
                const auto& set = families->sets[i];
                std::string names;
                for (GroupIndex g : set) {
                    names += names_[static_cast<std::size_t>(g)];
                    names.resize((names.size() + MED_LNAME_SIZE - 1) / MED_LNAME_SIZE * MED_LNAME_SIZE, '\0');
                }
                check_cancelled();
                const med_int number = sign * static_cast<med_int>(i + 1);
                const std::string name = "FAM_" + std::to_string(number);
                check(MEDfamilyCr(fid_, name_, name.c_str(), number, static_cast<med_int>(set.size()), names.c_str()),
                      "the families");
            }
    }

    void write_nodes() const {
        const Index n = mesh_.node_count();
        med_number(n);
        const auto size = static_cast<std::size_t>(n);
        const auto coordinates = std::make_unique_for_overwrite<med_float[]>(3 * size);
        const auto numbers = std::make_unique_for_overwrite<med_int[]>(size);
        const auto families = std::make_unique_for_overwrite<med_int[]>(size);
        SparseCheck sparse_check(1 << 14);
        for (std::size_t i = 0; i < size; ++i, sparse_check()) {
            for (std::size_t a = 0; a < 3; ++a)
                coordinates[a * size + i] = mesh_.points[i][static_cast<Eigen::Index>(a)];
            numbers[i] = med_number(mesh_.node_ids[i]);
            families[i] = nodes_.number[static_cast<std::size_t>(mesh_.node_families[i])];
        }
        const auto count = static_cast<med_int>(n);
        check(MEDmeshNodeCoordinateWr(fid_, name_, MED_NO_DT, MED_NO_IT, MED_UNDEF_DT, MED_NO_INTERLACE, count,
                                      coordinates.get()),
              "the coordinates");
        check_cancelled();
        check(MEDmeshEntityNumberWr(fid_, name_, MED_NO_DT, MED_NO_IT, MED_NODE, MED_NONE, count, numbers.get()),
              "the node numbers");
        check(MEDmeshEntityFamilyNumberWr(fid_, name_, MED_NO_DT, MED_NO_IT, MED_NODE, MED_NONE, count, families.get()),
              "the families of the nodes");
    }

    void write_elements(const CellTraits& t) const {
        const Index n = mesh_.block(t.type).size() + facets_.block(t.type).size();
        if (n == 0) return;
        const MedType& type = med_type(t.type);
        const auto count = med_number(n);
        const auto size = static_cast<std::size_t>(n);
        const auto connectivity = std::make_unique_for_overwrite<med_int[]>(size * static_cast<std::size_t>(t.nodes));
        const auto numbers = std::make_unique_for_overwrite<med_int[]>(size);
        const auto families = std::make_unique_for_overwrite<med_int[]>(size);
        med_int* columns[27];
        for (int k = 0; k < t.nodes; ++k)
            columns[k] = connectivity.get() + size * static_cast<std::size_t>(type.order[static_cast<std::size_t>(k)]);
        std::size_t at = 0;
        for (const CellBlock* block : {&mesh_.block(t.type), &facets_.block(t.type)}) {
            const Index* source = block->connectivity.data();
            SparseCheck sparse_check(1 << 14);
            for (std::size_t c = 0; c < block->ids.size(); ++c, ++at) {
                sparse_check();
                for (int k = 0; k < t.nodes; ++k) columns[k][at] = static_cast<med_int>(*source++ + 1);
                numbers[at] = med_number(block->ids[c]);
                families[at] = elements_.number[static_cast<std::size_t>(block->families[c])];
            }
        }
        check(MEDmeshElementConnectivityWr(fid_, name_, MED_NO_DT, MED_NO_IT, MED_UNDEF_DT, MED_CELL, type.geometry,
                                           MED_NODAL, MED_NO_INTERLACE, count, connectivity.get()),
              "the connectivity");
        check_cancelled();
        check(MEDmeshEntityNumberWr(fid_, name_, MED_NO_DT, MED_NO_IT, MED_CELL, type.geometry, count, numbers.get()),
              "the element numbers");
        check_cancelled();
        check(MEDmeshEntityFamilyNumberWr(fid_, name_, MED_NO_DT, MED_NO_IT, MED_CELL, type.geometry, count,
                                          families.get()),
              "the families of the elements");
    }

    const Mesh& mesh_;
    std::string path_;
    med_idt fid_ = -1;
    char name_[MED_NAME_SIZE + 1] = "";
    Mesh facets_;                     // only its blocks are used: the elements that stand for facets
    std::vector<std::string> names_;  // of the groups, as written
    Families nodes_, elements_;
};

}  // namespace

Mesh read_med(const std::filesystem::path& path) {
    const auto lock = lock_libraries();
    const QuietHdf5 quiet;
    try {
        return Reader(path).read();
    } catch (const std::bad_alloc&) {
        throw ReadError(path.string() + ": truncated or damaged, or larger than the memory");
    }
}

void write_med(const Mesh& mesh, const std::filesystem::path& path) {
    const auto lock = lock_libraries();
    const QuietHdf5 quiet;
    Writer(mesh, path).write();
}

}  // namespace femscalpel
