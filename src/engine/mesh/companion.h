// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>
#include <string>

#include "mesh/mesh.h"

namespace femscalpel {

/// What a mesh carries of the file it was read from, for the format that wrote it: a solver's input around the mesh.
/// The mesh knows no more of it than this; each format has a kind of its own (deck/solver_input.h). Never changed while
/// a mesh holds it: copies of the mesh share it, and an operator that changes it gives its result another.
class Companion {
public:
    Companion() = default;
    virtual ~Companion() = default;

    /// Largest number of an element that the file has or names and the mesh has not; 0 without any. New elements must
    /// not get its number.
    virtual Index largest_other_element() const = 0;

    /// Largest number of a node that the file names and the mesh has not; 0 without any. New nodes must not get it.
    virtual Index largest_other_node() const { return 0; }

    /// What it is once the group `old_name` of this kind is called `new_name`; null where it says nothing of that
    /// group.
    virtual std::shared_ptr<const Companion> with_renamed_group(GroupKind /*kind*/, const std::string& /*old_name*/,
                                                                const std::string& /*new_name*/) const {
        return nullptr;
    }

protected:
    Companion(const Companion&) = default;
    Companion(Companion&&) = default;
    Companion& operator=(const Companion&) = default;
    Companion& operator=(Companion&&) = default;
};

}  // namespace femscalpel
