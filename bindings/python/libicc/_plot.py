"""Pictures of maps and domains, by matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, Optional, Sequence

import numpy as np

from ._show import closed_lines, grid_lines, stretch_of, surfaces

if TYPE_CHECKING:
    from ._domain import Domain
    from ._map import Map
    from ._types import Floats

_ON_A_LINE = 400


def plot_map(mapping: Map, lines: int, axes: Optional[Sequence[Any]], stretch: bool, style: Dict[str, Any]) -> Any:
    if mapping.dim not in (2, 3):
        raise ValueError(f"plots are of the plane or of space; this map has dimension {mapping.dim}")
    if stretch and mapping.info.kind != "mesh":
        raise ValueError("stretch is drawn for each simplex of a mesh map; this is a curve map")
    if axes is None:
        from matplotlib import pyplot

        _, axes = pyplot.subplots(1, 2, figsize=(10, 5), layout="constrained",
                                  subplot_kw={"projection": "3d"} if mapping.dim == 3 else {})
    assert axes is not None
    before, after, facets = surfaces(mapping)
    if mapping.dim == 3:
        factors = _stretch_of_facets(mapping, facets) if stretch else None
        _plot_surface(axes[0], before, facets, None, style)
        _plot_surface(axes[1], after, facets, factors, style)
        return axes
    grid = grid_lines(before.min(0), before.max(0), lines, _ON_A_LINE)
    moved = mapping.apply(grid)
    grid[np.isnan(moved[:, 0])] = np.nan
    if stretch:
        vertices, images, triangles = mapping.mesh()
        colours = axes[1].tripcolor(*images.T, triangles, facecolors=stretch_of(vertices, images, triangles))
        axes[1].figure.colorbar(colours, ax=axes[1], label="stretch")
        style = {"linewidth": 0.3, "color": "white", **style}
    for axis, mesh, places in zip(axes, (before, after), (grid, moved)):
        axis.plot(*closed_lines(mesh, facets).T, color="black", linewidth=1.5)
        axis.plot(*places.T, **{"linewidth": 0.6, "color": "tab:blue",
                                **(style if not stretch or axis is axes[1] else {})})
        axis.set_aspect("equal")
    return axes


def _stretch_of_facets(mapping: Map, facets: Any) -> Floats:
    """The stretch of the tetrahedron behind each facet."""
    vertices, images, simplices = mapping.mesh()
    factors = stretch_of(vertices, images, simplices)
    behind: Dict[Any, float] = {}
    for left_out in range(4):
        sides = np.sort(np.delete(simplices, left_out, axis=1), axis=1)
        behind.update(zip(map(tuple, sides.tolist()), factors.tolist()))
    return np.array([behind[tuple(facet)] for facet in np.sort(facets, axis=1).tolist()])


def _plot_surface(axis: Any, vertices: Floats, facets: Any, factors: Optional[Floats], style: Dict[str, Any]) -> None:
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    corners = vertices[facets]
    if factors is None:
        faces = Poly3DCollection(corners, **{"facecolor": "lightsteelblue", "edgecolor": "0.3", "linewidth": 0.2, **style})
    else:
        faces = Poly3DCollection(corners, **{"edgecolor": "none", **style})
        faces.set_array(factors)
        axis.figure.colorbar(faces, ax=axis, label="stretch", shrink=0.7)
    axis.add_collection3d(faces)
    low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
    axis.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    axis.set_box_aspect(high - low)


def plot_domain(domain: Domain, axis: Any, style: Dict[str, Any]) -> Any:
    if domain.dim not in (2, 3):
        raise ValueError(f"plots are of the plane or of space; this domain has dimension {domain.dim}")
    if axis is None:
        from matplotlib import pyplot

        _, axis = pyplot.subplots(subplot_kw={"projection": "3d"} if domain.dim == 3 else {})
    vertices, facets = domain.vertices, domain.facets.astype(np.int64)
    if domain.dim == 3:
        _plot_surface(axis, vertices, facets, None, style)
        return axis
    axis.plot(*closed_lines(vertices, facets).T, **{"color": "black", "linewidth": 1.5, **style})
    for kind, own in domain.features:
        if kind in ("line", "point"):
            axis.plot(*own.T, color="tab:blue", linewidth=1, marker="o" if kind == "point" else None)
    axis.set_aspect("equal")
    return axis
