"""What every call needs: threads, progress, arrays and handles."""

from __future__ import annotations

import ctypes
import os
import sys
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Optional, Sequence, Tuple, Type, TypeVar, Union

import numpy as np

from ._abi import lib, new
from ._errors import check, fail

if TYPE_CHECKING:
    from ._types import Array, ArrayLike, Floats, Indices

Progress = Union[Callable[[str, float], Any], bool]
"""Called with the name of a stage and the share of the whole call that is done, which goes from 0 to 1 and never
falls; returning true or raising cancels the call. `icc/base.h` lists the stages. True: show a bar, by tqdm if it is
installed.
Every long call accepts one, and `threads`: how many it may use; None: one per processor."""

_PROGRESS = ctypes.CFUNCTYPE(ctypes.c_int32, ctypes.c_void_p, ctypes.c_char_p, ctypes.c_double)

_LOG = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_char_p)


def _listener() -> Optional[Any]:
    """The logger of diagnostics, if anybody listens. Without `logging` imported, nobody does."""
    logging = sys.modules.get("logging")
    if logging is None:
        return None
    logger = logging.getLogger("libicc")
    return logger if logger.isEnabledFor(logging.INFO) else None


def _tell(_user: Any, message: bytes) -> None:
    logger = _listener()
    if logger:
        logger.info(message.decode("utf-8", "replace"))


_log = _LOG(_tell)

# Starting threads does not pay for fewer points.
_FEW_POINTS = 2048


class Call:
    """The `env` and the `err` of one call.

    ``check`` raises the error of the call, or instead the exception that a progress callback raised.
    """

    def __init__(self, progress: Optional[Progress] = None, threads: Optional[int] = None,
                 limit: int = 0):
        self.error = new("error", index=-1)
        self.raised: Optional[BaseException] = None
        self._env = new("env", threads=_threads(threads), load_limit=limit)
        if _listener():
            self._env.log = ctypes.cast(_log, ctypes.c_void_p)
        self._bar: Any = None
        if progress is True:
            from ._progress import Bar

            progress = self._bar = Bar()
        if progress:
            self._callback = _PROGRESS(self._report(progress))
            self._env.progress = ctypes.cast(self._callback, ctypes.c_void_p)
        self.env = ctypes.addressof(self._env)
        self.err = ctypes.addressof(self.error)

    def _report(self, progress: Any) -> Callable[[Any, bytes, float], int]:
        def report(_user: Any, stage: bytes, share: float) -> int:
            if self.raised is not None:
                return 1
            try:
                return 1 if progress(stage.decode(), share) else 0
            except BaseException as raised:  # to be raised again by check()
                self.raised = raised
                return 1

        return report

    def check(self, status: int) -> None:
        if self._bar is not None:
            self._bar.close()
        if self.raised is not None:
            raise self.raised
        if status != 0:
            error = self.error
            text = error.message.decode("utf-8", "replace") if error.status == status else ""
            fail(status, text, error.index, error.side, error.item)


def _threads(wanted: Optional[int]) -> int:
    return len(os.sched_getaffinity(0)) if wanted is None else int(wanted)


def bulk(n: int, progress: Optional[Progress],
         threads: Optional[int]) -> Tuple[Optional[int], Callable[[int], None]]:
    """The `env` for a call on many points, and a function that checks its status."""
    if progress is None and threads is None and n < _FEW_POINTS:
        return None, check
    call = Call(progress, threads)
    return call.env, call.check


def is_geometry(shape: Any) -> bool:
    """Whether an object is a shapely geometry, or looks like one."""
    return any(hasattr(shape, name) for name in ("geom_type", "geoms", "exterior", "coords"))


def parts_of(shape: Any) -> List[Any]:
    """The parts of a geometry: itself unless it has several."""
    return list(getattr(shape, "geoms", (shape,)))


def coordinates(shapes: Any) -> Floats:
    """The coordinates of points and lines one after the other."""
    for part in shapes:
        if hasattr(part, "exterior"):
            raise TypeError("a polygon is no list of points; take the points of a ring, polygon.exterior, or call the map "
                            "itself with the geometry: mapping(polygon)")
    arrays = [np.asarray(part.coords, dtype=np.float64) for part in shapes if len(part.coords) > 0]
    return np.concatenate(arrays) if arrays else np.empty((0, 2))


