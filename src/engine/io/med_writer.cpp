// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "cancel.h"
#include "error.h"
#include "io/atomic_file.h"
#include "io/med.h"
#include "io/med_fields.h"
#include "io/med_library.h"
#include "io/quiet_libraries.h"
#include "mesh/facet_element.h"
#include "utf8.h"

namespace femscalpel {
namespace {

/// What groups are called in the file: facet groups, whose elements are among all elements there, may not be called as
/// element groups are. Empty for hidden groups.
std::vector<std::string> med_names(const Mesh& mesh) {
    std::unordered_set<std::string> taken;
    for (const Group& g : mesh.groups)
        if (!g.hidden && g.kind == GroupKind::element) taken.insert(g.name);
    std::vector<std::string> out;
    for (const Group& g : mesh.groups) {
        out.push_back(g.hidden ? std::string() : g.name);
        if (!g.hidden && g.kind == GroupKind::facet)
            while (!taken.insert(out.back()).second) out.back() += "_SURF";
    }
    return out;
}

/// What will be the file, once that is closed.
struct MedImage {
    med_memfile memory = MED_MEMFILE_INIT;

    MedImage() = default;
    ~MedImage() { std::free(memory.app_image_ptr); }
    MedImage(const MedImage&) = delete;
    MedImage& operator=(const MedImage&) = delete;

    /// Without the room behind its end, so that no truncation goes unnoticed: up to the end-of-file address in HDF5's
    /// superblock (HDF5 file format specification, II.A).
    std::string_view bytes() const {
        const std::string_view all(static_cast<const char*>(memory.app_image_ptr), memory.app_image_size);
        const std::size_t at = all.size() < 64 ? 0 : all[8] == 0 ? 40 : all[8] == 1 ? 44 : 28;
        std::uint64_t end = 0;
        if (at > 0) std::memcpy(&end, all.data() + at, sizeof end);
        return end >= 64 && end <= all.size() ? all.substr(0, end) : all;
    }
};

class Writer {
public:
    Writer(const Mesh& mesh, const std::filesystem::path& path) : mesh_(mesh), path_(path) {}

    void write() {
        if (mesh_.points.empty()) fail("a MED mesh needs nodes");
        collect_facets();
        name_groups();
        collect_families();
        AtomicFile target(path_);
        // In memory: where the disk is full, the libraries print what they were doing and crash at the program's end.
        MedImage image;
        MedFile file(MEDmemFileOpen(target.temporary().c_str(), &image.memory, MED_FALSE, MED_ACC_CREAT));
        fid_ = file.id();
        check(fid_, "the file");
        write_mesh();
        write_families();
        write_nodes();
        for (const CellTraits& t : all_cell_types()) write_elements(t);
        write_med_fields(
            mesh_,
            {fid_, name_, [this](CellType type) { return mesh_.block(type).size() + facets_.block(type).size(); },
             [this](const std::string& what) { check(-1, what.c_str()); }});
        check_cancelled();
        if (!file.close()) fail("closing it failed");
        std::ofstream out(target.temporary(), std::ios::binary | std::ios::trunc);
        write_obeying(out, image.bytes());
        out.close();
        if (!out) fail("the disk may be full");
        target.commit();
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw WriteError(shown_path(path_) + ": cannot be written: " + what);
    }

    template <class Result>
    void check(Result result, const char* what) const {
        if (result < 0) fail(std::string("the MED library could not write ") + what);
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
        names_ = med_names(mesh_);
        for (std::size_t g = 0; g < names_.size(); ++g) {
            if (mesh_.groups[g].hidden) continue;
            const std::string& name = names_[g];
            const std::string who = std::string(to_string(mesh_.groups[g].kind)) + " group '" + name + "'";
            if (name.empty() || name.back() == ' ' || name.find('\0') != std::string::npos)
                fail("the name of " + who + " is empty or ends in a blank; rename the group");
            if (name.size() > MED_LNAME_SIZE)
                fail("the name of " + who + " has " + std::to_string(name.size()) + " bytes, MED allows " +
                     std::to_string(MED_LNAME_SIZE) + "; rename the group");
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

        if (mesh_.unit.size() > MED_SNAME_SIZE)
            fail("the unit '" + mesh_.unit + "' has " + std::to_string(mesh_.unit.size()) + " bytes, MED allows " +
                 std::to_string(MED_SNAME_SIZE) + "; give it a shorter name");
        std::string axes, units;
        for (const char* axis : {"X", "Y", "Z"}) {
            axes += axis;
            units += mesh_.unit;
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
    std::filesystem::path path_;
    med_idt fid_ = -1;
    char name_[MED_NAME_SIZE + 1] = "";
    Mesh facets_;                     // only its blocks are used: the elements that stand for facets
    std::vector<std::string> names_;  // of the groups, as written
    Families nodes_, elements_;
};

}  // namespace

void write_med(const Mesh& mesh, const std::filesystem::path& path) {
    const auto lock = lock_libraries();
    const QuietLibraries quiet;
    Writer(mesh, path).write();
}

std::vector<std::string> med_losses(const Mesh& mesh) {
    std::vector<std::string> out;
    const std::vector<std::string> names = med_names(mesh);
    for (std::size_t g = 0; g < names.size(); ++g)
        if (const Group& group = mesh.groups[g]; !group.hidden && names[g] != group.name)
            out.push_back("the name of the facet group '" + group.name + "', called '" + names[g] +
                          "' there beside an element group of its name");
    return out;
}

}  // namespace femscalpel
