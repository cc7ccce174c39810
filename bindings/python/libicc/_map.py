"""Maps from one domain to another."""

from __future__ import annotations

import ctypes
import json
import warnings
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, List, Literal, Optional, Sequence, Tuple, Union, overload

import numpy as np

from ._abi import lib, new, plain, structs
from ._chart import Chart, chart_options
from ._core import (
    Call,
    Handle,
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
from ._domain import Domain, as_domain, as_domains
from ._errors import blaming, check, fail
from ._field import Field, field_of
from ._match import match_for
from ._transform import Transform

if TYPE_CHECKING:
    from ._types import ArrayLike, Floats, Indices, Ints, ShapeLike

_PAIR = ctypes.c_double * 2
_ONE = ctypes.c_size_t(1)
_apply_plain = plain("map_apply")

KINDS = {"curves": 1, "mesh": 2}
SLIDES = {"all": 2}
REPAIRS = {"none": 0, "patches": 1, "whole": 2}


class Map(Transform, Saved):
    """A map from one domain to another that agrees with their boundaries.

    Facet i of the source goes to facet i of the target. Call the map with points, or use `apply`. You can also call it
    with x and y, with a geometry of shapely or with GeoJSON. To go back, use `apply_inverse`, or `inverse`, which is a
    map itself. ``second @ first`` is a map after a map.

    If you know only some points, such as control points, landmarks or pins, call `libicc.fit` instead. It needs no
    target outline. To make a warp of a mesh one-to-one, call `libicc.nearest`.

    >>> mapping = libicc.Map([[0, 0], [4, 0], [4, 3], [0, 3]], [[0, 0], [4, 1], [4, 4], [0, 3]])
    >>> mapping
    <libicc.Map: mesh, 2-D, certified>
    >>> mapping([[1, 1], [9, 9]]).round(6)
    array([[1.  , 1.25],
           [ nan,  nan]])
    >>> mapping.inverse([[1, 1.25]]).round(6)
    array([[1., 1.]])

    Args:
        source, target: Domains, or anything that `as_domain` takes. An array holds the vertices of an outline in order.
            Control points go inside an outline: ``Map(Domain(outline, points=a), Domain(outline, points=b))``
        kind: "mesh" (mesh map: in 2-D, and between surfaces in 3-D, which are filled if they have no mesh) or "curves"
            (curve map). None: the best available
        improve: mesh map: at most this many improvement steps on each level; None: as long as they pay off; 0: none
        method, cells, maximum, ...: options of the charts, see `Chart`. The maximum is the source's
        target_maximum: the target's maximum, (dim,), or None
        ties: paths that tell on which side features pass one another. In each part of the domain one less than it has
            pieces (`Domain.info`), or none. Each is (vertices, source, target): two vertices of the domain, and the
            bends (n, 2) of a path between them in each domain. Together they join the pieces of each part
        match: for outlines that do not correspond, which first get common vertices. True: by shape. "arc": by arc
            length. Landmarks (n, 2, 2) or (n, 4): by shape between these. See `Match`
        slide: True: vertices of lines and borders inside may slide along them if that lowers the energy. "all": those
            of the boundary as well. Ends, and places where three or more edges meet, stay partners
        progress, threads: as for `Domain`

    Raises:
        those of `Chart`; BoundaryError if the domains do not correspond. ``side`` says which one is at fault.
    """

    _free = "map_free"
    _name = "map"
    dim = dimension("map_get_info", "map_info")
    _repaired: Optional[SimpleNamespace] = None

    def __init__(self, source: ShapeLike, target: ShapeLike, kind: Optional[str] = None, *,
                 improve: Optional[int] = None, method: Optional[str] = None,
                 cells: Optional[int] = None, maximum: Optional[ArrayLike] = None,
                 target_maximum: Optional[ArrayLike] = None, function: Optional[str] = None,
                 constraints: Optional[str] = None, solver: Optional[str] = None,
                 tree: Optional[str] = None, min_fall: Optional[float] = None,
                 leaf_min: Optional[float] = None, axis_order: Optional[Sequence[int]] = None,
                 ties: Sequence[Tuple[Sequence[int], ArrayLike, ArrayLike]] = (),
                 match: Union[bool, str, ArrayLike, None] = None,
                 slide: Union[bool, str] = False,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        source, target = as_domains(source, target)
        if match is not None and match is not False:
            matched = match_for(source, target, match)
            source, target = matched.source, matched.target
        chart = chart_options(source.dim, method, cells, maximum, function, constraints, solver, tree,
                              min_fall, leaf_min, axis_order)
        options = new("map_options", kind=choose(kind, KINDS, "kind"), chart=ctypes.addressof(chart),
                      iterations=0 if improve is None else improve or -1,
                      slide=int(slide) if isinstance(slide, bool) else choose(slide, SLIDES, "slide"))
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
        """Makes the map between two charts of the same method; `kind` as for `Map`."""
        options = new("map_options", kind=choose(kind, KINDS, "kind"))
        return cls._wrap(create(lib.map_create_from_charts, source, target,
                                ctypes.addressof(options), progress=progress, threads=threads))

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_map_info``. The kind is given by name."""
        result = fields(self._info("map_get_info", "map_info"))
        result.kind = name_of(result.kind, KINDS)
        return result

    @property
    def report(self) -> SimpleNamespace:
        """How the map was made: the members of ``icc_map_report``. If `libicc.nearest` has made it, also those of
        ``icc_nearest_report``."""
        result = fields(self._info("map_get_report", "map_report"))
        vars(result).update(vars(self._repaired) if self._repaired else {})
        return result

    @property
    def ties(self) -> List[Tuple[Tuple[int, int], Floats, Floats]]:
        """Ties, which tell on which side features pass one another. As the argument ``ties`` they make a map that can
        be moved to this one while it stays one-to-one. Each has two vertices, its bends in the source and its bends in
        the target. Without features there are none."""
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
    def source(self) -> Domain:
        """The shape that the map starts from: the domain of its chart, or else that of its mesh."""
        chart = self.source_chart
        return Domain.from_mesh(*self.mesh()[::2]) if chart is None else chart.domain

    @property
    def target(self) -> Domain:
        """The shape that the map leads to, as `source`."""
        chart = self.target_chart
        return Domain.from_mesh(*self.mesh()[1:]) if chart is None else chart.domain

    @property
    def bounds(self) -> Tuple[float, ...]:
        """The smallest and then the largest coordinates of the source, in the order of shapely's ``bounds``."""
        chart = self.source_chart
        if chart is None:
            vertices = self.mesh()[0]
            low, high = vertices.min(axis=0), vertices.max(axis=0)
        else:
            info = chart.domain.info
            low, high = info.lower, info.upper
        return (*low.tolist(), *high.tolist())

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
        is_single = getattr(points, "dtype", None) == np.float32
        points, shape = grid_of(points, self.dim)
        n, dim = points.shape
        images = np.empty((*shape, dim))
        states = np.empty(shape, dtype=np.int32) if status else None
        env, done = bulk(n, progress, threads)
        done(function(self, n, address(points), address(images), address(states), None, env))
        if is_single:
            images = images.astype(np.float32)
        return (images, states) if status else images

    @overload
    def apply(self, points: ArrayLike, *, status: Literal[False] = ..., progress: Optional[Progress] = ...,
              threads: Optional[int] = ...) -> Floats: ...
    @overload
    def apply(self, points: ArrayLike, *, status: Literal[True], progress: Optional[Progress] = ...,
              threads: Optional[int] = ...) -> Tuple[Floats, Ints]: ...

    def apply(self, points: ArrayLike, *, status: bool = False, progress: Optional[Progress] = None,
              threads: Optional[int] = None) -> Any:
        """Maps points (n, dim) of the source to images (n, dim) in the target, NaN for points without an image. With
        ``status`` it also returns an int32 array (n,): 0, or the number of an `Error`. Other arrangements, such as
        grids (height, width, dim), keep their shape. Images of float32 are float32, others float64."""
        return self._apply(lib.map_apply, points, status, progress, threads)

    @overload
    def apply_inverse(self, points: ArrayLike, *, status: Literal[False] = ..., progress: Optional[Progress] = ...,
                      threads: Optional[int] = ...) -> Floats: ...
    @overload
    def apply_inverse(self, points: ArrayLike, *, status: Literal[True], progress: Optional[Progress] = ...,
                      threads: Optional[int] = ...) -> Tuple[Floats, Ints]: ...

    def apply_inverse(self, points: ArrayLike, *, status: bool = False, progress: Optional[Progress] = None,
                      threads: Optional[int] = None) -> Any:
        """Maps points of the target to the source; otherwise like `apply`."""
        return self._apply(lib.map_apply_inverse, points, status, progress, threads)

    def _take(self, handle: int, owner: Optional[Handle] = None) -> None:
        super()._take(handle, owner)
        self._pointer = ctypes.c_void_p(handle)

    def _one(self, x: float, y: float) -> Tuple[float, ...]:
        point = _PAIR(x, y)
        status = _apply_plain(self._pointer, _ONE, point, point, None, None, None)
        if status:
            fail(status)
        return point[0], point[1]

    def jacobian(self, points: ArrayLike, *, progress: Optional[Progress] = None,
                 threads: Optional[int] = None) -> Floats:
        """Derivatives (n, dim, dim) at points (n, dim) of the source's inside. Entry [k, i, j] is that of image
        coordinate i by point coordinate j, NaN where there is none. Grids keep their shape, as in `apply`."""
        points, shape = grid_of(points, self.dim)
        n, dim = points.shape
        result = np.empty((*shape, dim, dim))
        env, done = bulk(n, progress, threads)
        done(lib.map_jacobian(self, n, address(points), address(result), None, None, env))
        return result

    def improve(self, iterations: int = 0, levels: int = 0, tolerance: float = 0, *,
                progress: Optional[Progress] = None,
                threads: Optional[int] = None) -> Tuple["Map", SimpleNamespace]:
        """Makes a map of lower distortion from a mesh map. If a progress callback asks to stop, it ends early with the
        map reached by then. Without arguments the work of a call is limited, and another call continues from there.

        Args:
            iterations: at most this many steps on each level; 0: as long as they pay off
            levels: at most this many refinements; 0: as long as they pay off; -1: none
            tolerance: the last level ends when a step gains less than this share of the energy; 0: the default

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
        """Makes the map to a target that has moved. It starts from this one, which must be a mesh map, and improves it
        by at most `iterations` steps. 0: as many as suit an interactive frame. -1: none."""
        with blaming(2):
            domain = as_domain(target)
        options = new("retarget_options", iterations=iterations)
        return type(self)._wrap(create(lib.map_retarget, self, domain, ctypes.addressof(options), progress=progress,
                                       threads=threads))

    def mesh(self) -> Tuple[Floats, Floats, Indices]:
        """The mesh of a mesh map: vertices (n, dim), images (n, dim), simplices (m, dim + 1). The numbers are rounded.
        A ``RuntimeWarning`` says if that makes simplices flat or reversed (``report.n_spoilt``). It can happen if a
        shape is about 1e9 times as far from the origin as it is large."""
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

    def mesh_regions(self) -> Indices:
        """The region of each simplex of `mesh`: k within the k-th feature of kind "region" of the source, but not within
        a region inside it, and 0 elsewhere.

        >>> inner = [[0.2, 0.2], [0.6, 0.2], [0.6, 0.6], [0.2, 0.6]]
        >>> square = libicc.Domain([[0, 0], [1, 0], [1, 1], [0, 1]], regions=[inner])
        >>> vertices, images, simplices = libicc.Map(square, square).mesh()
        >>> regions = libicc.Map(square, square).mesh_regions()
        >>> a, b, c = vertices[simplices[regions == 1]].transpose(1, 2, 0)
        >>> sides = b - a, c - a
        >>> print(f"{(sides[0][0] * sides[1][1] - sides[0][1] * sides[1][0]).sum() / 2:.2f}")
        0.16
        """
        regions = np.empty(self._info("map_get_info", "map_info").n_simplices, dtype=np.uint32)
        call = Call(threads=1)
        call.check(lib.map_get_regions(self, address(regions), call.err))
        return regions

    def to_proj(self, *, source_crs: Optional[Any] = None, target_crs: Optional[Any] = None) -> str:
        """The mesh of a mesh map in the plane as a triangulation for PROJ, in JSON. Save it to a file, and PROJ applies
        it by ``+proj=tinshift +file=FILE``. So do programs that use PROJ, such as pyproj, GDAL, QGIS and PostGIS.

        Args:
            source_crs, target_crs: reference systems to record in it, such as "EPSG:2056" or a ``pyproj.CRS``. They
                transform nothing
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
        """Maps the vertices of your mesh in 2-D or 3-D and checks its simplices exactly. Returns the images (n, dim)
        and the members of ``icc_certificate``.

        Args:
            vertices: (n, dim)
            simplices: (m, dim + 1) vertex indices
        """
        return self._carry(lib.map_certify, vertices, simplices, progress, threads)

    def repair(self, vertices: ArrayLike, simplices: ArrayLike, *, progress: Optional[Progress] = None,
               threads: Optional[int] = None) -> Tuple[Floats, SimpleNamespace]:
        """Like `certify`, but moves images of inner vertices until no simplex is inverted, if possible."""
        return self._carry(lib.map_repair, vertices, simplices, progress, threads)

    def field(self, grid: Any, spacing: Any = 1.0, origin: Any = 0.0, *, inverse: bool = False, displacement: bool = True,
              outside: str = "nan", dtype: Any = np.float64, refine: int = 1, progress: Optional[Progress] = None,
              threads: Optional[int] = None) -> Field:
        """Samples the map on a regular grid, for programs that read displacement fields. `Field.certified` tells whether
        the sampled field folds, although the map does not.

        Args:
            grid: samples along each axis, or an image of nibabel, which has origin and spacing as well
            spacing: one number, one for each axis, or a matrix whose row k is one step along axis k
            origin: place of the first sample
            inverse: sample the inverse map, with places in the target, as programs want that resample images
            displacement: whether to store the way to the image; False: the image itself
            outside: what samples without an image get: "nan", "identity" (they stay), or "nearest" (they move as the
                nearest point of the boundary does)
            dtype: float64 or float32
            refine: if the field is not certified, try grids up to this many times finer
        """
        return field_of(self, grid, spacing, origin, inverse=inverse, displacement=displacement, outside=outside,
                        dtype=dtype, refine=refine, progress=progress, threads=threads)

    def warp(self, image: ArrayLike, out: Optional[ArrayLike] = None, **options: Any) -> Any:
        """Warps a picture, as `libicc.warp_image` does; the other arguments are the same."""
        from ._image import warp_image

        return warp_image(image, self, out, **options)

    def plot(self, *, lines: int = 25, axes: Optional[Sequence[Any]] = None, stretch: bool = False,
             **style: Any) -> Any:
        """Draws a mesh map with matplotlib: the source on the left, the target on the right. In the plane a grid shows
        how the inside moves. In space both surfaces are drawn.

        Args:
            lines: number of grid lines along the longer side
            axes: two matplotlib axes to draw onto, in space with projection="3d"; None: new ones
            stretch: colour each place of the target by the largest factor that lengths grow by there
            style: how the grid is drawn, as ``pyplot.plot`` takes it; in space how faces are drawn

        Returns:
            the axes
        """
        from ._plot import plot_map

        return plot_map(self, lines, axes, stretch, style)

    def to_html(self, *, source: str = "source", target: str = "target", y_down: bool = False) -> str:
        """A page for the browser, as ``libicc plot OUT.html`` writes it: both shapes, a slider from one to the other,
        stretch as colours, and in space a cut and the regions inside. For mesh maps in the plane and in space.

        >>> square = [[0, 0], [1, 0], [1, 1], [0, 1]]
        >>> page = libicc.Map(square, [[0, 0], [2, 0], [2, 1], [0, 1]]).to_html(target="twice as wide")
        >>> page[:15], "twice as wide" in page
        ('<!doctype html>', True)

        Args:
            source, target: what the page calls the shapes
            y_down: draw y downwards, as in pictures
        """
        from ._viewer import page_of

        return page_of(self, (source, target), y_down)

    def _repr_html_(self) -> Optional[str]:
        from ._show import show_map

        return show_map(self)

    def _repr_svg_(self) -> Optional[str]:
        from ._show import draw_map

        return draw_map(self)

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
