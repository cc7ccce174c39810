"""Warps rasters that have a place in the world, window by window, in NumPy.

A raster is an array (height, width) or (bands, height, width), and a `Grid` that says where its pixels lie. Every pixel
of a result is computed separately. So a window of the result has the same bits as that part of the whole. `libicc.dask`
spreads windows over processes, and `libicc.xarray` keeps the coordinates of a ``DataArray`` in step.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, NamedTuple, Optional, Sequence, Tuple

import numpy as np

from ._map import Map

if TYPE_CHECKING:
    from ._types import Array, ArrayLike, Floats

RESAMPLING = ("nearest", "linear", "cubic")


class Window(NamedTuple):
    """Rows and columns of a raster, each from one up to another."""

    row: int
    row_end: int
    column: int
    column_end: int

    @property
    def shape(self) -> Tuple[int, int]:
        return self.row_end - self.row, self.column_end - self.column


class Grid(NamedTuple):
    """Where the pixels of a raster lie.

    >>> Grid((10.0, 0.0, 500.0, 0.0, -10.0, 800.0), 2, 3).centres()[0]
    array([[505., 795.],
           [515., 795.],
           [525., 795.]])

    Args:
        transform: (a, b, c, d, e, f): the corner of pixel [row, column] is at x = a column + b row + c,
            y = d column + e row + f; the first six numbers of a ``rasterio`` transform
        height, width: number of pixels
    """

    transform: Tuple[float, ...]
    height: int
    width: int

    @classmethod
    def of_centres(cls, x: ArrayLike, y: ArrayLike) -> "Grid":
        """The grid whose columns have their centres at x, and whose rows at y, evenly spaced."""
        steps, starts = [], []
        for name, values in (("x", np.asarray(x, dtype=float)), ("y", np.asarray(y, dtype=float))):
            if values.ndim != 1 or len(values) < 2:
                raise ValueError(f"{name} must be two or more coordinates, not of the shape {values.shape}")
            step = float(values[-1] - values[0]) / (len(values) - 1)
            if not np.allclose(np.diff(values), step, rtol=1e-6, atol=0):
                raise ValueError(f"{name} is not evenly spaced")
            steps.append(step)
            starts.append(float(values[0]) - step / 2)
        return cls((steps[0], 0.0, starts[0], 0.0, steps[1], starts[1]), len(np.asarray(y)), len(np.asarray(x)))

    @property
    def whole(self) -> Window:
        """All of it."""
        return Window(0, self.height, 0, self.width)

    def centres(self, window: Optional[Window] = None) -> Floats:
        """The centres of pixels, (height, width, 2)."""
        window = window or self.whole
        a, b, c, d, e, f = self.transform
        column = np.arange(window.column, window.column_end) + 0.5
        row = (np.arange(window.row, window.row_end) + 0.5)[:, None]
        return np.stack([a * column + b * row + c, d * column + e * row + f], axis=-1)

    def pixels(self, points: Floats) -> Tuple[Floats, Floats]:
        """Columns and rows, with fractions, of points (.., 2)."""
        a, b, c, d, e, f = self.transform
        det = a * e - b * d
        if det == 0:
            raise ValueError(f"the grid's rows and columns have one direction: {self.transform}")
        x, y = points[..., 0] - c, points[..., 1] - f
        return (e * x - b * y) / det, (a * y - d * x) / det


Reader = Callable[[Window], "Array"]
"""Gives the pixels (bands, height, width) of a window."""


def warp_raster(data: ArrayLike, grid: Grid, mapping: Map, out: Optional[Grid] = None, *,
                resampling: str = "linear", fill: float = 0, nodata: Optional[float] = None,
                threads: Optional[int] = None) -> Array:
    """Warps a raster of any type and number of bands by a map of the plane.

    >>> import libicc
    >>> square = [[0, 0], [3, 0], [3, 2], [0, 2]]
    >>> wide = [[0, 0], [6, 0], [6, 2], [0, 2]]
    >>> grid, out = Grid((1, 0, 0, 0, 1, 0), 2, 3), Grid((1, 0, 0, 0, 1, 0), 2, 6)
    >>> warp_raster([[1, 2, 3], [4, 5, 6]], grid, libicc.Map(square, wide), out, resampling="nearest")
    array([[1, 1, 2, 2, 3, 3],
           [4, 4, 5, 5, 6, 6]])

    Args:
        data: (height, width) or (bands, height, width)
        grid: where its pixels lie, in the coordinates of the map's source
        mapping: from places in the raster to places in the result
        out: where the pixels of the result lie, in the coordinates of the map's target; None: like those of `data`
        resampling: "linear" between the centres of pixels; "cubic", which is exact for quadratic functions and may
            overshoot, for whole numbers within their range; or "nearest", for classes and labels. None of them averages
            where the raster shrinks
        fill: value of pixels without an image in the raster
        nodata: pixels of this value are missing, and pixels computed from them get `fill`. None: no pixel is missing.
            NaN stays NaN unless it is this value

    Returns:
        the warped raster, of the type and with the bands of `data`
    """
    array = np.asarray(data)
    bands = array if array.ndim == 3 else array[None]
    if bands.ndim != 3 or bands.shape[1:] != (grid.height, grid.width):
        raise ValueError(f"the raster has the shape {array.shape}, the grid {(grid.height, grid.width)}")
    out = out or grid

    def read(w: Window) -> Array:
        return bands[:, w.row:w.row_end, w.column:w.column_end]

    how = Sampling(resampling, fill, nodata)
    result = pull(read, grid, mapping, out, out.whole, len(bands), array.dtype, how, threads)
    return result if array.ndim == 3 else result[0]


class Sampling(NamedTuple):
    """How the pixels of a result are made: as the arguments of `warp_raster`; at most `max_pixels` of the raster are read
    at a time."""

    resampling: str
    fill: float
    nodata: Optional[float]
    max_pixels: int = 1 << 62


def pull(read: Reader, grid: Grid, mapping: Map, out: Grid, window: Window, n_bands: int, dtype: Any, how: Sampling,
         threads: Optional[int] = None) -> Array:
    """The pixels of a window of the result, which is halved until what it needs may be read at a time."""
    if how.resampling not in RESAMPLING:
        raise ValueError(f"resampling must be one of {', '.join(RESAMPLING)}, not {how.resampling!r}")
    column, row = grid.pixels(mapping.inverse(out.centres(window), threads=threads))
    inside = (column >= 0) & (column < grid.width) & (row >= 0) & (row < grid.height)
    result = np.full((n_bands, *window.shape), how.fill, dtype=dtype)
    if not inside.any():
        return result
    column, row = column[inside], row[inside]
    cubic = how.resampling == "cubic"
    needed = _around(column, row, grid, 2 if cubic else 1)
    if needed.shape[0] * needed.shape[1] > how.max_pixels and window.shape != (1, 1):
        halves = _halves(window)
        parts = [pull(read, grid, mapping, out, half, n_bands, dtype, how, threads) for half in halves]
        return np.concatenate(parts, axis=1 if halves[0].row_end < window.row_end else 2)
    pixels, empty = read(needed), np.zeros((n_bands, len(row)), bool)
    column, row = column - needed.column, row - needed.row
    if how.resampling == "nearest":
        values = _nearest(pixels, column, row, how.nodata, empty)
    else:
        values = _between(pixels, column, row, how.nodata, empty, cubic)
    result[:, inside] = np.where(empty, result[:, inside], _typed(values, result.dtype))
    return result


def _around(column: Floats, row: Floats, grid: Grid, beside: int) -> Window:
    """The pixels that count for these places, up to so many centres away."""
    return Window(max(int(row.min()) - beside, 0), min(int(row.max()) + 1 + beside, grid.height),
                  max(int(column.min()) - beside, 0), min(int(column.max()) + 1 + beside, grid.width))


def _halves(w: Window) -> Sequence[Window]:
    height, width = w.shape
    if height >= width:
        middle = w.row + height // 2
        return w._replace(row_end=middle), w._replace(row=middle)
    middle = w.column + width // 2
    return w._replace(column_end=middle), w._replace(column=middle)


def _is(values: Array, nodata: Optional[float]) -> Any:
    """Compared in the type of the values, in which the number may have been rounded."""
    if nodata is None:
        return False
    if values.dtype.kind != "f":
        return values == nodata
    return np.isnan(values) if np.isnan(nodata) else values == values.dtype.type(nodata)


def _nearest(pixels: Array, column: Floats, row: Floats, nodata: Optional[float], empty: Array) -> Array:
    values = pixels[:, row.astype(np.intp), column.astype(np.intp)]
    empty |= _is(values, nodata)
    return values


def _taps(at: Floats, n: int, cubic: bool) -> Sequence[Tuple[Array, Floats]]:
    """The pixels that count along an axis, two or four, and what each counts. Beyond the edge its pixels go on."""
    if cubic:
        at = np.clip(at, 0, n - 1)
    low = np.floor(at)
    f = at - low
    shares = (((2 - f) * f - 1) * f / 2, ((3 * f - 5) * f * f + 2) / 2, ((4 - 3 * f) * f + 1) * f / 2,
              (f - 1) * f * f / 2) if cubic else (1 - f, f)
    first = low - 1 if cubic else low
    return [(np.clip(first + k, 0, n - 1).astype(np.intp), share) for k, share in enumerate(shares)]


def _between(pixels: Array, column: Floats, row: Floats, nodata: Optional[float], empty: Array, cubic: bool) -> Array:
    """Between the centres of pixels, linear or after R. Keys, Cubic Convolution Interpolation for Digital Image
    Processing, 1981. A pixel without data spoils what it has a share in, as one that is not finite does; of four by four
    that is linear then."""
    values, spoilt = np.zeros(empty.shape), np.zeros_like(empty)
    columns = _taps(column - 0.5, pixels.shape[2], cubic)
    for y, of_row in _taps(row - 0.5, pixels.shape[1], cubic):
        for x, of_column in columns:
            share, corner = of_row * of_column, pixels[:, y, x]
            counts = share != 0
            spoilt |= (_is(corner, nodata) | ~np.isfinite(corner) if cubic else _is(corner, nodata)) & counts
            values += np.multiply(share, corner, out=np.zeros(empty.shape), where=counts)
    if not cubic:
        empty |= spoilt
    elif spoilt.any():
        linear = _between(pixels, column, row, nodata, empty, False)
        values = np.where(spoilt, linear, values)
    return values


def _typed(values: Array, dtype: Any) -> Array:
    """Whole numbers are rounded, and kept in the range of their type."""
    if dtype.kind in "iu" and values.dtype.kind == "f":
        info = np.iinfo(dtype)
        most = float(info.max)
        return np.clip(np.rint(values), info.min, most if most <= info.max else np.nextafter(most, 0)).astype(dtype)
    return values.astype(dtype)
