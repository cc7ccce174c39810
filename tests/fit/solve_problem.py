"""Solves a problem of fitting by the Python binding, for a judge that knows nothing of libicc.

usage: solve_problem.py PROBLEM.json RESULT.npz

PROBLEM.json has a `kind`, and `points` with their places `to`, or numbers of vertices:

- points: control points in a `box` (lower and upper corner)
- puppet: pins inside an `outline`, which is free
- mesh: `vertices` and `triangles`, of which the vertices `fixed` go to `fixed_to`. The vertices `slide` may move along the
  directions `slide_along` only. With a `layer` of thin cells these keep their shape

RESULT.npz gets the mesh of the map: V (vertices), X (their images) and T (triangles).
"""

import json
import sys

import numpy as np

import libicc

LAYER = 1.5  # the stiffness that makes thin layers of cells move as if glued to their wall


def solve(problem):
    if problem["kind"] == "points":
        return libicc.fit(problem["points"], problem["to"], box=problem["box"])
    if problem["kind"] == "puppet":
        return libicc.fit(problem["points"], problem["to"], problem["outline"])
    if problem["kind"] == "mesh":
        sliding = (problem["slide"], problem["slide_along"]) if problem.get("slide") else None
        return libicc.fit(mesh=(problem["vertices"], problem["triangles"]),
                          vertices=(problem["fixed"], problem["fixed_to"]), sliding=sliding,
                          stiffness=LAYER if problem.get("layer") else 0)
    raise ValueError(f"no problem of kind {problem['kind']!r} is known")


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        mapping = solve(json.load(file))
    vertices, images, triangles = mapping.mesh()
    np.savez(sys.argv[2], V=vertices, X=images, T=triangles)
    print({name: value for name, value in vars(mapping.info).items() if name in (
        "model", "certified", "n_vertices", "residual", "left_out", "margin", "n_off", "most_off", "repair", "n_folded",
        "n_iterations")})


main()
