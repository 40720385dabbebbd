// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/bench_main.h"

#include <fmt/format.h>

#include <cstdio>
#include <new>

#include "base/error.h"

namespace weft::bench {

int bench_main(const char* name, const std::function<int()>& body) {
    try {
        return body();
    } catch (const Error& error) {
        fmt::print(stderr, "bench {}: {}\n", name, error.what());
        return static_cast<int>(error.code());
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "bench {}: out of memory\n", name);
        return static_cast<int>(ExitCode::out_of_memory);
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench {}: {}\n", name, error.what());
        return static_cast<int>(ExitCode::device);
    }
}

std::optional<int> parse_arguments(CLI::App& app, int argc, char** argv) {
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
    }
    return std::nullopt;
}

std::unique_ptr<tbb::global_control> limit_threads(int threads) {
    if (threads <= 0) return nullptr;
    return std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                 static_cast<std::size_t>(threads));
}

void print(const std::string& text) {
    fmt::print("{}", text);
    std::fflush(stdout);
}

}  // namespace weft::bench
