// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <stdexcept>

#include "base/error.h"
#include "tests/testing/session_fixture.h"
#include "tests/testing/smoky_room.h"

namespace weft::render_session_test {
namespace {

using test::counted_session;
using test::CountedSession;
using test::differing_values;
using test::fresh_image;
using test::KeptDisplay;
using test::KeptOutput;
using test::small_path;
using test::small_settings;
using test::TestBackend;

constexpr std::uint32_t width = 40;
constexpr std::uint32_t height = 33;

CountedSession room_session(TestBackend backend, const ImageSettings& settings) {
    return counted_session(backend, test::moving_room(2).scene, test::room_camera(), settings);
}

/// That the session's next image is that of a new renderer on its scene.
void expect_fresh(RenderSession& session, TestBackend backend, const std::string& when) {
    ASSERT_EQ(session.render({}), SessionEnd::complete) << when;
    const Image fresh = fresh_image(test::shared_executor(backend), session.scene().flat(),
                                    session.camera(), session.settings());
    EXPECT_EQ(differing_values(session.image().image, fresh), 0U) << when;
}

TEST(RenderSession, AlgorithmsShareOneUploadOfTheScene) {
    for (const TestBackend backend : test::backends()) {
        CountedSession made = room_session(backend, small_settings(Algorithm::ais, width, height));
        expect_fresh(*made.session, backend, "ais");
        made.session->set_settings(small_settings(Algorithm::ic, width, height));
        expect_fresh(*made.session, backend, "ic");
        made.session->set_settings(small_path(width, height, 3));
        expect_fresh(*made.session, backend, "path");
        made.session->set_settings(small_settings(Algorithm::igi, width, height));
        expect_fresh(*made.session, backend, "igi");
        EXPECT_EQ(made.allocations("vertex positions"), 1U);
        EXPECT_EQ(made.allocations("lights"), 1U);
        EXPECT_EQ(made.counts->scenes(), 1U) << test::backend_name(backend);
    }
}

TEST(RenderSession, AlgorithmsShareOneUploadOfMedia) {
    CountedSession made =
        counted_session(TestBackend::embree, test::smoky_room(), test::room_camera(),
                        small_settings(Algorithm::igi, width, height));
    expect_fresh(*made.session, TestBackend::embree, "igi");
    made.session->set_settings(small_path(width, height, 2));
    expect_fresh(*made.session, TestBackend::embree, "path");
    made.session->set_settings(small_settings(Algorithm::ais, width, height));
    expect_fresh(*made.session, TestBackend::embree, "ais");
    EXPECT_EQ(made.allocations("media"), 1U);
}

TEST(RenderSession, TheSizeChangesWithoutAnotherUpload) {
    CountedSession made = room_session(TestBackend::embree, small_path(width, height, 2));
    expect_fresh(*made.session, TestBackend::embree, "first");
    made.session->resize(51, 24);
    expect_fresh(*made.session, TestBackend::embree, "resized");
    EXPECT_EQ(made.session->image().image.width, 51U);
    EXPECT_EQ(made.allocations("vertex positions"), 1U);
}

TEST(RenderSession, TheCameraBeginsAnotherImage) {
    CountedSession made =
        room_session(TestBackend::embree, small_settings(Algorithm::igi, width, height));
    expect_fresh(*made.session, TestBackend::embree, "first");
    made.session->set_camera(test::look_at({0.5, 0.2, 3.0}, {0.0, 0.0, 0.0}, 0.8));
    EXPECT_EQ(made.session->samples(), 0U);
    expect_fresh(*made.session, TestBackend::embree, "from elsewhere");
}

/// Edits, and whether the scene can take them where it lies.
struct Edit {
    const char* name;
    bool in_place;
    std::function<void(const SceneParts&)> change;
};

std::vector<Edit> edits() {
    return {
        {"a colour", true,
         [](const SceneParts& parts) {
             set_diffuse_albedo(parts.materials[1], {0.1F, 0.8F, 0.2F});
         }},
        {"a brighter area light", true,
         [](const SceneParts& parts) { parts.materials[2].emission.radiance *= 2.0F; }},
        {"a thing that may move", true,
         [](const SceneParts& parts) { parts.instances.back().to_world[3].x += 0.3; }},
        {"a thing that could not move", false,
         [](const SceneParts& parts) { parts.instances[2].to_world[3].x -= 0.1; }},
        {"the same once more", true,
         [](const SceneParts& parts) { parts.instances[2].to_world[3].x -= 0.1; }},
        {"another material", false,
         [](const SceneParts& parts) { parts.instances[3].material = 1; }},
        {"light from everywhere", false,
         [](const SceneParts& parts) { parts.environment = Environment{glm::vec3(0.2F)}; }},
        {"another light", false,
         [](const SceneParts& parts) {
             PunctualLight light;
             light.position = {0.1, 0.4, 0.5};
             parts.lights.push_back(light);
         }},
        {"a thing less", false, [](const SceneParts& parts) { parts.instances.pop_back(); }},
    };
}

TEST(RenderSession, AnythingCanBeEdited) {
    const std::vector<ImageSettings> all{small_settings(Algorithm::ais, width, height),
                                         small_path(width, height, 2)};
    for (const ImageSettings& settings : all) {
        CountedSession made = room_session(TestBackend::embree, settings);
        std::size_t uploads = 1;
        ASSERT_EQ(made.session->render({}), SessionEnd::complete);
        for (const Edit& edit : edits()) {
            const Image before = made.session->image().image;
            made.session->edit(edit.change);
            uploads += edit.in_place ? 0 : 1;
            EXPECT_EQ(made.allocations("vertex positions"), uploads) << edit.name;
            ASSERT_EQ(made.session->render({}), SessionEnd::complete) << edit.name;
            EXPECT_GT(differing_values(made.session->image().image, before), 0U) << edit.name;
        }
        made.session->rebuild([](Scene& scene) {
            for (glm::vec3& position : scene.meshes[0].positions) position *= 0.9F;
        });
        expect_fresh(*made.session, TestBackend::embree, "another mesh");
    }
}

TEST(RenderSession, WhatIsEditedIsWhatARendererOfThatSceneShows) {
    // Each first image of a new sequence; those of a sequence may go on from others.
    CountedSession made =
        room_session(TestBackend::embree, small_settings(Algorithm::igi, width, height));
    for (const Edit& edit : edits()) {
        made.session->edit(edit.change);
        made.session->set_camera(test::room_camera());
        expect_fresh(*made.session, TestBackend::embree, edit.name);
    }
}

/// Edits that move one instance, as read for a scene.
std::function<EditTimeline(Scene&)> moves_instance(std::uint32_t index) {
    return [index](Scene& scene) {
        scene.instances.at(index).may_move = true;
        SceneEdit edit;
        edit.targets = {index};
        edit.change = ObjectMove{{-0.1, 0.0, 0.0}};
        return EditTimeline{{edit}};
    };
}

TEST(RenderSession, AHastyBvhIsReplacedOnceThereIsABetterOne) {
    for (const TestBackend backend : test::backends()) {
        CountedSession made = room_session(backend, small_settings(Algorithm::igi, width, height));
        RenderSession& session = *made.session;
        EXPECT_FALSE(session.is_hasty());
        EXPECT_TRUE(session.settle(false));
        const bool has_bvh = session.executor().bvh() != nullptr;
        session.set_edits(moves_instance(2), 0, test::room_camera());
        EXPECT_EQ(session.is_hasty(), has_bvh);
        expect_fresh(session, backend, "hasty");
        if (has_bvh) {
            EXPECT_FALSE(session.settle(false));
            while (!session.settle(false)) EXPECT_EQ(session.samples(), 1U);
            EXPECT_EQ(session.samples(), 0U);
            EXPECT_FALSE(session.is_hasty());
            expect_fresh(session, backend, "settled");
        }
        // One that is being built is of no use for another scene.
        session.set_edits(moves_instance(3), 0, test::room_camera());
        EXPECT_EQ(session.settle(false), !has_bvh);
        session.set_edits(moves_instance(2), 0, test::room_camera());
        EXPECT_TRUE(session.settle(true));
        EXPECT_FALSE(session.is_hasty());
        expect_fresh(session, backend, "settled again");
    }
}

TEST(RenderSession, AnEditThatIsRefusedChangesNothing) {
    CountedSession made =
        room_session(TestBackend::embree, small_settings(Algorithm::igi, width, height));
    ASSERT_EQ(made.session->render({}), SessionEnd::complete);
    const Image before = made.session->image().image;
    const auto flatten_something = [](const SceneParts& parts) {
        parts.instances.back().to_world[0] = glm::dvec4(0.0);
    };
    EXPECT_THROW(made.session->edit(flatten_something), Error);
    EXPECT_THROW(made.session->edit([](const SceneParts& parts) {
        parts.instances.pop_back();
        throw std::runtime_error("no");
    }),
                 std::runtime_error);
    EXPECT_THROW(made.session->rebuild([](Scene& scene) { scene.instances[0].mesh = 1000; }),
                 Error);
    made.session->set_camera(test::room_camera());
    ASSERT_EQ(made.session->render({}), SessionEnd::complete);
    EXPECT_EQ(differing_values(made.session->image().image, before), 0U);
}

TEST(RenderSession, OnlyADisplayMakesItResolveForOne) {
    PathSettings path = small_path(width, height, 4);
    path.frame_ms = 1e-3;  // a sample a frame
    for (const ImageSettings& settings :
         {ImageSettings(small_settings(Algorithm::igi, width, height)), ImageSettings(path)}) {
        CountedSession made = room_session(TestBackend::embree, settings);
        ASSERT_EQ(made.session->render({}), SessionEnd::complete);
        EXPECT_FALSE(made.has_built("resolve_display"));
        EXPECT_FALSE(made.has_built("resolve_display_sums"));
        EXPECT_EQ(made.allocations("colours of the display"), 0U);
        KeptDisplay display;
        made.session->set_display(&display);
        made.session->set_camera(test::room_camera());
        RenderBudget budget;
        budget.samples = 3;
        ASSERT_EQ(made.session->render(budget), SessionEnd::complete);
        EXPECT_EQ(display.colours.size(), std::size_t{width} * height);
        EXPECT_GE(display.samples.size(), 2U);
        EXPECT_EQ(display.samples.back(), made.session->samples());
        EXPECT_EQ(made.allocations("colours of the display"), 1U);
    }
}

TEST(RenderSession, TheOutputGetsEachFinishedImage) {
    CountedSession made =
        room_session(TestBackend::embree, small_settings(Algorithm::igi, width, height));
    KeptOutput output;
    made.session->set_output(&output);
    RenderBudget budget;
    budget.samples = 2;
    ASSERT_EQ(made.session->render(budget), SessionEnd::complete);
    ASSERT_EQ(output.images.size(), 1U);
    EXPECT_EQ(output.images[0].samples, 2U);
    EXPECT_EQ(output.images[0].algorithm, Algorithm::igi);
    EXPECT_TRUE(output.images[0].complete);
    std::atomic<bool> ended{true};
    budget.end_early = &ended;
    made.session->set_camera(test::room_camera());
    EXPECT_EQ(made.session->render(budget), SessionEnd::ended_early);
    EXPECT_EQ(output.images.size(), 1U) << "nothing was rendered";
    ended = false;
    budget.progress = [&](const SessionProgress& now) {
        if (now.stage == Stage::vpl_gather) ended = true;
    };
    EXPECT_EQ(made.session->render(budget), SessionEnd::ended_early);
    ASSERT_EQ(output.images.size(), 2U) << "with what light there is";
    EXPECT_EQ(output.images[1].samples, 1U);
    EXPECT_FALSE(output.images[1].complete);
    made.session->set_settings(small_path(width, height, 16));
    EXPECT_EQ(made.session->render(budget), SessionEnd::ended_early);
    EXPECT_EQ(output.images.size(), 2U) << "there is not one sample";
}

/// Sums that can never be saved, as on a disk that is full.
class FullDisk : public KeptOutput {
  public:
    [[nodiscard]] std::optional<double> save_interval_ms() const override { return 0.0; }
    void save(const FilmSums& /*sums*/, const Image& /*image*/) override {
        ++attempts;
        throw Error(ExitCode::output, "sums.exr", "cannot be written");
    }
    int attempts = 0;
};

TEST(RenderSession, SumsThatCannotBeSavedDoNotCostTheImage) {
    CountedSession made = room_session(TestBackend::embree, small_path(width, height, 4));
    FullDisk output;
    made.session->set_output(&output);
    try {
        static_cast<void>(made.session->render({}));
        FAIL() << "nothing was told";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::output);
    }
    ASSERT_EQ(output.images.size(), 1U);
    EXPECT_EQ(output.images[0].samples, 4U);
    EXPECT_TRUE(output.images[0].complete);
    EXPECT_GE(output.attempts, 2) << "one while it rendered";
}

TEST(RenderSession, TimeEndsAnImageAfterItsFirstSample) {
    CountedSession made =
        room_session(TestBackend::embree, small_settings(Algorithm::igi, width, height));
    RenderBudget budget;
    budget.time_ms = 1e-3;
    EXPECT_EQ(made.session->render(budget), SessionEnd::complete);
    EXPECT_EQ(made.session->samples(), 1U);
    budget.samples = 3;
    budget.time_ms.reset();
    EXPECT_EQ(made.session->render(budget), SessionEnd::complete) << "goes on";
    EXPECT_EQ(made.session->samples(), 3U);
}

/// An output that claims to need that long.
class SlowOutput : public KeptOutput {
  public:
    explicit SlowOutput(double ms) : ms_(ms) {}
    [[nodiscard]] double write_ms(const SessionImage& image) override {
        asked.push_back(image.samples);
        return ms_;
    }
    std::vector<std::uint64_t> asked;  ///< samples of the image each time

