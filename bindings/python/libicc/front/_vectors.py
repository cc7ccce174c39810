"""Vectors at the points and in the cells of a mesh get the rotation of the map and keep their length."""

from __future__ import annotations

from typing import Any, List, Tuple

import numpy as np

STEP = 2.0**-20
"""Beside a point of the boundary the derivative is taken this far towards the middle of a cell."""


def rotate(mesh: Any, mapping: Any, points: Any) -> str:
    """Rotates all arrays of three floating-point numbers, and says how many. `points` are those before the map."""
    middles = [points[np.asarray(block.data)].mean(axis=1) for block in mesh.cells]
    beside = points.copy()
    for block, middle in zip(mesh.cells, middles):
        for nodes in np.asarray(block.data).T:
            beside[nodes] = points[nodes] + STEP * (middle - points[nodes])
    found: List[Tuple[Any, Any, Any, Any]] = [(mesh.point_data, name, points, beside) for name in mesh.point_data]
    found += [(blocks, at, middle, middle) for blocks in mesh.cell_data.values() for at, middle in enumerate(middles)]
    n_arrays = n_vectors = n_still = 0
    for holder, key, at, near in found:
        field = np.array(holder[key])
        if field.ndim != 2 or field.shape[1] != 3 or field.dtype.kind != "f":
            continue
        images = np.einsum("nij,nj->ni", _rotations(mapping, at, near), field)
        still = ~np.isfinite(images).all(axis=1)
        told = still & np.isfinite(field).all(axis=1) & field.any(axis=1)
        holder[key] = np.where(still[:, None], field, images).astype(field.dtype)
        n_arrays, n_vectors, n_still = n_arrays + 1, n_vectors + len(field), n_still + int(told.sum())
    return f"{n_vectors} vectors in {n_arrays} arrays: {n_vectors - n_still} rotated, {n_still} not rotated"


def _rotations(mapping: Any, at: Any, near: Any) -> Any:
    """The rotation of the polar decomposition of each derivative, NaN where there is none."""
    n, dim = at.shape
    derivatives = mapping.jacobian(at)
    lost = np.isnan(derivatives).any(axis=(1, 2))
    if lost.any():
        derivatives[lost] = mapping.jacobian(near[lost])
    lost = np.isnan(derivatives).any(axis=(1, 2))
    out = np.tile(np.eye(3), (n, 1, 1))
    u, _, v = np.linalg.svd(derivatives[~lost])
    out[~lost, :dim, :dim] = u @ v
    out[lost] = np.nan
    return out
