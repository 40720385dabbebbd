// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "film/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "base/json_text.h"
#include "shared/shared_types.h"

namespace weft {
namespace {

constexpr std::size_t ranks = 6;
constexpr std::size_t ranks_of_layer = 2;
constexpr std::string_view metadata_prefix = "cryptomatte/";
// A larger manifest names only what the image shows: headers of EXR files have a limit.
constexpr std::size_t largest_manifest = std::size_t{1} << 18;

struct Rank {
    std::uint32_t id = 0;
    std::uint32_t samples = 0;
};

/// What a pixel shows by name, most samples first. Instances of one name count as one.
std::vector<Rank> ranked(const InstanceCounts& counts, std::size_t pixel,
                         std::span<const std::uint32_t> ids) {
    std::vector<Rank> found;
    for (const InstanceCounts::Count& count : counts.of(pixel)) {
        if (count.samples == 0) break;
        const std::uint32_t id = ids[count.instance];
        const auto same = std::find_if(found.begin(), found.end(),
                                       [&](const Rank& rank) { return rank.id == id; });
        if (same != found.end())
            same->samples += count.samples;
        else
            found.push_back({id, count.samples});
    }
    std::sort(found.begin(), found.end(), [](const Rank& a, const Rank& b) {
        return std::pair(b.samples, a.id) < std::pair(a.samples, b.id);
    });
    if (found.size() > ranks) found.resize(ranks);
    return found;
}

/// Names with their identifiers as JSON.
std::string manifest_of(const std::set<std::string>& names) {
    nlohmann::json manifest = nlohmann::json::object();
    for (const std::string& name : names)
        manifest[name] = fmt::format("{:08x}", cryptomatte_id(name));
    return json_line(manifest);
}

}  // namespace

std::uint32_t murmur_hash(std::string_view text) {
    constexpr std::uint32_t c1 = 0xcc9e2d51U;
    constexpr std::uint32_t c2 = 0x1b873593U;
    const auto byte = [&](std::size_t i) {
        return std::uint32_t{static_cast<unsigned char>(text[i])};
    };
    const auto mixed = [](std::uint32_t k) { return std::rotl(k * c1, 15) * c2; };
    std::uint32_t hash = 0;
    const std::size_t whole = text.size() / 4 * 4;
    for (std::size_t i = 0; i < whole; i += 4) {
        hash ^= mixed(byte(i) | byte(i + 1) << 8 | byte(i + 2) << 16 | byte(i + 3) << 24);
        hash = std::rotl(hash, 13) * 5 + 0xe6546b64U;
    }
    std::uint32_t rest = 0;
    for (std::size_t i = text.size(); i-- > whole;) rest = rest << 8 | byte(i);
    if (whole < text.size()) hash ^= mixed(rest);
    hash ^= static_cast<std::uint32_t>(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bU;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35U;
    return hash ^ hash >> 16;
}

std::uint32_t cryptomatte_id(std::string_view name) {
    const std::uint32_t hash = murmur_hash(name);
    const std::uint32_t exponent = hash >> 23 & 255U;
    return exponent == 0 || exponent == 255 ? hash ^ 1U << 23 : hash;
}

void InstanceCounts::add(std::span<const std::uint32_t> ids) {
    for (std::size_t pixel = 0; pixel < pixels_.size(); ++pixel) {
        const std::uint32_t instance = ids[2 * pixel];
        if (instance == INVALID_INDEX) continue;
        for (Count& count : pixels_[pixel]) {
            if (count.samples > 0 && count.instance != instance) continue;
            count.instance = instance;
            ++count.samples;
            break;
        }
    }
    ++samples_;
}

void attach_cryptomatte(const std::string& layer, const InstanceCounts& counts,
                        std::span<const std::string> names, Image& image) {
    std::vector<std::uint32_t> ids;
    for (const std::string& name : names) ids.push_back(cryptomatte_id(name));
    const std::size_t pixels = counts.pixels();
    const float share = 1.0F / static_cast<float>(std::max(1U, counts.samples()));
    std::vector<Layer> layers;
    for (std::size_t i = 0; i < ranks / ranks_of_layer; ++i)
        layers.push_back({fmt::format("{}{:02}", layer, i), "RGBA",
                          std::vector<float>(2 * ranks_of_layer * pixels, 0.0F)});
    std::set<std::string> shown;
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const std::vector<Rank> found = ranked(counts, pixel, ids);
        for (std::size_t rank = 0; rank < found.size(); ++rank) {
            std::vector<float>& values = layers[rank / ranks_of_layer].values;
            const std::size_t channel = 2 * (rank % ranks_of_layer);
            values[channel * pixels + pixel] = std::bit_cast<float>(found[rank].id);
            values[(channel + 1) * pixels + pixel] =
                static_cast<float>(found[rank].samples) * share;
        }
        for (const InstanceCounts::Count& count : counts.of(pixel))
            if (count.samples > 0) shown.insert(names[count.instance]);
    }
    std::move(layers.begin(), layers.end(), std::back_inserter(image.layers));
    const std::string key =
        fmt::format("{}{:.7}/", metadata_prefix, fmt::format("{:08x}", murmur_hash(layer)));
    image.metadata[key + "name"] = layer;
    image.metadata[key + "hash"] = "MurmurHash3_32";
    image.metadata[key + "conversion"] = "uint32_to_float32";
    std::string manifest = manifest_of({names.begin(), names.end()});
    if (manifest.size() > largest_manifest) manifest = manifest_of(shown);
    image.metadata[key + "manifest"] = std::move(manifest);
}

bool is_cryptomatte(std::string_view name) {
    return name.starts_with(metadata_prefix) || name.starts_with("CryptoObject") ||
           name.starts_with("CryptoMaterial");
}

}  // namespace weft