def _numbers(points: ArrayLike, dim: int) -> Floats:
    """Points as a contiguous array of float64, copied only if necessary. For shapely geometries these are the
    coordinates, in 2-D without heights."""
    if is_geometry(points):
        points = coordinates(parts_of(points))[:, :dim]
    elif isinstance(points, (list, tuple)) and len(points) > 0 and is_geometry(points[0]):
        points = coordinates(points)[:, :dim]
    return np.ascontiguousarray(points, dtype=np.float64)


def points_of(points: ArrayLike, dim: int, name: str = "points") -> Floats:
    """Points as `_numbers`, of shape (n, dim)."""
    array = _numbers(points, dim)
    if array.ndim == 1 and array.shape[0] == dim:
        array = array.reshape(1, dim)
    if array.ndim != 2 or array.shape[1] != dim:
        raise ValueError(f"{name} must have the shape (n, {dim}), not {array.shape}")
    return array


def grid_of(points: ArrayLike, dim: int) -> Tuple[Floats, Tuple[int, ...]]:
    """Points as in `points_of`, and the shape of the input without the axis of coordinates: a grid (height, width, dim)
    has the shape (height, width)."""
    array = _numbers(points, dim)
    shape = array.shape[:-1]
    if array.ndim > 2 and array.shape[-1] == dim:
        return array.reshape(-1, dim), shape
    array = points_of(array, dim)
    return array, array.shape[:1]


def floats(values: ArrayLike, shape: Sequence[int], name: str) -> Floats:
    array = np.ascontiguousarray(values, dtype=np.float64)
    if array.shape != tuple(shape):
        raise ValueError(f"{name} must have the shape {tuple(shape)}, not {array.shape}")
    return array


def indices(values: ArrayLike, width: int, name: str) -> Indices:
    """Vertex indices as a contiguous uint32 array of shape (n, width)."""
    array = np.asarray(values)
    if array.size and (array.dtype.kind not in "iu" or array.min() < 0 or array.max() >= 2**32 - 1):
        raise ValueError(f"{name} must be vertex indices")
    array = np.ascontiguousarray(array, dtype=np.uint32)
    if array.ndim != 2 or array.shape[1] != width:
        raise ValueError(f"{name} must have the shape (n, {width}), not {array.shape}")
    return array


def address(array: Optional[Array]) -> Optional[int]:
    """An array as an argument; the caller must keep it alive in a variable."""
    return None if array is None else array.ctypes.data


def mesh_of(vertices: Floats, simplices: Indices) -> Any:
    """The ``icc_mesh`` with these arrays, for reading or for writing. The caller must keep it and the arrays alive in
    variables."""
    return new("mesh", dim=vertices.shape[1], n_vertices=len(vertices), vertices=address(vertices),
               n_cells=len(simplices), cells=address(simplices))


def fields(struct: Any, dim: Optional[int] = None) -> SimpleNamespace:
    """The members of a struct except `size` and padding. Arrays by dimension become NumPy arrays."""
    members = {}
    for name, kind in struct._fields_:
        value = getattr(struct, name)
        if name == "size":
            continue
        if isinstance(value, ctypes.Array):
            value = np.array(value[:dim] if len(value) == 6 else value[:])
        members[name] = value.decode("utf-8", "replace") if isinstance(value, bytes) else value
    return SimpleNamespace(**members)


def choose(value: Optional[str], choices: Dict[str, int], name: str) -> int:
    """The number of a choice that is given by name; None means the default."""
    if value is None:
        return 0
    try:
        return choices[value]
    except (KeyError, TypeError):
        raise ValueError(f"{name} must be one of {', '.join(choices)}, not {value!r}") from None


def name_of(number: int, choices: Dict[str, int]) -> Optional[str]:
    for name, value in choices.items():
        if value == number:
            return name
    return None


_T = TypeVar("_T", bound="Handle")
_S = TypeVar("_S", bound="Saved")


