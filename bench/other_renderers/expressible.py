# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""What a renderer's program may not be able to express of an exported scene."""


class NotExpressible(ValueError):
    """A renderer has no like of something in a scene, which it has to leave out therefore."""



def refuse(scene, kinds):
    """Raises NotExpressible where the scene holds any of these, keys of `held`, or what no
    renderer's program has been taught yet: lobes of Weft's own and emission by a texture."""
    held = {"lights without area": bool(scene.lights),
            "textures": bool(scene.textures),
            "vertex colours": any(mesh.colours is not None for mesh in scene.meshes),
            # Exports that do not tell were made when there was no other lobe. What a surface is
            # described as, renderers express each in its own way, or refuse it themselves.
            "surfaces that are not Lambertian": not all(material.get("lambertian", True)
                                                        or material.get("surface")
                                                        for material in scene.materials),
            "metals, plastics and glass": any(material.get("surface")
                                              for material in scene.materials),
            "textured emission": any(material.get("textured_emission", False)
                                     for material in scene.materials),
            "media": bool(scene.media),
            "media with density grids": any(not medium["homogeneous"] for medium in scene.media),
            "media that shine": any(max(medium["emission"]) > 0.0 for medium in scene.media)}
    found = [kind for kind in (*kinds, "surfaces that are not Lambertian", "textured emission")
             if held[kind]]
    if found:
        raise NotExpressible(", ".join(found))
