"""The examples in docstrings, and that everything public has one."""

import doctest
import importlib

import libicc
import numpy
import pytest

NAMES = {"libicc": libicc, "numpy": numpy}


def examples(thing, name, names):
    found = doctest.DocTestFinder(recurse=False).find(thing, name, module=False, globs=dict(names))
    return [test for test in found if test.examples]


def run(test):
    runner = doctest.DocTestRunner()
    runner.run(test)
    assert runner.failures == 0


PUBLIC = [name for name in libicc.__all__ if callable(getattr(libicc, name)) and name != "Progress" and not (
    isinstance(getattr(libicc, name), type) and issubclass(getattr(libicc, name), Exception))]


@pytest.mark.parametrize("name", PUBLIC)
def test_public(name):
    tests = examples(getattr(libicc, name), name, NAMES)
    assert tests, f"libicc.{name} has no example"
    run(tests[0])


NEIGHBOURS = {"raster": ["Grid", "warp_raster"], "dask": ["map_points"], "geopandas": ["GeometryAccessor.map"],
              "xarray": ["RasterAccessor.warp"]}


@pytest.mark.parametrize("module", NEIGHBOURS)
def test_modules(module, neighbour):
    if module != "raster":
        neighbour(module)
    own = importlib.import_module("libicc." + module)
    for path in NEIGHBOURS[module]:
        thing = own
        for name in path.split("."):
            thing = getattr(thing, name)
        tests = examples(thing, path, vars(own))
        assert tests, f"libicc.{module}.{path} has no example"
        run(tests[0])
