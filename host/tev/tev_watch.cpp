// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tev/tev_watch.h"

#include <fmt/format.h>

#include <span>
#include <vector>

#include "image/channel_name.h"
#include "tev/tev_packet.h"

namespace weft {
namespace {

std::vector<std::string> channels_of(const Layer& layer) {
    std::vector<std::string> names;
    for (const char channel : layer.channels) names.push_back(full_channel_name(layer, channel));
    return names;
}

}  // namespace

std::string TevWatch::send(const Image& image) {
    connection_.notice_end();
    if (!connection_.is_open()) created_.clear();
    std::string wrong = connection_.open(address_);
    if (!wrong.empty()) return wrong;
    std::vector<std::string> all;
    for (const Layer& layer : image.layers)
        if (!layer.words)
            for (std::string& channel : channels_of(layer)) all.push_back(std::move(channel));
    std::string shown = fmt::format("{}x{}", image.width, image.height);
    for (const std::string& channel : all) shown += ' ' + channel;
    if (shown != created_) {
        wrong = connection_.send(tev_create(image_, image.width, image.height, all));
        if (!wrong.empty()) return wrong;
        created_ = std::move(shown);
    }
    for (const Layer& layer : image.layers) {
        if (layer.words) continue;
        if (!tev_can_update(image.width, image.height, layer.channels.size()))
            return "it is too large for the viewer's packets";
        wrong = connection_.send(
            tev_update_head(image_, image.width, image.height, channels_of(layer)));
        if (wrong.empty()) wrong = connection_.send(std::as_bytes(std::span(layer.values)));
        if (!wrong.empty()) return wrong;
    }
    return {};
}

void TevWatch::update(const SessionImage& image) {
    const std::string wrong = send(image.image);
    if (!wrong.empty())
        diagnostics_.warn("", fmt::format("--tev: the image was not shown at {} port {} for some "
                                          "of the time: {}",
                                          address_.host, address_.port, wrong));
}

}  // namespace weft
