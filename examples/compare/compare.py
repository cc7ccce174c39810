#!/usr/bin/env python3
"""libicc beside what the papers compare themselves with: mean value, harmonic, biharmonic, complex (Cauchy, Green)
coordinates, thin-plate splines and a locally injective map (baselines.py), on a square that is pushed in from two sides,
a frog, a long thin shape and the shape with three legs (shapes.py).

Each method gives images to the vertices of the same mesh. It is judged three times: by the triangles that are folded,
which are turned over or flat, counted exactly; by those still folded when one program (baselines.repaired) has moved the
inner vertices; and by its derivatives, as the shares of the area that it turns over and that it collapses.

    python3 examples/compare/compare.py [--cells N] [--steps N] [--shapes NAMES] [OUT.svg]

Needs libicc for Python and NumPy.
"""

import argparse
from fractions import Fraction
from typing import NamedTuple

import baselines
import libicc
import numpy as np
import shapes


def folds(images, triangles):
    """How many triangles are not positively oriented, exactly."""
    corners = images[triangles]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    determinants = baselines.cross(a, b)
    doubtful = abs(determinants) <= 1e-14 * abs(corners).max() * (abs(a) + abs(b)).sum(axis=1)
    wrong = int((determinants[~doubtful] < 0).sum())
    for triangle in corners[doubtful]:
        p, q, r = ([Fraction(float(x)) for x in corner] for corner in triangle)
        wrong += (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) <= 0
    return wrong


class Result(NamedTuple):
    """What a method made of a mesh."""
    name: str
    images: np.ndarray
    folded: int      # triangles as mapped
    repaired: int    # triangles still folded after repair
    inverted: float  # shares of the area by derivatives
    collapsed: float
    missed: float    # how far the boundary is missed, as a share of the size
    lost: int        # vertices without an image


def shares(derivatives, weights):
    """The weighted shares of derivatives that turn over, and that have no area."""
    determinants = np.linalg.det(derivatives)
    flat = abs(determinants) <= 1e-9 * (derivatives ** 2).sum(axis=(1, 2)) + 1e-24
    return weights[~flat & (determinants < 0)].sum() / weights.sum(), weights[flat].sum() / weights.sum()


def differences(method, mesh, source, target, points):
    """A formula's derivatives at points, by central differences."""
    step = 1e-5 * np.ptp(source, axis=0).max()
    moved = np.vstack([points + way for way in (np.array([[step, 0], [-step, 0], [0, step], [0, -step]])[:, None])])
    images = method(baselines.with_points(mesh, moved), source, target)[len(mesh.points):].reshape(4, -1, 2)
    return np.stack([images[0] - images[1], images[2] - images[3]], axis=2) / (2 * step)


def judge(name, mesh, images, missed, derivatives, weights):
    """The result of a method with these images and derivatives."""
    lost = int((~np.isfinite(images).all(axis=1)).sum())
    start = np.where(np.isfinite(images), images, mesh.boundary_images)
    has_all = np.isfinite(images[mesh.triangles]).all(axis=(1, 2))
    return Result(name, images, folds(images, mesh.triangles[has_all]),
                  folds(baselines.repaired(mesh, start), mesh.triangles), *shares(derivatives, weights), missed, lost)


def compare(source, target, cells, steps):
    """The mesh, and the result of each method."""
    points, _, triangles = libicc.Map(source, source, cells=cells).mesh()
    mapping = libicc.Map(source, target)
    mesh = baselines.Mesh(points, triangles, mapping(points))
    inside = np.random.default_rng(3).uniform(source.min(axis=0), source.max(axis=0), (3000, 2))
    inside = inside[libicc.Domain(source).locate(inside) == libicc.INSIDE][:1000]
    even = np.ones(len(inside))
    size = np.ptp(target, axis=0).max()
    results = []
    for name, method in baselines.METHODS.items():
        placed = method(mesh, source, target, steps) if name == "injective" else method(mesh, source, target)
        missed = np.hypot(*(placed - mesh.boundary_images)[mesh.on_boundary].T).max() / size
        by_formula = name in baselines.FORMULAS
        results.append(judge(name, mesh, placed, missed,
                             differences(method, mesh, source, target, inside) if by_formula else mesh.jacobians(placed),
                             even if by_formula else mesh.areas))
    maximum = libicc.Chart(source, method="gradient", cells=100).info.maximum
    same = {"kind": "curves", "maximum": maximum, "target_maximum": mapping(np.array([maximum]))[0]}
    for name, own in (("papers' method", libicc.Map(source, target, method="gradient", function="harmonic", cells=100, **same)),
                      ("leaves", libicc.Map(source, target, **same)), ("libicc", mapping)):
        derivatives = own.jacobian(inside)
        known = np.isfinite(derivatives).all(axis=(1, 2))
        results.append(judge(name, mesh, own(points), 0.0, derivatives[known], even[known]))
    return mesh, results


