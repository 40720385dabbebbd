// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Errors of images against two halves of a reference, for `bench other_renderers`.
// docs/benchmarks.md says what they are.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/common/bench_main.h"
#include "bench/half_errors/reference_halves.h"
#include "image/exr.h"
#include "image/load_image.h"

namespace {

using namespace weft;
using namespace weft::bench;

struct Settings {
    std::string first;
    std::string second;
    std::vector<std::string> images;
    std::string mean;
};

void add_options(CLI::App& app, Settings& settings) {
    app.add_option("FIRST", settings.first, "a reference")->required();
    app.add_option("SECOND", settings.second, "another one, of other random numbers")->required();
    app.add_option("IMAGE", settings.images, "images to compare with both");
    app.add_option("--mean", settings.mean, "write the mean of both references, as .exr");
}

void run(const Settings& settings) {
    const Image first = load_image(settings.first);
    const Image second = load_image(settings.second);
    if (!settings.mean.empty())
        write_exr(settings.mean, mean_of_halves(first, second, settings.second));
    nlohmann::json found = nlohmann::json::array();
    for (const std::string& image : settings.images) {
        const HalvesError error = halves_error(load_image(image), first, second, image);
        found.push_back({{"relmse", error.relmse}, {"interval", error.interval}});
    }
    fmt::print("{}\n", found.dump());
}

}  // namespace

int main(int argc, char** argv) {
    return bench_main("half_errors", [&] {
        Settings settings;
        CLI::App app{"Errors of images against two halves of a reference, as JSON"};
        add_options(app, settings);
        if (const auto code = parse_arguments(app, argc, argv)) return *code;
        run(settings);
        return 0;
    });
}
