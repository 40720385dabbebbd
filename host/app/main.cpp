// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>

#include <csignal>
#include <new>
#include <optional>
#include <variant>

#include "app/commands.h"
#include "app/options.h"
#include "app/print.h"
#include "base/diagnostics.h"
#include "base/error.h"
#include "base/require_memory.h"
#if WEFT_HAS_OPENCL
#include "device/opencl/driver_fault.h"
#include "device/opencl/opencl_start.h"
#endif

namespace {

#if WEFT_HAS_OPENCL
/// Whether a command may run kernels on an OpenCL device.
bool uses_opencl(const weft::ParsedCommand& command) {
    return std::visit(
        [](const auto& options) {
            if constexpr (requires { options.image.backend; })
                return options.image.backend.value_or(weft::Backend::opencl) ==
                       weft::Backend::opencl;
            else if constexpr (requires { options.backend; })
                return options.backend.value_or(weft::Backend::opencl) == weft::Backend::opencl;
            else
                return false;
        },
        command);
}
#endif

/// Whether a command is to name every place of its warnings.
bool is_verbose(const weft::ParsedCommand& command) {
    return std::visit(
        [](const auto& options) {
            if constexpr (requires { options.verbose; })
                return options.verbose;
            else
                return false;
        },
        command);
}

/// Makes TBB's threads and the arena of this one while there is memory for them.
void start_threads() {
    weft::require_memory(weft::arena_memory);
    tbb::parallel_for(0, 1, [](int) {});
}

/// What main returns, whatever drivers do while they are unloaded.
int exit_status(weft::ExitCode code) {
#if WEFT_HAS_OPENCL
    weft::ignore_driver_faults(code);
#endif
    return static_cast<int>(code);
}

weft::ExitCode run(const weft::ParsedCommand& command, weft::Diagnostics& diagnostics) {
    if (const auto* help = std::get_if<weft::HelpText>(&command)) {
        weft::print_result(help->text);
        return weft::ExitCode::success;
    }
    start_threads();
    if (const auto* render = std::get_if<weft::RenderOptions>(&command)) {
        return weft::render_command(*render, diagnostics);
    } else if (const auto* view = std::get_if<weft::ViewOptions>(&command)) {
        return weft::view_command(*view, diagnostics);
    } else if (const auto* merge = std::get_if<weft::MergeOptions>(&command)) {
        weft::merge_command(*merge, diagnostics);
    } else if (const auto* compare = std::get_if<weft::CompareOptions>(&command)) {
        weft::compare_command(*compare);
    } else if (const auto* info = std::get_if<weft::InfoOptions>(&command)) {
        weft::info_command(*info, diagnostics);
    } else if (const auto* devices = std::get_if<weft::DevicesOptions>(&command)) {
        return weft::devices_command(*devices);
    } else if (const auto* selftest = std::get_if<weft::SelftestOptions>(&command)) {
        return weft::selftest_command(*selftest);
    } else if (const auto* tradeoff = std::get_if<weft::TradeoffOptions>(&command)) {
        weft::tradeoff_command(*tradeoff, diagnostics);
    }
    return weft::ExitCode::success;
}

}  // namespace

int main(int argc, char** argv) {
    // Writing to a pipe whose reader has gone, or beyond the size that files may have, must fail as
    // an error and not end the program.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    // Whoever started the program may not wait for processes; this one does.
    std::signal(SIGCHLD, SIG_DFL);
    weft::Diagnostics diagnostics;
    bool verbose = false;
    try {
        const weft::ParsedCommand command = weft::parse_command_line(argc, argv);
#if WEFT_HAS_OPENCL
        std::optional<weft::OpenClStart> opencl;
        const auto* const devices = std::get_if<weft::DevicesOptions>(&command);
        if (devices != nullptr || uses_opencl(command))
            opencl.emplace(devices != nullptr && devices->check ? weft::TrialUse::fresh
                                                                : weft::TrialUse::remembered,
                           diagnostics);
#endif
        verbose = is_verbose(command);
        const weft::ExitCode code = run(command, diagnostics);
        weft::print_warnings(diagnostics, verbose);
        return exit_status(code);
    } catch (const weft::Error& error) {
        weft::print_warnings(diagnostics, verbose);
        weft::print_message(error.what());
        return exit_status(error.code());
    } catch (const std::bad_alloc&) {
        weft::print_message("out of memory");
        return exit_status(weft::ExitCode::out_of_memory);
    } catch (const std::exception& error) {
        if (weft::says_no_thread(error.what())) {
            weft::print_message("out of memory: no thread can be started");
            return exit_status(weft::ExitCode::out_of_memory);
        }
        weft::print_message(error.what());
        return exit_status(weft::ExitCode::device);
    }
}
