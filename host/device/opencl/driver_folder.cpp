// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/driver_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "base/boot_id.h"
#include "base/cache_folder.h"
#include "base/quote.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// What the names of folders begin with: in the cache, and among the temporary files of everybody.
constexpr std::string_view cache_prefix = "compiling-";
constexpr std::string_view temporary_prefix = "weft-compiling-";
/// What follows: letters and digits of mkdtemp.
constexpr std::string_view unique_part = "XXXXXX";
/// A file that is locked, and what it is called until it is.
constexpr const char* lock_name = "in-use";
constexpr const char* starting_name = "starting";
/// The kernels of an image take about 2 MiB.
constexpr std::uintmax_t least_space = std::uintmax_t{16} << 20;
/// A younger folder without a lock may be that of a process which has just begun.
constexpr std::chrono::minutes beginning{10};
/// Of a folder of another machine, whose locks this one may not see, or of this one before it was
/// started again, nobody knows more than its age.
constexpr std::chrono::days abandoned{30};

/// A file in the folder for driver_folder_is_full, with a name that signal handlers can read.
std::string probe;

/// Whether a folder is one of this program's, for this user.
bool is_own(const fs::path& folder, std::string_view prefix) {
    const std::string name = folder.filename().string();
    const bool has_name = name.starts_with(prefix) &&
                          name.size() == prefix.size() + unique_part.size() &&
                          std::ranges::all_of(name.substr(prefix.size()),
                                              [](unsigned char c) { return std::isalnum(c) != 0; });
    struct stat is {};
    return has_name && ::lstat(folder.c_str(), &is) == 0 && S_ISDIR(is.st_mode) &&
           is.st_uid == ::geteuid();
}

bool is_older(const fs::path& file, std::chrono::minutes age) {
    std::error_code error;
    const auto changed = fs::last_write_time(file, error);
    return !error && fs::file_time_type::clock::now() - changed > age;
}

/// Whether there is nothing in a folder but what a process makes there first.
bool has_only_begun(const fs::path& folder) {
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (at->path().filename() != starting_name) return false;
    return !error;
}

/// Whether no process uses such a folder: its file is not locked.
bool is_left_over(const fs::path& folder) {
    const int lock = ::open((folder / lock_name).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    if (lock < 0) return errno == ENOENT && is_older(folder, beginning) && has_only_begun(folder);
    std::array<char, 256> system{};
    const ssize_t size = ::read(lock, system.data(), system.size());
    const bool is_here = size > 0 && boot_id() == std::string_view(system.data(), size);
    const bool free =
        is_here ? ::flock(lock, LOCK_EX | LOCK_NB) == 0 : is_older(folder / lock_name, abandoned);
    ::close(lock);
    return free;
}

/// Removes a folder, its lock last: where something stays, as on file systems that keep what is
/// open, a later program still knows what it is.
void remove_folder(const fs::path& folder) {
    std::error_code error;
    bool all = true;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        if (at->path().filename() == lock_name) continue;
        std::error_code failed;
        fs::remove_all(at->path(), failed);
        all = all && !failed;
    }
    if (all && !error) fs::remove_all(folder, error);
}

void remove_left_over(const fs::path& parent, std::string_view prefix) {
    std::error_code error;
    for (fs::directory_iterator at(parent, error), end; !error && at != end; at.increment(error))
        if (is_own(at->path(), prefix) && is_left_over(at->path())) remove_folder(at->path());
}

[[noreturn]] void fail_with_errno() {
    throw std::system_error(errno, std::generic_category());
}

/// Makes a folder that has a name of its own; throws std::system_error.
fs::path make_folder(const fs::path& parent, std::string_view prefix) {
    const auto space = fs::space(parent);
    if (space.available < least_space)
        throw std::system_error(std::make_error_code(std::errc::no_space_on_device));
    std::string name = (parent / fmt::format("{}{}", prefix, unique_part)).string();
    if (::mkdtemp(name.data()) == nullptr) fail_with_errno();
    return name;
}

/// Locks a file in the folder until the process ends, however that happens; throws
/// std::system_error. Nobody sees it by its name before it is locked.
int lock_of(const fs::path& folder) {
    const fs::path starting = folder / starting_name;
    const int lock =
        ::open(starting.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR);
    if (lock < 0) fail_with_errno();
    // Where there are no locks, no machine may think that it knows.
    const std::string system = ::flock(lock, LOCK_EX | LOCK_NB) == 0 ? boot_id() : "-";
    if (::write(lock, system.data(), system.size()) != static_cast<ssize_t>(system.size()) ||
        ::rename(starting.c_str(), (folder / lock_name).c_str()) != 0) {
        const int reason = errno;
        ::close(lock);
        throw std::system_error(reason, std::generic_category());
    }
    return lock;
}

}  // namespace

DriverFolder::DriverFolder(const fs::path& cache) : owner_(::getpid()) {
    if (!cache.empty()) {
        try {
            make_in(fs::absolute(cache), cache_prefix);
        } catch (const std::system_error& failure) {  // filesystem errors are such, too
            trouble_ = failure.code().message();
        }
    }
    if (path_.empty()) {
        try {
            make_in(fs::temp_directory_path(), temporary_prefix);
        } catch (const std::system_error&) {
            return;  // drivers that need none still work
        }
    }
    ::setenv("POCL_CACHE_DIR", path_.c_str(), 1);
    probe = (path_ / "probe").string();
}

void DriverFolder::make_in(const fs::path& parent, std::string_view prefix) {
    make_cache_folder(parent);
    remove_left_over(parent, prefix);
    const fs::path made = make_folder(parent, prefix);
    try {
        lock_ = lock_of(made);
    } catch (const std::system_error&) {
        std::error_code ignored;
        fs::remove_all(made, ignored);
        throw;
    }
    path_ = made;
}

DriverFolder::~DriverFolder() {
    if (!path_.empty() && ::getpid() == owner_) remove_folder(path_);
    if (lock_ >= 0) ::close(lock_);
    probe.clear();
}

bool driver_folder_is_full() noexcept {
    if (probe.empty()) return false;
    static constexpr std::array<char, 65536> block{};
    const int file = ::open(probe.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, S_IRUSR | S_IWUSR);
    if (file < 0) return true;
    const bool full =
        ::write(file, block.data(), block.size()) < static_cast<ssize_t>(block.size());
    ::close(file);
    ::unlink(probe.c_str());
    return full;
}

std::string full_driver_folder() {
    return fmt::format(
        "{}: nothing can be written there, which the OpenCL driver needs, expected space for its "
        "files (WEFT_CACHE_DIR names another folder)",
        one_line(fs::path(probe).parent_path().parent_path().string()));
}

}  // namespace weft
