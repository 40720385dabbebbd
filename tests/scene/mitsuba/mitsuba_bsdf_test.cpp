// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_bsdf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "scene/mitsuba/mitsuba_optics.h"
#include "scene/validate_scene.h"
#include "tests/testing/mitsuba_folder.h"

namespace weft::mitsuba_bsdf_test {
namespace {

std::string rectangle(const std::string& content) {
    return "<shape type=\"rectangle\">" + content + "</shape>";
}

std::string bsdf(const std::string& type, const std::string& content = "") {
    return "<bsdf type=\"" + type + "\">" + content + "</bsdf>";
}

std::string number(const std::string& name, const std::string& value) {
    return "<float name=\"" + name + "\" value=\"" + value + "\"/>";
}

std::string text(const std::string& name, const std::string& value) {
    return "<string name=\"" + name + "\" value=\"" + value + "\"/>";
}

std::string rgb(const std::string& name, const std::string& value) {
    return "<rgb name=\"" + name + "\" value=\"" + value + "\"/>";
}

std::string bitmap(const std::string& name, const std::string& content = "") {
    return "<texture name=\"" + name + "\" type=\"bitmap\">" + text("filename", "image.tga") +
           content + "</texture>";
}

/// The material of a rectangle with this bsdf; the scene is valid.
Material material_of(const std::string& bsdf) {
    MitsubaFolder folder;
    const Scene scene = folder.read(rectangle(bsdf));
    validate_scene(scene);
    return scene.materials.at(0);
}

SurfaceDescription described(const std::string& bsdf) {
    const Material material = material_of(bsdf);
    EXPECT_TRUE(material.description.has_value()) << bsdf;
    return material.description.value_or(SurfaceDescription{});
}

template <class Model>
Model model_of(const std::string& bsdf) {
    const SurfaceDescription surface = described(bsdf);
    const Model* const model = std::get_if<Model>(&surface.model);
    EXPECT_NE(model, nullptr) << bsdf;
    return model == nullptr ? Model{} : *model;
}

/// The error of a rectangle with this bsdf, which begins on line 3.
std::string error_of(const std::string& bsdf) {
    MitsubaFolder folder;
    return folder.error(rectangle("\n" + bsdf));
}

TEST(MitsubaBsdf, NamesStandForIndices) {
    EXPECT_EQ(mitsuba::named_ior("bk7"), 1.5046);
    EXPECT_EQ(mitsuba::named_ior("Water"), 1.333);
    EXPECT_EQ(mitsuba::named_ior("diamond"), 2.419);
    EXPECT_EQ(mitsuba::named_ior("air"), 1.000277);
    EXPECT_FALSE(mitsuba::named_ior("glass").has_value());
    EXPECT_EQ(mitsuba::named_conductor("Au")->eta, glm::vec3(0.1430F, 0.3753F, 1.4420F));
    EXPECT_EQ(mitsuba::named_conductor("none")->k, glm::vec3(1.0F));
    EXPECT_FALSE(mitsuba::named_conductor("au").has_value());
}

TEST(MitsubaBsdf, ConductorsAreMirrorsByDefault) {
    const auto mirror = model_of<ConductorSurface>(bsdf("conductor"));
    EXPECT_EQ(mirror.eta, glm::vec3(0.0F));
    EXPECT_EQ(mirror.k, glm::vec3(1.0F));
    EXPECT_TRUE(mirror.roughness_u.value.is_zero());
    EXPECT_EQ(mirror.reflectance.factor, glm::vec3(1.0F));
    const auto copper = model_of<ConductorSurface>(
        bsdf("conductor", text("material", "Cu") + rgb("specular_reflectance", "0.5")));
    EXPECT_EQ(copper.k, glm::vec3(3.9133F, 2.4530F, 2.1421F));
    EXPECT_EQ(copper.reflectance.factor, glm::vec3(0.5F));
    const auto own =
        model_of<ConductorSurface>(bsdf("conductor", rgb("eta", "0.2 3 4") + number("k", "7")));
    EXPECT_EQ(own.eta, glm::vec3(0.2F, 3.0F, 4.0F));
    EXPECT_EQ(own.k, glm::vec3(7.0F));
    MitsubaFolder folder;
    const Scene scene = folder.read(rectangle(bsdf("conductor", text("material", "Hg"))));
    EXPECT_EQ(std::get<ConductorSurface>(scene.materials[0].description->model).eta,
              mitsuba::named_conductor("Al")->eta);
    EXPECT_EQ(folder.warnings().back(),
              "1 bsdf: metal 'Hg' is not known, aluminium is used; at s.xml:2");
}

TEST(MitsubaBsdf, RoughnessIsBeckmannsUnlessTheFileSaysOtherwise) {
    const auto plain = model_of<ConductorSurface>(bsdf("roughconductor"));
    EXPECT_EQ(plain.roughness_u.value.factor, 0.1F);
    EXPECT_EQ(plain.roughness_u.scale, RoughnessScale::alpha);
    EXPECT_EQ(plain.microfacets.distribution, MicrofacetDistribution::beckmann);
    EXPECT_TRUE(plain.microfacets.separable);
    EXPECT_TRUE(plain.microfacets.single_scatter);
    const auto ggx = model_of<ConductorSurface>(
        bsdf("roughconductor",
             text("distribution", "GGX") + number("alpha_u", "0.05") + number("alpha_v", "0.3")));
    EXPECT_EQ(ggx.microfacets.distribution, MicrofacetDistribution::ggx);
    EXPECT_EQ(ggx.roughness_u.value.factor, 0.05F);
    EXPECT_EQ(ggx.roughness_v.value.factor, 0.3F);
    // Mitsuba's least.
    EXPECT_EQ(model_of<ConductorSurface>(bsdf("roughconductor", number("alpha", "0")))
                  .roughness_v.value.factor,
              1e-4F);
    const auto textured = model_of<ConductorSurface>(bsdf("roughconductor", bitmap("alpha")));
    EXPECT_EQ(textured.roughness_u.value.map.channel, Channel::luminance);
    EXPECT_EQ(textured.roughness_u.value.map.texture, 0);
    EXPECT_EQ(textured.roughness_u.value.map, textured.roughness_v.value.map);
}

TEST(MitsubaBsdf, DielectricsAreGlassInAir) {
    const auto glass = model_of<DielectricSurface>(bsdf("dielectric"));
    EXPECT_EQ(glass.ior_inside, 1.5046);
    EXPECT_EQ(glass.ior_outside, 1.000277);
    EXPECT_TRUE(glass.local_index);
    EXPECT_FALSE(glass.thin);
    EXPECT_TRUE(glass.roughness_u.value.is_zero());
    const auto water = model_of<DielectricSurface>(
        bsdf("dielectric", text("int_ior", "water") + number("ext_ior", "1.0") +
                               rgb("specular_transmittance", "0.5 0.25 1")));
    EXPECT_EQ(water.ior_inside, 1.333);
    EXPECT_EQ(water.ior_outside, 1.0);
    EXPECT_EQ(water.transmittance.factor, glm::vec3(0.5F, 0.25F, 1.0F));
    EXPECT_TRUE(model_of<DielectricSurface>(bsdf("thindielectric")).thin);
    const auto frosted =
        model_of<DielectricSurface>(bsdf("roughdielectric", number("alpha", "0.3")));
    EXPECT_EQ(frosted.roughness_u.value.factor, 0.3F);
    EXPECT_TRUE(frosted.microfacets.separable);
    EXPECT_TRUE(material_of(bsdf("dielectric")).two_sided);
}

TEST(MitsubaBsdf, PlasticsHaveADiffuseBase) {
    const auto plain = model_of<PlasticSurface>(bsdf("plastic"));
    EXPECT_EQ(plain.ior_inside, 1.49);
    EXPECT_EQ(plain.diffuse.factor, glm::vec3(0.5F));
    EXPECT_EQ(plain.specular.factor, glm::vec3(1.0F));
    EXPECT_FALSE(plain.nonlinear);
    EXPECT_TRUE(plain.roughness.value.is_zero());
    const auto rough = model_of<PlasticSurface>(
        bsdf("roughplastic", rgb("diffuse_reflectance", "0.1 0.2 0.3") + number("alpha", "0.25") +
                                 text("distribution", "ggx") + number("int_ior", "1.9") +
                                 "<boolean name=\"nonlinear\" value=\"true\"/>"));
    EXPECT_EQ(rough.diffuse.factor, glm::vec3(0.1F, 0.2F, 0.3F));
    EXPECT_EQ(rough.roughness.value.factor, 0.25F);
    EXPECT_EQ(rough.microfacets.distribution, MicrofacetDistribution::ggx);
    EXPECT_EQ(rough.ior_inside, 1.9);
    EXPECT_TRUE(rough.nonlinear);
}

TEST(MitsubaBsdf, AdaptersKeepWhatTheyHold) {
    const SurfaceDescription masked = described(
        bsdf("mask", number("opacity", "0.25") + bsdf("diffuse", rgb("reflectance", "0.3"))));
    EXPECT_EQ(std::get<LambertSurface>(masked.model).colour.factor, glm::vec3(0.3F));
    EXPECT_EQ(masked.opacity.mode, OpacityMode::blend);
    EXPECT_EQ(masked.opacity.alpha.factor, 0.25F);
    EXPECT_EQ(described(bsdf("mask", bsdf("plastic"))).opacity.alpha.factor, 0.5F);

    const SurfaceDescription bumpy = described(
        bsdf("twosided",
             bsdf("normalmap", bitmap("normalmap", "<boolean name=\"raw\" value=\"true\"/>") +
                                   bsdf("mask", bitmap("opacity") + bsdf("conductor")))));
    EXPECT_TRUE(std::holds_alternative<ConductorSurface>(bumpy.model));
    EXPECT_TRUE(bumpy.normal_map.present());
    EXPECT_TRUE(bumpy.normal_map.mitsuba_flip);
    EXPECT_TRUE(bumpy.normal_map.mitsuba_shadowing);
    EXPECT_TRUE(bumpy.normal_map.mitsuba_frame);
    EXPECT_EQ(bumpy.opacity.alpha.map.channel, Channel::luminance);
    EXPECT_TRUE(material_of(bsdf("twosided", bsdf("plastic"))).two_sided);
    EXPECT_FALSE(material_of(bsdf("plastic")).two_sided);
    // One mask in another leaves the product.
    const std::string inner = bsdf("mask", number("opacity", "0.5") + bsdf("diffuse"));
    EXPECT_EQ(described(bsdf("mask", bitmap("opacity") + inner)).opacity.alpha.factor, 0.5F);
    // Surfaces that are no more than diffuse have no description.
    EXPECT_FALSE(material_of(bsdf("twosided", bsdf("diffuse"))).description.has_value());
    EXPECT_FALSE(material_of(bsdf("hair")).description.has_value());
}

TEST(MitsubaBsdf, TexturesHaveTheirOwnTransforms) {
    MitsubaFolder folder;
    const std::string scaled =
        "<transform name=\"to_uv\"><scale x=\"2\" y=\"4\"/><translate x=\"0.5\"/></transform>";
    const Scene scene =
        folder.read(rectangle(bsdf("roughplastic", bitmap("diffuse_reflectance", scaled) +
                                                       bitmap("specular_reflectance"))) +
                    rectangle(bsdf("diffuse", bitmap("reflectance"))));
    validate_scene(scene);
    EXPECT_EQ(scene.textures.size(), 1U);
    const auto& surface = std::get<PlasticSurface>(scene.materials[0].description->model);
    EXPECT_EQ(surface.diffuse.map.to_uv * glm::dvec3(1, 1, 1), glm::dvec3(2.5, 4, 1));
    EXPECT_EQ(surface.specular.map.to_uv, glm::dmat3(1.0));
    const Mesh& mesh = scene.meshes.at(scene.instances[0].mesh);
    EXPECT_EQ(mesh.uv_sets.at(0).at(2), glm::vec2(1, 1)) << "as the shape has them";
    EXPECT_EQ(mesh.uvs.at(2), glm::vec2(2.5F, 4)) << "for the diffuse surface";
    EXPECT_TRUE(scene.meshes.at(scene.instances[1].mesh).uv_sets.empty());
}

TEST(MitsubaBsdf, MeshesWithoutCoordinatesGetSomeForTheirTextures) {
    MitsubaFolder folder;
    const Scene scene = folder.read("<shape type=\"ply\">" + text("filename", "bare.ply") +
                                    bsdf("roughconductor", bitmap("alpha")) + "</shape>");
    validate_scene(scene);
    EXPECT_EQ(scene.meshes.at(0).uv_sets.at(0), (std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}}));
    EXPECT_TRUE(scene.meshes.at(0).uvs.empty());
}

