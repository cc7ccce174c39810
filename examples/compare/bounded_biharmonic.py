#!/usr/bin/env python3
"""Bounded biharmonic weights (A. Jacobson, I. Baran, J. Popovic, O. Sorkine 2011) beside kernel coordinates, as table 6.7 of
Sakaridis' thesis has them. libicc makes both for the handles of a scene. The biharmonic ones are also found by a second
solver, in NumPy, on a mesh of the same nodes. It prints how far its conditions of optimality fail, and the difference.

    python3 examples/compare/bounded_biharmonic.py [--cells N] [CAGE.txt SCENE.json]

Needs libicc for Python and NumPy.
"""

import argparse
import json
import time

import baselines
import libicc
import numpy as np
from libicc import kernel

MOST_ROUNDS = 100


def mesh_of(cage, nodes):
    """A mesh of the nodes, of which some lie on the cage and have all its corners among them. Returns it and its vertices
    as numbers of nodes."""
    begin, side = cage, np.roll(cage, -1, axis=0) - cage
    along = ((nodes[:, None] - begin) * side).sum(axis=2) / (side ** 2).sum(axis=1)
    off = abs(baselines.cross(nodes[:, None] - begin, side)) / np.hypot(*side.T)
    on = (off < 1e-9 * np.ptp(cage)) & (along > -1e-9) & (along < 1 - 1e-9)
    ring = [i for edge in range(len(cage)) for i in sorted(np.flatnonzero(on[:, edge]), key=lambda i, e=edge: along[i, e])]
    order = np.concatenate([ring, np.flatnonzero(~on.any(axis=1))])
    points = nodes[order]
    return baselines.Mesh(points, libicc.stages.triangulate(points, len(ring)), points), order


def bounded(energy, known, one):
    """The least w' energy w between 0 and 1, 1 at vertex `one` and 0 at the other known ones; and by how much the
    conditions of optimality fail, as a share of the largest force."""
    n = len(energy)
    state = np.zeros(n, int)  # -1 and 1: held at 0 and at 1
    weights = np.zeros(n)
    weights[one] = 1
    fixed = np.zeros(n, bool)
    fixed[known] = True
    for _ in range(MOST_ROUNDS):
        free = ~fixed & (state == 0)
        weights[~fixed & (state != 0)] = state[~fixed & (state != 0)] > 0
        weights[free] = -np.linalg.solve(energy[np.ix_(free, free)], energy[np.ix_(free, ~free)] @ weights[~free])
        force = energy @ weights
        scale = abs(force).max()
        before = state.copy()
        state[(state == -1) & (force < -1e-9 * scale) | (state == 1) & (force > 1e-9 * scale)] = 0
        state[free & (weights < -1e-12)] = -1
        state[free & (weights > 1 + 1e-12)] = 1
        if (state == before).all():
            break
    wrong = np.where(state == 0, abs(force), np.where(state < 0, np.maximum(-force, 0), np.maximum(force, 0)))
    outside = max(0, -weights.min(), weights.max() - 1)
    return weights, max((wrong[~fixed] / scale).max(), outside)


def second_opinion(cage, nodes, n_handles):
    """Bounded biharmonic weights at the nodes, the first of which are the handles."""
    start = time.process_time()
    mesh, order = mesh_of(cage, nodes)
    known = np.argsort(order)[:n_handles]
    energy = mesh.stiffness @ (mesh.stiffness / mesh.masses[:, None])
    solved = [bounded(energy, known, one) for one in known]
    weights = np.empty((len(nodes), n_handles))
    weights[order] = np.column_stack([w for w, _ in solved])
    sums = weights.sum(axis=1)
    print(f"in NumPy:           {len(nodes)} nodes, {n_handles} handles, {time.process_time() - start:.2f} s, optimal up to"
          f" {max(residual for _, residual in solved):.0e}; sums {sums.min():.2f} to {sums.max():.2f} before division")
    return weights / sums[:, None]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--cells", type=int, default=24, help="samples along the longest side (default: 24)")
    parser.add_argument("--quick", action="store_true", help="without the second solver, which is slow on many nodes")
    parser.add_argument("files", nargs="*", default=["examples/data/butterfly.txt", "examples/data/butterfly.json"])
    options = parser.parse_args()
    cage, scene = np.loadtxt(options.files[0]), json.load(open(options.files[1], encoding="utf-8"))
    handles = np.array([handle[:2] for handle in scene["handles"]], float)
    samples = kernel.Sampling(cage, spacing=np.ptp(cage, axis=0).max() / options.cells)

    for name, method in (("bounded biharmonic", "biharmonic"), ("kernel coordinates", "l1")):
        start = time.process_time()
        weights = kernel.Weights(samples, handles, method=method)
        seconds = time.process_time() - start
        nodes = weights.nodes()
        off = abs(nodes.weights @ handles - nodes.points).max() / np.ptp(cage, axis=0).max()
        print(f"{name}: {len(nodes.points)} nodes, {len(handles)} handles, {seconds:.2f} s, points reproduced up to"
              f" {off:.0e} of the size, least weight {nodes.weights.min():.0e}, {(nodes.weights == 0).mean():.0%} are 0")
        if method == "biharmonic" and not options.quick:
            other = second_opinion(cage, nodes.points, len(handles))
            print(f"                    they differ by {abs(other - nodes.weights).max():.0e} at most")


if __name__ == "__main__":
    main()
