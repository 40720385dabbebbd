// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// An OpenCL driver that does wrong on purpose, for tests: PoCL, behind calls that crash, hang, lie
// or fail. WEFT_FAULT says what is wrong:
//
//     crash-open, hang-open                when the driver is opened
//     exit-open, quit-open                 likewise, with exit codes 7 and 0
//     crash-unload, terminate-unload       when the process ends
//     crash-build, hang-build              when a program is built
//     crash-launch, hang-launch            when a kernel is launched
//     idle-launch                          kernels are never run, and nobody is told
//     crash-gbuffer, exit-gbuffer          when the kernel gbuffer is launched
//     abort-gbuffer                        likewise, if SIGXFSZ is still ignored
//     throw-gbuffer                        likewise, by an exception in a thread of its own
//     long-name                            a name of 2^62 bytes
//     no-units, many-units                 0 or 2^32 - 1 compute units
//     no-memory                            buffers of at most 0 bytes
//     fail=N                               the N-th call of a process fails, from 1, with the error
//                                          WEFT_FAULT_CODE, or the process gets the signal
//                                          WEFT_FAULT_SIGNAL; its name is added to WEFT_FAULT_LOG
//
// Only the device whose name contains WEFT_FAULTY_DEVICE does so, or all of them without it.
#include <CL/cl_icd.h>
#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <tuple>
#include <type_traits>

namespace {

struct _cl_icd_dispatch* table;  // of PoCL's objects, whose calls are replaced
struct _cl_icd_dispatch behind;  // what they were

std::string fault() {
    const char* const text = std::getenv("WEFT_FAULT");
    return text != nullptr ? text : "";
}

[[noreturn]] void crash() {
    volatile std::uintptr_t nowhere = 8;
    *reinterpret_cast<volatile int*>(nowhere) = 1;
    std::abort();
}

/// Aborts, but exits where a signal that the program ignores has found another handler: compilers
/// of drivers install some.
[[noreturn]] void abort_if_ignored(int signal) {
    struct sigaction now {};
    ::sigaction(signal, nullptr, &now);
    if (now.sa_handler != SIG_IGN) ::_exit(9);
    std::abort();
}

[[noreturn]] void hang() {
    for (;;) ::pause();
}

std::string name_of(cl_device_id device) {
    char name[256] = {};
    behind.clGetDeviceInfo(device, CL_DEVICE_NAME, sizeof(name) - 1, name, nullptr);
    return name;
}

std::string name_of(cl_kernel kernel) {
    char name[64] = {};
    behind.clGetKernelInfo(kernel, CL_KERNEL_FUNCTION_NAME, sizeof(name) - 1, name, nullptr);
    return name;
}

bool is_faulty(cl_device_id device) {
    const char* const wanted = std::getenv("WEFT_FAULTY_DEVICE");
    return wanted == nullptr || name_of(device).find(wanted) != std::string::npos;
}

bool is_faulty(cl_command_queue queue) {
    cl_device_id device = nullptr;
    behind.clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof(device), &device, nullptr);
    return is_faulty(device);
}

struct AtTheEnd {
    ~AtTheEnd() {
        if (fault() == "crash-unload") crash();
        if (fault() == "terminate-unload") std::terminate();
    }
} at_the_end;

/// Answers a question with the bytes of `value`.
template <class T>
cl_int answer(const T& value, size_t size, void* to, size_t* needed) {
    if (needed != nullptr) *needed = sizeof(T);
    if (to == nullptr) return CL_SUCCESS;
    if (size < sizeof(T)) return CL_INVALID_VALUE;
    std::memcpy(to, &value, sizeof(T));
    return CL_SUCCESS;
}

