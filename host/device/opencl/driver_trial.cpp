// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/driver_trial.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <exception>
#include <new>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/null_device.h"
#include "base/processor_wait.h"
#include "base/quote.h"
#include "base/stopwatch.h"
#include "device/opencl/device_trial.h"
#include "device/opencl/driver_folder.h"
#include "device/opencl/opencl_devices.h"

namespace weft {
namespace {

// What a trial's process tells, a line each: a tag, then fields after tabs.
constexpr char device_tag = 'D';     ///< a device: its name and its driver
constexpr char listed_tag = 'L';     ///< all devices have been told
constexpr char result_tag = 'R';     ///< what is wrong with the next device, or nothing
constexpr char momentary_tag = 'M';  ///< the same, where another time it may pass
constexpr char failed_tag = 'F';     ///< the driver cannot be used: why

// Whoever lists more devices than that in one driver has made them up.
constexpr std::size_t most_devices = 1000;

class Teller {
  public:
    explicit Teller(int to) : to_(to) {}

    void tell(char tag, std::string_view first = {}, std::string_view second = {}) const {
        const std::string line =
            fmt::format("{}\t{}\t{}\n", tag, one_line(first), one_line(second));
        std::string_view left = line;
        while (!left.empty()) {
            const ssize_t sent = ::write(to_, left.data(), left.size());
            if (sent < 0 && errno == EINTR) continue;
            if (sent <= 0) ::_exit(1);
            left.remove_prefix(static_cast<std::size_t>(sent));
        }
    }

  private:
    int to_;
};

/// Gives the process a session and group of its own, which a signal reaches with all it has
/// started, and nobody to talk to; a crash leaves no core file.
void set_apart(pid_t parent) {
    ::setsid();
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if (::getppid() != parent) ::_exit(0);  // the parent ended before prctl
    const rlimit none{0, 0};
    ::setrlimit(RLIMIT_CORE, &none);
    lead_to_null_device({STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO});
}

/// The process of a trial, from its `first` device on.
[[noreturn]] void run_trial(const DriverFile& driver, const std::filesystem::path& list,
                            std::size_t first, pid_t parent, int out) noexcept {
    set_apart(parent);
    const Teller teller(out);
    try {
        // The loader passes over libraries that it cannot open, and says nothing.
        if (::dlopen(driver.library.c_str(), RTLD_LAZY | RTLD_LOCAL) == nullptr) {
            const char* const reason = ::dlerror();
            teller.tell(failed_tag, fmt::format("its library cannot be loaded ({})",
                                                reason != nullptr ? reason : "no reason given"));
            ::_exit(0);
        }
        open_only(list);
        ::unsetenv("WEFT_KERNELS");  // what users make of kernels is no fault of the driver
        const std::vector<OpenClDevice> devices = opencl_devices();
        for (const OpenClDevice& device : devices)
            teller.tell(device_tag, device.info.name, device.info.driver);
        teller.tell(listed_tag);
        for (std::size_t i = first; i < devices.size(); ++i) {
            const DeviceVerdict verdict = try_device(devices[i]);
            teller.tell(verdict.momentary ? momentary_tag : result_tag, verdict.failure);
        }
    } catch (const std::bad_alloc&) {
        teller.tell(failed_tag, "it asks for more memory than there is to describe its devices");
    } catch (const std::length_error&) {
        teller.tell(failed_tag, "it describes its devices by texts of impossible lengths");
    } catch (const std::exception& error) {
        teller.tell(failed_tag, error.what());
    }
    // The driver's exit handlers are left out: they are not what is tried.
    ::_exit(0);
}

/// A driver that is being tried, by one process after another.
class Attempt {
  public:
    Attempt(const DriverFile& driver, const std::filesystem::path& cache_folder) {
        trial_.driver = driver;
        try {
            list_ = list_drivers(std::span(&driver, 1), cache_folder);
        } catch (const std::exception& error) {
            trial_.failure = error.what();
            trial_.momentary = true;
            return;
        }
        start();
    }
    ~Attempt() { stop(); }
    Attempt(const Attempt&) = delete;
    Attempt& operator=(const Attempt&) = delete;

