"""What a call that failed raises."""

from contextlib import contextmanager
from typing import Iterator, NoReturn, Optional

from ._abi import lib


ITEMS = (None, "vertex", "facet", "simplex", "cell", "grid vertex", "axis", "point", "region", "segment", "sample",
         "handle", "edge", "line", "node", "feature", "tie")
"""What `Error.item` may be: the ``ICC_ITEM_*`` of the C library in order."""


class Error(Exception):
    """An error that the library reports about a failed call.

    Attributes:
        status: the number of the status (``Error.ARGUMENT`` and so on)
        index: the item at fault, from 0, or -1
        item: what ``index`` counts, such as "vertex", "facet" or "point"; or None
        side: 1 if the source is at fault, 2 if the target is, else 0
    """

    ARGUMENT, MEMORY, VERSION, BOUNDARY, RESOLUTION, TOPOLOGY, OUTSIDE = range(1, 8)
    SOLVER, TRACE, CERTIFICATE, CANCELLED, UNSUPPORTED, FORMAT, AMBIGUOUS = range(8, 15)

    def __init__(self, message: str, status: int = 0, index: int = -1, side: int = 0,
                 item: Optional[str] = None):
        super().__init__(message)
        self.status, self.index, self.side, self.item = status, index, side, item


class ArgumentError(Error, ValueError):
    """An argument is missing or out of range."""


class BoundaryError(Error, ValueError):
    """The boundary is not that of a simple, solid shape."""


class TopologyError(Error, ValueError):
    """The shape or the grid has the wrong topology."""


class OutsideError(Error, ValueError):
    """A point lies outside the domain."""


class FormatError(Error, ValueError):
    """Input data is malformed."""


class AmbiguousError(Error, ValueError):
    """Several answers are equally good."""


class UnsupportedError(Error, NotImplementedError):
    """This combination is not supported."""


class ResolutionError(Error, ValueError):
    """The grid is too coarse, or would be too large."""


class TraceError(Error, ArithmeticError):
    """An integral curve does not reach its end."""


class VersionError(Error):
    """A struct or saved object is from another version."""


class CertificateError(Error, ArithmeticError):
    """A result could not be certified."""


class SolverError(Error, ArithmeticError):
    """A numerical solver did not converge."""


class OutOfMemoryError(Error, MemoryError):
    """An allocation failed."""


class Cancelled(Error):
    """The progress callback asked to stop."""


_ERRORS = {
    Error.ARGUMENT: ArgumentError,
    Error.MEMORY: OutOfMemoryError,
    Error.VERSION: VersionError,
    Error.BOUNDARY: BoundaryError,
    Error.RESOLUTION: ResolutionError,
    Error.TOPOLOGY: TopologyError,
    Error.OUTSIDE: OutsideError,
    Error.SOLVER: SolverError,
    Error.TRACE: TraceError,
    Error.CERTIFICATE: CertificateError,
    Error.CANCELLED: Cancelled,
    Error.UNSUPPORTED: UnsupportedError,
    Error.FORMAT: FormatError,
    Error.AMBIGUOUS: AmbiguousError,
}


@contextmanager
def blaming(side: int) -> Iterator[None]:
    """Marks errors raised inside as the fault of the source (1) or of the target (2). Their messages say so."""
    name = ("source", "target")[side - 1]
    try:
        yield
    except Error as error:
        if error.side != 0 or isinstance(error, (Cancelled, OutOfMemoryError)):
            raise
        error.args, error.side = (f"{name}: {error}",), side
        raise
    except (TypeError, ValueError) as error:
        error.args = (f"{name}: {error}",)
        raise


def fail(status: int, message: str = "", index: int = -1, side: int = 0, item: int = 0) -> NoReturn:
    name = lib.status_name(status).decode()
    raise _ERRORS.get(status, Error)(message or name, status, index, side, ITEMS[item])


def check(status: int) -> None:
    if status != 0:
        fail(status)
