"""Where a thin-plate spline folds, does a fit find a one-to-one map through all points? And does `nearest` certify any
folded warp without changing the rest of it?

Points are in the unit square. Each problem is one in which the thin plate turns some of the square over.
"""

import numpy as np
from common import EXACT, Clock, Report, ThinPlate, areas, cross, library, mesh_of, one_to_one, options, signs, wants

wants("shapely")

CERTIFIED = .99                         # share of the problems that must be certified
SOON = 20                               # CPU seconds for tangled points, on a slow machine
GRID = 60                               # the thin plate is asked on so many places in each direction
# Shares of triangles that fold in a warp: little, and at most. If little folds, this share of the vertices where the
# warp was one-to-one must not move at all, and half of them by this share of the size at most.
MILD, WILD = .05, .2
KEPT, MOVED = .4, 1e-3


def scattered(rng, n, gap=.35):
    """n points of the unit square, none much closer to another than even ones would be."""
    points = []
    while len(points) < n:
        p = rng.uniform(.02, .98, 2)
        if not points or np.hypot(*(np.array(points) - p).T).min() > gap / np.sqrt(n):
            points.append(p)
    return np.array(points)


def nearest_two(points):
    """The number of the nearest other point of each, and its distance."""
    d = np.hypot(*(points[:, None] - points[None]).transpose(2, 0, 1))
    np.fill_diagonal(d, np.inf)
    return d.argmin(1), d.min(1)


