#!/usr/bin/env python3
"""How fast the command moves a layer of points, lines or polygons, and a text of points: megabytes of input for each
processor second, the best of three runs. The start of the program and the making of the map count.

usage: bench_layer.py LIBICC"""
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile

N_VERTICES = 60  # of the cage, a flower whose leaves turn
N_POSITIONS = 600000
N_SIDES = 100  # of a line or polygon


def cage(turn):
    """A flower with the given turn of its leaves, one vertex per line."""
    lines = []
    for i in range(N_VERTICES):
        angle = 2 * math.pi * i / N_VERTICES
        radius = 1000 * (1 + 0.15 * math.sin(5 * angle + turn))
        lines.append(f"{500000 + 1.1 * radius * math.cos(angle):.3f} {4000000 + radius * math.sin(angle):.3f}\n")
    return "".join(lines)


def place(rng):
    angle, radius = rng.uniform(0, 2 * math.pi), 700 * math.sqrt(rng.random())
    return 500000 + radius * math.cos(angle), 4000000 + radius * math.sin(angle)


def line(rng):
    x, y = place(rng)
    path = []
    for _ in range(N_SIDES):
        x, y = x + rng.gauss(0, 1), y + rng.gauss(0, 1)
        path.append(f"[{x:.3f},{y:.3f}]")
    return "[" + ",".join(path) + "]"


def ring(rng):
    (x, y), size = place(rng), rng.uniform(10, 40)
    path = []
    for i in range(N_SIDES):
        angle = 2 * math.pi * i / N_SIDES
        radius = size * (1 + 0.2 * math.sin(7 * angle))
        path.append(f"[{x + radius * math.cos(angle):.3f},{y + radius * math.sin(angle):.3f}]")
    return "[[" + ",".join(path + path[:1]) + "]]"


def layer(kind, n, shape):
    features = (f'{{"type":"Feature","properties":{{"id":{i}}},"geometry":{{"type":"{kind}","coordinates":{shape()}}}}}'
                for i in range(n))
    return '{"type":"FeatureCollection","features":[\n' + ",\n".join(features) + "\n]}\n"


def seconds(command):
    """Processor seconds of a program."""
    before = os.times()
    subprocess.run(command, check=True)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def main():
    rng = random.Random(1)
    folder = pathlib.Path(tempfile.mkdtemp())
    inputs = {"text": "".join("{:.6f} {:.6f}\n".format(*place(rng)) for _ in range(N_POSITIONS)),
              "points": layer("Point", N_POSITIONS // 3, lambda: "[{:.3f},{:.3f}]".format(*place(rng))),
              "lines": layer("LineString", N_POSITIONS // N_SIDES, lambda: line(rng)),
              "polygons": layer("Polygon", N_POSITIONS // N_SIDES, lambda: ring(rng))}
    for name, turn in ("a.txt", 0), ("b.txt", 0.7):
        (folder / name).write_text(cage(turn))
    for name, text in inputs.items():
        (folder / "in").write_text(text)
        files = ["-p", folder / "in", "-o", folder / "out"] if name == "text" else ["--geojson", folder / "in",
                                                                                   folder / "out"]
        command = [sys.argv[1], "map", "-q", "-s", folder / "a.txt", "-t", folder / "b.txt", *files]
        best = min(seconds(command) for _ in range(3))
        print(f"{name}: {len(text) / 1e6:.0f} MB, {best:.2f} s, {len(text) / 1e6 / best:.0f} MB/s")
    for path in folder.iterdir():
        path.unlink()
    folder.rmdir()


if __name__ == "__main__":
    main()
