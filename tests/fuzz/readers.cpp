// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/readers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "app/options.h"
#include "base/diagnostics.h"
#include "base/error.h"
#include "base/finite.h"
#include "base/limits.h"
#include "bvh/wide_bvh.h"
#include "image/exr.h"
#include "image/hdr.h"
#include "image/read_png.h"
#include "plan/preset.h"
#include "render/camera_params.h"
#include "render/camera_placement.h"
#include "scene/flat_scene.h"
#include "scene/load/load_scene.h"
#include "scene/majorant_grid.h"
#include "scene/moving_scene.h"
#include "scene/obj/obj_reader.h"
#include "scene/ply/ply_reader.h"
#include "scene/pose_scene.h"
#include "scene/surface_lobes.h"
#include "scene/texture/environment_file.h"
#include "scene/texture/image_file.h"
#include "scene/validate_scene.h"
#include "scene/volume/nanovdb_reader.h"
#include "scene/volume/vol_reader.h"
#include "tests/testing/temporary_folder.h"
#include "tests/testing/vol_bytes.h"
#include "tradeoff/other_renderers.h"
#include "view/view_edits.h"
#include "view/view_message.h"

namespace weft::fuzz {
namespace {

namespace fs = std::filesystem;

// What scenes may refer to.
constexpr std::string_view triangle_ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
constexpr std::string_view pixel_tga("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\0\x40\x80\xC0", 21);
constexpr std::string_view part_xml =
    "<scene version=\"3.0.0\"><shape type=\"rectangle\" id=\"part\"/></scene>\n";
constexpr std::string_view square_obj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1 4/1\n";
constexpr std::string_view pair_hdr(
    "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x20\x81\x10\x20\x80\x80", 53);
constexpr std::string_view material_mtl = "newmtl red\nKd 0.8 0.1 0.1\nmap_Kd pixel.tga\n";

std::string_view as_text(Bytes bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// One folder for the whole process, since making it costs more than most inputs.
const TemporaryFolder& folder() {
    static const TemporaryFolder made;
    [[maybe_unused]] static const bool filled = [] {
        write_companions(made);
        return true;
    }();
    return made;
}

void require(bool condition, const char* what) {
    if (!condition) throw std::logic_error(what);
}

/// A message goes to a terminal, and is one line there.
void require_one_line(std::string_view text) {
    require(!text.empty(), "an empty message");
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        require(code >= 0x20 && code != 0x7F, "a message with a control character");
    }
}

void require_one_line(const Diagnostics& diagnostics) {
    for (const std::string& warning : diagnostics.warnings()) require_one_line(warning);
}

/// Runs `read`, which may end with an Error of this code alone.
template <typename Read>
void expect_error(ExitCode code, const Read& read) {
    try {
        read();
    } catch (const Error& error) {
        if (error.code() != code) throw;
        require_one_line(error.what());
    }
}

/// What a rendering over frames does with what moves.
void use_poses(const Scene& scene) {
    if (!is_animated(scene)) return;
    MovingScene moving(scene, {}, 2.0);
    for (const std::uint32_t frame : {0U, 1U, 3U, 1000U}) {
        moving.set_frame(frame);
        for (const shared::float4& p : moving.flat().positions)
            require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                    "a moving position that is not finite");
    }
}

/// What a rendering does with a scene before the first kernel runs.
void use_scene(const Scene& scene) {
    const FlatScene flat = flatten(scene);
    if (!scene.cameras.empty())
        for (const double time : {0.0, 0.7, 1e30})
            for (const Camera& camera : {scene.cameras.front(), scene.cameras.back()})
                require(is_finite(glm::vec3(camera_at(scene, camera, time).to_world[3])),
                        "a camera that is nowhere");
    for (const shared::float4& p : flat.positions)
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                "a position that is not finite");
    for (const shared::LightRecord& light : flat.lights)
        require(std::isfinite(light.probability) && light.probability >= 0.0F,
                "a light with an impossible probability");
    for (const Material& material : scene.materials)
        if (material.description)
            for (const SurfaceLobe& lobe : lobes_of(*material.description, flat.texture_statistics))
                require(lobe.least_alpha >= 0.0 && lobe.least_alpha <= lobe.most_alpha &&
                            std::isfinite(lobe.most_alpha),
                        "a lobe of an impossible width");
    use_poses(scene);
    constexpr std::size_t few = 1000;
    if (flat.triangles.size() > few) return;
    const BvhSettings settings;
    const WideBvh bvh = build_bvh(flat.positions, flat.triangles, settings);
    const std::string broken = check_bvh(bvh, flat.positions, flat.triangles, settings);
    require(broken.empty(), broken.c_str());
}

void read_scene(const std::string& name, Bytes bytes) {
    const fs::path path = folder().write(name, as_text(bytes));
    Diagnostics diagnostics;
    expect_error(ExitCode::bad_input, [&] { use_scene(load_scene(path, diagnostics)); });
    require_one_line(diagnostics);
}

