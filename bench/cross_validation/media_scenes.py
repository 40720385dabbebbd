# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes with participating media that benchmarks write themselves, as Mitsuba XML.

    media_scenes.py NAME FOLDER     writes one into a folder, and its path on a line

All are the same room, open to the camera: grey but for a red and a green wall, with an area light
below its ceiling. What is in it differs.
"""

import math
import pathlib
import struct
import sys

ROOM = """<scene version="3.0.0">
    <default name="max_depth" value="-1"/>
    <integrator type="{integrator}"><integer name="max_depth" value="$max_depth"/></integrator>
    <sensor type="perspective">
        <float name="fov" value="40"/>
        <transform name="to_world">
            <lookat origin="0, 1, 4.4" target="0, 1, 0" up="0, 1, 0"/>
        </transform>
        <film type="hdrfilm">
            <integer name="width" value="128"/><integer name="height" value="128"/>
            <rfilter type="box"/>
        </film>
        <sampler type="independent"/>
    </sensor>
{walls}{rest}</scene>
"""

WALL = """    <shape type="rectangle">
        <transform name="to_world">{transform}</transform>
        <bsdf type="twosided"><bsdf type="diffuse">
            <rgb name="reflectance" value="{colour}"/>
        </bsdf></bsdf>{more}
    </shape>
"""

MEDIUM = """    <medium type="{kind}" id="medium">
{coefficients}
        <float name="scale" value="{scale}"/>
        <phase type="hg"><float name="g" value="{g}"/></phase>
    </medium>
    <shape type="cube">
        <transform name="to_world">
            <translate x="1" y="1" z="1"/><scale value="0.5"/>{placement}
        </transform>
        <bsdf type="null"/>
        <ref name="interior" id="medium"/>
    </shape>
"""

GRID = """        <volume name="sigma_t" type="gridvolume">
            <string name="filename" value="{file}"/>
            <transform name="to_world">{placement}</transform>
        </volume>
        <rgb name="albedo" value="{albedo}"/>"""


def _walls():
    """Rectangles over [-1, 1]^2 that face +z, each turned and moved into its place."""
    grey, light = "0.7, 0.7, 0.7", "12, 10, 8"
    parts = (
        ('<rotate x="1" angle="-90"/>', grey, ""),
        ('<rotate x="1" angle="90"/><translate y="2"/>', grey, ""),
        ('<translate y="1" z="-1"/>', grey, ""),
        ('<rotate y="1" angle="90"/><translate x="-1" y="1"/>', "0.6, 0.1, 0.08", ""),
        ('<rotate y="1" angle="-90"/><translate x="1" y="1"/>', "0.1, 0.45, 0.12", ""),
        ('<scale x="0.4" y="0.3"/><rotate x="1" angle="90"/><translate y="1.96"/>', "0.5, 0.5, 0.5",
         f'\n        <emitter type="area"><rgb name="radiance" value="{light}"/></emitter>'),
    )
    return "".join(WALL.format(transform=t, colour=c, more=m) for t, c, m in parts)


def _vol(counts, density):
    """A Mitsuba grid volume of `density` at the centres of voxels in the unit cube."""
    centres = [[(i + 0.5) / n for i in range(n)] for n in counts]
    voxels = [density(x, y, z) for z in centres[2] for y in centres[1] for x in centres[0]]
    head = b"VOL\x03" + struct.pack("<5i6f", 1, *counts, 1, 0, 0, 0, 1, 1, 1)
    return head + struct.pack(f"<{len(voxels)}f", *voxels)


def _ball(x, y, z):
    """A ball of smoke with dents."""
    x, y, z = 2.0 * x - 1.0, 2.0 * y - 1.0, 2.0 * z - 1.0
    dents = 0.5 + 0.5 * math.sin(9.0 * x + 2.0 * z) * math.sin(8.0 * y) * math.cos(7.0 * z)
    return max(0.0, 1.0 - x * x - y * y - z * z) * dents


def _grid_medium(name, placement, albedo, scale, g):
    grid = GRID.format(file=f"{name}.vol", placement=placement, albedo=albedo)
    return MEDIUM.format(kind="heterogeneous", coefficients=grid, scale=scale, g=g,
                         placement=placement)


def _ball_files(name):
    placement = '<scale value="1.5"/><translate x="-0.75" y="0.2" z="-0.75"/>'
    medium = _grid_medium(name, placement, "0.95, 0.7, 0.35", 14, 0)
    return "volpathmis", medium, _vol((24, 24, 24), _ball)


def _slab_files(name):
    """Density grows upwards and along the slab's depth; the slab is turned about two axes."""
    placement = ('<translate x="-0.5" y="-0.5" z="-0.5"/><scale x="1.3" y="0.9" z="0.4"/>'
                 '<rotate y="1" angle="35"/><rotate x="1" angle="-20"/>'
                 '<translate y="0.9" z="0.1"/>')
    medium = _grid_medium(name, placement, "0.9, 0.9, 0.9", 8, 0.7)
    return "volpath", medium, _vol((2, 6, 5), lambda x, y, z: 0.5 * (y + z))


def _ink_files(_):
    """A homogeneous medium whose channels differ in everything, and that scatters backwards."""
    placement = '<scale value="1.2"/><translate x="-0.6" y="0.1" z="-0.6"/>'
    coefficients = ('        <rgb name="sigma_t" value="0.125, 0.375, 1"/>\n'
                    '        <rgb name="albedo" value="0.9, 0.6, 0.8"/>')
    return "volpathmis", MEDIUM.format(kind="homogeneous", coefficients=coefficients, scale=6,
                                       g=-0.4, placement=placement), None


SCENES = {"smoke-ball": _ball_files, "slab": _slab_files, "ink": _ink_files}


def write_scene(name, folder):
    """Writes one of SCENES into a folder; the path of its XML file."""
    integrator, medium, grid = SCENES[name](name)
    path = folder / f"{name}.xml"
    path.write_text(ROOM.format(integrator=integrator, walls=_walls(), rest=medium),
                    encoding="ascii")
    if grid:
        (folder / f"{name}.vol").write_bytes(grid)
    return path


if __name__ == "__main__":
    if len(sys.argv) != 3 or sys.argv[1] not in SCENES:
        sys.exit(f"media_scenes.py: expected one of {', '.join(SCENES)}, and a folder")
    print(write_scene(sys.argv[1], pathlib.Path(sys.argv[2])))
