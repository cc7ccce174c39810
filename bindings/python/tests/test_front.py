"""The front over libraries that read and write files."""

import importlib
import json
import os
from pathlib import Path
import subprocess

import numpy as np
import pytest

import libicc
from libicc import front
from libicc.front import formats, mesh, volume

SQUARE, WIDE = [[0, 0], [9, 0], [9, 9], [0, 9]], [[0, 0], [9, 0], [12, 9], [0, 9]]
COMMAND = Path(os.environ.get("LIBICC_LIBRARY", "")).resolve().parents[1] / "tools/libicc"


def cube(size):
    corners = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))], float) * size
    quads = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    return corners, np.array([half for a, b, c, d in quads for half in ((a, b, c), (a, c, d))])


def write_obj(path, points, faces):
    path.write_text("".join("v {} {} {}\n".format(*p) for p in points) + "".join("f {} {} {}\n".format(*(f + 1)) for f in faces))


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    np.savetxt("a.txt", SQUARE)
    np.savetxt("b.txt", WIDE)
    points, faces = cube(8.0)
    write_obj(tmp_path / "A.obj", points, faces)
    write_obj(tmp_path / "B.obj", points + [1, 0, 0], faces)
    return tmp_path


def run(*words):
    return front.main(list(words))


def test_points(folder):
    np.savetxt("p.csv", [[1, 2], [3, 4]], delimiter=",")
    assert run("map", "-s", "a.txt", "-t", "b.txt", "p.csv", "q.csv") == 0
    assert np.array_equal(np.loadtxt("q.csv", delimiter=","), libicc.Map(SQUARE, WIDE)([[1, 2], [3, 4]]))
    assert run("map", "-i", "-s", "a.txt", "-t", "b.txt", "q.csv", "r.txt") == 0
    assert np.allclose(np.loadtxt("r.txt"), [[1, 2], [3, 4]])


def test_exit_codes(folder, capsys):
    np.savetxt("p.txt", [[1, 2], [30, 40]])
    assert run("map", "-s", "a.txt", "-t", "b.txt", "p.txt", "q.txt") == 4
    assert run("map", "-s", "a.txt", "-t", "b.txt", "--outside", "fail", "p.txt", "r.txt") == 1
    assert not Path("r.txt").exists()
    assert run("map", "-s", "a.txt", "-t", "none.txt", "p.txt", "r.txt") == 1
    assert "none.txt: cannot be opened" in capsys.readouterr().err
    assert run("check", "-s", "a.txt", "-t", "b.txt") == 0
    Path("c.txt").write_text("0 0\n2 2\n2 0\n0 2\n")
    assert run("check", "-s", "a.txt", "-t", "c.txt") == 1
    assert "c.txt: no valid target" in capsys.readouterr().err
    with pytest.raises(SystemExit) as raised:
        run("map", "-s", "a.txt")
    assert raised.value.code == 2


def test_missing_library(folder, monkeypatch, capsys):
    def without(name):
        raise ImportError(name)

    Path("scan.nii").write_bytes(b"")
    monkeypatch.setattr(importlib, "import_module", without)
    assert run("check", "-s", "scan.nii") == 1
    said = capsys.readouterr().err
    assert "scan.nii" in said and "pip install nibabel" in said and "apt install python3-nibabel" in said


def test_figures(folder):
    Path("wall.tscn").write_text('[gd_scene]\n[node name="Wall" type="Polygon2D"]\npolygon = '
                                 "PackedVector2Array(0, 0, 9, 0, 9, 9, 0, 9)\n")
    assert front.read("wall.tscn").outline().tolist() == SQUARE
    with pytest.raises(front.FileError, match="choose one: wall.tscn#Wall"):
        front.read("wall.tscn#Door")
    Path("p.mrk.json").write_text(json.dumps({"markups": [{"controlPoints": [{"label": "x", "position": [1, 1, 1]}]}]}))
    pytest.importorskip("meshio")
    assert run("map", "-s", "A.obj", "-t", "B.obj", "p.mrk.json", "q.mrk.json") == 0
    place = json.loads(Path("q.mrk.json").read_text())["markups"][0]["controlPoints"][0]
    assert place["label"] == "x" and np.allclose(place["position"], [2, 1, 1])


@pytest.mark.parametrize("ending", ["mha", "mhd", "nrrd", "nhdr"])
def test_volumes(folder, ending):
    labels = np.zeros((12, 10, 9), np.int16)
    labels[3, 4, 5] = 7
    affine = np.diag([0.5, 1.0, 1.0, 1.0])
    affine[0, 3] = 0.25
    volume._write_headed(labels, affine, Path("in." + ending))
    back = front.read("in." + ending)
    assert np.array_equal(back.data, labels) and np.array_equal(back.affine, affine)
    pytest.importorskip("meshio")
    assert run("warp", "-s", "A.obj", "-t", "B.obj", "--outside", "null", "in." + ending, "out." + ending) == 0
    # One unit of the world is two voxels of the first axis.
    assert np.argwhere(front.read("out." + ending).data).tolist() == [[5, 4, 5]]


def test_displacements(folder):
    points, faces = cube(8.0)
    turned = np.c_[8 - points[:, 1], points[:, 0], points[:, 2]]
    field = volume.Volume(np.tile([1.0, 0.0, 0.0], (8, 8, 8, 1)), np.eye(4), Path("x"), "", lambda *_: None, True)
    field.carry(libicc.Map((points, faces), (turned, faces)), front._command.argparse.Namespace(
        outside="keep", resampling="linear"))
    assert np.allclose(field.data[4, 4, 4], [0, 1, 0])


