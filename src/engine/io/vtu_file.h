// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"

namespace femscalpel {

/// An array of a VTK XML file, as its element says.
struct VtuArray {
    std::string section;  ///< "Points", "Cells", "PointData", "CellData"
    std::map<std::string, std::string> attributes;
    Index line = 0;
    std::string_view inside;  ///< the text of the element itself

    /// An attribute's value; empty without.
    const std::string& operator[](const std::string& attribute) const;
    const std::string& name() const { return (*this)["Name"]; }
};

/// A VTK XML file of an unstructured grid (.vtu): its arrays, which are decoded when they are asked for. Text, binary
/// and appended, raw and base64, of either byte order, plain and compressed with zlib. Errors are ReadErrors that name
/// file and line, or file and array.
class VtuFile {
public:
    /// Loads the file and reads its XML.
    explicit VtuFile(const std::filesystem::path& path);

    const std::string& shown() const { return shown_; }
    /// What there is to say of the file's text (plain_text.h).
    const std::vector<std::string>& remarks() const { return remarks_; }
    Index points() const { return points_; }
    Index cells() const { return cells_; }
    const std::vector<VtuArray>& arrays() const { return arrays_; }
    /// The array of a section; null if there is none. An empty name is any.
    const VtuArray* find(std::string_view section, std::string_view name) const;

    /// `count` values of an array, which must be whole numbers.
    std::vector<Index> integers(const VtuArray& array, Index count) const;
    /// The same, as many as there are, at most `largest`.
    std::vector<Index> all_integers(const VtuArray& array, Index largest) const;
    /// `count` values of an array, all finite.
    std::vector<double> reals(const VtuArray& array, Index count) const;
    /// Whether the values are whole numbers by their type.
    static bool is_integer(const VtuArray& array);

    [[noreturn]] void fail(Index line, const std::string& what) const;
    [[noreturn]] void fail(const VtuArray& array, const std::string& what) const;

private:
    /// Makes what is text in the file UTF-8, as the XML is parsed, whatever it says of itself.
    void make_utf8();
    template <class T>
    std::vector<T> values(const VtuArray& array, Index least, Index most) const;
    template <class T>
    std::vector<T> text_values(const VtuArray& array, Index most) const;
    std::string bytes(const VtuArray& array, std::uint64_t most) const;
    /// No array can have more bytes than this; a larger count is damage. Compressed data shrink at most so much.
    std::uint64_t largest() const { return 1100 * (text_.size() + 1024); }

    std::string shown_;
    std::vector<std::string> remarks_;
    std::string text_;
    std::vector<VtuArray> arrays_;
    std::string_view appended_;  // what follows "_"
    bool appended_base64_ = false;
    bool swapped_ = false;
    bool compressed_ = false;
    int header_bytes_ = 4;
    Index points_ = 0, cells_ = 0;
};

}  // namespace femscalpel
