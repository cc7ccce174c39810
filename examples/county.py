#!/usr/bin/env python3
"""Makes an invented county, before and after a dam is built, for libicc's tutorial.

    python3 examples/county.py FOLDER      writes county.geojson and county-data.geojson, in kilometres

A lake becomes a reservoir, a pond is drained, the river below the dam becomes a canal, and seven towns move. The
data, roads and two places between towns, are to be carried along.
"""

import json
import sys
from math import cos, pi, sin


def ring(x, y, radius, n, waves, stretch=1.0):
    """Round (x, y), wavy: (how many, how high, where they begin) each."""
    out = []
    for k in range(n):
        turn = 2 * pi * k / n
        r = radius * (1 + sum(high * sin(many * turn + begin) for many, high, begin in waves))
        out.append([round(x + stretch * r * cos(turn), 2), round(y + r * sin(turn), 2)])
    return out


coast = ring(20, 15, 12, 48, [(2, .10, .6), (3, .08, 2.1), (5, .05, .4), (9, .03, 1.3)], 1.45)
lake = ring(15, 14, 1.5, 16, [(2, .25, .3), (3, .10, 1)], 1.3)
pond = ring(27.5, 19, 1.0, 12, [(2, .2, 1)])
reservoir = ring(17.6, 14.2, 4.3, 16, [(2, .2, .3), (3, .08, 1)], 1.35)
drained = ring(27.8, 19.4, 0.35, 12, [(2, .2, 1)])
river = [[17.6, 13.6], [19, 12.2], [20.2, 12.6], [21.4, 11.2], [22.8, 11.4], [24, 9.8], [25.2, 9.6], [26.6, 8.2]]
canal = [[24.6, 12.6], [25.1, 12.0], [25.6, 11.4], [26.0, 10.8], [26.3, 10.1], [26.5, 9.5], [26.6, 8.9], [26.6, 8.2]]
mouth = min(coast, key=lambda place: (place[0] - 26.6) ** 2 + (place[1] - 8.2) ** 2)
river, canal = [lake[15], *river, mouth], [reservoir[15], *canal, mouth]  # from the lake's shore to the sea
towns = {"Alder": ([12, 16.4], [10.2, 18.6]),
         "Birch": ([16.6, 16.2], [16.4, 21.0]), "Cedar": ([19.4, 14.2], [25.4, 14.4]),
         "Elm": ([13.4, 11.6], [11.6, 8.4]), "Fir": ([23.6, 15.4], [27.0, 16.0]), "Hazel": ([28.6, 11.6], [28.8, 12.0]),
         "Larch": ([20.6, 9.6], [21.2, 7.2])}
roads = [["Alder", "Birch", "Fir", "Hazel"], ["Elm", "Larch", "Hazel"], ["Cedar", "Fir"]]


def feature(kind, places, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": places}}


def closed(*rings):
    return [r + r[:1] for r in rings]


def write(name, features):
    with open(name, "w", encoding="utf-8") as file:
        lines = ",\n".join(json.dumps(f) for f in features)
        file.write('{"type": "FeatureCollection", "features": [\n' + lines + "\n]}\n")


folder = sys.argv[1]
both = [feature("Polygon", closed(coast, lake, pond), role="source"),
        feature("Polygon", closed(coast, reservoir, drained), role="target"),
        feature("LineString", river, role="source", feature=1), feature("LineString", canal, role="target", feature=1)]
for number, (town, (before, after)) in enumerate(towns.items(), 2):
    both += [feature("Point", before, role="source", feature=number, name=town),
             feature("Point", after, role="target", feature=number, name=town)]
write(f"{folder}/county.geojson", both)
write(f"{folder}/county-data.geojson",
      [feature("LineString", [towns[town][0] for town in road], name="-".join(road)) for road in roads] +
      [feature("Point", [18, 18.6], name="chapel"), feature("Point", [22, 13.2], name="mill")])
