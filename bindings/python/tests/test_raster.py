import shutil
import subprocess

import libicc
import numpy as np
import pytest
from libicc.raster import Grid, Sampling, Window, pull, warp_raster

EAST, NORTH = 2600000.0, 1200000.0


@pytest.fixture
def mapping(before, after):
    return libicc.Map(before + [EAST, NORTH], after + [EAST, NORTH])


@pytest.fixture
def grid():
    """Of the L, with a margin; north is up."""
    return Grid((0.05, 0, EAST - 2, 0, -0.05, NORTH + 13), 280, 320)


@pytest.fixture
def data(grid):
    rng = np.random.default_rng(1)
    return rng.integers(1, 200, (3, grid.height, grid.width), dtype=np.uint8)


def test_grids(before, after, inside):
    """Points in any arrangement, of any precision."""
    mapping = libicc.Map(before, after)
    grid = inside[:3000].reshape(50, 60, 2)
    images, status = mapping(grid, status=True)
    assert images.shape == (50, 60, 2) and status.shape == (50, 60)
    assert np.array_equal(images.reshape(-1, 2), mapping(inside[:3000]))
    assert mapping.inverse(images).shape == (50, 60, 2) and mapping.jacobian(grid).shape == (50, 60, 2, 2)
    assert mapping(np.empty((0, 7, 2))).shape == (0, 7, 2)
    single = grid.astype(np.float32)
    assert mapping(single).dtype == np.float32
    assert np.array_equal(mapping(single), mapping(single.astype(np.float64)).astype(np.float32))
    assert np.array_equal(mapping(grid[:, ::2]), images[:, ::2])
    for wrong in (np.zeros((4, 5, 3)), np.zeros((2, 2, 2, 1)), np.zeros(3)):
        with pytest.raises(ValueError, match="shape"):
            mapping(wrong)


def test_nothing_moves(before, data, grid):
    mapping = libicc.Map(before + [EAST, NORTH], before + [EAST, NORTH])
    inside = ~np.isnan(mapping.inverse(grid.centres())[..., 0])
    for kind in (np.uint8, np.int16, np.uint32, np.float32, np.float64):
        for resampling in ("nearest", "linear", "cubic"):
            warped = warp_raster(data.astype(kind), grid, mapping, resampling=resampling, fill=0)
            off = np.abs(warped[:, inside].astype(float) - data[:, inside])
            assert warped.dtype == kind and off.max() <= (1e-4 if warped.dtype.kind == "f" else 0)
            assert (warped[:, ~inside] == 0).all()


def test_linear_is_linear(mapping, grid):
    """A ramp is read at the very place where the pixel comes from."""
    out = grid._replace(transform=(0.04, 0.01, EAST - 1, 0.005, -0.04, NORTH + 11))
    places = mapping.inverse(out.centres())
    ramp = grid.centres() @ [2.0, 3.0]
    warped = warp_raster(ramp, grid, mapping, out, fill=np.nan)
    assert np.array_equal(np.isnan(warped), np.isnan(places[..., 0])) and np.isfinite(warped).sum() > 20000
    assert np.nanmax(np.abs(warped - places @ [2.0, 3.0])) < 1e-6 * 50


def test_cubic_is_quadratic(mapping, grid):
    """Away from the rim, where pixels go on beyond it."""
    local = np.array([EAST, NORTH])

    def surface(places):
        x, y = np.moveaxis(places - local, -1, 0)
        return x * x - 0.5 * x * y + 2 * y * y + 3 * x

    out = grid._replace(transform=(0.04, 0.01, EAST - 1, 0.005, -0.04, NORTH + 11))
    places = mapping.inverse(out.centres())
    warped = warp_raster(surface(grid.centres()), grid, mapping, out, resampling="cubic", fill=np.nan)
    assert np.isfinite(warped).sum() > 20000 and np.nanmax(np.abs(warped - surface(places))) < 1e-6 * 200
    linear = warp_raster(surface(grid.centres()), grid, mapping, out, fill=np.nan)
    assert np.nanmax(np.abs(linear - surface(places))) > 1e-4


def test_cubic_is_that_of_pictures(before, after):
    """On a grid of pixels, where no pixel of the result takes the mean of several."""
    picture = np.random.default_rng(2).normal(size=(60, 70, 1)).astype(np.float32)
    place = [5.0, 3.0] + 2.0 * (before - before.min(axis=0))
    mapping = libicc.Map(place, place + [0.3, 0.6])
    whole = libicc.warp_image(picture, mapping, interpolation="cubic", out=np.full_like(picture, np.nan))[..., 0]
    own = warp_raster(picture[..., 0], Grid((1, 0, 0, 0, 1, 0), 60, 70), mapping, resampling="cubic", fill=np.nan)
    both = np.isfinite(whole) & np.isfinite(own)
    assert both.sum() > 200 and np.abs(whole[both] - own[both]).max() < 1e-5


def test_whole_numbers_stay_in_range(before, grid):
    mapping = libicc.Map(before + [EAST, NORTH], before + [EAST + 0.02, NORTH])
    steps = np.arange(320) // 7 % 2 == np.arange(280)[:, None] // 5 % 2
    for kind in (np.uint8, np.int16, np.int64, np.uint64):
        info = np.iinfo(kind)
        values = np.where(steps, kind(info.max), kind(info.min))
        warped = warp_raster(values, grid, mapping, resampling="cubic", fill=info.min)
        exact = warp_raster(values.astype(float), grid, mapping, resampling="cubic", fill=info.min)
        assert warped.dtype == kind and exact.max() > 1.01 * info.max
        off = np.abs(warped.astype(float) - np.clip(exact, float(info.min), float(info.max)))
        assert off.max() <= max(0.5, 1e-15 * info.max)


