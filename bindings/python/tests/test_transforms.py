"""Maps as people's other programs use them: x and y, geometries, GeoJSON, inverses, chains, pictures and bars."""

import base64
import io
import json
import os
import pickle
import subprocess
import sys
from contextlib import redirect_stderr

import numpy as np
import pytest

import libicc

SQUARE = np.array([[0, 0], [10, 0], [10, 10], [0, 10]], float)
SLOPE = np.array([[0, 0], [12, 1], [11, 9], [1, 10]], float)
CUBE = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
QUADS = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
POINTS = np.array([[5, 5], [2, 7], [0, 10]], float)


@pytest.fixture(scope="module")
def slope():
    return libicc.Map(SQUARE, SLOPE)


def test_axes(slope):
    wanted = slope(POINTS)
    x, y = slope(*POINTS.T)
    assert np.array_equal(np.transpose([x, y]), wanted)
    x, y, z = slope(tuple(POINTS[:, 0]), tuple(POINTS[:, 1]), (7, 8, 9))
    assert np.array_equal(x, wanted[:, 0]) and z == (7, 8, 9)
    assert slope(5.0, 5.0) == tuple(wanted[0]) == slope(5, 5) and type(slope(5, 5)[0]) is float
    assert np.isnan(slope(50.0, 5.0)).all()
    (x, y), status = slope([5, 50], 5.0, status=True)
    assert list(status) == [0, libicc.Error.OUTSIDE] and (x[0], y[0]) == slope(5.0, 5.0) and np.isnan(x[1])
    assert slope(5.0, 5.0, status=True) == (slope(5.0, 5.0), 0)
    x, y = slope(np.array([[1.0], [2.0]]), 3.0)
    assert x.shape == (2, 1) and np.array_equal(y[:, 0], slope([[1, 3], [2, 3]])[:, 1])
    cube = libicc.Map((CUBE, QUADS), (2 * CUBE, QUADS))
    assert np.allclose(cube(0.5, 0.25, 0.5), (1, 0.5, 1))
    with pytest.raises(TypeError, match="3 coordinates; 2 are given"):
        cube(0.5, 0.5)


def test_inverse_and_chain(slope):
    back, on = slope.inverse, libicc.Map(SLOPE, SQUARE * 2)
    assert np.array_equal(back(POINTS), slope.apply_inverse(POINTS), equal_nan=True)
    assert back.inverse is slope and ~back is slope
    both = on @ slope
    assert both.certified and back.certified and both.dim == 2 and np.array_equal(both(POINTS), on(slope(POINTS)))
    there = both(POINTS)
    assert np.allclose(both.inverse(there), POINTS) and np.allclose(both.apply_inverse(there), POINTS)
    inside = np.array([[6.3, 4.7], [2, 7]])  # (5, 5) lies on an edge, where derivatives differ
    assert np.allclose(back.jacobian(slope(inside)) @ slope.jacobian(inside), np.eye(2))
    assert np.allclose(both.jacobian(inside), on.jacobian(slope(inside)) @ slope.jacobian(inside))
    assert np.allclose(both.inverse.jacobian(both(inside)), np.linalg.inv(both.jacobian(inside)))
    images, status = both([[5, 5], [50, 5]], status=True)
    assert status[0] == 0 and status[1] == libicc.Error.OUTSIDE and np.isnan(images[1]).all()
    again = pickle.loads(pickle.dumps(both.inverse))
    assert np.array_equal(again(there), both.inverse(there)) and "inverse" in repr(back) and "then" in repr(both)
    with pytest.raises(ValueError, match="dimension 3, the second 2"):
        slope @ libicc.Map((CUBE, QUADS), (2 * CUBE, QUADS))
    with pytest.raises(TypeError):
        slope @ 3


