// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "tools/tool.h"

namespace femscalpel {

/// The tools a node lies on: none, one, two (on the curve where they cross) or three (in the point).
class Contact {
public:
    Contact() = default;
    Contact(const Tool* tool) {  // NOLINT(google-explicit-constructor): one tool, or none, is the usual case
        if (tool) tools_[count_++] = tool;
    }

    std::span<const Tool* const> tools() const { return {tools_.data(), static_cast<std::size_t>(count_)}; }
    int count() const { return count_; }
    explicit operator bool() const { return count_ > 0; }
    bool has(const Tool* tool) const { return std::ranges::find(tools(), tool) != tools().end(); }
    bool full() const { return count_ == static_cast<int>(tools_.size()); }

    /// The same and `tool`; there must be room for it.
    Contact with(const Tool* tool) const {
        Contact out = *this;
        if (!has(tool)) out.tools_[out.count_++] = tool;
        return out;
    }

    /// The same without `tool`.
    Contact without(const Tool* tool) const {
        Contact out;
        for (const Tool* t : tools())
            if (t != tool) out.tools_[out.count_++] = t;
        return out;
    }

    /// The tools in both.
    Contact common(const Contact& other) const {
        Contact out;
        for (const Tool* t : tools())
            if (other.has(t)) out.tools_[out.count_++] = t;
        return out;
    }

    /// Whether every tool of `other` is in this one.
    bool includes(const Contact& other) const {
        return std::ranges::all_of(other.tools(), [&](const Tool* t) { return has(t); });
    }

private:
    std::array<const Tool*, 3> tools_{};
    int count_ = 0;
};

}  // namespace femscalpel
