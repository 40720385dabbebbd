# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes with materials that `bench witness` and `bench path` write themselves, as Mitsuba XML.

    witness_scenes.py NAME FOLDER     writes one into a folder, and its path on a line

Most are one sphere of a material, above a diffuse floor or not, under an environment. All its facets
are flat, so that geometric and shading normals are the same, and programs need not agree on what
happens where they differ; the scenes whose names begin with `smooth` have the sphere's own normals.
"""

import collections
import pathlib
import sys

import witness_files

# What is seen, and how: text of the scene's objects, of its environment, and most scatterings of a
# path, or -1. `options` are Weft's.
Scene = collections.namedtuple("Scene", "objects sky depth", defaults=("sky", -1))

ROOM = """<scene version="3.0.0">
    <default name="max_depth" value="-1"/>
    <default name="rr_depth" value="5"/>
    <integrator type="path">
        <integer name="max_depth" value="$max_depth"/>
        <integer name="rr_depth" value="$rr_depth"/>
    </integrator>
    <sensor type="perspective">
        <float name="fov" value="34"/>
        <transform name="to_world">
            <lookat origin="0, 2.1, 4.2" target="0, 0.85, 0" up="0, 1, 0"/>
        </transform>
        <film type="hdrfilm">
            <integer name="width" value="128"/><integer name="height" value="128"/>
            <rfilter type="box"/>
        </film>
        <sampler type="independent"/>
    </sensor>
{sky}{objects}</scene>
"""

SKIES = {
    "constant": """    <emitter type="constant"><rgb name="radiance" value="0.9, 1, 1.1"/></emitter>
""",
    "sky": """    <emitter type="envmap"><string name="filename" value="sky.hdr"/></emitter>
""",
    "turned": """    <emitter type="envmap">
        <string name="filename" value="sky.hdr"/>
        <float name="scale" value="0.8"/>
        <transform name="to_world"><rotate x="1" angle="-25"/><rotate y="1" angle="130"/></transform>
    </emitter>
""",
    "dark": "",
}


def _value(name, value):
    """A parameter by its type."""
    if isinstance(value, bool):
        return f'<boolean name="{name}" value="{str(value).lower()}"/>'
    if isinstance(value, (int, float)):
        return f'<float name="{name}" value="{value}"/>'
    if isinstance(value, tuple):
        return f'<rgb name="{name}" value="{", ".join(map(str, value))}"/>'
    if value.startswith("<"):
        return value
    return f'<string name="{name}" value="{value}"/>'


def bsdf(kind, *inner, **values):
    """A material, with others inside of it."""
    parts = [_value(name, value) for name, value in values.items()]
    return f'<bsdf type="{kind}">{"".join(parts)}{"".join(inner)}</bsdf>'


def bitmap(name, file, raw=False):
    more = '<boolean name="raw" value="true"/>' if raw else ""
    return (f'<texture type="bitmap" name="{name}"><string name="filename" value="{file}"/>{more}'
            '</texture>')


def sphere(material, scale=1.0, place=(0, 1, 0), mesh="sphere.ply", more=""):
    x, y, z = place
    return f"""    <shape type="ply">
        <string name="filename" value="{mesh}"/>
        <transform name="to_world"><scale value="{scale}"/><translate x="{x}" y="{y}" z="{z}"/></transform>
        {material}{more}
    </shape>
"""


def rectangle(material, transform, more=""):
    return f"""    <shape type="rectangle">
        <transform name="to_world">{transform}</transform>
        {material}{more}
    </shape>
