// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/abaqus_cards.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <set>
#include <string>

#include "cancel.h"
#include "deck/rules/nameless_cards.h"
#include "deck/solver_sets.h"
#include "error.h"
#include "io/flat_lines.h"

namespace femscalpel {
namespace {

/// A card that makes part of the mesh, as its keyword is written, and what it makes or does.
struct MeshMaker {
    std::string_view keyword, written, makes;
};

constexpr MeshMaker mesh_makers[] = {
    {"NGEN", "NGEN", "makes nodes between others"},
    {"NFILL", "NFILL", "makes nodes between others"},
    {"NCOPY", "NCOPY", "makes nodes from others"},
    {"NMAP", "NMAP", "puts nodes elsewhere"},
    {"ELGEN", "ELGEN", "makes elements from others"},
    {"ELCOPY", "ELCOPY", "makes elements from others"},
    {"SYMMETRICMODELGENERATION", "SYMMETRIC MODEL GENERATION", "makes nodes and elements from those of another model"},
    {"IMPORT", "IMPORT", "takes elements from the results of another analysis"},
};

[[noreturn]] void refuse_maker(const Card& card, std::string_view written, std::string_view makes) {
    throw ReadError(card.where() + ": *" + std::string(written) + " " + std::string(makes) +
                    " when Abaqus reads the deck; CalculiX passes over it, and so the mesh would not be whole here. "
                    "Write a deck that lists all nodes and elements (Abaqus/CAE: import this one, then write the "
                    "input file of a job)");
}

void refuse_short_words(const Card& card) {
    if (card.keyword != "NSET" && card.keyword != "ELSET") return;
    for (const CardParameter& p : card.parameters)
        if (is_short_generate(p.name))
            throw ReadError(card.where() + ": " + p.name + " of *" + card.keyword +
                            ": Abaqus takes it for GENERATE, CalculiX for nothing; write it out");
}

void refuse_system(const Card& card) {
    const std::string* system = card.keyword == "NODE" ? card.parameter("SYSTEM") : nullptr;
    if (system && deck_key(*system) != "R" && deck_key(*system) != "RECTANGULAR")
        throw ReadError(card.where() + ": SYSTEM=" + *system +
                        " of *NODE: CalculiX takes the numbers for x, y and z, Abaqus does not; write these");
    CardReader line(card);
    if (card.keyword == "SYSTEM" && line.next_data_line())
        throw ReadError(card.where() +
                        ": *SYSTEM: Abaqus takes the coordinates that follow in a system of its own, CalculiX does "
                        "not; write them as x, y and z of the model, and leave the card out");
}

/// The lines of numbers of a set.
std::string set_lines(const std::vector<Index>& numbers) {
    std::string out;
    constexpr std::size_t per_line = 16;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        out += std::to_string(numbers[i]) + (i % per_line + 1 == per_line || i + 1 == numbers.size() ? ",\n" : ", ");
    return out;
}

/// The numbers of the nodes of elements, ascending.
std::vector<Index> nodes_of(const SetMembers& elements, const Mesh& mesh, const NumberIndex& numbers,
                            const SolverInput& input) {
    std::vector<Index> out;
    for (const Index id : elements.members)
        if (const auto cell = numbers.cell(id))
            for (const Index n : mesh.block(cell->type).nodes(cell->cell)) out.push_back(mesh.node_ids[n]);
    for (const OtherElement& e : input.other_elements())
        if (std::ranges::find(elements.unheld, std::array<Index, 2>{e.number, 0}) != elements.unheld.end())
            std::ranges::copy_if(e.nodes, std::back_inserter(out), [](Index n) { return n > 0; });
    std::ranges::sort(out);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

void list_nodes(Card& card, const std::vector<Index>& nodes) {
    std::vector<CardParameter> rest = card.parameters;
    std::erase_if(rest, [](const CardParameter& p) { return p.name == "ELSET"; });
    change_parameters(card, std::move(rest));
    if (nodes.empty()) return;
    const DeckText head = card.text.front();
    const auto file = std::make_shared<const DeckFile>(DeckFile{head.file->path, set_lines(nodes)});
    card.text.insert(card.text.begin() + 1, {file, file->text, head.line});
}

}  // namespace

bool has_data_in_file(std::string_view keyword) {
    constexpr std::string_view keywords[] = {
        "AMPLITUDE", "BOUNDARY",    "CFLUX",   "CLOAD",          "DFLUX",       "DISTRIBUTION",
        "DLOAD",     "DSLOAD",      "ELEMENT", "ELSET",          "EQUATION",    "FIELD",
        "FILM",      "MPC",         "NODE",    "NODALTHICKNESS", "NORMAL",      "INITIALCONDITIONS",
        "NSET",      "ORIENTATION", "RADIATE", "SURFACE",        "TEMPERATURE", "TRANSFORM"};
    return std::ranges::find(keywords, keyword) != std::end(keywords);
}

bool is_short_generate(std::string_view parameter) {
    constexpr std::string_view whole = "GENERATE";
    return parameter.size() >= 3 && parameter.size() < whole.size() && whole.starts_with(parameter);
}

void refuse_generated_mesh(const std::vector<Card>& cards) {
    const bool has_instances = std::ranges::find(cards, "INSTANCE", &Card::keyword) != cards.end();
    for (const Card& card : cards) {
        const auto maker = std::ranges::find(mesh_makers, std::string_view(card.keyword), &MeshMaker::keyword);
        if (maker != std::end(mesh_makers)) refuse_maker(card, maker->written, maker->makes);
        if (card.keyword == "SURFACE")
            for (const std::string_view how : {"COMBINE", "CROP"})
                if (card.parameter(how))
                    throw ReadError(card.where() + ": *SURFACE with " + std::string(how) +
                                    ": CalculiX has no surfaces made of others; list the elements and their faces");
        if (has_instances) continue;
        refuse_system(card);
        refuse_short_words(card);
    }
}

void list_nodes_of_element_sets(const Mesh& mesh, SolverInput& input) {
    const auto names_elements = [](const Card& card) { return card.keyword == "NSET" && card.parameter("ELSET"); };
    if (std::ranges::none_of(input.cards(), names_elements)) return;
    const NumberIndex numbers(mesh);
    const DeckSetIndex index(input.sets());
    const std::vector<SetMembers> sets = evaluate_sets(mesh, numbers, input, members_by_card(mesh, input), {}, nullptr);
    for (Card& card : input.cards()) {
        check_cancelled();
        if (!names_elements(card)) continue;
        const std::string name = *card.parameter("ELSET"), where = card.where() + ": *NSET, ELSET=" + name + ": ";
        const auto s = index.find(DeckSetType::elset, name);
        if (!s) throw ReadError(where + "there is no element set '" + name + "'");
        const std::vector<Index> nodes = nodes_of(sets[*s], mesh, numbers, input);
        list_nodes(card, nodes);
        input.warnings().push_back(where + (nodes.empty() ? "that set has no elements, so there are no nodes of them"
                                                          : "CalculiX passes over ELSET=, so the " +
                                                                std::to_string(nodes.size()) +
                                                                " nodes of these elements are listed instead"));
    }
}

void warn_of_idle_constraints(SolverInput& input) {
    for (const Card& card : input.cards()) {
        CardReader line(card);
        if (card.keyword == "KINEMATIC" && !line.next_data_line())
            input.warnings().push_back(card.where() +
                                       ": *KINEMATIC without a line couples nothing in CalculiX; give it "
                                       "degrees of freedom (1, 3)");
        if (card.keyword == "RIGIDBODY" && !card.parameter("NSET") && !card.parameter("ELSET"))
            input.warnings().push_back(card.where() +
                                       ": *RIGID BODY without NSET= or ELSET= is none in CalculiX; say "
                                       "its nodes by NSET=");
    }
}

void warn_of_newer_cards(SolverInput& input) {
    std::set<std::string> told;
    for (const Card& card : input.cards()) {
        const std::string_view version = first_calculix_with(card.keyword);
        if (version.empty() || !told.insert(card.keyword).second) continue;
        input.warnings().push_back(card.where() + ": *" + card.keyword + " is a card of CalculiX " +
                                   std::string(version) + " and later; earlier ones pass over it");
    }
}

}  // namespace femscalpel
