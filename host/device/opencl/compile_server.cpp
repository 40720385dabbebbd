// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/compile_server.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

#include "base/null_device.h"
#include "device/opencl/compile_workers.h"
#include "device/opencl/message_socket.h"

namespace weft {
namespace {

CompileServer* running = nullptr;

/// Detaches the server from the terminal and from whoever reads what the program prints: these must
/// notice neither the output of compilers nor a process that outlives the program by a moment.
bool detach() {
    ::setsid();
    std::signal(SIGINT, SIG_IGN);
    std::signal(SIGCHLD, SIG_DFL);  // the server waits for its workers
    return lead_to_null_device({STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO});
}

/// Waits a moment for an answer, or the end of the server; returns whether there is either.
bool has_answer(int server) {
    constexpr int moment = 50;  // milliseconds
    pollfd end{server, POLLIN, 0};
    const int ready = ::poll(&end, 1, moment);
    return ready > 0 || (ready < 0 && errno != EINTR);
}

/// Answers requests until the client is gone.
void answer(int client) {
    while (const auto message = receive_message(client)) {
        const auto request = decode_request(*message);
        if (!request) return;
        const auto times = compile_in_workers(*request, client);
        if (!times || !send_message(client, encode(*times))) return;
    }
}

/// Runs the server process to its end. It leaves by _exit, since exit handlers are for the program.
[[noreturn]] void serve(int client) noexcept {
    try {
        if (detach()) answer(client);
    } catch (...) {  // the client sees the server end and compiles itself
    }
    ::_exit(0);
}

}  // namespace

CompileServer::CompileServer() {
    // Otherwise the socket would get the number of a standard descriptor that is closed.
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(standard, F_GETFD) < 0) return;
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
    process_ = ::fork();
    if (process_ == 0) {
        ::close(ends[0]);
        serve(ends[1]);
    }
    ::close(ends[1]);
    if (process_ < 0) {
        ::close(ends[0]);
        return;
    }
    socket_ = ends[0];
    running = this;
}

CompileServer::~CompileServer() {
    if (running == this) running = nullptr;
    if (socket_ >= 0) ::close(socket_);
    if (process_ < 0) return;
    // The server has nothing to clean up, and may have been stopped, so it is killed. Nobody else
    // waits for it, so its process id is still its own.
    if (::waitpid(process_, nullptr, WNOHANG) != 0) return;
    ::kill(process_, SIGKILL);
    while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

CompileTimes CompileServer::compile(const CompileRequest& request,
                                    const std::function<void()>& waiting) {
    const std::lock_guard lock(mutex_);
    const std::size_t count = request.programs.size();
    if (socket_ < 0) return CompileTimes(count);
    if (send_message(socket_, encode(request))) {
        while (waiting && !has_answer(socket_)) waiting();
        if (const auto answer = receive_message(socket_))
            if (auto times = decode_times(*answer, count)) return *std::move(times);
    }
    ::close(std::exchange(socket_, -1));
    return CompileTimes(count);
}

CompileServer* CompileServer::current() noexcept {
    return running;
}

}  // namespace weft
