// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/shared_scene.h"

namespace weft {
namespace {

/// Stands for the shared scene, which outlives all its users.
class Placeholder : public TracedScene {};

}  // namespace

std::unique_ptr<TracedScene> SharedScene::make_scene(const TracedGeometry& geometry) {
    if (!scene_) scene_ = inner().make_scene(geometry);
    return std::make_unique<Placeholder>();
}

void SharedScene::update_scene(TracedScene&, const TracedGeometry& geometry) {
    inner().update_scene(*scene_, geometry);
}

bool SharedScene::run(const Launch& launch, const std::function<bool(double)>& keep_going) {
    Launch passed = launch;
    if (launch.scene != nullptr) passed.scene = scene_.get();
    return inner().run(passed, keep_going);
}

}  // namespace weft
