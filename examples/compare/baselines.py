"""Other ways to carry the inside of a polygon along with its boundary, as small as they get. Each takes a mesh of the
inside and gives an image for each of its vertices; none is tuned.

Boundary vertices come with their images; a cage is what these are corners of.
"""

from types import SimpleNamespace

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
        jacobians = mesh.jacobians(places)
        determinants = np.linalg.det(jacobians)
        if not np.all(determinants > 0):
            return (np.inf, None) if gradient else np.inf
        squares = (jacobians ** 2).sum(axis=(1, 2))
        away = places[rows] - mesh.boundary_images[rows]
        value = mesh.areas @ (squares * (1 + determinants ** -2)) / 4 + pull / 2 * (away ** 2).sum()
        if not gradient:
            return value
        slopes = (jacobians * (1 + determinants ** -2)[:, None, None]
                  - (squares / determinants ** 3)[:, None, None] * cofactors(jacobians)) / 2
        out = mesh.gather(slopes)
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


def repaired(mesh, images, rounds=60, steps=4):
    """Turns triangles back by moving inner vertices, from the images of any method (foldover-free maps, V. Garanzha et al.
    2021). The boundary goes to its images. A barrier in the energy stands behind the worst triangle and comes nearer round
    by round. Newton steps, without the terms that are not convex. Returns what it has at the end."""
    images = images.copy()
    images[mesh.on_boundary] = mesh.boundary_images[mesh.on_boundary]
    inner = np.flatnonzero(~mesh.on_boundary)
    # Determinants are 1 on average.
    scale = np.linalg.det(mesh.jacobians(images)) @ mesh.areas / mesh.areas.sum()

    def energy(places, behind):
        """What each triangle contributes, with what its derivatives are made of; `behind` is where the barrier stands."""
        jacobians = mesh.jacobians(places) / np.sqrt(scale)
        determinants = np.linalg.det(jacobians)
        roots = np.hypot(determinants, behind)
        # The same as (determinants + roots) / 2, without cancellation.
        barrier = np.where(determinants > 0, determinants + roots, behind ** 2 / (roots + abs(determinants))) / 2
        terms = (jacobians ** 2).sum(axis=(1, 2)) + determinants ** 2 + 1
        return mesh.areas @ (terms / barrier), (jacobians, determinants, roots, barrier, terms)

    def newton(parts, behind):
        """A step downhill for the inner vertices, and how fast the energy falls along it."""
        jacobians, determinants, roots, barrier, terms = parts
        turns = cofactors(jacobians)
        along = (2 * determinants - terms / roots) / barrier
        bend = 2 / barrier * (1 - 2 * determinants / roots) + terms / barrier / roots ** 2 * (1 + determinants / roots)
        slopes = 2 * jacobians / barrier[:, None, None] + along[:, None, None] * turns
        gradient = mesh.gather(slopes)[inner].ravel()
        spread = np.einsum("tid,tjd,t->tij", mesh.gradients, mesh.gradients, 2 * mesh.areas / barrier)
        sides = np.einsum("tcd,tid->tic", turns, mesh.gradients) * np.sqrt(mesh.areas * np.maximum(bend, 0))[:, None, None]
        blocks = spread[:, :, None, :, None] * np.eye(2)[:, None, :] + sides[:, :, :, None, None] * sides[:, None, None]
        rows = (2 * mesh.triangles[:, :, None] + [0, 1]).reshape(len(turns), 6)
        matrix = np.zeros((2 * len(mesh.points), 2 * len(mesh.points)))
        np.add.at(matrix, (rows[:, :, None], rows[:, None, :]), blocks.reshape(-1, 6, 6))
        free = (2 * inner[:, None] + [0, 1]).ravel()
        step = np.linalg.solve(matrix[np.ix_(free, free)], gradient)
        return step.reshape(-1, 2) * np.sqrt(scale), step @ gradient

    for _ in range(rounds):
        worst = np.linalg.det(mesh.jacobians(images)).min() / scale
        if worst > 1e-3:
            break
        behind = np.sqrt(1e-4 + .04 * min(worst, 0) ** 2)
        for _ in range(steps):
            value, parts = energy(images, behind)
            step, slope = newton(parts, behind)
            length, moved = 1.0, images.copy()
            while length > 1e-9:
                moved[inner] = images[inner] - length * step
                if energy(moved, behind)[0] <= value - 1e-4 * length * slope:
                    break
                length /= 2
            else:
                break
            images = moved
    return images


def cofactors(matrices):
    """The derivative of each determinant."""
    out = matrices[:, ::-1, ::-1].copy()
    out[:, 0, 1], out[:, 1, 0] = -matrices[:, 1, 0], -matrices[:, 0, 1]
    return out


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

    def jacobians(self, places):
        """The derivative of each triangle's map."""
        return np.einsum("tic,tid->tcd", places[self.triangles], self.gradients)

    def gather(self, slopes):
        """The gradient, at vertices, of an energy whose density has these derivatives by the entries of `jacobians`."""
        out = np.zeros_like(self.points)
        np.add.at(out, self.triangles, np.einsum("tcd,tid,t->tic", slopes, self.gradients, self.areas))
        return out


def with_points(mesh, points):
    """What a formula asks of a mesh, with further points inside behind the vertices."""
    empty = np.full_like(points, np.nan)
    return SimpleNamespace(points=np.vstack([mesh.points, points]), middles=np.vstack([mesh.middles, points]),
                           boundary_images=np.vstack([mesh.boundary_images, empty]),
                           on_boundary=np.append(mesh.on_boundary, np.zeros(len(points), bool)))


METHODS = {"mean value": mean_value, "harmonic": harmonic, "biharmonic": biharmonic, "Cauchy-Green": cauchy,
           "thin plate": thin_plate, "injective": injective}
# Methods that give an image to any point. The others give them to the vertices of a mesh.
FORMULAS = ("mean value", "Cauchy-Green", "thin plate")
