// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mutate.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <utility>

namespace femscalpel::checks {

namespace {

/// What readers of numbers are seldom tried with.
constexpr std::array numbers = {"-1",
                                "0",
                                "1",
                                "2",
                                "1e308",
                                "-1e308",
                                "1e-320",
                                "nan",
                                "inf",
                                "1e999",
                                "1.5",
                                "+",
                                "-",
                                "1d5",
                                "0x10",
                                "1-5",
                                "",
                                "1 2",
                                ",",
                                "\"",
                                "=",
                                "*",
                                "%",
                                "\xff",
                                "1e",
                                ".",
                                "10000000",
                                "2147483647",
                                "2147483648",
                                "4294967296",
                                "-9223372036854775808",
                                "9223372036854775807",
                                "99999999999999999999999999"};
constexpr std::array<std::uint64_t, 12> words = {
    0, 1, 2, 0x7f, 0xff, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff, 1ULL << 32, ~0ULL, 0x7ff8'0000'0000'0000};

class Mutation {
public:
    Mutation(std::string& file, const std::string& other, Random& random)
        : file_(file), other_(other), random_(random) {}

    void one() {
        switch (pick(14)) {
            case 0:
                return change_byte();
            case 1:
                return flip_bit();
            case 2:
                return change_word();
            case 3:
                return change_number();
            case 4:
                return change_number();
            case 5:
                return exchange_numbers();
            case 6:
                return leave_out_line();
            case 7:
                return double_lines();
            case 8:
                return exchange_lines();
            case 9:
                return cut_off();
            case 10:
                return leave_out();
            case 11:
                return bring_in();
            case 12:
                return bring_in_lines();
            default:
                return zero();
        }
    }

private:
    using Range = std::pair<std::size_t, std::size_t>;  // from, size

    std::size_t pick(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_.bits() % n); }

    /// Small ones more often.
    std::size_t some(std::size_t most) { return std::min(most, pick(std::size_t{1} << pick(12)) + 1); }

    void change_byte() {
        if (!file_.empty()) file_[pick(file_.size())] = static_cast<char>(random_.bits());
    }

    void flip_bit() {
        if (!file_.empty()) file_[pick(file_.size())] ^= static_cast<char>(1 << pick(8));
    }

    void change_word() {
        const std::uint64_t word = words[pick(words.size())];
        const std::size_t size = pick(2) ? 4 : 8;
        if (file_.size() >= size) std::memcpy(&file_[pick(file_.size() - size + 1)], &word, size);
    }

    Range number() {
        const auto is_part = [&](char c) {
            return std::isdigit(static_cast<unsigned char>(c)) || std::strchr("+-.eE", c) != nullptr;
        };
        std::size_t from = file_.find_first_of("0123456789", pick(file_.size()));
        if (from == std::string::npos) return {0, 0};
        std::size_t to = from;
        while (from > 0 && file_[from - 1] && is_part(file_[from - 1])) --from;
        while (to < file_.size() && file_[to] && is_part(file_[to])) ++to;
        return {from, to - from};
    }

    void change_number() {
        const Range at = number();
        file_.replace(at.first, at.second, numbers[pick(numbers.size())]);
    }

    void exchange_numbers() {
        const Range a = number();
        const std::string text = file_.substr(a.first, a.second);
        const Range b = number();
        file_.replace(b.first, b.second, text);
    }

    Range lines(std::size_t count) {
        std::size_t from = file_.rfind('\n', pick(file_.size()));
        from = from == std::string::npos ? 0 : from + 1;
        std::size_t to = from;
        for (; count > 0 && to < file_.size(); --count) to = std::min(file_.find('\n', to), file_.size() - 1) + 1;
        return {from, to - from};
    }

    void leave_out_line() {
        const Range at = lines(some(4));
        file_.erase(at.first, at.second);
    }

    void double_lines() {
        const Range at = lines(some(20));
        const std::string text = file_.substr(at.first, at.second);
        file_.insert(lines(1).first, text);
    }

    void exchange_lines() {
        const Range a = lines(1);
        const std::string text = file_.substr(a.first, a.second);
        file_.erase(a.first, a.second);
        file_.insert(lines(1).first, text);
    }

    void cut_off() {
        if (pick(3) == 0) file_.resize(pick(file_.size() + 1));
    }

    void leave_out() {
        if (!file_.empty()) file_.erase(pick(file_.size()), some(file_.size()));
    }

    void bring_in() {
        if (other_.empty()) return;
        const std::string piece = other_.substr(pick(other_.size()), some(other_.size()));
        const std::size_t at = pick(file_.size() + 1);
        if (pick(2))
            file_.insert(at, piece);
        else
            file_.replace(at, std::min(piece.size(), file_.size() - at), piece);
    }

    void bring_in_lines() {
        std::string whole = other_;
        Mutation from(whole, file_, random_);
        const Range at = from.lines(some(30));
        file_.insert(lines(1).first, whole, at.first, at.second);
    }

    void zero() {
        if (file_.empty()) return;
        const std::size_t at = pick(file_.size()), size = std::min(some(64), file_.size() - at);
        std::fill_n(file_.begin() + static_cast<std::ptrdiff_t>(at), size, pick(2) ? '\0' : '\xff');
    }

    std::string& file_;
    const std::string& other_;
    Random& random_;
};

}  // namespace

std::string mutated(std::string file, const std::string& other, Random& random) {
    Mutation mutation(file, other, random);
    for (std::uint64_t k = 1 + random.bits() % 4; k > 0; --k) mutation.one();
    return file;
}

}  // namespace femscalpel::checks
