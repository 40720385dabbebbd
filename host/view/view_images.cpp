// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The images that ViewLoop sends to pages: those of a display while it renders, and files such as
// a command writes.
#include <algorithm>
#include <memory>
#include <utility>

#include "image/png.h"
#include "image/write_jpeg.h"
#include "view/view_loop.h"
#include "view/view_overlay.h"

namespace weft {
namespace {

// Moving images are replaced at once; those at rest are looked at.
constexpr JpegSettings moving_jpeg{80, true};
constexpr JpegSettings resting_jpeg{92, false};
constexpr double least_file_pause_ms = 300.0;
constexpr double file_pause_by_cost = 10.0;

}  // namespace

void ViewLoop::show(const DisplayFrame& frame) {
    // What refines a preview corrects it, which the film does not show.
    if (server_ == nullptr || shown_as_file_ || session_.refined_samples() > 0 ||
        phase_ == Phase::measuring || !choice_.overlay.empty())
        return;
    ViewFrame sent;
    sent.codec = ViewCodec::jpeg;
    sent.pane = pane_;
    sent.moving = divided_;
    sent.version = version_;
    sent.width = frame.width;
    sent.height = frame.height;
    sent.samples = static_cast<std::uint32_t>(frame.samples);
    sent.milliseconds = static_cast<float>(sample_ms_);
    sent.file = std::make_shared<const std::vector<std::byte>>(jpeg_bytes(
        frame.colours, frame.width, frame.height, divided_ ? moving_jpeg : resting_jpeg));
    server_->show(std::move(sent));
}

bool ViewLoop::has_image() const {
    return pane_ == 0 && session_.samples() > 0 && !stale_ && !changed_;
}

bool ViewLoop::has_command() const {
    if (session_.is_hasty()) return false;
    const auto* const preview = std::get_if<RenderSettings>(&session_.settings());
    if (preview == nullptr) return session_.samples() > 0;
    return session_.samples() >= last_.value_or(std::max(1U, preview->refined_after));
}

std::span<const float> ViewLoop::flip() const {
    if (!judgement_) return {};
    for (const JudgedErrors& errors : judgement_->images)
        if (errors.pane == 0) return errors.flip;
    return {};
}

void ViewLoop::show_overlay() {
    const Image image = session_.image().image;
    overlays_ = overlay_names(image, false);
    const Image overlay = overlay_of(image, choice_.overlay, {}, choice_.exposure_ev);
    ViewFrame sent;
    sent.codec = ViewCodec::png;
    sent.pane = pane_;
    sent.moving = divided_;
    sent.version = version_;
    sent.width = image.width;
    sent.height = image.height;
    sent.samples = static_cast<std::uint32_t>(session_.samples());
    sent.milliseconds = static_cast<float>(sample_ms_);
    sent.file = std::make_shared<const std::vector<std::byte>>(
        overlay.layers.empty() ? png_bytes(image, {choice_.exposure_ev, choice_.tone, {}})
                               : png_bytes(overlay, 0.0));
    server_->show(std::move(sent));
}

void ViewLoop::show_file() {
    const Stopwatch cost;
    SessionImage image = session_.image();
    const FileOutputSettings settings = recipe_.output(choice_of(pane_), "view.png");
    describe(image, settings);
    Image overlay;
    if (pane_ == 0) {
        overlays_ = overlay_names(image.image, !flip().empty());
        overlay = overlay_of(image.image, choice_.overlay, flip(), choice_.exposure_ev);
    }
    const bool plain = overlay.layers.empty();
    ViewFrame sent;
    sent.codec = ViewCodec::png;
    sent.pane = pane_;
    sent.final = has_command() && plain;
    sent.version = version_;
    sent.width = image.image.width;
    sent.height = image.image.height;
    sent.samples = static_cast<std::uint32_t>(image.samples);
    sent.milliseconds = static_cast<float>(sample_ms_);
    sent.file = std::make_shared<const std::vector<std::byte>>(
        plain ? png_bytes(image.image, png_settings(image.image, settings))
              : png_bytes(overlay, 0.0));
    shown_as_file_ = true;
    Shown& shown = shown_.at(pane_);
    shown.samples = has_command() ? image.samples : 0;
    shown.image = {pane_, image.samples, beauty_of(image.image)};
    server_->show(std::move(sent));
    next_file_ms_ = std::max(least_file_pause_ms, file_pause_by_cost * cost.total());
    since_file_ = Stopwatch();
    send_status();
}

}  // namespace weft
