# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Seeds of the targets ply, obj and options."""
import struct


def ply(form, vertices, faces, body, other=""):
    count, corners = vertices[0], faces[0]
    head = ["ply", f"format {form} 1.0", "comment made for tests", f"element vertex {count}"]
    head += ["property " + p for p in vertices[1:]]
    head += [f"element face {corners}"] + ["property " + p for p in faces[1:]]
    return ("\n".join(head) + "\n" + other + "end_header\n").encode() + body


XYZ = ["float x", "float y", "float z"]
INDICES = "list uchar int vertex_indices"


def ply_files():
    square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    ascii_body = "".join(f"{x} {y} {z}\n" for x, y, z in square) + "4 0 1 2 3\n3 0 2 3\n"
    rich = ["double x", "float32 y", "short z", "float nx", "float ny", "float nz", "float s",
            "float t", "uchar red", "uchar green", "uchar blue", "list uchar int8 tags"]

    def packed(order):
        rows = b""
        for x, y, z in square:
            rows += struct.pack(order + "dfh3f2f3B", x, y, z, 0, 0, 1, x, y, 255, 128, 0)
            rows += bytes([2, 1, 2])
        for face in [(0, 1, 2), (2, 3, 0)]:
            rows += struct.pack(order + "B3iB", 3, *face, 7)
        return rows + struct.pack(order + "2f", 1, 2)

    faces = [2, INDICES, "uchar material"]
    other = "element extra 1\nproperty float a\nproperty float b\n"
    colours = "".join(f"{x} {y} {z} 0.5 2 nan\n" for x, y, z in square) + "3 0 1 2\n"
    return {
        "square.ply": ply("ascii", [4] + XYZ, [2, INDICES], ascii_body.encode()),
        "little.ply": ply("binary_little_endian", [4] + rich, faces, packed("<"), other),
        "big.ply": ply("binary_big_endian", [4] + rich, faces, packed(">"), other),
        "colours.ply": ply("ascii", [4] + XYZ + ["float red", "float green", "float blue"],
                           [1, "list uint32 uint vertex_index"], colours.encode()),
        "wide.ply": ply("ascii", [3] + XYZ + ["ushort red", "ushort green", "ushort blue",
                                              "float texture_u", "float texture_v"],
                        [3, INDICES], b"0 0 0 65535 0 1 0 0\n1e3 0 0 1 2 3 1 0\n"
                        b"inf 1 0 1 2 3 0 1\n3 0 1 2\n2 0 1\n5 0 1 2 1 0\nleft over\n"),
        "badempty.ply": ply("ascii", [0] + XYZ, [0, INDICES], b""),
        "badcount.ply": ply("binary_little_endian", [4294967295] + XYZ, [1, INDICES], b"\0" * 9),
        "badindex.ply": ply("ascii", [3] + XYZ, [1, INDICES], b"0 0 0 1 0 0 0 1 0\n3 0 1 3\n"),
        "badlist.ply": ply("binary_little_endian", [1] + XYZ,
                           [1, "list int int vertex_indices"], bytes(12) + b"\xff\xff\xff\xff"),
    }


def obj_files():
    square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    full = square + "vt 0 0\nvt 1 0\nvt 1 1 0\nvt 0 1\nvn 0 0 1\n"
    materials = ("#mtl\nnewmtl red\nKd 0.8 0.1 0.1\nKa 0 0 0\nKs 1 1 1\nNs 20\nillum 2\nd 0.5\n"
                 "map_Kd -s 2 2 1 -clamp on pixel.tga\nnewmtl lamp\nKe 5 5 5\nTr 0.2\n"
                 "newmtl blue\nKd spectral x.rfl\nKd xyz 0.1 0.2 0.3\nmap_Ke pixel.tga\n")
    surfaces = ("#mtl\nnewmtl coat\nKs 0.5 0.5 0.5\nNs 100\nmap_Ks pixel.tga\nmap_Ns pixel.tga\n"
                "norm -bm 0.5 pixel.tga\nmap_d -imfchan m pixel.tga\nd -halo 0.5\n"
                "newmtl mirror\nKs 1 1 1\nillum 3\nnewmtl glass\nNi 1.5\nTf 0.5 1 1\nillum 7\n"
                "newmtl metal\nPr 0.25\nPm 1\nPc 0.5\nPcr 0.1\nmap_Pr pixel.tga\nmap_Pm pixel.tga\n")
    glass = "f 1 3 2\nf 1 2 5\nf 2 3 5\nf 3 1 5\n"
    return {
        "plain.obj": "# made for tests\n" + square + "f 1 2 3\nf 1 3 4\n",
        "full.obj": "mtllib material.mtl\no one\ng a b\ns 1\n" + full +
                    "usemtl red\nf 1/1/1 2/2/1 3/3/1 4/4/1\nusemtl lamp\ns off\n"
                    "f -4//-1 -3//-1 -2//-1\nusemtl nothing\nf -4/-4 \\\n -3/-3 -2/-2\n" +
                    materials,
        "surfaces.obj": "mtllib material.mtl\n" + full + "v 0 0 1\n" + "".join(
            f"usemtl {name}\nf 1/1 2/2 3/3\n" for name in ("coat", "mirror", "metal")) +
                        "usemtl glass\n" + glass + surfaces,
        "colours.obj": "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\r\nf 1 2 3\r\n",
        "polygon.obj": square + "v 0.5 2 0\nf 1 2 3 5 4\nl 1 2\np 1\n",
        "numbers.obj": "v +1e3 -.5 1e-40\nv 1. 2 3 1.0\nv 1e6 0 0\nvn 0 0 0\nf 1//1 2//1 3//1\n",
        "badcurves.obj": square + "cstype bezier\ndeg 3\ncurv 0 1 1 2 3 4\nparm u 0 1\nend\n",
        "badindex.obj": square + "f 1 2 5\n",
        "badzero.obj": square + "f 0 1 2\n",
        "badnumber.obj": "v 0 zero 0\nf 1 1 1\n",
    }


def option_files():
    every = ["render", "scene.gltf", "-o", "out.exr", "--algorithm", "ir", "--backend", "native",
             "--device", "0", "--threads", "4", "--tile", "32", "--size", "640x480", "--camera",
             "eye", "--components", "direct,indirect", "--spp", "16", "--time", "2.5s", "--seed",
             "7", "--exposure", "auto", "--stats", "stats.json", "--progress", "plain"]
    lines = {
        "every": every,
        "equals": ["render", "a.xml", "--output=b.PNG", "--exposure=-1.5", "--time=300ms"],
        "compare": ["compare", "a.exr", "b.exr", "--metric", "flip", "--metric", "all",
                    "--luminance-scale", "1", "--ppd", "60", "--map", "m.png", "--layer",
                    "direct", "--json", "--legacy-fan", "--legacy-otf-grid"],
        "info": ["info", "--json", "scene.glb"],
        "devices": ["devices", "--json"],
        "help": ["--help"],
        "render_help": ["render", "-h"],
        "version": ["render", "--version"],
        "dashes": ["render", "--", "-scene.xml"],
        "badname": ["rendr", "a.xml"],
        "badoption": ["render", "a.xml", "--algoritm", "igi"],
        "badtwice": ["render", "a.xml", "--spp", "1", "--spp", "2"],
        "badlack": ["render", "a.xml", "--spp", "--seed", "1"],
        "badsize": ["render", "a.xml", "--size", "0x99999999999"],
    }
    return {name: "\n".join(arguments) + "\n" for name, arguments in lines.items()}
