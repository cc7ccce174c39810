#!/usr/bin/env python3
"""Bounded biharmonic weights (A. Jacobson, I. Baran, J. Popovic, O. Sorkine 2011) beside kernel coordinates, as table 6.7 of
Sakaridis' thesis has them: for the handles of a scene, weights of least squared Laplacian between 0 and 1. Each is a quadratic
program on a mesh of the cage, solved by a primal-dual active set; how far its conditions of optimality fail is printed.

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


def mesh_of(cage, handles, cells):
    """A mesh of the inside, and which of its vertices are nearest to the handles."""
    points, _, triangles = libicc.Map(cage, cage, cells=cells).mesh()
    mesh = baselines.Mesh(points, triangles, points)
    nearest = np.argmin(((handles[:, None] - points) ** 2).sum(axis=2), axis=1)
    if len(set(nearest)) < len(handles):
        raise SystemExit("two handles share a vertex: use more cells")
    return mesh, nearest


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


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--cells", type=int, default=24, help="of the mesh, along the longest side (default: 24)")
    parser.add_argument("files", nargs="*", default=["examples/data/butterfly.txt", "examples/data/butterfly.json"])
    options = parser.parse_args()
    cage, scene = np.loadtxt(options.files[0]), json.load(open(options.files[1], encoding="utf-8"))
    handles = np.array([handle[:2] for handle in scene["handles"]], float)

    start = time.process_time()
    mesh, known = mesh_of(cage, handles, options.cells)
    energy = mesh.stiffness @ (mesh.stiffness / mesh.masses[:, None])
    solved = [bounded(energy, known, one) for one in known]
    weights = np.column_stack([w for w, _ in solved])
    unity = abs(weights.sum(axis=1) - 1).max()
    print(f"bounded biharmonic: {len(mesh.points)} vertices, {len(handles)} handles, {time.process_time() - start:.2f} s,"
          f" optimal up to {max(residual for _, residual in solved):.0e}, least weight {weights.min():.0e},"
          f" sums off 1 by {unity:.2f} before they are divided by")

    start = time.process_time()
    size = np.ptp(cage, axis=0).max()
    samples = kernel.Sampling(cage, spacing=size / options.cells)
    own = kernel.Weights(samples, handles)
    seconds = time.process_time() - start
    values = own.weights(mesh.points)
    print(f"kernel coordinates: {len(own.nodes().points)} nodes, {len(handles)} handles, {seconds:.2f} s,"
          f" least weight {values.min():.0e}, sums off 1 by {abs(values.sum(axis=1) - 1).max():.0e}")


if __name__ == "__main__":
    main()
