"""GeoPandas, xarray, matplotlib."""

import libicc
import numpy as np
import pytest
from libicc._layer import _off


@pytest.fixture
def mapping(before, after):
    return libicc.Map(before, after)


@pytest.fixture
def shapes(neighbour):
    geopandas, geometry = neighbour("geopandas"), neighbour("shapely.geometry")
    import libicc.geopandas  # noqa: F401

    hole = [(1, 1), (1, 2), (2, 2), (2, 1)]
    every = [geometry.Point(2, 3), geometry.LineString([(1, 1), (9, 1), (9, 4)]),
             geometry.Polygon([(0.5, 0.5), (9, 0.5), (9, 4), (0.5, 4)], [hole]), None,
             geometry.MultiPoint([(1, 1), (2, 2)]), geometry.Point(1, 2, 77), geometry.Polygon(),
             geometry.GeometryCollection([geometry.Point(1, 5), geometry.LineString([(1, 6, 5), (1, 9, 7)])])]
    return geopandas.GeoSeries(every, index=list("abcdefgh"), crs="EPSG:2056", name="shape")


def positions(shapely_object):
    from shapely.ops import transform

    found = []
    transform(lambda *axes: found.append(np.array(axes).T) or axes, shapely_object)
    return found


def test_geometries(mapping, shapes):
    moved = shapes.icc.map(mapping)
    assert list(moved.index) == list("abcdefgh") and moved.crs == shapes.crs and moved.name == "shape"
    assert list(moved.geom_type) == list(shapes.geom_type) and moved["d"] is None and moved["g"].is_empty
    for old, new in zip(shapes, moved):
        if old is None or old.is_empty:
            continue
        for a, b in zip(positions(old), positions(new)):
            assert np.array_equal(b[:, :2], mapping(a[:, :2])) and np.array_equal(b[:, 2:], a[:, 2:])
    back = moved.icc.map(mapping, inverse=True)
    assert back["c"].symmetric_difference(shapes["c"]).area < 1e-9


def test_lines_bend(mapping, shapes):
    """Between vertices a line is where the map takes it, and no vertex is added where nothing bends."""
    for tolerance in (0.1, 1e-3):
        moved = shapes.icc.map(mapping, tolerance=tolerance)
        for name in "bch":
            for old, new in zip(positions(shapes[name]), positions(moved[name])):
                kept = {tuple(p) for p in mapping(old[:, :2])}
                assert kept <= {tuple(p) for p in new[:, :2]}
                if len(old) < 2:
                    continue
                share = np.linspace(0, 1, 501)[:, None]
                on_old = np.concatenate([a + share * (b - a) for a, b in zip(old[:-1, :2], old[1:, :2])])
                images = mapping(on_old)
                far = _off(new[:-1, None, :2].repeat(len(images), 1).reshape(-1, 2),
                           new[1:, None, :2].repeat(len(images), 1).reshape(-1, 2),
                           np.tile(images, (len(new) - 1, 1))[:, None])
                assert far.reshape(len(new) - 1, -1).min(axis=0).max() < 3 * tolerance
    assert len(positions(moved["b"])[0]) > 10
    straight = libicc.Map([[0, 0], [10, 0], [10, 10], [0, 10]], [[5, 0], [15, 0], [15, 10], [5, 10]])
    assert len(positions(shapes.icc.map(straight, tolerance=1e-6)["b"])[0]) == 3
    heights = positions(moved["h"])[1][:, 2]
    assert heights[0] == 5 and heights[-1] == 7 and (np.diff(heights) > 0).all()


def test_geometries_outside(mapping, shapes, neighbour):
    geometry = neighbour("shapely.geometry")
    import geopandas

    series = geopandas.GeoSeries([geometry.Point(1, 1), geometry.LineString([(9, 4), (9, 9)]),
                                  geometry.LineString([(9, 4.5), (4.5, 9)])])
    with pytest.raises(libicc.OutsideError, match="at 1 has no image") as told:
        series.icc.map(mapping)
    assert told.value.index == 1
    moved = series.icc.map(mapping, outside="null")
    assert moved[0] is not None and moved[1] is None and moved[2] is not None  # its ends are inside
    moved = series.icc.map(mapping, outside="null", tolerance=1e-3)
    assert moved[0] is not None and moved[1] is None and moved[2] is None
    with pytest.raises(ValueError, match="outside must be"):
        series.icc.map(mapping, outside="keep")
    with pytest.raises(AttributeError):
        geopandas.pd.Series([1, 2]).icc


