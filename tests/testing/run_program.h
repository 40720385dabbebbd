// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_RUN_PROGRAM_H
#define WEFT_TESTS_TESTING_RUN_PROGRAM_H

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "tests/testing/temporary_folder.h"

namespace weft::test {

inline std::string text_of_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The built program as another process, with its output in files of a folder of its own.
class RunningProgram {
  public:
    struct Settings {
        std::filesystem::path working_folder = ".";
        std::map<std::string, std::string> environment{};
        std::string standard_output{};  ///< where it goes instead of a file for `out()`
        int output_descriptor = -1;     ///< or an open descriptor
        std::size_t address_bytes = 0;  ///< all that it may have; 0 sets no limit
        std::size_t file_bytes = 0;     ///< that a file may have; 0 sets no limit
        bool ignores_children = false;  ///< starts with SIGCHLD ignored
        unsigned seconds = 0;           ///< after which SIGALRM ends it; 0: never
    };

    /// Starts `weft` with these arguments.
    explicit RunningProgram(const std::vector<std::string>& arguments)
        : RunningProgram(arguments, Settings{}) {}
    RunningProgram(const std::vector<std::string>& arguments, const Settings& settings) {
        const std::string out = settings.standard_output.empty() ? (folder_.path() / "out").string()
                                                                 : settings.standard_output;
        const std::string err = (folder_.path() / "err").string();
        std::vector<char*> argv;
        std::vector<std::string> all{WEFT_PROGRAM};
        all.insert(all.end(), arguments.begin(), arguments.end());
        for (std::string& argument : all) argv.push_back(argument.data());
        argv.push_back(nullptr);
        process_ = ::fork();
        if (process_ < 0) throw std::runtime_error("cannot fork");
        if (process_ > 0) return;
        const int given = settings.output_descriptor;
        const bool ready =
            (given >= 0 ? ::dup2(given, STDOUT_FILENO) >= 0 : redirect(out, STDOUT_FILENO)) &&
            redirect(err, STDERR_FILENO) && ::chdir(settings.working_folder.c_str()) == 0;
        if (settings.address_bytes > 0) {
            const rlimit limit{settings.address_bytes, settings.address_bytes};
            static_cast<void>(::setrlimit(RLIMIT_AS, &limit));
        }
        if (settings.file_bytes > 0) {
            const rlimit limit{settings.file_bytes, settings.file_bytes};
            static_cast<void>(::setrlimit(RLIMIT_FSIZE, &limit));
        }
        if (settings.ignores_children) std::signal(SIGCHLD, SIG_IGN);
        ::alarm(settings.seconds);  // outlives the call of execv
        for (const auto& [name, value] : settings.environment)
            ::setenv(name.c_str(), value.c_str(), 1);
        if (ready) ::execv(argv[0], argv.data());
        ::_exit(126);
    }
    ~RunningProgram() {
        if (running_) {
            ::kill(process_, SIGKILL);
            static_cast<void>(wait());
        }
    }
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;

    [[nodiscard]] pid_t process() const { return process_; }

    void send(int signal) const { ::kill(process_, signal); }

    /// Waits until standard error holds that many lines; false where the program ends or hangs
    /// before.
    [[nodiscard]] bool wait_for_lines(std::ptrdiff_t count) {
        constexpr int tries = 6000;
        const auto enough = [&] {
            const std::string text = err();
            return std::count(text.begin(), text.end(), '\n') >= count;
        };
        for (int i = 0; i < tries; ++i) {
            if (enough()) return true;
            siginfo_t info{};
            const auto id = static_cast<id_t>(process_);
            if (::waitid(P_PID, id, &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid != 0)
                return enough();
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        return false;
    }

    /// Waits for the end. The exit code, or 1000 + the signal that ended it.
    int wait() {
        int status = 0;
        if (::waitpid(process_, &status, 0) != process_) throw std::runtime_error("cannot wait");
        running_ = false;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
    }

    [[nodiscard]] std::string out() const { return text_of_file(folder_.path() / "out"); }
    [[nodiscard]] std::string err() const { return text_of_file(folder_.path() / "err"); }

  private:
    static bool redirect(const std::string& path, int descriptor) {
        const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        return file >= 0 && ::dup2(file, descriptor) == descriptor;
    }

    TemporaryFolder folder_;
    pid_t process_ = -1;
    bool running_ = true;
};

struct ProgramResult {
    int exit_code = -1;
    std::string out, err;
};

/// Runs `weft` with these arguments to its end.
inline ProgramResult run_program(const std::vector<std::string>& arguments,
                                 const RunningProgram::Settings& settings = {}) {
    RunningProgram program(arguments, settings);
    const int code = program.wait();
    return {code, program.out(), program.err()};
}

/// A scene that ships.
inline std::string shipped_scene(const std::string& name) {
    return std::string(WEFT_SOURCE_DIR) + "/scenes/" + name;
}

}  // namespace weft::test

#endif