TEST(MitsubaBsdf, LobesWithADirectionKeepTheCoordinatesThatItFollows) {
    MitsubaFolder folder;
    const Scene scene = folder.read(
        rectangle(bsdf("roughconductor", number("alpha_u", "0.1") + number("alpha_v", "0.3"))) +
        rectangle(bsdf("roughconductor", number("alpha", "0.1"))) + "<shape type=\"ply\">" +
        text("filename", "bare.ply") +
        bsdf("roughconductor", number("alpha_u", "0.1") + number("alpha_v", "0.3")) + "</shape>");
    validate_scene(scene);
    const auto mesh_of = [&](std::size_t i) { return scene.meshes.at(scene.instances.at(i).mesh); };
    ASSERT_EQ(mesh_of(0).uv_sets.size(), 1U);
    EXPECT_EQ(mesh_of(0).uv_sets[0], mesh_of(0).uvs);
    EXPECT_TRUE(mesh_of(1).uv_sets.empty());
    EXPECT_TRUE(mesh_of(2).uv_sets.empty()) << "without coordinates there is none";
}

TEST(MitsubaBsdf, PrincipledSurfacesBecomeMetalAndDielectric) {
    const auto plain = model_of<MetallicSurface>(bsdf("principled"));
    EXPECT_EQ(plain.base_colour.factor, glm::vec3(0.5F));
    EXPECT_EQ(plain.roughness.value.factor, 0.5F);
    EXPECT_TRUE(plain.metallic.is_zero());
    EXPECT_NEAR(plain.ior, 1.5F, 1e-6F) << "specular 0.5";
    EXPECT_FALSE(plain.solid);
    const auto full = model_of<MetallicSurface>(bsdf(
        "principled",
        rgb("base_color", "0.2 0.4 0.8") + number("metallic", "0.7") + number("roughness", "0.6") +
            number("anisotropic", "0.5") + number("spec_trans", "0.3") + number("eta", "1.33") +
            number("clearcoat", "0.8") + number("clearcoat_gloss", "1") + number("sheen", "0.3")));
    EXPECT_EQ(full.metallic.factor, 0.7F);
    EXPECT_TRUE(full.solid);
    EXPECT_TRUE(full.transmission_by_root);
    EXPECT_EQ(full.ior, 1.33F);
    EXPECT_NEAR(full.clearcoat.factor.factor, 0.2F, 1e-6F);
    EXPECT_NEAR(full.clearcoat.roughness.value.factor, 0.001F, 1e-7F);
    EXPECT_EQ(full.clearcoat.roughness.scale, RoughnessScale::alpha);
    // Disney's ax and ay: r^2 over and times the root of 1 - 0.9 * 0.5.
    const double aspect = std::sqrt(0.55);
    const double across = alpha_of(full.roughness.value.factor, full.roughness.scale);
    const double strength = full.anisotropy.strength;
    EXPECT_NEAR(across, 0.36 * aspect, 1e-6);
    EXPECT_NEAR(across + (1.0 - across) * strength * strength, 0.36 / aspect, 1e-6);
}

