# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""A scene that is put together from solids, by names of materials."""

from .gltf import Document
from .solids import Mesh, box, finish


def light_quad(corners):
    """A single sheet that shines to the side from which its corners are counter-clockwise."""
    return Mesh(list(corners), [(0, 1, 2), (0, 2, 3)])


class Builder:
    """Collects meshes and the nodes that place them. `albedo` and `radiance` are by name."""

    def __init__(self, title, albedo, radiance):
        self.document = Document(title, "The Weft Authors, CC0 1.0.")
        self.materials = {name: self.document.add_material(name, colour)
                          for name, colour in albedo.items()}
        for name, light in radiance.items():
            self.materials[name] = self.document.add_material(name, (0.4, 0.4, 0.4),
                                                              radiance=light)

    def mesh(self, name, material, mesh):
        primitive = self.document.primitive(mesh, self.materials[material])
        return self.document.add_mesh(name, [primitive])

    def solid(self, name, material, solids, at=(0.0, 0.0, 0.0), **how):
        """One mesh placed once."""
        self.place(name, self.mesh(name, material, finish(solids, **how)), at)

    def assembly(self, name, parts, **how):
        """One mesh of several materials: `parts` lists solids by material."""
        return self.document.add_mesh(name, [
            self.document.primitive(finish(solids, **how), self.materials[material])
            for material, solids in parts.items()])

    def light(self, name, material, corners, at=(0.0, 0.0, 0.0)):
        """A rectangle of light."""
        self.place(name, self.mesh(name, material, light_quad(corners)), at)

    def boundary(self, name, lo, hi, *medium):
        """A box filled with a medium; `medium` is what `Document.add_medium` takes."""
        self.materials[name] = self.document.add_medium(name, *medium)
        self.place(name, self.mesh(name, name, Mesh(*box(lo, hi))))

    def place(self, name, mesh, at=(0.0, 0.0, 0.0), rotation=None):
        fields = {"mesh": mesh}
        if any(at):
            fields["translation"] = [round(c, 6) for c in at]
        if rotation:
            fields["rotation"] = [round(c, 9) for c in rotation]
        self.document.add_node(name, **fields)
