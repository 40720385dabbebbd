# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""Seeds of the targets preset, view and peers."""
import json


def text(value):
    return json.dumps(value) + "\n"


def preset(**settings):
    return text({"weft_preset": 1, **settings})


def view_files():
    camera = {"from": [0.1, 2.5e-3, -3], "at": [0, 0, 0], "up": [0, 1, 0], "fov": 40}
    flat = {**camera, "up": [0.1, 2.5e-3, -3]}
    settings = {
        "algorithm": "tic", "quality": "high", "size": [640, 480], "exposure": -1.5,
        "tone": "agx", "paused": True, "camera": "top",
    }
    more = {
        "frame": 12, "samples": 16, "overlay": "direct.level", "trust": True,
        "compare": {"algorithm": "igi", "quality": "draft", "seconds": 0.3},
    }
    turn = {"axis": [0, 1, 0], "degrees": 30, "about": [1, 0, 0]}
    return {
        "key.json": text({"token": "00112233445566778899aabbccddeeff"}),
        "ack.json": text({"ack": 4294967295}),
        "camera.json": text({"camera": camera, "state": 7, "moving": True}),
        "settings.json": text({"set": settings, "state": 8}),
        "pick.json": text({"pick": [12, 34]}),
        "save.json": text({"save": "exr"}),
        "more.json": text({"set": more, "state": 3, "moving": True}),
        "move.json": text({"edit": {"object": "box", "move": [1, 0, 0.5]}, "state": 4}),
        "turn.json": text({"edit": {"object": "box", "rotate": turn}, "state": 4,
                           "continues": True, "moving": True}),
        "paint.json": text({"edit": {"material": "red", "albedo": [0, 0.5, 1],
                                     "emission_factor": 2}, "state": 5}),
        "dim.json": text({"edit": {"light": "lamp", "intensity": 0.5}, "state": 6}),
        "copy.json": text({"edit": {"object": "box", "add": {"name": "b"}}, "state": 6}),
        "undo.json": text({"undo": "last", "state": 7}),
        "measure.json": text({"measure": True}),
        "adopt.json": text({"adopt": 2}),
        "badfar.json": text({"edit": {"object": "box", "move": [1e300, 0, 0]}, "state": 4}),
        "badframe.json": text({"edit": {"frame": 1, "object": "box", "scale": 2}, "state": 4}),
        "badalong.json": text({"camera": flat, "state": 7}),
        "badsize.json": text({"set": {"size": [32768, 32768]}, "state": 8}),
        "badstate.json": text({"set": {}}),
        "badkind.json": text({"hello": 1}),
        "baddeep.json": '{"ack": ' + "[" * 200 + "\n",
        "badsyntax.json": '{"ack": 1,}\n',
    }


def preset_files():
    every = {
        "algorithm": "amax", "indirect": "tic", "spp": 12, "interleave": 5, "vpls": 17,
        "bounces": 2, "light_samples": 3, "max_light_samples": 99, "bound_spacing": 1.5,
        "filter_radius": 2, "filter_cosine": 0.25, "filter_planes": 3.5, "threshold": 0.1,
        "luminance_scale": 80, "support": 0.9, "roulette": 0, "edge_samples": 8,
        "compensation": False, "cache_error": 0.3, "cache_rays": 64, "cache_records": 1000,
        "cache_masks": False, "local_bounds": False, "vpl_tail": False, "candidates": 4,
        "near_residual": True, "threshold_falls": True,
    }
    return {
        "bare.json": preset(),
        "every.json": preset(**every),
        "spaced.json": json.dumps({"weft_preset": 1, **every}, indent=2) + "\n",
        "records.json": preset(algorithm="ais", indirect="ic", cache_error=0.05),
        "refined.json": preset(spp=70, refined_after=6),
        "badrefined.json": preset(algorithm="igi", refined_after=6),
        "whole.json": preset(compensation=True, spp=4),
        "paths.json": preset(algorithm="path", spp=16777216),
        "numbers.json": '{"weft_preset": 1.0, "spp": 1e2, "threshold": 1E-300, "roulette": -0.0}\n',
        "largest.json": preset(interleave=15, vpls=4660, max_light_samples=4660, threshold=1e6),
        "badversion.json": text({"weft_preset": 2}),
        "badnone.json": text({"spp": 4}),
        "badkey.json": preset(vpl=64),
        "badtwice.json": '{"weft_preset": 1, "spp": 1, "spp": 2}\n',
        "badtype.json": preset(threshold="10"),
        "badrange.json": preset(filter_cosine=1.5),
        "badeven.json": preset(interleave=4),
        "badsets.json": preset(interleave=15, vpls=65536),
        "badsource.json": preset(algorithm="igi", indirect="ic"),
        "badlarge.json": '{"weft_preset": 1, "threshold": 1e999}\n',
        "baddeep.json": '{"weft_preset": 1, "spp": ' + "[" * 200 + "\n",
        "badsyntax.json": '{"weft_preset": 1,}\n',
    }


def peer(**changes):
    full = {"name": "another", "budget_s": 0.3, "seconds": 0.31, "samples": 12, "denoised": False,
            "picture": "pair.hdr"}
    return {key: value for key, value in {**full, **changes}.items() if value is not None}


def peers(*images, **more):
    return text({"weft_peers": 1, "pictures": list(images), **more})


def peer_files():
    return {
        "none.json": peers(),
        "one.json": peers(peer()),
        "bare.json": peers(peer(samples=None, denoised=None)),
        "several.json": peers(peer(), peer(name="d\u00e9bruit\u00e9", denoised=True, samples=0),
                              peer(budget_s=31536000, seconds=0, picture="./pair.hdr"),
                              notes=["set-up is left out", "\u2026 and more"]),
        "badversion.json": text({"weft_peers": 2, "pictures": []}),
        "badlack.json": text({"weft_peers": 1}),
        "badkey.json": peers(peer(speed=1)),
        "badtwice.json": '{"weft_peers": 1, "pictures": [], "pictures": []}\n',
        "badname.json": peers(peer(name="")),
        "badseconds.json": peers(peer(seconds=-1)),
        "badsamples.json": peers(peer(samples=1e300)),
        "badnote.json": peers(notes=["", 1]),
        "badfile.json": peers(peer(), peer(picture="missing.hdr")),
        "badkind.json": peers(peer(picture="triangle.ply")),
        "badfolder.json": peers(peer(picture="../pair.hdr")),
        "badcontrol.json": peers(peer(picture="pair\n.hdr")),
    }
