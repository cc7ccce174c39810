"""GeoPandas: ``import libicc.geopandas`` adds an accessor ``.icc`` to every series and frame of geometries.

    moved = frame.icc.map(mapping, tolerance=0.5)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, List, Tuple

import geopandas
import numpy as np
from pandas.api.extensions import register_dataframe_accessor, register_series_accessor
from shapely.ops import transform

from ._errors import Error, OutsideError
from ._layer import exact_images
from ._map import Map
from ._transform import Transform

if TYPE_CHECKING:
    from ._types import Array, Floats

_MOST_ROUNDS = 12
_QUARTERS = np.array([0.25, 0.5, 0.75])[:, None]


@register_series_accessor("icc")
class GeometryAccessor:
    """Applies maps to the geometries of a series."""

    def __init__(self, series: Any):
        if not hasattr(series, "geom_type"):
            raise AttributeError("only series of geometries have .icc")
        self._series = series

    def map(self, mapping: Transform, *, inverse: bool = False, tolerance: float = 0, exact: bool = False,
            outside: str = "raise") -> Any:
        """Moves the geometries by a map of the plane. They keep their index, CRS and heights.

        >>> import geopandas, libicc, libicc.geopandas
        >>> from shapely.geometry import LineString
        >>> before, after = [[0, 0], [4, 0], [4, 3], [0, 3]], [[0, 0], [4, 1], [4, 4], [0, 3]]
        >>> lines = geopandas.GeoSeries([LineString([(1, 1), (2, 1)])])
        >>> lines.icc.map(libicc.Map(before, after)).length.round(6)[0]
        1.030776

        Args:
            inverse: map from the target to the source
            tolerance: edges get more vertices, at most 4095 each, until their quarter points are within this distance
                of the true images; 0: no more vertices
            exact: edges get a vertex wherever they cross an edge of the map's triangles, so their images are exact. A
                vertex on a neighbour's edge becomes a vertex of that edge, too. So polygons that share edges stay
                without gaps and overlaps. Only for mesh maps
            outside: what happens to geometries that lie partly or wholly outside: "raise" an `OutsideError`, or become
                "null"
        """
        if outside not in ("raise", "null"):
            raise ValueError(f"outside must be 'raise' or 'null', not {outside!r}")
        if mapping.dim != 2:
            raise ValueError(f"geometries are of the plane; this map has dimension {mapping.dim}")
        if exact and tolerance > 0:
            raise ValueError("exact and tolerance exclude each other")
        if exact and not (isinstance(mapping, Map) and mapping.info.kind == "mesh"):
            raise ValueError("exact needs the triangles of a mesh map; for an inverse give the map itself and inverse=True, "
                             "for others a tolerance")
        lines, counts = _lines_of(self._series)
        carried = iter(_carried(lines, mapping, inverse, tolerance, exact))
        moved: List[Any] = []
        for (label, geometry), count in zip(self._series.items(), counts):
            own = [next(carried) for _ in range(count)]
            lost = any(np.isnan(line[:, :2]).any() for line in own)
            if lost and outside == "raise":
                raise OutsideError(f"the geometry at {label!r} has no image, be it in part; outside='null' leaves such "
                                   "out", Error.OUTSIDE, len(moved), 0, "feature")
            each = iter(own)
            moved.append(None if lost or geometry is None else transform(lambda *axes: next(each).T, geometry))
        return geopandas.GeoSeries(moved, index=self._series.index, crs=self._series.crs, name=self._series.name)


@register_dataframe_accessor("icc")
class FrameAccessor:
    """Applies maps to the active geometries of a frame. The other columns stay."""

    def __init__(self, frame: Any):
        if not isinstance(frame, geopandas.GeoDataFrame):
            raise AttributeError("only frames with geometries have .icc: geopandas.GeoDataFrame(frame, geometry=..)")
        self._frame = frame

    def map(self, mapping: Transform, **options: Any) -> Any:
        """Moves the geometries as `GeometryAccessor.map` does, with the same options."""
        return self._frame.set_geometry(self._frame.geometry.icc.map(mapping, **options))


def _lines_of(series: Any) -> Tuple[List[Floats], List[int]]:
    """The coordinates of all points, lines and rings, in the order of `transform`, and how many each geometry has."""
    lines: List[Floats] = []
    counts = []

    def note(*axes: Any) -> Any:
        lines.append(np.array(axes, dtype=float).T)
        return axes

    for geometry in series:
        before = len(lines)
        if geometry is not None:
            transform(note, geometry)
        counts.append(len(lines) - before)
    return lines, counts


def _carried(lines: List[Floats], mapping: Transform, inverse: bool, tolerance: float, exact: bool) -> List[Floats]:
    """Moves all lines at once, NaN where there is no image. Coordinates beyond the first two stay."""
    if not lines:
        return []
    width = max(line.shape[1] for line in lines)
    points = np.concatenate([np.pad(line, ((0, 0), (0, width - line.shape[1]))) for line in lines])
    number = np.repeat(np.arange(len(lines)), [len(line) for line in lines])
    if exact:
        assert isinstance(mapping, Map)
        points, images, number = exact_images(points, number, mapping, inverse)
    else:
        points, images, number = _bent(points, number, mapping.apply_inverse if inverse else mapping.apply, tolerance)
    points[:, :2] = images
    parts = np.split(points, np.searchsorted(number, np.arange(1, len(lines))))
    return [part[:, :line.shape[1]] for part, line in zip(parts, lines)]


def _bent(points: Floats, number: Array, carry: Callable[[Floats], Floats],
          tolerance: float) -> Tuple[Floats, Floats, Array]:
    """Adds vertices until all lines are right to a tolerance: the positions, their images, and the line of each."""
    images = carry(points[:, :2])
    begins = np.flatnonzero(number[:-1] == number[1:]) if tolerance > 0 else np.empty(0, int)
    for _ in range(_MOST_ROUNDS):
        begins, points, images, number = _split(begins, points, images, number, carry, tolerance)
        if len(begins) == 0:
            break
    return points, images, number


def _split(begins: Array, points: Floats, images: Floats, number: Array, carry: Callable[[Floats], Floats],
           tolerance: float) -> Tuple[Array, Floats, Floats, Array]:
    """Halves the edges that begin at these points where their images bend. Returns where the halves begin, and all
    points with those between. A quarter without an image takes that of its edge away."""
    edges = points[begins, None] + _QUARTERS * (points[begins + 1] - points[begins])[:, None]
    checks = carry(edges[:, :, :2]) if len(begins) else np.empty((0, 3, 2))
    lost = np.isnan(checks).any(axis=(1, 2))
    images[begins[lost]] = np.nan
    far = ~lost & (_off(images[begins], images[begins + 1], checks) > tolerance)
    at = begins[far] + 1
    first = at + np.arange(len(at))
    return (np.sort(np.concatenate([first - 1, first])), np.insert(points, at, edges[far, 1], axis=0),
            np.insert(images, at, checks[far, 1], axis=0), np.insert(number, at, number[begins[far]]))


def _off(a: Floats, b: Floats, checks: Floats) -> Floats:
    """Distance from each segment a b to the farthest of its checks (n, 3, 2)."""
    along = (b - a)[:, None]
    square = (along**2).sum(-1)
    share = ((checks - a[:, None]) * along).sum(-1) / np.where(square > 0, square, 1)
    nearest = a[:, None] + np.clip(share, 0, 1)[..., None] * along
    return np.sqrt(((checks - nearest) ** 2).sum(-1)).max(axis=1)
