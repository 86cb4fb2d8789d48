// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fields/field.h"

#include <algorithm>
#include <unordered_set>

#include "error.h"

namespace femscalpel {
namespace {

[[noreturn]] void fail(const Field& field, const std::string& what) {
    throw Error("field '" + field.name + "': " + what);
}

void check_part(const Field& field, const FieldPart& part, const NumberIndex& numbers, const Fields& fields) {
    const bool of_nodes = part.support == FieldSupport::node;
    const int expected = part.support == FieldSupport::element_nodes    ? traits(part.type).nodes
                         : part.support == FieldSupport::element_points ? part.points
                                                                        : 1;
    if (part.points < 1 || part.points != expected)
        fail(field, std::to_string(part.points) + " values per " + (of_nodes ? "node" : "element") + ", where there " +
                        "are " + std::to_string(expected));
    const std::size_t values = part.numbers->size() * static_cast<std::size_t>(part.points) * field.components.size();
    if (part.reals.size() != (field.whole() ? 0 : values) || part.integers.size() != (field.whole() ? values : 0))
        fail(field, "there are " + std::to_string(part.reals.size() + part.integers.size()) + " values of its type, " +
                        std::to_string(values) + " are needed");
    if (!part.localization.empty()) {
        const FieldLocalization* where = fields.localization(part.localization);
        if (!where || where->type != part.type || where->weights.size() != static_cast<std::size_t>(part.points))
            fail(field, "its localization '" + part.localization + "' is not one of " + std::to_string(part.points) +
                            " points of " + std::string(traits(part.type).name) + " elements");
    }
    std::unordered_set<Index> seen;
    for (const Index number : *part.numbers) {
        const std::string who = (of_nodes ? "node " : "element ") + std::to_string(number);
        if (!seen.insert(number).second) fail(field, who + " has values twice");
        if (of_nodes ? !numbers.node(number) : !numbers.cell(number)) fail(field, "the mesh has no " + who);
        if (!of_nodes && numbers.cell(number)->type != part.type)
            fail(field, who + " is no " + std::string(traits(part.type).name));
    }
}

}  // namespace

std::string_view to_string(FieldSupport support) {
    constexpr std::string_view names[] = {"node", "element", "element nodes", "element points"};
    return names[static_cast<int>(support)];
}

const FieldLocalization* Fields::localization(std::string_view name) const {
    const auto found = std::ranges::find(localizations, name, &FieldLocalization::name);
    return found == localizations.end() ? nullptr : &*found;
}

void validate(const Fields& fields, const Mesh& mesh) {
    const NumberIndex numbers(mesh);
    std::unordered_set<std::string> names;
    for (const Field& field : fields.fields) {
        if (field.name.empty()) fail(field, "it has no name");
        if (!names.insert(field.name).second) fail(field, "there are two of this name");
        if (field.components.empty()) fail(field, "it has no components");
        if (field.units.size() != field.components.size())
            fail(field, std::to_string(field.components.size()) + " components, but " +
                            std::to_string(field.units.size()) + " units");
        for (const FieldStep& step : field.steps)
            for (const FieldPart& part : step.parts) check_part(field, part, numbers, fields);
    }
}

}  // namespace femscalpel
