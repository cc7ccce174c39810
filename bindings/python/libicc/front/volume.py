"""Volumes of voxels, which lie in the world: labels, scans and fields of displacements.

World coordinates are those of the file: millimetres to the right, front and top in NIfTI (RAS), and to the left, back and
top in MetaImage, NRRD and DICOM (LPS). Voxel indices are whole numbers at the centres of voxels.
"""

from __future__ import annotations

import gzip
import zlib
from pathlib import Path
from typing import Any, Callable, Dict, List, Tuple

import numpy as np

from ._tally import Tally
from .formats import FileError, Format, use

_TYPES = {"MET_UCHAR": "u1", "MET_CHAR": "i1", "MET_USHORT": "u2", "MET_SHORT": "i2", "MET_UINT": "u4", "MET_INT": "i4",
          "MET_FLOAT": "f4", "MET_DOUBLE": "f8",
          "uchar": "u1", "unsigned char": "u1", "uint8": "u1", "uint8_t": "u1", "signed char": "i1", "int8": "i1",
          "int8_t": "i1", "ushort": "u2", "unsigned short": "u2", "uint16": "u2", "uint16_t": "u2", "short": "i2",
          "int16": "i2", "int16_t": "i2", "uint": "u4", "unsigned int": "u4", "uint32": "u4", "uint32_t": "u4", "int": "i4",
          "int32": "i4", "int32_t": "i4", "float": "f4", "double": "f8"}


class Volume:
    """Voxels with an affine transform to the world.

    Args:
        data: (i, j, k) or (i, j, k, values): whole numbers are labels
        affine: (dim + 1, dim + 1): from voxel indices to the world; None: from_mask's corners of cells
        is_field: whether the values are displacements in the world
        rewrite: writes new data to a file of the own format
    """

    kind = "volume"

    def __init__(self, data: Any, affine: Any, path: Path, own: str, rewrite: Callable[[Any, Path], None],
                 is_field: bool = False):
        self.data, self.affine, self._path, self._own = data, affine, path, own
        self._rewrite, self._is_field = rewrite, is_field
        self._dim = affine.shape[0] - 1 if affine is not None else data.ndim

    def outline(self) -> Any:
        """The boundary of the voxels that are not 0."""
        import libicc

        mask = self.data.reshape(*self.data.shape[:self._dim], -1).any(axis=-1)
        if self._is_field or not mask.any():
            raise FileError(f"{self._path}: no voxel is above 0, so there is no shape")
        shape = libicc.Domain.from_mask(mask)
        if self.affine is None:
            return shape
        vertices = (shape.vertices - 0.5) @ self.affine[:-1, :-1].T + self.affine[:-1, -1]
        facets = shape.facets if np.linalg.det(self.affine[:-1, :-1]) > 0 else shape.facets[:, ::-1]
        return vertices, facets

    def carry(self, mapping: Any, how: Any) -> Tally:
        if mapping.dim != self._dim:
            raise FileError(f"{self._path}: has {self._dim} dimensions, and the cages have {mapping.dim}")
        if self.data.ndim < self._dim:
            raise FileError(f"{self._path}: has the shape {self.data.shape}")
        affine = self.affine if self.affine is not None else _corners(self._dim)
        matrix, offset = affine[:-1, :-1], affine[:-1, -1]
        grid = np.moveaxis(np.indices(self.data.shape[:self._dim]), 0, -1).reshape(-1, self._dim)
        world = grid @ matrix.T + offset
        back = mapping.inverse(world)
        inside = np.isfinite(back).all(axis=1)
        index = (back[inside] - offset) @ np.linalg.inv(matrix).T
        smooth = self.data.dtype.kind == "f" and how.resampling != "nearest"
        values = _linear(self.data, index) if smooth else _nearest(self.data, index)
        if self._is_field:
            # An arrow moves with both of its ends. An arrow that leaves the cage ends where it did.
            arrows = values.reshape(len(index), -1)[:, :self._dim]
            ends = mapping(back[inside] + arrows)
            ends = np.where(np.isfinite(ends), ends, back[inside] + arrows)
            values = (ends - world[inside]).reshape(values.shape)
        result = np.zeros_like(self.data) if how.outside == "null" else self.data.copy()
        flat = result.reshape(len(grid), *self.data.shape[self._dim:])
        flat[inside] = values
        self.data = flat.reshape(self.data.shape)
        return Tally()

    def save(self, path: Path, row: Format) -> None:
        if row.reader == self._own:
            self._rewrite(self.data, path)
        elif row.reader == "nifti" and self.affine is not None and self._dim == 3:
            # NIfTI turns the first two axes of the others.
            turn = np.diag([-1.0, -1.0, 1.0, 1.0]) if self._own != "nifti" else np.eye(4)
            nibabel = use("nibabel", path, row.name)
            nibabel.save(nibabel.Nifti1Image(self.data, turn @ self.affine), path)
        elif row.reader == "headed" and self._dim == 3 and self.affine is not None:
            turn = np.diag([-1.0, -1.0, 1.0, 1.0]) if self._own == "nifti" else np.eye(4)
            _write_headed(self.data, turn @ self.affine, path)
        elif row.reader == "arrays":
            np.save(path, self.data) if path.suffix == ".npy" else np.savez_compressed(path, data=self.data)
        else:
            raise FileError(f"{path}: {row.name} is written only from a file of this format; write .nii.gz, .mha or .npy")


