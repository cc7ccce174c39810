#!/usr/bin/env python3
"""Makes two animals that were never the same mesh, for libicc's tutorial.

    python3 examples/animals.py FOLDER      writes dog.off, giraffe.off and animals.txt, their landmarks

Each is put together from limbs, rods with round ends that flow into one another, and gets a mesh of its own. Import it
for the meshes: animal(DOG, cell) gives vertices and triangles; picture() draws bodies side by side.
"""

import sys

import libicc
import numpy as np

# Limbs: from, to, radius. Landmarks are the ends of some. Left is +y.
DOG = {"body": ([-1, 0, 1.3], [.9, 0, 1.35], .5), "neck": ([1, 0, 1.5], [1.5, 0, 2.1], .3),
       "head": ([1.5, 0, 2.15], [1.8, 0, 2.15], .36), "snout": ([1.8, 0, 2.1], [2.4, 0, 1.95], .2),
       "tail": ([-1.3, 0, 1.6], [-2.1, 0, 2.3], .18),
       "ear left": ([1.45, .3, 2.35], [1.35, .55, 2.75], .17), "ear right": ([1.45, -.3, 2.35], [1.35, -.55, 2.75], .17),
       "fore left": ([.85, .33, 1.1], [.9, .38, .1], .2), "fore right": ([.85, -.33, 1.1], [.9, -.38, .1], .2),
       "hind left": ([-1.05, .33, 1.1], [-1.1, .38, .1], .22), "hind right": ([-1.05, -.33, 1.1], [-1.1, -.38, .1], .22)}
GIRAFFE = {"body": ([-.8, 0, 2.2], [.7, 0, 2.5], .5), "neck": ([.9, 0, 2.7], [1.9, 0, 4.9], .26),
           "head": ([1.9, 0, 5], [2.2, 0, 5], .3), "snout": ([2.2, 0, 4.95], [2.75, 0, 4.7], .2),
           "tail": ([-1.1, 0, 2.4], [-1.8, 0, 1.5], .17),
           "ear left": ([1.85, .25, 5.2], [1.75, .45, 5.55], .16), "ear right": ([1.85, -.25, 5.2], [1.75, -.45, 5.55], .16),
           "fore left": ([.7, .33, 2], [.8, .4, .1], .19), "fore right": ([.7, -.33, 2], [.95, -.4, .1], .19),
           "hind left": ([-.8, .33, 2], [-.75, .4, .1], .2), "hind right": ([-.8, -.33, 2], [-.95, -.4, .1], .2)}
LANDMARKS = ["snout", "tail", "ear left", "ear right", "fore left", "fore right", "hind left", "hind right"]


def depth(limbs, points, soft=.12):
    """How far points are inside, less than nothing for those outside: a soft maximum over the limbs."""
    inside = []
    for first, last, radius in limbs.values():
        first, way = np.array(first, float), np.subtract(last, first)
        share = np.clip((points - first) @ way / (way @ way), 0, 1)
        inside.append(radius - np.linalg.norm(points - first - share[..., None] * way, axis=-1))
    inside = np.array(inside) / soft
    most = inside.max(axis=0)
    return soft * (most + np.log(np.exp(inside - most).sum(axis=0)))


def animal(limbs, cell):
    """Vertices and triangles: the boundary of cells, drawn onto the surface and evened out."""
    ends = np.array([end for first, last, _ in limbs.values() for end in (first, last)], float)
    low, n = ends.min(axis=0) - .8, np.ceil((np.ptp(ends, axis=0) + 1.6) / cell).astype(int)
    middles = low + cell * (np.stack(np.meshgrid(*map(np.arange, n), indexing="ij"), axis=-1) + .5)
    cells = libicc.Domain.from_mask(libicc.repair_mask(depth(limbs, middles) > 0)[0])
    vertices, faces = low + cell * cells.vertices, cells.facets
    sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    degree = np.bincount(sides[:, 0], minlength=len(vertices))[:, None]
    for _ in range(30):
        mean = np.zeros_like(vertices)
        np.add.at(mean, sides[:, 0], vertices[sides[:, 1]])
        vertices = vertices + .5 * (mean / degree - vertices)
        off = depth(limbs, vertices)
        rise = np.stack([depth(limbs, vertices + step) - off for step in 1e-4 * np.eye(3)], axis=-1) / 1e-4
        vertices = vertices - (off / (rise ** 2).sum(axis=-1))[:, None] * rise
    return vertices, faces


def landmarks(limbs, vertices):
    """The vertices at the tips of the limbs that both animals have."""
    tips = np.array([np.add(last, .8 * radius * np.subtract(last, first) / np.linalg.norm(np.subtract(last, first)))
                     for first, last, radius in (limbs[name] for name in LANDMARKS)])
    return vertices[np.linalg.norm(vertices - tips[:, None], axis=2).argmin(axis=1)]


def coat(points):
    """The colours of the dog's coat: stripes along the body, a dark snout, light legs."""
    x, _, z = points.T
    colours = np.where((np.sin(9 * x + 2 * z) > 0)[:, None], [205, 133, 63], [139, 80, 30])
    colours[z < .8] = [235, 215, 180]
    colours[x > 2.15] = [40, 30, 30]
    return colours


def picture(name, bodies, size=240):
    """Draws bodies, (vertices, triangles, a colour for each triangle), side by side, from their right side."""
    from PIL import Image, ImageDraw
    fine = 3 * size
    image = Image.new("RGB", (fine * len(bodies), int(1.2 * fine)), "white")
    draw = ImageDraw.Draw(image)
    side, up, light = np.array([.85, .5, .12]), np.array([.05, -.2, 1]), np.array([.25, -.6, .75])
    away = np.cross(up, side)
    for k, (vertices, faces, colours) in enumerate(bodies):
        corners = vertices[faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals /= np.linalg.norm(normals, axis=1)[:, None]
        shade = .5 + .5 * np.clip(normals @ light, 0, 1)
        at = np.stack([corners @ side, -corners @ up], axis=-1) * fine / 5.7 + [fine * (k + .41), 1.12 * fine]
        for f in np.argsort(-(corners.mean(axis=1) @ away)):
            colour = tuple((colours[f] * shade[f]).astype(int))
            draw.polygon([tuple(p) for p in at[f]], fill=colour, outline=colour)
    image.resize((image.width // 3, image.height // 3), Image.LANCZOS).save(name, optimize=True)


def write_off(name, vertices, faces):
    with open(name, "w") as file:
        file.write(f"OFF\n{len(vertices)} {len(faces)} 0\n")
        file.writelines("%.17g %.17g %.17g\n" % tuple(p) for p in vertices)
        file.writelines("3 %d %d %d\n" % tuple(f) for f in faces)


if __name__ == "__main__":
    folder, marks = sys.argv[1], []
    for name, limbs, cell in (("dog", DOG, .2), ("giraffe", GIRAFFE, .22)):
        body = animal(limbs, cell)
        marks.append(landmarks(limbs, body[0]))
        write_off(f"{folder}/{name}.off", *body)
    np.savetxt(f"{folder}/animals.txt", np.hstack(marks), fmt="%.17g")
