// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_page.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "tradeoff/thumbnail.h"

namespace weft::tradeoff_page_test {
namespace {

Image grey(std::uint32_t width, std::uint32_t height, float value) {
    Image image;
    image.width = width;
    image.height = height;
    image.layers = {{"", "RGB", std::vector<float>(std::size_t{3} * width * height, value)}};
    return image;
}

TradeoffPoint point_of(const std::string& name, double ms, double error, bool on_front) {
    TradeoffPoint point;
    point.name = name;
    point.family = name.substr(0, name.find(' '));
    point.ms = {ms, 0.9 * ms, 1.1 * ms};
    point.errors.assign(error_measures, {error, 0.95 * error, 1.05 * error});
    point.rays = 1234567;
    point.on_front = on_front;
    if (on_front) {
        point.image = grey(8, 4, 0.5F);
        point.error_map.assign(32, static_cast<float>(error));
    }
    return point;
}

TradeoffResult made_up() {
    TradeoffResult result;
    result.scene = "nave.gltf";
    result.scene_path = "scenes/nave.gltf";
    result.folder = "out";
    result.width = 8;
    result.height = 4;
    result.repetitions = 3;
    result.machine = {{"processor", "four cores"}, {"versions", {{"weft", "1"}}}};
    result.image_options = " --size 64x48";
    result.command = "weft tradeoff nave.gltf";
    result.reference = {.samples = 1024,
                        .noise_floor = std::vector<double>(error_measures, 0.001),
                        .image = grey(8, 4, 0.5F)};
    result.points = {point_of("ais 1", 10.0, 0.4, true), point_of("igi 1", 20.0, 0.5, false),
                     point_of("ais 2", 100.0, 0.1, true), point_of("path 1", 2000.0, 0.02, true)};
    result.time_spread = {.factor = 1.25, .degrees = 10.0, .deviations = 1200};
    result.advice = {{300.0, {}, 2, "For 300 ms the best is ais 2.", "300ms.json"}};
    for (const double budget : {0.3, 3.0})
        result.others.push_back({.name = "other",
                                 .budget_s = budget,
                                 .seconds = budget,
                                 .samples = 7.0,
                                 .denoised = budget > 1.0,
                                 .errors = std::vector<double>(error_measures, 0.2 / budget),
                                 .image = grey(8, 4, 0.25F)});
    result.other_notes = {"one more is not installed"};
    return result;
}

/// A page as a program that shows it reads it.
class Page {
  public:
    explicit Page(const TradeoffResult& result) : text_(tradeoff_page(result)) {
        const pugi::xml_parse_result parsed =
            xml_.load_buffer(text_.data(), text_.size(), pugi::parse_default | pugi::parse_doctype,
                             pugi::encoding_utf8);
        EXPECT_TRUE(parsed) << parsed.description() << " at " << parsed.offset;
    }
    [[nodiscard]] std::size_t count(const std::string& path) const {
        return xml_.select_nodes(path.c_str()).size();
    }
    [[nodiscard]] bool holds(const std::string& text) const {
        return text_.find(text) != std::string::npos;
    }
    [[nodiscard]] const std::string& text() const { return text_; }
    [[nodiscard]] const pugi::xml_document& xml() const { return xml_; }

