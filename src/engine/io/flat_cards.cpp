// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/flat_cards.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "deck/rules/nameless_cards.h"
#include "error.h"
#include "io/abaqus_cards.h"
#include "io/inp_numbers.h"

namespace femscalpel {
namespace {

/// Where the data lines of a card hold numbers and names of nodes, elements, sets and surfaces.
enum class Entries : std::uint8_t {
    nowhere,
    first,
    first_two,
    all,
    all_but_first,
    node,
    element,
    set,
    surface,
    equation
};

struct CardForm {
    std::string_view keyword;
    Entries entries;
    Numbered what = Numbered::either;
    /// In an instance that is turned: the lines have no direction in them.
    bool turns = true;
};

constexpr CardForm forms[] = {
    {"NODE", Entries::node},
    {"ELEMENT", Entries::element},
    {"NSET", Entries::set, Numbered::node},
    {"ELSET", Entries::set, Numbered::element},
    {"SURFACE", Entries::surface},
    {"BOUNDARY", Entries::first, Numbered::node, false},
    {"BOUNDARYF", Entries::first, Numbered::element, false},
    {"CFLUX", Entries::first, Numbered::node},
    {"CLOAD", Entries::first, Numbered::node, false},
    {"CONTACTPAIR", Entries::all},
    {"DFLUX", Entries::first, Numbered::element},
    {"DESIGNVARIABLES", Entries::all, Numbered::node},
    {"DISTRIBUTION", Entries::first},
    {"DISTRIBUTINGCOUPLING", Entries::first, Numbered::node},
    {"DLOAD", Entries::first, Numbered::element, false},
    {"DSFLUX", Entries::first},
    {"DSLOAD", Entries::first, Numbered::either, false},
    {"EQUATION", Entries::equation, Numbered::node, false},
    {"FIELD", Entries::first, Numbered::node},
    {"FILM", Entries::first, Numbered::element},
    {"INITIALCONDITIONS", Entries::first, Numbered::either, false},
    {"DASHPOT", Entries::nowhere, Numbered::either, false},
    {"KINEMATIC", Entries::nowhere, Numbered::either, false},
    {"KINEMATICCOUPLING", Entries::first, Numbered::node, false},
    {"MASSFLOW", Entries::first, Numbered::element},
    {"MODELCHANGE", Entries::all, Numbered::element},
    {"MPC", Entries::all_but_first, Numbered::node},
    {"NETWORKMPC", Entries::equation, Numbered::node, false},
    {"NODALTHICKNESS", Entries::first, Numbered::node},
    {"NORMAL", Entries::first_two},
    {"RADIATE", Entries::first, Numbered::element},
    {"RETAINEDNODALDOFS", Entries::first, Numbered::node, false},
    {"SFILM", Entries::first},
    {"SPRING", Entries::nowhere, Numbered::either, false},
    {"SRADIATE", Entries::first},
    {"SUBMODEL", Entries::all},
    {"TEMPERATURE", Entries::first, Numbered::node},
    {"TIE", Entries::all},
    {"BASEMOTION", Entries::nowhere, Numbered::either, false},
    {"ROTARYINERTIA", Entries::nowhere, Numbered::either, false},
    {"PRE-TENSIONSECTION", Entries::nowhere, Numbered::either, false},
    {"MONITOR", Entries::nowhere},
    {"RESTART", Entries::nowhere},
};

/// None for cards that neither CalculiX nor the table knows.
std::optional<CardForm> form_of(const Card& card) {
    const auto* it = std::ranges::find(forms, std::string_view(card.keyword), &CardForm::keyword);
    if (it != std::end(forms)) return *it;
    if (NamelessCards().takes(card) || is_nameless_in_abaqus(card.keyword))
        return CardForm{card.keyword, Entries::nowhere};
    return {};
}

bool is_true_for(const Card& card, std::string_view parameter, std::initializer_list<std::string_view> values,
                 std::string_view otherwise) {
    const std::string* value = card.parameter(parameter);
    const std::string key = value ? name_key(*value) : std::string(otherwise);
    return std::ranges::find(values, std::string_view(key)) != values.end();
}

/// Whether a spring or dashpot has the direction from node to node: its line of degrees of freedom is empty.
bool acts_along_its_nodes(const Card& card) {
    if (card.keyword != "SPRING" && card.keyword != "DASHPOT") return false;
    CardReader line(card);
    Index freedom = 0;
    return !line.next_data_line() || !line.integer(freedom);
}

}  // namespace

void FlatCards::enter(const FlatScope& scope) {
    scope_ = &scope;
    system_ = {};
}

void FlatCards::refuse_turned(const std::string& where, const std::string& what) const {
    throw ReadError(where + what + ", and " + scope_->label +
                    " is moved or turned: what it would be there is not known. Take it out of the part and say it in "
                    "the assembly");
}

void FlatCards::translate(LineFields& line, std::size_t k, const FlatScope& scope, Numbered what,
                          const Where& where) const {
    if (k >= line.fields.size()) return;
    if (auto text = names_.number_or_name(scope, line.fields[k], what,
                                          [&](const std::string& wrong) { throw ReadError(where() + wrong); }))
        line.put(k, std::move(*text));
}

std::optional<Card> FlatCards::flat(const Card& original) {
    if (original.keyword == "SYSTEM") {
        system_ = placement_of_system(original);
        return {};
    }
    Card card = original;
    const std::string* of_instance =
        card.keyword == "NSET" || card.keyword == "ELSET" ? card.parameter("INSTANCE") : nullptr;
    const FlatScope* const scope = of_instance ? names_.find_instance(*of_instance) : scope_;
    if (!scope) throw ReadError(card.where() + ": there is no instance '" + unquoted(*of_instance) + "'");
    change_head(card, *scope);
    const auto form = form_of(card);
    if (!form) {
        change_unknown(card);
        return card;
    }
    if (scope_->placement.moves) turn(card);
    switch (form->entries) {
        case Entries::nowhere:
            if (card.keyword == "SHELLSECTION" && card.parameter("COMPOSITE")) change_first(card, 1, 3, form->what);
            if (card.keyword == "ORIENTATION") change_first(card, 1, 0, form->what);
            break;
        case Entries::first:
            change_first(card, 1, 0, form->what);
            break;
        case Entries::first_two:
            change_first(card, 2, 0, form->what);
            break;
        case Entries::all:
            change_first(card, static_cast<std::size_t>(-1), 0, form->what);
            break;
        case Entries::all_but_first:
            change_first(card, static_cast<std::size_t>(-1), 1, form->what);
            break;
        case Entries::node:
            change_nodes(card);
            break;
        case Entries::element:
            change_elements(card);
            break;
        case Entries::set:
            change_set(card, *scope);
            break;
        case Entries::surface:
            change_surface(card);
            break;
        case Entries::equation:
            change_equation(card);
            break;
    }
    return card;
}

void FlatCards::change_head(Card& card, const FlatScope& of) const {
    constexpr std::string_view numbers[] = {"REFNODE", "ROTNODE", "NODE", "ELEMENT"};
    constexpr std::string_view names[] = {"NSET",    "ELSET",       "SURFACE",           "MASTER", "SLAVE", "TIENSET",
                                          "PINNSET", "ORIENTATION", "ANALYTICALSURFACE", "TIE"};
    const CardParameter* defined = defined_name(card);
    std::vector<CardParameter> parameters;
    bool changed = false;
    const bool is_set = card.keyword == "NSET" || card.keyword == "ELSET" || card.keyword == "SURFACE";
    for (const CardParameter& p : card.parameters) {
        if (is_set && (p.name == "INSTANCE" || p.name == "INTERNAL")) {
            changed = true;
            continue;
        }
        CardParameter flat = p;
        if (is_set && is_short_generate(p.name)) {
            flat.name = "GENERATE";
            changed = true;
        }
        const bool is_number = std::ranges::find(numbers, std::string_view(p.name)) != std::end(numbers);
        const bool is_name = std::ranges::find(names, std::string_view(p.name)) != std::end(names);
        const auto fail = [&](const std::string& wrong) {
            throw ReadError(card.where() + ": " + p.name + "=" + p.value + ": " + wrong);
        };
        std::optional<std::string> text;
        if (&p == defined && scope_->names.at(name_key(p.value)) != p.value)
            text = scope_->names.at(name_key(p.value));
        else if (&p != defined && !p.value.empty() && (is_name || is_number))
            text = !is_number && whole_number(p.value)
                       ? std::nullopt
                       : names_.number_or_name(of, p.value, p.name == "ELEMENT" ? Numbered::element : Numbered::node,
                                               fail);
        if (text) {
            flat.value = *text;
            changed = true;
        }
        parameters.push_back(std::move(flat));
    }
    if (changed) change_parameters(card, std::move(parameters));
}

void FlatCards::change_nodes(Card& card) const {
    const bool is_cylindrical = is_true_for(card, "SYSTEM", {"C", "CYLINDRICAL"}, "R");
    if (!is_cylindrical && !is_true_for(card, "SYSTEM", {"R", "RECTANGULAR"}, "R"))
        throw ReadError(card.where() + ": SYSTEM=" + *card.parameter("SYSTEM") +
                        " of *NODE is not understood; give the coordinates in x, y and z");
    if (card.parameter("SYSTEM")) {
        std::vector<CardParameter> rest = card.parameters;
        std::erase_if(rest, [](const CardParameter& p) { return p.name == "SYSTEM"; });
        change_parameters(card, std::move(rest));
    }
    const Placement place = scope_->placement.after(system_);
    if (!place.moves && !is_cylindrical && scope_->offset == 0) return;
    change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& where) {
        translate(line, 0, *scope_, Numbered::node, where);
        if (!place.moves && !is_cylindrical) return;
        Vec3 x[2] = {Vec3::Zero(), Vec3::Zero()};  // the place, and the normal of shells
        for (std::size_t k = 0; k < 6; ++k) {
            if (!line.has(k + 1)) continue;
            const auto value = deck_number(line.fields[k + 1]);
            if (!value) return;  // the reader tells
            x[k / 3][static_cast<int>(k % 3)] = *value;
        }
        const bool has_normal = line.has(4) || line.has(5) || line.has(6);
        if (is_cylindrical) {
            if (has_normal) throw ReadError(where() + "a normal in cylindrical coordinates is not understood");
            const double angle = x[0][1] * std::numbers::pi / 180;
            x[0] = Vec3(x[0][0] * std::cos(angle), x[0][0] * std::sin(angle), x[0][2]);
        }
        x[0] = place.point(x[0]);
        x[1] = place.direction(x[1]);
        for (std::size_t k = 0; k < (has_normal && place.turns ? 6u : 3u); ++k) {
            std::string text;
            append_coordinate(text, x[k / 3][static_cast<int>(k % 3)]);
            line.put(k + 1, std::move(text));
        }
    });
}

