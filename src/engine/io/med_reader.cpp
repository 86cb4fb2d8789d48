// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <new>
#include <string>
#include <unordered_map>
#include <vector>

#include "cancel.h"
#include "error.h"
#include "io/med.h"
#include "io/med_fields.h"
#include "io/med_library.h"
#include "io/med_soundness.h"
#include "io/med_structure.h"
#include "io/quiet_libraries.h"
#include "utf8.h"

namespace femscalpel {
namespace {

using MedInts = std::unique_ptr<med_int[]>;

/// Text of a fixed-width field: up to the first NUL, without trailing blanks.
std::string trimmed(const char* field, std::size_t width) {
    std::size_t n = 0;
    while (n < width && field[n] != '\0') ++n;
    while (n > 0 && field[n - 1] == ' ') --n;
    return {field, n};
}

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
    explicit Reader(const std::filesystem::path& path, std::string wanted = {})
        : path_(path.string()), sound_(path_), wanted_(std::move(wanted)) {}

    Mesh read() {
        const std::unique_ptr<MedFile> file = open();
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
        mesh_.fields = read_med_fields({fid_, path_, name_, is_old_, largest_array(), sound_}, mesh_);
        return std::move(mesh_);
    }

    std::vector<std::string> meshes() {
        const std::unique_ptr<MedFile> file = open();
        std::vector<std::string> out;
        const med_int count = MEDnMesh(fid_);
        if (count < 0) damaged("the list of meshes");
        for (int i = 1; i <= count; ++i)
            if (as_number(describe_mesh(i).type) == MED_UNSTRUCTURED_MESH) out.push_back(as_utf8(name_));
        return out;
    }

private:
    /// Of a file that can be read.
    std::unique_ptr<MedFile> open() {
        std::error_code error;
        const auto status = std::filesystem::status(path_, error);
        if (!std::filesystem::exists(status)) fail("there is no such file");
        if (!std::filesystem::is_regular_file(status)) fail("not a file");
        file_size_ = std::filesystem::file_size(path_, error);
        if (error) fail("cannot be read: " + error.message());
        if (!std::ifstream(path_)) fail(std::string("cannot be read: ") + std::strerror(errno));

        if (H5Fis_hdf5(path_.c_str()) <= 0) fail("not a MED file (nor any HDF5 file)");
        if (!sound_.of_mesh()) fail("truncated or damaged: its structure cannot be read");
        med_bool hdf_good = MED_FALSE, med_good = MED_FALSE;
        if (MEDfileCompatibility(path_.c_str(), &hdf_good, &med_good) < 0) damaged("its MED version");
        if (!med_good) fail("not a MED file, or one of a MED version this library (" MED_VERSION_STR ") cannot read");

        check_cancelled();
        auto file = std::make_unique<MedFile>(MEDfileOpen(path_.c_str(), MED_ACC_RDONLY));
        fid_ = file->id();
        if (fid_ < 0) damaged("the file");
        med_int major = 0, minor = 0, release = 0;
        if (MEDfileNumVersionRd(fid_, &major, &minor, &release) < 0) damaged("its MED version");
        is_old_ = major < 3;
        return file;
    }

    [[noreturn]] void fail(const std::string& what) const { throw ReadError(shown_path(path_) + ": " + what); }
    [[noreturn]] void damaged(const std::string& what) const { fail("truncated or damaged: cannot read " + what); }

    /// What a file says of a mesh, but for its name, which is in name_.
    struct Header {
        med_int axes = 0, space_dimension = 0, steps = 0;
        med_mesh_type type = MED_UNDEF_MESH_TYPE;
        med_axis_type axis_type = MED_UNDEF_AXIS_TYPE;
        std::string unit;  ///< of the first axis
    };
    Header describe_mesh(int i) {
        Header out;
        out.axes = MEDmeshnAxis(fid_, i);
        if (out.axes < 0) damaged("the number of axes of mesh " + std::to_string(i));
        if (out.axes < 1 || out.axes > 3)
            fail("mesh " + std::to_string(i) + " has " + std::to_string(out.axes) + " axes");
        char description[MED_COMMENT_SIZE + 1] = "", dt_unit[MED_SNAME_SIZE + 1] = "";
        char axis_names[3 * MED_SNAME_SIZE + 1] = "", axis_units[3 * MED_SNAME_SIZE + 1] = "";
        med_int mesh_dimension = 0;
        med_sorting_type sorting = MED_SORT_UNDEF;
        if (MEDmeshInfo(fid_, i, name_, &out.space_dimension, &mesh_dimension, &out.type, description, dt_unit,
                        &sorting, &out.steps, &out.axis_type, axis_names, axis_units) < 0)
            damaged("the description of mesh " + std::to_string(i));
        out.unit = as_utf8(trimmed(axis_units, MED_SNAME_SIZE));
        return out;
    }

