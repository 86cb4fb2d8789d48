// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "cancel.h"
#include "error.h"
#include "io/bdf.h"
#include "io/bdf_sets.h"
#include "io/bdf_source.h"
#include "io/bdf_types.h"
#include "io/group_numbers.h"
#include "io/inp_file.h"
#include "io/lost_digits.h"
#include "utf8.h"

namespace femscalpel {
namespace {

constexpr Index largest_bdf_number = 99999999;  // what fields of eight characters hold, and Nastran
constexpr std::size_t real_width = 16;
constexpr std::size_t longest_statement = 70;

/// A number as Nastran reads it, in so many digits: with a point, and an exponent without a letter.
std::string nastran_form(double value, std::chars_format format, int digits) {
    char text[64];
    const auto end = digits < 0 ? std::to_chars(text, text + sizeof text, value, format).ptr
                                : std::to_chars(text, text + sizeof text, value, format, digits).ptr;
    std::string out(text, end);
    std::string exponent;
    if (const std::size_t e = out.find('e'); e != out.npos) {
        exponent = out.substr(e + 1);
        out.resize(e);
        const std::size_t zeros = exponent.find_first_not_of('0', 1);
        exponent = zeros == exponent.npos ? "" : exponent[0] + exponent.substr(zeros);
    }
    if (out.find('.') == out.npos)
        out += '.';
    else
        while (out.ends_with('0')) out.pop_back();
    // A zero before the point costs a place.
    if (out.starts_with("0.") && out.size() > 2) out.erase(0, 1);
    if (out.starts_with("-0.") && out.size() > 3) out.erase(1, 1);
    return out + exponent;
}

/// The nearest number that a large field holds.
std::string real_field(double value) {
    std::string best;
    double error = std::numeric_limits<double>::infinity();
    const auto look = [&](std::string text) {
        if (text.size() > real_width) return;
        const auto back = bdf_real(text);
        if (!back) return;
        const double off = std::abs(*back - value);
        if (off < error || (off == error && text.size() < best.size())) {
            best = std::move(text);
            error = off;
        }
    };
    const bool plain = value == 0 || (std::abs(value) >= 1e-4 && std::abs(value) < 1e15);
    if (plain) look(nastran_form(value, std::chars_format::fixed, -1));
    if (error > 0) look(nastran_form(value, std::chars_format::scientific, -1));
    for (int digits = 16; error > 0 && digits > 8; --digits) {
        if (plain) look(nastran_form(value, std::chars_format::fixed, digits));
        look(nastran_form(value, std::chars_format::scientific, digits));
    }
    if (!best.empty()) return best;
    // Rounded up, the largest numbers are infinite.
    best = nastran_form(value, std::chars_format::scientific, 16);
    const std::size_t exponent = best.find_last_of("+-"), long_by = best.size() - real_width;
    return best.erase(exponent - long_by, long_by);
}

class BdfWriter {
public:
    BdfWriter(const Mesh& mesh, std::string shown) : mesh_(mesh), shown_(std::move(shown)) {}

    std::string text() {
        check();
        out_ = "$ Written by FemScalpel\n" + std::string(bdf_stand_ins) + "\n";
        put_sets();
        out_ += "BEGIN BULK\n";
        put_nodes();
        put_elements();
        out_ += "ENDDATA\n";
        return std::move(out_);
    }

private:
    void check() const {
        if (mesh_.points.empty()) throw WriteError(shown_ + ": the mesh has no nodes");
        for (const CellBlock& block : mesh_.blocks())
            if (block.size() > 0 && bdf_card(block.type).empty())
                throw WriteError(shown_ + ": the mesh has " + std::to_string(block.size()) + " elements of type " +
                                 std::string(traits(block.type).name) +
                                 ", which Nastran does not have; write another format, as .med");
        const Index largest = std::max(mesh_.largest_node_id(), mesh_.largest_cell_id());
        if (largest > largest_bdf_number)
            throw WriteError(shown_ + ": Nastran has numbers up to " + std::to_string(largest_bdf_number) +
                             ", the mesh has " + std::to_string(largest));
        for (const Group& group : mesh_.groups)
            if (!group.hidden && group.kind != GroupKind::facet &&
                (group.name.empty() ||
                 std::ranges::any_of(group.name, [](char c) { return c == '"' || (c >= 0 && c < ' '); })))
                throw WriteError(shown_ +
                                 ": names of groups in Nastran decks are not empty and have no quotation marks or "
                                 "control characters; rename the group '" +
                                 group.name + "'");
    }

