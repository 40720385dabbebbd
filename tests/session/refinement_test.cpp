// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "selftest/optics_scenes.h"
#include "tests/testing/session_fixture.h"
#include "tests/testing/smoky_room.h"
#include "tests/testing/surface_scenes.h"

// Previews that unbiased samples lead on to the truth.
namespace weft::refinement_test {
namespace {

using test::counted_session;
using test::CountedSession;
using test::differing_values;
using test::small_path;
using test::small_settings;
using test::TestBackend;

constexpr std::uint32_t width = 48;
constexpr std::uint32_t height = 40;
constexpr std::uint32_t preview_samples = 3;

RenderSettings refined_settings() {
    RenderSettings settings = small_settings(Algorithm::ais, width, height);
    settings.samples = preview_samples;
    settings.refined_after = preview_samples;
    return settings;
}

CountedSession room_session(TestBackend backend, const ImageSettings& settings) {
    return counted_session(backend, test::moving_room(2).scene, test::room_camera(), settings);
}

SessionEnd render_to(RenderSession& session, std::uint32_t samples) {
    RenderBudget budget;
    budget.samples = samples;
    return session.render(budget);
}

double mean_square_error(const Image& image, const Image& reference) {
    const auto& a = image.find("")->values;
    const auto& b = reference.find("")->values;
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2);
    return sum / static_cast<double>(a.size());
}

TEST(Refinement, BeginsWhereThePreviewEnds) {
    for (const TestBackend backend : test::backends()) {
        RenderSettings plain = refined_settings();
        plain.refined_after = 0;
        CountedSession preview = room_session(backend, plain);
        CountedSession refined = room_session(backend, refined_settings());
        ASSERT_EQ(render_to(*preview.session, preview_samples), SessionEnd::complete);
        ASSERT_EQ(render_to(*refined.session, preview_samples), SessionEnd::complete);
        EXPECT_EQ(differing_values(preview.session->image().image, refined.session->image().image),
                  0U);
        EXPECT_EQ(refined.session->refined_samples(), 0U);
        // What refines it is built once it is needed.
        EXPECT_FALSE(refined.has_built("vpl_choice"));
        ASSERT_EQ(render_to(*refined.session, preview_samples + 3), SessionEnd::complete);
        EXPECT_EQ(refined.session->refined_samples(), 3U);
        EXPECT_EQ(refined.session->samples(), preview_samples + 3U);
        EXPECT_TRUE(refined.has_built("vpl_choice"));
        EXPECT_EQ(refined.allocations("vertex positions"), 1U);
        EXPECT_GT(differing_values(preview.session->image().image, refined.session->image().image),
                  0U);
    }
}

TEST(Refinement, EverySecondSampleIsUnbiasedAndThenAll) {
    CountedSession made = room_session(TestBackend::embree, refined_settings());
    const auto unbiased_of = [&](std::uint32_t samples) {
        EXPECT_EQ(render_to(*made.session, samples), SessionEnd::complete);
        EXPECT_EQ(made.session->samples(), samples);
        return made.session->refined_samples();
    };
    EXPECT_EQ(unbiased_of(2), 0U);
    EXPECT_EQ(unbiased_of(6), 3U);
    EXPECT_EQ(unbiased_of(7), 3U);
    EXPECT_EQ(unbiased_of(8), 4U);
    EXPECT_EQ(unbiased_of(24), 12U);
    EXPECT_EQ(unbiased_of(25), 13U);
    EXPECT_EQ(unbiased_of(40), 28U);
}

TEST(Refinement, DoesNotDependOnHowSamplesAreAskedFor) {
    CountedSession once = room_session(TestBackend::embree, refined_settings());
    CountedSession often = room_session(TestBackend::embree, refined_settings());
    ASSERT_EQ(render_to(*once.session, preview_samples + 7), SessionEnd::complete);
    for (std::uint32_t samples = 1; samples <= preview_samples + 7; ++samples)
        ASSERT_EQ(often.session->render({}), SessionEnd::complete);
    EXPECT_EQ(often.session->samples(), once.session->samples());
    EXPECT_EQ(differing_values(once.session->image().image, often.session->image().image), 0U);
}

TEST(Refinement, TheImageGoesToTheReference) {
    CountedSession reference = room_session(TestBackend::embree, small_path(width, height, 1024));
    ASSERT_EQ(reference.session->render({}), SessionEnd::complete);
    const Image truth = reference.session->image().image;
    CountedSession made = room_session(TestBackend::embree, refined_settings());
    ASSERT_EQ(render_to(*made.session, preview_samples), SessionEnd::complete);
    double error = mean_square_error(made.session->image().image, truth);
    for (const std::uint32_t more : {16U, 128U}) {
        ASSERT_EQ(render_to(*made.session, preview_samples + more), SessionEnd::complete);
        const double refined = mean_square_error(made.session->image().image, truth);
        EXPECT_LT(refined, 0.7 * error) << more;
        error = refined;
    }
}

// What a mirror, glass and gloss show counts once, although previews and paths have it in other
// layers: the mean stays that of the reference, within what a preview leaves out and four standard
// errors of it (0.4 % in all 259 samples).
TEST(Refinement, MaterialsCountOnce) {
    test::SceneBuilder room;
    room.scene = test::moving_room(2).scene;
    double x = -0.6;
    for (const SurfaceDescription& surface :
         {test::metal(0.0F), test::metal(0.3F), test::glass(1.5)}) {
        room.add(test::smooth_sphere(3), test::add_surface(room, surface),
                 test::placement(0.25, {x, 0.3, 0.2}));
        x += 0.6;
    }
    CountedSession reference = counted_session(TestBackend::embree, room.scene, test::room_camera(),
                                               small_path(width, height, 1024));
    ASSERT_EQ(reference.session->render({}), SessionEnd::complete);
    const Image truth = reference.session->image().image;
    CountedSession made =
        counted_session(TestBackend::embree, room.scene, test::room_camera(), refined_settings());
    ASSERT_EQ(render_to(*made.session, preview_samples), SessionEnd::complete);
    const double error = mean_square_error(made.session->image().image, truth);
    ASSERT_EQ(render_to(*made.session, preview_samples + 256), SessionEnd::complete);
    const Image refined = made.session->image().image;
    EXPECT_NEAR(test::mean_of(refined.find("")->values), test::mean_of(truth.find("")->values),
                0.02 * test::mean_of(truth.find("")->values));
    EXPECT_LT(mean_square_error(refined, truth), error);
}

TEST(Refinement, EndsWithTheImage) {
    CountedSession made = room_session(TestBackend::embree, refined_settings());
    ASSERT_EQ(render_to(*made.session, preview_samples + 2), SessionEnd::complete);
    made.session->set_camera(test::look_at({0.5, 0.2, 3.0}, {0.0, 0.0, 0.0}, 0.8));
    EXPECT_EQ(made.session->samples(), 0U);
    EXPECT_EQ(made.session->refined_samples(), 0U);
    ASSERT_EQ(render_to(*made.session, preview_samples), SessionEnd::complete);
    EXPECT_EQ(
        differing_values(made.session->image().image,
                         test::fresh_image(test::shared_executor(TestBackend::embree),
                                           made.session->scene().flat(), made.session->camera(),
                                           refined_settings(), preview_samples)),
        0U);
}

TEST(Refinement, MediaAreRefinedByPaths) {
    CountedSession made = counted_session(TestBackend::embree, test::smoky_room(),
                                          test::room_camera(), refined_settings());
    ASSERT_EQ(render_to(*made.session, 2 * preview_samples), SessionEnd::complete);
    EXPECT_EQ(made.session->refined_samples(), std::uint64_t{preview_samples});
    EXPECT_FALSE(made.has_built("vpl_choice"));
    EXPECT_EQ(made.session->image().samples, 2U * preview_samples);
}

TEST(Refinement, TimeLeadsItOnAndEndsIt) {
    CountedSession made = room_session(TestBackend::embree, refined_settings());
    RenderBudget budget;
    budget.time_ms = 1500.0;
    ASSERT_EQ(made.session->render(budget), SessionEnd::complete);
    EXPECT_GT(made.session->refined_samples(), 1U);
    // With no time for two unbiased samples the preview goes on by itself.
    CountedSession hurried = room_session(TestBackend::embree, refined_settings());
    budget.time_ms = 0.001;
    ASSERT_EQ(hurried.session->render(budget), SessionEnd::complete);
    EXPECT_EQ(hurried.session->refined_samples(), 0U);
    EXPECT_EQ(hurried.session->samples(), 1U);
}

}  // namespace
}  // namespace weft::refinement_test
