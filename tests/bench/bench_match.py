#!/usr/bin/env python3
"""Outlines that do not correspond: energies with one landmark, what is refused, and whether sides, starts, senses, sizes
and places make a difference. The vertices of each pair correspond; 30 % more are put at random places on edges and the
starts turned, as by bench_match.c.

usage: PYTHONPATH=bindings/python LIBICC_LIBRARY=build/release/lib/libicc.so bench_match.py FOLDER [ATLAS]. FOLDER has
pairs NAME.src.txt and NAME.tgt.txt. ATLAS has countries-110m.json, countries-50m.json and countries-10m.json of npm's
world-atlas (2.0.2; Natural Earth): each country's largest ring is matched with the one which overlaps it most in a
finer file, turned at random and three times as large.

Bars: median energy at most 1.1 times the truth's, none above 1.3; all refused that is free and none that is upright but
discs; 1 % where sides are changed. Of thirty countries at most 5 refused, none begun wrongly, median at most .6 %."""
import json
import pathlib
import sys
import time

import libicc
import numpy as np

MOST_VERTICES = 4000  # of pairs that are mapped
WRONG = 5  # from this mean distance on, in % of the source's perimeter, the start is wrong
UNLIKE = 2  # what is that far from the other outline at least has no truth: other islands, or a part more
LEFT_OUT = {"Antarctica"}  # ends at the edge of the map
THIRTY = {"Norway", "Chile", "Italy", "Greece", "Japan", "United Kingdom", "France", "Spain", "Turkey", "India",
          "Brazil", "Mexico", "Indonesia", "Australia", "Canada", "Gambia", "Croatia", "Vietnam", "Somalia", "Iceland",
          "New Zealand", "Madagascar", "Egypt", "Poland", "Hungary", "Kenya", "Peru", "Argentina", "Finland", "Sweden"}


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


def countries(path):
    """The outer rings of every country of a file of TopoJSON, in degrees."""
    topology = json.loads(path.read_text())
    scale, shift = (np.asarray(topology["transform"][key]) for key in ("scale", "translate"))
    arcs = [np.cumsum(np.asarray(arc, float), 0) * scale + shift for arc in topology["arcs"]]

    def ring(numbers):
        return np.concatenate([(arcs[k] if k >= 0 else arcs[~k][::-1])[:-1] for k in numbers])

    found = {}
    for shape in topology["objects"]["countries"]["geometries"]:
        parts = [shape["arcs"]] if shape["type"] == "Polygon" else shape.get("arcs", [])
        found.setdefault(shape["properties"]["name"], []).extend(ring(part[0]) for part in parts)
    return found


def equal_area(ring, middle):
    """By Lambert's azimuthal projection."""
    x, y, x0, y0 = np.radians([*ring.T, *np.broadcast_to(middle[:, None], ring.T.shape)])
    x -= x0
    near = 1 + np.sin(y0) * np.sin(y) + np.cos(y0) * np.cos(y) * np.cos(x)
    flat = np.c_[np.cos(y) * np.sin(x), np.cos(y0) * np.sin(y) - np.sin(y0) * np.cos(y) * np.cos(x)]
    return np.sqrt(2 / near)[:, None] * flat


def inside(ring, points):
    crossed = np.zeros(len(points), bool)
    for a, b in zip(ring, np.roll(ring, -1, 0)):
        if a[1] != b[1]:
            crossed ^= (((a[1] <= points[:, 1]) != (b[1] <= points[:, 1]))
                        & (points[:, 0] < a[0] + (points[:, 1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])))
    return crossed


