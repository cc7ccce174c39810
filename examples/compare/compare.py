#!/usr/bin/env python3
"""libicc beside what the papers compare themselves with: mean value, harmonic, biharmonic, complex (Cauchy, Green)
coordinates, thin-plate splines and a locally injective map (baselines.py), on a square that is pushed in from two sides,
a frog, a long thin shape and the shape with three legs (shapes.py). Triangles that are turned over or flat are counted
exactly: libicc's by icc_map_certify, those of the others by rational numbers where doubles do not decide.

    python3 examples/compare/compare.py [--cells N] [--steps N] [--shapes NAMES] [OUT.svg]

Needs libicc for Python and NumPy.
"""

import argparse
from fractions import Fraction

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


def compare(source, target, cells, steps):
    """The mesh, and for each method its name, the images, the number of folds, how far the boundary is missed and how many
    vertices have no image."""
    points, _, triangles = libicc.Map(source, source, cells=cells).mesh()
    mapping = libicc.Map(source, target)
    images, _ = mapping.repair(points, triangles)
    mesh = baselines.Mesh(points, triangles, images)
    size = np.ptp(target, axis=0).max()
    results = []
    for name, method in baselines.METHODS.items():
        placed = method(mesh, source, target, steps) if name == "injective" else method(mesh, source, target)
        missed = np.hypot(*(placed - images)[mesh.on_boundary].T).max() / size
        results.append((name, placed, folds(placed, mesh.triangles), missed, 0))
    maximum = libicc.Chart(source, method="gradient", cells=100).info.maximum
    papers = libicc.Map(source, target, kind="curves", method="gradient", function="harmonic", cells=100, maximum=maximum,
                        target_maximum=mapping(np.array([maximum]))[0])
    for name, ask in (("papers' method", papers.certify), ("libicc", mapping.repair)):
        placed, certificate = ask(points, triangles)
        results.append((name, placed, certificate.n_inverted + certificate.n_flat, 0.0,
                        certificate.n_no_image))
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
    name, _, n_folds, missed, n_lost = result
    return name, f"misses {100 * missed:.0f} %" if missed > .02 else f"{n_folds + n_lost} folded"


def draw(name, rows):
    """For each shape the source, then each method, five to a line."""
    height = SIDE + 3 * FONT + GAP
    lines = -(-(1 + len(rows[0][2])) // COLUMNS)
    width, total = COLUMNS * (SIDE + GAP) + GAP, len(rows) * lines * height + GAP
    with open(name, "w", encoding="utf-8") as out:
        out.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {total}" font-family="sans-serif"'
                  f' font-size="{FONT}"><rect width="{width}" height="{total}" fill="white"/>\n')
        for j, (title, mesh, results) in enumerate(rows):
            panels = [((title, "at rest"), mesh.points)] + [(caption(result), result[1]) for result in results]
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
    parser.add_argument("--cells", type=int, default=24, help="of the mesh, along the longest side (default: 24)")
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
        for name, _, n_folds, missed, n_lost in results:
            print(f"  {name:15}{n_folds:6} folded" + (f", boundary missed by {100 * missed:.1f} %" if missed > 1e-4 else "")
                  + (f", {n_lost} vertices without image" if n_lost > 0 else ""))
    if options.out is not None:
        draw(options.out, rows)


if __name__ == "__main__":
    main()
