// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "tests/testing/run_program.h"
#include "tests/testing/view_client.h"

namespace weft::program_view_test {
namespace {

using nlohmann::json;
using test::RunningProgram;
using test::shipped_scene;
using test::ViewClient;
using test::ViewReceived;

constexpr std::size_t head_bytes = 28;

/// `weft view` with a page that has opened it.
class OpenView {
  public:
    explicit OpenView(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "view");
        arguments.insert(arguments.end(), {"--backend", "native"});
        RunningProgram::Settings settings;
        settings.seconds = 300;
        program_ = std::make_unique<RunningProgram>(arguments, settings);
        std::size_t begin = std::string::npos;
        while ((begin = program_->out().find("127.0.0.1:")) == std::string::npos ||
               program_->out().find("Ctrl-C") == std::string::npos)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        const std::string out = program_->out();
        const std::size_t port = begin + std::string("127.0.0.1:").size();
        const std::size_t hash = out.find('#', port);
        port_ = static_cast<std::uint16_t>(std::stoi(out.substr(port)));
        key_ = out.substr(hash + 1, 32);
        page_ = std::make_unique<ViewClient>(port_);
        const json told = json::parse(page_->enter(key_).text);
        hello_ = told.at("hello");
        scene_ = told.at("scene");
    }

    [[nodiscard]] RunningProgram& program() { return *program_; }
    [[nodiscard]] ViewClient& page() { return *page_; }
    [[nodiscard]] const json& hello() const { return hello_; }
    [[nodiscard]] const json& scene() const { return scene_; }
    [[nodiscard]] std::uint16_t port() const { return port_; }
    [[nodiscard]] const std::string& key() const { return key_; }
    /// Of the image that final_file() returned last.
    [[nodiscard]] std::uint32_t samples() const { return samples_; }

    void send(json message) {
        message["state"] = ++state_;
        page_->send(message.dump());
    }

    /// Sends what changes no image.
    void tell(const json& message) { page_->send(message.dump()); }

    /// The next message that is an answer of that kind.
    json next(const std::string& kind) {
        while (true) {
            const ViewReceived received = receive();
            if (received.text.empty()) continue;
            const json text = json::parse(received.text);
            if (text.contains(kind)) return text.at(kind);
        }
    }

    /// The file of the next image in a pane that a command makes, once all requests are met.
    std::string final_file(char pane = 0) {
        while (true) {
            const ViewReceived received = receive();
            const bool final = received.bytes.size() > head_bytes && (received.bytes[6] & 2) != 0 &&
                               received.bytes[5] == pane;
            if (final && received.state() == state_) {
                samples_ = received.samples();
                return received.bytes.substr(head_bytes);
            }
        }
    }

    /// The command that makes the image that final_file() returned last, of that pane.
    std::string command(const char* of = "command") {
        // Statuses may come before the frame that they are about.
        for (std::size_t i = 0;; ++i) {
            while (statuses_.size() <= i) (void)receive();
            const json& status = statuses_[i];
            const std::string found = status.at(of);
            if (found.find(" --spp " + std::to_string(samples_) + " ") != std::string::npos &&
                status.at("state") == state_)
                return found;
        }
    }

    /// Waits until the last status is as wished.
    template <class Wish>
    void wait_until(const Wish& wish) {
        while (statuses_.empty() || !wish(statuses_.back())) (void)receive();
    }

  private:
    ViewReceived receive() {
        ViewReceived received = page_->receive();
        if (!received.ended.empty()) throw std::runtime_error("the view ended: " + received.ended);
        if (!received.bytes.empty()) page_->ack(received.sequence());
        if (!received.text.empty()) {
            const json text = json::parse(received.text);
            if (text.contains("status")) statuses_.push_back(text.at("status"));
        }
        return received;
    }

