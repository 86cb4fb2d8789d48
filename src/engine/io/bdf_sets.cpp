// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/bdf_sets.h"

#include <algorithm>
#include <charconv>

namespace femscalpel {
namespace {

std::optional<Index> bdf_number(std::string_view word) {
    Index value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || stop != word.data() + word.size()) return {};
    return value;
}

std::vector<std::string> bdf_words(std::string_view text, std::string_view between = ", \t") {
    std::vector<std::string> out;
    for (std::size_t at = 0; (at = text.find_first_not_of(between, at)) != text.npos;) {
        const std::size_t end = std::min(text.size(), text.find_first_of(between, at));
        out.emplace_back(text.substr(at, end - at));
        at = end;
    }
    return out;
}

constexpr std::string_view node_requests[] = {"DISP", "VECT", "PRES", "VELO", "ACCE", "SPCF",
                                              "MPCF", "OLOA", "THER", "TEMP", "GPFO", "SVEC"};
constexpr std::string_view element_requests[] = {"STRE", "ELST", "STRA", "FORC", "ELFO", "ESE", "EDE", "EKE", "FLUX"};

/// The name in a HyperMesh comment: $HMSET 1 2 "name".
std::string bdf_quoted(std::string_view text) {
    const std::size_t first = text.find('"'), last = text.rfind('"');
    return first == text.npos || last == first ? std::string() : std::string(text.substr(first + 1, last - first - 1));
}

std::string bdf_trimmed(std::string text) {
    while (text.ends_with(' ')) text.pop_back();
    text.erase(0, text.find_first_not_of(' '));
    return text;
}

}  // namespace

bool BdfNumbers::parse(const std::vector<std::string>& words) {
    for (std::size_t k = 0; k < words.size(); ++k) {
        if (words[k] == "EXCEPT") {
            if (ranges_.empty()) return false;
            Range& range = ranges_.back();
            for (; k + 1 < words.size(); ++k) {
                const auto number = bdf_number(words[k + 1]);
                // What is beyond the range is a member again.
                if (!number || *number > range.last || (k + 2 < words.size() && words[k + 2] == "THRU")) break;
                range.except.push_back(*number);
            }
            continue;
        }
        const auto first = bdf_number(words[k]);
        if (!first) return false;
        if (k + 1 >= words.size() || words[k + 1] != "THRU") {
            single_.push_back(*first);
            continue;
        }
        const auto last = k + 2 < words.size() ? bdf_number(words[k + 2]) : std::nullopt;
        if (!last) return false;
        k += 2;
        Index step = 1;
        if (k + 2 < words.size() && words[k + 1] == "BY") {
            const auto by = bdf_number(words[k + 2]);
            if (!by || *by <= 0) return false;
            step = *by;
            k += 2;
        }
        ranges_.push_back({*first, *last, step, {}});
    }
    return true;
}

std::vector<Index> BdfNumbers::among(const std::vector<Index>& sorted) const {
    std::vector<Index> out;
    for (const Index n : single_)
        if (std::ranges::binary_search(sorted, n)) out.push_back(n);
    for (const Range& r : ranges_)
        for (auto at = std::ranges::lower_bound(sorted, r.first); at != sorted.end() && *at <= r.last; ++at)
            if ((*at - r.first) % r.step == 0 && std::ranges::find(r.except, *at) == r.except.end()) out.push_back(*at);
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

Index BdfNumbers::absent(const std::vector<Index>& sorted) const {
    return std::ranges::count_if(single_, [&](Index n) { return !std::ranges::binary_search(sorted, n); });
}

std::vector<BdfSet> bdf_sets(const BdfSource& source, Index& others) {
    std::vector<BdfSet> out;
    std::vector<std::pair<std::string, Index>> requests;
    others = 0;
    for (const BdfStatement& s : source.statements()) {
        const std::size_t equals = s.text.find('=');
        const std::vector<std::string> head = bdf_words(std::string_view(s.text).substr(0, equals), " \t(");
        if (head.size() == 2 && head[0] == "SET" && equals != s.text.npos && bdf_number(head[1])) {
            BdfSet set{*bdf_number(head[1]), s.at, BdfNumbers(), false, false};
            const std::vector<std::string> words = bdf_words(std::string_view(s.text).substr(equals + 1));
            if (words.empty() || !set.numbers->parse(words)) set.numbers.reset();
            out.push_back(std::move(set));
            continue;
        }
        others += s.text != "CEND" && !s.text.starts_with("SOL ");
        if (equals == s.text.npos || head.empty()) continue;
        const std::vector<std::string> value = bdf_words(std::string_view(s.text).substr(equals + 1));
        if (value.size() == 1)
            if (const auto number = bdf_number(value[0])) requests.emplace_back(head[0], *number);
    }
    for (BdfSet& set : out)
        for (const auto& [request, number] : requests) {
            const auto is = [&, &word = request](std::string_view begin) { return word.starts_with(begin); };
            if (number != set.number) continue;
            set.of_nodes = set.of_nodes || std::ranges::any_of(node_requests, is);
            set.of_elements = set.of_elements || std::ranges::any_of(element_requests, is);
        }
    return out;
}

BdfNames bdf_names(const BdfSource& source) {
    BdfNames out;
    for (const std::string_view line : source.comments()) {
        if (line == bdf_stand_ins) out.stand_ins = true;
        const std::vector<std::string> words = bdf_words(line.substr(0, line.find('"')), " \t");
        const auto number = [&](std::size_t k) {
            return k < words.size() ? bdf_number(words[k]) : std::optional<Index>();
        };
        if (words.size() >= 3 && words[0] == "$HMSET" && number(1) && number(2)) {
            if (const Index kind = *number(2); kind == 1 || kind == 2)
                out.sets.push_back({*number(1), kind == 1 ? GroupKind::node : GroupKind::element, bdf_quoted(line)});
        } else if (words.size() >= 3 && words[0] == "$HMNAME" && words[1] == "PROP" && number(2)) {
            if (std::string name = bdf_quoted(line); !name.empty()) out.properties.emplace(*number(2), std::move(name));
        } else if (line.starts_with("$ANSA_NAME_COMMENT;")) {
            // $ANSA_NAME_COMMENT;3;PSHELL;the name;...
            const std::vector<std::string> parts = bdf_words(line, ";");
            if (parts.size() > 3 && bdf_number(parts[1]) && parts[2].starts_with('P') && parts[2] != "PART")
                out.properties.emplace(*bdf_number(parts[1]), bdf_trimmed(parts[3]));
        } else if (words.size() > 2 && line.starts_with("$ Femap")) {
            const auto property = std::ranges::find(words, "Property");
            const std::size_t colon = line.find(':');
            if (property != words.end() && property + 1 != words.end() && colon != line.npos)
                if (const auto id = bdf_number(*(property + 1)))
                    out.properties.emplace(*id, bdf_trimmed(std::string(line.substr(colon + 1))));
        }
    }
    return out;
}

}  // namespace femscalpel
