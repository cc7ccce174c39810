#!/usr/bin/env python3
"""Makes an invented parish: the scan of an old map sheet, and what a new survey found, for libicc's documentation.

    python3 examples/cadastre.py FOLDER      writes sheet.png, parish.geojson and parcels.geojson

The sheet was drawn in feet of 0.3 m and lies askew, its paper has shrunk by 0.4 % in one direction, and its makers erred
by ten metres, here to this side, there to that. It was scanned at two feet a pixel; pixels count downwards. The new
coordinates are metres of EPSG:2056. Boundary stones, and four marks inside, are known in both.
"""

import json
import struct
import sys
import zlib
from math import cos, hypot, pi, sin

FOOT, SHRUNK, ASKEW = 0.3, 0.996, 0.12
WIDTH, HEIGHT = 1420, 1080    # of the scan


def surveyed(x, y):
    """Where a place of the sheet is."""
    e, n = FOOT * x / SHRUNK, FOOT * y
    e, n = e + 12 * sin(n / 90) + 3 * sin(e / 37), n + 10 * sin(e / 70 + 1)
    return [round(2683100 + cos(ASKEW) * e - sin(ASKEW) * n, 2), round(1247300 + sin(ASKEW) * e + cos(ASKEW) * n, 2)]


def pixel(x, y):
    """Where a place of the sheet is in the scan."""
    return [round(x / 2, 2), round(HEIGHT - y / 2, 2)]


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


def drawn(lines, marks):
    """The scan: rows of grey bytes."""
    rows = [bytearray(238 - (3 * x + 5 * y) // 7 % 9 for x in range(WIDTH)) for y in range(HEIGHT)]

    def dot(x, y, radius, shade):
        for j in range(int(y - radius), int(y + radius) + 2):
            for i in range(int(x - radius), int(x + radius) + 2):
                if hypot(i + .5 - x, j + .5 - y) <= radius and 0 <= i < WIDTH and 0 <= j < HEIGHT:
                    rows[j][i] = shade
    for places, radius, shade in lines:
        for (x, y), (u, v) in zip(places, places[1:]):
            steps = int(hypot(u - x, v - y)) + 1
            for k in range(steps + 1):
                dot(x + (u - x) * k / steps, y + (v - y) * k / steps, radius, shade)
    for x, y in marks:
        dot(x, y, 11, 40)
        dot(x, y, 5, 238)
    return rows


def write_png(name, rows):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open(name, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 0, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)) + chunk(b"IEND", b""))


folder = sys.argv[1]
outline = [stone(k) for k in range(20)]
outline.append(outline[0])
marks = {"church": [1330, 1180], "well": [980, 1040], "mill": [1820, 1250], "cross": [1500, 800]}
both = [feature("Polygon", [[pixel(*p) for p in outline]], role="source"),
        feature("Polygon", [[surveyed(*p) for p in outline]], role="target")]
for number, (name, place) in enumerate(marks.items(), 1):
    both += [feature("Point", pixel(*place), role="source", feature=number, name=name),
             feature("Point", surveyed(*place), role="target", feature=number, name=name)]
write(f"{folder}/parish.geojson", both)
rings = {9007199254740993 + 10 * r + c: [pixel(*corner(c + i, r + j)) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))]
         for r in range(5) for c in range(6)}
write(f"{folder}/parcels.geojson", [feature("Polygon", [ring], parcel=number) for number, ring in rings.items()])
write_png(f"{folder}/sheet.png", drawn([([pixel(*p) for p in outline], 3, 40), *((ring, 1.5, 90) for ring in rings.values())],
                                       [pixel(*place) for place in marks.values()]))
