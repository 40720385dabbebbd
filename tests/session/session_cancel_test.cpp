// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <functional>
#include <thread>

#include "tests/testing/session_fixture.h"

namespace weft::session_cancel_test {
namespace {

using test::differing_values;
using test::TestBackend;

constexpr std::uint32_t width = 64;
constexpr std::uint32_t height = 48;

/// An executor that counts launches, each a quarter of what is asked for, and does something after
/// one of them.
class LaunchCounter : public test::CountingExecutor {
  public:
    using CountingExecutor::CountingExecutor;

    bool run(const Launch& launch, const std::function<bool(double done)>& keep_going) override {
        return test::run_in_quarters(inner(), launch, [&](double done) {
            ++launches;
            if (acted) after.push_back(launch.kernel);
            if (act && launches == act_after) {
                act();
                acted = true;
            }
            return !keep_going || keep_going(done);
        });
    }

    std::size_t launches = 0;
    std::size_t act_after = 0;
    std::function<void()> act;
    bool acted = false;
    std::vector<KernelId> after;  ///< launches after that
};

struct CancelledSession {
    LaunchCounter* launches;
    std::unique_ptr<RenderSession> session;
};

CancelledSession session_of(const ImageSettings& settings, TestBackend backend) {
    auto executor = std::make_unique<LaunchCounter>(test::make_executor(backend));
    LaunchCounter* const launches = executor.get();
    return {launches, std::make_unique<RenderSession>(
                          std::move(executor), MovingScene(test::moving_room(2).scene, {}, 30.0),
                          test::room_camera(), settings)};
}

std::vector<std::pair<std::string, ImageSettings>> all_settings() {
    std::vector<std::pair<std::string, ImageSettings>> all;
    for (const Algorithm algorithm :
         {Algorithm::ais, Algorithm::amax, Algorithm::igi, Algorithm::ir,
          Algorithm::irradiance_cache, Algorithm::ic, Algorithm::tic}) {
        RenderSettings settings = test::small_settings(algorithm, width, height);
        settings.samples = 2;
        all.emplace_back(to_string(algorithm), settings);
    }
    RenderSettings edges = test::small_settings(Algorithm::ais, width, height);
    edges.samples = 1;
    all.emplace_back("ais with edge samples", edges);
    all.emplace_back("path", test::small_path(width, height, 6));
    return all;
}

RenderBudget two_samples() {
    RenderBudget budget;
    budget.samples = 2;
    return budget;
}

/// How many launches a render of two samples has at least, after one that was complete. Path
/// tracing puts as many samples into one as its time allows: all of them may be in the same.
std::size_t sure_launches(const CancelledSession& made, const std::string& name) {
    return name == "path" ? 4 : made.launches->launches;
}

/// Cancels after a launch; returns whether it came to that.
bool cancel_after(CancelledSession& made, std::size_t launch, SessionEnd& end) {
    LaunchCounter& counter = *made.launches;
    counter.launches = 0;
    counter.acted = false;
    counter.after.clear();
    counter.act_after = launch;
    counter.act = [&made] { made.session->cancel(); };
    end = made.session->render(two_samples());
    counter.act = {};
    return counter.acted;
}

/// What a film that holds a frame gets all of, or nothing.
bool adds_to_film(KernelId kernel) {
    return kernel == KernelId::edge_masks || kernel == KernelId::compose ||
           kernel == KernelId::edge_samples;
}

void expect_nothing_heavy_after(const std::string& name, const ImageSettings& settings,
                                TestBackend backend) {
    CancelledSession made = session_of(settings, backend);
    ASSERT_EQ(made.session->render(two_samples()), SessionEnd::complete);
    const std::size_t all = sure_launches(made, name);
    ASSERT_GE(all, 4U) << name;
    for (std::size_t point = 1; point < all; point += std::max<std::size_t>(1, all / 6)) {
        made.session->set_camera(test::room_camera());
        SessionEnd end{};
        ASSERT_TRUE(cancel_after(made, point, end)) << name << ", launch " << point;
        EXPECT_EQ(end, SessionEnd::cancelled) << name << ", launch " << point;
        // The three of them, in quarters, but for the one after which it was cancelled.
        EXPECT_LE(made.launches->after.size(), 11U) << name << ", launch " << point;
        for (const KernelId kernel : made.launches->after)
            EXPECT_TRUE(adds_to_film(kernel))
                << name << ", launch " << point << ": " << kernel_name(kernel);
    }
}

TEST(SessionCancel, NothingHeavyBeginsAfterIt) {
    for (const TestBackend backend : test::backends())
        for (const auto& [name, settings] : all_settings()) {
            SCOPED_TRACE(test::backend_name(backend));
            expect_nothing_heavy_after(name, settings, backend);
        }
}

TEST(SessionCancel, WhatGoesOnIsWhatItWouldHaveBeen) {
    for (const auto& [name, settings] : all_settings()) {
        CancelledSession made = session_of(settings, TestBackend::embree);
        ASSERT_EQ(made.session->render(two_samples()), SessionEnd::complete);
        const std::size_t all = sure_launches(made, name);
        const Image whole = made.session->image().image;
        for (const std::size_t share : {1U, 2U, 3U}) {
            made.session->set_camera(test::room_camera());
            SessionEnd end{};
            ASSERT_TRUE(cancel_after(made, std::max<std::size_t>(1, all * share / 4), end)) << name;
            ASSERT_EQ(made.session->render(two_samples()), SessionEnd::complete) << name;
            // Records outlast a frame that was cancelled, so that the next one finds more of them.
            if (name == "tic") continue;
            EXPECT_EQ(differing_values(made.session->image().image, whole), 0U)
                << name << ", after " << share << " quarters";
        }
    }
}

TEST(SessionCancel, AnImageHoldsWholeFramesAlone) {
    for (const auto& [name, settings] : all_settings()) {
        if (name == "path") continue;
        CancelledSession made = session_of(settings, TestBackend::embree);
        ASSERT_EQ(made.session->render({}), SessionEnd::complete);
        const Image one = made.session->image().image;
        const std::size_t of_frame = made.launches->launches;
        SessionEnd end{};
        ASSERT_TRUE(cancel_after(made, std::max<std::size_t>(1, of_frame / 2), end)) << name;
        EXPECT_EQ(made.session->samples(), 1U) << name;
        const Image after = made.session->image().image;
        for (const char* const layer : {"", "direct", "indirect"})
            EXPECT_EQ(after.find(layer)->values, one.find(layer)->values) << name;
    }
}

TEST(SessionCancel, SumsOfPathTracingStayExact) {
    CancelledSession made = session_of(test::small_path(width, height, 6), TestBackend::embree);
    ASSERT_EQ(made.session->render({}), SessionEnd::complete);
    const FilmSums whole = *made.session->image().sums;
    const std::size_t all = made.launches->launches;
    ASSERT_GE(all, 4U);
    for (std::size_t point = 1; point < all; ++point) {
        made.session->set_camera(test::room_camera());
        SessionEnd end{};
        const bool cancelled = cancel_after(made, point, end);
        ASSERT_TRUE(cancelled || point > 4) << "launch " << point;
        if (!cancelled) break;
        const FilmSums part = *made.session->image().sums;
        EXPECT_EQ(part.samples(), made.session->samples());
        PathSettings first = test::small_path(width, height, 6);
        first.samples.end = static_cast<std::uint32_t>(part.samples());
        if (first.samples.end > 0) {
            PathRenderer renderer(test::shared_executor(TestBackend::embree),
                                  made.session->scene().flat(), test::room_camera(), first, {});
            while (renderer.render_frame({})) continue;
            EXPECT_EQ(part.words, renderer.sums().words) << "launch " << point;
        }
        ASSERT_EQ(made.session->render({}), SessionEnd::complete);
        EXPECT_EQ(made.session->image().sums->words, whole.words) << "launch " << point;
    }
}

TEST(SessionCancel, ARequestBeforehandEndsTheNextCall) {
    CancelledSession made =
        session_of(test::small_settings(Algorithm::igi, width, height), TestBackend::embree);
    test::KeptOutput output;
    made.session->set_output(&output);
    const std::size_t before = made.launches->launches;
    made.session->cancel();
    EXPECT_EQ(made.session->render(two_samples()), SessionEnd::cancelled);
    EXPECT_EQ(made.launches->launches, before);
    EXPECT_EQ(output.images.size(), 0U);
    EXPECT_EQ(made.session->render(two_samples()), SessionEnd::complete) << "and only that one";
    EXPECT_EQ(output.images.size(), 1U);
}

TEST(SessionCancel, ComesFromAnyThread) {
    CancelledSession made = session_of(test::small_path(width, height, 60000), TestBackend::embree);
    std::atomic<bool> begun{false};
    RenderBudget budget;
    budget.progress = [&](const SessionProgress&) { begun = true; };
    std::thread canceller([&] {
        while (!begun) std::this_thread::yield();
        made.session->cancel();
    });
    EXPECT_EQ(made.session->render(budget), SessionEnd::cancelled);
    canceller.join();
    EXPECT_LT(made.session->samples(), 60000U);
}

}  // namespace
}  // namespace weft::session_cancel_test
