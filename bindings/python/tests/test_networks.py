"""Maps of domains whose features meet: made, saved, inverted, retargeted, improved, certified."""

import libicc
import numpy as np
import pytest

SQUARE = np.array([[0, 0], [8, 0], [8, 8], [0, 8]], float)

NETWORKS = {
    # A lake with a river that comes from a corner, one that leaves to a corner, and a brook.
    "rivers": [("hole", [[3, 3], [4, 2], [5, 3], [4, 4]]), ("line", [[0, 0], [2, 1], [3, 3]]),
               ("line", [[5, 3], [6.5, 3.5], [8, 8]]), ("line", [[6.5, 3.5], [6, 1]]), ("point", [[2, 6]])],
    # A body with limbs that share joints.
    "bones": [("line", [[4, 2], [4, 4], [4, 6]]), ("line", [[4, 6], [2, 4]]), ("line", [[4, 6], [6, 4], [7, 2]]),
              ("line", [[4, 2], [3, 1]]), ("line", [[4, 2], [5, 1]])],
    # Parcels: closed lines with common sides.
    "parcels": [("line", [[1, 1], [4, 1], [4, 4], [1, 4], [1, 1]]), ("line", [[4, 1], [7, 1], [7, 4], [4, 4], [4, 1]]),
                ("line", [[1, 4], [4, 4], [7, 4], [6, 7], [1, 4]])],
    # Holes that touch each other and the outer ring.
    "holes": [("hole", [[0, 0], [3, 1], [2, 3]]), ("hole", [[3, 1], [5, 1], [6, 3], [4, 4]])],
}


def bend(points, amount):
    points = np.asarray(points, float)
    x, y = points.T
    return np.stack([x + amount * np.sin(0.7 * y), 0.9 * y - amount * np.sin(0.5 * x)], 1)


def domain(features, amount=0.0):
    return libicc.Domain(bend(SQUARE, amount), features=[(kind, bend(f, amount)) for kind, f in features])


def check(mapping, source, target):
    assert mapping.certified
    np.testing.assert_allclose(mapping.apply(source.vertices), target.vertices, rtol=0, atol=1e-13)
    np.testing.assert_allclose(mapping.apply_inverse(target.vertices), source.vertices, rtol=0, atol=1e-13)
    points, images, triangles = mapping.mesh()
    for corners in points[triangles], images[triangles]:
        assert (np.linalg.det(corners[:, 1:] - corners[:, :1]) > 0).all()
    inside = points[triangles].mean(1)
    back = mapping.apply_inverse(mapping.apply(inside))
    np.testing.assert_allclose(back, inside, rtol=0, atol=1e-10)
    certificate = mapping.certify(points, triangles)[1]
    assert certificate.certified and certificate.boundary_simple, certificate.message


@pytest.mark.parametrize("name", NETWORKS)
def test_networks(name, tmp_path):
    features = NETWORKS[name]
    source, target, further = domain(features), domain(features, 0.4), domain(features, 0.6)
    mapping = libicc.Map(source, target)
    check(mapping, source, target)
    check(libicc.Map(target, source), target, source)
    mapping.save(tmp_path / "network.map")
    again = libicc.Map.load(tmp_path / "network.map")
    check(again, source, target)
    assert again.to_bytes() == mapping.to_bytes()
    moved = mapping.retarget(further)
    check(moved, source, further)
    assert moved.info.class_kept
    better, _ = moved.improve()
    check(better, source, further)
    assert better.info.energy <= moved.info.energy * (1 + 1e-12)
    assert libicc.Map.from_bytes(better.to_bytes()).to_bytes() == better.to_bytes()


@pytest.mark.parametrize("name", NETWORKS)
def test_sides_keep_their_shares(name):
    features = NETWORKS[name]
    mapping = libicc.Map(domain(features), domain(features, 0.4))
    share = np.linspace(0, 1, 12)[:, None]
    for kind, line in features:
        for a, b in zip(np.asarray(line, float)[:-1], np.asarray(line, float)[1:]):
            given, expected = ((1 - share) * p + share * q for p, q in (bend([a, b], 0), bend([a, b], 0.4)))
            np.testing.assert_allclose(mapping.apply(given), expected, rtol=0, atol=1e-11)


def test_truncated_bytes_are_refused():
    data = libicc.Map(domain(NETWORKS["rivers"]), domain(NETWORKS["rivers"], 0.4)).to_bytes()
    for end in range(0, len(data), 97):
        with pytest.raises(libicc.Error):
            libicc.Map.from_bytes(data[:end])


def test_one_class():
    """With one piece all maps are of one class, so a target that lines cannot reach straight is reached anyway."""
    bent = [[0, 4], [2, 4], [6, 7], [6, 1]]
    source = libicc.Domain([[0, 0], [8, 0], [8, 8], [0, 8], [0, 4]], features=[("line", bent)])
    target = libicc.Domain([[0, 0], [8, 0], [8, 8], [0, 8], [0, 4]], features=[("line", bent[:2] + bent[:1:-1])])
    mapping = libicc.Map(source, source).retarget(target)
    check(mapping, source, target)
    assert mapping.info.class_kept
