#!/usr/bin/env python3
"""What Sakaridis' thesis draws in its chapter 3: sums of the rows of the kernel's matrix, dual functions on a grid and on
blue noise, and on a line a dual function and interpolants that have false extrema (figures 3.1 to 3.9).

    python3 examples/compare/dual_functions.py [OUT.svg]

Needs libicc for Python and NumPy.
"""

import argparse

import numpy as np
from libicc import kernel

STEPS = 81


def square(half):
    return half * np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])


def lattice(half, n):
    ticks = np.linspace(-half, half, n)
    return np.stack(np.meshgrid(ticks, ticks), axis=-1).reshape(-1, 2)


def weights_on(sampling, handles, sigma):
    return kernel.Weights(sampling, handles, kernel="gauss", sigma=sigma, affine_tail=False)


def row_sums(places, sigma):
    return sum(np.exp(-((places - p) ** 2).sum(axis=1) / (2 * sigma ** 2)) for p in places)


def planes():
    """Titles, a size and values on a lattice of STEPS by STEPS; and values at places."""
    grid = kernel.Sampling.from_points(square(20.0), lattice(20, 41))
    noise = kernel.Sampling(square(20.0), spacing=1.25)
    for name, sampling, sigma in (("grid", grid, 3 / np.pi), ("blue noise", noise, noise.info.sigma)):
        weights = weights_on(sampling, square(20.0), sigma)
        places = weights.nodes().points
        yield f"row sums, {name}", (places, row_sums(places, sigma))
        for title, wanted in (("middle", (0, 0)), ("beside", (-5, -5)), ("outside", (-14, -14))):
            node = int(np.hypot(*(places - wanted).T).argmin())
            yield f"dual, {name}, {title}", weights.dual(node, lattice(10, STEPS)).reshape(STEPS, STEPS)


def curves():
    """Titles, samples and the curve through them, each in an interval."""
    far = 90 * square(1.0)
    for line, heats in ((np.arange(-10.0, 11), None), (np.arange(-50.0, 51), (5, 20))):
        samples = kernel.Sampling.from_points(square(100.0), np.column_stack([line, 0 * line]))
        weights = weights_on(samples, far, 3 / np.pi)

        def through(values, lower, upper, line=line, weights=weights):
            x = np.linspace(lower, upper, 801)
            basis = [weights.dual(len(far) + k, np.column_stack([x, 0 * x])) for k in range(len(line))]
            inside = (line >= lower) & (line <= upper)
            return (line[inside], values[inside]), (x, values @ np.array(basis))

        if heats is None:
            yield "dual function", through((line == 0) * 1.0, -3, 3)
            yield "f (3.36) on [-2, 2]", through(np.maximum(-line / 10, 0), -2, 2)
            continue
        matrix = np.exp(-(line[:, None] - line) ** 2 / (2 * weights.info.sigma ** 2))
        for steps, (lower, upper) in zip(heats, ((-25, -20), (-9, -4))):
            heat = (line == -30) * 1.0
            for _ in range(steps):
                heat = np.where(line == -30, 1, matrix @ heat / matrix.sum(axis=1).max())
            yield f"heat, {steps} steps", through(heat, -30, 30)
            yield f"heat, {steps} steps, on [{lower}, {upper}]", through(heat, lower, upper)


# ---- a picture

SIDE, GAP = 170, 14


def shade(value):
    """White at 0, blue above, red below."""
    strength = min(abs(value), 1)
    low, other = round(255 * (1 - strength)), round(255 * (1 - .5 * strength))
    return f"#{low:02x}{other:02x}ff" if value >= 0 else f"#ff{low:02x}{low:02x}"


def draw_plane(out, values):
    if isinstance(values, tuple):
        places, values = values
        for (x, y), value in zip((places / 40 + .5) * SIDE, values / values.max()):
            out.write(f'<circle cx="{x:.1f}" cy="{SIDE - y:.1f}" r="2" fill="{shade(value ** 4)}"/>\n')
        return
    cell = SIDE / STEPS
    for j, row in enumerate(values[::-1]):
        for i, value in enumerate(np.cbrt(row)):
            if abs(value) > .02:
                out.write(f'<rect x="{i * cell:.1f}" y="{j * cell:.1f}" width="{cell + .1:.1f}" height="{cell + .1:.1f}"'
                          f' fill="{shade(value)}"/>\n')


def draw_curve(out, samples, curve):
    low, high = min(curve[1].min(), 0), curve[1].max()

    def place(x, y):
        return ((x - curve[0][0]) / np.ptp(curve[0]) * SIDE, SIDE - (y - low) / (high - low) * SIDE)

    zero = place(0, 0)[1]
    out.write(f'<path stroke="#999" d="M0 {zero:.1f}H{SIDE}"/>\n')
    out.write('<path fill="none" stroke="#478" d="M' + "L".join(f"{x:.1f} {y:.1f}" for x, y in zip(*place(*curve))) + '"/>\n')
    for x, y in zip(*place(*samples)):
        out.write(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2" fill="#d22"/>\n')


def draw(name, rows):
    width, height = 4 * (SIDE + GAP) + GAP, -(-len(rows) // 4) * (SIDE + 2 * GAP) + GAP
    with open(name, "w", encoding="utf-8") as out:
        out.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif"'
                  f' font-size="10"><rect width="{width}" height="{height}" fill="white"/>\n')
        for k, (title, panel, values) in enumerate(rows):
            out.write(f'<g transform="translate({GAP + k % 4 * (SIDE + GAP)} {GAP + k // 4 * (SIDE + 2 * GAP)})">\n')
            panel(out, *values)
            out.write(f'<rect width="{SIDE}" height="{SIDE}" fill="none" stroke="#ccc"/>'
                      f'<text y="{SIDE + GAP - 3}">{title}</text></g>\n')
        out.write("</svg>\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("out", nargs="?", metavar="OUT.svg")
    options = parser.parse_args()
    rows = []
    for title, values in planes():
        numbers = values[1] if isinstance(values, tuple) else values
        print(f"{title:28} {numbers.min():9.2e} to {numbers.max():9.2e}")
        rows.append((title, draw_plane, (values,)))
    for title, (samples, curve) in curves():
        print(f"{title:28} {curve[1].min():9.2e} at {curve[0][curve[1].argmin()]:6.2f}, samples from {samples[1].min():9.2e}")
        rows.append((title, draw_curve, (samples, curve)))
    if options.out is not None:
        draw(options.out, rows)


if __name__ == "__main__":
    main()
