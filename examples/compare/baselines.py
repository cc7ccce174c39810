"""Other ways to carry the inside of a polygon along with its boundary, as small as they get. Each takes a mesh of the
inside and gives an image for each of its vertices; none is tuned.

Boundary vertices come with their images; a cage is what these are corners of.
"""

import numpy as np


def mean_value(mesh, cage, target):
    """Mean value coordinates (M. S. Floater 2003; K. Hormann, M. S. Floater 2006): a formula of the cage."""
    images = mesh.boundary_images.copy()
    for v in np.flatnonzero(~mesh.on_boundary):
        spokes = cage - mesh.points[v]
        lengths = np.hypot(*spokes.T)
        following = np.roll(spokes, -1, axis=0)
        tangents = np.tan(np.arctan2(cross(spokes, following), (spokes * following).sum(axis=1)) / 2)
        weights = (tangents + np.roll(tangents, 1)) / lengths
        images[v] = weights @ target / weights.sum()
    return images


def harmonic(mesh, cage, target):
    """Harmonic coordinates (P. Joshi et al. 2007): Laplace's equation by finite elements."""
    return with_boundary(mesh, mesh.stiffness)


def biharmonic(mesh, cage, target):
    """Least squared Laplacian under the boundary's places, edges free to turn (the energy of bounded biharmonic weights,
    A. Jacobson et al. 2011, without bounds)."""
    inside = mesh.stiffness[~mesh.on_boundary]
    return with_boundary(mesh, inside.T @ (inside / mesh.masses[~mesh.on_boundary, None]))


def cauchy(mesh, cage, target):
    """Complex barycentric coordinates by Cauchy's formula (O. Weber, M. Ben-Chen, C. Gotsman 2009), which in the plane are
    Green coordinates (Y. Lipman, D. Levin, D. Cohen-Or 2008). Vertices do not go to the target's: boundary vertices are
    taken from just inside."""
    corners, places = cage @ [1, 1j], target @ [1, 1j]
    z = (mesh.points + 1e-6 * (mesh.middles - mesh.points)) @ [1, 1j]
    edges = np.roll(corners, -1) - corners
    spokes = corners[None] - z[:, None]
    following = np.roll(spokes, -1, axis=1)
    logs = np.log(following / spokes)
    rising, falling = following / edges * logs, spokes / edges * logs
    weights = (rising - np.roll(falling, 1, axis=1)) / 2j / np.pi
    images = weights @ places
    return np.column_stack([images.real, images.imag])


def thin_plate(mesh, cage, target):
    """A thin-plate spline through the boundary's vertices (F. L. Bookstein 1989)."""
    known = mesh.points[mesh.on_boundary]

    def kernel(at):
        squares = ((at[:, None] - known) ** 2).sum(axis=2)
        return squares * np.log(np.where(squares > 0, squares, 1))

    def linear(at):
        return np.column_stack([np.ones(len(at)), at])

    system = np.block([[kernel(known), linear(known)], [linear(known).T, np.zeros((3, 3))]])
    weights = np.linalg.solve(system, np.vstack([mesh.boundary_images[mesh.on_boundary], np.zeros((3, 2))]))
    return np.hstack([kernel(mesh.points), linear(mesh.points)]) @ weights


def injective(mesh, cage, target, steps=400):
    """A locally injective map (as C. Schueller et al. 2013 make one): from the source itself, boundary vertices are drawn
    towards their images, ever harder, under the symmetric Dirichlet energy, which keeps triangles from turning over.
    Preconditioned gradient steps; the boundary arrives as nearly as `steps` of them get it."""
    images, rows = mesh.points.copy(), np.flatnonzero(mesh.on_boundary)
    size = np.ptp(mesh.boundary_images, axis=0).max()

    def energy(places, pull, gradient=False):
        """Its value, infinite where a triangle is turned over, and its gradient."""
        jacobians = np.einsum("tic,tid->tcd", places[mesh.triangles], mesh.gradients)
        determinants = np.linalg.det(jacobians)
        if not np.all(determinants > 0):
            return (np.inf, None) if gradient else np.inf
        squares = (jacobians ** 2).sum(axis=(1, 2))
        away = places[rows] - mesh.boundary_images[rows]
        value = mesh.areas @ (squares * (1 + determinants ** -2)) / 4 + pull / 2 * (away ** 2).sum()
        if not gradient:
            return value
        cofactors = jacobians[:, ::-1, ::-1].copy()
        cofactors[:, 0, 1], cofactors[:, 1, 0] = -jacobians[:, 1, 0], -jacobians[:, 0, 1]
        slopes = (jacobians * (1 + determinants ** -2)[:, None, None]
                  - (squares / determinants ** 3)[:, None, None] * cofactors) / 2 * mesh.areas[:, None, None]
        out = np.zeros_like(places)
        np.add.at(out, mesh.triangles, np.einsum("tcd,tid->tic", slopes, mesh.gradients))
        out[rows] += pull * away
        return value, out

    for pull in 10.0 ** np.arange(0, 8) * mesh.areas.sum() / size ** 2 / len(rows):
        matrix = mesh.stiffness.copy()
        matrix[rows, rows] += pull
        inverse = np.linalg.inv(matrix)
        for _ in range(steps // 8):
            value, gradient = energy(images, pull, gradient=True)
            step, length = inverse @ gradient, 1.0
            while length > 1e-9 and energy(images - length * step, pull) > value - 1e-4 * length * (gradient * step).sum():
                length /= 2
            if length <= 1e-9:
                break
            images -= length * step
    return images


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def with_boundary(mesh, matrix):
    """Where a quadratic energy is least when the boundary's vertices go to their images."""
    images, inner = mesh.boundary_images.copy(), np.flatnonzero(~mesh.on_boundary)
    right = matrix[np.ix_(inner, mesh.on_boundary)] @ images[mesh.on_boundary]
    images[inner] = -np.linalg.solve(matrix[np.ix_(inner, inner)], right)
    return images


class Mesh:
    """What the baselines ask of a mesh: `boundary_images` counts on the boundary only."""

    def __init__(self, points, triangles, boundary_images):
        self.points, self.triangles, self.boundary_images = points, triangles.astype(np.int64), boundary_images
        sides = np.sort(np.vstack([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
        edges, counts = np.unique(sides, axis=0, return_counts=True)
        self.on_boundary = np.zeros(len(points), bool)
        self.on_boundary[edges[counts == 1]] = True
        corners = points[self.triangles]
        self.areas = cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) / 2
        against = np.roll(corners, -2, axis=1) - np.roll(corners, -1, axis=1)
        self.gradients = np.stack([-against[..., 1], against[..., 0]], axis=2) / (2 * self.areas)[:, None, None]
        self.stiffness = np.zeros((len(points), len(points)))
        local = np.einsum("tid,tjd,t->tij", self.gradients, self.gradients, self.areas)
        np.add.at(self.stiffness, (self.triangles[:, :, None], self.triangles[:, None, :]), local)
        self.masses, sums, counts = np.zeros(len(points)), np.zeros_like(points), np.zeros(len(points))
        np.add.at(self.masses, self.triangles, np.repeat(self.areas[:, None] / 3, 3, axis=1))
        np.add.at(sums, self.triangles, np.repeat(corners.mean(axis=1)[:, None], 3, axis=1))
        np.add.at(counts, self.triangles, 1)
        self.middles = sums / counts[:, None]


METHODS = {"mean value": mean_value, "harmonic": harmonic, "biharmonic": biharmonic, "Cauchy-Green": cauchy,
           "thin plate": thin_plate, "injective": injective}
