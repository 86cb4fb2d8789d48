// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "cancel.h"
#include "error.h"
#include "io/inp_file.h"
#include "io/inp_numbers.h"
#include "io/msh.h"
#include "io/msh_types.h"
#include "utf8.h"

namespace femscalpel {
namespace {

constexpr std::size_t longest_msh_name = 127;  // by Gmsh's description of the format

template <class T>
void append_value(std::string& out, T value, char after = ' ') {
    char text[32];
    out.append(text, std::to_chars(text, text + sizeof text, value).ptr);
    out += after;
}

/// A discrete entity of Gmsh: what is of one dimension and in the same groups.
struct MshEntity {
    int tag = 0;
    std::vector<GroupIndex> groups;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::max());
    Vec3 high = Vec3::Constant(std::numeric_limits<double>::lowest());

    void include(const Vec3& p) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
};

/// Consecutive elements of one type and entity.
struct MshRun {
    CellType type;
    int entity;
    Index first, end;
};

class MshWriter {
public:
    MshWriter(const Mesh& mesh, std::string shown) : mesh_(mesh), shown_(std::move(shown)) {}

    std::string text() {
        check();
        find_entities();
        out_ = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
        put_names();
        put_comment();
        put_entities();
        put_nodes();
        put_elements();
        return std::move(out_);
    }

private:
    void check() const {
        if (mesh_.points.empty())
            throw WriteError(shown_ + ": the mesh has no nodes, without which Gmsh reads no mesh");
        for (const CellBlock& block : mesh_.blocks())
            if (block.size() > 0 && msh_type(block.type).number == 0)
                throw WriteError(shown_ + ": the mesh has " + std::to_string(block.size()) + " elements of type " +
                                 std::string(traits(block.type).name) +
                                 ", which Gmsh does not have; write another format, as .med");
        for (const Group& group : mesh_.groups) {
            if (group.hidden || group.kind == GroupKind::facet) continue;
            const auto bad = [](char c) { return c == '"' || (c >= 0 && c < ' '); };
            if (group.name.empty() || group.name.size() > longest_msh_name || std::ranges::any_of(group.name, bad))
                throw WriteError(shown_ + ": Gmsh's names have 1 to " + std::to_string(longest_msh_name) +
                                 " bytes, no double quotes and no control characters; rename the group '" + group.name +
                                 "'");
        }
    }

    std::vector<GroupIndex> shown_groups(FamilyIndex family) const {
        std::vector<GroupIndex> out;
        for (const GroupIndex g : mesh_.families.groups(family))
            if (!mesh_.groups[static_cast<std::size_t>(g)].hidden) out.push_back(g);
        return out;
    }

    MshEntity& entity(int dimension, FamilyIndex family) {
        const auto at = static_cast<std::size_t>(dimension);
        const auto [it, added] = by_groups_[at].try_emplace(shown_groups(family), entities_[at].size());
        if (added) {
            entities_[at].push_back({static_cast<int>(entities_[at].size()) + 1, it->first});
            for (const GroupIndex g : it->first) dimensions_[g] |= 1u << dimension;
        }
        return entities_[at][it->second];
    }

    void find_entities() {
        SparseCheck check(1 << 16);
        for (const CellBlock& block : mesh_.blocks()) {
            std::map<FamilyIndex, int> known;
            FamilyIndex last = -1;
            for (Index c = 0; c < block.size(); ++c, check()) {
                const FamilyIndex family = block.families[static_cast<std::size_t>(c)];
                const int dimension = traits(block.type).dimension;
                MshEntity& e = family == last ? entities_[static_cast<std::size_t>(dimension)]
                                                         [static_cast<std::size_t>(runs_.back().entity - 1)]
                                              : entity(dimension, family);
                for (const Index n : block.nodes(c)) e.include(mesh_.points[static_cast<std::size_t>(n)]);
                if (family != last && (last < 0 || runs_.back().entity != e.tag))
                    runs_.push_back({block.type, e.tag, c, c});
                last = family;
                runs_.back().end = c + 1;
            }
        }
        node_entities_.assign(mesh_.points.size(), 0);
        for (std::size_t n = 0; n < mesh_.points.size(); ++n, check()) {
            if (mesh_.node_families[n] == 0 || shown_groups(mesh_.node_families[n]).empty()) continue;
            MshEntity& e = entity(0, mesh_.node_families[n]);
            e.include(mesh_.points[n]);
            node_entities_[n] = e.tag;
            ++members_;
        }
        // Every node stands in an entity; which one means nothing in a mesh without geometry.
        home_dimension_ = std::max(mesh_.dimension(), 0);
        if (entities_[static_cast<std::size_t>(home_dimension_)].empty()) entity(home_dimension_, 0).include({0, 0, 0});
    }

    void put_names() {
        std::string lines;
        Index count = 0;
        for (std::size_t g = 0; g < mesh_.groups.size(); ++g) {
            const Group& group = mesh_.groups[g];
            if (group.hidden || group.kind == GroupKind::facet) continue;
            unsigned dimensions = dimensions_[static_cast<GroupIndex>(g)];
            if (dimensions == 0) dimensions = group.kind == GroupKind::node ? 1u : 1u << std::max(home_dimension_, 1);
            for (int d = 0; d <= 3; ++d)
                if (dimensions & (1u << d)) {
                    append_value(lines, d);
                    append_value(lines, g + 1);
                    lines += '"' + group.name + "\"\n";
                    ++count;
                }
        }
        if (count == 0) return;
        out_ += "$PhysicalNames\n";
        append_value(out_, count, '\n');
        out_ += lines + "$EndPhysicalNames\n";
    }