    void find_mesh() {
        const med_int meshes = MEDnMesh(fid_);
        if (meshes < 0) damaged("the list of meshes");
        if (meshes == 0) fail("contains no mesh");
        std::string names;
        for (int i = 1; i <= meshes; ++i) {
            const Header header = describe_mesh(i);
            if (as_number(header.type) != MED_UNSTRUCTURED_MESH) continue;
            names += (names.empty() ? "'" : ", '") + as_utf8(name_) + "'";
            if (!wanted_.empty() && wanted_ != as_utf8(name_)) continue;
            if (as_number(header.axis_type) != MED_CARTESIAN)
                fail("mesh '" + as_utf8(name_) +
                     "' has cylindrical or spherical coordinates; convert it to Cartesian ones");
            if (header.space_dimension != header.axes) damaged("the dimension of mesh '" + as_utf8(name_) + "'");
            med_float time = 0;
            if (header.steps < 1 || MEDmeshComputationStepInfo(fid_, name_, 1, &step_, &iteration_, &time) < 0)
                fail("mesh '" + as_utf8(name_) + "' is declared but has no nodes, or the file is damaged");
            dimension_ = static_cast<int>(header.axes);
            mesh_.name = as_utf8(name_);
            if (header.steps > 1)
                mesh_.remarks.push_back(shown_path(path_) + ": mesh '" + mesh_.name + "' has " +
                                        std::to_string(header.steps) +
                                        " time steps of its own, of which the first is read");
            mesh_.unit = header.unit;
            return;
        }
        if (names.empty()) fail("contains structured grids only; convert the grid to an unstructured mesh");
        fail("has no mesh '" + wanted_ + "'; it has " + names);
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
            const bool read = is_old_ ? read_old_family(i, family_name, family.number, names.data())
                                      : MEDfamilyInfo(fid_, name_, i, family_name, &family.number, names.data()) >= 0;
            if (!read) damaged("family " + std::to_string(i));
            if (family.number == 0) continue;
            for (med_int g = 0; g < groups; ++g) {
                std::string group =
                    trimmed(names.data() + static_cast<std::size_t>(g) * MED_LNAME_SIZE, MED_LNAME_SIZE);
                if (!group.empty()) family.names.push_back(std::move(group));
            }
            families_.push_back(std::move(family));
        }
        make_names_utf8();
        numbers_.build(families_);
        for (std::size_t i = 0; i < families_.size(); ++i)
            if (numbers_.find(families_[i].number) != static_cast<std::int32_t>(i))
                fail("contradictory or damaged: family number " + std::to_string(families_[i].number) +
                     " is declared twice");
    }

    /// Where one name is not, none is: different names stay different.
    void make_names_utf8() {
        const auto is_odd = [](const std::string& name) { return not_utf8(name) != name.npos; };
        const auto has_odd = [&](const FileFamily& f) { return std::ranges::any_of(f.names, is_odd); };
        if (std::ranges::none_of(families_, has_odd)) return;
        for (FileFamily& family : families_)
            for (std::string& name : family.names) name = from_windows_1252(name);
        mesh_.remarks.push_back(shown_path(path_) +
                                ": names of groups are not UTF-8; they are read as Windows-1252 (Latin-1). Look at "
                                "those with letters beyond A to Z");
    }

    /// A family as files before version 3 have it, with attributes that nothing uses any more.
    bool read_old_family(int i, char* family_name, med_int& number, char* groups) const {
        const med_int attributes = MEDnFamily23Attribute(fid_, name_, i);
        if (attributes < 0 || static_cast<std::uint64_t>(attributes) * MED_COMMENT_SIZE > largest_array()) return false;
        const auto count = static_cast<std::size_t>(attributes);
        std::vector<med_int> numbers(count + 1), values(count + 1);
        std::vector<char> texts(count * MED_COMMENT_SIZE + 1, '\0');
        return MEDfamily23Info(fid_, name_, i, family_name, numbers.data(), values.data(), texts.data(), &number,
                               groups) >= 0;
    }

    std::uint64_t largest_array() const { return largest_med_array(file_size_); }
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
        const std::string set = "/ENS_MAA/" + std::string(name_) + "/NOE/COO";  // of which old ones read all there is
        if (values * sizeof(med_float) > largest_array() || (is_old_ && size_of_dataset(fid_, set) != values))
            damaged("the coordinates");
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
        throw UnsupportedElementError(shown_path(path_) + ": mesh '" + mesh_.name + "' has " + std::to_string(n) + " " +
                                      what + ", which FemScalpel cannot hold; remove or convert them");
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
            if (const Index n = count(MED_CELL, k.geometry, k.counted); n > k.extra) unsupported(n - k.extra, k.name);
        if (const Index n = is_old_ ? 0 : count(MED_STRUCT_ELEMENT, MED_GEO_ALL, MED_CONNECTIVITY); n > 0)
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
    MedSoundness sound_;
    std::uintmax_t file_size_ = 0;
    std::string wanted_;  // the mesh's name; the first if empty
    med_idt fid_ = -1;
    bool is_old_ = false;  // before version 3
    char name_[MED_NAME_SIZE + 1] = "";
    med_int step_ = MED_NO_DT;
    med_int iteration_ = MED_NO_IT;
    int dimension_ = 3;
    bool all_numbered_ = true;
    std::vector<FileFamily> families_;
    FamilyNumbers numbers_;
    Mesh mesh_;
};

auto from_file(const std::filesystem::path& path, auto read) {
    const auto lock = lock_libraries();
    const QuietLibraries quiet;
    try {
        return read();
    } catch (const std::bad_alloc&) {
        throw ReadError(shown_path(path) + ": truncated or damaged, or larger than the memory");
    }
}

}  // namespace

Mesh read_med(const std::filesystem::path& path, const std::string& mesh) {
    return from_file(path, [&] { return Reader(path, mesh).read(); });
}

std::vector<std::string> med_meshes(const std::filesystem::path& path) {
    return from_file(path, [&] { return Reader(path).meshes(); });
}

}  // namespace femscalpel