void FlatCards::change_elements(Card& card) const {
    const bool in_assembly = scope_ == &names_.assembly();
    if (scope_->offset == 0 && !in_assembly && scope_->is_alone) return;
    ElementLines element(card);
    change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& where) {
        element.start_line();
        for (std::size_t k = 0; k < line.fields.size(); ++k) {
            if (k + 1 == line.fields.size() && !line.has(k)) break;  // behind the last comma
            const auto what = element.next();
            if (!what) break;
            translate(line, k, *scope_, *what, where);
        }
        element.end_line(!line.has(line.fields.size() - 1));
    });
}

void FlatCards::change_set(Card& card, const FlatScope& scope) const {
    const Numbered what = card.keyword == "NSET" ? Numbered::node : Numbered::element;
    if (!card.parameter("GENERATE")) {
        change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& where) {
            for (std::size_t k = 0; k < line.fields.size(); ++k) translate(line, k, scope, what, where);
        });
        return;
    }
    const NumberRange& range = what == Numbered::node ? scope.nodes : scope.elements;
    const bool in_assembly = &scope == &names_.assembly();
    if (scope.is_alone || (in_assembly && names_.keeps_plain_numbers())) return;
    change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& where) {
        const auto first = whole_number(line.fields[0]);
        const auto last = line.has(1) ? whole_number(line.fields[1]) : std::nullopt;
        const auto step = line.has(2) ? whole_number(line.fields[2]) : 1;
        if (!first || !last || !step || *first < 0 || *last < *first || *step <= 0) return;  // the reader tells
        // Numbers beyond those of the scope would be those of another.
        Index from = *first, to = std::min(*last, range.last);
        if (range.first > 0 && from < range.first) from += (range.first - from + *step - 1) / *step * *step;
        if (range.first == 0 || from > to) {
            const std::string kind = what == Numbered::node ? "node" : "element";
            throw ReadError(where() + scope.label + " has no " + kind + " from " + std::to_string(*first) + " to " +
                            std::to_string(*last) +
                            (in_assembly ? " of its own; say which instance's is meant, by INSTANCE=" : ""));
        }
        if (from + scope.offset != *first) line.put(0, std::to_string(from + scope.offset));
        if (to + scope.offset != *last) line.put(1, std::to_string(to + scope.offset));
    });
}

