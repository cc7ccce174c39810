"""The part of the Blender add-on that needs no Blender: examples/blender/libicc_cage/cage_deform.py."""

import sys
from pathlib import Path

HERE = Path(__file__).resolve()
sys.path.insert(0, str(HERE.parents[2] / "examples/blender/libicc_cage"))

import cage_deform
import libicc
import numpy as np

corners = np.array(np.meshgrid([0, 1], [0, 1], [0, 1], indexing="ij"), float).reshape(3, -1).T
triangles = np.array([[0, 1, 2], [2, 1, 3], [4, 6, 5], [6, 7, 5], [0, 4, 1], [4, 5, 1], [2, 3, 6], [6, 3, 7],
                      [0, 2, 4], [4, 2, 6], [1, 5, 3], [5, 7, 3]])
points = np.random.default_rng(1).uniform(-0.1, 1.1, (2000, 3))
outside = ((points < 0) | (points > 1)).any(axis=1)

cage, first = cage_deform.Cage(corners, triangles), {}
for share in (0.2, 0.4, 0.2):
    moved = corners + share * corners[:, [2]] * [1.0, 0.5, 0.0]  # a shear, which the map must be on a cube's faces
    assert cage.move(moved).certified
    images, n_outside = cage.deform(points)
    assert n_outside == outside.sum() and np.array_equal(images[outside], points[outside])
    assert np.isfinite(images).all()
    assert np.abs(cage.map(corners) - moved).max() < 1e-12
    assert np.abs(cage.map.inverse(images[~outside]) - points[~outside]).max() < 1e-9
    assert np.array_equal(first.setdefault(share, images), images), "a pose depends on the pose before it"
assert cage.is_of(corners, triangles) and not cage.is_of(moved, triangles)

matrix = np.array([[0, -2, 0, 5], [2, 0, 0, 6], [0, 0, 2, 7], [0, 0, 0, 1]])
assert np.array_equal(cage_deform.transformed(matrix, np.array([[1.0, 2.0, 3.0]])), [[1.0, 8.0, 13.0]])

try:
    cage.move(corners[:-1])
except ValueError as error:
    assert "number of its vertices" in str(error), error
else:
    sys.exit("a cage with another number of vertices is taken")

for wrong, word in ((triangles[1:], "open"), (triangles[:, ::-1][:1], "facets")):
    try:
        cage_deform.Cage(corners, wrong)
    except libicc.Error as error:
        assert word in str(error), error
    else:
        sys.exit(f"a surface that is wrong is bound: {word}")
