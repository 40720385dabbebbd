// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "film/film_sums_file.h"
#include "image/exr.h"
#include "tests/testing/bvh_meshes.h"
#include "tests/testing/furnished_room.h"
#include "tests/testing/path_fixture.h"
#include "tests/testing/run_program.h"

// Path-traced images made in parts, and by every backend: the same bits as at once. Words are
// compared, not values.
namespace weft::path_resume_test {
namespace {

using test::SceneBuilder;
using test::TestBackend;

constexpr std::uint32_t width = 23;
constexpr std::uint32_t height = 17;

/// A scene with everything that surfaces and lights can have.
const FlatScene& everything() {
    static const FlatScene flat = [] {
        SceneBuilder builder;
        test::furnish(builder);
        test::Uniform uniform(4);
        Mesh wall = test::quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 4);
        for (std::size_t i = 0; i < wall.positions.size(); ++i)
            wall.colours.emplace_back(uniform(0.2F, 1.0F), uniform(0.2F, 1.0F),
                                      uniform(0.2F, 1.0F));
        builder.add(std::move(wall), builder.material({0.7F, 0.7F, 0.7F}));
        const std::uint32_t one_sided = builder.material({0.5F, 0.5F, 0.9F});
        builder.scene.materials[one_sided].two_sided = false;
        builder.add(test::quad_mesh({0.2F, -0.9F, -0.5F}, {0.5F, 0, 0.3F}, {0, 0.9F, 0.1F}),
                    one_sided);
        builder.add(test::quad_mesh({-0.3F, 0.98F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                    builder.material({0.3F, 0.3F, 0.3F}, {12.0F, 10.0F, 8.0F}));
        builder.light(LightType::directional, {}, {0.5F, 0.5F, 0.7F}, {-0.7, -0.6, -0.2});
        validate_scene(builder.scene);
        return flatten(builder.scene);
    }();
    return flat;
}

Camera camera() {
    return test::look_at({0.35, 0.1, 2.9}, {0.0, -0.05, 0.0}, 0.7);
}

PathSettings settings_of(SampleRange range, std::uint32_t seed = 0) {
    PathSettings settings = test::path_settings(width, height, 1, seed);
    settings.samples = range;
    return settings;
}

FilmSums render(Executor& executor, const PathSettings& settings, FilmSums before = {}) {
    return test::path_sums(executor, everything(), camera(), settings, std::move(before));
}

FilmSums render(SampleRange range, FilmSums before = {}) {
    return render(test::shared_executor(TestBackend::own_bvh), settings_of(range),
                  std::move(before));
}

/// Writes the sums to a file and reads them again.
FilmSums through_a_file(const FilmSums& sums) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path() / "sums.exr";
    Image image = resolve_sums(sums);
    attach_sums(sums, image);
    write_exr(path, image);
    return sums_of(read_exr(path), path.string());
}

void expect_refused(const std::function<void()>& use) {
    try {
        use();
        FAIL() << "was not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
    }
}

TEST(PathResume, TheSceneShowsAllItShould) {
    constexpr std::uint32_t all = 255U | FEATURE_EMISSION_TEXTURES;
    EXPECT_EQ(everything().features & all, all);
    const Image image = resolve_sums(render({0, 4}));
    for (const char* layer : {"direct", "indirect", "emission", "albedo", "depth", "variance"})
        EXPECT_GT(test::mean_of(image.find(layer)->values), 1e-3) << layer;
}

TEST(PathResume, TenContinuationsThroughFilesEqualTheWhole) {
    const FilmSums whole = render({0, 40});
    EXPECT_EQ(whole.samples(), 40U);
    for (const std::uint32_t stop : {1U, 2U, 3U, 5U, 8U, 13U, 21U, 34U, 38U, 39U}) {
        SCOPED_TRACE(stop);
        test::expect_same_sums(render({stop, 40}, through_a_file(render({0, stop}))), whole);
    }
    // One image, left and gone on with ten times.
    FilmSums sums;
    for (std::uint32_t first = 0; first < 40; first += 4)
        sums = through_a_file(render({first, first + 4}, std::move(sums)));
    test::expect_same_sums(sums, whole);
}

TEST(PathResume, FramesEndedByTheUserAreWhole) {
    const FilmSums whole = render({0, 30});
    PathSettings settings = settings_of({0, 30});
    FilmSums sums;
    for (std::uint32_t interruption = 1; interruption <= 10; ++interruption) {
        PathRenderer renderer(test::shared_executor(TestBackend::own_bvh), everything(), camera(),
                              settings, std::move(sums));
        // Asked to end at once: the first frame, of one sample, is finished all the same.
        EXPECT_FALSE(renderer.render_frame([](Stage, double) { return false; }));
        EXPECT_EQ(renderer.samples(), interruption);
        EXPECT_EQ(renderer.samples_left(), 30 - interruption);
        settings.samples.first = interruption;
        sums = renderer.sums();
    }
    test::expect_same_sums(
        render(test::shared_executor(TestBackend::own_bvh), settings, std::move(sums)), whole);
}

TEST(PathResume, ThreeRangesAddUpToTheWhole) {
    const FilmSums whole = render({0, 50});
    const FilmSums parts[] = {render({0, 11}), render({11, 12}), render({12, 50})};
    FilmSums sum = parts[2];
    add_sums(sum, parts[0]);
    EXPECT_EQ(sum.ranges, (std::vector<SampleRange>{{0, 11}, {12, 50}}));
    add_sums(sum, through_a_file(parts[1]));
    test::expect_same_sums(sum, whole);
    expect_refused([&] { add_sums(sum, parts[1]); });
    // A gap is filled as well.
    FilmSums gap = parts[0];
    add_sums(gap, parts[2]);
    test::expect_same_sums(render({11, 12}, gap), whole);
}

TEST(PathResume, OtherImagesAreNotContinued) {
    const FilmSums part = render({0, 2});
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    expect_refused([&] { (void)render(executor, settings_of({2, 4}, 1), part); });
    expect_refused([&] { (void)render({1, 4}, part); });
    const auto with = [&](const std::function<void(PathSettings&)>& change) {
        PathSettings settings = settings_of({2, 4});
        change(settings);
        expect_refused([&] { (void)render(executor, settings, part); });
    };
    with([](PathSettings& settings) { settings.through_centres = true; });
    with([](PathSettings& settings) { settings.direct = false; });
    with([](PathSettings& settings) { settings.indirect = false; });
    with([](PathSettings& settings) { std::swap(settings.width, settings.height); });
    with([](PathSettings& settings) { settings.width = 1; });
    const Camera moved = test::look_at({0.36, 0.1, 2.9}, {0.0, -0.05, 0.0}, 0.7);
    expect_refused([&] {
        (void)test::path_sums(executor, everything(), moved, settings_of({2, 4}), part);
    });
    FlatScene brighter = everything();
    brighter.lights[0].power.x *= 1.5F;
    expect_refused([&] {
        (void)test::path_sums(executor, brighter, camera(), settings_of({2, 4}), part);
    });
}

TEST(PathResume, SeedsAndSamplesDiffer) {
    Executor& executor = test::shared_executor(TestBackend::own_bvh);
    const FilmSums first = render(executor, settings_of({0, 2}, 0));
    EXPECT_FALSE(first.words == render(executor, settings_of({0, 2}, 1)).words);
    EXPECT_FALSE(first.words == render(executor, settings_of({2, 4}, 0)).words);
    test::expect_same_sums(first, render(executor, settings_of({0, 2}, 0)));
}

TEST(PathResume, ThreadsDoNotMatter) {
    for (const TestBackend backend : test::backends()) {
        SCOPED_TRACE(test::backend_name(backend));
        test::expect_same_sums(render(*test::make_executor(backend, 0, 1), settings_of({0, 12})),
                               render(*test::make_executor(backend, 0, 2), settings_of({0, 12})));
    }
}

TEST(PathResume, EveryPacketWidthGivesTheSameBits) {
    const FilmSums expected = render({3, 9});
    for (const std::uint32_t lanes : {1U, 4U, 8U, 16U}) {
        SCOPED_TRACE(lanes);
        for (const TestBackend backend : {TestBackend::own_bvh, TestBackend::opencl}) {
            if (backend == TestBackend::opencl && !test::has_opencl()) continue;
            test::expect_same_sums(
                render(*test::make_executor(backend, lanes), settings_of({3, 9})), expected);
        }
    }
}

TEST(PathResume, BackendsShareAnImage) {
    // Begun by one, continued by another: for own_bvh and OpenCL the very same bits.
    if (!test::has_opencl()) GTEST_SKIP() << "no OpenCL device";
    const FilmSums whole = render({0, 20});
    Executor& opencl = test::shared_executor(TestBackend::opencl);
    test::expect_same_sums(render(opencl, settings_of({9, 20}), render({0, 9})), whole);
    test::expect_same_sums(render({9, 20}, render(opencl, settings_of({0, 9}))), whole);
}

TEST(PathResume, EmbreeDiffersByAlmostNothing) {
    const Image own = resolve_sums(render({0, 16}));
    const Image embree =
        resolve_sums(render(test::shared_executor(TestBackend::embree), settings_of({0, 16})));
    for (const Layer& layer : own.layers)
        EXPECT_LE(test::relative_mse(layer.values, embree.find(layer.name)->values), 1e-5)
            << layer.name;
}

/// The program on a small image.
class PathResumeProgram : public testing::Test {
  protected:
    [[nodiscard]] std::string at(const std::string& name) const { return folder_.path() / name; }

