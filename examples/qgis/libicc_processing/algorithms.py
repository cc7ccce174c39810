"""The algorithms: where their maps come from, and what they ask for."""

import json

import libicc
import numpy as np
from qgis.core import (
    QgsProcessing,
    QgsProcessingAlgorithm,
    QgsProcessingException,
    QgsProcessingOutputBoolean,
    QgsProcessingOutputNumber,
    QgsRectangle,
    QgsWkbTypes,
)
from qgis.core import QgsProcessingParameterCrs as Crs
from qgis.core import QgsProcessingParameterEnum as Choice
from qgis.core import QgsProcessingParameterFeatureSink as NewLayer
from qgis.core import QgsProcessingParameterFeatureSource as Layer
from qgis.core import QgsProcessingParameterField as Field
from qgis.core import QgsProcessingParameterFile as File
from qgis.core import QgsProcessingParameterFileDestination as NewFile
from qgis.core import QgsProcessingParameterNumber as Number
from qgis.core import QgsProcessingParameterRasterDestination as NewRaster
from qgis.core import QgsProcessingParameterRasterLayer as Raster

from . import control_points
from .carry import RESAMPLING, carry_layer, carry_raster

ANY = [QgsProcessing.TypeVectorAnyGeometry]
POINTS = [QgsProcessing.TypeVectorPoint]
POLYGONS = [QgsProcessing.TypeVectorPolygon]
REAL = {"type": Number.Double, "defaultValue": 0, "minValue": 0}
FREE = {"optional": True}
ON_DEMAND = {"optional": True, "createByDefault": False}
MOST_SHOWN = 30


class Carrying(QgsProcessingAlgorithm):
    """Moves a layer and a raster by the map that `make_map` makes."""

    def createInstance(self):
        return type(self)()

    def name(self):
        return type(self).__name__.lower()

    def displayName(self):
        return self.title

    def shortHelpString(self):
        return self.help

    def initAlgorithm(self, configuration=None):
        for parameter in (
                *self.own_parameters(),
                Layer("INPUT", "Layer to move", ANY, **FREE),
                Raster("RASTER", "Raster to move", **FREE),
                Number("DEVIATION", "How far lines may be off, in units of the result (0: exact)", **REAL),
                Number("PIXEL", "Pixel size of the new raster (0: about as many pixels as before)", **REAL),
                Choice("RESAMPLING", "Resampling", RESAMPLING, defaultValue=1),
                NewLayer("OUTPUT", "Moved layer", **FREE),
                NewRaster("OUTPUT_RASTER", "Moved raster", **ON_DEMAND)):
            self.addParameter(parameter)
        self.addOutput(QgsProcessingOutputBoolean("CERTIFIED", "Whether the map is proved one-to-one"))

    def processAlgorithm(self, parameters, context, feedback):
        def progress(stage, share):
            feedback.setProgress(100 * share)
            return feedback.isCanceled()

        self.layer = self.parameterAsSource(parameters, "INPUT", context)
        self.raster = self.parameterAsRasterLayer(parameters, "RASTER", context)
        try:
            mapping, crs, results = self.make_map(parameters, context, feedback, progress)
            self.log(mapping, feedback)
            results["CERTIFIED"] = bool(mapping.certified)
            self.carry(mapping, crs, parameters, context, feedback, results)
        except libicc.Cancelled:
            return {}
        except (libicc.Error, ValueError) as error:
            raise QgsProcessingException(self.in_words(str(error))) from error
        return results

    def carry(self, mapping, crs, parameters, context, feedback, results):
        if self.layer is not None and parameters.get("OUTPUT") is not None:
            kind, fields = QgsWkbTypes.linearType(self.layer.wkbType()), self.layer.fields()
            sink, results["OUTPUT"] = self.parameterAsSink(parameters, "OUTPUT", context, fields, kind, crs)
            if sink is None:
                raise QgsProcessingException(self.invalidSinkError(parameters, "OUTPUT"))
            tolerance = self.parameterAsDouble(parameters, "DEVIATION", context)
            carry_layer(mapping, self.layer, sink, tolerance, feedback)
        if self.raster is not None and parameters.get("OUTPUT_RASTER") is not None:
            results["OUTPUT_RASTER"] = self.parameterAsOutputLayer(parameters, "OUTPUT_RASTER", context)
            carry_raster(mapping, self.raster, results["OUTPUT_RASTER"], crs,
                         self.parameterAsDouble(parameters, "PIXEL", context),
                         RESAMPLING[self.parameterAsEnum(parameters, "RESAMPLING", context)], feedback)

    def log(self, mapping, feedback):
        info = mapping.info
        if info.certified:
            feedback.pushInfo(f"One-to-one: yes, certified. All {info.n_simplices} triangles keep their orientation, "
                              "checked with exact arithmetic.")
        else:
            feedback.pushWarning("One-to-one: not proved. Look for places where the result folds.")

    def check_crs(self, name, thing):
        """Raises an error if the layer to move is in another system than the source."""
        if self.layer is None:
            return
        own, other = self.layer.sourceCrs(), thing.sourceCrs()
        if own.isValid() and other.isValid() and own != other:
            raise QgsProcessingException(f"{name} is in {other.authid()}, but the layer to move in {own.authid()}. "
                                         "Reproject one of them")