cl_int CL_API_CALL device_info(cl_device_id device, cl_device_info what, size_t size, void* to,
                               size_t* needed) {
    const std::string wrong = is_faulty(device) ? fault() : "";
    if (wrong == "long-name" && what == CL_DEVICE_NAME && needed != nullptr) {
        *needed = std::size_t{1} << 62;
        return CL_SUCCESS;
    }
    if (what == CL_DEVICE_MAX_COMPUTE_UNITS) {
        if (wrong == "no-units") return answer(cl_uint{0}, size, to, needed);
        if (wrong == "many-units") return answer(~cl_uint{0}, size, to, needed);
    }
    if (what == CL_DEVICE_MAX_MEM_ALLOC_SIZE && wrong == "no-memory")
        return answer(cl_ulong{0}, size, to, needed);
    return behind.clGetDeviceInfo(device, what, size, to, needed);
}

cl_int CL_API_CALL build_program(cl_program program, cl_uint count, const cl_device_id* devices,
                                 const char* options, void(CL_CALLBACK* done)(cl_program, void*),
                                 void* data) {
    if (count == 0 || is_faulty(devices[0])) {
        if (fault() == "crash-build") crash();
        if (fault() == "hang-build") hang();
    }
    return behind.clBuildProgram(program, count, devices, options, done, data);
}

cl_int CL_API_CALL launch(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                          const size_t* offset, const size_t* global, const size_t* local,
                          cl_uint waits, const cl_event* events, cl_event* event) {
    const std::string wrong = is_faulty(queue) ? fault() : "";
    if (wrong == "crash-launch") crash();
    if (wrong == "hang-launch") hang();
    if (wrong == "idle-launch")
        return behind.clEnqueueMarkerWithWaitList(queue, waits, events, event);
    if (wrong.ends_with("-gbuffer") && name_of(kernel) == "gbuffer") {
        if (wrong == "exit-gbuffer") std::exit(7);
        if (wrong == "throw-gbuffer")
            std::thread([] { throw std::runtime_error("nobody catches it"); }).join();
        if (wrong == "abort-gbuffer") abort_if_ignored(SIGXFSZ);
        crash();
    }
    return behind.clEnqueueNDRangeKernel(queue, kernel, dimensions, offset, global, local, waits,
                                         events, event);
}

/// Whether this call is the one to fail; `name` is its.
bool fails(const char* name) {
    static const long wanted = std::strtol(fault().c_str() + std::strlen("fail="), nullptr, 10);
    static std::atomic<long> calls{0};
    if (++calls != wanted) return false;
    if (const char* const log = std::getenv("WEFT_FAULT_LOG"))
        std::ofstream(log, std::ios::app) << name << std::endl;
    if (const char* const signal = std::getenv("WEFT_FAULT_SIGNAL")) {
        ::kill(::getpid(), static_cast<int>(std::strtol(signal, nullptr, 10)));
        return false;
    }
    return true;
}

cl_int fault_code() {
    const char* const text = std::getenv("WEFT_FAULT_CODE");
    return text != nullptr ? static_cast<cl_int>(std::strtol(text, nullptr, 10))
                           : CL_OUT_OF_RESOURCES;
}

/// What a failing call returns that makes an object: nothing, and the error by its last argument.
template <class... Arguments>
void* no_object(Arguments... arguments) {
    cl_int* const error = std::get<sizeof...(Arguments) - 1>(std::tuple(arguments...));
    if (error != nullptr) *error = fault_code();
    return nullptr;
}

/// A call that is counted, and may fail.
template <auto member, auto name>
struct Counted;
template <class Result, class... Arguments,
          Result (CL_API_CALL* _cl_icd_dispatch::*member)(Arguments...), auto name>
struct Counted<member, name> {
    static Result CL_API_CALL call(Arguments... arguments) {
        if (!fails(name())) return (behind.*member)(arguments...);
        if constexpr (std::is_pointer_v<Result>)
            return static_cast<Result>(no_object(arguments...));
        else
            return fault_code();
    }
};

