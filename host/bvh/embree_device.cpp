// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/embree_device.h"

#include <fmt/format.h>

#include <exception>
#include <string_view>

#include "base/error.h"

namespace weft {
namespace {

void report(void* device, RTCError code, const char* text) noexcept {
    static_cast<EmbreeDevice*>(device)->add_error(code, text);
}

/// Whether an error stands for memory that ran out. Nobody cancels Embree's tasks here, so what
/// cancels them is another task that found no memory, and Embree reports whichever it sees first.
bool is_of_memory(RTCError code, std::string_view text) {
    if (code == RTC_ERROR_OUT_OF_MEMORY) return true;
    return code == RTC_ERROR_UNKNOWN && (text == "task cancelled" || says_no_thread(text));
}

}  // namespace

EmbreeDevice::EmbreeDevice(int threads) {
    std::string settings = "tessellation_cache_size=0";
    if (threads > 0) settings += fmt::format(",threads={}", threads);
    constexpr const char* action = "making a device";
    device_ = rtcNewDevice(settings.c_str());
    if (device_ == nullptr) {
        add_error(rtcGetDeviceError(nullptr), "there is none");
        throw_if_failed(action);
        throw Error(ExitCode::device, fmt::format("Embree failed while {}", action));
    }
    rtcSetDeviceErrorFunction(device_, report, this);
}

EmbreeDevice::~EmbreeDevice() {
    rtcReleaseDevice(device_);
}

void EmbreeDevice::add_error(RTCError code, const char* text) noexcept {
    const std::lock_guard lock(mutex_);
    if (code_ != RTC_ERROR_NONE) return;
    code_ = code;
    try {
        text_ = text != nullptr ? text : "";
    } catch (const std::exception&) {
        code_ = RTC_ERROR_OUT_OF_MEMORY;
    }
}

void EmbreeDevice::throw_if_failed(const char* action) const {
    const std::lock_guard lock(mutex_);
    if (code_ == RTC_ERROR_NONE) return;
    if (is_of_memory(code_, text_))
        throw Error(ExitCode::out_of_memory, fmt::format("out of memory while {}", action));
    throw Error(ExitCode::device, fmt::format("Embree failed while {}: {}", action, text_));
}

}  // namespace weft
