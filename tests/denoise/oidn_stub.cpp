// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// A library with the interface of Open Image Denoise that tests load in its place. It writes what
// it gets to the file that WEFT_OIDN_STUB_LOG names, fails where WEFT_OIDN_STUB_FAILS names a
// function, and its filter halves colours. WEFT_OIDN_STUB_VERSION is the version whose names it
// has.
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

struct Filter {
    const float* colour = nullptr;
    float* output = nullptr;
    std::size_t pixels = 0;
};

int device;
bool failed;

void note(const char* text, const char* name = "", double value = 0.0) {
    const char* const log = std::getenv("WEFT_OIDN_STUB_LOG");
    std::FILE* const file = log != nullptr ? std::fopen(log, "a") : nullptr;
    if (file == nullptr) return;
    std::fprintf(file, "%s %s %g\n", text, name, value);
    std::fclose(file);
}

void fail_if_told(const char* function) {
    const char* const told = std::getenv("WEFT_OIDN_STUB_FAILS");
    failed = failed || (told != nullptr && std::strcmp(told, function) == 0);
}

double sum_of(const float* values, std::size_t count) {
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) sum += values[k];
    return sum;
}

void set_int(const char* name, int value) {
    note("int", name, value);
}

int get_int(const char* name) {
    if (std::strcmp(name, "versionMajor") == 0) return WEFT_OIDN_STUB_VERSION;
    return std::strcmp(name, "versionMinor") == 0 ? 9 : 7;
}

void set_bool(const char* name, bool value) {
    note("bool", name, value ? 1.0 : 0.0);
}

}  // namespace

extern "C" {

void* oidnNewDevice(int type) {
    note("device", "", type);
    fail_if_told("oidnNewDevice");
    return failed ? nullptr : &device;
}

#if WEFT_OIDN_STUB_VERSION == 2
void oidnSetDeviceInt(void*, const char* name, int value) {
    set_int(name, value);
}
int oidnGetDeviceInt(void*, const char* name) {
    return get_int(name);
}
void oidnSetFilterBool(void*, const char* name, bool value) {
    set_bool(name, value);
}
#else
void oidnSetDevice1i(void*, const char* name, int value) {
    set_int(name, value);
}
int oidnGetDevice1i(void*, const char* name) {
    return get_int(name);
}
void oidnSetFilter1b(void*, const char* name, bool value) {
    set_bool(name, value);
}
#endif

void oidnCommitDevice(void*) {
    fail_if_told("oidnCommitDevice");
}

int oidnGetDeviceError(void*, const char** message) {
    const bool before = failed;
    failed = false;
    if (before) *message = "told to fail\nhere";
    return before ? 1 : 0;
}

void oidnReleaseDevice(void*) {
    note("released device");
}

void* oidnNewFilter(void*, const char* type) {
    note("filter", type);
    return new Filter;
}

void oidnSetSharedFilterImage(void* handle, const char* name, void* data, int format,
                              std::size_t width, std::size_t height, std::size_t offset,
                              std::size_t pixel_stride, std::size_t row_stride) {
    auto* const filter = static_cast<Filter*>(handle);
    filter->pixels = width * height;
    if (format != 3 || offset + pixel_stride + row_stride != 0) failed = true;
    if (std::strcmp(name, "output") == 0)
        filter->output = static_cast<float*>(data);
    else
        note("image", name, sum_of(static_cast<const float*>(data), 3 * filter->pixels));
    if (std::strcmp(name, "color") == 0) filter->colour = static_cast<const float*>(data);
}

void oidnCommitFilter(void*) {
    fail_if_told("oidnCommitFilter");
}

void oidnExecuteFilter(void* handle) {
    fail_if_told("oidnExecuteFilter");
    const auto* const filter = static_cast<const Filter*>(handle);
    for (std::size_t k = 0; k < 3 * filter->pixels; ++k)
        filter->output[k] = 0.5F * filter->colour[k];
}

void oidnReleaseFilter(void* handle) {
    note("released filter");
    delete static_cast<Filter*>(handle);
}
}
