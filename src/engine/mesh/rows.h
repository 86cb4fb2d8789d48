// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace femscalpel {

/// Short lists of numbers, one per row, that may grow: all in one array, which a list that outgrows its place
/// moves to the end of. Much cheaper to make and to walk over than a vector of vectors.
class Rows {
public:
    std::span<const int> operator[](int row) const {
        const Row& r = rows_[row];
        return {pool_.data() + r.start, static_cast<std::size_t>(r.count)};
    }

    void resize(std::size_t rows) { rows_.resize(rows); }

    /// Makes room for so many entries in each row; only while there are none.
    void reserve(const std::vector<int>& counts) {
        rows_.resize(counts.size());
        int start = 0;
        for (std::size_t r = 0; r < counts.size(); ++r) {
            rows_[r] = {start, 0, counts[r]};
            start += counts[r];
        }
        pool_.resize(static_cast<std::size_t>(start));
    }

    void add(int row, int value) {
        Row& r = rows_[row];
        if (r.count == r.room) {
            const int start = static_cast<int>(pool_.size());
            r.room = 2 * r.count + 4;
            pool_.resize(pool_.size() + static_cast<std::size_t>(r.room));
            std::copy_n(pool_.begin() + r.start, r.count, pool_.begin() + start);
            r.start = start;
        }
        pool_[r.start + r.count++] = value;
    }

    void replace(int row, int value, int by) { std::ranges::replace(values(row), value, by); }

    void remove(int row, int value) {
        const auto rest = std::ranges::remove(values(row), value);
        rows_[row].count -= static_cast<int>(rest.size());
    }

    void clear(int row) { rows_[row].count = 0; }

private:
    struct Row {
        int start = 0;
        int count = 0;
        int room = 0;
    };
    std::span<int> values(int row) {
        return {pool_.data() + rows_[row].start, static_cast<std::size_t>(rows_[row].count)};
    }

    std::vector<Row> rows_;
    std::vector<int> pool_;
};

}  // namespace femscalpel
