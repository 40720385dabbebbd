# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""cornell-box.gltf: the measured box, in metres, facing its camera as published.
cornell-box-fog.gltf: the same box filled with fog."""

import math

from . import cornell_data as data
from .colour import emission, piecewise_linear, reflectance
from .gltf import Document
from .solids import Mesh, cross, dot, ear_clip, sub

ROOM_CENTRE = (0.278, 0.2744, 0.2796)
# Per metre. The box is 0.559 m deep: an extinction of 1.8 / m is an optical depth of 1.
FOG_SCATTERING, FOG_ABSORPTION, FOG_ANISOTROPY = (1.7,) * 3, (0.1,) * 3, 0.3
FOG_LAP = 0.001  # by which fog reaches into the walls, so that its boundary is not on them


def _metres(corners):
    return [tuple(round(c / 1000.0, 6) for c in corner) for corner in corners]


def _seen_from(point, corners, triangles):
    """Turns every triangle counter-clockwise as seen from `point`."""
    turned = []
    for a, b, c in triangles:
        normal = cross(sub(corners[b], corners[a]), sub(corners[c], corners[a]))
        turned.append((a, b, c) if dot(normal, sub(point, corners[a])) > 0.0 else (a, c, b))
    return Mesh(corners, turned)


def _quad(corners):
    return _seen_from(ROOM_CENTRE, _metres(corners), [(0, 1, 2), (0, 2, 3)])


def _floor():
    """The floor stops at the blocks' feet, as published: no two faces lie in one plane."""
    feet = [(x, 0.0, z) for x, z in (*data.SHORT_BLOCK, *data.TALL_BLOCK)]
    corners = _metres((*data.FLOOR, *feet))
    plan = [(x, -z) for x, _, z in corners]  # (x, -z) is counter-clockwise seen from above
    # Counter-clockwise round the outline, with a bridge out to each foot and back.
    ring = (1, 4, 7, 6, 5, 4, 1, 2, 3, 10, 9, 8, 11, 10, 3, 0)
    return _seen_from(ROOM_CENTRE, corners, ear_clip(plan, ring))


def _ceiling():
    """The ceiling ends where the light begins, as published."""
    corners = _metres((*data.CEILING, *data.LIGHT_CORNERS))
    triangles = []
    for i in range(4):
        j = (i + 1) % 4
        triangles += [(i, j, 4 + j), (i, 4 + j, 4 + i)]
    return _seen_from(ROOM_CENTRE, corners, triangles)


def _block(foot, height):
    """Five faces seen from outside; the open bottom stands in the floor's hole."""
    corners = _metres((x, y, z) for y in (0.0, height) for x, z in foot)
    triangles = [(4, 5, 6), (4, 6, 7)]
    for i in range(4):
        j = (i + 1) % 4
        triangles += [(i, j, 4 + j), (i, 4 + j, 4 + i)]
    centre = [math.fsum(c[k] for c in corners) / 8.0 for k in range(3)]
    inward = _seen_from(centre, corners, triangles)
    return Mesh(corners, [(a, c, b) for a, b, c in inward.triangles])


def colours():
    """The published spectra as linear Rec.709: (light radiance, white, green, red)."""
    light = piecewise_linear(400.0, 100.0, data.LIGHT)
    surfaces = (piecewise_linear(400.0, 4.0, s) for s in (data.WHITE, data.GREEN, data.RED))
    return (emission(light), *(reflectance(s, light) for s in surfaces))


def _fog():
    """The inside of the box, closed across its open front, seen from outside."""
    lap = FOG_LAP
    corners = [(x + math.copysign(lap, x - ROOM_CENTRE[0]),
                y + math.copysign(lap, y - ROOM_CENTRE[1]), z + (lap if z > 0.0 else 0.0))
               for x, y, z in _metres((*data.FLOOR, *data.CEILING))]
    corners = [tuple(round(c, 6) for c in corner) for corner in corners]
    above = (4, 7, 6, 5)  # the ceiling's corner above each of the floor's
    quads = [(0, 1, 2, 3), (4, 5, 6, 7)]
    # The left wall is not flat: its quad is split as the wall is.
    quads += [((i + 1) % 4, above[(i + 1) % 4], above[i], i) for i in range(4)]
    inward = _seen_from(ROOM_CENTRE, corners,
                        [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    return Mesh(corners, [(a, c, b) for a, b, c in inward.triangles])


def _box(name, foggy):
    """The text of the scene."""
    document = Document(name, "Geometry and spectra: Cornell University Program of "
                        "Computer Graphics. This file: The Weft Authors, CC0 1.0.")
    radiance, white, green, red = colours()
    materials = {
        "white": document.add_material("white", white, double_sided=True),
        "green": document.add_material("green", green, double_sided=True),
        "red": document.add_material("red", red, double_sided=True),
        "light": document.add_material("light", [data.LIGHT_REFLECTANCE] * 3, radiance=radiance),
    }
    parts = [
        ("floor", "white", _floor()),
        ("ceiling", "white", _ceiling()),
        ("back wall", "white", _quad(data.BACK_WALL)),
        ("left wall", "red", _quad(data.LEFT_WALL)),
        ("right wall", "green", _quad(data.RIGHT_WALL)),
        ("short block", "white", _block(data.SHORT_BLOCK, data.SHORT_HEIGHT)),
        ("tall block", "white", _block(data.TALL_BLOCK, data.TALL_HEIGHT)),
        ("light", "light", _quad(data.LIGHT_CORNERS)),
    ]
    if foggy:
        materials["fog"] = document.add_medium("fog", FOG_SCATTERING, FOG_ABSORPTION,
                                               FOG_ANISOTROPY)
        parts.append(("fog", "fog", _fog()))
    for part, material, mesh in parts:
        primitive = document.primitive(mesh, materials[material])
        document.add_node(part, mesh=document.add_mesh(part, [primitive]))
    eye = _metres([data.CAMERA_POSITION])[0]
    document.add_camera("camera", eye, (eye[0], eye[1], eye[2] + 1.0),
                        2.0 * math.atan2(0.5 * data.FILM_EDGE, data.FOCAL_LENGTH))
    return document.finish()[0].encode("ascii")


def build():
    """The files of the scenes: {name: bytes}."""
    return {"cornell-box.gltf": _box("Cornell box", False),
            "cornell-box-fog.gltf": _box("Cornell box with fog", True)}
