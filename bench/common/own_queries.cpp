// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/own_queries.h"

#include <array>

#include "base/error.h"
#include "device/launch.h"
#include "device/native/native_executor.h"
#if WEFT_HAS_OPENCL
#include "device/opencl/opencl_executor.h"
#endif

namespace weft::bench {

namespace {

/// Runs a kernel and waits for it.
template <class Kernel>
Timing timed(Executor& executor, const Kernel& arguments, std::size_t items) {
    const RunTimer watch;
    run_kernel(executor, {}, arguments, static_cast<std::uint32_t>(items));
    const double ms = executor.take_milliseconds();
    Timing timing = watch.elapsed();
    timing.ms = ms;
    return timing;
}

/// Single rays on the device, and room for what a kernel answers.
template <class Kernel, class Answers>
struct RayQuery {
    RayQuery(Executor& on, const TracedScene& in, const RaySet& rays)
        : executor(on),
          scene(in),
          origins(upload<kinds::RayOrigins>(on, rays.origins, "ray origins")),
          directions(upload<kinds::RayDirections>(on, rays.directions, "ray directions")),
          answers(allocate<Answers>(on, rays.size(), "answers")),
          count(rays.size()) {}

    Timing run() const {
        return timed(executor, Kernel{scene, origins, directions, answers}, count);
    }
    /// The answers as `As`, of the same size.
    template <class As>
    std::vector<As> read() const {
        return read_buffer<As>(executor, *answers, count);
    }

    Executor& executor;
    const TracedScene& scene;
    DeviceBuffer<kinds::RayOrigins> origins;
    DeviceBuffer<kinds::RayDirections> directions;
    DeviceBuffer<Answers> answers;
    std::size_t count;
};

/// Packets of shadow rays on the device.
struct PacketQuery {
    PacketQuery(Executor& on, const TracedScene& in, const PacketSet& packets)
        : executor(on),
          scene(in),
          origins(upload<kinds::BlockOrigins>(on, packets.block_origins, "packet origins")),
          rays(upload<kinds::PacketRays>(on, packets.planes, "packet directions")),
          blocked(allocate<kinds::PacketBlocked>(on, packets.slots(), "answers")),
          slots(static_cast<std::uint32_t>(packets.slots())) {}

    Timing run() const {
        return timed(executor,
                     kernels::query_packet{.scene = scene,
                                           .slots = slots,
                                           .block_origin = origins,
                                           .rays = rays,
                                           .blocked = blocked},
                     slots / executor.lanes());
    }

    Executor& executor;
    const TracedScene& scene;
    DeviceBuffer<kinds::BlockOrigins> origins;
    DeviceBuffer<kinds::PacketRays> rays;
    DeviceBuffer<kinds::PacketBlocked> blocked;
    std::uint32_t slots;
};

using ClosestQuery = RayQuery<kernels::query_closest, kinds::RayHits>;
using AnyQuery = RayQuery<kernels::query_any, kinds::RaysBlocked>;

}  // namespace

OwnQueries::OwnQueries(std::string name, Executor& executor, const TracedScene& scene)
    : name_(std::move(name)), executor_(executor), scene_(scene) {
    constexpr std::array kernels{KernelId::query_closest, KernelId::query_any,
                                 KernelId::query_packet};
    executor_.build(kernels, 0);
}

Candidate OwnQueries::closest(const RaySet& rays) const {
    const auto query = std::make_shared<ClosestQuery>(executor_, scene_, rays);
    const auto answers = [query] {
        std::vector<std::uint32_t> ids;
        for (const QueryHit& hit : query->read<QueryHit>()) ids.push_back(hit.triangle);
        return ids;
    };
    return {name_, false, {}, [query] { return query->run(); }, answers};
}

Candidate OwnQueries::any(const RaySet& rays) const {
    const auto query = std::make_shared<AnyQuery>(executor_, scene_, rays);
    const auto answers = [query] { return query->read<std::uint32_t>(); };
    return {name_, false, {}, [query] { return query->run(); }, answers};
}

Candidate OwnQueries::packets(const PacketSet& packets) const {
    const auto query = std::make_shared<PacketQuery>(executor_, scene_, packets);
    const auto answers = [query] {
        std::vector<std::uint32_t> blocked;
        for (const float x : read_buffer(query->executor, query->blocked, query->slots))
            blocked.push_back(x > 0.0F ? 1 : 0);
        return blocked;
    };
    return {name_, false, {}, [query] { return query->run(); }, answers};
}

std::vector<QueryHit> OwnQueries::trace(const RaySet& rays) const {
    const ClosestQuery query(executor_, scene_, rays);
    (void)query.run();
    return query.read<QueryHit>();
}

#if WEFT_HAS_OPENCL
std::unique_ptr<Executor> open_opencl(const std::string& wanted, int threads) {
    if (threads > 0) limit_opencl_threads(threads);
    if (!wanted.empty()) return make_opencl_executor(choose_opencl_device(wanted), threads);
    for (const OpenClDevice& device : opencl_devices())
        if (device.info.is_cpu && device.info.name.find("Oclgrind") == std::string::npos)
            return make_opencl_executor(device, threads);
    return nullptr;
}
#else
std::unique_ptr<Executor> open_opencl(const std::string&, int) {
    return nullptr;
}
#endif

std::unique_ptr<Executor> open_backend(const std::string& backend, const std::string& device,
                                       int threads) {
    if (backend == "embree") return make_native_executor(NativeTraversal::embree, threads);
    if (backend == "native") return make_native_executor(NativeTraversal::own_bvh, threads);
    auto opencl = open_opencl(device, threads);
    if (!opencl)
        throw Error(ExitCode::device,
                    "no OpenCL device was found, expected one or another backend");
    return opencl;
}

}  // namespace weft::bench
