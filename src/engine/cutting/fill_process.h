// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "cutting/fill_protocol.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// What the program that fills cavities answered; `failure` is empty if it filled.
struct FillAnswer {
    std::string failure;
    std::vector<Vec3> points;
    std::vector<std::array<int, 4>> tetras;
};

/// Path of the program; see helper_program(). Throws Error if it is nowhere.
std::string fill_program();

/// Runs the program `program` on a cavity, and ends it after `seconds` or when the calling thread is cancelled. Any
/// number of threads can do so at once. An end without an answer is a failure.
FillAnswer run_fill_program(const std::string& program, const fill_protocol::Request& request,
                            const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& triangles,
                            double seconds);

}  // namespace femscalpel
