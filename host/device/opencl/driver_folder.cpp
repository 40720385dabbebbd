// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/driver_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <system_error>

#include "base/cache_folder.h"
#include "base/quote.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr const char* prefix = "compiling-";
constexpr const char* lock_name = "in-use";
/// The kernels of an image take about 2 MiB.
constexpr std::uintmax_t least_space = std::uintmax_t{16} << 20;
/// A younger folder without a locked file may be that of a process which has just begun.
constexpr std::chrono::minutes beginning{10};

/// A file in the folder for driver_folder_is_full, with a name that signal handlers can read.
std::string probe;

/// Whether no process uses such a folder: its file is not locked.
bool is_left_over(const fs::path& folder) {
    const int lock = ::open((folder / lock_name).c_str(), O_RDWR | O_CLOEXEC);
    if (lock < 0) {
        const bool missing = errno == ENOENT;
        std::error_code error;
        const auto changed = fs::last_write_time(folder, error);
        return missing && !error && fs::file_time_type::clock::now() - changed > beginning;
    }
    const bool free = ::flock(lock, LOCK_EX | LOCK_NB) == 0;
    ::close(lock);
    return free;
}

void remove_left_over(const fs::path& parent) {
    std::error_code error;
    for (fs::directory_iterator at(parent, error), end; !error && at != end; at.increment(error))
        if (at->path().filename().string().starts_with(prefix) && is_left_over(at->path())) {
            std::error_code ignored;
            fs::remove_all(at->path(), ignored);
        }
}

/// Makes an empty folder that has a name of its own; throws std::system_error.
fs::path make_folder(const fs::path& parent) {
    const auto space = fs::space(parent);
    if (space.available < least_space)
        throw std::system_error(std::make_error_code(std::errc::no_space_on_device));
    std::string name = (parent / (std::string(prefix) + "XXXXXX")).string();
    if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category());
    return name;
}

int lock_of(const fs::path& folder) {
    const int lock =
        ::open((folder / lock_name).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, S_IRUSR | S_IWUSR);
    if (lock >= 0) static_cast<void>(::flock(lock, LOCK_EX | LOCK_NB));
    return lock;
}

}  // namespace

DriverFolder::DriverFolder(const fs::path& cache) : owner_(::getpid()) {
    std::error_code error;
    if (!cache.empty()) {
        try {
            const fs::path parent = fs::absolute(cache);
            make_cache_folder(parent);
            remove_left_over(parent);
            path_ = make_folder(parent);
        } catch (const std::system_error& failure) {  // filesystem errors are such, too
            trouble_ = failure.code().message();
        }
    }
    if (path_.empty()) {
        try {
            const fs::path parent = fs::temp_directory_path();
            path_ = make_folder(parent);
        } catch (const std::system_error&) {
            return;  // drivers that need none still work
        }
    }
    lock_ = lock_of(path_);
    ::setenv("POCL_CACHE_DIR", path_.c_str(), 1);
    probe = (path_ / "probe").string();
}

DriverFolder::~DriverFolder() {
    if (lock_ >= 0) ::close(lock_);
    std::error_code ignored;
    if (!path_.empty() && ::getpid() == owner_) fs::remove_all(path_, ignored);
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
