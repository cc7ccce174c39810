import libicc
import numpy as np
import pytest

OLD = {"north": [[0, 1], [4, 1], [4, 2], [0, 2]], "south": [[0, 0], [4, 0], [4, 1], [0, 1]]}
NEW = {"south": [[0, 0], [4, 0], [4, 1], [2, 1.4], [0, 1]], "north": [[0, 1], [2, 1.4], [4, 1], [4, 2], [0, 2]]}


def geojson(layer, name):
    return {"type": "FeatureCollection", "features": [
        {"type": "Feature", "id": k, "properties": {name: k},
         "geometry": {"type": "Polygon", "coordinates": [[*ring, ring[0]]]}} for k, ring in layer.items()]}


def test_two_layers_become_one_map():
    coverage = libicc.Coverage(OLD, NEW)
    info = coverage.info
    assert (info.n_regions, info.n_nodes, info.n_sides, info.n_islands) == (2, 2, 3, 0)
    assert coverage.regions == ["north", "south"] and coverage.differences == []
    mapping = libicc.Map(coverage.source, coverage.target)
    assert mapping.certified and np.allclose(mapping([[2.0, 1.0], [0, 1]]), [[2, 1.4], [0, 1]])
    for name, is_hole, source, target in coverage.rings:
        assert not is_hole and source.shape == target.shape
        given = np.array(NEW[name], float)
        assert all((np.hypot(*(target - p).T) < 1e-12).any() for p in given)


def test_layers_of_geojson_and_shapely():
    for by in (None, "name"):
        assert libicc.Coverage(geojson(OLD, "name"), geojson(NEW, "name"), by).regions == ["north", "south"]
    shapely = pytest.importorskip("shapely.geometry")
    old, new = ({k: shapely.Polygon(ring) for k, ring in layer.items()} for layer in (OLD, NEW))
    assert libicc.Coverage(old, new).info.n_nodes == 2
    with pytest.raises(ValueError, match="property"):
        libicc.Coverage(geojson(OLD, "name"), geojson(NEW, "name"), "county")


def test_differences_have_names():
    more = {**NEW, "east": [[5, 5], [6, 5], [6, 6]]}
    with pytest.raises(libicc.TopologyError, match=r"region east, near \(5, 5\), is in the target only"):
        libicc.Coverage(OLD, more)
    coverage = libicc.Coverage(OLD, more, unmatched="leave out")
    (one,) = coverage.differences
    assert (one.kind, one.side, one.regions, one.place) == ("region", 2, ("east",), (5, 5))
    assert libicc.Coverage(OLD, more, left_out=["east"]).differences == []
    over = {**NEW, "south": [[0, 0], [4, 0], [4, 1.2], [0, 1]]}
    with pytest.raises(libicc.BoundaryError, match="regions north and south overlap"):
        libicc.Coverage(OLD, over)


def test_noise_is_welded():
    random = np.random.default_rng(1)
    noisy = [{k: np.array(ring, float) + 0.01 * random.uniform(-1, 1, (len(ring), 2)) for k, ring in layer.items()}
             for layer in (OLD, NEW)]
    coverage = libicc.Coverage(*noisy, weld=0.03)
    assert coverage.info.n_nodes == 2 and (coverage.info.most_moved <= 0.03).all()
    assert libicc.Map(coverage.source, coverage.target).certified
