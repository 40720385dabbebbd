# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""figure.gltf: a wooden figure that sways, breathes and waves: a skin and a morph target."""

import math

from . import furniture, gallery_parts
from .builder import Builder
from .solids import box, finish, moved, revolve, sphere, sub

X0, X1, HEIGHT, Z0, Z1, THICK = -1.9, 1.9, 2.6, -1.5, 2.9, 0.3
WINDOW = (-0.9, 0.9, 0.9, 2.2)  # of the left wall: z, y
LAMP = (1.25, 1.75, 0.85)
PLINTH = 0.24

RADIANCE = {  # W/(m^2 sr), linear Rec.709
    "window": (4.2, 5.2, 6.6),
    "lamp": (80.0, 50.0, 24.0),
}

ALBEDO = {
    "plaster": (0.62, 0.6, 0.56),
    "back wall": (0.5, 0.38, 0.24),
    "right wall": (0.16, 0.34, 0.33),
    "floor": (0.36, 0.25, 0.16),
    "stone": (0.5, 0.48, 0.45),
    "iron": (0.06, 0.06, 0.065),
    "blue glaze": (0.1, 0.2, 0.45),
    "robe": (0.5, 0.13, 0.08),
    "wood": (0.62, 0.42, 0.24),
    "ink": (0.03, 0.03, 0.035),
}

# Where the joints are in the space of the figure, which stands on its origin and looks along +z,
# and the joint above each.
JOINTS = {
    "hips": ((0.0, 0.06, 0.0), None),
    "spine": ((0.0, 0.36, 0.0), "hips"),
    "chest": ((0.0, 0.66, 0.0), "spine"),
    "head": ((0.0, 1.0, 0.0), "chest"),
    "left arm": ((0.13, 0.84, 0.0), "chest"),
    "left hand": ((0.39, 0.84, 0.0), "left arm"),
    "right arm": ((-0.13, 0.84, 0.0), "chest"),
    "right hand": ((-0.39, 0.84, 0.0), "right arm"),
}
NUMBER = {name: number for number, name in enumerate(JOINTS)}

PERIOD, KEYS = 2.0, 16


def _room(room):
    ys, xs = (-0.2, HEIGHT + 0.2), (X0 - 0.15, X1 + 0.15)
    zs = (Z0 - THICK + 0.05, Z1 + THICK - 0.05)
    room.solid("left wall", "plaster", furniture.wall(zs, ys, (WINDOW,), X0, X0 - THICK, "z"))
    room.solid("right wall", "right wall", furniture.wall(zs, ys, (), X1, X1 + THICK, "z"))
    room.solid("back wall", "back wall", furniture.wall(xs, ys, (), Z0, Z0 - THICK, "x"))
    room.solid("front wall", "plaster", furniture.wall(xs, ys, (), Z1, Z1 + THICK, "x"))
    lo, hi = (X0 - 0.25, -0.4, Z0 - 0.2), (X1 + 0.25, 0.0, Z1 + 0.2)
    room.solid("floor", "floor", [box(lo, hi)])
    room.solid("ceiling", "plaster", [box((lo[0], HEIGHT, lo[2]), (hi[0], HEIGHT + 0.4, hi[2]))])
    room.solid("window bars", "iron", furniture.window_bars(X0 - 0.1, WINDOW, 2, 1, 0.05))
    z0, z1, y0, y1 = WINDOW
    lap, x = 0.03, X0 - 0.2
    room.light("window", "window", [(x, y0 - lap, z0 - lap), (x, y1 + lap, z0 - lap),
                                    (x, y1 + lap, z1 + lap), (x, y0 - lap, z1 + lap)])
    room.solid("lamp", "lamp", [sphere(3, lambda d: 0.07)], LAMP, crease_degrees=60.0)
    room.solid("lamp cord", "iron", gallery_parts.lamp_cord(HEIGHT - LAMP[1] + 0.05), LAMP)
    steps = [(0.52, -0.02), (0.52, 0.11), (0.5, 0.125), (0.43, 0.125), (0.43, PLINTH - 0.015),
             (0.41, PLINTH)]
    room.solid("plinth", "stone", [revolve(steps, 56)])
    room.solid("vase", "blue glaze", gallery_parts.vase(), (-1.2, -0.01, -0.95))


def _smooth_step(first, last, value):
    t = min(max((value - first) / (last - first), 0.0), 1.0)
    return t * t * (3.0 - 2.0 * t)


