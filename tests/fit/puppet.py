"""How well does a figure keep its shape when pins move? Beside as-rigid-as-possible shapes on the same triangles.

Energy is the symmetric Dirichlet energy, 4 where a triangle keeps its shape and size. Figures are about 400 high.
"""

import numpy as np
from common import (EXACT, Clock, Report, areas, aspects, energies, jacobians, library, mesh_of, one_to_one, options, rms,
                    share, wants)

wants("scipy", "shapely")
from peers import Arap                                          # noqa: E402
from rigs import FEET, HANDS, HEAD, Rig                         # noqa: E402
from scipy.spatial import Delaunay, cKDTree                     # noqa: E402
from shapely.geometry import Point, Polygon                     # noqa: E402
from shapely.prepared import prep                               # noqa: E402

# Energies may be above those of as-rigid-as-possible shapes by this factor.
FACTOR = 1.02
DRAG_TRIANGLES, DRAG_PINS, DRAG_FRAMES, DRAG_RADIUS, DRAG_SECONDS = 2000, 20, 40, 60., .01


def own_mesh(outline, pins, cell):
    """A plain mesh of a figure, for the peer when libicc is not at hand."""
    inside = Polygon(outline)
    low, high = outline.min(0), outline.max(0)
    x, y = np.meshgrid(np.arange(low[0], high[0], cell), np.arange(low[1], high[1], cell * .87))
    x = x + (np.arange(len(x)) % 2)[:, None] * cell / 2
    grid, shrunk = np.c_[x.ravel(), y.ravel()], prep(inside.buffer(-.5 * cell))
    grid = np.array([p for p in grid if shrunk.contains(Point(p))])
    grid = grid[cKDTree(pins).query(grid)[0] > .5 * cell]
    vertices = np.concatenate([pins, outline, grid])
    triangles = Delaunay(vertices).simplices.astype(int)
    triangles = triangles[[inside.contains(Point(c)) for c in vertices[triangles].mean(1)]]
    turned = areas(vertices, triangles) < 0
    triangles[turned] = triangles[turned][:, ::-1]
    return vertices, triangles


def measure(vertices, images, triangles):
    """Energy of the median and of 90 % of the area."""
    j, weights = jacobians(vertices, images, triangles), areas(vertices, triangles)
    e = energies(j)
    return share(e, weights, .5), share(e, weights, .9)


def rigid_pose(vertices, triangles, pins, path):
    """The peer's images of a mesh, on which the pins are vertices."""
    distance, at = cKDTree(vertices).query(pins)
    assert distance.max() < 1e-6, "a pin is no vertex of the mesh"
    return Arap(vertices, triangles, at).pose(path)


def sound(report, name, fit, pins, to):
    """Nothing turned over, nothing overlaps, and the pins are where they were asked to be or said to be off."""
    vertices, images, triangles = mesh_of(fit)
    faults = one_to_one(vertices, images, triangles)
    report.check(fit.certified and not faults, f"{name}: certified, but {faults}" if faults else f"{name}: certified")
    off = np.hypot(*(fit(pins) - to).T)
    size = np.ptp(vertices, axis=0).max()
    report.check(int((off > EXACT * size).sum()) == fit.info.n_off,
                 f"{name}: {(off > EXACT * size).sum()} pins are off, and {fit.info.n_off} are reported")
    return vertices, images, triangles


def figure(report, libicc, args):
    """Six pins, and the arms go up."""
    rig = Rig()
    outline, rest = rig.outline(), rig.joints()
    chosen = [1, HEAD, *HANDS, *FEET]

    def path(t):
        turns = np.zeros(len(rig.angles))
        turns[3], turns[5] = -t * np.radians(75), t * np.radians(75)
        return rig.joints(turns)[chosen]

    pins, to = rest[chosen], path(1)
    cells = (4., 8.) if args.full else (8.,)
    for cell in cells:
        if libicc is None:
            vertices, triangles = own_mesh(outline, pins, cell)
        else:
            with Clock() as clock:
                fit = libicc.fit(pins, to, outline, cell=cell)
            vertices, images, triangles = sound(report, "figure", fit, pins, to)
            report.check(fit.info.n_off == 0, "figure: all pins can be reached")
        rigid = rigid_pose(vertices, triangles, pins, path)
        head, weights = rig.head(vertices[triangles].mean(1)), areas(vertices, triangles)
        line, measured = f"figure, {len(triangles)} triangles", []
        for who, images in (("as rigid as possible", rigid), *((("libicc", images),) if libicc else ())):
            middle, ninety = measure(vertices, images, triangles)
            aspect = share(aspects(jacobians(vertices, images, triangles))[head], weights[head], .9)
            faults = one_to_one(vertices, images, triangles) or "one-to-one"
            line += f"; {who}: energy {middle:.3f}, 90 % {ninety:.3f}, head {aspect:.3f}, {faults}"
            measured.append((middle, ninety, aspect))
        if libicc:
            line += f", {clock.seconds:.3f} s"
            for name, peer, value in zip(("median energy", "energy of 90 %", "aspect of the head"), *measured):
                report.at_most(f"figure: {name}", value, FACTOR * peer)
        report.say(line)


