// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/child_process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "base/error.h"

extern char** environ;

namespace weft::bench {
namespace {

constexpr std::size_t longest_line = 4096;
constexpr timeval patience{600, 0};
/// How long a child that closed its output may take to end.
constexpr int grace_steps = 100;
constexpr useconds_t grace_step = 20'000;

/// Starts a process that reads and writes `socket`; 0 or an errno.
int spawn(const std::vector<std::string>& command, int socket, pid_t& process) {
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, socket, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, socket, STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    const int status =
        posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return status;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw Error(ExitCode::device, "no connection to another program can be made");
    socket_ = ends[0];
    const int status = spawn(command, ends[1], process_);
    close(ends[1]);
    if (status == 0) {
        setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
        return;
    }
    close(socket_);
    throw Error(ExitCode::device, command[0] + ": " + std::strerror(status));
}

ChildProcess::~ChildProcess() {
    if (process_ > 0) {
        kill(process_, SIGKILL);
        waitpid(process_, nullptr, 0);
    }
    close(socket_);
}

bool ChildProcess::write_line(const std::string& line) {
    const std::string text = line + "\n";
    // A broken connection is an answer here, not a signal that ends this program.
    return send(socket_, text.data(), text.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(text.size());
}

std::optional<std::string> ChildProcess::read_line() {
    for (;;) {
        const std::size_t end = unread_.find('\n');
        if (end != std::string::npos) {
            std::string line = unread_.substr(0, end);
            unread_.erase(0, end + 1);
            return line;
        }
        std::array<char, 512> part{};
        const ssize_t count = recv(socket_, part.data(), part.size(), 0);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0 || unread_.size() > longest_line) return std::nullopt;
        unread_.append(part.data(), static_cast<std::size_t>(count));
    }
}

std::string ChildProcess::fate() {
    int status = 0;
    pid_t ended = 0;
    for (int step = 0; step < grace_steps && ended == 0; ++step) {
        ended = waitpid(process_, &status, WNOHANG);
        if (ended == 0) usleep(grace_step);
    }
    if (ended != process_) return "it does not answer";
    process_ = -1;
    if (WIFSIGNALED(status)) return fmt::format("it ended by signal {}", WTERMSIG(status));
    return fmt::format("it ended with exit code {}", WEXITSTATUS(status));
}

}  // namespace weft::bench