def same_part(coarse, fine):
    """The largest of the coarse rings, and the fine one which overlaps it most, on a plane; None: none is near."""
    ring = max(coarse, key=lambda part: abs(area(part)))
    middle = (ring.min(0) + ring.max(0)) / 2
    ring, *fine = (equal_area(part, middle) for part in (ring, *fine))
    low, high = ring.min(0), ring.max(0)
    places = np.stack(np.meshgrid(*np.linspace(low, high, 30).T), -1).reshape(-1, 2)
    places = places[inside(ring, places)]
    near = [part for part in fine if (part.max(0) > low).all() and (part.min(0) < high).all()]
    return (ring, max(near, key=lambda part: np.count_nonzero(inside(part, places)))) if near else None


def mended(ring):
    """Without the small loops that whole numbers as coordinates have made: what is cut off is between the two vertices
    or edges of a defect."""
    while True:
        found = libicc.boundary_defects(ring)
        if not found:
            return ring
        low, high = sorted(found[0][1:])
        if high - low > len(ring) // 2:
            ring, low, high = np.roll(ring, -high, 0), 0, len(ring) - high + low
        ring = np.delete(ring, np.s_[low + 1:high + 1], 0)


def along(ring, n):
    """n points at equal distances, and the perimeter."""
    closed = np.r_[ring, ring[:1]]
    length = np.r_[0, np.cumsum(np.hypot(*np.diff(closed, axis=0).T))]
    at = np.arange(n) / n * length[-1]
    return np.c_[np.interp(at, length, closed[:, 0]), np.interp(at, length, closed[:, 1])], length[-1]


def coast(name, rng, source, target):
    """How far points are from the other outline, whether the match is sure, and how far they are from their partners,
    in % of the source's perimeter."""
    angle = rng.uniform(0, 2 * np.pi)
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    source, target = (np.roll(ring, rng.integers(len(ring)), 0) for ring in (source, target))
    points, perimeter = along(source, 3000)
    begin = time.process_time()
    match = libicc.Match(source, 3 * target @ turn, turning="free", least_sure=1)
    seconds = time.process_time() - begin
    distance = 100 * np.mean(np.hypot(*(match.apply(points)[0] @ turn.T / 3 - points).T)) / perimeter
    domain = libicc.Domain(target)
    _, facets, weights = domain.locate(points, nearest=True)
    nearest = np.einsum("nk,nkd->nd", weights, domain.vertices[domain.facets[facets]])
    is_sure = match.info.sure >= 1.06
    least = 100 * np.mean(np.hypot(*(nearest - points).T)) / perimeter
    words = [word for word, holds in (("unlike", least > UNLIKE), ("refused", not is_sure),
                                      ("begun wrongly", distance > WRONG)) if holds]
    print(f"{name:24} {len(source):6} {len(target):6} apart {distance:5.2f} %, at least {least:5.2f} %, "
          f"cost {match.info.cost:.3f}, sure {match.info.sure:.3f}, {seconds:.2f} s", *words, sep=", ", flush=True)
    return least, is_sure, distance


def coasts(atlas, coarse, fine):
    rng = np.random.default_rng(3)
    files = [countries(atlas / f"countries-{scale}.json") for scale in (coarse, fine)]
    names = sorted(set(files[0]) & set(files[1]) - LEFT_OUT)
    pairs = {name: same_part(files[0][name], files[1][name]) for name in names}
    found = {name: coast(name, rng, *map(mended, pair)) for name, pair in pairs.items() if pair}
    for title, names in (("thirty countries", THIRTY & set(found)), ("all", found)):
        answers = np.array([found[name] for name in names if found[name][0] < UNLIKE])
        sure = answers[answers[:, 1] > 0, 2]
        print(f"1:{coarse} onto 1:{fine}, {title}: {len(answers)} pairs, {len(answers) - len(sure)} refused, "
              f"{np.count_nonzero(sure > WRONG)} begun wrongly, median {np.median(sure):.2f} %")


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
    if len(sys.argv) < 3:
        print("coasts are left out: no ATLAS was named")
        return
    for coarse, fine in (("110m", "10m"), ("50m", "10m"), ("110m", "50m")):
        coasts(pathlib.Path(sys.argv[2]), coarse, fine)


main()
