// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/png.h"

#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"

namespace weft::png_test {
namespace {

namespace fs = std::filesystem;

class Png : public testing::Test {
  protected:
    Png() : folder_(fs::path(testing::TempDir()) / ("weft_png_" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
    }
    ~Png() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }

    /// Writes the image and reads its 8-bit values back.
    [[nodiscard]] std::vector<png_byte> round_trip(const Image& image, double exposure_ev) const {
        write_png(file("a.png"), image, exposure_ev);
        png_image png{};
        png.version = PNG_IMAGE_VERSION;
        if (png_image_begin_read_from_file(&png, file("a.png").c_str()) == 0) return {};
        EXPECT_EQ(png.width, image.width);
        EXPECT_EQ(png.height, image.height);
        EXPECT_EQ(png.format, png_uint_32{PNG_FORMAT_RGB});
        std::vector<png_byte> bytes(PNG_IMAGE_SIZE(png));
        if (png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr) == 0) return {};
        return bytes;
    }

  private:
    fs::path folder_;
};

Image make_image(std::uint32_t width, std::uint32_t height, const std::string& channels,
                 float value) {
    Image image;
    image.width = width;
    image.height = height;
    image.layers = {
        {"", channels, std::vector<float>(std::size_t{width} * height * channels.size(), value)}};
    return image;
}

double srgb_decode(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

std::string slurp(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

ExitCode write_code(const fs::path& path, const Image& image) {
    try {
        write_png(path, image, 0.0);
    } catch (const Error& error) {
        return error.code();
    }
    return ExitCode::success;
}

TEST_F(Png, KeepsAllCodesThatEightBitsHold) {
    Image image = make_image(256, 9, "RGB", 0.0f);
    for (std::size_t i = 0; i < image.layers[0].values.size(); ++i)
        image.layers[0].values[i] =
            static_cast<float>(srgb_decode(static_cast<double>(i % 256) / 255.0));
    const std::vector<png_byte> bytes = round_trip(image, 0.0);
    ASSERT_EQ(bytes.size(), 256u * 9 * 3);
    for (std::size_t i = 0; i < bytes.size(); ++i) ASSERT_EQ(bytes[i], (i / 3) % 256) << "at " << i;
}

TEST_F(Png, DitherKeepsTheMeanOfAConstant) {
    for (const double code : {0.25, 100.5, 200.8125, 254.75}) {
        const auto linear = static_cast<float>(srgb_decode(code / 255.0));
        const std::vector<png_byte> bytes = round_trip(make_image(16, 16, "Y", linear), 0.0);
        ASSERT_EQ(bytes.size(), 16u * 16 * 3);
        double sum = 0.0;
        for (const png_byte byte : bytes) sum += byte;
        EXPECT_NEAR(sum / static_cast<double>(bytes.size()), code, 0.5 / 64 + 1e-3);
    }
}

TEST_F(Png, PlanesAndRowsKeepTheirPlace) {
    Image image = make_image(3, 2, "RGB", 0.0f);
    image.layers[0].values[0 * 6 + 2] = 1.0f;  // red, top right
    image.layers[0].values[1 * 6 + 3] = 1.0f;  // green, bottom left
    image.layers[0].values[2 * 6 + 4] = 1.0f;  // blue, bottom centre
    const std::vector<png_byte> expected = {0, 0,   0, 0, 0, 0,   255, 0, 0,
                                            0, 255, 0, 0, 0, 255, 0,   0, 0};
    EXPECT_EQ(round_trip(image, 0.0), expected);
}

TEST_F(Png, ExposureScalesAndExtremesClamp) {
    const auto first = [&](float value, double exposure) {
        const std::vector<png_byte> bytes = round_trip(make_image(1, 1, "RGB", value), exposure);
        return bytes.empty() ? -1 : int{bytes[0]};
    };
    EXPECT_EQ(first(0.25f, 2.0), 255);
    EXPECT_EQ(first(static_cast<float>(8.0 * srgb_decode(188 / 255.0)), -3.0), 188);
    EXPECT_EQ(first(1e30f, 0.0), 255);
    EXPECT_EQ(first(-1.0f, 0.0), 0);
    EXPECT_EQ(first(std::numeric_limits<float>::infinity(), 0.0), 255);
    EXPECT_EQ(first(std::numeric_limits<float>::quiet_NaN(), 0.0), 0);
}

TEST_F(Png, CarriesColourSpaceAndText) {
    Image image = make_image(4, 4, "RGB", 0.5f);
    image.metadata = {{"Software", "Weft"}, {"Title", "caf\xc3\xa9"}};
    write_png(file("a.png"), image, 0.0);
    const std::string bytes = slurp(file("a.png"));
    EXPECT_NE(bytes.find("sRGB"), std::string::npos);
    EXPECT_NE(bytes.find("gAMA"), std::string::npos);
    EXPECT_NE(bytes.find(std::string("tEXtSoftware\0Weft", 17)), std::string::npos);
    EXPECT_NE(bytes.find(std::string("iTXtTitle\0\0\0\0\0caf\xc3\xa9", 19)), std::string::npos);
    write_png(file("b.png"), image, 0.0);
    EXPECT_EQ(bytes, slurp(file("b.png"))) << "the same image gives the same bytes";
}

TEST_F(Png, FailuresKeepTheOldFile) {
    const Image small = make_image(4, 4, "RGB", 0.5f);
    write_png(file("a.png"), small, 0.0);
    const std::string before = slurp(file("a.png"));
    Image noise = make_image(128, 128, "RGB", 0.0f);
    for (std::size_t i = 0; i < noise.layers[0].values.size(); ++i)
        noise.layers[0].values[i] = static_cast<float>(i * 2654435761u % 1000003) / 1000003.0f;
    write_png(file("b.png"), noise, 0.0);
    const auto complete = static_cast<rlim_t>(fs::file_size(file("b.png")));

    rlimit old_limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    for (const rlim_t bytes : {rlim_t{0}, complete / 2, complete - 1}) {
        const rlimit limit{bytes, old_limit.rlim_max};
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
        const ExitCode code = write_code(file("a.png"), noise);
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old_limit), 0);
        EXPECT_EQ(code, ExitCode::output) << bytes;
        EXPECT_EQ(slurp(file("a.png")), before) << bytes;
    }
    std::signal(SIGXFSZ, old_handler);

    Image unusable = small;
    unusable.metadata[""] = "a text without a name";
    EXPECT_EQ(write_code(file("a.png"), unusable), ExitCode::output);
    EXPECT_EQ(slurp(file("a.png")), before);
}

TEST_F(Png, RefusesWhatItCannotWrite) {
    EXPECT_EQ(write_code(file("missing/a.png"), make_image(2, 2, "RGB", 0.5f)), ExitCode::output);
    EXPECT_EQ(write_code("/dev/full", make_image(2, 2, "RGB", 0.5f)), ExitCode::output);
    EXPECT_EQ(write_code(file("a.png"), make_image(0, 2, "RGB", 0.5f)), ExitCode::output);
    EXPECT_EQ(write_code(file("a.png"), make_image(2, 2, "XYZ", 0.5f)), ExitCode::output);
    Image wrong_size = make_image(2, 2, "RGB", 0.5f);
    wrong_size.layers[0].values.pop_back();
    EXPECT_EQ(write_code(file("a.png"), wrong_size), ExitCode::output);
    EXPECT_FALSE(fs::exists(file("a.png")));
}

TEST(PngAutoExposure, PutsTheLogAverageAtMiddleGrey) {
    EXPECT_NEAR(auto_exposure(make_image(8, 8, "RGB", 0.18f)), 0.0, 1e-6);
    EXPECT_NEAR(auto_exposure(make_image(8, 8, "RGB", 0.045f)), 2.0, 1e-6);
    EXPECT_NEAR(auto_exposure(make_image(8, 8, "Y", 720.0f)), std::log2(0.18 / 720.0), 1e-5);
    Image two = make_image(2, 1, "Y", 0.0f);
    two.layers[0].values = {0.01f, 0.04f};
    EXPECT_NEAR(auto_exposure(two), std::log2(0.18 / 0.02), 1e-5);
}

TEST(PngAutoExposure, IgnoresBlackAndNonFinitePixels) {
    EXPECT_EQ(auto_exposure(make_image(8, 8, "RGB", 0.0f)), 0.0);
    EXPECT_EQ(auto_exposure(make_image(0, 0, "RGB", 0.0f)), 0.0);
    Image image = make_image(5, 1, "Y", 0.0f);
    image.layers[0].values = {0.09f, 0.0f, -4.0f, std::numeric_limits<float>::quiet_NaN(),
                              std::numeric_limits<float>::infinity()};
    EXPECT_NEAR(auto_exposure(image), 1.0, 1e-6);
    image.layers[0].values = {0.09f, 0.09f, 0.09f, 0.09f, 1e-30f};
    EXPECT_NEAR(auto_exposure(image), 1.0, 1e-6);
}

TEST(PngAutoExposure, JudgesWhatIsLitNotTheLamp) {
    // A tenth of the pixels are lit to 0.045; the others are lamps or sky.
    Image image = make_image(100, 1, "RGB", 0.5f);
    Layer emission{"emission", "RGB", std::vector<float>(300, 0.5f)};
    const auto set = [](Layer& layer, std::size_t pixel, float value) {
        for (const std::size_t c : {0, 100, 200}) layer.values[c + pixel] = value;
    };
    for (std::size_t i = 0; i < 10; ++i) {
        set(image.layers[0], i, 0.045f);
        set(emission, i, 0.0f);
    }
    const double all = auto_exposure(image);
    EXPECT_LT(all, 0.0);
    image.layers.push_back(emission);
    EXPECT_NEAR(auto_exposure(image), 1.0, 1e-5) << "up to where the lamps are white";
    for (std::size_t i = 10; i < 100; ++i) set(image.layers[0], i, 0.1f);
    for (std::size_t i = 10; i < 100; ++i) set(image.layers[1], i, 0.1f);
    EXPECT_NEAR(auto_exposure(image), 2.0, 1e-5) << "what is lit comes to middle grey";
    // Where next to nothing is lit, the lamps are all there is to see.
    for (std::size_t i = 0; i < 10; ++i) set(image.layers[0], i, 0.1f);
    for (std::size_t i = 0; i < 10; ++i) set(image.layers[1], i, 0.1f);
    EXPECT_NEAR(auto_exposure(image), std::log2(0.18 / 0.1), 1e-5);
}

TEST(PngAutoExposure, ProtectsHighlightsByAtMostTwoStops) {
    // 80 dark pixels and 20 bright ones: log-average 2^-6 * 2^(0.2 * s) for a bright value 2^(s-6).
    const auto exposure = [](float bright) {
        Image image = make_image(100, 1, "Y", 0x1p-6f);
        for (std::size_t i = 0; i < 20; ++i) image.layers[0].values[i * 5] = bright;
        return auto_exposure(image);
    };
    const double key_of_one = std::log2(0.18) + 6.0 - 0.2 * 6.0;
    EXPECT_NEAR(exposure(1.0f), key_of_one - 2.0, 1e-5) << "full protection";
    const double key_of_eighth = std::log2(0.18) + 6.0 - 0.2 * 3.0;
    EXPECT_GT(key_of_eighth, 2.9);
    EXPECT_NEAR(exposure(0.25f), 2.0, 1e-5) << "the 95th percentile lands on white";
    EXPECT_NEAR(exposure(0.125f), key_of_eighth, 1e-5) << "no need of protection";
}

}  // namespace
}  // namespace weft::png_test
