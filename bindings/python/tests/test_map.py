import gc
import json
import threading
import warnings

import libicc
import numpy as np
import pytest


def test_map_and_back(before, after, inside):
    mapping = libicc.Map(before, after)
    assert mapping.certified and mapping.info.kind == "mesh"
    images = mapping(inside)
    assert np.abs(mapping.inverse(images) - inside).max() < 1e-12
    assert np.abs(mapping(before) - after).max() < 1e-13
    jacobians = mapping.jacobian(inside)
    assert np.nanmin(np.linalg.det(jacobians)) > 0


def test_points_outside_have_no_image(before, after):
    mapping = libicc.Map(before, after)
    images, status = mapping([[1.0, 1.0], [9.0, 9.0]], status=True)
    assert status.tolist() == [0, libicc.Error.OUTSIDE]
    assert np.isfinite(images[0]).all() and np.isnan(images[1]).all()


def test_one_point_is_as_many(before, after, inside):
    mapping = libicc.Map(before, after)
    images = [tuple(image) for image in mapping(inside).tolist()]
    points = inside.tolist()
    assert [mapping(x, y) for x, y in points] == images
    assert [mapping(x, y, threads=1) for x, y in points] == images
    assert mapping(*points[0], 7.0) == (*images[0], 7.0)
    assert np.isnan(mapping(9.0, 9.0)).all()
    again = libicc.Map.from_bytes(mapping.to_bytes())
    wrong = []

    def work():
        wrong.extend(p for p, image in zip(points * 50, images * 50) if again(*p) != image)
    workers = [threading.Thread(target=work) for _ in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert wrong == []


@pytest.mark.parametrize("method", ["foliation", "disc", "gradient", "field"])
def test_charts(before, inside, method):
    chart = libicc.Chart(before, method, cells=40)
    facet, bary, t, status = chart.encode(inside, status=True)
    good = status == 0
    assert good.mean() > 0.5 and chart.info.method == method
    back = chart.decode(facet[good], bary[good], t[good])
    close = np.abs(back - inside[good]).max(axis=1) < 1e-6
    assert close.all() if method != "gradient" else close.any()
    curve = chart.trace(inside[good][0])
    assert np.abs(curve[-1] - chart.info.maximum).max() < 1e-12
    assert chart.domain.dim == 2


def test_a_map_for_proj(before, after, inside):
    mapping = libicc.Map(before, after)
    content = json.loads(mapping.to_proj(source_crs="EPSG:2056"))
    assert content["file_type"] == "triangulation_file" and content["input_crs"] == "EPSG:2056"
    assert "output_crs" not in content
    vertices, images, triangles = mapping.mesh()
    assert content["vertices"] == np.hstack([vertices, images]).tolist()
    assert content["triangles"] == triangles.tolist()


def test_a_map_that_proj_cannot_have(before, after):
    with pytest.raises(libicc.UnsupportedError):
        libicc.Map(before, after, "curves").to_proj()


OWN = {"gradient": ("n_compression", "function", "tree"), "field": ("n_infeasible", "n_contacts"),
       "foliation": ("n_ties",), "disc": (), "shelling": ("n_orders", "flux_energy")}


@pytest.mark.parametrize("method", OWN)
def test_info_has_what_the_method_has(before, method):
    if method == "shelling":
        square = libicc.Domain.from_mesh([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5]],
                                         [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
        info = libicc.Chart(square).info
        assert info.n_mesh_simplices == 4
    else:
        info = libicc.Chart(before, method).info
    assert info.dim == 2 and len(info.maximum) == 2 and not hasattr(info, "size")
    for name, members in OWN.items():
        for member in members:
            assert hasattr(info, member) == (name == method)
    assert hasattr(info, "n_mesh_vertices") == (method in ("foliation", "disc", "shelling"))
    if method == "gradient":
        assert info.function == "decay" and info.tree == "thesis"


def test_borrowed_objects_keep_their_owner(before, after, inside):
    chart = libicc.Map(before, after, "curves", method="foliation").source_chart
    gc.collect()
    assert len(chart.encode(inside)) == 3


def test_errors(before):
    with pytest.raises(libicc.BoundaryError) as caught:
        libicc.Domain([[0, 0], [1, 1], [1, 0], [0, 1]])
    assert caught.value.status == libicc.Error.BOUNDARY and caught.value.index >= 0
    with pytest.raises(libicc.BoundaryError) as caught:
        libicc.Map(before, before[:5])
    assert "source" in str(caught.value) or "target" in str(caught.value) or caught.value.side == 0
    with pytest.raises(ValueError, match="method must be one of"):
        libicc.Chart(before, "folation")
    with pytest.raises(ValueError, match="shape"):
        libicc.Map(before, before)(np.zeros((3, 3)))
    with pytest.raises(ValueError, match="^maximum must have the shape"):
        libicc.Chart(before, maximum=[1])
    with pytest.raises(ValueError, match="^target_maximum must have the shape"):
        libicc.Map(before, before, target_maximum=[1, 2, 3])
    with pytest.raises(libicc.ResolutionError):
        libicc.Chart([[0, 0], [1, 0], [1, 1], [0, 1]], "gradient", cells=16384)
    with pytest.raises(ValueError, match="indices"):
        libicc.Domain(before, [[0.5, 1]])


def test_progress(before, after):
    stages = []
    libicc.Map(before, after, progress=lambda stage, share: stages.append((stage, share)))
    assert stages and all(0 <= share <= 1 for _, share in stages)
    with pytest.raises(libicc.Cancelled):
        libicc.Map(before, after, progress=lambda stage, share: True)

    def complain(stage, share):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        libicc.Map(before, after, progress=complain)


def test_log(caplog):
    """Stars so wild that the charts invert triangles, which is logged if anybody listens."""
    angle = np.arange(16) * np.pi / 8
    circle = np.stack([np.cos(angle), np.sin(angle)], -1)
    before, after = (circle * np.resize(radii, 16)[:, None] for radii in ([1, 0.02], [0.02, 1, 0.02, 0.5]))
    libicc.Map(before, after)
    assert not caplog.records
    with caplog.at_level("INFO", "libicc"):
        libicc.Map(before, after)
    assert any("are inverted" in message for message in caplog.messages)


def test_threads_give_the_same_bits(before, after, inside):
    mapping = libicc.Map(before, after)
    many = np.tile(inside, (20, 1))
    assert np.array_equal(mapping(many, threads=1), mapping(many, threads=4))
    results = [None] * 4

    def work(k):
        results[k] = mapping(many)

    workers = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    assert all(np.array_equal(result, results[0]) for result in results)


def test_improve_follow_and_mesh(before, after, inside):
    rough = libicc.Map(before, after, improve=0)
    fair, report = rough.improve()
    assert report.energy <= report.energy_start and fair.info.energy <= rough.info.energy
    moved = fair.retarget(after + [[0.1, 0]] * 6)
    assert moved.certified and moved.source_chart is None
    vertices, images, triangles = fair.mesh()
    assert np.abs(fair(vertices) - images).max() < 1e-12
    checked, certificate = fair.certify(vertices, triangles)
    assert certificate.certified == 1 and np.abs(checked - images).max() < 1e-12


def flower(petals, depth, phase):
    """An outline of 1000 vertices with petals."""
    angle = 2 * np.pi * np.arange(1000) / 1000
    radius = 1 + depth * np.cos(petals * angle + phase)
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle)])


