"""Control points: from a file of QGIS's georeferencer, or from two layers of points that share an id."""

import csv
from typing import NamedTuple

import numpy as np
from qgis.core import NULL, QgsCoordinateReferenceSystem, QgsProcessingException

HEADING = ["mapX", "mapY", "sourceX", "sourceY", "enable", "dX", "dY", "residual", "left_out"]


class ControlPoints(NamedTuple):
    names: list
    source: np.ndarray
    target: np.ndarray
    crs: QgsCoordinateReferenceSystem
    """The reference system of the targets, if it is known."""


def read_file(path):
    """The enabled points of a .points file, named by their lines. The source is in the coordinates in which QGIS shows
    the raster. Rows of a scan that is not georeferenced count down from 0, so they are negative."""
    names, numbers, crs = [], [], QgsCoordinateReferenceSystem()
    with open(path, encoding="utf-8-sig") as file:
        for line, text in enumerate(file, 1):
            row = text.strip().split(",")
            if text.startswith("#CRS:"):
                crs.createFromUserInput(text[5:].strip())
            if not text.strip() or text.startswith(("#", "mapX")):
                continue
            try:
                point = [float(word) for word in row[:5]]
            except ValueError:
                point = []
            if len(point) < 4:
                raise QgsProcessingException(f"{path}, line {line}: a row begins with mapX, mapY, sourceX, sourceY, "
                                             "enable, with commas between. Save the file in QGIS's Georeferencer")
            if point[4:] != [0]:
                names.append(f"line {line}")
                numbers.append(point[:4])
    numbers = np.reshape(numbers, (-1, 4))
    return ControlPoints(names, numbers[:, 2:], numbers[:, :2], crs)


def join(source, target, field, feedback):
    """Pairs the points of two layers by a field that both have."""
    sides = [_by_name(source, field, "source"), _by_name(target, field, "target")]
    names = [name for name in sides[0] if name in sides[1]]
    alone = [str(name) for name in [*sides[0], *sides[1]] if name not in names]
    if alone:
        feedback.pushWarning(f"Left out, because only one layer has them: {', '.join(alone)}")
    places = [np.reshape([side[name] for name in names], (-1, 2)) for side in sides]
    return ControlPoints(names, *places, target.sourceCrs())


def _by_name(layer, field, side):
    if field not in layer.fields().names():
        raise QgsProcessingException(f"The layer of {side} points has no field '{field}'. Both layers need this field, "
                                     "with the same value for the same place")
    result = {}
    for feature in layer.getFeatures():
        name, points = feature[field], list(feature.geometry().vertices())
        if name == NULL:
            continue
        if len(points) != 1:
            raise QgsProcessingException(f"The {side} point '{name}' has {len(points)} places instead of one")
        if name in result:
            raise QgsProcessingException(f"Two {side} points have the {field} '{name}'. Delete one of them")
        result[name] = points[0].x(), points[0].y()
    return result


def write_file(path, points, residuals, left_out, crs):
    """A .points file with residuals, in units of the map. Its last column is for people. It says how far off the other
    points alone would put this one."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        file.write(f"#CRS: {crs.toWkt()}\n" if crs.isValid() else "")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADING)
        for place, scan, off, alone in zip(points.target, points.source, residuals, left_out):
            writer.writerow([*map(repr, map(float, [*place, *scan])), 1, *off, np.hypot(*off), np.hypot(*alone)])
