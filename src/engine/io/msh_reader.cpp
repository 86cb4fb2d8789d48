// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <charconv>
#include <map>
#include <memory>

#include "error.h"
#include "io/msh.h"
#include "io/msh_builder.h"
#include "io/msh_sections.h"
#include "io/msh_source.h"
#include "io/msh_types.h"
#include "utf8.h"

namespace femscalpel {
namespace {

/// What sections hold that are passed over.
constexpr struct {
    std::string_view name, holds;
} passed_over_in_msh[] = {
    {"Periodic", "which nodes are periodic"},
    {"GhostElements", "which elements are ghosts"},
    {"Parametrizations", "the geometry's parametrizations"},
    {"NodeData", "results in nodes"},
    {"ElementData", "results in elements"},
    {"ElementNodeData", "results in elements' nodes"},
    {"InterpolationScheme", "how results are interpolated"},
    {"Comments", "comments"},
};

class MshReader {
public:
    MshReader(MshSource& source, RepeatedNumber sought, std::string name) : source_(source), builder_(source, sought) {
        builder_.mesh().name = std::move(name);
        builder_.mesh().remarks = source.remarks();
    }

    Mesh read() {
        source_.rewind();
        read_format();
        read_names();
        read_sections();
        sections_->finish();
        for (const auto& [section, at] : passed_) tell_passed(section, at);
        return builder_.finish();
    }

private:
    struct Passed {
        Index first_line = 0;
        Index count = 0;
    };

    void read_format() {
        const std::string_view first = source_.word();
        if (first == "$NOD" || first == "$PTS")
            source_.fail("files of Gmsh's version 1 are not read; save it anew with Gmsh, which reads them");
        if (first != "$MeshFormat")
            source_.fail(
                "this is no mesh of Gmsh, which begins with $MeshFormat (other programs, as Fluent, have files "
                "of the same extension, which are not read)");
        source_.rewind();
        source_.next_section();
        const std::string_view version = source_.word();
        const Index file_type = source_.text_integer(), bytes = source_.text_integer();
        if (version == "4.1")
            sections_ = std::make_unique<Msh4Sections>(source_, builder_, 1);
        else if (version == "4" || version == "4.0")
            sections_ = std::make_unique<Msh4Sections>(source_, builder_, 0);
        else if (version == "2" || version == "2.0" || version == "2.1" || version == "2.2")
            sections_ = std::make_unique<Msh2Sections>(source_, builder_);
        else
            source_.fail("version " + std::string(version.substr(0, 12)) +
                         " of Gmsh's format is not read, but 2.0 to 2.2, 4.0 and 4.1; save it as one of these "
                         "(Mesh.MshFileVersion in Gmsh)");
        if (file_type == 1)
            start_binary(version, bytes);
        else if (file_type != 0)
            source_.fail("the file type " + std::to_string(file_type) + " is neither 0, text, nor 1, binary");
        source_.end_section();
    }

    void start_binary(std::string_view version, Index bytes) {
        if (version == "4" || version == "4.0")
            source_.fail("binary files of version 4.0 are not read; save it as 4.1 (Mesh.MshFileVersion in Gmsh)");
        if (bytes != 8 && !(version == "4.1" && bytes == 4))
            source_.fail("numbers of " + std::to_string(bytes) + " bytes are not read");
        source_.rest_of_line();
        source_.set_binary(false);
        source_.set_size_bytes(static_cast<int>(bytes));
        const Index one = source_.integer();
        if (one == 0x01000000)
            source_.set_binary(true);
        else if (one != 1)
            source_.fail("the byte order cannot be told: here should be the number 1");
    }

    /// Names come first, wherever they stand in the file.
    void read_names() {
        read_own_comment();
        source_.rewind_to_sections();
        if (source_.find_section("PhysicalNames")) {
            const Index count = source_.text_integer();
            source_.rest_of_line();
            source_.expect(count, 3);
            for (Index k = 0; k < count; ++k) read_name();
            source_.end_section();
        }
        builder_.groups().make_named();
        source_.rewind_to_sections();
    }

    void read_name() {
        const Index dimension = source_.text_integer(), tag = source_.text_integer();
        const std::string_view rest = source_.rest_of_line();
        const auto open = rest.find('"'), close = rest.rfind('"');
        if (open == rest.npos || close == open)
            source_.fail("expected a dimension, a tag and a name in quotation marks, as 2 1 \"WALL\"");
        if (dimension < 0 || dimension > 3) source_.fail("there is no dimension " + std::to_string(dimension));
        if (tag <= 0 || tag > 2147483647) source_.fail("there is no physical tag " + std::to_string(tag));
        const std::string_view name = rest.substr(open + 1, close - open - 1);
        if (!builder_.groups().name(static_cast<int>(dimension), tag, name))
            source_.fail("the physical group of dimension " + std::to_string(dimension) + " and tag " +
                         std::to_string(tag) + " has two names");
    }

    /// What write_msh() says of node groups.
    void read_own_comment() {
        source_.rewind_to_sections();
        if (!source_.find_section("Comments")) return;
        const std::string_view text = source_.content();
        if (!text.starts_with(msh_node_groups_comment)) return;
        std::vector<Index> tags;
        const char* p = text.data() + msh_node_groups_comment.size();
        const char* const end = text.data() + text.size();
        for (Index tag = 0; p < end && *p == ' ';) {
            const auto [q, error] = std::from_chars(p + 1, end, tag);
            if (error != std::errc()) return;  // somebody changed it
            tags.push_back(tag);
            p = q;
        }
        builder_.groups().set_node_groups(std::move(tags));
        own_comment_ = source_.section_line();
    }

    void read_sections() {
        for (std::string_view section = source_.next_section(); !section.empty(); section = source_.next_section()) {
            check_cancelled();
            if (section == "PhysicalNames") {
                source_.skip_section();
                if (names_met_) source_.fail("there is a second section of physical names");
                names_met_ = true;
            } else if (sections_->read(section)) {
                source_.end_section();
            } else {
                Passed& passed = passed_[std::string(section)];
                const Index line = source_.section_line();
                if (line == own_comment_)
                    passed_.erase(std::string(section));
                else if (passed.count++ == 0)
                    passed.first_line = line;
                source_.skip_section();
            }
        }
    }

    void tell_passed(const std::string& section, const Passed& at) {
        const auto* const known =
            std::ranges::find(passed_over_in_msh, std::string_view(section), [](auto& p) { return p.name; });
        std::string text = source_.shown();
        if (!source_.is_binary()) text += ":" + std::to_string(at.first_line);
        text += ": the section $" + section + " is not read";
        if (known != std::end(passed_over_in_msh)) text += ": " + std::string(known->holds);
        if (at.count > 1) text += " (there are " + std::to_string(at.count) + " of them)";
        builder_.remark(std::move(text));
    }

    MshSource& source_;
    MshBuilder builder_;
    std::unique_ptr<MshSections> sections_;
    std::map<std::string, Passed> passed_;
    Index own_comment_ = -1;  // line of the section that is ours
    bool names_met_ = false;
};

}  // namespace

Mesh read_msh(const std::filesystem::path& path) {
    MshSource source(path);
    const std::string name = shown_path(path.stem());
    try {
        return MshReader(source, {}, name).read();
    } catch (const RepeatedNumber& repeated) {
        return MshReader(source, repeated, name).read();  // throws where the number stands for the second time
    }
}

}  // namespace femscalpel
