// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "bench/adaptive/adaptive_run.h"
#include "bench/tables/tables_report.h"
#include "device/native/native_executor.h"
#include "scene/load/load_scene.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"
#include "tradeoff/reference_images.h"

namespace weft::bench::adaptive_floor_test {
namespace {

/// The Cornell box in a few pixels, by two methods, against references of 16 samples.
class AdaptiveFloor : public testing::Test {
  protected:
    [[nodiscard]] AdaptiveScene measure() {
        AdaptiveRun run;
        run.methods = {{method_amax, Algorithm::amax, {}}, {method_ais, Algorithm::ais, {}}};
        run.frames.size = 24;
        run.frames.repetitions = 1;
        run.frames.packets = false;
        run.frames.alone = false;
        run.filters = {"box"};
        run.references = folder_.path();
        run.reference_spp = 16;
        run.say = [&](const std::string&) { ++made_; };
        const auto load = [](Diagnostics& diagnostics) {
            return load_scene(test::shipped_scene("cornell-box.gltf"), diagnostics);
        };
        const auto executor = make_native_executor(NativeTraversal::own_bvh, 0);
        Diagnostics diagnostics;
        return measure_scene({{"box", load}, true}, run, *executor, *executor, diagnostics);
    }

    TemporaryFolder folder_;
    int made_ = 0;
};

TEST_F(AdaptiveFloor, HalvesOfTheReferenceGiveFloorsAndUnbiasedErrors) {
    const AdaptiveScene scene = measure();
    EXPECT_EQ(made_, 1);
    ASSERT_TRUE(scene.floors.box.has_value());
    EXPECT_FALSE(scene.floors.centre.has_value());
    EXPECT_GT(*scene.floors.box->hdrflip, 0.0);
    EXPECT_GT(scene.floors.box->display->p75, 0.0);
    EXPECT_FALSE(scene.floors.box->unbiased_relmse.has_value());
    for (const MethodErrors& errors : scene.errors) {
        ASSERT_TRUE(errors.box.beauty.unbiased_relmse.has_value());
        const ErrorEstimate& unbiased = *errors.box.beauty.unbiased_relmse;
        EXPECT_LT(unbiased.low, unbiased.value);
        EXPECT_LT(unbiased.value, unbiased.high);
        EXPECT_LT(unbiased.value, *errors.box.beauty.relmse) << "which has the noise as well";
        EXPECT_FALSE(errors.box.indirect.unbiased_relmse.has_value()) << "halves are of beauty";
    }
    const nlohmann::json json = adaptive_json(scene);
    EXPECT_EQ(json["references"]["box"]["floor"]["hdrflip"], *scene.floors.box->hdrflip);
    const nlohmann::json& errors = json["methods"][1]["errors"]["box"]["beauty"];
    EXPECT_EQ(errors["unbiased_relmse"]["value"],
              scene.errors[1].box.beauty.unbiased_relmse->value);
    EXPECT_EQ(json["references"]["box"]["noise_relmse"], scene.floors.box_noise.value());
    EXPECT_GT(*scene.floors.box_noise, 0.005) << "of 16 samples";
    EXPECT_NE(adaptive_tables(scene).find("to relMSE: intervals are too narrow"),
              std::string::npos);
    EXPECT_NE(adaptive_tables(scene).find("\n  floor     beauty "), std::string::npos);
    const nlohmann::json summary = adaptive_summary({scene}, method_ais);
    EXPECT_EQ(summary["vdp75_floor_display"], scene.floors.box->display->p75);
    EXPECT_EQ(summary["unbiased_relmse_amax"], scene.errors[0].box.beauty.unbiased_relmse->value);
    EXPECT_TRUE(summary["vdp75_floor_centre"].is_null());

    const nlohmann::json rows = table_scene_json({scene, {}})["rows"];
    EXPECT_NEAR(rows["hdrvdp_display"]["floor_75"].get<double>(), scene.floors.box->display->p75,
                1e-3);
    EXPECT_NEAR(rows["relmse"]["noise"].get<double>(), *scene.floors.box_noise,
                1e-4 * *scene.floors.box_noise);
    EXPECT_NEAR(rows["hdrflip"]["floor"].get<double>(), *scene.floors.box->hdrflip, 1e-5);
    for (const char* const end : {"", "_low", "_high"})
        EXPECT_TRUE(rows[std::string("unbiased_relmse") + end]["A"].is_number()) << end;
    EXPECT_LT(rows["unbiased_relmse_low"]["AMAX"], rows["unbiased_relmse_high"]["AMAX"]);
    const std::string text = table_scene_text(table_scene_json({scene, {}}), {});
    EXPECT_NE(text.find("floor_75"), std::string::npos) << text;
    EXPECT_NE(text.find("unbiased relMSE"), std::string::npos) << text;

    (void)measure();
    EXPECT_EQ(made_, 1) << "the reference is found again";
}

}  // namespace
}  // namespace weft::bench::adaptive_floor_test
