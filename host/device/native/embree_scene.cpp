// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/native/embree_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "base/limits.h"

namespace weft {
namespace {

constexpr const char* building = "building the BVH";

}  // namespace

EmbreeScene::EmbreeScene(const TracedGeometry& geometry, int threads, int flags)
    : device_(threads) {
    const std::size_t count = geometry.triangles.size();
    const std::size_t first_moving = std::min(geometry.first_moving, count);
    if (count > limits::max_triangles)
        throw Error(ExitCode::bad_input,
                    fmt::format("the scene has {} triangles, expected at most {}", count,
                                limits::max_triangles));
    first_moving_ = static_cast<unsigned int>(first_moving);
    moves_ = first_moving < count;
    scene_.reset(rtcNewScene(device_.handle()));
    device_.throw_if_failed(building);
    // With low quality Embree builds a tree of trees, one a mesh, and only then does a commit leave
    // meshes alone that have not changed. Each mesh has a quality of its own.
    rtcSetSceneFlags(scene_.get(),
                     static_cast<RTCSceneFlags>(flags | (moves_ ? RTC_SCENE_FLAG_DYNAMIC : 0)));
    rtcSetSceneBuildQuality(scene_.get(), moves_ ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_HIGH);
    attach(geometry, 0, first_moving, resting_mesh);
    attach(geometry, first_moving, count, moving_mesh);
    rtcCommitScene(scene_.get());
    device_.throw_if_failed(building);
}

void EmbreeScene::attach(const TracedGeometry& geometry, std::size_t first, std::size_t end,
                         unsigned int mesh) {
    if (first == end) return;
    const bool moving = mesh == moving_mesh;
    const bool any = !moving || choose_moving(geometry);
    RTCGeometry triangles = rtcNewGeometry(device_.handle(), RTC_GEOMETRY_TYPE_TRIANGLE);
    device_.throw_if_failed(building);
    rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               geometry.positions.data(), 0, sizeof(shared::float4),
                               geometry.positions.size());
    rtcSetSharedGeometryBuffer(
        triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
        moving ? static_cast<const void*>(moving_.data()) : geometry.triangles.data() + first, 0,
        moving ? sizeof(moving_[0]) : sizeof(shared::Triangle), end - first);
    if (moves_)
        rtcSetGeometryBuildQuality(triangles,
                                   moving ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH);
    if (!any) rtcDisableGeometry(triangles);
    rtcCommitGeometry(triangles);
    rtcAttachGeometryByID(scene_.get(), triangles, mesh);
    rtcReleaseGeometry(triangles);
}

bool EmbreeScene::choose_moving(const TracedGeometry& geometry) {
    // Absent instances have shrunk to a point. Embree's tree of trees fails an assertion (compiled
    // in by Debian) where boxes are points; with indices beyond the vertices it leaves them out.
    constexpr std::array none{~0U, ~0U, ~0U};
    const auto same = [&](std::uint32_t a, std::uint32_t b) {
        const shared::float4& p = geometry.positions[a];
        const shared::float4& q = geometry.positions[b];
        return p.x == q.x && p.y == q.y && p.z == q.z;
    };
    moving_.resize(geometry.triangles.size() - first_moving_);
    bool any = false;
    for (std::size_t i = 0; i < moving_.size(); ++i) {
        const shared::Triangle& t = geometry.triangles[first_moving_ + i];
        const bool point = same(t.v0, t.v1) && same(t.v0, t.v2);
        moving_[i] = point ? none : std::array{t.v0, t.v1, t.v2};
        any = any || !point;
    }
    return any;
}

void EmbreeScene::update(const TracedGeometry& geometry) {
    if (!moves_) return;
    const bool any = choose_moving(geometry);
    RTCGeometry triangles = rtcGetGeometry(scene_.get(), moving_mesh);
    if (any)
        rtcEnableGeometry(triangles);
    else
        rtcDisableGeometry(triangles);
    rtcUpdateGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcUpdateGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0);
    rtcCommitGeometry(triangles);
    rtcCommitScene(scene_.get());
    device_.throw_if_failed("updating the BVH");
}

std::string embree_version() {
    try {
        const EmbreeDevice device(1);
        const auto version = rtcGetDeviceProperty(device.handle(), RTC_DEVICE_PROPERTY_VERSION);
        return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
    } catch (const Error&) {
        return "unavailable";
    }
}

}  // namespace weft
