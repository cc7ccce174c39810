#!/usr/bin/env python3
"""Outlines that do not correspond: energies with one landmark, what is refused, and whether sides, starts, senses, sizes
and places make a difference. The vertices of each pair correspond; 30 % more are put at random places on edges and the
starts turned, as by bench_match.c.

usage: PYTHONPATH=bindings/python LIBICC_LIBRARY=build/release/lib/libicc.so bench_match.py FOLDER, which has pairs
NAME.src.txt and NAME.tgt.txt

Bars: median energy at most 1.1 times the truth's, none above 1.3; all refused that is free and none that is upright but
discs; 1 % where sides are changed."""
import pathlib
import sys

import libicc
import numpy as np

MOST_VERTICES = 4000  # of pairs that are mapped


def disguise(rng, ring):
    """The ring with more vertices, begun elsewhere, and where its own vertices went."""
    n = len(ring)
    labels = np.sort(np.r_[np.arange(n), rng.uniform(0, n, n * 3 // 10 + 3)])
    labels = np.roll(labels, -int(rng.integers(len(labels))))
    i = labels.astype(int)
    f = (labels - i)[:, None]
    return (1 - f) * ring[i] + f * ring[(i + 1) % n], labels


def area(ring):
    after = np.roll(ring, -1, 0)
    return np.sum(ring[:, 0] * after[:, 1] - ring[:, 1] * after[:, 0])


def shares(common, origin, first, sense):
    """Where common vertices lie on the outline given, counted from its vertex `first` in its sense."""
    ring = common if area(common) * sense > 0 else common[::-1]
    origin = origin if ring is common else origin[::-1]
    length = np.r_[0, np.cumsum(np.hypot(*(np.roll(ring, -1, 0) - ring).T))]
    at = (length[:-1] - length[np.flatnonzero(origin == first)[0]]) / length[-1] % 1
    return at if ring is common else at[::-1]


def pairing(match, firsts, senses):
    """The shares of common vertices on the source, and on the target."""
    return tuple(shares(domain.vertices, np.asarray(origin).astype(np.int64), first, sense)
                 for domain, origin, first, sense in
                 zip((match.source, match.target), match.origins(), firsts, senses))


def apart(first, second):
    """The mean distance of two pairings along the target, in % of its perimeter."""
    at = np.arange(1000) / 1000
    images = []
    for s, t in (first, second):
        order = np.argsort(s, kind="stable")
        s, t = s[order], t[order]
        t = np.r_[t[0], t[0] + np.cumsum((np.diff(t) + .5) % 1 - .5)]
        images.append(np.interp(at, np.r_[s[-1] - 1, s, s[0] + 1], np.r_[t[-1] - 1, t, t[0] + 1]))
    return 100 * np.mean(np.abs((images[0] - images[1] + .5) % 1 - .5))


def one_landmark(name, rng, source, target):
    (a, _), (b, _) = disguise(rng, source), disguise(rng, target)
    k = int(rng.integers(len(source)))
    match = libicc.Match(a, b, np.r_[source[k], target[k]][None])
    energy = libicc.Map(match.source, match.target).info.energy
    truth = libicc.Map(source, target).info.energy
    print(f"{name:24} one landmark: energy {energy:.3f} by {truth:.3f} = {energy / truth:.3f}", flush=True)
    return energy / truth


def symmetry(name, rng, source, target):
    (a, _), (b, _) = disguise(rng, source), disguise(rng, target)
    senses = area(a), area(b)
    options = {"least_sure": 1}
    plain = pairing(libicc.Match(a, b, **options), (0, 0), senses)
    back = pairing(libicc.Match(b, a, **options), (0, 0), senses[::-1])
    turn = len(a) // 3
    turned = pairing(libicc.Match(np.roll(a, -turn, 0), b, **options), (len(a) - turn, 0), senses)
    other = pairing(libicc.Match(a[::-1], b, **options), (len(a) - 1, 0), senses)
    larger = pairing(libicc.Match(a, 37.5 * b + [1e4, -3e5], **options), (0, 0), senses)
    print(f"{name:24} sides changed {apart(plain, back[::-1]):.2f} %, other start {apart(plain, turned):.2f} %, other "
          f"sense {apart(plain, other):.2f} %, size and place {apart(plain, larger):.2f} %", flush=True)


def ring_of(n, radii=(1,)):
    t = 2 * np.pi * np.arange(n) / n
    r = np.resize(np.asarray(radii, float), n)
    return np.c_[r * np.cos(t), r * np.sin(t)]


def turned(ring, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    after = np.roll(ring, -1, 0)
    fine = np.concatenate([ring + k / 3 * (after - ring) for k in range(3)], 1).reshape(-1, 2)
    return fine @ np.array([[c, s], [-s, c]])


def answer(source, target, **options):
    try:
        return f"turn {round(libicc.Match(source, target, **options).info.turn)}"
    except libicc.AmbiguousError:
        return "refused"


def main():
    shapes = {"disc": ring_of(60), "square": [[0, 0], [1, 0], [1, 1], [0, 1]], "star of 5": ring_of(10, (1, .4)),
              "star of 7": ring_of(14, (1, .4)), "rectangle": [[0, 0], [2, 0], [2, 1], [0, 1]],
              "ellipse": ring_of(80) * [2, 1], "parallelogram": [[0, 0], [2, 0], [2.5, 1], [.5, 1]]}
    for name, ring in shapes.items():
        ring = np.asarray(ring, float)
        print(f"{name:24} free, turned by 0 and 40:", *(answer(ring, turned(ring, k), turning="free") for k in (0, 40)),
              "| upright, turned by -20, 0, 20:", *(answer(ring, turned(ring, k)) for k in (-20, 0, 20)))
    rng = np.random.default_rng(1)
    ratios = []
    for path in sorted(pathlib.Path(sys.argv[1]).glob("*.src.txt")):
        name = path.name[:-len(".src.txt")]
        source, target = np.loadtxt(path), np.loadtxt(path.with_name(name + ".tgt.txt"))
        print(f"{name:24} no landmark: {answer(*(disguise(rng, ring)[0] for ring in (source, target)))}", flush=True)
        symmetry(name, rng, source, target)
        if len(source) <= MOST_VERTICES:
            ratios.append(one_landmark(name, rng, source, target))
    print(f"energies with one landmark by those of the true pairs: median {np.median(ratios):.3f}, most {max(ratios):.3f}")


main()