def test_signs():
    rng = np.random.default_rng(1)
    points = rng.integers(-3, 4, (40, 3)).astype(float) + 2.0**40
    simplices = rng.integers(0, 40, (300, 4))
    exact = [mesh._exact_sign(points[each]) for each in simplices]
    assert mesh.signs(points, simplices).tolist() == exact and set(exact) == {-1, 0, 1}


def test_meshes(folder, capsys):
    meshio = pytest.importorskip("meshio")
    points, _ = cube(2.0)
    order = [0, 1, 2, 3, 4, 5, 6, 7]
    bricks = meshio.Mesh(points + 1, [("hexahedron", np.array([order]))], point_data={"t": points[:, 0]})
    meshio.write("in.vtu", bricks)
    assert run("mesh", "-s", "A.obj", "-t", "B.obj", "in.vtu", "out.vtk") == 0
    moved = meshio.read("out.vtk")
    assert np.allclose(moved.points, points + [2, 1, 1]) and "t" in moved.point_data
    assert "1 hexahedra: 1 keep their orientation at their corners" in capsys.readouterr().out
    boundary = libicc.as_domain(front.read("in.vtu").outline())
    assert boundary.info.measure == pytest.approx(8)
    meshio.write("far.vtu", meshio.Mesh(points + 7, bricks.cells))
    assert run("mesh", "-s", "A.obj", "-t", "B.obj", "far.vtu", "none.vtu") == 4
    assert not Path("none.vtu").exists()


def test_vectors(folder, capsys):
    meshio = pytest.importorskip("meshio")
    points, faces = cube(8.0)
    turn = np.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, 1]])
    write_obj(folder / "C.obj", points @ (turn @ np.diag([2.0, 1, 1])).T, faces)
    nodes = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4.0]])
    vectors = np.array([[1, 0, 0], [0, 2, 0], [3, 0, 4], [np.nan, 0, 0]])
    meshio.write("in.vtu", meshio.Mesh(nodes, [("tetra", [[0, 1, 2, 3]])], {"v": vectors, "s": nodes[:, 0]}, {"c": [vectors[:1]]}))
    assert run("mesh", "-s", "A.obj", "-t", "C.obj", "--rotate-vectors", "in.vtu", "out.vtk") == 0
    moved = meshio.read("out.vtk")
    assert np.allclose(moved.point_data["v"][:3], vectors[:3] @ turn.T) and np.isnan(moved.point_data["v"][3, 0])
    assert np.allclose(moved.cell_data["c"][0], vectors[:1] @ turn.T) and np.array_equal(moved.point_data["s"].ravel(), nodes[:, 0])
    assert "5 vectors in 2 arrays: 5 rotated, 0 not rotated" in capsys.readouterr().out
    assert run("mesh", "-s", "A.obj", "-t", "C.obj", "in.vtu", "plain.vtu") == 0
    assert np.array_equal(meshio.read("plain.vtu").point_data["v"], vectors, equal_nan=True)


def test_layers(folder):
    geopandas = pytest.importorskip("geopandas")
    from shapely.geometry import Point, Polygon

    frame = geopandas.GeoDataFrame({"name": ["in", "out"]}, geometry=[Point(4, 4), Point(40, 4)], crs="EPSG:2056")
    frame.to_file("in.gpkg", driver="GPKG")
    assert run("map", "-s", "a.txt", "-t", "b.txt", "in.gpkg", "out.fgb") == 4
    cages = geopandas.GeoDataFrame({"name": ["a", "b"]}, geometry=[Polygon(SQUARE), Polygon(WIDE)])
    cages.to_file("cages.shp")
    assert run("check", "-s", "cages.shp#name=a", "-t", "cages.shp#name=b") == 0
    assert run("map", "-s", "cages.shp#name=a", "-t", "b.txt", "--outside", "keep", "in.gpkg", "kept.geojson") == 0
    kept = geopandas.read_file("kept.geojson")
    assert np.allclose(kept.geometry[0].coords, libicc.Map(SQUARE, WIDE)([[4, 4]])) and kept.geometry[1].x == 40


def test_rasters(folder):
    rasterio = pytest.importorskip("rasterio")
    heights = np.arange(81, dtype=np.float32).reshape(1, 9, 9)
    heights[0, 2, 2] = -9999
    with rasterio.open("in.tif", "w", driver="GTiff", height=9, width=9, count=1, dtype="float32", crs="EPSG:2056",
                       nodata=-9999, transform=rasterio.transform.from_origin(0, 9, 1, 1)) as file:
        file.write(heights)
    assert run("warp", "-s", "a.txt", "-t", "a.txt", "in.tif", "out.tif") == 0
    with rasterio.open("out.tif") as file:
        assert np.array_equal(file.read(), heights) and file.crs.to_epsg() == 2056 and file.nodata == -9999


@pytest.mark.skipif(not COMMAND.exists(), reason="the command is missing")
def test_same_picture_as_the_command(folder):
    Image = pytest.importorskip("PIL.Image")
    Image.fromarray(np.random.default_rng(0).integers(0, 255, (12, 14, 4), np.uint8)).save("in.png")
    cages = ["-s", "a.txt", "-t", "b.txt"]
    assert run("warp", *cages, "in.png", "out.png") == 0
    subprocess.run([COMMAND, "warp", "-q", *cages, "in.png", "c.png"], check=True)
    assert np.array_equal(np.asarray(Image.open("out.png")), np.asarray(Image.open("c.png")))


def test_table():
    """Every row names a module and a function of it, and a library whose package is known."""
    for row in formats.FORMATS:
        assert hasattr(importlib.import_module("libicc.front." + row.kind), row.reader)
        assert row.library in formats.LIBRARIES or row.library in ("", "libicc")
