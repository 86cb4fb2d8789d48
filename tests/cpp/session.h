// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "operators/crack.h"
#include "operators/cut.h"
#include "operators/drill.h"
#include "operators/scalpel.h"

namespace femscalpel::checks {

/// A session with its operators as methods.
struct Session : Scalpel {
    using Scalpel::Scalpel;

    Result crack(const Tool& tool, const CrackOptions& options = {}) const {
        return femscalpel::crack(mesh(), tool, options, prepared());
    }
    Result drill(std::span<const Tool* const> tools, const DrillOptions& options = {}) const {
        return femscalpel::drill(mesh(), tools, options, prepared());
    }
    Result cut(const Tool& positive, const Tool& negative, const CutOptions& options = {}) const {
        return femscalpel::cut(mesh(), positive, negative, options, prepared());
    }
    Result cut(const Plane& plane, double width, const CutOptions& options = {}) const {
        return femscalpel::cut(mesh(), plane, width, options, prepared());
    }
};

}  // namespace femscalpel::checks
