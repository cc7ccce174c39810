"""Writes sampled fields as other programs read them. See docs/howto/fields.md.

ITK and NIfTI store displacements in LPS: x to the left, y to the back. A map in RAS, the world coordinates of nibabel
and Slicer, has both signs turned. The writers for .nii and .mha take fields in RAS unless you say ``world="LPS"``.
"""

from __future__ import annotations

import pathlib
import sys
from typing import TYPE_CHECKING, Any, Callable, Dict, Tuple

import numpy as np

if TYPE_CHECKING:
    from ._field import Field
    from ._types import Floats

_TURN = np.array([-1.0, -1.0, 1.0])


def save(field: Field, path: Any) -> None:
    """Writes a field in the format of the file's ending."""
    name = str(path).lower()
    writers: Dict[str, Callable[[Field, Any], None]] = {
        ".nii": save_nifti, ".nii.gz": save_nifti, ".mha": save_mha, ".vti": save_vti, ".npz": save_npz,
        ".pfm": save_stmap}
    for ending, writer in writers.items():
        if name.endswith(ending):
            return writer(field, path)
    raise ValueError(f"{path}: the ending must be one of {', '.join(writers)}")


def _numbers(values: Any) -> str:
    return " ".join(repr(float(v)) for v in np.ravel(values))


def _solid(field: Field, what: str) -> None:
    if field.dim != 3:
        raise ValueError(f"{what} needs a field in space, not in the plane")


def _turn(world: str) -> Floats:
    if world not in ("RAS", "LPS"):
        raise ValueError(f"world is {world!r}; it must be RAS or LPS")
    return _TURN if world == "RAS" else np.ones(3)


def save_nifti(field: Field, path: Any, *, world: str = "RAS") -> None:
    """A displacement field as ANTs and ITK read it: intent vector, displacements in LPS, the affine in RAS."""
    import nibabel

    _solid(field, "NIfTI")
    turn = _turn(world)
    affine = field.affine
    if world == "LPS":
        affine = np.diag([-1.0, -1.0, 1.0, 1.0]) @ affine
    data = (field.displacements * turn).astype(field.values.dtype)
    image = nibabel.Nifti1Image(data[:, :, :, np.newaxis, :], affine)
    image.header.set_intent("vector")
    nibabel.save(image, str(path))


def save_mha(field: Field, path: Any, *, world: str = "RAS") -> None:
    """A displacement field as ITK, elastix and Slicer read it, all in LPS."""
    _solid(field, "MHA")
    turn = _turn(world)
    step = field.step * turn
    spacing = np.linalg.norm(step, axis=1)
    data = (field.displacements * turn).astype(field.values.dtype).transpose(2, 1, 0, 3)
    kind = "MET_FLOAT" if data.dtype == np.float32 else "MET_DOUBLE"
    head = (f"ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = {sys.byteorder == 'big'}\n"
            f"CompressedData = False\nTransformMatrix = {_numbers(step / spacing[:, None])}\n"
            f"Offset = {_numbers(field.origin * turn)}\nElementSpacing = {_numbers(spacing)}\n"
            f"DimSize = {' '.join(map(str, field.shape))}\nElementNumberOfChannels = 3\nElementType = {kind}\n"
            "ElementDataFile = LOCAL\n")
    pathlib.Path(path).write_bytes(head.encode() + np.ascontiguousarray(data).tobytes())


def _spacing(field: Field, what: str) -> Floats:
    """The steps of a grid along the coordinate axes."""
    spacing = np.diag(field.step)
    if np.any(np.diag(spacing) != field.step):
        raise ValueError(f"{what} needs a grid along the coordinate axes")
    return np.asarray(spacing)


def save_vti(field: Field, path: Any) -> None:
    """An image with vectors, as vtkGridTransform takes it (SetDisplacementGridData)."""
    _solid(field, "VTK")
    spacing = _spacing(field, "VTK")
    data = np.ascontiguousarray(field.displacements.astype(field.values.dtype).transpose(2, 1, 0, 3))
    kind = "Float32" if data.dtype == np.float32 else "Float64"
    extent = " ".join(f"0 {side - 1}" for side in field.shape)
    order = "BigEndian" if sys.byteorder == "big" else "LittleEndian"
    head = (f'<VTKFile type="ImageData" version="1.0" byte_order="{order}" header_type="UInt64">'
            f'<ImageData WholeExtent="{extent}" Origin="{_numbers(field.origin)}" Spacing="{_numbers(spacing)}">'
            f'<Piece Extent="{extent}"><PointData Scalars="displacement"><DataArray type="{kind}" Name="displacement" '
            'NumberOfComponents="3" format="appended" offset="0"/></PointData></Piece></ImageData>'
            '<AppendedData encoding="raw">_')
    size = np.array([data.nbytes], np.uint64).tobytes()
    pathlib.Path(path).write_bytes(head.encode() + size + data.tobytes() + b"</AppendedData></VTKFile>\n")


def save_npz(field: Field, path: Any) -> None:
    """Arrays of NumPy: values, origin, step and displacement."""
    np.savez(path, values=field.values, origin=field.origin, step=field.step, displacement=field.displacement)


def remap(field: Field) -> Tuple[Any, Any]:
    """map_x and map_y of cv2.remap, float32, for a field of the inverse map with the origin (0.5, 0.5). In libicc the
    centre of the first pixel is at (0.5, 0.5), in OpenCV at (0, 0)."""
    if field.dim != 2:
        raise ValueError("cv2.remap needs a field in the plane")
    images = np.asarray(field.images - 0.5, np.float32)
    return np.ascontiguousarray(images[..., 0].T), np.ascontiguousarray(images[..., 1].T)


def save_stmap(field: Field, path: Any, *, size: Any = None) -> None:
    """An STmap as a float PFM: red and green are where to read, from 0 to 1, with 0 at the bottom. The field is that of
    the inverse map, one sample for each pixel. `size`: width and height of the picture to read; None: those of the field."""
    if field.dim != 2:
        raise ValueError("an STmap needs a field in the plane")
    width, height = size or field.shape
    data = np.zeros((*field.shape[::-1], 3), "<f4")
    images = field.images.transpose(1, 0, 2)
    data[..., 0], data[..., 1] = images[..., 0] / width, 1 - images[..., 1] / height
    # PFM stores the bottom row first.
    pathlib.Path(path).write_bytes(f"PF\n{field.shape[0]} {field.shape[1]}\n-1.0\n".encode() + data[::-1].tobytes())