class Handle:
    """An object of the library; immutable, shared freely between threads."""

    _free = ""
    _dim: Optional[int] = None

    def __init__(self) -> None:
        raise TypeError(f"{type(self).__name__} cannot be made this way")

    def __init_subclass__(cls, **options: Any) -> None:
        """`help(Map.__init__)` shows the same text as `help(Map)`, because the class describes its arguments."""
        super().__init_subclass__(**options)
        own = cls.__dict__.get("__init__")
        if own is not None and own.__doc__ is None:
            own.__doc__ = cls.__doc__

    def _take(self, handle: int, owner: Optional["Handle"] = None) -> None:
        """Owns a handle, or borrows it from `owner`, which is kept alive."""
        self._handle = handle
        self._owned = owner

    @classmethod
    def _wrap(cls: Type[_T], handle: int, owner: Optional["Handle"] = None) -> _T:
        self = cls.__new__(cls)
        self._take(handle, owner)
        return self

    @classmethod
    def _borrow(cls: Type[_T], handle: Optional[int], owner: "Handle") -> Optional[_T]:
        """A borrowed object that belongs to `owner`, or None if there is none."""
        return cls._wrap(handle, owner) if handle else None

    @property
    def _as_parameter_(self) -> int:
        """What ctypes passes on. Objects themselves are passed to the library, so that they outlive the call."""
        return self._handle

    def __del__(self) -> None:
        if getattr(self, "_handle", None) and self._owned is None:
            getattr(lib, self._free)(self._handle)

    def __copy__(self: _T) -> _T:
        """The object itself, because it never changes."""
        return self

    def __deepcopy__(self: _T, memo: Any) -> _T:
        return self

    def __reduce__(self) -> Any:
        raise TypeError(f"a {type(self).__name__} cannot be pickled")

    def _info(self, function: str, struct: str) -> Any:
        info = new(struct)
        check(getattr(lib, function)(self, ctypes.addressof(info)))
        return info


_NO_LIMIT = 2**64 - 1


class Saved(Handle):
    """An object that can be written to bytes, and so be pickled and sent to other processes."""

    _name = ""

    def to_bytes(self) -> bytes:
        """The object as bytes, the same on every machine."""
        function, n = getattr(lib, self._name + "_save"), ctypes.c_size_t()
        check(function(self, 0, None, ctypes.addressof(n)))
        data = np.empty(n.value, dtype=np.uint8)
        check(function(self, n.value, address(data), ctypes.addressof(n)))
        return data.tobytes()

    @classmethod
    def from_bytes(cls: Type[_S], data: Any, *, limit: Optional[int] = None,
                   progress: Optional[Progress] = None, threads: Optional[int] = None) -> _S:
        """Reads the object that `to_bytes` wrote. It gives the same results, bit for bit.

        Args:
            data: bytes, or anything with a buffer. Any bytes are safe to pass
            limit: bytes of memory that loading may take, in addition to 64 for each byte of `data`; None: 256,000,000.
                Time is limited in proportion. Charts on fine grids are rebuilt and may need more. The error message
                then names this limit as `icc_env.load_limit`.

        Raises:
            FormatError: for any other bytes, and if the limit is too low; VersionError: if a later version wrote the
                bytes
        """
        if limit is not None and not 0 < limit <= _NO_LIMIT:
            raise ValueError(f"limit is {limit}; it must lie in 1..2**64 - 1")
        function, read = getattr(lib, cls._name + "_load"), np.frombuffer(data, dtype=np.uint8)
        return cls._wrap(create(function, len(read), address(read), progress=progress, threads=threads,
                                limit=limit or 0))

    @classmethod
    def _unpickle(cls: Type[_S], data: bytes) -> _S:
        # Whoever unpickles trusts the bytes anyway.
        return cls.from_bytes(data, limit=_NO_LIMIT)

    def save(self, path: Union[str, "os.PathLike[str]"]) -> None:
        """Writes `to_bytes` to a file."""
        data = self.to_bytes()
        with open(path, "wb") as file:
            file.write(data)

    @classmethod
    def load(cls: Type[_S], path: Union[str, "os.PathLike[str]"], *, progress: Optional[Progress] = None,
             threads: Optional[int] = None) -> _S:
        """Reads the object that `save` wrote to a file; otherwise like `from_bytes`."""
        with open(path, "rb") as file:
            return cls.from_bytes(file.read(), progress=progress, threads=threads)

    def __reduce__(self) -> Any:
        return type(self)._unpickle, (self.to_bytes(),)


def dimension(function: str, struct: str) -> property:
    """A property that calls the library once."""

    def ask(self: Handle) -> int:
        if self._dim is None:
            self._dim = int(self._info(function, struct).dim)
        return self._dim

    return property(ask, doc="How many coordinates points have.")


def create(function: Any, *arguments: Any, progress: Optional[Progress] = None,
           threads: Optional[int] = None, limit: int = 0) -> int:
    """Calls a creator: handle first, `env` and `err` last; returns the handle."""
    call, out = Call(progress, threads, limit), ctypes.c_void_p()
    call.check(function(ctypes.addressof(out), *arguments, call.env, call.err))
    assert out.value is not None
    return out.value
