"""The plugin for QGIS as it is packed, without a window: its results are those of the Python package.

usage: qgis_processing.py ZIP FOLDER      libicc-qgis.zip, as examples/addons.py makes it
"""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

FOLDER = Path(sys.argv[2]).resolve()
shutil.rmtree(FOLDER, ignore_errors=True)
FOLDER.mkdir(mode=0o700, parents=True)
zipfile.ZipFile(sys.argv[1]).extractall(FOLDER / "plugins")
for name in ("PYTHONPATH", "LIBICC_LIBRARY"):
    os.environ.pop(name, None)
os.environ.update(QT_QPA_PLATFORM="offscreen", HOME=str(FOLDER), XDG_RUNTIME_DIR=str(FOLDER),
                  QGIS_PLUGINPATH=str(FOLDER / "plugins"))
sys.path[:0] = [str(FOLDER / "plugins"), "/usr/share/qgis/python/plugins"]

import libicc_processing

import libicc
import numpy as np
from libicc.raster import Grid, warp_raster
from osgeo import gdal
from qgis.core import (
    QgsApplication,
    QgsFeature,
    QgsGeometry,
    QgsProcessingException,
    QgsProcessingFeedback,
    QgsRasterLayer,
    QgsVectorLayer,
)

WIDTH, HEIGHT = 60, 40
SOURCE = np.array([[3, -4], [56, -5], [30, -20], [52, -36], [6, -35], [40, -10]], float)
TARGET = np.array([[1010, 2090], [1120, 2080], [1062, 2055], [1108, 2020], [1015, 2022], [1085, 2072]], float)
NAMES = ["church", "well", "mill", "cross", "oak", "bridge"]


class Log(QgsProcessingFeedback):
    def __init__(self):
        super().__init__(False)
        self.text = ""

    def pushInfo(self, text):
        self.text += text + "\n"

    pushWarning = pushInfo


def layer(kind, shapes, names=None, crs="EPSG:2056"):
    result = QgsVectorLayer(f"{kind}?crs={crs}&field=name:string", "made up", "memory")
    features = []
    for name, wkt in zip(names or map(str, range(len(shapes))), shapes):
        feature = QgsFeature(result.fields())
        feature.setAttribute("name", name)
        feature.setGeometry(QgsGeometry.fromWkt(wkt))
        features.append(feature)
    assert result.dataProvider().addFeatures(features)[0]
    return result


def points(places, names=NAMES):
    return layer("Point", [f"POINT({x} {y})" for x, y in places], names)


def coordinates(wkt_or_geometry):
    geometry = QgsGeometry.fromWkt(wkt_or_geometry) if isinstance(wkt_or_geometry, str) else wkt_or_geometry
    return [np.array([(p.x(), p.y()) for p in ring])
            for part in geometry.constGet().coordinateSequence() for ring in part]


def polygon(ring):
    return "POLYGON((" + ",".join("{} {}".format(*p) for p in [*ring, ring[0]]) + "))"


def run(name, **parameters):
    import processing

    log = Log()
    return processing.run("libicc:" + name, parameters, feedback=log), log.text


def refused(word, name, **parameters):
    try:
        run(name, **parameters)
    except QgsProcessingException as error:
        assert word in str(error), error
    else:
        sys.exit(f"{name} takes what it should refuse: {word}")


def scan(path, bands=3, kind=gdal.GDT_Byte, dtype=np.uint8):
    data = gdal.GetDriverByName("GTiff").Create(str(path), WIDTH, HEIGHT, bands, kind)
    pixels = np.random.default_rng(1).integers(0, 256, (bands, HEIGHT, WIDTH)).astype(dtype)
    data.WriteArray(pixels)
    return data, pixels


def grid_of(data):
    c, a, b, f, d, e = data.GetGeoTransform()
    return Grid((a, b, c, d, e, f), data.RasterYSize, data.RasterXSize)


