// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/fill_process.h"

#include "helper_process.h"

namespace femscalpel {
namespace {

bool converse(HelperProcess& process, const fill_protocol::Request& request, const std::vector<Vec3>& points,
              const std::vector<std::array<int, 3>>& triangles, FillAnswer& result) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(int) == 4);
    fill_protocol::Answer answer{};
    if (!process.send_all(&request, sizeof request) || !process.send_all(points.data(), points.size() * sizeof(Vec3)) ||
        !process.send_all(triangles.data(), triangles.size() * sizeof(std::array<int, 3>)) ||
        !process.receive_all(&answer, sizeof answer))
        return false;
    result.failure.resize(answer.text);
    result.points.resize(answer.points);
    result.tetras.resize(answer.tetras);
    return process.receive_all(result.failure.data(), result.failure.size()) &&
           process.receive_all(result.points.data(), result.points.size() * sizeof(Vec3)) &&
           process.receive_all(result.tetras.data(), result.tetras.size() * sizeof(std::array<int, 4>));
}

}  // namespace

std::string fill_program() { return helper_program("femscalpel-fill", "the program that fills cavities"); }

FillAnswer run_fill_program(const std::string& program, const fill_protocol::Request& request,
                            const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& triangles,
                            double seconds) {
    HelperProcess process(program, {}, seconds);
    FillAnswer result;
    if (!converse(process, request, points, triangles, result)) {
        result = {};
        result.failure = process.timed_out() ? "no end after " + std::to_string(static_cast<int>(seconds)) + " s"
                                             : "Netgen broke off";
    } else if (result.failure.empty() && result.tetras.empty()) {
        result.failure = "no tetrahedra";
    }
    return result;
}

}  // namespace femscalpel
