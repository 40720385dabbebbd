// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/nanovdb_reader.h"

#include <gtest/gtest.h>
#include <nanovdb/NanoVDB.h>
#include <nanovdb/util/GridBuilder.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <vector>

#define NANOVDB_USE_ZIP
#define NANOVDB_USE_BLOSC
#include <nanovdb/util/IO.h>

#include "base/error.h"
#include "tests/testing/temporary_folder.h"

// Files are written by the library itself, and read back voxel by voxel.
namespace weft::nanovdb_reader_test {
namespace {

using nanovdb::Coord;
using nanovdb::io::Codec;
using Handle = nanovdb::GridHandle<>;

constexpr std::size_t header_size = sizeof(nanovdb::io::Header) + sizeof(nanovdb::io::MetaData);

/// A density on a sparse, slanted set of voxels, several nodes wide.
float density_of(const Coord& p) {
    const int sum = p[0] + 2 * p[1] - p[2];
    return (sum % 7 + 7) % 7 < 3 ? 0.25F * static_cast<float>((sum % 5 + 5) % 5) : 0.0F;
}

const nanovdb::CoordBBox box(Coord(-9, 3, -40), Coord(12, 20, 5));

template <typename Build = float>
Handle build(float background = 0.0F, const std::string& name = "density") {
    using Value = typename nanovdb::NanoGrid<Build>::ValueType;
    nanovdb::GridBuilder<Value, Build> builder(background, nanovdb::GridClass::FogVolume);
    auto accessor = builder.getAccessor();
    for (int x = box.min()[0]; x <= box.max()[0]; ++x)
        for (int y = box.min()[1]; y <= box.max()[1]; ++y)
            for (int z = box.min()[2]; z <= box.max()[2]; ++z) {
                const Coord p(x, y, z);
                if (density_of(p) > 0.0F) accessor.setValue(p, density_of(p));
            }
    return builder.getHandle(0.5, nanovdb::Vec3d(1.0, 2.0, 3.0), name);
}

/// A file of these grids, each in a segment of its own.
std::string written(const std::vector<const Handle*>& handles, Codec codec = Codec::NONE) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.write("smoke.nvdb", "");
    {
        std::ofstream out(path, std::ios::binary);
        for (const Handle* handle : handles) nanovdb::io::writeGrid(out, *handle, codec);
    }
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string file_of(const Handle& handle, Codec codec = Codec::NONE) {
    return written({&handle}, codec);
}

DensityGrid decode(const std::string& bytes, const std::string& name = "") {
    Diagnostics diagnostics;
    DensityGrid grid =
        decode_nanovdb(std::as_bytes(std::span(bytes)), name, "smoke.nvdb", diagnostics);
    EXPECT_TRUE(diagnostics.warnings().empty());
    return grid;
}

std::string error_of(const std::string& bytes, const std::string& name = "") {
    Diagnostics diagnostics;
    try {
        (void)decode_nanovdb(std::as_bytes(std::span(bytes)), name, "smoke.nvdb", diagnostics);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
    return "no error";
}

void expect_start(const std::string& text, const std::string& start) {
    EXPECT_EQ(text.substr(0, start.size()), start) << text;
}

/// A number of the file's bytes.
template <typename Value>
void put(std::string& bytes, std::size_t offset, Value value) {
    std::memcpy(bytes.data() + offset, &value, sizeof(value));
}

/// Where the grid begins in an uncompressed file of one grid of this name.
std::size_t grid_offset(const std::string& name = "density") {
    return header_size + name.size() + 1;
}

/// The grid is what density_of says, to `tolerance`, and 0 on one voxel about it.
void expect_densities(const DensityGrid& grid, float tolerance) {
    const Coord low = box.min() - Coord(1, 1, 1);
    const Coord size = box.max() - box.min() + Coord(3, 3, 3);
    ASSERT_EQ(grid.size,
              (GridSize{static_cast<std::uint32_t>(size[0]), static_cast<std::uint32_t>(size[1]),
                        static_cast<std::uint32_t>(size[2])}));
    std::size_t index = 0;
    for (int z = 0; z < size[2]; ++z)
        for (int y = 0; y < size[1]; ++y)
            for (int x = 0; x < size[0]; ++x) {
                const Coord p = low + Coord(x, y, z);
                const float expected = box.isInside(p) ? density_of(p) : 0.0F;
                ASSERT_NEAR(grid.densities[index++], expected, tolerance) << x << y << z;
            }
}

TEST(NanovdbReader, ReadsEveryCompression) {
    const Handle handle = build();
    for (const Codec codec : {Codec::NONE, Codec::ZIP, Codec::BLOSC})
        expect_densities(decode(file_of(handle, codec)), 0.0F);
}

TEST(NanovdbReader, ReadsEveryKindOfFloat) {
    expect_densities(decode(file_of(build<double>())), 0.0F);
    // The densities are within [0, 1] in each leaf; codes are rounded to one of 15, 255 or 65535.
    expect_densities(decode(file_of(build<nanovdb::Fp4>())), 1.0F / 15.0F);
    expect_densities(decode(file_of(build<nanovdb::Fp8>())), 1.0F / 255.0F);
    expect_densities(decode(file_of(build<nanovdb::Fp16>())), 1.0F / 65535.0F);
    expect_densities(decode(file_of(build<nanovdb::FpN>())), 0.02F);
}

TEST(NanovdbReader, PlacesVoxelsByTheMap) {
    const DensityGrid grid = decode(file_of(build()));
    // The first voxel is at index (-10, 2, -41), its centre half a voxel inside the cube.
    const glm::dvec4 centre(0.5 / grid.size[0], 0.5 / grid.size[1], 0.5 / grid.size[2], 1.0);
    const glm::dvec3 place(grid.placement * centre);
    EXPECT_NEAR(place.x, 1.0 + 0.5 * -10, 1e-12);
    EXPECT_NEAR(place.y, 2.0 + 0.5 * 2, 1e-12);
    EXPECT_NEAR(place.z, 3.0 + 0.5 * -41, 1e-12);
    const glm::dvec3 size(grid.placement * glm::dvec4(1, 1, 1, 0));
    EXPECT_NEAR(size.x, 0.5 * grid.size[0], 1e-12);
    EXPECT_NEAR(size.z, 0.5 * grid.size[2], 1e-12);
}

// Whole nodes of one value have no voxels of their own.
TEST(NanovdbReader, ReadsTilesOfEveryLevel) {
    nanovdb::GridBuilder<float> builder(0.0F, nanovdb::GridClass::FogVolume);
    builder([](const Coord&) { return 0.5F; },
            nanovdb::CoordBBox(Coord(-130, -8, -8), Coord(140, 9, 7)));
    const DensityGrid grid = decode(file_of(builder.getHandle(1.0, nanovdb::Vec3d(0), "fog")));
    EXPECT_EQ(grid.size, (GridSize{273, 20, 18}));
    std::size_t filled = 0;
    for (const float density : grid.densities) {
        EXPECT_TRUE(density == 0.0F || density == 0.5F);
        filled += density == 0.5F ? 1 : 0;
    }
    EXPECT_EQ(filled, std::size_t{271} * 18 * 16);
}

TEST(NanovdbReader, TakesAnEmptyGrid) {
    nanovdb::GridBuilder<float> builder(0.0F, nanovdb::GridClass::FogVolume);
    EXPECT_TRUE(decode(file_of(builder.getHandle(1.0, nanovdb::Vec3d(0), "a"))).densities.empty());
}

TEST(NanovdbReader, ChoosesTheGridCalledDensity) {
    const Handle handle = build();
    nanovdb::GridBuilder<float> builder(0.0F, nanovdb::GridClass::FogVolume);
    builder.getAccessor().setValue(Coord(4, 5, 6), 7.0F);
    const Handle heat = builder.getHandle(1.0, nanovdb::Vec3d(0), "heat");
    for (const std::string& file : {written({&heat, &handle}), written({&handle, &heat})}) {
        expect_densities(decode(file), 0.0F);
        expect_densities(decode(file, "density"), 0.0F);
        EXPECT_EQ(decode(file, "heat").densities.at(13), 7.0F);
        expect_start(error_of(file, "soot"), "smoke.nvdb: no grid is called 'soot', the first is");
    }
    EXPECT_EQ(decode(file_of(heat)).size, (GridSize{3, 3, 3}));
}

TEST(NanovdbReader, WarnsOfABackground) {
    Diagnostics diagnostics;
    const std::string bytes = file_of(build(0.125F));
    (void)decode_nanovdb(std::as_bytes(std::span(bytes)), "", "smoke.nvdb", diagnostics);
    ASSERT_EQ(diagnostics.warnings().size(), 1U);
    EXPECT_EQ(diagnostics.warnings()[0],
              "smoke.nvdb: the background 0.125 is not continued outside the grid");
}

TEST(NanovdbReader, NamesAVoxelThatIsNoDensity) {
    nanovdb::GridBuilder<float> builder(0.0F, nanovdb::GridClass::FogVolume);
    builder.getAccessor().setValue(Coord(4, 5, 6), -1.0F);
    builder.getAccessor().setValue(Coord(6, 5, 6), 1.0F);
    EXPECT_EQ(error_of(file_of(builder.getHandle(1.0, nanovdb::Vec3d(0), "a"))),
              "smoke.nvdb: voxel (1, 1, 1) is -1, expected a finite density of at least 0");
}

TEST(NanovdbReader, RefusesOtherFiles) {
    const std::string whole = file_of(build());
    expect_start(error_of(""), "smoke.nvdb: no grid");
    expect_start(error_of("VOL\3"), "smoke.nvdb: the file ends inside a header");
    expect_start(error_of(std::string(400, 'x')), "smoke.nvdb: not a NanoVDB file");
    std::string bytes = whole;
    put<std::uint32_t>(bytes, 8, 31U << 21);
    expect_start(error_of(bytes), "smoke.nvdb: NanoVDB of major version 31, expected 32");
    bytes = whole;
    put<std::uint16_t>(bytes, 14, 3);
    expect_start(error_of(bytes), "smoke.nvdb: compression 3, expected 0");
    nanovdb::GridBuilder<std::int32_t> builder(0);
    builder.getAccessor().setValue(Coord(0, 0, 0), 1);
    expect_start(error_of(file_of(builder.getHandle())), "smoke.nvdb: a grid of type 4, expected");
}

TEST(NanovdbReader, RefusesSizesThatAreNot) {
    const std::string whole = file_of(build());
    const auto with = [&](std::size_t offset, auto value) {
        std::string bytes = whole;
        put(bytes, offset, value);
        return error_of(bytes);
    };
    constexpr std::size_t meta = sizeof(nanovdb::io::Header);
    const std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    expect_start(with(meta, most), "smoke.nvdb: a grid of 18446744073709551615 bytes");
    expect_start(with(meta, std::uint64_t{1} << 31), "smoke.nvdb: a grid of 2147483648 bytes in ");
    expect_start(with(meta, std::uint64_t{100}), "smoke.nvdb: a grid of 100 bytes in ");
    expect_start(with(meta + 8, most), "smoke.nvdb: the file ends inside a grid");
    expect_start(with(meta + offsetof(nanovdb::io::MetaData, nameSize), std::uint32_t{4000000000}),
                 "smoke.nvdb: the file ends inside the name of a grid");
    // Boxes that no grid could have, and one that is too large.
    const std::size_t root = grid_offset() + sizeof(nanovdb::GridData) + 64;
    expect_start(with(root, std::int32_t{-2147483647}), "smoke.nvdb: a grid of 2147483662 x");
    EXPECT_TRUE(decode([&] {
                    std::string bytes = whole;
                    put(bytes, root, std::int32_t{100});
                    return bytes;
                }())
                    .densities.empty());
}

TEST(NanovdbReader, RefusesNodesOutsideOfTheGrid) {
    const std::string whole = file_of(build());
    const std::size_t tree = grid_offset() + sizeof(nanovdb::GridData);
    using Root = nanovdb::NanoRoot<float>::DataType;
    const std::size_t root = tree + 64;
    const std::int64_t offsets[] = {1,     -1,      7,         std::int64_t{1} << 40,
                                    -4096, 1 << 30, INT64_MAX, INT64_MIN};
    for (const std::int64_t offset : offsets) {
        std::string bytes = whole;
        put(bytes, tree + 24, offset);  // of the root
        expect_start(error_of(bytes), "smoke.nvdb: a tree with a node outside of its grid");
        bytes = whole;
        put(bytes, root + sizeof(Root) + offsetof(Root::Tile, child), offset);
        expect_start(error_of(bytes), "smoke.nvdb: a tree with a node outside of its grid");
    }
    std::string bytes = whole;
    put(bytes, root + offsetof(Root, mTableSize), std::uint32_t{4000000000});
    expect_start(error_of(bytes), "smoke.nvdb: a tree with a node outside of its grid");
}

TEST(NanovdbReader, RefusesAFileThatIsCutAnywhere) {
    const Handle handle = build();
    for (const Codec codec : {Codec::NONE, Codec::ZIP, Codec::BLOSC}) {
        const std::string whole = file_of(handle, codec);
        for (std::size_t length = 0; length < whole.size(); length += 1 + length / 16)
            EXPECT_NE(error_of(whole.substr(0, length)), "no error") << length;
    }
}

// Whatever is changed, the file is read or refused, and nothing outside of it is touched.
TEST(NanovdbReader, ReadsOrRefusesAFileWithAnythingChanged) {
    std::mt19937 random(1);
    const std::vector<std::string> files = {file_of(build()), file_of(build(), Codec::ZIP),
                                            file_of(build(), Codec::BLOSC),
                                            file_of(build<nanovdb::FpN>())};
    for (const std::string& whole : files) {
        for (int n = 0; n < 800; ++n) {
            std::string changed = whole;
            // Half of them in the first kilobytes, where the sizes and offsets are.
            const std::size_t reach =
                n % 2 == 0 ? whole.size() : std::min<std::size_t>(whole.size(), 1200);
            const std::size_t place = random() % reach;
            changed[place] = static_cast<char>(random());
            (void)error_of(changed);
        }
    }
}

}  // namespace
}  // namespace weft::nanovdb_reader_test
