#!/usr/bin/env python3
"""What Huynh and Gingold leave open, tried out and measured: a plaid grid (thesis, chapter 7), C1 interpolation of the
function that is monotone or not (6.5), the separation of curves that have merged (8), all points of a curve at once (paper, 7),
the centre of the extended grassfire transform (4.1).

    python3 examples/compare/open_questions.py [--cells N]

Needs libicc for Python and NumPy.
"""

import argparse
import time

import libicc
import numpy as np
import shapes
from libicc import stages

# ---- a plaid grid: lines through the corners ----


def spread(values, cells):
    """Different values, rising, to whole numbers that rise, about `cells` from the first to the last."""
    wanted = np.round((values - values[0]) / (values[-1] - values[0]) * cells)
    return np.maximum.accumulate(wanted - np.arange(len(values))) + np.arange(len(values))


def plaid(outline, cells):
    """The outline where a regular grid of spacing 1 runs through its corners: each axis is stretched, piece by piece."""
    lines = [np.unique(outline[:, k]) for k in (0, 1)]
    cells = [round(cells * np.ptp(outline[:, k]) / np.ptp(outline, axis=0).max()) for k in (0, 1)]
    rows = []
    for a, b in zip(outline, np.roll(outline, -1, axis=0)):
        # An edge bends where it crosses a line.
        shares = [0.0]
        for k in (0, 1):
            if a[k] != b[k]:
                crossing = (lines[k] - a[k]) / (b[k] - a[k])
                shares += list(crossing[(crossing > 1e-9) & (crossing < 1 - 1e-9)])
        rows += [(1 - t) * a + t * b for t in np.unique(np.round(shares, 12))]
    rows = np.array(rows)
    return np.column_stack([np.interp(rows[:, k], lines[k], spread(lines[k], cells[k])) for k in (0, 1)])


def wedge(degrees):
    half = np.tan(np.radians(degrees / 2))
    turn = np.radians(17)
    corners = np.array([(0, 0), (1, -half), (1.3, 0), (1, half)])
    return corners @ np.array([(np.cos(turn), np.sin(turn)), (-np.sin(turn), np.cos(turn))])


def compare_plaid(cells):
    print(f"plaid grid, {cells} cells or as many as its lines take: uncovered and collapsed, % (regular -> plaid)")
    star = np.loadtxt(shapes.DATA / "star.txt")
    for name, outline in (("star", star), *((f"wedge of {d} degrees", wedge(d)) for d in (60, 30, 15))):
        bent = plaid(outline, cells)
        lines = int(np.ptp(bent, axis=0).max())
        row = f"  {name:20}{lines:4} cells"
        for function in ("distance", "laplace", "harmonic"):
            pair = [libicc.Chart(shape, method="gradient", function=function, cells=lines).report() for shape in (outline, bent)]
            row += f" | {function} " + ", ".join(
                " -> ".join(f"{100 * getattr(r, member):.1f}" for r in pair) for member in ("uncovered", "collapsed"))
        print(row)


# ---- C1 interpolation ----


def slopes(values, axis, monotone):
    """By central differences, one-sided at the rim; or the harmonic mean of both sides, 0 where these differ in sign."""
    values = np.moveaxis(values, axis, 0)
    step = np.diff(values, axis=0)
    before, after = np.full(values.shape, np.nan), np.full(values.shape, np.nan)
    before[1:], after[:-1] = step, step
    before, after = np.where(np.isnan(before), after, before), np.where(np.isnan(after), before, after)
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = np.where(before * after > 0, 2 * before * after / (before + after), 0) if monotone else (before + after) / 2
    return np.moveaxis(mean, 0, axis)


class Smooth:
    """Cubic in x and in y on each cell whose corners have values, with continuous derivatives."""

    def __init__(self, values, monotone):
        along, across = slopes(values, 0, monotone), slopes(values, 1, monotone)
        mixed = slopes(along, 1, monotone)
        self.tables = np.stack([values, along, across, np.nan_to_num(mixed)])

    def gradient(self, points):
        """NaN outside the cells."""
        cell = np.clip(np.floor(np.nan_to_num(points)).astype(int), 0, np.array(self.tables.shape[1:]) - 2)
        s = (points - cell).T
        value = [((1 + 2 * x) * (1 - x) ** 2, x**2 * (3 - 2 * x), x * (1 - x) ** 2, x**2 * (x - 1)) for x in s]
        slope = [(6 * x * (x - 1), 6 * x * (1 - x), (1 - x) * (1 - 3 * x), x * (3 * x - 2)) for x in s]
        total = np.zeros((2, len(points)))
        for i in (0, 1):
            for j in (0, 1):
                f, fx, fy, fxy = self.tables[:, cell[:, 0] + i, cell[:, 1] + j]
                for k, (x, y) in enumerate(((slope[0], value[1]), (value[0], slope[1]))):
                    total[k] += x[i] * (f * y[j] + fy * y[2 + j]) + x[2 + i] * (fx * y[j] + fxy * y[2 + j])
        return total.T

    def run(self, points, way, limit):
        """Along the gradient by steps of a tenth of a cell; all places after each step. What leaves the cells stays there."""
        places = [points]
        for _ in range(limit):
            middle = places[-1] + way * 0.05 * unit(self.gradient(places[-1]))
            places.append(places[-1] + np.nan_to_num(way * 0.1 * unit(self.gradient(middle))))
        return np.array(places)


