// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_PATH_MITSUBA_CHOICE_H
#define WEFT_BENCH_PATH_MITSUBA_CHOICE_H

#include <filesystem>
#include <string>
#include <vector>

namespace weft::bench {

/// How programs in Python are started that use Mitsuba.
struct PythonPrograms {
    std::string python;            ///< interpreter
    std::filesystem::path folder;  ///< bench/ of the sources
};

/// The variant of Mitsuba 3 to compare with.
struct MitsubaChoice {
    PythonPrograms programs;
    std::string variant;              ///< such as "llvm_ad_rgb"; empty where none works
    std::string library;              ///< of LLVM; empty: none, or what Dr.Jit finds
    std::string version;              ///< of Mitsuba
    std::string llvm;                 ///< version of the library, as far as it is known
    std::string problem;              ///< why none works; else empty
    std::vector<std::string> failed;  ///< what was tried before, and why it is not taken

    [[nodiscard]] bool available() const noexcept { return !variant.empty(); }
    /// "Mitsuba 3.9.1, llvm_ad_rgb with LLVM 19.1.7 (LIBRARY)", or why there is none.
    [[nodiscard]] std::string text() const;
};

/// Asks bench/common/mitsuba_variant.py, which proves variants by rendering. `variant`: that one or
/// none; empty: the vectorised one with the newest library that it works with, else the scalar one.
[[nodiscard]] MitsubaChoice choose_mitsuba(const PythonPrograms& programs,
                                           const std::string& variant);

/// What that program has answered.
[[nodiscard]] MitsubaChoice read_choice(const PythonPrograms& programs, const std::string& line);

}  // namespace weft::bench

#endif
