// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_SESSION_FIXTURE_H
#define WEFT_TESTS_TESTING_SESSION_FIXTURE_H

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "session/render_session.h"
#include "tests/testing/counting_executor.h"
#include "tests/testing/moving_room.h"
#include "tests/testing/render_fixture.h"

namespace weft::test {

/// Receives what a session hands over.
class KeptOutput : public OutputDriver {
  public:
    void write(SessionImage image) override { images.push_back(std::move(image)); }
    std::vector<SessionImage> images;
};

/// Receives what a session shows.
class KeptDisplay : public DisplayDriver {
  public:
    void show(const DisplayFrame& frame) override {
        colours.assign(frame.colours.begin(), frame.colours.end());
        samples.push_back(frame.samples);
    }
    [[nodiscard]] double exposure_ev() const override { return exposure; }
    [[nodiscard]] ToneCurve tone() const override { return curve; }

    std::vector<std::uint32_t> colours;  ///< of the last frame
    std::vector<std::uint64_t> samples;  ///< of each frame
    double exposure = 0.0;
    ToneCurve curve = ToneCurve::none;
};

/// A session, and what it asks of its device.
struct CountedSession {
    CountingExecutor* counts;  ///< belongs to the session
    std::unique_ptr<RenderSession> session;

    /// Allocations for something of that name.
    [[nodiscard]] std::size_t allocations(const std::string& what) const {
        const auto& all = counts->allocations();
        return static_cast<std::size_t>(std::count_if(
            all.begin(), all.end(), [&](const auto& made) { return made.first == what; }));
    }
    [[nodiscard]] bool has_built(const std::string& kernel) const {
        const auto& all = counts->kernels();
        return std::find(all.begin(), all.end(), kernel) != all.end();
    }
};

inline CountedSession counted_session(TestBackend backend, Scene scene, const Camera& camera,
                                      const ImageSettings& settings,
                                      std::size_t kept = RenderSession::default_kept_frames) {
    auto executor = std::make_unique<CountingExecutor>(make_executor(backend));
    CountingExecutor* const counts = executor.get();
    return {counts, std::make_unique<RenderSession>(std::move(executor),
                                                    MovingScene(std::move(scene), {}, 30.0), camera,
                                                    settings, kept)};
}

inline PathSettings small_path(std::uint32_t width, std::uint32_t height, std::uint32_t samples) {
    PathSettings settings;
    settings.width = width;
    settings.height = height;
    settings.samples = {0, samples};
    return settings;
}

/// What a new renderer makes of a scene as it has been flattened.
inline Image fresh_image(Executor& executor, const FlatScene& flat, const Camera& camera,
                         const ImageSettings& settings, std::uint32_t frames = 1) {
    if (const auto* const preview = std::get_if<RenderSettings>(&settings))
        return render_flat(executor, flat, camera, *preview, frames).image;
    PathRenderer renderer(executor, flat, camera, std::get<PathSettings>(settings), {});
    while (renderer.render_frame({})) continue;
    return renderer.image();
}

}  // namespace weft::test

#endif
