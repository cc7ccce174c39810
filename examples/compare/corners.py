#!/usr/bin/env python3
"""What Laplace's function, with zeros on the boundary itself, leaves uncovered behind re-entrant corners, and what might be done
about it: a plaid grid whose lines come together at them, and an equation that conducts less near them. Beside these, the
singular function itself on an even grid. The way down, the function and, on even grids, both results are libicc's `harmonic`.

A corner of angle a has a share r^(pi / a) of all curves pass nearer than r. On an even grid of spacing h the cells at that
distance lose h / r of them, so h^(pi / a) is lost in all; if the spacing is h r^(1 - m), m < pi / a, it is about h.

    python3 examples/compare/corners.py [--cells N ...] [--turns N] [--shapes NAME ...]

Needs libicc for Python and NumPy.
"""

import argparse

import libicc
import numpy as np
import shapes

SHARE = 0.8  # m, of pi / a
REACH = 0.16  # within which distance lines come together, in sizes of the shape


def corners(outline):
    """The re-entrant corners of an anticlockwise outline, and their angles inside."""
    before, after = outline - np.roll(outline, 1, axis=0), np.roll(outline, -1, axis=0) - outline
    turn = np.arctan2(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1))
    sharp = turn < -np.radians(18)
    return list(zip(outline[sharp], np.pi - turn[sharp]))


def grid_lines(outline, cells, graded):
    size = np.ptp(outline, axis=0).max()
    h, lines = size / cells, []
    for k in (0, 1):
        x = np.linspace(outline[:, k].min() - 2.5 * h, outline[:, k].max() + 2.5 * h, 400001)
        density = np.full(len(x), 1 / h)
        for corner, angle in corners(outline) if graded else ():
            m, reach = SHARE * np.pi / angle, REACH * size
            r = np.maximum(abs(x - corner[k]), h ** (1 / m) * reach ** (1 - 1 / m))
            density = np.maximum(density, (reach / r) ** (1 - m) / h)
        count = np.append(0, np.cumsum((density[1:] + density[:-1]) / 2 * np.diff(x)))
        lines.append(np.interp(np.linspace(0, count[-1], int(np.ceil(count[-1])) + 1), count, x))
    return lines


def conductance(outline, points):
    """Near a corner r^(1 - (pi / a)^2): then a share r of all curves passes nearer than r."""
    value, size = np.ones(points.shape[:-1]), np.ptp(outline, axis=0).max()
    for corner, angle in corners(outline):
        r = np.linalg.norm(points - corner, axis=-1) / size
        value = np.minimum(value, np.minimum(2 * r, 1) ** (1 - (np.pi / angle) ** 2))
    return value


def moved(array, k, step):
    """Neighbours' entries along an axis: [j, i] of the result is that of the neighbour."""
    return np.roll(array, -step, axis=k)


def find_function(outline, domain, lines, maximum, conduct):
    """Laplace's function with zeros on the boundary, on a grid [y, x] with any lines; the same weights as libicc's harmonic
    where they are even. Beyond the boundary it goes on along lines and planes; NaN elsewhere."""
    points = np.stack(np.meshgrid(*lines), axis=-1)
    inside = domain.locate(points.reshape(-1, 2)).reshape(points.shape[:2]) == libicc.INSIDE
    wide = [np.gradient(line) for line in lines]
    row, weight, beyond, ways = np.zeros(inside.shape), [], [], ((1, 1), (1, -1), (0, 1), (0, -1))
    for k, step in ways:
        other, out = moved(points, k, step), inside & ~moved(inside, k, step)
        share, ends = np.ones(inside.shape), np.array([points[out], other[out]])
        low, high = np.zeros(out.sum()), np.ones(out.sum())
        for _ in range(40):
            middle = (low + high) / 2
            there = domain.locate(ends[0] + middle[:, None] * (ends[1] - ends[0])) == libicc.INSIDE
            low, high = np.where(there, middle, low), np.where(there, high, middle)
        share[out] = np.maximum(high, 1e-6)
        length = abs(other - points)[..., 1 - k] + ~inside
        each = inside * (wide[0] if k == 0 else wide[1][:, None]) / length
        each *= conductance(outline, (points + other) / 2) if conduct else 1
        row += each / share
        weight.append(np.where(moved(inside, k, step), each, 0))
        beyond.append((out, share))
    row[~inside] = 1
    f = conjugate_gradients(row, weight, ways, np.hypot(*np.moveaxis(points - maximum, -1, 0)).argmin())
    return go_on(np.where(inside, f / f.max(), np.nan), inside, beyond, ways)