def _curve(points, steps):
    """Points of a smooth curve through `points`, `steps` of them from one to the next."""
    found = []
    for k in range(len(points) - 1):
        a, b, c, d = (points[min(max(k + i, 0), len(points) - 1)] for i in (-1, 0, 1, 2))
        for s in range(steps):
            t = s / steps
            found.append(tuple(
                0.5 * (2.0 * q + (r - p) * t + (2.0 * p - 5.0 * q + 4.0 * r - u) * t * t
                       + (3.0 * q - p - 3.0 * r + u) * t * t * t)
                for p, q, r, u in zip(a, b, c, d)))
    return [*found, points[-1]]


def _robe(breath):
    """The body, a solid of revolution; `breath` from 0 to 1 widens it at the chest."""
    profile = _curve([(0.2, 0.0), (0.27, 0.015), (0.285, 0.06), (0.262, 0.2), (0.215, 0.4),
                      (0.185, 0.56), (0.19, 0.7), (0.18, 0.8), (0.12, 0.9), (0.062, 0.96),
                      (0.055, 1.04)], 2)

    def widened(r, y, _):
        rise = (y - 0.62) / 0.16
        return r * (1.0 + 0.16 * breath * math.exp(-rise * rise))

    return [revolve(profile, 32, widened)]


def _arm(side):
    """An arm that is stretched out to the side, +1 or -1; its end is round."""
    profile = _curve([(0.03, 0.0), (0.058, 0.02), (0.05, 0.14), (0.043, 0.26), (0.042, 0.3),
                      (0.034, 0.42), (0.034, 0.46), (0.06, 0.52), (0.05, 0.575), (0.02, 0.595)], 2)
    positions, triangles = revolve(profile, 12)
    shoulder = JOINTS["left arm"][0]
    return [(side * (shoulder[0] - 0.04 + y), shoulder[1] + x, z)
            for x, y, z in positions], triangles


def _head():
    middle = (0.0, 1.165, 0.0)
    return [moved(sphere(3, lambda d: 0.15 * (1.0 + 0.12 * d[1] * d[1])), middle),
            moved(sphere(2, lambda d: 0.026), (0.0, 1.15, 0.158))]


def _eyes():
    return [moved(sphere(1, lambda d: 0.019), (x, 1.2, 0.139)) for x in (-0.055, 0.055)]


def _between(first, second, share):
    return [(NUMBER[first], 1.0 - share), (NUMBER[second], share)]


def _robe_joints(position):
    y = position[1]
    if y < 0.36:
        return _between("hips", "spine", _smooth_step(0.06, 0.5, y))
    if y < 0.66:
        low = _smooth_step(0.06, 0.5, y)
        high = _smooth_step(0.4, 0.8, y)
        return [(NUMBER["hips"], (1.0 - low) * (1.0 - high)),
                (NUMBER["spine"], low * (1.0 - high)), (NUMBER["chest"], high)]
    if y < 0.9:
        return _between("spine", "chest", _smooth_step(0.4, 0.8, y))
    return _between("chest", "head", _smooth_step(0.92, 1.06, y))


def _arm_joints(name):
    elbow = abs(JOINTS[name + " hand"][0][0])
    return lambda position: _between(name + " arm", name + " hand",
                                     _smooth_step(elbow - 0.07, elbow + 0.07, abs(position[0])))


def _head_joints(_):
    return [(NUMBER["head"], 1.0)]


def _wood():
    """Head and arms as one mesh, and the joints of its vertices."""
    mesh = finish(_head(), crease_degrees=180.0)
    joints = [_head_joints(p) for p in mesh.positions]
    for side, name in ((1.0, "left"), (-1.0, "right")):
        arm = finish([_arm(side)], crease_degrees=180.0)
        first = len(mesh.positions)
        mesh.positions += arm.positions
        mesh.normals += arm.normals
        mesh.triangles += [tuple(first + i for i in t) for t in arm.triangles]
        joints += [_arm_joints(name)(p) for p in arm.positions]
    return mesh, joints


def _turn(x, y, z):
    """The quaternion of turns about x, then y, then z, in degrees."""
    def times(a, b):
        return (a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
                a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
                a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
                a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2])

    turned = (0.0, 0.0, 0.0, 1.0)
    for axis, degrees in enumerate((x, y, z)):
        half = 0.5 * math.radians(degrees)
        one = [0.0, 0.0, 0.0, math.cos(half)]
        one[axis] = math.sin(half)
        turned = times(one, turned)
    return tuple(round(c, 6) for c in turned)


