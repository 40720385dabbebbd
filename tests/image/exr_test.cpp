// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>
#include <half.h>
#include <sys/resource.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/limits.h"

namespace weft::exr_test {
namespace {

namespace fs = std::filesystem;

class Exr : public testing::Test {
  protected:
    Exr() : folder_(fs::path(testing::TempDir()) / ("weft_exr_" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
    }
    ~Exr() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }

    [[nodiscard]] std::size_t files_in_folder() const {
        return static_cast<std::size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

  private:
    fs::path folder_;
};

std::vector<float> ramp(std::size_t count, float first) {
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = first + 0.1f * static_cast<float>(i);
    return values;
}

Image sample_image() {
    Image image;
    image.width = 7;
    image.height = 5;
    image.layers = {{"", "RGB", ramp(105, 0.0f)},
                    {"direct", "RGB", ramp(105, 1e6f)},
                    {"normal", "XYZ", ramp(105, -5.0f)},
                    {"depth", "Z", ramp(35, 1e-30f)}};
    image.metadata = {{"weft:algorithm", "igi"}, {"comments", "two words"}};
    return image;
}

std::string slurp(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void spill(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// The exit code read_exr fails with; success where it does not.
ExitCode read_code(const fs::path& path) {
    try {
        static_cast<void>(read_exr(path));
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.code();
    }
    return ExitCode::success;
}

// What images of other programs hold at pixel i.
float lossy_value(std::size_t i) {
    return 0.5f + 0.25f * std::sin(static_cast<float>(i % 37) * 0.1f);
}

std::uint32_t lossy_word(std::size_t i) {
    return static_cast<std::uint32_t>(i) * 2654435761u;
}

/// Writes a smooth image of halves and floats, and a plane of integers, as other programs do.
void write_with(const fs::path& path, Imf::Header header) {
    const Imath::V2i size = header.dataWindow().size() + Imath::V2i(1);
    const auto width = static_cast<std::size_t>(size.x);
    const std::size_t pixels = width * static_cast<std::size_t>(size.y);
    std::vector<half> halves(pixels);
    std::vector<float> floats(pixels);
    std::vector<std::uint32_t> words(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        halves[i] = half(lossy_value(i));
        floats[i] = lossy_value(i);
        words[i] = lossy_word(i);
    }
    Imf::FrameBuffer frame;
    const auto add = [&](const char* name, Imf::PixelType type, auto& values) {
        header.channels().insert(name, Imf::Channel(type));
        frame.insert(name, Imf::Slice(type, reinterpret_cast<char*>(values.data()),
                                      sizeof(values[0]), width * sizeof(values[0])));
    };
    for (const char* name : {"R", "G", "B"}) add(name, Imf::HALF, halves);
    add("depth.Z", Imf::FLOAT, floats);
    add("weft.sums.00.Y", Imf::UINT, words);
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(size.y);
}

ExitCode write_code(const fs::path& path, const Image& image) {
    try {
        write_exr(path, image);
    } catch (const Error& error) {
        return error.code();
    }
    return ExitCode::success;
}

TEST_F(Exr, KeepsEveryLayerBitForBit) {
    Image image = sample_image();
    image.layers[3].values[3] = std::numeric_limits<float>::denorm_min();
    image.layers[3].values[4] = std::numeric_limits<float>::max();
    write_exr(file("a.exr"), image);
    const Image read = read_exr(file("a.exr"));
    EXPECT_EQ(read.width, image.width);
    EXPECT_EQ(read.height, image.height);
    EXPECT_EQ(read.layers.size(), image.layers.size());
    for (const Layer& layer : image.layers) {
        const Layer* found = read.find(layer.name);
        ASSERT_NE(found, nullptr) << layer.name;
        EXPECT_EQ(found->channels, layer.channels);
        ASSERT_EQ(found->values.size(), layer.values.size());
        for (std::size_t i = 0; i < layer.values.size(); ++i)
            EXPECT_EQ(std::bit_cast<std::uint32_t>(found->values[i]),
                      std::bit_cast<std::uint32_t>(layer.values[i]))
                << layer.name << " " << i;
    }
    for (const auto& [key, value] : image.metadata) EXPECT_EQ(read.metadata.at(key), value);
}

TEST_F(Exr, HalfLayersAreRoundedToNearestAndStayFinite) {
    Image image = sample_image();
    image.layers[1].half = true;
    image.layers[2].half = true;
    image.layers[2].values[0] = 1.0F + 0x1p-11F + 0x1p-20F;
    image.layers[2].values[1] = -1e9F;
    write_exr(file("a.exr"), image);
    const Image read = read_exr(file("a.exr"));
    EXPECT_EQ(read.find("normal")->values[0], 1.0F + 0x1p-10F);
    EXPECT_EQ(read.find("normal")->values[1], -65504.0F);
    for (std::size_t i = 2; i < 105; ++i)
        EXPECT_NEAR(read.find("normal")->values[i], image.layers[2].values[i],
                    0x1p-11F * std::abs(image.layers[2].values[i]));
    for (const float value : read.find("direct")->values) EXPECT_EQ(value, 65504.0F);
    EXPECT_EQ(read.find("")->values, image.layers[0].values);
    EXPECT_EQ(read.find("depth")->values, image.layers[3].values);
}

TEST_F(Exr, SumsAreZipped) {
    Image image = sample_image();
    image.layers.push_back({std::string(word_layer_prefix) + ".00", "Y", ramp(35, 0.0F), true});
    write_exr(file("a.exr"), image);
    const std::string compression("compression\0compression\0\1\0\0\0\3", 29);
    EXPECT_NE(slurp(file("a.exr")).find(compression), std::string::npos);
}

TEST_F(Exr, WritesChannelsOfTheirTypesWithRleAndPlainBeautyNames) {
    Image image = sample_image();
    image.layers[2].half = true;
    write_exr(file("a.exr"), image);
    const std::string bytes = slurp(file("a.exr"));
    const std::string channels = bytes.substr(bytes.find("chlist") + 11, 300);
    const auto type_of = [&](const std::string& name) {
        const std::string entry = std::string(1, '\0') + name + '\0';
        const std::size_t at = ('\0' + channels).find(entry);
        return at == std::string::npos ? -1 : int{channels[at + entry.size() - 1]};
    };
    constexpr int half_type = 1;
    constexpr int float_type = 2;
    for (const char* name : {"B", "G", "R", "depth.Z", "direct.R"})
        EXPECT_EQ(type_of(name), float_type) << name;
    EXPECT_EQ(type_of("normal.X"), half_type);
    EXPECT_EQ(type_of("beauty.R"), -1);
    const std::string compression("compression\0compression\0\1\0\0\0\1", 29);
    EXPECT_NE(bytes.find(compression), std::string::npos);
    const std::string red_x("chromaticities\0chromaticities\0\x20\0\0\0\x0a\xd7\x23\x3f", 38);
    EXPECT_NE(bytes.find(red_x), std::string::npos) << "red primary at x = 0.64";
}

TEST_F(Exr, RefusesImagesThatDoNotAddUp) {
    std::vector<Image> wrong(6, sample_image());
    wrong[0].layers[1].values.pop_back();
    wrong[1].height = 0;
    wrong[2].layers[2].name = "direct";
    wrong[2].layers[2].channels = "RGB";
    wrong[3].width = limits::max_film_edge + 1;
    wrong[4].metadata["compression"] = "best";
    wrong[5].layers.clear();
    for (std::size_t i = 0; i < wrong.size(); ++i) {
        EXPECT_EQ(write_code(file("a.exr"), wrong[i]), ExitCode::output) << i;
        EXPECT_EQ(files_in_folder(), 0u) << i;
    }
}

TEST_F(Exr, MissingFolderAndDevicesAreOutputErrors) {
    EXPECT_EQ(write_code(file("missing/a.exr"), sample_image()), ExitCode::output);
    EXPECT_EQ(write_code("/dev/full", sample_image()), ExitCode::output);
    EXPECT_EQ(write_code(file(""), sample_image()), ExitCode::output);
}

TEST_F(Exr, FullDiskKeepsTheOldFile) {
    write_exr(file("a.exr"), sample_image());
    const std::string before = slurp(file("a.exr"));
    Image large = sample_image();
    large.width = 64;
    large.height = 64;
    large.layers = {{"", "RGB", ramp(64 * 64 * 3, 0.0f)}};
    write_exr(file("b.exr"), large);
    const auto complete = static_cast<rlim_t>(fs::file_size(file("b.exr")));

    rlimit old_limit{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
    const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
    // One byte short fails when the stream is flushed, the others in the middle of the pixels.
    for (const rlim_t bytes : {rlim_t{0}, rlim_t{1000}, complete / 2, complete - 1}) {
        const rlimit limit{bytes, old_limit.rlim_max};
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
        const ExitCode code = write_code(file("a.exr"), large);
        ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old_limit), 0);
        EXPECT_EQ(code, ExitCode::output) << bytes;
        EXPECT_EQ(slurp(file("a.exr")), before) << bytes;
        EXPECT_EQ(files_in_folder(), 2u) << bytes;
    }
    std::signal(SIGXFSZ, old_handler);
}

TEST_F(Exr, CutFilesAreErrors) {
    write_exr(file("a.exr"), sample_image());
    const std::string bytes = slurp(file("a.exr"));
    std::vector<std::size_t> lengths = {bytes.size() - 1};
    for (std::size_t length = 0; length < bytes.size(); length += 11) lengths.push_back(length);
    for (const std::size_t length : lengths) {
        spill(file("cut.exr"), bytes.substr(0, length));
        EXPECT_EQ(read_code(file("cut.exr")), ExitCode::bad_input) << length;
    }
}

TEST_F(Exr, FlippedBytesLoadOrThrow) {
    write_exr(file("a.exr"), sample_image());
    const std::string bytes = slurp(file("a.exr"));
    constexpr char flips[] = {'\x01', '\x80', '\xff'};
    for (std::size_t at = 0; at < bytes.size(); at += 2) {
        std::string damaged = bytes;
        damaged[at] = static_cast<char>(damaged[at] ^ flips[at % 3]);
        spill(file("damaged.exr"), damaged);
        const ExitCode code = read_code(file("damaged.exr"));
        EXPECT_TRUE(code == ExitCode::success || code == ExitCode::bad_input) << at;
    }
}

TEST_F(Exr, RefusesHugeAndUnsupportedHeaders) {
    write_exr(file("a.exr"), sample_image());
    const std::string good = slurp(file("a.exr"));
    const std::size_t window = good.find("box2i", good.find("dataWindow")) + 10;
    const auto patched = [&](std::size_t at, const std::string& bytes) {
        std::string result = good;
        spill(file("patched.exr"), result.replace(at, bytes.size(), bytes));
        return read_code(file("patched.exr"));
    };
    EXPECT_EQ(patched(0, good.substr(0, 1)), ExitCode::success);
    EXPECT_EQ(patched(window + 8, std::string("\xff\xff\xff\x7f", 4)), ExitCode::bad_input);
    EXPECT_EQ(patched(window + 8, std::string("\0\0\1\0", 4)), ExitCode::bad_input);
    EXPECT_EQ(patched(window, std::string("\0\0\0\x80", 4)), ExitCode::bad_input);
    // 32768 x 7168 pixels are within the limits, but no file of this length can hold them.
    EXPECT_EQ(patched(window + 8, std::string("\xff\x7f\0\0\xff\x1b\0\0", 8)), ExitCode::bad_input);
    EXPECT_EQ(patched(5, std::string(1, '\x02')), ExitCode::bad_input) << "tiled";
    EXPECT_EQ(patched(5, std::string(1, '\x08')), ExitCode::bad_input) << "deep";
    EXPECT_EQ(patched(5, std::string(1, '\x10')), ExitCode::bad_input) << "several parts";
    EXPECT_EQ(patched(good.find("compression") + 28, std::string(1, '\x0a')), ExitCode::bad_input);
}

// Some programs name the type of a file that has a single part, too.
TEST_F(Exr, ReadsSinglePartsThatNameTheirType) {
    Imf::Header header(6, 4);
    header.setType("scanlineimage");
    header.setName("beauty");
    write_with(file("typed.exr"), header);
    const std::string good = slurp(file("typed.exr"));
    const std::size_t type = good.find("scanlineimage");
    ASSERT_NE(type, std::string::npos);
    EXPECT_EQ(read_exr(file("typed.exr")).layers.size(), 3u);
    for (const char* other : {"tiledimage\0\0\0", "deepscanline\0", "scanlineimagE"}) {
        std::string bytes = good;
        spill(file("other.exr"), bytes.replace(type, 13, other, 13));
        EXPECT_EQ(read_code(file("other.exr")), ExitCode::bad_input) << other;
    }
}

// The words of sums must not change in files that other programs have saved again.
TEST_F(Exr, ReadsLossyCompressionsOfOtherPrograms) {
    for (const Imf::Compression compression :
         {Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION,
          Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
        SCOPED_TRACE(compression);
        Imf::Header header(37, 43);
        header.compression() = compression;
        write_with(file("lossy.exr"), header);
        const Image image = read_exr(file("lossy.exr"));
        ASSERT_EQ(image.layers.size(), 3u);
        for (const Layer& layer : image.layers) {
            ASSERT_EQ(layer.values.size(), layer.channels.size() * 37 * 43);
            for (std::size_t i = 0; i < layer.values.size(); ++i) {
                if (layer.words)
                    ASSERT_EQ(std::bit_cast<std::uint32_t>(layer.values[i]), lossy_word(i % 1591));
                else
                    ASSERT_NEAR(layer.values[i], lossy_value(i % 1591), 0.02f) << i;
            }
        }
    }
}

// A few bytes decode to a large image of one value: the claim is no lie.
TEST_F(Exr, ReadsLargeEmptyImagesOfEveryCompression) {
    for (int compression = Imf::NO_COMPRESSION; compression <= Imf::DWAB_COMPRESSION;
         ++compression) {
        SCOPED_TRACE(compression);
        Imf::Header header(2048, 512);
        header.compression() = static_cast<Imf::Compression>(compression);
        for (const char* name : {"R", "G", "B", "A"})
            header.channels().insert(name, Imf::Channel(Imf::HALF));
        {
            Imf::OutputFile output(file("black.exr").c_str(), header);
            output.setFrameBuffer({});  // channels that it lacks are zero
            output.writePixels(512);
        }
        EXPECT_EQ(read_code(file("black.exr")), ExitCode::success)
            << fs::file_size(file("black.exr")) << " bytes";
    }
}

TEST_F(Exr, MissingFilesAndFoldersAreInputErrors) {
    EXPECT_EQ(read_code(file("none.exr")), ExitCode::bad_input);
    EXPECT_EQ(read_code(file("")), ExitCode::bad_input);
    EXPECT_EQ(read_code("/dev/zero"), ExitCode::bad_input);
}

TEST_F(Exr, DamagedFilesOfOtherProjectsLoadOrThrow) {
    const char* shared = std::getenv("WEFT_SHARED");
    const fs::path root =
        fs::path(shared != nullptr ? shared : WEFT_SOURCE_DIR "/../shared") / "data" / "malformed";
    std::size_t files = 0;
    std::size_t readable = 0;
    for (const char* name : {"exr-exrs", "exr-openexr-images", "exr-tinyexr"}) {
        if (!fs::is_directory(root / name)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root / name)) {
            if (!entry.is_regular_file()) continue;
            const ExitCode code = read_code(entry.path());
            EXPECT_TRUE(code == ExitCode::success || code == ExitCode::bad_input) << entry.path();
            ++files;
            if (code == ExitCode::success) ++readable;
        }
    }
    if (files == 0) GTEST_SKIP() << "no collection of damaged files in " << root;
    EXPECT_GT(readable, 0u) << "the collection also holds sound files";
}

}  // namespace
}  // namespace weft::exr_test
