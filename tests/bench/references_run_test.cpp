// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/references/references_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "device/native/native_executor.h"
#include "scene/load/load_scene.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"

namespace weft::bench::references_run_test {
namespace {

BenchScene shipped_scene(const std::string& name) {
    const std::filesystem::path file = test::shipped_scene(name);
    return {name, [file](Diagnostics& diagnostics) { return load_scene(file, diagnostics); }, file};
}

/// References of tiny images.
class ReferencesRunOfTinyImages : public testing::Test {
  protected:
    ReferencesRunOfTinyImages() {
        run_.size = 16;
        run_.spp = 2;
        run_.goal = {.floor = {0.0, 100.0}, .most_spp = 64};
        run_.limit_minutes = 60.0;
        run_.folder = folder_.path();
        run_.say = [](const std::string&) {};
        run_.keep_going = [] { return true; };
        run_.report = [&](const std::vector<ReferenceRow>& rows) { reported_ = rows; };
    }

    [[nodiscard]] std::vector<ReferenceRow> make() {
        const auto executor = make_native_executor(NativeTraversal::own_bvh, 0);
        return make_references(run_, *executor, status_);
    }

    TemporaryFolder folder_;
    ReferencesRun run_;
    std::vector<ReferenceRow> reported_;
    int status_ = 0;
};

TEST_F(ReferencesRunOfTinyImages, EveryFilterOfEverySceneReachesTheGoal) {
    run_.scenes = {shipped_scene("cornell-box.gltf"), shipped_scene("cornell-box-fog.gltf")};
    run_.filters = {"box", "centre"};
    run_.goal.most_spp = 1U << 14;
    const std::vector<ReferenceRow> rows = make();
    ASSERT_EQ(rows.size(), 4U);
    std::set<std::string> files;
    for (const ReferenceRow& row : rows) {
        EXPECT_TRUE(row.reached) << row.scene << " " << row.filter;
        EXPECT_EQ(row.floor.value().published, 0.0);
        EXPECT_GT(row.hdrflip.value(), 0.0);
        EXPECT_GT(row.noise_relmse.value(), 0.0);
        EXPECT_GT(row.seconds, 0.0);
        EXPECT_TRUE(std::filesystem::is_regular_file(folder_.path() / row.file));
        EXPECT_TRUE(files.insert(row.file).second) << row.file;
    }
    EXPECT_EQ(rows[0].algorithm, "reference");
    EXPECT_EQ(rows[2].algorithm, "path") << "there is fog";
    EXPECT_EQ(reported_.size(), 4U);
    EXPECT_EQ(reported_[3].samples, rows[3].samples);
    EXPECT_EQ(status_, 0);
}

TEST_F(ReferencesRunOfTinyImages, TheOthersGoOnWithoutOneThatFails) {
    BenchScene missing = shipped_scene("cornell-box.gltf");
    missing.load = [](Diagnostics&) -> Scene {
        throw Error(ExitCode::bad_input, "gone.gltf", "cannot be opened");
    };
    run_.scenes = {missing, shipped_scene("cornell-box.gltf")};
    run_.goal.floor = {100.0, 100.0};
    const std::vector<ReferenceRow> rows = make();
    EXPECT_NE(rows[0].failure.find("cannot be opened"), std::string::npos);
    EXPECT_FALSE(rows[0].reached);
    EXPECT_TRUE(rows[1].reached);
    EXPECT_EQ(status_, static_cast<int>(ExitCode::bad_input));
}

TEST_F(ReferencesRunOfTinyImages, EndsAtItsLimits) {
    run_.scenes = {shipped_scene("cornell-box.gltf")};
    run_.goal = {.floor = {0.0, 0.0}, .most_spp = 9};
    EXPECT_EQ(make()[0].samples, 8U);
    EXPECT_FALSE(reported_[0].reached);
    run_.goal.most_spp = 1U << 20;
    run_.limit_minutes = 1e-9;
    EXPECT_LE(make()[0].samples, 16U) << "there was no time for more than a sample or none";
}

TEST_F(ReferencesRunOfTinyImages, AnInterruptionIsReported) {
    run_.scenes = {shipped_scene("cornell-box.gltf")};
    run_.keep_going = [] { return false; };
    EXPECT_THROW((void)make(), Error);
    ASSERT_EQ(reported_.size(), 1U);
    EXPECT_FALSE(reported_[0].floor.has_value());
}

TEST(ReferencesRun, ShippedScenesAreAllOfTheFolder) {
    const std::filesystem::path folder =
        std::filesystem::path(test::shipped_scene("cornell-box.gltf")).parent_path();
    std::set<std::string> names;
    for (const BenchScene& scene : all_shipped_scenes(folder))
        EXPECT_TRUE(names.insert(scene.name).second) << scene.name;
    std::set<std::string> expected;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".gltf") expected.insert(entry.path().filename().string());
    EXPECT_EQ(names, expected);
    EXPECT_TRUE(all_shipped_scenes("no-such-folder").empty());
}

}  // namespace
}  // namespace weft::bench::references_run_test
