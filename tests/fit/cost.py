"""How long does a fit take, alone and with many points afterwards? Beside SciPy's thin plate, one after the other.

Times are processor time of one thread. Figures say little on a busy machine; `--times` checks them.
"""

import numpy as np
from common import Clock, Report, library, options, wants

wants("scipy")
from scipy.interpolate import RBFInterpolator                   # noqa: E402
from sheet import METRES, PIXELS, drawn                         # noqa: E402
from truths import sheet                                        # noqa: E402

# Seconds of one fit, by its number of points.
LIMITS = {100: .03, 300: .06, 1000: .2}
MANY = 3000             # from here on half of SciPy's time is the limit
GROWTH = 1.3            # the exponent of the number of points
N_AFTER, N_MANY_AFTER = 100000, 1000000


def spline(p, q):
    return RBFInterpolator(p, q, kernel="thin_plate_spline", degree=1)


def best(n_times, *makers):
    """The least time of each maker, by turns, and what it made."""
    seconds, made = [np.inf] * len(makers), [None] * len(makers)
    for _ in range(n_times):
        for k, make in enumerate(makers):
            with Clock() as clock:
                made[k] = make()
            seconds[k] = min(seconds[k], clock.seconds)
    return seconds, made


def main():
    args = options(__doc__, ("--points", {"type": int, "nargs": "*", "help": "numbers of points"}))
    libicc = None if args.peers else library()
    report, found = Report(), {}
    for n in args.points or ((100, 300, 1000, 3000) if args.full else (100, 300)):
        p = drawn(np.random.default_rng([args.seed, n]), n)
        p, q = p * PIXELS, sheet(p) * METRES
        makers = [lambda: spline(p, q)] + ([] if libicc is None else [lambda: libicc.fit(p, q, box=[[0, 0], PIXELS])])
        seconds, made = best((3 if n < 3000 else 1) if args.full else 2, *makers)
        text = f"{n} points: SciPy {seconds[0]:.4f} s"
        if libicc:
            found[n] = seconds[1]
            text += f", libicc {seconds[1]:.4f} s"
            images = made[1](p)
            report.at_most(f"{n} points: how far one is off", np.abs(images - q).max() / METRES, 1e-12)
            if args.times:
                report.at_most(f"{n} points: seconds of a fit", seconds[1], LIMITS.get(n, .5 * seconds[0] if n >= MANY else np.inf))
        report.say(text)
        for n_after in ((N_AFTER, N_MANY_AFTER) if n <= 1000 else (N_AFTER,)) if args.full else (2000,):
            places = np.random.default_rng(0).uniform(0, 1, (n_after, 2)) * PIXELS
            after = best(1, *[lambda f=f: f(places) for f in [made[0]] + ([] if libicc is None else [made[1]])])[0]
            text = f"   and {n_after} points afterwards: SciPy {seconds[0] + after[0]:.3f} s"
            if libicc:
                text += f", libicc {seconds[1] + after[1]:.3f} s"
                if args.times:
                    share = .1 if n_after >= N_MANY_AFTER else 1
                    report.at_most(f"{n} points and {n_after} afterwards: seconds", seconds[1] + after[1], share * (seconds[0] + after[0]))
            report.say(text)
    if len(found) > 1:
        first, last = min(found), max(found)
        growth = np.log(found[last] / found[first]) / np.log(last / first)
        report.say(f"growth from {first} to {last} points: n^{growth:.2f}")
        if args.times:
            report.at_most("exponent of the growth", growth, GROWTH)
    report.end(args.peers)


if __name__ == "__main__":
    main()
