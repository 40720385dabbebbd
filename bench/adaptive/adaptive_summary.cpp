// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <optional>

#include "bench/adaptive/adaptive_report.h"

namespace weft::bench {
namespace {

using Value = std::function<std::optional<double>(const AdaptiveScene&)>;

/// The scenes with media of a run, or those without.
struct SceneSet {
    const std::vector<AdaptiveScene>& all;
    bool media;
};

/// The scenes that means are over: those that come with Weft only where there are no others.
std::vector<const AdaptiveScene*> counted(const SceneSet& scenes) {
    std::vector<const AdaptiveScene*> real;
    std::vector<const AdaptiveScene*> shipped;
    for (const AdaptiveScene& scene : scenes.all)
        if (scene.media == scenes.media) (scene.shipped ? shipped : real).push_back(&scene);
    return real.empty() ? shipped : real;
}

std::vector<double> values(const SceneSet& scenes, const Value& value) {
    std::vector<double> result;
    for (const AdaptiveScene* const scene : counted(scenes))
        if (const auto x = value(*scene); x && std::isfinite(*x)) result.push_back(*x);
    return result;
}

nlohmann::json mean(const SceneSet& scenes, const Value& value) {
    const std::vector<double> all = values(scenes, value);
    if (all.empty()) return {};
    double sum = 0.0;
    for (const double x : all) sum += x;
    return sum / static_cast<double>(all.size());
}

nlohmann::json smallest(const SceneSet& scenes, const Value& value) {
    const std::vector<double> all = values(scenes, value);
    return all.empty() ? nlohmann::json()
                       : nlohmann::json(*std::min_element(all.begin(), all.end()));
}

nlohmann::json largest(const SceneSet& scenes, const Value& value) {
    const std::vector<double> all = values(scenes, value);
    return all.empty() ? nlohmann::json()
                       : nlohmann::json(*std::max_element(all.begin(), all.end()));
}

Value speedup(const std::string& method, const char* other, FrameView view,
              std::function<double(const FrameTime&)> figure) {
    return [=](const AdaptiveScene& scene) -> std::optional<double> {
        const MethodFrames* const ours = scene.frames.find(method);
        const MethodFrames* const theirs = scene.frames.find(other);
        if (ours == nullptr || theirs == nullptr) return std::nullopt;
        const double ratio = frame_ratio(*ours, *theirs, view, figure);
        return ratio > 0.0 ? std::optional(ratio) : std::nullopt;
    };
}

Value least_share(bool indirect, bool direct) {
    return [=](const AdaptiveScene& scene) {
        std::optional<double> least;
        for (const char* const method : {method_amax, method_igi}) {
            const nlohmann::json share = ray_share(scene, method, indirect, direct);
            if (!share.is_null()) least = std::min(least.value_or(1e30), share.get<double>());
        }
        return least;
    };
}

using Pick = std::function<std::optional<double>(const LayerErrors&)>;

/// An error of a method's image.
Value error(const std::string& method, bool centre, const Pick& pick) {
    return [=](const AdaptiveScene& scene) -> std::optional<double> {
        const MethodErrors* const errors = scene.errors_of(method);
        if (errors == nullptr) return std::nullopt;
        return pick(centre ? errors->centre : errors->box);
    };
}

/// An error of one half of the reference against the other.
Value floor_of(bool centre, const Pick& pick) {
    return [=](const AdaptiveScene& scene) -> std::optional<double> {
        const std::optional<ImageErrors>& floor = centre ? scene.floors.centre : scene.floors.box;
        return floor ? pick({*floor, {}, {}}) : std::nullopt;
    };
}

Value difference(const Value& a, const Value& b) {
    return [=](const AdaptiveScene& scene) -> std::optional<double> {
        const auto x = a(scene);
        const auto y = b(scene);
        return x && y ? std::optional(*x - *y) : std::nullopt;
    };
}

std::optional<double> of_shares(const std::optional<VisibleShares>& shares,
                                double VisibleShares::*member) {
    return shares ? std::optional((*shares).*member) : std::nullopt;
}

void add_speeds(const SceneSet& scenes, const std::string& ais, nlohmann::json& summary) {
    const auto wall = [](const FrameTime& time) { return time.wall_ms; };
    const auto cpu = [](const FrameTime& time) { return time.cpu_ms; };
    const auto device = [](const FrameTime& time) { return time.all.ms; };
    const auto id = [](const FrameTime& time) { return time.indirect.ms; };
    const auto ss = [](const FrameTime& time) { return time.direct.ms; };
    const auto against_amax = [&](FrameView view, const auto& figure) {
        return mean(scenes, speedup(ais, method_amax, view, figure));
    };
    summary["speedup_id"] = against_amax(FrameView::full, id);
    summary["speedup_ss"] = against_amax(FrameView::full, ss);
    summary["speedup_pm"] =
        against_amax(FrameView::full, [](const FrameTime& time) { return time.media.ms; });
    summary["speedup_full"] = against_amax(FrameView::full, wall);
    summary["speedup_full_device"] = against_amax(FrameView::full, device);
    summary["speedup_full_cpu"] = against_amax(FrameView::full, cpu);
    summary["speedup_id_alone"] = against_amax(FrameView::indirect, wall);
    summary["speedup_ss_alone"] = against_amax(FrameView::direct, wall);
    summary["speedup_id_alone_cpu"] = against_amax(FrameView::indirect, cpu);
    summary["speedup_ss_alone_cpu"] = against_amax(FrameView::direct, cpu);
    summary["speedup_vs_igi_cpu"] = mean(scenes, speedup(ais, method_igi, FrameView::full, cpu));
    summary["speedup_vs_igi"] = mean(scenes, speedup(ais, method_igi, FrameView::full, wall));
    summary["baseline_ray_share"] = smallest(scenes, least_share(true, true));
    summary["baseline_ray_share_indirect"] = smallest(scenes, least_share(true, false));
    summary["baseline_ray_share_direct"] = smallest(scenes, least_share(false, true));
}

/// Keys vdp75_ais and so on, vdp75_floor for the halves of the reference; the pixel-centre
/// reference and the display protocol as suffixes.
void add_errors(const SceneSet& scenes, const std::string& ais, nlohmann::json& summary) {
    struct Share {
        const char* key;
        double VisibleShares::*member;
    };
    constexpr std::array shares{Share{"vdp75", &VisibleShares::p75},
                                Share{"vdp95", &VisibleShares::p95}};
    const std::array<std::pair<const char*, std::string>, 3> methods{
        {{"ais", ais}, {"amax", method_amax}, {"igi", method_igi}}};
    for (const bool centre : {false, true}) {
        const std::string filter = centre ? "_centre" : "";
        const auto add_means = [&](const std::string& name, const std::string& suffix,
                                   const Pick& pick) {
            for (const auto& [key, method] : methods)
                summary[name + "_" + key + filter + suffix] =
                    mean(scenes, error(method, centre, pick));
        };
        const auto add = [&](const std::string& name, const std::string& suffix, const Pick& pick) {
            add_means(name, suffix, pick);
            summary["worst_" + name + "_difference" + filter + suffix] = largest(
                scenes, difference(error(ais, centre, pick), error(method_amax, centre, pick)));
            summary[name + "_floor" + filter + suffix] = mean(scenes, floor_of(centre, pick));
        };
        for (const Share& share : shares) {
            add(share.key, "", [share](const LayerErrors& errors) {
                return of_shares(errors.beauty.published, share.member);
            });
            add(share.key, "_display", [share](const LayerErrors& errors) {
                return of_shares(errors.beauty.display, share.member);
            });
        }
        add("hdrflip", "", [](const LayerErrors& errors) { return errors.beauty.hdrflip; });
        add("relmse", "", [](const LayerErrors& errors) { return errors.beauty.relmse; });
        add_means("unbiased_relmse", "", [](const LayerErrors& errors) {
            const auto& unbiased = errors.beauty.unbiased_relmse;
            return unbiased ? std::optional(unbiased->value) : std::nullopt;
        });
        add_means("bias", "", [](const LayerErrors& errors) { return errors.beauty.bias; });
    }
}

/// What a scene of ours is called in the published tables.
std::string published_name(std::string name) {
    if (name == "cornell-box") return "Cornell";
    name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
    return name;
}

std::optional<double> number_at(const nlohmann::json& object, const std::string& key) {
    if (!object.is_object() || !object.contains(key) || !object[key].is_number())
        return std::nullopt;
    return object[key].get<double>();
}

/// Mean of a column over the rows that `wanted` names, or over all.
std::optional<double> published_mean(const nlohmann::json& published, const char* table,
                                     const char* column, const nlohmann::json* wanted) {
    if (!published.is_object() || !published.contains(table)) return std::nullopt;
    const nlohmann::json rows = published[table].value("rows", nlohmann::json::object());
    double sum = 0.0;
    int count = 0;
    for (const auto& entry : rows.items()) {
        const bool named =
            wanted == nullptr || std::any_of(wanted->begin(), wanted->end(), [&](const auto& own) {
                return published_name(own.template get<std::string>()) == entry.key();
            });
        const auto value = number_at(entry.value(), column);
        if (!named || !value) continue;
        sum += *value;
        ++count;
    }
    return count > 0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace

nlohmann::json adaptive_summary(const std::vector<AdaptiveScene>& scenes, const std::string& ais) {
    nlohmann::json summary{{"method", ais}, {"scenes", nlohmann::json::array()}};
    const SceneSet clear{scenes, false};
    for (const AdaptiveScene* const scene : counted(clear))
        summary["scenes"].push_back(scene->name);
    add_speeds(clear, ais, summary);
    add_errors(clear, ais, summary);
    const SceneSet foggy{scenes, true};
    nlohmann::json of_media;
    add_speeds(foggy, ais, of_media);
    add_errors(foggy, ais, of_media);
    summary["speedup_pm"] = of_media["speedup_pm"];
    of_media.erase("speedup_pm");
    for (const auto& [key, value] : of_media.items()) summary[key + "_media"] = value;
    return summary;
}

std::string summary_table(const nlohmann::json& summary, const nlohmann::json& published) {
    struct Row {
        const char* key;
        const char* table;
        const char* column;
    };
    constexpr std::array rows{Row{"speedup_id", "speedup", "ID"},
                              Row{"speedup_ss", "speedup", "SS"},
                              Row{"speedup_pm", "speedup", "PM"},
                              Row{"speedup_full", "speedup", "FULL"},
                              Row{"speedup_vs_igi", "speedup", "FULL_A_vs_IGI"},
                              Row{"vdp75_ais", "hdrvdp_percent_of_pixels", "A_75"},
                              Row{"vdp95_ais", "hdrvdp_percent_of_pixels", "A_95"},
                              Row{"vdp75_amax", "hdrvdp_percent_of_pixels", "AMAX_75"},
                              Row{"vdp95_amax", "hdrvdp_percent_of_pixels", "AMAX_95"},
                              Row{"vdp75_igi", "hdrvdp_percent_of_pixels", "IGI_75"},
                              Row{"vdp95_igi", "hdrvdp_percent_of_pixels", "IGI_95"}};
    const auto cell = [](const std::optional<double>& value) {
        return value ? fmt::format("{:12.3f}", *value) : fmt::format("{:>12}", "-");
    };
    std::string text =
        fmt::format("\n{:36}{:>12}{:>12}{:>12}\n", "means, " + summary.value("method", ""), "here",
                    "published", "same names");
    const nlohmann::json names = summary.value("scenes", nlohmann::json::array());
    for (const Row& row : rows)
        text += fmt::format("{:36}", row.key) + cell(number_at(summary, row.key)) +
                cell(published_mean(published, row.table, row.column, nullptr)) +
                cell(published_mean(published, row.table, row.column, &names)) + "\n";
    for (const char* const key : {"speedup_id_alone",
                                  "speedup_ss_alone",
                                  "speedup_full_device",
                                  "speedup_full_cpu",
                                  "speedup_vs_igi_cpu",
                                  "baseline_ray_share",
                                  "vdp75_floor",
                                  "vdp95_floor",
                                  "hdrflip_floor",
                                  "unbiased_relmse_ais",
                                  "unbiased_relmse_amax",
                                  "unbiased_relmse_igi",
                                  "vdp75_ais_display",
                                  "vdp75_amax_display",
                                  "vdp75_igi_display",
                                  "vdp75_ais_centre",
                                  "vdp75_amax_centre",
                                  "vdp75_igi_centre",
                                  "worst_vdp75_difference",
                                  "worst_vdp75_difference_display",
                                  "worst_vdp75_difference_centre",
                                  "speedup_full_media",
                                  "speedup_id_media",
                                  "speedup_ss_media",
                                  "speedup_vs_igi_media",
                                  "vdp75_ais_media",
                                  "vdp75_amax_media",
                                  "vdp95_ais_media",
                                  "worst_vdp75_difference_media"})
        text += fmt::format("{:36}", key) + cell(number_at(summary, key)) + "\n";
    return text;
}

}  // namespace weft::bench
