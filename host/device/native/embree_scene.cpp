// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/native/embree_scene.h"

#include <fmt/format.h>

#include "base/error.h"

namespace weft {
namespace {

void throw_embree_error(RTCDevice device, const char* action) {
    const RTCError code = rtcGetDeviceError(device);
    if (code == RTC_ERROR_NONE) return;
    const bool memory = code == RTC_ERROR_OUT_OF_MEMORY;
    throw Error(memory ? ExitCode::out_of_memory : ExitCode::device,
                fmt::format("Embree could not {} (error {})", action, static_cast<int>(code)));
}

}  // namespace

EmbreeScene::EmbreeScene(const TracedGeometry& geometry, int threads, int flags) {
    const std::string config = threads > 0 ? fmt::format("threads={}", threads) : std::string();
    device_ = rtcNewDevice(config.c_str());
    if (device_ == nullptr) throw_embree_error(nullptr, "start");
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, static_cast<RTCSceneFlags>(flags));
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_HIGH);
    if (!geometry.triangles.empty()) {
        RTCGeometry mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                   geometry.positions.data(), 0, sizeof(shared::float4),
                                   geometry.positions.size());
        rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   geometry.triangles.data(), 0, sizeof(shared::Triangle),
                                   geometry.triangles.size());
        rtcCommitGeometry(mesh);
        rtcAttachGeometryByID(scene_, mesh, 0);
        rtcReleaseGeometry(mesh);
    }
    rtcCommitScene(scene_);
    const RTCError code = rtcGetDeviceError(device_);
    if (code != RTC_ERROR_NONE) {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
        throw Error(
            code == RTC_ERROR_OUT_OF_MEMORY ? ExitCode::out_of_memory : ExitCode::device,
            fmt::format("Embree could not build the scene (error {})", static_cast<int>(code)));
    }
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

std::string embree_version() {
    RTCDevice device = rtcNewDevice("threads=1");
    if (device == nullptr) return "unavailable";
    const auto version = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_VERSION);
    rtcReleaseDevice(device);
    return fmt::format("{}.{}.{}", version / 10000, version / 100 % 100, version % 100);
}

}  // namespace weft
