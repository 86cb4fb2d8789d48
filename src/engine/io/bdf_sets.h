// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "io/bdf_source.h"

namespace femscalpel {

/// Numbers as sets list them: 1, 2, 5 THRU 10, 20 THRU 100 BY 5, EXCEPT 30.
class BdfNumbers {
public:
    /// From words in capitals, a comma or blank between each. False where they are no whole numbers, or ALL.
    bool parse(const std::vector<std::string>& words);

    /// Those of `sorted` that are listed, ascending.
    std::vector<Index> among(const std::vector<Index>& sorted) const;

    /// How many that are listed singly are not among `sorted`.
    Index absent(const std::vector<Index>& sorted) const;

private:
    struct Range {
        Index first, last, step;
        std::vector<Index> except;
    };
    std::vector<Index> single_;
    std::vector<Range> ranges_;
};

/// A set of case control.
struct BdfSet {
    Index number = 0;
    const char* at = nullptr;
    std::optional<BdfNumbers> numbers;           ///< none where they are all, or no whole numbers
    bool of_nodes = false, of_elements = false;  ///< as output requests use it
};

/// The sets among a deck's statements, in their order, and how many other statements there are.
std::vector<BdfSet> bdf_sets(const BdfSource& source, Index& others);

/// Names that preprocessors write as comments.
struct BdfNames {
    /// A set's name.
    struct Set {
        Index number;
        GroupKind kind;
        std::string name;
    };
    std::vector<Set> sets;                    ///< of HyperMesh, in the file's order
    std::map<Index, std::string> properties;  ///< by number
    bool stand_ins = false;                   ///< properties stand for no groups (write_bdf())
};

/// The names among a deck's comments; empty where there are none.
BdfNames bdf_names(const BdfSource& source);

/// The comment that says that properties stand for no groups.
inline constexpr const char* bdf_stand_ins = "$ FemScalpel: property 1 stands for no group; the groups are the sets";

}  // namespace femscalpel