/// CalculiX has no areas of nodes, which Abaqus/CAE writes behind them.
void FlatCards::change_surface(Card& card) const {
    if (!is_true_for(card, "TYPE", {"NODE"}, "ELEMENT")) {
        change_first(card, 1, 0, Numbered::element);
        change_lines(card, [](LineFields& line, std::size_t /*number*/, const Where& /*where*/) {
            if (!line.has(1)) return;
            const std::string label = name_key(line.fields[1]);  // an edge of a shell
            if (label.size() == 2 && label[0] == 'E' && label[1] >= '1' && label[1] <= '4')
                line.put(1, "S" + std::to_string(label[1] - '0' + 2));
        });
        return;
    }
    change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& where) {
        translate(line, 0, *scope_, Numbered::node, where);
        if (!line.has(1) || line.has(2)) return;
        if (const auto area = deck_number(line.fields[1]); area == 1.0)
            line.cut(1);
        else if (area)
            throw ReadError(where() + "CalculiX has no areas of nodes in a surface; the area would be lost");
    });
}

void FlatCards::change_equation(Card& card) const {
    Index terms = 0;
    change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& where) {
        if (terms <= 0) {
            terms = whole_number(line.fields[0]).value_or(0);
            return;
        }
        for (std::size_t k = 0; k < line.fields.size() && terms > 0; k += 3)
            if (line.has(k)) {
                translate(line, k, *scope_, Numbered::node, where);
                --terms;
            }
    });
}

