// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <string>

#include "base/error.h"
#include "image/hdr.h"
#include "scene/validate_scene.h"
#include "selftest/case_groups.h"
#include "selftest/measurements.h"
#include "selftest/media_builder.h"

// Degenerate scenes and images, and values that are not finite.
namespace weft::selftest {
namespace {

Camera plain_camera() {
    return look_at({0.3, 0.2, 3.0}, {0.0, 0.0, 0.0}, 0.8);
}

/// The largest value of the image, or NaN where any value is bad.
double brightest(const Rendering& rendering) {
    if (bad_values(rendering) > 0.0) return NAN;
    const std::vector<float>& beauty = rendering.layer("");
    return static_cast<double>(*std::max_element(beauty.begin(), beauty.end()));
}

Rendering preview(Executor& executor, const Scene& scene, const Camera& camera,
                  std::uint32_t width = 16, std::uint32_t height = 12) {
    return render(executor, scene, camera, small_settings(Algorithm::igi, width, height));
}

/// Area lights that give no light: one of radiance 0, and some that are points and lines.
SceneBuilder area_lights_without_light() {
    SceneBuilder builder;
    builder.add(room_mesh(), builder.material(glm::vec3(0.8F)));
    builder.add(quad_mesh({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}),
                builder.material(glm::vec3(0.5F), glm::vec3(0.0F)));
    Mesh flat;
    flat.positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {-0.5F, 0, 0}, {0, 0, 0}, {0.5F, 0, 0}};
    flat.triangles = {{0, 1, 2}, {3, 4, 5}, {3, 3, 5}};
    builder.add(std::move(flat), builder.material(glm::vec3(0.5F), glm::vec3(9.0F)));
    return builder;
}

/// A light within a closed ball, seen from outside.
SceneBuilder hidden_light() {
    SceneBuilder builder;
    builder.add(icosphere(2, false), builder.material(glm::vec3(0.8F)));
    builder.light(LightType::point, {0.1, 0.2, 0.0}, glm::vec3(2.0F));
    return builder;
}

double bad_in_medium(Executor& executor) {
    SceneBuilder builder;
    builder.add(room_mesh(), builder.material(glm::vec3(0.7F)));
    builder.light(LightType::point, {0.2, 0.1, 0.0}, glm::vec3(0.3F));
    builder.scene.media.push_back(medium_of(glm::vec3(1.0F), glm::vec3(0.8F), 0.5F));
    add_boundary(builder.scene, cube_mesh(), placement(0.3, {0.0, 0.0, 0.3}), 0);
    // The camera is within it, and on its boundary.
    return bad_values(preview(executor, builder.scene, look_at({0, 0, 0.2}, {0, 0, 0}, 1.0))) +
           bad_values(preview(executor, builder.scene, look_at({0, 0, 0.6}, {0, 0, 0}, 1.0)));
}

double bad_in_odd_sizes(Executor& executor) {
    SceneBuilder builder;
    builder.add(room_mesh(), builder.material(glm::vec3(0.7F)));
    builder.add(quad_mesh({-0.3F, 0.9F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}),
                builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    const Camera camera = look_at({0.0, 0.0, 0.9}, {0.0, 0.0, 0.0}, 1.0);
    double bad = 0.0;
    for (const auto& [width, height] : {std::pair{1U, 1U}, {7U, 5U}, {1U, 9U}}) {
        const Rendering rendering = preview(executor, builder.scene, camera, width, height);
        bad += bad_values(rendering) + (brightest(rendering) > 0.0 ? 0.0 : 1.0);
    }
    return bad;
}

std::vector<Measured> measure_edges(Executor& executor) {
    const SceneBuilder nothing;
    SceneBuilder surroundings;
    surroundings.scene.environment = Environment{glm::vec3(0.25F)};
    const Camera inside = look_at({0.0, 0.0, 0.9}, {0.0, 0.0, 0.0}, 1.0);
    return {brightest(preview(executor, nothing.scene, plain_camera())),
            brightest(preview(executor, surroundings.scene, plain_camera())),
            brightest(preview(executor, area_lights_without_light().scene, inside)),
            brightest(preview(executor, hidden_light().scene, plain_camera())),
            bad_in_medium(executor),
            bad_in_odd_sizes(executor)};
}

SelftestCase edges_of_scenes() {
    const std::string exact = "nothing is sampled: the value is given, or light is not there";
    return {29,
            "degenerate scenes",
            RunsOn::devices,
            {{"brightest pixel of no scene", 0.0, within(0.0), exact},
             {"brightest pixel of surroundings alone", 0.25, within(0.0), exact},
             {"brightest pixel, area lights without power or area", 0.0, within(0.0), exact},
             {"brightest pixel, a light within a ball", 0.0, within(1e-6),
              "a facet sees itself at a cosine of 0, but for rounding"},
             {"bad values, camera in a medium and on its edge", 0.0, within(0.0),
              "every segment of a medium has a finite optical depth"},
             {"bad values or no light, 1x1, 7x5 and 1x9 pixels", 0.0, within(0.0),
              "footprints move inwards, and lists of pixels are padded"}},
            measure_edges};
}

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// A floor that fills the image, under a light, with texture coordinates and vertex colours.
SceneBuilder lit_floor() {
    SceneBuilder builder;
    Mesh floor = quad_mesh({-4, -4, 0}, {8, 0, 0}, {0, 8, 0});
    floor.colours.assign(floor.positions.size(), glm::vec3(1.0F));
    builder.add(std::move(floor), builder.material(glm::vec3(0.8F), glm::vec3(0.25F)));
    builder.light(LightType::point, {0.0, 0.0, 2.0}, glm::vec3(5.0F));
    return builder;
}

/// Number of places in a scene where a value that is not finite was not refused.
double accepted_places() {
    const std::vector<std::function<void(Scene&, float)>> places{
        [](Scene& scene, float bad) {
            set_diffuse_albedo(scene.materials[0], {0.5F, bad, 0.5F});
        },
        [](Scene& scene, float bad) { scene.materials[0].emission.radiance.y = bad; },
        [](Scene& scene, float bad) { scene.meshes[0].uvs[1].y = bad; },
        [](Scene& scene, float bad) { scene.meshes[0].colours[1].y = bad; },
        [](Scene& scene, float bad) { scene.lights[0].intensity.y = bad; },
        [](Scene& scene, float bad) {
            scene.environment = Environment{{0.5F, bad, 0.5F}};
        }};
    double accepted = 0.0;
    for (const float bad : {not_a_number, infinity})
        for (const auto& spoil : places) {
            Scene scene = lit_floor().scene;
            spoil(scene, bad);
            try {
                validate_scene(scene);
                accepted += 1.0;
            } catch (const Error& error) {
                accepted += error.code() == ExitCode::bad_input ? 0.0 : 1.0;
            }
        }
    return accepted;
}

/// Number of Radiance images that were not refused although their exposure makes values overflow
/// floats.
double accepted_images() {
    double accepted = 0.0;
    for (const char* const exposure : {"nan", "1e-3"}) {
        const std::string image =
            std::string("#?RGBE\nEXPOSURE=") + exposure + "\n\n-Y 1 +X 1\n\xff\xff\xff\xff";
        try {
            (void)decode_hdr(std::as_bytes(std::span(image)), "picture");
            accepted += 1.0;
        } catch (const Error& error) {
            accepted += error.code() == ExitCode::bad_input ? 0.0 : 1.0;
        }
    }
    return accepted;
}

/// An image whose emission was made invalid after the scene was read and checked.
std::vector<Measured> measure_spoilt(Executor& executor) {
    FlatScene flat = flatten(lit_floor().scene);
    flat.materials[0].emission.y = not_a_number;
    RenderSettings settings = small_settings(Algorithm::igi, 16, 12);
    settings.indirect = false;
    const Rendering rendering =
        render_flat(executor, flat, look_at({0.0, 0.0, 3.0}, {0.0, 0.0, 0.0}, 0.6), settings);
    return {static_cast<double>(unclean_values(rendering.image)),
            static_cast<double>(guarded_values(rendering.stats))};
}

SelftestCase values_that_are_refused() {
    return host_case(
        30, "NaN and Inf",
        {{"of 14 in scenes and Radiance images, accepted", 0.0, within(0.0),
          "each is refused with its place; bytes of textures cannot hold any"}},
        []() -> std::vector<Measured> { return {accepted_places() + accepted_images()}; });
}

SelftestCase values_that_are_none() {
    return {30,
            "NaN and Inf",
            RunsOn::devices,
            {{"bad values of an image that got one anyway", 0.0, within(0.0),
              "what is not finite turns black before it reaches the film"},
             {"pixels in which that was counted", 192.0, within(0.0), "every pixel shows it"}},
            measure_spoilt};
}

}  // namespace

std::vector<SelftestCase> degenerate_cases() {
    return {edges_of_scenes(), values_that_are_refused(), values_that_are_none()};
}

}  // namespace weft::selftest
