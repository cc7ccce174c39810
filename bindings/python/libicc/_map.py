"""Maps from one domain to another."""

from __future__ import annotations

import ctypes
import json
import warnings
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, List, Literal, Optional, Sequence, Tuple, Union, overload

import numpy as np

from ._abi import lib, new, structs
from ._chart import Chart, chart_options
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
    grid_of,
    indices,
    mesh_of,
    name_of,
    points_of,
)
from ._domain import as_domain, as_domains
from ._errors import blaming, check
from ._match import match_for

if TYPE_CHECKING:
    from ._types import ArrayLike, Floats, Indices, Ints, ShapeLike

KINDS = {"curves": 1, "mesh": 2}


class Map(Saved):
    """A map from one domain to another that agrees with their boundaries.

    Facet i of the source goes to facet i of the target. Call the map with points, or use `apply`; `inverse`, or
    `apply_inverse`, goes back.

    >>> mapping = libicc.Map([[0, 0], [4, 0], [4, 3], [0, 3]], [[0, 0], [4, 1], [4, 4], [0, 3]])
    >>> mapping
    <libicc.Map: mesh, 2-D, certified>
    >>> mapping([[1, 1], [9, 9]]).round(6)
    array([[1.  , 1.25],
           [ nan,  nan]])
    >>> mapping.inverse([[1, 1.25]]).round(6)
    array([[1., 1.]])

    Args:
        source, target: Domains, or what `as_domain` takes. An array holds the vertices of an outline in their
            order; control points go inside one: ``Map(Domain(outline, points=a), Domain(outline, points=b))``
        kind: "mesh" (2-D, and surfaces in 3-D, which are filled if they have no mesh) or "curves"; None: the best
            available
        improve: improvement steps on each level for kind mesh; None: as long as they pay off, 0: none
        method, cells, maximum, ...: of the charts, see `Chart`; the maximum is the source's
        target_maximum: the target's maximum, (dim,), or None
        ties: with features, as many as there are of them, or none: (vertices, source, target), two vertices of
            the domain, and the bends of a path from one to the other, (n, 2), in each of the domains. Together
            they join the features and the outer ring, and say which way round one another these go
        match: True for outlines that do not correspond: they get common vertices first, by shape. "arc": by arc
            length. Landmarks (n, 2, 2) or (n, 4): by shape between these. See `Match`
        progress, threads: as for `Domain`

    Raises:
        as `Chart`; BoundaryError if the domains do not correspond. ``side`` says which one is at fault.
    """

    _free = "map_free"
    _name = "map"
    dim = dimension("map_get_info", "map_info")

    def __init__(self, source: ShapeLike, target: ShapeLike, kind: Optional[str] = None, *,
                 improve: Optional[int] = None, method: Optional[str] = None,
                 cells: Optional[int] = None, maximum: Optional[ArrayLike] = None,
                 target_maximum: Optional[ArrayLike] = None, function: Optional[str] = None,
                 constraints: Optional[str] = None, solver: Optional[str] = None,
                 tree: Optional[str] = None, min_fall: Optional[float] = None,
                 leaf_min: Optional[float] = None, ties: Sequence[Tuple[Sequence[int], ArrayLike, ArrayLike]] = (),
                 match: Union[bool, str, ArrayLike, None] = None,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        source, target = as_domains(source, target)
        if match is not None and match is not False:
            matched = match_for(source, target, match)
            source, target = matched.source, matched.target
        chart = chart_options(source.dim, method, cells, maximum, function, constraints, solver, tree,
                              min_fall, leaf_min)
        options = new("map_options", kind=choose(kind, KINDS, "kind"), chart=ctypes.addressof(chart),
                      iterations=0 if improve is None else improve or -1)
        if target_maximum is not None:
            point = floats(target_maximum, (target.dim,), "target_maximum")
            options.target_maximum = address(point)
        all_ties, keep = _ties(ties)
        if ties:
            options.n_ties, options.ties = len(ties), ctypes.addressof(all_ties)
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
    def report(self) -> SimpleNamespace:
        """How the map was made: the members of ``icc_map_report``."""
        return fields(self._info("map_get_report", "map_report"))

    @property
    def ties(self) -> List[Tuple[Tuple[int, int], Floats, Floats]]:
        """Which way round one another features go: as the argument ``ties``, they make another map that can
        be moved to this one while it stays one-to-one. Each is its two vertices and its bends in the source
        and in the target; there are none without features."""
        return [self._tie(tie) for tie in range(self.info.n_ties)]

    def _tie(self, tie: int) -> Tuple[Tuple[int, int], Floats, Floats]:
        info = new("tie_info")
        check(lib.map_get_tie(self, tie, ctypes.addressof(info), None, None))
        source, target = np.empty((info.n_source, 2)), np.empty((info.n_target, 2))
        check(lib.map_get_tie(self, tie, ctypes.addressof(info), address(source), address(target)))
        return (info.vertex[0], info.vertex[1]), source, target

    @property
    def certified(self) -> bool:
        """Whether the map is proved to be one-to-one."""
        return bool(self._info("map_get_info", "map_info").certified)

    @property
    def source_chart(self) -> Optional[Chart]:
        """The chart of the source; None for maps made by `retarget`."""
        return Chart._borrow(lib.map_source_chart(self), owner=self)

    @property
    def target_chart(self) -> Optional[Chart]:
        """The chart of the target; None for maps made by `retarget`."""
        return Chart._borrow(lib.map_target_chart(self), owner=self)

    def _apply(self, function: Any, points: ArrayLike, status: bool, progress: Optional[Progress],
               threads: Optional[int]) -> Any:
        points, shape = grid_of(points, self.dim)
        n, dim = points.shape
        images = np.empty((*shape, dim))
        states = np.empty(shape, dtype=np.int32) if status else None
        env, done = bulk(n, progress, threads)
        done(function(self, n, address(points), address(images), address(states), None, env))
        return (images, states) if status else images

    @overload
    def apply(self, points: ArrayLike, *, status: Literal[False] = ..., progress: Optional[Progress] = ...,
              threads: Optional[int] = ...) -> Floats: ...
    @overload
    def apply(self, points: ArrayLike, *, status: Literal[True], progress: Optional[Progress] = ...,
              threads: Optional[int] = ...) -> Tuple[Floats, Ints]: ...

    def apply(self, points: ArrayLike, *, status: bool = False, progress: Optional[Progress] = None,
              threads: Optional[int] = None) -> Any:
        """Source -> target: points (n, dim) -> images (n, dim), NaN for points without one. With
        ``status`` also an int32 array (n,): 0, or the number of an `Error`. Grids (height, width, dim) and the like
        keep their shape. Images are float64, whatever points come as."""
        return self._apply(lib.map_apply, points, status, progress, threads)

    @overload
    def apply_inverse(self, points: ArrayLike, *, status: Literal[False] = ..., progress: Optional[Progress] = ...,
                      threads: Optional[int] = ...) -> Floats: ...
    @overload
    def apply_inverse(self, points: ArrayLike, *, status: Literal[True], progress: Optional[Progress] = ...,
                      threads: Optional[int] = ...) -> Tuple[Floats, Ints]: ...

    def apply_inverse(self, points: ArrayLike, *, status: bool = False, progress: Optional[Progress] = None,
                      threads: Optional[int] = None) -> Any:
        """Target -> source; otherwise as `apply`."""
        return self._apply(lib.map_apply_inverse, points, status, progress, threads)

    #: Calling a map is applying it, and `inverse` is `apply_inverse`.
    __call__ = apply
    inverse = apply_inverse

    def jacobian(self, points: ArrayLike, *, progress: Optional[Progress] = None,
                 threads: Optional[int] = None) -> Floats:
        """Derivatives (n, dim, dim) at points (n, dim) of the source's inside: entry [k, i, j] is that of
        image coordinate i by point coordinate j; NaN where there is none. Grids keep their shape, as in `apply`."""
        points, shape = grid_of(points, self.dim)
        n, dim = points.shape
        result = np.empty((*shape, dim, dim))
        env, done = bulk(n, progress, threads)
        done(lib.map_jacobian(self, n, address(points), address(result), None, None, env))
        return result

    def improve(self, iterations: int = 0, levels: int = 0, tolerance: float = 0, *,
                progress: Optional[Progress] = None,
                threads: Optional[int] = None) -> Tuple["Map", SimpleNamespace]:
        """A fairer map, and a report (kind mesh). If a progress callback asks to stop, it ends early,
        with the map reached so far. Without arguments the work of a call is limited; another goes on from there.

        Args:
            iterations: at most so many steps on each level; 0: 60
            levels: at most so many refinements; 0: 16; -1: none
            tolerance: the last level ends when a step gains less than this share of the energy; 0: 1e-4

        Returns:
            the map, and the members of ``icc_improve_report``
        """
        options = new("improve_options", iterations=iterations, levels=levels, tolerance=tolerance)
        call, out, report = Call(progress, threads), ctypes.c_void_p(), new("improve_report")
        call.check(lib.map_improve(ctypes.addressof(out), self, ctypes.addressof(options),
                                   ctypes.addressof(report), call.env, call.err))
        assert out.value is not None
        return type(self)._wrap(out.value), fields(report)

    def retarget(self, target: ShapeLike, iterations: int = 0, *, progress: Optional[Progress] = None,
                 threads: Optional[int] = None) -> "Map":
        """The map to a target that has moved, starting from this one (kind mesh, in 2-D or 3-D), improved by
        at most `iterations` steps (0: what a frame has time for; -1: none)."""
        with blaming(2):
            domain = as_domain(target)
        options = new("retarget_options", iterations=iterations)
        return type(self)._wrap(create(lib.map_retarget, self, domain, ctypes.addressof(options), progress=progress,
                                       threads=threads))

    def mesh(self) -> Tuple[Floats, Floats, Indices]:
        """The mesh of a map of kind mesh: vertices (n, dim), images (n, dim), simplices (m, dim + 1). The numbers are
        rounded; a ``RuntimeWarning`` says if that makes simplices flat or reversed (``report.n_spoilt``), as it can
        where shapes are about 1e9 times as far from the origin as they are large."""
        info = self._info("map_get_info", "map_info")
        n_spoilt = self.report.n_spoilt
        if n_spoilt > 0:
            warnings.warn(f"{n_spoilt} of {info.n_simplices} simplices are flat or reversed when rounded, because "
                          "the shape is so far from the origin; shift source and target to the origin",
                          RuntimeWarning, stacklevel=2)
        vertices = np.empty((info.n_vertices, info.dim))
        images = np.empty((info.n_vertices, info.dim))
        triangles = np.empty((info.n_simplices, info.dim + 1), dtype=np.uint32)
        mesh = mesh_of(vertices, triangles)
        check(lib.map_get_mesh(self, ctypes.addressof(mesh), address(images)))
        return vertices, images, triangles

    def to_proj(self, *, source_crs: Optional[Any] = None, target_crs: Optional[Any] = None) -> str:
        """The mesh of a map of kind mesh in the plane as a triangulation for PROJ, in JSON. From a file, PROJ
        applies it by ``+proj=tinshift +file=FILE``, and so do all that use PROJ: pyproj, GDAL, QGIS, PostGIS.

        Args:
            source_crs, target_crs: reference systems that are noted in it, such as "EPSG:2056" or a
                ``pyproj.CRS``; nothing is transformed by them
        """
        if self.dim != 2:
            raise ValueError(f"PROJ's triangulations are of the plane; this map has dimension {self.dim}")
        vertices, images, triangles = self.mesh()
        systems = {"input_crs": source_crs, "output_crs": target_crs}
        return json.dumps({
            "file_type": "triangulation_file", "format_version": "1.1",
            "publisher": "libicc " + lib.version().decode(),
            **{key: str(crs) for key, crs in systems.items() if crs is not None},
            "transformed_components": ["horizontal"], "fallback_strategy": "none",
            "vertices_columns": ["source_x", "source_y", "target_x", "target_y"],
            "triangles_columns": ["idx_vertex1", "idx_vertex2", "idx_vertex3"],
            "vertices": np.hstack([vertices, images]).tolist(), "triangles": triangles.tolist()})

    def _carry(self, function: Any, vertices: ArrayLike, simplices: ArrayLike, progress: Optional[Progress],
               threads: Optional[int]) -> Tuple[Floats, SimpleNamespace]:
        dim = self.dim
        vertices, simplices = points_of(vertices, dim), indices(simplices, dim + 1, "simplices")
        images, certificate, mesh = np.empty_like(vertices), new("certificate"), mesh_of(vertices, simplices)
        call = Call(progress, threads)
        call.check(function(self, ctypes.addressof(mesh), address(images), ctypes.addressof(certificate),
                            call.env, call.err))
        return images, fields(certificate)

    def certify(self, vertices: ArrayLike, simplices: ArrayLike, *, progress: Optional[Progress] = None,
                threads: Optional[int] = None) -> Tuple[Floats, SimpleNamespace]:
        """Maps the vertices of your mesh and checks its simplices exactly:
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

    def plot(self, *, lines: int = 25, axes: Optional[Sequence[Any]] = None, **style: Any) -> Any:
        """Draws a map of kind mesh in the plane with matplotlib: the source with a grid on the left, and on the right
        the target with what becomes of the grid.

        Args:
            lines: of the grid, along the longer side
            axes: two of matplotlib's axes to draw onto; None: new ones
            style: how the grid is drawn, as ``pyplot.plot`` takes it

        Returns:
            the axes
        """
        from ._plot import plot_map

        return plot_map(self, lines, axes, style)

    def __repr__(self) -> str:
        info = self.info
        word = "certified" if info.certified else "not certified"
        return f"<libicc.Map: {info.kind}, {info.dim}-D, {word}>"


def _ties(ties: Sequence[Tuple[Sequence[int], ArrayLike, ArrayLike]]) -> Tuple[Any, List[Floats]]:
    """An array of ``icc_tie``, and what it points to."""
    result, keep = (structs.tie * len(ties))(), []
    for tie, (vertices, source, target) in zip(result, ties):
        tie.size = ctypes.sizeof(structs.tie)
        tie.vertex[:] = vertices
        for side, bends in (("source", source), ("target", target)):
            points = points_of(np.reshape(np.asarray(bends, dtype=float), (-1, 2)), 2)
            setattr(tie, "n_" + side, len(points))
            setattr(tie, side, address(points))
            keep.append(points)
    return result, keep
