"""Maps points and rasters in several processes, or in parts that fit into memory: dask arrays of points, files of
points, and rasters in chunks.

Each worker gets the map once, as bytes, and it gives the same results there, bit for bit. This module needs Dask. Files
of points are .npy or zarr. Rasters are zarr, or anything that rasterio reads.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Optional, Tuple

import numpy as np
from dask.array.core import map_blocks
from dask.base import compute
from dask.delayed import delayed
from numpy.lib.format import open_memmap

from ._map import Map
from ._transform import Transform
from .raster import Grid, Sampling, Window, pull

if TYPE_CHECKING:
    from ._types import Array

DEFAULT_CHUNK = 1 << 20


def _images(points: Array, mapping: Transform, inverse: bool) -> Array:
    """In a worker, which has one thread."""
    images: Array = mapping.apply_inverse(points, threads=1) if inverse else mapping.apply(points, threads=1)
    return images


def map_points(mapping: Transform, points: Any, *, inverse: bool = False) -> Any:
    """The images of a dask array (.., dim) of points, as a lazy dask array with the same chunks.

    >>> import dask.array, libicc
    >>> square, moved = [[0, 0], [4, 0], [4, 3], [0, 3]], [[0, 0], [4, 1], [4, 4], [0, 3]]
    >>> points = dask.array.ones((1000, 2), chunks=(100, 2))
    >>> map_points(libicc.Map(square, moved), points)[:2].compute().round(6)
    array([[1.  , 1.25],
           [1.  , 1.25]])
    """
    if points.shape[-1] != mapping.dim:
        raise ValueError(f"points must have the shape (.., {mapping.dim}), not {points.shape}")
    points = points.rechunk({points.ndim - 1: -1})
    dtype = _dtype_of(points)
    return map_blocks(_images, points, delayed(mapping, pure=True), inverse, dtype=dtype,
                      meta=np.empty((0,) * points.ndim, dtype))


def _dtype_of(points: Any) -> Any:
    """The type of the images of points."""
    return np.float32 if points.dtype == np.float32 else np.float64


def _map_rows(mapping: Map, source: str, target: str, first: int, last: int, inverse: bool) -> int:
    """Opens both files anew for each part, so that no worker keeps what it has read."""
    points = np.load(source, mmap_mode="r")[first:last]
    images = open_memmap(target, mode="r+")
    images[first:last] = _images(points, mapping, inverse)
    images.flush()
    return len(points)


def map_npy(mapping: Map, source: str, target: str, *, inverse: bool = False, chunk: int = DEFAULT_CHUNK) -> int:
    """Maps the points (n, dim) of a .npy file and writes the images to another, new file. All workers must see its file
    system. Returns the number of points.

    Args:
        chunk: number of points at a time; a worker needs about 50 bytes for each
    """
    points = np.load(source, mmap_mode="r")
    if points.ndim != 2 or points.shape[1] != mapping.dim:
        raise ValueError(f"points must have the shape (n, {mapping.dim}), not {points.shape}")
    open_memmap(target, "w+", _dtype_of(points), points.shape).flush()
    there = delayed(mapping, pure=True)
    parts = [delayed(_map_rows)(there, source, target, first, min(first + chunk, len(points)), inverse)
             for first in range(0, len(points), chunk)]
    return sum(compute(*parts))


class Raster(NamedTuple):
    """A raster in a file. It is opened where it is read."""

    path: str
    is_zarr: bool
    grid: Grid
    n_bands: int
    dtype: str
    nodata: Optional[float]

    @classmethod
    def open(cls, path: str, grid: Optional[Grid] = None) -> "Raster":
        """Opens a file. It is zarr (a folder whose name ends in .zarr), which has no grid of its own and needs one, or
        anything that rasterio reads."""
        if path.rstrip("/").endswith(".zarr"):
            import zarr

            shape, dtype = zarr.open(path, mode="r").shape, zarr.open(path, mode="r").dtype
            if grid is None:
                raise ValueError(f"{path} needs a grid: a zarr array does not say where its pixels lie")
            if shape[-2:] != (grid.height, grid.width) or len(shape) not in (2, 3):
                raise ValueError(f"{path} has the shape {shape}, the grid {(grid.height, grid.width)}")
            return cls(path, True, grid, shape[0] if len(shape) == 3 else 1, dtype.str, None)
        import rasterio

        with rasterio.open(path) as file:
            if len(set(file.dtypes)) != 1:
                raise ValueError(f"{path} has bands of several types: {', '.join(file.dtypes)}")
            own = Grid(tuple(file.transform)[:6], file.height, file.width)
            return cls(path, False, grid or own, file.count, np.dtype(file.dtypes[0]).str, file.nodata)

    def read(self, w: Window) -> Array:
        """The pixels (bands, height, width) of a window."""
        if self.is_zarr:
            import zarr

            pixels = zarr.open(self.path, mode="r")[..., w.row:w.row_end, w.column:w.column_end]
            return pixels if pixels.ndim == 3 else pixels[None]
        import rasterio
        import rasterio.windows

        with rasterio.open(self.path) as file:
            return file.read(window=rasterio.windows.Window(w.column, w.row, *w.shape[::-1]))


def _warp_block(mapping: Map, raster: Raster, out: Grid, how: Sampling, block_info: Any) -> Array:
    (row, row_end), (column, column_end) = block_info[None]["array-location"][1:]
    window = Window(row, row_end, column, column_end)
    return pull(raster.read, raster.grid, mapping, out, window, raster.n_bands, np.dtype(raster.dtype), how, threads=1)


def warp_raster(mapping: Map, raster: Raster, out: Optional[Grid] = None, *, chunk: int = 1024,
                resampling: str = "linear", fill: Optional[float] = None, max_pixels: int = 1 << 24) -> Any:
    """Warps a raster in a file. Returns a lazy dask array (bands, height, width). ``to_zarr`` writes it from all
    workers, `write_tiff` from one.

    Args:
        mapping, out, resampling: as in `libicc.raster.warp_raster`
        chunk: the result has chunks of chunk x chunk pixels. A worker needs about 200 bytes for each pixel, and room
            for `max_pixels` of the raster
        fill: value of pixels without an image; None: the raster's own nodata, or 0
        max_pixels: number of pixels of the raster that are read at a time
    """
    out = out or raster.grid
    fill = fill if fill is not None else raster.nodata if raster.nodata is not None else 0
    chunks = ((raster.n_bands,), *(_chunks(n, chunk) for n in (out.height, out.width)))
    how = Sampling(resampling, fill, raster.nodata, max_pixels)
    return map_blocks(_warp_block, delayed(mapping, pure=True), raster, out, how, chunks=chunks,
                      dtype=raster.dtype, meta=np.empty((0, 0, 0), raster.dtype))


def _chunks(n: int, chunk: int) -> Tuple[int, ...]:
    return (chunk,) * (n // chunk) + ((n % chunk,) if n % chunk else ())


def write_tiff(array: Any, path: str, grid: Grid, *, crs: Any = None, nodata: Optional[float] = None) -> None:
    """Writes a dask array (bands, height, width) as GeoTIFF, in tiles and compressed. This process alone writes, one
    row of chunks after the other. Only one row is in memory."""
    import rasterio
    import rasterio.transform
    import rasterio.windows

    profile = dict(driver="GTiff", height=grid.height, width=grid.width, count=array.shape[0], dtype=array.dtype.name,
                   transform=rasterio.transform.Affine(*grid.transform), crs=crs, nodata=nodata, tiled=True,
                   blockxsize=512, blockysize=512, compress="deflate", BIGTIFF="IF_SAFER")
    with rasterio.open(path, "w", **profile) as file:
        row = 0
        for height in array.chunks[1]:
            pixels = array[:, row:row + height].compute()
            file.write(pixels, window=rasterio.windows.Window(0, row, grid.width, height))
            row += height
