// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_RAYS_EMBREE_QUERIES_H
#define WEFT_BENCH_RAYS_EMBREE_QUERIES_H

#include <tbb/task_arena.h>

#include <memory>
#include <vector>

#include "bench/common/candidate.h"
#include "bench/common/ray_sets.h"
#include "device/executor.h"
#include "device/native/embree_scene.h"

namespace weft::bench {

/// The triangles as plain Embree scenes of the highest build quality: one in robust mode, one in
/// the default mode.
class EmbreeScenes {
  public:
    /// Uses the geometry's memory. `threads` is 0 for all.
    EmbreeScenes(const TracedGeometry& geometry, int threads)
        : robust_(geometry, threads, RTC_SCENE_FLAG_ROBUST),
          fast_(geometry, threads, RTC_SCENE_FLAG_NONE) {}

    [[nodiscard]] RTCScene robust() const noexcept { return robust_.handle(); }
    [[nodiscard]] RTCScene fast() const noexcept { return fast_.handle(); }

  private:
    EmbreeScene robust_;
    EmbreeScene fast_;
};

/// Embree's calls 1, 8 and 16 rays wide over blocks of rays in parallel. The yardsticks are in
/// robust mode without the COHERENT flag: for single rays the calls 1 wide, for packets those of
/// all three widths. Default mode and COHERENT packets come along.
class EmbreeQueries {
  public:
    /// `scenes` must outlive the candidates. `threads` is 0 for all.
    EmbreeQueries(const EmbreeScenes& scenes, int threads);

    [[nodiscard]] std::vector<Candidate> closest(const RaySet& rays) const;
    [[nodiscard]] std::vector<Candidate> any(const RaySet& rays) const;
    [[nodiscard]] std::vector<Candidate> packets(const PacketSet& packets) const;

  private:
    const EmbreeScenes& scenes_;
    std::shared_ptr<tbb::task_arena> arena_;
};

}  // namespace weft::bench

#endif
