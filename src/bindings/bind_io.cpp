// SPDX-License-Identifier: LGPL-2.1-or-later
#include <pybind11/stl/filesystem.h>

#include <memory>

#include "bindings.h"
#include "interruptible.h"
#include "io/io.h"

namespace py = pybind11;

namespace femscalpel::bindings {

void bind_io(py::module_& module) {
    module.def(
        "read",
        [](const std::filesystem::path& path) {
            return interruptible([&] { return std::make_shared<Mesh>(read(path)); });
        },
        py::arg("path"));
    module.def(
        "write", [](const Mesh& mesh, const std::filesystem::path& path) { interruptible([&] { write(mesh, path); }); },
        py::arg("mesh"), py::arg("path"));
}

}  // namespace femscalpel::bindings
