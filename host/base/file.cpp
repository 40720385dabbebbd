// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <exception>
#include <new>
#include <random>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/quote.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

/// A POSIX file descriptor that closes itself.
class Descriptor {
  public:
    explicit Descriptor(int value) : value_(value) {}
    ~Descriptor() { reset(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] int get() const { return value_; }
    [[nodiscard]] bool valid() const { return value_ >= 0; }

    /// Closes and says whether that worked: delayed write errors of network disks show here.
    bool reset() {
        const int old = std::exchange(value_, -1);
        return old < 0 || ::close(old) == 0;
    }

  private:
    int value_;
};

std::string reason(int error) {
    return std::generic_category().message(error);
}

Error output_error(const fs::path& path, const std::string& message) {
    return {ExitCode::output, path.string(), message};
}

/// Reads until `size` bytes or the end of the file; returns the number of bytes, -1 on error.
ssize_t read_fully(int file, std::byte* to, std::size_t size) {
    std::size_t done = 0;
    while (done < size) {
        const ssize_t got = ::read(file, to + done, size - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return -1;
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    return static_cast<ssize_t>(done);
}

bool write_fully(int file, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return true;
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

std::string percent_decode(const std::string& text, const std::string& place) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            result += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
        if (high < 0 || low < 0)
            throw input_error(place, "reference " + quote(text) +
                                         " holds a broken percent escape, expected % and two "
                                         "hexadecimal digits");
        result += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return result;
}

/// True for `scheme:...`, which also covers Windows drive letters.
bool has_scheme(const std::string& text) {
    const std::size_t colon = text.find(':');
    if (colon == std::string::npos || colon == 0) return false;
    if (std::isalpha(static_cast<unsigned char>(text[0])) == 0) return false;
    return std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '.' || c == '-';
    });
}

bool has_parent_component(const std::string& text) {
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find_first_of("/\\", begin), text.size());
        if (text.compare(begin, end - begin, "..") == 0) return true;
        begin = end + 1;
    }
    return false;
}

/// Whether a file is protected against changes: it may not be written by this user, or by anyone,
/// which stops even the superuser from replacing it by mistake.
bool is_read_only(const fs::path& file, fs::perms permissions) {
    constexpr fs::perms writable =
        fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
    return (permissions & writable) == fs::perms::none || ::access(file.c_str(), W_OK) != 0;
}

/// The file that a write to `path` ends in: renaming onto a symbolic link would replace the link,
/// renaming onto a device such as /dev/null would destroy it, and renaming onto a file asks nobody
/// whether that may be written.
fs::path final_target(const fs::path& path) {
    std::error_code error;
    if (path.empty() || !path.has_filename()) throw output_error(path, "is not a file name");
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status) && !fs::is_regular_file(status))
        throw output_error(path, "is not a regular file, expected a file that can be replaced");
    if (fs::exists(status) && is_read_only(path, status.permissions()))
        throw output_error(path, "is read-only, expected a file that may be replaced");
    if (!fs::is_symlink(path, error)) return path;
    fs::path resolved = fs::weakly_canonical(path, error);
    if (error || fs::is_symlink(resolved, error))
        throw output_error(path, "is a symbolic link that leads nowhere");
    return resolved;
}

/// Creates an empty file of a fresh name in the folder of `target`, with the same extension.
fs::path create_temporary(const fs::path& target) {
    std::random_device random;
    std::string stem = target.stem().string();
    stem.resize(std::min<std::size_t>(stem.size(), 100));
    for (int attempt = 0; attempt < 100; ++attempt) {
        const std::uint64_t key = (std::uint64_t{random()} << 32) | random();
        fs::path name = target.parent_path() / ("." + stem + "." + std::to_string(key) + ".tmp");
        name += target.extension();
        const Descriptor file(::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
        if (file.valid()) return name;
        if (errno != EEXIST) break;
    }
    throw output_error(target, "cannot be written: " + reason(errno));
}

void flush_to_disk(const fs::path& path, const fs::path& target) {
    Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.valid() || ::fsync(file.get()) != 0 || !file.reset())
        throw output_error(target, "cannot be flushed to disk: " + reason(errno));
}

/// Removes the temporary file unless it has become the real one.
class TemporaryGuard {
  public:
    explicit TemporaryGuard(fs::path path) : path_(std::move(path)) {}
    ~TemporaryGuard() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove(path_, ignored);
    }
    TemporaryGuard(const TemporaryGuard&) = delete;
    TemporaryGuard& operator=(const TemporaryGuard&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }
    void release() { path_.clear(); }

  private:
    fs::path path_;
};