def _corners(dim: int) -> Any:
    """Cell (i, j, ..) of an array covers [i, i + 1] x [j, j + 1] x .."""
    affine = np.eye(dim + 1)
    affine[:-1, -1] = 0.5
    return affine


def _nearest(data: Any, index: Any) -> Any:
    at = np.rint(index).astype(np.intp)
    return data[tuple(np.clip(at[:, axis], 0, data.shape[axis] - 1) for axis in range(index.shape[1]))]


def _linear(data: Any, index: Any) -> Any:
    """Between the centres of voxels. Beyond the last ones, their values go on."""
    dim, beyond = index.shape[1], data.ndim - index.shape[1]
    low = np.floor(index)
    total = np.zeros((len(index), *data.shape[dim:]))
    for corner in np.ndindex(*(2,) * dim):
        share = np.where(corner, index - low, 1 - (index - low)).prod(axis=1)
        total += share.reshape(-1, *(1,) * beyond) * _nearest(data, low + np.array(corner))
    return total


def nifti(path: Path, choice: str, row: Format) -> Volume:
    nibabel = use("nibabel", path, row.name)
    image: Any = nibabel.load(path)
    given = np.asarray(image.dataobj)
    # Values stand in the fifth axis. Time stays as further values.
    data = given.reshape(*given.shape[:3], -1) if given.ndim > 3 else given

    def rewrite(images: Any, target: Path) -> None:
        nibabel.save(type(image)(images.reshape(given.shape), image.affine, image.header), target)

    is_field = image.header.get_intent()[0] in ("vector", "displacement vector") if hasattr(
        image.header, "get_intent") else False
    return Volume(data, image.affine, path, row.reader, rewrite, is_field and data.ndim == 4)


def dicom(path: Path, choice: str, row: Format) -> Volume:
    """One slice: columns and rows in pixels. A series of slices is converted by 'dcm2niix' first."""
    pydicom = use("pydicom", path, row.name)
    scan = pydicom.dcmread(path)
    data = np.ascontiguousarray(scan.pixel_array.T)

    def rewrite(images: Any, target: Path) -> None:
        if scan.file_meta.TransferSyntaxUID.is_compressed:
            scan.decompress()
        scan.PixelData = np.ascontiguousarray(images.T).tobytes()
        scan.save_as(target)

    return Volume(data, None, path, row.reader, rewrite)


