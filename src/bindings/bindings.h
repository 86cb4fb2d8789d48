// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <string>

#include "mesh/mesh.h"

// The compiled module `femscalpel._engine` is private to the package in src/python/femscalpel, which
// checks arguments, documents them and gives them their Python form. One function per part of the engine.
namespace femscalpel::bindings {

void bind_errors(pybind11::module_& module);
void bind_mesh(pybind11::module_& module);
void bind_groups(pybind11::module_& module);
void bind_tools(pybind11::module_& module);
/// Adds what fields need to the class of meshes.
void bind_fields(pybind11::class_<Mesh, std::shared_ptr<Mesh>>& mesh);
void bind_io(pybind11::module_& module);
void bind_operators(pybind11::module_& module);
void bind_fracture(pybind11::module_& module);

/// The visible group of this name and kind; throws Error when there is none.
GroupIndex require_group(const Mesh& mesh, const std::string& name, const std::string& kind);

/// Numbers as Python gets them: (n,) for nodes and elements, (n, 2) for facets.
pybind11::array_t<std::int64_t> to_array(const GroupMembers& members);

}  // namespace femscalpel::bindings