def test_geometries(slope, neighbour):
    geometry = neighbour("shapely.geometry")
    from shapely.ops import transform

    hole = geometry.Polygon([(1, 1), (8, 1), (8, 8)], [[(5, 3), (6, 3), (6, 4)]])
    shapes = [hole, geometry.MultiPolygon([hole]), geometry.Point(1, 2, 9), geometry.LineString([(1, 1), (2, 3)]),
              geometry.GeometryCollection([geometry.Point(1, 1), hole])]
    for shape in shapes:
        moved = slope(shape)
        assert moved.geom_type == shape.geom_type and moved.has_z == shape.has_z
        assert slope.inverse(moved).equals_exact(shape, 1e-9)
    assert transform(slope, hole).equals(slope(hole)) and len(slope(hole).interiors) == 1
    with pytest.raises(libicc.OutsideError, match="2 of the geometry's 3 vertices have no image"):
        slope(geometry.LineString([(1, 1), (11, 1), (12, 1)]))
    moved = slope({"type": "Feature", "properties": {"id": 3}, "bbox": [0] * 4, "geometry": geometry.mapping(hole)})
    assert moved["properties"] == {"id": 3} and "bbox" not in moved
    assert geometry.shape(moved["geometry"]).equals(slope(hole))

    class Place:
        __geo_interface__ = {"type": "Point", "coordinates": [5, 5]}

    assert slope(Place()) == {"type": "Point", "coordinates": slope([5, 5])[0].tolist()}
    with pytest.raises(TypeError, match="no GeoJSON: it has a"):
        slope({"a": 1})


def test_labels_stay(slope, neighbour):
    pandas, xarray = neighbour("pandas"), neighbour("xarray")
    table = pandas.DataFrame({"x": [5, 2], "y": [5, 7]}, index=["a", "b"])
    moved = slope(table)
    assert list(moved) == ["x", "y"] and list(moved.index) == ["a", "b"]
    assert np.array_equal(moved, slope(POINTS[:2])) and np.allclose(slope.inverse(moved), table)
    assert slope(table, status=True)[1].tolist() == [0, 0]
    grid = xarray.DataArray(POINTS.reshape(1, 3, 2), {"t": [7]}, ("t", "n", "axis"), "at")
    moved = slope(grid)
    assert moved.dims == grid.dims and moved.name == "at" and np.array_equal(moved[0], slope(POINTS))


def test_dask_stays_lazy(slope, neighbour):
    array, frame = neighbour("dask.array"), neighbour("dask.dataframe")
    xarray, pandas = neighbour("xarray"), neighbour("pandas")
    points = array.from_array(POINTS, chunks=(2, 2))
    for lazy in (slope(points), slope(xarray.DataArray(points)), slope.inverse.inverse(points)):
        assert hasattr(lazy, "dask") or lazy.chunks
        assert np.array_equal(lazy.compute(scheduler="synchronous"), slope(POINTS))
    back = slope.inverse(slope(points))
    assert np.allclose(back.compute(scheduler="synchronous"), POINTS)
    table = frame.from_pandas(pandas.DataFrame(POINTS, columns=["x", "y"]), npartitions=2)
    moved = slope(table)
    assert list(moved.columns) == ["x", "y"]
    assert np.array_equal(moved.compute(scheduler="synchronous"), slope(POINTS))


def test_domains_as_geojson(neighbour):
    geometry = neighbour("shapely.geometry")
    ring, island = SQUARE * 0.5 + 2, SQUARE * 0.1 + 4
    domain = libicc.Domain(SQUARE[::-1], holes=[ring], regions=[island], points=[[1, 1]])
    shape = geometry.shape(domain)
    assert shape.geom_type == "MultiPolygon" and shape.area == 100 - 25 + 1
    assert domain.bounds == shape.bounds == (0, 0, 10, 10)
    assert geometry.shape(libicc.Domain(SQUARE)).equals(geometry.Polygon(SQUARE))
    assert not hasattr(libicc.Domain(CUBE, QUADS), "__geo_interface__")


def test_shapes_of_maps(slope):
    for mapping in (slope, pickle.loads(pickle.dumps(slope)), slope.retarget(SLOPE + 1), libicc.Map(SQUARE, SLOPE, "curves")):
        assert mapping.bounds == (0, 0, 10, 10) and mapping.source.info.measure == pytest.approx(100)
        assert mapping.target.info.measure == pytest.approx(libicc.Domain(SLOPE).info.measure)


