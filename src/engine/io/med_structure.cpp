// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/med_structure.h"

#include <med.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace femscalpel {
namespace {

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

/// Texts that the library copies into buffers of fixed size; but for components it asks for the memory.
herr_t check_field_attribute(hid_t object, const char* name, const H5A_info_t* info, void* more) {
    if (check_attribute(object, name, info, more) < 0) return -1;
    const hid_t attribute = H5Aopen(object, name, H5P_DEFAULT);
    if (attribute < 0) return -1;
    const hid_t type = H5Aget_type(attribute);
    bool good = type >= 0;
    if (good && H5Tget_class(type) == H5T_STRING) {
        const bool of_components = std::strcmp(name, "NOM") == 0 || std::strcmp(name, "UNI") == 0;
        const std::size_t most = of_components ? longest_med_attribute : MED_COMMENT_SIZE + 1;
        const bool short_one = std::strcmp(name, "DES") != 0 && !of_components;
        good = H5Tis_variable_str(type) == 0 && H5Tget_size(type) <= (short_one ? MED_NAME_SIZE + 1 : most);
    }
    if (type >= 0) H5Tclose(type);
    H5Aclose(attribute);
    return good ? 0 : -1;
}

bool check_dataset(hid_t object) {
    const hid_t space = H5Dget_space(object);
    if (space < 0) return false;
    const bool good = H5Sget_simple_extent_ndims(space) == 1;
    H5Sclose(space);
    return good;
}

/// Whether every attribute can be decoded: asked for a name that none has, HDF5 looks at all. Iterating over a damaged
/// one crashes in HDF5 1.10, which frees a table it never filled.
bool check_attributes_decode(hid_t object) { return H5Aexists(object, "of no MED file") >= 0; }

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

/// Whether all data can be read, as they are: without checksums, what says where its pieces are can be damaged. Data
/// much larger than their file are damage, too: nothing is compressed as much.
bool check_data(hid_t dataset, std::uint64_t largest) {
    const hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset), properties = H5Dget_create_plist(dataset);
    bool good = type >= 0 && space >= 0 && properties >= 0;
    if (good) {
        hsize_t chunk = 1 << 16;
        if (H5Pget_layout(properties) == H5D_CHUNKED) good = H5Pget_chunk(properties, 1, &chunk) == 1 && chunk > 0;
        const hssize_t size = H5Sget_simple_extent_npoints(space);
        const std::size_t width = H5Tget_size(type);
        good = good && size >= 0 && width > 0 && static_cast<std::uint64_t>(size) <= largest / width;
        std::vector<char> bytes(good ? std::min(chunk, static_cast<hsize_t>(size)) * width : 0);
        for (hsize_t at = 0; good && at < static_cast<hsize_t>(size); at += chunk) {
            const hsize_t count = std::min(chunk, static_cast<hsize_t>(size) - at);
            const hid_t memory = H5Screate_simple(1, &count, nullptr);
            good = H5Sselect_hyperslab(space, H5S_SELECT_SET, &at, nullptr, &count, nullptr) >= 0 &&
                   H5Dread(dataset, type, memory, space, H5P_DEFAULT, bytes.data()) >= 0;
            H5Sclose(memory);
        }
    }
    if (type >= 0) H5Tclose(type);
    if (space >= 0) H5Sclose(space);
    if (properties >= 0) H5Pclose(properties);
    return good;
}

/// How many entries a data set has for each of the entities that its attribute NBR counts: at least, at most. Of an
/// element's connectivity that is what its type's name ends with; of coordinates the axes. Nothing where it is no
/// matter.
struct PerEntity {
    hsize_t least = 0, most = 0;
};

PerEntity per_entity(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    if (slash == path.npos) return {};
    const std::string_view set = path.substr(slash + 1), above = path.substr(0, slash);
    if (set == "FAM" || set == "NUM") return {1, 1};
    if (set == "COO") return {1, 3};
    if (set != "NOD") return {};
    hsize_t nodes = 0;
    for (const char c : above.substr(std::min(above.size(), above.find_last_not_of("0123456789") + 1)))
        nodes = 10 * nodes + static_cast<hsize_t>(c - '0');
    return {nodes, nodes};
}

