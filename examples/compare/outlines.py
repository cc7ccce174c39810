#!/usr/bin/env python3
"""How the functions of the papers' method do on twenty outlines: letters, limbs, figures, coasts of 200 to 15,000 vertices.
Prints what docs/performance.md says of expansion edges, and how much of the coordinates collapses and is not covered.

    python3 examples/compare/outlines.py [--cells N] [FUNCTION..]

Needs libicc for Python and NumPy.
"""

import argparse

import libicc
import numpy as np
import shapes
from libicc import stages

KINDS = (("decay", None), ("distance", None), ("laplace", "all"), ("laplace", "none"), ("harmonic", "none"),
         ("bilaplace", "all"), ("bilaplace", "none"))


def stroke(path, width):
    """The outline of a pen that is drawn along a path with mitred corners."""
    path = np.asarray(path, float)
    ways = np.diff(path, axis=0)
    ways /= np.hypot(*ways.T)[:, None]
    aside = np.column_stack([-ways[:, 1], ways[:, 0]])
    before, after = np.vstack([aside[:1], aside]), np.vstack([aside, aside[-1:]])
    shift = width / 2 * (before + after) / (1 + (before * after).sum(axis=1))[:, None]
    return np.vstack([path - shift, (path + shift)[::-1]])


def polar(radius):
    angle = 2 * np.pi * np.arange(len(radius)) / len(radius)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def coast(n, seed):
    """A radius that is the rougher the closer one looks, as coasts are."""
    random = np.random.default_rng(seed)
    angle = 2 * np.pi * np.arange(n) / n
    radius = np.ones(n)
    for wave in 2 ** np.arange(1, int(np.log2(n / 4))):
        height, phase = random.uniform(-.22, .22) * wave ** -.8, random.uniform(0, 2 * np.pi)
        radius += height * np.cos(wave * angle + phase)
    return polar(radius)


def bone():
    angle = np.radians(np.arange(-140, 141, 20))
    knob = .5 * np.column_stack([np.cos(angle), np.sin(angle)])
    return np.vstack([knob + (2, .1), -knob - (2, -.1)])


def outlines():
    ring = np.radians(np.arange(40, 321, 20))
    snake = np.linspace(0, 3 * np.pi, 40)
    return {
        "L": [(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)],
        "T": [(1, 0), (2, 0), (2, 2), (3, 2), (3, 3), (0, 3), (0, 2), (1, 2)],
        "C": stroke(np.column_stack([np.cos(ring), np.sin(ring)]), .6),
        "E": [(0, 0), (3, 0), (3, .7), (.8, .7), (.8, 1.5), (2.5, 1.5), (2.5, 2.1), (.8, 2.1), (.8, 3), (3, 3), (3, 3.6), (0, 3.6)],
        "S": stroke([(3, 3), (1, 3), (.2, 2.2), (1, 1.5), (2, 1.4), (2.8, .8), (2, 0), (0, 0)], .5),
        "U": stroke([(0, 4), (0, .5), (.5, 0), (1.5, 0), (2, .5), (2, 4)], .3),
        "plus": [(1, 0), (2, 0), (2, 1), (3, 1), (3, 2), (2, 2), (2, 3), (1, 3), (1, 2), (0, 2), (0, 1), (1, 1)],
        "arrow": [(0, .7), (3, .6), (2.8, 0), (5, 1), (2.8, 2), (3, 1.4), (0, 1.3)],
        "bone": bone(),
        "comb": [p for i in range(8) for p in ((1.1 * i, 0), (1.1 * i + .8, 0), (1.1 * i + .8, 3), (1.1 * i + 1.1, 3))][:-1] + [(8.5, 4), (0, 4)],
        "snake": stroke(np.column_stack([snake, 1.5 * np.sin(snake)]), .5),
        "flower": polar(1 + .4 * np.cos(7 * 2 * np.pi * np.arange(140) / 140)),
        "spiral": shapes.long_thin()[1],
        "frog": shapes.frog()[1],
        "star": np.loadtxt(shapes.DATA / "star.txt"),
        "butterfly": np.loadtxt(shapes.DATA / "butterfly.txt"),
        "three legs": shapes.tripus()[1],
        "cat": np.loadtxt(shapes.DATA / "chelsea.src.txt"),
        "coast of 1,000": coast(1000, 1),
        "coast of 15,000": coast(15000, 2)}


def edges(chart):
    """Numbers of expansion edges, of those between two triangles inside, and of compression edges."""
    function = stages.Function.of(chart)
    grid = function.tree.grid
    inside, row = np.asarray(grid.inside).ravel(order="F").astype(bool), grid.shape[0]
    ends, kinds = function.edges()
    low, high = np.sort(ends[kinds == 2].astype(np.int64), axis=1).T
    step = high - low
    first = np.where(step == 1, low - row, np.where(step == row, low - 1, low + 1))
    second = np.where(step == row + 1, low + row, low + row + 1)
    within = inside[low] & inside[high] & inside[first] & inside[second]
    return len(low), int(within.sum()), int((kinds == 1).sum())


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--cells", type=int, default=50, help="of the grid, along the longest side (default: 50)")
    parser.add_argument("functions", nargs="*", help="only these")
    options = parser.parse_args()
    cells, drawn = options.cells, outlines()
    print(f"{len(drawn)} outlines, {cells} cells; in percent: least, median, most")
    print(f"{'':22}{'expansion':>10}{'inside':>8}{'compression':>13}{'collapsed':>14}{'uncovered':>14}")
    for function, constraints in KINDS:
        if options.functions and function not in options.functions:
            continue
        counts, collapsed, uncovered = np.zeros(3, int), [], []
        for outline in drawn.values():
            chart = libicc.Chart(outline, method="gradient", function=function, constraints=constraints, cells=cells)
            report = chart.report()
            counts += edges(chart)
            collapsed.append(100 * report.collapsed)
            uncovered.append(100 * report.uncovered)
        shares = "".join("{:5.0f}{:4.0f}{:5.0f}".format(*np.quantile(x, [0, .5, 1])) for x in (collapsed, uncovered))
        name = function + {"all": ", constrained", "none": ", unconstrained", None: ""}[constraints]
        print(f"{name:24}{counts[0]:8}{counts[1]:8}{counts[2]:13}{shares}")


if __name__ == "__main__":
    main()
