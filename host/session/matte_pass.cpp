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

/// Traces rays from a camera to find which instance each pixel shows.
class PrimaryRays {
  public:
    /// All must outlive it.
    PrimaryRays(Executor& executor, const FlatScene& flat, const SceneBuffers& buffers,
                const MatteView& view)
        : executor_(executor),
          buffers_(buffers),
          view_(view),
          // What surfaces look like makes no difference, so that the kernel needs no feature for
          // it.
          params_(scene_params(flat, view.camera, view.width, view.height)) {
        params_.features = camera_features(view.camera);
        executor.build(std::array{KernelId::gbuffer}, params_.features);
        gbuffer_ = allocate_gbuffer(executor, pixels(), "G-buffer of identifiers");
    }

    /// Hands out the words of InstanceCounts::add. Returns false where that was cancelled.
    template <class Take>
    bool trace(std::uint32_t sample, const Take& take) {
        set_jitter(sample, view_.samples <= 1, view_.seed, params_);
        if (!run_kernel(executor_, params_,
                        kernels::gbuffer{.scene = *buffers_.traced,
                                         .geometry = weft::view(buffers_.geometry),
                                         .environment = weft::view(buffers_.environment),
                                         .gb_ids = gbuffer_.gb_ids,
                                         .gb_position = gbuffer_.gb_position,
                                         .gb_normal = gbuffer_.gb_normal,
                                         .gb_shading = gbuffer_.gb_shading,
                                         .gb_albedo = gbuffer_.gb_albedo,
                                         .gb_emission = gbuffer_.gb_emission},
                        pixel_blocks(view_.width, view_.height, executor_.lanes())))
            return false;
        executor_.with_mapped(*gbuffer_.gb_ids, Access::read, [&](std::span<std::byte> data) {
            take({reinterpret_cast<const std::uint32_t*>(data.data()), 2 * pixels()});
        });
        return true;
    }

  private:
    [[nodiscard]] std::size_t pixels() const { return std::size_t{view_.width} * view_.height; }

    Executor& executor_;
    const SceneBuffers& buffers_;
    MatteView view_;
    shared::RenderParams params_;
    GBuffer gbuffer_;
};

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
    PrimaryRays rays(executor, flat, buffers, view);
    InstanceCounts counts(std::size_t{view.width} * view.height);
    for (std::uint32_t sample = 0; sample < view.samples; ++sample)
        if (!rays.trace(sample, [&](std::span<const std::uint32_t> ids) { counts.add(ids); }))
            return false;
    if (settings.objects) attach_cryptomatte("CryptoObject", counts, object_names(scene), image);
    if (settings.materials)
        attach_cryptomatte("CryptoMaterial", counts, material_names(scene), image);
    return true;
}

std::optional<std::uint32_t> instance_at(Executor& executor, const FlatScene& flat,
                                         const SceneBuffers& buffers, const MatteView& view,
                                         std::uint32_t x, std::uint32_t y) {
    if (x >= view.width || y >= view.height) return {};
    std::uint32_t found = INVALID_INDEX;
    (void)PrimaryRays(executor, flat, buffers, view)
        .trace(0, [&](std::span<const std::uint32_t> ids) {
            found = ids[2 * (std::size_t{y} * view.width + x)];
        });
    return found == INVALID_INDEX ? std::nullopt : std::optional(found);
}

}  // namespace weft
