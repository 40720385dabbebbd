// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "denoise/open_image_denoise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "tests/testing/noisy_image.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"

namespace weft::open_image_denoise_test {
namespace {

using test::dark_wall;
using test::shine;
using test::text_of_file;
using test::values_of;

/// Loads the library that stands in for the real one.
class OpenImageDenoiseStub : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        set("WEFT_OIDN_LIBRARY", GetParam());
        set("WEFT_OIDN_STUB_LOG", log().c_str());
    }
    void TearDown() override {
        for (const char* const name :
             {"WEFT_OIDN_LIBRARY", "WEFT_OIDN_STUB_LOG", "WEFT_OIDN_STUB_FAILS"})
            unsetenv(name);
    }

    static void set(const char* name, const char* value) { setenv(name, value, 1); }
    [[nodiscard]] std::string log() const { return folder_.path() / "log"; }
    [[nodiscard]] bool noted(const std::string& line) const {
        return text_of_file(log()).find(line) != std::string::npos;
    }

    TemporaryFolder folder_;
};

/// The message of the failure to load the library, which has to have exit code 3 and one line.
std::string refusal() {
    try {
        const OpenImageDenoise library;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::device);
        const std::string message = error.what();
        EXPECT_EQ(message.find('\n'), std::string::npos);
        return message;
    }
    return "no failure";
}

TEST_P(OpenImageDenoiseStub, GetsColoursAlbedoAndNormalsOfEachPixel) {
    Image wall = dark_wall(3, 2);
    shine(
        wall, [](std::size_t x, std::size_t y) { return 1.0 + static_cast<double>(x + 10 * y); },
        0.0, 1);
    {
        const OpenImageDenoise library;
        EXPECT_EQ(library.version(),
                  std::string(GetParam()).find("_1") != std::string::npos ? "1.9.7" : "2.9.7");
        std::vector<float> expected = values_of(wall, "");
        for (float& value : expected) value *= 0.5F;
        EXPECT_EQ(library.denoised(wall), expected);
    }
    EXPECT_TRUE(noted("device  1\n"));
    EXPECT_TRUE(noted("int numThreads "));
    EXPECT_TRUE(noted("filter RT 0\n"));
    // Light 1, 2, 3, 11, 12 and 13 times 0.5, in three channels.
    EXPECT_TRUE(noted("image color 63\n"));
    EXPECT_TRUE(noted("image albedo 9\n"));
    EXPECT_TRUE(noted("image normal 6\n"));
    EXPECT_TRUE(noted("bool hdr 1\n"));
    EXPECT_TRUE(noted("released filter"));
    EXPECT_TRUE(noted("released device"));
}

TEST_P(OpenImageDenoiseStub, ItsFailuresAreTold) {
    for (const char* const function : {"oidnNewDevice", "oidnCommitDevice"}) {
        set("WEFT_OIDN_STUB_FAILS", function);
        EXPECT_EQ(refusal(), "Open Image Denoise: opening its device failed: told to fail?here");
    }
    for (const char* const function : {"oidnCommitFilter", "oidnExecuteFilter"}) {
        unsetenv("WEFT_OIDN_STUB_FAILS");
        const OpenImageDenoise library;
        set("WEFT_OIDN_STUB_FAILS", function);
        EXPECT_THROW((void)library.denoised(dark_wall(2, 2)), Error) << function;
    }
}

// What tests/CMakeLists.txt builds for this.
INSTANTIATE_TEST_SUITE_P(OpenImageDenoise, OpenImageDenoiseStub,
                         testing::Values(WEFT_OIDN_STUB_1, WEFT_OIDN_STUB_2),
                         [](const auto& version) {
                             return "Version" + std::to_string(version.index + 1);
                         });

TEST(OpenImageDenoise, NamesWhatIsNotThere) {
    const TemporaryFolder folder;
    setenv("WEFT_OIDN_LIBRARY", (folder.path() / "none.so").c_str(), 1);
    const std::string missing = refusal();
    EXPECT_NE(missing.find("none.so"), std::string::npos) << missing;
    EXPECT_NE(missing.find("WEFT_OIDN_LIBRARY"), std::string::npos) << missing;
    // The C++ library is one, but not that one.
    setenv("WEFT_OIDN_LIBRARY", "libstdc++.so.6", 1);
    EXPECT_EQ(refusal(),
              "Open Image Denoise: the library has no oidnNewDevice, expected version 1 or 2");
    unsetenv("WEFT_OIDN_LIBRARY");
}

TEST(OpenImageDenoise, TheRealOneRemovesNoise) {
    std::optional<OpenImageDenoise> library;
    try {
        library.emplace();
    } catch (const Error& error) {
        GTEST_SKIP() << error.what();
    }
    constexpr std::uint32_t edge = 64;
    Image wall = dark_wall(edge, edge);
    shine(
        wall, [](std::size_t, std::size_t) { return 1.0; }, 0.2, 2);
    double before = 0.0;
    double after = 0.0;
    const std::vector<float> result = library->denoised(wall);
    for (std::size_t at = 0; at < result.size(); ++at) {
        before += std::pow(values_of(wall, "")[at] - 0.5, 2);
        after += std::pow(result[at] - 0.5, 2);
    }
    EXPECT_LT(after, 0.1 * before);
}

}  // namespace
}  // namespace weft::open_image_denoise_test
