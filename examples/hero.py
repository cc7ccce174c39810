#!/usr/bin/env python3
"""Draws a character on a transparent ground, and six pins that make it wave, for libicc's guide to poses.

    python3 examples/hero.py FOLDER      writes hero.png and pins.json

Each shape is a distance that is negative inside, so its edge is soft by itself. It needs NumPy only.
"""

import json
import struct
import sys
import zlib

import numpy as np

WIDTH, HEIGHT = 400, 440
INK = (58, 46, 60)
X, Y = np.meshgrid(np.arange(WIDTH) + 0.5, np.arange(HEIGHT) + 0.5)

# Where each pin is, and where it goes: the character waves with one hand, and puts the other one on its hip.
PINS = [("head", (200, 80), (206, 84)), ("belly", (200, 250), None), ("right hand", (92, 296), (62, 92)),
        ("left hand", (308, 296), (296, 330)), ("right foot", (168, 408), None), ("left foot", (232, 408), None)]


def disc(x, y, radius, tall=1):
    return np.hypot(X - x, (Y - y) / tall) - radius


def limb(*joints, width):
    """A stroke through the joints."""
    distance = np.full(X.shape, np.inf)
    for (x0, y0), (x1, y1) in zip(joints, joints[1:]):
        dx, dy = x1 - x0, y1 - y0
        along = np.clip(((X - x0) * dx + (Y - y0) * dy) / (dx * dx + dy * dy), 0, 1)
        distance = np.minimum(distance, np.hypot(X - x0 - along * dx, Y - y0 - along * dy))
    return distance - width / 2


def paint(picture, distance, colour):
    cover = np.clip(0.5 - distance, 0, 1)[..., None]
    picture[:] = cover * np.array([*colour, 255]) + (1 - cover) * picture


def shape(picture, distance, colour, stripes=None):
    """A shape with a line of ink around it."""
    paint(picture, distance - 3, INK)
    paint(picture, distance, colour)
    if stripes:
        paint(picture, np.maximum(distance, np.abs(Y % 26 - 13) - 5), stripes)


def draw():
    picture = np.zeros((HEIGHT, WIDTH, 4))
    skin, shirt, trousers, boots = (246, 205, 170), (222, 92, 74), (66, 96, 148), (110, 72, 52)
    for side in (-1, 1):
        shape(picture, limb((200 + 22 * side, 300), (200 + 32 * side, 390), width=40), trousers)
        shape(picture, limb((200 + 32 * side, 408), (200 + 46 * side, 411), width=40), boots)
    for side in (-1, 1):
        shape(picture, limb((200 + 100 * side, 276), (200 + 108 * side, 296), width=34), skin)
        shape(picture, limb((200 + 46 * side, 186), (200 + 82 * side, 232), (200 + 98 * side, 272), width=36), shirt)
    shape(picture, limb((200, 208), (200, 288), width=110), shirt, stripes=(244, 226, 198))
    shape(picture, np.maximum(limb((200, 208), (200, 288), width=110), 290 - Y), trousers)
    for side in (-1, 1):
        paint(picture, limb((200 + 46 * side, 186), (200 + 60 * side, 204), width=33), shirt)
    shape(picture, disc(200, 92, 62), skin)
    shape(picture, np.maximum(disc(200, 88, 66), Y - 66), (86, 138, 90))
    shape(picture, limb((140, 68), (262, 68), width=12), (70, 114, 76))
    for side in (-1, 1):
        paint(picture, disc(200 + 24 * side, 96, 6.5, 1.4), INK)
        paint(picture, disc(200 + 42 * side, 118, 9), (240, 170, 150))
    paint(picture, np.maximum(np.abs(disc(200, 108, 22)) - 2.5, 118 - Y), INK)
    return picture


def save(name, picture):
    """Writes a PNG. The colours are not multiplied by the alpha."""
    alpha = np.maximum(picture[..., 3:], 1e-9)
    colours = np.concatenate([picture[..., :3] * 255 / alpha, picture[..., 3:]], axis=2)
    rows = np.clip(colours + 0.5, 0, 255).astype(np.uint8).reshape(HEIGHT, -1)
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 6, 0, 0, 0)),
              (b"IDAT", zlib.compress(b"".join(b"\0" + row.tobytes() for row in rows), 9)), (b"IEND", b"")]
    with open(name, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in chunks:
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


def main(folder):
    save(f"{folder}/hero.png", draw())
    pins = [{"name": name, "at": at} | ({"to": to} if to else {}) for name, at, to in PINS]
    with open(f"{folder}/pins.json", "w", encoding="utf-8") as file:
        file.write('{"pins": [\n  ' + ",\n  ".join(map(json.dumps, pins)) + "\n]}\n")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else ".")