def _pose(phase):
    """The rotations of the joints that move, at a phase of the period in [0, 1]."""
    def wave(turns, shift=0.0):
        return math.sin(2.0 * math.pi * (turns * phase + shift))

    return {
        "hips": _turn(0.0, 0.0, 3.0 * wave(1)),
        "spine": _turn(2.0 * wave(2), 5.0 * wave(1, 0.1), 6.0 * wave(1)),
        "chest": _turn(1.5 * wave(2), 6.0 * wave(1, 0.05), 5.0 * wave(1, -0.08)),
        "head": _turn(5.0 * wave(2, 0.2), 12.0 * wave(1, -0.1), -9.0 * wave(1, -0.1)),
        "left arm": _turn(0.0, -12.0, 24.0 + 6.0 * wave(2)),
        "left hand": _turn(0.0, -8.0, 44.0 + 28.0 * wave(2, 0.15)),
        "right arm": _turn(12.0 * wave(1), 0.0, 58.0 + 5.0 * wave(1, 0.2)),
        "right hand": _turn(14.0 * wave(1, -0.1), 30.0, 8.0),
    }


def _skeleton(document):
    """The nodes of the joints by name, and the skin. At rest they are as at the first key."""
    half = 0.5 * math.radians(-10.0)
    stand = document.add_node("figure", translation=[0.0, PLINTH, 0.0],
                              rotation=[0.0, round(math.sin(half), 6), 0.0,
                                        round(math.cos(half), 6)])
    nodes, rest = {}, _pose(0.0)
    for name, (place, above) in JOINTS.items():
        origin = JOINTS[above][0] if above else (0.0, 0.0, 0.0)
        nodes[name] = document.add_child(name, nodes[above] if above else stand,
                                         translation=[round(c, 6) for c in sub(place, origin)],
                                         rotation=list(rest[name]))
    skin = document.add_skin("figure", nodes.values(), [place for place, _ in JOINTS.values()])
    return nodes, skin


def _figure(room):
    document = room.document
    nodes, skin = _skeleton(document)
    robe, wide = (finish(_robe(breath), crease_degrees=180.0) for breath in (0.0, 1.0))
    if robe.triangles != wide.triangles:
        raise ValueError("the two forms of the robe have different triangles")
    cloth = document.primitive(robe, room.materials["robe"])
    document.carry(cloth, [_robe_joints(p) for p in robe.positions])
    document.morph(cloth, [sub(b, a) for a, b in zip(robe.positions, wide.positions)],
                   [sub(b, a) for a, b in zip(robe.normals, wide.normals)])
    body = document.add_node("body", mesh=document.add_mesh("body", [cloth]), skin=skin)
    wood, joints = _wood()
    limbs = document.primitive(wood, room.materials["wood"])
    document.carry(limbs, joints)
    dark = finish(_eyes(), crease_degrees=180.0)
    eyes = document.primitive(dark, room.materials["ink"])
    document.carry(eyes, [_head_joints(p) for p in dark.positions])
    document.add_node("limbs", mesh=document.add_mesh("limbs", [limbs, eyes]), skin=skin)

    times = tuple(PERIOD * k / KEYS for k in range(KEYS + 1))
    poses = [_pose(k % KEYS / KEYS) for k in range(KEYS + 1)]
    channels = [(nodes[name], "rotation", times, [pose[name] for pose in poses], "LINEAR")
                for name in poses[0]]
    # In-tangent, weight and out-tangent of each key.
    breath = [(c,) for weight in (0.0, 1.0, 0.0) for c in (0.0, weight, 0.0)]
    channels.append((body, "weights", (0.0, 0.5 * PERIOD, PERIOD), breath, "CUBICSPLINE"))
    document.add_animation("wave", channels)


def build():
    """The files of the scene: {name: bytes}."""
    room = Builder("Figure", ALBEDO, RADIANCE)
    _room(room)
    _figure(room)
    room.document.add_camera("camera", (0.3, 1.2, 2.75), (0.02, 0.92, 0.0), math.radians(42.0))
    text, binary = room.document.finish("figure.bin")
    return {"figure.gltf": text.encode("ascii"), "figure.bin": binary}
