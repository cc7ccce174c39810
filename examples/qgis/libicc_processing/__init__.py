"""QGIS plugin: the algorithms of libicc in the Processing toolbox."""

import sys
from pathlib import Path

WHEEL = Path(__file__).resolve().parent / "wheel"
"""The Python package libicc, if this plugin brings it along."""

if WHEEL.exists():
    sys.path.insert(0, str(WHEEL))


def classFactory(interface):
    """Called by QGIS when it loads the plugin."""
    from .provider import Plugin

    return Plugin()