  private:
    double ms_;
};

TEST(RenderSession, TimeIncludesWhatComesAfterTheSamples) {
    constexpr double long_ms = 1e9;
    for (const ImageSettings& settings :
         {ImageSettings(small_settings(Algorithm::ais, width, height)),
          ImageSettings(small_path(width, height, 3))}) {
        CountedSession made = room_session(TestBackend::embree, settings);
        SlowOutput slow(long_ms);
        made.session->set_output(&slow);
        RenderBudget budget;
        budget.time_ms = long_ms / 2.0;
        EXPECT_EQ(made.session->render(budget), SessionEnd::complete);
        EXPECT_EQ(slow.asked, std::vector<std::uint64_t>{1}) << "once, with the first sample";
        ASSERT_EQ(slow.images.size(), 1U);
        EXPECT_EQ(slow.images[0].samples, 1U);
        // What the image took to be written is known by now.
        budget.samples = 3;
        EXPECT_EQ(made.session->render(budget), SessionEnd::complete);
        EXPECT_EQ(slow.asked.size(), 1U);
        EXPECT_GT(made.session->samples(), 1U);
        // What the caller reserves counts as well.
        made.session->set_camera(test::room_camera());
        budget.reserved_ms = long_ms;
        EXPECT_EQ(made.session->render(budget), SessionEnd::complete);
        EXPECT_EQ(made.session->samples(), 1U);
    }
}

TEST(RenderSession, WithoutATimeNothingIsRehearsed) {
    for (const ImageSettings& settings :
         {ImageSettings(small_settings(Algorithm::ais, width, height)),
          ImageSettings(small_path(width, height, 3))}) {
        CountedSession made = room_session(TestBackend::embree, settings);
        SlowOutput slow(1e9);
        made.session->set_output(&slow);
        EXPECT_EQ(made.session->render({}), SessionEnd::complete);
        EXPECT_TRUE(slow.asked.empty());
    }
}

TEST(RenderSession, AnErrorEndsPathTracing) {
    CountedSession made = room_session(TestBackend::embree, small_path(width, height, 4096));
    RenderBudget budget;
    budget.target_error = 0.5;
    EXPECT_EQ(made.session->render(budget), SessionEnd::complete);
    EXPECT_GE(made.session->samples(), 16U);
    EXPECT_LT(made.session->samples(), 4096U);
}

TEST(RenderSession, KeepsTheLastFramesAndCountsAll) {
    auto made =
        counted_session(TestBackend::embree, test::moving_room(0).scene, test::room_camera(),
                        small_settings(Algorithm::igi, width, height), 3);
    RenderBudget budget;
    budget.samples = 5;
    ASSERT_EQ(made.session->render(budget), SessionEnd::complete);
    made.session->set_settings(small_settings(Algorithm::ir, width, height));
    ASSERT_EQ(made.session->render({}), SessionEnd::complete);
    const SessionStats& stats = made.session->stats();
    EXPECT_EQ(stats.frames(), 6U);
    ASSERT_EQ(stats.last_frames().size(), 3U);
    EXPECT_EQ(stats.last_frames()[1].image, 0U);
    EXPECT_EQ(stats.last_frames()[2].image, 1U) << "another renderer's";
    double ms = 0.0;
    for (const FrameStats& frame : stats.last_frames()) ms += frame.ms;
    EXPECT_GT(stats.ms(), ms);
    EXPECT_GT(stats.rays(), 6U * width * height);
}

}  // namespace
}  // namespace weft::render_session_test
