"""The table of formats: which module and library read and write a file.

A row fits a file if the name has one of its endings, and the file holds the mark, if the row has one. If no ending
fits, a mark alone decides. The first row that fits is used.
"""

from __future__ import annotations

import importlib
from pathlib import Path
from typing import Any, Dict, NamedTuple, Optional, Sequence, Tuple

_HEAD = 4096
"""Marks stand within this many bytes from the beginning."""


class FileError(Exception):
    """A file cannot be read or written. The message names the file and a remedy."""


class Format(NamedTuple):
    """A row of the table.

    Args:
        kind: the module that handles it
        name: what messages call a file of this format
        endings: of names of files, between blanks
        reader: the function of the module
        library: the package that reader and writer need; "": none but NumPy
        driver: what the library calls the format
        writes: whether the format can be written
        mark: bytes that the file holds near its beginning
    """

    kind: str
    name: str
    endings: str
    reader: str
    library: str = ""
    driver: str = ""
    writes: bool = True
    mark: bytes = b""


LIBRARIES: Dict[str, Tuple[str, str]] = {
    "geopandas": ("geopandas", "python3-geopandas"),
    "shapely": ("shapely", "python3-shapely"),
    "pyarrow": ("pyarrow geopandas", ""),
    "rasterio": ("rasterio", "python3-rasterio"),
    "PIL": ("pillow", "python3-pil"),
    "pillow_heif": ("pillow-heif", ""),
    "pillow_avif": ("pillow-avif-plugin", ""),
    "pillow_jxl": ("pillow-jxl-plugin", ""),
    "meshio": ("meshio", "python3-meshio"),
    "h5py": ("h5py meshio", "python3-h5py python3-meshio"),
    "netCDF4": ("netCDF4 meshio", "python3-netcdf4 python3-meshio"),
    "gmsh": ("gmsh meshio", "python3-gmsh python3-meshio"),
    "nibabel": ("nibabel", "python3-nibabel"),
    "pydicom": ("pydicom", "python3-pydicom"),
}
"""The packages of a library for pip and for Debian."""

