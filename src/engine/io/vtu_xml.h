// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/vtu_file.h"

namespace femscalpel {

/// What the elements of a VTK XML file say.
struct VtuHead {
    std::string byte_order, header_type, compressor;
    Index points = 0, cells = 0;
    std::vector<VtuArray> arrays;
    std::string appended_encoding;
};

/// Reads the XML of a VTK file, up to the data that may be appended to it; `shown` is the file's name in messages.
/// Throws ReadError with file and line: no XML, no unstructured grid, several pieces.
VtuHead read_vtu_xml(std::string_view xml, const std::string& shown);

}  // namespace femscalpel
