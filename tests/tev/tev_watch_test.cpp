// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tev/tev_watch.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "image/channel_name.h"
#include "tests/testing/fake_tev.h"

namespace weft::tev_watch_test {
namespace {

using test::FakeTev;
using test::TevImage;

/// An image whose values all differ.
SessionImage some_image(std::uint32_t width, std::uint32_t height, float first = 0.0F) {
    SessionImage made;
    made.image.width = width;
    made.image.height = height;
    made.image.layers = {
        {"", "RGB", {}}, {"alpha", "A", {}}, {"indirect", "RGB", {}}, {"depth", "Z", {}}};
    float next = first;
    for (Layer& layer : made.image.layers)
        for (std::size_t i = 0; i < layer.channels.size() * width * height; ++i)
            layer.values.push_back(next += 0.25F);
    made.image.layers.push_back({"weft.sums.a", "Y", std::vector<float>(width * height), true});
    return made;
}

void expect_shown(const TevImage& shown, const Image& image) {
    EXPECT_EQ(shown.width, image.width);
    EXPECT_EQ(shown.height, image.height);
    std::size_t channels = 0;
    const std::size_t plane = std::size_t{image.width} * image.height;
    for (const Layer& layer : image.layers) {
        if (layer.words) continue;
        for (std::size_t c = 0; c < layer.channels.size(); ++c) {
            const std::string name = full_channel_name(layer, layer.channels[c]);
            const auto found = shown.channels.find(name);
            ASSERT_NE(found, shown.channels.end()) << name;
            EXPECT_TRUE(std::equal(found->second.begin(), found->second.end(),
                                   layer.values.begin() + static_cast<std::ptrdiff_t>(c * plane)))
                << name;
            ++channels;
        }
    }
    EXPECT_EQ(shown.channels.size(), channels);
}

TEST(TevWatch, ShowsAllLayersUnderTheirNames) {
    FakeTev tev;
    Diagnostics diagnostics;
    TevWatch watch({"127.0.0.1", tev.port()}, "cornell.exr", diagnostics);
    watch.update(some_image(7, 5));
    const SessionImage last = some_image(7, 5, 100.0F);
    watch.update(last);
    tev.wait_for_updates(8);  // four layers, twice
    EXPECT_EQ(tev.problem(), "");
    EXPECT_EQ(tev.created(), 1U);
    ASSERT_EQ(tev.images().count("cornell.exr"), 1U);
    expect_shown(tev.images().at("cornell.exr"), last.image);
    EXPECT_EQ(tev.images().at("cornell.exr").channels.count("indirect.G"), 1U);
    EXPECT_TRUE(diagnostics.list().empty());
}

TEST(TevWatch, MakesAnotherImageWhereNameSizeOrLayersChange) {
    FakeTev tev;
    Diagnostics diagnostics;
    TevWatch watch({"127.0.0.1", tev.port()}, "a.0.exr", diagnostics);
    watch.update(some_image(4, 3));
    watch.set_image("a.1.exr");
    watch.update(some_image(4, 3));
    watch.update(some_image(6, 3));
    SessionImage less = some_image(6, 3);
    less.image.layers.resize(1);
    watch.update(less);
    tev.wait_for_updates(13);
    EXPECT_EQ(tev.problem(), "");
    EXPECT_EQ(tev.created(), 4U);
    EXPECT_EQ(tev.images().size(), 2U);
    expect_shown(tev.images().at("a.1.exr"), less.image);
}

TEST(TevWatch, SendsPiecemealToASlowViewer) {
    FakeTev tev({.receive_bytes = 4096, .pause_us = 200});
    Diagnostics diagnostics;
    TevWatch watch({"127.0.0.1", tev.port()}, "large.exr", diagnostics);
    // More than any buffer of a socket holds.
    const SessionImage large = some_image(1024, 512);
    watch.update(large);
    tev.wait_for_updates(4);
    EXPECT_EQ(tev.problem(), "");
    expect_shown(tev.images().at("large.exr"), large.image);
    EXPECT_TRUE(diagnostics.list().empty());
}

TEST(TevWatch, GoesOnAfterALostConnection) {
    // The viewer hangs up in the middle of a packet, once.
    FakeTev tev({.hang_up_after = 5000});
    Diagnostics diagnostics;
    TevWatch watch({"127.0.0.1", tev.port()}, "again.exr", diagnostics);
    const SessionImage image = some_image(512, 512);
    watch.update(image);  // fails
    EXPECT_EQ(diagnostics.list().size(), 1U);
    watch.update(image);
    tev.wait_for_updates(4);
    EXPECT_EQ(tev.problem(), "");
    EXPECT_EQ(tev.connections(), 2U);
    expect_shown(tev.images().at("again.exr"), image.image);
}

TEST(TevWatch, NoticesThatTheViewerWasClosedMeanwhile) {
    FakeTev tev;
    Diagnostics diagnostics;
    TevWatch watch({"127.0.0.1", tev.port()}, "b.exr", diagnostics);
    watch.update(some_image(4, 3));
    tev.wait_for_updates(4);
    tev.hang_up();
    watch.update(some_image(4, 3));
    tev.wait_for_updates(8);
    EXPECT_EQ(tev.created(), 2U);
    EXPECT_TRUE(diagnostics.list().empty());
}

TEST(TevWatch, WithoutAViewerIsAWarning) {
    std::uint16_t port = 0;
    {
        const FakeTev gone;
        port = gone.port();
    }
    Diagnostics diagnostics;
    TevWatch watch({"127.0.0.1", port}, "c.exr", diagnostics);
    watch.update(some_image(4, 3));
    watch.update(some_image(4, 3));
    ASSERT_EQ(diagnostics.warnings().size(), 1U);
    EXPECT_EQ(diagnostics.warnings().front(), "--tev: the image was not shown at 127.0.0.1 port " +
                                                  std::to_string(port) +
                                                  " for some of the time: Connection refused");
}

}  // namespace
}  // namespace weft::tev_watch_test
