// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/driver_fault.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <termios.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/quote.h"

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

/// What there is to say: the line in two parts, between which the name of the fault stands, and a
/// file to leave. Never freed: a driver's thread may fault while the program ends.
struct FaultReport {
    std::string before, after;
    std::string mark;
};
std::atomic<const FaultReport*> report{nullptr};
std::atomic<bool> told{false};
std::array<struct sigaction, faults.size()> earlier{};

void write_text(const char* text, std::size_t length) {
    static_cast<void>(::write(STDERR_FILENO, text, length) < 0);
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
    return at >= reinterpret_cast<std::uintptr_t>(&__executable_start) &&
           at < reinterpret_cast<std::uintptr_t>(&etext);
}

extern "C" void weft_handle_fault(int signal, siginfo_t* info, void* context) {
    std::size_t which = 0;
    while (which + 1 < faults.size() && faults[which].signal != signal) ++which;
    // Signals that another process sends are no faults.
    const bool sent = info->si_code == SI_USER && info->si_pid != ::getpid();
    if (sent || is_own(context)) {
        ::sigaction(signal, &earlier[which], nullptr);
        if (sent) ::raise(signal);
        return;  // the same instruction faults again
    }
    // Several threads may fault at once; the first one tells.
    if (told.exchange(true))
        for (;;) ::pause();
    // There may be a progress bar.
    termios terminal{};
    if (::tcgetattr(STDERR_FILENO, &terminal) == 0) write_text("\n", 1);
    const FaultReport& text = *report;
    if (!text.mark.empty()) ::open(text.mark.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, S_IRUSR);
    write_text(text.before.data(), text.before.size());
    const std::string_view name = faults[which].name;
    write_text(name.data(), name.size());
    write_text(text.after.data(), text.after.size());
    ::_exit(static_cast<int>(ExitCode::device));
}

/// Memory for handlers of the calling thread, so that one that has run out of stack can run them.
void use_own_stack() {
    static std::array<char, 65536> memory;
    stack_t stack{};
    stack.ss_sp = memory.data();
    stack.ss_size = memory.size();
    ::sigaltstack(&stack, nullptr);
}

}  // namespace

void report_driver_faults(const DeviceInfo& device, const std::filesystem::path& mark) {
    const bool first = report.load() == nullptr;
    report = new FaultReport{fmt::format("weft: OpenCL device {} \"{}\": its driver crashed (",
                                         device.index, one_line(device.name)),
                             "), expected one that works (try --backend embree)\n", mark.string()};
    if (!first) return;
    use_own_stack();
    struct sigaction action {};
    action.sa_sigaction = weft_handle_fault;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    ::sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < faults.size(); ++i)
        ::sigaction(faults[i].signal, &action, &earlier[i]);
}

}  // namespace weft
