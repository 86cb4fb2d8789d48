// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/vtu_xml.h"

#include <expat.h>

#include <algorithm>
#include <charconv>
#include <exception>
#include <memory>

#include "cancel.h"
#include "error.h"

namespace femscalpel {
namespace {

// Where Expat has counters of 64 bits it deprecates the others; which there are is looked for, not told by its version.
auto line_of(auto parser) {
    if constexpr (requires { XML_GetCurrentLineNumber64(parser); })
        return XML_GetCurrentLineNumber64(parser);
    else
        return XML_GetCurrentLineNumber(parser);
}
auto byte_of(auto parser) {
    if constexpr (requires { XML_GetCurrentByteIndex64(parser); })
        return XML_GetCurrentByteIndex64(parser);
    else
        return XML_GetCurrentByteIndex(parser);
}
auto bytes_of(auto parser) {
    if constexpr (requires { XML_GetCurrentByteCount64(parser); })
        return XML_GetCurrentByteCount64(parser);
    else
        return XML_GetCurrentByteCount(parser);
}

class VtuXmlReader {
public:
    VtuXmlReader(std::string_view xml, const std::string& shown) : xml_(xml), shown_(shown) {}

    VtuHead read() {
        const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate("UTF-8"), XML_ParserFree);
        if (!parser) throw std::bad_alloc();
        parser_ = parser.get();
        XML_SetUserData(parser_, this);
        XML_SetElementHandler(parser_, &VtuXmlReader::start, &VtuXmlReader::end);
        // In pieces, as text is scanned for long when arrays stand in it.
        constexpr std::size_t piece = 1 << 22;
        for (std::size_t at = 0; at < xml_.size() && !problem_; at += piece) {
            check_cancelled();
            const std::string_view part = xml_.substr(at, piece);
            if (XML_Parse(parser_, part.data(), static_cast<int>(part.size()), XML_FALSE) == XML_STATUS_ERROR &&
                !problem_)
                fail(XML_ErrorString(XML_GetErrorCode(parser_)));
        }
        if (problem_) std::rethrow_exception(problem_);
        if (!grid_) fail("this is no VTK file of an unstructured grid");
        if (pieces_ == 0) fail("the grid has no piece");
        return std::move(head_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw ReadError(shown_ + ":" + std::to_string(line_of(parser_)) + ": " + what);
    }

    /// Exceptions must not pass through expat, which is C.
    static void start(void* self, const XML_Char* name, const XML_Char** attributes) {
        auto& reader = *static_cast<VtuXmlReader*>(self);
        try {
            std::map<std::string, std::string> values;
            for (; *attributes; attributes += 2) values.emplace(attributes[0], attributes[1]);
            reader.start(name, std::move(values));
        } catch (...) {
            reader.stop();
        }
    }
    static void end(void* self, const XML_Char* name) {
        auto& reader = *static_cast<VtuXmlReader*>(self);
        try {
            reader.end(name);
        } catch (...) {
            reader.stop();
        }
    }
    void stop() {
        if (!problem_) problem_ = std::current_exception();
        XML_StopParser(parser_, XML_FALSE);
    }

    std::size_t offset() const { return static_cast<std::size_t>(byte_of(parser_)); }

    void start(std::string_view name, std::map<std::string, std::string> values) {
        if (is_array_) {  // as InformationKey, before or after the values
            if (++within_array_ == 1) values_follow_ = !has_values();
            if (within_array_ == 1 && !values_follow_) stop_ = std::min(stop_, offset());
            return;
        }
        if (++depth_ == 1) {
            if (name != "VTKFile" || values["type"] != "UnstructuredGrid")
                fail("this is no VTK file of an unstructured grid, but of " +
                     (name == "VTKFile" ? "the type '" + values["type"] + "'" : "something else"));
            head_.byte_order = values["byte_order"];
            head_.header_type = values["header_type"];
            head_.compressor = values["compressor"];
            grid_ = true;
        } else if (name == "Piece") {
            if (++pieces_ > 1)
                fail("the grid has several pieces, whose nodes are double where they meet; save it as one");
            head_.points = count(values, "NumberOfPoints");
            head_.cells = count(values, "NumberOfCells");
        } else if (name == "DataArray" || name == "Array") {
            head_.arrays.push_back({section_, std::move(values), static_cast<Index>(line_of(parser_)), {}});
            inside_ = offset() + static_cast<std::size_t>(bytes_of(parser_));
            stop_ = xml_.size();
            is_array_ = true;
        } else if (name == "AppendedData") {
            head_.appended_encoding = values["encoding"];
        } else {
            section_ = name;
        }
    }

    void end(std::string_view name) {
        if (within_array_ > 0) {
            if (--within_array_ == 0 && values_follow_)
                inside_ = offset() + static_cast<std::size_t>(bytes_of(parser_));
            return;
        }
        --depth_;
        if (is_array_) {
            // Of an empty element, <DataArray/>, both events are at the same place.
            stop_ = std::min(stop_, offset());
            head_.arrays.back().inside = stop_ > inside_ ? xml_.substr(inside_, stop_ - inside_) : std::string_view();
            is_array_ = false;
        } else if (name == section_) {
            section_.clear();
        }
    }

    /// Whether there is anything but blanks between the start of the current array's text and here.
    bool has_values() const {
        const std::size_t here = std::min(stop_, offset());
        return here > inside_ && xml_.substr(inside_, here - inside_).find_first_not_of(" \t\r\n") != xml_.npos;
    }

    Index count(const std::map<std::string, std::string>& values, const char* name) const {
        const auto found = values.find(name);
        Index out = -1;
        if (found != values.end()) {
            const std::string& text = found->second;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
            if (error != std::errc() || end != text.data() + text.size()) out = -1;
        }
        if (out < 0) fail(std::string("the piece has no ") + name + " that is a number");
        return out;
    }

    std::string_view xml_;
    const std::string& shown_;
    XML_Parser parser_ = nullptr;
    VtuHead head_;
    std::string section_;  // "PointData", ...
    std::exception_ptr problem_;
    std::size_t inside_ = 0, stop_ = 0;  // where the text of the current array starts and ends
    int depth_ = 0, within_array_ = 0, pieces_ = 0;
    bool grid_ = false, is_array_ = false, values_follow_ = false;
};

}  // namespace

VtuHead read_vtu_xml(std::string_view xml, const std::string& shown) { return VtuXmlReader(xml, shown).read(); }

}  // namespace femscalpel