def conjugate_gradients(row, weight, ways, root):
    def apply(x):
        return row * x - sum(w * moved(x, *way) for w, way in zip(weight, ways))

    x, rest = np.zeros(row.shape), np.zeros(row.shape)
    rest.flat[root] = 1
    ahead, old = 0, 1
    for _ in range(20000):
        better = rest / row
        new = (rest * better).sum()
        ahead = better + new / old * ahead
        image = apply(ahead)
        step = new / (ahead * image).sum()
        x, rest, old = x + step * ahead, rest - step * image, new
        if new < 1e-26:
            return x
    raise RuntimeError("conjugate gradients do not end")


def go_on(f, inside, beyond, ways):
    """Outside: lines through the function at a neighbour inside and 0 at the boundary; the next layer on lines and planes."""
    total, weight = np.zeros(f.shape), np.zeros(f.shape)
    for (out, share), (k, step) in zip(beyond, ways):
        total -= moved(np.where(out, (1 - share) * f, 0), k, -step)
        weight += moved(np.where(out, share, 0), k, -step)
    with np.errstate(invalid="ignore"):
        first = np.where(weight > 0, total / weight, f)
    far, best = first.copy(), np.full(f.shape, -np.inf)
    for one in ways:
        for other in ways:
            if one[0] == other[0] and one[1] != other[1]:
                continue
            behind = moved(moved(f, *other), *one)
            good = np.isnan(first) & (moved(weight, *one) > 0) & (behind > best)
            beside = moved(first, *other) if one[0] != other[0] else moved(first, *one)
            far, best = np.where(good, moved(first, *one) + beside - behind, far), np.where(good, behind, best)
    return far


def count_uncovered(domain, lines, f, points):
    """The share of the points from which the way down along the gradients of the triangles comes to an edge that both sides
    fall to, before it is outside: where it runs together with others. All points at once, from edge to edge; of a cell's two
    triangles the upper one has sign 1. Edges: 0 the diagonal, 1 upright, 2 level."""
    n = len(points)
    cell = np.stack([np.searchsorted(line, points[:, k]) - 1 for k, line in enumerate(lines)])
    start = np.stack([lines[k][cell[k]] for k in (0, 1)])
    at = (points.T - start) / (np.stack([lines[k][cell[k] + 1] for k in (0, 1)]) - start)
    sign, edge, verdict = np.where(at[1] > at[0], 1, -1), np.full(n, -1), np.zeros(n, int)
    left = np.arange(n)
    for _ in range(20 * sum(f.shape)):
        if len(left) == 0:
            break
        (i, j), upper = cell, sign > 0
        start = np.stack([lines[0][i], lines[1][j]])
        size = np.stack([lines[0][i + 1], lines[1][j + 1]]) - start
        rise = np.stack([np.where(upper, f[j + 1, i + 1] - f[j + 1, i], f[j, i + 1] - f[j, i]),
                         np.where(upper, f[j + 1, i] - f[j, i], f[j + 1, i + 1] - f[j, i + 1])])
        speed = -rise / size ** 2
        inward = sign * np.stack([speed[1] - speed[0], speed[0], -speed[1]])
        distance = np.stack([sign * (at[1] - at[0]), np.where(upper, at[0], 1 - at[0]), np.where(upper, 1 - at[1], at[1])])
        merged = (edge >= 0) & (inward[edge, np.arange(len(edge))] <= 0)
        with np.errstate(divide="ignore", invalid="ignore"):
            time = np.where((inward < 0) & (edge != np.arange(3)[:, None]), np.maximum(distance, 0) / -inward, np.inf)
        edge, time = time.argmin(axis=0), time.min(axis=0)
        at = np.clip(at + np.where(time < np.inf, time, 0) * speed, 0, 1)
        at = np.where(edge == 0, at.mean(axis=0), at)
        at[0], at[1] = np.where(edge == 1, ~upper, at[0]), np.where(edge == 2, upper, at[1])
        gone = domain.locate((start + at * size).T) != libicc.INSIDE
        verdict[left[merged]] = 1
        cell = cell + np.stack([np.where(edge == 1, -sign, 0), np.where(edge == 2, sign, 0)])
        at[0], at[1] = np.where(edge == 1, upper, at[0]), np.where(edge == 2, ~upper, at[1])
        keep = ~merged & ~gone
        left, cell, at, sign, edge = left[keep], cell[:, keep], at[:, keep], -sign[keep], edge[keep]
    return verdict.mean()


