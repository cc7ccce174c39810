"""What a shape may be, and what is said of what is none."""

import ctypes
import json
import math

import numpy as np
import pytest

import libicc
from libicc import _abi, stages
from libicc._core import Call

SQUARE = [[0, 0], [4, 0], [4, 3], [0, 3]]
BOW = [[0, 0], [4, 0], [0, 3], [4, 3]]
CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
FACES = [[0, 1, 3], [0, 3, 2], [4, 7, 5], [4, 6, 7], [0, 5, 1], [0, 4, 5], [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4],
         [1, 7, 3], [1, 5, 7]]


def polygon(rings):
    return {"type": "Polygon", "coordinates": [[*ring, ring[0]] for ring in rings]}


def test_geojson():
    hole = [[1, 1], [1, 2], [2, 2], [2, 1]]
    shapes = [polygon([SQUARE, hole]), {"type": "Feature", "properties": {}, "geometry": polygon([SQUARE, hole])},
              {"type": "MultiPolygon", "coordinates": [polygon([SQUARE, hole])["coordinates"]]}]
    shapes.append({"type": "FeatureCollection", "features": [shapes[1]]})

    class Own:
        __geo_interface__ = shapes[1]

    for shape in [*shapes, Own()]:
        assert libicc.Domain(shape).info.measure == 11
        assert libicc.as_domain(shape).features[0][0] == "hole"
    assert libicc.Map(polygon([SQUARE]), SQUARE).certified
    with pytest.raises(ValueError, match="target: this LineString is no shape"):
        libicc.Map(SQUARE, {"type": "LineString", "coordinates": SQUARE})
    with pytest.raises(ValueError, match="this FeatureCollection is no shape"):
        libicc.Domain({"type": "FeatureCollection", "features": [shapes[1], shapes[1]]})
    with pytest.raises(ValueError, match="this dict is no shape"):
        libicc.Domain({})


def test_geopandas(neighbour):
    geopandas, geometry = neighbour("geopandas"), neighbour("shapely.geometry")
    series = geopandas.GeoSeries([geometry.Polygon(SQUARE)])
    assert libicc.Map(series, geopandas.GeoDataFrame(geometry=series)).certified
    with pytest.raises(ValueError, match="source: the GeoSeries has 0 rows; choose one"):
        libicc.Map(series[:0], series)
    with pytest.raises(TypeError, match="polygon is no list of points"):
        libicc.Map(series, series).apply(series[0])


def test_masks():
    mask = np.ones((75, 100), bool)
    assert libicc.Domain(mask).info.measure == 7500
    assert libicc.Map(mask[:9, :9], mask[:9, :9]).dim == 2
    with pytest.raises(ValueError, match=r"not \(75, 100\); a mask is taken by Domain.from_mask"):
        libicc.Domain(mask.astype(np.uint8))
    with pytest.raises(ValueError, match="a mask has no holes"):
        libicc.Domain(mask, points=[[1, 1]])


@pytest.mark.parametrize("shape", ["a.geojson", b"a", libicc.__loader__, None, 3, [[0, 0], [1]]])
def test_what_is_no_shape(shape):
    with pytest.raises((TypeError, ValueError), match="^source: .*(shape may be .*an array|must have the shape|opened)"):
        libicc.Map(shape, SQUARE)


def test_files(tmp_path):
    pytest.importorskip("geopandas")
    name = tmp_path / "a.geojson"
    name.write_text(json.dumps(polygon([SQUARE])))
    text = tmp_path / "b.txt"
    np.savetxt(text, np.multiply(SQUARE, 2))
    assert libicc.Map(str(name), text).certified and libicc.as_domain(name).info.measure == 12
    with pytest.raises(TypeError, match=r"not made of the name of a file; libicc.as_domain\('a.geojson'\) reads it"):
        libicc.Domain("a.geojson")
    with pytest.raises(ValueError, match="target: .*no.geojson: cannot be opened"):
        libicc.Map(name, tmp_path / "no.geojson")


def test_features_in_space():
    for features in ({"points": [[.2, .2, .2]]}, {"lines": [[[.2, .2, .2], [.5, .5, .5]]]}, {"holes": [CUBE]}):
        with pytest.raises(ValueError):
            libicc.Domain(CUBE, **features)
    with pytest.raises(ValueError, match="a solid has voids and surfaces"):
        libicc.Domain(CUBE, FACES, holes=[CUBE])
    with pytest.raises(ValueError, match="polygons in the plane"):
        libicc.Domain(SQUARE, [[0, 1], [1, 2], [2, 3], [3, 0]], points=[[.2, .2]])
    assert libicc.Domain(CUBE, FACES, points=[]).dim == 3


@pytest.mark.parametrize("make", [libicc.Map, libicc.Match])
def test_sides(make):
    for side, shapes in enumerate([(BOW, SQUARE), (SQUARE, BOW)], 1):
        with pytest.raises(libicc.BoundaryError, match=f"^{('source', 'target')[side - 1]}: edges") as told:
            make(*shapes)
        assert told.value.side == side and told.value.item == "facet"
    with pytest.raises(libicc.BoundaryError, match="^target: ") as told:
        libicc.Map(SQUARE, SQUARE).retarget(BOW)
    assert told.value.side == 2
    with pytest.raises(libicc.Error) as told:
        libicc.Domain(BOW)
    assert told.value.side == 0 and str(told.value).startswith("edges")


def test_sides_come_from_the_library():
    with pytest.raises(libicc.ArgumentError, match="^target: landmark 0 lies off the outline") as told:
        libicc.Match(SQUARE, SQUARE, [[0, 0, 90, 90]])
    assert told.value.side == 2


def options():
    """(struct, member, value, call) for values that no member of any struct of options may have."""
    lib, address = _abi.lib, ctypes.addressof
    square, cube = libicc.Domain(SQUARE), libicc.Domain(CUBE, FACES)
    mapping, grid = libicc.Map(square, square), stages.Grid(square, 10)
    tree = stages.Tree(grid)
    calls = {
        "improve_options": lambda o, out, c: lib.map_improve(out, mapping, o, None, c.env, c.err),
        "map_options": lambda o, out, c: lib.map_create(out, square, square, o, c.env, c.err),
        "match_options": lambda o, out, c: lib.match_create(out, square, square, 0, None, o, c.env, c.err),
        "fill_options": lambda o, out, c: lib.domain_fill(out, cube, o, c.env, c.err),
        "chart_options": lambda o, out, c: lib.chart_create(out, square, o, c.env, c.err),
        "tree_options": lambda o, out, c: lib.tree_create(out, grid, int(np.flatnonzero(grid.inside)[0]), o, c.env, c.err),
        "function_options": lambda o, out, c: lib.function_create(out, tree, o, c.env, c.err),
    }
    for name, call in calls.items():
        for member, kind in getattr(_abi.structs, name)._fields_:
            for value in {ctypes.c_int32: [-2**31], ctypes.c_double: [math.nan]}.get(kind, []):
                yield name, member, value, call


def test_options_out_of_range_are_named():
    seen = 0
    for name, member, value, call in options():
        struct, told, out = _abi.new(name, **{member: value}), Call(threads=1), ctypes.c_void_p()
        status = call(ctypes.addressof(struct), ctypes.addressof(out), told)
        message = told.error.message.decode()
        assert status != 0 and f"icc_{name}.{member}" in message, (name, member, value, message)
        seen += 1
    assert seen > 20
