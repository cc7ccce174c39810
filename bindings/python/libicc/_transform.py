"""Maps as objects that can be called, turned around and chained: `Map`, its inverse, and one map after another."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Tuple

import numpy as np

from ._core import is_geometry
from ._errors import Error, OutsideError

if TYPE_CHECKING:
    from ._types import ArrayLike, Floats


class Transform:
    """What maps, inverse maps and chains of maps have in common.

    >>> slope = libicc.Map([[0, 0], [4, 0], [4, 3], [0, 3]], [[0, 0], [4, 1], [4, 4], [0, 3]])
    >>> [float(round(x, 6)) for x in slope(1, 1)]
    [1.0, 1.25]
    >>> back = slope.inverse
    >>> (back @ slope)([[1, 1]]).round(6)
    array([[1., 1.]])
    >>> back.certified and back.inverse is slope
    True
    """

    dim: Any
    certified: Any
    #: As those of `Map`.
    apply: Any
    apply_inverse: Any
    jacobian: Any

    def __call__(self, points: Any, *axes: Any, **options: Any) -> Any:
        """Maps what you give, and returns the same form.

        Args:
            points: points as for `apply`. A DataFrame of pandas and a DataArray of xarray keep their labels, and what
                Dask computes later stays lazy. Or the first coordinates, and the others in `axes`: ``m(x, y)`` returns
                the new x and y, as the transformers of pyproj do. Or a geometry of shapely, whose vertices move. Or
                GeoJSON (a dict, or anything with ``__geo_interface__``), which comes back as a dict
            options: status, progress and threads, as for `apply`. ``m(x, y, status=True)`` returns the new x and y as
                a pair, and the states of the points

        Raises:
            OutsideError: for a geometry that lies partly outside. Points get NaN instead
        """
        if axes:
            if type(points) is float and len(axes) == 1 and type(axes[0]) is float and not options and self.dim == 2:
                return self._one(points, axes[0])
            return _by_axis(self, (points, *axes), options)
        if isinstance(points, np.ndarray):
            return self.apply(points, **options)
        if hasattr(points, "iloc") and hasattr(points, "geometry"):
            return _move_frame(self, points)
        if _is_labelled(points):
            return self.apply(points, **options) if options.get("status") else _move_labelled(self, points, options)
        if is_geometry(points):
            return move_geometry(self, points)
        if isinstance(points, dict) or hasattr(points, "__geo_interface__"):
            return move_geojson(self, points if isinstance(points, dict) else points.__geo_interface__)
        return self.apply(points, **options)

    def _one(self, x: float, y: float) -> Tuple[float, ...]:
        """The image of one point of the plane."""
        return tuple(self.apply((x, y))[0].tolist())

    @property
    def inverse(self) -> "Transform":
        """The way back, as a map: call it with points, or hand it on."""
        return Inverse(self)

    def __invert__(self) -> "Transform":
        return self.inverse

    def __matmul__(self, first: "Transform") -> "Transform":
        """``second @ first`` maps by `first`, and then by `second`."""
        if not isinstance(first, Transform):
            return NotImplemented
        return Chain(first, self)


class Inverse(Transform):
    """A map turned around. It keeps the map, and can be pickled if the map can."""

    def __init__(self, mapping: Transform):
        self._map = mapping

    @property
    def dim(self) -> int:
        """How many coordinates points have."""
        return int(self._map.dim)

    @property
    def certified(self) -> bool:
        """Whether the map is proved to be one-to-one."""
        return bool(self._map.certified)

    def apply(self, points: ArrayLike, **options: Any) -> Any:
        return self._map.apply_inverse(points, **options)

    def apply_inverse(self, points: ArrayLike, **options: Any) -> Any:
        return self._map.apply(points, **options)

    def jacobian(self, points: ArrayLike, **options: Any) -> Floats:
        return _inverted(self._map.jacobian(self._map.apply_inverse(points, **options), **options))

    @property
    def inverse(self) -> Transform:
        return self._map

    def __repr__(self) -> str:
        return f"<the inverse of {self._map!r}>"


class Chain(Transform):
    """One map after another. A point has an image if the first map's image lies in the second map's source."""

    def __init__(self, first: Transform, second: Transform):
        if first.dim != second.dim:
            raise ValueError(f"the first map has dimension {first.dim}, the second {second.dim}")
        self._first, self._second = first, second

    @property
    def dim(self) -> int:
        """How many coordinates points have."""
        return int(self._first.dim)

    @property
    def certified(self) -> bool:
        """Whether both maps are proved to be one-to-one, and so their chain wherever it gives an image."""
        return bool(self._first.certified and self._second.certified)

    def apply(self, points: ArrayLike, **options: Any) -> Any:
        return _one_after_another(self._first.apply, self._second.apply, points, options)

    def apply_inverse(self, points: ArrayLike, **options: Any) -> Any:
        return _one_after_another(self._second.apply_inverse, self._first.apply_inverse, points, options)

    def jacobian(self, points: ArrayLike, **options: Any) -> Floats:
        between = self._first.apply(points, **options)
        result: Floats = self._second.jacobian(between, **options) @ self._first.jacobian(points, **options)
        return result

    @property
    def inverse(self) -> Transform:
        return Chain(self._second.inverse, self._first.inverse)

    def __repr__(self) -> str:
        return f"<{self._first!r}, then {self._second!r}>"


def _one_after_another(first: Any, second: Any, points: ArrayLike, options: Any) -> Any:
    if not options.get("status"):
        return second(first(points, **options), **options)
    between, failed = first(points, **options)
    images, states = second(between, **options)
    return images, np.where(failed != 0, failed, states)


def _inverted(matrices: Floats) -> Floats:
    """Inverse matrices, NaN where there is none."""
    result = np.full_like(matrices, np.nan)
    good = np.isfinite(matrices).all(axis=(-2, -1))
    result[good] = np.linalg.inv(matrices[good])
    return result


def _by_axis(mapping: Transform, axes: Tuple[Any, ...], options: Any) -> Tuple[Any, ...]:
    """Maps coordinates that come one axis at a time. Further axes, such as heights, stay as they are."""
    dim = mapping.dim
    if len(axes) < dim:
        raise TypeError(f"the map has {dim} coordinates; {len(axes)} are given")
    if dim == 2 and not options and all(type(axis) is float for axis in axes):
        return (*mapping._one(*axes[:2]), *axes[2:])
    arrays = np.broadcast_arrays(*(np.asarray(axis) for axis in axes[:dim]))
    shape = arrays[0].shape
    images = mapping.apply(np.stack(arrays, axis=-1).reshape(-1, dim), **options)
    images, states = images if options.get("status") else (images, None)
    moved = np.moveaxis(images.reshape(*shape, dim), -1, 0)
    result = (*(moved.tolist() if moved.ndim == 1 else moved), *axes[dim:])
    return result if states is None else (result, states.reshape(shape)[()])


def _move(mapping: Transform, coordinates: Floats) -> Floats:
    """Moves vertices; further coordinates stay. Raises an error if one has no image."""
    images = mapping.apply(coordinates[..., :mapping.dim])
    lost = np.isnan(images).any(axis=-1)
    if lost.any():
        raise OutsideError(f"{int(lost.sum())} of the geometry's {lost.size} vertices have no image, because they lie "
                           "outside; cut the geometry to the shape first, or map its coordinates by apply(), which "
                           "gives NaN there", Error.OUTSIDE, int(np.argmax(lost)), 0, "vertex")
    return np.concatenate([images, coordinates[..., mapping.dim:]], axis=-1)


def move_geometry(mapping: Transform, geometry: Any) -> Any:
    """A geometry of shapely with moved vertices."""
    from shapely.ops import transform

    def moved(*axes: Any) -> Any:
        return _move(mapping, np.array(axes, dtype=np.float64).T).T

    return transform(moved, geometry)


def _move_frame(mapping: Transform, frame: Any) -> Any:
    """A GeoSeries or GeoDataFrame with moved vertices."""
    from . import geopandas  # noqa: F401, adds the accessor

    return frame.icc.map(mapping)


_LABELLED = (("dims", "coords"), ("map_partitions",), ("map_blocks", "dask"), ("iloc", "columns"))
"""Members of a DataArray of xarray, a frame of Dask, an array of Dask and a DataFrame of pandas."""


def _is_labelled(points: Any) -> bool:
    return any(all(hasattr(type(points), name) for name in members) for members in _LABELLED)


def _move_labelled(mapping: Transform, points: Any, options: Any) -> Any:
    """Points with labels keep them. Those of Dask are mapped when they are computed."""
    kind = type(points)
    if hasattr(kind, "dims"):
        return points.copy(data=mapping(points.data, **options))
    if hasattr(kind, "map_partitions"):
        return points.map_partitions(mapping)
    if hasattr(kind, "map_blocks"):
        from .dask import map_points

        return map_points(mapping, points)
    return kind(mapping.apply(points.to_numpy(), **options), points.index, points.columns)


def move_geojson(mapping: Transform, tree: Any) -> Any:
    """GeoJSON with moved coordinates; everything else stays. Boxes are left out."""
    result = {key: value for key, value in tree.items() if key != "bbox"}
    if tree.get("coordinates"):
        result["coordinates"] = _move_nested(mapping, tree["coordinates"])
    for key in ("geometries", "features"):
        if key in tree:
            result[key] = [move_geojson(mapping, one) for one in tree[key]]
    if tree.get("geometry"):
        result["geometry"] = move_geojson(mapping, tree["geometry"])
    if not result.keys() & {"coordinates", "geometries", "features", "geometry"}:
        raise TypeError(f"this dict is no GeoJSON: it has {', '.join(map(str, tree))}")
    return result


def _move_nested(mapping: Transform, coordinates: Any) -> Any:
    first = coordinates[0] if len(coordinates) else ()
    if np.ndim(first) == 0:
        return _move(mapping, np.array([coordinates], dtype=np.float64))[0].tolist()
    if np.ndim(first) == 1 and all(np.ndim(x) == 0 for x in first):
        return _move(mapping, np.array(coordinates, dtype=np.float64)).tolist()
    return [_move_nested(mapping, part) for part in coordinates]