def points_file():
    path = FOLDER / "sheet.points"
    rows = [f"{x!r},{y!r},{a!r},{b!r},1,0,0,0" for (x, y), (a, b) in zip(TARGET.tolist(), SOURCE.tolist())]
    path.write_text("#CRS: EPSG:2056\nmapX,mapY,sourceX,sourceY,enable,dX,dY,residual\n" + "\n".join(rows)
                    + "\n1,2,3,-4,0,0,0,0\n")
    return str(path)


def test_georeference():
    pixels = scan(FOLDER / "sheet.tif")[1]
    shapes = ["POLYGON((5 -5,20 -5,20 -20,5 -20,5 -5))", "POLYGON((20 -5,40 -5,40 -20,20 -20,20 -14,20 -5))",
              "POLYGON((45 -25,55 -25,55 -35,45 -35,45 -25),(48 -28,48 -32,52 -32,52 -28,48 -28))"]
    parcels = layer("Polygon", shapes, crs="")
    result, log = run("georeference", POINTS=points_file(), INPUT=parcels, RASTER=str(FOLDER / "sheet.tif"),
                      OUTPUT="TEMPORARY_OUTPUT", OUTPUT_RASTER=str(FOLDER / "moved.tif"),
                      OUTPUT_POINTS=str(FOLDER / "again.points"))
    direct = libicc.fit(SOURCE, TARGET, box=[[0, -HEIGHT], [WIDTH, 0]])
    assert result["CERTIFIED"] and "certified" in log and "line 8" in log and "line 9" not in log, log
    assert abs(result["LEFT_OUT"] - direct.info.left_out) < 1e-12

    moved = result["OUTPUT"]
    assert moved.crs().authid() == "EPSG:2056" and moved.featureCount() == len(shapes)
    lines = [ring for shape in shapes for ring in coordinates(shape)]
    found = [ring for feature in moved.getFeatures() for ring in coordinates(feature.geometry())]
    wanted = libicc.move_lines(lines, direct, exact=True)
    assert len(found) == len(wanted) and all(np.array_equal(a, b) for a, b in zip(found, wanted))
    assert len(found[0]) > len(lines[0])
    whole = QgsGeometry.unaryUnion([feature.geometry() for feature in moved.getFeatures()])
    parts = sum(feature.geometry().area() for feature in moved.getFeatures())
    assert abs(whole.area() - parts) < 1e-9 * parts, "neighbours have come apart"

    data = gdal.Open(str(FOLDER / "moved.tif"))
    grid = Grid((1, 0, 0, 0, -1, 0), HEIGHT, WIDTH)
    with_alpha = np.concatenate([pixels, np.full((1, HEIGHT, WIDTH), 255, np.uint8)])
    assert np.array_equal(data.ReadAsArray(), warp_raster(with_alpha, grid, direct, grid_of(data)))
    assert 0.9 < (data.ReadAsArray()[3] > 127).sum() / (WIDTH * HEIGHT) < 1.1, "about as many pixels as before"
    assert QgsRasterLayer(str(FOLDER / "moved.tif")).crs().authid() == "EPSG:2056"

    table = np.genfromtxt(FOLDER / "again.points", delimiter=",", skip_header=2)
    assert np.array_equal(table[:, :4], np.hstack([TARGET, SOURCE])) and table[:, 7].max() < 1e-9
    assert np.allclose(table[:, 8], np.hypot(*direct.left_out.T))