FORMATS: Sequence[Format] = (
    # points, and outlines as lists of vertices
    Format("points", "a list of landmarks of 3D Slicer", ".fcsv", "slicer_table", mark=b"# Markups fiducial"),
    Format("points", "a list of landmarks of 3D Slicer", ".json", "slicer_json", mark=b'"markups"'),
    Format("points", "a Spine skeleton", ".json", "spine", writes=False, mark=b'"skeleton"'),
    Format("points", "a Lottie animation", ".json", "lottie", writes=False, mark=b'"layers"'),
    Format("points", "a Godot scene", ".tscn .tres", "godot", writes=False, mark=b"[gd_"),
    Format("points", "an OpenFOAM file of points", "", "foam", mark=b"FoamFile"),
    Format("points", "a NumPy array of points", ".npy", "array"),
    Format("points", "an SVG drawing", ".svg .svgz", "drawing", "libicc", writes=False),
    # layers
    Format("layer", "a GeoJSON file", ".geojson .json", "file", "geopandas", "GeoJSON"),
    Format("layer", "a sequence of GeoJSON", ".geojsonl .geojsons .ndjson", "file", "geopandas", "GeoJSONSeq"),
    Format("layer", "a TopoJSON file", ".topojson", "file", "geopandas", "TopoJSON", writes=False),
    Format("layer", "a GeoPackage", ".gpkg", "file", "geopandas", "GPKG", mark=b"SQLite format 3"),
    Format("layer", "a GeoPackage", ".gpkg", "file", "geopandas", "GPKG"),
    Format("layer", "an SQLite database", ".sqlite .db", "file", "geopandas", "SQLite"),
    Format("layer", "a zipped shapefile", ".zip .shz", "zipped", "geopandas", "ESRI Shapefile"),
    Format("layer", "a shapefile", ".shp", "file", "geopandas", "ESRI Shapefile"),
    Format("layer", "a FlatGeobuf file", ".fgb", "file", "geopandas", "FlatGeobuf"),
    Format("layer", "a KML file", ".kml", "file", "geopandas", "KML"),
    Format("layer", "a KMZ file", ".kmz", "file", "geopandas", "LIBKML"),
    Format("layer", "a GML file", ".gml", "file", "geopandas", "GML"),
    Format("layer", "a MapInfo file", ".tab .mif", "file", "geopandas", "MapInfo File"),
    Format("layer", "a DXF drawing", ".dxf", "file", "geopandas", "DXF"),
    Format("layer", "a DGN drawing", ".dgn", "file", "geopandas", "DGN", writes=False),
    Format("layer", "a GPX file", ".gpx", "tracks", "geopandas", "GPX", writes=False),
    Format("layer", "a Parquet file", ".parquet .geoparquet", "parquet", "pyarrow"),
    Format("layer", "a table with WKT", ".csv", "table", "geopandas", "CSV", mark=b"(("),
    Format("layer", "WKT", ".wkt .ewkt", "wkt", "shapely", "wkt"),
    Format("layer", "WKB", ".wkb .ewkb", "wkb", "shapely", "wkb"),
    Format("layer", "WKB in digits", ".hexewkb .hexwkb .hex", "wkb_digits", "shapely", "hex"),
    Format("mesh", "a Tecplot mesh", ".dat .tec", "file", "meshio", "tecplot", mark=b"ZONE"),
    Format("points", "a table of points", ".txt .csv .xy .xyz .dat .pts", "text"),
    # pictures and rasters
    Format("picture", "a GeoTIFF or TIFF picture", ".tif .tiff .vrt", "raster", "rasterio", "GTiff"),
    Format("picture", "a PNG picture", ".png", "image", "PIL", "PNG"),
    Format("picture", "a JPEG picture", ".jpg .jpeg .jpe", "image", "PIL", "JPEG"),
    Format("picture", "a WebP picture", ".webp", "image", "PIL", "WEBP"),
    Format("picture", "a GIF picture", ".gif", "image", "PIL", "GIF"),
    Format("picture", "a BMP picture", ".bmp .dib", "image", "PIL", "BMP"),
    Format("picture", "a Targa picture", ".tga", "image", "PIL", "TGA"),
    Format("picture", "a JPEG 2000 picture", ".jp2 .j2k .jpx", "image", "PIL", "JPEG2000"),
    Format("picture", "a Netpbm picture", ".ppm .pgm .pbm .pnm", "image", "PIL", "PPM"),
    Format("picture", "a Photoshop picture", ".psd", "image", "PIL", "PSD", writes=False),
    Format("picture", "an OpenRaster picture", ".ora .kra", "merged", "PIL", writes=False),
    Format("picture", "a HEIC picture", ".heic .heif", "image", "pillow_heif", "HEIF"),
    Format("picture", "an AVIF picture", ".avif", "image", "pillow_avif", "AVIF"),
    Format("picture", "a JPEG XL picture", ".jxl", "image", "pillow_jxl", "JXL"),
    # meshes
    Format("mesh", "a Gmsh mesh", ".msh", "file", "meshio", "gmsh"),
    Format("mesh", "a VTK mesh", ".vtk", "file", "meshio", "vtk"),
    Format("mesh", "a VTK mesh in XML", ".vtu", "file", "meshio", "vtu"),
    Format("mesh", "an XDMF mesh", ".xdmf .xmf", "file", "h5py", "xdmf"),
    Format("mesh", "an Exodus mesh", ".e .exo .ex2", "file", "netCDF4", "exodus"),
    Format("mesh", "a CGNS mesh", ".cgns", "file", "h5py", "cgns"),
    Format("mesh", "a MED mesh", ".med", "file", "h5py", "med"),
    Format("mesh", "a MOAB mesh", ".h5m", "file", "h5py", "h5m"),
    Format("mesh", "an Abaqus mesh", ".inp", "file", "meshio", "abaqus"),
    Format("mesh", "an SU2 mesh", ".su2", "file", "meshio", "su2"),
    Format("mesh", "a Netgen mesh", ".vol", "file", "meshio", "netgen"),
    Format("mesh", "a Medit mesh", ".mesh .meshb", "file", "meshio", "medit"),
    Format("mesh", "a UGRID mesh", ".ugrid", "file", "meshio", "ugrid"),
    Format("mesh", "an AVS mesh", ".avs", "file", "meshio", "avsucd"),
    Format("mesh", "a Tecplot mesh", ".tec", "file", "meshio", "tecplot"),
    Format("mesh", "a FLAC3D grid", ".f3grid", "file", "meshio", "flac3d"),
    Format("mesh", "a TetGen mesh", ".node .ele", "file", "meshio", "tetgen"),
    Format("mesh", "a FEniCS mesh", ".xml", "file", "meshio", "dolfin-xml", mark=b"<dolfin"),
    Format("mesh", "a Nastran mesh", ".bdf .nas .fem", "by_gmsh", "gmsh"),
    Format("mesh", "a UNV mesh", ".unv", "by_gmsh", "gmsh"),
    Format("mesh", "a FEBio model", ".feb", "febio", "meshio", writes=False),
    Format("mesh", "an STL surface", ".stl", "file", "meshio", "stl"),
    Format("mesh", "a PLY surface", ".ply", "file", "meshio", "ply"),
    Format("mesh", "an OFF surface", ".off", "file", "meshio", "off"),
    Format("mesh", "an OBJ surface", ".obj", "obj", "meshio", "obj"),
    Format("mesh", "a glTF scene", ".glb .gltf", "scene", "libicc", writes=False),
    # volumes
    Format("volume", "a NIfTI volume", ".nii .nii.gz .hdr", "nifti", "nibabel", mark=b"n+1\0"),
    Format("volume", "a NIfTI volume", ".nii .nii.gz .mgz .mgh .hdr", "nifti", "nibabel"),
    Format("volume", "a MetaImage volume", ".mha .mhd", "headed"),
    Format("volume", "an NRRD volume", ".nrrd .nhdr", "headed", mark=b"NRRD000"),
    Format("volume", "a DICOM slice", ".dcm .dicom .ima", "dicom", "pydicom", mark=b"DICM"),
    Format("volume", "NumPy arrays", ".npz .npy", "arrays"),
)