    void put_right(Index value, std::size_t width) {
        const std::string text = std::to_string(value);
        out_.append(width - std::min(width, text.size()), ' ');
        out_ += text;
    }

    void put_left(std::string_view text, std::size_t width) {
        out_ += text;
        out_.append(width - std::min(width, text.size()), ' ');
    }

    void put_nodes() {
        SparseCheck check(1 << 12);
        for (std::size_t n = 0; n < mesh_.points.size(); ++n, check()) {
            out_ += "GRID*   ";
            put_right(mesh_.node_ids[n], real_width);
            out_.append(real_width, ' ');  // the basic system
            for (int a = 0; a < 3; ++a) {
                put_left(real_field(mesh_.points[n][a]), a < 2 ? real_width : 0);
                if (a == 1) out_ += "\n*       ";
            }
            out_ += '\n';
        }
    }

    void put_elements() {
        SparseCheck check(1 << 12);
        for (const CellBlock& block : mesh_.blocks()) {
            if (block.size() == 0) continue;
            const std::string_view name = bdf_card(block.type);
            const auto order = bdf_order(block.type);
            const auto count = static_cast<std::size_t>(traits(block.type).nodes);
            for (Index c = 0; c < block.size(); ++c, check()) {
                put_left(name, 8);
                put_right(block.ids[static_cast<std::size_t>(c)], 8);
                put_right(1, 8);
                const auto nodes = block.nodes(c);
                for (std::size_t k = 0; k < count; ++k) {
                    if (k >= 6 && (k - 6) % 8 == 0) out_ += "\n+       ";
                    put_right(mesh_.node_ids[nodes[static_cast<std::size_t>(order[k])]], 8);
                }
                out_ += '\n';
            }
        }
    }

    void put_sets() {
        auto all = group_numbers(mesh_);
        Index number = 0;
        std::string statements;
        for (std::size_t g = 0; g < all.size(); ++g) {
            const Group& group = mesh_.groups[g];
            if (group.hidden || group.kind == GroupKind::facet) continue;
            out_ += "$HMSET " + std::to_string(++number) + (group.kind == GroupKind::node ? " 1 \"" : " 2 \"") +
                    group.name + "\"\n";
            std::ranges::sort(all[g]);
            if (!all[g].empty()) put_statement("SET " + std::to_string(number) + " =", all[g], statements);
        }
        out_ += "SOL 101\nCEND\n" + statements;
    }

    static void put_statement(std::string line, const std::vector<Index>& ids, std::string& out) {
        for (std::size_t k = 0; k < ids.size();) {
            std::size_t end = k + 1;  // of consecutive numbers
            while (end < ids.size() && ids[end] == ids[end - 1] + 1) ++end;
            std::string item = " " + std::to_string(ids[k]);
            if (end - k > 2)
                item += " THRU " + std::to_string(ids[end - 1]);
            else
                end = k + 1;
            if (end < ids.size()) item += ',';
            if (line.size() + item.size() > longest_statement) {
                out += line + '\n';
                line = "  ";
            }
            line += item;
            k = end;
        }
        out += line + '\n';
    }

    const Mesh& mesh_;
    std::string shown_;
    std::string out_;
};

}  // namespace

void write_bdf(const Mesh& mesh, const std::filesystem::path& path) {
    save_text(path, BdfWriter(mesh, shown_path(path)).text());
}

std::vector<std::string> bdf_losses(const Mesh& mesh) {
    std::vector<std::string> out;
    for (const Group& group : mesh.groups)
        if (!group.hidden && group.kind == GroupKind::facet) out.push_back("the facet group '" + group.name + "'");
    const LostDigits lost(mesh, [](double value) { return *bdf_real(real_field(value)); });
    if (auto told = lost.told()) out.push_back(std::move(*told));
    if (!mesh.unit.empty()) out.push_back("the unit '" + mesh.unit + "'");
    return out;
}

}  // namespace femscalpel
