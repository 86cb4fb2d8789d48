// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <deque>
#include <set>
#include <span>
#include <vector>

#include "operators/fillet_material.h"

namespace femscalpel {

/// A part of a plane across an edge that is rounded, which is made anew: skin where the edge leaves the part, or a
/// border inside, such as one of materials. Edges that lie near each other may share one.
struct FilletPatch {
    Vec3 normal;
    double offset;
    std::array<int, 2> domain;                   ///< behind and before the plane, as its normal points; -1 outside
    bool free = false;                           ///< a new face, where there was none
    std::vector<Triangle> old = {}, fresh = {};  ///< their normals are the plane's
    /// Lines through nodes, from one end of the old faces' outline to another, that close it on the new material's
    /// side.
    std::vector<std::vector<int>> links = {};
};

/// All of them.
class FilletPatches {
public:
    explicit FilletPatches(FilletMaterial& material) : m_(material) {}

    FilletPatch& operator[](int patch) { return patches_[patch]; }
    const FilletPatch& operator[](int patch) const { return patches_[patch]; }
    const std::deque<FilletPatch>& all() const { return patches_; }

    /// Takes the plane skin at a node that belongs to a domain, as far as it hangs together; -1: to any one. Nodes may
    /// be `off` the plane. The patch is -1 when there is none.
    int take_skin(const Vec3& normal, double offset, double off, int node, int domain);
    /// The same with a border between domains, the first behind the plane.
    int take_border(const Vec3& normal, double offset, double off, int node, const std::array<int, 2>& domain);
    /// Edges of old outlines that go.
    void hide(int a, int b) { hidden_.insert({{a, b}, {b, a}}); }
    /// A new face without old ones.
    int add_free(const Vec3& normal, double offset, const std::array<int, 2>& domain);

    /// Makes the new faces, once all links are known. Throws QualityError where they do not close the outline.
    void mesh();
    /// What lay on the old faces lies on the new ones.
    void carry_over();
    /// The nodes of the old face of some patches that is nearest; of an element, where there is none.
    std::vector<int> nodes_near(std::span<const int> patches, const Vec3& x) const;

private:
    int known(const Vec3& normal, double off, int node, std::array<int, 2> domain, bool any) const;
    void keep_connected(std::vector<char>& taken, const std::vector<Triangle>& faces, int node) const;
    const Triangle& face_near(const FilletPatch& patch, const Vec3& x) const;
    std::vector<int> outline_of(const FilletPatch& patch) const;
    void mesh(FilletPatch& patch);
    void carry_over(const FilletPatch& patch);

    FilletMaterial& m_;
    std::deque<FilletPatch> patches_;
    std::set<DirectedEdge> hidden_;  // in both directions
};

}  // namespace femscalpel