def test_a_map_that_is_overlaid_in_patches():
    mapping = libicc.Map(flower(5, 0.4, 0), flower(4, 0.4, 1))
    assert mapping.report.n_inverted > 0 and mapping.info.n_vertices > 2000
    loaded = libicc.Map.from_bytes(mapping.to_bytes())
    moved = flower(4, 0.38, 1.05)
    for go_on in (lambda m: m, lambda m: m.retarget(moved), lambda m: m.improve()[0]):
        one, two = go_on(mapping), go_on(loaded)
        assert one.certified and two.certified and one.info.energy == two.info.energy
        assert all(map(np.array_equal, one.mesh(), two.mesh()))
        vertices, _, triangles = one.mesh()
        images, certificate = one.certify(vertices, triangles)
        again, same = two.certify(vertices, triangles)
        assert np.array_equal(images, again) and certificate == same


def test_masks_and_surfaces(cube):
    domain = libicc.Domain.from_mask(np.ones((2, 3, 4), bool))
    assert domain.dim == 3 and domain.info.measure == 24
    assert domain.info.upper.tolist() == [2, 3, 4]
    mask = np.zeros((2, 2), bool)
    mask[0, 0] = mask[1, 1] = True
    repaired, n = libicc.repair_mask(mask)
    assert n == 1 and repaired.sum() == 3
    vertices, faces = cube
    surface = libicc.Domain(vertices, faces)
    where, facet, bary = surface.locate([[0.5, 0.5, 0.5], [2, 0, 0]], nearest=True)
    assert where.tolist() == [libicc.INSIDE, libicc.OUTSIDE] and bary.shape == (2, 3)
    assert np.array_equal(surface.facets, faces) and np.array_equal(surface.vertices, vertices)


