// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/kernels/kernel_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <utility>

namespace weft::bench {
namespace {

using Figure = std::function<double(const MeteredFrame&)>;

double median_of(const BackendFrames& backend, const Figure& figure) {
    std::vector<double> values;
    for (const MeteredFrame& frame : backend.frames) values.push_back(figure(frame));
    return median(std::move(values));
}

/// How many times as long as on `base`; null where either takes no time.
nlohmann::json ratio(const BackendFrames& backend, const BackendFrames& base,
                     const Figure& figure) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(backend.frames.size(), base.frames.size()); ++i) {
        const double ours = figure(backend.frames[i]);
        const double theirs = figure(base.frames[i]);
        if (ours > 0.0 && theirs > 0.0) ratios.push_back(ours / theirs);
    }
    if (ratios.empty()) return {};
    return median(std::move(ratios));
}

/// A frame whose kernels know their rays, where there is one: all frames trace the same.
const MeteredFrame& example(const BackendFrames& backend) {
    for (const MeteredFrame& frame : backend.frames)
        if (frame.rays_of_kernels_known) return frame;
    return backend.frames.front();
}

nlohmann::json stages_json(const BackendFrames& backend, const BackendFrames& base) {
    nlohmann::json stages = nlohmann::json::array();
    for (const StageStats& stage : example(backend).stages) {
        const Figure ms = [&](const MeteredFrame& frame) { return frame.stage_ms(stage); };
        stages.push_back({{"name", stage_name(stage.stage)},
                          {"component", stage.component},
                          {"ms", median_of(backend, ms)},
                          {"ratio", ratio(backend, base, ms)},
                          {"rays", stage.rays}});
    }
    return stages;
}

nlohmann::json kernels_json(const BackendFrames& backend, const BackendFrames& base) {
    const MeteredFrame& frame_of_rays = example(backend);
    nlohmann::json kernels = nlohmann::json::array();
    for (const KernelUse& use : frame_of_rays.kernels) {
        const Figure ms = [&](const MeteredFrame& frame) { return frame.kernel_ms(use.kernel); };
        const Figure share = [&](const MeteredFrame& frame) {
            return frame.timing.wall_ms > 0.0 ? ms(frame) / frame.timing.wall_ms : 0.0;
        };
        nlohmann::json rays;
        if (frame_of_rays.rays_of_kernels_known) rays = use.rays;
        kernels.push_back({{"kernel", std::string(kernel_name(use.kernel))},
                           {"ms", median_of(backend, ms)},
                           {"ratio", ratio(backend, base, ms)},
                           {"share", median_of(backend, share)},
                           {"launches", use.launches},
                           {"items", use.items},
                           {"rays", rays},
                           {"bound_bytes", use.bound_bytes}});
    }
    return kernels;
}

nlohmann::json backend_json(const BackendFrames& backend, const BackendFrames& base) {
    const Figure wall = [](const MeteredFrame& frame) { return frame.timing.wall_ms; };
    const Figure cpu = [](const MeteredFrame& frame) { return frame.timing.cpu_ms; };
    const Figure device = [](const MeteredFrame& frame) { return frame.device_ms; };
    nlohmann::json runs = nlohmann::json::array();
    for (const MeteredFrame& frame : backend.frames) runs.push_back(frame.timing.wall_ms);
    const MeteredFrame& one = example(backend);
    return {{"backend", backend.backend},
            {"ms", median_of(backend, wall)},
            {"ratio", ratio(backend, base, wall)},
            {"cpu_ms", median_of(backend, cpu)},
            {"cpu_ratio", ratio(backend, base, cpu)},
            {"device_ms", median_of(backend, device)},
            {"device_ratio", ratio(backend, base, device)},
            {"runs_ms", runs},
            {"rays", one.rays},
            {"host_read_bytes", one.read_bytes},
            {"host_written_bytes", one.written_bytes},
            {"stages", stages_json(backend, base)},
            {"kernels", kernels_json(backend, base)}};
}

std::string cell(const nlohmann::json& number, int width, int decimals) {
    return number.is_number() ? fmt::format("{:{}.{}f}", number.get<double>(), width, decimals)
                              : fmt::format("{:>{}}", "-", width);
}

std::string millions(const nlohmann::json& number) {
    return cell(number.is_number() ? nlohmann::json(number.get<double>() * 1e-6) : number, 9, 3);
}

/// Milliseconds and ratio of the entry with that name in a list of a backend.
std::string times(const nlohmann::json& list, const std::vector<std::string>& keys,
                  const nlohmann::json& wanted) {
    for (const nlohmann::json& entry : list)
        if (std::all_of(keys.begin(), keys.end(),
                        [&](const std::string& key) { return entry[key] == wanted[key]; }))
            return cell(entry["ms"], 10, 3) + cell(entry["ratio"], 7, 2);
    return fmt::format("{:>10}{:>7}", "-", "-");
}