class Georeference(Carrying):
    title = "Georeference by control points, certified"
    help = """Moves a raster, a layer drawn over it, or both to where control points say. The map goes through all
points and does not fold. That is proved, and the log says so.

The points come from a file of the Georeferencer, or from two layers of points that share a field. Source points are in
the coordinates in which QGIS shows the raster.

The log lists how far off each point would be if only the others were known. A wrong point stands out. The root mean
square is the accuracy that you can expect between the points."""

    def own_parameters(self):
        return (File("POINTS", "Control points of the Georeferencer", extension="points", **FREE),
                Layer("SOURCE_POINTS", "Or source points", POINTS, **FREE),
                Layer("TARGET_POINTS", "and target points", POINTS, **FREE),
                Field("ID", "that share this field", parentLayerParameterName="SOURCE_POINTS", **FREE),
                Crs("CRS", "Reference system of the targets, if the points do not tell", **FREE),
                Number("TOLERANCE", "How exact the targets are, in their units (0: the map goes through them)", **REAL),
                NewFile("OUTPUT_POINTS", "Control points with residuals", "Control points (*.points)", **ON_DEMAND))

    def initAlgorithm(self, configuration=None):
        super().initAlgorithm(configuration)
        self.addOutput(QgsProcessingOutputNumber("LEFT_OUT", "Accuracy: root mean square of points left out"))

    def make_map(self, parameters, context, feedback, progress):
        self.points = self.read_points(parameters, context, feedback)
        n = len(self.points.names)
        if n < 3:
            raise QgsProcessingException(f"There are {n} control points. At least three are needed")
        crs = self.parameterAsCrs(parameters, "CRS", context)
        crs = crs if crs.isValid() else self.points.crs
        mapping = libicc.fit(self.points.source, self.points.target, box=self.box(feedback), progress=progress,
                             tolerance=self.parameterAsDouble(parameters, "TOLERANCE", context) or None)
        off = mapping.left_out
        results = {"LEFT_OUT": float(np.sqrt((off ** 2).sum(axis=1).mean()))}
        path = self.parameterAsFileOutput(parameters, "OUTPUT_POINTS", context)
        if path:
            control_points.write_file(path, self.points, mapping.residuals, off, crs)
            results["OUTPUT_POINTS"] = path
        return mapping, crs, results

    def read_points(self, parameters, context, feedback):
        path = self.parameterAsFile(parameters, "POINTS", context)
        if path:
            return control_points.read_file(path)
        source = self.parameterAsSource(parameters, "SOURCE_POINTS", context)
        target = self.parameterAsSource(parameters, "TARGET_POINTS", context)
        if source is None or target is None:
            raise QgsProcessingException("Choose a file of control points, or two layers of points and a field that "
                                         "they share")
        self.check_crs("The layer of source points", source)
        return control_points.join(source, target, self.parameterAsString(parameters, "ID", context), feedback)

    def box(self, feedback):
        """What the map must cover: points, layer and raster."""
        low, high = self.points.source.min(axis=0), self.points.source.max(axis=0)
        among_points = QgsRectangle(*low, *high)
        things = {"layer": self.layer and self.layer.sourceExtent(), "raster": self.raster and self.raster.extent()}
        for name, extent in things.items():
            if extent is None or extent.isNull():
                continue
            low = np.minimum(low, [extent.xMinimum(), extent.yMinimum()])
            high = np.maximum(high, [extent.xMaximum(), extent.yMaximum()])
            if not extent.intersects(among_points):
                feedback.pushWarning(f"No control point is near the {name}. Do both have the same coordinates? Rows "
                                     "of a scan are negative in QGIS")
        return low, high

    def log(self, mapping, feedback):
        super().log(mapping, feedback)
        off, residuals = np.hypot(*mapping.left_out.T), np.hypot(*mapping.residuals.T)
        feedback.pushInfo("Distance from the target, in its units: if the point is left out; in this map")
        for k in np.argsort(-off)[:MOST_SHOWN]:
            feedback.pushInfo(f"{self.points.names[k]}: {off[k]:.6g}; {residuals[k]:.6g}")

    def in_words(self, message):
        """libicc counts points from 0. Here they have names."""
        words = message.split()
        if words[0] == "points" and words[2] == "and":
            words[1], words[3] = (str(self.points.names[int(words[k])]) for k in (1, 3))
        elif words[0] == "point":
            words[1] = str(self.points.names[int(words[1])])
        elif "mirror" in words:
            return ("The target points are a mirror image of the source points. In the source y must grow upwards: "
                    "rows of a scan are negative in QGIS")
        return " ".join(words)