TEST(MitsubaBsdf, DiffuseDetailReadsNoMore) {
    MitsubaFolder folder;
    const auto path = folder.folder().write(
        "d.xml", "<scene version=\"3.0.0\">" + rectangle(bsdf("plastic", number("int_ior", "-1"))) +
                     "</scene>");
    Diagnostics diagnostics;
    const Scene scene = read_mitsuba(path, diagnostics, MaterialDetail::diffuse);
    EXPECT_FALSE(scene.materials.at(0).description.has_value());
    EXPECT_EQ(diagnostics.warnings().size(), 1U);
}

TEST(MitsubaBsdf, WrongValuesAreRefused) {
    EXPECT_EQ(error_of(bsdf("dielectric", number("int_ior", "0"))),
              "s.xml:3: int_ior is 0, expected 0.01 to 100");
    EXPECT_EQ(error_of(bsdf("plastic", number("ext_ior", "-1.5"))),
              "s.xml:3: ext_ior is -1.5, expected 0.01 to 100");
    EXPECT_EQ(error_of(bsdf("dielectric", number("int_ior", "1e30"))),
              "s.xml:3: int_ior is 1e+30, expected 0.01 to 100");
    EXPECT_TRUE(error_of(bsdf("dielectric", text("int_ior", "jelly")))
                    .starts_with("s.xml:3: int_ior names the material 'jelly', expected one of "
                                 "vacuum, helium"));
    EXPECT_EQ(error_of(bsdf("dielectric", rgb("int_ior", "1.5"))),
              "s.xml:3: int_ior is a <rgb>, expected a <float> or the <string> of a material");
    EXPECT_EQ(error_of(bsdf("roughconductor", number("alpha", "-1"))),
              "s.xml:3: 'alpha' is -1, expected 0 to 1e+06");
    EXPECT_EQ(error_of(bsdf("roughconductor", number("alpha", "nan"))),
              "s.xml:3: bad number 'nan', expected a finite decimal number");
    EXPECT_TRUE(error_of(bsdf("roughconductor", number("alpha_u", "0.1")))
                    .starts_with("s.xml:3: 'alpha_u' or 'alpha_v' alone"));
    EXPECT_EQ(error_of(bsdf("roughdielectric", text("distribution", "phong"))),
              "s.xml:3: distribution 'phong', expected beckmann or ggx");
    EXPECT_EQ(error_of(bsdf("conductor", text("material", "Au") + number("k", "1"))),
              "s.xml:3: both a material and 'eta' or 'k', expected one of the two");
    EXPECT_EQ(error_of(bsdf("conductor", rgb("eta", "-1"))),
              "s.xml:3: negative colour, expected numbers from 0 on");
    EXPECT_EQ(error_of(bsdf("plastic", rgb("specular_reflectance", "2"))),
              "s.xml:3: reflectance outside of its range, expected 0 to 1");
    EXPECT_EQ(error_of(bsdf("mask", number("opacity", "1.5") + bsdf("diffuse"))),
              "s.xml:3: 'opacity' is 1.5, expected 0 to 1");
    EXPECT_EQ(error_of(bsdf("mask")), "s.xml:3: mask with 0 nested bsdfs, expected 1");
    EXPECT_EQ(error_of(bsdf("normalmap", bsdf("diffuse"))),
              "s.xml:3: normalmap without a texture, expected a <texture name=\"normalmap\">");
    EXPECT_EQ(error_of(bsdf("normalmap", rgb("normalmap", "1") + bsdf("diffuse"))),
              "s.xml:3: normals are a 'rgb', expected a texture");
    EXPECT_EQ(error_of(bsdf("principled", number("eta", "1.5") + number("specular", "0.5"))),
              "s.xml:3: both 'eta' and 'specular', expected one of the two");
    EXPECT_EQ(error_of(bsdf("principled", number("eta", "0.5"))),
              "s.xml:3: eta is 0.5, expected 1 to 100");
}