/// MED-fichier's functions for MED 2 read a data set as long as it is into arrays as long as NBR says.
bool has_counted_size(hid_t dataset, const char* path) {
    const PerEntity entries = per_entity(path);
    if (entries.least == 0 || H5Aexists(dataset, "NBR") <= 0) return true;
    const hid_t attribute = H5Aopen(dataset, "NBR", H5P_DEFAULT), space = H5Dget_space(dataset);
    std::int64_t counted = -1;
    const bool read = attribute >= 0 && H5Aread(attribute, H5T_NATIVE_INT64, &counted) >= 0;
    const hssize_t size = space >= 0 ? H5Sget_simple_extent_npoints(space) : -1;
    if (attribute >= 0) H5Aclose(attribute);
    if (space >= 0) H5Sclose(space);
    if (!read || counted < 0 || size < 0) return false;
    if (counted == 0) return size <= static_cast<hssize_t>(entries.most);
    const auto count = static_cast<hsize_t>(counted), whole = static_cast<hsize_t>(size);
    return whole % count == 0 && whole / count >= entries.least && whole / count <= entries.most;
}

struct Looking {
    bool at_fields, at_data;
    std::uint64_t largest;  // of a data set, in bytes
};

herr_t check_object(hid_t root, const char* path, const H5O_info_t* info, void* more) {
    const auto& looking = *static_cast<const Looking*>(more);
    const char* slash = std::strrchr(path, '/');
    if (std::strlen(slash ? slash + 1 : path) > MED_NAME_SIZE || std::strlen(path) > longest_path) return -1;
    const bool family_list = slash && (std::strcmp(slash, "/ELEME") == 0 || std::strcmp(slash, "/NOEUD") == 0);
    if (info->num_attrs == 0 && info->type != H5O_TYPE_DATASET && !family_list) return 0;
    const hid_t object = H5Oopen(root, path, H5P_DEFAULT);
    if (object < 0) return -1;
    hsize_t first = 0;
    bool good = check_attributes_decode(object) &&
                H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, &first,
                            looking.at_fields ? check_field_attribute : check_attribute, nullptr) >= 0;
    if (good && info->type == H5O_TYPE_DATASET)
        good = check_dataset(object) &&
               (!looking.at_data || (has_counted_size(object, path) && check_data(object, looking.largest)));
    if (good && family_list) good = check_creation_order(object);
    H5Oclose(object);
    return good ? 0 : -1;
}

#if H5_VERSION_GE(1, 12, 0)  // H5O_info_t is H5O_info2_t from then on
constexpr auto visit_objects = H5Ovisit3;
#else
constexpr auto visit_objects = H5Ovisit2;
#endif

bool can_be_walked(hid_t file, std::initializer_list<const char*> parts, Looking looking) {
    for (const char* part : parts) {
        const htri_t there = H5Lexists(file, part, H5P_DEFAULT);
        if (there < 0) return false;
        if (there == 0) continue;
        const hid_t group = H5Gopen2(file, part, H5P_DEFAULT);
        if (group < 0) return false;
        const herr_t walked = visit_objects(group, H5_INDEX_NAME, H5_ITER_NATIVE, check_object, &looking,
                                            H5O_INFO_BASIC | H5O_INFO_NUM_ATTRS);
        H5Gclose(group);
        if (walked < 0) return false;
    }
    return true;
}

}  // namespace

bool is_sound_structure(const std::string& path, MedPart part, MedLook look) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) return false;
    hsize_t bytes = 0;
    H5Fget_filesize(file, &bytes);
    const Looking looking{part == MedPart::fields, look == MedLook::everything, largest_med_array(bytes)};
    const bool good = part == MedPart::mesh ? can_be_walked(file, {"INFOS_GENERALES", "ENS_MAA", "FAS"}, looking)
                                            : can_be_walked(file, {"CHA", "PROFILS", "GAUSS"}, looking);
    return H5Fclose(file) >= 0 && good;
}

}  // namespace femscalpel
