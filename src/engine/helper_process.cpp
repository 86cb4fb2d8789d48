// SPDX-License-Identifier: LGPL-2.1-or-later
#include "helper_process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <utility>

#include "cancel.h"
#include "error.h"

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
    int release() { return std::exchange(number_, -1); }
    void close_now() {
        if (number_ >= 0) close(number_);
        number_ = -1;
    }

private:
    int number_;
};

pid_t start(const std::string& program, const std::vector<std::string>& arguments, int socket) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, socket, helper_socket);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    // A group of its own: Ctrl-C is for who asked, who then ends this.
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    std::vector<std::string> texts{program};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    std::vector<char*> pointers;
    pointers.reserve(texts.size() + 1);
    for (std::string& text : texts) pointers.push_back(text.data());
    pointers.push_back(nullptr);
    pid_t process = -1;
    const int error = posix_spawn(&process, program.c_str(), &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw Error("cannot start " + program + ": " + std::strerror(error));
    return process;
}

}  // namespace

std::string helper_program(const std::string& name, const std::string& purpose) {
    namespace fs = std::filesystem;
    Dl_info here{};
    std::error_code error;
    if (dladdr(reinterpret_cast<const void*>(&helper_program), &here) != 0 && here.dli_fname) {
        const fs::path beside = fs::canonical(here.dli_fname, error).parent_path() / name;
        if (!error && fs::exists(beside, error)) return beside.string();
    }
    const fs::path built = fs::path(FEMSCALPEL_HELPER_DIR) / name;
    if (fs::exists(built, error)) return built.string();
    throw Error(name + ", " + purpose + ", is missing beside FemScalpel's compiled module: install it anew");
}

HelperProcess::HelperProcess(const std::string& program, const std::vector<std::string>& arguments, double seconds)
    : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw Error(std::string("cannot talk to ") + program + ": " + std::strerror(errno));
    Descriptor ours(ends[0]);
    Descriptor theirs(ends[1]);
    // dup2() of a descriptor onto itself would leave it to be closed on exec.
    const Descriptor moved(fcntl(theirs.number(), F_DUPFD_CLOEXEC, helper_socket + 1));
    theirs.close_now();
    process_ = start(program, arguments, moved.number());
    socket_ = ours.release();
    // Theirs is closed now on this side: else the end of the program would not end the conversation.
}

HelperProcess::~HelperProcess() {
    close(socket_);
    kill(process_, SIGKILL);
    while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

bool HelperProcess::send_all(const void* data, std::size_t bytes) {
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

bool HelperProcess::receive_all(void* data, std::size_t bytes) {
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

bool HelperProcess::wait_for(short events) {
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

}  // namespace femscalpel
