#!/usr/bin/env python3
"""Where curves merge in two, three and four dimensions: shares of compression and expansion facets, and what curves lose.
Prints the table of docs/theory/gradient.md.

    python3 examples/compare/facets.py [--quick] [BODY..]

Needs libicc for Python and NumPy.
"""

import argparse

import libicc
import numpy as np
import shapes
from libicc import stages

FUNCTIONS = (("decay", None), ("distance", None), ("laplace", "none"), ("laplace", "all"), ("harmonic", "none"),
             ("harmonic", "all"), ("bilaplace", "none"), ("bilaplace", "all"))


def cells(*taken):
    """A body of cells that are 1 wide, given by their indices."""
    taken = np.array(taken)
    mask = np.zeros(taken.max(axis=0) + 1, bool)
    mask[tuple(taken.T)] = True
    return libicc.Domain.from_mask(mask)


def sphere(n):
    """The vertices and triangles of a cube's surface, n squares along each edge, moved to a sphere.

    Coordinates are rounded, because the last bits of NumPy's functions differ between processors.
    """
    square = [(i, j) for i in range(n) for j in range(n)]
    number, vertices, triangles = {}, [], []
    for axis in range(3):
        for side in (0, n):
            for i, j in square:
                corners = []
                for a, b in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)):
                    key = tuple(np.roll((side, a, b), axis))
                    if key not in number:
                        number[key] = len(vertices)
                        vertices.append(np.tan(np.pi / 4 * (2 * np.array(key) / n - 1)))
                    corners.append(number[key])
                a, b, c, d = corners if side == n else corners[::-1]
                triangles += [(a, b, c), (a, c, d)]
    vertices = np.array(vertices)
    return (vertices / np.linalg.norm(vertices, axis=1)[:, None]).round(9), np.array(triangles)


def ball():
    return libicc.Domain(*sphere(6))


def banana():
    """A long ball that is bent by half a turn."""
    vertices, triangles = sphere(6)
    x, y, z = vertices.T * [[1], [.35], [.35]]
    radius, angle = 1 - z, np.pi / 2 * x
    return libicc.Domain(np.column_stack([radius * np.sin(angle), y, radius * np.cos(angle)]).round(9), triangles)


# How to make a body, cells of the grid along its longest side, and whether its border consists of vertices of the grid.
# Then harmonic is the same as laplace.
BODIES = {
    "2-D three legs": (lambda: libicc.Domain(shapes.tripus()[1]), 50, False),
    "2-D L": (lambda: cells((0, 0), (1, 0), (0, 1)), 50, True),
    "3-D cube": (lambda: cells((0, 0, 0)), 20, True),
    "3-D three cubes": (lambda: cells((0, 0, 0), (1, 0, 0), (0, 1, 0)), 20, True),
    "3-D ball": (ball, 20, False),
    "3-D banana": (banana, 24, False),
    "4-D cube": (lambda: cells((0, 0, 0, 0)), 8, True),
    "4-D three cubes": (lambda: cells((0, 0, 0, 0), (1, 0, 0, 0), (0, 1, 0, 0)), 8, True)}


def inside(function, facets):
    """The share of these facets whose corners all lie inside."""
    return function.tree.grid.inside.ravel(order="F")[facets].all(axis=1).mean() if len(facets) else 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("bodies", nargs="*", metavar="BODY", help=", ".join(BODIES))
    options = parser.parse_args()
    print("in percent                       facets  compression  expansion  inside  collapsed  uncovered")
    for name in options.bodies or BODIES:
        make, n, on_grid = BODIES[name]
        body = make()
        print(f"{name}, {n // 2 if options.quick else n} cells")
        for function, constraints in FUNCTIONS:
            if function == "harmonic" and on_grid:
                continue
            chart = libicc.Chart(body, method="gradient", function=function, constraints=constraints,
                                 cells=n // 2 if options.quick else n)
            of, lost = stages.Function.of(chart), chart.report(500 if options.quick else 5000)
            facets, kinds = of.facets()
            tested = of.facet_report().n_tested
            label = function if constraints is None else f"{function}, {'tree' if constraints == 'all' else 'free'}"
            print(f"  {label:18}{tested:19,}{100 * (kinds == 1).sum() / tested:13.2f}{100 * (kinds == 2).sum() / tested:11.2f}"
                  f"{100 * inside(of, facets[kinds == 2]):8.0f}{100 * lost.collapsed:11.1f}{100 * lost.uncovered:11.2f}")


if __name__ == "__main__":
    main()