    [[nodiscard]] std::vector<std::string> arguments(const std::string& output,
                                                     const std::vector<std::string>& more) const {
        std::vector<std::string> all{"render",      test::shipped_scene("cornell-box.gltf"),
                                     "-o",          at(output),
                                     "--algorithm", "path",
                                     "--size",      "24x20"};
        if (std::find(more.begin(), more.end(), "--backend") == more.end())
            all.insert(all.end(), {"--backend", "native"});
        all.insert(all.end(), more.begin(), more.end());
        return all;
    }
    void run(const std::string& output, std::vector<std::string> more, int code = 0) const {
        more.insert(more.end(), {"--progress", "none"});
        const test::ProgramResult result = test::run_program(arguments(output, more));
        EXPECT_EQ(result.exit_code, code) << result.err;
        if (code == 2) {
            EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        }
    }
    [[nodiscard]] FilmSums sums(const std::string& name) const {
        return sums_of(read_exr(at(name)), name);
    }

    TemporaryFolder folder_;
};

TEST_F(PathResumeProgram, ContinuedImagesEqualTheWhole) {
    run("whole.exr", {"--samples", "0:24"});
    for (const char* samples : {"1", "5", "16", "24"})
        run("x.exr", {"--spp", samples, "--resume", at("kept.exr")});
    test::expect_same_sums(sums("kept.exr"), sums("whole.exr"));
    // The image is the one without sums, too.
    run("plain.exr", {"--spp", "24"});
    const Image plain = read_exr(at("plain.exr"));
    const Image continued = read_exr(at("x.exr"));
    EXPECT_EQ(test::differing_values(plain, continued), 0U);
    EXPECT_EQ(continued.metadata.at("samples"), "24");
    // Fewer samples than there are: nothing is lost.
    run("x.exr", {"--spp", "3", "--resume", at("kept.exr")});
    test::expect_same_sums(sums("kept.exr"), sums("whole.exr"));
    run("x.exr", {"--spp", "30", "--seed", "1", "--resume", at("kept.exr")}, 2);
    test::expect_same_sums(sums("kept.exr"), sums("whole.exr"));
}

TEST_F(PathResumeProgram, MergedRangesEqualTheWhole) {
    run("whole.exr", {"--samples", "0:24"});
    run("a.exr", {"--samples", "0:9"});
    run("b.exr", {"--samples", "9:10"});
    run("c.exr", {"--samples", "10:24"});
    const auto merge = [&](const std::vector<std::string>& parts) {
        std::vector<std::string> all{"merge"};
        for (const std::string& part : parts) all.push_back(at(part));
        all.insert(all.end(), {"-o", at("merged.exr")});
        return test::run_program(all);
    };
    const test::ProgramResult result = merge({"c.exr", "a.exr", "b.exr"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    test::expect_same_sums(sums("merged.exr"), sums("whole.exr"));
    EXPECT_EQ(test::differing_values(read_exr(at("merged.exr")), read_exr(at("whole.exr"))), 0U);
    EXPECT_EQ(merge({"a.exr", "a.exr"}).exit_code, 2);
    const test::ProgramResult twice = merge({"a.exr", "b.exr", "b.exr"});
    EXPECT_EQ(twice.exit_code, 2);
    EXPECT_NE(twice.err.find("the parts before it"), std::string::npos) << twice.err;
    // What is missing is told, by merging and where such a file cannot be continued.
    const test::ProgramResult gap = merge({"c.exr", "a.exr"});
    EXPECT_EQ(gap.exit_code, 0);
    EXPECT_NE(gap.err.find("lacks the samples 9:10 "), std::string::npos) << gap.err;
    run("x.exr", {"--spp", "30", "--resume", at("merged.exr")}, 2);
    run("x.exr", {"--spp", "9", "--resume", at("merged.exr")});
    run("x.exr", {"--samples", "9:10", "--resume", at("merged.exr")});
    test::expect_same_sums(sums("merged.exr"), sums("whole.exr"));
    run("late.exr", {"--samples", "10:24"});
    run("x.exr", {"--spp", "24", "--resume", at("late.exr")});  // what is missing before
    test::expect_same_sums(sums("late.exr"), sums("whole.exr"));
    run("d.exr", {"--samples", "9:10", "--seed", "1"});
    const test::ProgramResult other = merge({"a.exr", "d.exr"});
    EXPECT_EQ(other.exit_code, 2);
    for (const char* part : {"a.exr", "d.exr"})
        EXPECT_NE(other.err.find(at(part)), std::string::npos) << other.err;
    run("plain.exr", {"--spp", "1"});
    EXPECT_EQ(merge({"a.exr", "plain.exr"}).exit_code, 2);
}

TEST_F(PathResumeProgram, PartsOfOtherBackendsAreToldOfOnce) {
    run("a.exr", {"--samples", "0:2"});
    run("b.exr", {"--samples", "2:4", "--backend", "embree"});
    run("c.exr", {"--samples", "4:6", "--backend", "embree"});
    run("d.exr", {"--samples", "6:8"});
    const auto merge = [&](const std::vector<std::string>& parts) {
        std::vector<std::string> all{"merge"};
        for (const std::string& part : parts) all.push_back(at(part));
        all.insert(all.end(), {"-o", at("merged.exr")});
        return test::run_program(all);
    };
    const auto lines = [](const std::string& text) {
        return std::count(text.begin(), text.end(), '\n');
    };
    const test::ProgramResult mixed = merge({"a.exr", "b.exr", "c.exr", "d.exr"});
    EXPECT_EQ(mixed.exit_code, 0) << mixed.err;
    EXPECT_NE(mixed.err.find("b.exr: is of embree and '"), std::string::npos) << mixed.err;
    EXPECT_NE(mixed.err.find("a.exr' of native: the image is as good"), std::string::npos)
        << mixed.err;
    EXPECT_EQ(lines(mixed.err), 1) << mixed.err;
    EXPECT_EQ(sums("merged.exr").backends, (std::set<std::string>{"embree", "native"}));
    EXPECT_EQ(sums("merged.exr").samples(), 8U);
    EXPECT_EQ(merge({"b.exr", "c.exr"}).err, "");
    // The same where an image is continued, unless there is nothing left to add.
    const auto resume = [&](const std::string& backend, const char* samples) {
        return test::run_program(
            arguments("x.exr", {"--backend", backend, "--spp", samples, "--resume", at("kept.exr"),
                                "--progress", "none"}));
    };
    EXPECT_EQ(resume("native", "2").err, "");
    EXPECT_EQ(resume("native", "3").err, "");
    EXPECT_EQ(resume("embree", "3").err, "");
    const test::ProgramResult other = resume("embree", "4");
    EXPECT_EQ(other.exit_code, 0) << other.err;
    EXPECT_NE(other.err.find(at("kept.exr") + ": holds samples of native, to which embree adds"),
              std::string::npos)
        << other.err;
    EXPECT_EQ(lines(other.err), 1) << other.err;
    EXPECT_EQ(sums("kept.exr").backends, (std::set<std::string>{"embree", "native"}));
}

TEST_F(PathResumeProgram, InterruptedRunsAreContinued) {
    std::vector<std::string> more{"--spp",        "1000000",    "--resume",
                                  at("kept.exr"), "--progress", "plain"};
    test::RunningProgram program(arguments("x.exr", more));
    ASSERT_TRUE(program.wait_for_lines(2)) << program.err();
    program.send(SIGINT);
    EXPECT_EQ(program.wait(), 130) << program.err();
    const FilmSums kept = sums("kept.exr");
    const auto made = static_cast<std::uint32_t>(kept.samples());
    ASSERT_GT(made, 0U);
    ASSERT_LT(made, 1'000'000U);
    EXPECT_EQ(read_exr(at("x.exr")).metadata.at("samples"), std::to_string(made));
    run("whole.exr", {"--samples", "0:" + std::to_string(made + 7)});
    run("x.exr", {"--spp", std::to_string(made + 7), "--resume", at("kept.exr")});
    test::expect_same_sums(sums("kept.exr"), sums("whole.exr"));
}

}  // namespace
}  // namespace weft::path_resume_test
