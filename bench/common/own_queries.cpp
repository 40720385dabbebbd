// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/own_queries.h"

#include <array>

#include "base/error.h"
#include "device/native/native_executor.h"
#if WEFT_HAS_OPENCL
#include "device/opencl/opencl_executor.h"
#endif

namespace weft::bench {

/// One ray set on the device.
struct OwnQueries::Query {
    Executor& executor;
    const TracedScene& scene;
    KernelId kernel;
    std::unique_ptr<Buffer> first, second, answers;
    std::size_t slots;
    std::uint32_t items;

    Timing run() const {
        const Stopwatch watch;
        shared::Params params{};
        params.slots = static_cast<std::uint32_t>(slots);
        const std::array<Buffer*, 3> buffers{first.get(), second.get(), answers.get()};
        executor.run({kernel, params, &scene, buffers, items, 0}, {});
        const double ms = executor.take_milliseconds();
        Timing timing = watch.elapsed();
        timing.ms = ms;
        return timing;
    }
};

OwnQueries::OwnQueries(std::string name, Executor& executor, const TracedScene& scene)
    : name_(std::move(name)), executor_(executor), scene_(scene) {
    constexpr std::array kernels{KernelId::query_closest, KernelId::query_any,
                                 KernelId::query_packet};
    executor_.build(kernels, 0);
}

std::shared_ptr<OwnQueries::Query> OwnQueries::single(KernelId kernel, const RaySet& rays,
                                                      std::size_t answer_bytes) const {
    return std::make_shared<Query>(Query{
        executor_, scene_, kernel, upload<shared::float4>(executor_, rays.origins, "ray origins"),
        upload<shared::float4>(executor_, rays.directions, "ray directions"),
        executor_.allocate(rays.size() * answer_bytes, "answers"), rays.size(),
        static_cast<std::uint32_t>(rays.size())});
}

Contender OwnQueries::closest(const RaySet& rays) const {
    const auto query = single(KernelId::query_closest, rays, sizeof(QueryHit));
    const auto answers = [query] {
        std::vector<std::uint32_t> ids;
        for (const QueryHit& hit :
             read_buffer<QueryHit>(query->executor, *query->answers, query->slots))
            ids.push_back(hit.triangle);
        return ids;
    };
    return {name_, false, {}, [query] { return query->run(); }, answers};
}

Contender OwnQueries::any(const RaySet& rays) const {
    const auto query = single(KernelId::query_any, rays, sizeof(int));
    const auto answers = [query] {
        return read_buffer<std::uint32_t>(query->executor, *query->answers, query->slots);
    };
    return {name_, false, {}, [query] { return query->run(); }, answers};
}

Contender OwnQueries::packets(const PacketSet& packets) const {
    const auto query = std::make_shared<Query>(
        Query{executor_, scene_, KernelId::query_packet,
              upload<shared::float4>(executor_, packets.block_origins, "packet origins"),
              upload<float>(executor_, packets.planes, "packet directions"),
              executor_.allocate(packets.slots() * sizeof(float), "answers"), packets.slots(),
              static_cast<std::uint32_t>(packets.slots() / executor_.lanes())});
    const auto answers = [query] {
        std::vector<std::uint32_t> blocked;
        for (const float x : read_buffer<float>(query->executor, *query->answers, query->slots))
            blocked.push_back(x > 0.0F ? 1 : 0);
        return blocked;
    };
    return {name_, false, {}, [query] { return query->run(); }, answers};
}

std::vector<QueryHit> OwnQueries::trace(const RaySet& rays) const {
    const auto query = single(KernelId::query_closest, rays, sizeof(QueryHit));
    (void)query->run();
    return read_buffer<QueryHit>(executor_, *query->answers, rays.size());
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
