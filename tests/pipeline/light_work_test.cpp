// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/light_work.h"

#include <gtest/gtest.h>

namespace weft::light_work_test {
namespace {

TEST(LightWork, CountsWhatWasPlannedAndNotDone) {
    LightWork work;
    EXPECT_EQ(work.share(), 1.0) << "nothing to do";
    work.plan(Stage::light_samples, "direct", 1000);
    work.add(Stage::light_samples, 1000);
    EXPECT_EQ(work.component(), "direct");
    EXPECT_EQ(work.share(), 1.0) << "that is no light";
    work.plan(Stage::area_lights, "direct", 200);
    EXPECT_EQ(work.share(), 0.0);
    work.add(Stage::area_lights, 50.0);
    EXPECT_EQ(work.share(), 0.25);
    work.plan(Stage::area_lights, "direct", 100);
    work.add(Stage::area_lights, 100.0);
    EXPECT_EQ(work.share(), 0.5);
    work.add(Stage::area_lights, 150.0);
    EXPECT_EQ(work.share(), 1.0);
    work.plan(Stage::area_lights, "direct", 500);
    EXPECT_EQ(work.share(), 1.0) << "another round refines what is there";
}

TEST(LightWork, EveryStageCountsAlike) {
    LightWork work;
    work.plan(Stage::punctual_lights, "direct", 10);
    work.add(Stage::punctual_lights, 10.0);
    work.plan(Stage::distant_light, "direct", 1'000'000);
    EXPECT_EQ(work.share(), 0.5);
}

TEST(LightWork, SharesHaveAText) {
    EXPECT_EQ(light_text({}), "");
    EXPECT_EQ(light_text({{"direct", 1.0}}), "direct 100 %");
    EXPECT_EQ(light_text({{"direct", 0.999}, {"indirect", 0.0}}), "direct 99 %, indirect 0 %");
}

TEST(LightWork, DarkIsWhatHasNoLightAtAll) {
    EXPECT_FALSE(is_dark({}));
    EXPECT_FALSE(is_dark({{"direct", 0.0}, {"indirect", 0.1}}));
    EXPECT_TRUE(is_dark({{"direct", 0.0}, {"indirect", 0.0}}));
}

}  // namespace
}  // namespace weft::light_work_test
