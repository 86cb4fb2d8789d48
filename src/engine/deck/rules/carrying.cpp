// SPDX-License-Identifier: LGPL-2.1-or-later
#include "deck/rules/carrying.h"

#include <cmath>

namespace femscalpel {
namespace {

/// Displacements of nodes smaller than this part of the mesh's size do not count.
constexpr double unmoved = 1e-9;

double size_of(const Mesh& mesh) {
    if (mesh.node_count() == 0) return 0;
    Vec3 low = Vec3::Constant(INFINITY), high = -low;
    for (const Vec3& x : mesh.points) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    return (high - low).norm();
}

}  // namespace

Carrying::Carrying(const Mesh& before, Mesh& after, const Changes& changes)
    : before_(before),
      after_(after),
      changes_(changes),
      old_(before),
      new_numbers_(after),
      origins_(before, old_.numbers(), after, new_numbers_, changes),
      input_(old_.input()),
      edits_(input_.cards().size()),
      remarks_(old_.input()),
      closed_sets_(old_, after, new_numbers_, changes, input_),
      emptied_sets_(old_.input(), before, after),
      size_(size_of(before)) {
    for (const Changes::Part& p : changes.parts) {
        parts_[p.parent].push_back(p.element);
        parents_.emplace(p.element, p.parent);
    }
}

bool Carrying::node_moved(Index number) const { return origins_.moved(number) > unmoved * size_; }

std::vector<Index> Carrying::parts_of(Index element) const {
    std::vector<Index> out;
    if (new_numbers_.cell(element)) out.push_back(element);
    if (const auto it = parts_.find(element); it != parts_.end())
        out.insert(out.end(), it->second.begin(), it->second.end());
    return out;
}

Index Carrying::origin_of(Index element) const {
    const auto parent = parents_.find(element);
    return parent == parents_.end() ? element : parent->second;
}

bool Carrying::is_plane_now(Index element) const {
    return old_.is_plane(*old_.numbers().cell(origin_of(element)));  // parts stand under the card of their parent
}

std::shared_ptr<const Companion> Carrying::result() {
    bool any = closed_sets_.any();
    for (std::size_t c = 0; c < edits_.size(); ++c)
        if (!edits_[c].empty()) {
            edits_[c].apply(input_.cards()[c]);
            any = true;
        }
    if (!any) return before_.companion;
    closed_sets_.define();
    return std::make_shared<const SolverInput>(std::move(input_));
}

}  // namespace femscalpel
