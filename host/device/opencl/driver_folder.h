// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_DRIVER_FOLDER_H
#define WEFT_DEVICE_OPENCL_DRIVER_FOLDER_H

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace weft {

/// A folder for what drivers write while they compile, which starts empty and goes with this
/// object. PoCL would keep compiled kernels for later runs, loads them without a look at what has
/// become of them, and ends the program where they are damaged; Weft keeps them itself, with a
/// checksum (ProgramCache).
class DriverFolder {
  public:
    /// Makes the folder in `cache`, or else among temporary files, and has PoCL use it, in this
    /// process and in those that it starts. Removes what processes of this user and machine have
    /// left that were killed, and what those of other machines have left a month ago.
    /// Must come before the first OpenCL call.
    explicit DriverFolder(const std::filesystem::path& cache);
    ~DriverFolder();
    DriverFolder(const DriverFolder&) = delete;
    DriverFolder& operator=(const DriverFolder&) = delete;

    /// The folder; empty where none could be made.
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
    /// Why `cache` cannot be used, such as "no space is left"; empty where it can, or is not known.
    [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }

  private:
    void make_in(const std::filesystem::path& parent, std::string_view prefix);

    std::filesystem::path path_;
    std::string trouble_;
    int lock_ = -1;  ///< a locked file in the folder
    pid_t owner_;    ///< processes that are forked leave the folder alone
};

/// Whether files in the folder of this process's DriverFolder cannot grow, as on a disk that has
/// become full; false where it has none. Signal handlers may ask.
[[nodiscard]] bool driver_folder_is_full() noexcept;

/// What to say then: `place: what is wrong, what was expected`.
[[nodiscard]] std::string full_driver_folder();

}  // namespace weft

#endif
