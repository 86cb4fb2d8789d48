// SPDX-License-Identifier: LGPL-2.1-or-later
#include "io/quiet_libraries.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <iostream>
#include <string>
#include <thread>

namespace femscalpel {
namespace FILE_NAMESPACE {

/// As C code prints it.
void print(const std::string& text) { std::fprintf(stderr, "%s\n", text.c_str()); }

TEST(QuietLibraries, DropWhatTheirThreadPrints) {
    FILE* const before = stderr;
    testing::internal::CaptureStderr();
    print("before");
    {
        const QuietLibraries quiet;
        print("dropped");
        const QuietLibraries again;
        print("dropped, too");
    }
    print("after");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "before\nafter\n");
    EXPECT_EQ(stderr, before);
}

TEST(QuietLibraries, LoseNothingOfOtherThreads) {
    testing::internal::CaptureStderr();
    {
        const QuietLibraries quiet;
        std::thread([] { print("of another thread"); }).join();
        std::thread([] {
            {
                const QuietLibraries quiet_there;
                print("dropped");
            }
            print("of a third");
        }).join();
        std::cerr << "of C++\n";
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "of another thread\nof a third\nof C++\n");
}

TEST(QuietLibraries, LoseNothingOfThreadsThatPrintAllTheTime) {
    constexpr int lines = 5000;
    FILE* const before = stderr;
    testing::internal::CaptureStderr();
    std::thread other([] {
        for (int k = 0; k < lines; ++k) print("kept " + std::to_string(k));
    });
    for (int k = 0; k < 20000; ++k) {
        const QuietLibraries quiet;
        if (k % 10 == 0) print("dropped");
    }
    other.join();
    std::string expected;
    for (int k = 0; k < lines; ++k) expected += "kept " + std::to_string(k) + "\n";
    EXPECT_EQ(testing::internal::GetCapturedStderr(), expected);
    EXPECT_EQ(stderr, before);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