    /// Says which physical groups of points are node groups, where others hold point elements.
    void put_comment() {
        const auto elements = [this](const auto& d) {
            return (d.second & 1u) && mesh_.groups[static_cast<std::size_t>(d.first)].kind == GroupKind::element;
        };
        if (std::ranges::none_of(dimensions_, elements)) return;
        out_ += "$Comments\n" + std::string(msh_node_groups_comment);
        for (std::size_t g = 0; g < mesh_.groups.size(); ++g)
            if (mesh_.groups[g].kind == GroupKind::node && !mesh_.groups[g].hidden) {
                out_ += ' ';
                append_integer(out_, static_cast<Index>(g) + 1);
            }
        out_ += "\n$EndComments\n";
    }

    void put_entities() {
        out_ += "$Entities\n";
        for (int d = 0; d <= 3; ++d)
            append_value(out_, entities_[static_cast<std::size_t>(d)].size(), d < 3 ? ' ' : '\n');
        for (int d = 0; d <= 3; ++d)
            for (const MshEntity& e : entities_[static_cast<std::size_t>(d)]) {
                append_value(out_, e.tag);
                for (int a = 0; a < 3; ++a) append_value(out_, e.low[a]);
                if (d > 0)
                    for (int a = 0; a < 3; ++a) append_value(out_, e.high[a]);
                append_value(out_, e.groups.size());
                for (const GroupIndex g : e.groups) append_value(out_, g + 1);
                out_ += d > 0 ? "0\n" : "\n";  // no bounding entities
            }
        out_ += "$EndEntities\n";
    }

    void put_nodes() {
        const auto [low, high] = std::ranges::minmax(mesh_.node_ids);
        out_ += "$Nodes\n1 ";
        append_value(out_, mesh_.node_count());
        append_value(out_, low);
        append_value(out_, high, '\n');
        append_value(out_, home_dimension_);
        out_ += "1 0 ";
        append_value(out_, mesh_.node_count(), '\n');
        SparseCheck check(1 << 14);
        for (const Index id : mesh_.node_ids) append_value(out_, id, '\n');
        for (const Vec3& p : mesh_.points) {
            check();
            append_value(out_, p.x());
            append_value(out_, p.y());
            append_value(out_, p.z(), '\n');
        }
        out_ += "$EndNodes\n";
    }

    void put_elements() {
        const Index last = mesh_.largest_cell_id();
        Index low = last + 1;
        for (const CellBlock& block : mesh_.blocks())
            for (const Index id : block.ids) low = std::min(low, id);
        std::string points;
        const std::size_t blocks = runs_.size() + put_members(last, points);
        out_ += "$Elements\n";
        append_value(out_, blocks);
        append_value(out_, mesh_.cell_count() + members_);
        append_value(out_, mesh_.cell_count() + members_ == 0 ? 0 : low);
        append_value(out_, last + members_, '\n');
        SparseCheck check(1 << 14);
        for (const MshRun& run : runs_) {
            const CellBlock& block = mesh_.block(run.type);
            const MshType& type = msh_type(run.type);
            const auto nodes = static_cast<std::size_t>(traits(run.type).nodes);
            append_value(out_, traits(run.type).dimension);
            append_value(out_, run.entity);
            append_value(out_, type.number);
            append_value(out_, run.end - run.first, '\n');
            for (Index c = run.first; c < run.end; ++c, check()) {
                append_value(out_, block.ids[static_cast<std::size_t>(c)]);
                const auto of = block.nodes(c);
                for (std::size_t k = 0; k < nodes; ++k)
                    append_value(out_,
                                 mesh_.node_ids[static_cast<std::size_t>(of[static_cast<std::size_t>(type.order[k])])],
                                 k + 1 < nodes ? ' ' : '\n');
            }
        }
        out_ += points + "$EndElements\n";
    }

    /// The point elements of the node groups, entity by entity; gives the number of blocks.
    std::size_t put_members(Index last, std::string& out) const {
        std::vector<std::vector<Index>> of(entities_[0].size());
        for (std::size_t n = 0; n < node_entities_.size(); ++n)
            if (node_entities_[n] > 0) of[static_cast<std::size_t>(node_entities_[n] - 1)].push_back(mesh_.node_ids[n]);
        std::size_t blocks = 0;
        for (std::size_t e = 0; e < of.size(); ++e) {
            if (of[e].empty()) continue;
            ++blocks;
            out += "0 ";
            append_value(out, e + 1);
            out += "15 ";
            append_value(out, of[e].size(), '\n');
            for (const Index node : of[e]) {
                append_value(out, ++last);
                append_value(out, node, '\n');
            }
        }
        return blocks;
    }

    const Mesh& mesh_;
    std::string shown_;
    std::string out_;
    std::array<std::vector<MshEntity>, 4> entities_;
    std::array<std::map<std::vector<GroupIndex>, std::size_t>, 4> by_groups_;
    std::map<GroupIndex, unsigned> dimensions_;  // bits
    std::vector<MshRun> runs_;
    std::vector<int> node_entities_;  // tags; 0 for nodes in no group
    Index members_ = 0;               // nodes in groups
    int home_dimension_ = 0;          // of the entity, of tag 1, that all nodes are said to stand in
};

}  // namespace

void write_msh(const Mesh& mesh, const std::filesystem::path& path) {
    save_text(path, MshWriter(mesh, shown_path(path)).text());
}

std::vector<std::string> msh_losses(const Mesh& mesh) {
    std::vector<std::string> out;
    for (const Group& group : mesh.groups)
        if (!group.hidden && group.kind == GroupKind::facet) out.push_back("the facet group '" + group.name + "'");
    if (!mesh.unit.empty()) out.push_back("the unit '" + mesh.unit + "'");
    return out;
}

}  // namespace femscalpel