void require_finite_colours(const Image& image) {
    require(image.width > 0 && image.height > 0 && image.layers.size() == 1 &&
                image.layers[0].values.size() == std::size_t{3} * image.width * image.height,
            "an image of the wrong size");
    for (const float value : image.layers[0].values)
        require(std::isfinite(value) && value >= 0.0F, "an impossible value");
}

/// A scene of this mesh alone.
Scene scene_of(Mesh mesh) {
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(std::move(mesh));
    scene.instances.emplace_back();
    return scene;
}

/// What a medium does with its densities.
void use_grid(const DensityGrid& grid) {
    validate_density_grid(grid, "grid");
    const MajorantGrid majorants = make_majorant_grid(greatest_channels(grid));
    const float greatest = greatest_density(grid);
    require(majorants.bounds.empty() == grid.densities.empty(), "bounds of nothing, or none");
    for (const float bound : majorants.bounds)
        require(bound >= 0.0F && bound <= greatest, "a bound that no voxel has");
    for (int column = 0; column < 4; ++column)
        require(is_finite(glm::vec3(grid.placement[column])), "a grid that is nowhere");
}

}  // namespace

void read_gltf_bytes(Bytes bytes) {
    read_scene(as_text(bytes).starts_with("glTF") ? "scene.glb" : "scene.gltf", bytes);
}

void read_mitsuba_bytes(Bytes bytes) {
    read_scene("scene.xml", bytes);
}

void read_ply_bytes(Bytes bytes) {
    const fs::path path = folder().write("input.ply", as_text(bytes));
    Diagnostics diagnostics;
    expect_error(ExitCode::bad_input, [&] {
        Mesh mesh = read_ply(path, "scene.xml:1", diagnostics);
        const std::size_t vertices = mesh.positions.size();
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t corner : triangle)
                require(corner < vertices && is_finite(mesh.positions[corner]),
                        "a corner that is nowhere");
        use_scene([&] {
            Scene scene = scene_of(std::move(mesh));
            validate_scene(scene);
            return scene;
        }());
    });
    require_one_line(diagnostics);
}

void read_vol_bytes(Bytes bytes) {
    Diagnostics diagnostics;
    expect_error(ExitCode::bad_input, [&] { use_grid(decode_vol(bytes, "grid", diagnostics)); });
    require_one_line(diagnostics);
}

void read_nanovdb_bytes(Bytes bytes) {
    Diagnostics diagnostics;
    expect_error(ExitCode::bad_input,
                 [&] { use_grid(decode_nanovdb(bytes, "", "grid", diagnostics)); });
    require_one_line(diagnostics);
}

void read_obj_bytes(Bytes bytes) {
    constexpr std::string_view mark = "#mtl\n";
    std::string_view text = as_text(bytes);
    const std::size_t cut = text.find(mark);
    folder().write("material.mtl",
                   cut == std::string_view::npos ? material_mtl : text.substr(cut + mark.size()));
    const fs::path path = folder().write("scene.obj", text.substr(0, cut));
    Diagnostics diagnostics;
    expect_error(ExitCode::bad_input, [&] {
        const Scene scene = read_obj(path, diagnostics);
        validate_scene(scene);
        use_scene(scene);
    });
    require_one_line(diagnostics);
}

void read_image_bytes(Bytes bytes) {
    expect_error(ExitCode::bad_input, [&] {
        const Texture texture = decode_image(bytes, "picture");
        require(texture.width > 0 && texture.height > 0 &&
                    texture.rgba.size() == std::size_t{4} * texture.width * texture.height,
                "an image of the wrong size");
    });
}

void use_environment(const EnvironmentFile& file) {
    const FlatEnvironment flat = flatten_environment(*file.image, glm::dmat3(1.0));
    for (const float sum : flat.sums)
        require(sum >= 0.0F && sum <= 1.0F, "an impossible probability");
    for (const float texel : flat.texels)
        require(std::isfinite(texel) && texel >= 0.0F, "an impossible radiance");
}

void read_exr_bytes(Bytes bytes) {
    const fs::path path = folder().write("picture.exr", as_text(bytes));
    expect_error(ExitCode::bad_input, [&] {
        const Image image = read_exr(path);
        const std::size_t pixels = std::size_t{image.width} * image.height;
        require(pixels > 0 && !image.layers.empty(), "an empty image");
        for (const Layer& layer : image.layers)
            require(
                !layer.channels.empty() && layer.values.size() == pixels * layer.channels.size(),
                "a layer of the wrong size");
    });
    expect_error(ExitCode::bad_input, [&] { use_environment(read_environment(path)); });
}

void read_hdr_bytes(Bytes bytes) {
    expect_error(ExitCode::bad_input,
                 [&] { require_finite_colours(decode_hdr(bytes, "picture")); });
    const fs::path path = folder().write("picture.hdr", as_text(bytes));
    expect_error(ExitCode::bad_input, [&] { use_environment(read_environment(path)); });
}

void read_png_bytes(Bytes bytes) {
    expect_error(ExitCode::bad_input,
                 [&] { require_finite_colours(decode_png(bytes, "picture")); });
}

