// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <charconv>
#include <string>
#include <vector>

#include "cancel.h"
#include "error.h"
#include "io/group_numbers.h"
#include "io/inp_file.h"
#include "io/unv.h"
#include "io/unv_types.h"
#include "utf8.h"

namespace femscalpel {
namespace {

constexpr Index largest_unv_number = 2147483647;
constexpr std::size_t standard_unv_name = 40;  // by the format's description; SALOME reads and writes longer ones

class UnvWriter {
public:
    UnvWriter(const Mesh& mesh, std::string shown) : mesh_(mesh), shown_(std::move(shown)) {}

    std::string text() {
        check();
        put_nodes();
        put_elements();
        put_groups();
        return std::move(out_);
    }

private:
    void check() const {
        if (mesh_.points.empty()) throw WriteError(shown_ + ": the mesh has no nodes");
        for (const CellBlock& block : mesh_.blocks())
            if (block.size() > 0 && unv_type(block.type).descriptor == 0)
                throw WriteError(shown_ + ": the mesh has " + std::to_string(block.size()) + " elements of type " +
                                 std::string(traits(block.type).name) +
                                 ", which universal files do not have; write another format, as .med");
        const Index largest = std::max(mesh_.largest_node_id(), mesh_.largest_cell_id());
        if (largest > largest_unv_number)
            throw WriteError(shown_ + ": universal files have numbers up to " + std::to_string(largest_unv_number) +
                             ", the mesh has " + std::to_string(largest));
        for (const Group& group : mesh_.groups) {
            if (group.hidden || group.kind == GroupKind::facet) continue;
            const std::string& n = group.name;
            if (n.empty() || n.front() == ' ' || n.back() == ' ' || n == "-1" ||
                std::ranges::any_of(n, [](char c) { return c >= 0 && c < ' '; }))
                throw WriteError(shown_ +
                                 ": names of groups in universal files are not empty, do not begin or end in a blank, "
                                 "are not -1 and have no control characters; rename the group '" +
                                 n + "'");
        }
    }

    void put(Index value) {
        char text[24];
        const char* end = std::to_chars(text, text + sizeof text, value).ptr;
        out_.append(10 - static_cast<std::size_t>(end - text), ' ');
        out_.append(text, static_cast<std::size_t>(end - text));
    }

    void put(double value) {
        char text[40];
        char* end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, 16).ptr;
        std::replace(text, end, 'e', 'E');
        out_.append(25 - static_cast<std::size_t>(end - text), ' ');
        out_.append(text, static_cast<std::size_t>(end - text));
    }

    void put_nodes() {
        out_ += "    -1\n  2411\n";
        SparseCheck check(1 << 12);
        for (std::size_t n = 0; n < mesh_.points.size(); ++n, check()) {
            put(mesh_.node_ids[n]);
            out_ += "         1         1        11\n";  // the global system, a colour
            for (int a = 0; a < 3; ++a) put(mesh_.points[n][a]);
            out_ += '\n';
        }
        out_ += "    -1\n";
    }

    void put_elements() {
        out_ += "    -1\n  2412\n";
        SparseCheck check(1 << 12);
        for (const CellBlock& block : mesh_.blocks()) {
            const UnvType& type = unv_type(block.type);
            const auto count = static_cast<std::size_t>(traits(block.type).nodes);
            for (Index c = 0; c < block.size(); ++c, check()) {
                put(block.ids[static_cast<std::size_t>(c)]);
                put(Index{type.descriptor});
                out_ += "         2         1         7";  // tables of properties and materials, a colour
                put(static_cast<Index>(count));
                out_ += '\n';
                if (is_unv_beam(type.descriptor)) out_ += "         0         0         0\n";
                const auto nodes = block.nodes(c);
                for (std::size_t k = 0; k < count; ++k) {
                    const Index node = nodes[static_cast<std::size_t>(type.order[k])];
                    put(mesh_.node_ids[static_cast<std::size_t>(node)]);
                    if (k % 8 == 7 || k + 1 == count) out_ += '\n';
                }
            }
        }
        out_ += "    -1\n";
    }

    void put_groups() {
        const auto all = group_numbers(mesh_);
        std::string before;
        std::swap(before, out_);
        Index number = 0;
        SparseCheck check(1 << 12);
        for (std::size_t g = 0; g < all.size(); ++g) {
            const Group& group = mesh_.groups[g];
            if (group.hidden || group.kind == GroupKind::facet) continue;
            put(++number);
            for (int k = 0; k < 6; ++k) put(Index{0});
            put(std::ssize(all[g]));
            out_ += '\n' + group.name;
            for (std::size_t k = 0; k < all[g].size(); ++k, check()) {
                if (k % 2 == 0) out_ += '\n';
                put(Index{group.kind == GroupKind::node ? 7 : 8});
                put(all[g][k]);
                out_ += "         0         0";
            }
            out_ += '\n';
        }
        std::swap(before, out_);
        if (number > 0) out_ += "    -1\n  2467\n" + before + "    -1\n";
    }

    const Mesh& mesh_;
    std::string shown_;
    std::string out_;
};

}  // namespace

void write_unv(const Mesh& mesh, const std::filesystem::path& path) {
    save_text(path, UnvWriter(mesh, shown_path(path)).text());
}

std::vector<std::string> unv_losses(const Mesh& mesh) {
    std::vector<std::string> out;
    std::vector<bool> filled(mesh.groups.size(), false);
    for (const FamilyIndex family : mesh.node_families)
        for (const GroupIndex g : mesh.families.groups(family)) filled[static_cast<std::size_t>(g)] = true;
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
        const Group& group = mesh.groups[g];
        if (group.hidden) continue;
        if (group.kind == GroupKind::facet)
            out.push_back("the facet group '" + group.name + "'");
        else if (group.name.size() > standard_unv_name)
            out.push_back("the name '" + group.name + "' for programs that read 40 bytes of it");
        if (group.kind == GroupKind::node && !filled[g])
            out.push_back("that the empty group '" + group.name + "' is one of nodes");
    }
    if (!mesh.unit.empty()) out.push_back("the unit '" + mesh.unit + "'");
    return out;
}

}  // namespace femscalpel