def use(library: str, path: Any, name: str) -> Any:
    """Imports a library, or names how to install it."""
    try:
        return importlib.import_module(library)
    except ImportError:
        pip, debian = LIBRARIES[library]
        also = f" (Debian: 'apt install {debian}')" if debian else ""
        raise FileError(f"{path}: {name} needs {library}, which is not installed; install it by "
                        f"'pip install {pip}'{also}") from None


def _fits(row: Format, name: str, head: Optional[bytes]) -> bool:
    return name.endswith(tuple(row.endings.split()) or ("\0",)) and (head is None or row.mark in head)


def format_of(path: Any, kinds: Sequence[str], write: bool = False) -> Format:
    """The row of the table for a file. Rows of these kinds come first."""
    name, head = str(path).lower(), None
    if not write:
        try:
            with open(path, "rb") as file:
                head = file.read(_HEAD)
        except OSError as error:
            raise FileError(f"{path}: cannot be opened: {error.strerror}") from None
    rows = [row for row in FORMATS if _fits(row, name, head)]
    if not rows and head:
        rows = [row for row in FORMATS if len(row.mark) > 3 and row.mark in head]
    wanted = [row for row in rows if row.kind in kinds and (row.writes or not write)]
    if wanted:
        return wanted[0]
    if write and any(not row.writes for row in rows):
        raise FileError(f"{path}: {rows[0].name} can only be read; {_others(rows[0].kind)}")
    if rows:
        raise FileError(f"{path}: this is {rows[0].name}, but a {' or '.join(kinds)} is needed here")
    ending = Path(name).suffix or "no ending"
    if write:
        raise FileError(f"{path}: no format is known for '{ending}'; {' or '.join(map(_others, kinds))}")
    raise FileError(f"{path}: no format is known for '{ending}'; 'python -m libicc --formats' lists the formats")


def _others(kind: str) -> str:
    """The endings that a kind can be written to."""
    endings = [row.endings.split()[0] for row in FORMATS if row.kind == kind and row.writes and row.endings]
    return f"files of {kind} end with {' '.join(dict.fromkeys(endings))}"


def _module(row: Format, path: Any) -> Any:
    if row.library in LIBRARIES:
        use(row.library, path, row.name)
    return importlib.import_module("libicc.front." + row.kind)


def split_choice(path: Any) -> Tuple[Path, str]:
    """A file and what follows # in ``FILE#name=Kent``. A file with all of that as its name comes first."""
    text = str(path)
    file, _, choice = text.rpartition("#")
    return (Path(file), choice) if file and not Path(text).exists() else (Path(text), "")


def read(path: Any, kinds: Sequence[str] = ("layer", "points", "picture", "mesh", "volume")) -> Any:
    """Reads a file by its row of the table. The result has the methods `outline`, `carry` and `save`."""
    file, choice = split_choice(path)
    row = format_of(file, kinds)
    module = _module(row, file)
    try:
        thing = getattr(module, row.reader)(file, choice, row)
    except (FileError, MemoryError):
        raise
    except Exception as error:  # of any of the libraries
        raise FileError(f"{file}: cannot be read as {row.name}: {_first_line(error)}") from error
    return thing


def write(thing: Any, path: Any) -> None:
    """Writes a thing in the format that the name of the file says."""
    row = format_of(path, [thing.kind], write=True)
    _module(row, path)
    try:
        thing.save(Path(path), row)
    except (FileError, MemoryError):
        raise
    except Exception as error:  # of any of the libraries
        raise FileError(f"{path}: cannot be written as {row.name}: {_first_line(error)}") from error


def _first_line(error: Exception) -> str:
    lines = str(error).strip().splitlines()
    return lines[0] if lines else type(error).__name__
