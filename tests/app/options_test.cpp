// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/options.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/testing/parse_options.h"

namespace weft::options_test {
namespace {

using test::parse;
using test::refusal;
using test::render;
using test::render_refusal;

TEST(Options, RenderDefaults) {
    const RenderOptions options = render({});
    EXPECT_EQ(options.scene, "scenes/box.gltf");
    EXPECT_EQ(options.output, "box.exr");
    EXPECT_EQ(options.algorithm, Algorithm::ais);
    EXPECT_EQ(options.tile, 64u);
    EXPECT_EQ(options.seed, 0u);
    EXPECT_EQ(options.exposure_ev, 0.0);
    EXPECT_EQ(options.tone, ToneCurve::none);
    EXPECT_EQ(options.progress, ProgressMode::automatic);
    EXPECT_FALSE(options.backend || options.device || options.threads || options.size ||
                 options.camera || options.components || options.spp || options.time_seconds ||
                 options.stats);
}

TEST(Options, RenderReadsEveryOption) {
    const RenderOptions options = render(
        {"-o",         "out/x.PNG", "--algorithm", "ir",       "--backend",    "native",
         "--device",   "1",         "--threads",   "3",        "--tile",       "4096",
         "--size",     "640x480",   "--camera",    "top",      "--components", "indirect,direct",
         "--spp",      "16",        "--time",      "2.5s",     "--seed",       "4294967295",
         "--exposure", "-1.5",      "--stats",     "run.json", "--progress",   "plain"});
    EXPECT_EQ(options.output, "out/x.PNG");
    EXPECT_EQ(options.algorithm, Algorithm::ir);
    EXPECT_EQ(options.backend, Backend::native);
    EXPECT_EQ(options.device, "1");
    EXPECT_EQ(options.threads, 3u);
    EXPECT_EQ(options.tile, 4096u);
    ASSERT_TRUE(options.size);
    EXPECT_EQ(options.size->width, 640u);
    EXPECT_EQ(options.size->height, 480u);
    EXPECT_EQ(options.camera, "top");
    EXPECT_EQ(options.components, (std::vector<std::string>{"direct", "indirect"}));
    EXPECT_EQ(options.spp, 16u);
    EXPECT_EQ(options.time_seconds, 2.5);
    EXPECT_EQ(options.seed, 4294967295u);
    EXPECT_EQ(options.exposure_ev, -1.5);
    EXPECT_EQ(options.stats, "run.json");
    EXPECT_EQ(options.progress, ProgressMode::plain);
}

TEST(Options, ValuesMayFollowAnEqualsSignAndScenesMayStartWithADash) {
    EXPECT_EQ(render({"--spp=4"}).spp, 4u);
    EXPECT_EQ(render({"--exposure=auto"}).exposure_ev, std::nullopt);
    EXPECT_EQ(render({"--tone", "filmic"}).tone, ToneCurve::filmic);
    EXPECT_EQ(render({"--tone=agx"}).tone, ToneCurve::agx);
    EXPECT_EQ(render({}).background, std::nullopt);
    EXPECT_EQ(render({"--background", "transparent"}).background, Background{});
    EXPECT_EQ(render({"--background", "white"}).background, (Background{false, glm::vec3(1.0F)}));
    EXPECT_EQ(render({"--background=#f00"}).background, (Background{false, {1.0F, 0.0F, 0.0F}}));
    EXPECT_EQ(render({"--background=#00ff00"}).background, (Background{false, {0.0F, 1.0F, 0.0F}}));
    EXPECT_EQ(render({"--background", "0,0.5,20"}).background,
              (Background{false, {0.0F, 0.5F, 20.0F}}));
    for (const char* const text :
         {"", "red", "#12", "#12345g", "#1234567", "1,2", "1,2,3,4", "1,2,-1", "1,2,nan", "0.5"})
        EXPECT_EQ(render_refusal({"--background", text}).find("--background: "), 0u) << text;
    EXPECT_EQ(render({"--device", "GeForce RTX"}).device, "GeForce RTX");
    EXPECT_EQ(std::get<RenderOptions>(parse({"render", "--", "-a.xml"})).scene, "-a.xml");
    EXPECT_EQ(std::get<RenderOptions>(parse({"render", "info"})).scene, "info");
    EXPECT_EQ(std::get<RenderOptions>(parse({"render", "a.b.glb"})).output, "a.b.exr");
}

TEST(Options, InfoAndDevices) {
    const auto info = std::get<InfoOptions>(parse({"info", "a.xml", "--json"}));
    EXPECT_EQ(info.scene, "a.xml");
    EXPECT_TRUE(info.json);
    EXPECT_FALSE(std::get<InfoOptions>(parse({"info", "a.xml"})).json);
    EXPECT_FALSE(info.verbose);
    EXPECT_TRUE(std::get<InfoOptions>(parse({"info", "a.xml", "--verbose"})).verbose);
    EXPECT_TRUE(render({"--verbose"}).verbose);
    EXPECT_EQ(refusal({"info", "a.xml", "--verbose=1"}), "--verbose: takes no value");
    EXPECT_TRUE(std::get<DevicesOptions>(parse({"devices", "--json"})).json);
    EXPECT_FALSE(std::get<DevicesOptions>(parse({"devices"})).json);
}

TEST(Options, HowScenesAreReadIsThatOfEveryCommandThatReadsOne) {
    const SceneReading plain = render({}).reading;
    EXPECT_EQ(plain.light, DefaultLight::as_needed);
    EXPECT_TRUE(plain.environment.empty());
    EXPECT_EQ(plain.environment_rotation, 0.0);
    const std::vector<const char*> given{
        "--light", "none",        "--environment", "my sky.hdr", "--environment-rotation",
        "-37.5",   "--materials", "diffuse"};
    const auto of = [&](const char* command) {
        std::vector<const char*> line{"weft", command, "a.gltf"};
        line.insert(line.end(), given.begin(), given.end());
        return parse_command_line(static_cast<int>(line.size()), line.data());
    };
    for (const SceneReading& reading :
         {std::get<RenderOptions>(of("render")).reading, std::get<InfoOptions>(of("info")).reading,
          std::get<TradeoffOptions>(of("tradeoff")).reading}) {
        EXPECT_EQ(reading.light, DefaultLight::never);
        EXPECT_EQ(reading.environment, "my sky.hdr");
        EXPECT_EQ(reading.environment_rotation, -37.5);
        EXPECT_EQ(reading.materials, MaterialDetail::diffuse);
        EXPECT_EQ(reading_arguments(reading),
                  " --light none --environment 'my sky.hdr' --environment-rotation -37.5 "
                  "--materials diffuse");
    }
    EXPECT_EQ(reading_arguments(plain), "");
    const nlohmann::json json = options_json(std::get<RenderOptions>(of("render")));
    EXPECT_EQ(json["environment"], "my sky.hdr");
    EXPECT_EQ(json["environment_rotation"], -37.5);
    EXPECT_EQ(json["materials"], "diffuse");
    for (const char* bad : {"x", "nan", "36001", ""})
        EXPECT_NE(render_refusal({"--environment-rotation", bad}), "no failure") << bad;
}

TEST(Options, Selftest) {
    const auto all = std::get<SelftestOptions>(parse({"selftest"}));
    EXPECT_FALSE(all.backend || all.device || all.json || all.ledger);
    EXPECT_TRUE(all.cases.empty());
    const auto some = std::get<SelftestOptions>(
        parse({"selftest", "--device", "1", "--cases", "3,16,3", "--json", "a.json", "--ledger"}));
    EXPECT_EQ(some.device, "1");
    EXPECT_EQ(some.cases, (std::vector<int>{3, 16}));
    EXPECT_EQ(some.json, "a.json");
    EXPECT_TRUE(some.ledger);
    EXPECT_EQ(std::get<SelftestOptions>(parse({"selftest", "--backend", "native"})).backend,
              Backend::native);
    for (const char* const list : {"0", "42", "3,,4", "a", "3-4"})
        EXPECT_EQ(refusal({"selftest", "--cases", list}).find("--cases: "), 0u) << list;
}

TEST(Options, HelpNamesAllThatExistsAndNothingElse) {
    const std::string top = std::get<HelpText>(parse({"--help"})).text;
    for (const char* name : {"render", "merge", "compare", "tradeoff", "info", "devices",
                             "selftest", "--help", "--version"})
        EXPECT_NE(top.find(name), std::string::npos) << name;
    EXPECT_NE(top.find("To begin: weft render scene.gltf -o image.png\n"), std::string::npos);
    const std::string help = std::get<HelpText>(parse({"render", "--help"})).text;
    EXPECT_EQ(help.find("To begin"), std::string::npos) << "only where one begins";
    for (const char* name : {"SCENE",
                             "-o,--output",
                             "--algorithm",
                             "--backend",
                             "--device",
                             "--threads",
                             "--tile",
                             "--size",
                             "--camera",
                             "--components",
                             "--spp",
                             "--time",
                             "--seed",
                             "--exposure",
                             "--stats",
                             "--progress",
                             "--frames",
                             "--frame-rate",
                             "--samples",
                             "--target-error",
                             "--resume",
                             "--pixel-filter",
                             "--vpl-compensation",
                             "--quality",
                             "--frame-time",
                             "--edits",
                             "--cache-records",
                             "--cache-masks",
                             "--overlays",
                             "--preset"})
        EXPECT_NE(help.find(name), std::string::npos) << name;
    EXPECT_EQ(std::get<HelpText>(parse({"render", "a", "--spp", "x", "--help"})).text, help);
}

TEST(Options, FramesOfAnAnimation) {
    EXPECT_FALSE(render({}).frames);
    const RenderOptions options = render({"--frames", "3:16777216", "--frame-rate", "23.976"});
    ASSERT_TRUE(options.frames);
    EXPECT_EQ(options.frames->first, 3u);
    EXPECT_EQ(options.frames->end, 16777216u);
    EXPECT_EQ(options.frame_rate, 23.976);
    EXPECT_EQ(render({"--frames=0:1"}).frame_rate, 30.0);
    for (const char* text : {"", ":", "1", "1:", ":1", "2:2", "3:2", "0:1:2", "-1:2", "0:1.5",
                             " 0:1", "0:16777217", "0:99999999999"})
        EXPECT_EQ(render_refusal({"--frames", text}).find("--frames: "), 0u) << text;
    for (const char* text : {"0", "-1", "1e-7", "1000.5", "nan", "inf", "30fps"})
        EXPECT_EQ(render_refusal({"--frames", "0:1", "--frame-rate", text}).find("--frame-rate: "),
                  0u)
            << text;
}

TEST(Options, OneFrameOfAnAnimation) {
    EXPECT_NE(std::get<HelpText>(parse({"render", "--help"})).text.find("--frame N"),
              std::string::npos);
    EXPECT_FALSE(render({}).frame || render({}).chosen_frames());
    EXPECT_FALSE(render({"--frames", "3:5"}).frame);
    EXPECT_EQ(render({"--frames", "3:5"}).chosen_frames()->end, 5u);
    const RenderOptions options =
        render({"--frame", "16777215", "--frame-rate", "25", "--edits", "edits.json", "--algorithm",
                "path", "--resume", "sums.exr", "--samples", "0:8"});
    EXPECT_EQ(options.frame, 16777215u);
    EXPECT_EQ(options.frame_rate, 25.0);
    EXPECT_EQ(options.edits, "edits.json");
    EXPECT_TRUE(options.resume && options.samples) << "it is a single image";
    EXPECT_FALSE(options.frames);
    EXPECT_EQ(options.chosen_frames()->first, 16777215u);
    EXPECT_EQ(options.chosen_frames()->end, 16777216u);
    EXPECT_EQ(options_json(options).at("frame"), 16777215);
    EXPECT_TRUE(options_json(options).at("frames").is_null());
    EXPECT_TRUE(options_json(render({})).at("frame").is_null());
    for (const char* text : {"", "1:2", "-1", "1.5", " 1", "+1", "16777216", "99999999999"})
        EXPECT_EQ(render_refusal({"--frame", text}).find("--frame: "), 0u) << text;
    EXPECT_EQ(render_refusal({"--frame", "1", "--frames", "0:2"}),
              "--frame: is one image instead of those of --frames, expected one of them");
    EXPECT_EQ(render_refusal({"--frame-rate", "25"}),
              "--frame-rate: is for animations, expected it together with --frames or --frame");
    EXPECT_EQ(render({"-o", "o/out.png", "--frame", "1", "--stats", "o/out.0001.png"}).stats,
              "o/out.0001.png")
        << "the image has no number";
}

TEST(Options, FramesAreNumberedBeforeTheExtension) {
    EXPECT_EQ(numbered_output("out.png", 0), "out.0000.png");
    EXPECT_EQ(numbered_output("a.b/c d.e.EXR", 42), "a.b/c d.e.0042.EXR");
    EXPECT_EQ(numbered_output("/tmp/out.exr", 12345), "/tmp/out.12345.exr");
    for (const char* stats : {"o/out.0001.png", "o/./out.12345.png", "o/x/../out.7.png"})
        EXPECT_EQ(render_refusal({"-o", "o/out.png", "--frames", "0:2", "--stats", stats}),
                  "--stats: names the same file as one of the images of --frames");
    for (const char* stats : {"out.0001.png", "o/out.png.json", "o/out.0001.json", "o/out.a.png",
                              "o/out..png", "o/xout.0001.png"})
        EXPECT_EQ(render({"-o", "o/out.png", "--frames", "0:2", "--stats", stats}).stats, stats);
}

TEST(Options, VersionWorksEverywhere) {
    const std::string version = std::get<HelpText>(parse({"--version"})).text;
    EXPECT_EQ(version.find("weft "), 0u);
    EXPECT_EQ(std::get<HelpText>(parse({"render", "--version"})).text, version);
}

TEST(Options, RefusesBadNumbers) {
    for (const char* text : {"0", "-1", "+1", "1.5", "1e3", "4k", " 4", "4 ", "", "x", "nan",
                             "99999999999", "0x10", "4097"}) {
        EXPECT_EQ(render_refusal({"--threads", text}).find("--threads: "), 0u) << text;
        EXPECT_EQ(render_refusal({"--tile", text}).find("--tile: "), 0u) << text;
    }
    EXPECT_EQ(render_refusal({"--spp", "0"}),
              "--spp: '0' is not valid, expected a whole number from 1 to 16777216");
    EXPECT_EQ(render_refusal({"--seed", "4294967296"}).find("--seed: "), 0u);
    EXPECT_EQ(render_refusal({"--seed", "-1"}).find("--seed: "), 0u);
    for (const char* text : {"nan", "inf", "-inf", "1e999", "1,5", "2ev", "automatic", "101"})
        EXPECT_EQ(render_refusal({"--exposure", text}),
                  "--exposure: '" + std::string(text) +
                      "' is not valid, expected auto or a number from -100 to 100");
    for (const char* text : {"-1", "4294967296", "99999999999999999999"})
        EXPECT_EQ(render_refusal({"--device", text}).find("--device: "), 0u) << text;
}

TEST(Options, ReadsTimes) {
    EXPECT_DOUBLE_EQ(render({"--time", "300ms"}).time_seconds.value(), 0.3);
    EXPECT_DOUBLE_EQ(render({"--time", "2m"}).time_seconds.value(), 120.0);
    EXPECT_DOUBLE_EQ(render({"--time", "1e2s"}).time_seconds.value(), 100.0);
    for (const char* text :
         {"5", "s", "ms", "0s", "-1s", "nans", "infs", "1e999s", "1h", "2 s", "2.5.1s", "1e9s"})
        EXPECT_EQ(render_refusal({"--time", text}).find("--time: "), 0u) << text;
}

TEST(Options, FrameTimesAreOfAdaptiveSampling) {
    EXPECT_FALSE(render({}).frame_seconds);
    EXPECT_DOUBLE_EQ(render({"--frame-time", "40ms"}).frame_seconds.value(), 0.04);
    EXPECT_DOUBLE_EQ(render({"--algorithm", "ais", "--frame-time", "40ms"}).frame_seconds.value(),
                     0.04);
    for (const char* text : {"40", "0ms", "-1s", "infs"})
        EXPECT_EQ(
            render_refusal({"--algorithm", "ais", "--frame-time", text}).find("--frame-time: "), 0u)
            << text;
    EXPECT_EQ(render_refusal({"--algorithm", "igi", "--frame-time", "40ms"}),
              "--frame-time: is for adaptive sampling, expected --algorithm ais");
    EXPECT_DOUBLE_EQ(
        options_json(render({"--algorithm", "ais", "--frame-time", "2.5s"}))["frame_time"]
            .get<double>(),
        2.5);
}

TEST(Options, ReadsSizes) {
    EXPECT_EQ(render({"--size", "32768x8192"}).size->width, 32768u);
    for (const char* text : {"640", "640x", "x480", "0x480", "640x0", "-1x5", "640X480", "1x2x3",
                             "640 x 480", "32769x1", "32768x32768", "4294967297x1"})
        EXPECT_EQ(render_refusal({"--size", text}).find("--size: "), 0u) << text;
}

TEST(Options, ComponentsThatHaveToBeAskedForAreNotOfPathTracing) {
    const RenderOptions options = render({"--components", "occlusion,direct"});
    EXPECT_EQ(options.components, (std::vector<std::string>{"direct", "occlusion"}));
    EXPECT_TRUE(options.names_component("occlusion"));
    EXPECT_FALSE(options.names_component("indirect") || render({}).names_component("occlusion"));
    EXPECT_EQ(render_refusal({"--algorithm", "path", "--components", "direct,occlusion"}),
              "--components: path tracing has no occlusion, expected direct, indirect, reflection, "
              "refraction, glossy, media");
    EXPECT_EQ(render_refusal({"--algorithm", "path", "--components", "media"}),
              "--components: path tracing has the light of media in direct, indirect");
    EXPECT_EQ(render_refusal({"--algorithm", "path", "--components", "refraction,reflection"}),
              "--components: path tracing has the light of reflection, refraction in direct, "
              "indirect");
}

TEST(Options, RefusesBadListsAndNames) {
    for (const char* text : {"direct,direct", ",", "direct,", "fog", "Direct"})
        EXPECT_EQ(render_refusal({"--components", text}).find("--components: "), 0u) << text;
    EXPECT_EQ(render_refusal({"--algorithm", "photons"}),
              "--algorithm: 'photons' is not valid, expected one of ais, amax, igi, ir, ic, tic, "
              "irradiance-cache, path, reference");
    EXPECT_EQ(render_refusal({"--backend", "cuda"}),
              "--backend: 'cuda' is not valid, expected one of opencl, embree, native");
    EXPECT_EQ(render_refusal({"--progress", "bar"}).find("--progress: "), 0u);
    EXPECT_EQ(render_refusal({"-o", "a.jpg"}),
              "--output: 'a.jpg' has no known extension, expected .exr or .png");
    EXPECT_EQ(render_refusal({"-o", "folder/"}).find("--output: "), 0u);
    EXPECT_EQ(render_refusal({"--stats", "./box.exr"}).find("--stats: "), 0u);
    EXPECT_EQ(render_refusal({"--stats", "scenes/./box.gltf"}).find("--stats: "), 0u);
}

TEST(Options, Merge) {
    const auto merge =
        std::get<MergeOptions>(parse({"merge", "a.exr", "b.exr", "-o", "c.exr", "d.exr"}));
    EXPECT_EQ(merge.parts.size(), 3u);
    EXPECT_EQ(merge.output, "c.exr");
    EXPECT_EQ(refusal({"merge", "-o", "c.exr"}).find("no parts given"), 0u);
    EXPECT_EQ(refusal({"merge", "a.exr"}).find("no output given"), 0u);
    EXPECT_EQ(refusal({"merge", "a.exr", "-o", "c.png"}).find("--output: "), 0u);
}

TEST(Options, SuggestsNearMisses) {
    const auto suggests = [](const std::string& message, const std::string& name) {
        return message.find("did you mean '" + name + "'?") != std::string::npos;
    };
    EXPECT_TRUE(suggests(refusal({"rendr", "a"}), "render"));
    EXPECT_TRUE(suggests(refusal({"--versoin"}), "--version"));
    EXPECT_TRUE(suggests(render_refusal({"--tiel", "4"}), "--tile"));
    EXPECT_TRUE(suggests(render_refusal({"--algoritm=igi"}), "--algorithm"));
    EXPECT_TRUE(suggests(render_refusal({"--algorithm", "igl"}), "igi"));
    EXPECT_TRUE(suggests(render_refusal({"--backend", "openCL"}), "opencl"));
    EXPECT_TRUE(suggests(render_refusal({"--components", "indirekt"}), "indirect"));
    EXPECT_TRUE(suggests(refusal({"devices", "--jsn"}), "--json"));
    EXPECT_EQ(render_refusal({"--photons", "4"}), "unknown option '--photons'");
    // The dashes are no part of the likeness.
    EXPECT_EQ(render_refusal({"--dissolve"}), "unknown option '--dissolve'");
    EXPECT_EQ(render_refusal({"--depth", "4"}), "unknown option '--depth'");
    EXPECT_EQ(refusal({"photons"}),
              "unknown command 'photons', expected render, view, merge, compare, tradeoff, info, "
              "devices or selftest");
}

TEST(Options, HelpMayBeAWord) {
    const auto help = [](std::initializer_list<const char*> line) {
        return std::get<HelpText>(parse(line)).text;
    };
    EXPECT_EQ(help({"help"}), help({"--help"}));
    EXPECT_EQ(help({"help", "render"}), help({"render", "--help"}));
    EXPECT_EQ(std::get<RenderOptions>(parse({"render", "help"})).scene, "help");
}

TEST(Options, ASceneWithoutACommandSaysWhichToUse) {
    EXPECT_EQ(refusal({"my room.GLB"}),
              "unknown command 'my room.GLB', expected weft render 'my room.GLB'");
}

TEST(Options, RefusesBadLines) {
    EXPECT_EQ(refusal({}).find("no command given"), 0u);
    EXPECT_EQ(refusal({""}).find("unknown command"), 0u);
    EXPECT_EQ(refusal({"render"}), "no scene given, expected weft render SCENE");
    EXPECT_EQ(refusal({"info", "--json"}), "no scene given, expected weft info SCENE");
    EXPECT_EQ(refusal({"render", ""}).find("SCENE: "), 0u);
    EXPECT_EQ(refusal({"--seed", "3", "render", "a"}),
              "unknown option '--seed', expected a command first");
    EXPECT_EQ(refusal({"devices", "a"}), "unexpected argument 'a'");
    EXPECT_EQ(refusal({"info", "a", "b"}), "unexpected argument 'b'");
    EXPECT_EQ(refusal({"info", "a", "--spp", "3"}), "unknown option '--spp'");
    EXPECT_EQ(render_refusal({"--spp"}), "--spp: lacks its value");
    EXPECT_EQ(render_refusal({"--spp", "--tile", "4"}), "--spp: lacks its value");
    EXPECT_EQ(render_refusal({"--spp", "1", "--spp", "2"}), "--spp: is given more than once");
    EXPECT_EQ(render_refusal({"-x"}), "unknown option '-x'");
    EXPECT_NE(refusal({"devices", "--json=3"}), "no failure");
    EXPECT_EQ(render_refusal({"a\nb\x1b"}), "unexpected argument 'a?b?'");
}

TEST(Options, JsonHoldsEveryOption) {
    const nlohmann::json defaults = options_json(render({}));
    for (const char* name : {"backend", "device", "threads", "size", "camera", "components", "spp",
                             "time", "frame_time", "stats", "environment"})
        EXPECT_TRUE(defaults.contains(name) && defaults[name].is_null()) << name;
    EXPECT_EQ(defaults["scene"], "scenes/box.gltf");
    EXPECT_EQ(defaults["output"], "box.exr");
    EXPECT_EQ(defaults["algorithm"], "ais");
    EXPECT_EQ(defaults["tile"], 64);
    EXPECT_EQ(defaults["seed"], 0);
    EXPECT_EQ(defaults["exposure"], 0.0);
    EXPECT_EQ(defaults["tone"], "none");
    EXPECT_EQ(defaults["background"], nullptr);
    EXPECT_EQ(defaults["progress"], "auto");
    EXPECT_EQ(defaults["verbose"], false);

    const nlohmann::json given = options_json(render(
        {"--backend",  "embree", "--device",     "2",      "--threads",  "3",   "--size", "6x4",
         "--camera",   "c\xff",  "--components", "direct", "--spp",      "5",   "--time", "300ms",
         "--exposure", "auto",   "--stats",      "s.json", "--progress", "none"}));
    EXPECT_EQ(given["backend"], "embree");
    EXPECT_EQ(given["device"], "2");
    EXPECT_EQ(given["threads"], 3);
    EXPECT_EQ(given["size"], nlohmann::json({6, 4}));
    EXPECT_EQ(given["components"], nlohmann::json({"direct"}));
    EXPECT_EQ(given["spp"], 5);
    EXPECT_DOUBLE_EQ(given["time"].get<double>(), 0.3);
    EXPECT_EQ(given["exposure"], "auto");
    EXPECT_EQ(given["stats"], "s.json");
    EXPECT_EQ(given["progress"], "none");
    EXPECT_NO_THROW(static_cast<void>(given.dump())) << "names need not be UTF-8, JSON must";
    EXPECT_EQ(given.size(), defaults.size());
}

}  // namespace
}  // namespace weft::options_test
