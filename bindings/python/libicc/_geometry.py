"""Domains, charts and maps."""

from __future__ import annotations

import ctypes
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, List, Literal, Optional, Tuple, overload

import numpy as np

from ._abi import lib, new
from ._core import (
    Call,
    Handle,
    Progress,
    Saved,
    address,
    bulk,
    check,
    choose,
    create,
    fields,
    floats,
    indices,
    name_of,
    points_of,
)

if TYPE_CHECKING:
    from ._types import ArrayLike, Bools, Floats, Indices, Ints, ShapeLike

METHODS = {"gradient": 1, "foliation": 2, "field": 3, "disc": 4}
FUNCTIONS = {"decay": 1, "distance": 2, "laplace": 3, "bilaplace": 4, "clamped": 5}
CONSTRAINTS = {"needed": 1, "none": 2, "all": 3}
SOLVERS = {"direct": 1, "iterative": 2}
TREES = {"thesis": 1, "paper": 2}
KINDS = {"curves": 1, "mesh": 2}
DEFECTS = {"not finite": 1, "repeated": 2, "spike": 3, "crossing": 4, "touch": 5, "flat": 6}

INSIDE, BOUNDARY, OUTSIDE = 1, 2, 3
"""Where a point lies: see `Domain.locate`."""


def _dimension(function: str, struct: str) -> property:
    """A property that asks once."""

    def dimension(self: Handle) -> int:
        if self._dim is None:
            self._dim = int(self._info(function, struct).dim)
        return self._dim

    return property(dimension, doc="How many coordinates points have.")