def test_counts_of_features_in_space():
    parts = [libicc.Domain(10 * k * CUBE, QUADS, voids=[(k * (CUBE + 1), QUADS)], points=[[8 * k, 8, 8]],
                           lines=[[[8 * k, 2, 2], [8 * k, 2, 4]]]) for k in (1, 1.25)]
    mapping = libicc.Map(*parts)
    for info in (mapping.info, pickle.loads(pickle.dumps(mapping)).info):
        assert (info.n_holes, info.n_lines, info.n_points) == (1, 1, 1)


def test_parts_are_imported_late():
    code = "import sys, libicc; assert 'libicc.kernel' not in sys.modules; libicc.kernel; libicc.stages.Grid"
    subprocess.run([sys.executable, "-c", code], check=True, env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)})


def test_quads():
    domain = libicc.Domain(CUBE, QUADS)
    assert domain.info.measure == 1 and domain.info.n_facets == 12
    assert libicc.Domain(CUBE * 3 - 1, QUADS, voids=[(CUBE, QUADS)]).info.n_voids == 1

    def mesh(points, **cells):
        return type("Mesh", (), {"points": points, "cells_dict": cells})()

    assert libicc.as_domain(mesh(CUBE, quad=QUADS)).info.n_facets == 12
    flat = libicc.as_domain(mesh(CUBE[:4], quad=QUADS[:1][:, ::-1]))
    assert flat.dim == 2 and flat.info.n_mesh_simplices == 2
    with pytest.raises(ValueError, match="cells of the kind hexahedron; a shape is made of tetrahedra"):
        libicc.as_domain(mesh(CUBE, hexahedron=np.arange(8)[None], quad=QUADS))
    with pytest.raises(ValueError, match="the mesh has line; a shape"):
        libicc.as_domain(mesh(CUBE, line=QUADS[:, :2]))


def test_pixel_transforms():
    frame = libicc.picture_cage((20, 30))
    inner = libicc.Domain(frame, points=[[15, 10]]), libicc.Domain(frame, points=[[18, 8]])
    one, two = libicc.PixelTransform(libicc.Map(*inner)), libicc.PixelTransform(libicc.Map(*inner[::-1]))
    pixels = np.array([[4, 4], [20, 11], [9, 3.5]])
    assert np.allclose(one.inverse(one(pixels)), pixels) and np.allclose(one.inverse.inverse(pixels), one(pixels))
    assert np.allclose((one + two)(pixels), two(one(pixels)))
    assert np.allclose(one.residuals(pixels, one(pixels) + [3, 4]), 5)
    with pytest.raises(TypeError):
        one + 3
    fitted = libicc.PixelTransform.from_estimate(pixels, pixels * 2)
    assert fitted.residuals(pixels, pixels * 2).max() < 1e-6


def test_pixel_transforms_beside_others(neighbour):
    transform = neighbour("skimage.transform")
    frame = libicc.picture_cage((20, 30))
    inner = libicc.Domain(frame, points=[[15, 10]]), libicc.Domain(frame, points=[[18, 8]])
    own, turned = libicc.PixelTransform(libicc.Map(*inner)), transform.AffineTransform(scale=2, translation=(3, -1))
    pixels = np.array([[4, 4], [20, 11], [9, 3.5]])
    both = own + turned
    assert np.allclose(both(pixels), turned(own(pixels)))
    assert np.allclose(both.inverse(both(pixels)), pixels)
    assert transform.warp(np.ones((20, 30)), both.inverse).shape == (20, 30)