void read_options_bytes(Bytes bytes) {
    // As the system gives it: no argument holds a NUL.
    std::string text(as_text(bytes));
    std::replace(text.begin(), text.end(), '\0', '\n');
    std::vector<const char*> arguments = {"weft"};
    constexpr std::size_t most = 64;
    for (std::size_t begin = 0; begin < text.size() && arguments.size() < most;) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        arguments.push_back(text.data() + begin);
        if (end < text.size()) text[end] = '\0';
        begin = end + 1;
    }
    expect_error(ExitCode::usage, [&] {
        const ParsedCommand command =
            parse_command_line(static_cast<int>(arguments.size()), arguments.data());
        if (const auto* render = std::get_if<RenderOptions>(&command))
            require(!options_json(*render).dump().empty(), "options without JSON");
    });
}

namespace {

/// A scene of one object, one material and one light, with the names that the dictionary has.
Scene edited_scene() {
    Scene scene;
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    scene.meshes.push_back(mesh);
    scene.materials.emplace_back().name = "red";
    Instance& instance = scene.instances.emplace_back();
    instance.name = "box";
    scene.lights.emplace_back().name = "lamp";
    return scene;
}

}  // namespace

void read_view_bytes(Bytes bytes) {
    expect_error(ExitCode::bad_input, [&] {
        const ViewMessage message = read_view_message(as_text(bytes));
        if (const auto* const camera = std::get_if<ViewCamera>(&message)) {
            const Camera placed = placed_camera({}, {camera->view, camera->fov});
            for (int column = 0; column < 4; ++column)
                for (int row = 0; row < 4; ++row)
                    require(std::isfinite(placed.to_world[column][row]),
                            "a camera that is not finite");
        }
        if (const auto* const settings = std::get_if<ViewSettings>(&message))
            require(!settings->size || settings->size->width > 0, "an image without pixels");
        if (const auto* const edit = std::get_if<ViewEdit>(&message)) {
            ViewEdits edits;
            edits.add(edit->change, 0, edit->continues);
            Scene scene = edited_scene();
            const EditTimeline timeline =
                read_scene_edits(nlohmann::json::parse(edits.text()), "edits", scene);
            apply_edits(timeline, 0, scene);
            for (const Instance& instance : scene.instances)
                require(transform_flaw(instance.to_world) == nullptr, "an unusable transform");
        }
    });
}

void read_preset_bytes(Bytes bytes) {
    expect_error(ExitCode::bad_input, [&] {
        const Preset preset = read_preset(folder().write("preset.json", as_text(bytes)));
        const nlohmann::json settings = preset_json(preset);
        const Preset again = read_preset(folder().write("again.json", settings.dump()));
        require(preset_json(again) == settings, "settings that are not those that were written");
    });
}

void read_peers_bytes(Bytes bytes) {
    const fs::path path = folder().write("peers.json", as_text(bytes));
    expect_error(ExitCode::bad_input, [&] {
        for (const OtherRendererPoint& peer : read_other_renderers(path, pair_size).images) {
            require(!peer.name.empty() && peer.name.size() <= limits::max_name_bytes,
                    "a name of the wrong length");
            for (const double number : {peer.budget_s, peer.seconds, peer.samples})
                require(std::isfinite(number) && number >= 0.0, "an impossible number");
            require(peer.image.width == pair_size.width && peer.image.height == pair_size.height &&
                        peer.image.layers.size() == 1,
                    "an image of another size");
            const Layer& layer = peer.image.layers[0];
            require(layer.channels == "RGB" && layer.values.size() == std::size_t{3} * 2,
                    "an image without colours");
            for (const float value : layer.values)
                require(std::isfinite(value), "a value that is not finite");
        }
    });
}

void write_companions(const TemporaryFolder& folder) {
    folder.write("triangle.ply", triangle_ply);
    folder.write("square.obj", square_obj);
    folder.write("material.mtl", material_mtl);
    folder.write("pixel.tga", pixel_tga);
    folder.write("pair.hdr", pair_hdr);
    folder.write("data.bin", std::string(36, '\0'));
    folder.write("part.xml", part_xml);
    folder.write("smoke.vol", vol_file({1, 2, 2}, {0, 1, 2, 3}));
}

std::span<const Reader> readers() {
    static constexpr std::array all = {
        Reader{"gltf", read_gltf_bytes},       Reader{"mitsuba", read_mitsuba_bytes},
        Reader{"ply", read_ply_bytes},         Reader{"vol", read_vol_bytes},
        Reader{"nanovdb", read_nanovdb_bytes}, Reader{"obj", read_obj_bytes},
        Reader{"image", read_image_bytes},     Reader{"exr", read_exr_bytes},
        Reader{"hdr", read_hdr_bytes},         Reader{"png", read_png_bytes},
        Reader{"options", read_options_bytes}, Reader{"preset", read_preset_bytes},
        Reader{"view", read_view_bytes},       Reader{"peers", read_peers_bytes},
    };
    return all;
}

}  // namespace weft::fuzz
