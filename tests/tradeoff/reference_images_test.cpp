// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/reference_images.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/error.h"
#include "device/native/native_executor.h"
#include "device/shared_scene.h"
#include "image/exr.h"
#include "render/camera_params.h"
#include "scene/load/load_scene.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"
#include "tradeoff/image_errors.h"

namespace weft::reference_images_test {
namespace {

class ReferenceImagesOfABox : public testing::Test {
  protected:
    ReferenceImagesOfABox()
        : scene_(load_scene(test::shipped_scene("cornell-box.gltf"), diagnostics_)),
          flat_(flatten(scene_)),
          camera_(choose_camera(scene_, flat_, "", diagnostics_)),
          executor_(make_native_executor(NativeTraversal::own_bvh, 0)),
          shared_(*executor_) {
        wish_.scene = "box";
        wish_.size = 20;
        wish_.height = 12;
        wish_.spp = 8;
        wish_.with_halves = true;
    }

    [[nodiscard]] Reference find(const std::string& folder,
                                 std::function<bool(double)> keep_going = {}) {
        ReferenceImages images(
            folder_.path() / folder, shared_, [&](const std::string&) { ++made_; },
            std::move(keep_going));
        return images.find(flat_, camera_, wish_);
    }

    [[nodiscard]] Reference reach(const std::string& folder, const FloorGoal& goal,
                                  std::function<bool(double)> keep_going = {}) {
        ReferenceImages images(
            folder_.path() / folder, shared_, [&](const std::string&) { ++made_; },
            std::move(keep_going));
        return images.reach(flat_, camera_, wish_, goal);
    }

    /// The images in a folder, without sums.
    [[nodiscard]] std::vector<std::filesystem::path> images_in(const std::string& folder) const {
        std::vector<std::filesystem::path> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / folder))
            if (entry.path().extension() == ".exr") found.push_back(entry.path());
        return found;
    }

    Diagnostics diagnostics_;
    Scene scene_;
    FlatScene flat_;
    Camera camera_;
    std::unique_ptr<Executor> executor_;
    SharedScene shared_;
    ReferenceWish wish_;
    TemporaryFolder folder_;
    int made_ = 0;
};

void expect_same(const Image& a, const Image& b) {
    for (const char* const name : {"", "direct", "indirect", first_half_layer, second_half_layer}) {
        ASSERT_NE(a.find(name), nullptr) << name;
        ASSERT_NE(b.find(name), nullptr) << name;
        EXPECT_EQ(a.find(name)->values, b.find(name)->values) << name;
    }
}

TEST_F(ReferenceImagesOfABox, IsTheMeanOfItsHalves) {
    const Reference reference = find("a");
    EXPECT_EQ(reference.samples, 8U);
    EXPECT_TRUE(reference.identified);
    EXPECT_EQ(reference.image.width, 20U);
    EXPECT_EQ(reference.image.height, 12U);
    const std::vector<float>& whole = reference.image.find("")->values;
    const std::vector<float>& first = reference.image.find(first_half_layer)->values;
    const std::vector<float>& second = reference.image.find(second_half_layer)->values;
    std::size_t different = 0;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_NEAR(whole[i], 0.5F * (first[i] + second[i]), 1e-5F * (1.0F + whole[i]));
        if (first[i] != second[i]) ++different;
    }
    EXPECT_GT(different, whole.size() / 4);
}

TEST_F(ReferenceImagesOfABox, IsMadeOnce) {
    const Reference first = find("a");
    EXPECT_EQ(made_, 1);
    const Reference second = find("a");
    EXPECT_EQ(made_, 1);
    EXPECT_EQ(first.file, second.file);
    expect_same(first.image, second.image);
    wish_.spp = 4;  // fewer than there are
    EXPECT_EQ(find("a").samples, 8U);
    wish_.scene = "crate";  // the digest says what it is
    EXPECT_EQ(find("a").file, first.file);
    EXPECT_EQ(made_, 1);
    wish_.height = 10;
    EXPECT_EQ(find("a").image.height, 10U);
    EXPECT_EQ(made_, 2);
}

TEST_F(ReferenceImagesOfABox, SaysWhatMadeIt) {
    EXPECT_EQ(find("a").algorithm(), "reference");
    EXPECT_EQ(find("a").json()["algorithm"], "reference");
    wish_.algorithm = Algorithm::path;
    const Reference by_path = find("a");
    EXPECT_EQ(made_, 2) << "one by another algorithm is no reference by path";
    EXPECT_EQ(by_path.algorithm(), "path");
    EXPECT_GT(by_path.seconds(), 0.0);
    // The other way round it is good enough.
    wish_.height = 10;
    const Reference other = find("b");
    wish_.algorithm = Algorithm::reference;
    EXPECT_EQ(find("b").file, other.file);
}

TEST_F(ReferenceImagesOfABox, GoesOnWhereItWasInterrupted) {
    const Reference whole = find("a");
    for (const double end : {0.1, 0.6}) {
        try {
            (void)find("b", [&](double done) { return done < end; });
            ADD_FAILURE() << "was not interrupted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::interrupted);
        }
        EXPECT_TRUE(images_in("b").empty());
    }
    std::size_t frames = 0;
    const Reference resumed = find("b", [&](double) {
        ++frames;
        return true;
    });
    EXPECT_GT(frames, 0U);
    EXPECT_LT(frames, 5U) << "more than half of the eight samples were there";
    expect_same(whole.image, resumed.image);
    EXPECT_EQ(folder_.entry_count(), 2U);
}