def arrays(path: Path, choice: str, row: Format) -> Volume:
    """One array of NumPy. Cell (i, j, ..) covers [i, i + 1] x [j, j + 1] x .."""
    loaded = np.load(path)
    name = ""
    if not isinstance(loaded, np.ndarray):
        names = list(loaded)
        name = choice or names[0]
        if name not in names or len(names) > 1 and not choice:
            raise FileError(f"{path}: holds the arrays {', '.join(names)}; choose one: {path}#{names[0]}")
        loaded = loaded[name]

    def rewrite(images: Any, target: Path) -> None:
        np.save(target, images) if target.suffix == ".npy" else np.savez_compressed(target, **{name or "data": images})

    return Volume(loaded, None, path, "arrays", rewrite)


def _fields(lines: List[str], between: str) -> Dict[str, str]:
    pairs = [line.split(between, 1) for line in lines if between in line and not line.startswith("#")]
    return {name.strip(): value.lstrip("=").strip() for name, value in pairs}


def headed(path: Path, choice: str, row: Format) -> Volume:
    """MetaImage and NRRD: a header of lines, and voxels as raw or zipped bytes behind it or in a file of their own."""
    content = path.read_bytes()
    read = _nrrd if content.startswith(b"NRRD") else _metaimage
    data, affine = read(path, content)
    return Volume(data, affine, path, row.reader, lambda images, target: _write_headed(images, affine, target))


def _voxels(path: Path, content: bytes, file: str, kind: str, order: str, sizes: Any, zipped: bool, n: int) -> Any:
    if kind not in _TYPES:
        raise FileError(f"{path}: voxels of the type {kind!r} are not known")
    raw = content if not file else (path.parent / file).read_bytes()
    raw = (gzip.decompress(raw) if raw[:2] == b"\x1f\x8b" else zlib.decompress(raw)) if zipped else raw
    dtype = np.dtype(order + _TYPES[kind])
    shape = (*sizes[::-1], n) if n > 1 else tuple(sizes[::-1])
    flat = np.frombuffer(raw, dtype, count=int(np.prod(shape)))
    cells = flat.reshape(shape)
    axes = (*range(len(sizes) - 1, -1, -1), len(sizes)) if n > 1 else tuple(range(len(sizes) - 1, -1, -1))
    return np.array(cells.transpose(axes), dtype=dtype.newbyteorder("="))


def _metaimage(path: Path, content: bytes) -> Tuple[Any, Any]:
    end = content.index(b"\n", content.index(b"ElementDataFile")) + 1
    about = _fields(content[:end].decode("latin-1").splitlines(), "=")
    dim = int(about["NDims"])
    file = about["ElementDataFile"]
    if file == "LIST" or "%" in file or about.get("BinaryData", "True") == "False":
        raise FileError(f"{path}: its voxels are text or a list of files; SimpleITK writes them as one: "
                        f"SimpleITK.WriteImage(SimpleITK.ReadImage('{path}'), 'one.mha')")
    affine = np.eye(dim + 1)
    matrix = about.get("TransformMatrix", about.get("Rotation", about.get("Orientation", "")))
    turn = np.reshape([float(x) for x in matrix.split()], (dim, dim)).T if matrix else np.eye(dim)
    affine[:-1, :-1] = turn * [float(x) for x in about.get("ElementSpacing", "1 " * dim).split()]
    affine[:-1, -1] = [float(x) for x in about.get("Offset", about.get("Position", "0 " * dim)).split()]
    order = ">" if about.get("BinaryDataByteOrderMSB", about.get("ElementByteOrderMSB", "False")) == "True" else "<"
    data = _voxels(path, content[end:], "" if file == "LOCAL" else file, about["ElementType"], order,
                   [int(x) for x in about["DimSize"].split()], about.get("CompressedData", "False") == "True",
                   int(about.get("ElementNumberOfChannels", "1")))
    return data, affine


def _vector(text: str) -> List[float]:
    return [float(x) for x in text.strip(" ()").split(",")]


