"""How accurate is a fit through control points? Beside a thin-plate spline, on an old sheet and ten kinds of truths.

The sheet has 6200 x 5400 pixels and shows 1500 m. Points are drawn at random. Errors are root mean squares over many
places, in the inner 80 % of the sheet and over all of it.
"""

import numpy as np
from common import Clock, Report, ThinPlate, geometric, library, options, rms
from truths import GLOBAL, families, sheet

PIXELS = np.array([6200., 5400.])
METRES = 1500.
# A single fit may be worse than the thin plate by this factor at most; on average it may not.
WORST = 1.25
N_PLACES = 10000
N_FULL, N_SMALL = (6, 12, 25, 75, 100, 300, 1000, 3000), (6, 12, 25, 75)
FAMILY_FULL, FAMILY_SMALL = (8, 12, 25, 75, 300), (12, 25)


def drawn(rng, n):
    """n points of the unit square, away from its sides."""
    return rng.uniform(.04, .96, (n, 2))


class Places:
    """Where errors are measured, in the unit square."""

    def __init__(self):
        self.all = np.random.default_rng(99).uniform(0, 1, (N_PLACES, 2))
        self.inner = (np.abs(self.all - .5) < .4).all(1)

    def errors(self, images, right):
        return rms((images - right)[self.inner]), rms(images - right)


def compare(libicc, points, truth, size, scale, places):
    """Errors of the thin plate, and of libicc or None, for points of the unit square; and the fit."""
    p, q = points * size, truth(points) * scale
    right, where = truth(places.all) * scale, places.all * size
    spline = places.errors(ThinPlate(p, q)(where), right)
    if libicc is None:
        return spline, None, None
    with Clock() as clock:
        fit = libicc.fit(p, q, box=[[0, 0], size])
    fit_errors = places.errors(fit(where), right)
    return spline, fit_errors, (fit, clock.seconds)


def sheets(report, libicc, args, places):
    """The sheet: on average over the draws, a fit is as good as a thin plate for each number of points."""
    for n in N_FULL if args.full else N_SMALL:
        ratios, lines = [], []
        for draw in range((5 if n <= 300 else 1) if args.full else 3):
            points = drawn(np.random.default_rng([args.seed, n, draw]), n)
            spline, fitted, made = compare(libicc, points, sheet, PIXELS, METRES, places)
            lines.append((*spline, *(fitted or (np.nan, np.nan))))
            if made:
                fit, seconds = made
                ratios.append(np.divide(fitted, spline))
                report.check(fit.certified, f"sheet, {n} points, draw {draw}: certified")
                report.at_most(f"sheet, {n} points, draw {draw}: error over the thin plate's", max(ratios[-1]), WORST)
        means = [geometric(column) if column[0] == column[0] else np.nan for column in np.array(lines).T]
        report.say("sheet, %4d points: thin plate %.4g m inside, %.4g m in all; libicc %.4g m, %.4g m" % (n, *means) +
                   (f"; margin {fit.info.margin:.3g}, left out {fit.info.left_out:.3g} m, {seconds:.3f} s" if made else ""))
        if ratios:
            for name, ratio in zip(("inside", "in all"), np.array(ratios).T):
                report.at_most(f"sheet, {n} points, {name}: mean error over the thin plate's", geometric(ratio), 1)


def kinds(report, libicc, args, places):
    """Ten kinds of truths: on average as good as a thin plate, and nowhere much worse."""
    if libicc is None:
        return
    found = {}
    for n in FAMILY_FULL if args.full else FAMILY_SMALL:
        for draw in range((4 if n <= 75 else 2) if args.full else 1):
            rng = np.random.default_rng([args.seed, 7, n, draw])
            points = drawn(rng, n)
            for name, truth in families(rng).items():
                spline, fitted, (fit, _) = compare(libicc, points, truth, np.ones(2), 1., places)
                found.setdefault(name, {}).setdefault(n, []).append((fitted[0] / spline[0], fitted[1] / spline[1],
                                                                     fit.info.left_out / fitted[1], fit.info.margin))
    for name, by_number in found.items():
        cells = ["%d: %.2f %.2f" % (n, *(geometric(c) for c in np.array(v)[:, :2].T)) for n, v in by_number.items()]
        report.say(f"{name} ({'global' if name in GLOBAL else 'local'}), error over the thin plate's, inside and in all: " +
                   "; ".join(cells))
    every = np.array([values for by_number in found.values() for v in by_number.values() for values in v])
    report.say("all: mean %.3f inside, %.3f in all; most %.2f, %.2f; left-out over true error from %.2f to %.2f" % (
        geometric(every[:, 0]), geometric(every[:, 1]), *every[:, :2].max(0), every[:, 2].min(), every[:, 2].max()))
    for column, name in enumerate(("inside", "in all")):
        report.at_most(f"ten kinds, {name}: mean error over the thin plate's", geometric(every[:, column]), 1)
        report.at_most(f"ten kinds, {name}: largest error over the thin plate's", every[:, column].max(), WORST)


def main():
    args = options(__doc__)
    libicc = None if args.peers else library()
    report, places = Report(), Places()
    sheets(report, libicc, args, places)
    kinds(report, libicc, args, places)
    report.end(args.peers)


if __name__ == "__main__":
    main()
