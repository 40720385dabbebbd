// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/adaptive/adaptive_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "bench/common/candidate.h"

namespace weft::bench {
namespace {

using Figure = std::function<double(const FrameTime&)>;

double wall(const FrameTime& time) {
    return time.wall_ms;
}
double processor(const FrameTime& time) {
    return time.cpu_ms;
}
double on_device(const FrameTime& time) {
    return time.all.ms;
}
double indirect(const FrameTime& time) {
    return time.indirect.ms;
}
double direct(const FrameTime& time) {
    return time.direct.ms;
}
double media(const FrameTime& time) {
    return time.media.ms;
}
double million_rays(const FrameTime& time) {
    return static_cast<double>(time.all.rays) * 1e-6;
}

std::string cell(std::optional<double> value, int decimals = 2) {
    if (!value || !std::isfinite(*value)) return fmt::format("{:>9}", "-");
    return fmt::format("{:9.{}f}", *value, decimals);
}

std::string ratio_cell(const AdaptiveScene& scene, const MethodFrames& method, const char* other,
                       FrameView view, const Figure& figure) {
    const MethodFrames* const base = scene.frames.find(other);
    const double ratio = base != nullptr ? frame_ratio(method, *base, view, figure) : 0.0;
    return cell(ratio > 0.0 ? std::optional(ratio) : std::nullopt);
}

std::string time_row(const AdaptiveScene& scene, const MethodFrames& method) {
    std::string row = fmt::format("  {:10}", method.name);
    const auto time = [&](FrameView view, const Figure& figure) {
        return cell(method.median_of(view, figure), 1);
    };
    row += time(FrameView::full, wall) + time(FrameView::full, on_device) +
           time(FrameView::full, indirect) + time(FrameView::full, direct) +
           time(FrameView::full, media) + time(FrameView::indirect, wall) +
           time(FrameView::direct, wall);
    row += cell(method.median_of(FrameView::full, million_rays), 2);
    for (const char* const component : {"indirect", "direct", "media"}) {
        const double percent = method.median_of(FrameView::full, [&](const FrameTime& frame) {
            return 100.0 * static_cast<double>(frame.sampled(component)) /
                   (static_cast<double>(method.image.width) * method.image.height);
        });
        row += cell(percent > 0.0 ? std::optional(percent) : std::nullopt, 1);
    }
    const nlohmann::json share = ray_share(scene, method.name);
    row += cell(share.is_null() ? std::nullopt : std::optional(share.get<double>()));
    row += ratio_cell(scene, method, method_amax, FrameView::full, wall) +
           ratio_cell(scene, method, method_amax, FrameView::full, indirect) +
           ratio_cell(scene, method, method_amax, FrameView::full, direct) +
           ratio_cell(scene, method, method_amax, FrameView::full, media) +
           ratio_cell(scene, method, method_amax, FrameView::indirect, wall) +
           ratio_cell(scene, method, method_amax, FrameView::direct, wall) +
           ratio_cell(scene, method, method_amax, FrameView::full, processor) +
           ratio_cell(scene, method, method_igi, FrameView::full, wall) +
           ratio_cell(scene, method, method_igi, FrameView::full, processor);
    return row + "\n";
}

/// Where the milliseconds of full frames go: a line for every stage, a column for every method.
std::string stage_table(const AdaptiveScene& scene) {
    std::string text = fmt::format("  {:28}", "stage, ms");
    std::vector<std::pair<std::string, Stage>> stages;
    for (const MethodFrames& method : scene.frames.methods) {
        text += fmt::format("{:>9}", method.name);
        if (method.of(FrameView::full).empty()) continue;
        for (const StageStats& stage : method.of(FrameView::full).front().stages) {
            const std::pair key(stage.component, stage.stage);
            if (std::find(stages.begin(), stages.end(), key) == stages.end()) stages.push_back(key);
        }
    }
    std::stable_sort(stages.begin(), stages.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    text += "\n";
    const auto line = [&](const std::string& label, const Figure& figure) {
        text += fmt::format("  {:28}", label);
        for (const MethodFrames& method : scene.frames.methods)
            text += cell(method.median_of(FrameView::full, figure), 1);
        text += "\n";
    };
    for (const auto& stage : stages)
        line(
            (stage.first.empty() ? "" : stage.first + ": ") + std::string(stage_name(stage.second)),
            [&](const FrameTime& time) { return time.stage_ms(stage.first, stage.second); });
    line("outside of the device", [](const FrameTime& time) { return time.wall_ms - time.all.ms; });
    return text;
}

std::string shares_cells(const std::optional<VisibleShares>& shares) {
    return cell(shares ? std::optional(shares->p75) : std::nullopt) +
           cell(shares ? std::optional(shares->p95) : std::nullopt);
}

std::string percent_cell(const std::optional<double>& value) {
    return cell(value ? std::optional(100.0 * *value) : std::nullopt);
}

/// The value and the ends of the interval.
std::string unbiased_cells(const std::optional<ErrorEstimate>& error) {
    std::string cells;
    for (double ErrorEstimate::*const member :
         {&ErrorEstimate::value, &ErrorEstimate::low, &ErrorEstimate::high})
        cells += cell(error ? std::optional((*error).*member) : std::nullopt, 4);
    return cells;
}

std::string noise_line(const char* filter, const std::optional<double>& noise) {
    if (!noise) return {};
    return fmt::format("  the noise of the reference ({}) adds {:.4f} to relMSE{}\n", filter,
                       *noise, *noise > most_noise_relmse ? ": intervals are too narrow" : "");
}

std::string error_row(const std::string& method, const char* what, const ImageErrors& box,
                      const ImageErrors& centre) {
    std::string row = fmt::format("  {:10}{:9}", method, what);
    for (const ImageErrors* const errors : {&box, &centre})
        row += shares_cells(errors->published) + shares_cells(errors->display) +
               cell(errors->hdrflip, 4) + cell(errors->relmse, 4) +
               unbiased_cells(errors->unbiased_relmse) + percent_cell(errors->bias);
    return row + "\n";
}

nlohmann::json sum_json(const StageSum& sum) {
    return {{"ms", sum.ms}, {"rays", sum.rays}, {"mrays", sum.mrays()}};
}

nlohmann::json time_json(const FrameTime& time) {
    nlohmann::json levels = nlohmann::json::object();
    for (const LevelStats& level : time.levels)
        levels[level.component] = {{"tiles", level.tiles}, {"samples", level.samples}};
    nlohmann::json stages = nlohmann::json::array();
    for (const StageStats& stage : time.stages)
        stages.push_back({{"name", stage_name(stage.stage)},
                          {"component", stage.component},
                          {"ms", stage.ms},
                          {"rays", stage.rays}});
    return {{"levels", levels},
            {"stages", stages},
            {"wall_ms", time.wall_ms},
            {"cpu_ms", time.cpu_ms},
            {"all", sum_json(time.all)},
            {"indirect", sum_json(time.indirect)},
            {"direct", sum_json(time.direct)},
            {"media", sum_json(time.media)},
            {"vpl_gather", sum_json(time.vpl_gather)},
            {"area_lights", sum_json(time.area_lights)}};
}

nlohmann::json layers_json(const LayerErrors& errors) {
    return {{"beauty", errors.beauty.json()},
            {"indirect", errors.indirect.json()},
            {"direct", errors.direct.json()}};
}

}  // namespace

const MethodErrors* AdaptiveScene::errors_of(std::string_view method) const {
    for (std::size_t m = 0; m < errors.size(); ++m)
        if (frames.methods[m].name == method) return &errors[m];
    return nullptr;
}

nlohmann::json ray_share(const AdaptiveScene& scene, std::string_view method, bool of_indirect,
                         bool of_direct) {
    const MethodFrames* const frames = scene.frames.find(method);
    if (frames == nullptr) return {};
    const std::vector<FrameTime>& runs = frames->of(FrameView::full);
    std::vector<double> shares;
    for (std::size_t i = 0; i < std::min(runs.size(), scene.frames.packets.size()); ++i) {
        StageSum sum;
        if (of_indirect) sum.ms += runs[i].vpl_gather.ms, sum.rays += runs[i].vpl_gather.rays;
        if (of_direct) sum.ms += runs[i].area_lights.ms, sum.rays += runs[i].area_lights.rays;
        const double packets = scene.frames.packets[i].mrays();
        if (sum.mrays() > 0.0 && packets > 0.0) shares.push_back(sum.mrays() / packets);
    }
    return shares.empty() ? nlohmann::json() : nlohmann::json(median(std::move(shares)));
}

std::string adaptive_legend() {
    return "Times: medians in milliseconds. full: wall time of a frame; device: of it, on the\n"
           "device; ID, SS, PM: the stages of indirect and of direct light and of light that\n"
           "media scatter within it; ID only, SS only: wall time of frames with that light\n"
           "alone. Mrays: million rays of a frame;\n"
           "% ID, % SS, % PM: pixels that adaptive sampling samples, percent;\n"
           "share: rate of its shadow rays over that of packets. x full to x SS o.: times as\n"
           "fast as amax in each of these, x cpu the full frame by processor time; x igi and\n"
           "x i.cpu: the full frame against igi. Ratios are medians of those within repetitions.\n"
           "Errors against references with a box filter, then through pixel centres (ctr): p75,\n"
           "p95: percent of the pixels whose difference is seen with that probability (HDR-VDP)\n"
           "at 1 cd/m2 of value 1; d75, d95: at 100; HDR-FLIP; relMSE; unb., low,\n"
           "high: relMSE without the noise of the reference, and its interval (95 %); bias of the\n"
           "mean, percent. floor: one half of the reference's samples against the other; errors "
           "as\n"
           "small as that say nothing.\n";
}

std::string adaptive_tables(const AdaptiveScene& scene) {
    std::string text =
        fmt::format("\n{}: {} triangles\n  {:10}", scene.name, scene.triangles, "method");
    for (const char* const title :
         {"full",  "device", "ID",      "SS",      "PM",    "ID only", "SS only",
          "Mrays", "% ID",   "% SS",    "% PM",    "share", "x full",  "x ID",
          "x SS",  "x PM",   "x ID o.", "x SS o.", "x cpu", "x igi",   "x i.cpu"})
        text += fmt::format("{:>9}", title);
    text += "\n";
    for (const MethodFrames& method : scene.frames.methods) text += time_row(scene, method);
    text += stage_table(scene);
    if (scene.errors.empty()) return text;
    text += fmt::format("  {:10}{:9}", "method", "layer");
    for (const char* const filter : {"box ", "ctr "})
        for (const char* const title :
             {"p75", "p95", "d75", "d95", "FLIP", "rMSE", "unb.", "low", "high", "bias"})
            text += fmt::format("{:>9}", std::string(filter) + title);
    text += "\n";
    for (std::size_t m = 0; m < scene.errors.size(); ++m) {
        const std::string& name = scene.frames.methods[m].name;
        const LayerErrors& box = scene.errors[m].box;
        const LayerErrors& centre = scene.errors[m].centre;
        text += error_row(name, "beauty", box.beauty, centre.beauty);
        text += error_row("", "indirect", box.indirect, centre.indirect);
        text += error_row("", "direct", box.direct, centre.direct);
    }
    if (scene.floors.box || scene.floors.centre)
        text += error_row("floor", "beauty", scene.floors.box.value_or(ImageErrors{}),
                          scene.floors.centre.value_or(ImageErrors{}));
    text += noise_line("box", scene.floors.box_noise);
    text += noise_line("centre", scene.floors.centre_noise);
    return text;
}

nlohmann::json adaptive_json(const AdaptiveScene& scene) {
    nlohmann::json methods = nlohmann::json::array();
    for (std::size_t m = 0; m < scene.frames.methods.size(); ++m) {
        const MethodFrames& frames = scene.frames.methods[m];
        nlohmann::json method{{"name", frames.name},
                              {"ray_share", ray_share(scene, frames.name)},
                              {"ray_share_indirect", ray_share(scene, frames.name, true, false)},
                              {"ray_share_direct", ray_share(scene, frames.name, false, true)}};
        for (const FrameView view : frame_views) {
            nlohmann::json runs = nlohmann::json::array();
            for (const FrameTime& time : frames.of(view)) runs.push_back(time_json(time));
            method["frames"][to_string(view)] = runs;
        }
        if (m < scene.errors.size())
            method["errors"] = {{"box", layers_json(scene.errors[m].box)},
                                {"centre", layers_json(scene.errors[m].centre)}};
        methods.push_back(method);
    }
    nlohmann::json packets = nlohmann::json::array();
    for (const StageSum& sum : scene.frames.packets) packets.push_back(sum_json(sum));
    return {{"name", scene.name},           {"shipped", scene.shipped},
            {"triangles", scene.triangles}, {"references", scene.references},
            {"packets", packets},           {"methods", methods}};
}

}  // namespace weft::bench
