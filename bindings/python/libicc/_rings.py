"""Outlines as polygons of GeoJSON."""

from __future__ import annotations

from typing import Any, Dict, List

import numpy as np

from ._show import rings_of


def _is_inside(point: Any, ring: Any) -> bool:
    """Whether a ray to the right from the point crosses the ring an odd number of times."""
    a, b = ring, np.roll(ring, -1, axis=0)
    above_a, above_b = a[:, 1] > point[1], b[:, 1] > point[1]
    crosses = above_a != above_b
    a, b = a[crosses], b[crosses]
    x = a[:, 0] + (point[1] - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return bool(np.count_nonzero(x > point[0]) % 2)


def _area(ring: Any) -> float:
    x, y = (ring - ring[0]).T
    return float((x * np.roll(y, -1) - y * np.roll(x, -1)).sum()) / 2


def geojson_of(vertices: Any, facets: Any) -> Dict[str, Any]:
    """The polygons between rings: every second one, from outside, bounds a hole. Outlines run counter-clockwise."""
    rings = [vertices[ring] for ring in rings_of(facets)]
    around = [[k for k, other in enumerate(rings) if other is not ring and _is_inside(ring[0], other)] for ring in rings]
    polygons: Dict[int, List[Any]] = {k: [] for k, outside in enumerate(around) if len(outside) % 2 == 0}
    for k, outside in enumerate(around):
        owner = k if k in polygons else min(outside, key=lambda other: abs(_area(rings[other])))
        ring = rings[k] if (_area(rings[k]) > 0) == (k in polygons) else rings[k][::-1]
        closed = [*map(tuple, ring.tolist()), tuple(ring[0].tolist())]
        polygons[owner].insert(0 if k == owner else len(polygons[owner]), tuple(closed))
    shapes = [tuple(polygon) for polygon in polygons.values()]
    return {"type": "Polygon", "coordinates": shapes[0]} if len(shapes) == 1 else {"type": "MultiPolygon",
                                                                                     "coordinates": tuple(shapes)}
