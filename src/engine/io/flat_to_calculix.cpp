// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/flat_to_calculix.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <memory>
#include <unordered_set>
#include <utility>

#include "io/flat_lines.h"
#include "io/flat_names.h"

namespace femscalpel {
namespace {

/// A support by name and the degrees of freedom it holds (Abaqus Keywords Guide, *BOUNDARY).
struct NamedSupport {
    std::string_view name;
    std::array<std::pair<int, int>, 2> freedoms;  ///< from, to; 0: none
};

constexpr NamedSupport named_supports[] = {
    {"ENCASTRE", {{{1, 6}}}}, {"PINNED", {{{1, 3}}}}, {"XSYMM", {{{1, 1}, {5, 6}}}},  {"YSYMM", {{{2, 2}, {4, 4}}}},
    {"ZSYMM", {{{3, 5}}}},    {"XASYMM", {{{2, 4}}}}, {"YASYMM", {{{1, 1}, {3, 3}}}}, {"ZASYMM", {{{1, 2}, {6, 6}}}},
};

/// See fit_to_calculix().
class CalculixFit {
public:
    CalculixFit(std::vector<Card>& cards, std::vector<std::string>& warnings) : cards_(cards), warnings_(warnings) {}

    void run() {
        for (Card& card : cards_) {
            fit_head(card);
            if (card.keyword == "EQUATION") fit_terms(card);
            if (card.keyword == "BOUNDARY") fit_supports(card);
            if (card.keyword == "RIGIDBODY") fit_rigid_body(card);
            if (card.keyword == "KINEMATIC") fit_kinematic(card);
            if (card.keyword == "DLOAD") fit_loads_of_all(card);
        }
        if (!all_elements_.empty()) define_all_elements();
    }

private:
    void fit_head(Card& card) {
        std::vector<CardParameter> parameters = card.parameters;
        bool changed = false;
        for (CardParameter& p : parameters) {
            if ((p.name != "REFNODE" && p.name != "ROTNODE" && p.name != "NODE") || p.value.empty() ||
                whole_number(p.value))
                continue;
            const std::vector<Index> nodes = nodes_of_set(name_key(p.value));
            if (nodes.size() == 1) {
                p.value = std::to_string(nodes.front());
                changed = true;
            } else {
                warnings_.push_back(card.where() + ": " + p.name + "=" + p.value + " is " +
                                    (nodes.empty() ? "no set of a node" : "a set of several nodes") +
                                    "; CalculiX wants the number of one node");
            }
        }
        const std::string_view head =
            card.text.empty() ? std::string_view() : card.text.front().text.substr(0, card.head);
        if (changed || std::ranges::count(head, '\n') > 1) change_parameters(card, std::move(parameters));
    }

    void fit_terms(Card& card) {
        change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& where) {
            for (std::size_t k = 0; line.fields.size() > 1 && line.has(k); k += 3) {
                if (whole_number(line.fields[k])) continue;
                const std::vector<Index> nodes = nodes_of_set(name_key(line.fields[k]));
                if (nodes.size() == 1)
                    line.put(k, std::to_string(nodes.front()));
                else
                    warnings_.push_back(where() + "'" + unquoted(line.fields[k]) + "' of *EQUATION is " +
                                        (nodes.empty() ? "no set of a node" : "a set of several nodes") +
                                        "; CalculiX wants the number of one node");
            }
        });
    }