def test_a_surface_that_is_dragged(cube):
    vertices, faces = cube
    frame = libicc.Map(libicc.Domain(vertices, faces), libicc.Domain(vertices, faces))
    for k in range(1, 6):
        moved = np.array(vertices, float)
        moved[:, 0] += 0.1 * k * moved[:, 2] ** 2
        frame = frame.retarget(libicc.Domain(moved, faces))
        assert frame.certified and frame.source_chart is None
        assert np.abs(frame(vertices) - moved).max() < 1e-12
    again = libicc.Map.from_bytes(frame.to_bytes())
    assert again.retarget(libicc.Domain(vertices, faces)).certified


def test_defects():
    assert libicc.boundary_defects([[0, 0], [1, 1], [1, 0], [0, 1]]) == [("crossing", 0, 2)]


def test_shapely(before, after, inside, neighbour):
    shapely = neighbour("shapely.geometry")
    mapping = libicc.Map(shapely.Polygon(before), shapely.Polygon(after))
    assert np.array_equal(mapping(inside), libicc.Map(before, after)(inside))
    ring = shapely.Polygon([[0, 0], [9, 0], [9, 9]], [[[5, 1], [6, 1], [6, 2]]])
    domain = libicc.Domain(ring, holes=[shapely.LinearRing([[7, 1], [8, 1], [8, 2]])],
                           lines=shapely.MultiLineString([[[3, 1], [4, 1]]]), points=shapely.Point(2, 1))
    assert [kind for kind, _ in domain.features] == ["hole", "hole", "line", "point"]
    assert libicc.as_domain(ring).info.n_features == 1
    with pytest.raises(ValueError, match="holes"):
        libicc.boundary_defects(ring)


def test_features():
    square, hole = [[0, 0], [9, 0], [9, 9], [0, 9]], [[1, 1], [1, 3], [3, 3], [1, 1]]
    bone, line = [[5, 5], [7, 5]], np.array([[5, 6], [6, 7], [7, 6]])
    domain = libicc.Domain(square, holes=[hole], lines=[bone, line], points=[[2, 8], [8, 8]])
    assert domain.info.n_features == 5 and domain.info.measure == 79
    assert len(domain.vertices) == 4 + 3 + 2 + 3 + 2 and domain.facets[4:].tolist() == [[4, 5], [5, 6], [6, 4]]
    given = [("hole", hole[:3]), ("line", bone), ("line", line.tolist()), ("point", [[2, 8]]), ("point", [[8, 8]])]
    assert [(kind, vertices.tolist()) for kind, vertices in domain.features] == given
    where = domain.locate([[2.9, 2], [1.5, 2.5], [1, 2], [6, 5], [2, 8]])
    assert where.tolist() == [libicc.INSIDE, libicc.OUTSIDE, libicc.BOUNDARY, libicc.INSIDE, libicc.INSIDE]
    assert libicc.Domain(square).features == [] and libicc.Domain(square, points=[]).info.n_features == 0
    assert libicc.Domain(square, points=[3, 4]).features[0][1].tolist() == [[3, 4]]
    sized = libicc.Domain(square, lines=[bone], points=[[2, 7], [7, 7]], radii=[0, 1]).features
    assert [kind for kind, _ in sized] == ["line", "point", "point", "line"]
    np.testing.assert_allclose(np.hypot(*(sized[3][1] - [7, 7]).T), np.ones(16), rtol=1e-15)
    assert len(libicc.Domain(square, points=[[2, 7], [7, 7]], radii=1).features) == 4
    again = libicc.Domain(square, features=sized)
    assert [(kind, vertices.tolist()) for kind, vertices in again.features] == [
        (kind, vertices.tolist()) for kind, vertices in sized]
    assert libicc.Domain(square, features=[("point", [3, 4])]).features[0][1].tolist() == [[3, 4]]
    with pytest.raises(ValueError, match="feature 1 must be one of hole, line, point, region, not 'circle'"):
        libicc.Domain(square, features=[("line", bone), ("circle", bone)])
    for other in ({"holes": [hole]}, {"points": [[2, 8]]}, {"radii": 1}):
        with pytest.raises(ValueError, match="features come instead of"):
            libicc.Domain(square, features=[("line", bone)], **other)
    with pytest.raises(ValueError, match="each of the 2 points"):
        libicc.Domain(square, points=[[2, 7], [7, 7]], radii=[1, 1, 1])
    with pytest.raises(libicc.ArgumentError, match="feature 0: the radius"):
        libicc.Domain(square, points=[[2, 7]], radii=-1)
    with pytest.raises(libicc.OutsideError, match="feature 1 .a point., vertex 0, lies in feature 0") as caught:
        libicc.Domain(square, holes=[hole], points=[[1.5, 2.5]])
    assert caught.value.index == 1 and caught.value.item == "feature"
    with pytest.raises(libicc.BoundaryError, match="feature 2 .a point.*feature 1"):
        libicc.Domain(square, lines=[bone, line], points=[[5.5, 6.5]])
    with pytest.raises(libicc.ArgumentError, match="a line has at least 2 vertices"):
        libicc.Domain(square, lines=[[[1, 1]]])
    with pytest.raises(ValueError, match="facets"):
        libicc.Domain(square, [[0, 1], [1, 2], [2, 3], [3, 0]], holes=[hole])
    with pytest.raises(ValueError, match="shape"):
        libicc.Domain(square, points=[[1, 1, 1]])
    with pytest.raises(libicc.UnsupportedError, match="holes, lines or points"):
        libicc.Chart(domain)