def unit(vectors):
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(length > 0, length, 1)


def even_points(outline, n):
    """On the boundary, at equal distances, and the direction there."""
    closed = np.vstack([outline, outline[:1]])
    length = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(closed, axis=0).T))])
    at = (np.arange(n) + 0.5) / n * length[-1]
    edge = np.searchsorted(length, at) - 1
    along = np.diff(closed, axis=0)[edge] / np.diff(length)[edge, None]
    return closed[edge] + (at - length[edge])[:, None] * along, along


def compare_smooth(cells):
    print(f"C1 interpolation, {cells} cells: % of the boundary's length times the share of the way")
    random = np.random.default_rng(1)
    for shape, function in ((s, f) for s in shapes.pairs() for f in ("distance", "laplace")):
        outline = shape[2]
        chart = libicc.Chart(outline, method="gradient", function=function, cells=cells)
        made, report = stages.Function.of(chart), chart.report()
        grid, tree = made.tree.grid, made.tree
        root = np.array(np.unravel_index(tree.root, grid.shape, order="F"))
        points, along = even_points(outline, 1000)
        points = (points - grid.info.origin) / grid.info.spacing
        print(f"  {shape[0]:11}{function:9} linear  collapsed {100 * report.collapsed:5.1f}, does not enter"
              f" {100 * report.not_inward:4.1f}; of the area, behind expansion edges {100 * report.uncovered:4.1f}")
        for name, monotone in (("central", False), ("monotone", True)):
            smooth = Smooth(np.array(made.values), monotone)
            gap = 1e-4
            curve, beside = (smooth.run(points + sign * gap / 2 * along, 1, 30 * cells) for sign in (1, -1))
            is_there = np.hypot(*np.moveaxis(curve - root, -1, 0)) < 1
            steps = np.where(is_there.any(axis=0), is_there.argmax(axis=0), 0)
            at, each = (random.uniform(size=len(points)) * steps).astype(int), np.arange(len(points))
            ahead, aside = unit(curve[at + 1, each] - curve[at, each]), beside[at, each] - curve[at, each]
            apart = np.abs(ahead[:, 0] * aside[:, 1] - ahead[:, 1] * aside[:, 0])[steps > 0] / gap
            print(f"{name:>30}  squeezed to a hundredth {100 * (apart < 1e-2).mean():5.1f},"
                  f" to a ten thousandth {100 * (apart < 1e-4).mean():5.1f}; does not reach the maximum"
                  f" {100 * (steps == 0).mean():4.1f}")


# ---- merged curves ----


def compare_separated(cells):
    print(f"curves that have merged, {cells} cells: triangles of a mesh that is carried along, and images moved apart")
    for name, source, target in shapes.pairs():
        points, _, triangles = libicc.Map(source, source, cells=16).mesh()
        row = f"  {name:11}{len(triangles):5}"
        for function in ("distance", "harmonic"):
            mapping = libicc.Map(source, target, kind="curves", method="gradient", function=function, cells=cells)
            found = [ask(points, triangles)[1] for ask in (mapping.certify, mapping.repair)]
            row += f" | {function} " + " -> ".join(f"{r.n_inverted} inverted, {r.n_flat} flat" for r in found)
        print(row)


# ---- all points of a curve at once ----


def polylines(chart, points, n):
    """n points on the curve of each point, by equal shares of its length from the boundary on; NaN where there is none."""
    curves = np.full((len(points), n, 2), np.nan)
    for i, point in enumerate(points):
        try:
            curve = chart.trace(point)
        except libicc.Error:
            continue
        length = np.concatenate([[0], np.cumsum(np.hypot(*np.diff(curve, axis=0).T))])
        if length[-1] > 0:
            curves[i] = np.column_stack([np.interp(np.linspace(0, 1, n), length / length[-1], curve[:, k]) for k in (0, 1)])
    return curves


def area(corners):
    x, y = np.moveaxis(corners, -1, 0)
    return 0.5 * ((x[:, 2] - x[:, 0]) * (y[:, 3] - y[:, 1]) - (x[:, 3] - x[:, 1]) * (y[:, 2] - y[:, 0]))


