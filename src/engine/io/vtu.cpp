// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/vtu.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <new>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "cancel.h"
#include "error.h"
#include "io/atomic_file.h"
#include "io/vtu_types.h"
#include "utf8.h"

namespace femscalpel {
namespace {

/// What XML cannot hold.
bool is_control(char c) { return c >= 0 && c < ' '; }

/// Text as an XML attribute value; control characters, which XML cannot hold, become "_".
std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : as_utf8(std::string(text))) {
        if (is_control(c))
            out += '_';
        else if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

/// Appends a value's bytes.
template <class T>
void put(std::string& out, T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    out.append(bytes, sizeof(T));
}

/// The file: the XML of its head and the compressed arrays that follow.
class Document {
public:
    std::string xml;
    std::string data;

    /// One array, of `components` values each, as a DataArray element and a compressed block.
    template <class T>
    void array(std::string_view type, std::string_view name, const std::vector<T>& values, int components = 1,
               const std::string& more = {}) {
        xml += "<DataArray type=\"";
        xml += type;
        xml += "\" Name=\"" + escaped(name) + "\" NumberOfComponents=\"" + std::to_string(components) +
               "\" format=\"appended\" offset=\"" + std::to_string(data.size()) + "\"" + more + "/>\n";
        compress(reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(T));
    }

private:
    // vtkZLibDataCompressor's layout: number of blocks, their size, the last one's if it is smaller
    // (else 0), then the compressed sizes, then the blocks.
    void compress(const unsigned char* bytes, std::size_t size) {
        constexpr std::size_t block_size = 1 << 18;
        const std::size_t blocks = (size + block_size - 1) / block_size;
        const std::size_t head = data.size();
        put<std::uint64_t>(data, blocks);
        put<std::uint64_t>(data, block_size);
        put<std::uint64_t>(data, size % block_size);
        data.append(blocks * sizeof(std::uint64_t), '\0');
        std::vector<unsigned char> packed(compressBound(block_size));
        for (std::size_t b = 0; b < blocks; ++b) {
            check_cancelled();
            uLongf length = packed.size();
            const std::size_t here = std::min(block_size, size - b * block_size);
            // With a buffer of this size only lack of memory can make it fail.
            if (compress2(packed.data(), &length, bytes + b * block_size, static_cast<uLong>(here), Z_BEST_SPEED) !=
                Z_OK)
                throw std::bad_alloc();
            const auto stored = static_cast<std::uint64_t>(length);
            std::memcpy(data.data() + head + (3 + b) * sizeof stored, &stored, sizeof stored);
            data.append(reinterpret_cast<const char*>(packed.data()), length);
        }
    }
};

/// Array names of one section, made unique.
class Names {
public:
    std::string unique(std::string name) {
        while (!taken_.insert(name).second) name += '_';
        return name;
    }

private:
    std::set<std::string> taken_;
};

/// Attributes that tell read_vtu() which group an array is; others pass over them.
std::string group_attributes(const Group& group) {
    return std::string(" ") + vtu_group_kind + "=\"" + std::string(to_string(group.kind)) + "\" " + vtu_group_name +
           "=\"" + escaped(group.name) + "\"";
}

/// 1 for the families that contain `group`, by family.
std::vector<std::uint8_t> families_with(const Mesh& mesh, GroupIndex group) {
    std::vector<std::uint8_t> in(static_cast<std::size_t>(mesh.families.size()));
    for (FamilyIndex f = 0; f < mesh.families.size(); ++f)
        in[static_cast<std::size_t>(f)] = mesh.families.contains(f, group);
    return in;
}

void write_point_data(Document& document, const Mesh& mesh) {
    Names names;
    document.xml += "<PointData>\n";
    document.array("Int64", names.unique("NodeNumber"), mesh.node_ids);
    document.array("Int32", names.unique("Family"), mesh.node_families);
    std::vector<std::uint8_t> flags(mesh.points.size());
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
        check_cancelled();
        const Group& group = mesh.groups[g];
        if (group.hidden || group.kind != GroupKind::node) continue;
        const std::vector<std::uint8_t> in = families_with(mesh, static_cast<GroupIndex>(g));
        for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = in[static_cast<std::size_t>(mesh.node_families[i])];
        document.array("UInt8", names.unique(group.name), flags, 1, group_attributes(group));
    }
    document.xml += "</PointData>\n";
}

void write_cell_data(Document& document, const Mesh& mesh) {
    std::vector<Index> ids;
    std::vector<FamilyIndex> families;
    std::array<std::size_t, cell_type_count> first{};
    for (const CellBlock& block : mesh.blocks()) {
        first[static_cast<std::size_t>(block.type)] = ids.size();
        ids.insert(ids.end(), block.ids.begin(), block.ids.end());
        families.insert(families.end(), block.families.begin(), block.families.end());
    }
    Names names;
    document.xml += "<CellData>\n";
    document.array("Int64", names.unique("ElementNumber"), ids);
    document.array("Int32", names.unique("Family"), families);
    std::vector<std::uint8_t> flags(ids.size());
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
        const Group& group = mesh.groups[g];
        if (group.hidden || group.kind == GroupKind::node) continue;
        check_cancelled();
        const std::vector<std::uint8_t> in = families_with(mesh, static_cast<GroupIndex>(g));
        if (group.kind == GroupKind::element) {
            for (std::size_t i = 0; i < flags.size(); ++i) flags[i] = in[static_cast<std::size_t>(families[i])];
        } else {
            std::ranges::fill(flags, std::uint8_t{0});
            for (const Facet& f : mesh.facets)
                if (in[static_cast<std::size_t>(f.family)])
                    flags[first[static_cast<std::size_t>(f.type)] + static_cast<std::size_t>(f.cell)] |=
                        static_cast<std::uint8_t>(1u << (f.face - 1));
        }
        document.array("UInt8", names.unique(group.name), flags, 1, group_attributes(group));
    }
    document.xml += "</CellData>\n";
}

