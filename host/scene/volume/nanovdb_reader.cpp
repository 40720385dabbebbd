// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/nanovdb_reader.h"

#include <fmt/format.h>
#include <nanovdb/NanoVDB.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>

#include "base/error.h"
#include "base/warning_collector.h"
#include "scene/volume/nanovdb_file.h"

namespace weft {
namespace {

constexpr std::uint64_t grid_magic = 0x314244566F6E614EU;  // NanoVDB1, of grids since 32.6

/// Voxels from `low` to `high`, both included.
struct Box {
    std::array<std::int64_t, 3> low{}, high{};

    [[nodiscard]] bool empty() const {
        return low[0] > high[0] || low[1] > high[1] || low[2] > high[2];
    }
    [[nodiscard]] Box common(const Box& other) const {
        Box result;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            result.low[axis] = std::max(low[axis], other.low[axis]);
            result.high[axis] = std::min(high[axis], other.high[axis]);
        }
        return result;
    }
};

/// The cube of this edge at an origin.
Box cube_at(const std::array<std::int64_t, 3>& origin, std::int64_t edge) {
    return {origin, {origin[0] + edge - 1, origin[1] + edge - 1, origin[2] + edge - 1}};
}

/// A tree of nodes in a buffer that is not trusted: every node is checked to lie inside before it
/// is read. The place of a node in space follows from its parents, never from its own data, so that
/// no voxel is written twice however the nodes refer to each other.
template <typename Build>
class TreeReader {
    using Root = typename nanovdb::NanoRoot<Build>::DataType;
    using Upper = typename nanovdb::NanoUpper<Build>::DataType;
    using Lower = typename nanovdb::NanoLower<Build>::DataType;
    using Leaf = typename nanovdb::NanoLeaf<Build>::DataType;

  public:
    TreeReader(std::span<const std::byte> buffer, const std::string& file)
        : buffer_(buffer), file_(file) {
        constexpr std::size_t tree_offset = sizeof(nanovdb::GridData);
        const auto& tree = *at<nanovdb::TreeData<3>>(tree_offset, 0);
        root_offset_ = child_offset(tree_offset, static_cast<std::int64_t>(tree.mNodeOffset[3]));
        root_ = at<Root>(root_offset_, 0);
        for (int axis = 0; axis < 3; ++axis) {
            box_.low[static_cast<std::size_t>(axis)] = root_->mBBox.min()[axis];
            box_.high[static_cast<std::size_t>(axis)] = root_->mBBox.max()[axis];
        }
    }

    /// The value of all voxels that have no value of their own.
    [[nodiscard]] float background() const { return static_cast<float>(root_->mBackground); }

    /// The box of voxels that are read: the active ones with a layer of background about them.
    [[nodiscard]] Box padded_box() const {
        Box box = box_;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            --box.low[axis];
            ++box.high[axis];
        }
        return box;
    }
    [[nodiscard]] bool empty() const { return box_.empty(); }

    /// Fills a grid of the size of padded_box().
    void read(DensityGrid& grid) {
        grid_ = &grid;
        const std::size_t first = root_offset_ + sizeof(Root);
        if (root_->mTableSize > (buffer_.size() - first) / sizeof(typename Root::Tile))
            throw outside();
        std::set<std::uint64_t> keys;
        for (std::uint32_t i = 0; i < root_->mTableSize; ++i) {
            const auto& tile = *at<typename Root::Tile>(first, i * sizeof(typename Root::Tile));
            if (!keys.insert(tile.key).second)
                throw input_error(file_, "a tree that covers a place twice");
            const auto origin = Root::KeyToCoord(tile.key);
            const Box cube = cube_at({origin[0], origin[1], origin[2]}, 4096);
            if (tile.child == 0) {
                fill(cube, static_cast<float>(tile.value));
            } else if (!cube.common(box_).empty()) {
                read_inner<Upper, 5, 7>(child_offset(root_offset_, tile.child), cube);
            }
        }
    }

  private:
    [[nodiscard]] Error outside() const {
        return input_error(file_, "a tree with a node outside of its grid");
    }

