"""Smooth one-to-one distortions of the unit square that a fit has to find from points.

The first is an old sheet: its paper has shrunk, and its makers erred. The others are ten families, half of them
distortions of the whole square and half of them local ones.
"""

import numpy as np


def sheet(p):
    """An old map sheet, of the unit square."""
    x, y = p.T
    return np.c_[x + .04 * np.sin(3 * y) + .015 * x * x, .97 * y + .05 * np.sin(2.5 * x) - .03 * x * y]


def _turned(p, centre, angle):
    """Points turned about a centre, each by its own angle."""
    d = p - centre
    return centre + np.c_[d[:, 0] * np.cos(angle) - d[:, 1] * np.sin(angle), d[:, 0] * np.sin(angle) + d[:, 1] * np.cos(angle)]


def families(rng):
    """Ten distortions by name; `rng` draws their places, sizes and directions."""
    turn = rng.uniform(0, 2 * np.pi)
    way = np.array([np.cos(turn), np.sin(turn)])
    across = np.array([-way[1], way[0]])
    centre = rng.uniform(.35, .65, 2)
    phases, tilt = rng.uniform(0, 2 * np.pi, 6), rng.uniform(-.3, .3, 2)
    cubic = rng.normal(size=(7, 2)) * .06
    long_waves, short_waves = rng.normal(size=(6, 2)) * 3, rng.normal(size=(6, 2)) * 7
    long_heights, short_heights = rng.normal(size=(6, 2)) * .02, rng.normal(size=(6, 2)) * .006

    def paper(p):
        return sheet(.5 + (p - .5) @ np.array([way, across]))

    def projective(p):
        return (p + .1 * p[:, ::-1]) / (1 + (p - .5) @ tilt)[:, None]

    def lens(p):
        d = p - centre
        return p + .15 * d * (d ** 2).sum(1)[:, None]

    def polynomial(p):
        x, y = (p - .5).T
        return p + np.c_[x * x, x * y, y * y, x ** 3, x * x * y, x * y * y, y ** 3] @ cubic

    def shrinking(p):
        along = (p - .5) @ way
        return p + (np.exp(.5 * along) - 1 - .5 * along)[:, None] * way * .8

    def waves(p):
        return p + np.sin(p @ long_waves.T + phases) @ long_heights

    def ripples(p):
        return p + np.sin(p @ short_waves.T + phases) @ short_heights

    def swirl(p):
        return _turned(p, centre, 1.5 * np.exp(-8 * ((p - centre) ** 2).sum(1)))

    def bump(p):
        return p + .08 * np.exp(-((p - centre) ** 2).sum(1) / (2 * .15 ** 2))[:, None] * way

    def fault(p):
        return p + .03 * np.tanh(((p - centre) @ across) / .12)[:, None] * way

    return {f.__name__: f for f in (paper, projective, lens, polynomial, shrinking,
                                    waves, ripples, swirl, bump, fault)}


GLOBAL = ("paper", "projective", "lens", "polynomial", "shrinking")
