"""Solids with voids, surfaces, lines and points."""

import numpy as np
import pytest

import libicc

VERTICES = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
FACETS = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])


def ball(x, radius):
    return radius * VERTICES + [x, 0, 0], FACETS


def solid(**more):
    return libicc.Domain(VERTICES, FACETS, voids=[ball(0.5, 0.125)], surfaces=[ball(-0.4, 0.3)],
                         lines=[[[0, 0.5, 0], [0, 0.5, 0.25]]], points=[[0, 0, 0], [-0.4, 0, 0]], **more)


def test_features_of_a_solid():
    domain = solid()
    info = domain.info
    assert (info.n_features, info.n_holes, info.n_regions, info.n_lines, info.n_points) == (5, 1, 1, 1, 2)
    assert (info.n_voids, info.genus, info.n_faces) == (1, 0, 2)
    assert info.measure == pytest.approx(4 / 3 * (1 - 1 / 512))
    assert [kind for kind, _ in domain.features] == ["hole", "region", "line", "point", "point"]
    vertices, facets = domain.features[1][1]
    assert np.array_equal(vertices, ball(-0.4, 0.3)[0]) and np.array_equal(facets, FACETS)
    again = libicc.Domain(VERTICES, FACETS, features=domain.features)
    assert np.array_equal(again.vertices, domain.vertices) and np.array_equal(again.facets, domain.facets)
    assert domain.locate([[0.5, 0, 0], [-0.4, 0, 0]]).tolist() == [libicc.OUTSIDE, libicc.INSIDE]


def test_errors_name_the_feature():
    with pytest.raises(libicc.OutsideError, match=r"feature 0 \(a void\), vertex 1, lies outside") as raised:
        libicc.Domain(VERTICES, FACETS, voids=[ball(3, 0.1)])
    assert raised.value.index == 0
    with pytest.raises(libicc.BoundaryError, match="feature 1 .*meets feature 0"):
        libicc.Domain(VERTICES, FACETS, voids=[ball(0, 0.2), ball(0.1, 0.2)])


def test_wrong_arguments():
    with pytest.raises(ValueError, match="a pair of vertices"):
        libicc.Domain(VERTICES, FACETS, voids=[VERTICES])
    with pytest.raises(ValueError, match="voids and surfaces lie in a solid"):
        libicc.Domain([[0, 0], [1, 0], [0, 1]], voids=[ball(0, 1)])
    with pytest.raises(ValueError, match="instead of holes"):
        libicc.Domain(VERTICES, FACETS, holes=[[[0, 0], [1, 0], [0, 1]]])
    with pytest.raises(ValueError, match="feature 0 must be one of"):
        libicc.Domain(VERTICES, FACETS, features=[("void", ball(0, 0.1))])
    with pytest.raises(ValueError, match="features come instead"):
        solid(features=[])


def test_regions_of_a_mesh():
    mesh = libicc.Domain(VERTICES, FACETS).filled()
    assert mesh.mesh_regions.tolist() == [0] * mesh.info.n_mesh_simplices
    body = libicc.Domain(VERTICES, FACETS, surfaces=[ball(-0.4, 0.3)])
    mapping = libicc.Map(body, body)
    vertices, _, simplices = mapping.mesh()
    a, b, c, d = vertices[simplices[mapping.mesh_regions() == 1]].transpose(1, 0, 2)
    assert np.linalg.det(np.stack([b - a, c - a, d - a], axis=1)).sum() / 6 == pytest.approx(4 / 3 * 0.027)
    filled = body.filled()
    again = libicc.Domain.from_mesh(*filled.mesh, regions=5 - 3 * filled.mesh_regions.astype(int))
    assert again.info.n_regions == 1 and again.info.n_features == 1
    assert again.mesh_regions.tolist() == filled.mesh_regions.tolist()
    with pytest.raises(ValueError, match="regions must have the shape"):
        libicc.Domain.from_mesh(*filled.mesh, regions=[1])
    with pytest.raises(libicc.BoundaryError, match="touch"):
        libicc.Domain.from_mesh(*filled.mesh, regions=range(len(filled.mesh[1])))
    curves = libicc.Map([[0, 0], [1, 0], [0, 1]], [[0, 0], [1, 0], [0, 1]], kind="curves")
    with pytest.raises(libicc.UnsupportedError, match="a curve map has no mesh"):
        curves.mesh_regions()
