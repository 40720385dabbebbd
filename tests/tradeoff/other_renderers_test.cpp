// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/other_renderers.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "image/exr.h"
#include "tests/testing/temporary_folder.h"

namespace weft::other_renderers_test {
namespace {

using nlohmann::json;

constexpr std::uint32_t width = 24;
constexpr std::uint32_t height = 16;

Image grey(float value, const std::string& channels = "RGB") {
    Layer layer{"", channels, {}};
    layer.values.assign(channels.size() * width * height, value);
    return {width, height, {layer}, {}};
}

class OtherRenderersFile : public testing::Test {
  protected:
    OtherRenderersFile() { write_exr(folder_.path() / "a.exr", grey(0.5F)); }

    [[nodiscard]] OtherRenderers read(const json& content) const {
        return read_other_renderers(folder_.write("peers.json", content.dump()), {width, height});
    }
    [[nodiscard]] std::string refusal(const json& content) const {
        try {
            (void)read(content);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            return error.what();
        }
        return "no failure";
    }

    static json make_image(const std::string& file = "a.exr") {
        return {{"name", "other path"}, {"budget_s", 0.3},   {"seconds", 0.31},
                {"samples", 12},        {"denoised", false}, {"picture", file}};
    }
    static json others_of(json images) {
        return {
            {"weft_peers", 1}, {"pictures", std::move(images)}, {"notes", {"set-up is left out"}}};
    }
    /// Not by braces, which take a list of one value for that value.
    template <class... Images>
    static json others(const Images&... images) {
        json list = json::array();
        (list.push_back(images), ...);
        return others_of(std::move(list));
    }

    TemporaryFolder folder_;
};

TEST_F(OtherRenderersFile, ReadsEveryImage) {
    write_exr(folder_.path() / "b.exr", grey(0.75F, "RGBA"));
    json brighter = make_image("b.exr");
    brighter["denoised"] = true;
    brighter.erase("samples");
    const OtherRenderers found = read(others(make_image(), brighter));
    ASSERT_EQ(found.images.size(), 2U);
    EXPECT_EQ(found.notes, std::vector<std::string>{"set-up is left out"});
    const OtherRendererPoint& same = found.images[0];
    EXPECT_EQ(same.name, "other path");
    EXPECT_EQ(same.budget_s, 0.3);
    EXPECT_EQ(same.seconds, 0.31);
    EXPECT_EQ(same.samples, 12.0);
    EXPECT_FALSE(same.denoised);
    EXPECT_TRUE(same.errors.empty());
    EXPECT_EQ(same.image.find("")->values, grey(0.5F).layers[0].values);
    const OtherRendererPoint& other = found.images[1];
    EXPECT_TRUE(other.denoised);
    EXPECT_EQ(other.samples, 0.0);
    EXPECT_EQ(other.image.find("")->values, grey(0.75F).layers[0].values);
    EXPECT_EQ(other.image.find("")->channels, "RGB");
}

TEST_F(OtherRenderersFile, StaysInItsFolder) {
    for (const char* const name : {"../a.exr", "/etc/passwd", "x/../../a.exr", "http://a/b.exr"})
        EXPECT_NE(refusal(others(make_image(name))).find("peers.json#/pictures/0/picture"),
                  std::string::npos)
            << name;
}

TEST_F(OtherRenderersFile, RefusesWhatIsUnknownOrOutOfRange) {
    const auto refused = [&](const char* key, const json& value) {
        json changed = make_image();
        changed[key] = value;
        return refusal(others(make_image(), changed));
    };
    EXPECT_NE(refused("speed", 1).find("#/pictures/1: has the unknown key 'speed'"),
              std::string::npos);
    EXPECT_NE(refused("name", "").find("#/pictures/1/name: "), std::string::npos);
    EXPECT_NE(refused("name", std::string(300, 'a')).find("#/pictures/1/name: "),
              std::string::npos);
    EXPECT_NE(refused("seconds", -1).find("#/pictures/1/seconds: "), std::string::npos);
    EXPECT_NE(refused("seconds", "1").find("#/pictures/1/seconds: "), std::string::npos);
    EXPECT_NE(refused("budget_s", 1e30).find("#/pictures/1/budget_s: "), std::string::npos);
    EXPECT_NE(refused("samples", 1e30).find("#/pictures/1/samples: "), std::string::npos);
    EXPECT_NE(refused("denoised", 0).find("#/pictures/1/denoised: "), std::string::npos);
    EXPECT_NE(refused("picture", 7).find("#/pictures/1/picture: "), std::string::npos);
    EXPECT_NE(refused("picture", "missing.exr").find("missing.exr"), std::string::npos);
    json more = others(make_image());
    more["weft_peers"] = 2;
    EXPECT_NE(refusal(more).find("#/weft_peers: "), std::string::npos);
    more = others(make_image());
    more["extra"] = 1;
    EXPECT_NE(refusal(more).find("unknown key 'extra'"), std::string::npos);
    more = others();
    more["notes"] = std::vector<std::string>(101, "note");
    EXPECT_NE(refusal(more).find("#/notes: "), std::string::npos);
    EXPECT_NE(refusal(others_of(std::vector<json>(1001, make_image()))).find("#/pictures: "),
              std::string::npos);
    for (const json& other : {json(), json::array(), json::object(), json(3)})
        EXPECT_NE(refusal(other), "no failure") << other;
}

TEST_F(OtherRenderersFile, RefusesImagesThatCannotBeCompared) {
    const std::string place = "peers.json#/pictures/1/picture: ";
    const auto refused = [&](const std::string& file, const std::string& why) {
        const std::string message = refusal(others(make_image(), make_image(file)));
        EXPECT_NE(message.find(place), std::string::npos) << message;
        EXPECT_NE(message.find(why), std::string::npos) << message;
        EXPECT_EQ(message.find_first_of("\n\t"), std::string::npos) << message;
    };
    Image small = grey(0.5F);
    small.height = height / 2;
    small.layers[0].values.resize(3 * width * height / 2);
    write_exr(folder_.path() / "small.exr", small);
    refused("small.exr", "names 'small.exr', which is of 24 x 8 pixels, expected 24 x 16");
    for (const float value :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Image broken = grey(0.5F);
        broken.layers[0].values[5] = value;
        write_exr(folder_.path() / "broken.exr", broken);
        refused("broken.exr", "names 'broken.exr', which holds values that are not finite");
    }
    write_exr(folder_.path() / "plane.exr", grey(0.5F, "Y"));
    refused("plane.exr", "names 'plane.exr', which has no channels R, G and B");
    folder_.write("text.exr", "no image");
    refused("text.exr", "text.exr: is not an image");
    refused("missing.exr", "missing.exr: cannot be opened");
    refused("a\nb\t.exr", "is 'a?b?.exr', expected no control characters");
}

TEST_F(OtherRenderersFile, RefusesMorePixelsThanThereIsRoomForWithoutReadingAny) {
    const auto file = folder_.write(
        "peers.json", others_of(std::vector<json>(5, make_image("missing.exr"))).dump());
    const auto message = [&](const FilmSize& size) {
        try {
            (void)read_other_renderers(file, size);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("no failure");
    };
    EXPECT_NE(message({8192, 8192}).find("peers.json#/pictures: has 5 images of 8192 x 8192"),
              std::string::npos);
    EXPECT_NE(message({8192, 6553}).find("missing.exr: cannot be opened"), std::string::npos);
}

}  // namespace
}  // namespace weft::other_renderers_test
