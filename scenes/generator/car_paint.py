# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""car-paint.gltf: the front of a racing car in a studio: clear coat over metal flakes, lamps of
glass and chromium, brushed aluminium, rubber and leather."""

import math

from . import car_paint_parts as parts
from . import surfaces
from .builder import Builder
from .forms import rod, turn
from .solids import cross, finish, unit

FRONT, REAR, REACH = 0.66, -1.2, 0.6  # axles at x, wheels at z
LAMP_AT = (0.86, 0.79, 0.335)

RADIANCE = {  # W/(m^2 sr), linear Rec.709
    "key": (9.5, 9.3, 8.8),
    "strip": (6.2, 6.7, 7.4),
    "warm": (8.0, 5.8, 3.6),
    "filament": (26.0, 18.0, 9.0),
}

ALBEDO = {
    "back of intake": (0.012, 0.012, 0.012),
    "leather": (0.17, 0.085, 0.04),
}


def _surfaces(scene):
    surfaces.lacquer(scene, "paint", (0.5, 0.012, 0.018), 0.36)
    surfaces.metal(scene, "chromium", surfaces.CHROMIUM, 0.03)
    surfaces.metal(scene, "reflector", surfaces.ALUMINIUM, 0.02)
    surfaces.metal(scene, "steel", surfaces.STEEL, 0.3)
    surfaces.metal(scene, "turned aluminium", surfaces.ALUMINIUM, 0.25, brushed=0.75)
    surfaces.metal(scene, "brushed aluminium", surfaces.ALUMINIUM, 0.28, brushed=0.8)
    surfaces.glossy(scene, "rubber", (0.022, 0.022, 0.023), 0.6)
    surfaces.glossy(scene, "number", (0.78, 0.77, 0.73), 0.25)
    surfaces.glossy(scene, "floor", (0.2, 0.205, 0.215), 0.2)
    surfaces.glass(scene, "lens", 1.5, absorption=((0.9, 0.95, 0.94), 0.02))
    surfaces.pane(scene, "pane", (0.92, 0.96, 0.95))


def _round(position, normal):
    """The tangent of things turned about y: across the grooves that turning leaves."""
    x, _, z = position
    r = math.sqrt(x * x + z * z)
    if r < 1e-5:
        return (1.0, 0.0, 0.0, 1.0)
    across = cross((-z / r, 0.0, x / r), normal)
    size = math.sqrt(sum(c * c for c in across))
    return (*unit(across), 1.0) if size > 1e-3 else (-z / r, 0.0, x / r, 1.0)


def _upright(_, normal):
    """The tangent of bars that are brushed along y."""
    return (0.0, 0.0, 1.0, 1.0) if abs(normal[2]) < 0.9 else (1.0, 0.0, 0.0, 1.0)


def _body(scene):
    scene.solid("body", "paint", parts.body(), crease_degrees=45.0)
    intake = parts.intake()
    scene.solid("intake", "back of intake", intake["back"])
    for name in ("bars", "cross"):
        mesh = scene.mesh(name, "brushed aluminium", finish(intake[name], 50.0, tangent=_upright))
        scene.place(name, mesh)
    scene.solid("intake ring", "chromium", parts.intake_ring(), crease_degrees=60.0)
    scene.solid("strap", "leather", parts.bonnet_strap(0.42, 0.331, 0.27, 0.516),
                crease_degrees=40.0)
    for side, name in ((1.0, "right"), (-1.0, "left")):
        scene.solid(f"louvres {name}", "paint", parts.louvres(
            -0.02, 11, lambda x: 0.372 - 0.1 * max(0.0, x) ** 1.5, 0.53, side), crease_degrees=50.0)
    screen = parts.windscreen()
    at, tilt = (-0.28, 0.8, 0.0), turn(z=24.0)
    scene.place("windscreen", scene.mesh("windscreen", "pane", finish(screen["pane"], 20.0)), at,
                tilt)
    scene.place("windscreen frame", scene.mesh("windscreen frame", "chromium",
                                               finish(screen["frame"], 50.0)), at, tilt)
    scene.solid("filler cap", "chromium", parts.filler_cap(), (0.72, 0.742, 0.0),
                crease_degrees=40.0)
    scene.solid("exhaust", "steel", parts.exhaust(), crease_degrees=50.0)


def _wheels(scene):
    rim = parts.rim()
    meshes = [scene.mesh("tyre", "rubber", finish(parts.tyre(), 35.0)),
              scene.mesh("rim", "turned aluminium", finish(rim["ring"], 40.0, tangent=_round)),
              scene.mesh("spokes", "chromium", finish(rim["spokes"], 60.0)),
              scene.mesh("hub", "turned aluminium", finish(rim["hub"], 40.0, tangent=_round)),
              scene.mesh("knock-off", "chromium", finish(parts.knock_off(), 40.0))]
    for x, name in ((FRONT, "front"), (REAR, "rear")):
        for side in (1.0, -1.0):
            turned = turn(y=37.0, x=90.0 * side)
            for mesh in meshes:
                scene.place(f"{name} wheel", mesh, (x, parts.WHEEL_R, side * REACH), turned)
    wing = scene.mesh("wing", "paint", finish(parts.wing(), 60.0))
    for side in (1.0, -1.0):
        scene.place("wing", wing, (FRONT, parts.WHEEL_R, side * REACH))
        z = side * (REACH - 0.02)
        scene.solid("stays", "chromium", [
            *parts.stay((FRONT - 0.16, parts.WHEEL_R + 0.33, z),
                        (FRONT - 0.18, 0.6, side * 0.27)),
            *parts.stay((FRONT + 0.16, parts.WHEEL_R + 0.35, z),
                        (FRONT + 0.14, 0.6, side * 0.24))], crease_degrees=50.0)
    scene.solid("axle", "steel", parts.front_axle(REACH - 0.02, (FRONT, parts.WHEEL_R)),
                crease_degrees=50.0)
    scene.solid("rear axle", "steel", [rod((REAR, parts.WHEEL_R, -REACH), (REAR, parts.WHEEL_R,
                                                                          REACH), 0.04, 16)])


def _lamps(scene):
    lamp = parts.lamp()
    materials = {"shell": "chromium", "bezel": "chromium", "lens": "lens", "bulb": "filament",
                 "socket": "turned aluminium"}
    meshes = {part: scene.mesh(f"lamp {part}", materials[part],
                               finish(lamp[part], 40.0,
                                      tangent=_round if part == "socket" else None))
              for part in lamp}
    x, y, z = LAMP_AT
    for side in (1.0, -1.0):
        for part, mesh in meshes.items():
            scene.place(f"lamp {part}", mesh, (x, y, side * z), turn(z=-93.0))
        scene.solid("lamp post", "chromium", [
            *parts.stay((x - 0.07, y - 0.085, side * z), (x - 0.1, 0.58, side * 0.2))],
            crease_degrees=50.0)
    scene.solid("lamp bar", "chromium", [rod((x - 0.07, y - 0.06, -z), (x - 0.07, y - 0.06, z),
                                             0.01, 14)], crease_degrees=50.0)


def _studio(scene):
    scene.solid("studio", "floor", parts.studio(), crease_degrees=60.0)

    def sheet(name, material, centre, u, v):
        corners = [tuple(c + a * p + b * q for c, p, q in zip(centre, u, v))
                   for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        scene.light(name, material, corners)
    sheet("key", "key", (0.5, 2.7, 0.1), (1.7, 0.0, 0.0), (0.0, 0.0, 0.75))
    sheet("strip", "strip", (-0.6, 1.25, 3.1), (0.0, 0.75, 0.0), (1.5, 0.0, 0.4))
    sheet("warm", "warm", (3.6, 1.2, -1.9), (0.0, 0.85, 0.0), (-0.45, 0.0, -0.75))


def build():
    """The files of the scene: {name: bytes}."""
    scene = Builder("Car paint", ALBEDO, RADIANCE)
    _surfaces(scene)
    _body(scene)
    _wheels(scene)
    _lamps(scene)
    _studio(scene)
    scene.document.add_camera("camera", (2.55, 1.02, 1.85), (0.62, 0.5, 0.14), math.radians(30.0))
    text, binary = scene.document.finish("car-paint.bin")
    return {"car-paint.gltf": text.encode("ascii"), "car-paint.bin": binary}
