// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "denoise/open_image_denoise.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <span>

#include "base/error.h"
#include "base/quote.h"
#include "denoise/layer_values.h"
#include "film/for_each_pixel.h"

namespace weft {
namespace {

constexpr const char* library_variable = "WEFT_OIDN_LIBRARY";

// Numbers of the library's interface.
constexpr int processor_device = 1;  // OIDN_DEVICE_TYPE_CPU
constexpr int three_floats = 3;      // OIDN_FORMAT_FLOAT3

/// The file of the library, as the environment names it, or empty.
std::string named_library() {
    const char* const named = std::getenv(library_variable);
    return named != nullptr ? named : "";
}

Error failure(const std::string& what) {
    return {ExitCode::device, "Open Image Denoise: " + what};
}

/// Three planes as one colour after the other.
std::vector<float> interleaved(std::span<const float> planes) {
    const std::size_t pixels = planes.size() / 3;
    std::vector<float> colours(planes.size());
    for_each_pixel(pixels, [&](std::size_t i) {
        for (std::size_t c = 0; c < 3; ++c) colours[3 * i + c] = planes[c * pixels + i];
    });
    return colours;
}

}  // namespace

/// The functions of the library that are used; handles are opaque. Functions that set numbers have
/// another name in each of its versions.
struct OpenImageDenoise::Library {
    using Handle = void*;

    void* file = nullptr;
    Handle (*new_device)(int type) = nullptr;
    void (*set_device_int)(Handle, const char* name, int value) = nullptr;
    int (*device_int)(Handle, const char* name) = nullptr;
    void (*commit_device)(Handle) = nullptr;
    int (*device_error)(Handle, const char** message) = nullptr;
    void (*release_device)(Handle) = nullptr;
    Handle (*new_filter)(Handle device, const char* type) = nullptr;
    void (*set_image)(Handle, const char* name, void* data, int format, std::size_t width,
                      std::size_t height, std::size_t offset, std::size_t pixel_stride,
                      std::size_t row_stride) = nullptr;
    void (*set_bool)(Handle, const char* name, bool value) = nullptr;
    void (*commit_filter)(Handle) = nullptr;
    void (*execute_filter)(Handle) = nullptr;
    void (*release_filter)(Handle) = nullptr;
    Handle device = nullptr;

    Library() {
        open();
        find(new_device, "oidnNewDevice");
        find(set_device_int, "oidnSetDeviceInt", "oidnSetDevice1i");
        find(device_int, "oidnGetDeviceInt", "oidnGetDevice1i");
        find(commit_device, "oidnCommitDevice");
        find(device_error, "oidnGetDeviceError");
        find(release_device, "oidnReleaseDevice");
        find(new_filter, "oidnNewFilter");
        find(set_image, "oidnSetSharedFilterImage");
        find(set_bool, "oidnSetFilterBool", "oidnSetFilter1b");
        find(commit_filter, "oidnCommitFilter");
        find(execute_filter, "oidnExecuteFilter");
        find(release_filter, "oidnReleaseFilter");
    }
    // The file stays open: the library has threads that may outlive what is released here.
    ~Library() {
        if (device != nullptr) release_device(device);
    }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    /// Throws what the library says went wrong since it was last asked, if anything did.
    void check(const char* doing) const {
        const char* message = nullptr;
        if (device_error(device, &message) != 0)
            throw failure(fmt::format("{} failed: {}", doing,
                                      message != nullptr ? one_line(message) : "unknown error"));
    }

  private:
    void open() {
        const std::string named = named_library();
        if (!named.empty()) {
            file = dlopen(named.c_str(), RTLD_NOW | RTLD_LOCAL);
            if (file == nullptr) {
                const char* const reason = dlerror();
                throw failure(fmt::format("cannot load {}, which {} names: {}", quote(named),
                                          library_variable, reason != nullptr ? reason : ""));
            }
            return;
        }
        for (const char* const name :
             {"libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1", "libOpenImageDenoise.so"}) {
            file = dlopen(name, RTLD_NOW | RTLD_LOCAL);
            if (file != nullptr) return;
        }
        throw failure(
            fmt::format("is not installed, expected libOpenImageDenoise.so.2 or .so.1 (from "
                        "www.openimagedenoise.org) where libraries are, or its path in {}",
                        library_variable));
    }

    template <class Function>
    void find(Function*& function, const char* name, const char* older = nullptr) const {
        void* found = dlsym(file, name);
        if (found == nullptr && older != nullptr) found = dlsym(file, older);
        if (found == nullptr)
            throw failure(fmt::format("the library has no {}, expected version 1 or 2", name));
        function = reinterpret_cast<Function*>(found);
    }
};

OpenImageDenoise::OpenImageDenoise() : library_(std::make_unique<Library>()) {
    Library& library = *library_;
    library.device = library.new_device(processor_device);
    library.check("opening its device");
    if (library.device == nullptr) throw failure("opening its device failed");
    library.set_device_int(library.device, "numThreads", tbb::this_task_arena::max_concurrency());
    library.commit_device(library.device);
    library.check("opening its device");
    version_ = fmt::format("{}.{}.{}", library.device_int(library.device, "versionMajor"),
                           library.device_int(library.device, "versionMinor"),
                           library.device_int(library.device, "versionPatch"));
}

OpenImageDenoise::~OpenImageDenoise() = default;

std::vector<float> OpenImageDenoise::denoised(const Image& image) const {
    const Library& library = *library_;
    const std::size_t pixels = std::size_t{image.width} * image.height;
    const std::span<const float> beauty = layer_values(image, "", 3);
    std::vector<float> colour = interleaved(beauty);
    std::vector<float> albedo = interleaved(layer_values(image, "albedo", 3));
    std::vector<float> normal = interleaved(layer_values(image, "normal", 3));
    std::vector<float> output(3 * pixels);
    const std::unique_ptr<void, void (*)(void*)> filter(library.new_filter(library.device, "RT"),
                                                        library.release_filter);
    library.check("making a filter");
    if (filter == nullptr) throw failure("making a filter failed");
    const auto set = [&](const char* name, std::vector<float>& values) {
        library.set_image(filter.get(), name, values.data(), three_floats, image.width,
                          image.height, 0, 0, 0);
    };
    set("color", colour);
    set("albedo", albedo);
    set("normal", normal);
    set("output", output);
    library.set_bool(filter.get(), "hdr", true);
    library.commit_filter(filter.get());
    library.check("preparing a filter");
    library.execute_filter(filter.get());
    library.check("denoising");
    std::vector<float> result(3 * pixels);
    for_each_pixel(pixels, [&](std::size_t i) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t at = c * pixels + i;
            const float value = output[3 * i + c];
            result[at] = std::isfinite(value) ? value : beauty[at];
        }
    });
    return result;
}

}  // namespace weft
