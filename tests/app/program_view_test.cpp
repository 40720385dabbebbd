// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <signal.h>

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
        hello_ = json::parse(page_->enter(key_).text).at("hello");
    }

    [[nodiscard]] RunningProgram& program() { return *program_; }
    [[nodiscard]] ViewClient& page() { return *page_; }
    [[nodiscard]] const json& hello() const { return hello_; }
    [[nodiscard]] std::uint16_t port() const { return port_; }
    [[nodiscard]] const std::string& key() const { return key_; }
    /// Of the image that final_file() returned last.
    [[nodiscard]] std::uint32_t samples() const { return samples_; }

    void send(json message) {
        message["state"] = ++state_;
        page_->send(message.dump());
    }

    /// The next message that is an answer of that kind.
    json next(const std::string& kind) {
        while (true) {
            const ViewReceived received = receive();
            if (received.text.empty()) continue;
            const json text = json::parse(received.text);
            if (text.contains(kind)) return text.at(kind);
        }
    }

    /// The file of the next image that a command makes, once all requests are met.
    std::string final_file() {
        while (true) {
            const ViewReceived received = receive();
            const bool final = received.bytes.size() > head_bytes && (received.bytes[6] & 2) != 0;
            if (final && received.state() == state_) {
                samples_ = received.samples();
                return received.bytes.substr(head_bytes);
            }
        }
    }

    /// The command that makes the image that final_file() returned last.
    std::string command() {
        // Statuses may come before the frame that they are about.
        for (std::size_t i = 0;; ++i) {
            while (statuses_.size() <= i) (void)receive();
            const json& status = statuses_[i];
            const std::string found = status.at("command");
            if (found.find(" --spp " + std::to_string(samples_) + " ") != std::string::npos &&
                status.at("state") == state_)
                return found;
        }
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
    json hello_;
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

/// That the view rests on what its command writes.
void expect_command_makes_it(OpenView& view, const std::string& when) {
    const std::string shown = view.final_file();
    const std::string command = view.command();
    const std::string made = file_of(command);
    EXPECT_TRUE(shown == made) << when << ": " << command << ", " << shown.size() << " and "
                               << made.size() << " bytes";
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
