// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "cancel.h"
#include "error.h"
#include "io/vtu.h"
#include "io/vtu_file.h"
#include "io/vtu_types.h"
#include "utf8.h"

namespace femscalpel {
namespace {

class VtuReader {
public:
    explicit VtuReader(const std::filesystem::path& path) : file_(path) {
        mesh_.name = shown_path(path.stem());
        mesh_.remarks = file_.remarks();
    }

    Mesh read() {
        read_points();
        read_cells();
        read_groups();
        tell_rest();
        return std::move(mesh_);
    }

private:
    const VtuArray& need(std::string_view section, std::string_view name) {
        const VtuArray* found = file_.find(section, name);
        if (!found)
            throw ReadError(file_.shown() + ": the file has no array '" + std::string(name) + "' of " +
                            std::string(section));
        known_.insert(found);
        return *found;
    }

    void read_points() {
        if (file_.points() == 0) throw ReadError(file_.shown() + ": there are no nodes in this file");
        const VtuArray& array = need("Points", "");
        const std::vector<double> values = file_.reals(array, 3 * file_.points());
        SparseCheck check(1 << 16);
        mesh_.points.reserve(values.size() / 3);
        for (std::size_t k = 0; k < values.size(); k += 3, check())
            mesh_.points.emplace_back(values[k], values[k + 1], values[k + 2]);
        mesh_.node_ids = numbers("PointData", "NodeNumber", file_.points());
        mesh_.node_families.assign(mesh_.points.size(), 0);
    }

    /// The numbers that an array gives, or from 1.
    std::vector<Index> numbers(std::string_view section, std::string_view name, Index count) {
        std::vector<Index> out;
        const VtuArray* array = file_.find(section, name);
        if (array && VtuFile::is_integer(*array)) {
            out = file_.integers(*array, count);
            std::vector<Index> sorted(out);
            check_cancelled();
            std::ranges::sort(sorted);
            if (!sorted.empty() && (sorted[0] <= 0 || std::ranges::adjacent_find(sorted) != sorted.end()))
                out.clear();  // somebody else's array, which tell_rest() names
            else
                known_.insert(array);
        }
        if (out.empty())
            for (Index k = 1; k <= count; ++k) out.push_back(k);
        return out;
    }

    void read_cells() {
        const Index count = file_.cells();
        const VtuArray &types = need("Cells", "types"), &ends = need("Cells", "offsets"),
                       &nodes = need("Cells", "connectivity");
        const std::vector<Index> type = file_.integers(types, count), end = file_.integers(ends, count),
                                 all = file_.all_integers(nodes, 27 * count),
                                 ids = numbers("CellData", "ElementNumber", count);
        SparseCheck check(1 << 14);
        Index from = 0;
        cells_.reserve(type.size());
        std::array<Index, 27> in;
        for (std::size_t c = 0; c < type.size(); ++c, check()) {
            const CellType ours = cell_type(type[c], c);
            const auto size = static_cast<std::size_t>(traits(ours).nodes);
            if (end[c] < from || end[c] - from != traits(ours).nodes || end[c] > std::ssize(all))
                file_.fail(ends, "gives cell " + std::to_string(c) + ", a " + std::string(traits(ours).name) + ", " +
                                     std::to_string(end[c] - from) + " nodes");
            std::copy_n(all.begin() + from, size, in.begin());
            for (std::size_t k = 0; k < size; ++k)
                if (in[k] < 0 || in[k] >= file_.points())
                    file_.fail(nodes, "gives cell " + std::to_string(c) + " the point " + std::to_string(in[k]) +
                                          " of " + std::to_string(file_.points()));
            if (ours == CellType::wedge) turn_vtk_wedge(in.begin());
            cells_.push_back({ours, mesh_.add_cell(ours, std::span(in).first(size), ids[c])});
            from = end[c];
        }
    }

    CellType cell_type(Index number, std::size_t cell) const {
        const auto found = std::ranges::find(vtk_types, number);
        if (found == vtk_types.end())
            throw UnsupportedElementError(file_.shown() + ": cell " + std::to_string(cell) + " is of VTK's type " +
                                          std::to_string(number) + ", which FemScalpel cannot hold");
        return static_cast<CellType>(found - vtk_types.begin());
    }

    void read_groups() {
        for (const VtuArray& array : file_.arrays()) {
            check_cancelled();
            const std::string &kind = array[vtu_group_kind], &name = array[vtu_group_name];
            if (kind.empty() || !VtuFile::is_integer(array)) continue;
            const bool of_nodes = kind == to_string(GroupKind::node) && array.section == "PointData";
            const bool of_cells = kind == to_string(GroupKind::element) && array.section == "CellData";
            const bool of_faces = kind == to_string(GroupKind::facet) && array.section == "CellData";
            if (!of_nodes && !of_cells && !of_faces) continue;
            const GroupKind is = of_nodes ? GroupKind::node : of_cells ? GroupKind::element : GroupKind::facet;
            if (mesh_.find_group(name, is)) file_.fail(array, "is the second group of that name");
            mesh_.add_group(name, is);
            known_.insert(&array);
            GroupMembers members{is, {}, {}};
            const std::vector<Index> marks = file_.integers(array, of_nodes ? file_.points() : file_.cells());
            for (std::size_t k = 0; k < marks.size(); ++k)
                if (of_faces)
                    add_faces(array, cells_[k], marks[k], members);
                else if (marks[k] != 0)
                    members.ids.push_back(of_nodes ? mesh_.node_ids[k] : number(cells_[k]));
            members_.push_back(std::move(members));
        }
        assign_groups(mesh_, members_);
    }

    Index number(const CellRef& cell) const { return mesh_.block(cell.type).ids[static_cast<std::size_t>(cell.cell)]; }

    /// Bit k is face k + 1.
    void add_faces(const VtuArray& array, const CellRef& cell, Index mask, GroupMembers& members) const {
        const CellTraits& t = traits(cell.type);
        const int faces = t.dimension == 3 ? static_cast<int>(t.faces.size()) : t.dimension == 2 ? 2 + t.corners : 0;
        if (mask < 0 || mask >> faces != 0)
            file_.fail(array, "names faces of element " + std::to_string(number(cell)) + " that it has not");
        for (int f = 0; f < faces; ++f)
            if (mask >> f & 1) {
                members.ids.push_back(number(cell));
                members.faces.push_back(f + 1);
            }
    }

    void tell_rest() {
        std::string names;
        bool own = false;
        for (const VtuArray* array : known_) own = own || array->name() == "NodeNumber";
        for (const VtuArray& array : file_.arrays())
            if (!known_.contains(&array) && !(own && array.name() == "Family"))
                names += (names.empty() ? "'" : ", '") + array.name() + "'";
        if (!names.empty()) mesh_.remarks.push_back(file_.shown() + ": the data arrays " + names + " are not read");
    }

    VtuFile file_;
    Mesh mesh_;
    std::vector<CellRef> cells_;  // in the file's order
    std::vector<GroupMembers> members_;
    std::unordered_set<const VtuArray*> known_;
};

}  // namespace

Mesh read_vtu(const std::filesystem::path& path) { return VtuReader(path).read(); }

}  // namespace femscalpel
