// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace femscalpel::checks {

/// Collects failures: the first offender of each kind is described, the others counted.
class Findings {
public:
    template <class... Parts>
    void add(const std::string& keyword, const Parts&... parts) {
        auto& [count, first] = found_[keyword];
        if (count++ > 0) return;
        std::ostringstream text;
        text.precision(12);
        (text << ... << parts);
        first = text.str();
    }

    std::vector<std::string> lines() const {
        std::vector<std::string> out;
        for (const auto& [keyword, found] : found_)
            out.push_back(keyword + ": " + found.second +
                          (found.first > 1 ? " (" + std::to_string(found.first) + " in all)" : ""));
        return out;
    }

private:
    std::map<std::string, std::pair<int, std::string>> found_;
};

}  // namespace femscalpel::checks
