// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/adaptive/adaptive_run.h"

#include <algorithm>

#include "device/shared_scene.h"
#include "image/exr.h"
#include "image/png.h"
#include "render/camera_params.h"
#include "scene/flat_scene.h"
#include "tradeoff/error_values.h"
#include "tradeoff/reference_images.h"

namespace weft::bench {
namespace {

/// Where there are media, path tracing has their light in other layers: only beauty is compared.
LayerErrors layer_errors(const Image& reference, const Image& test, bool components,
                         bool components_visible) {
    const ErrorChoice whole{true, true};
    const ErrorChoice part{components_visible, false};
    if (!components) return {image_errors(reference, test, "", whole), {}, {}};
    return {image_errors(reference, test, "", whole),
            image_errors(reference, test, "indirect", part),
            image_errors(reference, test, "direct", part)};
}

/// The image, for the screen with this exposure and as it is.
void write_image(const std::filesystem::path& folder, const AdaptiveScene& scene,
                 const std::string& name, const Image& image, double exposure) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    write_png(folder / (scene.name + "-" + name + ".png"), image, exposure);
    write_exr(folder / (scene.name + "-" + name + ".exr"), image);
}

/// Of all images of a scene.
double exposure_of(const AdaptiveScene& scene) {
    const MethodFrames* const amax = scene.frames.find(method_amax);
    return auto_exposure(amax != nullptr ? amax->image : scene.frames.methods.front().image);
}

void write_images(const AdaptiveRun& run, const AdaptiveScene& scene) {
    if (run.images.empty()) return;
    const double exposure = exposure_of(scene);
    for (const MethodFrames& method : scene.frames.methods)
        write_image(run.images, scene, method.name, method.image, exposure);
}

void compare(const AdaptiveRun& run, const FlatScene& flat, const Camera& camera,
             Executor& path_executor, AdaptiveScene& scene) {
    SharedScene shared(path_executor);
    ReferenceImages references(run.references, shared, run.say);
    const std::vector<MethodFrames>& methods = scene.frames.methods;
    scene.errors.resize(methods.size());
    for (const bool centre : {false, true}) {
        ReferenceWish wish{scene.name, run.frames.size, centre, run.reference_spp};
        wish.with_halves = true;
        wish.enough = run.enough;
        if (std::find(run.filters.begin(), run.filters.end(), wish.filter()) == run.filters.end())
            continue;
        const Reference reference = references.find(flat, camera, wish);
        std::optional<ImageErrors>& floor = centre ? scene.floors.centre : scene.floors.box;
        floor = floor_errors(reference.image);
        nlohmann::json& json = scene.references[wish.filter()];
        json = reference.json();
        if (floor) json["floor"] = floor->json();
        std::optional<double>& noise = centre ? scene.floors.centre_noise : scene.floors.box_noise;
        noise = noise_relmse_of(reference.image);
        if (noise) json["noise_relmse"] = *noise;
        for (std::size_t m = 0; m < methods.size(); ++m) {
            MethodErrors& errors = scene.errors[m];
            (centre ? errors.centre : errors.box) = layer_errors(
                reference.image, methods[m].image, run.layers && !scene.media, !centre);
        }
        if (!run.images.empty())
            write_image(run.images, scene, std::string("reference-") + wish.filter(),
                        reference.image, exposure_of(scene));
    }
}

}  // namespace

AdaptiveScene measure_scene(const AdaptiveSource& source, const AdaptiveRun& run,
                            Executor& executor, Executor& path_executor, Diagnostics& diagnostics) {
    const Scene scene = source.scene.load(diagnostics);
    const FlatScene flat = flatten(scene);
    const Camera camera = choose_camera(scene, flat, "", diagnostics);
    AdaptiveScene result;
    result.name = source.scene.name;
    result.shipped = source.shipped;
    result.media = flat.media.present();
    result.triangles = flat.triangles.size();
    {
        SharedScene shared(executor);
        result.frames = measure_frames(shared, flat, camera, run.methods, run.frames);
    }
    write_images(run, result);
    if (!run.filters.empty()) compare(run, flat, camera, path_executor, result);
    return result;
}

}  // namespace weft::bench
