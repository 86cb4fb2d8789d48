// SPDX-License-Identifier: LGPL-2.1-or-later
#include <pybind11/stl/filesystem.h>

#include <memory>

#include "bindings.h"
#include "interruptible.h"
#include "io/formats.h"
#include "io/io.h"

namespace py = pybind11;

namespace femscalpel::bindings {

void bind_io(py::module_& module) {
    module.def(
        "read",
        [](const std::filesystem::path& path, const std::string& mesh) {
            return interruptible([&] { return std::make_shared<Mesh>(read(path, mesh)); });
        },
        py::arg("path"), py::arg("mesh") = std::string());
    module.def(
        "meshes_in", [](const std::filesystem::path& path) { return interruptible([&] { return meshes_in(path); }); },
        py::arg("path"));
    module.def(
        "write", [](const Mesh& mesh, const std::filesystem::path& path) { interruptible([&] { write(mesh, path); }); },
        py::arg("mesh"), py::arg("path"));
    module.def(
        "losses", [](const Mesh& mesh, const std::filesystem::path& path) { return losses(mesh, path); },
        py::arg("mesh"), py::arg("path"));
    module.def(
        "loose_ends", [](const Mesh& mesh, const std::filesystem::path& path) { return loose_ends(mesh, path); },
        py::arg("mesh"), py::arg("path"));
    module.def("formats", [] {  // (title, extensions, read, written)
        py::list rows;
        for (const Format& f : formats()) {
            py::list extensions;
            for (const std::string_view e : f.extensions()) extensions.append(std::string(e));
            rows.append(
                py::make_tuple(std::string(f.title), py::tuple(extensions), f.read != nullptr, f.write != nullptr));
        }
        return rows;
    });
}

}  // namespace femscalpel::bindings
