"""Surfaces and conforming meshes."""

import libicc
import numpy as np
import pytest
from meshes import bend, grid_mesh


@pytest.fixture
def pair():
    points, cells = grid_mesh(4)
    return libicc.Domain.from_mesh(points, cells), libicc.Domain.from_mesh(bend(points), cells)


@pytest.mark.parametrize("kind", ["mesh", "curves"])
def test_meshes(pair, kind):
    mapping = libicc.Map(*pair, kind)
    assert mapping.certified and mapping.info.kind == kind
    points = np.random.default_rng(1).uniform(0.01, 3.99, (3000, 3))
    assert np.abs(mapping.inverse(mapping(points)) - points).max() < 1e-12
    jacobians = mapping.jacobian(points)
    good = np.isfinite(jacobians).all(axis=(1, 2))
    assert good.mean() > 0.99 and (np.linalg.det(jacobians[good]) > 0).all()


def test_mesh_of_a_map_in_space(pair):
    vertices, images, cells = libicc.Map(*pair).mesh()
    edges = images[cells[:, 1:]] - images[cells[:, :1]]
    assert vertices.shape == images.shape and (np.linalg.det(edges) > 0).all()


def test_certify_in_space(pair):
    points, cells = grid_mesh(3)
    images, certificate = libicc.Map(*pair).repair(points * 4 / 3, cells)
    assert images.shape == points.shape and certificate.n_no_image == 0


def test_surfaces_without_meshes(cube):
    vertices, faces = cube
    mapping = libicc.Map((vertices, faces), (vertices * [1, 2, 1], faces))
    assert mapping.certified and mapping.info.kind == "mesh"
    assert np.abs(mapping([[0.5, 0.5, 0.5]]) - [0.5, 1, 0.5]).max() < 0.1


def test_surfaces_on_a_grid(cube):
    vertices, faces = cube
    mapping = libicc.Map((vertices, faces), (vertices * [1, 2, 1], faces), method="field", cells=12)
    assert mapping.source_chart.info.method == "field"
    assert np.abs(mapping([[0.5, 0.5, 0.5]]) - [0.5, 1, 0.5]).max() < 0.1


def test_surfaces_are_filled(cube):
    vertices, faces = cube
    surface = libicc.Domain(vertices, faces)
    filled = surface.filled()
    points, cells = filled.mesh
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    assert (filled.vertices == vertices).all() and (filled.facets == faces).all()
    assert np.linalg.det(edges).sum() / 6 == pytest.approx(surface.info.measure)
    assert filled.info.n_mesh_vertices == len(points) and filled.info.n_mesh_simplices == len(cells)
    bent = libicc.Domain(vertices * [1, 2, 1], faces).filled()
    assert libicc.Map(filled, bent).info.kind == "mesh"
    with pytest.raises(libicc.Error):
        filled.filled()


def test_errors_name_the_simplex():
    points, cells = grid_mesh(2)
    points[13] = points[12]
    with pytest.raises(libicc.BoundaryError) as caught:
        libicc.Domain.from_mesh(points, cells)
    assert caught.value.index >= 0


def test_meshio(neighbour):
    meshio = neighbour("meshio")
    points, cells = grid_mesh(2)
    domain = libicc.as_domain(meshio.Mesh(points, [("tetra", cells)]))
    assert domain.dim == 3 and domain.info.measure == pytest.approx(8)
    flat = meshio.Mesh([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [("triangle", [[0, 1, 2], [0, 2, 3]])])
    assert libicc.as_domain(flat).dim == 2
