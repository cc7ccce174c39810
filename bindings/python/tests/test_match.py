import pickle

import libicc
import numpy as np
import pytest

HOOK = np.array([[0, 0], [6, 0], [6, 1], [1, 1], [1, 3], [3, 3], [3, 4], [0, 4]], float)


def test_outlines_that_do_not_correspond():
    turned = np.roll(np.insert(HOOK, 1, [3, 0], axis=0), 4, axis=0)[::-1] * 2 + 5
    match = libicc.Match(HOOK, turned)
    assert match.info.n_vertices == 9 and match.info.n_joined == 8 and abs(match.info.turn) < 1
    source, target = match.origins()
    assert sorted(source[source >= 0]) == list(range(8)) and sorted(target) == list(range(9))
    mapping = libicc.Map(match.source, match.target)
    assert mapping.certified and np.allclose(mapping(HOOK), HOOK * 2 + 5)
    images, off = match.apply([[[6, 0], [3, 0]], [[-1, 2], [np.nan, 0]]])
    assert np.allclose(images[0], [[17, 5], [11, 5]]) and np.allclose(images[1, 0], [5, 9])
    assert np.allclose(off, [[0, 0], [1, np.nan]], equal_nan=True) and np.isnan(images[1, 1]).all()
    again = pickle.loads(pickle.dumps(match))
    assert again.dim == 2 and np.array_equal(again.apply_inverse(images)[0], match.apply_inverse(images)[0], equal_nan=True)
    assert again.to_bytes() == match.to_bytes() and vars(again.info) == vars(match.info)


def test_maps_match_for_themselves():
    turned = np.roll(np.insert(HOOK, 1, [3, 0], axis=0), 4, axis=0)[::-1] * 2 + 5
    assert np.allclose(libicc.Map(HOOK, turned, match=True)(HOOK), HOOK * 2 + 5)
    pairs = np.stack([HOOK[:2], HOOK[:2] * 2 + 5], axis=1)
    assert np.allclose(libicc.Map(HOOK, turned, match=pairs)(HOOK), HOOK * 2 + 5)
    source, target, info = libicc.match(HOOK, turned)
    assert info.n_joined == 8 and len(source) == len(target) == 9 and np.allclose(source * 2 + 5, target)
    with pytest.raises(libicc.BoundaryError):
        libicc.Map(HOOK, turned)
    with pytest.raises(libicc.ArgumentError):
        libicc.Map(HOOK, turned, match="best")


def test_a_matched_domain_is_built_again():
    square = np.array([[0, 0], [9, 0], [9, 9], [0, 9]], float)
    match = libicc.Match(libicc.Domain(square, points=[[2, 6]], radii=1),
                         libicc.Domain(np.roll(square, 1, axis=0) * 1.5, points=[[3, 9]], radii=1.5))
    mapping = libicc.Map(match.source, match.target)
    n_outer = len(match.target.vertices) - sum(len(vertices) for _, vertices in match.target.features)
    again = libicc.Domain(match.target.vertices[:n_outer] + 1,
                          features=[(kind, vertices + 1) for kind, vertices in match.target.features])
    assert np.array_equal(again.facets, match.target.facets)
    assert np.allclose(mapping.retarget(again)([[2, 6], [2, 7]]), [[4, 10], [4, 11.5]])


def test_discs_go_by_arc_length():
    turns = [np.linspace(0, 2 * np.pi, n, endpoint=False) for n in (40, 37)]
    disc, larger = np.column_stack([np.cos(turns[0]), np.sin(turns[0])]), 2 * np.column_stack(
        [np.cos(turns[1] + 2), np.sin(turns[1] + 2)])
    with pytest.raises(libicc.AmbiguousError):
        libicc.Match(disc, larger, turning="free")
    assert np.allclose(libicc.Map(disc, larger, match="arc")([[0.5, 0]]), [[1, 0]], atol=0.02)


def test_a_landmark_decides():
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    with pytest.raises(libicc.AmbiguousError):
        libicc.Match(square, square, turning="free")
    match = libicc.Match(square, square, [[[0, 0], [1, 0]]])
    assert np.allclose(libicc.Map(match.source, match.target)([[0, 0], [1, 0]]), [[1, 0], [1, 1]])


def test_landmarks_that_are_off():
    with pytest.raises(libicc.ArgumentError) as error:
        libicc.Match(HOOK, HOOK, [[0, 0, 0, 0], [9, 9, 1, 1]])
    assert error.value.index == 1


def test_landmarks_of_another_shape():
    pairs = np.array([[[0, 0], [1, 0]], [[1, 0], [1, 1]], [[1, 1], [0, 1]]], float)
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    for wrong in (np.stack([pairs[:, 0], pairs[:, 1]]), pairs[:, 0], pairs.ravel(), np.ones((4, 3))):
        with pytest.raises(libicc.ArgumentError, match=r"shape \(n, 2, 2\) or \(n, 4\), not"):
            libicc.Match(square, square, wrong)
    for right in (pairs, pairs.reshape(3, 4)):
        assert libicc.Match(square, square, right).info.n_landmarks == 3


def test_a_source_that_keeps_its_mesh():
    faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]]
    corners = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
    turn = np.array([[0.8, 0.6, 0], [-0.6, 0.8, 0], [0, 0, 1]])
    source, target = libicc.Domain(corners, faces), libicc.Domain(corners @ turn, faces)
    match = libicc.Match(source, target, keep_source=True)
    assert np.array_equal(match.source.vertices[:6], corners)
    assert match.origins()[0][:6].tolist() == list(range(6))
    with pytest.raises(libicc.ArgumentError, match="keep_source"):
        libicc.Match(source, target, keep_source=2)


def test_several_outlines_are_matched():
    def ring(x, y, size, n, first=0):
        turns = 2 * np.pi * (np.arange(n) + first) / n
        return np.column_stack([x + size * np.cos(turns), y + size * np.sin(turns)])

    def glyph(width, n):  # an i: a round dot over a stem, in either order
        stem = [[0, 0], [width, 0], [width, 10], [0, 10]]
        parts = [ring(width / 2, 13, 1, n, n / 3), stem]
        return {"type": "MultiPolygon", "coordinates": [[np.vstack([p, p[:1]]).tolist()]
                                                        for p in (parts if n > 15 else parts[::-1])]}

    match = libicc.Match(glyph(2, 14), glyph(2.5, 20))
    assert [kind for kind, _ in match.source.features] == ["region", "region"]
    assert [vertices[:, 1].max() > 11 for _, vertices in match.target.features] == [False, True]
    mapping = libicc.Map(match.source, match.target)
    assert mapping.certified
    top = mapping([[1, 13.9]])[0]
    assert abs(top[0] - 1.25) < .2 and top[1] > 13.8
    with pytest.raises(libicc.BoundaryError, match="the source has 2 parts, the target 1"):
        libicc.Match(glyph(2, 14), [[0, 0], [1, 0], [0, 1]])