# ---- a picture

SIDE, GAP, COLUMNS, FONT = 150, 14, 5, 17


def panel(out, mesh, placed, left, top, frame):
    """The triangles in two colours by where they come from; on top, in red, those that are turned over."""
    low, size = frame
    places = (placed - low) / size * SIDE
    places = np.column_stack([left + places[:, 0], top + SIDE - places[:, 1]])
    middle = mesh.points[mesh.triangles].mean(axis=1)
    cells = np.floor(10 * (middle - mesh.points.min(axis=0)) / np.ptp(mesh.points, axis=0).max()).sum(axis=1) % 2
    corners = placed[mesh.triangles]
    turned = ~(baselines.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) > 0)
    for colour, which in (("#bcd", (cells == 0) & ~turned), ("#478", (cells == 1) & ~turned), ("#d22", turned)):
        path = "".join("M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in places[triangle]) + "z"
                       for triangle in mesh.triangles[which] if np.isfinite(places[triangle]).all())
        out.write(f'<path fill="{colour}" stroke="{colour}" stroke-width=".3" d="{path}"/>\n')


def caption(result):
    """The name of a method, and what is wrong with what it made."""
    lines = [result.name, f"{result.folded} folded"]
    if result.missed > .02:
        lines.append(f"misses {100 * result.missed:.0f} %")
    elif result.collapsed > .005:
        lines.append(f"{100 * result.collapsed:.0f} % collapsed")
    return lines


def draw(name, rows):
    """For each shape the source, then each method, five to a line."""
    height = SIDE + 4 * FONT + GAP
    lines = -(-(1 + len(rows[0][2])) // COLUMNS)
    width, total = COLUMNS * (SIDE + GAP) + GAP, len(rows) * lines * height + GAP
    with open(name, "w", encoding="utf-8") as out:
        out.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {total}" font-family="sans-serif"'
                  f' font-size="{FONT}"><rect width="{width}" height="{total}" fill="white"/>\n')
        for j, (title, mesh, results) in enumerate(rows):
            panels = [((title, "at rest"), mesh.points)] + [(caption(result), result.images) for result in results]
            for i, (text, placed) in enumerate(panels):
                around = mesh.points if i == 0 else mesh.boundary_images[mesh.on_boundary]
                low, size = around.min(axis=0), np.ptp(around, axis=0).max()
                left, top = GAP + i % COLUMNS * (SIDE + GAP), GAP + (j * lines + i // COLUMNS) * height
                panel(out, mesh, placed, left, top, (low, size))
                for k, line in enumerate(text):
                    out.write(f'<text x="{left}" y="{top + SIDE + (1.2 + 1.1 * k) * FONT:.0f}">{line}</text>\n')
        out.write("</svg>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--cells", type=int, default=12, help="of the mesh, along the longest side (default: 12)")
    parser.add_argument("--steps", type=int, default=400, help="of the locally injective map (default: 400)")
    parser.add_argument("--shapes", help="parts of the names of shapes, with commas between them (default: all)")
    parser.add_argument("out", nargs="?", metavar="OUT.svg")
    options = parser.parse_args()
    rows = []
    wanted = options.shapes.split(",") if options.shapes else [""]
    for title, source, target in (pair for pair in shapes.pairs() if any(part in pair[0] for part in wanted)):
        mesh, results = compare(source, target, options.cells, options.steps)
        rows.append((title, mesh, results))
        print(f"{title}: {len(mesh.triangles)} triangles")
        print(f"  {'':15}{'folded':>8}{'repaired':>10}{'inverted':>10}{'collapsed':>11}")
        for result in results:
            print(f"  {result.name:15}{result.folded:8}{result.repaired:10}{100 * result.inverted:8.2f} %{100 * result.collapsed:9.1f} %"
                  + (f"  boundary missed by {100 * result.missed:.1f} %" if result.missed > 1e-4 else "")
                  + (f"  {result.lost} vertices without image" if result.lost > 0 else ""))
    if options.out is not None:
        draw(options.out, rows)


if __name__ == "__main__":
    main()
