// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/reference_images.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <functional>
#include <memory>
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
    EXPECT_EQ(made_, 1);
    wish_.height = 10;
    EXPECT_EQ(find("a").image.height, 10U);
    EXPECT_EQ(made_, 2);
}

TEST_F(ReferenceImagesOfABox, GoesOnWhereItWasInterrupted) {
    const Reference whole = find("a");
    // Frames of the first half, then of the second: ended in each.
    for (const double end : {0.1, 0.6}) {
        try {
            (void)find("b", [&](double done) { return done < end; });
            ADD_FAILURE() << "was not interrupted";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::interrupted);
        }
    }
    std::vector<double> done;
    const Reference resumed = find("b", [&](double share) {
        done.push_back(share);
        return true;
    });
    ASSERT_FALSE(done.empty());
    EXPECT_GE(done.front(), 0.5);
    expect_same(whole.image, resumed.image);
    EXPECT_EQ(folder_.entry_count(), 2U);
}

TEST_F(ReferenceImagesOfABox, WhatIsDamagedIsMadeAnew) {
    const Reference whole = find("a");
    const std::string name = whole.file.stem().string();
    folder_.write("b/" + name + ".1.part", "damaged");
    expect_same(whole.image, find("b").image);
    folder_.write("a/" + name + ".exr", "damaged");
    expect_same(whole.image, find("a").image);
}

}  // namespace
}  // namespace weft::reference_images_test
