"""Charts: coordinates of the inside of a domain."""

from __future__ import annotations

import ctypes
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Literal, Optional, Sequence, Tuple, overload

import numpy as np

from ._abi import lib, new
from ._core import (
    Call,
    Progress,
    Saved,
    address,
    bulk,
    choose,
    create,
    dimension,
    fields,
    floats,
    name_of,
    points_of,
)
from ._domain import Domain, as_domain

if TYPE_CHECKING:
    from ._types import ArrayLike, Floats, Indices, Ints, ShapeLike
    from .stages import Function

METHODS = {"gradient": 1, "foliation": 2, "field": 3, "disc": 4}
FUNCTIONS = {"decay": 1, "distance": 2, "laplace": 3, "bilaplace": 4, "clamped": 5, "harmonic": 6, "values": 7}
CONSTRAINTS = {"needed": 1, "none": 2, "all": 3}
SOLVERS = {"direct": 1, "iterative": 2}
TREES = {"thesis": 1, "paper": 2}


def chart_options(dim: int, method: Optional[str], cells: Optional[int], maximum: Optional[ArrayLike],
                  function: Optional[str], constraints: Optional[str], solver: Optional[str],
                  tree: Optional[str], min_fall: Optional[float], leaf_min: Optional[float],
                  axis_order: Optional[Sequence[int]] = None) -> Any:
    options = new("chart_options", method=choose(method, METHODS, "method"), cells=cells or 0,
                  function=choose(function, FUNCTIONS, "function"),
                  constraints=choose(constraints, CONSTRAINTS, "constraints"),
                  solver=choose(solver, SOLVERS, "solver"), tree=choose(tree, TREES, "tree"),
                  min_fall=min_fall or 0, leaf_min=leaf_min or 0)
    if maximum is not None:
        options.keep = floats(maximum, (dim,), "maximum")
        options.maximum = address(options.keep)
    if axis_order is not None:
        options.keep_order = axes_of(axis_order, dim)
        options.axis_order = address(options.keep_order)
    return options


def axes_of(axis_order: Sequence[int], dim: int) -> Ints:
    """An order of the axes for C."""
    order = np.ascontiguousarray(axis_order, dtype=np.int32)
    if sorted(order.tolist()) != list(range(dim)):
        raise ValueError("axis_order must be a permutation of the axes")
    return order