def test_data_arrays(mapping, neighbour):
    xarray = neighbour("xarray")
    import libicc.xarray  # noqa: F401
    from libicc.raster import Grid, warp_raster

    x, y = np.linspace(-2, 14, 65)[:-1] + 0.125, np.linspace(13, -1, 57)[:-1] - 0.125
    data = np.random.default_rng(1).uniform(1, 9, (2, 3, 56, 64)).astype(np.float32)
    raster = xarray.DataArray(data, {"band": [4, 5], "x": x, "y": y, "spatial_ref": 0}, ("band", "time", "y", "x"), "heat",
                              {"units": "K"})
    moved = raster.icc.warp(mapping)
    assert moved.dims == raster.dims and moved.dtype == np.float32 and moved.attrs == {"units": "K"}
    assert moved.name == "heat" and set(moved.coords) == set(raster.coords)
    grid = Grid.of_centres(x, y)
    assert np.allclose(grid.transform, (0.25, 0, -2, 0, -0.25, 13), atol=1e-12)
    own = warp_raster(data.reshape(6, 56, 64), grid, mapping, fill=np.nan).reshape(data.shape)
    assert moved.values.tobytes() == own.tobytes() and np.isnan(own).any() and np.isfinite(own).any()

    like = xarray.DataArray(np.zeros((30, 40)), {"lat": np.linspace(0, 12, 30), "lon": np.linspace(-1, 12, 40)}, ("lat", "lon"))
    classes = (raster[0, 0] > 5).astype(np.uint8)
    classes.attrs["nodata"] = 255
    placed = classes.icc.warp(mapping, like, resampling="nearest")
    assert placed.shape == (30, 40) and placed.dims == ("lat", "lon") and set(np.unique(placed)) == {0, 1, 255}
    with pytest.raises(ValueError, match="evenly"):
        raster.assign_coords(x=x**3).icc.warp(mapping)

    masked = raster[0, 0].where(raster[0, 0] > 2)  # as it was read, with NaN for what the file calls -9999
    masked.encoding["_FillValue"] = -9999.0
    raw = raster[0, 0].where(masked.notnull(), -9999.0)
    raw.attrs["missing_value"] = -9999.0
    for resampling in ("linear", "cubic"):
        moved, other = (one.icc.warp(mapping, resampling=resampling) for one in (masked, raw))
        assert np.array_equal(moved.values, other.where(other != -9999), equal_nan=True)
        assert np.isnan(moved).sum() > np.isnan(raster[0, 0].icc.warp(mapping, resampling=resampling)).sum()


def test_plot(mapping, neighbour, tmp_path):
    matplotlib = neighbour("matplotlib")
    matplotlib.use("Agg")
    axes = mapping.plot(lines=9)
    assert len(axes) == 2
    for axis, ring in zip(axes, (mapping.source_chart, mapping.target_chart)):
        outline = axis.lines[0].get_xydata()
        assert {tuple(p) for p in ring.domain.vertices} <= {tuple(p) for p in outline}
        assert np.array_equal(outline[0], outline[-1]) and libicc.Domain(outline).info.measure == ring.domain.info.measure
    places, images = (axis.lines[1].get_xydata() for axis in axes)
    seen = ~np.isnan(places[:, 0])
    assert seen.sum() > 100 and np.abs(mapping(places[seen]) - images[seen]).max() == 0
    axes[0].figure.savefig(tmp_path / "map.png")
    again = mapping.plot(axes=axes, color="tab:red")
    assert list(again) == list(axes)
    moved = mapping.retarget(mapping.target_chart.domain)
    assert len(moved.plot()) == 2


def test_plot_where_rings_touch(neighbour):
    neighbour("matplotlib").use("Agg")
    hole = [[0, 1], [1, 0.5], [2, 1], [1, 1.5]]
    shape = libicc.Domain([[0, 0], [2, 0], [2, 1], [2, 2], [0, 2], [0, 1]], holes=[hole])
    axes = libicc.Map(shape, shape).plot()
    outline = axes[0].lines[0].get_xydata()
    corners = {tuple(corner) for corner in outline[np.isfinite(outline[:, 0])]}
    assert corners >= {(0, 0), (2, 0), (2, 1), (2, 2), (0, 2), (0, 1), (1, 0.5), (1, 1.5)}