TEST(MitsubaBsdf, CheckerboardsBecomeTextures) {
    MitsubaFolder folder;
    const auto read = [&](const std::string& colours) {
        return folder.read(
            rectangle(bsdf("diffuse", "<texture name=\"reflectance\" type=\"checkerboard\">" +
                                          colours + "</texture>")));
    };
    /// The colour at the middle of a quarter of the pattern, counted in rows.
    const auto colour_at = [](const Scene& scene, std::size_t quarter) {
        const std::vector<std::uint8_t>& rgba = scene.textures.at(0).rgba;
        glm::vec3 colour = diffuse_albedo(scene.materials.at(0));
        for (int c = 0; c < 3; ++c)
            colour[c] *=
                static_cast<float>(rgba.at(4 * quarter + static_cast<std::size_t>(c))) / 255.0F;
        return colour;
    };
    const Scene plain = read("");
    EXPECT_TRUE(folder.warnings().empty());
    const Texture& texture = plain.textures.at(0);
    EXPECT_EQ(texture.width, 2U);
    EXPECT_EQ(texture.height, 2U);
    EXPECT_TRUE(texture.nearest);
    EXPECT_FALSE(texture.srgb);
    EXPECT_EQ(texture.wrap_u, Wrap::repeat);
    for (const std::size_t quarter : {0U, 1U, 2U, 3U}) {
        const float expected = quarter == 0 || quarter == 3 ? 0.4F : 0.2F;
        EXPECT_NEAR(colour_at(plain, quarter).g, expected, 1e-6F) << quarter;
    }
    // Any two colours are met within half a thousandth of the greater.
    const Scene odd = read(rgb("color0", "0.123 0.9999 0") + rgb("color1", "0.871 0.3331 0"));
    EXPECT_NEAR(colour_at(odd, 0).r, 0.123F, 5e-4F);
    EXPECT_NEAR(colour_at(odd, 1).r, 0.871F, 1e-6F);
    EXPECT_NEAR(colour_at(odd, 0).g, 0.9999F, 1e-6F);
    EXPECT_NEAR(colour_at(odd, 1).g, 0.3331F, 2e-3F) << "a byte of 255";
    EXPECT_EQ(colour_at(odd, 2).b, 0.0F);
    EXPECT_NE(folder.error(
                  rectangle(bsdf("diffuse", "<texture name=\"reflectance\" type=\"checkerboard\">" +
                                                rgb("color0", "2") + "</texture>"))),
              "no error");
}

}  // namespace
}  // namespace weft::mitsuba_bsdf_test
