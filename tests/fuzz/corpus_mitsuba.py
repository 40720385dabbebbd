# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Seeds of the target mitsuba, which reads XML."""


def scene(body, version="3.0.0"):
    return f'<?xml version="1.0"?>\n<scene version="{version}">\n{body}\n</scene>\n'


SENSOR = """<sensor type="perspective" id="eye">
 <float name="fov" value="45"/> <string name="fov_axis" value="smaller"/>
 <transform name="to_world"><lookat origin="0, 1, 6" target="0 1 0" up="0 1 0"/></transform>
 <film type="hdrfilm"><integer name="width" value="64"/><integer name="height" value="48"/>
  <rfilter type="box"/></film>
 <sampler type="independent"><integer name="sample_count" value="4"/></sampler>
</sensor>"""

SHAPES = """<bsdf type="twosided" id="grey"><bsdf type="diffuse">
 <rgb name="reflectance" value="0.5, 0.4 0.3"/></bsdf></bsdf>
<bsdf type="diffuse" id="hex"><rgb name="reflectance" value="0.25 0.75 1"/></bsdf>
<shape type="rectangle"><ref id="grey"/>
 <transform name="to_world"><rotate x="1" angle="-90"/><scale value="4"/>
  <translate y="-1"/></transform></shape>
<shape type="cube" id="box"><ref id="hex"/><boolean name="flip_normals" value="true"/>
 <transform name="to_world"><scale x="0.5" y="-1" z="0.5"/>
  <matrix value="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"/></transform></shape>
<shape type="sphere"><point name="center" x="1" y="0" z="0"/><float name="radius" value="0.5"/>
 <emitter type="area"><rgb name="radiance" value="10"/></emitter></shape>
<shape type="disk"><emitter type="area"><spectrum name="radiance" value="3"/></emitter></shape>
<shape type="ply"><string name="filename" value="triangle.ply"/>
 <boolean name="face_normals" value="true"/><ref id="grey"/></shape>
<shape type="obj"><string name="filename" value="square.obj"/></shape>
<shape type="cylinder"/>"""

LIGHTS = """<emitter type="point"><point name="position" x="0" y="3" z="0"/>
 <rgb name="intensity" value="10 9 8"/></emitter>
<emitter type="spot"><float name="cutoff_angle" value="30"/><float name="beam_width" value="20"/>
 <transform name="to_world"><translate value="0 3 0"/></transform>
 <spectrum name="intensity" value="400:1, 500:2 600:3"/></emitter>
<emitter type="directional"><vector name="direction" value="0 -1 0.5"/>
 <spectrum name="irradiance" type="d65"><float name="scale" value="2"/></spectrum></emitter>
<emitter type="constant"><rgb name="radiance" value="0.1 0.1 0.2"/></emitter>
<emitter type="sunsky"/>
<emitter type="constant"/>"""

TEXTURES = """<texture type="bitmap" id="wood"><string name="filename" value="pixel.tga"/>
 <string name="filter_type" value="nearest"/><string name="wrap_mode" value="mirror"/>
 <boolean name="raw" value="true"/>
 <transform name="to_uv"><scale x="2" y="3"/><rotate z="1" angle="30"/></transform></texture>
<bsdf type="diffuse" id="a"><ref name="reflectance" id="wood"/></bsdf>
<bsdf type="diffuse" id="b"><texture name="reflectance" type="checkerboard">
 <rgb name="color0" value="0.1"/><rgb name="color1" value="0.9"/></texture></bsdf>
<bsdf type="roughconductor" id="c"><string name="material" value="Cu"/>
 <rgb name="specular_reflectance" value="0.9"/></bsdf>
<bsdf type="mask" id="d"><ref id="a"/><float name="opacity" value="0.5"/></bsdf>
<bsdf type="principled" id="e"><rgb name="base_color" value="0.2 0.3 0.4"/></bsdf>
<bsdf type="dielectric" id="f"/>
""" + "\n".join(f'<shape type="rectangle"><ref id="{i}"/></shape>' for i in "abcdef") + """
<shape type="ply"><string name="filename" value="triangle.ply"/><ref id="a"/></shape>"""