def test_two_layers_of_points():
    order = [3, 0, 5, 1, 4, 2]
    target = points([*TARGET[order], (0, 0)], [*(NAMES[k] for k in order), "lost"])
    lines = layer("LineStringZ", ["LINESTRING Z(5 -5 400, 50 -30 410)"])
    result, log = run("georeference", SOURCE_POINTS=points(SOURCE), TARGET_POINTS=target, ID="name", INPUT=lines,
                      DEVIATION=0.01, OUTPUT="TEMPORARY_OUTPUT")
    assert "lost" in log and "church" in log, log
    box = [np.minimum(SOURCE.min(axis=0), [5, -30]), np.maximum(SOURCE.max(axis=0), [50, -5])]
    direct = libicc.fit(SOURCE, TARGET, box=box)
    wanted = libicc.move_lines([[[5, -5, 400], [50, -30, 410]]], direct, tolerance=0.01)[0]
    found = next(result["OUTPUT"].getFeatures()).geometry().constGet().points()
    assert np.array_equal([(p.x(), p.y(), p.z()) for p in found], wanted) and len(wanted) > 2

    below = layer("Point", ["POINT(30 20)"])
    _, log = run("georeference", POINTS=points_file(), INPUT=below, OUTPUT="TEMPORARY_OUTPUT")
    assert "No control point is near the layer" in log, log

    for word, field, source in (("Both layers need this field", "number", points(SOURCE)),
                                ("Two source points", "name", points(SOURCE, NAMES[:5] + ["oak"])),
                                ("church and well coincide", "name", points([*SOURCE[[0, 0]], *SOURCE[2:]])),
                                ("mirror image", "name", points(SOURCE * [1, -1])),
                                ("At least three", "name", points(SOURCE[:2], NAMES[:2]))):
        refused(word, "georeference", SOURCE_POINTS=source, TARGET_POINTS=target, ID=field)
    refused("Choose a file", "georeference", SOURCE_POINTS=points(SOURCE))
    bad = FOLDER / "bad.points"
    bad.write_text("mapX,mapY,sourceX,sourceY,enable\n1,2,x,4,1\n")
    refused("line 2", "georeference", POINTS=str(bad))


SQUARE = [(0, 0), (40, 0), (40, 30), (0, 30)]
BENT = [(100, 0), (140, 10), (150, 40), (100, 30)]


def test_rubber_sheet():
    before, after = layer("Polygon", [polygon(SQUARE)]), layer("Polygon", [polygon(BENT[::-1])], crs="EPSG:3857")
    towns = layer("MultiPoint", ["MULTIPOINT((10 10),(20 25))", "MULTIPOINT((5 5),(50 5))"])
    result, log = run("rubbersheet", SOURCE=before, TARGET=layer("Polygon", [polygon(BENT)]), INPUT=towns,
                      OUTPUT="TEMPORARY_OUTPUT")
    direct = libicc.Map(SQUARE, BENT)
    (only,) = result["OUTPUT"].getFeatures()
    assert np.allclose(np.concatenate(coordinates(only.geometry())), direct([[10, 10], [20, 25]]), atol=1e-9, rtol=0)
    assert result["CERTIFIED"] and "1 of 2 features" in log and "certified" in log, log
    result, _ = run("rubbersheet", SOURCE=before, TARGET=after, PAIRS=1, INPUT=towns, OUTPUT="TEMPORARY_OUTPUT")
    assert result["OUTPUT"].crs().authid() == "EPSG:3857"

    odd = layer("Polygon", [polygon([*BENT, (90, 20)])])
    refused("are paired by shape", "rubbersheet", SOURCE=before, TARGET=odd, INPUT=towns, OUTPUT="TEMPORARY_OUTPUT")
    lake = layer("Polygon", [polygon(SQUARE)[:-1] + ",(10 10,20 10,20 20,10 10))"])
    refused("Features are the holes", "rubbersheet", SOURCE=lake, TARGET=after, INPUT=towns, OUTPUT="TEMPORARY_OUTPUT")
    refused("EPSG:3857", "rubbersheet", SOURCE=after, TARGET=before, INPUT=towns, OUTPUT="TEMPORARY_OUTPUT")
    refused("has 2 polygons", "rubbersheet", SOURCE=layer("Polygon", [polygon(SQUARE)] * 2), TARGET=after)