  private:
    std::string text_;
    pugi::xml_document xml_;
};

/// Elements of a table that is known by its caption.
std::string in_table(const std::string& caption, const std::string& path) {
    return "//table[caption='" + caption + "']" + path;
}

TEST(TradeoffPage, ShowsEveryPoint) {
    const TradeoffResult result = made_up();
    const Page page(result);
    for (const TradeoffPoint& point : result.points) {
        const std::string row = "/tbody/tr[th='" + point.name + "']";
        EXPECT_EQ(page.count(in_table("Pareto front by rising time", row)),
                  point.on_front ? 1U : 0U);
        EXPECT_EQ(page.count(in_table("All settings by rising time", row)), 1U);
        EXPECT_EQ(page.count("//g[starts-with(title, '" + point.name + ":')]"), error_measures)
            << "a point in every plot";
    }
    EXPECT_EQ(page.count("//svg[@class='plot']"), error_measures);
    EXPECT_TRUE(
        page.holds("weft render scenes/nave.gltf --preset out/300ms.json --size 64x48 -o out.exr"));
    EXPECT_TRUE(page.holds("For 300 ms the best is ais 2."));
    EXPECT_TRUE(page.holds("four cores"));
    EXPECT_TRUE(page.holds("divided and multiplied by 1.25, which the deviations of all "));
    EXPECT_EQ(page.text(), tradeoff_page(result));
}

TEST(TradeoffPage, SetsTheBestOfTheSameTimeBesideOthers) {
    const Page page(made_up());
    const std::string best = "/tbody/tr[@class='weft']";
    EXPECT_EQ(page.count(in_table("In 0.3 s", best + "[th='Weft: ais 2']")), 1U);
    EXPECT_EQ(page.count(in_table("In 0.3 s", best + "[1][preceding-sibling::tr]")), 0U)
        << "0.1 is below 0.2 / 0.3";
    EXPECT_EQ(page.count(in_table("In 3 s", best + "[th='Weft: path 1']")), 1U);
    EXPECT_EQ(page.count(in_table("In 3 s", "/tbody/tr[td='denoised']")), 1U);
    EXPECT_TRUE(page.holds("one more is not installed"));
    TradeoffResult slow = made_up();
    slow.others[0].budget_s = 0.001;
    EXPECT_TRUE(Page(slow).holds("No setting of the front is that fast."));
    TradeoffResult unsteady = made_up();
    for (TradeoffPoint& point : unsteady.points) point.ms.high = 10.0 * point.ms.median;
    unsteady.others[0].budget_s = 0.011;
    const Page page_of_unsteady(unsteady);
    EXPECT_TRUE(
        page_of_unsteady.holds("No setting of the front is certain enough to keep to that."));
    EXPECT_FALSE(page_of_unsteady.holds("No setting of the front is that fast."));
}

TEST(TradeoffPage, SaysWhatTheNoiseOfTheReferenceHides) {
    TradeoffResult result = made_up();
    result.points[2].unbiased_relmse = ErrorEstimate{0.25, -0.125, 0.625};
    const Page clear(result);
    const std::string row = "/tbody/tr[th='ais 2']";
    EXPECT_EQ(
        clear.count(in_table("Pareto front by rising time", row + "/td[small='-0.125 to 0.625']")),
        1U);
    EXPECT_EQ(clear.count("//th[.='unbiased relMSE']"), 4U) << "in the tables of each kind";
    EXPECT_TRUE(clear.holds("No setting is within the floor, HDR-FLIP 0.00100"));
    EXPECT_FALSE(clear.holds("The reference has too much noise"));
    result.reference.noise_floor.assign(error_measures, 0.1);
    result.reference.noise_relmse = 0.1;
    const Page noisy(result);
    EXPECT_TRUE(noisy.holds("where comparing says nothing: ais 2, path 1."));
    EXPECT_TRUE(noisy.holds("The reference has too much noise"));
    result.reference.noise_floor.clear();
    EXPECT_FALSE(Page(result).holds("within the floor"));
}

TEST(TradeoffPage, NeedsNothingElse) {
    const Page page(made_up());
    EXPECT_EQ(page.count("//script | //link | //iframe | //object | //embed | //*[@src]"), 0U);
    std::size_t references = 0;
    for (const pugi::xpath_node& found : page.xml().select_nodes("//@href")) {
        const std::string target = found.attribute().value();
        const bool inside = target.starts_with("data:image/png;base64,");
        EXPECT_TRUE(inside || target.starts_with("#")) << target;
        if (target.starts_with("#")) {
            EXPECT_EQ(page.count("//*[@id='" + target.substr(1) + "']"), 1U) << target;
        }
        ++references;
    }
    EXPECT_GT(references, 8U);
    for (std::size_t at = page.text().find("://"); at != std::string::npos;
         at = page.text().find("://", at + 1))
        EXPECT_EQ(page.text().substr(at, 13), "://www.w3.org") << "a name of a vocabulary";
    EXPECT_FALSE(page.holds("url("));
    EXPECT_FALSE(page.holds("@import"));
}

TEST(TradeoffPage, TakesNamesAsText) {
    const std::string hostile = "<script>alert(1)</script>\"'&]]>\xFF\x01";
    TradeoffResult result = made_up();
    result.scene = result.command = result.points[0].name = result.points[0].family = hostile;
    result.others[0].name = result.other_notes[0] = result.advice[0].sentence = hostile;
    result.advice[0].preset_file = hostile;
    result.machine = {{hostile, hostile}, {"object", {{hostile, {hostile}}}}};
    result.skipped = {hostile};
    result.check = FrontCheck{.points = {}, .images = 30, .times_within = 28, .errors_within = 29};
    const Page page(result);
    EXPECT_EQ(page.count("//script"), 0U);
    EXPECT_FALSE(page.holds("<script"));
    EXPECT_EQ(page.count("//h1"), 1U);
    EXPECT_TRUE(page.holds("Too slow to be measured: &lt;script&gt;"));
    EXPECT_TRUE(page.holds("of 30 images 28 kept to the interval of their setting's time, and 29"));
    EXPECT_TRUE(page.holds("&lt;script&gt;alert(1)&lt;/script&gt;&quot;&#39;&amp;]]&gt;"));
}

TEST(TradeoffPage, ShowsNoNumbersThatAreNone) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double nan = std::nan("");
    TradeoffResult result = made_up();
    result.exposure_ev = nan;
    result.points[0].ms = {nan, nan, nan};
    result.points[0].errors.assign(error_measures, {infinity, nan, infinity});
    result.points[0].error_map.assign(32, std::numeric_limits<float>::infinity());
    result.points[0].image = grey(8, 4, std::numeric_limits<float>::quiet_NaN());
    result.points[2].errors.clear();
    result.reference.noise_floor.assign(error_measures, nan);
    result.others[0].seconds = result.others[0].budget_s = infinity;
    result.others[1].samples = nan;
    result.machine["number"] = nan;
    const Page page(result);
    for (const char* path : {"//td", "//th", "//p", "//text", "//title", "//caption", "//@*"})
        for (const pugi::xpath_node& found : page.xml().select_nodes(path)) {
            const std::string text =
                found.attribute() ? found.attribute().value() : found.node().text().get();
            if (text.starts_with("data:")) continue;
            for (const char* bad : {"nan", "inf", "NaN", "Inf"})
                EXPECT_EQ(text.find(bad), std::string::npos) << text;
        }
}

TEST(TradeoffPage, WorksWithNothing) {
    const Page page(TradeoffResult{});
    EXPECT_EQ(page.count("//svg[@class='plot']"), error_measures);
    EXPECT_EQ(page.count("//image"), 0U);
    EXPECT_EQ(page.count("//h2[.='In the same time']"), 0U);
    TradeoffResult bare = made_up();
    for (TradeoffPoint& point : bare.points) {
        point.image = {};
        point.error_map.clear();
    }
    bare.reference = {};
    EXPECT_EQ(Page(bare).count("//span[.='no image']"), 9U) << "three each of the front";
}

TEST(TradeoffPage, ThumbnailsAreMeansOfWhatTheyCover) {
    Image image = grey(3, 1, 0.0F);
    image.layers[0].values = {3.0F, 6.0F, 9.0F, 0.0F, 0.0F, 3.0F, 1.0F, 1.0F, 1.0F};
    const Image two = scaled_down(image, 2);
    ASSERT_EQ(two.width, 2U);
    ASSERT_EQ(two.height, 1U);
    const std::vector<float> expected = {4.0F, 8.0F, 0.0F, 2.0F, 1.0F, 1.0F};
    for (std::size_t i = 0; i < expected.size(); ++i)
        EXPECT_NEAR(two.layers[0].values[i], expected[i], 1e-6);
    const Image wide = scaled_down(grey(1000, 3, 0.5F), thumbnail_edge);
    EXPECT_EQ(wide.width, thumbnail_edge);
    EXPECT_EQ(wide.height, 1U);
    for (const float value : wide.layers[0].values) EXPECT_NEAR(value, 0.5F, 1e-6);
    EXPECT_EQ(scaled_down(image, 192).layers[0].values, image.layers[0].values);
    image.layers[0].values.pop_back();
    EXPECT_TRUE(scaled_down(image, 2).layers.empty());
}

TEST(TradeoffPage, MapsShareARoundScale) {
    const Image low = scaled_map(std::vector<float>(200, 0.013F), 20, 10, 192);
    const Image high = scaled_map(std::vector<float>(200, 0.3F), 20, 10, 192);
    EXPECT_DOUBLE_EQ(map_scale(std::vector{low}), 0.02);
    EXPECT_DOUBLE_EQ(map_scale(std::vector{low, high}), 0.5);
    EXPECT_EQ(map_scale({}), 1.0);
    EXPECT_EQ(map_scale(std::vector{scaled_map(std::vector<float>(4, 0.0F), 2, 2, 192)}), 1.0);
}

}  // namespace
}  // namespace weft::tradeoff_page_test
