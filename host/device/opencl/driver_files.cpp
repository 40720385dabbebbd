// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/driver_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include "base/cache_folder.h"
#include "base/content_digest.h"
#include "base/error.h"
#include "base/file.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_icd_bytes = 4096;
constexpr const char* icd_extension = ".icd";

/// The library that an .icd file names: its first line. None where it cannot be read.
std::optional<DriverFile> read_icd(const fs::path& file) {
    try {
        const std::vector<std::byte> bytes = read_file(file, most_icd_bytes);
        const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
        if (line.empty()) return {};
        return DriverFile{fs::absolute(file), std::string(line)};
    } catch (const std::exception&) {
        return {};
    }
}

std::vector<DriverFile> drivers_of(const fs::path& vendors) {
    if (vendors.extension() == icd_extension) {
        const auto driver = read_icd(vendors);
        return driver ? std::vector{*driver} : std::vector<DriverFile>();
    }
    std::error_code error;
    std::vector<DriverFile> drivers;
    if (!fs::is_directory(vendors, error)) {
        if (fs::exists(vendors, error)) drivers.push_back({{}, vendors.string()});
        return drivers;
    }
    for (fs::directory_iterator at(vendors, error), end; !error && at != end; at.increment(error))
        if (at->path().extension() == icd_extension)
            if (auto driver = read_icd(at->path())) drivers.push_back(*std::move(driver));
    std::ranges::sort(drivers, {}, &DriverFile::file);
    return drivers;
}

/// A temporary folder, which goes with the process; those that it forks leave it alone.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "weft-drivers-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw Error(ExitCode::output, name,
                        "cannot be made, expected a writable temporary folder");
        path_ = name;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        if (::getpid() == owner_) fs::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const fs::path& path() const { return path_; }

  private:
    pid_t owner_ = ::getpid();
    fs::path path_;
};

/// Whether a file has that text. A machine that lost power may have left an empty one.
bool has_text(const fs::path& file, std::string_view text) {
    try {
        const std::vector<std::byte> bytes = read_file(file, text.size());
        return std::ranges::equal(bytes, std::as_bytes(std::span(text)));
    } catch (const std::exception&) {
        return false;
    }
}

void write_list(std::span<const DriverFile> drivers, const fs::path& folder) {
    make_cache_folder(folder);
    for (std::size_t i = 0; i < drivers.size(); ++i) {
        const std::string& library = drivers[i].library;
        const fs::path file = folder / fmt::format("{:03}{}", i, icd_extension);
        if (!has_text(file, library))
            write_file_atomically(file, std::as_bytes(std::span(library)), WriteMode::unflushed);
    }
}

}  // namespace

std::vector<DriverFile> driver_files() {
    const char* const vendors = std::getenv("OCL_ICD_VENDORS");
    std::vector<DriverFile> drivers =
        drivers_of(vendors != nullptr && *vendors != '\0' ? vendors : "/etc/OpenCL/vendors");
    const char* const libraries = std::getenv("OCL_ICD_FILENAMES");
    std::istringstream list(libraries != nullptr ? libraries : "");
    for (std::string library; std::getline(list, library, ':');)
        if (!library.empty()) drivers.push_back({{}, library});
    return drivers;
}

fs::path list_drivers(std::span<const DriverFile> drivers, const fs::path& folder) {
    ContentDigest digest;
    for (const DriverFile& driver : drivers) digest.add(driver.library);
    if (!folder.empty()) {
        try {
            fs::path list = fs::absolute(folder) / digest.text();
            write_list(drivers, list);
            return list;
        } catch (const std::exception&) {  // a temporary folder does as well
        }
    }
    static const TemporaryFolder temporary;
    fs::path list = temporary.path() / digest.text();
    write_list(drivers, list);
    return list;
}

void open_only(const fs::path& list) {
    ::setenv("OCL_ICD_VENDORS", list.c_str(), 1);
    ::unsetenv("OCL_ICD_FILENAMES");
}

}  // namespace weft
