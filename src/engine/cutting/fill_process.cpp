// SPDX-License-Identifier: LGPL-2.1-or-later
#include "cutting/fill_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "cancel.h"

extern char** environ;

namespace femscalpel {
namespace {

using Clock = std::chrono::steady_clock;

/// A file descriptor that is closed at the end.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close_now(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int number() const { return number_; }
    void close_now() {
        if (number_ >= 0) close(number_);
        number_ = -1;
    }

private:
    int number_;
};

/// The program running; ended, if it still runs, and waited for at the end.
class Process {
public:
    Process(const std::string& program, int socket) {
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_adddup2(&actions, socket, fill_protocol::socket);
        posix_spawnattr_t attributes;
        posix_spawnattr_init(&attributes);
        // A group of its own: Ctrl-C is for who asked, who then ends this.
        posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
        sigset_t none;
        sigemptyset(&none);
        posix_spawnattr_setsigmask(&attributes, &none);
        std::string name = program;
        char* arguments[] = {name.data(), nullptr};
        const int error = posix_spawn(&process_, program.c_str(), &actions, &attributes, arguments, environ);
        posix_spawnattr_destroy(&attributes);
        posix_spawn_file_actions_destroy(&actions);
        if (error != 0) throw Error("cannot start " + program + ": " + std::strerror(error));
    }
    ~Process() {
        kill(process_, SIGKILL);
        while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

private:
    pid_t process_ = -1;
};

/// One end of the conversation. Both directions end with an empty failure text, or with why not.
class Conversation {
public:
    Conversation(int socket, double seconds)
        : socket_(socket),
          end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}

    bool send_all(const void* data, std::size_t bytes) {
        const auto* at = static_cast<const char*>(data);
        while (bytes > 0) {
            if (!wait_for(POLLOUT)) return false;
            const ssize_t sent = send(socket_, at, bytes, MSG_NOSIGNAL | MSG_DONTWAIT);
            if (sent < 0 && (errno == EAGAIN || errno == EINTR)) continue;
            if (sent <= 0) return false;
            at += sent;
            bytes -= static_cast<std::size_t>(sent);
        }
        return true;
    }

    bool receive_all(void* data, std::size_t bytes) {
        auto* at = static_cast<char*>(data);
        while (bytes > 0) {
            if (!wait_for(POLLIN)) return false;
            const ssize_t got = recv(socket_, at, bytes, MSG_DONTWAIT);
            if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
            if (got <= 0) return false;
            at += got;
            bytes -= static_cast<std::size_t>(got);
        }
        return true;
    }

    bool timed_out() const { return timed_out_; }

private:
    bool wait_for(short events) {
        for (;;) {
            check_cancelled();
            if (Clock::now() > end_) {
                timed_out_ = true;
                return false;
            }
            pollfd place{socket_, events, 0};
            const int ready = poll(&place, 1, 20);
            if (ready > 0) return true;
            if (ready < 0 && errno != EINTR) return false;
        }
    }

    int socket_;
    Clock::time_point end_;
    bool timed_out_ = false;
};

bool converse(Conversation& conversation, const fill_protocol::Request& request, const std::vector<Vec3>& points,
              const std::vector<std::array<int, 3>>& triangles, FillAnswer& result) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(int) == 4);
    fill_protocol::Answer answer{};
    if (!conversation.send_all(&request, sizeof request) ||
        !conversation.send_all(points.data(), points.size() * sizeof(Vec3)) ||
        !conversation.send_all(triangles.data(), triangles.size() * sizeof(std::array<int, 3>)) ||
        !conversation.receive_all(&answer, sizeof answer))
        return false;
    result.failure.resize(answer.text);
    result.points.resize(answer.points);
    result.tetras.resize(answer.tetras);
    return conversation.receive_all(result.failure.data(), result.failure.size()) &&
           conversation.receive_all(result.points.data(), result.points.size() * sizeof(Vec3)) &&
           conversation.receive_all(result.tetras.data(), result.tetras.size() * sizeof(std::array<int, 4>));
}

}  // namespace

std::string fill_program() {
    namespace fs = std::filesystem;
    constexpr const char* name = "femscalpel-fill";
    Dl_info here{};
    std::error_code error;
    if (dladdr(reinterpret_cast<const void*>(&fill_program), &here) != 0 && here.dli_fname) {
        const fs::path beside = fs::canonical(here.dli_fname, error).parent_path() / name;
        if (!error && fs::exists(beside, error)) return beside.string();
    }
    const fs::path built = fs::path(FEMSCALPEL_FILL_PROGRAM_DIR) / name;
    if (fs::exists(built, error)) return built.string();
    throw Error(std::string(name) +
                ", the program that fills cavities, is missing beside FemScalpel's compiled module: install it anew");
}

FillAnswer run_fill_program(const std::string& program, const fill_protocol::Request& request,
                            const std::vector<Vec3>& points, const std::vector<std::array<int, 3>>& triangles,
                            double seconds) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw Error(std::string("cannot talk to ") + program + ": " + std::strerror(errno));
    const Descriptor ours(ends[0]);
    Descriptor theirs(ends[1]);
    // dup2() of a descriptor onto itself would leave it to be closed on exec.
    Descriptor moved(fcntl(theirs.number(), F_DUPFD_CLOEXEC, fill_protocol::socket + 1));
    theirs.close_now();
    const Process process(program, moved.number());
    // Else the end of the program would not end the conversation.
    moved.close_now();

    FillAnswer result;
    Conversation conversation(ours.number(), seconds);
    if (!converse(conversation, request, points, triangles, result)) {
        result = {};
        result.failure = conversation.timed_out() ? "no end after " + std::to_string(static_cast<int>(seconds)) + " s"
                                                  : "Netgen broke off";
    } else if (result.failure.empty() && result.tetras.empty()) {
        result.failure = "no tetrahedra";
    }
    return result;
}

}  // namespace femscalpel
