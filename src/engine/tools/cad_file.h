// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

#include <TopoDS_Shape.hxx>

namespace femscalpel {

// Errors are about the parameter `source`, as that of faces and shapes is called.

/// The shape in a .step, .stp, .brep or .brp file. Throws ReadError that names the file.
TopoDS_Shape read_cad_file(const std::filesystem::path& path);

/// The shape in the text of a .brep file. Throws ToolError that begins with `what`.
TopoDS_Shape shape_from_brep(const std::string& text, const std::string& what);

}  // namespace femscalpel
