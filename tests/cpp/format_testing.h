// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "error.h"
#include "mesh/mesh.h"
#include "random_numbers.h"

namespace femscalpel::checks {

/// A mesh of one element of every type but those listed, in overlapping groups: all nodes lie about the unit cube,
/// numbers do not start at 1, some groups are empty and one name belongs to groups of both kinds.
Mesh one_of_each(std::initializer_list<CellType> without);

/// Expects two meshes to be the same: numbers, coordinates, elements, groups in their order with their members.
void expect_equal(const Mesh& found, const Mesh& expected);

/// The text of a binary file, put together value by value.
class Bytes {
public:
    explicit Bytes(bool swapped = false) : swapped_(swapped) {}

    Bytes& text(const std::string& s) {
        out_ += s;
        return *this;
    }
    template <class T>
    Bytes& put(std::initializer_list<T> values) {
        for (const T value : values) {
            char bytes[sizeof(T)];
            std::memcpy(bytes, &value, sizeof(T));
            if (swapped_) std::reverse(bytes, bytes + sizeof(T));
            out_.append(bytes, sizeof(T));
        }
        return *this;
    }
    const std::string& str() const { return out_; }

private:
    std::string out_;
    bool swapped_;
};

/// Reads texts that are files for the time of a test.
class TextReading : public testing::Test {
protected:
    using Reader = Mesh (*)(const std::filesystem::path&);

    /// `ending`: such as ".unv".
    TextReading(Reader reader, const std::string& ending)
        : reader_(reader),
          path_(std::filesystem::path(testing::TempDir()) /
                ("femscalpel_" + std::to_string(::getpid()) + "_" +
                 testing::UnitTest::GetInstance()->current_test_info()->name() + ending)) {}

    void TearDown() override { std::filesystem::remove(path_); }

    Mesh read(const std::string& text) const {
        std::filesystem::remove(path_);  // to write over a file waits for the disk
        std::ofstream(path_, std::ios::binary | std::ios::trunc) << text;
        return reader_(path_);
    }

    /// A mesh's remarks, a line each, without the file's name that each begins with.
    std::string remarks(const Mesh& mesh) const {
        std::string out;
        for (const std::string& r : mesh.remarks) {
            EXPECT_TRUE(r.starts_with(path_.string() + ":")) << r;
            out += r.substr(path_.string().size()) + "\n";
        }
        return out;
    }

    /// A message that begins with a colon goes on behind the file's name.
    void expect_error(const std::string& text, const std::string& message) const {
        EXPECT_THAT([&] { read(text); }, testing::ThrowsMessage<Error>(
                                             testing::HasSubstr((message[0] == ':' ? path_.string() : "") + message)))
            << text;
    }

    /// Reads a file so many times, each time damaged otherwise: bytes changed, in every other round to one of
    /// `characters`, a line less, or its end cut off. Errors have to name the file.
    void read_damaged(const std::string& whole, int rounds, const std::string& characters, Random& random) {
        for (int round = 0; round < rounds; ++round) {
            std::string text = whole;
            const auto pick = [&](std::size_t n) { return static_cast<std::size_t>(random.bits() % n); };
            if (round % 5 == 0) text.resize(pick(text.size()));
            if (round % 5 == 1) {  // a line less
                const std::size_t from = text.rfind('\n', pick(text.size())), to = text.find('\n', from + 1);
                if (from != text.npos && to != text.npos) text.erase(from, to - from);
            }
            for (std::size_t k = round % 5 < 2 ? pick(2) : 1 + pick(4); k > 0 && !text.empty(); --k) {
                char& c = text[pick(text.size())];
                c = round % 2 ? static_cast<char>(random.bits()) : characters[pick(characters.size())];
            }
            try {
                read(text).validate();
                ++read_well_;
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), testing::StartsWith(path_.string() + ":")) << round;
                ++refused_;
            }
        }
    }

    const Reader reader_;
    const std::filesystem::path path_;
    int read_well_ = 0, refused_ = 0;  // by read_damaged()
};

}  // namespace femscalpel::checks