def test_windows_are_the_whole(mapping, data, grid):
    for resampling in ("nearest", "linear", "cubic"):
        whole = warp_raster(data.astype(np.float32), grid, mapping, resampling=resampling, nodata=7)
        reads = []

        def read(w):
            reads.append(w.shape[0] * w.shape[1])
            return data[:, w.row:w.row_end, w.column:w.column_end].astype(np.float32)

        for rows, columns, most in ((100, 70, 1 << 62), (280, 320, 3000)):
            for row in range(0, 280, rows):
                for column in range(0, 320, columns):
                    window = Window(row, min(row + rows, 280), column, min(column + columns, 320))
                    part = pull(read, grid, mapping, grid, window, 3, np.float32, Sampling(resampling, 0, 7, most))
                    own = whole[:, window.row:window.row_end, window.column:window.column_end]
                    assert part.tobytes() == own.tobytes()
            assert max(reads[-10:]) <= most


def test_no_data_stays_none(before, grid):
    mapping = libicc.Map(before + [EAST, NORTH], before + [EAST + 0.02, NORTH])
    data = np.full((280, 320), 50, np.int16)
    data[:, 160:] = -9999
    for resampling in ("nearest", "linear", "cubic"):
        warped = warp_raster(data, grid, mapping, resampling=resampling, fill=-1, nodata=-9999)
        assert set(np.unique(warped)) == {-1, 50}


def test_nan_is_no_data(mapping, data, grid):
    """As far as any other value that stands for none, and no farther; and a number is the same in fewer digits."""
    values = data[0].astype(np.float32)
    missing = values < 20
    for resampling in ("nearest", "linear", "cubic"):
        least = np.float32(-3.4028235e38)
        known = warp_raster(np.where(missing, least, values), grid, mapping, resampling=resampling, fill=-1,
                            nodata=-3.40282347e38)
        named = warp_raster(np.where(missing, np.nan, values), grid, mapping, resampling=resampling, fill=-1, nodata=np.nan)
        kept = warp_raster(np.where(missing, np.nan, values), grid, mapping, resampling=resampling, fill=-1)
        outside = np.isnan(mapping.inverse(grid.centres())[..., 0])
        assert named.tobytes() == known.tobytes() and ((known == -1) & ~outside).sum() > 1000
        assert np.array_equal(np.isnan(kept), (known == -1) & ~outside)
        assert np.array_equal(kept[~np.isnan(kept)], known[~np.isnan(kept)])


def test_not_finite_is_not_spread(before, grid):
    """A pixel counts where it has a share, and nowhere else."""
    mapping = libicc.Map(before + [EAST, NORTH], before + [EAST, NORTH])
    exact = grid._replace(transform=(0.0625, 0, EAST - 2, 0, -0.0625, NORTH + 13))
    data = np.ones((280, 320))
    data[100, 50], data[120, 60] = np.inf, np.nan
    with np.errstate(all="raise"):
        warped = warp_raster(data, exact, mapping)
    assert np.isinf(warped).sum() == 1 and np.isnan(warped).sum() == 1


def test_wrong_rasters(mapping, data, grid):
    with pytest.raises(ValueError, match="one direction"):
        warp_raster(data, grid._replace(transform=(1, 1, 0, 1, 1, 0)), mapping, grid)
    with pytest.raises(ValueError, match="one of nearest, linear, cubic, not 'lanczos'"):
        warp_raster(data, grid, mapping, resampling="lanczos")
    with pytest.raises(ValueError, match="the raster has the shape"):
        warp_raster(data[:, 1:], grid, mapping)
    with pytest.raises(ValueError, match="evenly"):
        Grid.of_centres([0, 1, 3], [0, 1])


def test_beside_gdal(mapping, data, grid, tmp_path, neighbour):
    """The same pixels as gdalwarp, which has the map as a triangulation of PROJ's."""
    rasterio = neighbour("rasterio")
    if shutil.which("gdalwarp") is None:
        pytest.skip("gdalwarp is not installed")
    (tmp_path / "map.json").write_text(mapping.to_proj())
    profile = dict(driver="GTiff", height=280, width=320, count=3, dtype="uint8", crs="EPSG:2056",
                   transform=rasterio.Affine(*grid.transform))
    with rasterio.open(tmp_path / "in.tif", "w", **profile) as file:
        file.write(data)
    subprocess.run(["gdalwarp", "-q", "-et", "0", "-r", "near", "-ct", f"+proj=tinshift +file={tmp_path}/map.json",
                    "-t_srs", "EPSG:2056", "-te", "2599998", "1199999", "2600014", "1200013", "-ts", "320", "280",
                    "-dstnodata", "0", tmp_path / "in.tif", tmp_path / "out.tif"], check=True)
    with rasterio.open(tmp_path / "out.tif") as file:
        theirs = file.read()
    ours = warp_raster(data, grid, mapping, resampling="nearest")
    assert (theirs != ours).mean() < 1e-3 and (theirs > 0).mean() > 0.4
