// SPDX-License-Identifier: LGPL-2.1-or-later
#include "helper_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include "cancel.h"
#include "error.h"

namespace femscalpel {
namespace FILE_NAMESPACE {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(HelperProcess, ProgramsThatAreMissingAreCalledByName) {
    EXPECT_TRUE(std::filesystem::exists(helper_program("femscalpel-fill", "the program that fills cavities")));
    EXPECT_THAT([] { helper_program("femscalpel-none", "the program that does nothing"); },
                ThrowsMessage<Error>(HasSubstr("femscalpel-none, the program that does nothing, is missing")));
    EXPECT_THAT([] { HelperProcess("/no/such/program", {}, 60); },
                ThrowsMessage<Error>(HasSubstr("cannot start /no/such/program: No such file")));
}

/// A shell that runs `script`, with the socket as its descriptor 3.
HelperProcess shell(const std::string& script, double seconds = 60) {
    return HelperProcess("/bin/sh", {"-c", script}, seconds);
}

TEST(HelperProcess, Converses) {
    HelperProcess process = shell("read line <&3; echo prints; echo \"$line again\" >&3");
    EXPECT_TRUE(process.send_all("words\n", 6));
    std::array<char, 11> answer{};
    EXPECT_TRUE(process.receive_all(answer.data(), answer.size()));
    EXPECT_EQ(std::string(answer.data(), answer.size()), "words again");
    std::array<char, 100> more{};
    EXPECT_FALSE(process.receive_all(more.data(), more.size())) << "it has ended";
    EXPECT_FALSE(process.timed_out());
}

TEST(HelperProcess, MayCrash) {
    HelperProcess process = shell("kill -SEGV $$");
    char byte = 0;
    EXPECT_FALSE(process.receive_all(&byte, 1));
    EXPECT_FALSE(process.timed_out());
}

/// The number of the process that says it as a line.
pid_t number_of(HelperProcess& process) {
    std::string line;
    for (char c = 0; process.receive_all(&c, 1) && c != '\n';) line += c;
    return std::stoi(line);
}

TEST(HelperProcess, EndsInTime) {
    pid_t number = -1;
    {
        HelperProcess process = shell("echo $$ >&3; while :; do :; done", 0.2);
        number = number_of(process);
        ASSERT_EQ(kill(number, 0), 0);
        char byte = 0;
        EXPECT_FALSE(process.receive_all(&byte, 1));
        EXPECT_TRUE(process.timed_out());
    }
    EXPECT_EQ(kill(number, 0), -1);
    EXPECT_EQ(errno, ESRCH) << "not even a zombie is left";
}

TEST(HelperProcess, EndsWhenCancelled) {
    pid_t number = -1;
    const CancelToken token;
    std::thread other;
    const auto wait = [&] {
        const CancelScope scope(token);
        HelperProcess process = shell("echo $$ >&3; while :; do :; done", 600);
        number = number_of(process);
        other = std::thread([&] { token.cancel(); });
        char byte = 0;
        process.receive_all(&byte, 1);
    };
    EXPECT_THROW(wait(), Cancelled);
    other.join();
    EXPECT_EQ(kill(number, 0), -1);
    EXPECT_EQ(errno, ESRCH);
}

}  // namespace FILE_NAMESPACE
}  // namespace femscalpel
