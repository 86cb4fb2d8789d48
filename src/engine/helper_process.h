// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace femscalpel {

/// Number of the socket in a program that HelperProcess starts.
inline constexpr int helper_socket = 3;

/// Path of one of the programs that FemScalpel brings along: beside the file this code was loaded from, else where it
/// was built. Throws Error that calls it `name`, `purpose` (as "the program that fills cavities"), if it is nowhere.
std::string helper_program(const std::string& name, const std::string& purpose);

/// One of these programs, running, with a socket between it and this object; ended, if it still runs, and waited for
/// at the end. For what libraries do that print, hang or crash: nothing of it reaches the calling process. What the
/// program prints is dropped; its working folder is the caller's. Any number of threads can have one at once.
class HelperProcess {
public:
    /// `seconds`: how long the conversation may last. Throws Error if the program cannot be started.
    HelperProcess(const std::string& program, const std::vector<std::string>& arguments, double seconds);
    ~HelperProcess();
    HelperProcess(const HelperProcess&) = delete;
    HelperProcess& operator=(const HelperProcess&) = delete;

    /// False if the program has ended, or time is over. Throws Cancelled, as receive_all() does.
    bool send_all(const void* data, std::size_t bytes);

    /// False if the program has ended before it sent as much, or time is over.
    bool receive_all(void* data, std::size_t bytes);

    /// Whether that was why.
    bool timed_out() const { return timed_out_; }

private:
    bool wait_for(short events);

    int socket_ = -1;
    pid_t process_ = -1;
    std::chrono::steady_clock::time_point end_;
    bool timed_out_ = false;
};

}  // namespace femscalpel
