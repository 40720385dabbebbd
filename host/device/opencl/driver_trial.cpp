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
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/null_device.h"
#include "base/processor_wait.h"
#include "base/quote.h"
#include "base/stopwatch.h"
#include "device/opencl/device_trial.h"
#include "device/opencl/opencl_devices.h"

namespace weft {
namespace {

// What a trial's process tells, a line each: a tag, then fields after tabs.
constexpr char device_tag = 'D';  ///< a device: its name and its driver
constexpr char listed_tag = 'L';  ///< all devices have been told
constexpr char begins_tag = 'B';  ///< begins to try a device: its position
constexpr char result_tag = 'R';  ///< what is wrong with that device, or nothing
constexpr char failed_tag = 'F';  ///< the driver cannot be used: why

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
[[noreturn]] void run_trial(const DriverFile& driver, const std::filesystem::path& cache_folder,
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
        open_only(std::span(&driver, 1), cache_folder);
        ::unsetenv("WEFT_KERNELS");  // what users make of kernels is no fault of the driver
        const std::vector<OpenClDevice> devices = opencl_devices();
        for (const OpenClDevice& device : devices)
            teller.tell(device_tag, device.info.name, device.info.driver);
        teller.tell(listed_tag);
        for (std::size_t i = first; i < devices.size(); ++i) {
            teller.tell(begins_tag, std::to_string(i));
            teller.tell(result_tag, try_device(devices[i]));
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
    Attempt(const DriverFile& driver, const std::filesystem::path& cache_folder)
        : cache_folder_(cache_folder) {
        trial_.driver = driver;
        start(0);
    }
    ~Attempt() { stop(); }
    Attempt(const Attempt&) = delete;
    Attempt& operator=(const Attempt&) = delete;

    [[nodiscard]] bool done() const { return process_ < 0; }
    [[nodiscard]] int input() const { return input_; }
    /// See processor_wait_ms.
    [[nodiscard]] double waited_ms() const { return processor_wait_ms(process_); }
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
        blame(finish());
        // The next device may work, in a process of its own.
        if (listed_ && current_ && *current_ + 1 < trial_.devices.size()) start(*current_ + 1);
    }

    /// Ends the process, since its time is over.
    void give_up(double seconds) {
        stop();
        blame(fmt::format("its driver does not answer within {:.0f} s", seconds));
        for (std::size_t i = current_ ? *current_ + 1 : 0; i < trial_.devices.size(); ++i)
            trial_.devices[i].failure = "there was no time to try it";
    }

  private:
    void start(std::size_t first) {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
            trial_.failure = "no process can be started to try it";
            return;
        }
        told_ = 0;
        current_.reset();
        const pid_t parent = ::getpid();
        process_ = ::fork();
        if (process_ == 0) {
            ::close(ends[0]);
            run_trial(trial_.driver, cache_folder_, first, parent, ends[1]);
        }
        ::close(ends[1]);
        input_ = ends[0];
        if (process_ >= 0) return;
        ::close(input_);
        trial_.failure = "no process can be started to try it";
    }

    /// Waits for the end of a process that has closed its pipe, and ends it where it does not;
    /// says how it ended, where that was not as it should be.
    std::string finish() {
        constexpr int moments = 1000;  // of a millisecond
        int status = 0;
        for (int i = 0; i < moments; ++i) {
            if (::waitpid(process_, &status, WNOHANG) == process_) {
                process_ = -1;
                ::close(input_);
                return end_of(status);
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
            trial_.disturbed = true;
            return "its trial was ended from outside";
        }
        if (WIFSIGNALED(status))
            return fmt::format("its driver crashes ({})", ::strsignal(WTERMSIG(status)));
        if (WIFEXITED(status) && WEXITSTATUS(status) != 0)
            return fmt::format("its driver ends the program (exit code {})", WEXITSTATUS(status));
        return {};
    }

    /// Takes note of what went wrong with what was being tried.
    void blame(const std::string& failure) {
        if (failure.empty()) return;
        if (current_ && *current_ < trial_.devices.size())
            trial_.devices[*current_].failure = failure;
        else if (!listed_)
            trial_.failure = failure;
    }

    void take(std::string_view line) {
        const std::size_t tab = std::min(line.find('\t'), line.size());
        const std::string_view rest = line.substr(std::min(tab + 1, line.size()));
        const std::size_t second = std::min(rest.find('\t'), rest.size());
        const std::string first(rest.substr(0, second));
        switch (line.empty() ? '\0' : line.front()) {
            case device_tag:
                // A process after the first lists them again.
                if (told_++ == trial_.devices.size() && told_ <= most_devices)
                    trial_.devices.push_back(
                        {first, std::string(rest.substr(std::min(second + 1, rest.size()))), {}});
                break;
            case listed_tag:
                listed_ = true;
                break;
            case begins_tag: {
                std::size_t position = 0;
                std::from_chars(first.data(), first.data() + first.size(), position);
                current_ = position;
                break;
            }
            case result_tag:
                blame(first);
                break;
            case failed_tag:
                trial_.failure = first;
                break;
            default:
                break;
        }
    }

    const std::filesystem::path& cache_folder_;
    DriverTrial trial_;
    pid_t process_ = -1;
    int input_ = -1;
    std::string text_;  ///< told, of a line that is not whole
    bool listed_ = false;
    std::size_t told_ = 0;                ///< devices, by this process
    std::optional<std::size_t> current_;  ///< the device that is being tried
};

/// Milliseconds that are left to drivers that have `seconds`, as poll takes them. What they waited
/// for a processor on a busy machine is added, up to twice as long again.
int left_of(double seconds, const Stopwatch& watch, std::span<Attempt* const> running) {
    double waited = 0.0;
    for (const Attempt* const attempt : running) waited = std::max(waited, attempt->waited_ms());
    const double all = 1000.0 * seconds + std::min(waited, 2000.0 * seconds);
    return static_cast<int>(std::clamp(all - watch.total(), 0.0, 1e6));
}

}  // namespace

std::vector<DriverTrial> try_drivers(std::span<const DriverFile> drivers,
                                     const std::filesystem::path& cache_folder, double seconds) {
    const Stopwatch watch;
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
        const int left = left_of(seconds, watch, running);
        if (running.empty() || left == 0) break;
        if (::poll(ends.data(), ends.size(), left) < 0) continue;
        for (std::size_t i = 0; i < running.size(); ++i)
            if (ends[i].revents != 0) running[i]->advance();
    }
    std::vector<DriverTrial> trials;
    for (Attempt& attempt : attempts) {
        if (!attempt.done()) attempt.give_up(seconds);
        trials.push_back(attempt.trial());
    }
    return trials;
}

}  // namespace weft
