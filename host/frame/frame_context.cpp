// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "frame/frame_context.h"

#include "base/error.h"
#include "frame/adaptive_sampling.h"
#include "frame/edge_samples.h"
#include "frame/film.h"
#include "frame/media_buffers.h"
#include "frame/view_media.h"
#include "kernels/receivers.h"
#include "scene/mip_levels.h"

namespace weft {
namespace {

/// Counters that stages share out; all are read before the first is used again.
constexpr std::uint32_t counter_slots = 32;

TracedGeometry traced_geometry(const FlatScene& flat) {
    // Boxes grow by what the triangle tests may be off: some rounding errors of the largest
    // coordinate. Where the tree changes from frame to frame they hold all that packets count as
    // inside (2^-19 of the distance), so that a ray's result does not depend on it.
    const bool moves = flat.first_moving_triangle < flat.triangles.size();
    return {flat.positions, flat.triangles, flat.extent * (moves ? 0x1p-16F : 0x1p-22F),
            flat.first_moving_triangle};
}

void upload_lights(Executor& executor, const FlatScene& flat, SceneBuffers& scene) {
    scene.lights = upload<shared::LightRecord>(executor, flat.lights, "lights");
    scene.emissive = upload<shared::EmissiveTriangle>(executor, flat.emissive, "emitters");
}

}  // namespace

SceneBuffers upload_scene(Executor& executor, const FlatScene& flat) {
    SceneBuffers scene;
    const auto add = [&]<class T>(const std::vector<T>& values, const char* what) {
        scene.geometry.push_back(upload<T>(executor, values, what));
    };
    add(flat.positions, "vertex positions");
    add(flat.triangles, "triangles");
    add(flat.instances, "instances");
    add(flat.materials, "materials");
    add(flat.normals, "vertex normals");
    add(flat.texture_coordinates, "texture coordinates");
    add(flat.vertex_colours, "vertex colours");
    add(flat.textures, "texture table");
    add(flat.texels, "texels");
    add(srgb_table(), "sRGB table");
    upload_lights(executor, flat, scene);
    scene.traced = executor.make_scene(traced_geometry(flat));
    return scene;
}

void update_scene(Executor& executor, const FlatScene& flat, SceneBuffers& scene) {
    const auto write = [&]<class T>(std::size_t buffer, const std::vector<T>& values) {
        write_buffer<T>(executor, *scene.geometry[buffer], values);
    };
    if (flat.first_moving_triangle < flat.triangles.size()) {
        write(0, flat.positions);
        write(1, flat.triangles);
        write(4, flat.normals);
        executor.update_scene(*scene.traced, traced_geometry(flat));
    }
    write(2, flat.instances);
    write(3, flat.materials);
    upload_lights(executor, flat, scene);
}

std::shared_ptr<MediaBuffers> media_of(Executor& executor, const FlatScene& flat,
                                       SceneBuffers& scene) {
    if (!scene.media)
        scene.media = std::make_shared<MediaBuffers>(upload_media(executor, flat.media));
    return scene.media;
}

FrameBuffers::FrameBuffers() = default;
FrameBuffers::FrameBuffers(FrameBuffers&&) noexcept = default;
FrameBuffers& FrameBuffers::operator=(FrameBuffers&&) noexcept = default;
FrameBuffers::~FrameBuffers() = default;

std::size_t receiver_planes(std::uint32_t features) {
    if ((features & FEATURE_MEDIA) != 0) return RECEIVER_PLANES_MEDIA;
    return (features & FEATURE_SMOOTH_NORMALS) != 0 ? RECEIVER_PLANES_SMOOTH : RECEIVER_PLANES_FLAT;
}

GBuffer allocate_gbuffer(Executor& executor, std::size_t pixels, const char* of) {
    GBuffer gbuffer;
    gbuffer.push_back(executor.allocate(2 * pixels * sizeof(std::uint32_t), of));
    while (gbuffer.size() < gbuffer_buffers)
        gbuffer.push_back(executor.allocate(pixels * sizeof(shared::float4), of));
    return gbuffer;
}

FrameBuffers allocate_frame(Executor& executor, const FramePlan& plan, const WorkList& work,
                            std::uint32_t width, std::uint32_t height, std::uint32_t features,
                            bool tiles) {
    FrameBuffers frame = allocate_counters(executor);
    const std::size_t pixels = std::size_t{width} * height;
    frame.slots = static_cast<std::uint32_t>(work.pixels.size());
    const auto floats = [&](std::size_t count, const char* what) {
        return executor.allocate(count * sizeof(float), what);
    };
    frame.gbuffer = allocate_gbuffer(executor, pixels, "G-buffer");
    frame.nothing = floats(4, "a dummy buffer");
    frame.slot_pixel = upload<std::uint32_t>(executor, work.pixels, "work list");
    frame.block_set = upload<std::uint32_t>(executor, work.block_sets, "sample sets");
    frame.pixel_slot = floats(pixels, "pixel slots");
    frame.receivers = floats(receiver_planes(features) * frame.slots, "receivers");
    if (tiles) frame.tiles = std::make_unique<TileGeometry>(executor, width, height);
    if (plan.edge_samples > 0) frame.edges = std::make_unique<EdgeSamples>(executor, width, height);
    frame.film_high = floats(film_planes(features) * FILM_STRIDE(pixels), "film");
    frame.film_low = floats(film_planes(features) * FILM_STRIDE(pixels), "film");
    if (plan.light_sample_count() > 0)
        frame.light_samples =
            executor.allocate(plan.light_sample_count() * sizeof(shared::Vpl), "light samples");
    if (plan.has_vpls())
        frame.vpls = executor.allocate(
            std::size_t{plan.sets} * plan.vpls_per_set * sizeof(shared::Vpl), "VPLs");
    return frame;
}

FrameBuffers allocate_counters(Executor& executor) {
    FrameBuffers frame;
    frame.counters = executor.allocate(counter_slots * sizeof(shared::RayCounter), "counters");
    frame.nonfinite = executor.allocate(sizeof(shared::NonfiniteCounter), "counters");
    clear_nonfinite(executor, *frame.nonfinite);
    return frame;
}

void clear_nonfinite(Executor& executor, Buffer& counter) {
    shared::NonfiniteCounter clear{};
    for (auto& first : clear.first_pixel) first = NO_TRIANGLE;
    write_buffer(executor, counter, std::span<const shared::NonfiniteCounter>(&clear, 1));
}

void FrameContext::run(KernelId kernel, Stage stage, const char* component, bool traces,
                       const std::vector<Buffer*>& arguments, std::uint32_t items,
                       std::uint32_t items_per_launch, std::uint32_t first_item) {
    if (items == 0 || (ended_early() && !finishing_)) return;
    if (uncounted_.size() == counter_slots) count();
    if (uncounted_.empty()) {
        const std::vector<shared::RayCounter> zero(counter_slots);
        write_buffer<shared::RayCounter>(executor, *buffers.counters, zero);
    }
    params.counter = static_cast<std::uint32_t>(uncounted_.size());
    uncounted_.push_back(stages_.size());
    stages_.push_back({stage, component, 0.0, 0, 0});
    const TracedScene* const scene_of_stage =
        other_scene != nullptr ? other_scene : scene_buffers.traced.get();
    const Launch launch{kernel,     params,         traces ? scene_of_stage : nullptr,
                        arguments,  items,          items_per_launch,
                        first_item, whole_launches, &stages_.back().ms};
    const bool complete = executor.run(launch, [&](double done) {
        return finishing_ || !keep_going_ || keep_going_(stage, done);
    });
    ended_early_ = ended_early_ || !complete;
}

void FrameContext::add_host_stage(Stage stage, const char* component, double ms) {
    stages_.push_back({stage, component, ms, 0, 0});
}

FrameContext::~FrameContext() {
    // Launches that still run have places in `stages_` to write to.
    try {
        (void)executor.take_milliseconds();
    } catch (const Error&) {
        // What the device has to say of them it has said, or will say to the next frame.
    }
}

const std::deque<StageStats>& FrameContext::stages() {
    (void)executor.take_milliseconds();
    count();
    return stages_;
}

void FrameContext::count() {
    if (uncounted_.empty()) return;
    const auto counters =
        read_buffer<shared::RayCounter>(executor, *buffers.counters, uncounted_.size());
    for (std::size_t slot = 0; slot < uncounted_.size(); ++slot) {
        StageStats& stage = stages_[uncounted_[slot]];
        stage.rays = std::uint64_t{counters[slot].rays_high} << 32 | counters[slot].rays_low;
        stage.misses = counters[slot].misses;
    }
    uncounted_.clear();
}

std::vector<Buffer*> with_geometry(const SceneBuffers& scene, const std::vector<Buffer*>& others) {
    std::vector<Buffer*> all;
    for (const auto& buffer : scene.geometry) all.push_back(buffer.get());
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

std::vector<Buffer*> with_gbuffer(const GBuffer& gbuffer, const std::vector<Buffer*>& others) {
    std::vector<Buffer*> all;
    for (const auto& buffer : gbuffer) all.push_back(buffer.get());
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

std::vector<Buffer*> with_gbuffer(const FrameBuffers& frame, const std::vector<Buffer*>& others) {
    return with_gbuffer(frame.gbuffer, others);
}

std::vector<Buffer*> with_irradiance(const FrameBuffers& frame,
                                     const std::vector<Buffer*>& others) {
    const ComposedIrradiance& irradiance = frame.irradiance;
    const ViewMedia* const media = frame.view_media.get();
    std::vector<Buffer*> all{frame.pixel_slot.get(),
                             frame.or_nothing(irradiance.direct),
                             frame.or_nothing(irradiance.exact_direct),
                             frame.or_nothing(irradiance.indirect),
                             frame.or_nothing(media != nullptr ? &media->left() : nullptr),
                             frame.or_nothing(media != nullptr ? media->glow() : nullptr),
                             frame.or_nothing(irradiance.media)};
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

}  // namespace weft
