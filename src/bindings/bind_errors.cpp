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

}  // namespace

void bind_errors(py::module_& module) {
    types.error =
        add_exception(module, "Error",
                      "Base of every error femscalpel raises itself. The message names the file, line, entity or\n"
                      "parameter at fault and says what to do.",
                      PyExc_RuntimeError);
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
            PyErr_SetString(types.read, e.what());
        } catch (const WriteError& e) {
            PyErr_SetString(types.write, e.what());
        } catch (const ToolError& e) {
            PyErr_SetString(types.tool, e.what());
        } catch (const QualityError& e) {
            PyErr_SetString(types.quality, e.what());
        } catch (const UnsupportedElementError& e) {
            PyErr_SetString(types.unsupported, e.what());
        } catch (const Cancelled& e) {
            PyErr_SetString(types.cancelled, e.what());
        } catch (const Error& e) {
            PyErr_SetString(types.error, e.what());
        }
    });
}

}  // namespace femscalpel::bindings
