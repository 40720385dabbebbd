// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_medium.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <system_error>

#include "base/error.h"
#include "base/quote.h"

namespace weft::mitsuba {

int MediumReader::index(const Element* medium) {
    if (medium == nullptr) return -1;
    if (const auto found = indices_.find(medium); found != indices_.end()) return found->second;
    if (medium->tag != "medium")
        throw input_error(medium->place(), "a <" + medium->tag + "> where a <medium> is expected");
    scene_.media.push_back(read(*medium));
    const int index = static_cast<int>(scene_.media.size()) - 1;
    indices_.emplace(medium, index);
    return index;
}

Medium MediumReader::read(const Element& element) {
    Object object(element, context_);
    Medium medium;
    medium.type = object.type();
    medium.name = object.id_or(medium.type);
    if (medium.type != "homogeneous" && medium.type != "heterogeneous")
        throw input_error(object.place(), "medium " + quote(medium.type) +
                                              ", expected homogeneous or heterogeneous");
    const double scale = object.number("scale", 1.0);
    if (scale < 0.0)
        throw input_error(object.place(), "negative medium scale, expected a number from 0 on");
    medium.scale = static_cast<float>(scale);
    read_coefficients(object, medium);
    read_phase(object, medium);
    object.ignore({"sample_emitters", "has_spectral_extinction", "majorant_resolution_factor"});
    object.report_unused();
    return medium;
}

void MediumReader::read_coefficients(Object& object, Medium& medium) {
    const Element* const density = object.find("sigma_t");
    if (medium.type == "heterogeneous") {
        if (density == nullptr || density->tag != "volume")
            throw input_error(object.place(),
                              "heterogeneous medium without a density, expected a "
                              "<volume name=\"sigma_t\">");
        read_density(*density, medium);
        read_albedo(object, medium);
        return;
    }
    if (object.find("sigma_a") == nullptr && object.find("sigma_s") == nullptr) {
        medium.sigma_t = read_volume(object, "sigma_t", glm::vec3(1.0F));
        medium.albedo = read_volume(object, "albedo", glm::vec3(0.75F));
    } else {
        if (density != nullptr || object.find("albedo") != nullptr)
            throw input_error(object.place(),
                              "sigma_a or sigma_s beside sigma_t or albedo, "
                              "expected one of the two pairs");
        const glm::vec3 absorbed = read_volume(object, "sigma_a", glm::vec3(0.0F));
        const glm::vec3 scattered = read_volume(object, "sigma_s", glm::vec3(0.0F));
        medium.sigma_t = absorbed + scattered;
        for (int i = 0; i < 3; ++i)
            medium.albedo[i] = medium.sigma_t[i] > 0.0F ? scattered[i] / medium.sigma_t[i] : 0.0F;
        if (!std::isfinite(medium.sigma_t.r + medium.sigma_t.g + medium.sigma_t.b))
            throw input_error(object.place(), "sigma_a + sigma_s is too large, expected less");
    }
    if (glm::any(glm::greaterThan(medium.albedo, glm::vec3(1.0F))))
        throw input_error(object.place(), "medium albedo above 1, expected 0 to 1");
}

glm::vec3 MediumReader::read_volume(Object& object, const char* name, const glm::vec3& missing) {
    const Element* const found = object.find(name);
    if (found == nullptr || found->tag != "volume")
        return object.colour(name, ColourUse::medium, missing);
    Object volume(*found, context_);
    if (volume.type() == "constvolume") return volume.colour("value", ColourUse::medium, missing);
    if (volume.type() == "gridvolume")
        throw input_error(volume.place(),
                          fmt::format("a grid for {}, expected a constant: only the sigma_t and "
                                      "the albedo of heterogeneous media may vary",
                                      quote(name)));
    context_.warnings.count(*found, {"volume", "volumes"},
                            fmt::format("type {} for {} is not supported, {} is used instead",
                                        quote(volume.type()), quote(name), missing.r));
    return missing;
}

void MediumReader::read_density(const Element& volume, Medium& medium) {
    Object object(volume, context_);
    if (object.type() == "constvolume") {
        medium.sigma_t = object.colour("value", ColourUse::medium, glm::vec3(1.0F));
        return;
    }
    if (object.type() != "gridvolume")
        throw input_error(object.place(), "volume " + quote(object.type()) +
                                              ", expected gridvolume or constvolume");
    medium.grid = read_grid(object, volume, medium.grid_to_world);
}

void MediumReader::read_albedo(Object& object, Medium& medium) {
    const Element* const found = object.find("albedo");
    const bool is_grid = found != nullptr && found->tag == "volume" &&
                         Object(*found, context_).type() == "gridvolume";
    if (!is_grid) {
        medium.albedo = read_volume(object, "albedo", glm::vec3(0.75F));
        return;
    }
    Object volume(*found, context_);
    medium.albedo_grid = read_grid(volume, *found, medium.albedo_to_world);
    const DensityGrid& grid = scene_.grids[static_cast<std::size_t>(medium.albedo_grid)];
    if (grid.densities.empty())
        throw input_error(volume.place(), "a grid of albedos without voxels, expected some");
    if (greatest_density(grid) > 1.0F)
        throw input_error(volume.place(), "medium albedo above 1, expected 0 to 1");
}

int MediumReader::read_grid(Object& object, const Element& volume, glm::dmat4& to_world) {
    const std::filesystem::path path = object.file();
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
        throw input_error(object.place(),
                          "file " + quote(path.string()) + " is missing, expected a grid volume");
    const int grid = grids_.add(path, "", object.place());
    to_world = object.transform("to_world");
    if (object.boolean("use_grid_bbox", false))
        to_world *= scene_.grids[static_cast<std::size_t>(grid)].placement;
    if (object.text("filter_type").value_or("trilinear") != "trilinear")
        context_.warnings.count(volume, {"volume", "volumes"},
                                "filter_type is not supported, densities are trilinear");
    if (object.text("wrap_mode").value_or("clamp") != "clamp")
        context_.warnings.count(volume, {"volume", "volumes"},
                                "wrap_mode is not supported, coordinates are clamped");
    object.ignore({"raw", "accel"});
    object.report_unused();
    return grid;
}

void MediumReader::read_phase(Object& object, Medium& medium) {
    for (const Element* element : object.nested("phase")) {
        Object phase(*element, context_);
        if (phase.type() == "hg") {
            const double g = phase.number("g", 0.8);
            if (!(std::abs(g) < 1.0))
                throw input_error(phase.place(),
                                  fmt::format("g = {}, expected more than -1 and less than 1", g));
            medium.anisotropy = static_cast<float>(g);
        } else if (phase.type() != "isotropic") {
            context_.warnings.count(
                *element, {"phase function", "phase functions"},
                "type " + quote(phase.type()) + " is not supported, isotropic instead");
            continue;
        }
        phase.report_unused();
    }
}

}  // namespace weft::mitsuba
