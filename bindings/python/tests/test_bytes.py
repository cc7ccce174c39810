"""Objects as bytes, in other processes, and copied."""

import copy
import pickle
import subprocess
import sys

import libicc
import numpy as np
import pytest
from libicc import kernel
from meshes import bend, grid_mesh


def same(one, two):
    """Whether two arrays are the same bit for bit."""
    return one.dtype == two.dtype and one.shape == two.shape and one.tobytes() == two.tobytes()


def answers(chart, points):
    facet, bary, t, status = chart.encode(points, status=True)
    return facet, bary, t, status, chart.decode(facet, bary, t)


@pytest.mark.parametrize("method", ["foliation", "disc", "gradient", "field"])
def test_charts(before, inside, method):
    chart = libicc.Chart(before, method, cells=30)
    data = chart.to_bytes()
    again = libicc.Chart.from_bytes(data, threads=1)
    assert all(map(same, answers(chart, inside), answers(again, inside)))
    assert again.info.method == method and again.to_bytes() == data
    assert same(again.domain.vertices, before)


@pytest.mark.parametrize("kind", ["mesh", "curves"])
def test_maps(before, after, inside, kind):
    mapping = libicc.Map(before, after, kind)
    data = mapping.to_bytes()
    again = libicc.Map.from_bytes(memoryview(bytearray(data)))
    assert again.certified and again.info.kind == kind and again.to_bytes() == data
    assert same(again(inside), mapping(inside))
    assert same(again.inverse(inside), mapping.inverse(inside))
    assert same(again.jacobian(inside), mapping.jacobian(inside))


def test_files(before, after, inside, tmp_path):
    mapping = libicc.Map(before, after)
    mapping.save(tmp_path / "map.icc")
    assert (tmp_path / "map.icc").read_bytes() == mapping.to_bytes()
    again = libicc.Map.load(str(tmp_path / "map.icc"))
    assert same(again.apply(inside), mapping(inside)) and same(again.apply_inverse(inside), mapping.inverse(inside))
    with pytest.raises(FileNotFoundError):
        libicc.Map.load(tmp_path / "none")
    with pytest.raises(libicc.FormatError):
        libicc.Chart.load(tmp_path / "map.icc")


def test_charts_of_a_map(before, after, inside):
    borrowed = libicc.Map(before, after, "curves").source_chart
    again = pickle.loads(pickle.dumps(borrowed))
    assert all(map(same, answers(borrowed, inside), answers(again, inside)))


def test_maps_with_another_target(before, after, inside):
    moved = libicc.Map(before, after).retarget(after * 1.01)
    again = pickle.loads(pickle.dumps(moved))
    assert same(again(inside), moved(inside)) and again.source_chart is None


def test_space(cube):
    vertices, faces = cube
    chart = libicc.Chart((vertices, faces), cells=10)
    again = pickle.loads(pickle.dumps(chart))
    points = np.random.default_rng(3).uniform(0.1, 0.9, (200, 3))
    assert all(map(same, answers(chart, points), answers(again, points)))


@pytest.mark.parametrize("kind", ["mesh", "curves"])
def test_meshes_in_space(kind):
    points, cells = grid_mesh(3)
    pair = [libicc.Domain.from_mesh(corners, cells) for corners in (points, bend(points))]
    mapping = libicc.Map(*pair, kind)
    again = pickle.loads(pickle.dumps(mapping))
    assert again.certified and again.info.kind == kind
    inside = np.random.default_rng(4).uniform(0.1, 2.9, (300, 3))
    assert same(again(inside), mapping(inside)) and same(again.inverse(inside), mapping.inverse(inside))


def test_another_process(before, after, inside, tmp_path):
    """Bytes from here give the same images there."""
    mapping = libicc.Map(before, after)
    (tmp_path / "map").write_bytes(mapping.to_bytes())
    np.save(tmp_path / "points.npy", inside)
    there = ("import libicc, numpy, sys; data = open('map', 'rb').read(); points = numpy.load('points.npy');"
             "sys.stdout.buffer.write(libicc.Map.from_bytes(data)(points).tobytes())")
    images = subprocess.run([sys.executable, "-c", f"import sys; sys.path[:0] = {sys.path}; {there}"],
                            cwd=tmp_path, stdout=subprocess.PIPE, check=True).stdout
    assert images == mapping(inside).tobytes()


def test_damage(before, after):
    data = libicc.Map(before, after).to_bytes()
    damaged = bytearray(data)
    damaged[len(data) // 2] ^= 1
    for wrong in (b"", b"nonsense", data[:-1], data + b"\0", damaged):
        with pytest.raises(libicc.FormatError):
            libicc.Map.from_bytes(wrong)
    with pytest.raises(libicc.FormatError):
        libicc.Chart.from_bytes(data)
    with pytest.raises(TypeError):
        libicc.Map.from_bytes("text")


def test_progress(before):
    """A chart on a grid is made again, which takes its time."""
    data = libicc.Chart(before, "gradient", cells=200, function="laplace").to_bytes()
    with pytest.raises(libicc.Cancelled):
        libicc.Chart.from_bytes(data, progress=lambda stage, share: True)


def test_copies(before, after):
    """Objects never change, so that a copy is the object itself."""
    for thing in (libicc.Domain(before), libicc.Map(before, after), kernel.Sampling(before, "grid")):
        assert copy.copy(thing) is thing
        assert copy.deepcopy([thing])[0] is thing


def test_what_cannot_be_pickled(before):
    with pytest.raises(TypeError, match="Domain cannot be pickled"):
        pickle.dumps(libicc.Domain(before))
