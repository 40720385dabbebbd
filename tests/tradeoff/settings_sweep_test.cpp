// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/settings_sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "plan/algorithm.h"
#include "tests/testing/temporary_folder.h"

namespace weft::settings_sweep_test {
namespace {

bool has_family(const std::vector<Candidate>& candidates, const std::string& family) {
    return std::any_of(candidates.begin(), candidates.end(),
                       [&](const Candidate& candidate) { return candidate.family == family; });
}

std::vector<SweepScene> all_scenes() {
    std::vector<SweepScene> scenes;
    for (const bool indirect : {false, true})
        for (const bool lights : {false, true}) {
            scenes.push_back({indirect, lights, false, false});
            scenes.push_back({indirect, lights, true, false});
            scenes.push_back({indirect, lights, true, true});
        }
    return scenes;
}

TEST(SettingsSweep, HasAboutADozenOrAboutSixty) {
    EXPECT_GE(settings_sweep({}, SweepSize::quick).size(), 12U);
    EXPECT_LE(settings_sweep({}, SweepSize::quick).size(), 15U);
    EXPECT_GE(settings_sweep({}, SweepSize::full).size(), 50U);
    EXPECT_LE(settings_sweep({}, SweepSize::full).size(), 70U);
}

TEST(SettingsSweep, NamesAndSettingsAreUnique) {
    for (const SweepScene& scene : all_scenes())
        for (const SweepSize size : {SweepSize::quick, SweepSize::full}) {
            std::set<std::string> names, settings;
            for (const Candidate& candidate : settings_sweep(scene, size)) {
                EXPECT_TRUE(names.insert(candidate.name).second) << candidate.name;
                EXPECT_TRUE(settings.insert(preset_json(candidate.preset).dump()).second)
                    << candidate.name;
                EXPECT_EQ(candidate.family, to_string(candidate.preset.algorithm));
                EXPECT_EQ(candidate.name.find(candidate.family), 0U) << candidate.name;
            }
        }
}

TEST(SettingsSweep, ThoseThatFillBudgetsAreNamedAlikeWithAnySamples) {
    for (const SweepScene& scene : all_scenes())
        for (const SweepSize size : {SweepSize::quick, SweepSize::full}) {
            std::set<std::string> filling, settings;
            for (const Candidate& candidate : settings_sweep(scene, size)) {
                EXPECT_EQ(with_samples(candidate, candidate.preset.samples).name, candidate.name);
                if (!candidate.fills_budgets) continue;
                filling.insert(candidate.family);
                EXPECT_TRUE(
                    settings.insert(preset_json(with_samples(candidate, 7).preset).dump()).second)
                    << candidate.name;
            }
            EXPECT_TRUE(filling.contains("ais"));
            EXPECT_TRUE(filling.contains("path"));
        }
}

TEST(SettingsSweep, EverySettingCanBeKeptInAFile) {
    const TemporaryFolder folder;
    for (const Candidate& candidate : settings_sweep({}, SweepSize::full)) {
        const nlohmann::json json = preset_json(candidate.preset);
        const auto file = folder.write("preset.json", json.dump());
        EXPECT_EQ(preset_json(read_preset(file)), json) << candidate.name;
    }
}

TEST(SettingsSweep, TheQuickOneIsPartOfTheFullOne) {
    for (const SweepScene& scene : all_scenes()) {
        std::set<std::string> full;
        for (const Candidate& candidate : settings_sweep(scene, SweepSize::full))
            full.insert(preset_json(candidate.preset).dump());
        for (const Candidate& candidate : settings_sweep(scene, SweepSize::quick))
            EXPECT_TRUE(full.contains(preset_json(candidate.preset).dump())) << candidate.name;
    }
}

TEST(SettingsSweep, LeavesOutWhatTheSceneDoesNotCallFor) {
    const auto direct = settings_sweep({.indirect = false}, SweepSize::full);
    for (const char* family : {"ic", "irradiance-cache"}) EXPECT_FALSE(has_family(direct, family));
    for (const Candidate& candidate : direct) {
        EXPECT_FALSE(candidate.preset.sampling.cached) << candidate.name;
        EXPECT_EQ(candidate.name.find("vpls"), std::string::npos);
    }
    const auto exact =
        settings_sweep({.indirect = false, .sampled_lights = false}, SweepSize::full);
    for (const Candidate& candidate : exact) {
        EXPECT_EQ(candidate.name.find("threshold"), std::string::npos);
        EXPECT_EQ(candidate.name.find("light samples"), std::string::npos);
    }
    EXPECT_LT(exact.size(), direct.size());
    const auto plain = settings_sweep({.indirect = false, .adapts = false}, SweepSize::full);
    for (const Candidate& candidate : plain)
        EXPECT_EQ(candidate.name.find("threshold"), std::string::npos);
    const auto foggy = settings_sweep({.media = true, .media_light = true}, SweepSize::full);
    EXPECT_FALSE(has_family(foggy, "irradiance-cache"));
    EXPECT_TRUE(has_family(foggy, "ic"));
    for (const Candidate& candidate : foggy)
        EXPECT_FALSE(candidate.preset.sampling.compensation) << candidate.name;
    for (const SweepScene& scene : all_scenes())
        for (const SweepSize size : {SweepSize::quick, SweepSize::full}) {
            const auto all = settings_sweep(scene, size);
            EXPECT_FALSE(has_family(all, "tic"));
            for (const char* family : {"ais", "amax", "igi", "path"})
                EXPECT_TRUE(has_family(all, family)) << family;
        }
}

TEST(SettingsSweep, DenoisesPathsByWhatIsThere) {
    for (const SweepSize size : {SweepSize::quick, SweepSize::full})
        for (const bool oidn : {false, true}) {
            std::set<Denoiser> found;
            for (const Candidate& candidate : settings_sweep({.oidn = oidn}, size)) {
                found.insert(candidate.preset.denoiser);
                if (candidate.preset.denoiser == Denoiser::none) continue;
                EXPECT_EQ(candidate.preset.algorithm, Algorithm::path);
                EXPECT_NE(candidate.name.find(to_string(candidate.preset.denoiser)),
                          std::string::npos);
            }
            EXPECT_TRUE(found.contains(Denoiser::statistical));
            EXPECT_EQ(found.contains(Denoiser::oidn), oidn);
        }
}

TEST(SettingsSweep, ReadsTheSceneFromItsPlan) {
    SceneStatistics scene;
    scene.area_lights = 1;
    scene.surface_area = 1.0;
    scene.mean_reflectance = 0.5;
    const auto is_enabled = [&] {
        return sweep_scene(plan_frames(Algorithm::ais, SamplingSettings{}, scene));
    };
    EXPECT_TRUE(is_enabled().indirect);
    EXPECT_TRUE(is_enabled().sampled_lights);
    EXPECT_FALSE(is_enabled().media);
    scene.media = scene.scattering = true;
    EXPECT_TRUE(is_enabled().media);
    EXPECT_TRUE(is_enabled().media_light);
    scene.media = scene.scattering = false;
    scene.area_lights = 0;
    scene.punctual_lights = 1;
    EXPECT_FALSE(is_enabled().sampled_lights);
    EXPECT_TRUE(is_enabled().adapts);
    scene.mean_reflectance = 0.0;
    EXPECT_FALSE(is_enabled().indirect);
    EXPECT_FALSE(is_enabled().adapts);
    // Lights are looked at first where a set has enough samples on them.
    scene.area_lights = 1;
    EXPECT_FALSE(is_enabled().adapts);
    scene.area_lights = 16;
    EXPECT_TRUE(is_enabled().adapts);
    scene.area_lights = 0;
    scene.media = scene.scattering = true;
    EXPECT_TRUE(is_enabled().adapts);
}

}  // namespace
}  // namespace weft::settings_sweep_test
