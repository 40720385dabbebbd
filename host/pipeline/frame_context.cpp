// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/frame_context.h"

#include <algorithm>

#include "base/error.h"
#include "film/film.h"
#include "kernels/core/receivers.h"
#include "pipeline/camera_vpls.h"
#include "pipeline/edge_samples.h"
#include "pipeline/media_buffers.h"
#include "pipeline/tile_geometry.h"
#include "pipeline/traced_geometry.h"
#include "pipeline/view_media.h"
#include "scene/environment_irradiance.h"
#include "scene/mip_levels.h"

namespace weft {
namespace {

/// Number of ray counters, one a stage; all are read before the first is used again.
constexpr std::uint32_t counter_slots = 32;

void upload_lights(Executor& executor, const FlatScene& flat, SceneBuffers& scene) {
    scene.light_table.lights = upload<kinds::Lights>(executor, flat.lights, "lights");
    scene.light_table.emissive =
        upload<kinds::EmissiveTriangles>(executor, flat.emissive, "emitters");
    scene.light_nodes = {};
    if (!flat.light_nodes.empty())
        scene.light_nodes = upload<kinds::LightNodes>(executor, flat.light_nodes, "light tree");
}

void upload_surfaces(Executor& executor, const FlatSurfaces& surfaces, owned::SurfaceTables& to) {
    if (!surfaces.present()) return;
    to.surface_records = upload<kinds::SurfaceRecords>(executor, surfaces.records, "surfaces");
    to.surface_instances =
        upload<kinds::SurfaceInstances>(executor, surfaces.of_instances, "surfaces of instances");
    if (!surfaces.maps.empty())
        to.surface_maps = upload<kinds::SurfaceMaps>(executor, surfaces.maps, "texture maps");
    if (!surfaces.coordinates.empty())
        to.surface_coordinates = upload<kinds::SurfaceCoordinates>(
            executor, surfaces.coordinates, "texture coordinates of surfaces");
    if (!surfaces.tangents.empty())
        to.tangents = upload<kinds::Tangents>(executor, surfaces.tangents, "tangents");
    if (!surfaces.interfaces.empty())
        to.interfaces = upload<kinds::Interfaces>(executor, surfaces.interfaces, "interfaces");
    if (!surfaces.values.empty())
        to.surface_values =
            upload<kinds::SurfaceValues>(executor, surfaces.values, "tables of albedos");
}

/// Replaces what a buffer holds, by another buffer where there are more or fewer values.
template <class Kind>
void replace(Executor& executor, const std::vector<typename Kind::Element>& values,
             DeviceBuffer<Kind>& to, std::string_view what) {
    if (values.empty()) return;
    if (to && to->bytes() == values.size() * sizeof(typename Kind::Element))
        write_buffer(executor, to, values);
    else
        to = upload<Kind>(executor, values, what);
}

/// Writes what edits change of surfaces: their records, and the maps and tables that these read.
void update_surfaces(Executor& executor, const FlatSurfaces& surfaces, owned::SurfaceTables& to) {
    if (!surfaces.present()) return;
    replace(executor, surfaces.records, to.surface_records, "surfaces");
    replace(executor, surfaces.maps, to.surface_maps, "texture maps");
    replace(executor, surfaces.values, to.surface_values, "tables of albedos");
}

TracedGeometry blocking_geometry(const FlatScene& flat, const SceneBuffers& scene) {
    TracedGeometry geometry = traced_geometry(flat);
    geometry.triangles = scene.blocking_triangles;
    geometry.soon = scene.soon;
    geometry.further = true;
    return geometry;
}

}  // namespace

SceneBuffers upload_scene(Executor& executor, const FlatScene& flat, bool soon) {
    SceneBuffers scene;
    owned::Geometry& to = scene.geometry;
    to.positions = upload<kinds::VertexPositions>(executor, flat.positions, "vertex positions");
    to.triangle_list = upload<kinds::Triangles>(executor, flat.triangles, "triangles");
    to.instances = upload<kinds::Instances>(executor, flat.instances, "instances");
    to.materials = upload<kinds::Materials>(executor, flat.materials, "materials");
    to.normals = upload<kinds::VertexNormals>(executor, flat.normals, "vertex normals");
    to.texture_coordinates = upload<kinds::TextureCoordinates>(executor, flat.texture_coordinates,
                                                               "texture coordinates");
    to.vertex_colours =
        upload<kinds::VertexColours>(executor, flat.vertex_colours, "vertex colours");
    to.textures = upload<kinds::Textures>(executor, flat.textures, "texture table");
    to.texels = upload<kinds::Texels>(executor, flat.texels, "texels");
    to.srgb_table = upload<kinds::SrgbTable>(executor, srgb_table(), "sRGB table");
    upload_lights(executor, flat, scene);
    if (flat.environment_image.present()) {
        const FlatEnvironment& image = flat.environment_image;
        scene.environment = {
            upload<kinds::EnvironmentRecords>(executor, image.records, "environment"),
            upload<kinds::EnvironmentTexels>(executor, image.texels, "texels of the environment"),
            upload<kinds::EnvironmentSums>(executor, image.sums, "sums of the environment")};
    }
    upload_surfaces(executor, flat.surfaces, scene.surfaces);
    TracedGeometry traced = traced_geometry(flat);
    traced.soon = soon;
    scene.soon = soon;
    scene.traced = executor.make_scene(traced);
    return scene;
}

void make_light_scene(Executor& executor, const FlatScene& flat, SceneBuffers& scene) {
    if (scene.blocking) return;
    scene.blocking_triangles = blocking_triangles(flat);
    if (scene.blocking_triangles.empty()) return;
    scene.blocking = executor.make_scene(blocking_geometry(flat, scene));
}

void make_open_irradiance(Executor& executor, const FlatScene& flat, SceneBuffers& scene) {
    if (scene.environment_irradiance || !flat.environment_image.present()) return;
    scene.environment_irradiance = upload<kinds::EnvironmentIrradiance>(
        executor, environment_irradiance(flat.environment_image), "irradiance of the environment");
}

void update_scene(Executor& executor, const FlatScene& flat, SceneBuffers& scene) {
    const owned::Geometry& to = scene.geometry;
    if (flat.first_moving_triangle < flat.triangles.size()) {
        write_buffer(executor, to.positions, flat.positions);
        write_buffer(executor, to.triangle_list, flat.triangles);
        write_buffer(executor, to.normals, flat.normals);
        write_buffer(executor, scene.surfaces.tangents, flat.surfaces.tangents);
        executor.update_scene(*scene.traced, traced_geometry(flat));
        if (scene.blocking) {
            std::ranges::copy(blocking_triangles(flat), scene.blocking_triangles.begin());
            executor.update_scene(*scene.blocking, blocking_geometry(flat, scene));
        }
    }
    write_buffer(executor, to.instances, flat.instances);
    write_buffer(executor, to.materials, flat.materials);
    update_surfaces(executor, flat.surfaces, scene.surfaces);
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
    gbuffer.gb_ids = allocate<kinds::SurfaceIds>(executor, 2 * pixels, of);
    gbuffer.gb_position = allocate<kinds::SurfacePositions>(executor, pixels, of);
    gbuffer.gb_normal = allocate<kinds::SurfaceNormals>(executor, pixels, of);
    gbuffer.gb_shading = allocate<kinds::SurfaceShadingNormals>(executor, pixels, of);
    gbuffer.gb_albedo = allocate<kinds::SurfaceAlbedo>(executor, pixels, of);
    gbuffer.gb_emission = allocate<kinds::SurfaceEmission>(executor, pixels, of);
    return gbuffer;
}

FrameBuffers allocate_frame(Executor& executor, const FramePlan& plan, const WorkList& work,
                            std::uint32_t width, std::uint32_t height, std::uint32_t features,
                            bool tiles) {
    FrameBuffers frame = allocate_counters(executor);
    const std::size_t pixels = std::size_t{width} * height;
    const std::size_t film_values = film_planes(features) * FILM_STRIDE(pixels);
    frame.slots = static_cast<std::uint32_t>(work.pixels.size());
    frame.gbuffer = allocate_gbuffer(executor, pixels, "G-buffer");
    frame.slot_pixel = upload<kinds::SlotPixels>(executor, work.pixels, "work list");
    frame.block_set = upload<kinds::BlockSets>(executor, work.block_sets, "sample sets");
    frame.pixel_slot = allocate<kinds::PixelSlots>(executor, pixels, "pixel slots");
    frame.receivers = allocate<kinds::ReceiverPlanes>(
        executor, receiver_planes(features) * frame.slots, "receivers");
    if (tiles) frame.tiles = std::make_unique<TileGeometry>(executor, width, height);
    if (plan.edge_samples > 0) frame.edges = std::make_unique<EdgeSamples>(executor, width, height);
    if (!plan.exact) {
        frame.film_high = allocate<kinds::FilmHigh>(executor, film_values, "film");
        frame.film_low = allocate<kinds::FilmLow>(executor, film_values, "film");
    }
    if (plan.light_sample_count() > 0)
        frame.light_samples =
            allocate<kinds::VirtualLights>(executor, plan.light_sample_count(), "light samples");
    if (plan.has_vpls())
        frame.vpls = allocate<kinds::VirtualLights>(
            executor, std::size_t{plan.sets} * plan.vpls_per_set, "VPLs");
    if (plan.selects_vpls())
        frame.camera_vpls =
            std::make_unique<CameraVpls>(executor, plan, static_cast<std::uint32_t>(pixels));
    return frame;
}

FrameBuffers allocate_counters(Executor& executor) {
    FrameBuffers frame;
    frame.counters = allocate<kinds::RayCounters>(executor, counter_slots, "counters");
    frame.nonfinite = allocate<kinds::NonfiniteCounters>(executor, 1, "counters");
    clear_nonfinite(executor, frame.nonfinite);
    return frame;
}

groups::MediaTables FrameBuffers::media() const {
    static const owned::MediaTables none;
    return view(view_media ? view_media->media() : none);
}

BufferRef<kinds::EnclosingMedia> FrameBuffers::view_enclosing_media() const {
    if (!view_media) return {};
    return view_media->enclosing_media();
}

groups::ComposedLight FrameBuffers::composed() const {
    BufferRef<kinds::Transmittances> transmittance;
    BufferRef<kinds::MediaEmission> emission;
    if (view_media) {
        transmittance = view_media->transmittance();
        emission = view_media->media_emission();
    }
    return {.pixel_slot = pixel_slot,
            .direct = irradiance.direct,
            .exact_irradiance = irradiance.exact_direct,
            .indirect = irradiance.indirect,
            .view_transmittance = transmittance,
            .view_emission = emission,
            .media_light = irradiance.media,
            .reflection_light = irradiance.reflection,
            .refraction_light = irradiance.refraction,
            .glossy_light = irradiance.glossy};
}

void clear_nonfinite(Executor& executor, const DeviceBuffer<kinds::NonfiniteCounters>& counter) {
    shared::NonfiniteCounter clear{};
    for (auto& first : clear.first_pixel) first = INVALID_INDEX;
    write_buffer(executor, counter, std::span<const shared::NonfiniteCounter>(&clear, 1));
}

void FrameContext::run_bound(KernelId kernel, Stage stage, const char* component,
                             const ArgumentBinder& arguments, const Items& items) {
    if (uncounted_.size() == counter_slots) count();
    if (uncounted_.empty()) {
        const std::vector<shared::RayCounter> zero(counter_slots);
        write_buffer(executor, buffers.counters, zero);
    }
    const auto counter = static_cast<std::uint32_t>(uncounted_.size());
    uncounted_.push_back(stages_.size());
    stages_.push_back({stage, component, 0.0, 0, 0});
    const Launch launch{kernel,
                        params,
                        arguments.scene(),
                        arguments.arguments(),
                        items.count,
                        {.items_per_launch = items.per_launch,
                         .first_item = items.first,
                         .counter = counter,
                         .milliseconds = &stages_.back().ms,
                         .whole = whole_launches}};
    double share = 0.0;
    const bool complete = executor.run(launch, [&](double done) {
        share = done;
        return finishing_ || !keep_going_ || keep_going_(stage, done);
    });
    light_.add(stage, complete ? items.count : share * items.count);
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
        // The device has reported the error already, or will report it to the next frame.
    }
}

const std::deque<StageStats>& FrameContext::stages() {
    (void)executor.take_milliseconds();
    count();
    return stages_;
}

void FrameContext::count() {
    if (uncounted_.empty()) return;
    const auto counters = read_buffer(executor, buffers.counters, uncounted_.size());
    for (std::size_t slot = 0; slot < uncounted_.size(); ++slot) {
        StageStats& stage = stages_[uncounted_[slot]];
        stage.rays = std::uint64_t{counters[slot].rays_high} << 32 | counters[slot].rays_low;
        stage.misses = counters[slot].misses;
    }
    uncounted_.clear();
}

std::uint32_t gather_items_per_launch(const Executor& executor, std::uint32_t list_length) {
    constexpr std::uint32_t rays_per_launch = 1U << 20;
    const std::uint32_t rays_per_item = executor.lanes() * std::max(1U, list_length);
    const std::uint32_t items = std::max(64U, rays_per_launch / rays_per_item);
    // Other devices take the kernel's own, larger chunk.
    return executor.device().is_cpu ? items : 0;
}

}  // namespace weft
