// SPDX-License-Identifier: LGPL-2.1-or-later
#include "operators/options.h"

#include "error.h"

namespace femscalpel {

Method method_from_name(const std::string& name) {
    if (name == "snap") return Method::snap;
    if (name == "deform") return Method::deform;
    throw ToolError("method '" + name + "' is unknown; it is \"snap\" or \"deform\"", "method");
}

std::string_view to_string(Method method) { return method == Method::snap ? "snap" : "deform"; }

}  // namespace femscalpel
