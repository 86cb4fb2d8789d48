// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace femscalpel {

/// Records the seconds of consecutive steps by name; those of one name are added up.
class Stopwatch {
public:
    explicit Stopwatch(std::vector<std::pair<std::string, double>>& laps) : laps_(laps) {}

    /// Forgets the time since the last lap, which somebody else has recorded.
    void skip() { last_ = std::chrono::steady_clock::now(); }

    void lap(const char* step) {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - last_).count();
        const auto known = std::ranges::find(laps_, step, &std::pair<std::string, double>::first);
        if (known == laps_.end()) laps_.emplace_back(step, seconds);
        else known->second += seconds;
        last_ = now;
    }

private:
    std::vector<std::pair<std::string, double>>& laps_;
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace femscalpel
