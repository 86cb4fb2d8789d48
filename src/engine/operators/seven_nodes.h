// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <unordered_map>
#include <vector>

#include "mesh/changes.h"
#include "operators/prepared.h"
#include "operators/report.h"

namespace femscalpel {

/// Triangles of seven nodes (Code_Aster's shells) without the one in their middle for the time of an operation; all of
/// them, and those that are born of them, get it back.
class SevenNodes {
public:
    /// Takes the middles out of a copy of `input`, which must outlive this.
    explicit SevenNodes(const Mesh& input);

    /// Whether there are such triangles.
    explicit operator bool() const { return !places_.empty(); }

    const Mesh& mesh() const { return mesh_; }

    /// What an operation on mesh() is to know.
    Prepared known();

    /// Gives the triangles of what an operation made of mesh() their middles, and brings the report up to date: where
    /// a triangle is as it was, the node is; else it lies in the middle of the triangle's shape, and if that is new, in
    /// the node groups that all corners are in.
    void finish(Result& result);

private:
    void put_middles(Mesh& mesh, Report& report) const;
    void sort_nodes(Mesh& mesh) const;
    void report_groups(const Mesh& mesh, Report& report) const;

    const Mesh& input_;
    Mesh mesh_;
    Index placeholder_ = 0;                    // number of a middle that mesh() has all the same; 0: none
    std::unordered_map<Index, Index> places_;  // in the input's block, by number
    std::vector<Changes> stages_;
};

}  // namespace femscalpel
