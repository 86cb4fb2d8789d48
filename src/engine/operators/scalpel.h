// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>

#include "operators/crack.h"
#include "operators/cut.h"
#include "operators/drill.h"

namespace femscalpel {

/// Repeated operations on one mesh: keeps what does not depend on the tool (adjacency, numbering, group
/// measures), so that a further tool position costs only its band and the output.
class Scalpel {
public:
    /// Keeps a shared, unchanging copy of the mesh; linear time.
    explicit Scalpel(std::shared_ptr<const Mesh> mesh);
    ~Scalpel();
    Scalpel(Scalpel&&) noexcept;

    const Mesh& mesh() const;

    /// As femscalpel::crack().
    Result crack(const Tool& tool, const CrackOptions& options = {}) const;

    /// As femscalpel::drill().
    Result drill(std::span<const Tool* const> tools, const DrillOptions& options = {}) const;

    /// As femscalpel::cut().
    Result cut(const Tool& positive, const Tool& negative, const CutOptions& options = {}) const;
    /// As femscalpel::cut(), a slot around a plane.
    Result cut(const Plane& plane, double width, const CutOptions& options = {}) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace femscalpel
