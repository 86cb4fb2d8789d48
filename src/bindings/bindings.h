// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

// The compiled module `femscalpel._engine` is private to the package in src/python/femscalpel, which
// checks arguments, documents them and gives them their Python form. One function per part of the engine.
namespace femscalpel::bindings {

void bind_errors(pybind11::module_& module);
void bind_mesh(pybind11::module_& module);
void bind_tools(pybind11::module_& module);
void bind_io(pybind11::module_& module);
void bind_operators(pybind11::module_& module);

}  // namespace femscalpel::bindings
