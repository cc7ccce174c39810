"""Maps that are sampled on a grid, and their certificate."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from ._abi import lib, new
from ._core import Call, Progress, address

if TYPE_CHECKING:
    from ._types import ArrayLike, Floats

OUTSIDE = {"nan": 1, "identity": 2, "nearest": 3}
KINDS = ("folded", "undecided", "missing")
_MOST = 4096


class Field:
    """A map that is sampled on a regular grid and read multilinearly: `Map.field` makes one.

    Attributes:
        values: (shape.., dim), displacements or images of the samples. The first index belongs to the first axis
        origin: (dim,), the place of the first sample
        step: (dim, dim); row k is one step along axis k
        displacement: whether values are added to the place
        n_outside: samples whose place had no image
        factor: how many times finer the grid is than the one that was asked for
        report: what `certify_field` found

    >>> field = libicc.Field(numpy.zeros((3, 4, 2)))
    >>> field.shape, field.report["certified"]
    ((3, 4), True)
    """

    def __init__(self, values: ArrayLike, origin: ArrayLike = 0.0, step: ArrayLike = 1.0, displacement: bool = True):
        values = np.asarray(values)
        if values.dtype != np.float32:
            values = np.asarray(values, np.float64)
        dim = values.shape[-1] if values.ndim else 0
        if dim not in (2, 3) or values.ndim != dim + 1:
            raise ValueError(f"values must have the shape (nx, ny, 2) or (nx, ny, nz, 3), not {values.shape}")
        self.values = values
        self.origin = np.broadcast_to(np.asarray(origin, np.float64), (dim,)).copy()
        step = np.asarray(step, np.float64)
        self.step = np.diag(np.broadcast_to(step, (dim,))) if step.ndim < 2 else step.copy()
        if self.step.shape != (dim, dim):
            raise ValueError(f"step must be one number, one for each axis, or a matrix ({dim}, {dim})")
        self.displacement = bool(displacement)
        self.n_outside = 0
        self.factor = 1
        self._report: Optional[Dict[str, Any]] = None

    @property
    def dim(self) -> int:
        return int(self.values.shape[-1])

    @property
    def shape(self) -> Tuple[int, ...]:
        return self.values.shape[:-1]

    @property
    def affine(self) -> Floats:
        """The matrix (dim + 1, dim + 1) from indices to places, as nibabel has it."""
        matrix = np.eye(self.dim + 1)
        matrix[:-1, :-1], matrix[:-1, -1] = self.step.T, self.origin
        return matrix

    @property
    def places(self) -> Floats:
        """The places of all samples, (shape.., dim)."""
        index = np.stack(np.meshgrid(*(np.arange(n) for n in self.shape), indexing="ij"), -1)
        return np.asarray(self.origin + index @ self.step)

    def _as(self, displacement: bool) -> Any:
        if displacement == self.displacement:
            return self.values
        return self.values + (-1 if displacement else 1) * self.places

    @property
    def displacements(self) -> Any:
        """The way from each place to its image."""
        return self._as(True)

    @property
    def images(self) -> Any:
        """The image of each place."""
        return self._as(False)

    @property
    def report(self) -> Dict[str, Any]:
        if self._report is None:
            self._report = certify_field(self)
        return self._report

    @property
    def certified(self) -> bool:
        """Whether the determinant is proven positive in all of the field."""
        return bool(self.report["certified"])

    def __repr__(self) -> str:
        state = "certified" if self.certified else self.report["message"]
        return f"<libicc.Field: {' x '.join(map(str, self.shape))}, {self.values.dtype}, {state}>"

    def save(self, path: Any) -> None:
        """Writes the field: .nii or .nii.gz, .mha, .vti, .npz, or in the plane .pfm (an STmap)."""
        from . import fields

        fields.save(self, path)

    def _struct(self) -> Tuple[Any, Any]:
        dim = self.dim
        # The first axis is the fastest in C.
        stored = np.ascontiguousarray(self.values.transpose((1, 0, 2) if dim == 2 else (2, 1, 0, 3)))
        struct = new("field", dim=dim, bytes=stored.itemsize, displacement=int(self.displacement),
                     values=address(stored))
        for k in range(dim):
            struct.shape[k], struct.origin[k] = self.shape[k], self.origin[k]
        for k, number in enumerate(self.step.ravel()):
            struct.step[k] = number
        return struct, stored


def certify_field(values: Any, spacing: Any = 1.0, origin: Any = 0.0, *, displacement: bool = True,
                  most: int = _MOST, progress: Optional[Progress] = None,
                  threads: Optional[int] = None) -> Dict[str, Any]:
    """Proves that a sampled field does not fold, or lists the cells where it does. The field may come from any program.

    >>> values = numpy.zeros((3, 3, 2))
    >>> values[1, 1] = [5, 0]
    >>> report = libicc.certify_field(values)
    >>> report["certified"], report["n_folded"], report["cells"][0]
    (False, 2, ((1, 0), 'folded'))

    Args:
        values: (nx, ny, 2), (nx, ny, nz, 3) or a `Field`. float32 is judged as it is
        spacing: one number, one for each axis, or a matrix whose row k is one step along axis k
        displacement: whether values are added to the places; False: they are the images themselves
        most: list at most this many cells, first those that fold, then undecided ones
    Returns:
        the members of `icc_field_report`, and `cells`: ((i, j, ..), "folded", "undecided" or "missing") each
    """
    field = values if isinstance(values, Field) else Field(values, origin, spacing, displacement)
    struct, _stored = field._struct()
    cells, kinds, report = _certified(struct, most, progress, threads)
    total = report.n_folded + report.n_undecided + report.n_missing
    if total > most and report.n_missing < total:
        cells, kinds, report = _certified(struct, total, progress, threads)
    order = np.argsort(kinds, kind="stable")[:most]
    places = np.unravel_index(cells[order].astype(np.intp), [side - 1 for side in field.shape], order="F")
    listed: List[Tuple[Tuple[int, ...], str]] = [
        (tuple(place), KINDS[kind - 1]) for place, kind in zip(np.transpose(places).tolist(), kinds[order].tolist())]
    result = {name: getattr(report, name) for name in
              ("certified", "one_to_one", "n_cells", "n_folded", "n_undecided", "n_missing", "least")}
    result["certified"], result["one_to_one"] = bool(report.certified), bool(report.one_to_one)
    result["message"] = report.message.decode("utf-8")
    result["cells"] = listed
    return result


def _certified(struct: Any, most: int, progress: Optional[Progress], threads: Optional[int]) -> Tuple[Any, Any, Any]:
    """The first cells that are not certified, their kinds, and the report."""
    call, report = Call(progress, threads), new("field_report")
    cells, kinds = np.empty(most, np.uint32), np.empty(most, np.int32)
    call.check(lib.field_certify(ctypes.addressof(struct), most, address(cells), address(kinds),
                                 ctypes.addressof(report), call.env, call.err))
    n = min(most, report.n_folded + report.n_undecided + report.n_missing)
    return cells[:n], kinds[:n], report


def _sample(mapping: Any, field: Field, inverse: bool, outside: str, call: Call) -> None:
    struct, stored = field._struct()
    struct.outside = OUTSIDE[outside]
    n = ctypes.c_size_t()
    call.check(lib.map_sample(mapping, int(inverse), ctypes.addressof(struct), ctypes.addressof(n), call.env, call.err))
    order = (1, 0, 2) if field.dim == 2 else (2, 1, 0, 3)
    field.values, field.n_outside = stored.transpose(order), n.value


def field_of(mapping: Any, shape: Sequence[int], spacing: Any, origin: Any, *, inverse: bool, displacement: bool,
             outside: str, dtype: Any, refine: int, progress: Optional[Progress], threads: Optional[int]) -> Field:
    """See `Map.field`."""
    if outside not in OUTSIDE:
        raise ValueError(f"outside is {outside!r}; it must be one of {', '.join(OUTSIDE)}")
    if np.dtype(dtype) not in (np.float32, np.float64):
        raise ValueError(f"dtype is {dtype}; it must be float32 or float64")
    if int(refine) < 1:
        raise ValueError(f"refine is {refine}; it must be at least 1")
    if hasattr(shape, "affine") and hasattr(shape, "shape"):  # an image of nibabel
        matrix = np.asarray(shape.affine)
        origin, spacing, shape = matrix[:-1, -1], matrix[:-1, :-1].T, shape.shape[:3]
    dim = len(shape)
    for factor in range(1, int(refine) + 1):
        finer = [(side - 1) * factor + 1 for side in shape]
        field = Field(np.zeros((*finer, dim), dtype), origin, np.asarray(spacing, np.float64) / factor, displacement)
        _sample(mapping, field, inverse, outside, Call(progress, threads))
        field.factor = factor
        if refine == 1 or field.certified:
            break
    return field
