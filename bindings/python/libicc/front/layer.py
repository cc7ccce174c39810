"""Layers of points, lines and polygons. geopandas and shapely read and write them."""

from __future__ import annotations

import tempfile
import zipfile
from pathlib import Path
from typing import Any, List

from ._tally import Tally
from .formats import FileError, Format, use

_SHARE = 1 / 1000
"""How far lines may be off, as a share of the longest side of the result's cage, as in the command."""


class Layer:
    """A GeoDataFrame. Its attributes and its reference system stay."""

    kind = "layer"

    def __init__(self, frame: Any, path: Path, choice: str = "", clockwise: bool = False):
        self.frame, self._path, self._choice, self._clockwise = frame, path, choice, clockwise

    def outline(self) -> Any:
        """The only shape of the layer, or the one that is chosen by NAME=VALUE. Closed lines are outlines."""
        from shapely.geometry import LineString, Polygon
        from shapely.geometry.polygon import orient

        frame = self.frame[~self.frame.geometry.isna()]
        name, is_property, value = self._choice.rpartition("=")
        if is_property:
            if name not in frame:
                raise FileError(f"{self._path}: no column is called {name}; there are "
                                f"{', '.join(map(str, frame.columns.drop(frame.geometry.name)))}")
            frame = frame[frame[name].astype(str) == value]
        shapes = [shape for shape in frame.geometry
                  if shape.geom_type in ("Polygon", "MultiPolygon", "LineString", "MultiLineString", "LinearRing")]
        shapes = [line for shape in shapes
                  for line in (shape.geoms if shape.geom_type == "MultiLineString" else [shape])]
        if len(shapes) != 1:
            raise FileError(f"{self._path}: has {len(shapes)} shapes{' with ' + self._choice if is_property else ''}; "
                            f"choose one by an attribute: {self._path}#name=value")
        shape = shapes[0]
        if isinstance(shape, LineString):
            shape = Polygon(shape.coords)
        # A shapefile turns its outlines clockwise by its standard, whatever they were before.
        return orient(shape) if self._clockwise and shape.geom_type == "Polygon" else shape

    def carry(self, mapping: Any, how: Any) -> Tally:
        from libicc import geopandas as _accessor

        domain = how.source_domain if how.inverse else how.target_domain
        tolerance = how.tolerance if how.tolerance is not None else _SHARE * max(domain.info.upper - domain.info.lower)
        before = self.frame.geometry
        images = _accessor.GeometryAccessor(before).map(
            mapping, inverse=how.inverse, tolerance=0 if how.exact else tolerance, exact=how.exact, outside="null")
        lost = images.isna() & ~before.isna()
        if how.outside == "keep":
            images = images.where(~lost, before)
        self.frame = self.frame.set_geometry(images)
        return Tally(f"{lost.sum()} of {len(before)} features lie outside the cage" if lost.any() else "",
                     0 if how.outside == "keep" else int(lost.sum()))

    def save(self, path: Path, row: Format) -> None:
        frame = self.frame
        if row.reader == "table":
            table = frame.drop(columns=frame.geometry.name)
            table["WKT"] = [None if shape is None else shape.wkt for shape in frame.geometry]
            table.to_csv(path, index=False)
        elif row.reader == "parquet":
            frame.to_parquet(path)
        elif row.library == "shapely":
            self._save_shape(path, row)
        elif row.reader == "zipped":
            self._save_zip(path)
        else:
            _unlock(row.driver)
            columns = [frame.geometry.name] if row.driver in ("DXF",) else list(frame.columns)
            frame[columns].to_file(path, driver=row.driver)

    def _save_shape(self, path: Path, row: Format) -> None:
        from shapely import wkb, wkt
        from shapely.geometry import GeometryCollection

        shapes = list(self.frame.geometry)
        shape = shapes[0] if len(shapes) == 1 else GeometryCollection(shapes)
        if row.driver == "wkb":
            path.write_bytes(wkb.dumps(shape))
        else:
            path.write_text(wkb.dumps(shape, hex=True) if row.driver == "hex" else wkt.dumps(shape, trim=True))

    def _save_zip(self, path: Path) -> None:
        with tempfile.TemporaryDirectory() as folder:
            self.frame.to_file(Path(folder, path.stem + ".shp"), driver="ESRI Shapefile")
            with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
                for part in sorted(Path(folder).iterdir()):
                    archive.write(part, part.name)


def _unlock(driver: str) -> None:
    """Fiona knows more formats than it uses unless it is told so. pyogrio uses them all."""
    try:
        import fiona
    except ImportError:
        return
    for name in (driver, "LIBKML") if driver == "KML" else (driver,):
        fiona.drvsupport.supported_drivers[name] = "rw"


def _read(path: Any, choice: str, row: Format, **options: Any) -> Any:
    geopandas = use("geopandas", path, row.name)
    _unlock(row.driver)
    name, _, value = choice.partition("=")
    if name == "layer" and value:
        options["layer"] = value
    return geopandas.read_file(path, **options)


def file(path: Path, choice: str, row: Format) -> Layer:
    frame = _read(path, choice, row)
    return Layer(frame, path, "" if choice.startswith("layer=") else choice, row.driver == "ESRI Shapefile")


def zipped(path: Path, choice: str, row: Format) -> Layer:
    return Layer(_read(f"zip://{path}", choice, row), path, choice, True)


def tracks(path: Path, choice: str, row: Format) -> Layer:
    """The tracks of a GPX file."""
    return Layer(_read(path, choice or "layer=tracks", row), path)


def parquet(path: Path, choice: str, row: Format) -> Layer:
    return Layer(use("geopandas", path, row.name).read_parquet(path), path, choice)


def table(path: Path, choice: str, row: Format) -> Layer:
    """A table with a column of WKT."""
    geopandas, pandas = use("geopandas", path, row.name), use("pandas", path, row.name)
    from shapely import wkt

    frame = pandas.read_csv(path)
    for name in frame.columns:
        if frame[name].astype(str).str.contains(r"^\s*(?:SRID=\d+;)?\s*[A-Za-z ]+\(").all():
            shapes = [wkt.loads(text.split(";")[-1]) for text in frame[name]]
            return Layer(geopandas.GeoDataFrame(frame.drop(columns=name), geometry=shapes), path, choice)
    raise FileError(f"{path}: no column holds WKT")


def _shapes(shapes: List[Any], path: Path, choice: str) -> Layer:
    geopandas = use("geopandas", path, "a layer")
    return Layer(geopandas.GeoDataFrame(geometry=shapes), path, choice)


def wkt(path: Path, choice: str, row: Format) -> Layer:
    from shapely import wkt as reader

    return _shapes([reader.loads(path.read_text().split(";")[-1])], path, choice)


def wkb(path: Path, choice: str, row: Format) -> Layer:
    from shapely import wkb as reader

    return _shapes([reader.loads(path.read_bytes())], path, choice)


def wkb_digits(path: Path, choice: str, row: Format) -> Layer:
    from shapely import wkb as reader

    return _shapes([reader.loads(path.read_text().strip(), hex=True)], path, choice)
