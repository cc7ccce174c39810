"""Layers whose polygons share sides, and exact images of lines."""

import libicc
import numpy as np
import pytest
from libicc._layer import exact_images

FRAME = np.array([[-1, -1], [11, -1.2], [11.2, 11], [-1.1, 11.1]])


def bent(rng, n=12):
    """A map of a frame with points inside, all of which move a little."""
    points = rng.uniform(1, 9, (n, 2))
    return libicc.Map(libicc.Domain(FRAME, points=points),
                      libicc.Domain(FRAME + rng.normal(0, .1, (4, 2)), points=points + rng.normal(0, .1, (n, 2))))


def halves(polygon, a, d):
    """The parts of a convex polygon on both sides of the line from a along d."""
    side = d[0] * (polygon[:, 1] - a[1]) - d[1] * (polygon[:, 0] - a[0])
    parts = [], []
    for p, q, s, t in zip(polygon, np.roll(polygon, -1, axis=0), side, np.roll(side, -1)):
        parts[int(s < 0)].append(p)
        if s * t < 0:
            for part in parts:
                part.append(p + s / (s - t) * (q - p))
    return [np.array(part) for part in parts]


def area(ring):
    x, y = np.asarray(ring).T
    return (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2


def parcels(rng, n):
    """A square cut n times: where a cut ends on the side of a neighbour, that one has no vertex."""
    cells = [np.array([[0, 0], [10, 0], [10, 10], [0, 10]], dtype=float)]
    while len(cells) <= n:
        at = int(np.argmax([area(cell) for cell in cells]))
        parts = halves(cells[at], cells[at].mean(axis=0), rng.normal(size=2))
        if min(map(area, parts)) > area(cells[at]) / 4:
            cells[at:at + 1] = parts
    return cells


def carry(lines, mapping, inverse=False):
    number = np.repeat(np.arange(len(lines)), [len(line) for line in lines])
    points, images, number = exact_images(np.concatenate(lines), number, mapping, inverse)
    return [(points[number == k], images[number == k]) for k in range(len(lines))]


def closed(ring):
    return np.concatenate([ring, ring[:1]])


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("inverse", [False, True])
def test_coverages(seed, inverse):
    """Each side of the result has its neighbour, bit by bit, but for those of the border."""
    rng = np.random.default_rng(seed)
    mapping, cells = bent(rng), parcels(rng, 30)
    rings = [images for _, images in carry([closed(cell) for cell in cells], mapping, inverse)]
    sides = {side for ring in rings for side in zip(map(tuple, ring[:-1]), map(tuple, ring[1:]))}
    assert len(sides) == sum(len(ring) - 1 for ring in rings)
    border = {a: b for a, b in sides if (b, a) not in sides}
    outline = [next(iter(border))]
    while (at := border.pop(outline[-1], None)) is not None:
        outline.append(at)
    assert not border and outline[0] == outline[-1]
    areas = [area(ring[:-1]) for ring in rings]
    assert min(areas) > 0 and sum(areas) == pytest.approx(area(outline[:-1]), rel=1e-12)
    assert len(sides) > sum(map(len, cells))


@pytest.mark.parametrize("inverse", [False, True])
def test_lines_are_exact(inverse):
    """Within a triangle the map is linear, so all of a piece is where the map takes it."""
    rng = np.random.default_rng(5)
    mapping = bent(rng)
    lines = [np.column_stack([rng.uniform(0, 10, (4, 2)), rng.uniform(0, 5, 4)]) for _ in range(20)]
    lines.append(np.array([[5., 5., 5.]]))
    for line, (points, images) in zip(lines, carry(lines, mapping, inverse)):
        shares = np.linspace(0, 1, 9)[:, None, None]
        along = points[:-1, :2] + shares * np.diff(points[:, :2], axis=0)
        found = (mapping.inverse if inverse else mapping.apply)(along)
        assert np.abs(found - (images[:-1] + shares * np.diff(images, axis=0))).max(initial=0) < 1e-10
        kept = [int(np.flatnonzero((points == p).all(axis=1))[0]) for p in line]
        assert kept == sorted(kept) and len(points) >= len(line)
        for a, b in zip(kept, kept[1:]):
            heights = points[a:b + 1, 2]
            assert (np.sort(heights) == heights).all() or (np.sort(heights)[::-1] == heights).all()


def test_a_side_through_vertices():
    """A line along edges of the triangles, from vertex to vertex, has no other vertices than theirs."""
    mapping = bent(np.random.default_rng(6))
    vertices, moved, triangles = mapping.mesh()
    a, b, c = vertices[triangles[0]]
    (points, images), = carry([np.array([a, b, c, a])], mapping)
    assert len(points) == 4 and np.abs(images - moved[triangles[0]][[0, 1, 2, 0]]).max() < 1e-12


def test_parts_outside(before, after):
    """The line has both ends in the L, but not its middle."""
    mapping = libicc.Map(before, after)
    (_, lost), (_, whole) = carry([np.array([[9, 4.5], [4.5, 9]]), np.array([[1., 1], [9, 4]])], mapping)
    assert np.isnan(lost).any() and not np.isnan(whole).any()


def test_frames_of_geometries(neighbour):
    geopandas, geometry = neighbour("geopandas"), neighbour("shapely.geometry")
    import libicc.geopandas  # noqa: F401
    from shapely.ops import unary_union

    rng = np.random.default_rng(7)
    mapping = bent(rng)
    series = geopandas.GeoSeries([geometry.Polygon(cell) for cell in parcels(rng, 20)])
    moved = series.icc.map(mapping, exact=True)
    union = unary_union(list(moved))
    assert union.geom_type == "Polygon" and not union.interiors
    assert moved.area.sum() == pytest.approx(union.area, rel=1e-12)
    back = moved.icc.map(mapping, exact=True, inverse=True)
    assert max(a.symmetric_difference(b).area for a, b in zip(back, series)) < 1e-9
    with pytest.raises(ValueError, match="exclude"):
        series.icc.map(mapping, exact=True, tolerance=1)
    with pytest.raises(ValueError, match="mesh map"):
        series.icc.map(libicc.Map(FRAME, FRAME, "curves"), exact=True)
