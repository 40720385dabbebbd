// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_server.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "tests/testing/temporary_folder.h"
#include "tests/testing/view_client.h"

namespace weft::view_server_test {
namespace {

using test::ViewClient;
using test::ViewReceived;

const std::string key = "00112233445566778899aabbccddeeff";

/// A view that takes everything.
class TakenEvents : public ViewEvents {
  public:
    std::string hello() override { return R"({"hello":{}})"; }
    std::uint64_t take(std::uint32_t, const ViewMessage& message) override {
        const std::lock_guard guard(mutex_);
        taken_.push_back(message);
        const bool changes = std::holds_alternative<ViewCamera>(message) ||
                             std::holds_alternative<ViewSettings>(message);
        return changes ? ++version_ : 0;
    }
    [[nodiscard]] std::vector<ViewMessage> taken() const {
        const std::lock_guard guard(mutex_);
        return taken_;
    }
    /// Waits until so many messages have come.
    void wait_for(std::size_t count) const {
        while (taken().size() < count) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }

  private:
    mutable std::mutex mutex_;
    std::vector<ViewMessage> taken_;
    std::uint64_t version_ = 0;
};

ViewFrame frame_of(std::uint32_t samples, std::uint64_t version = 0, std::size_t bytes = 3) {
    ViewFrame frame;
    frame.samples = samples;
    frame.version = version;
    frame.width = frame.height = 4;
    frame.file = std::make_shared<const std::vector<std::byte>>(bytes, std::byte{7});
    return frame;
}

void wait_for_pages(const ViewServer& server, std::size_t count) {
    while (server.pages() != count) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

class ViewServerPages : public testing::Test {
  protected:
    TakenEvents events_;
    ViewServer server_{{}, key, events_};
};

TEST_F(ViewServerPages, ServesThePageAndNothingElse) {
    ViewClient client(server_.port());
    const auto page = client.get("/");
    EXPECT_EQ(page.result_int(), 200U);
    EXPECT_EQ(page.at("Content-Type"), "text/html; charset=utf-8");
    EXPECT_NE(page.body().find("<!doctype html>"), std::string::npos);
    const std::string policy(page.at("Content-Security-Policy"));
    EXPECT_TRUE(policy.starts_with("default-src 'self';")) << policy;
    EXPECT_NE(policy.find("frame-ancestors 'none'"), std::string::npos);
    EXPECT_EQ(client.get("/view.js").at("Content-Type"), "text/javascript; charset=utf-8");
    EXPECT_EQ(client.get("/view.css").at("Content-Type"), "text/css; charset=utf-8");
    EXPECT_EQ(client.get("/", boost::beast::http::verb::head).body(), "");
    for (const char* target : {"/index.html", "/../etc/passwd", "/view.js?x", "/ws", "*"})
        EXPECT_EQ(client.get(target).result_int(), 404U) << target;
    EXPECT_EQ(client.get("/", boost::beast::http::verb::post).result_int(), 405U);
    // What a page may hold names nothing that lies elsewhere.
    for (const char* target : {"/", "/view.js", "/view.css"})
        for (const char* elsewhere : {"https://", "//cdn", "@import", "eval("})
            EXPECT_EQ(client.get(target).body().find(elsewhere), std::string::npos) << target;
}

TEST_F(ViewServerPages, AnswersOnlyRequestsForThisMachine) {
    ViewClient client(server_.port());
    client.set_host("evil.example:80");
    EXPECT_EQ(client.get("/").result_int(), 403U);
    ViewClient rebound(server_.port());
    rebound.set_host("evil.example");
    EXPECT_EQ(rebound.open(), 403U);
    for (const char* origin : {"http://evil.example", "null", ""}) {
        ViewClient other(server_.port());
        other.set_origin(origin);
        EXPECT_EQ(other.open(), 403U) << origin;
    }
    ViewClient elsewhere(server_.port());
    EXPECT_EQ(elsewhere.open("/other"), 404U);
    EXPECT_EQ(server_.pages(), 0U);
}

TEST_F(ViewServerPages, TurnsAwayWhoDoesNotKnowTheKey) {
    for (const std::string& text :
         {std::string(R"({"token":"00112233445566778899aabbccddeefe"})"),
          std::string(R"({"token":""})"), std::string(R"({"ack":1})"), std::string("no JSON")}) {
        ViewClient client(server_.port());
        ASSERT_EQ(client.open(), 101U);
        client.send(text);
        EXPECT_EQ(client.receive().ended, "the key is not that of this view") << text;
    }
    EXPECT_EQ(server_.pages(), 0U);
    EXPECT_TRUE(events_.taken().empty());
}

TEST_F(ViewServerPages, GoesOnAfterMessagesThatAreWrong) {
    ViewClient client(server_.port());
    EXPECT_EQ(client.enter(key).text, R"({"hello":{}})");
    client.send("{");
    EXPECT_EQ(client.receive().text, R"({"error":"message#:1: JSON syntax error"})");
    client.send(R"({"token":")" + key + "\"}");
    EXPECT_EQ(client.receive().text,
              R"({"error":"message#: is a key, which this page has shown already"})");
    client.send("{\"save\":\"\x01\xc3\xa9\"}");
    EXPECT_TRUE(client.receive().text.starts_with(R"({"error":)"));
    client.send(R"({"pick":[1,2]})");
    events_.wait_for(1);
    EXPECT_EQ(server_.pages(), 1U);
}

TEST_F(ViewServerPages, ClosesWhatIsTooLongOrNoText) {
    ViewClient long_winded(server_.port());
    EXPECT_EQ(long_winded.enter(key).text, R"({"hello":{}})");
    long_winded.send(std::string(max_view_message_bytes + 1, ' '));
    EXPECT_NE(long_winded.receive().ended, "");
    EXPECT_EQ(long_winded.close_code(), boost::beast::websocket::close_code::too_big);
    ViewClient binary(server_.port());
    EXPECT_EQ(binary.enter(key).text, R"({"hello":{}})");
    binary.send_binary("{}");
    EXPECT_EQ(binary.receive().ended, "a message was not text");
    wait_for_pages(server_, 0);
}

TEST_F(ViewServerPages, AClientThatNeverAnswersHoldsUpNobody) {
    ViewClient silent(server_.port());
    ViewClient quick(server_.port());
    (void)silent.enter(key);
    (void)quick.enter(key);
    constexpr std::uint32_t frames = 30;
    for (std::uint32_t i = 1; i <= frames; ++i) {
        server_.show(frame_of(i, 0, std::size_t{1} << 20U));
        const ViewReceived received = quick.receive();
        ASSERT_EQ(received.samples(), i);
        quick.ack(received.sequence());
    }
    // The silent one has two frames, and gets the newest once it has drawn one of them.
    EXPECT_EQ(silent.receive().samples(), 1U);
    EXPECT_EQ(silent.receive().samples(), 2U);
    silent.ack(1);
    EXPECT_EQ(silent.receive().samples(), frames);
}

TEST_F(ViewServerPages, FourPagesShowAView) {
    std::vector<std::unique_ptr<ViewClient>> clients;
    for (int i = 0; i < 10; ++i) {
        clients.push_back(std::make_unique<ViewClient>(server_.port()));
        const ViewReceived first = clients.back()->enter(key);
        EXPECT_EQ(first.text, i < 4 ? R"({"hello":{}})" : "") << i;
        EXPECT_EQ(first.ended, i < 4 ? "" : "4 pages show this view already") << i;
    }
    EXPECT_EQ(server_.pages(), 4U);
    clients.front()->hang_up();
    wait_for_pages(server_, 3);
    ViewClient next(server_.port());
    EXPECT_EQ(next.enter(key).text, R"({"hello":{}})");
}

TEST_F(ViewServerPages, SurvivesDisconnectsInTheMiddle) {
    for (int i = 0; i < 20; ++i) {
        ViewClient client(server_.port());
        (void)client.enter(key);
        server_.show(frame_of(1, 0, std::size_t{4} << 20U));
        server_.show(frame_of(2, 0, std::size_t{4} << 20U));
        if (i % 2 == 0) client.send(R"({"pick":[)");
        client.hang_up();
    }
    ViewClient last(server_.port());
    EXPECT_EQ(last.enter(key).text, R"({"hello":{}})");
    // Who comes later sees what there is.
    EXPECT_EQ(last.receive().samples(), 2U);
    wait_for_pages(server_, 1);
}

TEST_F(ViewServerPages, FramesTellWhichRequestTheyShow) {
    ViewClient client(server_.port());
    (void)client.enter(key);
    server_.show(frame_of(1));
    EXPECT_EQ(client.receive().state(), 0U);
    client.ack(1);
    client.send(R"({"set":{"paused":false},"state":41})");  // version 1
    client.send(R"({"set":{"paused":false},"state":42})");  // version 2
    client.send(R"({"set":{"paused":false},"state":43})");  // version 3
    events_.wait_for(3);
    server_.send_status(R"({"samples":1})", 1);
    EXPECT_EQ(client.receive().text, R"({"status":{"state":41,"samples":1}})");
    server_.show(frame_of(2, 2));
    EXPECT_EQ(client.receive().state(), 42U);
    client.ack(2);
    server_.show(frame_of(3, 3));
    EXPECT_EQ(client.receive().state(), 43U);
}

TEST_F(ViewServerPages, SendsTextsToOneOrAll) {
    ViewClient first(server_.port());
    ViewClient second(server_.port());
    (void)first.enter(key);
    (void)second.enter(key);
    server_.send(R"({"a":1})");
    server_.send(2, R"({"b":2})");
    server_.send(99, R"({"c":3})");
    server_.send(R"({"d":4})");
    EXPECT_EQ(first.receive().text, R"({"a":1})");
    EXPECT_EQ(first.receive().text, R"({"d":4})");
    EXPECT_EQ(second.receive().text, R"({"a":1})");
    EXPECT_EQ(second.receive().text, R"({"b":2})");
    EXPECT_EQ(second.receive().text, R"({"d":4})");
}

TEST(ViewServer, EndsWithClientsConnected) {
    TakenEvents events;
    auto server = std::make_unique<ViewServer>(ViewAddress{}, key, events);
    ViewClient page(server->port());
    ViewClient keyless(server->port());
    ViewClient silent(server->port());
    (void)page.enter(key);
    ASSERT_EQ(keyless.open(), 101U);
    const auto begin = std::chrono::steady_clock::now();
    std::thread farewell([&] { EXPECT_EQ(page.receive().ended, "the program has ended"); });
    server.reset();
    farewell.join();
    // Those that do not answer are not waited for.
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST(ViewServer, RefusesAPortThatIsTaken) {
    TakenEvents events;
    const ViewServer server({}, key, events);
    try {
        const ViewServer other({server.port()}, key, events);
        FAIL() << "two servers have one port";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::output);
        EXPECT_NE(std::string(error.what()).find("cannot be served"), std::string::npos);
    }
}

TEST(ViewServer, UnixSocketsArePrivateAndGoAway) {
    const TemporaryFolder folder;
    const std::filesystem::path socket = folder.path() / "view.sock";
    TakenEvents events;
    {
        const ViewServer server({{}, socket}, key, events);
        EXPECT_EQ(server.port(), 0U);
        struct stat found {};
        ASSERT_EQ(::stat(socket.c_str(), &found), 0);
        EXPECT_TRUE(S_ISSOCK(found.st_mode));
        EXPECT_EQ(found.st_mode & 0777U, 0600U);
        EXPECT_THROW(ViewServer({{}, socket}, key, events), Error);
        EXPECT_TRUE(std::filesystem::exists(socket));
    }
    EXPECT_FALSE(std::filesystem::exists(socket));
    EXPECT_THROW(ViewServer({{}, folder.path() / std::string(200, 'x')}, key, events), Error);
}

}  // namespace
}  // namespace weft::view_server_test
