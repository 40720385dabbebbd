// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/reference_pair.h"

#include <gtest/gtest.h>

#include <cmath>

#include "metrics/unbiased_mse.h"
#include "tests/testing/session_fixture.h"

namespace weft::reference_pair_test {
namespace {

using test::counted_session;
using test::CountedSession;
using test::differing_values;
using test::small_path;
using test::small_settings;
using test::TestBackend;

constexpr std::uint32_t edge = 32;

CountedSession room_session(TestBackend backend, const ImageSettings& settings) {
    return counted_session(backend, test::moving_room(2).scene, test::room_camera(), settings);
}

void grow_to(RenderSession& session, ReferencePair& pair, std::uint64_t samples) {
    while (pair.samples() < samples) ASSERT_TRUE(session.grow(pair, 20.0, nullptr));
}

RgbView view_of(const Image& image) {
    return {image.find("")->values, image.width, image.height};
}

TEST(ReferencePair, HasTwoHalvesOfTheSameLightThatShareNoNoise) {
    for (const TestBackend backend : test::backends()) {
        CountedSession made = room_session(backend, small_settings(Algorithm::igi, edge, edge));
        const auto pair = made.session->make_references();
        EXPECT_EQ(pair->samples(), 0U);
        grow_to(*made.session, *pair, 16);
        const Image first = pair->half(0);
        const Image second = pair->half(1);
        EXPECT_GT(differing_values(first, second), 0U);
        // A long path-traced image has no error against them but noise: the interval of the
        // unbiased error holds 0, or what the seed's noise leaves, which is below the noise.
        CountedSession truth = room_session(backend, small_path(edge, edge, 512));
        ASSERT_EQ(truth.session->render({}), SessionEnd::complete);
        const Image image = truth.session->image().image;
        const UnbiasedErrors errors =
            unbiased_errors({view_of(first), view_of(second)}, view_of(image));
        ASSERT_TRUE(errors.relmse && errors.noise_relmse);
        EXPECT_LT(std::abs(errors.relmse->value), *errors.noise_relmse)
            << test::backend_name(backend);
    }
}

TEST(ReferencePair, GrowsEvenlyAndDoesNotTouchTheImage) {
    CountedSession made =
        room_session(TestBackend::own_bvh, small_settings(Algorithm::igi, edge, edge));
    RenderBudget budget;
    budget.samples = 2;
    ASSERT_EQ(made.session->render(budget), SessionEnd::complete);
    const Image before = made.session->image().image;
    const auto pair = made.session->make_references();
    std::uint64_t samples = 0;
    for (int i = 0; i < 12; ++i) {
        ASSERT_TRUE(made.session->grow(*pair, 1.0, nullptr));
        EXPECT_GE(pair->samples(), samples);
        samples = pair->samples();
    }
    EXPECT_GE(samples, 2U);
    EXPECT_EQ(differing_values(before, made.session->image().image), 0U);
    EXPECT_EQ(made.session->samples(), 2U);
    budget.samples = 3;
    ASSERT_EQ(made.session->render(budget), SessionEnd::complete);
    CountedSession alone =
        room_session(TestBackend::own_bvh, small_settings(Algorithm::igi, edge, edge));
    ASSERT_EQ(alone.session->render(budget), SessionEnd::complete);
    EXPECT_EQ(differing_values(made.session->image().image, alone.session->image().image), 0U);
}

TEST(ReferencePair, StopsWhereItIsCancelled) {
    CountedSession made = room_session(TestBackend::own_bvh, small_path(edge, edge, 4));
    const auto pair = made.session->make_references();
    made.session->cancel();
    EXPECT_FALSE(made.session->grow(*pair, 20.0, nullptr));
    EXPECT_EQ(pair->samples(), 0U);
    grow_to(*made.session, *pair, 1);
    // The session is not cancelled for that.
    EXPECT_EQ(made.session->render({}), SessionEnd::complete);
}

}  // namespace
}  // namespace weft::reference_pair_test
