#!/usr/bin/env python3
"""A skeleton as the maximum, which Huynh and Gingold leave open (paper, section 9): every curve ends on a tree of bones
in place of a point. The same tree is given in both shapes, or is the first one's medial axis, made simple, and its image
by libicc's map; each bone goes to its partner, from both of its sides.

    python3 examples/compare/skeleton.py [--cells N] [OUT.svg]

Both shapes are slit open along the tree, which leaves a ring. psi winds once round it, as in libicc's foliations; its
level lines are the leaves. On both rims of the ring psi is the mean of what either shape would have by itself, so that a
leaf has the same ends in both, and what lies on either side of a bone stays together. A point goes to where the same share
of the leaf's length lies before it. That leaves never meet is certified, in whole numbers.

Needs libicc for Python and NumPy.
"""

import argparse

import compare
import libicc
import numpy as np
import open_questions
import shapes
from libicc import stages

TURN = 1 << 50


def after(corner):
    return corner // 3 * 3 + (corner + 1) % 3


def before(corner):
    return corner // 3 * 3 + (corner + 2) % 3


def cut(points, edges, pieces):
    """The points, then those that cut each edge into equal pieces; and all edges."""
    points, cut_edges = list(points), []
    for (a, b), n in zip(edges, pieces):
        chain = [a, *range(len(points), len(points) + n - 1), b]
        points += [points[a] + k / n * (points[b] - points[a]) for k in range(1, n)]
        cut_edges += zip(chain, chain[1:])
    return np.array(points), np.array(cut_edges)


class NotConforming(Exception):
    """Which pieces of bones are no edges of the triangulation."""