def compare_curves(cells):
    print(f"all points of a curve at once, {cells} cells, three legs: curves instead of points")
    source, target = shapes.tripus()
    whole = abs(area(np.array([source[[0, i, i + 1, 0]] for i in range(1, len(source) - 1)]))[()].sum())
    for function in ("distance", "laplace"):
        charts = [libicc.Chart(shape, method="gradient", function=function, cells=cells) for shape in (source, target)]
        exact = libicc.Map.from_charts(*charts, kind="curves")
        for pieces in (8, 32):
            ends = [shapes.finer(shape, pieces) for shape in (source, target)]
            begin = time.process_time()
            curves = [polylines(chart, points, 64) for chart, points in zip(charts, ends)]
            seconds = time.process_time() - begin
            quads = [np.stack([c[:, :-1], np.roll(c, -1, 0)[:, :-1], np.roll(c, -1, 0)[:, 1:], c[:, 1:]], 2).reshape(-1, 4, 2)
                     for c in curves]
            good = ~np.isnan(quads[0]).any((1, 2)) & ~np.isnan(quads[1]).any((1, 2))
            middle = [q[good].mean(axis=1) for q in quads]
            images = exact.apply(middle[0])
            off = np.hypot(*(images - middle[1]).T)
            share = np.abs(area(quads[0][good]))
            known = ~np.isnan(off)
            order = np.argsort(off[known])
            weight = np.cumsum(share[known][order]) / share[known].sum()
            size = np.ptp(target, axis=0).max()
            median, most = (off[known][order][np.searchsorted(weight, q)] / size for q in (0.5, 0.95))
            print(f"  {function:9}{len(ends[0]):5} curves a side, {1e6 * seconds / len(ends[0]) / 2:4.0f} us each: off by"
                  f" {100 * median:.3f} % of the size (median), {100 * most:.2f} % (95 of 100);"
                  f" {100 * share.sum() / whole:.1f} % of the area filled")
        points = middle[0][known][:20000]
        begin = time.process_time()
        exact.apply(points)
        print(f"  {function:9}each point by itself: {1e6 * (time.process_time() - begin) / len(points):.1f} us")


# ---- the extended grassfire's centre


def medial_tree(outline):
    """Circumcentres of the triangles of an outline with many points, their radii, and which triangles are neighbours: about
    the medial axis, and a tree."""
    points = shapes.finer(outline, 8)
    triangles = stages.triangulate(points, len(points)).astype(int)
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    u, v = (ux ** 2 + uy ** 2) / 2 / (ux * vy - uy * vx), (vx ** 2 + vy ** 2) / 2 / (ux * vy - uy * vx)
    offsets = np.column_stack([vy * u - uy * v, ux * v - vx * u])
    sides, near = {}, [[] for _ in triangles]
    for t, corners in enumerate(triangles):
        for k in range(3):
            side = frozenset((corners[k], corners[k - 1]))
            if side in sides:
                near[t].append(sides[side])
                near[sides[side]].append(t)
            sides[side] = t
    return a + offsets, np.hypot(*offsets.T), near


def extended_centre(outline):
    """Fire burns along the medial axis from its ends, each of which catches fire when the boundary's fire gets there: the
    middle of the longest way burns last. Liu, Chambers, Letscher, Ju, Extended grassfire transform, 2011."""
    centres, radii, near = medial_tree(outline)

    def ways_from(start):
        ways, came, queue = {start: radii[start]}, {}, [start]
        for t in queue:
            for other in near[t]:
                if other not in ways:
                    ways[other], came[other] = ways[t] + np.hypot(*(centres[other] - centres[t])), t
                    queue.append(other)
        return ways, came

    def end(ways):
        return max(ways, key=lambda t: ways[t] + radii[t])

    ways, came = ways_from(end(ways_from(0)[0]))
    t = end(ways)
    half = (ways[t] + radii[t]) / 2
    while t in came and ways[came[t]] > half:
        t = came[t]
    share = (half - ways[came[t]]) / (ways[t] - ways[came[t]])
    return (1 - share) * centres[came[t]] + share * centres[t]


def compare_centres(cells):
    print(f"the grassfire's centre and the extended one's, {cells} cells, harmonic: collapsed and uncovered, %")
    star = np.loadtxt(shapes.DATA / "star.txt")
    for name, outline in (("star", star), ("three legs", shapes.tripus()[0]), ("frog", shapes.frog()[1])):
        row = f"  {name:12}"
        for maximum in (None, extended_centre(outline)):
            chart = libicc.Chart(outline, method="gradient", function="harmonic", cells=cells, maximum=maximum)
            report, (x, y) = chart.report(), chart.info.maximum
            row += f" | ({x:5.2f}, {y:5.2f}) {100 * report.collapsed:5.1f}, {100 * report.uncovered:5.2f}"
        print(row)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cells", type=int, default=100, help="cells along the longest side")
    cells = parser.parse_args().cells
    compare_plaid(cells)
    compare_smooth(cells)
    compare_separated(cells)
    compare_curves(cells)
    compare_centres(cells)


if __name__ == "__main__":
    main()
