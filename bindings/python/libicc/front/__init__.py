"""One front for the files of other programs: ``python -m libicc warp|map|mesh|check|match``.

    python -m libicc map -s county.gpkg -t moved.shp roads.kml moved-roads.gpkg
    python -m libicc mesh -s before.stl -t after.stl part.msh moved.vtu

Well-kept libraries read and write the files, and the map moves what they hold. `formats` is the table of formats. Each
kind of thing has a module: `points`, `layer`, `picture`, `mesh`, `volume`. Each module has readers, and a class with
``outline`` (the thing as a shape), ``carry`` (moves it) and ``save``. Libraries are imported when a format needs them.

`read` and `write` are for your own programs.
"""

from ._command import CAGES, main
from .formats import FileError, read, write

__all__ = ["CAGES", "FileError", "main", "read", "write"]
