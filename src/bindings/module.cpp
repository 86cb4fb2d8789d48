// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bindings.h"
#include "interruptible.h"

PYBIND11_MODULE(_engine, module) {
    module.doc() = "Compiled part of femscalpel; use the package femscalpel instead.";
    femscalpel::bindings::bind_errors(module);
    femscalpel::bindings::bind_cancel(module);
    femscalpel::bindings::bind_mesh(module);
    femscalpel::bindings::bind_groups(module);
    femscalpel::bindings::bind_tools(module);
    femscalpel::bindings::bind_io(module);
    femscalpel::bindings::bind_operators(module);
    femscalpel::bindings::bind_fracture(module);
}
