// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/embree_tree.h"

#include <sys/types.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <new>
#include <string>
#include <vector>

#include "base/error.h"
#include "bvh/split_triangle.h"

namespace weft {
namespace {

// Room for pieces, as a factor, when splits may add some. Measured SAH costs of two interiors at
// 1.0 (no splits), 1.3, 1.6 and 2.0: 17.8, 15.1, 14.6, 14.2 and 21.6, 19.8, 19.4, 19.2.
constexpr double split_capacity = 2.0;

// A leaf of up to this many triangles is tested as a whole, which costs about as much as a node.
// Blocks of 2 and 4 at costs of 0.4 to 1 were measured: more nodes, no faster.
constexpr unsigned leaf_block = node_width;
constexpr float leaf_cost = 1.0F;

// The first error that Embree reports, from whichever thread.
class ErrorLog {
  public:
    void add(RTCError code, const char* text) noexcept {
        const std::lock_guard lock(mutex_);
        if (code_ != RTC_ERROR_NONE) return;
        code_ = code;
        try {
            text_ = text != nullptr ? text : "";
        } catch (const std::exception&) {
            code_ = RTC_ERROR_OUT_OF_MEMORY;
        }
    }

    void throw_if_any() const {
        const std::lock_guard lock(mutex_);
        if (code_ == RTC_ERROR_NONE) return;
        if (code_ == RTC_ERROR_OUT_OF_MEMORY)
            throw Error(ExitCode::out_of_memory, "out of memory while building the BVH");
        throw Error(ExitCode::device, "Embree cannot build the BVH: " + text_);
    }