void write_cells(Document& document, const Mesh& mesh) {
    std::vector<Index> connectivity, offsets;
    std::vector<std::uint8_t> types;
    for (const CellBlock& block : mesh.blocks()) {
        const std::size_t start = connectivity.size();
        connectivity.insert(connectivity.end(), block.connectivity.begin(), block.connectivity.end());
        if (block.type == CellType::wedge)
            for (std::size_t c = start; c < connectivity.size(); c += 6) turn_vtk_wedge(&connectivity[c]);
        const auto nodes = static_cast<std::size_t>(traits(block.type).nodes);
        for (std::size_t c = 1; c <= block.ids.size(); ++c) offsets.push_back(static_cast<Index>(start + c * nodes));
        types.insert(types.end(), block.ids.size(), vtk_types[static_cast<std::size_t>(block.type)]);
    }
    document.xml += "<Cells>\n";
    document.array("Int64", "connectivity", connectivity);
    document.array("Int64", "offsets", offsets);
    document.array("UInt8", "types", types);
    document.xml += "</Cells>\n";
}

}  // namespace

void write_vtu(const Mesh& mesh, const std::filesystem::path& path) {
    if (mesh.points.empty()) throw WriteError(shown_path(path) + ": the mesh has no nodes");
    AtomicFile target(path);
    Document document;
    document.xml =
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"";
    document.xml += std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";
    document.xml += "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n";
    document.xml += "<Piece NumberOfPoints=\"" + std::to_string(mesh.node_count()) + "\" NumberOfCells=\"" +
                    std::to_string(mesh.cell_count()) + "\">\n";
    write_point_data(document, mesh);
    write_cell_data(document, mesh);
    std::vector<double> coordinates;
    coordinates.reserve(3 * mesh.points.size());
    for (const Vec3& p : mesh.points) coordinates.insert(coordinates.end(), p.data(), p.data() + 3);
    document.xml += "<Points>\n";
    document.array("Float64", "Points", coordinates, 3);
    document.xml += "</Points>\n";
    write_cells(document, mesh);
    document.xml += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";

    std::ofstream file(target.temporary(), std::ios::binary | std::ios::trunc);
    file << document.xml;
    write_obeying(file, document.data);
    file << "\n</AppendedData>\n</VTKFile>\n";
    file.close();
    if (!file) throw WriteError(shown_path(path) + ": cannot be written: the disk may be full");
    target.commit();
}

std::vector<std::string> vtu_losses(const Mesh& mesh) {
    std::vector<std::string> out;
    for (const Group& group : mesh.groups) {
        if (group.hidden || std::ranges::none_of(group.name, is_control)) continue;
        std::string name = group.name;
        std::ranges::replace_if(name, is_control, '_');
        out.push_back("the control characters in the name of the " + std::string(to_string(group.kind)) + " group '" +
                      name + "'");
    }
    if (!mesh.unit.empty()) out.push_back("the unit '" + mesh.unit + "'");
    return out;
}

}  // namespace femscalpel
