// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <array>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cancel.h"
#include "mesh/facet_element.h"

namespace femscalpel {

/// Faces inside the solids of a mesh (edges between its shells, where it has none) that a group covers, or that lie on
/// a surface, and which of their sides is negative; see part_along().
class FaceCover {
public:
    /// Corners of a face or edge, ascending, each once; then -1.
    using Key = std::array<Index, 4>;
    static Key key_of(std::span<const Index> corners);

    /// A face as one of the elements at it has it.
    struct Owner {
        CellRef cell;
        int face;  ///< Facet::face
    };
    /// One with all elements that have it.
    struct Face {
        std::vector<Owner> owners;
        std::vector<CellRef> elements;  ///< that lie on it, those of the group first
        int reference = 0;              ///< 1: the first owner is on the negative side, as what covers it says; -1: not
        int sense = 0;                  ///< the same when it is known
    };

    /// `mesh` must outlive this.
    FaceCover(const Mesh& mesh, GroupIndex group);
    /// The same for faces all of whose corners are within `rounding` of a surface, by their distances from it.
    FaceCover(const Mesh& mesh, const std::vector<double>& distance, double rounding);

    /// Finds them. Throws ToolError that names `group` where it covers none inside; false where a surface does.
    bool find();

    const std::map<Key, Face>& faces() const { return faces_; }

    /// 1 where an owner is on the negative side, -1 on the positive.
    static int side(const Face& face, std::size_t owner) { return owner == 0 ? face.sense : -face.sense; }

    int dimension() const { return dimension_; }
    /// "face" or "edge".
    std::string what() const { return dimension_ == 3 ? "face" : "edge"; }
    /// Throws ToolError about what is to be parted.
    [[noreturn]] void refuse(const std::string& why) const;

    /// Corners of an element.
    std::span<const Index> corners(const CellRef& c) const;
    /// Faces (edges) of an element of the mesh's dimension.
    int face_count(CellType type) const;
    /// Its face (edge) k, from 0.
    Owner owner(CellType type, Index cell, int k) const { return {{type, cell}, dimension_ == 3 ? k + 1 : k + 3}; }
    /// A face as a facet of no group.
    static Facet facet(const Owner& o);
    /// All nodes of a face, corners first, turned out of its owner; in a mesh with the same elements.
    static std::vector<Index> nodes_of(const Mesh& mesh, const Owner& o);
    /// Its corners alone.
    std::vector<Index> corners_of(const Owner& o) const;

    /// Whether those corners are fewer than a face (edge) of an element that is not degenerate has.
    bool is_degenerate(const Key& key) const { return key[static_cast<std::size_t>(dimension_) - 1] < 0; }

    /// Calls visit(CellRef) for each element of a dimension.
    void for_each_of(int dimension, auto visit) const {
        SparseCheck check;
        for (const CellBlock& b : mesh_.blocks()) {
            if (traits(b.type).dimension != dimension) continue;
            for (Index c = 0; c < b.size(); ++c) {
                check();
                visit(CellRef{b.type, c});
            }
        }
    }

private:
    bool has(FamilyIndex family) const { return mesh_.families.contains(family, group_); }
    void find_elements();
    void find_wanted();
    void find_owners();
    void ask(const Key& key, Face& face) const;
    void orient();
    bool is_turned(const std::vector<Face*>& patch) const;

    const Mesh& mesh_;
    const GroupIndex group_;
    const int dimension_;
    const std::vector<double>* distance_ = nullptr;  // in place of a group: from a surface
    double rounding_ = 0;
    std::vector<char> reached_;  // nodes of wanted faces
    std::map<Key, Face> faces_;
    std::map<Key, CellRef> told_;  // the element whose facet it is
};

}  // namespace femscalpel
