// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "operators/report.h"

namespace femscalpel {

/// Carries the fields of `input` over to the result of an operator, and lists in its report what became of them, with
/// a warning where values are missing, or lie outside what the input tells. What is in the element group `added`, if
/// one is named, is not the input's. A preview has none. Costs nothing without fields.
void follow_fields(const Mesh& input, bool band_only, Result& result, const std::string& added = {});

}  // namespace femscalpel