def test_pictures_in_notebooks(slope):
    assert slope._repr_svg_().startswith("<svg") and "Certified" in slope._repr_html_() and "<svg" in slope._repr_html_()
    assert "<path" in libicc.Map(SQUARE, SLOPE, "curves")._repr_svg_()
    cube = libicc.Map((CUBE, QUADS), (2 * CUBE, QUADS))
    assert cube._repr_svg_().count("<polygon") == 24 and libicc.Domain(CUBE, QUADS)._repr_svg_().count("<polygon") == 12
    domain = libicc.Domain(SQUARE, holes=[SQUARE * 0.5 + 2], points=[[1, 1]], lines=[[[8, 8], [9, 9]]])
    assert domain._repr_svg_().count("<circle") == 1 and domain._repr_svg_().count("<path") == 2


def test_page():
    inner = (CUBE * 0.2 + 0.3, QUADS)
    solid = libicc.Map(*(libicc.Domain(k * CUBE, QUADS, surfaces=[(k * inner[0], QUADS)]) for k in (1, 2)))
    page = solid.to_html(source="a<b>")
    data = json.loads(page.partition('type="application/json">')[2].partition("</script>")[0])
    assert data["source"] == "a<b>" and data["certified"] and [part["name"] for part in data["parts"]] == ["region 1"]
    assert len(base64.b64decode(data["parts"][0]["facets"])) == 12 * 3 * 4
    assert "<iframe srcdoc=" in solid._repr_html_() and "Certified" in solid._repr_html_()
    with pytest.raises(ValueError, match="this map has none"):
        libicc.Map(SQUARE, SLOPE, "curves").to_html()


def test_plots(slope, neighbour):
    neighbour("matplotlib").use("Agg")
    from matplotlib import pyplot

    slope.plot(stretch=True)[0].figure.canvas.draw()
    cube = libicc.Map((CUBE, QUADS), (2 * CUBE, QUADS))
    cube.plot(stretch=True)
    libicc.Domain(SQUARE, points=[[1, 1]]).plot().figure.canvas.draw()
    libicc.Domain(CUBE, QUADS).plot()
    pyplot.close("all")
    vertices, images, simplices = cube.mesh()
    from libicc._show import stretch_of

    assert stretch_of(vertices, 3 * vertices, simplices) == pytest.approx(3)
    with pytest.raises(ValueError, match="each simplex of a mesh map"):
        libicc.Map(SQUARE, SLOPE, "curves").plot(stretch=True)


def test_bar():
    with redirect_stderr(io.StringIO()) as shown:
        libicc.Map(SQUARE, SLOPE, progress=True)
    assert "%" in shown.getvalue() and shown.getvalue().endswith("\n")


def test_warp(slope):
    picture = np.arange(100, dtype=np.uint8).reshape(10, 10)
    assert np.array_equal(slope.warp(picture, interpolation="cubic"), libicc.warp_image(picture, slope, interpolation="cubic"))


def test_accessors(slope, neighbour):
    geopandas, geometry, xarray = neighbour("geopandas"), neighbour("shapely.geometry"), neighbour("xarray")
    import libicc.geopandas
    import libicc.xarray

    frame = geopandas.GeoDataFrame({"id": [7]}, geometry=[geometry.Point(5, 5)], crs="EPSG:2056")
    for moved in (frame.icc.map(slope), slope(frame)):
        assert list(moved.id) == [7] and moved.crs == frame.crs and moved.geometry[0].equals(slope(frame.geometry[0]))
    assert slope(frame.geometry)[0].equals(slope(frame.geometry[0]))
    assert moved.icc.map(slope.inverse).geometry[0].equals_exact(frame.geometry[0], 1e-9)
    with pytest.raises(AttributeError, match="only frames with geometries"):
        frame[["id"]].icc
    x, y = np.arange(0.5, 10), np.arange(9.5, 0, -1)
    data = xarray.Dataset({"h": (("t", "y", "x"), np.ones((2, 10, 10))), "k": (("y", "x"), np.add.outer(y, -x)),
                           "name": 3}, {"y": y, "x": x})
    warped = data.icc.warp(slope)
    assert set(warped) == {"h", "k", "name"}
    assert warped.k.equals(data.k.icc.warp(slope)) and warped.h.shape == (2, 10, 10)
    small = data.isel(x=slice(3, 7))
    assert data.icc.warp(slope, small).k.shape == (10, 4)