/// A file to read from its beginning.
class InputFile {
  public:
    /// Errors name `place`, or the path where that is empty.
    InputFile(const fs::path& path, const std::string& place)
        : where_(place.empty() ? path.string() : place),
          subject_(place.empty() ? "" : "file " + quote(path.string()) + " "),
          // Without O_NONBLOCK, opening a pipe that nobody writes to would wait for ever.
          file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
        if (!file_.valid()) throw error("cannot be opened: " + reason(errno));
        struct stat status {};
        if (::fstat(file_.get(), &status) != 0 || !S_ISREG(status.st_mode))
            throw error("is not a regular file");
        size_ = static_cast<std::size_t>(status.st_size);
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    /// The first `count` bytes; fewer where the file has become shorter.
    [[nodiscard]] std::vector<std::byte> read(std::size_t count) const {
        std::vector<std::byte> bytes(count);
        const ssize_t got = read_fully(file_.get(), bytes.data(), count);
        if (got < 0) throw error("cannot be read: " + reason(errno));
        bytes.resize(static_cast<std::size_t>(got));
        return bytes;
    }
    [[nodiscard]] Error error(const std::string& what) const {
        return input_error(where_, subject_ + what);
    }

  private:
    std::string where_, subject_;
    Descriptor file_;
    std::size_t size_ = 0;
};

}  // namespace

std::vector<std::byte> read_file(const fs::path& path, std::size_t max_bytes,
                                 const std::string& place) {
    const InputFile file(path, place);
    if (file.size() > max_bytes)
        throw file.error("is longer than the limit of " + std::to_string(max_bytes) + " bytes");
    return file.read(file.size());
}

std::vector<std::byte> read_file_head(const fs::path& path, std::size_t most_bytes) {
    const InputFile file(path, {});
    return file.read(std::min(file.size(), most_bytes));
}

fs::path resolve_reference(const fs::path& scene_file, const std::string& reference,
                           const std::string& place, bool percent_encoded) {
    const auto refuse = [&](const std::string& why) {
        return input_error(place, "reference " + quote(reference) + " " + why +
                                      ", expected a path relative to the folder of this file");
    };
    const std::string text = percent_encoded ? percent_decode(reference, place) : reference;
    if (text.empty()) throw refuse("is empty");
    if (text.find('\0') != std::string::npos) throw refuse("holds a NUL byte");
    if (has_scheme(text) || has_scheme(reference)) throw refuse("is a URI with a scheme");
    if (text.front() == '/' || text.front() == '\\') throw refuse("is absolute");
    if (has_parent_component(text)) throw refuse("leaves its folder with '..'");
    return scene_file.parent_path() / fs::path(text);
}

void check_output(const fs::path& path) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
    std::error_code error;
    if (!fs::is_directory(folder, error))
        throw output_error(
            path, "cannot be written, expected " + quote(folder.string()) + " to be a folder");
    static_cast<void>(final_target(path));
}

void write_file_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write,
                           WriteMode mode) {
    const fs::path target = final_target(path);
    TemporaryGuard temporary(create_temporary(target));
    try {
        write(temporary.path());
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        throw output_error(target, std::string("cannot be written: ") + error.what());
    }
    if (mode != WriteMode::unflushed) flush_to_disk(temporary.path(), target);
    if (mode == WriteMode::rehearsed) return;
    std::error_code error;
    const fs::file_status replaced = fs::status(target, error);
    if (fs::exists(replaced)) fs::permissions(temporary.path(), replaced.permissions(), error);
    if (::rename(temporary.path().c_str(), target.c_str()) != 0)
        throw output_error(target, "cannot be replaced: " + reason(errno));
    temporary.release();
    if (mode == WriteMode::unflushed) return;
    // Some file systems refuse to flush a folder; the file itself is safe by then.
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    const Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (opened.valid()) static_cast<void>(::fsync(opened.get()));
}

void write_file_atomically(const fs::path& path, std::span<const std::byte> bytes, WriteMode mode) {
    const auto write = [&](const fs::path& temporary) {
        Descriptor file(::open(temporary.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC));
        if (!file.valid() || !write_fully(file.get(), bytes) || !file.reset())
            throw output_error(path, "cannot be written: " + reason(errno));
    };
    write_file_atomically(path, write, mode);
}

}  // namespace weft
