"""Pictures of maps, by matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence

import numpy as np

if TYPE_CHECKING:
    from ._map import Map
    from ._types import Floats

_ON_A_LINE = 400


def plot_map(mapping: Map, lines: int, axes: Optional[Sequence[Any]], style: Dict[str, Any]) -> Any:
    if mapping.dim != 2:
        raise ValueError(f"plots are of the plane; this map has dimension {mapping.dim}")
    if axes is None:
        from matplotlib import pyplot

        _, axes = pyplot.subplots(1, 2, figsize=(10, 5), layout="constrained")
    assert axes is not None
    vertices, images, triangles = mapping.mesh()
    grid = _grid(vertices.min(0), vertices.max(0), lines)
    moved = mapping(grid)
    grid[np.isnan(moved[:, 0])] = np.nan
    for axis, mesh, places in zip(axes, (vertices, images), (grid, moved)):
        outline = _outline(mesh, triangles)
        axis.plot(*outline.T, color="black", linewidth=1.5)
        axis.plot(*places.T, **{"linewidth": 0.6, "color": "tab:blue", **style})
        axis.set_aspect("equal")
    return axes


def _grid(low: Floats, high: Floats, lines: int) -> Floats:
    """Points on lines along both axes, one line after the other with NaN between, (n, 2)."""
    step, parts = (high - low).max() / lines, []
    for axis in (0, 1):
        along = np.linspace(low[1 - axis], high[1 - axis], _ON_A_LINE)
        for at in np.arange(low[axis] + step / 2, high[axis], step):
            line = np.empty((_ON_A_LINE + 1, 2))
            line[:-1, axis], line[:-1, 1 - axis] = at, along
            line[-1] = np.nan
            parts.append(line)
    return np.concatenate(parts)


def _outline(places: Floats, triangles: Any) -> Floats:
    """The edges that belong to one triangle only, joined to closed lines with NaN between, (n, 2)."""
    edges = np.concatenate([triangles[:, [i, (i + 1) % 3]] for i in range(3)]).astype(np.int64)
    whole = {(a, b) for a, b in edges.tolist()}
    following: Dict[int, List[int]] = {}  # several where rings touch
    for a, b in sorted(whole):
        if (b, a) not in whole:
            following.setdefault(a, []).append(b)
    parts = []
    for first in sorted(following):
        while following[first]:
            ring, at = [first], following[first].pop()
            while at != first:
                ring.append(at)
                at = following[at].pop()
            parts += [places[[*ring, first]], np.full((1, 2), np.nan)]
    return np.concatenate(parts[:-1])
