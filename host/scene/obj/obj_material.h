// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_OBJ_OBJ_MATERIAL_H
#define WEFT_SCENE_OBJ_OBJ_MATERIAL_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>

#include "base/warning_collector.h"
#include "scene/obj/obj_data.h"
#include "scene/obj/obj_mtl.h"
#include "scene/obj/obj_surface.h"
#include "scene/scene.h"

namespace weft {

/// How texture coordinates of the file become those of a texture: times scale, plus offset.
struct ObjUvs {
    glm::dvec2 scale{1.0};
    glm::dvec2 offset{0.0};

    bool operator==(const ObjUvs&) const = default;
};

/// A material of the scene, and the coordinates of its textures.
struct ObjSurface {
    std::uint32_t material = 0;
    std::optional<ObjUvs> diffuse_uvs{};   ///< empty without texture
    std::optional<ObjUvs> emission_uvs{};  ///< empty without texture
    bool has_maps = false;                 ///< of the description
};

/// Makes materials of a scene from the MTL files of an OBJ file. Missing files and images are
/// named in the report and replaced by a default. Surfaces reflect and emit on both sides.
class ObjMaterials {
  public:
    ObjMaterials(std::filesystem::path obj_file, WarningCollector& report, MaterialDetail detail,
                 Scene& scene);

    /// Reads the files that an `mtllib` names: one name with blanks, or several words. Throws Error
    /// (exit code 2) for a file that is there, but broken.
    void read_library(const ObjLibrary& library);

    /// The material of that name, added to the scene at its first use; the default one, with a
    /// warning at `place`, where there is none.
    [[nodiscard]] const ObjSurface& surface(const std::string& name, const std::string& place);

    /// The material of faces without one.
    [[nodiscard]] const ObjSurface& default_surface();

    /// Whether this material of the scene is the default one.
    [[nodiscard]] bool is_default(std::uint32_t material) const {
        return default_ && default_->material == material;
    }

  private:
    [[nodiscard]] std::optional<std::filesystem::path> find_file(std::string_view reference,
                                                                 std::string& why) const;
    void report_lost(const ObjLibrary& library, const std::string& name, const std::string& why);
    bool read_file_named(std::string_view reference, const std::string& place, std::string& why);
    [[nodiscard]] ObjSurface make_surface(const std::string& name, const MtlMaterial& source);
    [[nodiscard]] std::optional<Texture> read_map(const MtlMap& map);
    [[nodiscard]] int add_texture(const MtlMap& map, bool srgb = true);
    [[nodiscard]] TextureMap add_map(const MtlMap& map, MtlMapUse use);

    std::filesystem::path obj_file_;
    WarningCollector& report_;
    MaterialDetail detail_;
    Scene& scene_;
    std::map<std::string, MtlMaterial, std::less<>> sources_;
    std::map<std::string, ObjSurface, std::less<>> surfaces_;
    std::optional<ObjSurface> default_;
    std::set<std::filesystem::path> libraries_;
    std::map<std::tuple<std::string, bool, bool>, int> textures_;
    std::size_t decoded_bytes_ = 0;
    bool library_lost_ = false;  ///< an MTL file could not be read
};

}  // namespace weft

#endif
