// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_judge.h"

#include <exception>
#include <utility>

#include "metrics/flip.h"
#include "metrics/hdr_vdp.h"

namespace weft {
namespace {

double vdp_of(const RgbView& reference, const RgbView& test) {
    return hdr_vdp(luminance(test), luminance(reference), test.width, test.height, {}).p75;
}

std::vector<float> mean_of(const std::vector<float>& a, const std::vector<float>& b) {
    std::vector<float> mean(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) mean[i] = 0.5F * a[i] + 0.5F * b[i];
    return mean;
}

}  // namespace

std::vector<float> beauty_of(const Image& image) {
    const Layer* const layer = image.find("");
    return layer != nullptr && layer->channels == "RGB" ? layer->values : std::vector<float>();
}

Judgement judge(const JudgeTask& task, const std::atomic<bool>& ended) {
    const auto view = [&](const std::vector<float>& values) {
        return RgbView{values, task.width, task.height};
    };
    Judgement judgement{task.version, task.reference_samples, {}, {}};
    const ReferenceHalves halves{view(task.halves[0]), view(task.halves[1])};
    check_pair(halves.first, halves.second);
    const std::vector<float> mean = mean_of(task.halves[0], task.halves[1]);
    const FlipExposures exposures = flip_exposures(view(mean));
    for (const JudgedImage& image : task.images) {
        check_pair(halves.first, view(image.values));
        if (ended) return judgement;
        JudgedErrors errors{image.pane, image.samples};
        const UnbiasedErrors unbiased = unbiased_errors(halves, view(image.values));
        // Before, its interval would promise too much.
        if (unbiased.noise_relmse && *unbiased.noise_relmse <= most_noise_relmse)
            errors.relmse = unbiased.relmse;
        FlipResult flip = hdr_flip(view(mean), view(image.values), exposures);
        if (ended) return judgement;
        errors.distance = {flip.mean, vdp_of(view(mean), view(image.values))};
        errors.flip = std::move(flip.map);
        judgement.images.push_back(std::move(errors));
    }
    if (ended) return judgement;
    judgement.floor.hdrflip = hdr_flip(halves.first, halves.second, exposures).mean;
    if (!ended) judgement.floor.vdp = vdp_of(halves.first, halves.second);
    return judgement;
}

ImageFlip flip_by_halves(const JudgeTask& task, const std::vector<float>& image) {
    const auto view = [&](const std::vector<float>& values) {
        return RgbView{values, task.width, task.height};
    };
    const std::vector<float> mean = mean_of(task.halves[0], task.halves[1]);
    check_pair(view(mean), view(image));
    const FlipExposures exposures = flip_exposures(view(mean));
    return {hdr_flip(view(mean), view(image), exposures).mean,
            hdr_flip(view(task.halves[0]), view(task.halves[1]), exposures).mean};
}

ViewJudge::ViewJudge() : thread_([this] { work(); }) {}

ViewJudge::~ViewJudge() {
    {
        const std::lock_guard guard(mutex_);
        ended_ = true;
    }
    has_task_.notify_one();
    thread_.join();
}

bool ViewJudge::is_idle() {
    const std::lock_guard guard(mutex_);
    return !task_ && !ready_;
}

void ViewJudge::begin(JudgeTask task) {
    {
        const std::lock_guard guard(mutex_);
        task_ = std::move(task);
    }
    has_task_.notify_one();
}

std::optional<Judgement> ViewJudge::take() {
    const std::lock_guard guard(mutex_);
    return std::exchange(ready_, {});
}

void ViewJudge::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        has_task_.wait(lock, [&] { return ended_ || (task_ && !ready_); });
        if (ended_) return;
        // It stays where it is until it is done: begin() is called only while there is none.
        const JudgeTask& task = *task_;
        lock.unlock();
        std::optional<Judgement> judgement;
        try {
            judgement = judge(task, ended_);
        } catch (const std::exception&) {
            // There is no error of an image that is black all over, for example.
        }
        lock.lock();
        task_.reset();
        ready_ = std::move(judgement);
    }
}

}  // namespace weft
