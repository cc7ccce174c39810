#!/usr/bin/env python3
"""Makes a bracket with two holes, and air around a wing, for libicc's page on parts and flow domains.

    python3 examples/parts.py FOLDER     writes bracket.obj, bracket-moved.obj, air.obj, air-turned.obj

Import it for arrays: bracket() and wing() give vertices and triangles of closed surfaces.
"""

import sys

import libicc
import numpy as np

WIDTH, THICKNESS, RADIUS = 12, 1, 2         # of the bracket's strip, and the radius of its fold
BLOCKS = 5                                  # half the side of the square around a hole that its own mesh fills
FOOT, UPRIGHT = np.array([7, 6]), np.array([25, 6])     # the holes' middles along and across the flat strip


def strip():
    """The flat strip: places in the plane, triangles, and the rings of vertices of its outline and its holes."""
    length = 32
    places = [np.stack(np.meshgrid(np.arange(length + 1.), np.arange(WIDTH + 1.), indexing="ij"), -1).reshape(-1, 2)]
    k = np.arange((length + 1) * (WIDTH + 1)).reshape(length + 1, WIDTH + 1)
    quads, rings = [], []
    keep = np.ones((length, WIDTH), bool)
    for middle in (FOOT, UPRIGHT):
        low, high = middle - BLOCKS, middle + BLOCKS
        keep[low[0]:high[0], low[1]:high[1]] = False
        along, across = np.arange(2 * BLOCKS) - BLOCKS, np.full(2 * BLOCKS, BLOCKS)
        rim = middle + np.concatenate([np.column_stack(side) for side in ((across, along), (-along, across),
                                                                          (-across, -along), (along, -across))])
        out = rim - middle
        hole = middle + 2 * out / np.linalg.norm(out, axis=1)[:, None]
        numbers = [k[tuple(rim.T)]]
        for share in (.3, .55, .78, 1):
            numbers.append(sum(map(len, places)) + np.arange(len(rim)))
            places.append((1 - share) * rim + share * hole)
        for a, b in zip(numbers, numbers[1:]):
            quads.append(np.stack([a, np.roll(a, -1), np.roll(b, -1), b], -1))
        rings.append(numbers[-1])
    quads.append(np.stack([k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]], -1)[keep])
    outline = np.concatenate([k[:-1, 0], k[-1, :-1], k[:0:-1, -1], k[0, :0:-1]])
    quads, places = np.concatenate(quads), np.concatenate(places)
    used, quads = np.unique(quads, return_inverse=True)
    quads = quads.reshape(-1, 4)
    renamed = np.full(len(places), -1)
    renamed[used] = np.arange(len(used))
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    return places[used], triangles, renamed[outline], [renamed[r] for r in rings]


def folded(places, height):
    """Folds the strip by 90 degrees: the foot lies flat, the rest stands upright."""
    along, across = places.T
    start, middle = 14, RADIUS + THICKNESS / 2
    angle = np.clip((along - start) / middle, 0, np.pi / 2)
    rest = np.maximum(along - start - middle * np.pi / 2, 0)
    from_axis = middle - height
    x = np.minimum(along, start) + from_axis * np.sin(angle)
    z = middle - from_axis * np.cos(angle) + rest
    return np.column_stack([x, across, z])


def bracket(move=(0, 0), scale=1):
    """A strip with two holes, folded. The upper hole may be moved along the strip and across, and scaled."""
    places, triangles, outline, rings = strip()
    if np.any(move) or scale != 1:
        holes = [places[r] for r in rings]
        middle = holes[1].mean(axis=0)
        moved = [holes[0], middle + move + scale * (holes[1] - middle)]
        plane = libicc.Map(*(libicc.Domain(places[outline], holes=h) for h in (holes, moved)))
        places = plane(places)
    n = len(places)
    vertices = np.vstack([folded(places, THICKNESS / 2), folded(places, -THICKNESS / 2)])
    walls = []
    for loop in (outline, *(r[::-1] for r in rings)):
        after = np.roll(loop, -1)
        walls += [np.column_stack([loop + n, after + n, after]), np.column_stack([loop + n, after, loop])]
    return vertices, np.concatenate([triangles, triangles[:, ::-1] + n, *walls])


def wing(degrees=0, n=48, n_sections=13):
    """A wing of span 6, 4 long in its middle, with its nose turned up."""
    middle = -.12 + .1j                                      # Joukowski's map makes an airfoil of a circle through 1
    circle = middle + (1 - middle) * np.exp(2j * np.pi * np.arange(n) / n)
    section = circle + 1 / circle
    section = np.column_stack([section.real, section.imag])
    t = np.radians(degrees)
    turn = np.array([[np.cos(t), np.sin(t)], [-np.sin(t), np.cos(t)]])
    span = np.linspace(-3, 3, n_sections)
    vertices = []
    for y in span:
        size = 1 - .25 * abs(y) / 3
        xz = (size * section) @ turn.T
        vertices.append(np.column_stack([xz[:, 0], np.full(n, y), xz[:, 1]]))
    vertices = np.concatenate(vertices)
    k = np.arange(n * n_sections).reshape(n_sections, n)
    right = np.roll(k, -1, axis=1)
    walls = np.concatenate([np.stack([k[:-1], right[1:], right[:-1]], -1), np.stack([k[:-1], k[1:], right[1:]], -1)])
    cap = np.array([(i, i + 1, -(i + 1) % n) for i in range(n // 2 - 1)] + [(i, -(i + 1) % n, -i % n) for i in range(1, n // 2)])
    return vertices, np.concatenate([walls.reshape(-1, 3), cap, cap[:, ::-1] + n * (n_sections - 1)])


def box():
    """A box around the wing, its surface in triangles."""
    cells = libicc.Domain.from_mask(np.ones((14, 11, 10), bool))
    return (cells.vertices - [6, 5.5, 5]) * .75, cells.facets


def write_obj(name, surfaces):
    """One OBJ file with an object for each surface."""
    with open(name, "w", encoding="utf-8") as file:
        first = 1
        for title, (vertices, faces) in surfaces.items():
            file.write(f"o {title}\n")
            file.writelines("v %.17g %.17g %.17g\n" % tuple(v) for v in vertices)
            file.writelines("f %d %d %d\n" % tuple(f + first) for f in faces)
            first += len(vertices)


def main():
    folder = sys.argv[1]
    write_obj(f"{folder}/bracket.obj", {"outer": bracket()})
    write_obj(f"{folder}/bracket-moved.obj", {"outer": bracket((4, -1.5), .75)})
    write_obj(f"{folder}/air.obj", {"outer": box(), "void.wing": wing()})
    write_obj(f"{folder}/air-turned.obj", {"outer": box(), "void.wing": wing(25)})


if __name__ == "__main__":
    main()
