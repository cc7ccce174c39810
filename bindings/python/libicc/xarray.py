"""xarray: ``import libicc.xarray`` adds an accessor ``.icc`` to every ``DataArray`` and ``Dataset``.

    moved = elevation.icc.warp(mapping)

Rasters of rioxarray keep their reference system, because it is a coordinate like others.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional

import numpy as np
import xarray

from ._map import Map
from .raster import Grid, warp_raster

if TYPE_CHECKING:
    from ._types import Array


@xarray.register_dataarray_accessor("icc")
class RasterAccessor:
    """Applies maps to a raster whose last two dimensions, y and x, have evenly spaced coordinates."""

    def __init__(self, raster: Any):
        self._raster = raster

    @property
    def grid(self) -> Grid:
        """Where the pixels lie. The coordinates are those of their centres."""
        y, x = self._raster.dims[-2:]
        return Grid.of_centres(self._raster[x].values, self._raster[y].values)

    def warp(self, mapping: Map, like: Optional[Any] = None, *, resampling: str = "linear", fill: Optional[float] = None,
             threads: Optional[int] = None) -> Any:
        """Moves the raster by a map of the plane. Other dimensions, coordinates and attributes stay.

        >>> import libicc, libicc.xarray, numpy, xarray
        >>> square, right = [[0, 0], [4, 0], [4, 3], [0, 3]], [[1, 0], [5, 0], [5, 3], [1, 3]]
        >>> raster = xarray.DataArray(numpy.arange(12.0).reshape(3, 4), [("y", [2.5, 1.5, 0.5]), ("x", [0.5, 1.5, 2.5, 3.5])])
        >>> raster.icc.warp(libicc.Map(square, right), resampling="nearest").values
        array([[nan,  0.,  1.,  2.],
               [nan,  4.,  5.,  6.],
               [nan,  8.,  9., 10.]])

        Args:
            mapping, resampling, threads: as in `libicc.raster.warp_raster`
            like: a raster that gives the result its last two dimensions and their coordinates; None: this raster
            fill: value of pixels without an image. None: the value of pixels without data; else NaN, or 0 for whole
                numbers

        The value of pixels without data is the attribute ``_FillValue``, ``missing_value`` or ``nodata``. If xarray has
        replaced it by NaN, it is in the encoding.
        """
        raster, like = self._raster, self._raster if like is None else like
        nodata = _nodata(raster)
        if fill is None:
            fill = nodata if nodata is not None else np.nan if raster.dtype.kind == "f" else 0
        pixels: Array = np.ascontiguousarray(raster.values).reshape(-1, *raster.shape[-2:])
        warped = warp_raster(pixels, self.grid, mapping, like.icc.grid, resampling=resampling, fill=fill, nodata=nodata,
                             threads=threads)
        own, places = raster.dims[-2:], like.dims[-2:]
        coords = {name: value for name, value in raster.coords.items() if not set(own) & set(value.dims)}
        coords.update({name: like[name] for name in places})
        return xarray.DataArray(warped.reshape(*raster.shape[:-2], *like.shape[-2:]), coords,
                                (*raster.dims[:-2], *places), raster.name, raster.attrs)


@xarray.register_dataset_accessor("icc")
class DatasetAccessor:
    """Applies maps to all rasters of a dataset."""

    def __init__(self, dataset: Any):
        self._dataset = dataset

    def warp(self, mapping: Map, like: Optional[Any] = None, **options: Any) -> Any:
        """Moves every variable that lies on the dataset's grid, as `RasterAccessor.warp` does with the same arguments.
        Other variables stay. The grid is that of the first variable with two or more dimensions whose last two have
        coordinates; `like` may be a dataset, too."""
        places = _places(self._dataset)
        if isinstance(like, xarray.Dataset):
            like = like[_on(like, _places(like))[0]]
        moved = _on(self._dataset, places)
        kept = self._dataset.drop_vars([*moved, *(places if like is not None else ())])
        return kept.assign({name: self._dataset[name].icc.warp(mapping, like, **options) for name in moved})


def _places(dataset: Any) -> Any:
    """The dimensions y and x of the first raster of a dataset."""
    for raster in dataset.data_vars.values():
        if raster.ndim >= 2 and all(name in raster.coords for name in raster.dims[-2:]):
            return raster.dims[-2:]
    raise ValueError("the dataset has no raster, which is a variable whose last two dimensions have coordinates")


def _on(dataset: Any, places: Any) -> Any:
    """The names of the rasters that lie on these dimensions."""
    return [name for name, raster in dataset.data_vars.items() if raster.dims[-2:] == places]


def _nodata(raster: Any) -> Any:
    names = ("_FillValue", "missing_value", "nodata")
    if raster.dtype.kind == "f" and any(name in raster.encoding for name in names[:2]):
        return np.nan
    return next((have[name] for have in (raster.encoding, raster.attrs) for name in names if name in have), None)
