// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_OPENCL_COMPILE_HISTORY_H
#define WEFT_DEVICE_OPENCL_COMPILE_HISTORY_H

#include <filesystem>
#include <map>
#include <string>

#include "device/opencl/program_recipe.h"

namespace weft {

/// What kernels took to compile on one device the last time: a small text file in the folder of the
/// ProgramCache, which outlasts the programs of a version. A line that is damaged counts as absent,
/// and a file that cannot be written is no error.
class CompileHistory {
  public:
    /// Reads what earlier runs have left. `folder` empty: nothing.
    CompileHistory(const std::filesystem::path& folder, const DeviceInfo& device);

    /// Milliseconds that a program is expected to take: as long as its kernel took the last time,
    /// else by the length of its source. Above 0.
    [[nodiscard]] double expected_ms(const ProgramRecipe& recipe) const;

    /// Adds what a program took. A time far below what was expected is no compilation: some drivers
    /// have a cache of their own.
    void add(const ProgramRecipe& recipe, double ms);
    /// Writes the file where anything was added.
    void store() const;

  private:
    std::filesystem::path file_;
    std::map<std::string, double> times_;
    bool changed_ = false;
};

}  // namespace weft

#endif