def test_closed_rings(before, after, inside):
    """The first vertex once more at the end, as files and shapely have it."""
    close = lambda ring: np.concatenate([ring, ring[:1]])  # noqa: E731
    assert len(libicc.Domain(close(before)).vertices) == len(before)
    assert libicc.boundary_defects(close(before)) == []
    mapping = libicc.Map(close(before), close(after).tolist())
    assert np.array_equal(mapping(inside), libicc.Map(before, after)(inside))
    with pytest.raises(libicc.BoundaryError):
        libicc.Domain(np.concatenate([before, before[1:2]]))
    with pytest.raises(libicc.BoundaryError, match="at least 3"):
        libicc.Domain([[0, 0], [1, 1]])


def test_geometries(before, after, inside, neighbour):
    shapely = neighbour("shapely.geometry")
    high = np.column_stack([before, np.arange(len(before))])
    wanted = libicc.Map(before, after)(inside)
    for shape in (shapely.Polygon(high), shapely.LinearRing(before), shapely.MultiPolygon([shapely.Polygon(before)]),
                  shapely.GeometryCollection([shapely.Polygon(high)])):
        assert np.array_equal(libicc.Map(shape, after)(inside), wanted)
        assert np.array_equal(libicc.Domain(shape).vertices, before)
    two = shapely.MultiPolygon([shapely.Polygon(before), shapely.Polygon(before + 20)])
    assert libicc.as_domain(two).info.n_vertices == libicc.Domain(two).info.n_vertices == 2 * len(before)
    with pytest.raises(libicc.UnsupportedError):
        libicc.Chart(two)
    for make in (libicc.Domain, libicc.as_domain, libicc.Chart):
        with pytest.raises(ValueError, match="Point is no outline"):
            make(shapely.Point(1, 2))
        with pytest.raises(ValueError, match="0 parts"):
            make(shapely.MultiPolygon())
    with pytest.raises(ValueError):
        libicc.Domain(shapely.Polygon())


def test_geometries_as_points(before, after, inside, neighbour):
    shapely = neighbour("shapely.geometry")
    mapping, few = libicc.Map(before, after), inside[:3]
    wanted = mapping(few)
    assert np.array_equal(mapping.apply(shapely.Point(few[0])), wanted[:1])
    assert np.array_equal(mapping.apply(shapely.Point(*few[0], 7)), wanted[:1])
    assert np.array_equal(mapping([shapely.Point(p) for p in few]), wanted)
    assert np.array_equal(mapping.apply(shapely.MultiPoint(few)), wanted)
    assert np.array_equal(mapping.apply_inverse(shapely.LineString(few)), mapping.inverse(few))


@pytest.mark.parametrize("kind", [libicc.Domain, libicc.Chart, libicc.Map])
def test_help(kind):
    assert kind.__init__.__doc__ == kind.__doc__ and "Args:" in kind.__doc__


