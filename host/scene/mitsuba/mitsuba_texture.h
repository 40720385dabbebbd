// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_MITSUBA_MITSUBA_TEXTURE_H
#define WEFT_SCENE_MITSUBA_MITSUBA_TEXTURE_H

#include <cstddef>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <string_view>

#include "scene/mitsuba/mitsuba_object.h"
#include "scene/scene.h"
#include "scene/surface/surface_parameter.h"

namespace weft::mitsuba {

/// Reads what bsdfs say of colours and numbers, which may vary with textures: bitmaps and
/// checkerboards become Scene::textures. Others are named in a warning. Every function throws Error
/// (exit code 2) for what is wrong.
class TextureReader {
  public:
    TextureReader(Context& context, Scene& scene) : context_(context), scene_(scene) {}

    /// A reflectance, in [0, 1], from a colour or texture; each element is read once.
    [[nodiscard]] const ColourParameter& reflectance(const Element& element);

    /// The property `name` of an object as a reflectance.
    [[nodiscard]] ColourParameter reflectance(Object& object, std::string_view name,
                                              const glm::vec3& missing);

    /// The property `name` as a number from 0 to `most`, or the luminance of a texture.
    [[nodiscard]] ScalarParameter scalar(Object& object, std::string_view name, double missing,
                                         double most);

    /// A texture whose colours stand for vectors.
    [[nodiscard]] TextureMap vectors(const Element& element);

  private:
    [[nodiscard]] ColourParameter read_texture(const Element& element);
    [[nodiscard]] ColourParameter read_bitmap(Object& object);
    [[nodiscard]] ColourParameter read_checkerboard(Object& object);

    Context& context_;
    Scene& scene_;
    std::map<const Element*, ColourParameter> read_;
    std::map<std::string, int> bitmaps_;
    std::size_t bytes_ = 0;
};

}  // namespace weft::mitsuba

#endif