"""


def lamp(*radiance):
    return f'<emitter type="area">{_value("radiance", radiance)}</emitter>'


DIFFUSE = bsdf("diffuse", reflectance=(0.6, 0.5, 0.4))
BLACK = bsdf("diffuse", reflectance=(0, 0, 0))
FLOOR = rectangle(bsdf("twosided", DIFFUSE), '<scale value="4"/><rotate x="1" angle="-90"/>')
ALPHAS = (0.02, 0.05, 0.1, 0.2, 0.35, 0.5)
METALS = ("Au", "Al", "none")


def on_floor(material, **more):
    return FLOOR + sphere(material, **more)


def _metals(scenes):
    scenes["conductor-none"] = Scene(sphere(bsdf("conductor")))
    scenes["conductor-gold"] = Scene(on_floor(bsdf("conductor", material="Au")))
    for d in ("ggx", "beckmann"):
        for i, alpha in enumerate(ALPHAS):
            material = bsdf("roughconductor", material=METALS[i % 3], distribution=d, alpha=alpha)
            scenes[f"roughconductor-{d}-{alpha}"] = Scene(on_floor(material))
        scenes[f"roughconductor-{d}-anisotropic"] = Scene(on_floor(
            bsdf("roughconductor", material="Al", distribution=d, alpha_u=0.05, alpha_v=0.3)))
    scenes["roughconductor-constant"] = Scene(
        sphere(bsdf("roughconductor", material="Cu", distribution="ggx", alpha=0.5)), "constant")
    scenes["roughconductor-textured"] = Scene(on_floor(
        bsdf("roughconductor", bitmap("alpha", "waves.png", raw=True), material="Al",
             specular_reflectance=(0.9, 0.7, 0.5))), "turned")


def _glass(scenes):
    scenes["dielectric"] = Scene(on_floor(bsdf("dielectric")))
    # The floor gives it noise, which a z-test needs; few scatterings, since light that goes round in
    # a diamond has few paths of much weight.
    scenes["dielectric-constant"] = Scene(
        on_floor(bsdf("dielectric", int_ior="diamond")), "constant", depth=5)
    scenes["dielectric-tinted"] = Scene(on_floor(
        bsdf("dielectric", int_ior=1.33, specular_reflectance=(1, 0.5, 0.2),
             specular_transmittance=(0.6, 0.9, 1))), "turned")
    for d in ("ggx", "beckmann"):
        for alpha in ALPHAS:
            scenes[f"roughdielectric-{d}-{alpha}"] = Scene(
                on_floor(bsdf("roughdielectric", distribution=d, alpha=alpha)))
    scenes["roughdielectric-dense-outside"] = Scene(on_floor(
        bsdf("roughdielectric", distribution="ggx", alpha=0.2, int_ior=1.0, ext_ior=1.4)))
    scenes["thindielectric"] = Scene(on_floor(bsdf("thindielectric")))
    inner = sphere(bsdf("dielectric", int_ior=1.8, ext_ior=1.4), scale=0.5)
    scenes["glass-in-glass"] = Scene(
        FLOOR + sphere(bsdf("dielectric", int_ior=1.4, ext_ior=1.0)) + inner)
    scenes["lamp-in-glass"] = Scene(
        on_floor(bsdf("dielectric", int_ior=1.5, ext_ior=1.0))
        + sphere(BLACK, scale=0.3, more=lamp(3, 2, 1)), "dark")
    scenes["lamp-in-glass-in-glass"] = Scene(
        FLOOR + sphere(bsdf("dielectric", int_ior=1.4, ext_ior=1.0))
        + sphere(bsdf("dielectric", int_ior=1.8, ext_ior=1.4), scale=0.6)
        + sphere(BLACK, scale=0.3, more=lamp(3, 2, 1)), "dark")


def _plastics(scenes):
    colour = {"diffuse_reflectance": (0.1, 0.4, 0.8)}
    scenes["plastic"] = Scene(on_floor(bsdf("plastic", **colour)))
    scenes["plastic-nonlinear"] = Scene(on_floor(
        bsdf("plastic", bitmap("diffuse_reflectance", "colours.png"), nonlinear=True,
             int_ior=1.9)), "turned")
    for d, nonlinear in (("ggx", False), ("beckmann", True)):
        for alpha in (0.02, 0.1, 0.2, 0.5):
            scenes[f"roughplastic-{d}-{alpha}"] = Scene(on_floor(
                bsdf("roughplastic", distribution=d, alpha=alpha, nonlinear=nonlinear, **colour)))
    scenes["roughplastic-constant"] = Scene(
        sphere(bsdf("roughplastic", distribution="ggx", alpha=0.35, **colour)), "constant")


def _adapters(scenes):
    gold = bsdf("roughconductor", material="Au", distribution="ggx", alpha=0.2)
    plastic = bsdf("roughplastic", distribution="ggx", alpha=0.1)
    scenes["mask"] = Scene(on_floor(bsdf("mask", gold, opacity=0.6)))
    scenes["mask-textured"] = Scene(on_floor(
        bsdf("mask", bsdf("twosided", DIFFUSE), bitmap("opacity", "waves.png", raw=True))))
    for name, inner in (("diffuse", DIFFUSE), ("metal", gold), ("plastic", plastic)):
        scenes[f"normalmap-{name}"] = Scene(on_floor(
            bsdf("normalmap", bitmap("normalmap", "bumps.png", raw=True), inner)))
    scenes["normalmap-plain"] = Scene(on_floor(
        bsdf("normalmap", bitmap("normalmap", "bumps.png", raw=True), gold,
             flip_invalid_normals=False, use_shadowing_function=False)))
    tilted = '<scale value="1.2"/><rotate x="1" angle="-20"/><rotate y="1" angle="{}"/>' \
             '<translate x="{}" y="1.2" z="-0.4"/>'
    for name, inner in (("metal", gold), ("plastic", plastic)):
        scenes[f"twosided-{name}"] = Scene(
            FLOOR + rectangle(bsdf("twosided", inner), tilted.format(150, 0)))
    scenes["onesided"] = Scene(FLOOR + rectangle(plastic, tilted.format(30, -0.8))
                               + rectangle(gold, tilted.format(165, 1.2)))


def _smooth(scenes):
    for name, material in (
            ("metal", bsdf("roughconductor", material="Au", distribution="ggx", alpha=0.1)),
            ("glass", bsdf("dielectric")), ("plastic", bsdf("plastic"))):
        scenes[f"smooth-{name}"] = Scene(on_floor(material, mesh="smooth_sphere.ply"))


def _mirrors(scenes):
    silver = bsdf("twosided", bsdf("conductor", material="Ag"))
    walls = "".join(rectangle(silver, f'<scale value="1.5"/><rotate y="1" angle="{angle}"/>'
                              f'<translate x="{x}" y="1" z="0"/>')
                    for angle, x in ((84, -1.2), (-84, 1.2)))
    ball = sphere(DIFFUSE, scale=0.5, place=(0, 0.6, 0))
    light = sphere(BLACK, scale=0.3, place=(0.2, 2.2, 0.4), more=lamp(6, 6, 5))
    scenes["mirrors"] = Scene(FLOOR + walls + ball, "constant")
    scenes["mirrors-lamp"] = Scene(FLOOR + walls + ball + light, "dark")


def _depths(scenes):
    for name in ("roughdielectric-ggx-0.2", "mirrors-lamp", "plastic", "normalmap-metal"):
        for depth in (1, 3):
            scenes[f"{name}-{depth}-scattering{'s' if depth > 1 else ''}"] = \
                scenes[name]._replace(depth=depth)


def _scenes():
    found = {}
    for part in (_metals, _glass, _plastics, _adapters, _smooth, _mirrors, _depths):
        part(found)
    return found


SCENES = _scenes()


def write_scene(name, folder):
    """Writes one of SCENES and the files that it names into a folder; the path of its XML file."""
    scene = SCENES[name]
    text = ROOM.format(sky=SKIES[scene.sky], objects=scene.objects)
    for file, make in witness_files.FILES.items():
        if f'"{file}"' in text and not (folder / file).exists():
            (folder / file).write_bytes(make())
    path = folder / f"{name}.xml"
    path.write_text(text, encoding="ascii")
    return path


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in SCENES:
        sys.exit(f"witness_scenes.py: expected one of {', '.join(SCENES)}, and a folder")
    print(write_scene(sys.argv[1], pathlib.Path(sys.argv[2])))