def test_maps_of_features():
    square, hole = [[0, 0], [9, 0], [9, 9], [0, 9]], [[3, 3], [3, 5], [5, 5], [5, 3]]
    source = libicc.Domain(square, holes=[hole], points=[[7, 2]])
    target = libicc.Domain(square, holes=[[[4, 4], [4, 6], [6, 6], [6, 4]]], points=[[2, 7]])
    mapped = libicc.Map(source, target)
    assert mapped.certified and mapped.info.kind == "mesh"
    assert np.abs(mapped(source.vertices) - target.vertices).max() < 1e-14
    images, status = mapped.apply([[4, 4], [7, 2]], status=True)
    assert status.tolist() == [libicc.Error.OUTSIDE, 0] and images[1].tolist() == [2, 7]
    # As it is, and with hole and point turned once.
    short = libicc.Map(source, source, ties=[((0, 4), [], []), ((7, 8), [], [])])
    turn = [[8, 0.5], [8, 8], [1, 8], [2, 3]]
    long = libicc.Map(source, source, ties=[((0, 4), [], turn), ((7, 8), [], [])])
    assert short.info.energy == pytest.approx(4) and long.certified and long.info.energy > 10
    assert short.info.class_kept == long.info.class_kept == 1 and long.info.detour > 1.2 > short.info.detour
    assert short.info.n_ties == 2 and (short.info.n_holes, short.info.n_lines, short.info.n_points) == (1, 0, 1)
    # Ties out, and in again.
    again = libicc.Map(source, source, improve=0, ties=long.ties)
    for (ends, _, bends), (own_ends, own_source, own_bends) in zip(long.ties, again.ties):
        assert ends == own_ends and len(own_source) == 0 and np.array_equal(bends, own_bends)
    loaded = libicc.Map.from_bytes(long.to_bytes())
    assert np.array_equal(loaded([[1, 1], [6, 6]]), long([[1, 1], [6, 6]]))
    assert libicc.Map(square, square).ties == []
    with pytest.raises(libicc.TopologyError, match="tie 1 joins") as caught:
        libicc.Map(source, source, ties=[((0, 4), [], []), ((1, 7), [], [])])
    assert caught.value.index == 1 and caught.value.item == "tie"


def test_what_rounding_spoils_is_said() -> None:
    def bell(width: float, offset: float) -> np.ndarray:
        return offset + np.array([[0, 0], [1, 0], [1, .5], [3, .5], [4, 0], [5, 0], [5, 1], [4, 1], [3, .5 + width],
                                  [1, .5 + width], [1, 1], [0, 1]])

    far = libicc.Map(bell(.25, 0), bell(2.0 ** -21, 2.0 ** 30))
    assert far.report.n_spoilt > 0
    for call in (far.mesh, far.to_proj):
        with pytest.warns(RuntimeWarning, match="flat or reversed"):
            call()
    near = libicc.Map(bell(.25, 0), bell(2.0 ** -21, 0))
    assert near.report.n_spoilt == 0
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        near.mesh()


def interface(n, power):
    """Vertices of a line across a square, spaced by a power."""
    share = np.linspace(0, 1, n) ** power
    return np.column_stack([4 * share, 2 + 0.3 * np.sin(2 * np.pi * share) * (share < 1)])


def test_vertices_of_an_interface_slide(tmp_path):
    outline = [[0, 0], [4, 0], [4, 2], [4, 4], [0, 4], [0, 2]]
    before, after = interface(9, 1), interface(9, 1.7)
    source, target = libicc.Domain(outline, lines=[before]), libicc.Domain(outline, lines=[after])
    still, mapping = libicc.Map(source, target), libicc.Map(source, target, slide=True)
    everywhere = libicc.Map(source, target, slide="all")
    assert still.info.n_slid == 0 and mapping.info.n_slid == 7 and mapping.certified and everywhere.certified
    assert mapping.info.energy < 4.1 < still.info.energy
    np.testing.assert_allclose(mapping(before)[[0, -1]], after[[0, -1]], atol=1e-14)
    ends = np.column_stack([after[:-1], after[1:]])
    for x, y in mapping(before)[1:-1]:
        side = ends[np.searchsorted(after[:, 0], x) - 1]
        assert abs(y - np.interp(x, side[[0, 2]], side[[1, 3]])) < 1e-13
    mapping.save(tmp_path / "slid.icc")
    assert libicc.Map.load(tmp_path / "slid.icc").info.n_slid == 7
    assert mapping.retarget(source).info.n_slid == 7
    with pytest.raises(libicc.UnsupportedError, match="slide"):
        libicc.Map(outline, outline, slide=True)
    with pytest.raises(ValueError, match="slide must be one of all"):
        libicc.Map(source, target, slide="some")