    [[nodiscard]] std::size_t child_offset(std::size_t offset, std::int64_t relative) const {
        const auto size = static_cast<std::int64_t>(buffer_.size());
        const auto start = static_cast<std::int64_t>(offset);
        if (relative < -start || relative > size - start) throw outside();
        return static_cast<std::size_t>(start + relative);
    }

    template <typename Node>
    [[nodiscard]] const Node* at(std::size_t offset, std::size_t relative) const {
        const std::size_t place = offset + relative;
        if (place % alignof(Node) != 0 || place > buffer_.size() ||
            sizeof(Node) > buffer_.size() - place)
            throw outside();
        return reinterpret_cast<const Node*>(buffer_.data() + place);
    }

    /// An inner node of 2^edge_bits children along an edge, each 2^child_bits voxels wide.
    template <typename Node, int edge_bits, int child_bits>
    void read_inner(std::size_t offset, const Box& cube) {
        const Node& node = *at<Node>(offset, 0);
        const Box wanted = cube.common(box_);
        std::array<std::int64_t, 3> c{};
        const auto first = [&](std::size_t axis) {
            return (wanted.low[axis] - cube.low[axis]) >> child_bits;
        };
        const auto last = [&](std::size_t axis) {
            return (wanted.high[axis] - cube.low[axis]) >> child_bits;
        };
        for (c[0] = first(0); c[0] <= last(0); ++c[0])
            for (c[1] = first(1); c[1] <= last(1); ++c[1])
                for (c[2] = first(2); c[2] <= last(2); ++c[2]) {
                    const auto n = static_cast<std::uint32_t>(c[0] << 2 * edge_bits |
                                                              c[1] << edge_bits | c[2]);
                    const Box child = cube_at(
                        {cube.low[0] + (c[0] << child_bits), cube.low[1] + (c[1] << child_bits),
                         cube.low[2] + (c[2] << child_bits)},
                        std::int64_t{1} << child_bits);
                    if (!node.mChildMask.isOn(n))
                        fill(child, static_cast<float>(node.mTable[n].value));
                    else if constexpr (edge_bits == 5)
                        read_inner<Lower, 4, 3>(child_offset(offset, node.mTable[n].child), child);
                    else
                        read_leaf(child_offset(offset, node.mTable[n].child), child);
                }
    }

    void read_leaf(std::size_t offset, const Box& cube) {
        const Leaf& leaf = *at<Leaf>(offset, 0);
        if constexpr (!Leaf::FIXED_SIZE) {
            // Five widths of codes, 1 to 16 bits, which follow the node.
            if (leaf.mFlags >> 5 > 4 || leaf.memUsage() > buffer_.size() - offset) throw outside();
        }
        const Box wanted = cube.common(box_);
        for (std::int64_t z = wanted.low[2]; z <= wanted.high[2]; ++z)
            for (std::int64_t y = wanted.low[1]; y <= wanted.high[1]; ++y)
                for (std::int64_t x = wanted.low[0]; x <= wanted.high[0]; ++x) {
                    const auto n = static_cast<std::uint32_t>(
                        (x - cube.low[0]) << 6 | (y - cube.low[1]) << 3 | (z - cube.low[2]));
                    *voxel(x, y, z) = static_cast<float>(leaf.getValue(n));
                }
    }

    void fill(const Box& cube, float value) {
        const Box wanted = cube.common(box_);
        if (wanted.empty()) return;
        for (std::int64_t z = wanted.low[2]; z <= wanted.high[2]; ++z)
            for (std::int64_t y = wanted.low[1]; y <= wanted.high[1]; ++y)
                std::fill_n(voxel(wanted.low[0], y, z), wanted.high[0] - wanted.low[0] + 1, value);
    }

    /// A voxel of the grid, which has a layer of background about the box.
    [[nodiscard]] float* voxel(std::int64_t x, std::int64_t y, std::int64_t z) const {
        const auto i = static_cast<std::size_t>(x - box_.low[0] + 1);
        const auto j = static_cast<std::size_t>(y - box_.low[1] + 1);
        const auto k = static_cast<std::size_t>(z - box_.low[2] + 1);
        return grid_->densities.data() + (k * grid_->size[1] + j) * grid_->size[0] + i;
    }

