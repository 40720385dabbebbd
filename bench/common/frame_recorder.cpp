// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/frame_recorder.h"

#include <utility>

#include "base/error.h"
#include "device/forwarding_executor.h"
#include "device/kernel_signature.h"
#include "render/renderer.h"

namespace weft::bench {
namespace {

/// Passes everything on to another executor, keeping inputs of the launches of interest.
class FrameRecorder : public ForwardingExecutor {
  public:
    using ForwardingExecutor::ForwardingExecutor;

    [[nodiscard]] std::unique_ptr<TracedScene> make_scene(const TracedGeometry& geometry) override {
        frame_.box_padding = geometry.box_padding;
        frame_.scene = inner().make_scene(geometry);
        return std::make_unique<Placeholder>();
    }
    void update_scene(TracedScene&, const TracedGeometry& geometry) override {
        frame_.box_padding = geometry.box_padding;
        inner().update_scene(*frame_.scene, geometry);
    }
    bool run(const Launch& launch, const std::function<bool(double)>& keep_going) override {
        if (launch.kernel == KernelId::vpl_gather) keep_gather(launch);
        Launch passed = launch;
        if (launch.scene != nullptr) passed.scene = frame_.scene.get();
        return inner().run(passed, keep_going);
    }

    [[nodiscard]] RecordedFrame take() { return std::move(frame_); }

  private:
    /// What the renderer holds in place of the scene, which outlives the renderer.
    class Placeholder : public TracedScene {};

    template <class T>
    std::vector<T> contents(const Launch& launch, std::string_view name) {
        Buffer& buffer = *argument_of(launch, name).buffer;
        return read_buffer<T>(inner(), buffer, buffer.bytes() / sizeof(T));
    }
    template <class T>
    static T value_of(const Launch& launch, std::string_view name) {
        return *static_cast<const T*>(argument_of(launch, name).value);
    }

    /// Lights are gathered by the same kernel, before the indirect VPLs: the last launch counts.
    void keep_gather(const Launch& launch) {
        frame_.params = launch.params;
        frame_.list = value_of<shared::SetList>(launch, "list");
        frame_.slots = value_of<shared::uint>(launch, "slots");
        frame_.receivers = contents<float>(launch, "receiver_planes");
        frame_.block_sets = contents<std::uint32_t>(launch, "block_set");
        frame_.vpls = contents<shared::Vpl>(launch, "vpls");
    }

    RecordedFrame frame_;
};

}  // namespace

RecordedFrame record_frame(Executor& executor, const FlatScene& scene, const Camera& camera) {
    RenderSettings settings;
    settings.algorithm = Algorithm::igi;
    settings.sampling.interleave = 3;
    settings.sampling.vpls_per_set = 64;
    if (!plan_for(scene, settings).has_indirect())
        throw Error(ExitCode::bad_input, "the scene has no indirect light, expected some");
    FrameRecorder recorder(executor);
    Renderer renderer(recorder, scene, camera, settings);
    renderer.render_frame({});
    return recorder.take();
}

}  // namespace weft::bench