def test_rasters():
    """Heights with a place and missing values, of which an outline covers a part; and classes with colours."""
    data, pixels = scan(FOLDER / "heights.tif", 1, gdal.GDT_Float32, np.float32)
    data.SetGeoTransform((-5, 1, 0, 35, 0, -1))
    data.GetRasterBand(1).SetNoDataValue(7)
    del data    # writes it
    outlines = {"SOURCE": layer("Polygon", [polygon(SQUARE)]), "TARGET": layer("Polygon", [polygon(BENT)])}
    run("rubbersheet", **outlines, RASTER=str(FOLDER / "heights.tif"), PIXEL=0.5, RESAMPLING=2,
        OUTPUT_RASTER=str(FOLDER / "bent.tif"))
    bent = gdal.Open(str(FOLDER / "bent.tif"))
    out, found = grid_of(bent), bent.ReadAsArray()
    assert out.transform == (0.5, 0, 100, 0, -0.5, 40) and (out.height, out.width) == (80, 100)
    wanted = warp_raster(pixels[0], Grid((1, 0, -5, 0, -1, 35), HEIGHT, WIDTH), libicc.Map(SQUARE, BENT), out,
                         resampling="cubic", fill=7, nodata=7)
    assert np.array_equal(found, wanted) and (found == 7).any() and bent.GetRasterBand(1).GetNoDataValue() == 7

    data, pixels = scan(FOLDER / "classes.tif", 1)
    table = gdal.ColorTable()
    table.SetColorEntry(9, (250, 0, 0, 255))
    data.GetRasterBand(1).SetColorTable(table)
    del data    # writes it
    run("georeference", POINTS=points_file(), RASTER=str(FOLDER / "classes.tif"), RESAMPLING=0,
        OUTPUT_RASTER=str(FOLDER / "moved_classes.tif"))
    moved = gdal.Open(str(FOLDER / "moved_classes.tif"))
    assert moved.GetRasterBand(1).GetColorTable().GetColorEntry(9) == (250, 0, 0, 255)
    assert np.isin(np.unique(moved.ReadAsArray()[0]), [0, *np.unique(pixels)]).all()


def test_regions():
    names = ["north", "south"]
    before = layer("Polygon", [polygon([(0, 1), (4, 1), (4, 2), (0, 2)]),
                               polygon([(0, 0), (4, 0), (4, 1), (0, 1)])], names)
    after = layer("Polygon", [polygon([(0, 0), (4, 0), (4, 1), (2, 1.4), (0, 1)]),
                              polygon([(0, 1), (2, 1.4), (4, 1), (4, 2), (0, 2)])], names[::-1])
    border = layer("LineString", ["LINESTRING(0 1,4 1)"])
    result, _ = run("rubbersheet", SOURCE=before, TARGET=after, ID="name", INPUT=border, OUTPUT="TEMPORARY_OUTPUT")
    (line,) = coordinates(next(result["OUTPUT"].getFeatures()).geometry())
    assert any(np.allclose(p, (2, 1.4)) for p in line), "the border follows the border"
    refused("has no field", "rubbersheet", SOURCE=before, TARGET=after, ID="number")


def test_installed():
    """QGIS finds the plugin in its folder of plugins. Debian gives the program qgis_process a word it does not know."""
    command = shutil.which("qgis_process.bin") or shutil.which("qgis_process")
    subprocess.run([command, "plugins", "enable", "libicc_processing"], check=True, capture_output=True)
    words = [f"--POINTS={points_file()}", f"--OUTPUT_POINTS={FOLDER / 'again.points'}"]
    done = subprocess.run([command, "run", "libicc:georeference", *words], capture_output=True, text=True)
    assert done.returncode == 0 and "certified" in done.stdout, done.stdout + done.stderr


def main():
    assert Path(libicc.__file__).is_relative_to(FOLDER), libicc.__file__
    gdal.UseExceptions()
    application = QgsApplication([], False)
    application.initQgis()
    from processing.core.Processing import Processing

    Processing.initialize()
    plugin = libicc_processing.classFactory(None)
    plugin.initProcessing()
    for test in (test_georeference, test_two_layers_of_points, test_rubber_sheet, test_rasters, test_regions):
        test()
        print(test.__name__)
    plugin.unload()
    test_installed()
    shutil.rmtree(FOLDER)
    print("the plugin works", flush=True)
    os._exit(0)    # QGIS without a window may crash when it ends


main()
