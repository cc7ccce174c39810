"""The stages of the papers one by one: grid, tree, function, curves, triangulation."""

from __future__ import annotations

import ctypes
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Optional, Sequence, Tuple

import numpy as np

from ._abi import lib, new
from ._chart import CONSTRAINTS, FUNCTIONS, SOLVERS, TREES, Chart, axes_of
from ._core import Call, Handle, Progress, address, choose, create, fields, name_of, points_of
from ._domain import as_domain
from ._errors import check

if TYPE_CHECKING:
    from ._types import Array, ArrayLike, Bools, Floats, Indices, Ints, ShapeLike

__all__ = ["Curves", "Function", "Grid", "Tree", "triangulate"]


def _view(pointer: Optional[int], n: int, dtype: Any, owner: Handle) -> Optional[Array]:
    """The library's own array, read-only; keeps its owner alive."""
    if not pointer:
        return None
    dtype = np.dtype(dtype)
    interface = {"shape": (n,), "typestr": dtype.str, "data": (pointer, True), "version": 3}
    return np.asarray(SimpleNamespace(__array_interface__=interface, owner=owner))


class Grid(Handle):
    """A regular grid of vertices, each inside or outside a shape.

    Arrays over its vertices have the grid's shape: axis k of the array is coordinate k.

    Args:
        domain: a Domain, or anything that `libicc.as_domain` takes
        cells: grid cells along the longest side; None: 50
    """

    _free = "grid_free"

    def __init__(self, domain: ShapeLike, cells: Optional[int] = None, *,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        self._take(create(lib.grid_create, as_domain(domain), cells or 0, progress=progress,
                          threads=threads))

    @classmethod
    def from_mask(cls, inside: ArrayLike) -> "Grid":
        """The grid whose vertices inside are the true ones of an array."""
        inside = np.asfortranarray(np.asarray(inside) != 0).view(np.uint8)
        shape = (ctypes.c_size_t * inside.ndim)(*inside.shape)
        return cls._wrap(create(lib.grid_create_mask, inside.ndim, ctypes.addressof(shape),
                                inside.ctypes.data))

    def refine(self) -> "Grid":
        """The grid with cells half as large."""
        return Grid._wrap(create(lib.grid_refine, self))

    def restrict(self, keep: ArrayLike) -> "Grid":
        """The grid without the vertices inside where `keep` is false."""
        keep = np.asfortranarray(np.asarray(keep) != 0).view(np.uint8)
        if keep.shape != self.shape:
            raise ValueError(f"keep must have the shape {self.shape}, not {keep.shape}")
        return Grid._wrap(create(lib.grid_restrict, self, keep.ctypes.data))

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_grid_info``."""
        info = self._info("grid_get_info", "grid_info")
        return fields(info, info.dim)

    @property
    def shape(self) -> Tuple[int, ...]:
        """Number of vertices along each axis."""
        info = self._info("grid_get_info", "grid_info")
        return tuple(info.shape[: info.dim])

    def _array(self, pointer: Optional[int], dtype: Any, owner: Handle) -> Any:
        shape = self.shape
        view = _view(pointer, int(np.prod(shape)), dtype, owner)
        return None if view is None else view.reshape(shape, order="F")

    @property
    def inside(self) -> Bools:
        """Which vertices are inside: a read-only boolean array."""
        return self._array(lib.grid_inside(self), np.bool_, self)

    def maximum(self, *, progress: Optional[Progress] = None) -> Tuple[int, int]:
        """The grassfire's maximum (Algorithm 1) as a vertex number, and the rounds it took."""
        call, vertex, rounds = Call(progress, 1), ctypes.c_uint32(), ctypes.c_uint32()
        call.check(lib.grid_find_maximum(self, ctypes.addressof(vertex), ctypes.addressof(rounds),
                                    call.env, call.err))
        return vertex.value, rounds.value

    def nearest(self, point: ArrayLike) -> int:
        """The number of the vertex inside that is nearest to a point (dim,)."""
        point, vertex = points_of(point, len(self.shape)), ctypes.c_uint32()
        check(lib.grid_find_nearest(self, address(point), ctypes.addressof(vertex)))
        return vertex.value

    def position(self, vertex: ArrayLike) -> Floats:
        """Coordinates (n, dim) of vertices that are given by their numbers (n,)."""
        numbers = np.ascontiguousarray(vertex, dtype=np.uint32)
        points = np.empty((*np.shape(vertex), len(self.shape)))
        check(lib.grid_get_points(self, numbers.size, address(numbers), address(points)))
        return points


def _tree_options(grid: Grid, form: Optional[str],
                  axis_order: Optional[Sequence[int]]) -> Tuple[Any, Any]:
    """The options, and the array that they point to."""
    options = new("tree_options", form=choose(form, TREES, "form"))
    if axis_order is None:
        return options, None
    order = axes_of(axis_order, len(grid.shape))
    options.axis_order = order.ctypes.data
    return options, order


class Tree(Handle):
    """The tree of Algorithm 2.

    Args:
        grid: a Grid
        root: the number of a vertex inside; None: the grassfire's maximum
        form: "thesis" (default) or "paper"
        axis_order: order in which a generation expands along the axes, a permutation
    """

    _free = "tree_free"

    def __init__(self, grid: Grid, root: Optional[int] = None, *, form: Optional[str] = None,
                 axis_order: Optional[Sequence[int]] = None, progress: Optional[Progress] = None):
        root = grid.maximum()[0] if root is None else root
        options, _order = _tree_options(grid, form, axis_order)
        self._take(create(lib.tree_create, grid, root, ctypes.addressof(options),
                          progress=progress))

    @classmethod
    def from_parents(cls, grid: Grid, root: int, parents: ArrayLike, *, form: Optional[str] = None,
                     axis_order: Optional[Sequence[int]] = None,
                     progress: Optional[Progress] = None) -> "Tree":
        """A tree with parents of your own: for each vertex inside the number of a neighbour inside, or 2**32 - 1
        for the root and for vertices to leave out. An array of the grid's shape."""
        options, _order = _tree_options(grid, form, axis_order)
        parents = np.asfortranarray(np.asarray(parents, dtype=np.uint32))
        if parents.shape != grid.shape:
            raise ValueError(f"parents must have the shape {grid.shape}, not {parents.shape}")
        return cls._wrap(create(lib.tree_create_parents, grid, root, parents.ctypes.data,
                                ctypes.addressof(options), progress=progress))

    @property
    def grid(self) -> Grid:
        """The grid that the tree grows on."""
        return Grid._wrap(lib.tree_grid(self), owner=self)

    @property
    def root(self) -> int:
        """The number of the vertex that it grows from."""
        return lib.tree_root(self)

    @property
    def parents(self) -> Indices:
        """Vertex numbers, read-only; 2**32 - 1 where there is none."""
        return self.grid._array(lib.tree_parents(self), np.uint32, self)

    @property
    def generations(self) -> Ints:
        """0 at the root, -1 where the tree does not reach, read-only."""
        return self.grid._array(lib.tree_generations(self), np.int32, self)

    def _report(self, function: Any, struct: str, *arguments: Any,
                progress: Optional[Progress] = None) -> SimpleNamespace:
        call, report = Call(progress, None), new(struct)
        call.check(function(self, *arguments, ctypes.addressof(report), call.env, call.err))
        return fields(report)

    def report(self, *, progress: Optional[Progress] = None) -> SimpleNamespace:
        """Checks the cousin rule; see ``icc_tree_report``."""
        return self._report(lib.tree_get_report, "tree_report", progress=progress)

    def grow(self, values: Optional[ArrayLike] = None, *,
             progress: Optional[Progress] = None) -> Tuple[Indices, SimpleNamespace]:
        """Orders the vertices so that the root is the only critical one. Returns ranks as an array, and a report: see
        ``icc_grow_report``."""
        shape = self.grid.shape
        values = None if values is None else np.asfortranarray(_floats_of(values, shape))
        rank = np.empty(shape, dtype=np.uint32, order="F")
        report = self._report(lib.tree_grow, "grow_report",
                              None if values is None else values.ctypes.data, rank.ctypes.data,
                              progress=progress)
        return rank, report

    def rank_report(self, rank: ArrayLike, *, progress: Optional[Progress] = None) -> SimpleNamespace:
        """Counts the critical vertices of an order; see ``icc_function_report``."""
        rank = np.asfortranarray(np.asarray(rank, dtype=np.uint32))
        if rank.shape != self.grid.shape:
            raise ValueError(f"rank must have the shape {self.grid.shape}, not {rank.shape}")
        return self._report(lib.tree_get_rank_report, "function_report", rank.ctypes.data,
                            progress=progress)


def _floats_of(values: ArrayLike, shape: Tuple[int, ...]) -> Floats:
    array = np.asarray(values, dtype=np.float64)
    if array.shape != tuple(shape):
        raise ValueError(f"values must have the shape {tuple(shape)}, not {array.shape}")
    return array


class Function(Handle):
    """A function on the vertices of a tree.

    `decay` and `distance` fall from parent to child. The other functions solve an equation. By default the tree's
    inequalities are imposed on these only if they would have other critical points than the maximum (`constraints`).

    Args:
        tree: a Tree
        function, constraints, solver, min_fall, leaf_min: as for `libicc.Chart`
    """

    _free = "function_free"

    def __init__(self, tree: Tree, function: Optional[str] = None, *,
                 constraints: Optional[str] = None, solver: Optional[str] = None,
                 min_fall: Optional[float] = None, leaf_min: Optional[float] = None,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        options = new("function_options", function=choose(function, FUNCTIONS, "function"),
                      constraints=choose(constraints, CONSTRAINTS, "constraints"),
                      solver=choose(solver, SOLVERS, "solver"), min_fall=min_fall or 0, leaf_min=leaf_min or 0)
        self._take(create(lib.function_create, tree, ctypes.addressof(options),
                          progress=progress, threads=threads))

    @classmethod
    def from_values(cls, tree: Tree, values: ArrayLike, *, progress: Optional[Progress] = None) -> "Function":
        """A function with values of your own, an array of the grid's shape. Values of vertices outside may be NaN:
        the function then goes on as it falls inside."""
        return cls._given(lib.function_create_values, tree, values, progress)

    @classmethod
    def from_logs(cls, tree: Tree, logs: ArrayLike, *, progress: Optional[Progress] = None) -> "Function":
        """The same from natural logarithms, for values that doubles cannot hold. The function is 0 just outside."""
        return cls._given(lib.function_create_logs, tree, logs, progress)

    @classmethod
    def solve(cls, tree: Tree, function: str = "laplace", *, fixed: Optional[ArrayLike] = None,
              right_side: Optional[ArrayLike] = None, progress: Optional[Progress] = None,
              threads: Optional[int] = None) -> "Function":
        """Solves ``L f = right_side`` ("laplace") or ``L L f = right_side`` ("bilaplace"), where L f is the sum of
        differences to the 2 dim neighbours. Both arrays have the grid's shape. `fixed` is NaN where a vertex is free;
        just outside, NaN stands for 0."""
        options = new("function_options", function=choose(function, FUNCTIONS, "function"))
        arrays = [None if given is None else np.asfortranarray(_floats_of(given, tree.grid.shape))
                  for given in (fixed, right_side)]
        return cls._wrap(create(lib.function_create_solve, tree, ctypes.addressof(options),
                                *(None if array is None else array.ctypes.data for array in arrays),
                                progress=progress, threads=threads))

    @classmethod
    def _given(cls, create_it: Any, tree: Tree, given: ArrayLike, progress: Optional[Progress]) -> "Function":
        array = np.asfortranarray(_floats_of(given, tree.grid.shape))
        return cls._wrap(create(create_it, tree, array.ctypes.data, progress=progress))

    @classmethod
    def of(cls, chart: Chart) -> Optional["Function"]:
        """The function of a chart of method gradient or field; None for others."""
        return cls._borrow(lib.chart_function(chart), owner=chart)

    @property
    def tree(self) -> Tree:
        """The tree that the function was made on."""
        return Tree._wrap(lib.function_tree(self), owner=self)

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_function_info``. Function and solver are given by name."""
        result = fields(self._info("function_get_info", "function_info"))
        result.function = name_of(result.function, FUNCTIONS)
        result.solver = name_of(result.solver, SOLVERS)
        return result

    @property
    def solver_report(self) -> SimpleNamespace:
        """How the function was computed: the members of ``icc_solver_report``."""
        return fields(self._info("function_get_solver_report", "solver_report"))

    @property
    def values(self) -> Floats:
        """The values as an array of the grid's shape, read-only."""
        return self.tree.grid._array(lib.function_values(self), np.float64, self)

    @property
    def logs(self) -> Optional[Floats]:
        """Logarithms of the values, which may be too small for doubles; or None. Read-only."""
        return self.tree.grid._array(lib.function_logs(self), np.float64, self)

    def report(self, *, progress: Optional[Progress] = None) -> SimpleNamespace:
        """Counts the critical points; see ``icc_function_report``."""
        call, report = Call(progress, None), new("function_report")
        call.check(lib.function_get_report(self, ctypes.addressof(report), call.env, call.err))
        return fields(report)

    def trace(self, point: ArrayLike) -> Floats:
        """Computes the curve through a point (dim,), from the boundary to the maximum: a polyline, (m, dim). See `Curves`
        for each way by itself, for many points, and for how curves end."""
        point = points_of(point, len(self.tree.grid.shape))
        down, up = (Curves(self, point, way)[0] for way in ("down", "up"))
        return np.vstack([down[::-1], up[1:]])

    def edges(self) -> Tuple[Indices, Ints]:
        """Edges (n, 2) where gradient lines merge, and their kinds (n,): 1 on the way up
        (compression), 2 on the way down (expansion). 2-D."""
        n = ctypes.c_size_t()
        check(lib.function_get_edges(self, 0, None, None, ctypes.addressof(n), None))
        edges, kinds = np.empty((n.value, 2), np.uint32), np.empty(n.value, np.int32)
        check(lib.function_get_edges(self, n.value, address(edges), address(kinds),
                              ctypes.addressof(n), None))
        return edges, kinds

    def facets(self, *, progress: Optional[Progress] = None) -> Tuple[Indices, Ints]:
        """Facets (n, dim) of simplices where gradient lines merge, and their kinds (n,) as for `edges`, in any
        dimension."""
        report, dim = self.facet_report(progress=progress), len(self.tree.grid.shape)
        n = report.n_compression + report.n_expansion
        facets, kinds = np.empty((n, dim), np.uint32), np.empty(n, np.int32)
        self._facets(n, address(facets), address(kinds), progress)
        return facets, kinds

    def facet_report(self, *, progress: Optional[Progress] = None) -> SimpleNamespace:
        """Only counts these facets; see ``icc_facet_report``."""
        return self._facets(0, None, None, progress)

    def _facets(self, n: int, facets: Any, kinds: Any, progress: Optional[Progress]) -> SimpleNamespace:
        call, report = Call(progress, None), new("facet_report")
        call.check(lib.function_get_facets(self, n, facets, kinds, ctypes.addressof(report), call.env, call.err))
        return fields(report)


WAYS = {"up": 1, "down": 2}
ENDS = {"none": 0, "maximum": 1, "boundary": 2, "critical": 3, "values": 4}


class Curves(Handle):
    """The integral curves of a function through points, as polylines: ``curves[i]`` has the vertices (m, dim) of
    the curve through point i.

    Args:
        function: a Function
        points: (n, dim)
        way: "up" to the maximum, or "down" to the boundary
    """

    _free = "curves_free"

    def __init__(self, function: Function, points: ArrayLike, way: str = "up", *,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        points = points_of(points, len(function.tree.grid.shape))
        self._take(create(lib.curves_create, function, len(points), address(points),
                          choose(way, WAYS, "way"), progress=progress, threads=threads))
        info = self._info("curves_get_info", "curves_info")
        self._first = np.empty(info.n_curves + 1, dtype=np.uintp)
        self._vertices = np.empty((info.n_vertices, info.dim))
        check(lib.curves_get_vertices(self, address(self._first), address(self._vertices)))

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_curves_info``; the way by its name."""
        result = fields(self._info("curves_get_info", "curves_info"))
        result.way = name_of(result.way, WAYS)
        return result

    def __len__(self) -> int:
        return len(self._first) - 1

    def __getitem__(self, i: int) -> Floats:
        if not -len(self) <= i < len(self):
            raise IndexError(i)
        i %= len(self)
        return self._vertices[self._first[i]:self._first[i + 1]]

    def ends(self) -> SimpleNamespace:
        """How the curves end: ``end`` (n,) names, ``length`` (n,), ``alone`` (n,) up to where others join, ``facet``
        (n,) and ``bary`` (n, dim) of curves that end on the boundary."""
        n, dim = len(self), self._vertices.shape[1]
        end, facet = np.empty(n, np.int32), np.empty(n, np.uint32)
        length, alone, bary = np.empty(n), np.empty(n), np.empty((n, dim))
        check(lib.curves_get_ends(self, address(end), address(length), address(alone), address(facet), address(bary)))
        names = np.array([name for name, _ in sorted(ENDS.items(), key=lambda item: item[1])])
        return SimpleNamespace(end=names[end], length=length, alone=alone, facet=facet, bary=bary)


def triangulate(points: ArrayLike, n_boundary: int, *,
                progress: Optional[Progress] = None) -> Indices:
    """The constrained Delaunay triangles (m, 3) of points (n, 2). The first `n_boundary` points are a simple
    polygon."""
    points = points_of(points, 2)
    triangles = np.empty((2 * len(points) - n_boundary - 2, 3), dtype=np.uint32)
    call = Call(progress, 1)
    call.check(lib.triangulate(n_boundary, len(points), address(points), address(triangles), call.env,
                               call.err))
    return triangles
