import importlib
import importlib.util
import pathlib
import sys

import numpy as np
import pytest

sys.path.insert(0, str(pathlib.Path(__file__).parents[1]))


@pytest.fixture
def neighbour():
    """Imports another package. Skips the test only where that is not installed, not where it is broken."""
    def load(name):
        if importlib.util.find_spec(name.partition(".")[0]) is None:
            pytest.skip(f"{name} is not installed")
        return importlib.import_module(name)

    return load


@pytest.fixture
def before():
    """An L."""
    return np.array([[0, 0], [10, 0], [10, 5], [5, 5], [5, 10], [0, 10]], dtype=float)


@pytest.fixture
def after():
    return np.array([[0, 0], [12, 1], [12, 6], [6.5, 7], [5, 12], [-1, 10]], dtype=float)


@pytest.fixture
def inside():
    """Points inside the L."""
    rng = np.random.default_rng(1)
    points = rng.uniform(0.2, 9.8, (5000, 2))
    return points[~((points[:, 0] > 4.8) & (points[:, 1] > 4.8))]


@pytest.fixture
def cube():
    """A cube's vertices and triangles."""
    vertices = np.array(np.meshgrid([0, 1], [0, 1], [0, 1], indexing="ij"), float).reshape(3, -1).T
    faces = [[0, 1, 2], [2, 1, 3], [4, 6, 5], [6, 7, 5], [0, 4, 1], [4, 5, 1], [2, 3, 6], [6, 3, 7],
             [0, 2, 4], [4, 2, 6], [1, 5, 3], [5, 7, 3]]
    return vertices, np.array(faces)
