// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace femscalpel {

/// The elements around a node of the interface, numbered 0, 1, 2, ... by who asks, and the parts in which they hang
/// together. A part is known by its first element.
class NodeParts {
public:
    explicit NodeParts(int elements);

    /// Says on which side of the tool an element is (1 or -1), and whether it has an open edge at the node.
    void describe(int element, int side, bool touches) { elements_[element] = {side, touches}; }

    /// Puts the parts of two elements together.
    void unite(int a, int b);

    /// Sums up the parts, when all elements are described and united.
    void sum_up();

    /// The part an element goes with, or -1: its own, or, where that hangs on in the node alone, the largest of those
    /// on its side that do not, else of all that do not.
    int goes_with(int element);

    /// The part that keeps the node, or -1: of those that do not hang on in it alone the largest on the negative side,
    /// else the largest.
    int keeper() const;

    /// Of the parts that do not hang on in the node alone all but keeper(), and whether they are on the positive side.
    std::vector<std::pair<int, bool>> parted() const;

private:
    struct Element {
        int side = -1;
        bool touches = false;
    };
    struct Part {
        int size = 0, side = 0;
        bool touches = false;
    };

    int find(int element);
    int largest(std::optional<bool> positive) const;

    std::vector<Element> elements_;
    std::vector<int> part_;  // by element: one before it in its part, in the end the first
    std::map<int, Part> parts_;
};

}  // namespace femscalpel