def swaps(rng, n):
    """Neighbours change places."""
    p = scattered(rng, n)
    q, used = p.copy(), set()
    other, _ = nearest_two(p)
    for i in rng.permutation(n)[:max(1, n // 8)]:
        j = int(other[i])
        if not {int(i), j} & used:
            q[[i, j]] = q[[j, i]]
            used |= {int(i), j}
    return p, q


def pushes(rng, n):
    """Some points go close to another one, against points that stay."""
    p = scattered(rng, n)
    q, (other, _) = p.copy(), nearest_two(p)
    for i in rng.permutation(n)[:max(1, n // 6)]:
        q[i] += rng.uniform(.7, .95) * (p[other[i]] - q[i])
    return p, q


def shears(rng, n):
    """Points on both sides of a line slide along it in opposite directions."""
    p, turn = scattered(rng, n), rng.uniform(0, 2 * np.pi)
    way = np.array([np.cos(turn), np.sin(turn)])
    side = np.sign((p - rng.uniform(.35, .65, 2)) @ [-way[1], way[0]])
    return p, p + rng.uniform(.3, 1.2) / np.sqrt(n) * side[:, None] * way


def moves(rng, n):
    """All points move at random, by up to about their distance."""
    p = scattered(rng, n)
    _, d = nearest_two(p)
    return p, p + rng.normal(size=(n, 2)) * rng.uniform(.3, .7) * d[:, None]


def rows(rng, n):
    """Two rows of points slide along each other, between corners that stay."""
    k = max(1, (n - 4) // 2)
    x, gap = np.linspace(.1, .9, k), rng.uniform(.02, .06)
    p = np.r_[np.c_[x, 0 * x + .5 - gap], np.c_[x, 0 * x + .5 + gap], [[0, 0], [1, 0], [1, 1], [0, 1.]]]
    p[:2 * k] += rng.normal(size=(2 * k, 2)) * .003
    q, slide = p.copy(), rng.uniform(.04, .12)
    q[:k, 0] += slide
    q[k:2 * k, 0] -= slide
    return p, q


def face(rng, n):
    """Landmarks of a face. The mouth opens wide, the eyes close, and the brows go up."""
    k = max(1, (n - 6) // 6)
    t = np.linspace(-1, 1, k + 2)[1:-1]
    parts = []
    for centre, width, high in ((-.18, .1, .05), (.18, .1, .05), (0, .17, .045)):
        y = .62 if centre else .28
        parts += [np.c_[.5 + centre + width * t, y + side * high * (1 - t * t)] for side in (1, -1)]
    jaw = np.array([[.1, .6], [.9, .6], [.2, .2], [.8, .2], [.5, .04], [.5, .97]])
    p = np.r_[np.concatenate(parts), jaw]
    p = p + rng.normal(size=p.shape) * .002
    q = p.copy()
    wide, shut = rng.uniform(.5, 1.5), rng.uniform(.75, .97)
    for eye in (0, 2):
        upper, lower = slice(eye * k, eye * k + k), slice(eye * k + k, eye * k + 2 * k)
        q[upper, 1] -= shut * (p[upper, 1] - p[lower, 1])
    q[5 * k:6 * k, 1] -= wide * .1 * (1 - t * t)
    q[4 * k:5 * k, 1] += rng.uniform(0, .04) * (1 - t * t)
    q[6 * k + 4, 1] -= wide * .03
    turn = rng.uniform(-.3, .3)
    return p, .5 + (q - .5) @ np.array([[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]])


KINDS = (swaps, pushes, shears, moves, rows, face)


def folds(p, q):
    """Share of the square, and of the points' surroundings, that the thin plate turns over or flattens."""
    x = (np.arange(GRID) + .5) / GRID
    places = np.concatenate([np.stack(np.meshgrid(x, x), -1).reshape(-1, 2),
                             (p[:, None] + .003 * np.array([[1, 0], [-1, 0], [0, 1], [0, -1.]])).reshape(-1, 2)])
    return float((ThinPlate(p, q).determinants(places) <= 0).mean())


def problems(seed, n_all):
    """Problems with a name, in which the thin plate folds."""
    for k in range(n_all):
        make = KINDS[k % len(KINDS)]
        for again in range(1000):
            rng = np.random.default_rng([seed, 17, k, again])
            n = int(round(np.exp(rng.uniform(np.log(6), np.log(300)))))
            p, q = make(rng, max(n, 6))
            if folds(p, q) > 0 and nearest_two(q)[1].min() > 1e-6:
                yield make.__name__, p, q, folds(p, q)
                break
        else:
            raise RuntimeError(f"no {make.__name__} in which a thin plate folds")


def points(report, libicc, args):
    """Random problems with points."""
    n_all = 300 if args.full else 6
    kinds, refused = {}, []
    for k, (kind, p, q, turned) in enumerate(problems(args.seed, n_all)):
        found = kinds.setdefault(kind, [])
        if libicc is None:
            found.append((len(p), turned, 0., 0., 0.))
            continue
        name = f"{kind} {k}, {len(p)} points"
        with Clock() as clock:
            try:
                fit = libicc.fit(p, q, box=[[0, 0], [1, 1]])
            except libicc.Error as error:
                refused.append(f"{name}: {type(error).__name__}: {error}")
                report.check(str(error) != "", f"{name}: refused without a word")
                continue
        vertices, images, triangles = mesh_of(fit)
        faults = one_to_one(vertices, images, triangles)
        report.check(fit.certified and not faults, f"{name}: certified, {faults}")
        off = np.abs(fit(p) - q).max()
        report.at_most(f"{name}: distance of a point", off, EXACT)
        report.check(np.isfinite(fit([[0, 0], [1, 1], [.5, .5]])).all(), f"{name}: the square is covered")
        stretch = np.linalg.svd(fit.jacobian(np.random.default_rng(0).uniform(0, 1, (500, 2))), compute_uv=False)
        found.append((len(p), turned, clock.seconds, fit.info.repair == "whole", np.quantile(stretch[:, 0] / stretch[:, 1], .9)))
    for kind, found in kinds.items():
        v = np.array(found).reshape(-1, 5)
        if len(v):
            report.say("%s: %d problems, %d to %d points; the thin plate turns over %.2g %% in the median, %.2g %% at most" % (
                kind, len(v), v[:, 0].min(), v[:, 0].max(), 100 * np.median(v[:, 1]), 100 * v[:, 1].max()) +
                ("" if libicc is None else "; %.3f s in the median, %.2f s at most; %d mapped anew as a whole; aspect of 90 %% %.1f" % (
                    np.median(v[:, 2]), v[:, 2].max(), v[:, 3].sum(), np.median(v[:, 4]))))
    if libicc:
        report.say(f"refused: {len(refused)} of {n_all}")
        for text in refused:
            report.say(f"   {text}")
        report.at_least("share of certified problems", 1 - len(refused) / n_all, CERTIFIED)


def tangled(report, libicc, args):
    """Points that change places at random. With many of them no doubles can tell the ways around each other apart. That
    must be said soon."""
    if libicc is None:
        return
    for n in (20, 60, 100, 300, 1000) if args.full else (20, 100, 300):
        rng = np.random.default_rng([args.seed, 23, n])
        p = rng.uniform(0, 1, (n, 2))
        with Clock() as clock:
            try:
                fit = libicc.fit(p, p[rng.permutation(n)])
                vertices, images, triangles = mesh_of(fit)
                report.check(fit.certified and not one_to_one(vertices, images, triangles), f"tangled {n}: certified")
                outcome = fit.info.repair
            except libicc.CertificateError as error:
                report.check("tangled" in str(error), f"tangled {n}: {error}")
                outcome = "refused"
        report.say(f"tangled, {n} points: {outcome}, {clock.seconds:.2f} s")
        report.at_most(f"tangled, {n} points: seconds", clock.seconds, SOON)


# ------------------------------------------------------------------- warps

def grid(n):
    """A mesh of the unit square, whose diagonals alternate."""
    x = np.linspace(0, 1, n + 1)
    vertices = np.stack(np.meshgrid(x, x, indexing="ij"), -1).reshape(-1, 2)
    a = (np.arange(n)[:, None] * (n + 1) + np.arange(n)[None]).ravel()
    b, c, d = a + n + 1, a + n + 2, a + 1
    odd = ((np.arange(n)[:, None] + np.arange(n)[None]) % 2 == 1).ravel()
    first = np.where(odd[:, None], np.c_[a, b, c], np.c_[a, b, d])
    second = np.where(odd[:, None], np.c_[a, c, d], np.c_[b, c, d])
    return vertices, np.concatenate([first, second])


def dies(p):
    """1 inside of the unit square, smoothly 0 at its sides, where warps end."""
    t = np.minimum(np.minimum(p, 1 - p).min(1) / .15, 1)
    return (t * t * (3 - 2 * t))[:, None]


def field(rng, p):
    """A smooth random displacement field, as programs that register pictures give."""
    waves, phases = rng.normal(size=(40, 2)) * 12, rng.uniform(0, 7, 40)
    return p + dies(p) * (np.sin(p @ waves.T + phases) @ rng.normal(size=(40, 2))) * .012


def plate(rng, p):
    """A thin plate in which points change places."""
    a, b = swaps(rng, 24)
    return p + dies(p) * (ThinPlate(a, b)(p) - p)


def cubic(rng, p):
    """A polynomial of third degree, as tools for old maps offer."""
    x, y = (p - .5).T
    powers = np.c_[x * x, x * y, y * y, x ** 3, x * x * y, x * y * y, y ** 3]
    return p + dies(p) * (powers @ (rng.normal(size=(7, 2)) * 2.))


def skinned(rng, p):
    """Three bones that turn, blended by smooth weights, as rigs do."""
    places = rng.uniform(.25, .75, (3, 2))
    weights = np.stack([1 / (.01 + ((p - c) ** 2).sum(1)) for c in places], 1)
    weights = weights / weights.sum(1)[:, None]
    move = 0
    for k, centre in enumerate(places):
        t = rng.uniform(-2.2, 2.2)
        turn = np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]])
        move = move + weights[:, k:k + 1] * ((p - centre) @ turn.T + centre - p)
    return p + dies(p) * move


def network(rng, p):
    """A small network with random weights, as neural fields are."""
    hidden = np.tanh(p @ (rng.normal(size=(2, 32)) * 8) + rng.normal(size=32) * 4)
    hidden = np.tanh(hidden @ rng.normal(size=(32, 32)) * .4 + rng.normal(size=32))
    return p + dies(p) * (hidden @ rng.normal(size=(32, 2))) * .035


WARPS = (field, plate, cubic, skinned, network)


def covered_again(images, triangles):
    """Which vertices have an image that another triangle covers, too. There a warp is not one-to-one."""
    again, order = np.zeros(len(images), bool), np.argsort(images[:, 0])
    ordered = images[order]
    first = np.searchsorted(ordered[:, 0], images[triangles][:, :, 0].min(1))
    last = np.searchsorted(ordered[:, 0], images[triangles][:, :, 0].max(1), "right")
    for corners, begin, end in zip(triangles, first, last):
        q, places = images[corners], ordered[begin:end]
        side = np.array([cross(q[k - 2] - q[k], places - q[k]) for k in range(3)])
        inside = order[begin:end][(side >= 0).all(0) | (side <= 0).all(0)]
        again[np.setdiff1d(inside, corners)] = True
    return again


def drawn(seed, k, vertices, triangles):
    """A folded warp, which of its triangles fold, and its name. One of five folds much, the others little."""
    warp, (least, most) = WARPS[k % len(WARPS)], ((MILD, WILD) if k // len(WARPS) % 5 == 4 else (0, MILD))
    for again in range(1000):
        rng = np.random.default_rng([seed, 19, k, again])
        strength = np.exp(rng.uniform(np.log(.1), 0))
        images = vertices + strength * (warp(rng, vertices) - vertices)
        bad = signs(images, triangles) <= 0
        if least < bad.mean() <= most:
            return images, bad, warp.__name__
    raise RuntimeError(f"no {warp.__name__} that folds")


def warps(report, libicc, args):
    """Folded warps, made one-to-one. Most of what was one-to-one stays, bit for bit, if the warp folds little."""
    vertices, triangles = grid(48)
    kinds = {}
    for k in range(50 if args.full else 5):
        images, bad, kind = drawn(args.seed, k, vertices, triangles)
        found = kinds.setdefault(kind, [])
        if libicc is None:
            found.append((bad.mean(), 0, 0, 0, 0))
            continue
        name = f"warp {kind} {k}"
        with Clock() as clock:
            near = libicc.nearest(vertices, triangles, images)
        v, x, t = mesh_of(near)
        faults = one_to_one(v, x, t)
        report.check(near.certified and not faults, f"{name}: certified, {faults}")
        report.check(np.array_equal(v[:len(vertices)], vertices), f"{name}: the mesh's vertices keep their numbers")
        edge = ((vertices == 0) | (vertices == 1)).any(1)
        report.check(np.array_equal(x[:len(vertices)][edge], images[edge]), f"{name}: the boundary keeps its images, bit for bit")
        moved = np.hypot(*(x[:len(vertices)] - images).T)
        again = covered_again(images, triangles)
        again[triangles[bad]] = True
        once = ~again & ~edge
        kept = float((moved[once] == 0).mean())
        if bad.mean() <= MILD:
            report.at_least(f"{name}: share of what was one-to-one that is the same, bit for bit", kept, KEPT)
            report.at_most(f"{name}: median move of what was one-to-one", np.median(moved[once]), MOVED)
        found.append((bad.mean(), near.report.changed, kept, moved[once].max() / np.ptp(images, axis=0).max(), clock.seconds))
    for kind, found in kinds.items():
        v = np.array(found)
        report.say("%s: %d warps; folded %.2g to %.2g %%" % (kind, len(v), 100 * v[:, 0].min(), 100 * v[:, 0].max()) +
                   ("" if libicc is None else "; mapped anew %.2g %% in the median; of what was one-to-one %.2g %% is the same, and the "
                    "rest moved by %.2g of the size at most; %.2f s" % (100 * np.median(v[:, 1]), 100 * np.median(v[:, 2]),
                                                                       v[:, 3].max(), np.median(v[:, 4]))))
    whole(report, libicc, vertices, triangles)


def whole(report, libicc, vertices, triangles):
    """A warp that does not fold stays as it is, and one whose boundary crosses itself is refused."""
    if libicc is None:
        return
    images = vertices + dies(vertices) * .05 * np.sin(5 * vertices[:, ::-1])
    assert (areas(images, triangles) > 0).all()
    near = libicc.nearest(vertices, triangles, images)
    v, x, t = mesh_of(near)
    report.check(np.array_equal(v, vertices) and np.array_equal(x, images) and np.array_equal(t, triangles),
                 "a warp that does not fold: kept bit for bit")
    images = images.copy()
    images[0] = [2., 2.]
    try:
        libicc.nearest(vertices, triangles, images)
        report.check(False, "a boundary that crosses itself: refused")
    except libicc.BoundaryError:
        report.check(True, "")


def main():
    args = options(__doc__)
    libicc = None if args.peers else library()
    report = Report()
    points(report, libicc, args)
    tangled(report, libicc, args)
    warps(report, libicc, args)
    report.end(args.peers)


if __name__ == "__main__":
    main()