    [[nodiscard]] bool done() const { return process_ < 0; }
    [[nodiscard]] int input() const { return input_; }
    [[nodiscard]] const DriverTrial& trial() const { return trial_; }

    /// Takes what the process has told, or its end.
    void advance() {
        std::array<char, 4096> bytes{};
        const ssize_t got = ::read(input_, bytes.data(), bytes.size());
        if (got < 0 && errno == EINTR) return;
        if (got > 0) {
            text_.append(bytes.data(), static_cast<std::size_t>(got));
            for (std::size_t end = text_.find('\n'); end != std::string::npos;
                 end = text_.find('\n')) {
                take(std::string_view(text_).substr(0, end));
                text_.erase(0, end + 1);
            }
            return;
        }
        end();
    }

    /// Counts time; ends the process where it has had more than `seconds` for what it does now.
    void spend(double ms, double seconds) {
        spent_ms_ += ms;
        const double waited = processor_wait_ms(process_) - waited_before_ms_;
        if (hung_) seconds *= 0.4;
        if (spent_ms_ < 1000.0 * seconds + std::clamp(waited, 0.0, 2000.0 * seconds)) return;
        stop();
        fail_next(fmt::format("its driver does not answer within {:.0f} s", seconds));
        if (!hung_ && has_next()) return try_after_hang();
        while (has_next()) fail_next("two devices before it have not answered");
    }

  private:
    [[nodiscard]] bool has_next() const { return listed_ && next_ < trial_.devices.size(); }

    /// Other devices may work; but a user is not to wait as long for each of them.
    void try_after_hang() {
        hung_ = true;
        start();
    }

    /// Starts a process that tries the devices from the next on.
    void start() {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) return fail_to_start();
        told_ = 0;
        text_.clear();
        told_failure_.clear();
        const pid_t parent = ::getpid();
        process_ = ::fork();
        if (process_ == 0) {
            ::close(ends[0]);
            run_trial(trial_.driver, list_, next_, parent, ends[1]);
        }
        ::close(ends[1]);
        input_ = ends[0];
        restart_clock();
        if (process_ >= 0) return;
        ::close(input_);
        fail_to_start();
    }

    void fail_to_start() {
        trial_.momentary = true;
        do fail_next("no process can be started to try it");
        while (has_next());
    }

    /// Takes the end of the process, which has closed its pipe, and goes on with the next device.
    void end() {
        std::string how = finish();
        if (!told_failure_.empty()) how = std::move(told_failure_);
        if (listed_ && next_ == trial_.devices.size()) {
            // All have been tried, the last one by this process.
            if (next_ > 0 && trial_.devices.back().failure.empty())
                trial_.devices.back().failure = std::move(how);
            return;
        }
        fail_next(how.empty() ? "its driver ends the program (exit code 0)" : std::move(how));
        if (has_next()) start();
    }

    /// Waits for the end of a process that has closed its pipe, and ends it where it does not;
    /// says how it ended, where that was not as it should be.
    std::string finish() {
        constexpr int moments = 1000;  // of a millisecond
        int status = 0;
        for (int i = 0; i < moments; ++i) {
            const pid_t ended = ::waitpid(process_, &status, WNOHANG);
            if (ended == process_ || (ended < 0 && errno == ECHILD)) {
                process_ = -1;
                ::close(input_);
                return ended < 0 ? std::string() : end_of(status);
            }
            ::usleep(1000);
        }
        stop();
        return "its driver does not let the program end";
    }

