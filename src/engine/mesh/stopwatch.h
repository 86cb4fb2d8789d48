// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace femscalpel {

/// Seconds by step, in order; those of one name are added up. Copies are the same list: what attempts took that came to
/// nothing is not lost.
class Laps {
public:
    using List = std::vector<std::pair<std::string, double>>;

    void add(const std::string& step, double seconds) {
        const auto known = std::ranges::find(*list_, step, &List::value_type::first);
        if (known == list_->end())
            list_->emplace_back(step, seconds);
        else
            known->second += seconds;
    }
    const List& list() const { return *list_; }
    double sum() const {
        double out = 0;
        for (const auto& [step, seconds] : *list_) out += seconds;
        return out;
    }

private:
    std::shared_ptr<List> list_ = std::make_shared<List>();
};

/// Records the seconds of consecutive steps by name.
class Stopwatch {
public:
    using Time = std::chrono::steady_clock::time_point;

    static Time now() { return std::chrono::steady_clock::now(); }
    static double since(Time start) { return std::chrono::duration<double>(now() - start).count(); }

    explicit Stopwatch(Laps laps, Time start = now()) : laps_(std::move(laps)), last_(start) {}

    void lap(const char* step) {
        const double seconds = since(last_);
        laps_.add(step, seconds);
        last_ += std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(seconds));
    }

    /// The same for a step that parts of it have timed: these, and the rest as `step`.
    void lap(const char* step, const Laps& parts) {
        for (const auto& [part, seconds] : parts.list()) laps_.add(part, seconds);
        last_ += std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(parts.sum()));
        lap(step);
    }

private:
    Laps laps_;
    Time last_;
};

}  // namespace femscalpel
