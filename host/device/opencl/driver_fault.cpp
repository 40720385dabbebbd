// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/driver_fault.h"

#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <link.h>
#include <sys/stat.h>
#include <termios.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/quote.h"
#include "device/opencl/driver_folder.h"

// Bounds of the program's own code, by the linker.
extern "C" {
extern const char __executable_start;  // NOLINT(bugprone-reserved-identifier): the linker's name
extern const char etext;
}

namespace weft {
namespace {

struct Fault {
    int signal;
    const char* name;
};
constexpr std::array<Fault, 5> faults{{{SIGSEGV, "segmentation fault"},
                                       {SIGBUS, "bus error"},
                                       {SIGILL, "illegal instruction"},
                                       {SIGFPE, "arithmetic fault"},
                                       {SIGABRT, "abort"}}};

/// What there is to say: the line in two parts, between which stands what the driver did, or
/// another one where its folder is full; and a file to leave. Kept to the very end: a driver's
/// thread may fault while the program ends.
struct FaultReport {
    std::string before, after;
    std::string full;
    std::string mark;
};
std::atomic<const FaultReport*> report{nullptr};
std::atomic<bool> told{false};
std::atomic<bool> reports{false};  ///< not where no driver is in use
std::atomic<bool> watches_exits{false};
std::atomic<int> exit_code{-1};  ///< of the command, once it is done
/// Standard error as it was at first: it may lead nowhere while a driver compiles.
int errors = STDERR_FILENO;
std::array<struct sigaction, faults.size()> earlier{};
std::terminate_handler usual_terminate = nullptr;

void write_text(std::string_view text) {
    static_cast<void>(::write(errors, text.data(), text.size()) < 0);
}

/// Ends the program with the line about its driver: what that did, and more about it, which may be
/// empty. Signal handlers may call it.
[[noreturn]] void end_with_report(std::string_view what, std::string_view more) {
    if (const int code = exit_code; code >= 0) ::_exit(code);
    // Several threads may fault at once; the first one tells.
    if (told.exchange(true))
        for (;;) ::pause();
    // There may be a progress bar.
    termios terminal{};
    if (::tcgetattr(errors, &terminal) == 0) write_text("\n");
    const FaultReport& text = *report;
    if (driver_folder_is_full()) {
        write_text(text.full);
        ::_exit(static_cast<int>(ExitCode::device));
    }
    if (!text.mark.empty()) ::open(text.mark.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, S_IRUSR);
    write_text(text.before);
    write_text(what);
    if (!more.empty()) {
        write_text(" (");
        write_text(more);
        write_text(")");
    }
    write_text(text.after);
    ::_exit(static_cast<int>(ExitCode::device));
}

bool is_own_code(std::uintptr_t at) {
    return at >= reinterpret_cast<std::uintptr_t>(&__executable_start) &&
           at < reinterpret_cast<std::uintptr_t>(&etext);
}

/// Whether the fault is at an instruction of this program; not known on every processor.
bool is_own(const void* context) {
#if defined(__x86_64__) && defined(__linux__)
    const auto at = static_cast<std::uintptr_t>(
        static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RIP]);
#elif defined(__aarch64__) && defined(__linux__)
    const auto at =
        static_cast<std::uintptr_t>(static_cast<const ucontext_t*>(context)->uc_mcontext.pc);
#else
    static_cast<void>(context);
    const std::uintptr_t at = 0;
#endif
    return is_own_code(at);
}

extern "C" void weft_handle_fault(int signal, siginfo_t* info, void* context) {
    std::size_t which = 0;
    while (which + 1 < faults.size() && faults[which].signal != signal) ++which;
    // Signals that another process sends are no faults.
    const bool sent = info->si_code == SI_USER && info->si_pid != ::getpid();
    const bool matters_not = exit_code >= 0;
    if (sent || is_own(context) || (!reports && !matters_not)) {
        ::sigaction(signal, &earlier[which], nullptr);
        if (sent) ::raise(signal);
        return;  // the same instruction faults again
    }
    end_with_report("crashed", faults[which].name);
}

extern "C" void weft_handle_exit() {
    if (watches_exits && reports) end_with_report("ended the program", {});
}

extern "C" void weft_handle_llvm_error(const char* reason) {
    end_with_report("ended the program", one_line(reason));
}

constexpr const char* llvm_library = "/libLLVM";  ///< what paths of its files contain

/// Adds the file of a loaded library to the list, where it is of LLVM.
extern "C" int weft_add_llvm_library(dl_phdr_info* library, std::size_t, void* list) {
    if (std::strstr(library->dlpi_name, llvm_library) != nullptr)
        static_cast<std::vector<std::string>*>(list)->emplace_back(library->dlpi_name);
    return 0;
}

/// Has the LLVM libraries of drivers tell their errors here: they would print lines of their own
/// before they exit. And has them install their handlers of signals, which they do but once, so
/// that they can be replaced: LLVM would do that when it first compiles, and its handler of aborts
/// lets the process die.
void prepare_llvm() {
    using Handler = void (*)(const char*);
    std::vector<std::string> files;
    ::dl_iterate_phdr(weft_add_llvm_library, &files);
    for (const std::string& file : files) {
        void* const library = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_NOLOAD);
        if (library == nullptr) continue;
        if (void* const install = ::dlsym(library, "LLVMInstallFatalErrorHandler"))
            reinterpret_cast<void (*)(Handler)>(install)(weft_handle_llvm_error);
        if (void* const handle_signals = ::dlsym(library, "LLVMEnablePrettyStackTrace"))
            reinterpret_cast<void (*)()>(handle_signals)();
        ::dlclose(library);
    }
}