def rigs(report, libicc, args):
    """Random figures in random poses."""
    n_rigs, n_poses = (20, 10) if args.full else (2, 2)
    ratios, n_off, n_folded, seconds = [], 0, 0, []
    for k in range(n_rigs):
        rng = np.random.default_rng([args.seed, 11, k])
        rig = Rig(rng)
        outline, pins = rig.outline(), rig.joints()
        for pose in range(n_poses):
            turns = rig.pose(rng) * (1 if args.full else .6)

            def path(t, rig=rig, turns=turns):
                return rig.joints(t * turns)

            to, name = path(1), f"rig {k}, pose {pose}"
            if libicc is None:
                vertices, triangles = own_mesh(outline, pins, 10.)
            else:
                with Clock() as clock:
                    fit = libicc.fit(pins, to, outline)
                seconds.append(clock.seconds)
                vertices, images, triangles = sound(report, name, fit, pins, to)
                n_off += fit.info.n_off > 0
            rigid = rigid_pose(vertices, triangles, pins, path)
            if one_to_one(vertices, rigid, triangles):
                n_folded += 1
            elif libicc and fit.info.n_off == 0:
                ratio = max(np.divide(measure(vertices, images, triangles), measure(vertices, rigid, triangles)))
                ratios.append(ratio)
                report.at_most(f"{name}: energy over the peer's", ratio, FACTOR)
    report.check(bool(ratios) or libicc is None, "rigs: some poses in which the peer does not fold")
    report.say(f"{n_rigs} rigs in {n_poses} poses: as rigid as possible folds or overlaps in {n_folded}" +
               (f"; libicc in none, {n_off} poses cannot be reached, energy over the peer's at most {max(ratios):.4f}, "
                f"{np.median(seconds):.3f} s" if libicc and not report.broken else ""))


def drag(report, libicc, args):
    """A hand goes round a circle, frame by frame, with 20 pins."""
    rig = Rig()
    outline, rest = rig.outline(), rig.joints()
    rng, inside = np.random.default_rng([args.seed, 13]), Polygon(outline).buffer(-12)
    # The dragged hand's elbow has no pin, so the arm can bend.
    pins = list(np.delete(rest, HANDS[0] - 1, axis=0))
    hand = HANDS[0] - 1
    while len(pins) < DRAG_PINS:
        p = rng.uniform(outline.min(0), outline.max(0))
        if inside.contains(Point(p)) and np.hypot(*(np.array(pins) - p).T).min() > 20 and np.hypot(*(rest[HANDS[0]] - p)) > 100:
            pins.append(p)
    pins = np.array(pins)
    if libicc is None:
        return
    fit = libicc.fit(pins, pins, outline, cell=np.sqrt(Polygon(outline).area / DRAG_TRIANGLES / .5))
    seconds, ninety, off = [], [], 0
    for frame in range(1, (DRAG_FRAMES if args.full else DRAG_FRAMES // 4) + 1):
        angle, to = 2 * np.pi * frame / DRAG_FRAMES, pins.copy()
        to[hand] += DRAG_RADIUS * np.array([np.sin(angle), 1 - np.cos(angle)])
        with Clock() as clock:
            fit = fit.move(to)
        seconds.append(clock.seconds)
        vertices, images, triangles = sound(report, f"drag, frame {frame}", fit, pins, to)
        ninety.append(measure(vertices, images, triangles)[1])
        off += fit.info.n_off > 0
    back = rms(images - vertices) / np.ptp(vertices, axis=0).max()
    report.say("drag, %d triangles, %d pins: %.1f ms a frame in the median, %.1f at most; energy of 90 %% at most %.2f; "
               "%d frames not reached; at the end %.2g of the size from rest" % (
                   len(triangles), len(pins), 1e3 * np.median(seconds), 1e3 * max(seconds), max(ninety), off, back))
    report.check(off == 0, f"drag: all pins are reached, but not in {off} frames")
    if args.times:
        report.at_most("drag: seconds of a frame", np.median(seconds), DRAG_SECONDS)


def main():
    args = options(__doc__)
    libicc = None if args.peers else library()
    report = Report()
    figure(report, libicc, args)
    rigs(report, libicc, args)
    drag(report, libicc, args)
    report.end(args.peers)


if __name__ == "__main__":
    main()
