// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/embree_tree.h"

#include <sys/types.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <new>
#include <vector>

#include "base/error.h"
#include "bvh/embree_device.h"

namespace weft {
namespace {

// A leaf of up to this many triangles is tested as a whole, which costs about as much as a node.
// Blocks of 2 and 4 at costs of 0.4 to 1 were measured: more nodes, no faster.
constexpr unsigned leaf_block = node_width;
constexpr float leaf_cost = 1.0F;

struct ReleaseBvh {
    using pointer = RTCBVH;
    void operator()(RTCBVH bvh) const noexcept { rtcReleaseBVH(bvh); }
};

constexpr const char* action = "building the BVH";

// Owns the memory of a tree. The callbacks of the device use the first members until it is gone;
// several threads call them at once, and they must not throw, since their callers are C.
struct Session {
    std::atomic<std::ptrdiff_t> bytes{0};
    std::size_t max_bytes = SIZE_MAX;
    EmbreeDevice device;
    std::unique_ptr<RTCBVH, ReleaseBvh> bvh;
};

bool on_memory(void* user, ssize_t bytes, bool post) noexcept {
    auto& session = *static_cast<Session*>(user);
    const std::ptrdiff_t total = session.bytes.fetch_add(bytes) + bytes;
    // A refusal is allowed only before the allocation, and must leave the sum as it was.
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
        static_cast<Session*>(user)->device.add_error(RTC_ERROR_OUT_OF_MEMORY, "");
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

// Does nothing: boxes are made anew, bottom up and grown, when the tree is flattened.
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

std::shared_ptr<Session> open_session(std::size_t max_bytes) {
    auto session = std::make_shared<Session>();
    session->max_bytes = max_bytes;
    rtcSetDeviceMemoryMonitorFunction(session->device.handle(), on_memory, session.get());
    session->bvh.reset(rtcNewBVH(session->device.handle()));
    session->device.throw_if_failed(action);
    return session;
}

}  // namespace

BuildTree build_embree_tree(std::span<const Piece> pieces, const EmbreeBuild& request) {
    if (pieces.empty()) return {};
    const std::shared_ptr<Session> session = open_session(request.max_bytes);
    std::vector<Piece> array(pieces.begin(), pieces.end());  // Embree reorders it

    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = static_cast<unsigned>(node_width);
    arguments.maxDepth = request.max_depth;
    arguments.maxLeafSize = request.max_leaf;
    arguments.sahBlockSize = leaf_block;
    arguments.traversalCost = 1.0F;
    arguments.intersectionCost = leaf_cost;
    arguments.bvh = session->bvh.get();
    arguments.primitives = array.data();
    arguments.primitiveCount = array.size();
    arguments.primitiveArrayCapacity = array.size();
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    arguments.userPtr = session.get();

    auto* root = static_cast<BuildNode*>(rtcBuildBVH(&arguments));
    session->device.throw_if_failed(action);
    if (root == nullptr)
        throw Error(ExitCode::device, "Embree failed while building the BVH: it returned no tree");
    return {root, session};
}

}  // namespace weft