/// Whether the handler of a signal is LLVM's.
bool is_of_llvm(int signal) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) != 0) return false;
    Dl_info library{};
    return ::dladdr(reinterpret_cast<const void*>(action.sa_handler), &library) != 0 &&
           std::strstr(library.dli_fname, llvm_library) != nullptr;
}

/// Memory for handlers of the calling thread, so that one that has run out of stack can run them.
void use_own_stack() {
    static std::array<char, 65536> memory;
    stack_t stack{};
    stack.ss_sp = memory.data();
    stack.ss_size = memory.size();
    ::sigaltstack(&stack, nullptr);
}

/// Whether the code that has called the C++ runtime to end the program is a driver's, and not this
/// program's.
bool is_terminated_by_driver() {
    std::array<void*, 64> frames{};
    const int count = ::backtrace(frames.data(), static_cast<int>(frames.size()));
    bool in_runtime = false;
    for (const void* const frame : std::span(frames).first(static_cast<std::size_t>(count))) {
        Dl_info library{};
        const bool known = ::dladdr(frame, &library) != 0;
        const std::string_view name(known ? library.dli_fname : "");
        if (name.find("/libstdc++") != std::string_view::npos ||
            name.find("/libgcc_s") != std::string_view::npos ||
            name.find("/libc.") != std::string_view::npos)
            in_runtime = true;
        else if (in_runtime)  // before it is this handler
            return !is_own_code(reinterpret_cast<std::uintptr_t>(frame));
    }
    return false;
}

/// What std::terminate does: an exception that nobody catches is a fault of who has thrown it.
[[noreturn]] void handle_terminate() {
    if (const int code = exit_code; code >= 0) ::_exit(code);
    if (reports && is_terminated_by_driver())
        end_with_report("ended the program", "an exception that it did not catch");
    std::signal(SIGABRT, SIG_DFL);
    if (usual_terminate != nullptr) usual_terminate();
    std::abort();
}

/// Has faults end with these words; the first call installs what notices them.
void install(const std::string& who, const std::filesystem::path& mark) {
    const bool first = report.load() == nullptr;
    static auto& kept = *new std::deque<FaultReport>;
    report = &kept.emplace_back(FaultReport{fmt::format("weft: {} ", who),
                                            ", expected one that works (try --backend embree)\n",
                                            "weft: " + full_driver_folder() + "\n", mark.string()});
    std::atexit(weft_handle_exit);  // again, before the handlers of drivers opened since
    reports = true;
    if (!first) return;
    if (const int copy = ::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1); copy >= 0)
        errors = copy;
    use_own_stack();
    usual_terminate = std::set_terminate(handle_terminate);
    struct sigaction action {};
    action.sa_sigaction = weft_handle_fault;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    ::sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < faults.size(); ++i)
        ::sigaction(faults[i].signal, &action, &earlier[i]);
}

}  // namespace

void report_driver_faults(const std::filesystem::path& mark) {
    install("an OpenCL driver", mark);
}

void report_driver_faults(const DeviceInfo& device, const std::filesystem::path& mark) {
    install(fmt::format("OpenCL device {} \"{}\": its driver", device.index, one_line(device.name)),
            mark);
}

void forget_driver_faults() noexcept {
    reports = false;
}

void ignore_driver_faults(ExitCode code) noexcept {
    exit_code = static_cast<int>(code);
}

DriverOpening::DriverOpening() noexcept {
    for (int signal = 1; signal < NSIG; ++signal)
        ::sigaction(signal, nullptr, &before_[static_cast<std::size_t>(signal)]);
}

DriverOpening::~DriverOpening() {
    try {
        if (report.load() != nullptr) prepare_llvm();
    } catch (const std::bad_alloc&) {
        // Then LLVM says in its own words what is wrong.
    }
    for (int signal = 1; signal < NSIG; ++signal)
        if (is_of_llvm(signal))
            ::sigaction(signal, &before_[static_cast<std::size_t>(signal)], nullptr);
}

ExitWatch::ExitWatch() noexcept {
    watches_exits = true;
}

ExitWatch::~ExitWatch() {
    watches_exits = false;
}

}  // namespace weft
