// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace femscalpel {

/// Records the seconds of consecutive steps by name.
class Stopwatch {
public:
    explicit Stopwatch(std::vector<std::pair<std::string, double>>& laps) : laps_(laps) {}

    /// Forgets the time since the last lap, which somebody else has recorded.
    void skip() { last_ = std::chrono::steady_clock::now(); }

    void lap(const char* step) {
        const auto now = std::chrono::steady_clock::now();
        laps_.emplace_back(step, std::chrono::duration<double>(now - last_).count());
        last_ = now;
    }

private:
    std::vector<std::pair<std::string, double>>& laps_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace femscalpel