/// Counts every call that Weft makes, but for those that count references.
void count_calls() {
#define COUNT(name) table->name = Counted<&_cl_icd_dispatch::name, [] { return #name; }>::call
    COUNT(clGetDeviceIDs);
    COUNT(clGetDeviceInfo);
    COUNT(clGetPlatformInfo);
    COUNT(clCreateContext);
    COUNT(clCreateCommandQueue);
    COUNT(clCreateBuffer);
    COUNT(clCreateProgramWithSource);
    COUNT(clCreateProgramWithBinary);
    COUNT(clBuildProgram);
    COUNT(clGetProgramInfo);
    COUNT(clGetProgramBuildInfo);
    COUNT(clCreateKernel);
    COUNT(clSetKernelArg);
    COUNT(clGetKernelInfo);
    COUNT(clEnqueueNDRangeKernel);
    COUNT(clEnqueueReadBuffer);
    COUNT(clEnqueueWriteBuffer);
    COUNT(clEnqueueMapBuffer);
    COUNT(clEnqueueUnmapMemObject);
    COUNT(clFlush);
    COUNT(clFinish);
    COUNT(clWaitForEvents);
    COUNT(clGetEventProfilingInfo);
#undef COUNT
}

/// The platform of PoCL, whose library its .icd file names; null where there is none.
cl_platform_id pocl() {
    std::string library;
    std::getline(std::ifstream("/etc/OpenCL/vendors/pocl.icd"), library);
    void* const handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) return nullptr;
    const auto find =
        reinterpret_cast<void* (*)(const char*)>(::dlsym(handle, "clGetExtensionFunctionAddress"));
    if (find == nullptr) return nullptr;
    const auto platforms =
        reinterpret_cast<clIcdGetPlatformIDsKHR_fn>(find("clIcdGetPlatformIDsKHR"));
    cl_platform_id platform = nullptr;
    if (platforms == nullptr || platforms(1, &platform, nullptr) != CL_SUCCESS) return nullptr;
    return platform;
}

/// Replaces calls in the table that all objects of PoCL refer to.
void replace_calls(cl_platform_id platform) {
    std::memcpy(&table, platform, sizeof(table));  // the first member of every object
    const auto page = static_cast<std::uintptr_t>(::sysconf(_SC_PAGESIZE));
    const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(table) / page * page;
    const std::uintptr_t end = reinterpret_cast<std::uintptr_t>(table + 1);
    ::mprotect(reinterpret_cast<void*>(first), end - first, PROT_READ | PROT_WRITE);
    behind = *table;
    if (fault().starts_with("fail=")) return count_calls();
    table->clGetDeviceInfo = device_info;
    table->clBuildProgram = build_program;
    table->clEnqueueNDRangeKernel = launch;
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) cl_int CL_API_CALL
clIcdGetPlatformIDsKHR(cl_uint count, cl_platform_id* platforms, cl_uint* found) {
    if (fault() == "crash-open") crash();
    if (fault() == "hang-open") hang();
    if (fault() == "exit-open") std::exit(7);
    if (fault() == "quit-open") std::exit(0);
    static const cl_platform_id platform = pocl();
    if (platform == nullptr) return CL_PLATFORM_NOT_FOUND_KHR;
    if (table == nullptr) replace_calls(platform);
    if (found != nullptr) *found = 1;
    if (platforms != nullptr && count > 0) platforms[0] = platform;
    return CL_SUCCESS;
}

__attribute__((visibility("default"))) cl_int CL_API_CALL clGetPlatformInfo(cl_platform_id platform,
                                                                            cl_platform_info what,
                                                                            size_t size, void* to,
                                                                            size_t* needed) {
    return behind.clGetPlatformInfo(platform, what, size, to, needed);
}

__attribute__((visibility("default"))) void* CL_API_CALL
clGetExtensionFunctionAddress(const char* name) {
    if (std::strcmp(name, "clIcdGetPlatformIDsKHR") == 0)
        return reinterpret_cast<void*>(clIcdGetPlatformIDsKHR);
    if (std::strcmp(name, "clGetPlatformInfo") == 0)
        return reinterpret_cast<void*>(clGetPlatformInfo);
    return nullptr;
}
}
