#!/usr/bin/env python3
"""Makes a torso with lungs, heart, spine and landmarks inside, for libicc's tutorial on solids.

    python3 examples/torso.py FOLDER     writes before.obj, after.obj, landmarks.csv and spine.json

Import it for arrays: torso(lean, breath) gives the body as a dict, upright and breathed out by default. Lengths are
centimetres: x goes to the patient's left, y to the back, z up. No outside data is used.
"""

import json
import sys

import numpy as np

ORGANS = ["left lung", "right lung", "heart"]
LANDMARKS = {"windpipe fork": (0, 1.5, 45.5), "breastbone": (0, -8, 28), "navel": (0, -7.6, 16),
             "left kidney": (6.5, 4, 19), "right kidney": (-6.5, 4, 18)}
# Half widths of the body at some heights: to the side, and to the front and back.
HEIGHTS = [0, 4, 16, 28, 38, 45, 50, 53, 56, 60, 64]
SIDE = [16, 17.5, 14.2, 16, 17.8, 18.8, 19, 16.5, 8.5, 5.8, 6.2]
DEPTH = [10, 11, 9.3, 10.8, 11.8, 10.8, 9, 7.8, 6.5, 6, 6.2]


def ball(steps=3):
    """A ball: the faces of an octahedron, cut into four again and again."""
    vertices = np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], float)
    faces = np.array([(x, y, z) if (x + y + z) % 2 == 0 else (y, x, z) for x in (0, 1) for y in (2, 3) for z in (4, 5)])
    for _ in range(steps):
        edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]], axis=2).reshape(-1, 2)
        edges, middle = np.unique(edges, axis=0, return_inverse=True)
        (a, b, c), (i, j, k) = (middle.reshape(-1, 3) + len(vertices)).T, faces.T
        vertices = np.vstack([vertices, vertices[edges].mean(axis=1)])
        faces = np.vstack([np.column_stack(corners) for corners in ((i, a, c), (a, j, b), (c, b, k), (a, b, c))])
    return vertices / np.linalg.norm(vertices, axis=1)[:, None], faces


def skin(breath, n_around=48, n_rings=33):
    """The outer surface: rings of vertices, closed by two caps. A breath lifts the chest."""
    fine = np.linspace(HEIGHTS[0], HEIGHTS[-1], 257)
    blur = np.hanning(39) / np.hanning(39).sum()
    side, depth = (np.convolve(np.pad(np.interp(fine, HEIGHTS, widths), 19, "edge"), blur, "valid")
                   for widths in (SIDE, DEPTH))
    z = np.linspace(HEIGHTS[0], HEIGHTS[-1], n_rings)
    z = np.concatenate([3 * [z[0]], z, 3 * [z[-1]]])
    share = np.concatenate([[.3, .6, .85], np.full(n_rings, 1.), [.85, .6, .3]])[:, None]
    chest = 1 + .07 * breath * np.exp(-((z - 38) / 11) ** 2)
    angle = 2 * np.pi * np.arange(n_around) / n_around
    rounded = [np.sign(f) * np.abs(f) ** .85 for f in (np.cos(angle), np.sin(angle))]
    x = share * (chest * np.interp(z, fine, side))[:, None] * rounded[0]
    y = share * (chest * np.interp(z, fine, depth))[:, None] * rounded[1]
    rings = np.stack([x, y, np.broadcast_to(z[:, None], x.shape)], axis=-1).reshape(-1, 3)
    k = np.arange(len(rings)).reshape(x.shape)
    right = np.roll(k, -1, axis=1)
    walls = np.concatenate([np.stack([k[:-1], right[:-1], right[1:]], -1), np.stack([k[:-1], right[1:], k[1:]], -1)])
    low, high = np.full(n_around, len(rings)), np.full(n_around, len(rings) + 1)
    caps = np.concatenate([np.column_stack([low, right[0], k[0]]), np.column_stack([high, k[-1], right[-1]])])
    return np.vstack([rings, [[0, 0, z[0]], [0, 0, z[-1]]]]), np.concatenate([walls.reshape(-1, 3), caps])


def heart_frame(breath):
    """The heart's middle and half axes. With a breath it sinks and turns upright."""
    tilt = np.radians(42 - 9 * breath)
    long = np.array([np.sin(tilt), -.25, -np.cos(tilt)])
    long /= np.linalg.norm(long)
    across = np.cross([0, 1, 0], long)
    across /= np.linalg.norm(across)
    return np.array([1.6, -2.6, 36.5 - 2 * breath]), np.stack([6.3 * long, 4.5 * across, 4.2 * np.cross(long, across)])


