// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <type_traits>

#include "cancel.h"

namespace femscalpel::bindings {

/// Looks for signals (Ctrl-C) while the engine computes, and keeps what their handlers raise.
class Signals {
public:
    Signals();
    ~Signals();  // NOLINT(bugprone-exception-escape): see there
    Signals(const Signals&) = delete;
    Signals& operator=(const Signals&) = delete;

    /// Whether a handler has raised. Takes the interpreter lock now and then; on other threads than Python's main
    /// thread, never.
    bool raised();

    /// Throws that, with the interpreter lock held.
    void rethrow();

private:
    using Clock = std::chrono::steady_clock;
    bool main_thread_;
    Clock::time_point next_;
    PyObject *type_ = nullptr, *value_ = nullptr, *traceback_ = nullptr;
};

/// Runs `function` without the interpreter lock; a signal handler that raises ends it (cancel.h), and so does a
/// CancelToken of Python's. It must not have begun to change a Python object when it comes to a check point.
template <class Function>
auto interruptible(Function function) {
    Signals signals;
    const auto run = [&] {
        const pybind11::gil_scoped_release release;
        const CancelScope scope(CancelToken(), [&signals] { return signals.raised(); });
        check_cancelled();  // small meshes have no other check point
        return function();
    };
    try {
        if constexpr (std::is_void_v<decltype(function())>) {
            run();
            signals.rethrow();
        } else {
            auto out = run();
            signals.rethrow();
            return out;
        }
    } catch (const Cancelled&) {
        signals.rethrow();
        throw;
    }
}

void bind_cancel(pybind11::module_& module);

}  // namespace femscalpel::bindings
