// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fields/field.h"
#include "mesh/changes.h"

namespace femscalpel {

/// What became of a field's values on one support; nodes or elements, counted over all time steps.
struct FieldRecord {
    std::string name;
    FieldSupport support = FieldSupport::node;
    Index steps = 0;
    Index kept = 0;       ///< bit for bit: of entities that the operator did not touch
    Index doubled = 0;    ///< new nodes with their original's value
    Index parts = 0;      ///< elements that changed or are new: their own or their parent's value, or made of that
    Index made = 0;       ///< nodes that are new or moved: interpolated at their place
    Index outside = 0;    ///< of all these, farther off the input than it tells: the nearest point's value
    Index absent = 0;     ///< new nodes and elements without a value
    Index removed = 0;    ///< values of nodes and elements that are gone
    double farthest = 0;  ///< how far those outside are off, in the mesh's unit
};

/// What is to be carried over.
struct FieldCarrying {
    const Mesh& before;               ///< with its fields
    const Mesh& after;                ///< what an operator made of it
    std::span<const Changes> stages;  ///< step by step, as far as known
    std::optional<GroupIndex> added;  ///< group of `after` of elements that are not the input's, if there are any
};

/// The fields of `before` on `after`. Values of what was not touched stay bit for bit. For the rest:
///
/// - Nodes: doubled ones have their original's value; new and moved ones what the field has at their place in the old
///   mesh, by the shape functions of the element that they are in there; slightly outside (curved skins) by those of
///   its corners. Whole numbers: that of the node with the largest share.
/// - Elements: parts have their parent's value.
/// - Nodes of elements: by the own values, at its nodes, of the old element that the place is in, which mostly is the
///   parent; on a border between old elements of the one on the element's own side.
/// - Integration points: the linear function that fits the values of the old element they are in best; so constant and
///   linear fields stay what they are. Without a localization that element's mean. Elements of a type for which the
///   field has no points get one, in their middle.
///
/// What has no parent, or one without a value, has none (a profile tells which have). Null without fields.
std::shared_ptr<const Fields> carry_fields(const FieldCarrying& carrying, std::vector<FieldRecord>& records);

}  // namespace femscalpel
