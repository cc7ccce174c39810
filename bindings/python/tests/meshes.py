"""Tetrahedra to test with."""

import numpy as np


def grid_mesh(n):
    """The cube [0, n]^3 in Kuhn's tetrahedra."""
    index = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
    points = np.stack(np.meshgrid(*[np.arange(n + 1.0)] * 3, indexing="ij"), -1).reshape(-1, 3)
    cells = []
    for order in [(0, 1, 2), (0, 2, 1), (1, 0, 2), (1, 2, 0), (2, 0, 1), (2, 1, 0)]:
        corner, path = np.zeros(3, int), []
        for axis in (None, *order):
            if axis is not None:
                corner = corner + np.eye(3, dtype=int)[axis]
            i, j, k = corner
            path.append(index[i:i + n, j:j + n, k:k + n].ravel())
        cells.append(np.stack(path, -1))
    return points, np.concatenate(cells)


def bend(points):
    x, y, z = points.T
    return np.stack([x + 0.3 * np.sin(y), y + 0.1 * z * x, 1.5 * z - 0.1 * x * y], -1)
