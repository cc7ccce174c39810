"""Layers and rasters of QGIS that a map carries along."""

import libicc
import numpy as np
from libicc.raster import Grid, Sampling, Window, pull
from osgeo import gdal
from qgis.core import (
    QgsFeature,
    QgsGeometry,
    QgsGeometryCollection,
    QgsLineString,
    QgsPoint,
    QgsPolygon,
    QgsProcessingException,
    QgsRasterFileWriter,
)

RESAMPLING = ["nearest", "linear", "cubic"]
PIXELS_AT_A_TIME = 1 << 20
SIDE_SAMPLES = 500
"""Points on each side of a raster, whose images tell its new extent."""


def edited(geometry, edit):
    """A geometry with straight sides, in which `edit` has replaced the coordinates of each point, line and ring. Its
    argument and result have the shape (n, 4), for x, y, z and m. What a geometry lacks is NaN."""
    if isinstance(geometry, QgsGeometryCollection):
        result = geometry.createEmptyWithSameType()
        for part in range(geometry.numGeometries()):
            result.addGeometry(edited(geometry.geometryN(part), edit))
        return result
    if isinstance(geometry, QgsPolygon):
        result = QgsPolygon(edited(geometry.exteriorRing(), edit))
        for ring in range(geometry.numInteriorRings()):
            result.addInteriorRing(edited(geometry.interiorRing(ring), edit))
        return result
    is_point = isinstance(geometry, QgsPoint)
    points = [geometry] if is_point else geometry.points()
    moved = [QgsPoint(*point) for point in edit(np.array([(p.x(), p.y(), p.z(), p.m()) for p in points])).tolist()]
    return moved[0] if is_point else QgsLineString(moved)


def carry_layer(mapping, layer, sink, tolerance, feedback):
    """Moves all features at once, so that neighbours get the same vertices. Tolerance 0: lines are exact."""
    features = list(layer.getFeatures())
    shapes = [None if f.geometry().isEmpty() else f.geometry().constGet().segmentize() for f in features]
    lines = []
    for shape in shapes:
        if shape is not None:
            edited(shape, lambda line: lines.append(line) or line)
    moved = iter(libicc.move_lines(lines, mapping, tolerance=tolerance, exact=tolerance == 0))
    lost = []
    for feature, shape in zip(features, shapes):
        result = QgsFeature(feature)
        if shape is not None:
            own = []
            shape = edited(shape, lambda line: own.append(next(moved)) or own[-1])
            if any(np.isnan(line[:, :2]).any() for line in own):
                lost.append(feature.id())
                continue
            result.setGeometry(QgsGeometry(shape))
        sink.addFeature(result)
    if lost:
        feedback.pushWarning(f"{len(lost)} of {len(features)} features are left out, because they lie at least partly "
                             f"outside the outline; clip them first to keep their inner parts. Their ids: {lost[:20]}")


class Raster:
    """A raster, and where its pixels lie in the coordinates in which QGIS shows it."""

    def __init__(self, layer):
        self.data = gdal.Open(layer.source()) if layer.providerType() == "gdal" else None
        if self.data is None:
            raise QgsProcessingException(f"{layer.name()}: only rasters in files can be moved. Export the layer first")
        at = self.data.GetGeoTransform(can_return_null=True)
        if at is None or at == (0, 1, 0, 0, 0, 1):    # QGIS shows a scan below the x axis
            at = (0, 1, 0, 0, 0, -1)
        self.grid = Grid((at[1], at[2], at[0], at[4], at[5], at[3]), self.data.RasterYSize, self.data.RasterXSize)
        self.bands = [self.data.GetRasterBand(1 + k) for k in range(self.data.RasterCount)]
        self.nodata = self.bands[0].GetNoDataValue()
        self.dtype = self.data.ReadAsArray(0, 0, 1, 1).dtype
        if self.nodata is None and self.dtype.kind == "f":
            self.nodata = float("nan")
        shown = [band.GetColorInterpretation() for band in self.bands]
        self.needs_alpha = self.nodata is None and gdal.GCI_AlphaBand not in shown

    @property
    def n_bands(self):
        return len(self.bands) + self.needs_alpha

    def read(self, window):
        array = self.data.ReadAsArray(window.column, window.row, window.shape[1], window.shape[0])
        array = array.reshape(-1, *window.shape)
        if self.needs_alpha:
            opaque = np.full((1, *window.shape), np.iinfo(self.dtype).max, self.dtype)
            array = np.concatenate([array, opaque])
        return array

    def corner(self, column, row):
        a, b, c, d, e, f = self.grid.transform
        return a * column + b * row + c, d * column + e * row + f

    @property
    def rim(self):
        """Points all around, (n, 2)."""
        w, h = self.grid.width, self.grid.height
        corners = np.array([self.corner(*c) for c in ((0, 0), (w, 0), (w, h), (0, h))])
        share = np.linspace(0, 1, SIDE_SAMPLES, endpoint=False)[:, None]
        return np.concatenate([a + share * (b - a) for a, b in zip(corners, np.roll(corners, -1, axis=0))])


def grid_for(raster, mapping, pixel):
    """North-up pixels over the image of a raster. Pixel size 0: as large as the image of one pixel, on average."""
    a, b, _, d, e, _ = raster.grid.transform
    growth = mapping.target.info.measure / mapping.source.info.measure
    pixel = pixel or float(np.sqrt(abs((a * e - b * d) * growth)))
    rim = mapping(raster.rim)
    if np.isnan(rim).any():                           # the map covers a part of the raster
        rim = mapping.target.vertices
    low, high = np.floor(rim.min(axis=0) / pixel), np.ceil(rim.max(axis=0) / pixel)
    width, height = (int(n) for n in high - low)
    return Grid((pixel, 0.0, pixel * low[0], 0.0, -pixel, pixel * high[1]), height, width)


def carry_raster(mapping, layer, path, crs, pixel, resampling, feedback):
    raster = Raster(layer)
    out = grid_for(raster, mapping, pixel)
    driver = gdal.GetDriverByName(QgsRasterFileWriter.driverForExtension(path.rpartition(".")[2]) or "GTiff")
    result = driver.Create(path, out.width, out.height, raster.n_bands, raster.bands[0].DataType)
    if result is None:
        raise QgsProcessingException(f"{path}: cannot be written ({gdal.GetLastErrorMsg()}). Take a name that ends with "
                                     ".tif")
    a, b, c, d, e, f = out.transform
    result.SetGeoTransform((c, a, b, f, d, e))
    result.SetProjection(crs.toWkt())
    for number, band in enumerate(raster.bands, 1):
        new = result.GetRasterBand(number)
        new.SetColorInterpretation(band.GetColorInterpretation())
        if band.GetColorTable() is not None:
            new.SetColorTable(band.GetColorTable())
        if raster.nodata is not None:
            new.SetNoDataValue(raster.nodata)
    if raster.needs_alpha:
        result.GetRasterBand(raster.n_bands).SetColorInterpretation(gdal.GCI_AlphaBand)
    how = Sampling(resampling, 0 if raster.nodata is None else raster.nodata, raster.nodata, 4 * PIXELS_AT_A_TIME)
    rows = max(PIXELS_AT_A_TIME // out.width, 1)
    for row in range(0, out.height, rows):
        if feedback.isCanceled():
            break
        window = Window(row, min(row + rows, out.height), 0, out.width)
        pixels = pull(raster.read, raster.grid, mapping, out, window, raster.n_bands, raster.dtype, how)
        result.WriteArray(pixels, 0, row)
        feedback.setProgress(100 * window.row_end / out.height)
