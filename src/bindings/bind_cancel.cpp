// SPDX-License-Identifier: LGPL-2.1-or-later
#include <memory>
#include <utility>
#include <vector>

#include "bindings.h"
#include "interruptible.h"

namespace py = pybind11;

namespace femscalpel::bindings {
namespace {

/// Ctrl-C is seen within this time.
constexpr std::chrono::milliseconds patience(50);

/// Number of Python's main thread, where signal handlers run.
unsigned long main_thread = 0;

/// The scopes that Python code of this thread is in.
thread_local std::vector<std::pair<const CancelToken*, std::unique_ptr<CancelScope>>> entered;

void leave(const CancelToken& token) {
    if (entered.empty() || entered.back().first != &token)
        throw Error("a CancelToken is left in another order or thread than it was entered");
    entered.pop_back();
}

}  // namespace

Signals::Signals() : main_thread_(PyThread_get_thread_ident() == main_thread), next_(Clock::now() + patience) {}

// NOLINTNEXTLINE(bugprone-exception-escape): without an interpreter lock to be had the program ends.
Signals::~Signals() {
    if (!type_) return;
    const py::gil_scoped_acquire acquire;
    Py_XDECREF(type_);
    Py_XDECREF(value_);
    Py_XDECREF(traceback_);
}

bool Signals::raised() {
    if (type_) return true;
    if (!main_thread_ || Clock::now() < next_) return false;
    {
        const py::gil_scoped_acquire acquire;
        if (PyErr_CheckSignals() != 0) PyErr_Fetch(&type_, &value_, &traceback_);
    }
    next_ = Clock::now() + patience;
    return type_ != nullptr;
}

void Signals::rethrow() {
    if (!type_) return;
    PyErr_Restore(std::exchange(type_, nullptr), std::exchange(value_, nullptr), std::exchange(traceback_, nullptr));
    throw py::error_already_set();
}

void bind_cancel(py::module_& module) {
    main_thread = py::module_::import("threading").attr("main_thread")().attr("ident").cast<unsigned long>();
    py::class_<CancelToken>(module, "CancelToken")
        .def(py::init<>())
        .def("cancel", &CancelToken::cancel)
        .def_property_readonly("cancelled", &CancelToken::cancelled)
        .def("enter",
             [](const CancelToken& token) { entered.emplace_back(&token, std::make_unique<CancelScope>(token)); })
        .def("leave", &leave);
}

}  // namespace femscalpel::bindings