TEST_F(ReferenceImagesOfABox, MoreSamplesAreAddedToThoseThatAreThere) {
    const Reference few = find("a");
    wish_.spp = 12;
    std::size_t frames = 0;
    const Reference more = find("a", [&](double) {
        ++frames;
        return true;
    });
    EXPECT_EQ(frames, 4U) << "of one sample, two for each half";
    EXPECT_EQ(more.samples, 12U);
    EXPECT_GE(more.seconds(), few.seconds());
    expect_same(find("b").image, more.image);
    EXPECT_EQ(images_in("a"), std::vector{more.file}) << "the one with fewer samples is gone";
}

TEST_F(ReferenceImagesOfABox, WhatIsDamagedIsMadeAnew) {
    const Reference whole = find("a");
    const std::string digest = whole.image.metadata.at("picture");
    // Of another image: as if the file had been renamed.
    wish_.height = 10;
    const std::string other = find("c").image.metadata.at("picture");
    wish_.height = 12;
    for (const char* const part : {".1.sums", ".2.sums"}) {
        folder_.write("b/box-20x12-box-" + digest + part, "damaged");
        expect_same(whole.image, find("b").image);
        std::filesystem::remove_all(folder_.path() / "b");
        std::filesystem::create_directories(folder_.path() / "b");
        std::filesystem::copy_file(folder_.path() / "c" / ("box-20x10-box-" + other + part),
                                   folder_.path() / "b" / ("box-20x12-box-" + digest + part));
        expect_same(whole.image, find("b").image);
        std::filesystem::remove_all(folder_.path() / "b");
    }
    folder_.write("a/" + whole.file.filename().string(), "damaged");
    expect_same(whole.image, find("a").image);
}

TEST_F(ReferenceImagesOfABox, GrowsUntilItsHalvesAgree) {
    const FloorGoal goal{.floor = {0.0, 40.0}};
    wish_.spp = 2;
    const Reference made = reach("a", goal);
    ASSERT_TRUE(made.floor.has_value());
    EXPECT_TRUE(made.floor->within(goal.floor));
    // Measured by what measures images.
    const ImageErrors floor = floor_errors(made.image).value();
    EXPECT_EQ(floor.published->p75, made.floor->published);
    EXPECT_EQ(floor.display->p75, made.floor->display);
    // Of 2, 4, 8, ... samples; with half of them the floor was too high.
    EXPECT_EQ(made.samples & (made.samples - 1), 0U);
    ASSERT_GT(made.samples, 2U);
    wish_.spp = static_cast<std::uint32_t>(made.samples);
    const Reference at_once = find("b");
    expect_same(made.image, at_once.image);
    wish_.spp = static_cast<std::uint32_t>(made.samples / 2);
    EXPECT_FALSE(measured_floor(find("c").image)->within(goal.floor));
    // Found again without rendering, also with a wish for more samples where the floor is enough.
    wish_.spp = 1U << 20;
    wish_.enough = made.floor;
    const int said = made_;
    EXPECT_EQ(find("a").file, made.file);
    EXPECT_EQ(reach("a", goal).file, made.file);
    EXPECT_EQ(made_, said);
    EXPECT_EQ(find("a").floor->display, made.floor->display) << "as its file states";
}

TEST_F(ReferenceImagesOfABox, AStricterGoalGoesOn) {
    wish_.spp = 2;
    const Reference coarse = reach("a", {.floor = {100.0, 100.0}});
    EXPECT_EQ(coarse.samples, 2U);
    const FloorGoal goal{.floor = {0.0, 0.0}, .most_spp = 16};
    const Reference fine = reach("a", goal);
    EXPECT_EQ(fine.samples, 16U);
    expect_same(reach("b", goal).image, fine.image);
    EXPECT_EQ(images_in("a"), std::vector{fine.file});
}

TEST_F(ReferenceImagesOfABox, StepsInterruptedAnywhereAreTheSame) {
    const FloorGoal goal{.floor = {0.0, 0.0}, .most_spp = 8};
    wish_.spp = 2;
    const Reference whole = reach("a", goal);
    std::optional<Reference> made;
    int runs = 0;
    while (!made && runs < 100) {
        int calls = 0;
        ++runs;
        try {
            made = reach("b", goal, [&](double) { return ++calls < 3; });
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::interrupted);
        }
    }
    ASSERT_TRUE(made.has_value());
    EXPECT_GT(runs, 2);
    expect_same(whole.image, made->image);
}

TEST_F(ReferenceImagesOfABox, LimitsAreKept) {
    wish_.spp = 2;
    const Reference by_samples = reach("a", {.floor = {0.0, 0.0}, .most_spp = 7});
    EXPECT_EQ(by_samples.samples, 6U);
    EXPECT_FALSE(by_samples.floor->within({0.0, 0.0}));
    // No time at all: one sample for each half, then no more.
    const FloorGoal no_time{.floor = {0.0, 0.0}, .most_seconds = 0.0};
    wish_.spp = 32;
    EXPECT_EQ(reach("b", no_time).samples, 2U);
    EXPECT_EQ(reach("b", no_time).samples, 2U);
    EXPECT_EQ(reach("a", no_time).samples, 6U);
}

TEST_F(ReferenceImagesOfABox, UnequalHalvesBecomeEqual) {
    const Reference whole = find("a");
    const auto end = [](double done) { return done < 0.05; };  // after the first sample of a half
    EXPECT_THROW((void)find("b", end), Error);
    const FloorGoal no_time{.floor = {0.0, 0.0}, .most_seconds = 0.0};
    EXPECT_EQ(reach("b", no_time).samples, 2U);
    expect_same(whole.image, find("b").image);
}

}  // namespace
}  // namespace weft::reference_images_test