def evenly(domain, outline, n):
    """About n points inside."""
    low, high = outline.min(axis=0), outline.max(axis=0)
    points = low + np.outer(np.arange(1, 2 * n + 1), (0.7548776662466927, 0.5698402909980532)) % 1 * (high - low)
    return points[domain.locate(points) == libicc.INSIDE]


def cut_disc():
    wide = np.radians(np.linspace(17, 362, 240))
    return np.array([*zip(np.cos(wide), np.sin(wide)), (0, 0)])


def turned(outline, angle):
    c, s = np.cos(angle), np.sin(angle)
    return outline @ np.array([(c, s), (-s, c)])


def singular(outline, lines):
    """The function at a corner itself, in the disc without a wedge, with its corner at 0."""
    along = outline[(len(outline) - 1) // 2]
    x, y = np.meshgrid(*lines)
    angle = np.arctan2(along[0] * y - along[1] * x, along[0] * x + along[1] * y)
    power = 180 / 345
    return np.hypot(x, y) ** power * np.cos(power * angle)


def measure(outline, cells, turns, way):
    """The share in percent, and how many cells the longer side has; means over some ways to lay the shape on the grid."""
    shares, sizes = [], []
    for turn in range(turns):
        shape = turned(outline, 0.37 + 0.61 * turn)
        domain = libicc.Domain(shape)
        lines = grid_lines(shape, cells, way == "lines")
        sizes.append(max(map(len, lines)) - 5)
        points = evenly(domain, shape, 20000)
        if way == "singular":
            f, points = singular(shape, lines), points[np.hypot(*points.T) < 0.5]
        else:
            maximum = libicc.Chart(shape, method="gradient", function="distance").info.maximum
            f = find_function(shape, domain, lines, maximum, way == "conduct")
        shares.append(count_uncovered(domain, lines, f, points))
    return 100 * np.mean(shares), np.mean(sizes)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cells", type=int, nargs="+", default=[25, 50, 100, 200], help="cells along the longest side")
    parser.add_argument("--turns", type=int, default=4, help="how many ways round each shape is laid on the grid")
    parser.add_argument("--shapes", nargs="+", default=["cut disc", "star", "three legs", "L"])
    asked = parser.parse_args()
    outlines = {"cut disc": cut_disc(), "star": np.loadtxt(shapes.DATA / "star.txt"), "three legs": shapes.tripus()[0],
                "L": np.array([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)], float)}
    titles = {"even": "even grid", "lines": "lines come together", "conduct": "conducts less",
              "singular": "singular function"}
    for name in asked.shapes:
        for way, title in titles.items():
            if way == "singular" and name != "cut disc":
                continue
            rows = [measure(outlines[name], cells, asked.turns, way) for cells in asked.cells]
            rate = np.polyfit(np.log(asked.cells), np.log([share for share, _ in rows]), 1)[0]
            print(f"{name:11}{title:20} uncovered:", *(f"{share:4.1f} ({size:.0f})" for share, size in rows),
                  f"%, as cells^{rate:.1f}", flush=True)


if __name__ == "__main__":
    main()