class Domain(Handle):
    """A shape: its boundary, and what lies inside.

    Args:
        vertices: float array of shape (n, dim)
        facets: int array of shape (m, dim): vertex indices of the boundary's edges (2-D), triangles
            (3-D) and so on. May be left out in 2-D: a polygon through the vertices in their order.
        progress, threads: see `libicc.Progress`; threads default to one per processor, results are
            the same for every number

    Raises:
        BoundaryError, TopologyError: with the vertex or facet at fault as ``index``
    """

    _free = "domain_free"

    def __init__(self, vertices: ArrayLike, facets: Optional[ArrayLike] = None, *,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        vertices = np.ascontiguousarray(vertices, dtype=np.float64)
        if vertices.ndim != 2:
            raise ValueError(f"vertices must have the shape (n, dim), not {vertices.shape}")
        n, dim = vertices.shape
        facets = None if facets is None else indices(facets, dim, "facets")
        self._take(create(lib.domain_create, dim, n, address(vertices),
                          0 if facets is None else len(facets), address(facets),
                          progress=progress, threads=threads))

    @classmethod
    def from_mask(cls, mask: ArrayLike, *, progress: Optional[Progress] = None,
                  threads: Optional[int] = None) -> "Domain":
        """The solid of the cells of a mask that are true; cell (i, j, ..) covers
        [i, i + 1] x [j, j + 1] x .., so axis k of the array is coordinate k."""
        mask = np.asarray(mask)
        cells = np.asfortranarray(mask != 0).view(np.uint8)
        shape = (ctypes.c_size_t * mask.ndim)(*mask.shape)
        return cls._wrap(create(lib.domain_create_mask, mask.ndim, ctypes.addressof(shape),
                                cells.ctypes.data, progress=progress, threads=threads))

    @classmethod
    def from_mesh(cls, vertices: ArrayLike, simplices: ArrayLike, facets: Optional[ArrayLike] = None, *,
                  progress: Optional[Progress] = None, threads: Optional[int] = None) -> "Domain":
        """A domain with a conforming mesh of its inside, on which foliations work in every dimension.

        Args:
            vertices: (n, dim)
            simplices: (m, dim + 1) vertex indices
            facets: (k, dim) vertex indices of the boundary, in an order of yours; or None
        """
        vertices = np.ascontiguousarray(vertices, dtype=np.float64)
        if vertices.ndim != 2:
            raise ValueError(f"vertices must have the shape (n, dim), not {vertices.shape}")
        n, dim = vertices.shape
        simplices = indices(simplices, dim + 1, "simplices")
        facets = None if facets is None else indices(facets, dim, "facets")
        return cls._wrap(create(lib.domain_create_mesh, dim, n, address(vertices), len(simplices),
                                address(simplices), 0 if facets is None else len(facets),
                                address(facets), progress=progress, threads=threads))

    @property
    def info(self) -> SimpleNamespace:
        """dim, orientation, n_vertices, n_facets, lower, upper, measure."""
        info = self._info("domain_get_info", "domain_info")
        return fields(info, info.dim)

    dim = _dimension("domain_get_info", "domain_info")

    @property
    def vertices(self) -> Floats:
        """A copy of the vertices, (n, dim)."""
        info = self._info("domain_get_info", "domain_info")
        vertices = np.empty((info.n_vertices, info.dim))
        check(lib.domain_get_boundary(self, address(vertices), None))
        return vertices

    @property
    def facets(self) -> Indices:
        """A copy of the facets, (m, dim) vertex indices."""
        info = self._info("domain_get_info", "domain_info")
        facets = np.empty((info.n_facets, info.dim), dtype=np.uint32)
        check(lib.domain_get_boundary(self, None, address(facets)))
        return facets

    @overload
    def locate(self, points: ArrayLike, *, nearest: Literal[False] = ..., progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Ints: ...
    @overload
    def locate(self, points: ArrayLike, *, nearest: Literal[True], progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Tuple[Ints, Indices, Floats]: ...

    def locate(self, points: ArrayLike, *, nearest: bool = False, progress: Optional[Progress] = None,
               threads: Optional[int] = None) -> Any:
        """Where points lie: an int32 array of INSIDE, BOUNDARY and OUTSIDE.

        With ``nearest`` also the nearest facets (n,) and the barycentric coordinates (n, dim) of the
        nearest boundary points.
        """
        dim = self.dim
        points = points_of(points, dim)
        n = len(points)
        where = np.empty(n, dtype=np.int32)
        facet = np.empty(n, dtype=np.uint32) if nearest else None
        bary = np.empty((n, dim)) if nearest else None
        env, done = bulk(n, progress, threads)
        done(lib.domain_locate(self, n, address(points), address(where), address(facet),
                               address(bary), env))
        return (where, facet, bary) if nearest else where

    def __repr__(self) -> str:
        info = self.info
        return f"<libicc.Domain: {info.dim}-D, {info.n_vertices} vertices, {info.n_facets} facets>"


def as_domain(shape: ShapeLike) -> Domain:
    """A domain from whatever describes one.

    Takes a Domain; an array of polygon vertices; a pair (vertices, facets); a boolean mask; a shapely
    Polygon without holes; a meshio Mesh of triangles in space (a surface), of triangles in the plane or
    of tetrahedra (a conforming mesh).
    """
    if isinstance(shape, Domain):
        return shape
    if hasattr(shape, "exterior"):
        return _from_shapely(shape)
    if hasattr(shape, "cells_dict"):
        return _from_meshio(shape)
    if isinstance(shape, tuple) and len(shape) == 2 and np.ndim(shape[0]) == 2:
        return Domain(*shape)
    array = np.asarray(shape)
    return Domain.from_mask(array) if array.dtype == bool else Domain(array)


def _from_shapely(polygon: Any) -> Domain:
    if len(polygon.interiors) > 0:
        raise ValueError("the polygon has holes; make one map for each part without")
    return Domain(np.asarray(polygon.exterior.coords)[:-1, :2])


def _from_meshio(mesh: Any) -> Domain:
    points, cells = np.asarray(mesh.points, dtype=np.float64), mesh.cells_dict
    if "tetra" in cells:
        return Domain.from_mesh(points, cells["tetra"])
    if "triangle" not in cells:
        raise ValueError("the mesh has neither tetrahedra nor triangles")
    if points.shape[1] == 2 or not points[:, 2].any():
        return Domain.from_mesh(points[:, :2], cells["triangle"])
    return Domain(points, cells["triangle"])


def _chart_options(dim: int, method: Optional[str], cells: Optional[int], maximum: Optional[ArrayLike],
                   function: Optional[str], constraints: Optional[str], solver: Optional[str],
                   tree: Optional[str], eta: Optional[float], leaf: Optional[float]) -> Any:
    options = new("chart_options", method=choose(method, METHODS, "method"), cells=cells or 0,
                  function=choose(function, FUNCTIONS, "function"),
                  constraints=choose(constraints, CONSTRAINTS, "constraints"),
                  solver=choose(solver, SOLVERS, "solver"), tree=choose(tree, TREES, "tree"),
                  eta=eta or 0, leaf=leaf or 0)
    if maximum is not None:
        options.keep = floats(maximum, (dim,), "maximum")
        options.maximum = address(options.keep)
    return options


class Chart(Saved):
    """Coordinates of a domain's inside: a boundary point, and the share of the way to the maximum.

    Args:
        domain: a Domain, or what `as_domain` takes
        method: "foliation", "disc" (2-D), "field" or "gradient"; None: the best that there is
        cells: grid or mesh cells along the longest side; None: as many as suit
        maximum: where the curves shall end, (dim,), or None
        function: of the method gradient: "decay", "distance", "laplace", "bilaplace" or "clamped"
        constraints: whether it is made to fall along the tree: "needed", "none" or "all"
        solver: "direct" or "iterative"
        tree: "thesis" or "paper"
        eta, leaf: least relative fall and least value, see ``icc_chart_options``
        progress, threads: as for `Domain`

    Raises:
        CertificateError, ResolutionError, OutsideError (the maximum), UnsupportedError, SolverError
    """

    _free = "chart_free"
    _name = "chart"
    dim = _dimension("chart_get_info", "chart_info")

    def __init__(self, domain: ShapeLike, method: Optional[str] = None, *, cells: Optional[int] = None,
                 maximum: Optional[ArrayLike] = None, function: Optional[str] = None,
                 constraints: Optional[str] = None, solver: Optional[str] = None,
                 tree: Optional[str] = None, eta: Optional[float] = None, leaf: Optional[float] = None,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        domain = as_domain(domain)
        options = _chart_options(domain.dim, method, cells, maximum, function, constraints, solver, tree,
                                 eta, leaf)
        self._take(create(lib.chart_create, domain, ctypes.addressof(options),
                          progress=progress, threads=threads))

    @property
    def domain(self) -> Domain:
        """The domain that the chart was made on."""
        return Domain._wrap(lib.chart_domain(self), owner=self)

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_chart_info``; method and function by their names."""
        info = self._info("chart_get_info", "chart_info")
        result = fields(info, info.dim)
        result.method = name_of(info.method, METHODS)
        result.function = name_of(info.function, FUNCTIONS)
        result.tree = name_of(info.tree, TREES)
        return result

    @property
    def certified(self) -> bool:
        """Whether the chart is proved to be one-to-one."""
        return bool(self._info("chart_get_info", "chart_info").certified)

    def measure(self, n_points: int = 0, *, progress: Optional[Progress] = None,
                threads: Optional[int] = None) -> SimpleNamespace:
        """Estimates what the coordinates miss from `n_points` evenly spread points (0: 4096): the members of
        ``icc_chart_measures``, shares in [0, 1]."""
        call, measures = Call(progress, threads), new("chart_measures")
        call.check(lib.chart_measure(self, n_points, ctypes.addressof(measures), call.env,
                                     call.err))
        return fields(measures)

    @overload
    def encode(self, points: ArrayLike, *, status: Literal[False] = ..., progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Tuple[Indices, Floats, Floats]: ...
    @overload
    def encode(self, points: ArrayLike, *, status: Literal[True], progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Tuple[Indices, Floats, Floats, Ints]: ...

    def encode(self, points: ArrayLike, *, status: bool = False, progress: Optional[Progress] = None,
               threads: Optional[int] = None) -> Any:
        """Cartesian -> integral curve coordinates.

        Args:
            points: (n, dim)
            status: whether to return the status of every point, too

        Returns:
            facet (n,) uint32, bary (n, dim), t (n,), and with ``status`` an int32 array (n,): 0, or the
            number of an `Error`. A point without coordinates has NaN in bary and t.
        """
        points = points_of(points, self.dim)
        n, dim = points.shape
        facet, bary, t = np.empty(n, dtype=np.uint32), np.empty((n, dim)), np.empty(n)
        states = np.empty(n, dtype=np.int32) if status else None
        env, done = bulk(n, progress, threads)
        done(lib.chart_encode(self, n, address(points), address(facet), address(bary),
                              address(t), address(states), None, env))
        return (facet, bary, t, states) if status else (facet, bary, t)

    @overload
    def decode(self, facet: ArrayLike, bary: ArrayLike, t: ArrayLike, *, status: Literal[False] = ...,
               progress: Optional[Progress] = ..., threads: Optional[int] = ...) -> Floats: ...
    @overload
    def decode(self, facet: ArrayLike, bary: ArrayLike, t: ArrayLike, *, status: Literal[True],
               progress: Optional[Progress] = ..., threads: Optional[int] = ...) -> Tuple[Floats, Ints]: ...

    def decode(self, facet: ArrayLike, bary: ArrayLike, t: ArrayLike, *, status: bool = False,
               progress: Optional[Progress] = None, threads: Optional[int] = None) -> Any:
        """Integral curve coordinates -> Cartesian; the inverse of `encode`.

        Args:
            facet: (n,) indices of boundary facets
            bary: (n, dim) barycentric coordinates there: not negative, sum 1
            t: (n,) shares of the curves' arc length from the boundary, in [0, 1]
            status: whether to return the status of every point, too

        Returns:
            points (n, dim), NaN where there is none, and with ``status`` an int32 array (n,) as `encode`
        """
        dim = self.dim
        facet = np.ascontiguousarray(facet, dtype=np.uint32)
        n = len(facet)
        bary, t = floats(bary, (n, dim), "bary"), floats(t, (n,), "t")
        points = np.empty((n, dim))
        states = np.empty(n, dtype=np.int32) if status else None
        env, done = bulk(n, progress, threads)
        done(lib.chart_decode(self, n, address(facet), address(bary), address(t),
                              address(points), address(states), None, env))
        return (points, states) if status else points

    def trace(self, point: ArrayLike) -> Floats:
        """The curve through a point (dim,), from the boundary to the maximum: a polyline, (m, dim)."""
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


class Map(Saved):
    """A map from one domain to another that agrees with their boundaries.

    Facet i of the source goes to facet i of the target. Call it with points, or use `inverse`.

    Args:
        source, target: Domains, or what `as_domain` takes
        kind: "mesh" (2-D, and 3-D between domains with meshes) or "curves"; None: the best that there is
        improve: steps of improvement on each level for kind mesh; None: as many as pay, 0: none
        method, cells, maximum, ...: of the charts, see `Chart`; the maximum is the source's
        target_maximum: where the target's maximum shall be, (dim,), or None
        progress, threads: as for `Domain`

    Raises:
        as `Chart`; BoundaryError if the domains do not correspond. ``side`` tells which is at fault.
    """

    _free = "map_free"
    _name = "map"
    dim = _dimension("map_get_info", "map_info")

    def __init__(self, source: ShapeLike, target: ShapeLike, kind: Optional[str] = None, *,
                 improve: Optional[int] = None, method: Optional[str] = None,
                 cells: Optional[int] = None, maximum: Optional[ArrayLike] = None,
                 target_maximum: Optional[ArrayLike] = None, function: Optional[str] = None,
                 constraints: Optional[str] = None, solver: Optional[str] = None,
                 tree: Optional[str] = None, eta: Optional[float] = None,
                 leaf: Optional[float] = None, progress: Optional[Progress] = None,
                 threads: Optional[int] = None):
        source, target = as_domain(source), as_domain(target)
        chart = _chart_options(source.dim, method, cells, maximum, function, constraints, solver, tree,
                               eta, leaf)
        options = new("map_options", kind=choose(kind, KINDS, "kind"), chart=ctypes.addressof(chart),
                      iterations=0 if improve is None else improve or -1)
        if target_maximum is not None:
            point = floats(target_maximum, (target.dim,), "target_maximum")
            options.target_maximum = address(point)
        self._take(create(lib.map_create, source, target,
                          ctypes.addressof(options), progress=progress, threads=threads))

    @classmethod
    def from_charts(cls, source: Chart, target: Chart, kind: Optional[str] = None, *,
                    progress: Optional[Progress] = None, threads: Optional[int] = None) -> "Map":
        """The map between two charts that were made with the same method, of a kind as for `Map`."""
        options = new("map_options", kind=choose(kind, KINDS, "kind"))
        return cls._wrap(create(lib.map_create_from_charts, source, target,
                                ctypes.addressof(options), progress=progress, threads=threads))

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_map_info``; the kind by its name."""
        result = fields(self._info("map_get_info", "map_info"))
        result.kind = name_of(result.kind, KINDS)
        return result

    @property
    def certified(self) -> bool:
        """Whether the map is proved to be one-to-one."""
        return bool(self._info("map_get_info", "map_info").certified)

    @property
    def source_chart(self) -> Optional[Chart]:
        """The chart of the source; None for maps made by `follow`."""
        return Chart._borrow(lib.map_source_chart(self), owner=self)

    @property
    def target_chart(self) -> Optional[Chart]:
        """The chart of the target; None for maps made by `follow`."""
        return Chart._borrow(lib.map_target_chart(self), owner=self)

    def _apply(self, function: Any, points: ArrayLike, status: bool, progress: Optional[Progress],
               threads: Optional[int]) -> Any:
        points = points_of(points, self.dim)
        n = len(points)
        images = np.empty_like(points)
        states = np.empty(n, dtype=np.int32) if status else None
        env, done = bulk(n, progress, threads)
        done(function(self, n, address(points), address(images), address(states), None, env))
        return (images, states) if status else images

    @overload
    def __call__(self, points: ArrayLike, *, status: Literal[False] = ..., progress: Optional[Progress] = ...,
                 threads: Optional[int] = ...) -> Floats: ...
    @overload
    def __call__(self, points: ArrayLike, *, status: Literal[True], progress: Optional[Progress] = ...,
                 threads: Optional[int] = ...) -> Tuple[Floats, Ints]: ...

    def __call__(self, points: ArrayLike, *, status: bool = False, progress: Optional[Progress] = None,
                 threads: Optional[int] = None) -> Any:
        """Source -> target: points (n, dim) -> images (n, dim), NaN where there is none. With
        ``status`` also an int32 array (n,): 0, or the number of an `Error`."""
        return self._apply(lib.map_apply, points, status, progress, threads)

    @overload
    def inverse(self, points: ArrayLike, *, status: Literal[False] = ..., progress: Optional[Progress] = ...,
                threads: Optional[int] = ...) -> Floats: ...
    @overload
    def inverse(self, points: ArrayLike, *, status: Literal[True], progress: Optional[Progress] = ...,
                threads: Optional[int] = ...) -> Tuple[Floats, Ints]: ...

    def inverse(self, points: ArrayLike, *, status: bool = False, progress: Optional[Progress] = None,
                threads: Optional[int] = None) -> Any:
        """Target -> source; otherwise as calling the map."""
        return self._apply(lib.map_apply_inverse, points, status, progress, threads)

    def jacobian(self, points: ArrayLike, *, progress: Optional[Progress] = None,
                 threads: Optional[int] = None) -> Floats:
        """Derivatives (n, dim, dim) at points (n, dim) of the source's inside: entry [k, i, j] is that of
        image coordinate i by point coordinate j; NaN where there is none."""
        points = points_of(points, self.dim)
        n, dim = points.shape
        result = np.empty((n, dim, dim))
        env, done = bulk(n, progress, threads)
        done(lib.map_jacobian(self, n, address(points), address(result), None, None, env))
        return result

    def improve(self, iterations: int = 0, levels: int = 0, tolerance: float = 0, *,
                progress: Optional[Progress] = None,
                threads: Optional[int] = None) -> Tuple["Map", SimpleNamespace]:
        """A fairer map, and a report (kind mesh in 2-D). A progress callback that asks to stop ends it early,
        without loss.

        Args:
            iterations: steps at most on each level; 0: 60
            levels: refinements at most; 0: 4; -1: none
            tolerance: a level ends with a step that gains less than this share of the energy; 0: 1e-4

        Returns:
            the map, and the members of ``icc_improve_report``
        """
        options = new("improve_options", iterations=iterations, levels=levels, tolerance=tolerance)
        call, out, report = Call(progress, threads), ctypes.c_void_p(), new("improve_report")
        call.check(lib.map_improve(ctypes.addressof(out), self, ctypes.addressof(options),
                                   ctypes.addressof(report), call.env, call.err))
        assert out.value is not None
        return type(self)._wrap(out.value), fields(report)

    def follow(self, target: ShapeLike, iterations: int = 0, *, progress: Optional[Progress] = None,
               threads: Optional[int] = None) -> "Map":
        """The map to a target that has moved a little, starting from this one (kind mesh in 2-D), improved by
        at most `iterations` steps (0: 8; -1: none). CertificateError if it has moved too far."""
        return type(self)._wrap(create(lib.map_follow, self, as_domain(target),
                                       iterations, progress=progress, threads=threads))

    def mesh(self) -> Tuple[Floats, Floats, Indices]:
        """The mesh of a map of kind mesh: vertices (n, dim), images (n, dim), simplices (m, dim + 1)."""
        info = self._info("map_get_info", "map_info")
        vertices = np.empty((info.n_vertices, info.dim))
        images = np.empty((info.n_vertices, info.dim))
        triangles = np.empty((info.n_triangles, info.dim + 1), dtype=np.uint32)
        check(lib.map_mesh(self, address(vertices), address(images), address(triangles)))
        return vertices, images, triangles

    def _carry(self, function: Any, vertices: ArrayLike, simplices: ArrayLike, progress: Optional[Progress],
               threads: Optional[int]) -> Tuple[Floats, SimpleNamespace]:
        dim = self.dim
        vertices, simplices = points_of(vertices, dim), indices(simplices, dim + 1, "simplices")
        images, certificate = np.empty_like(vertices), new("certificate")
        call = Call(progress, threads)
        call.check(function(self, len(vertices), address(vertices), len(simplices),
                            address(simplices), address(images), ctypes.addressof(certificate),
                            call.env, call.err))
        return images, fields(certificate)

    def certify(self, vertices: ArrayLike, simplices: ArrayLike, *, progress: Optional[Progress] = None,
                threads: Optional[int] = None) -> Tuple[Floats, SimpleNamespace]:
        """Maps the vertices of a mesh of yours and checks exactly what became of its simplices:
        images (n, dim) and the members of ``icc_certificate``. 2-D and 3-D.

        Args:
            vertices: (n, dim)
            simplices: (m, dim + 1) vertex indices
        """
        return self._carry(lib.map_certify, vertices, simplices, progress, threads)

    def repair(self, vertices: ArrayLike, simplices: ArrayLike, *, progress: Optional[Progress] = None,
               threads: Optional[int] = None) -> Tuple[Floats, SimpleNamespace]:
        """As `certify`, but moves images of inner vertices until no simplex is inverted, where that
        is possible."""
        return self._carry(lib.map_repair, vertices, simplices, progress, threads)

    def __repr__(self) -> str:
        info = self.info
        word = "certified" if info.certified else "not certified"
        return f"<libicc.Map: {info.kind}, {info.dim}-D, {word}>"


def boundary_defects(vertices: ArrayLike) -> List[Tuple[str, int, int]]:
    """Everything that keeps a closed polygon (n, 2) from being a boundary: a list of (kind, a, b)."""
    vertices = points_of(vertices, 2)
    call, n, capacity = Call(threads=1), ctypes.c_size_t(), 64
    while True:
        kinds, items = np.empty(capacity, np.int32), np.empty((capacity, 2), np.uint32)
        call.check(lib.boundary_defects(len(vertices), address(vertices), capacity, address(kinds),
                                        address(items), ctypes.addressof(n), call.env, call.err))
        if n.value <= capacity:
            break
        capacity = n.value
    return [(name_of(kinds[i], DEFECTS) or "", int(items[i, 0]), int(items[i, 1])) for i in range(n.value)]


def repair_mask(mask: ArrayLike) -> Tuple[Bools, int]:
    """A mask without cells that touch only along an edge or a corner, and how many cells were
    filled for that."""
    mask = np.asarray(mask)
    cells = np.array(mask != 0, order="F").view(np.uint8)
    shape = (ctypes.c_size_t * mask.ndim)(*mask.shape)
    call, n = Call(threads=1), ctypes.c_size_t()
    call.check(lib.mask_repair(mask.ndim, ctypes.addressof(shape), cells.ctypes.data,
                               ctypes.addressof(n), call.env, call.err))
    return cells.view(bool), n.value