class Ring:
    """A shape that is slit open along a tree, as triangles. The vertices of the outline come first, anticlockwise, then
    those of the slit, a vertex of the tree once for each bone that it ends, with the triangles to the left of the way
    round. Corner c of the triangles faces an edge that runs from vertex tail[c] to head[c]."""

    def __init__(self, outline, joints, bones, step):
        self.n_outer = n = len(outline)
        lower, upper = outline.min(axis=0), outline.max(axis=0)
        columns, rows = np.meshgrid(*(np.arange(size / unit + 1) for size, unit in zip(upper - lower, (step, .87 * step))))
        lattice = np.column_stack([lower[0] + step * (columns + rows % 2 / 2).ravel(), lower[1] + .87 * step * rows.ravel()])
        lattice = lattice[libicc.Domain(outline).locate(lattice) == libicc.INSIDE]
        rims = np.vstack([outline, joints])
        lattice = lattice[[np.hypot(*(rims - p).T).min() > .7 * step for p in lattice]]
        points = np.vstack([rims, lattice])
        self.triangles = stages.triangulate(points, n).astype(np.int64)
        self.twins = self.find_twins(n + bones)
        self.slit_open(points, n + bones[0])
        self.tail, self.head = (self.triangles.ravel()[f(np.arange(self.triangles.size))] for f in (after, before))
        self.cut_across()
        self.weigh()

    def find_twins(self, walls):
        """The corner that faces the same edge from the other side; -1 at the outline and at the walls."""
        n = self.triangles.max() + 1
        corners = np.arange(self.triangles.size)
        key, back = (self.triangles.ravel()[f(corners)] * n + self.triangles.ravel()[g(corners)]
                     for f, g in ((after, before), (before, after)))
        order = np.argsort(key)
        at = np.minimum(np.searchsorted(key[order], back), len(key) - 1)
        twins = np.where(key[order][at] == back, order[at], -1)
        is_wall = np.isin(key, np.concatenate([walls[:, 0] * n + walls[:, 1], walls[:, 1] * n + walls[:, 0]]))
        lost = ~np.isin(walls[:, 0] * n + walls[:, 1], key)
        if lost.any():
            raise NotConforming(lost)
        return np.where(is_wall, -1, twins)

    def slit_open(self, points, first):
        """Walks round the tree, from one bone on. What lies between two of its edges at a vertex gets a vertex of its own."""
        flat, n = self.triangles.ravel(), self.n_outer
        corners = np.arange(len(flat))
        start = corner = corners[(flat[after(corners)] == first[0]) & (flat[before(corners)] == first[1])][0]
        walk, owner, copies = [], [], flat.copy()
        while corner != start or not walk:
            walk.append(corner)
            owner.append(flat[before(corner)])
            copies[before(corner)] = len(points) + len(owner) - 1
            corner = after(corner)
            while self.twins[corner] >= 0:
                copies[before(self.twins[corner])] = len(points) + len(owner) - 1
                corner = after(self.twins[corner])
        self.inner, self.owner = np.array(walk), np.array(owner)
        n_tree = len(set(owner))
        number = np.arange(len(points) + len(owner))
        number[len(points):] = n + np.arange(len(owner))
        number[n + n_tree:len(points)] += len(owner) - n_tree
        self.triangles = number[copies].reshape(-1, 3)
        self.points = np.vstack([points[:n], points[owner], points[n + n_tree:]])
        self.n_rims = n + len(owner)

    def cut_across(self):
        """1 along edges across a row of triangles from the outline to the slit, -1 the other way, else 0: closed, and 1 in
        all round the ring."""
        self.winding = np.zeros(len(self.tail), np.int64)
        entry = np.flatnonzero((self.tail == 0) & (self.head == 1))[0]
        came, queue, is_inner = {entry // 3: entry}, [entry // 3], set(self.inner.tolist())
        for triangle in queue:
            for corner in range(3 * triangle, 3 * triangle + 3):
                if corner in is_inner:
                    while True:
                        self.winding[corner] = -1
                        entry = came[corner // 3]
                        self.winding[entry] = 1
                        corner = self.twins[entry]
                        if corner < 0:
                            return
                other = self.twins[corner]
                if other >= 0 and other // 3 not in came:
                    came[other // 3] = other
                    queue.append(other // 3)

    def weigh(self):
        """Cotangent weights, kept positive, and their Laplacian."""
        corners = np.arange(len(self.tail))
        p = self.points[self.triangles.ravel()]
        u, v = p[after(corners)] - p, p[before(corners)] - p
        cotangent = .5 * (u * v).sum(axis=1) / (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0])
        self.once = (self.twins < 0) | (self.twins > corners)
        self.weight = np.maximum(cotangent + np.where(self.twins >= 0, cotangent[self.twins], 0), 1e-3)[self.once]
        self.laplacian = np.zeros((len(self.points),) * 2)
        a, b = self.tail[self.once], self.head[self.once]
        for i, j, sign in ((a, a, 1), (b, b, 1), (a, b, -1), (b, a, -1)):
            np.add.at(self.laplacian, (i, j), sign * self.weight)

    def solve(self, values, n_given, pull):
        """Least energy where the first values are given."""
        values = values.copy()
        right = pull[n_given:] - self.laplacian[n_given:, :n_given] @ values[:n_given]
        values[n_given:] = np.linalg.solve(self.laplacian[n_given:, n_given:], right)
        return values

    def flux(self):
        """What flows through each edge of the outline to the tree, half of it spread by length instead, in turns."""
        n = self.n_outer
        height = np.zeros(len(self.points))
        height[n:self.n_rims] = 1
        height = self.solve(height, self.n_rims, 0 * height)
        through = -(self.laplacian[:n] @ height)
        length = np.hypot(*(np.roll(self.points[:n], -1, axis=0) - self.points[:n]).T)
        return .25 * (through + np.roll(through, -1)) / through.sum() + .5 * length / length.sum()

    def harmonic(self, outer, inner=None):
        """psi, less what the row of triangles adds, where psi is given on the outline or on both rims."""
        pull, winding = np.zeros(len(self.points)), self.winding[self.once] * self.weight
        np.add.at(pull, self.tail[self.once], winding)
        np.add.at(pull, self.head[self.once], -winding)
        n = self.n_outer
        values = np.zeros(len(self.points))
        values[:n] = outer - (np.arange(n) > 0)
        if inner is not None:
            steps = self.winding[self.inner]
            values[n:self.n_rims] = inner - np.concatenate([[0], np.cumsum(steps[1:])])
        return self.solve(values, n if inner is None else self.n_rims, pull)

    def along_slit(self, values):
        """psi at the vertices of the slit, falling from one to the next."""
        return values[self.n_outer:self.n_rims] + np.concatenate([[0], np.cumsum(self.winding[self.inner][1:])])

    def label(self, outer, inner):
        """psi in whole numbers, so that what follows is exact."""
        self.labels = np.rint(self.harmonic(outer, inner) * TURN).astype(np.int64)
        self.rise = self.labels[self.head] - self.labels[self.tail] + self.winding * TURN
        self.starts = np.rint(outer * TURN).astype(np.int64)

    def faults(self):
        """Triangles that are turned over, or no ring; and where level lines of psi are no leaves that never meet: edges of the
        rims along which psi does not rise, less or more than a turn, vertices whose neighbours are not one higher and one
        lower run."""
        corners = np.arange(len(self.rise))
        on_outline = (self.twins < 0) & (self.tail < self.n_outer)
        flat = (self.rise[on_outline] <= 0).sum() + (self.rise[self.inner] >= 0).sum()
        sign = np.where(self.rise != 0, np.sign(self.rise), np.sign(self.head - self.tail))
        changes = np.zeros(len(self.points), np.int64)
        np.add.at(changes, self.triangles.ravel(), sign[before(corners)] == sign[after(corners)])
        wanted = np.where(np.arange(len(self.points)) < self.n_rims, 1, 2)
        no_ring = len(self.points) - self.once.sum() + len(self.triangles) != 0 or self.rise[on_outline].sum() != TURN
        return compare.folds(self.points, self.triangles) + no_ring + flat + (changes != wanted).sum()

    def leaves(self, labels):
        """The leaves with these labels from the outline to the tree: (steps, n, 2), and the length up to there."""
        labels = (labels - 1) % TURN + 1
        edge = np.searchsorted(self.starts, labels) - 1
        corner_of = np.zeros(self.n_outer, np.int64)
        rim = np.flatnonzero((self.twins < 0) & (self.tail < self.n_outer))
        corner_of[self.tail[rim]] = rim
        corner = corner_of[edge]
        below = labels - self.starts[edge]
        over = self.rise[corner] - below
        a, b = self.tail[corner], self.head[corner]
        path, alive = [], np.full(len(labels), True)
        while True:
            share = (below / (below + over))[:, None]
            path.append((1 - share) * self.points[a] + share * self.points[b])
            if not alive.any():
                break
            tip = self.triangles.ravel()[corner]
            opposite = over + self.rise[after(corner)]
            under = opposite < 0
            step = np.where(under, after(corner), before(corner))
            a, b = np.where(alive & under, tip, a), np.where(alive & ~under, tip, b)
            below = np.where(alive & under, -opposite, below)
            over = np.where(alive & ~under, opposite, over)
            corner = np.where(alive, self.twins[step], corner)
            alive = alive & (corner >= 0)
            corner = np.where(corner >= 0, corner, 0)
        path = np.array(path)
        pieces = np.hypot(*np.moveaxis(np.diff(path, axis=0), -1, 0))
        return path, np.vstack([np.zeros(len(labels)), np.cumsum(pieces, axis=0)])

    def encode(self, points):
        """The label of the leaf through each point, and the share of the leaf's length before it."""
        corners = self.points[self.triangles]
        labels = np.empty(len(points), np.int64)
        areas = compare.baselines.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        for i, p in enumerate(points):
            shares = np.stack([compare.baselines.cross(corners[:, (k + 1) % 3] - p, corners[:, (k + 2) % 3] - p)
                               for k in range(3)]) / areas
            t = shares.min(axis=0).argmax()
            rise = self.rise[3 * t:3 * t + 3]
            labels[i] = self.labels[self.triangles[t, 0]] + int(shares[1, t] * rise[2] - shares[2, t] * rise[1])
        path, length = self.leaves(labels)
        way = np.diff(path, axis=0)
        square = np.maximum((way ** 2).sum(axis=-1), 1e-300)
        share = np.clip(((points - path[:-1]) * way).sum(axis=-1) / square, 0, 1)
        off = ((path[:-1] + share[..., None] * way - points) ** 2).sum(axis=-1)
        piece, each = off.argmin(axis=0), np.arange(len(points))
        return labels, (length[piece, each] + share[piece, each] * np.sqrt(square[piece, each])) / length[-1]

    def decode(self, labels, shares):
        path, length = self.leaves(labels)
        wanted, each = shares * length[-1], np.arange(len(labels))
        piece = np.clip((length <= wanted).sum(axis=0) - 1, 0, len(path) - 2)
        begin, end = length[piece, each], length[piece + 1, each]
        share = (wanted - begin) / np.where(end > begin, end - begin, 1)
        return path[piece, each] + share[:, None] * (path[piece + 1, each] - path[piece, each])


def conforming_rings(outlines, trees, bones, cells):
    """Both shapes, cut alike; bones that are no edges of a mesh are cut finer."""
    steps = [np.ptp(outline, axis=0).max() / cells for outline in outlines]

    def pieces(places, edges):
        return np.max([np.ceil(np.hypot(*(p[edges[:, 1]] - p[edges[:, 0]]).T) / step) for p, step in zip(places, steps)],
                      axis=0).astype(int)

    n = len(outlines[0])
    ring = np.column_stack([np.arange(n), np.roll(np.arange(n), -1)])
    n_pieces = pieces(trees, bones)
    for _ in range(12):
        both = []
        try:
            for outline, joints, step in zip(outlines, trees, steps):
                points, edges = cut(outline, ring, pieces(outlines, ring))
                both.append(Ring(points[edges[:, 0]], *cut(joints, bones, n_pieces), step))
            return both
        except NotConforming as fault:
            n_pieces[np.unique(np.repeat(np.arange(len(bones)), n_pieces)[fault.args[0]])] *= 2
    raise SystemExit("bones are no edges of the meshes: use more cells")


def rings(outlines, trees, bones, cells):
    """Both shapes, with psi that is the same on their rims."""
    both = conforming_rings(outlines, trees, bones, cells)
    if not np.array_equal(both[0].owner, both[1].owner):
        raise ValueError("the bones do not leave their joints in the same order in both shapes")
    flux = (both[0].flux() + both[1].flux()) / 2
    outer = np.concatenate([[0], np.cumsum(flux)[:-1]])
    alone = [r.along_slit(r.harmonic(outer)) for r in both]
    turns = np.rint((alone[1] - alone[0]).mean())
    inner = (alone[0] + alone[1] - turns) / 2
    for r, more in zip(both, (0, turns)):
        r.label(outer, inner + more)
    return both


# ---- what it is tried on


def letter():
    source = [(0, 0), (3, 0), (3, 1), (1, 1), (1, 2), (2.6, 2), (2.6, 3), (1, 3), (1, 4), (3, 4), (3, 5), (0, 5)]
    target = [(0, .3), (2.9, -1), (3.3, 0), (1, 1.3), (1, 2), (2.6, 2.5), (2.3, 3.4), (1, 3), (1, 4), (2.2, 5.6), (1.4, 6.3),
              (0, 5)]
    trees = ([(.5, .5), (.5, 2.5), (.5, 4.5), (2.5, .5), (2.1, 2.5), (2.5, 4.5)],
             [(.5, .75), (.5, 2.5), (.5, 4.45), (2.7, -.25), (2.1, 2.85), (1.55, 5.7)])
    return (source, target), trees, [(0, 1), (1, 2), (0, 3), (1, 4), (2, 5)]


def frog():
    trees = []
    for ways in ((-40, 1.1), (20, .8), (160, .8), (220, 1.1)), ((30, 1.6), (75, 1.1), (215, .9), (275, 1.8)):
        joints = [(0, -.65), (0, .45)]
        for (x, y), (degrees, length) in zip(((.7, -.8), (.8, .6), (-.8, .6), (-.7, -.8)), ways):
            way = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
            joints += [(x, y) - .1 * way, (x, y) + length * way]
        trees.append(joints)
    return shapes.frog(), trees, [(0, 1), (0, 2), (2, 3), (1, 4), (4, 5), (1, 6), (6, 7), (0, 8), (8, 9)]


def medial_bones(outline, end=.2, near=.5, bend=.08):
    """A simple medial axis: its limbs lack `end` of the longest way from its middle, bones are no shorter than `near` radii,
    and straight to `bend` radii."""
    centres, radii, neighbours = open_questions.medial_tree(outline)
    root = int(radii.argmax())
    came, order = {root: root}, [root]
    for t in order:
        for other in neighbours[t]:
            if other not in came:
                came[other] = t
                order.append(other)
    reach = radii.copy()
    for t in order[:0:-1]:
        reach[came[t]] = max(reach[came[t]], reach[t] + np.hypot(*(centres[t] - centres[came[t]])))
    kept = {root}
    kept.update(t for t in order if reach[t] > end * reach[root])
    children = {t: [other for other in neighbours[t] if other in kept and came[other] == t] for t in kept}
    joints, bones, left = [centres[root]], [], [(root, 0)]
    while left:
        top, joint = left.pop()
        for child in children[top]:
            chain, last = [top, child], joint
            while len(children[chain[-1]]) == 1:
                chain += children[chain[-1]]
            at, limit = 0, bend * radii[chain]
            while at + 1 < len(chain):
                to = next(k for k in range(len(chain) - 1, at, -1)
                          if k == at + 1 or is_straight(centres[chain[at:k + 1]], limit[k]))
                if np.hypot(*(centres[chain[to]] - joints[last])) > near * radii[chain[to]]:
                    bones.append((last, len(joints)))
                    last = len(joints)
                    joints.append(centres[chain[to]])
                at = to
            left.append((chain[-1], last))
    return np.array(joints), np.array(bones)


def is_straight(chain, limit):
    way = chain[-1] - chain[0]
    return abs(compare.baselines.cross(chain - chain[0], way)).max() <= limit * np.hypot(*way)


def carried(outlines):
    """The first shape's medial axis, and where libicc's map takes it."""
    joints, bones = medial_bones(outlines[0])
    length = np.hypot(*(joints[bones[:, 1]] - joints[bones[:, 0]]).T)
    joints, bones = cut(joints, bones, np.ceil(24 * length / np.ptp(outlines[0], axis=0).max()).astype(int))
    return outlines, (joints, libicc.Map(*outlines)(joints)), bones


def energies(points, triangles, images):
    """The symmetric Dirichlet energy of each triangle, 4 where it is only moved."""
    sides = [np.stack([p[triangles[:, k]] - p[triangles[:, 0]] for k in (1, 2)], axis=-1) for p in (points, images)]
    jacobian = sides[1] @ np.linalg.inv(sides[0])
    return (jacobian ** 2).sum(axis=(1, 2)) * (1 + 1 / np.linalg.det(jacobian) ** 2)


def compare_maxima(outlines, source, target):
    """Images of the source's mesh, from a map whose curves end on the tree, and from one where they end at a point."""
    images = np.vstack([target.points[:target.n_rims], target.decode(*source.encode(source.points[source.n_rims:]))])
    to_point = libicc.Map(*outlines, kind="curves", method="foliation")
    others = np.vstack([target.points[:target.n_outer], to_point(source.points[source.n_outer:])])
    bones = slice(source.n_outer, source.n_rims)
    for name, places in (("tree", images), ("point", others)):
        median, most = np.percentile(energies(source.points, source.triangles, places), (50, 90))
        off = np.hypot(*(places[bones] - target.points[bones]).T).max()
        print(f"  {name:6} energy {median:.2f}, of nine in ten triangles at most {most:.2f};"
              f" bones off by {100 * off / np.ptp(outlines[1], axis=0).max():.1f} % of the size")


# ---- a picture


def draw(name, rows):
    """For each shape the source, and where both maps take its leaves, and what lies across them."""
    side, gap = 260, 14
    with open(name, "w", encoding="utf-8") as out:
        width, height = 3 * (side + gap) + gap, len(rows) * (side + gap) + gap
        out.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}">'
                  '<rect width="100%" height="100%" fill="white"/>\n')
        for j, (source, target, lines, others) in enumerate(rows):
            for i, (ring, each) in enumerate(((source, lines[0]), (target, lines[1]), (target, others))):
                low, size = ring.points.min(axis=0), np.ptp(ring.points, axis=0).max()

                def path(points, look, low=low, size=size, i=i, j=j):
                    places = (points - low) / size * side
                    places = np.column_stack([gap + i * (side + gap) + places[:, 0], (j + 1) * (side + gap) - places[:, 1]])
                    out.write(f'<path fill="none" {look} d="M' + "L".join(f"{x:.1f} {y:.1f}" for x, y in places) + '"/>\n')

                for line in each:
                    path(line[np.isfinite(line).all(axis=1)], 'stroke="#478" stroke-width=".6"')
                n = ring.n_outer
                path(ring.points[[*range(n), 0]], 'stroke="black" stroke-width="1.2"')
                path(ring.points[[*range(n, ring.n_rims), n]], 'stroke="#d22" stroke-width="2"')
        out.write("</svg>\n")


def lines_of(outlines, source, target):
    """Leaves, and lines of equal shares, in the source and their images by both maps."""
    leaf, share = np.arange(72) * (TURN // 72) + TURN // 144, np.linspace(0, 1, 41)
    across = np.arange(0, TURN, TURN // 720)
    grids = [(np.full(41, k), share) for k in leaf] + [(across, np.full(len(across), t)) for t in (.2, .4, .6, .8)]
    lines = [[ring.decode(*grid) for grid in grids] for ring in (source, target)]
    to_point = libicc.Map(*outlines, kind="curves", method="foliation")
    return lines, [to_point(line) for line in lines[0]]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--cells", type=int, default=32, help="of the meshes, along the longest side (default: 32)")
    parser.add_argument("out", nargs="?", metavar="OUT.svg")
    options = parser.parse_args()
    rows = []
    for title, (outlines, trees, bones) in (("letter", letter()), ("frog", frog()),
                                            ("frog, medial axis", carried(shapes.frog())),
                                            ("three legs, medial axis", carried(shapes.tripus()))):
        outlines, trees = ([np.asarray(places, float) for places in pair] for pair in (outlines, trees))
        source, target = rings(outlines, trees, np.array(bones), options.cells)
        print(f"{title}: {len(source.triangles)} and {len(target.triangles)} triangles")
        if source.faults() + target.faults() > 0:
            raise SystemExit("these leaves are not one-to-one")
        compare_maxima(outlines, source, target)
        if options.out is not None:
            rows.append((source, target, *lines_of(outlines, source, target)))
    if options.out is not None:
        draw(options.out, rows)


if __name__ == "__main__":
    main()