def _nrrd(path: Path, content: bytes) -> Tuple[Any, Any]:
    head, _, rest = content.replace(b"\r\n", b"\n", 100).partition(b"\n\n")
    about = _fields(head.decode("latin-1").splitlines()[1:], ":")
    sizes = [int(x) for x in about["sizes"].split()]
    n = 1
    if "space directions" in about:
        directions = [_vector(x) if x != "none" else None for x in about["space directions"].replace(", ", ",").split()]
        columns = [x for x in directions if x is not None]
        if directions[0] is None:
            n, sizes = sizes[0], sizes[1:]
        dim = len(sizes)
        affine = np.eye(dim + 1)
        affine[:-1, :-1] = np.array(columns).T
    else:
        dim = len(sizes)
        affine = np.diag([*(float(x) for x in about.get("spacings", "1 " * dim).split()), 1.0])
    if "space origin" in about:
        affine[:-1, -1] = _vector(about["space origin"])
    if about.get("space", "").lower() in ("right-anterior-superior", "ras"):
        affine = np.diag([-1.0, -1.0, 1.0, 1.0]) @ affine
    encoding = about["encoding"].lower()
    if encoding not in ("raw", "gzip", "gz"):
        raise FileError(f"{path}: the encoding {encoding} is not known; 'unu save -f nrrd -e gzip' writes gzip")
    file = about.get("data file", about.get("datafile", ""))
    order = ">" if about.get("endian", "little") == "big" else "<"
    return _voxels(path, rest, file, about["type"], order, sizes, encoding != "raw", n), affine


def _write_headed(data: Any, affine: Any, path: Path) -> None:
    dim = affine.shape[0] - 1
    n = int(np.prod(data.shape[dim:]))
    axes = (*range(dim - 1, -1, -1), *range(dim, data.ndim))
    raw = np.ascontiguousarray(data.transpose(axes)).astype(data.dtype.newbyteorder("<")).tobytes()
    code = data.dtype.str[1:]
    is_nrrd = path.suffix.lower() in (".nrrd", ".nhdr")
    kind = next((name for name, its in _TYPES.items() if its == code and name.startswith("MET_") != is_nrrd), None)
    if kind is None:
        raise FileError(f"{path}: voxels of the type {data.dtype} cannot be written; convert them first")
    numbers = " ".join
    columns = affine[:-1, :-1].T
    apart = path.suffix.lower() in (".mhd", ".nhdr")
    file = path.with_suffix(".raw").name
    if is_nrrd:
        vectors = ["(" + ",".join(repr(float(x)) for x in column) + ")" for column in columns]
        lines = ["NRRD0004", f"type: {kind}", f"dimension: {dim + (n > 1)}", "space: left-posterior-superior",
                 f"sizes: {numbers(map(str, ([n] if n > 1 else []) + list(data.shape[:dim])))}",
                 f"space directions: {numbers((['none'] if n > 1 else []) + vectors)}",
                 f"kinds: {numbers((['vector'] if n > 1 else []) + ['domain'] * dim)}", "endian: little", "encoding: raw",
                 "space origin: (" + ",".join(repr(float(x)) for x in affine[:-1, -1]) + ")"]
        head = "\n".join([*lines, *([f"data file: {file}"] if apart else [])]) + "\n" + ("" if apart else "\n")
    else:
        spacing = np.linalg.norm(columns, axis=1)
        turn = (columns / spacing[:, None]).ravel()
        about = {"ObjectType": "Image", "NDims": dim, "BinaryData": "True", "BinaryDataByteOrderMSB": "False",
                 "CompressedData": "False", "TransformMatrix": numbers(repr(float(x)) for x in turn),
                 "Offset": numbers(repr(float(x)) for x in affine[:-1, -1]),
                 "ElementSpacing": numbers(repr(float(x)) for x in spacing),
                 "DimSize": numbers(map(str, data.shape[:dim])), "ElementNumberOfChannels": n, "ElementType": kind,
                 "ElementDataFile": file if apart else "LOCAL"}
        head = "".join(f"{name} = {value}\n" for name, value in about.items())
    path.write_bytes(head.encode() + (b"" if apart else raw))
    if apart:
        path.with_suffix(".raw").write_bytes(raw)
