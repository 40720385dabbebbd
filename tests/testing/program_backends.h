// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_PROGRAM_BACKENDS_H
#define WEFT_TESTS_TESTING_PROGRAM_BACKENDS_H

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/testing/run_program.h"

namespace weft::test {

/// Names for --backend that work on this machine, by what the program says.
inline std::vector<std::string> program_backends() {
    std::vector<std::string> names{"embree", "native"};
    for (const auto& device : nlohmann::json::parse(run_program({"devices", "--json"}).out))
        if (device["backend"] == "opencl" && names.back() != "opencl") names.push_back("opencl");
    return names;
}

}  // namespace weft::test

#endif
