"""What the programs of this folder share: how they report, exact signs, simple outlines, and the peers' splines.

Each program measures one family of fits beside the best peer. It prints figures, checks them against limits and ends
with exit code 1 if a limit is broken. Without options it runs a small share, as a test. `--full` runs everything, and
`--seed N` tries other problems of the same kind. Times are processor time; only `--times` checks them.
"""

import argparse
import os
import sys
import time
from fractions import Fraction

# One thread for the peers, too, because times are compared. It must be set before NumPy is loaded.
for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(name, "1")

MISSING = 77        # the exit code of a test that was left out

try:
    import numpy as np
except ImportError as reason:
    print(f"left out: {reason}")
    sys.exit(MISSING)

# Far above the rounding error of a determinant of two differences, relative to the products in it.
ROUNDING = 1e-14
# Of the size of a shape: exact points may be off by so much, which is some roundings.
EXACT = 1e-12


def options(text, *more):
    """The command line: `more` are further options, each with its keywords for argparse."""
    parser = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1, help="draws other problems of the same kind")
    parser.add_argument("--full", action="store_true", help="all problems; takes minutes")
    parser.add_argument("--times", action="store_true", help="check limits of processor time, too")
    parser.add_argument("--peers", action="store_true", help="only the peers, without libicc")
    for name, keywords in more:
        parser.add_argument(name, **keywords)
    return parser.parse_args()


def wants(*names):
    """Ends the program as left out if a Python module is missing."""
    for name in names:
        try:
            __import__(name)
        except ImportError as reason:
            print(f"left out: {reason}")
            sys.exit(MISSING)


class Report:
    """Figures, and the limits that they break."""

    def __init__(self):
        self.n_checks, self.broken = 0, []

    def say(self, text):
        print(text, flush=True)

    def check(self, right, text):
        """Notes that `text` is wrong unless `right` holds."""
        self.n_checks += 1
        if not right:
            self.broken.append(text)
            self.say(f"   BROKEN: {text}")

    def at_most(self, name, value, limit):
        self.check(value <= limit, f"{name} is {value:.4g}, and may be {limit:.4g} at most")

    def at_least(self, name, value, limit):
        self.check(value >= limit, f"{name} is {value:.4g}, and must be {limit:.4g} at least")

    def end(self, only_peers=False):
        if self.n_checks == 0 and not only_peers:
            self.broken.append("nothing was checked")
        print(f"{self.n_checks} limits, {len(self.broken)} broken", *self.broken, sep="\n   ")
        sys.exit(bool(self.broken))


class Clock:
    """Processor time of a block: `with Clock() as clock: ..`, then `clock.seconds`."""

    def __enter__(self):
        self.start = time.process_time()
        return self

    def __exit__(self, *_):
        self.seconds = time.process_time() - self.start


def geometric(values):
    """The geometric mean."""
    return float(np.exp(np.log(values).mean()))


def rms(vectors):
    """The root mean square length of vectors (n, 2)."""
    return float(np.sqrt((vectors ** 2).sum(1).mean()))


# ---------------------------------------------------------------- geometry

def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def areas(points, triangles):
    """Twice the signed area of each triangle, in doubles."""
    p = points[triangles]
    return cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])


def signs(points, triangles):
    """The exact orientation of each triangle, 1, 0 or -1. Doubles decide where they can, fractions elsewhere."""
    p = points[triangles]
    u, v = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    scale = np.abs(p).max(axis=(1, 2))
    bound = ROUNDING * (np.abs(u[:, 0] * v[:, 1]) + np.abs(u[:, 1] * v[:, 0]) + scale * np.abs(p[:, 1:] - p[:, :1]).max(axis=(1, 2)))
    value = cross(u, v)
    result = np.sign(value).astype(int)
    for i in np.flatnonzero(np.abs(value) <= bound):
        (ax, ay), (bx, by), (cx, cy) = [[Fraction(float(x)) for x in q] for q in p[i]]
        exact = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
        result[i] = (exact > 0) - (exact < 0)
    return result


def rings(triangles):
    """The loops of boundary vertices of a mesh."""
    pairs = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    inside = set(map(tuple, pairs.tolist()))
    following = {a: b for a, b in pairs.tolist() if (b, a) not in inside}
    loops = []
    while following:
        start, loop = next(iter(following)), []
        while start in following:
            loop.append(start)
            start = following.pop(start)
        loops.append(np.array(loop))
    return loops


