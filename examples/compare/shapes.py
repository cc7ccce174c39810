"""Pairs of outlines: of the kinds that the papers draw, drawn anew but for the one with three legs.

Coordinates are rounded, because the last bits of NumPy's sines differ between processors.
"""

from pathlib import Path

import numpy as np

DATA = Path(__file__).resolve().parent.parent / "data"


def finer(outline, pieces):
    """Each edge cut into equal pieces."""
    outline = np.asarray(outline, float)
    shares = np.arange(pieces)[:, None] / pieces
    return np.vstack([a * (1 - shares) + b * shares for a, b in zip(outline, np.roll(outline, -1, axis=0))]).round(9)


def square():
    """Two opposite sides are pushed far in, past one another: no barycentric coordinates are one-to-one here."""
    source = [(0, 0), (.3, 0), (.4, 0), (.5, 0), (1, 0), (1, 1), (.7, 1), (.6, 1), (.5, 1), (0, 1)]
    target = [(0, 0), (.3, 0), (.36, .85), (.42, 0), (1, 0), (1, 1), (.7, 1), (.64, .15), (.58, 1), (0, 1)]
    return finer(source, 4), finer(target, 4)


def limb(root, way, length, width):
    """The corners of a limb that leaves the body at `root`, in anticlockwise order, with three toes."""
    way = np.asarray(way, float) / np.hypot(*way)
    aside = np.array([-way[1], way[0]])
    root = np.asarray(root, float)
    foot = root + length * way
    return [root - width / 2 * aside, foot - width / 2 * aside, foot - width * aside + .6 * width * way,
            foot - .3 * width * aside + .5 * width * way, foot + 1.1 * width * way, foot + .3 * width * aside + .5 * width * way,
            foot + width * aside + .6 * width * way, foot + width / 2 * aside, root + width / 2 * aside]


def frog_with(ways):
    """A body with four limbs, each given by its angle in degrees and its length, and a head."""
    roots = [(.7, -.8), (.8, .6), (-.8, .6), (-.7, -.8)]
    corners = []
    for root, (degrees, length) in zip(roots, ways):
        angle = np.radians(degrees)
        corners += limb(root, (np.cos(angle), np.sin(angle)), length, .3)
        if root == (.8, .6):
            corners += [(.55, 1.2), (.3, 1.5), (-.3, 1.5), (-.55, 1.2)]
    return finer(corners, 2)


def frog():
    """Its limbs are moved: those behind are stretched, those in front drawn in and raised."""
    return (frog_with([(-40, 1.1), (20, .8), (160, .8), (220, 1.1)]),
            frog_with([(30, 1.6), (75, 1.1), (215, .9), (275, 1.8)]))


def long_thin():
    """A strip is wound up."""
    n = 40
    along = np.linspace(0, 1, n)
    strip = np.vstack([np.column_stack([12 * along, 0 * along]), np.column_stack([12 - 12 * along, .8 + 0 * along])])
    angle = 3.2 * np.pi * along

    def spiral(radius):
        return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])

    wound = np.vstack([spiral(3.2 - 2.2 * along), spiral(2.55 - 2.1 * along)[::-1]])
    return strip, wound.round(9)


def tripus():
    return tuple(np.loadtxt(DATA / f"tripus.{end}.txt") for end in ("src", "tgt"))


def pairs():
    return [("square", *square()), ("frog", *frog()), ("long thin", *long_thin()), ("three legs", *tripus())]
