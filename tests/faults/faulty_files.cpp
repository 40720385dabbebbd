// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Preloaded (LD_PRELOAD), it makes the N-th call on files of a folder fail, for tests of what a
// program does then. WEFT_FILE_FAULT is N, from 1, or N+ for that call and all that follow;
// WEFT_FAULT_FOLDER is the folder; WEFT_FAULT_ERROR is the error number, by default that of a full
// disk, or with WEFT_FAULT_SIGNAL the process gets that signal and the call is made; and the name
// of the call is added to the file WEFT_FAULT_LOG.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

/// The function of that name behind this library.
template <class Function>
Function* next(const char* name, Function*) {
    return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}
#define NEXT(function) next(#function, static_cast<decltype(function)*>(nullptr))

const std::string& folder() {
    static const char* const text = std::getenv("WEFT_FAULT_FOLDER");
    static const std::string path = text != nullptr ? text : "";
    return path;
}

bool is_inside(const char* path) {
    return path != nullptr && !folder().empty() &&
           std::strncmp(path, folder().c_str(), folder().size()) == 0;
}

/// Descriptors of files in the folder.
constexpr int most_files = 4096;
std::array<std::atomic<bool>, most_files> inside;

bool is_inside(int file) {
    return file >= 0 && file < most_files && inside[static_cast<std::size_t>(file)];
}

int opened(int file, bool is_in) {
    if (file >= 0 && file < most_files) inside[static_cast<std::size_t>(file)] = is_in;
    return file;
}

/// Whether this call is the one to fail; then errno is set.
bool fails(const char* call) {
    static const char* const text = std::getenv("WEFT_FILE_FAULT");
    static const long wanted = text != nullptr ? std::strtol(text, nullptr, 10) : 0;
    static const bool for_good = text != nullptr && std::strchr(text, '+') != nullptr;
    static std::atomic<long> calls{0};
    const long number = ++calls;
    if (wanted == 0 || (for_good ? number < wanted : number != wanted)) return false;
    if (const char* const log = std::getenv("WEFT_FAULT_LOG")) {
        const int file = NEXT(open)(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
        const std::string line = std::string(call) + "\n";
        static_cast<void>(NEXT(write)(file, line.data(), line.size()) < 0);
        NEXT(close)(file);
    }
    if (const char* const signal = std::getenv("WEFT_FAULT_SIGNAL")) {
        ::kill(::getpid(), static_cast<int>(std::strtol(signal, nullptr, 10)));
        return false;
    }
    static const char* const given = std::getenv("WEFT_FAULT_ERROR");
    errno = given != nullptr ? static_cast<int>(std::strtol(given, nullptr, 10)) : ENOSPC;
    return true;
}

/// The mode that follows flags which make a file.
mode_t mode_of(int flags, va_list arguments) {
    return (flags & O_CREAT) != 0 ? static_cast<mode_t>(va_arg(arguments, int)) : 0;
}

}  // namespace

extern "C" {

#define OPEN(name)                                           \
    int name(const char* path, int flags, ...) {             \
        va_list arguments;                                   \
        va_start(arguments, flags);                          \
        const mode_t mode = mode_of(flags, arguments);       \
        va_end(arguments);                                   \
        const bool is_in = is_inside(path);                  \
        if (is_in && fails("open")) return -1;               \
        return opened(NEXT(name)(path, flags, mode), is_in); \
    }
OPEN(open)
OPEN(open64)
#undef OPEN

#define FOPEN(name)                                         \
    FILE* name(const char* path, const char* mode) {        \
        const bool is_in = is_inside(path);                 \
        if (is_in && fails("fopen")) return nullptr;        \
        FILE* const file = NEXT(name)(path, mode);          \
        if (file != nullptr) opened(::fileno(file), is_in); \
        return file;                                        \
    }
FOPEN(fopen)
FOPEN(fopen64)
#undef FOPEN

int close(int file) {
    opened(file, false);
    return NEXT(close)(file);
}
ssize_t read(int file, void* to, size_t size) {
    return is_inside(file) && fails("read") ? -1 : NEXT(read)(file, to, size);
}
ssize_t write(int file, const void* from, size_t size) {
    return is_inside(file) && fails("write") ? -1 : NEXT(write)(file, from, size);
}
ssize_t writev(int file, const struct iovec* parts, int count) {
    return is_inside(file) && fails("writev")
               ? -1
               : next("writev", static_cast<ssize_t (*)(int, const struct iovec*, int)>(nullptr))(
                     file, parts, count);
}
int fsync(int file) {
    return is_inside(file) && fails("fsync") ? -1 : NEXT(fsync)(file);
}
int fdatasync(int file) {
    return is_inside(file) && fails("fdatasync") ? -1 : NEXT(fdatasync)(file);
}
int rename(const char* from, const char* to) noexcept {
    return is_inside(to) && fails("rename") ? -1 : NEXT(rename)(from, to);
}
int mkdir(const char* path, mode_t mode) noexcept {
    return is_inside(path) && fails("mkdir") ? -1 : NEXT(mkdir)(path, mode);
}
int fchmod(int file, mode_t mode) noexcept {
    return is_inside(file) && fails("fchmod") ? -1 : NEXT(fchmod)(file, mode);
}
}
