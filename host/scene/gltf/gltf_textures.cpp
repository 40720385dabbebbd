// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_textures.h"

#include <string>
#include <utility>

#include "base/limits.h"
#include "scene/texture/image_file.h"

namespace weft {
namespace {

struct Sampler {
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    bool nearest = false;
};

Wrap wrap_mode(const JsonValue& sampler, const char* key) {
    const std::optional<JsonValue> value = sampler.find(key);
    if (!value) return Wrap::repeat;
    switch (value->as_integer()) {
        case 10497:
            return Wrap::repeat;
        case 33071:
            return Wrap::clamp;
        case 33648:
            return Wrap::mirror;
        default:
            throw value->error("is " + std::to_string(value->as_integer()) +
                               ", expected 10497, 33071 or 33648");
    }
}

Sampler read_sampler(const JsonValue& root, const JsonValue& texture) {
    const std::optional<JsonValue> reference = texture.find("sampler");
    if (!reference) return {};
    const std::size_t index = reference->as_index(root.size_of("samplers"), "samplers");
    const JsonValue value = root.at("samplers").element(index);
    const std::optional<JsonValue> filter = value.find("magFilter");
    const std::uint64_t code = filter ? filter->as_integer() : 9729;
    if (code != 9728 && code != 9729)
        throw filter->error("is " + std::to_string(code) + ", expected 9728 or 9729");
    return {wrap_mode(value, "wrapS"), wrap_mode(value, "wrapT"), code == 9728};
}

}  // namespace

GltfTextures::GltfTextures(const GltfDocument& document, GltfData& data, WarningCollector& report,
                           std::vector<Texture>& textures)
    : root_(document.root()), data_(data), report_(report), textures_(textures) {}

std::optional<std::size_t> GltfTextures::image_of(const JsonValue& texture, std::size_t index) {
    const std::optional<JsonValue> source = texture.find("source");
    if (source) return source->as_index(root_.size_of("images"), "images");
    if (without_image_.insert(index).second)
        report_.count(texture.place(), {"texture", "textures"},
                      "no PNG or JPEG image is given, plain white is rendered instead");
    return std::nullopt;
}

Texture GltfTextures::decode(std::size_t image) {
    const JsonValue value = root_.at("images").element(image);
    const std::optional<JsonValue> uri = value.find("uri");
    const std::optional<JsonValue> view = value.find("bufferView");
    Texture texture;
    if (uri) {
        texture = decode_image(data_.read_uri(*uri, limits::max_image_file_bytes), uri->place());
    } else if (view) {
        texture = decode_image(data_.view(*view).bytes, value.place());
    } else {
        throw value.error("lacks both 'uri' and 'bufferView', expected one of them");
    }
    decoded_bytes_ += texture.rgba.size();
    if (decoded_bytes_ > limits::max_texture_bytes)
        throw value.error("all images together exceed the limit of " +
                          std::to_string(limits::max_texture_bytes) + " decoded bytes");
    texture.name = value.name_or("image " + std::to_string(image));
    return texture;
}

Texture GltfTextures::image(const JsonValue& reference) {
    return decode(reference.as_index(root_.size_of("images"), "images"));
}

std::optional<int> GltfTextures::add(const JsonValue& reference, const GltfTextureUse& use) {
    const std::size_t index = reference.as_index(root_.size_of("textures"), "textures");
    const JsonValue value = root_.at("textures").element(index);
    const Sampler sampler = read_sampler(root_, value);
    const std::optional<std::size_t> image = image_of(value, index);
    if (!image) return std::nullopt;
    const auto key =
        std::make_tuple(*image, sampler.wrap_u, sampler.wrap_v, sampler.nearest, use.srgb);
    if (const auto known = added_.find(key); known != added_.end()) {
        textures_[static_cast<std::size_t>(known->second)].has_alpha |= use.alpha;
        return known->second;
    }
    Texture texture = decode(*image);
    texture.srgb = use.srgb;
    texture.has_alpha = use.alpha;
    texture.wrap_u = sampler.wrap_u;
    texture.wrap_v = sampler.wrap_v;
    texture.nearest = sampler.nearest;
    textures_.push_back(std::move(texture));
    return added_[key] = static_cast<int>(textures_.size() - 1);
}

}  // namespace weft
