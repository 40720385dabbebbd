// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_reader.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "scene/mitsuba/mitsuba_camera.h"
#include "scene/mitsuba/mitsuba_light.h"
#include "scene/mitsuba/mitsuba_material.h"
#include "scene/mitsuba/mitsuba_medium.h"
#include "scene/mitsuba/mitsuba_object.h"
#include "scene/mitsuba/mitsuba_shape.h"
#include "scene/mitsuba/mitsuba_xml.h"

namespace weft {

namespace {

/// Whether an element at the top of a scene has no effect of its own: hints for Mitsuba's
/// integrators, and objects that only count where they are referred to.
bool is_passive(std::string_view tag) {
    static constexpr std::array<std::string_view, 13> tags = {
        "integrator", "sampler", "rfilter", "film",     "bsdf",  "texture",  "medium",
        "phase",      "volume",  "rgb",     "spectrum", "alias", "resources"};
    return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

}  // namespace

Scene read_mitsuba(const std::filesystem::path& path, Diagnostics& diagnostics,
                   MaterialDetail detail) {
    mitsuba::Warnings warnings(diagnostics);
    mitsuba::Document document;
    mitsuba::load_document(path, warnings, document);
    mitsuba::Context context{document, warnings};
    Scene scene;
    scene.source = path.string();
    mitsuba::MaterialReader materials(context, scene, detail);
    mitsuba::MediumReader media(context, scene);
    mitsuba::ShapeReader shapes(context, materials, media, scene);
    for (const mitsuba::Element& element : document.root.children) {
        if (is_passive(element.tag)) continue;
        const mitsuba::Element& target = document.resolve(element);
        if (target.tag == "shape") {
            shapes.read(target);
        } else if (target.tag == "sensor") {
            mitsuba::read_camera(target, context, media, scene);
        } else if (target.tag == "emitter") {
            mitsuba::read_light(target, context, scene);
        } else {
            warnings.once(element, "<" + element.tag + "> is not supported here, ignored");
        }
    }
    return scene;
}

}  // namespace weft