std::string method_table(const nlohmann::json& method) {
    const nlohmann::json& backends = method["backends"];
    const nlohmann::json& first = backends.front();
    std::string text = fmt::format("\n  {:<36}", method["method"].get<std::string>());
    for (const nlohmann::json& backend : backends)
        text += fmt::format("{:>10}{:>7}", backend["backend"].get<std::string>(), "ratio");
    text += fmt::format("{:>9}{:>10}{:>9}{:>9}\n  {:<36}", "share %", "launches", "Mrays", "MB",
                        "whole frame");
    for (const nlohmann::json& backend : backends)
        text += cell(backend["ms"], 10, 3) + cell(backend["ratio"], 7, 2);
    text += fmt::format("{:>9}{:>10}{}{:>9}\n  {:<36}", "", "", millions(first["rays"]), "",
                        "on the device");
    for (const nlohmann::json& backend : backends)
        text += cell(backend["device_ms"], 10, 3) + cell(backend["device_ratio"], 7, 2);
    text += "\n";
    for (const nlohmann::json& stage : first["stages"]) {
        const auto component = stage["component"].get<std::string>();
        text += fmt::format("  stage  {:<29}", stage["name"].get<std::string>() +
                                                   (component.empty() ? "" : ", " + component));
        for (const nlohmann::json& backend : backends)
            text += times(backend["stages"], {"name", "component"}, stage);
        text += fmt::format("{:>9}{:>10}{}\n", "", "", millions(stage["rays"]));
    }
    for (const nlohmann::json& kernel : first["kernels"]) {
        text += fmt::format("  kernel {:<29}", kernel["kernel"].get<std::string>());
        for (const nlohmann::json& backend : backends)
            text += times(backend["kernels"], {"kernel"}, kernel);
        text += fmt::format("{:9.1f}{:>10}{}{}\n", 100.0 * kernel["share"].get<double>(),
                            kernel["launches"].get<std::uint64_t>(), millions(kernel["rays"]),
                            millions(kernel["bound_bytes"]));
    }
    return text;
}

/// Geometric mean: that of ratios does not depend on which of two is the base.
nlohmann::json geometric_mean(const std::vector<double>& values) {
    if (values.empty()) return {};
    double sum = 0.0;
    for (const double value : values) sum += std::log(value);
    return std::exp(sum / static_cast<double>(values.size()));
}

}  // namespace

std::string kernel_legend() {
    return "Milliseconds are medians; a ratio is the time over that of the first backend, below 1 "
           "is faster.\nshare, launches, Mrays and MB are the first backend's: share of the "
           "frame's wall time, million rays,\nmillion bytes of the buffers that the kernel is "
           "given, without the acceleration structure.\n";
}

nlohmann::json kernel_json(const MeteredScene& scene) {
    nlohmann::json structures = nlohmann::json::array();
    for (const BackendScene& structure : scene.structures) {
        nlohmann::json bytes;
        if (structure.bytes) bytes = *structure.bytes;
        structures.push_back(
            {{"backend", structure.backend}, {"build_ms", structure.build_ms}, {"bytes", bytes}});
    }
    nlohmann::json methods = nlohmann::json::array();
    for (const MethodOnBackends& method : scene.methods) {
        nlohmann::json backends = nlohmann::json::array();
        for (const BackendFrames& backend : method.backends)
            backends.push_back(backend_json(backend, method.backends.front()));
        methods.push_back({{"method", method.method}, {"backends", backends}});
    }
    return {{"scene", scene.name},
            {"triangles", scene.triangles},
            {"media", scene.media},
            {"structures", structures},
            {"methods", methods}};
}

std::string kernel_tables(const nlohmann::json& scene) {
    std::string text = fmt::format("\n{}, {} triangles\n", scene["scene"].get<std::string>(),
                                   scene["triangles"].get<std::uint64_t>());
    for (const nlohmann::json& structure : scene["structures"])
        text += fmt::format(
            "  {}: acceleration structure built in {:.1f} ms{}\n",
            structure["backend"].get<std::string>(), structure["build_ms"].get<double>(),
            structure["bytes"].is_number()
                ? fmt::format(", {:.3f} MB", structure["bytes"].get<double>() * 1e-6)
                : "");
    for (const nlohmann::json& method : scene["methods"]) text += method_table(method);
    return text;
}

nlohmann::json builds_json(const Executor& executor) {
    nlohmann::json builds = nlohmann::json::array();
    if (executor.device().index < 0) return builds;
    for (const KernelBuild& build : executor.builds())
        builds.push_back({{"kernel", build.name},
                          {"flags", build.flags},
                          {"ms", build.build_ms},
                          {"from_cache", build.from_cache}});
    return builds;
}

nlohmann::json kernel_summary(const nlohmann::json& scenes) {
    std::map<std::string, std::map<std::string, std::vector<double>>> ratios;
    for (const nlohmann::json& scene : scenes)
        for (const nlohmann::json& method : scene["methods"])
            for (std::size_t b = 1; b < method["backends"].size(); ++b) {
                const nlohmann::json& backend = method["backends"][b];
                auto& of_backend = ratios[backend["backend"].get<std::string>()];
                const auto add = [&](const std::string& name, const nlohmann::json& value) {
                    if (value.is_number()) of_backend[name].push_back(value.get<double>());
                };
                add("frame", backend["ratio"]);
                add("device", backend["device_ratio"]);
                add(scene["media"].get<bool>() ? "frame_media" : "frame_no_media",
                    backend["ratio"]);
                add("method_" + method["method"].get<std::string>(), backend["ratio"]);
                for (const nlohmann::json& kernel : backend["kernels"])
                    add("kernel_" + kernel["kernel"].get<std::string>(), kernel["ratio"]);
            }
    nlohmann::json summary = nlohmann::json::object();
    for (const auto& [backend, names] : ratios)
        for (const auto& [name, values] : names) summary[backend][name] = geometric_mean(values);
    return summary;
}

}  // namespace weft::bench