def heart(breath):
    """An egg, narrow at its lower end."""
    vertices, faces = ball(3)
    middle, axes = heart_frame(breath)
    vertices = vertices * np.column_stack([np.ones(len(vertices)), *2 * [1 - .28 * vertices[:, 0]]])
    return middle + vertices @ axes, faces


def lung(side, breath):
    """A lung: narrow on top, hollow below, and pushed aside by the heart. A breath makes it larger and longer.

    `side` is 1 for the left lung and -1 for the right one.
    """
    p, faces = ball(3)
    x, y, z = np.sign(p.T) * np.abs(p.T) ** .85
    narrow = 1 - .3 * z
    hollow = np.where(z < 0, .42 * (1 - x**2 - y**2).clip(0), 0)
    size = 1 + .08 * breath
    places = np.column_stack([side * (9.4 + 4.8 * size * narrow * x), .5 + 7 * size * narrow * y,
                              38.8 - 2 * breath + 12.3 * (1 + .16 * breath) * z * (1 - hollow)])
    middle, axes = heart_frame(breath)
    from_heart = (places - middle) @ np.linalg.inv(axes)
    far = np.linalg.norm(from_heart, axis=1)[:, None]
    return middle + from_heart * ((far ** 6 + 1.15 ** 6) ** (1 / 6) / far) @ axes, faces[:, ::side]


def spine_and_landmarks(breath):
    z = np.linspace(5, 58, 19)
    spine = np.column_stack([0 * z, 6 - 1.6 * np.cos(2 * np.pi * (z - 18) / 50) - (z > 50) * .18 * (z - 50), z])
    points = np.array(list(LANDMARKS.values()), float)
    inner = np.array([1, 0, 0, .6, .6])                      # how much of the breath a landmark feels
    return spine, points - breath * inner[:, None] * [0, 0, 1.5]


def leaning(places, lean):
    """Bends the trunk to the patient's left by an angle in degrees. The pelvis stays."""
    if lean == 0:
        return places
    steps = np.linspace(0, 1, 400)
    angles = np.radians(lean) * steps**2 * (3 - 2 * steps)
    way = np.stack([np.sin(angles), np.cos(angles)]) * 64 / (len(steps) - 1)
    way = np.concatenate([np.zeros((2, 1)), np.cumsum(way[:, :-1], axis=1)], axis=1)
    x, y, z = places.T
    middle_x, middle_z, angle = (np.interp(z / 64, steps, values) for values in (*way, angles))
    return np.column_stack([middle_x + x * np.cos(angle), y, middle_z - x * np.sin(angle)])


def torso(lean=0, breath=0):
    """The body: "skin" and "organs" are pairs of vertices and triangles, "spine" is a line, "landmarks" are points.

    Coordinates are rounded, because the last bits of NumPy's sines differ between processors.
    """
    surfaces = [skin(breath), lung(1, breath), lung(-1, breath), heart(breath)]
    surfaces = [(leaning(vertices, lean).round(9), faces) for vertices, faces in surfaces]
    spine, points = (leaning(places, lean).round(9) for places in spine_and_landmarks(breath))
    return {"skin": surfaces[0], "organs": surfaces[1:], "spine": spine, "landmarks": points}


def write_obj(name, body):
    """One OBJ file. The object "outer" is the skin, and each organ is an object with its name."""
    with open(name, "w", encoding="utf-8") as file:
        first = 1
        for title, (vertices, faces) in zip(["outer", *ORGANS], [body["skin"], *body["organs"]]):
            file.write(f"o {title.replace(' ', '_')}\n")
            file.writelines("v %.17g %.17g %.17g\n" % tuple(v) for v in vertices)
            file.writelines("f %d %d %d\n" % tuple(f + first) for f in faces)
            first += len(vertices)


def main():
    folder = sys.argv[1]
    before, after = torso(), torso(lean=28, breath=1)
    write_obj(f"{folder}/before.obj", before)
    write_obj(f"{folder}/after.obj", after)
    with open(f"{folder}/landmarks.csv", "w", encoding="utf-8") as file:
        file.write("name,x,y,z,x',y',z'\n")
        for name, places in zip(LANDMARKS, np.hstack([before["landmarks"], after["landmarks"]])):
            file.write(f"{name},{','.join('%.17g' % c for c in places)}\n")
    with open(f"{folder}/spine.json", "w", encoding="utf-8") as file:
        json.dump([{"name": "spine", "source": before["spine"].tolist(), "target": after["spine"].tolist()}], file)


if __name__ == "__main__":
    main()
