#!/usr/bin/env python3
"""Weights that are as symmetric as the shape. Sakaridis' thesis names symmetry as a source of structure (section 5.1). Matching
the shape with its mirror image finds the line of reflection R and the pairs of handles. On samples that are symmetric as
well, weights that are found at each sample by itself are symmetric, because they are unique. For painted or biharmonic
weights, icc_weights_repaint() gets the mean of w_j(x) and w_k(Rx), where k is the partner of handle j. It keeps sums, and
reproduction if there was any.

    python3 examples/compare/symmetric_weights.py [CAGE.txt SCENE.json]

Needs libicc for Python and NumPy.
"""

import json
import sys

import libicc
import numpy as np
from libicc import kernel


def near_reflection(cage, angle):
    """The linear part and the offset of a reflection that takes a shape nearly to itself, and by how much it fails. Of several
    such reflections, matching prefers the one whose line is near an angle."""
    mirror = np.array([[np.cos(2 * angle), np.sin(2 * angle)], [np.sin(2 * angle), -np.cos(2 * angle)]])
    match = libicc.Match(cage, cage @ mirror, least_sure=1)
    one, other = match.source.vertices, match.target.vertices @ mirror
    centre = (one + other).mean(axis=0) / 2
    z, w = [(points - centre) @ [1, 1j] for points in (one, other)]
    turn = np.exp(-1j * np.angle((np.conj(z) * np.conj(w)).sum()))
    matrix = np.array([[turn.real, turn.imag], [turn.imag, -turn.real]])
    return matrix, centre - matrix @ centre, abs(z - turn * np.conj(w)).max()


def symmetric_samples(cage, reflect, axis, spacing):
    """Samples of one side of the line, their mirror images, and samples on the line."""
    samples = kernel.Sampling(cage, spacing=spacing).points
    side = (samples - reflect(samples)) @ axis / 2
    near = samples[(side >= 0) & (side < spacing / 2)]
    half = samples[side >= spacing / 2]
    points = np.concatenate([half, reflect(half), (near + reflect(near)) / 2])
    shape = libicc.Domain(cage)
    middle = cage.mean(axis=0)
    outside = shape.locate(points) < 0
    points[outside] += 1e-12 * (middle - points[outside])  # mirror images on the boundary are rounded
    return kernel.Sampling.from_points(cage, points[shape.locate(points) >= 0])


def asymmetry(weights, points, reflect, partner):
    return abs(weights.weights(points) - weights.weights(reflect(points))[:, partner]).max()


def main():
    files = sys.argv[1:] or ["examples/data/star.txt", "examples/data/star.json"]
    cage, scene = np.loadtxt(files[0]), json.load(open(files[1], encoding="utf-8"))
    handles = np.array([handle[:2] for handle in scene["handles"]], float)
    found = [near_reflection(cage, angle) for angle in np.pi * np.arange(12) / 12]
    matrix, offset, off = min(found, key=lambda reflection: reflection[2])

    def reflect(points):
        return points @ matrix.T + offset

    distance = np.hypot(*(reflect(handles)[:, None] - handles).transpose(2, 0, 1))
    partner = distance.argmin(axis=1)
    print(f"reflection: off by {off:.0e}, handles by {distance.min(axis=1).max():.0e}; pairs {partner.tolist()}")
    if (partner[partner] != np.arange(len(handles))).any() or distance.min(axis=1).max() > 1e-9 * np.ptp(cage):
        raise SystemExit("the handles are not symmetric")
    axis = np.linalg.eigh(matrix)[1][:, 0]
    spacing = np.ptp(cage, axis=0).max() / 40
    samples = symmetric_samples(cage, reflect, axis, spacing)
    rng = np.random.default_rng(1)
    places = rng.uniform(cage.min(axis=0), cage.max(axis=0), (4000, 2))
    places = places[libicc.Domain(cage).locate(places) > 0]
    for method in ("qp", "l1", "biharmonic"):
        plain = kernel.Weights(kernel.Sampling(cage, spacing=spacing), handles, method=method)
        weights = kernel.Weights(samples, handles, method=method)
        nodes = weights.nodes()
        mean = (nodes.weights + weights.weights(reflect(nodes.points))[:, partner]) / 2
        both = weights.repaint(np.arange(len(nodes.points)), mean)
        report = both.report(places)
        off = [asymmetry(w, places, reflect, partner) for w in (plain, weights, both)]
        print(f"{method}: not symmetric by {off[0]:.0e} on blue noise, {off[1]:.0e} on symmetric samples, {off[2]:.0e} with"
              f" the mean; unity {report.unity:.0e}, reproduction {report.reproduction / np.ptp(cage):.0e}")
        if not off[2] < 1e-9:
            raise SystemExit("the weights are not symmetric")


if __name__ == "__main__":
    main()