    /// The support of some directions and rotations is a line for each range of them: the others follow at the end.
    static void fit_supports(Card& card) {
        std::string more;
        change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& /*where*/) {
            if (!line.has(1)) return;
            const auto support = std::ranges::find(named_supports, name_key(line.fields[1]), &NamedSupport::name);
            if (support == std::end(named_supports)) return;
            const auto range = [](const std::pair<int, int>& f) {
                return std::to_string(f.first) + ", " + std::to_string(f.second);
            };
            line.put(1, range(support->freedoms[0]));
            if (support->freedoms[1].first != 0)
                more += std::string(line.fields[0]) + ", " + range(support->freedoms[1]) + "\n";
        });
        if (!more.empty()) append_line(card, std::move(more));
    }

    /// Of TIE NSET= and PIN NSET= CalculiX takes no notice, and nothing is rigid.
    void fit_rigid_body(Card& card) {
        std::vector<CardParameter> parameters = card.parameters;
        const auto of_nodes = std::ranges::find_if(
            parameters, [](const CardParameter& p) { return p.name == "TIENSET" || p.name == "PINNSET"; });
        if (of_nodes == parameters.end()) return;
        const auto other = std::ranges::find_if(parameters, [&](const CardParameter& p) {
            return &p != &*of_nodes &&
                   (p.name == "NSET" || p.name == "ELSET" || p.name == "TIENSET" || p.name == "PINNSET");
        });
        if (other != parameters.end()) {
            warnings_.push_back(card.where() + ": *RIGID BODY has " + other->name + "= and " + of_nodes->name +
                                "=; CalculiX takes one set alone: put all of its nodes in one");
            return;
        }
        if (of_nodes->name == "PINNSET")
            warnings_.push_back(card.where() +
                                ": PIN NSET= of *RIGID BODY becomes NSET=: CalculiX holds rotations of shells and "
                                "beams there, too");
        of_nodes->name = "NSET";
        change_parameters(card, std::move(parameters));
    }

    /// Without lines all degrees of freedom are meant, of which CalculiX takes the translations; without lines it would
    /// couple nothing, and with rotations it stops.
    void fit_kinematic(Card& card) {
        bool any = false, translates = false, rotates = false;
        change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& /*where*/) {
            const auto first = whole_number(line.fields[0]);
            if (!first) return;
            any = true;
            const Index last = line.has(1) ? whole_number(line.fields[1]).value_or(*first) : *first;
            translates = translates || *first <= 3;
            rotates = rotates || last > 3;
            if (last <= 3) return;
            if (*first <= 3)
                line.put(1, "3");
            else
                line.put(0, "** " + std::string(line.fields[0]));
        });
        if (any && !rotates) return;
        if (!any) append_line(card, "1, 3\n");
        warnings_.push_back(card.where() + (any && !translates
                                                ? ": *KINEMATIC of rotations alone: CalculiX couples translations, and "
                                                  "stops here; say another constraint"
                                                : ": *KINEMATIC: CalculiX couples degrees of freedom 1 to 3 alone; "
                                                  "rotations of shells and beams there are free"));
    }

    static void append_line(Card& card, std::string line) {
        const DeckText last = card.text.back();
        if (!last.text.ends_with('\n')) line.insert(0, "\n");
        const auto file = std::make_shared<const DeckFile>(DeckFile{last.file->path, std::move(line)});
        card.text.push_back({file, file->text, last.line});
    }

    /// Loads without a set are those of the whole model; CalculiX ends without a word there.
    void fit_loads_of_all(Card& card) {
        change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& where) {
            if (line.has(0) || !line.has(1)) return;
            if (all_elements_.empty()) {
                name_all_elements();
                warnings_.push_back(
                    where() +
                    "a load without a set is that of the whole model; CalculiX wants a set: " + all_elements_);
            }
            line.put(0, all_elements_);
        });
    }

    void name_all_elements() {
        std::unordered_set<std::string> taken;
        for (const Card& card : cards_)
            if (const CardParameter* name = defined_name(card)) taken.insert(name_key(name->value));
        all_elements_ = "ALL_ELEMENTS";
        for (int n = 2; taken.contains(all_elements_); ++n) all_elements_ = "ALL_ELEMENTS_" + std::to_string(n);
    }

    /// All that have mass, before the first step.
    void define_all_elements() {
        std::string text = "*ELSET, ELSET=" + all_elements_ + "\n";
        for (const Card& card : cards_) {
            const std::string* type = card.keyword == "ELEMENT" ? card.parameter("TYPE") : nullptr;
            const std::string label = type ? deck_key(*type) : "";
            if (!type || label.starts_with("SPRING") || label.starts_with("DASHPOT") || label.starts_with("GAP") ||
                label.starts_with("CONN") || label.starts_with("DCOUP"))
                continue;
            for (const Index id : elements_of(card)) text += std::to_string(id) + ",\n";
        }
        auto at = std::ranges::find(cards_, "STEP", &Card::keyword);
        Card set;
        set.set_text(std::move(text));
        cards_.insert(at, std::move(set));
    }

    /// Nodes of a set by number; of what else is in it, which are never single nodes, no more than twice 0.
    std::vector<Index> nodes_of_set(const std::string& key) const {
        std::vector<Index> out;
        for (const Card& card : cards_) {
            const CardParameter* name = defined_name(card);
            if (!name || name_key(name->value) != key || (card.keyword != "NSET" && card.keyword != "NODE")) continue;
            CardReader line(card);
            const int most = card.keyword == "NODE" ? 1 : card.parameter("GENERATE") ? 2 : 16;
            while (out.size() < 3 && line.next_data_line())
                for (int k = 0; k < most && !line.at_end(); ++k)
                    if (Index id = 0; line.integer(id))
                        out.push_back(id);
                    else if (!line.field().empty())
                        out.insert(out.end(), 2, 0);
        }
        std::ranges::sort(out);
        if (!std::ranges::count(out, 0)) out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }

    std::vector<Card>& cards_;
    std::vector<std::string>& warnings_;
    std::string all_elements_;  // name of the set of them; empty while none is wanted
};

}  // namespace

void fit_to_calculix(std::vector<Card>& cards, std::vector<std::string>& warnings) {
    CalculixFit(cards, warnings).run();
}

}  // namespace femscalpel
