// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/vertex_cut.h"

#include <algorithm>

#include "cancel.h"

namespace femscalpel {

bool VertexCut::solve() {
    Weight flow = 0;
    SparseCheck check(64);
    while (find_levels()) {
        check_cancelled();
        next_ = first_;
        while (const Weight pushed = push(endless)) {
            check();
            flow += pushed;
            if (flow >= endless) return false;
        }
    }
    return true;
}

void VertexCut::add(int from, int to, Weight capacity) {
    arcs_.push_back({to, first_[from], capacity});
    first_[from] = static_cast<int>(arcs_.size()) - 1;
    arcs_.push_back({from, first_[to], 0});
    first_[to] = static_cast<int>(arcs_.size()) - 1;
}

bool VertexCut::find_levels() {
    level_.assign(first_.size(), -1);
    level_[source_] = 0;
    queue_.assign(1, source_);
    for (std::size_t k = 0; k < queue_.size(); ++k)
        for (int a = first_[queue_[k]]; a >= 0; a = arcs_[a].next)
            if (arcs_[a].left > 0 && level_[arcs_[a].to] < 0) {
                level_[arcs_[a].to] = level_[queue_[k]] + 1;
                queue_.push_back(arcs_[a].to);
            }
    return level_[sink_] >= 0;
}

VertexCut::Weight VertexCut::push(Weight most) {
    path_.clear();
    int at = source_;
    while (at != sink_) {
        int& a = next_[at];
        while (a >= 0 && !(arcs_[a].left > 0 && level_[arcs_[a].to] == level_[at] + 1)) a = arcs_[a].next;
        if (a >= 0) {
            path_.push_back(a);
            at = arcs_[a].to;
        } else {
            if (path_.empty()) return 0;
            at = arcs_[path_.back() ^ 1].to;
            path_.pop_back();
            next_[at] = arcs_[next_[at]].next;
        }
    }
    for (const int a : path_) most = std::min(most, arcs_[a].left);
    for (const int a : path_) {
        arcs_[a].left -= most;
        arcs_[a ^ 1].left += most;
    }
    return most;
}

}  // namespace femscalpel
