// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <string>

#include <TopoDS_Shape.hxx>

namespace femscalpel {

/// The shape in a .step, .stp, .brep or .brp file. Throws ReadError that names the file.
TopoDS_Shape read_cad_file(const std::filesystem::path& path);

/// The shape in the text of a .brep file. Throws ToolError that begins with `what`
/// and is about the parameter of that name, a literal.
TopoDS_Shape shape_from_brep(const std::string& text, const std::string& what, const char* parameter);

}  // namespace femscalpel
