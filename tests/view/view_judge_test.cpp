// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_judge.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>

namespace weft::view_judge_test {
namespace {

constexpr std::uint32_t edge = 64;

/// A grey image with noise of that deviation.
std::vector<float> noisy(double mean, double deviation, std::uint32_t seed) {
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> noise(-std::sqrt(3.0), std::sqrt(3.0));
    std::vector<float> values(std::size_t{3} * edge * edge);
    for (float& value : values) value = static_cast<float>(mean + deviation * noise(engine));
    return values;
}

JudgeTask task_of(const std::vector<float>& image, double deviation) {
    return {.version = 5,
            .width = edge,
            .height = edge,
            .reference_samples = 7,
            .halves = {noisy(0.5, deviation, 1), noisy(0.5, deviation, 2)},
            .images = {{1, 3, image}}};
}

const std::atomic<bool> never = false;

TEST(ViewJudge, FindsAKnownErrorWithinItsInterval) {
    // (0.6 - 0.5)^2 / (0.5^2 + 0.01 0.5^2), and the halves' noise does not add to it.
    const double known = 0.01 / (0.25 * 1.01);
    const Judgement judgement = judge(task_of(noisy(0.6, 0.0, 3), 0.02), never);
    ASSERT_EQ(judgement.images.size(), 1U);
    const JudgedErrors& errors = judgement.images[0];
    EXPECT_EQ(errors.pane, 1U);
    EXPECT_EQ(errors.samples, 3U);
    EXPECT_EQ(judgement.version, 5U);
    EXPECT_EQ(judgement.reference_samples, 7U);
    ASSERT_TRUE(errors.relmse);
    // Noise of 0.02 in 12288 values: the mean of (x - a)(x - b) scatters by less than 1 %.
    EXPECT_NEAR(errors.relmse->value, known, 0.02 * known);
    EXPECT_LE(errors.relmse->low, errors.relmse->value);
    EXPECT_GE(errors.relmse->high, errors.relmse->value);
    EXPECT_EQ(errors.flip.size(), std::size_t{edge} * edge);
    EXPECT_GT(errors.distance.hdrflip, judgement.floor.hdrflip);
}

TEST(ViewJudge, SeesWhereAnImageIsOff) {
    std::vector<float> image = noisy(0.5, 0.0, 3);
    const auto is_off = [](std::size_t pixel) { return pixel % edge >= edge / 2; };
    for (std::size_t i = 0; i < image.size(); ++i)
        if (is_off(i % (std::size_t{edge} * edge))) image[i] = 0.9F;
    const Judgement judgement = judge(task_of(image, 0.01), never);
    const JudgedErrors& errors = judgement.images.at(0);
    EXPECT_GT(errors.distance.vdp, judgement.floor.vdp + 5.0);
    double inside = 0.0;
    double outside = 0.0;
    for (std::size_t pixel = 0; pixel < errors.flip.size(); ++pixel)
        (is_off(pixel) ? inside : outside) += static_cast<double>(errors.flip[pixel]);
    EXPECT_GT(inside, 4.0 * outside);
}

TEST(ViewJudge, APerfectImageIsNotWorseThanTheFloor) {
    const Judgement judgement = judge(task_of(noisy(0.5, 0.0, 3), 0.04), never);
    ASSERT_EQ(judgement.images.size(), 1U);
    const JudgedErrors& errors = judgement.images[0];
    ASSERT_TRUE(errors.relmse);
    // The product of two independent errors of deviation 0.04 has the deviation 0.0016, of the mean
    // of 12288 of them 1.4e-5, divided by 0.2525: within five of these.
    EXPECT_NEAR(errors.relmse->value, 0.0, 5.0 * 5.7e-5);
    // The mean of both halves has a quarter of the variance of their difference.
    EXPECT_LT(errors.distance.hdrflip, judgement.floor.hdrflip);
}

TEST(ViewJudge, TellsNoUnbiasedErrorByANoisyReference) {
    // The mean of halves with the deviation 0.1 has the variance 0.005, or 0.02 relative to 0.25.
    const Judgement judgement = judge(task_of(noisy(0.6, 0.0, 3), 0.1), never);
    EXPECT_FALSE(judgement.images.at(0).relmse);
}

TEST(ViewJudge, MeasuresFlipAloneAsInAJudgement) {
    const std::vector<float> image = noisy(0.55, 0.01, 4);
    const JudgeTask task = task_of(image, 0.03);
    const Judgement judgement = judge(task, never);
    const ImageFlip flip = flip_by_halves(task, image);
    EXPECT_EQ(flip.error, judgement.images.at(0).distance.hdrflip);
    EXPECT_EQ(flip.floor, judgement.floor.hdrflip);
}

TEST(ViewJudge, RefusesSizesThatDiffer) {
    JudgeTask task = task_of(noisy(0.5, 0.0, 3), 0.05);
    task.images[0].values.pop_back();
    EXPECT_THROW((void)judge(task, never), std::invalid_argument);
}

TEST(ViewJudge, WorksInItsOwnThreadAndOutlivesWhatItCannotJudge) {
    ViewJudge judging;
    const auto wait = [&]() -> std::optional<Judgement> {
        // It is given up after a minute.
        for (int i = 0; i < 12000; ++i) {
            if (auto found = judging.take()) return found;
            if (judging.is_idle()) return {};
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        throw std::runtime_error("no judgement");
    };
    EXPECT_TRUE(judging.is_idle());
    JudgeTask wrong = task_of(noisy(0.5, 0.0, 3), 0.05);
    wrong.halves[1].clear();
    judging.begin(std::move(wrong));
    EXPECT_FALSE(wait());
    judging.begin(task_of(noisy(0.6, 0.0, 3), 0.05));
    const auto found = wait();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->images.size(), 1U);
    EXPECT_TRUE(judging.is_idle());
    // It ends while it has work.
    judging.begin(task_of(noisy(0.6, 0.0, 3), 0.05));
}

}  // namespace
}  // namespace weft::view_judge_test
