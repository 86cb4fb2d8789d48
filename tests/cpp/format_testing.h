// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstring>
#include <string>

#include "mesh/mesh.h"

namespace femscalpel::checks {

/// A mesh of one element of every type but those listed, in overlapping groups: all nodes lie about the unit cube,
/// numbers do not start at 1, some groups are empty and one name belongs to groups of both kinds.
Mesh one_of_each(std::initializer_list<CellType> without);

/// Expects two meshes to be the same: numbers, coordinates, elements, groups in their order with their members.
void expect_equal(const Mesh& found, const Mesh& expected);

/// The text of a binary file, put together value by value.
class Bytes {
public:
    explicit Bytes(bool swapped = false) : swapped_(swapped) {}

    Bytes& text(const std::string& s) {
        out_ += s;
        return *this;
    }
    template <class T>
    Bytes& put(std::initializer_list<T> values) {
        for (const T value : values) {
            char bytes[sizeof(T)];
            std::memcpy(bytes, &value, sizeof(T));
            if (swapped_) std::reverse(bytes, bytes + sizeof(T));
            out_.append(bytes, sizeof(T));
        }
        return *this;
    }
    const std::string& str() const { return out_; }

private:
    std::string out_;
    bool swapped_;
};

}  // namespace femscalpel::checks
