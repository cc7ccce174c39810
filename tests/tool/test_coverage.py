#!/usr/bin/env python3
"""map --geojson of layers whose polygons share sides: random coverages with T-junctions stay coverages, bit by bit.

usage: test_coverage.py LIBICC SCRATCH
Needs the standard library only. With SciPy and Shapely it also maps Voronoi cells, and measures overlaps and gaps.
"""
import collections
import json
import os
import random
import shutil
import subprocess
import sys

TOOL, SCRATCH = os.path.abspath(sys.argv[1]), sys.argv[2]
SIZE = 100
N_FAILED = 0


def complain(text):
    global N_FAILED
    N_FAILED += 1
    print("FAILED:", text, file=sys.stderr)


def run(expected, *words, text=None):
    got = subprocess.run([TOOL, *words], input=text, capture_output=True, text=True)
    if got.returncode != expected:
        complain(f"exit {got.returncode} instead of {expected}: libicc {' '.join(words)}\n    {got.stderr}")
    return got


def write(name, features):
    with open(name, "w") as out:
        json.dump({"type": "FeatureCollection", "features": features}, out)


def feature(kind, coordinates, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": coordinates}}


# --- random inputs ---------------------------------------------------------------------------------------------------

def closed(ring):
    return [*map(list, ring), list(ring[0])]


def cages(dice, frame, n_points, amount):
    """A frame and points in it, and both moved a little."""
    def near(p):
        return [x + dice.gauss(0, amount) for x in p]
    points = [[dice.uniform(.05, .95) * SIZE for _ in range(2)] for _ in range(n_points)]
    write("cages.geojson", [feature("Polygon", [closed(ring)], role=role) for role, ring in
                            (("source", frame), ("target", [near(p) for p in frame]))] +
          [feature("Point", at, role=role, feature=i) for i, p in enumerate(points, 1)
           for role, at in (("source", p), ("target", near(p)))])


def cut(polygon, a, b):
    """The parts of a convex polygon on both sides of the line a b."""
    side = [(b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]) for p in polygon]
    parts = [], []
    for i, p in enumerate(polygon):
        parts[side[i] < 0].append(p)
        k = (i + 1) % len(polygon)
        if side[i] * side[k] < 0:
            s = side[i] / (side[i] - side[k])
            at = tuple(x + s * (y - x) for x, y in zip(p, polygon[k]))
            parts[0].append(at)
            parts[1].append(at)
    return parts


def parcels(dice, n):
    """A square cut n times: where a cut ends on the side of a neighbour, that one has no vertex."""
    cells = [[(0., 0.), (SIZE, 0.), (SIZE, SIZE), (0., SIZE)]]
    while len(cells) <= n:
        cell = max(cells, key=area)
        centre = [sum(x) / len(cell) for x in zip(*cell)]
        parts = cut(cell, centre, [x + dice.gauss(0, 1) for x in centre])
        if min(map(area, parts)) > area(cell) / 4:
            cells.remove(cell)
            cells += parts
    return cells


def voronoi(dice, n):
    from scipy.spatial import Voronoi
    points = [[SIZE * dice.random(), SIZE * dice.random()] for _ in range(n)]
    around = [p for x, y in points for p in ([x, y], [-x, y], [x, -y], [2 * SIZE - x, y], [x, 2 * SIZE - y])]
    v = Voronoi(around)
    cells = [[tuple(v.vertices[k]) for k in v.regions[v.point_region[5 * i]]] for i in range(n)]
    return [cell if area(cell) > 0 else cell[::-1] for cell in cells]


# --- what is asked of results ----------------------------------------------------------------------------------------

def area(ring):
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(ring, [*ring[1:], ring[0]])) / 2


def rings_of(name):
    """The outer rings of a file, without their last positions."""
    with open(name) as file:
        shapes = [f["geometry"] for f in json.load(file)["features"] if f["geometry"] is not None]
    shapes = [s for s in shapes if s["type"].endswith("Polygon")]
    polygons = [p for s in shapes for p in ([s["coordinates"]] if s["type"] == "Polygon" else s["coordinates"])]
    return [[tuple(p) for p in polygon[0][:-1]] for polygon in polygons]


