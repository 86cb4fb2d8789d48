// SPDX-License-Identifier: LGPL-2.1-or-later
// Text of files in whatever encoding and with whatever ends of lines.
#include "io/plain_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "error.h"
#include "utf8.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Utf8, IsToldFromWhatIsNot) {
    EXPECT_EQ(not_utf8(""), std::string::npos);
    EXPECT_EQ(not_utf8("plain ASCII, longer than eight bytes\x7f"), std::string::npos);
    EXPECT_EQ(not_utf8("Gr\u00f6\u00dfe \u65e5\u672c \U0001F600"), std::string::npos);
    EXPECT_EQ(not_utf8("0123456789 Gr\xf6\xdf"
                       "e"),
              13U);
    EXPECT_EQ(not_utf8("cut \xc3"), 4U);
    EXPECT_EQ(not_utf8("\xa0"), 0U) << "a byte that goes on with nothing";
    EXPECT_EQ(not_utf8("\xc0\xaf"), 0U) << "overlong";
    EXPECT_EQ(not_utf8("\xe0\x9f\xbf"), 0U) << "overlong";
    EXPECT_EQ(not_utf8("\xf0\x8f\xbf\xbf"), 0U) << "overlong";
    EXPECT_EQ(not_utf8("\xed\xa0\x80"), 0U) << "half a character";
    EXPECT_EQ(not_utf8("\xf4\x90\x80\x80"), 0U) << "beyond Unicode";
}

TEST(Utf8, IsMadeOfWindows1252) {
    EXPECT_EQ(from_windows_1252("Gr\xf6\xdf"
                                "e \x80 \x96 mm\xb2"),
              "Gr\u00f6\u00dfe \u20ac \u2013 mm\u00b2");
    std::string all;
    for (int c = 1; c < 256; ++c) all += static_cast<char>(c);
    EXPECT_EQ(not_utf8(from_windows_1252(all)), std::string::npos);
    EXPECT_EQ(as_utf8("\u00e4"), "\u00e4");
    EXPECT_EQ(as_utf8("\xe4"), "\u00e4");
    EXPECT_EQ(shown_path(std::filesystem::path("b\xff.med")), "b\u00ff.med");
}

TEST(Utf8, IsMadeWindows1252Again) {
    std::string all;
    for (int c = 1; c < 256; ++c) all += static_cast<char>(c);
    EXPECT_EQ(to_windows_1252(from_windows_1252(all)), all);
    EXPECT_EQ(to_windows_1252(""), "");
    EXPECT_EQ(to_windows_1252("\u0100"), std::nullopt);
    EXPECT_EQ(to_windows_1252("\u0080"), std::nullopt) << "where it has the euro sign";
    EXPECT_EQ(to_windows_1252("\U0001F600"), std::nullopt);
    EXPECT_EQ(to_windows_1252("\xe4"), std::nullopt) << "no UTF-8";
}

class PlainText : public testing::Test {
protected:
    std::string plain(const std::string& bytes) {
        remarks_.clear();
        return plain_text(bytes, "a.inp", remarks_);
    }

    std::vector<std::string> remarks_;
};

TEST_F(PlainText, IsWhatIsUtf8) {
    for (const std::string& text : {std::string(), std::string("*NODE\n1, 0.\r\n"), std::string("Gr\u00f6\u00dfe\n")}) {
        EXPECT_EQ(plain(text), text);
        EXPECT_EQ(plain("\xEF\xBB\xBF" + text), text) << "without a byte-order mark";
        EXPECT_THAT(remarks_, IsEmpty());
    }
}

TEST_F(PlainText, IsOneEncodingThroughout) {
    // The last line would be UTF-8 alone; two names must not become one.
    EXPECT_EQ(plain("one\nGr\xf6\xdf"
                    "e\nGr\xc3\xb6\xc3\x9f"
                    "e\n"),
              "one\nGr\u00f6\u00dfe\nGr\u00c3\u00b6\u00c3\u0178e\n");
    EXPECT_THAT(remarks_, ElementsAre(HasSubstr("a.inp:2: the text is not UTF-8, here for the first time")));
}

TEST_F(PlainText, HasLinesThatEnd) {
    EXPECT_EQ(plain("a\rb\r\rc"), "a\nb\n\nc");
    EXPECT_EQ(plain("a\rb\rc\r\n"), "a\nb\nc\r\n") << "the last line is somebody else's";
    EXPECT_EQ(plain("a\r\nb\r\n"), "a\r\nb\r\n");
    EXPECT_EQ(plain("a\r\r\nb\r\r\n"), "a\r\r\nb\r\r\n");
    EXPECT_EQ(plain("a\nb\rc\nd\n"), "a\nb\rc\nd\n");
    EXPECT_EQ(plain("a\rGr\xf6\r"), "a\nGr\u00f6\n");
    EXPECT_THAT(remarks_, ElementsAre(HasSubstr("a.inp:2:")));
}

TEST_F(PlainText, IsNoUtf16) {
    using std::string_literals::operator""s;
    for (const std::string& mark : {"\xFF\xFE"s, "\xFE\xFF"s, "\xFF\xFE\0\0"s, "\0\0\xFE\xFF"s})
        EXPECT_THAT([&] { plain(mark + "*\0N\0"s); },
                    testing::ThrowsMessage<ReadError>(HasSubstr("a.inp: this is text in UTF-16 or UTF-32")));
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
