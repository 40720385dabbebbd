# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""gallery.gltf: a vaulted hall with columns, stairs, sculptures and many kinds of light."""

import math

from . import gallery_parts as parts
from . import gallery_plan as plan
from .builder import Builder, light_quad
from .texture_images import inscription, tiles
from .solids import box, finish, sphere, unit

REPEAT, CLAMP = 10497, 33071
TILE_PAIR = 1.6  # metres that one repeat of the tile image covers
MOSAIC = ((-1.8, -0.02, 3.2), (1.8, 0.03, 5.6))
WINDOWS = ((-2.55, -1.65, 2.9, 6.5), (1.65, 2.55, 2.9, 6.5))
KNOT, STONE, VASE = (0.0, 3.18, -9.7), (-2.25, 1.52, 0.4), (2.3, 0.9, -2.6)
LAMP = (5.5, 2.75, -5.6)

RADIANCE = {  # W/(m^2 sr), linear Rec.709
    "skylight": (11.0, 9.8, 7.8),
    "window": (2.6, 4.0, 6.6),
    "strip": (46.0, 40.0, 30.0),
    "lamp": (90.0, 44.0, 13.0),
}

ALBEDO = {
    "limestone": (0.66, 0.59, 0.48),
    "sandstone": (0.56, 0.38, 0.25),
    "plaster": (0.74, 0.71, 0.66),
    "terracotta wall": (0.62, 0.17, 0.09),
    "teal wall": (0.08, 0.34, 0.36),
    "dark stone": (0.2, 0.2, 0.21),
    "bronze green": (0.22, 0.44, 0.34),
    "white marble": (0.82, 0.81, 0.78),
    "ochre glaze": (0.72, 0.42, 0.1),
    "iron": (0.07, 0.07, 0.075),
}


def _stone_colour(position, _):
    """Vertex colour between deep blue and sand, by the height of the relief."""
    t = 0.5 + 0.5 * parts.wave_height(unit(position))
    low, high = (0.08, 0.16, 0.5), (0.92, 0.74, 0.42)
    return tuple(a + (b - a) * t for a, b in zip(low, high))


def _floor_uv(position, _):
    return position[0] / TILE_PAIR, position[2] / TILE_PAIR


def _mosaic_uv(position, _):
    """The image's top edge (v = 0) lies away from the camera, its left edge at -x."""
    (x0, _, z0), (x1, _, z1) = MOSAIC
    return (position[0] - x0) / (x1 - x0), (position[2] - z0) / (z1 - z0)


def _textures(gallery):
    document = gallery.document
    for name, uri, wrap in (("tiles", "gallery-tiles.png", REPEAT),
                            ("mosaic", "gallery-mosaic.png", CLAMP)):
        texture = document.add_texture(name, uri, wrap)
        gallery.materials[name] = document.add_material(name, (1.0, 1.0, 1.0), texture)
    gallery.materials["painted stone"] = document.add_material("painted stone", (1.0, 1.0, 1.0))


def _hall(gallery):
    end, aisle = plan.HALF_LENGTH, plan.AISLE_X
    gallery.solid("floor", "tiles", [box((-7.6, -0.5, -end - 0.6), (7.6, 0.0, end + 0.6))],
                  uv=_floor_uv)
    gallery.solid("mosaic", "mosaic", [box(*MOSAIC)], uv=_mosaic_uv)
    gallery.solid("far wall", "plaster", parts.end_wall(-end, WINDOWS))
    gallery.solid("near wall", "plaster", parts.end_wall(end, ()))
    for side, name, colour in ((-1, "left", "terracotta wall"), (1, "right", "teal wall")):
        inner, outer = sorted((side * aisle, side * (aisle + 0.45)))
        gallery.solid(f"{name} wall", colour, [box((inner, -0.3, -end - 0.4),
                                                   (outer, 6.45, end + 0.4))])
        inner, outer = sorted((side * (plan.ARCADE_OUT - 0.2), side * (aisle + 0.3)))
        gallery.solid(f"{name} aisle ceiling", "plaster", [
            box((inner, plan.AISLE_Y, -end - 0.35), (outer, plan.AISLE_Y + 0.35, end + 0.35))])
        gallery.solid(f"{name} arcade", "limestone", parts.arcade(side))
        gallery.solid(f"{name} cornice", "limestone", parts.cornice(side))
    gallery.solid("vault", "plaster", parts.vault())


def _columns(gallery):
    column = gallery.mesh("column", "limestone", finish(parts.column()))
    for side, name in ((-1, "left"), (1, "right")):
        for k in range(plan.BAYS + 1):
            z = plan.HALF_LENGTH - k * plan.BAY
            gallery.place(f"{name} column {k + 1}", column, (side * plan.COLUMN_X, 0.0, z))


