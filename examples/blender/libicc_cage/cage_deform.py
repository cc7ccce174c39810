"""Meshes follow a cage, one-to-one: what the add-on does, without Blender."""

import libicc
import numpy as np


class Cage:
    """A closed surface whose inside is filled with tetrahedra. Whatever lies inside is bound to it.

    A surface that is open or meets itself is an error that names the place. So is the rare surface that cannot be
    filled in doubles.
    """

    def __init__(self, vertices, triangles):
        """vertices (n, 3) and triangles (m, 3) of the cage at rest"""
        self.vertices, self.triangles = np.array(vertices), np.array(triangles)
        self.rest = libicc.Domain(self.vertices, self.triangles).filled()
        self.map = None

    def is_of(self, vertices, triangles):
        """Whether this cage was made from these arrays."""
        return np.array_equal(self.vertices, vertices) and np.array_equal(self.triangles, triangles)

    def move(self, vertices):
        """Makes the map to where the vertices are now. It depends on rest and pose alone, so frames may come in any
        order."""
        if len(vertices) != len(self.vertices):
            raise ValueError("a modifier of the cage changes the number of its vertices")
        self.map = libicc.Map(self.rest, libicc.Domain(vertices, self.triangles))
        return self.map

    def deform(self, points):
        """Returns the images of points (n, 3), and how many points lie outside the cage. These stay."""
        images = self.map(points)
        outside = np.isnan(images[:, 0])
        images[outside] = points[outside]
        return images, int(outside.sum())


def transformed(matrix, points):
    """Points (n, 3) under an affine matrix (4, 4)."""
    matrix = np.asarray(matrix, dtype=float)
    return points @ matrix[:3, :3].T + matrix[:3, 3]
