#!/usr/bin/env python3
"""What is gained by updating the constraints of the cousin tree, which Huynh and Gingold leave open (their section 9). Laplace's
function under f(parent) >= f(child) on a tree; then vertices whose constraint pushes go to the highest neighbour that the
cousin rule allows, and the function is found anew, until nothing moves any more or the energy does not fall.

    python3 examples/compare/reparent.py [--cells N] [--rounds N]

Needs libicc for Python and NumPy.
"""

import argparse

import libicc
import numpy as np
import outlines
from libicc import stages


class Program:
    """Vertices inside in the order of their generations, the root first; four neighbours each, -1 outside."""

    def __init__(self, outline, cells):
        tree = stages.Tree(stages.Grid(libicc.Domain(outline), cells))
        inside = np.asarray(tree.grid.inside).ravel(order="F").astype(bool)
        generations = np.asarray(tree.generations).ravel(order="F")
        vertices = np.flatnonzero(inside & (generations >= 0))
        vertices = vertices[np.argsort(generations[vertices], kind="stable")]
        number = np.full(len(inside), -1)
        number[vertices] = np.arange(len(vertices))
        row = tree.grid.shape[0]
        self.near = np.column_stack([number[vertices + step] for step in (1, row, -1, -row)])
        parents = np.asarray(tree.parents).ravel(order="F").astype(np.int64)[vertices]
        self.parent = np.array([-1 if v == 0 else number[p] for v, p in enumerate(parents)])
        n = len(vertices)
        self.laplacian = 4 * np.eye(n)
        for near in self.near.T:
            self.laplacian[np.flatnonzero(near >= 0), near[near >= 0]] = -1

    def order(self):
        """Parents before children."""
        depth = np.zeros(len(self.parent), int)
        for v in range(1, len(depth)):
            at = v
            while at != 0:
                at, depth[v] = self.parent[at], depth[v] + 1
        return np.argsort(depth, kind="stable")

    def solve(self):
        """The least energy, 1 at the root, under the constraints, and their multipliers: by the active set."""
        order, n = self.order(), len(self.parent)
        active = np.zeros(n, bool)
        for _ in range(200):
            top = np.arange(n)
            for v in order[1:]:
                top[v] = top[self.parent[v]] if active[v] else v
            tops, cluster = np.unique(top, return_inverse=True)
            ties = np.zeros((n, len(tops)))
            ties[np.arange(n), cluster] = 1
            reduced = ties.T @ self.laplacian @ ties
            values = np.ones(len(tops))
            values[1:] = -np.linalg.solve(reduced[1:, 1:], reduced[1:, 0])
            f = ties @ values
            multipliers = -self.laplacian @ f
            for v in order[:0:-1]:
                multipliers[self.parent[v]] += multipliers[v] if active[v] else 0
            multipliers[~active] = 0
            wrong = np.where(active, multipliers < -1e-12, f > f[self.parent] + 1e-12)
            wrong[0] = False
            if not wrong.any():
                break
            active = active ^ wrong
        return f, multipliers

    def related(self, v, parent, w):
        """Whether v, with that parent, and its neighbour w are parent and child or cousins."""
        if parent == w or self.parent[w] == v:
            return True
        return self.parent[w] >= 0 and self.parent[w] in self.near[parent]

    def move(self, f, multipliers):
        """Gives vertices, the most pushed first, another parent where there is a higher one; how many."""
        n_moved = 0
        for v in np.argsort(-multipliers):
            if not multipliers[v] > 1e-9:
                break
            near = self.near[v]
            for p in sorted((p for p in near if p >= 0 and f[p] > f[v] + 1e-12), key=lambda p: -f[p]):
                if all(self.related(v, p, w) for w in near if w >= 0):
                    self.parent[v] = p
                    n_moved += 1
                    break
        return n_moved


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n", maxsplit=1)[0])
    parser.add_argument("--cells", type=int, default=20, help="of the grid, along the longest side (default: 20)")
    parser.add_argument("--rounds", type=int, default=8, help="at most (default: 8)")
    options = parser.parse_args()
    for name in ("L", "C", "bone", "frog", "star", "butterfly", "three legs", "cat"):
        outline = outlines.outlines()[name]
        program = Program(outline, options.cells)
        n = len(program.parent)
        least = np.ones(n)
        least[1:] = -np.linalg.solve(program.laplacian[1:, 1:], program.laplacian[1:, 0])
        bound = least @ program.laplacian @ least
        energies, moved = [], []
        for _ in range(options.rounds):
            f, multipliers = program.solve()
            energies.append(f @ program.laplacian @ f)
            if len(energies) > 1 and not energies[-1] < energies[-2] * (1 - 1e-12):
                break
            moved.append(program.move(f, multipliers))
            if moved[-1] == 0:
                break
        print(f"{name}: {n} vertices; energy above the free one's: first {100 * (energies[0] / bound - 1):.3f} %,"
              f" last {100 * (energies[-1] / bound - 1):.3f} %; moved {', '.join(map(str, moved))}")


if __name__ == "__main__":
    main()
