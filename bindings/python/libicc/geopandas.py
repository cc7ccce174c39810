"""GeoPandas: ``import libicc.geopandas`` adds an accessor ``.icc`` to every series and frame of geometries.

    moved = frame.icc.map(mapping, tolerance=0.5)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, List, Tuple

import geopandas
import numpy as np
from pandas.api.extensions import register_dataframe_accessor, register_series_accessor
from shapely.ops import transform

from ._errors import Error, OutsideError
from ._layer import move_lines
from ._transform import Transform

if TYPE_CHECKING:
    from ._types import Floats


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
        lines, counts = _lines_of(self._series)
        carried = iter(move_lines(lines, mapping, inverse=inverse, tolerance=tolerance, exact=exact))
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
