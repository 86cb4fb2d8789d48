// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/flatten_parts.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>

#include "cancel.h"
#include "error.h"
#include "io/flat_cards.h"
#include "io/flat_lines.h"
#include "io/flat_to_calculix.h"

namespace femscalpel {
namespace {

/// Whether a card starts something of the model that is no property of a material.
bool ends_material(const Card& card) {
    constexpr std::string_view keywords[] = {
        "NODE",     "ELEMENT", "NSET",     "ELSET", "SURFACE", "ORIENTATION",  "SYSTEM",    "TRANSFORM",
        "COUPLING", "TIE",     "EQUATION", "MPC",   "MASS",    "DISTRIBUTION", "RIGIDBODY", "AMPLITUDE"};
    return card.keyword.ends_with("SECTION") || std::ranges::find(keywords, card.keyword) != std::end(keywords);
}

std::string range_text(const char* what, const std::array<Index, 2>& range) {
    if (range[0] == 0) return "no " + std::string(what) + "s";
    return std::string(what) + (range[0] == range[1]
                                    ? " " + std::to_string(range[0])
                                    : "s " + std::to_string(range[0]) + " to " + std::to_string(range[1]));
}

/// "instance A-2 of part A: nodes 2001 to 2125, elements 2001 to 2384 (numbers + 2000)".
std::string text_of(const DeckInstance& instance) {
    const std::string who =
        instance.part.empty() ? "assembly" : "instance " + instance.name + " of part " + instance.part;
    return who + ": " + range_text("node", instance.nodes) + ", " + range_text("element", instance.elements) +
           (instance.offset == 0 ? " (numbers as they were)" : " (numbers + " + std::to_string(instance.offset) + ")");
}

/// See flatten_parts().
class PartFlattener {
public:
    explicit PartFlattener(SolverInput& input)
        : input_(input), deck_(take_parts_apart(input.cards())), names_(deck_), cards_(names_, warnings_) {}

    void run() {
        for (const Card& card : input_.cards()) refuse_commas(card);
        for (std::size_t i = 0; i < deck_.instances.size(); ++i)
            record(deck_.instances[i].name, deck_.instances[i].part, names_.instance(i));
        record("", "", names_.assembly());
        add_note();
        cards_.enter(names_.assembly());
        for (const DeckItem& item : deck_.items) {
            check_cancelled();
            if (item.is_bracket)
                add_comments(comments_of(*item.card));
            else if (item.card)
                add(*item.card);
            else
                add_instance(item.instance);
        }
        fit_to_calculix(out_, warnings_);
        tell();
        input_.cards() = std::move(out_);
    }

private:
    static void refuse_commas(const Card& card) {
        for (const CardParameter& p : card.parameters)
            if (std::ranges::count(p.name + p.value, '"') % 2 != 0)
                throw ReadError(card.where() + ": a name in quotes of *" + card.keyword +
                                " has a comma, which no name of CalculiX can have; rename it");
    }

    void record(const std::string& name, const std::string& part, const FlatScope& scope) {
        const auto shifted = [&](const NumberRange& range) {
            const NumberRange out = range.shifted(scope.offset);
            return std::array<Index, 2>{out.first, out.last};
        };
        const DeckInstance instance{name, part, scope.offset, shifted(scope.nodes), shifted(scope.elements)};
        if (!part.empty() || instance.nodes[0] > 0 || instance.elements[0] > 0) input_.instances().push_back(instance);
    }

    /// Comment lines, at the place of a card of the user's file.
    void add_comment(const std::vector<std::string>& lines, const Card& at) {
        std::string text;
        for (const std::string& line : lines) text += "** " + line + eol(at);
        const DeckText& piece = at.text.front();
        const auto file = std::make_shared<const DeckFile>(DeckFile{piece.file->path, std::move(text)});
        add_comments({{file, file->text, piece.line}});
    }

    static std::string eol(const Card& card) {
        return card.text.front().text.find("\r\n") != std::string_view::npos ? "\r\n" : "\n";
    }

    /// Behind what is there already.
    void add_comments(const std::vector<DeckText>& texts) {
        if (out_.empty()) out_.emplace_back();
        out_.back().text.insert(out_.back().text.end(), texts.begin(), texts.end());
    }

    void add_note() {
        const Card& first = input_.cards().front();
        const std::string path = first.text.front().file->path;
        std::vector<std::string> lines{"Flat deck, put together from the parts and instances of " +
                                       std::filesystem::path(path).filename().string() + ". As read:"};
        for (const DeckInstance& instance : input_.instances()) lines.push_back(text_of(instance));
        lines.push_back("Names that several instances or the assembly have are INSTANCE_NAME.");
        add_comment(lines, first);
    }

    void add(const Card& card) {
        if (auto flat = cards_.flat(card))
            out_.push_back(std::move(*flat));
        else
            add_comments(comments_of(card));
    }

    void add_instance(std::size_t i) {
        const PartInstance& instance = deck_.instances[i];
        add_comment({"Instance " + instance.name + " of part " + instance.part}, *instance.card);
        add_comments(comments_of(*instance.card));
        cards_.enter(names_.instance(i));
        bool in_material = false;
        for (const Card* card : instance.cards) {
            if (card->keyword == "MATERIAL") in_material = true;
            if (ends_material(*card)) in_material = false;
            if (!in_material || instance.first) add(*card);
        }
        cards_.enter(names_.assembly());
    }

    void tell() {
        std::vector<std::string>& all = input_.warnings();
        std::string text = deck_.instances.front().card->where() + ": " + std::to_string(deck_.instances.size()) +
                           (deck_.instances.size() == 1 ? " instance of a part is" : " instances of parts are") +
                           " written out: ";
        constexpr std::size_t most = 8;
        const std::vector<DeckInstance>& instances = input_.instances();
        for (std::size_t i = 0; i < std::min(most, instances.size()); ++i)
            text += (i == 0 ? "" : "; ") + text_of(instances[i]);
        if (instances.size() > most)
            text +=
                "; and " + std::to_string(instances.size() - most) + " more, listed at the head of the deck as written";
        all.push_back(text);
        std::ranges::move(deck_.warnings, std::back_inserter(all));
        std::ranges::move(warnings_, std::back_inserter(all));
    }

    SolverInput& input_;
    PartDeck deck_;
    FlatNames names_;
    std::vector<std::string> warnings_;
    FlatCards cards_;
    std::vector<Card> out_;
};

}  // namespace

void flatten_parts(SolverInput& input) {
    if (std::ranges::find(input.cards(), "INSTANCE", &Card::keyword) != input.cards().end()) PartFlattener(input).run();
}

}  // namespace femscalpel