def sides_of(rings):
    return collections.Counter(side for r in rings for side in zip(r, [*r[1:], r[0]]) if side[0] != side[1])


def is_coverage(rings, what):
    """Each side has another polygon on its other side, but for those round the whole, which make up one ring."""
    sides = sides_of(rings)
    if max(sides.values()) > 1:
        complain(f"{what}: polygons overlap in {sum(n > 1 for n in sides.values())} sides")
    if min(map(area, rings)) <= 0:
        complain(f"{what}: {sum(area(r) <= 0 for r in rings)} polygons are turned over")
    border = {a: b for a, b in sides if (b, a) not in sides}
    if not border:
        return complain(f"{what}: no border")
    start = at = next(iter(border))
    ring = []
    while at in border:
        ring.append(at)
        at = border.pop(at)
    if at != start or border:
        complain(f"{what}: {len(border)} sides are beside the border: neighbours do not have the same sides")
    total = sum(map(area, rings))
    if abs(total - area(ring)) > 1e-12 * total:
        complain(f"{what}: areas add up to {total!r} within a border of {area(ring)!r}")


def has_no_overlaps(rings, what):
    try:
        from shapely.geometry import Polygon
        from shapely.ops import unary_union
    except ImportError:
        return
    cells = [Polygon(r) for r in rings]
    union = unary_union(cells)
    if union.geom_type != "Polygon" or union.interiors or not all(c.is_valid for c in cells):
        complain(f"{what}: there are gaps, or polygons that cross themselves")
    over = sum(a.intersection(b).area for i, a in enumerate(cells) for b in cells[:i])
    if over > 1e-12 * union.area:
        complain(f"{what}: overlaps of {over}")


def is_exact(rings, back, what):
    """Images of sides: mapped back, the middle between two vertices is in the middle of them."""
    sides = list(sides_of(rings))
    points = [p for a, b in sides for p in (a, b, [(x + y) / 2 for x, y in zip(a, b)])]
    text = "".join("%.17g %.17g\n" % tuple(p) for p in points)
    got = run(0, "map", "-s", "cages.geojson", *back, "--snap", "1e-6", text=text)
    images = [list(map(float, line.split())) for line in got.stdout.splitlines()]
    # Each piece is within a triangle, where the map is linear.
    off = max((abs((a + b) / 2 - m) for i in range(0, len(images), 3) for a, b, m in zip(*images[i:i + 3])), default=1)
    if not off < 1e-9 * SIZE:
        complain(f"{what}: the middle of a side is off by {off}")


def carry(expected, *options):
    run(expected, "map", "-s", "cages.geojson", "--json=report.json", *options,
        "--geojson", "in.geojson", "out.geojson")
    with open("report.json") as file:
        return rings_of("out.geojson"), json.load(file)


def check_layer(cells, what):
    write("in.geojson", [feature("Polygon", [closed(c)], number=i) for i, c in enumerate(cells)])
    for inverse in ([], ["--inverse"]):
        exact, report = carry(0, *inverse)
        is_coverage(exact, what)
        has_no_overlaps(exact, what)
        is_exact(exact, [] if inverse else ["--inverse"], what)
        if not report["exact_lines"] or report["shared_sides"] == 0:
            complain(f"{what}: not taken for a coverage: {report}")
        few, _ = carry(0, *inverse, "--exact", "--tolerance", "0.2")
        is_coverage(few, what + ", tolerance")
        if not sum(map(len, cells)) <= sum(map(len, few)) < sum(map(len, exact)):
            complain(f"{what}: {sum(map(len, few))} vertices with a tolerance, {sum(map(len, exact))} without")


# --- the tests -------------------------------------------------------------------------------------------------------

