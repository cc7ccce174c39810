"""The best peers of elastic fits: as-rigid-as-possible shapes, and linear elasticity for meshes whose walls move."""

import numpy as np
import scipy.sparse as sparse
from common import areas
from scipy.sparse.linalg import splu


def gradients(vertices, triangles):
    """Gradients (m, 3, 2) of the three hat functions on each triangle, and the triangles' areas."""
    p, double = vertices[triangles], areas(vertices, triangles)
    edges = np.stack([p[:, 2] - p[:, 1], p[:, 0] - p[:, 2], p[:, 1] - p[:, 0]], 1)
    return np.stack([-edges[..., 1], edges[..., 0]], -1) / double[:, None, None], double / 2


def matrix(values, rows, n):
    """A sparse matrix from a dense one (k, k) for each triangle, whose unknowns are `rows` (m, k)."""
    k = rows.shape[1]
    return sparse.csc_matrix((values.ravel(), (np.repeat(rows, k, 1).ravel(), np.tile(rows, (1, k)).ravel())), (n, n))


class Arap:
    """Triangles that stay as rigid as possible while pins move, by the local-global method. Sorkine and Alexa,
    As-Rigid-As-Possible Surface Modeling, 2007; Liu et al., A Local/Global Approach to Mesh Parameterization, 2008."""

    def __init__(self, vertices, triangles, pins):
        self.vertices, self.triangles, self.pins = vertices, triangles, pins
        self.hats, area = gradients(vertices, triangles)
        self.weighted = self.hats * area[:, None, None]
        n = len(vertices)
        self.free = np.setdiff1d(np.arange(n), pins)
        stiff = matrix(np.einsum("mid,mjd->mij", self.weighted, self.hats), triangles, n)
        self.to_pins, self.factor = stiff[self.free][:, pins], splu(stiff[self.free][:, self.free].tocsc())

    def step(self, images):
        """One rotation for each triangle, then the images that fit these rotations best."""
        j = np.einsum("mki,mkj->mij", images[self.triangles], self.hats)
        angle = np.arctan2(j[:, 1, 0] - j[:, 0, 1], j[:, 0, 0] + j[:, 1, 1])
        c, s = np.cos(angle), np.sin(angle)
        rotations = np.stack([np.stack([c, -s], -1), np.stack([s, c], -1)], 1)
        wanted = np.einsum("mij,mkj->mki", rotations, self.weighted)
        right = np.zeros_like(images)
        np.add.at(right, self.triangles.ravel(), wanted.reshape(-1, 2))
        images = images.copy()
        images[self.free] = self.factor.solve(right[self.free] - self.to_pins @ images[self.pins])
        return images

    def pose(self, path, n_steps=20, n_rounds=10, n_last=200):
        """The shape at the end of a path: path(t) tells the pins' places for t from 0 to 1."""
        images = self.vertices
        for step in range(1, n_steps + 1):
            images = images.copy()
            images[self.pins] = path(step / n_steps)
            for _ in range(n_rounds if step < n_steps else n_last):
                images = self.step(images)
        return images


def elasticity(vertices, triangles, held, path, n_steps, poisson=.3):
    """A mesh whose held vertices move along path(t), t from 0 to 1, by linear elasticity with a stiffness of one over
    the triangle's area. The mesh is updated after each step. This is what programs for moving meshes do."""
    points, n = vertices.copy(), len(vertices)
    unknowns = np.concatenate([2 * triangles[:, :, None], 2 * triangles[:, :, None] + 1], 2).reshape(len(triangles), 6)
    fixed = np.stack([2 * held, 2 * held + 1], -1).ravel()
    free = np.setdiff1d(np.arange(2 * n), fixed)
    law = np.array([[1 - poisson, poisson, 0], [poisson, 1 - poisson, 0], [0, 0, (1 - 2 * poisson) / 2]])
    for step in range(1, n_steps + 1):
        hats, area = gradients(points, triangles)
        strain = np.zeros((len(triangles), 3, 6))
        strain[:, 0, 0::2], strain[:, 1, 1::2] = hats[..., 0], hats[..., 1]
        strain[:, 2, 0::2], strain[:, 2, 1::2] = hats[..., 1], hats[..., 0]
        stiffness = np.sign(area) / np.maximum(np.abs(area), 1e-300)
        local = np.einsum("mai,ab,mbj->mij", strain, law, strain) * (np.abs(area) * np.abs(stiffness))[:, None, None]
        whole = matrix(local, unknowns, 2 * n)
        move = np.zeros(2 * n)
        move[fixed] = (path(step / n_steps) - points[held]).ravel()
        move[free] = splu(whole[free][:, free].tocsc()).solve(-(whole[free][:, fixed] @ move[fixed]))
        points = points + move.reshape(-1, 2)
    return points
