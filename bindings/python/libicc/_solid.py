"""Voids, surfaces, lines and points inside solids."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Iterable, List, Optional, Tuple

import numpy as np

from ._abi import lib, structs
from ._core import Progress, address, create, indices, points_of

if TYPE_CHECKING:
    from ._types import ArrayLike, Floats, Indices

KINDS = {"hole": 1, "line": 2, "point": 3, "region": 4}

Feature = Tuple[str, "Floats", Optional["Indices"]]
"""The kind, the vertices, and the triangles of a surface."""


def _surface(kind: str, surface: Any) -> Feature:
    try:
        vertices, facets = surface
    except (TypeError, ValueError):
        raise ValueError(f"a {kind} of a solid is a pair of vertices (n, 3) and triangles (m, 3)") from None
    return kind, points_of(vertices, 3), indices(triangles_of(vertices, facets), 3, f"the triangles of a {kind}")


def split_quads(quads: ArrayLike) -> Any:
    """Two triangles for each quadrilateral, split from its first vertex, as the command does."""
    corners = np.asarray(quads)
    return corners[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def triangles_of(vertices: Any, facets: Any) -> Any:
    """Facets of a surface with quadrilaterals (n, 4) split; others as they are."""
    is_surface = facets is not None and np.ndim(vertices) == 2 and np.shape(vertices)[1] == 3
    return split_quads(facets) if is_surface and np.ndim(facets) == 2 and np.shape(facets)[1] == 4 else facets


def solid_features(voids: Iterable[Any], surfaces: Iterable[Any], lines: Iterable[ArrayLike],
                   points: Optional[ArrayLike]) -> List[Feature]:
    """The features of a solid in the order voids, surfaces, lines, points."""
    features = [_surface("hole", void) for void in voids] + [_surface("region", surface) for surface in surfaces]
    features += [("line", points_of(line, 3), None) for line in lines]
    if points is not None and np.size(points) > 0:
        features += [("point", point.reshape(1, 3), None) for point in points_of(points, 3)]
    return features


def solid_features_in_order(features: Iterable[Tuple[str, Any]]) -> List[Feature]:
    """The features that are given in order: a kind and vertices, or for surfaces vertices and triangles."""
    result: List[Feature] = []
    for number, (kind, shape) in enumerate(features):
        if kind not in KINDS:
            raise ValueError(f"feature {number} must be one of {', '.join(KINDS)}, not {kind!r}")
        if kind in ("hole", "region"):
            result.append(_surface(kind, shape))
        else:
            result.append((kind, points_of(np.reshape(shape, (-1, 3)), 3), None))
    return result


def make_solid(vertices: ArrayLike, facets: ArrayLike, features: List[Feature], progress: Optional[Progress],
               threads: Optional[int]) -> int:
    """Makes the domain of a solid with features."""
    outer, triangles = points_of(vertices, 3), indices(facets, 3, "facets")
    all_features = (structs.feature * len(features))()
    for feature, (kind, own, own_facets) in zip(all_features, features):
        feature.size = ctypes.sizeof(structs.feature)
        feature.kind, feature.n_vertices, feature.vertices = KINDS[kind], len(own), address(own)
        if own_facets is not None:
            feature.n_facets, feature.facets = len(own_facets), address(own_facets)
    return create(lib.domain_create_solid, len(outer), address(outer), len(triangles), address(triangles),
                  len(features), ctypes.addressof(all_features), progress=progress, threads=threads)
