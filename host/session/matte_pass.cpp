// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/matte_pass.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <set>
#include <span>

#include "film/cryptomatte.h"
#include "render/camera_params.h"

namespace weft {
namespace {

/// Gives names out, each once: a name that was given before gets a number.
class UniqueNames {
  public:
    std::string make(const std::string& wanted) {
        std::string name = wanted;
        for (std::size_t number = 2; !given_.insert(name).second; ++number)
            name = fmt::format("{}#{}", wanted, number);
        return name;
    }

  private:
    std::set<std::string> given_;
};

/// Whether two instances that follow one another are parts of one object of the file.
bool is_same_object(const Instance& a, const Instance& b) {
    return !a.name.empty() && a.name == b.name && a.mesh != b.mesh && a.to_world == b.to_world;
}

}  // namespace

std::vector<std::string> object_names(const Scene& scene) {
    UniqueNames unique;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        if (i > 0 && is_same_object(scene.instances[i - 1], instance))
            names.push_back(names.back());
        else
            names.push_back(
                unique.make(instance.name.empty() ? fmt::format("object {}", i) : instance.name));
    }
    return names;
}

std::vector<std::string> material_names(const Scene& scene) {
    UniqueNames unique;
    std::vector<std::string> of_material;
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        of_material.push_back(unique.make(scene.materials[i].name.empty()
                                              ? fmt::format("material {}", i)
                                              : scene.materials[i].name));
    std::vector<std::string> names;
    for (const Instance& instance : scene.instances)
        names.push_back(of_material[instance.material]);
    return names;
}

bool add_mattes(Executor& executor, const Scene& scene, const FlatScene& flat,
                const SceneBuffers& buffers, const MatteView& view, const MatteSettings& settings,
                Image& image) {
    // What surfaces look like makes no difference, so that the kernel needs no feature for it.
    shared::RenderParams params = scene_params(flat, view.camera, view.width, view.height);
    params.features = camera_features(view.camera);
    executor.build(std::array{KernelId::gbuffer}, params.features);
    const std::size_t pixels = std::size_t{view.width} * view.height;
    const GBuffer gbuffer = allocate_gbuffer(executor, pixels, "G-buffer of identifiers");
    InstanceCounts counts(pixels);
    for (std::uint32_t sample = 0; sample < view.samples; ++sample) {
        set_jitter(sample, view.samples <= 1, view.seed, params);
        if (!run_kernel(executor, params,
                        kernels::gbuffer{.scene = *buffers.traced,
                                         .geometry = weft::view(buffers.geometry),
                                         .environment = weft::view(buffers.environment),
                                         .gb_ids = gbuffer.gb_ids,
                                         .gb_position = gbuffer.gb_position,
                                         .gb_normal = gbuffer.gb_normal,
                                         .gb_shading = gbuffer.gb_shading,
                                         .gb_albedo = gbuffer.gb_albedo,
                                         .gb_emission = gbuffer.gb_emission},
                        pixel_blocks(view.width, view.height, executor.lanes())))
            return false;
        executor.with_mapped(*gbuffer.gb_ids, Access::read, [&](std::span<std::byte> data) {
            counts.add({reinterpret_cast<const std::uint32_t*>(data.data()), 2 * pixels});
        });
    }
    if (settings.objects) attach_cryptomatte("CryptoObject", counts, object_names(scene), image);
    if (settings.materials)
        attach_cryptomatte("CryptoMaterial", counts, material_names(scene), image);
    return true;
}

}  // namespace weft