    std::unique_ptr<RunningProgram> program_;
    std::unique_ptr<ViewClient> page_;
    json hello_, scene_;
    std::uint16_t port_ = 0;
    std::string key_;
    std::uint32_t state_ = 0, samples_ = 0;
    std::vector<json> statuses_;
};

/// What a command writes to view.png.
std::string file_of(const std::string& command) {
    const TemporaryFolder folder;
    EXPECT_TRUE(command.starts_with("weft render ")) << command;
    const std::string line = "cd '" + folder.path().string() + "' && '" + WEFT_PROGRAM + "'" +
                             command.substr(std::string("weft").size());
    EXPECT_EQ(std::system(line.c_str()), 0) << line;
    return test::text_of_file(folder.path() / "view.png");
}

/// That a pane of the view rests on what its command writes.
void expect_command_makes_it(OpenView& view, const std::string& when, bool compared = false) {
    const std::string shown = view.final_file(compared ? 1 : 0);
    const std::string command = view.command(compared ? "command_b" : "command");
    const std::string made = file_of(command);
    EXPECT_TRUE(shown == made) << when << ": " << command << ", " << shown.size() << " and "
                               << made.size() << " bytes";
}

/// The part of a PNG file that holds its pixels, without what it says of how it was made.
std::string image_bytes(const std::string& png) {
    const std::size_t begin = png.find("IDAT");
    EXPECT_NE(begin, std::string::npos);
    return begin == std::string::npos ? png : png.substr(begin);
}

json camera_message(const json& hello, double turn, bool moving) {
    json camera = hello.at("camera");
    camera.erase("orthographic");
    camera["from"][0] = camera["from"][0].get<double>() + turn;
    return {{"camera", camera}, {"moving", moving}};
}

TEST(ProgramView, RestsOnWhatItsCommandMakes) {
    for (const char* scene : {"cornell-box.gltf", "shirley6-pm.gltf"}) {
        OpenView view({shipped_scene(scene), "--size", "56x48"});
        EXPECT_EQ(view.hello().at("scene"), scene);
        expect_command_makes_it(view, "at first");
        for (int i = 1; i <= 5; ++i) view.send(camera_message(view.hello(), 0.01 * i, true));
        view.send(camera_message(view.hello(), 1.0 / 30.0, false));
        expect_command_makes_it(view, "after moving");
        view.send({{"set", {{"algorithm", "igi"}, {"exposure", -0.5}, {"tone", "agx"}}}});
        expect_command_makes_it(view, "by igi");
        view.send({{"set", {{"algorithm", "path"}, {"size", {40, 40}}}}});
        expect_command_makes_it(view, "by path");
        view.send({{"set", {{"algorithm", "ais"}, {"quality", "draft"}}}});
        expect_command_makes_it(view, "at draft quality");
    }
}

json edit_message(const json& edit, bool moving = false, bool continues = false) {
    return {{"edit", edit}, {"moving", moving}, {"continues", continues}};
}

TEST(ProgramView, RestsOnWhatItsCommandMakesOfAnEditedScene) {
    OpenView view({shipped_scene("cornell-box.gltf"), "--size", "56x48"});
    const json& names = view.scene().at("objects");
    ASSERT_NE(std::find(names.begin(), names.end(), "short block"), names.end());
    for (int i = 1; i <= 4; ++i)
        view.send(
            edit_message({{"object", "short block"}, {"move", {0.02 * i, 0, 0.01}}}, true, i > 1));
    view.send(edit_message({{"object", "short block"}, {"move", {0.1, 0, 0.01}}}, false, true));
    expect_command_makes_it(view, "a block that was dragged");
    view.send(edit_message({{"material", "green"}, {"albedo", {0.1, 0.2, 0.7}}}));
    view.send(edit_message({{"material", "light"}, {"emission_factor", 0.5}}));
    view.send(edit_message(
        {{"object", "tall block"}, {"rotate", {{"axis", {0, 1, 0}}, {"degrees", 30}}}}));
    expect_command_makes_it(view, "several edits");
    view.send({{"set", {{"algorithm", "tic"}, {"samples", 2}}}});
    expect_command_makes_it(view, "by tic");
    view.send({{"set", {{"algorithm", "path"}, {"samples", 0}}}});
    expect_command_makes_it(view, "by path");
    view.send(edit_message({{"object", "short block"}, {"remove", true}}));
    expect_command_makes_it(view, "without a block");
    view.send({{"undo", "last"}});
    view.send({{"set", {{"algorithm", "ais"}}}});
    expect_command_makes_it(view, "with that block again");
    view.send({{"undo", "all"}});
    expect_command_makes_it(view, "as it was");
    EXPECT_EQ(view.command().find("--edits"), std::string::npos);
}

TEST(ProgramView, RestsOnWhatItsCommandMakesOfAnAnimation) {
    OpenView view({shipped_scene("figure.gltf"), "--size", "48x48"});
    ASSERT_GT(view.scene().at("frames"), 10);
    for (int frame = 1; frame <= 6; ++frame)
        view.send({{"set", {{"frame", frame}}}, {"moving", true}});
    view.send({{"set", {{"frame", 7}}}, {"moving", false}});
    expect_command_makes_it(view, "in a frame");
    view.send(camera_message(view.hello(), 0.2, false));
    expect_command_makes_it(view, "from elsewhere");
    const std::string object = view.scene().at("objects").at(0);
    view.send(edit_message({{"object", object}, {"move", {0, 0.1, 0}}}));
    expect_command_makes_it(view, "with an edit");
    // An edit holds from its frame on.
    view.send({{"set", {{"frame", 3}}}, {"moving", false}});
    expect_command_makes_it(view, "before the edit");
}

TEST(ProgramView, RestsOnWhatItsCommandMakesOfMaterials) {
    OpenView view({shipped_scene("still-life.gltf"), "--size", "40x40", "--algorithm", "path"});
    json rough;
    for (const json& material : view.scene().at("materials"))
        if (rough.is_null() && !material.at("roughness").is_null()) rough = material;
    ASSERT_FALSE(rough.is_null());
    view.send(edit_message({{"material", rough.at("name")}, {"roughness", 0.9}}));
    expect_command_makes_it(view, "of another roughness");
    view.send(edit_message({{"material", rough.at("name")}, {"albedo", {0.9, 0.1, 0.1}}}));
    expect_command_makes_it(view, "of another colour");
}

// A first sample takes long enough there that a divided image goes before, and trees are built with
// and without spatial splits.
TEST(ProgramView, RestsOnWhatItsCommandMakesOfALargeScene) {
    OpenView view({shipped_scene("conference.gltf"), "--size", "320x256"});
    (void)view.final_file();
    view.send(camera_message(view.hello(), 0.3, true));
    view.send(camera_message(view.hello(), 0.4, false));
    const std::string object = view.scene().at("objects").at(3);
    view.send(edit_message({{"object", object}, {"move", {0.05, 0.1, 0}}}));
    expect_command_makes_it(view, "with an object that was moved");
}

TEST(ProgramView, BeginsWithEdits) {
    OpenView view({shipped_scene("cornell-box.gltf"), "--size", "40x40", "--frame-rate", "25",
                   "--edits", shipped_scene("cornell-box-edits.json")});
    EXPECT_EQ(view.scene().at("frames"), 26);
    view.send({{"set", {{"frame", 12}}}, {"moving", false}});
    expect_command_makes_it(view, "in a frame");
    view.send(edit_message({{"object", "small block"}, {"move", {0, 0.1, 0}}}));
    expect_command_makes_it(view, "with one more");
    view.send({{"undo", "all"}});
    expect_command_makes_it(view, "without any");
}

TEST(ProgramView, RefusesEditsThatDoNotFitTheScene) {
    for (const char* edits : {"no-such-file.json", "{", R"({"edits": [{"frame": 0}]})",
                              R"({"edits": [{"frame": 0, "object": "x", "remove": true}]})"}) {
        const test::ProgramResult refused = test::run_program(
            {"view", shipped_scene("cornell-box.gltf"), "--backend", "native", "--edits", edits});
        EXPECT_EQ(refused.exit_code, 2) << edits;
        EXPECT_TRUE(refused.err.starts_with("weft: ")) << refused.err;
    }
}

TEST(ProgramView, ComparesInEqualTime) {
    OpenView view({shipped_scene("cornell-box.gltf"), "--size", "40x40"});
    view.send(
        {{"set", {{"compare", {{"algorithm", "igi"}, {"quality", "draft"}, {"seconds", 0.3}}}}}});
    // One waits for the other, and then both are finished.
    expect_command_makes_it(view, "what it is compared with", true);
    expect_command_makes_it(view, "the view itself");
    view.wait_until([](const json& status) { return status.at("phase") == "finished"; });
    view.send({{"set", {{"compare", nullptr}}}});
    expect_command_makes_it(view, "alone again");
}

TEST(ProgramView, JudgesWhatItShows) {
    OpenView view({shipped_scene("cornell-box.gltf"), "--size", "40x40"});
    view.send({{"set", {{"trust", true}, {"algorithm", "igi"}, {"samples", 4}}}});
    json trust;
    do trust = view.next("trust");
    while (trust.at("panes").empty() || trust.at("panes").at(0).at("relmse").is_null());
    const json& pane = trust.at("panes").at(0);
    EXPECT_EQ(pane.at("pane"), 0);
    EXPECT_EQ(pane.at("samples"), 4);
    EXPECT_GT(pane.at("hdrflip"), 0.0);
    EXPECT_LT(pane.at("hdrflip"), 1.0);
    EXPECT_GE(trust.at("samples"), trust.at("judged_by"));
    EXPECT_LE(pane.at("relmse").at("low"), pane.at("relmse").at("high"));
    // Its error is an overlay from then on.
    view.send({{"set", {{"overlay", "error"}}}});
    view.wait_until([](const json& status) {
        return status.at("settings").at("overlay") == "error" &&
               status.at("overlays").back() == "error";
    });
}

TEST(ProgramView, MeasuresSettingsAndSavesWhatIsChosen) {
    const TemporaryFolder folder;
    OpenView view(
        {shipped_scene("cornell-box.gltf"), "--size", "32x32", "--output", folder.path().string()});
    (void)view.final_file();
    view.tell({{"measure", true}});
    json front = view.next("front");
    EXPECT_EQ(front.at("running"), true);
    while (front.at("running") == true) front = view.next("front");
    ASSERT_GE(front.at("points").size(), 3U);
    ASSERT_LE(front.at("points").size(), 5U);
    for (const json& point : front.at("points")) {
        EXPECT_GT(point.at("ms"), 0.0);
        EXPECT_LE(point.at("low_ms"), point.at("ms"));
        EXPECT_GT(point.at("error"), 0.0);
    }
    view.tell({{"adopt", 0}});
    const std::string preset = view.next("saved");
    EXPECT_TRUE(preset.ends_with("view-001.preset.json"));
    const std::string shown = view.final_file();
    // The preset makes the same image as the command, and so as the view.
    const std::string command = view.command();
    EXPECT_TRUE(shown == file_of(command)) << command;
    const test::ProgramResult by_preset = test::run_program(
        {"render", shipped_scene("cornell-box.gltf"), "--backend", "native", "--size", "32x32",
         "--preset", preset, "-o", (folder.path() / "preset.png").string()});
    ASSERT_EQ(by_preset.exit_code, 0) << by_preset.err;
    EXPECT_TRUE(image_bytes(shown) ==
                image_bytes(test::text_of_file(folder.path() / "preset.png")));
}

TEST(ProgramView, SavesEditsThatRenderPlaysBack) {
    const TemporaryFolder folder;
    OpenView view(
        {shipped_scene("cornell-box.gltf"), "--size", "40x40", "--output", folder.path().string()});
    view.send(edit_message({{"object", "short block"}, {"scale", 0.5}}));
    const std::string shown = view.final_file();
    view.tell({{"save", "edits"}});
    const std::string edits = view.next("saved");
    const test::ProgramResult played = test::run_program(
        {"render", shipped_scene("cornell-box.gltf"), "--backend", "native", "--size", "40x40",
         "--frame", "0", "--edits", edits, "--spp", std::to_string(view.samples()), "-o",
         (folder.path() / "played.png").string()});
    ASSERT_EQ(played.exit_code, 0) << played.err;
    EXPECT_TRUE(shown == test::text_of_file(folder.path() / "played.png"));
}

TEST(ProgramView, RefusesEditsAndKeepsTheScene) {
    OpenView view({shipped_scene("cornell-box.gltf"), "--size", "40x40"});
    (void)view.final_file();
    for (const json& edit :
         {json{{"object", "no such object"}, {"move", {1, 0, 0}}}, json{{"object", "short block"}},
          json{{"material", "green"}, {"albedo", {2, 0, 0}}},
          json{{"object", "short block"}, {"move", {1e300, 0, 0}}}}) {
        view.send(edit_message(edit));
        EXPECT_FALSE(view.next("error").get<std::string>().empty());
    }
    view.tell({{"adopt", 3}});
    EXPECT_NE(view.next("error").get<std::string>().find("point"), std::string::npos);
    view.tell({{"save", "edits"}});
    EXPECT_NE(view.next("error").get<std::string>().find("edits"), std::string::npos);
    view.send({{"set", {{"exposure", 1}}}});
    expect_command_makes_it(view, "after refused edits");
}

TEST(ProgramView, ShowsAnImageInOtherColoursWithoutMakingItAnew) {
    OpenView view({shipped_scene("cornell-box.gltf"), "--size", "56x48"});
    while (view.samples() < 24) (void)view.final_file();
    const std::uint32_t before = view.samples();
    view.send({{"set", {{"exposure", 1.5}, {"tone", "filmic"}}}});
    (void)view.final_file();
    EXPECT_GE(view.samples(), before);
}

TEST(ProgramView, TellsWhatAPixelShowsAndSaves) {
    const TemporaryFolder folder;
    OpenView view({shipped_scene("cornell-box.gltf"), "--size", "64x64", "--output",
                   (folder.path() / "new").string()});
    const std::string shown = view.final_file();
    view.send({{"pick", {50, 58}}});
    const json picked = view.next("picked");
    EXPECT_EQ(picked.at("at"), json({50, 58}));
    EXPECT_EQ(picked.at("values").at("").size(), 3U);
    // The floor lies at y = 0.
    EXPECT_NEAR(picked.at("point").at(1).get<double>(), 0.0, 1e-3);
    view.send({{"set", {{"paused", true}}}});
    view.send({{"save", "png"}});
    const std::string file = view.next("saved");
    EXPECT_EQ(file, (folder.path() / "new" / "view-001.png").string());
    EXPECT_FALSE(test::text_of_file(file).empty());
    view.send({{"save", "exr"}});
    EXPECT_EQ(view.next("saved"), (folder.path() / "new" / "view-001.exr").string());
    view.send({{"save", "png"}});
    EXPECT_EQ(view.next("saved"), (folder.path() / "new" / "view-002.png").string());
}

TEST(ProgramView, SaysWhatItCannotDoAndGoesOn) {
    OpenView view({shipped_scene("shirley6-pm.gltf"), "--size", "40x40"});
    (void)view.final_file();
    view.send({{"set", {{"algorithm", "irradiance-cache"}}}});
    EXPECT_NE(view.next("error").get<std::string>().find("irradiance-cache"), std::string::npos);
    view.send({{"set", {{"camera", "no such camera"}}}});
    EXPECT_NE(view.next("error").get<std::string>().find("no such camera"), std::string::npos);
    view.send({{"save", "png"}});
    EXPECT_NE(view.next("error").get<std::string>().find("--output"), std::string::npos);
    view.send({{"set", {{"exposure", 1}}}});
    EXPECT_FALSE(view.final_file().empty());
}

TEST(ProgramView, EndsCleanlyAtCtrlCWithClientsConnected) {
    OpenView view({shipped_scene("cornell-box.gltf"), "--size", "96x96"});
    ViewClient other(view.port());
    EXPECT_TRUE(other.enter(view.key()).text.starts_with(R"({"hello":)"));
    view.program().send(SIGINT);
    EXPECT_EQ(view.program().wait(), 0);
    EXPECT_EQ(view.program().err(), "");
}

TEST(ProgramView, RefusesWhatCannotBeShown) {
    const test::ProgramResult missing = test::run_program({"view", "no-such-file.gltf"});
    EXPECT_EQ(missing.exit_code, 2);
    const TemporaryFolder folder;
    const test::ProgramResult taken =
        test::run_program({"view", shipped_scene("cornell-box.gltf"), "--output", WEFT_PROGRAM,
                           "--backend", "native"});
    EXPECT_EQ(taken.exit_code, 5);
    EXPECT_NE(taken.err.find("is no folder"), std::string::npos) << taken.err;
}

}  // namespace
}  // namespace weft::program_view_test
