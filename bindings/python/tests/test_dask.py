"""Points and rasters in chunks, beside the whole; `tests/ffi/many_processes.py` does it in several processes."""

import libicc
import numpy as np
import pytest
from libicc.raster import Grid, warp_raster


@pytest.fixture(autouse=True)
def scheduler(neighbour):
    """In this process; tests/ffi/many_processes.py has several."""
    dask = neighbour("dask")
    with dask.config.set(scheduler="synchronous"):
        yield


@pytest.fixture
def mapping(before, after):
    return libicc.Map(before, after)


@pytest.fixture
def points():
    return np.random.default_rng(2).uniform(-0.5, 10.5, (20000, 2))


def same(a, b):
    return a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes()


def test_points(mapping, points):
    import dask.array as da
    from libicc.dask import map_points

    lazy = map_points(mapping, da.from_array(points, chunks=(1000, 1)))
    assert lazy.chunks == ((1000,) * 20, (2,))
    assert same(lazy.compute(), mapping(points))
    grid = da.from_array(points.reshape(100, 200, 2), chunks=(30, 70, 2))
    assert same(map_points(mapping, grid, inverse=True).compute(), mapping.inverse(points).reshape(100, 200, 2))
    with pytest.raises(ValueError, match="shape"):
        map_points(mapping, da.zeros((5, 3)))


def test_files_of_points(mapping, points, tmp_path, neighbour):
    from libicc.dask import map_npy, map_points

    source, target = str(tmp_path / "points.npy"), str(tmp_path / "images.npy")
    for kind in (np.float64, np.float32):
        np.save(source, points.astype(kind))
        assert map_npy(mapping, source, target, chunk=3000) == len(points)
        assert same(np.load(target), mapping(points.astype(kind)))
    assert map_npy(mapping, target, source, inverse=True) == len(points)
    assert same(np.load(source), mapping.inverse(np.load(target)))
    np.save(source, points[:, :1])
    with pytest.raises(ValueError, match="shape"):
        map_npy(mapping, source, target)

    zarr = neighbour("zarr")
    import dask.array as da
    zarr.save(str(tmp_path / "points.zarr"), points)
    map_points(mapping, da.from_zarr(str(tmp_path / "points.zarr"))).to_zarr(str(tmp_path / "images.zarr"))
    assert same(zarr.load(str(tmp_path / "images.zarr")), mapping(points))


@pytest.mark.parametrize("resampling", ["nearest", "linear"])
def test_rasters(mapping, tmp_path, neighbour, resampling):
    rasterio, zarr = neighbour("rasterio"), neighbour("zarr")
    from libicc.dask import Raster, warp_raster as warp, write_tiff

    grid = Grid((0.05, 0, -2, 0, -0.05, 13), 280, 320)
    out = Grid((0.04, 0.01, -1, 0.005, -0.04, 11), 300, 250)
    data = np.random.default_rng(1).integers(0, 200, (2, 280, 320), dtype=np.uint8)
    whole = warp_raster(data, grid, mapping, out, resampling=resampling, fill=255, nodata=255)

    tiff, folder = str(tmp_path / "in.tif"), str(tmp_path / "in.zarr")
    with rasterio.open(tiff, "w", driver="GTiff", height=280, width=320, count=2, dtype="uint8", nodata=255,
                       transform=rasterio.Affine(*grid.transform)) as file:
        file.write(data)
    zarr.save(folder, data)
    raster = Raster.open(tiff)
    assert raster.grid == grid and raster.nodata == 255
    warped = warp(mapping, raster, out, chunk=64, resampling=resampling, max_pixels=2000)
    assert warped.chunks == ((2,), (64, 64, 64, 64, 44), (64, 64, 64, 58))
    assert same(warped.compute(), whole)
    of_zarr = warp(mapping, Raster.open(folder, grid), out, chunk=64, resampling=resampling, fill=255)
    of_zarr.to_zarr(str(tmp_path / "out.zarr"))
    assert same(zarr.load(str(tmp_path / "out.zarr")), whole)
    write_tiff(warped, str(tmp_path / "out.tif"), out, crs="EPSG:2056", nodata=255)
    with rasterio.open(tmp_path / "out.tif") as file:
        assert same(file.read(), whole) and tuple(file.transform)[:6] == out.transform and file.nodata == 255


def test_wrong_files(mapping, tmp_path, neighbour):
    zarr = neighbour("zarr")
    from libicc.dask import Raster

    zarr.save(str(tmp_path / "in.zarr"), np.zeros((4, 5)))
    with pytest.raises(ValueError, match="needs a grid"):
        Raster.open(str(tmp_path / "in.zarr"))
    with pytest.raises(ValueError, match="has the shape"):
        Raster.open(str(tmp_path / "in.zarr"), Grid((1, 0, 0, 0, 1, 0), 5, 4))
