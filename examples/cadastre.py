#!/usr/bin/env python3
"""Makes an invented parish, on an old map sheet and as it was surveyed anew, for libicc's tutorial.

    python3 examples/cadastre.py FOLDER      writes parish.geojson and parcels.geojson

The sheet counts in feet of 0.3 m from its lower left corner and lies askew, its paper has shrunk by 0.4 % in one
direction, and its makers erred by a metre or two, here to this side, there to that. The new coordinates are metres of
EPSG:2056. Boundary stones, and four marks inside, are known in both.
"""

import json
import sys
from math import cos, pi, sin

FOOT, SHRUNK, ASKEW = 0.3, 0.996, 0.023


def surveyed(x, y):
    """Where a place of the sheet is."""
    e, n = FOOT * x / SHRUNK, FOOT * y
    e, n = e + 1.6 * sin(n / 90) + .5 * sin(e / 37), n + 1.2 * sin(e / 70 + 1)
    return [round(2683100 + cos(ASKEW) * e - sin(ASKEW) * n, 2), round(1247300 + sin(ASKEW) * e + cos(ASKEW) * n, 2)]


def stone(k, n=20):
    """The k-th boundary stone on the sheet."""
    turn = 2 * pi * k / n
    r = 900 * (1 + .12 * sin(2 * turn + .4) + .06 * sin(3 * turn) + .03 * sin(5 * turn + 2))
    return [round(1400 + 1.3 * r * cos(turn), 1), round(1100 + r * sin(turn), 1)]


def corner(column, row):
    """A corner of parcels."""
    return [850 + 180 * column + 25 * ((row * 7 + column) % 3), 700 + 160 * row + 20 * ((column * 5 + row) % 4)]


def feature(kind, places, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": places}}


def write(name, features):
    with open(name, "w", encoding="utf-8") as file:
        lines = ",\n".join(json.dumps(f) for f in features)
        file.write('{"type": "FeatureCollection", "features": [\n' + lines + "\n]}\n")


folder = sys.argv[1]
outline = [stone(k) for k in range(20)]
marks = {"church": [1330, 1180], "well": [980, 1040], "mill": [1820, 1250], "cross": [1500, 800]}
both = [feature("Polygon", [outline + outline[:1]], role="source"),
        feature("Polygon", [[surveyed(*p) for p in outline + outline[:1]]], role="target")]
for number, (name, place) in enumerate(marks.items(), 1):
    both += [feature("Point", place, role="source", feature=number, name=name),
             feature("Point", surveyed(*place), role="target", feature=number, name=name)]
write(f"{folder}/parish.geojson", both)
parcels = [feature("Polygon", [[corner(c, r), corner(c + 1, r), corner(c + 1, r + 1), corner(c, r + 1), corner(c, r)]],
                   parcel=9007199254740993 + 10 * r + c) for r in range(5) for c in range(6)]
write(f"{folder}/parcels.geojson", parcels)
