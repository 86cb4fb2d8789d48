// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// Where a field has its values.
enum class FieldSupport : std::uint8_t {
    node,            ///< one per node
    element,         ///< one per element
    element_nodes,   ///< one per node of each element, in the order of CellBlock::nodes()
    element_points,  ///< one per integration point of each element
};

/// "node", "element", "element nodes" or "element points".
std::string_view to_string(FieldSupport support);

/// Values of one step on nodes, or on elements of one type. They go with numbers, not with places in arrays: what an
/// operator renumbers or leaves out never gets another's value.
struct FieldPart {
    FieldSupport support = FieldSupport::node;
    CellType type = CellType::vertex;  ///< of elements
    /// Of the nodes or elements that have values, unique.
    std::shared_ptr<const std::vector<Index>> numbers = std::make_shared<std::vector<Index>>();
    std::string profile;       ///< what a file calls the choice of them; empty if all have values, or without a name
    int points = 1;            ///< values per entity: nodes of the element, or integration points
    std::string localization;  ///< name of the integration points' FieldLocalization; empty if not known
    /// Numbers' size x points x components, in this order; `integers` where the field's are whole, else `reals`.
    std::vector<double> reals;
    std::vector<std::int64_t> integers;

    Index size() const { return static_cast<Index>(numbers->size()); }
};

/// A field at one time.
struct FieldStep {
    Index number = -1;     ///< of the time step; -1: none
    Index iteration = -1;  ///< -1: none
    double time = 0;
    std::vector<FieldPart> parts;
};

/// What a file stores a field's values as.
enum class FieldValues : std::uint8_t { float64, float32, int32, int64 };

/// Named values on a mesh, at one or several times.
struct Field {
    std::string name;
    std::vector<std::string> components;  ///< their names; as many as values per point
    std::vector<std::string> units;       ///< of the components
    std::string time_unit;
    FieldValues values = FieldValues::float64;
    std::vector<FieldStep> steps;

    bool whole() const { return values == FieldValues::int32 || values == FieldValues::int64; }
};

/// Where the integration points of an element type are, in coordinates of a reference element.
struct FieldLocalization {
    std::string name;
    CellType type = CellType::vertex;
    int dimension = 0;            ///< of these coordinates
    std::vector<double> element;  ///< nodes of the reference element x dimension, in the order of CellBlock::nodes()
    std::vector<double> points;   ///< points x dimension
    std::vector<double> weights;  ///< one per point
};

/// All fields of a mesh.
struct Fields {
    std::vector<Field> fields;
    std::vector<FieldLocalization> localizations;

    /// Null if there is none of that name.
    const FieldLocalization* localization(std::string_view name) const;
};

/// Throws Error that names the field at fault where sizes do not go together, a number is used twice or the mesh has
/// no such node or element of that type.
void validate(const Fields& fields, const Mesh& mesh);

}  // namespace femscalpel
