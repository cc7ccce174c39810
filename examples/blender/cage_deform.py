"""Meshes follow a cage, one-to-one: what the add-on does, without Blender."""

import libicc
import numpy as np


class Cage:
    """A closed surface, and what is bound to it: everything inside.

    Binding is filling the surface with tetrahedra, whatever lies inside. A surface that is open or meets itself is an
    error that names the place, and so is the rare one that cannot be filled in doubles.
    """

    def __init__(self, vertices, triangles):
        """Binds: vertices (n, 3) and triangles (m, 3) of the cage at rest."""
        self.triangles = np.asarray(triangles)
        self.rest = libicc.Domain(vertices, self.triangles).filled()
        self.map = None

    def move(self, vertices):
        """The map to where the cage's vertices are now; the next pose starts from this one."""
        target = libicc.Domain(vertices, self.triangles)
        self.map = libicc.Map(self.rest, target) if self.map is None else self.map.retarget(target)
        return self.map

    def deform(self, points):
        """Where points (n, 3) go, and how many lie outside the cage: these stay."""
        images = self.map(points)
        outside = np.isnan(images[:, 0])
        images[outside] = points[outside]
        return images, int(outside.sum())


def transformed(matrix, points):
    """Points (n, 3) under an affine matrix (4, 4)."""
    matrix = np.asarray(matrix, dtype=float)
    return points @ matrix[:3, :3].T + matrix[:3, 3]
