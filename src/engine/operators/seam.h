// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "cutting/imprint.h"
#include "operators/options.h"
#include "operators/prepared.h"
#include "operators/report.h"

namespace femscalpel {

/// A line made edges of a mesh, as imprint_seam() leaves it.
struct SeamLine {
    std::vector<Index> nodes;          ///< along it, of the result; of a closed line the first is there once
    std::vector<std::size_t> at_stop;  ///< for each stop of the line, which of the nodes is there
    std::vector<char> bound;           ///< of nodes: whether a border, line or group holds them on the surface
};

/// What imprint_seam() returns.
struct Seamed {
    Result result;
    std::vector<SeamLine> lines;
};

/// Makes edges of a mesh's surface lie along lines, as an operation of its own: with the band around them relaxed, poor
/// elements improved, the solver's input carried over, and a report. See Imprint for `exact`. Throws as perform() does.
Seamed imprint_seam(const Mesh& mesh, std::vector<ImprintLine> lines, bool exact, const OperatorOptions& options,
                    const Prepared& known);

}  // namespace femscalpel
