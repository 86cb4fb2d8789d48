// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/vtu_file.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "cancel.h"
#include "error.h"
#include "io/inp_file.h"
#include "io/plain_text.h"
#include "io/vtu_bytes.h"
#include "io/vtu_xml.h"
#include "utf8.h"

namespace femscalpel {
namespace {

struct VtuNumber {
    std::string_view type;
    std::size_t bytes;
    bool integer;
};

constexpr VtuNumber vtu_numbers[] = {
    {"Int8", 1, true},   {"UInt8", 1, true}, {"Int16", 2, true},  {"UInt16", 2, true},   {"Int32", 4, true},
    {"UInt32", 4, true}, {"Int64", 8, true}, {"UInt64", 8, true}, {"Float32", 4, false}, {"Float64", 8, false}};

const VtuNumber* vtu_number(const VtuArray& array) {
    const auto* const found = std::ranges::find(vtu_numbers, std::string_view(array["type"]), &VtuNumber::type);
    return found == std::end(vtu_numbers) ? nullptr : found;
}

template <class Stored, class T>
void convert_vtu(const std::string& bytes, bool swapped, std::vector<T>& out) {
    out.resize(bytes.size() / sizeof(Stored));
    SparseCheck check(1 << 16);
    for (std::size_t k = 0; k < out.size(); ++k, check()) {
        char one[sizeof(Stored)];
        std::memcpy(one, bytes.data() + k * sizeof(Stored), sizeof(Stored));
        if (swapped) std::reverse(one, one + sizeof(Stored));
        Stored value;
        std::memcpy(&value, one, sizeof(Stored));
        out[k] = static_cast<T>(value);  // NOLINT(bugprone-signed-char-misuse): Int8 holds numbers
    }
}

/// Whether XML says that it is Latin-1 or Windows-1252, which programs take for the same.
bool declares_latin_1(std::string_view xml) {
    if (!xml.starts_with("<?xml")) return false;
    std::string declaration(xml.substr(0, xml.find("?>")));
    for (char& c : declaration)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    const std::size_t encoding = declaration.find("encoding");
    if (encoding == declaration.npos) return false;
    const std::string_view said = std::string_view(declaration).substr(encoding);
    return said.find("iso-8859-1\"") != said.npos || said.find("iso-8859-1'") != said.npos ||
           said.find("windows-1252") != said.npos;
}

}  // namespace

const std::string& VtuArray::operator[](const std::string& attribute) const {
    static const std::string none;
    const auto found = attributes.find(attribute);
    return found == attributes.end() ? none : found->second;
}

VtuFile::VtuFile(const std::filesystem::path& path) : shown_(shown_path(path)), text_(load_bytes(path)) {
    make_utf8();
    const std::string_view text(text_);
    const std::size_t appended = text.find("<AppendedData");
    const std::size_t tag = appended == text.npos ? text.npos : text.find('>', appended);
    VtuHead head = read_vtu_xml(tag == text.npos ? text : text.substr(0, tag + 1), shown_);
    if (tag != text.npos) {
        const std::size_t start = text.find('_', tag);
        if (start != text.npos) appended_ = text.substr(start + 1);
    }
    appended_base64_ = head.appended_encoding == "base64";
    swapped_ = head.byte_order == (std::endian::native == std::endian::little ? "BigEndian" : "LittleEndian");
    header_bytes_ = head.header_type == "UInt64" ? 8 : 4;
    compressed_ = !head.compressor.empty();
    if (compressed_ && head.compressor != "vtkZLibDataCompressor")
        throw ReadError(shown_ + ": arrays compressed by " + head.compressor +
                        " are not read; save the file uncompressed or compressed with zlib");
    points_ = head.points;
    cells_ = head.cells;
    if (static_cast<std::uint64_t>(std::max(points_, cells_)) > largest())
        throw ReadError(shown_ + ": the file says that it has more nodes or elements than it can hold");
    arrays_ = std::move(head.arrays);
}

void VtuFile::make_utf8() {
    const std::string_view text(text_);
    const std::size_t appended = text.find("<AppendedData");
    const std::size_t end = appended == text.npos ? text.npos : text.find('>', appended);
    const std::string_view head = text.substr(0, end);
    const bool is_declared = declares_latin_1(head);
    const std::size_t odd = not_utf8(head);
    if (odd == text.npos && !is_declared) return;
    std::string rest = end == text.npos ? std::string() : text_.substr(end);
    if (end != text.npos) text_.resize(end);
    text_ = (is_declared ? from_windows_1252(text_) : plain_text(std::move(text_), shown_, remarks_)) + rest;
}

const VtuArray* VtuFile::find(std::string_view section, std::string_view name) const {
    const auto found = std::ranges::find_if(
        arrays_, [&](const VtuArray& a) { return a.section == section && (name.empty() || a.name() == name); });
    return found == arrays_.end() ? nullptr : &*found;
}

void VtuFile::fail(Index line, const std::string& what) const {
    throw ReadError(shown_ + ":" + std::to_string(line) + ": " + what);
}

void VtuFile::fail(const VtuArray& array, const std::string& what) const {
    fail(array.line,
         "the array '" + array.name() + "' of " + (array.section.empty() ? "the file" : array.section) + " " + what);
}

bool VtuFile::is_integer(const VtuArray& array) {
    const VtuNumber* number = vtu_number(array);
    return number && number->integer;
}

std::string VtuFile::bytes(const VtuArray& array, std::uint64_t most) const {
    std::string_view text = array.inside;
    bool base64 = true;
    if (array["format"] == "appended") {
        std::size_t offset = 0;
        const std::string& written = array["offset"];
        const auto [end, error] = std::from_chars(written.data(), written.data() + written.size(), offset);
        if (error != std::errc() || end != written.data() + written.size() || offset > appended_.size())
            fail(array, "has no offset within the appended data");
        text = appended_.substr(offset);
        base64 = appended_base64_;
    }
    VtuBytes stream(text, base64);
    const auto ended = [&] { fail(array, "is truncated or damaged"); };
    const auto number = [&]() -> std::uint64_t {
        char raw[8] = {};
        const auto size = static_cast<std::size_t>(header_bytes_);
        if (!stream.read(raw, size)) ended();
        if (swapped_) std::reverse(raw, raw + size);
        std::uint64_t wide = 0;
        std::uint32_t narrow = 0;
        std::memcpy(&wide, raw, 8);
        std::memcpy(&narrow, raw, 4);
        return header_bytes_ == 8 ? wide : narrow;
    };
    const auto too_much = [&](std::uint64_t size) {
        fail(array, "has " + std::to_string(size) + " bytes, of at most " + std::to_string(most));
    };
    std::string out;
    if (!compressed_) {
        const std::uint64_t size = number();
        if (size > most) too_much(size);
        if (size > stream.left()) ended();
        out.resize(size);
        if (!stream.read(out.data(), size)) ended();
        return out;
    }
    const std::uint64_t blocks = number(), full = number(), last = number();
    if (blocks == 0) return out;
    if (blocks > stream.left() || full > largest() || last > full) ended();
    const std::uint64_t total = (blocks - 1) * full + (last == 0 ? full : last);
    if (total > most || full > most + (1U << 20)) too_much(total);
    std::vector<std::uint64_t> sizes(blocks);
    for (std::uint64_t& size : sizes) size = number();
    out.resize(total);
    std::string packed;
    for (std::uint64_t b = 0; b < blocks; ++b) {
        check_cancelled();
        if (sizes[b] > stream.left()) ended();
        packed.resize(sizes[b]);
        if (!stream.read(packed.data(), packed.size())) ended();
        uLongf length = b + 1 == blocks ? total - b * full : full;
        const uLongf wanted = length;
        if (uncompress(reinterpret_cast<Bytef*>(out.data() + b * full), &length,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()) != Z_OK ||
            length != wanted)
            ended();
    }
    return out;
}

template <class T>
std::vector<T> VtuFile::text_values(const VtuArray& array, Index most) const {
    std::vector<T> out;
    SparseCheck check(1 << 14);
    const char* at = array.inside.data();
    const char* const end = at + array.inside.size();
    const auto blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (true) {
        check();
        while (at < end && blank(*at)) ++at;
        if (at == end) return out;
        T value{};
        const auto [stop, error] = std::from_chars(at, end, value);
        const std::string_view written(at, static_cast<std::size_t>(stop - at));
        const bool tiny = error == std::errc::result_out_of_range &&
                          (written.find("e-") != written.npos || written.find("E-") != written.npos);  // that is 0
        if ((error != std::errc() && !tiny) || (stop < end && !blank(*stop))) {
            const char* word = std::find_if(at, end, blank);
            fail(array, "has the entry '" + std::string(at, std::min(word, at + 40)) + "', which is no " +
                            (std::is_integral_v<T> ? "whole " : "") + "number");
        }
        if (std::ssize(out) == most) fail(array, "has more than " + std::to_string(most) + " values");
        out.push_back(value);
        at = stop;
    }
}

template <class T>
std::vector<T> VtuFile::values(const VtuArray& array, Index least, Index most) const {
    const VtuNumber* number = vtu_number(array);
    if (!number || (std::is_integral_v<T> && !number->integer))
        fail(array, "has values of the type '" + array["type"] + "', not " +
                        (std::is_integral_v<T> ? "whole numbers" : "numbers"));
    std::vector<T> out;
    const std::string& format = array["format"];
    if (format == "ascii") {
        out = text_values<T>(array, most);
    } else if (format == "binary" || format == "appended") {
        const std::string raw = bytes(array, static_cast<std::uint64_t>(most) * number->bytes);
        if (raw.size() % number->bytes != 0) fail(array, "does not end with a whole value");
        const bool is_signed = number->type[0] == 'I';
        switch (number->bytes) {
            case 1:
                is_signed ? convert_vtu<std::int8_t>(raw, swapped_, out)
                          : convert_vtu<std::uint8_t>(raw, swapped_, out);
                break;
            case 2:
                is_signed ? convert_vtu<std::int16_t>(raw, swapped_, out)
                          : convert_vtu<std::uint16_t>(raw, swapped_, out);
                break;
            case 4:
                if (!number->integer)
                    convert_vtu<float>(raw, swapped_, out);
                else
                    is_signed ? convert_vtu<std::int32_t>(raw, swapped_, out)
                              : convert_vtu<std::uint32_t>(raw, swapped_, out);
                break;
            default:
                if (!number->integer)
                    convert_vtu<double>(raw, swapped_, out);
                else
                    convert_vtu<std::int64_t>(raw, swapped_, out);
        }
    } else {
        fail(array, "has the format '" + format + "', which is none of ascii, binary and appended");
    }
    if (std::ssize(out) < least)
        fail(array, "has " + std::to_string(out.size()) + " values, not " + std::to_string(least));
    return out;
}

std::vector<Index> VtuFile::integers(const VtuArray& array, Index count) const {
    return values<Index>(array, count, count);
}

std::vector<Index> VtuFile::all_integers(const VtuArray& array, Index largest) const {
    return values<Index>(array, 0, largest);
}

std::vector<double> VtuFile::reals(const VtuArray& array, Index count) const {
    std::vector<double> out = values<double>(array, count, count);
    for (const double value : out)
        if (!std::isfinite(value)) fail(array, "has a value that is not a finite number");
    return out;
}

}  // namespace femscalpel