def one_to_one(vertices, images, triangles):
    """What keeps a mesh map from being one-to-one, as words; empty if it is."""
    from shapely.geometry import LinearRing, Polygon
    faults = []
    for name, points in (("source", vertices), ("target", images)):
        n = int((signs(points, triangles) <= 0).sum())
        if n:
            faults.append(f"{n} triangles flat or turned over in the {name}")
        loops = sorted((LinearRing(points[loop]) for loop in rings(triangles)), key=lambda r: -Polygon(r).area)
        if not all(loop.is_simple for loop in loops):
            faults.append(f"the outline meets itself in the {name}")
        elif any(a.intersects(b) for i, a in enumerate(loops) for b in loops[:i]):
            faults.append(f"rings of the boundary meet in the {name}")
        elif not all(Polygon(loops[0]).contains(loop) for loop in loops[1:]):
            faults.append(f"a hole is outside in the {name}")
    return ", ".join(faults)


def jacobians(vertices, images, triangles):
    """Derivatives (m, 2, 2) of the map that is linear on each triangle."""
    p, q = vertices[triangles], images[triangles]
    before = np.stack([p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]], -1)
    after = np.stack([q[:, 1] - q[:, 0], q[:, 2] - q[:, 0]], -1)
    return after @ np.linalg.inv(before)


def share(values, weights, part):
    """The value that `part` of the weight does not exceed."""
    order = np.argsort(values)
    sums = np.cumsum(weights[order])
    return float(values[order][min(np.searchsorted(sums, part * sums[-1]), len(values) - 1)])


def aspects(derivatives):
    """The longest over the shortest stretch of each derivative."""
    stretch = np.linalg.svd(derivatives, compute_uv=False)
    return stretch[:, 0] / np.maximum(stretch[:, 1], 1e-300)


def energies(derivatives):
    """The symmetric Dirichlet energy of each derivative: 4 for a rotation, infinite where it turns over."""
    with np.errstate(divide="ignore"):
        det = np.linalg.det(derivatives)
        value = (derivatives ** 2).sum((1, 2)) * (1 + 1 / det ** 2)
    return np.where(det > 0, value, np.inf)


# ------------------------------------------------------------------- peers

class ThinPlate:
    """The thin-plate spline through points, without smoothing. Bookstein, Principal Warps, 1989."""

    def __init__(self, points, to):
        self.points = np.asarray(points, float)
        # Shifted and scaled, which changes nothing but rounding.
        self.shift, self.scale = self.points.mean(0), np.ptp(self.points, axis=0).max()
        p = (self.points - self.shift) / self.scale
        n, self.knots = len(p), p
        matrix = np.zeros((n + 3, n + 3))
        matrix[:n, :n] = self._kernel(p)
        matrix[:n, n:] = np.c_[np.ones(n), p]
        matrix[n:, :n] = matrix[:n, n:].T
        self.coefficients = np.linalg.solve(matrix, np.r_[to, np.zeros((3, 2))])

    def _kernel(self, p):
        r2 = ((p[:, None] - self.knots[None]) ** 2).sum(2)
        return r2 * np.log(np.maximum(r2, 1e-300))

    def __call__(self, points, block=2000):
        q = (np.asarray(points, float) - self.shift) / self.scale
        return np.concatenate([np.c_[self._kernel(p), np.ones(len(p)), p] @ self.coefficients
                               for p in np.array_split(q, max(1, len(q) // block))])

    def determinants(self, points):
        """The determinant of the derivative at points; where it is not positive, the spline folds."""
        q = (np.asarray(points, float) - self.shift) / self.scale
        n, found = len(self.knots), []
        for p in np.array_split(q, max(1, len(q) // 2000)):
            d = p[:, None] - self.knots[None]
            r2 = np.maximum((d ** 2).sum(2), 1e-300)
            slope = 2 * (np.log(r2) + 1)[..., None] * d
            found.append(np.einsum("pni,nj->pji", slope, self.coefficients[:n]) + self.coefficients[n + 1:].T)
        return np.linalg.det(np.concatenate(found)) / self.scale ** 2


# ------------------------------------------------------------------ libicc

def library():
    """libicc for Python; ends the program as left out if it is not at hand."""
    try:
        import libicc
    except ImportError as reason:
        print(f"left out: {reason}")
        sys.exit(MISSING)
    return libicc


def mesh_of(mapping):
    """Vertices, images and triangles of a map."""
    vertices, images, triangles = mapping.mesh()
    return vertices, images, triangles.astype(int)