class Chart(Saved):
    """Coordinates of a domain's inside: a boundary point, and the share of the way to the maximum.

    >>> chart = libicc.Chart([[0, 0], [4, 0], [4, 4], [0, 4]], maximum=[2, 2])
    >>> facet, bary, t = chart.encode([[2, 1]])
    >>> int(facet[0]), chart.decode(facet, bary, t).round(6).tolist()
    (0, [[2.0, 1.0]])

    Args:
        domain: a Domain, or anything that `as_domain` takes
        method: "foliation", "disc" (2-D), "field" or "gradient"; None: the best available
        cells: grid or mesh cells along the longest side; None: 50
        maximum: point where the curves end, (dim,); None: chosen by the method
        function: for method gradient: "decay", "distance", "laplace", "bilaplace", "clamped" or "harmonic"
        constraints: whether the function is forced to fall along the tree: "needed", "none" or "all"
        solver: "direct" or "iterative"
        tree: "thesis" or "paper"
        min_fall, leaf_min: least relative fall and least value, see ``icc_chart_options``
        axis_order: for method gradient: order in which the tree expands along the axes, a permutation
        progress, threads: as for `Domain`

    Raises:
        CertificateError, ResolutionError, OutsideError (the maximum is outside), UnsupportedError, SolverError
    """

    LOSSES = {"away": 1, "uncovered": 2, "collapsed": 4, "gap": 8}
    """The bits of the flags that `encode` and `decode` return."""

    _free = "chart_free"
    _name = "chart"
    dim = dimension("chart_get_info", "chart_info")

    def __init__(self, domain: ShapeLike, method: Optional[str] = None, *, cells: Optional[int] = None,
                 maximum: Optional[ArrayLike] = None, function: Optional[str] = None,
                 constraints: Optional[str] = None, solver: Optional[str] = None,
                 tree: Optional[str] = None, min_fall: Optional[float] = None, leaf_min: Optional[float] = None,
                 axis_order: Optional[Sequence[int]] = None,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        domain = as_domain(domain)
        options = chart_options(domain.dim, method, cells, maximum, function, constraints, solver, tree,
                                min_fall, leaf_min, axis_order)
        self._take(create(lib.chart_create, domain, ctypes.addressof(options),
                          progress=progress, threads=threads))

    @classmethod
    def from_function(cls, function: Function, *, progress: Optional[Progress] = None,
                      threads: Optional[int] = None) -> "Chart":
        """The chart of method gradient whose curves follow a `libicc.stages.Function`, on the library's stages or your
        own. The function's grid must have been made from a domain."""
        return cls._wrap(create(lib.chart_create_function, function, progress=progress, threads=threads))

    @property
    def domain(self) -> Domain:
        """The domain that the chart was made on."""
        return Domain._wrap(lib.chart_domain(self), owner=self)

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_chart_info`` and of the method's own struct: ``icc_gradient_info``, ``icc_field_info``,
        ``icc_foliation_info``, ``icc_shelling_info`` (foliation on a domain's mesh) or ``icc_disc_info``. Method,
        function and tree are given by name."""
        info = self._info("chart_get_info", "chart_info")
        result = fields(info, info.dim)
        result.method = name_of(info.method, METHODS)
        for name in ("gradient", "field", "foliation", "shelling", "disc"):
            own = new(name + "_info")
            if getattr(lib, f"chart_get_{name}_info")(self, ctypes.addressof(own)) == 0:
                result.__dict__.update(vars(fields(own)))
        if info.method == METHODS["gradient"]:
            result.function = name_of(result.function, FUNCTIONS)
            result.tree = name_of(result.tree, TREES)
        return result

    @property
    def timings(self) -> SimpleNamespace:
        """Seconds for each step of making the chart: the members of ``icc_chart_timings``."""
        return fields(self._info("chart_get_timings", "chart_timings"))

    @property
    def certified(self) -> bool:
        """Whether the chart is proved to be one-to-one."""
        return bool(self._info("chart_get_info", "chart_info").certified)

    def report(self, n_points: int = 0, *, progress: Optional[Progress] = None,
                threads: Optional[int] = None) -> SimpleNamespace:
        """Estimates what the coordinates miss from `n_points` evenly spread points (0: 4096). Returns the members of
        ``icc_chart_report``, shares in [0, 1]."""
        call, measures = Call(progress, threads), new("chart_report")
        call.check(lib.chart_get_report(self, n_points, ctypes.addressof(measures), call.env,
                                     call.err))
        return fields(measures)

    @overload
    def encode(self, points: ArrayLike, *, status: Literal[False] = ..., flags: Literal[False] = ...,
               progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Tuple[Indices, Floats, Floats]: ...
    @overload
    def encode(self, points: ArrayLike, *, status: Literal[True], flags: Literal[False] = ...,
               progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Tuple[Indices, Floats, Floats, Ints]: ...
    @overload
    def encode(self, points: ArrayLike, *, status: Literal[False] = ..., flags: Literal[True],
               progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Tuple[Indices, Floats, Floats, Ints]: ...
    @overload
    def encode(self, points: ArrayLike, *, status: Literal[True], flags: Literal[True],
               progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Tuple[Indices, Floats, Floats, Ints, Ints]: ...

    def encode(self, points: ArrayLike, *, status: bool = False, flags: bool = False,
               progress: Optional[Progress] = None, threads: Optional[int] = None) -> Any:
        """Computes the coordinates of points in the chart.

        Args:
            points: (n, dim)
            status: whether to return the status of every point as well
            flags: whether to return as well what is lost at every point

        Returns:
            facet (n,) uint32, bary (n, dim), t (n,), and with ``status`` an int32 array (n,): 0, or the
            number of an `Error`. A point without coordinates has NaN in bary and t, and raises nothing.
            With ``flags`` another int32 array (n,): 0 if `decode` brings the point back, else a sum of
            `LOSSES`, see ``icc_chart_encode_flags()``. Takes twice the time.
        """
        points = points_of(points, self.dim)
        n, dim = points.shape
        facet, bary, t = np.empty(n, dtype=np.uint32), np.empty((n, dim)), np.empty(n)
        states = np.empty(n, dtype=np.int32) if status else None
        losses = np.empty(n, dtype=np.int32) if flags else None
        env, done = bulk(n, progress, threads)
        done(lib.chart_encode_flags(self, n, address(points), address(facet), address(bary), address(t),
                                    address(states), address(losses), None, env))
        return (facet, bary, t, *(x for x in (states, losses) if x is not None))

    @overload
    def decode(self, facet: ArrayLike, bary: ArrayLike, t: ArrayLike, *, status: Literal[False] = ...,
               flags: Literal[False] = ..., progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Floats: ...
    @overload
    def decode(self, facet: ArrayLike, bary: ArrayLike, t: ArrayLike, *, status: Literal[True],
               flags: Literal[False] = ..., progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Tuple[Floats, Ints]: ...
    @overload
    def decode(self, facet: ArrayLike, bary: ArrayLike, t: ArrayLike, *, status: Literal[False] = ...,
               flags: Literal[True], progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Tuple[Floats, Ints]: ...
    @overload
    def decode(self, facet: ArrayLike, bary: ArrayLike, t: ArrayLike, *, status: Literal[True],
               flags: Literal[True], progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Tuple[Floats, Ints, Ints]: ...

    def decode(self, facet: ArrayLike, bary: ArrayLike, t: ArrayLike, *, status: bool = False,
               flags: bool = False, progress: Optional[Progress] = None, threads: Optional[int] = None) -> Any:
        """Computes the points that have given coordinates: the inverse of `encode`.

        Args:
            facet: (n,) indices of boundary facets
            bary: (n, dim) barycentric coordinates there: not negative, sum 1
            t: (n,) shares of the curves' arc length from the boundary, in [0, 1]
            status: whether to return the status of every point as well
            flags: whether to return as well what is lost at every point

        Returns:
            points (n, dim), NaN where there is none, and with ``status`` an int32 array (n,) as in `encode`.
            With ``flags`` another int32 array (n,): 0 if `encode` returns the coordinates, else a sum of
            `LOSSES`, see ``icc_chart_decode_flags()``. Takes twice the time.
        """
        dim = self.dim
        facet = np.ascontiguousarray(facet, dtype=np.uint32)
        n = len(facet)
        bary, t = floats(bary, (n, dim), "bary"), floats(t, (n,), "t")
        points = np.empty((n, dim))
        states = np.empty(n, dtype=np.int32) if status else None
        losses = np.empty(n, dtype=np.int32) if flags else None
        env, done = bulk(n, progress, threads)
        done(lib.chart_decode_flags(self, n, address(facet), address(bary), address(t), address(points),
                                    address(states), address(losses), None, env))
        return (points, *(x for x in (states, losses) if x is not None)) if status or flags else points

    def trace(self, point: ArrayLike) -> Floats:
        """Computes the curve through a point (dim,), from the boundary to the maximum: a polyline, (m, dim)."""
        dim = self.dim
        point = points_of(point, dim)
        call, n = Call(threads=1), ctypes.c_size_t()
        curve = np.empty((256, dim))
        while True:
            call.check(lib.chart_trace(self, address(point), len(curve), address(curve),
                                       ctypes.addressof(n), call.env, call.err))
            if n.value <= len(curve):
                return curve[: n.value].copy()
            curve = np.empty((n.value, dim))

    def __repr__(self) -> str:
        info = self.info
        word = "certified" if info.certified else "not certified"
        return f"<libicc.Chart: {info.method}, {info.dim}-D, {word}>"