class RubberSheet(Carrying):
    title = "Rubber-sheet by outlines, certified"
    help = """Moves whatever lies in one outline to another outline: a layer, a raster, or both. The map is one-to-one
with little distortion. That is proved, and the log says so.

Each layer of outlines has one polygon. Holes become holes. With a field, each layer has many polygons that share
borders, and polygons of the same value are partners."""

    def own_parameters(self):
        ways = ["correspond one by one, in their order", "are paired by shape"]
        return (Layer("SOURCE", "Outline before", POLYGONS),
                Layer("TARGET", "Outline after", POLYGONS),
                Field("ID", "Field that tells which polygons are partners", parentLayerParameterName="SOURCE", **FREE),
                Choice("PAIRS", "Vertices of the outlines", ways, defaultValue=0))

    def make_map(self, parameters, context, feedback, progress):
        source, target = (self.parameterAsSource(parameters, name, context) for name in ("SOURCE", "TARGET"))
        self.check_crs("The outline before", source)
        field = self.parameterAsString(parameters, "ID", context)
        if field:
            pair = libicc.Coverage(regions_of(source, field, "before"), regions_of(target, field, "after"), "by",
                                   progress=progress)
            shapes = pair.source, pair.target
        else:
            shapes = outline_of(source, "before"), outline_of(target, "after")
            if self.parameterAsEnum(parameters, "PAIRS", context) == 1:
                pair = libicc.Match(*shapes, progress=progress)
                shapes = pair.source, pair.target
        return libicc.Map(*shapes, progress=progress), target.sourceCrs(), {}

    def in_words(self, message):
        if "must correspond" in message:
            return message + ". If the outlines were drawn apart, choose 'are paired by shape'"
        if "features" in message:
            return message + ". Features are the holes and further parts of an outline"
        return message


def geojson(features, **properties):
    """As GeoJSON. Rings of all layers run the same way round."""
    return [{"type": "Feature", "properties": {key: feature[name] for key, name in properties.items()},
             "geometry": json.loads(feature.geometry().forceRHR().asJson(17))}
            for feature in features if not feature.geometry().isEmpty()]


def outline_of(layer, which):
    shapes = geojson(layer.getFeatures())
    if len(shapes) != 1:
        raise QgsProcessingException(f"The outline {which} has {len(shapes)} polygons. Select one, dissolve them, or "
                                     "choose the field that tells which polygons are partners")
    return shapes[0]["geometry"]


def regions_of(layer, field, which):
    names = layer.fields().names()
    if field not in names:
        raise QgsProcessingException(f"The outline {which} has no field '{field}', but {', '.join(names)}")
    return {"type": "FeatureCollection", "features": geojson(layer.getFeatures(), by=field)}
