// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <memory>

#include "mesh/mesh.h"
#include "operators/prepared.h"

namespace femscalpel {

/// Repeated operations on one mesh: keeps what does not depend on the tool (adjacency, numbering, group
/// measures), so that a further tool position costs only its band and the output:
///
///     crack(scalpel.mesh(), tool, options, scalpel.prepared());
class Scalpel {
public:
    /// Keeps a shared, unchanging copy of the mesh; linear time.
    explicit Scalpel(std::shared_ptr<const Mesh> mesh);
    ~Scalpel();
    Scalpel(Scalpel&&) noexcept;

    const Mesh& mesh() const;

    /// What is known of the mesh; valid as long as this lives.
    Prepared prepared() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace femscalpel