def _podium(gallery):
    gallery.solid("podium", "sandstone", parts.podium())
    gallery.solid("rails", "dark stone", parts.rails())
    post = gallery.mesh("baluster", "white marble", finish(parts.baluster()))
    count, gap = 18, 0.26
    for side in (-1, 1):
        for k in range(count):
            z = plan.RAIL_Z - gap * (k + 1)
            gallery.place("baluster", post, (side * plan.RAIL_X, plan.PODIUM_Y, z))
        first, last = plan.STAIR_HALF + 0.16, plan.RAIL_X
        for k in range(1, 5):
            x = first + (last - first) * k / 5
            gallery.place("baluster", post, (side * x, plan.PODIUM_Y, plan.RAIL_Z))


def _sculptures(gallery):
    gallery.solid("knot", "bronze green", parts.knot(), KNOT, crease_degrees=60.0)
    gallery.solid("knot pedestal", "dark stone", parts.pedestal(0.8, 0.95),
                  (KNOT[0], plan.PODIUM_Y, KNOT[2]))
    gallery.solid("stone", "painted stone", parts.stone(), STONE, crease_degrees=60.0,
                  colour=_stone_colour)
    gallery.solid("stone pedestal", "white marble", parts.pedestal(0.7, 0.95),
                  (STONE[0], 0.0, STONE[2]))
    gallery.solid("vase", "ochre glaze", parts.vase(), (VASE[0], VASE[1] - 0.01, VASE[2]))
    gallery.solid("vase pedestal", "white marble", parts.pedestal(0.6, VASE[1]),
                  (VASE[0], 0.0, VASE[2]))
    bench = gallery.mesh("bench", "dark stone", finish(parts.bench()))
    turn = math.radians(8.0) / 2.0
    for k, (x, z) in enumerate(((2.5, 2.2), (-2.5, -3.4), (5.9, 2.0), (-5.9, 2.0))):
        gallery.place(f"bench {k + 1}", bench, (x, 0.0, z),
                      (0.0, math.sin(turn), 0.0, math.cos(turn)) if k == 0 else None)


def _lights(gallery):
    y, half, end = plan.VAULT_Y + plan.VAULT_R + 0.24, 0.86, plan.SLOT + 0.05
    gallery.light("skylight", "skylight", [(-half, y, -end), (half, y, -end), (half, y, end),
                                           (-half, y, end)])
    z, lap = -plan.HALF_LENGTH - 0.3, 0.03
    for k, (x0, x1, y0, y1) in enumerate(WINDOWS):
        pane = light_quad([(x0 - lap, y0 - lap, z), (x1 + lap, y0 - lap, z),
                           (x1 + lap, y1 + lap, z), (x0 - lap, y1 + lap, z)])
        gallery.place(f"window {k + 1}", gallery.mesh("pane", "window", pane))
    at, length = (-plan.AISLE_X + 0.45, 4.9, 0.0), 5.0
    gallery.solid("trough", "iron", parts.trough(length), at)
    gallery.light("strip", "strip", [(-0.1, -0.02, length - 0.01), (0.1, -0.02, length - 0.01),
                                     (0.1, -0.02, 0.01 - length), (-0.1, -0.02, 0.01 - length)],
                  at)
    gallery.solid("lamp", "lamp", [sphere(3, lambda d: 0.17)], LAMP, crease_degrees=60.0)
    gallery.solid("lamp cord", "iron", parts.lamp_cord(plan.AISLE_Y - LAMP[1] + 0.05), LAMP)
    gallery.document.add_spot("spot", (2.9, 6.0, -7.0), KNOT, (1.0, 0.9, 0.76), 70.0,
                              math.radians(9.0), math.radians(15.0))


def build():
    """The files of the scene: {name: bytes}."""
    gallery = Builder("Gallery", ALBEDO, RADIANCE)
    _textures(gallery)
    _hall(gallery)
    _columns(gallery)
    _podium(gallery)
    _sculptures(gallery)
    _lights(gallery)
    gallery.document.add_camera("nave", (-0.8, 1.85, 10.7), (0.15, 2.5, -9.0),
                                math.radians(50.0))
    gallery.document.add_camera("detail", (-2.35, 1.95, 4.7), (0.55, 1.35, -5.0),
                                math.radians(48.0))
    text, binary = gallery.document.finish("gallery.bin")
    return {"gallery.gltf": text.encode("ascii"), "gallery.bin": binary,
            "gallery-tiles.png": tiles(), "gallery-mosaic.png": inscription()}
