// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/compile_workers.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <memory>
#include <new>
#include <numeric>

#include "base/stopwatch.h"
#include "device/kernel_signature.h"
#include "device/opencl/opencl_devices.h"
#include "device/opencl/program_cache.h"
#include "shared/shared_types.h"

namespace weft {
namespace {

/// Memory that workers and their server share: which program is next, and the time of each, which
/// is below zero until it is compiled.
class Board {
  public:
    explicit Board(std::size_t programs) : programs_(programs) {
        void* const memory =
            ::mmap(nullptr, bytes(), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED) throw std::bad_alloc();
        times_ = static_cast<Time*>(memory);
        for (std::size_t i = 0; i < programs_; ++i) new (times_ + i) Time(-1.0);
        next_ = new (times_ + programs_) Next(0);
    }
    ~Board() { ::munmap(times_, bytes()); }
    Board(const Board&) = delete;
    Board& operator=(const Board&) = delete;

    /// The position of a program that no worker has taken; past the last one where none remains.
    std::size_t take() { return next_->fetch_add(1); }
    void finish(std::size_t program, double milliseconds) { times_[program] = milliseconds; }
    [[nodiscard]] CompileTimes times() const {
        CompileTimes times(programs_);
        for (std::size_t i = 0; i < programs_; ++i)
            if (const double time = times_[i]; time >= 0.0) times[i] = time;
        return times;
    }

  private:
    using Time = std::atomic<double>;
    using Next = std::atomic<std::uint64_t>;
    static_assert(Time::is_always_lock_free && Next::is_always_lock_free,
                  "locks would not be shared between processes");
    static_assert(sizeof(Time) == sizeof(Next) && alignof(Time) >= alignof(Next));

    [[nodiscard]] std::size_t bytes() const { return (programs_ + 1) * sizeof(Time); }

    std::size_t programs_;
    Time* times_ = nullptr;
    Next* next_ = nullptr;
};

/// Orders programs by falling length of their source, so that none that takes long comes last.
std::vector<std::size_t> order_of(const std::vector<ProgramRecipe>& programs) {
    std::vector<std::size_t> order(programs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return programs[a].source.size() > programs[b].source.size();
    });
    return order;
}

/// Launches no work-items: drivers compile for the launch size, and keep that in the program's
/// binary.
void launch_nothing(const cl::Context& context, const cl::Device& device, cl::Kernel& kernel,
                    const ProgramRecipe& recipe) {
    const std::optional<KernelId> id = kernel_of(recipe.name);
    if (!id) throw cl::Error(CL_INVALID_KERNEL_NAME, "a program of another kernel");
    constexpr std::array<std::byte, most_argument_bytes> nothing{};
    cl_uint index = 0;
    kernel.setArg(index++, sizeof(shared::RenderParams), nothing.data());
    kernel.setArg(index++, sizeof(shared::LaunchRange), nothing.data());
    for (int buffer = 0; kernel_traces(*id) && buffer < 2; ++buffer)
        kernel.setArg(index++, sizeof(cl_mem), nullptr);
    for (const ArgumentInfo& argument : kernel_arguments(*id))
        kernel.setArg(index++, argument.bytes, argument.is_value ? nothing.data() : nullptr);
    const cl::CommandQueue queue(context, device);
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(recipe.global_size),
                               cl::NDRange(recipe.local_size));
    queue.finish();
}

/// Compiles a program into the cache; returns whether it is there afterwards.
bool compile(const cl::Context& context, const cl::Device& device, const ProgramCache& cache,
             const ProgramRecipe& recipe) {
    try {
        if (program_key(device, recipe.source, recipe.options) != recipe.key) return false;
        const cl::Program program(context, recipe.source);
        program.build({device}, recipe.options.c_str());
        cl::Kernel kernel(program, recipe.name.c_str());
        launch_nothing(context, device, kernel, recipe);
        const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
        if (binaries.empty()) return false;
        cache.store(recipe.key, binaries.front());
        return cache.contains(recipe.key);
    } catch (const cl::Error&) {
        return false;
    }
}

void compile_all(const CompileRequest& request, const std::vector<std::size_t>& order,
                 Board& board) {
    limit_opencl_threads(1);  // kernels do not run here
    const std::vector<OpenClDevice> devices = opencl_devices();
    if (request.device >= devices.size()) return;
    const cl::Device& device = devices[request.device].device;
    const cl::Context context(device);
    const ProgramCache cache(request.cache_folder);
    for (std::size_t at = board.take(); at < order.size(); at = board.take()) {
        const Stopwatch watch;
        if (compile(context, device, cache, request.programs[order[at]]))
            board.finish(order[at], watch.total());
    }
}

/// Runs a worker process to its end. `server` is its parent.
[[noreturn]] void work(const CompileRequest& request, const std::vector<std::size_t>& order,
                       Board& board, pid_t server) noexcept {
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    if (::getppid() != server) ::_exit(0);  // the server ended before prctl
    try {
        compile_all(request, order, board);
    } catch (...) {  // the client compiles the rest
    }
    ::_exit(0);
}

/// Waits until all processes that hold the other end of the pipe `workers` have ended; false where
/// the client has gone before.
bool wait_for_end(int workers, int client) {
    // poll reports the end of a connection even where no events are requested.
    std::array<pollfd, 2> ends{{{workers, 0, 0}, {client, 0, 0}}};
    while (ends[0].revents == 0 && ends[1].revents == 0)
        if (::poll(ends.data(), ends.size(), -1) < 0 && errno != EINTR) return false;
    return ends[1].revents == 0;
}

}  // namespace

std::optional<CompileTimes> compile_in_workers(const CompileRequest& request, int client) {
    const std::size_t count = request.programs.size();
    if (!ProgramCache(request.cache_folder).writable()) return CompileTimes(count);
    const std::vector<std::size_t> order = order_of(request.programs);
    Board board(count);
    std::array<int, 2> alive{};
    if (::pipe2(alive.data(), O_CLOEXEC) != 0) return CompileTimes(count);
    const pid_t server = ::getpid();
    std::vector<pid_t> workers;
    workers.reserve(std::min<std::size_t>(request.workers, count));
    while (workers.size() < workers.capacity()) {
        const pid_t worker = ::fork();
        if (worker == 0) {
            ::close(client);  // an open copy would hide the client's end from the server
            ::close(alive[0]);
            work(request, order, board, server);
        }
        if (worker < 0) break;
        workers.push_back(worker);
    }
    ::close(alive[1]);
    const bool wanted = wait_for_end(alive[0], client);
    ::close(alive[0]);
    for (const pid_t worker : workers) {
        if (!wanted) ::kill(worker, SIGKILL);
        while (::waitpid(worker, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
    if (!wanted) return {};
    return board.times();
}

}  // namespace weft
