// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_DRIVER_FILES_H
#define WEFT_DEVICE_OPENCL_DRIVER_FILES_H

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// An OpenCL driver as the loader finds it: a library, which an .icd file names.
struct DriverFile {
    std::filesystem::path file;  ///< empty where an environment variable names the library
    std::string library;

    /// The file, or the library where there is none.
    [[nodiscard]] std::string place() const { return file.empty() ? library : file.string(); }
    [[nodiscard]] bool operator==(const DriverFile&) const = default;
};

/// The drivers that the loader would open, in order of their files: those of OCL_ICD_VENDORS (a
/// folder, an .icd file or a library), else of /etc/OpenCL/vendors; and the libraries of
/// OCL_ICD_FILENAMES.
[[nodiscard]] std::vector<DriverFile> driver_files();

/// Names drivers to the loader, by files in a folder of `folder` whose name depends on them, or in
/// a temporary one where it cannot be made, which goes with this process. Returns the folder that
/// holds the files. Throws Error (exit code 5).
[[nodiscard]] std::filesystem::path list_drivers(std::span<const DriverFile> drivers,
                                                 const std::filesystem::path& folder);

/// Lets the loader open the drivers of such a list and no others, in this process and in those it
/// starts. Takes effect only before the first OpenCL call.
void open_only(const std::filesystem::path& list);

}  // namespace weft

#endif
