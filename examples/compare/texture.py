#!/usr/bin/env python3
"""A texture that sparse points carry along, as in the thesis' figures 6.2 to 6.8: the points are mapped, and what lies in a
triangle of them follows its corners. The shape with three legs, by the papers' method at two resolutions, with another
maximum and with the source turned by 45 degrees, beside a foliation.

    python3 examples/compare/texture.py [--points N] [OUT.svg]

Needs libicc for Python and NumPy.
"""

import argparse

import compare
import libicc
import numpy as np
import shapes
from libicc import stages


def spread(outline, wanted):
    """Triangles of the outline and of about so many points of a lattice inside."""
    low, size = outline.min(axis=0), np.ptp(outline, axis=0)
    x, y = outline.T
    area = abs(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2
    step = np.sqrt(area / wanted * 2 / np.sqrt(3))
    columns, rows = np.meshgrid(*(np.arange(side / unit + 1) for side, unit in zip(size, (step, step * np.sqrt(3) / 2))))
    lattice = low + step * np.column_stack([(columns + rows % 2 / 2).ravel(), rows.ravel() * np.sqrt(3) / 2])
    lattice = lattice[libicc.Domain(outline).locate(lattice) == libicc.INSIDE]
    points = np.vstack([outline, [p for p in lattice if np.hypot(*(outline - p).T).min() > .6 * step]])
    return points, stages.triangulate(points, len(outline))


def carry(source, target, points, **options):
    """Images of the points, the outline's first; those that have none are not numbers."""
    mapping = libicc.Map(source, target, kind="curves", **options)
    return np.vstack([target, mapping(points[len(target):])])


def turned(points, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return points @ np.array([(c, s), (-s, c)])


# ---- a picture

SIDE, GAP, PARTS = 240, 12, 6


def parts():
    """A triangle's small triangles, in its barycentric coordinates."""
    for i in range(PARTS):
        for j in range(PARTS - i):
            yield (i, j), (i + 1, j), (i, j + 1)
            if i + j < PARTS - 1:
                yield (i + 1, j), (i + 1, j + 1), (i, j + 1)


def draw(name, points, triangles, rows):
    """The source's chequers, and where each map takes them."""
    small = np.array([[((PARTS - i - j) / PARTS, i / PARTS, j / PARTS) for i, j in part] for part in parts()])
    places = np.einsum("pcb,tbk->tpck", small, points[triangles]).reshape(-1, 3, 2)
    size = np.ptp(points, axis=0).max()
    dark = np.floor(16 * (places.mean(axis=1) - points.min(axis=0)) / size).sum(axis=1) % 2 > 0
    width, height = len(rows) * (SIDE + GAP) + GAP, SIDE + 4 * GAP
    with open(name, "w", encoding="utf-8") as out:
        out.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif"'
                  f' font-size="11"><rect width="{width}" height="{height}" fill="white"/>\n')
        for i, (title, images) in enumerate(rows):
            corners = np.einsum("pcb,tbk->tpck", small, images[triangles]).reshape(-1, 3, 2)
            low, size = np.nanmin(images, axis=0), np.nanmax(np.ptp(images[np.isfinite(images).all(axis=1)], axis=0))
            corners = (corners - low) / size * SIDE
            corners = np.stack([GAP + i * (SIDE + GAP) + corners[..., 0], GAP + SIDE - corners[..., 1]], axis=-1)
            for colour, which in (("#478", dark), ("#dde", ~dark)):
                path = "".join("M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in c) + "z"
                               for c in corners[which & np.isfinite(corners).all(axis=(1, 2))])
                out.write(f'<path fill="{colour}" stroke="{colour}" stroke-width=".3" d="{path}"/>\n')
            out.write(f'<text x="{GAP + i * (SIDE + GAP)}" y="{SIDE + 3 * GAP}">{title}</text>\n')
        out.write("</svg>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--points", type=int, default=673, help="inside (default: 673, as in the thesis' table 6.1)")
    parser.add_argument("out", nargs="?", metavar="OUT.svg")
    options = parser.parse_args()
    source, target = (shapes.finer(outline, 2) for outline in shapes.tripus())
    points, triangles = spread(source, options.points)
    papers = {"method": "gradient", "function": "harmonic"}
    maximum = libicc.Chart(source, cells=50, **papers).info.maximum
    beside = np.array(maximum) + (.06 * np.ptp(source[:, 0]), 0)
    rows = [("source", points)]
    for title, start, more in (("50 cells", 0, {"cells": 50}), ("200 cells", 0, {"cells": 200}),
                               ("another maximum", 0, {"cells": 200, "maximum": beside}),
                               ("turned by 45 degrees", 45, {"cells": 200})):
        rows.append((title, carry(turned(source, start), target, turned(points, start), **papers, **more)))
    rows.append(("foliation", carry(source, target, points, method="foliation")))
    print(f"{len(points)} points, {len(triangles)} triangles; folded or flat, without image, moved from 200 cells in the mean:")
    for title, images in rows[1:]:
        whole = np.isfinite(images[triangles]).all(axis=(1, 2))
        moved = np.nanmean(np.hypot(*(images - rows[2][1]).T)) / np.ptp(target, axis=0).max()
        print(f"  {title:21}{compare.folds(images, triangles[whole]):4}{int((~whole).sum()):4}{100 * moved:7.2f} % of the size")
    if options.out is not None:
        draw(options.out, points, triangles, rows)


if __name__ == "__main__":
    main()