  private:
    mutable std::mutex mutex_;
    RTCError code_ = RTC_ERROR_NONE;
    std::string text_;
};

struct ReleaseDevice {
    using pointer = RTCDevice;
    void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
};

struct ReleaseBvh {
    using pointer = RTCBVH;
    void operator()(RTCBVH bvh) const noexcept { rtcReleaseBVH(bvh); }
};

// Owns the memory of a tree. The callbacks of the device use the first members until it is gone.
struct Session {
    ErrorLog errors;
    std::atomic<std::ptrdiff_t> bytes{0};
    std::size_t max_bytes = SIZE_MAX;
    std::unique_ptr<RTCDevice, ReleaseDevice> device;
    std::unique_ptr<RTCBVH, ReleaseBvh> bvh;
};

// What the callbacks of one build see. They are called by several threads at once and must not
// throw, since their callers are C.
struct BuildContext {
    Session* session;
    std::span<const shared::float4> positions;
    std::span<const shared::Triangle> triangles;
};

void on_error(void* user, RTCError code, const char* text) noexcept {
    static_cast<Session*>(user)->errors.add(code, text);
}

bool on_memory(void* user, ssize_t bytes, bool post) noexcept {
    auto& session = *static_cast<Session*>(user);
    const std::ptrdiff_t total = session.bytes.fetch_add(bytes) + bytes;
    // Only a refusal before the allocation is allowed, and it must leave the sum as it was.
    const bool refuse =
        !post && bytes > 0 && total > 0 && static_cast<std::size_t>(total) > session.max_bytes;
    if (refuse) session.bytes.fetch_sub(bytes);
    return !refuse;
}

template <typename T>
T* allocate(RTCThreadLocalAllocator allocator, void* user, std::size_t count = 1) noexcept {
    void* memory = rtcThreadLocalAlloc(allocator, sizeof(T) * count,
                                       std::max(alignof(T), alignof(std::max_align_t)));
    if (memory == nullptr)
        static_cast<BuildContext*>(user)->session->errors.add(RTC_ERROR_OUT_OF_MEMORY, "");
    return static_cast<T*>(memory);
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned child_count, void* user) noexcept {
    auto* memory = allocate<BuildInner>(allocator, user);
    if (memory == nullptr) return nullptr;
    auto* node = new (memory) BuildInner;
    node->child_count = child_count;
    return static_cast<BuildNode*>(node);
}

void set_children(void* node, void** children, unsigned count, void*) noexcept {
    if (node == nullptr) return;
    auto& inner = *static_cast<BuildInner*>(static_cast<BuildNode*>(node));
    for (unsigned i = 0; i < count; ++i) inner.children[i] = static_cast<BuildNode*>(children[i]);
}

// Boxes are made anew, bottom up and grown, when the tree is flattened.
void set_bounds(void*, const RTCBounds**, unsigned, void*) noexcept {}

void* create_leaf(RTCThreadLocalAllocator allocator, const Piece* pieces, std::size_t count,
                  void* user) noexcept {
    auto* memory = allocate<BuildLeaf>(allocator, user);
    auto* copies = allocate<Piece>(allocator, user, count);
    if (memory == nullptr || copies == nullptr) return nullptr;
    std::uninitialized_copy_n(pieces, count, copies);
    auto* leaf = new (memory) BuildLeaf;
    leaf->piece_count = static_cast<std::uint32_t>(count);
    leaf->pieces = copies;
    return static_cast<BuildNode*>(leaf);
}

void write_bounds(const Box& box, RTCBounds& bounds) noexcept {
    bounds.lower_x = box.lower[0];
    bounds.lower_y = box.lower[1];
    bounds.lower_z = box.lower[2];
    bounds.upper_x = box.upper[0];
    bounds.upper_y = box.upper[1];
    bounds.upper_z = box.upper[2];
}

void split_piece(const Piece* piece, unsigned axis, float position, RTCBounds* below,
                 RTCBounds* above, void* user) noexcept {
    const auto& context = *static_cast<BuildContext*>(user);
    // The results may lie where the piece lies, so it is read first.
    const Corners corners = corners_of(context.positions, context.triangles[piece->primID]);
    const SplitBoxes split = split_triangle(corners, box_of(*piece), axis, position);
    write_bounds(split.below, *below);
    write_bounds(split.above, *above);
}

std::shared_ptr<Session> open_session(std::size_t max_bytes) {
    auto session = std::make_shared<Session>();
    session->max_bytes = max_bytes;
    session->device.reset(rtcNewDevice(nullptr));
    if (!session->device) {
        session->errors.add(rtcGetDeviceError(nullptr), "no device could be made");
        session->errors.throw_if_any();
        throw Error(ExitCode::device, "Embree cannot build the BVH: no device could be made");
    }
    rtcSetDeviceErrorFunction(session->device.get(), on_error, session.get());
    rtcSetDeviceMemoryMonitorFunction(session->device.get(), on_memory, session.get());
    session->bvh.reset(rtcNewBVH(session->device.get()));
    session->errors.throw_if_any();
    return session;
}

}  // namespace

BuildTree build_embree_tree(std::span<const Piece> pieces,
                            std::span<const shared::float4> positions,
                            std::span<const shared::Triangle> triangles,
                            const EmbreeBuild& request) {
    if (pieces.empty()) return {};
    const std::shared_ptr<Session> session = open_session(request.max_bytes);
    BuildContext context{session.get(), positions, triangles};

    // Embree splits only where the array is larger than what it holds, and it reorders the array.
    std::vector<Piece> array;
    const auto spare =
        static_cast<std::size_t>((split_capacity - 1.0) * static_cast<double>(pieces.size())) + 8;
    array.reserve(pieces.size() + (request.spatial_splits ? spare : 0));
    array.assign(pieces.begin(), pieces.end());
    array.resize(array.capacity());

    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality =
        request.spatial_splits ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = static_cast<unsigned>(node_width);
    arguments.maxDepth = request.max_depth;
    arguments.maxLeafSize = request.max_leaf;
    arguments.sahBlockSize = leaf_block;
    arguments.traversalCost = 1.0F;
    arguments.intersectionCost = leaf_cost;
    arguments.bvh = session->bvh.get();
    arguments.primitives = array.data();
    arguments.primitiveCount = pieces.size();
    arguments.primitiveArrayCapacity = array.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    arguments.splitPrimitive = request.spatial_splits ? split_piece : nullptr;
    arguments.userPtr = &context;

    auto* root = static_cast<BuildNode*>(rtcBuildBVH(&arguments));
    session->errors.throw_if_any();
    if (root == nullptr)
        throw Error(ExitCode::device, "Embree cannot build the BVH: it returned no tree");
    return {root, session};
}

}  // namespace weft
