// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bindings.h"
#include "cancel.h"

namespace py = pybind11;

namespace femscalpel::bindings {
namespace {

/// The Python exception types. They live as long as the interpreter, hence never released.
struct Types {
    PyObject* error;
    PyObject* read;
    PyObject* write;
    PyObject* tool;
    PyObject* quality;
    PyObject* unsupported;
    PyObject* cancelled;
};

Types types;

PyObject* add_exception(py::module_& module, const char* name, const char* doc, PyObject* base) {
    PyObject* type = PyErr_NewExceptionWithDoc((std::string("femscalpel.") + name).c_str(), doc, base, nullptr);
    if (!type) throw py::error_already_set();
    module.add_object(name, type);
    return type;
}

/// Raises a Python exception with what the error says, and the parameter it is about.
void raise(PyObject* type, const Error& e) {
    const std::string_view what = e.what();  // may quote a file in any encoding
    const auto text = py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(what.data(), static_cast<Py_ssize_t>(what.size()), "replace"));
    if (!text) return;
    const auto error = py::reinterpret_steal<py::object>(PyObject_CallFunctionObjArgs(type, text.ptr(), nullptr));
    if (!error) return;  // Python has raised another one
    if (*e.parameter() && PyObject_SetAttrString(error.ptr(), "_parameter", py::str(e.parameter()).ptr()) != 0) return;
    PyErr_SetObject(type, error.ptr());
}

/// The property `parameter` of all errors.
void add_parameter(PyObject* type) {
    const py::cpp_function get(
        [](const py::object& error) -> py::object { return py::getattr(error, "_parameter", py::none()); });
    const py::object property = py::module_::import("builtins").attr("property");
    py::handle(type).attr("parameter") =
        property(get, py::none(), py::none(),
                 "Name of the parameter at fault, of the function or class called, or None: it is none, or not one\n"
                 "alone.");
}

}  // namespace

void bind_errors(py::module_& module) {
    types.error =
        add_exception(module, "Error",
                      "Base of every error femscalpel raises itself. The message names the file, line, entity or\n"
                      "parameter at fault and says what to do.",
                      PyExc_RuntimeError);
    add_parameter(types.error);
    types.read =
        add_exception(module, "ReadError",
                      "A file cannot be read: missing, truncated, corrupt or contradicting itself.", types.error);
    types.write = add_exception(module, "WriteError", "A file cannot be written, or its format cannot hold the mesh.",
                                types.error);
    types.tool =
        add_exception(module, "ToolError",
                      "A tool or an option is unusable: zero normal, bad name, the tool misses the mesh.", types.error);
    types.quality = add_exception(module, "QualityError",
                                  "No valid mesh of acceptable element shape can be made this way.", types.error);
    types.unsupported = add_exception(
        module, "UnsupportedElementError",
        "The tool or its band reaches elements the method cannot cut (quadrangles, prisms, ...).", types.error);
    types.cancelled =
        add_exception(module, "Cancelled",
                      "What ran was cancelled through a CancelToken; nothing was changed or written.", types.error);

    // NOLINTNEXTLINE(performance-unnecessary-value-param): the type is pybind11's.
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const ReadError& e) {
            raise(types.read, e);
        } catch (const WriteError& e) {
            raise(types.write, e);
        } catch (const ToolError& e) {
            raise(types.tool, e);
        } catch (const QualityError& e) {
            raise(types.quality, e);
        } catch (const UnsupportedElementError& e) {
            raise(types.unsupported, e);
        } catch (const Cancelled& e) {
            raise(types.cancelled, e);
        } catch (const Error& e) {
            raise(types.error, e);
        }
    });
}

}  // namespace femscalpel::bindings
