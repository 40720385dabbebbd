// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_LIMITS_H
#define WEFT_BASE_LIMITS_H

#include <cstddef>
#include <cstdint>

/// Limits that keep a hostile file from using up memory or time. Readers check sizes against these
/// before they allocate.
namespace weft::limits {

/// 2^bits; less for fuzzers, which search for errors rather than for large files and so reach a
/// limit with a small file in little time.
[[nodiscard]] constexpr std::size_t power(unsigned bits) {
#ifdef WEFT_SMALL_LIMITS
    return std::size_t{1} << (bits - 10);
#else
    return std::size_t{1} << bits;
#endif
}

inline constexpr std::size_t max_text_file_bytes = std::size_t{256} << 20;   // XML, glTF JSON
inline constexpr std::size_t max_binary_file_bytes = std::size_t{4} << 30;   // PLY, GLB, .bin
inline constexpr std::size_t max_data_uri_bytes = std::size_t{256} << 20;    // encoded length
inline constexpr std::size_t max_image_file_bytes = std::size_t{512} << 20;  // encoded image
inline constexpr std::uint32_t max_texture_edge = 16384;                     // pixels
inline constexpr std::size_t max_texture_bytes = power(32);                  // all, decoded
inline constexpr std::size_t max_uv_sets = 4;                                // of a material
inline constexpr std::size_t max_environment_pixels = power(27);             // 16384 x 8192
inline constexpr std::size_t max_vertices = power(28);                       // per mesh, and placed
inline constexpr std::size_t max_triangles = power(27);                      // whole scene
inline constexpr std::size_t max_nodes = std::size_t{1} << 20;               // nodes, shapes
inline constexpr std::size_t max_instances = power(22);                      // placed meshes
inline constexpr int max_nesting = 128;                                      // node/XML/JSON depth
inline constexpr std::size_t max_xml_items = std::size_t{1} << 22;           // tags + attributes
inline constexpr std::size_t max_xml_expanded_bytes = std::size_t{1} << 26;  // after $parameters
inline constexpr std::size_t max_xml_includes = 256;                         // one scene
inline constexpr std::size_t max_warnings = 200;                             // kinds, one file
inline constexpr std::size_t max_warning_places = 100'000;                   // of all warnings
inline constexpr std::size_t max_ply_header_line = 4096;                     // bytes
inline constexpr std::size_t max_ply_declarations = 1024;  // elements and properties of a PLY
inline constexpr std::size_t max_obj_file_bytes = std::size_t{2} << 30;
inline constexpr std::size_t max_mtl_file_bytes = std::size_t{16} << 20;
inline constexpr std::size_t max_mtl_files = 256;                     // of one OBJ
inline constexpr std::size_t max_ear_tests = power(28);               // concave polygons, one OBJ
inline constexpr std::size_t max_json_values = std::size_t{1} << 24;  // in one glTF file
inline constexpr std::size_t max_animation_keys = power(24);          // of one glTF file
inline constexpr std::size_t max_morph_targets = power(14);           // of one mesh
inline constexpr std::size_t max_morph_deltas = power(27);            // of one glTF file
inline constexpr std::size_t max_skin_joints = power(20);             // of one glTF file
inline constexpr std::size_t max_joint_influences = power(29);        // of one glTF file
inline constexpr std::size_t max_deformation_work = power(31);        // a pose: targets * vertices
inline constexpr std::size_t max_joint_sets = 4;                      // of four joints, a vertex
inline constexpr std::size_t max_implicit_elements = power(24);       // zeros, no bytes
inline constexpr std::size_t max_name_bytes = 256;                    // longer: cut
inline constexpr std::uint32_t max_film_edge = 32768;                 // pixels
inline constexpr std::size_t max_film_pixels = power(28);
inline constexpr std::size_t max_exr_header_bytes = std::size_t{1} << 20;  // all attributes
inline constexpr std::size_t max_hdr_header_bytes = std::size_t{1} << 16;  // all lines
inline constexpr std::size_t max_exr_channels = 128;                       // all layers
inline constexpr std::size_t max_exr_values = power(32);                   // all channels
inline constexpr std::uint32_t max_samples_per_pixel = 1u << 24;  // a float still counts them
inline constexpr std::uint32_t max_frames = 1u << 24;             // of an animation
inline constexpr std::size_t max_scene_edits = 100'000;           // of one file of edits
inline constexpr std::size_t max_edit_targets = power(24);        // placed meshes of all edits
inline constexpr std::uint32_t max_cache_records = 1u << 24;      // kept between frames
inline constexpr std::uint32_t min_cache_rays = 16;               // of one irradiance record
inline constexpr std::uint32_t max_cache_rays = 1u << 14;         // of one irradiance record
inline constexpr std::uint32_t max_threads = 4096;
inline constexpr std::uint32_t max_tile_edge = 4096;                     // pixels
inline constexpr std::size_t max_hdr_vdp_pixels = std::size_t{1} << 26;  // 7 GB of maps
inline constexpr std::size_t max_grid_voxels = power(28);                // of one density grid
inline constexpr std::size_t max_scene_voxels = power(30);               // of all of them
inline constexpr std::size_t max_nanovdb_bytes = power(31);              // one grid, unpacked
inline constexpr double max_coordinate = 1e15;  // |world coordinate|; beyond it squares overflow

}  // namespace weft::limits

#endif