FRAME = [[-10, -10], [110, -12], [112, 110], [-11, 111]]


def test_coverages():
    for seed in range(6):
        dice = random.Random(seed)
        cages(dice, FRAME, 14, 1)
        check_layer(parcels(dice, 40), f"parcels {seed}")
        try:
            import scipy  # noqa: F401
        except ImportError:
            continue
        check_layer(voronoi(dice, 60), f"cells {seed}")


def test_clipped():
    """Part of the layer is outside: what is cut off leaves a coverage."""
    dice = random.Random(7)
    cages(dice, [[10, 12], [85, 8], [95, 50], [88, 93], [50, 80], [12, 90]], 0, 1.5)
    write("in.geojson", [feature("Polygon", [closed(c)]) for c in parcels(dice, 40)])
    for inverse in ([], ["--inverse"]):
        rings, _ = carry(4, *inverse, "--outside", "clip")
        is_coverage(rings, "clipped")
        has_no_overlaps(rings, "clipped")


def test_noise():
    """Each polygon was drawn by itself: --snap says how far corners may be apart."""
    dice = random.Random(8)
    cages(dice, FRAME, 14, 1)
    cells = [[[x + dice.uniform(-1e-5, 1e-5) for x in p] for p in c] for c in parcels(dice, 40)]
    write("in.geojson", [feature("Polygon", [closed(c)]) for c in cells])
    _, report = carry(0)
    if report["exact_lines"] or report["shared_sides"]:
        complain(f"noise is taken for a coverage: {report}")
    rings, _ = carry(0, "--snap", "1e-4")
    is_coverage(rings, "noise")
    has_no_overlaps(rings, "noise")


def test_others():
    """Lines, heights, polygons in one MultiPolygon; no triangles to cut lines at."""
    dice = random.Random(9)
    cages(dice, FRAME, 14, 1)
    line, corner = [[1, 1, 0], [90, 80, 8]], [20, 20, 5.0]
    write("in.geojson", [feature("LineString", line), feature("Point", corner)])
    if carry(0)[1]["exact_lines"] or not carry(0, "--exact")[1]["exact_lines"]:
        complain("lines alone are exact only with --exact")
    with open("out.geojson") as file:
        exact = json.load(file)["features"][0]["geometry"]["coordinates"]
    heights = [p[2] for p in exact]
    if len(exact) < 4 or heights != sorted(heights) or heights[0] != 0 or heights[-1] != 8:
        complain(f"heights of an exact line: {heights}")
    cells = parcels(dice, 10)
    write("in.geojson", [feature("MultiPolygon", [[closed(c)] for c in cells[:5]], name="\u00e9"),
                         *[feature("Polygon", [closed(c)]) for c in cells[5:]],
                         feature("LineString", closed(cells[0]))])
    rings, _ = carry(0)
    is_coverage(rings, "a MultiPolygon")
    with open("out.geojson") as file:
        road = [tuple(p) for p in json.load(file)["features"][-1]["geometry"]["coordinates"]]
    if road[:-1] != rings[0]:
        complain("a line along the sides of a polygon leaves them")
    write("cages.geojson", [feature("Polygon", [closed(FRAME)], role=role) for role in ("source", "target")])
    rings, report = carry(0, "--map", "curves", "--tolerance", "0.1")
    is_coverage(rings, "a curve map")
    if report["exact_lines"]:
        complain("a curve map is exact")
    got = run(2, "map", "-s", "cages.geojson", "--map", "curves", "--exact", "--geojson", "in.geojson", "out.geojson")
    if "--exact needs the triangles of a mesh map" not in got.stderr:
        complain(got.stderr)
    run(2, "map", "-s", "cages.geojson", "--exact", text="1 1\n")


if __name__ == "__main__":
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    test_coverages()
    test_clipped()
    test_noise()
    test_others()
    os.chdir("/")
    if not N_FAILED:
        shutil.rmtree(SCRATCH)
    sys.exit(N_FAILED > 0)