    std::span<const std::byte> buffer_;
    const std::string& file_;
    std::size_t root_offset_ = 0;
    const Root* root_ = nullptr;
    Box box_;
    DensityGrid* grid_ = nullptr;
};

/// From the unit cube to the indices of a box, whose voxels are centred at whole numbers, and on to
/// the world by the grid's map.
glm::dmat4 read_placement(const nanovdb::Map& map, const Box& box, const std::string& file) {
    glm::dmat4 to_index(1.0);
    glm::dmat4 to_world(1.0);
    for (int row = 0; row < 3; ++row) {
        const auto axis = static_cast<std::size_t>(row);
        to_index[row][row] = static_cast<double>(box.high[axis] - box.low[axis] + 1);
        to_index[3][row] = static_cast<double>(box.low[axis]) - 0.5;
        to_world[3][row] = map.mVecD[row];
        for (int column = 0; column < 3; ++column)
            to_world[column][row] = map.mMatD[3 * row + column];
    }
    const glm::dmat4 placement = to_world * to_index;
    const double volume = glm::determinant(glm::dmat3(placement));
    // Scenes are placed in single precision.
    bool fits = std::isfinite(volume) && volume != 0.0;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            fits = fits && std::isfinite(static_cast<float>(placement[column][row]));
    if (!fits) throw input_error(file, "a grid whose map is not finite or flattens it");
    return placement;
}

template <typename Build>
DensityGrid read_tree(std::span<const std::byte> buffer, const nanovdb::Map& map,
                      const std::string& file, Diagnostics& diagnostics) {
    TreeReader<Build> tree(buffer, file);
    DensityGrid grid;
    if (tree.empty()) return grid;
    const Box box = tree.padded_box();
    for (std::size_t axis = 0; axis < 3; ++axis)
        grid.size[axis] = static_cast<std::uint32_t>(
            std::min<std::int64_t>(box.high[axis] - box.low[axis] + 1, UINT32_MAX));
    const std::size_t count = checked_voxel_count(grid.size, file);
    grid.placement = read_placement(map, box, file);
    grid.densities.assign(count, tree.background());
    tree.read(grid);
    validate_density_grid(grid, file);
    if (tree.background() > 0.0F)
        WarningCollector(diagnostics)
            .once(file, fmt::format("the background {} is not continued outside the grid",
                                    tree.background()));
    return grid;
}

}  // namespace

DensityGrid decode_nanovdb(std::span<const std::byte> bytes, const std::string& name,
                           const std::string& file, Diagnostics& diagnostics) {
    const NanovdbBuffer unpacked = unpack_nanovdb(bytes, name, file);
    const std::span<const std::byte> buffer = unpacked.bytes();
    if (buffer.size() < sizeof(nanovdb::GridData))
        throw input_error(file, "a grid of fewer bytes than its description takes");
    const auto& data = *reinterpret_cast<const nanovdb::GridData*>(buffer.data());
    if (data.mMagic != NANOVDB_MAGIC_NUMBER && data.mMagic != grid_magic)
        throw input_error(file, "a grid that is none, expected one that begins with NanoVDB0");
    const auto type = static_cast<std::uint32_t>(data.mGridType);
    switch (static_cast<nanovdb::GridType>(type)) {
        case nanovdb::GridType::Float:
            return read_tree<float>(buffer, data.mMap, file, diagnostics);
        case nanovdb::GridType::Double:
            return read_tree<double>(buffer, data.mMap, file, diagnostics);
        case nanovdb::GridType::Fp4:
            return read_tree<nanovdb::Fp4>(buffer, data.mMap, file, diagnostics);
        case nanovdb::GridType::Fp8:
            return read_tree<nanovdb::Fp8>(buffer, data.mMap, file, diagnostics);
        case nanovdb::GridType::Fp16:
            return read_tree<nanovdb::Fp16>(buffer, data.mMap, file, diagnostics);
        case nanovdb::GridType::FpN:
            return read_tree<nanovdb::FpN>(buffer, data.mMap, file, diagnostics);
        default:
            break;
    }
    throw input_error(file, fmt::format("a grid of type {}, expected densities as float, double, "
                                        "Fp4, Fp8, Fp16 or FpN",
                                        type));
}

}  // namespace weft
