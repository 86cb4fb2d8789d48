// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cancel.h"
#include "mesh/mesh.h"

namespace femscalpel {

/// Edges (N = 2) or faces (N = 4; the fourth node of a triangle is -1) by their corner nodes in any order; open
/// addressing, entries in the order of insertion. Nodes are kept in 32 bits, because a large group is bound by memory.
template <std::size_t N>
class EntityTable {
public:
    using Key = std::array<std::uint32_t, N>;
    /// An entity, and what is known of it so far.
    struct Entry {
        Key given;               ///< the nodes, in their order
        Key key;                 ///< ascending
        std::uint32_t apex = 0;  ///< of the last element of the area on it: its smallest node off the entity
        std::uint8_t areas = 0;  ///< elements of the area on it; 2 stands for more, too
        bool belongs = false;    ///< to the group
        bool covered = false;    ///< by something larger

        std::array<Index, N> nodes() const {
            std::array<Index, N> out;
            for (std::size_t k = 0; k < N; ++k) out[k] = given[k] == no_node ? Index{-1} : static_cast<Index>(given[k]);
            return out;
        }
        /// Puts the nodes in this order.
        void turn(const std::array<Index, N>& nodes) { given = compact(nodes); }
    };

    /// The entry of these nodes; made if new.
    Entry& insert(const std::array<Index, N>& nodes) {
        check_();
        if (2 * (entries_.size() + 1) > slots_.size()) grow();
        const Key key = sorted(nodes);
        const std::size_t h = place(key);
        if (slots_[h] == empty) {
            slots_[h] = static_cast<std::uint32_t>(entries_.size());
            entries_.push_back({compact(nodes), key});
        }
        return entries_[slots_[h]];
    }

    /// The entry of these nodes, or null.
    Entry* find(const std::array<Index, N>& nodes) {
        if (entries_.empty()) return nullptr;
        const std::uint32_t e = slots_[place(sorted(nodes))];
        return e == empty ? nullptr : &entries_[e];
    }

    std::vector<Entry>& entries() { return entries_; }

private:
    static constexpr std::uint32_t no_node = 0xffffffffu;
    static constexpr std::uint32_t empty = 0xffffffffu;

    static Key compact(const std::array<Index, N>& nodes) {
        Key out;
        for (std::size_t k = 0; k < N; ++k) out[k] = static_cast<std::uint32_t>(nodes[k]);
        return out;
    }

    static Key sorted(const std::array<Index, N>& nodes) {
        Key key = compact(nodes);
        std::ranges::sort(key);
        return key;
    }

    std::size_t place(const Key& key) const {
        std::uint64_t h = 0;
        for (const std::uint32_t n : key) {
            h = (h ^ n) * 0x9e3779b97f4a7c15u;
            h ^= h >> 32;
        }
        const std::size_t mask = slots_.size() - 1;
        std::size_t at = h & mask;
        while (slots_[at] != empty && entries_[slots_[at]].key != key) at = (at + 1) & mask;
        return at;
    }

    void grow() {
        slots_.assign(std::max<std::size_t>(64, 2 * slots_.size()), empty);
        for (std::size_t e = 0; e < entries_.size(); ++e) {
            check_();
            slots_[place(entries_[e].key)] = static_cast<std::uint32_t>(e);
        }
    }

    std::vector<std::uint32_t> slots_;
    std::vector<Entry> entries_;
    SparseCheck check_;
};

}  // namespace femscalpel
