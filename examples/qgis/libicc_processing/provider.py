"""Adds the algorithms to the Processing toolbox."""

from qgis.core import QgsApplication, QgsProcessingProvider

from .algorithms import Georeference, RubberSheet


class Provider(QgsProcessingProvider):
    def id(self):
        return "libicc"

    def name(self):
        return "libicc"

    def loadAlgorithms(self):
        self.addAlgorithm(Georeference())
        self.addAlgorithm(RubberSheet())


class Plugin:
    """What QGIS expects of a plugin. `initProcessing` alone is called by qgis_process."""

    def __init__(self):
        self.provider = None

    def initProcessing(self):
        self.provider = Provider()
        QgsApplication.processingRegistry().addProvider(self.provider)

    def initGui(self):
        self.initProcessing()

    def unload(self):
        QgsApplication.processingRegistry().removeProvider(self.provider)
