// SPDX-License-Identifier: LGPL-2.1-or-later
#include "groups/tetra_faces.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "cancel.h"

namespace femscalpel {
namespace {

bool same_nodes(const std::array<int, 3>& a, const std::array<int, 3>& b) {
    return std::ranges::all_of(b, [&](int v) { return std::ranges::find(a, v) != a.end(); });
}

/// Calls `visit(tetrahedron, nodes)` with every face that has a movable node and only nodes that count.
void for_each_face(const BandMesh& band, const std::vector<char>& counts, const std::vector<char>& movable,
                   SparseCheck& check, auto visit) {
    for (int t = 0; t < band.tetras.size(); ++t) {
        check();
        if (!band.tetras.alive(t)) continue;
        const auto& v = band.tetras[t];
        if (counts[v[0]] + counts[v[1]] + counts[v[2]] + counts[v[3]] < 3) continue;
        for (const auto& f : outward_faces) {
            const std::array<int, 3> nodes{v[f[0]], v[f[1]], v[f[2]]};
            if (!(counts[nodes[0]] && counts[nodes[1]] && counts[nodes[2]])) continue;
            if (movable[nodes[0]] || movable[nodes[1]] || movable[nodes[2]]) visit(t, nodes);
        }
    }
}

}  // namespace

// Every face has a random number, and a node the exclusive or of those of its faces, counted once per tetrahedron.
void mark_outer_nodes(const BandMesh& band, std::vector<char>& marked) {
    const auto scramble = [](std::uint64_t x) {
        x = (x ^ (x >> 31)) * 0x7fb5d329728ea185u;
        x = (x ^ (x >> 27)) * 0x81dadef4bc2dd44du;
        return x ^ (x >> 33);
    };
    std::vector<std::uint64_t> random(static_cast<std::size_t>(band.size())), rest(random.size(), 0);
    for (std::size_t v = 0; v < random.size(); ++v) random[v] = scramble(v + 0x9e3779b97f4a7c15u);
    SparseCheck check(1 << 12);
    for (int t = 0; t < band.tetras.size(); ++t) {
        check();
        if (!band.tetras.alive(t)) continue;
        const auto& v = band.tetras[t];
        const std::uint64_t sum = random[v[0]] + random[v[1]] + random[v[2]] + random[v[3]];
        std::array<std::uint64_t, 4> face;  // opposite each corner
        for (int k = 0; k < 4; ++k) face[k] = scramble(sum - random[v[k]]);
        const std::uint64_t all = face[0] ^ face[1] ^ face[2] ^ face[3];
        for (int k = 0; k < 4; ++k) rest[v[k]] ^= all ^ face[k];
    }
    for (std::size_t v = 0; v < rest.size(); ++v)
        if (rest[v] != 0) marked[v] = 1;
}

TetraFaces::TetraFaces(const BandMesh& band, const std::vector<char>& counts)
    : start_(static_cast<std::size_t>(band.size()) + 1, 0) {
    std::vector<char> movable(static_cast<std::size_t>(band.size()));
    for (int v = 0; v < band.size(); ++v) movable[v] = band.nodes[v].movable();
    SparseCheck check;
    for_each_face(band, counts, movable, check,
                  [&](int, const std::array<int, 3>& nodes) { ++start_[std::ranges::min(nodes) + 1]; });
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    std::vector<BandBoundaries::Face> rows(static_cast<std::size_t>(start_.back()));
    std::vector<int> end(start_.begin(), start_.end() - 1);
    for_each_face(band, counts, movable, check, [&](int t, const std::array<int, 3>& nodes) {
        const int row = std::ranges::min(nodes);
        for (int at = start_[row]; at < end[row]; ++at)
            if (same_nodes(rows[at].nodes, nodes)) {
                rows[at].tetra[1] = t;
                return;
            }
        rows[end[row]++] = {nodes, 0, {t, -1}, false};
    });
    // Close the gaps that faces seen twice left.
    faces.reserve(rows.size());
    for (int v = 0; v < band.size(); ++v) {
        const int first = start_[v];
        start_[v] = static_cast<int>(faces.size());
        faces.insert(faces.end(), rows.begin() + first, rows.begin() + end[v]);
    }
    start_.back() = static_cast<int>(faces.size());
}

int TetraFaces::find(const std::array<int, 3>& nodes) const {
    const int row = std::ranges::min(nodes);
    for (int at = start_[row]; at < start_[row + 1]; ++at)
        if (same_nodes(faces[at].nodes, nodes)) return at;
    return -1;
}

}  // namespace femscalpel
