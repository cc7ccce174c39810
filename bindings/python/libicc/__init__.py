"""Move everything inside a shape along when its boundary moves.

    import libicc
    mapping = libicc.Map(before, after)      # two polygons, (n, 2) arrays
    images = mapping(points)                 # one-to-one, certified
    points = mapping.inverse(images)         # mapping.inverse is a map itself

If you know only some points, ``libicc.fit(points, to)`` makes the map from them.

`Domain` -> `Chart` -> `Map`. `libicc.stages` has the steps of the papers, `libicc.kernel` smooth weights for handles.
Points are arrays (n, dim) of float64 in your coordinates, and angles are radians.

Objects are immutable, and threads may share them. Calls release the interpreter lock. Charts and maps can be pickled,
so you can send them to other processes and machines. Diagnostics go to the logger "libicc", level INFO.
"""

from typing import TYPE_CHECKING as _TYPE_CHECKING
from typing import Any as _Any

from ._abi import lib as _lib
from ._chart import Chart
from ._core import Progress
from ._coverage import Coverage
from ._domain import BOUNDARY, INSIDE, OUTSIDE, Domain, as_domain, boundary_defects, repair_mask
from ._errors import (
    AmbiguousError,
    ArgumentError,
    BoundaryError,
    Cancelled,
    CertificateError,
    Error,
    FormatError,
    OutOfMemoryError,
    OutsideError,
    ResolutionError,
    SolverError,
    TopologyError,
    TraceError,
    UnsupportedError,
    VersionError,
)
from ._field import Field, certify_field
from ._fit import Fit, fit, nearest
from ._image import PixelTransform, picture_cage, warp_image
from ._layer import move_lines
from ._map import Map
from ._match import Match, match

if _TYPE_CHECKING:
    from . import fields, kernel, stages

__version__ = _lib.version().decode()
"""The version of the C library that is in use."""

__all__ = [
    "AmbiguousError",
    "ArgumentError",
    "BOUNDARY",
    "BoundaryError",
    "Cancelled",
    "CertificateError",
    "Chart",
    "Coverage",
    "Domain",
    "Error",
    "Field",
    "Fit",
    "FormatError",
    "INSIDE",
    "Map",
    "Match",
    "OUTSIDE",
    "OutOfMemoryError",
    "OutsideError",
    "PixelTransform",
    "Progress",
    "ResolutionError",
    "SolverError",
    "TopologyError",
    "TraceError",
    "UnsupportedError",
    "VersionError",
    "as_domain",
    "boundary_defects",
    "certify_field",
    "fields",
    "fit",
    "kernel",
    "match",
    "move_lines",
    "nearest",
    "picture_cage",
    "repair_mask",
    "stages",
    "warp_image",
]


def __getattr__(name: str) -> _Any:
    """Imports the parts that most programs do not need when they are first used."""
    if name in ("fields", "kernel", "stages"):
        from importlib import import_module

        return import_module("." + name, __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
