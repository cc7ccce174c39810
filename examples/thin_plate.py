"""The usual way to carry a picture or a map along with control points, for comparison: a thin-plate spline
(F. L. Bookstein, Principal warps, IEEE Transactions on Pattern Analysis and Machine Intelligence 11, 1989). It is smooth
and goes through all points, but it is not one-to-one: where points move far it folds over, and folded() measures that.
"""

import numpy as np


def spline(points, images):
    """The spline that takes points (n, 2) to their images, as a function of points (m, 2)."""
    points, images = np.asarray(points, float), np.asarray(images, float)

    def kernel(at):
        squares = ((at[:, None] - points) ** 2).sum(axis=2)
        return squares * np.log(np.where(squares > 0, squares, 1))

    def linear(at):
        return np.column_stack([np.ones(len(at)), at])

    system = np.block([[kernel(points), linear(points)], [linear(points).T, np.zeros((3, 3))]])
    weights = np.linalg.solve(system, np.vstack([images, np.zeros((3, 2))]))
    return lambda at: kernel(at) @ weights[:-3] + linear(at) @ weights[-3:]


def along(vertices, closed, pieces=4):
    """The vertices of a ring or line, and points that cut its edges into pieces."""
    ends = np.roll(vertices, -1, axis=0) if closed else vertices[1:]
    starts = vertices if closed else vertices[:-1]
    shares = np.arange(pieces)[:, None, None] / pieces
    inner = (starts * (1 - shares) + ends * shares).transpose(1, 0, 2).reshape(-1, 2)
    return inner if closed else np.vstack([inner, vertices[-1:]])


def determinants(function, at, step):
    """By which factor areas grow at the points, negative where the function turns them over."""
    x, y = np.array([step, 0]), np.array([0, step])
    dx = (function(at + x) - function(at - x)) / (2 * step)
    dy = (function(at + y) - function(at - y)) / (2 * step)
    return dx[:, 0] * dy[:, 1] - dx[:, 1] * dy[:, 0]


def folded(function, at, step):
    """The share of evenly spread points where the function turns over."""
    return float(np.mean(determinants(function, at, step) <= 0))
