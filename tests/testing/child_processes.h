// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_CHILD_PROCESSES_H
#define WEFT_TESTS_TESTING_CHILD_PROCESSES_H

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace weft::test {

/// State letter and parent of a process as the system tells in /proc; 'X' where there is none.
struct ProcessState {
    char state = 'X';
    pid_t parent = -1;
};
inline ProcessState process_state(const std::string& process) {
    std::ifstream file("/proc/" + process + "/stat");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    ProcessState found;
    // The program's name, in parentheses, may hold anything.
    if (const std::size_t name = text.rfind(')'); name != std::string::npos)
        std::istringstream(text.substr(name + 1)) >> found.state >> found.parent;
    return found;
}

/// Whether it runs no more, be it that nobody has waited for it yet.
inline bool has_ended(pid_t process) {
    const char state = process_state(std::to_string(process)).state;
    return state == 'X' || state == 'Z';
}

/// Processes that this one has started and that still run; empty where the system does not tell.
inline std::vector<pid_t> children_of(pid_t parent) {
    std::vector<pid_t> children;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
        const std::string name = entry.path().filename();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        const ProcessState found = process_state(name);
        if (found.parent == parent && found.state != 'Z') children.push_back(std::stoi(name));
    }
    return children;
}

/// Whether the condition comes true, within two minutes.
inline bool comes_true(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

}  // namespace weft::test

#endif