    /// Ends the process, if there is one, and all that it has started.
    void stop() {
        if (process_ < 0) return;
        ::close(input_);
        ::kill(-process_, SIGKILL);
        ::kill(process_, SIGKILL);
        while (::waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
        process_ = -1;
    }

    std::string end_of(int status) {
        if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGKILL || WTERMSIG(status) == SIGTERM)) {
            trial_.momentary = true;
            return "its trial was ended from outside";
        }
        if (status == 0) return {};
        if (driver_folder_is_full()) {
            trial_.momentary = true;
            return "nothing can be written to the folder that it needs";
        }
        if (WIFSIGNALED(status))
            return fmt::format("its driver crashes ({})", ::strsignal(WTERMSIG(status)));
        return fmt::format("its driver ends the program (exit code {})", WEXITSTATUS(status));
    }

    /// Takes note of what is wrong with the device that is tried, or with the driver before it has
    /// listed any.
    void fail_next(std::string failure) {
        if (!listed_)
            trial_.failure = std::move(failure);
        else if (next_ < trial_.devices.size())
            trial_.devices[next_++].failure = std::move(failure);
    }

    void restart_clock() {
        spent_ms_ = 0.0;
        waited_before_ms_ = processor_wait_ms(process_);
    }

    void take(std::string_view line) {
        const std::size_t tab = std::min(line.find('\t'), line.size());
        const std::string_view rest = line.substr(std::min(tab + 1, line.size()));
        const std::size_t second = std::min(rest.find('\t'), rest.size());
        std::string first(rest.substr(0, second));
        switch (line.empty() ? '\0' : line.front()) {
            case device_tag:
                // A process after the first lists them again.
                if (told_++ == trial_.devices.size() && !listed_ && told_ <= most_devices)
                    trial_.devices.push_back(
                        {first, std::string(rest.substr(std::min(second + 1, rest.size()))), {}});
                break;
            case listed_tag:
                listed_ = true;
                break;
            case momentary_tag:
                trial_.momentary = true;
                [[fallthrough]];
            case result_tag:
                fail_next(std::move(first));
                restart_clock();
                break;
            case failed_tag:
                told_failure_ = std::move(first);
                break;
            default:
                break;
        }
    }

    DriverTrial trial_;
    std::filesystem::path list_;
    pid_t process_ = -1;
    int input_ = -1;
    std::string text_;  ///< told, of a line that is not whole
    bool listed_ = false;
    std::string told_failure_;       ///< why the process cannot use the driver
    bool hung_ = false;              ///< a device has not answered
    std::size_t told_ = 0;           ///< devices, by this process
    std::size_t next_ = 0;           ///< the first device of which nothing is known yet
    double spent_ms_ = 0.0;          ///< since the process began, or told of a device
    double waited_before_ms_ = 0.0;  ///< processor_wait_ms at that time
};

}  // namespace

std::vector<DriverTrial> try_drivers(std::span<const DriverFile> drivers,
                                     const std::filesystem::path& cache_folder, double seconds) {
    // Time is counted in steps, of which a long one counts as short: this process may have been
    // stopped for a while, and has not looked then.
    constexpr int step = 200;
    constexpr double longest_step = 1000.0;
    std::deque<Attempt> attempts;
    for (const DriverFile& driver : drivers) attempts.emplace_back(driver, cache_folder);
    for (;;) {
        std::vector<pollfd> ends;
        std::vector<Attempt*> running;
        for (Attempt& attempt : attempts)
            if (!attempt.done()) {
                ends.push_back({attempt.input(), POLLIN, 0});
                running.push_back(&attempt);
            }
        if (running.empty()) break;
        const Stopwatch watch;
        const int ready = ::poll(ends.data(), ends.size(), step);
        const double ms = std::min(watch.total(), longest_step);
        for (std::size_t i = 0; i < running.size(); ++i)
            if (ready > 0 && ends[i].revents != 0)
                running[i]->advance();
            else
                running[i]->spend(ms, seconds);
    }
    std::vector<DriverTrial> trials;
    for (const Attempt& attempt : attempts) trials.push_back(attempt.trial());
    return trials;
}

}  // namespace weft