void FlatCards::change_first(Card& card, std::size_t count, std::size_t from, Numbered what) const {
    if (card.keyword == "ORIENTATION") what = Numbered::either;
    change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& where) {
        const std::size_t end = count > line.fields.size() ? line.fields.size() : from + count;
        for (std::size_t k = from; k < std::min(end, line.fields.size()); ++k) {
            const std::string_view field = line.fields[k];
            const bool is_name = card.keyword == "ORIENTATION" || card.keyword == "SHELLSECTION";
            if (is_name && deck_number(field)) continue;
            translate(line, k, *scope_, what, where);
        }
    });
}

void FlatCards::change_unknown(Card& card) {
    const bool in_assembly = scope_ == &names_.assembly();
    const bool keeps = in_assembly ? names_.keeps_plain_numbers() : scope_->offset == 0;
    bool told = false;
    change_lines(card, [&](LineFields& line, std::size_t /*number*/, const Where& where) {
        std::size_t numbers = 0;
        for (std::size_t k = 0; k < line.fields.size(); ++k) {
            if (!line.has(k)) continue;
            if (deck_number(line.fields[k])) {
                ++numbers;
            } else if (const auto own = scope_->names.find(name_key(line.fields[k])); own != scope_->names.end()) {
                if (own->second != unquoted(line.fields[k])) line.put(k, own->second);
            } else if (auto text = names_.if_reference(line.fields[k])) {
                line.put(k, std::move(*text));
            }
        }
        if (!in_assembly && scope_->placement.moves && numbers >= 3)
            refuse_turned(where(), "*" + card.keyword + " is not a card of CalculiX; its numbers may be a direction");
        const auto first = whole_number(line.fields[0]);
        if (keeps || !first || *first <= 0) return;
        const std::string what = where() + "*" + card.keyword +
                                 " is not a card of CalculiX: whether its numbers are nodes or elements is not known";
        if (!in_assembly)
            throw ReadError(what + ", and those of " + scope_->label + " change by " + std::to_string(scope_->offset) +
                            ". Take the card out of the part");
        if (!told) warnings_.push_back(what + ", so they stay as they are; check them");
        told = true;
    });
}