SURFACES = """<bsdf type="conductor" id="a"><rgb name="eta" value="0.2 0.9 1.1"/>
 <spectrum name="k" value="3"/></bsdf>
<bsdf type="roughconductor" id="b"><string name="material" value="Au"/>
 <string name="distribution" value="ggx"/><float name="alpha_u" value="0.05"/>
 <texture name="alpha_v" type="bitmap"><string name="filename" value="pixel.tga"/></texture></bsdf>
<bsdf type="dielectric" id="c"><string name="int_ior" value="water"/>
 <float name="ext_ior" value="1.0"/><rgb name="specular_transmittance" value="0.5 1 1"/></bsdf>
<bsdf type="roughdielectric" id="d"><float name="alpha" value="0.3"/>
 <string name="distribution" value="beckmann"/></bsdf>
<bsdf type="thindielectric" id="e"><float name="int_ior" value="1.7"/></bsdf>
<bsdf type="plastic" id="f"><rgb name="diffuse_reflectance" value="0.1 0.2 0.3"/>
 <boolean name="nonlinear" value="true"/></bsdf>
<bsdf type="roughplastic" id="g"><texture name="diffuse_reflectance" type="checkerboard">
 <transform name="to_uv"><scale value="4"/></transform></texture>
 <float name="alpha" value="0.2"/></bsdf>
<bsdf type="mask" id="h"><texture name="opacity" type="bitmap">
 <string name="filename" value="pixel.tga"/></texture><ref id="g"/></bsdf>
<bsdf type="twosided" id="i"><bsdf type="normalmap"><texture name="normalmap" type="bitmap">
 <boolean name="raw" value="true"/><string name="filename" value="pixel.tga"/></texture>
 <boolean name="flip_invalid_normals" value="false"/><ref id="b"/></bsdf></bsdf>
<bsdf type="principled" id="j"><rgb name="base_color" value="0.2 0.3 0.4"/>
 <float name="metallic" value="0.5"/><float name="anisotropic" value="0.5"/>
 <float name="spec_trans" value="0.5"/><float name="spec_tint" value="0.5"/>
 <float name="clearcoat" value="0.5"/><float name="eta" value="1.4"/></bsdf>
""" + "\n".join(f'<shape type="rectangle"><ref id="{i}"/></shape>' for i in "abcdefghij") + """
<shape type="ply"><string name="filename" value="triangle.ply"/><ref id="h"/></shape>"""

ENVMAP = """<emitter type="envmap"><string name="filename" value="pair.hdr"/>
 <float name="scale" value="2"/><boolean name="mis_compensation" value="true"/>
 <transform name="to_world"><rotate x="1" angle="90"/><scale x="-1"/></transform></emitter>
<shape type="sphere"/>"""

MEDIA = """<medium type="homogeneous" id="fog"><rgb name="sigma_t" value="1 2 3"/>
 <rgb name="albedo" value="0.9"/><float name="scale" value="2"/>
 <phase type="hg"><float name="g" value="0.5"/></phase></medium>
<medium type="heterogeneous" id="smoke"><volume name="sigma_t" type="gridvolume">
  <string name="filename" value="smoke.vol"/>
  <transform name="to_world"><scale value="2"/></transform></volume>
 <volume name="albedo" type="constvolume"><rgb name="value" value="0.5"/></volume>
 <phase type="isotropic"/></medium>
<medium type="homogeneous" id="ink"><rgb name="sigma_a" value="1"/>
 <rgb name="sigma_s" value="2"/></medium>
<shape type="cube"><bsdf type="null"/><ref name="interior" id="fog"/>
 <ref name="exterior" id="ink"/></shape>
<shape type="sphere"><bsdf type="null"/><ref name="interior" id="smoke"/></shape>
<sensor type="thinlens"><float name="aperture_radius" value="0.1"/>
 <float name="focus_distance" value="3"/><string name="focal_length" value="35mm"/>
 <ref id="fog"/></sensor>"""

PARAMETERS = """<!-- names -->
<default name="spp" value="16"/><default name="folder" value="triangle"/>
<default name="file" value="$folder.ply"/>
<integrator type="path"><integer name="max_depth" value="$spp"/></integrator>
<include filename="part.xml"/><path value="."/>
<shape type="ply" id="one"><string name="filename" value="$file"/></shape>
<bsdf type="diffuse" id="x"/><alias id="x" as="y"/>
<shape type="disk"><ref id="y"/></shape>
<unknown a="1"/><![CDATA[text]]> &lt;&amp;&#65;"""


def files():
    return {
        "shapes.xml": scene(SENSOR + SHAPES),
        "lights.xml": scene(SENSOR + LIGHTS, "2.1.0"),
        "envmap.xml": scene(SENSOR + ENVMAP),
        "textures.xml": scene(TEXTURES),
        "surfaces.xml": scene(SURFACES),
        "media.xml": scene(MEDIA),
        "parameters.xml": scene(PARAMETERS),
        "empty.xml": scene(""),
        "badhex.xml": scene('<shape type="cube"><bsdf type="diffuse">'
                            '<rgb name="reflectance" value="#40c0ff"/></bsdf></shape>'),
        "badenvmap.xml": scene('<emitter type="envmap"><string name="filename" '
                               'value="pixel.tga"/></emitter>'),
        "badself.xml": scene('<include filename="scene.xml"/>'),
        "badcycle.xml": scene('<bsdf type="twosided" id="a"><ref id="a"/></bsdf>'
                              '<shape type="cube"><ref id="a"/></shape>'),
        "badior.xml": scene('<shape type="cube"><bsdf type="dielectric">'
                            '<float name="int_ior" value="-1"/></bsdf></shape>'),
        "badpath.xml": scene('<path value="nowhere"/>'),
        "badversion.xml": scene("", "0.6.0"),
        "badreference.xml": scene('<shape type="cube"><ref id="nothing"/></shape>'),
    }