void FlatCards::turn(Card& card) const {
    const auto form = form_of(card);
    constexpr std::string_view with_points[] = {"ORIENTATION", "TRANSFORM", "DLOAD"};
    if (!scope_->placement.turns && std::ranges::find(with_points, card.keyword) == std::end(with_points)) return;
    if (card.keyword == "INITIALCONDITIONS" && is_true_for(card, "TYPE", {"TEMPERATURE", "FIELD"}, "")) return;
    if (form && !form->turns && !acts_along_its_nodes(card))
        refuse_turned(card.where() + ": ", "*" + card.keyword + " stands in a part and has directions");
    if (card.keyword == "ORIENTATION") {
        if (!is_true_for(card, "DEFINITION", {"COORDINATES"}, "COORDINATES"))
            refuse_turned(card.where() + ": ", "DEFINITION=" + *card.parameter("DEFINITION") + " of *ORIENTATION");
        if (is_true_for(card, "SYSTEM", {"RECTANGULAR", "ZRECTANGULAR"}, "RECTANGULAR"))
            turn_orientation(card, false);
        else if (is_true_for(card, "SYSTEM", {"CYLINDRICAL", "SPHERICAL"}, "RECTANGULAR"))
            turn_orientation(card, true);
        else
            refuse_turned(card.where() + ": ", "SYSTEM=" + *card.parameter("SYSTEM") + " of *ORIENTATION");
    } else if (card.keyword == "TRANSFORM") {
        const std::string* type = card.parameter("TYPE");
        turn_numbers(card, 0, 0, type && name_key(*type) != "R");
    } else if (card.keyword == "NORMAL") {
        turn_numbers(card, static_cast<std::size_t>(-1), 2, false);
    } else if (card.keyword == "DISTRIBUTION") {
        turn_numbers(card, static_cast<std::size_t>(-1), 1, false);
    } else if (card.keyword == "GAP") {
        turn_numbers(card, 0, 1, false);
    } else if (card.keyword == "BEAMSECTION" || card.keyword == "BEAMGENERALSECTION") {
        turn_beam(card);
    }
}

/// The first line has the points; the others have an axis and angles about it.
void FlatCards::turn_orientation(Card& card, bool points) const {
    if (!points && !scope_->placement.turns) return;
    turn_numbers(card, 0, 0, points);
}

/// Whole groups of three numbers of a line, from field `from` on; of all lines if `only_line` is -1.
void FlatCards::turn_numbers(Card& card, std::size_t only_line, std::size_t from, bool points) const {
    const Placement& place = scope_->placement;
    if (!points && !place.turns) return;
    change_lines(card, [&](LineFields& line, std::size_t number, const Where& where) {
        if (only_line != static_cast<std::size_t>(-1) && number != only_line) return;
        std::size_t last = line.fields.size();
        while (last > from && !line.has(last - 1)) --last;
        if (card.keyword == "GAP") last = std::min(last, from + 3);  // what follows is no direction
        std::vector<double> values;
        for (std::size_t k = from; k < last; ++k) {
            const auto value = deck_number(line.fields[k]);
            if (!value) return;  // a name, or the reader tells
            values.push_back(*value);
        }
        if (card.keyword == "DISTRIBUTION" && values.size() < 3) return;  // a thickness, not a direction
        if (values.size() % 3 != 0)
            refuse_turned(where(), "*" + card.keyword + " has a direction or point that has not three numbers");
        for (std::size_t v = 0; v < values.size(); v += 3) {
            const Vec3 x(values[v], values[v + 1], values[v + 2]);
            const Vec3 y = points ? place.point(x) : place.direction(x);
            for (std::size_t k = 0; k < 3; ++k) {
                std::string text;
                append_coordinate(text, y[static_cast<int>(k)]);
                line.put(from + v + k, std::move(text));
            }
        }
    });
}

/// The second line is the direction of a beam's first axis; without it the axis is a default of the whole model.
void FlatCards::turn_beam(Card& card) const {
    std::size_t lines = 0;
    CardReader reader(card);
    while (reader.next_data_line()) ++lines;
    if (is_true_for(card, "SECTION", {"CIRC", "PIPE"}, "") && lines < 2) return;  // alike all around
    if (lines < 2 || is_true_for(card, "SECTION", {"ARBITRARY", "MESHED"}, ""))
        refuse_turned(card.where() + ": ", "*" + card.keyword + " does not say the direction of its first axis in a " +
                                               std::string("second line"));
    turn_numbers(card, 1, 0, false);
}

}  // namespace femscalpel
