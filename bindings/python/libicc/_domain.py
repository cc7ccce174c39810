"""Domains: shapes, made from anything that describes one."""

from __future__ import annotations

import ctypes
import os
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Iterable, List, Literal, Optional, Tuple, overload

import numpy as np

from ._abi import lib, new, structs
from ._core import (
    Call,
    Handle,
    Progress,
    address,
    bulk,
    coordinates,
    create,
    dimension,
    fields,
    indices,
    is_geometry,
    mesh_of,
    name_of,
    parts_of,
    points_of,
)
from ._errors import blaming, check
from ._solid import make_solid, solid_features, solid_features_in_order, split_quads, triangles_of

if TYPE_CHECKING:
    from ._types import ArrayLike, Bools, Floats, Indices, Ints, ShapeLike

FEATURES = {"hole": 1, "line": 2, "point": 3, "region": 4}
DEFECTS = {"not finite": 1, "repeated": 2, "spike": 3, "crossing": 4, "touch": 5, "flat": 6}

_MAX_DIM = 6
_SHAPES = ("a Domain, an array of the vertices of an outline in their order, a pair (vertices, facets), a boolean mask, a "
           "polygon of shapely, geopandas or GeoJSON (a dict), or a mesh of meshio")

_SOLID_CELLS = ("tetra", "hexahedron", "wedge", "pyramid", "VTK_LAGRANGE")
"""How meshio's names of cells that fill space begin."""

INSIDE, BOUNDARY, OUTSIDE = 1, 2, 3
"""Where a point lies: see `Domain.locate`."""


class Domain(Handle):
    """A shape: its boundary, and what lies inside.

    >>> shape = libicc.Domain([[0, 0], [4, 0], [4, 3], [0, 3]], holes=[[[1, 1], [1, 2], [2, 2], [2, 1]]])
    >>> shape
    <libicc.Domain: 2-D, 8 vertices, 8 facets>
    >>> shape.locate([[3, 1], [1.5, 1.5], [4, 1]]).tolist() == [libicc.INSIDE, libicc.OUTSIDE, libicc.BOUNDARY]
    True

    Args:
        vertices: float array of shape (n, dim). A polygon without facets may be a closed ring, whose last vertex
            repeats the first. It may also be a shapely Polygon, LinearRing or MultiPolygon, the same as GeoJSON (a
            dict), or a GeoSeries or GeoDataFrame with one row. Their holes come before those of ``holes``, and heights
            are left out. Each polygon of a MultiPolygon of several becomes a region with its holes. A boolean array is a
            mask, as in `from_mask`. None: no outline, if there are regions.
        facets: int array of shape (m, dim): vertex indices of the boundary's edges (2-D), triangles (3-D) and so on. In
            2-D you may leave it out for a polygon through the vertices in order. In 3-D facets may be quadrilaterals
            (m, 4), which are split from their first vertex
        regions: polygons that are part of the shape: further outlines, or islands in holes
        holes: polygons inside a polygon that are not part of the shape; only without ``facets``
        lines: polylines inside it, (n, 2) each; two vertices make a bone
        voids: closed surfaces inside a solid in 3-D that bound holes: pairs of vertices (n, 3) and triangles (m, 3)
        surfaces: closed surfaces inside a solid, with the solid on both sides: pairs as for voids. A solid comes with
            ``facets``. Its lines and points have 3 coordinates, and its features are numbered in the order voids,
            surfaces, lines, points
        points: points inside it, (n, 2). Features are numbered in this order: regions, holes, lines, points. A `Map` of
            kind "mesh" takes each feature to the one of the same number, vertex by vertex. Other kinds refuse features.
        radii: sizes of points, one for each or the same for all; 0: no size. The circle around a point with a size
            moves along and may grow or shrink, but does not turn. It becomes a line of 16 vertices, which follows all
            other features.
        features: instead of these: pairs of a kind ("region", "hole", "line" or "point") and vertices, in the order of
            their numbers. This is the form of another domain's `features`, so you can build a domain again,
            including the circles of radii. Surfaces of a solid are "hole" and "region", with pairs instead of vertices.
        progress, threads: see `libicc.Progress`. There is one thread per processor by default. Results are the same for
            every number

    Raises:
        BoundaryError, TopologyError, OutsideError: ``index`` is the vertex, facet or feature at fault
    """

    _free = "domain_free"

    def __init__(self, vertices: Optional[ArrayLike], facets: Optional[ArrayLike] = None, *,
                 regions: Iterable[ArrayLike] = (), holes: Iterable[ArrayLike] = (), lines: Iterable[ArrayLike] = (),
                 points: Optional[ArrayLike] = None, radii: Optional[ArrayLike] = None,
                 voids: Iterable[Any] = (), surfaces: Iterable[Any] = (),
                 features: Optional[Iterable[Tuple[str, Any]]] = None,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        facets = triangles_of(vertices, facets)
        regions, holes, lines = list(regions), list(holes), list(parts_of(lines) if is_geometry(lines) else lines)
        voids, surfaces = list(voids), list(surfaces)
        if facets is not None and vertices is not None and np.ndim(vertices) == 2 and np.shape(vertices)[1] == 3:
            own_solid = solid_features(voids, surfaces, lines, points)
            if features is not None:
                if own_solid:
                    raise ValueError("features come instead of voids, surfaces, lines and points")
                own_solid = solid_features_in_order(features)
            if regions or holes or radii is not None:
                raise ValueError("a solid has voids and surfaces instead of holes, regions and radii")
            self._take(make_solid(vertices, facets, own_solid, progress, threads))
            return
        if voids or surfaces:
            raise ValueError("voids and surfaces lie in a solid, which has facets and vertices of 3 coordinates")
        has_outline = vertices is not None or not (regions or features is not None)
        vertices = _plain(vertices) if has_outline else np.empty((0, 2))
        has_features = bool(regions or holes or lines or features is not None or np.size(() if points is None else points))
        if has_features and facets is not None:
            raise ValueError("a boundary of facets has no holes, lines or points inside: these are for polygons in the "
                             "plane, which come without facets")
        if facets is None and isinstance(vertices, np.ndarray) and vertices.dtype == bool:
            if has_features:
                raise ValueError("a mask has no holes, lines or points: its cells say what is inside")
            self._take(_of_mask(vertices, progress, threads))
            return
        several = _regions_of(vertices)
        own = several + _features(regions, [*([] if several else _holes_of(vertices)), *holes], lines, points)
        n_points = sum(kind == "point" for kind, _ in own)
        if features is not None:
            if own or radii is not None:
                raise ValueError("features come instead of holes, lines, points and radii")
            own = _features_in_order(features)
        try:
            sizes = np.broadcast_to(np.asarray(0.0 if radii is None else radii, dtype=np.float64), n_points)
        except ValueError:
            raise ValueError(f"radii must be a number or one for each of the {n_points} points") from None
        if own:
            outer = np.empty((0, 2)) if several else _outline(vertices, True)
            self._take_features(points_of(outer, 2, "the vertices of a polygon with features"), own, sizes, progress,
                                threads)
            return
        given = getattr(vertices, "shape", None)
        vertices = _outline(vertices) if facets is None else np.ascontiguousarray(vertices, dtype=np.float64)
        if vertices.ndim != 2 or vertices.shape[1] > _MAX_DIM:
            raise ValueError(f"vertices must have the shape (n, dim), with dim up to {_MAX_DIM}, not {given}; a mask is "
                             "taken by Domain.from_mask")
        n, dim = vertices.shape
        facets = None if facets is None else indices(facets, dim, "facets")
        self._take(create(lib.domain_create, dim, n, address(vertices),
                          0 if facets is None else len(facets), address(facets),
                          progress=progress, threads=threads))

    def _take_features(self, outer: Floats, features: List[Tuple[str, Floats]], radii: Floats,
                       progress: Optional[Progress], threads: Optional[int]) -> None:
        all_features = (structs.feature * len(features))()
        for feature, (kind, vertices) in zip(all_features, features):
            feature.size = ctypes.sizeof(structs.feature)
            feature.kind, feature.n_vertices = FEATURES[kind], len(vertices)
            feature.vertices = address(vertices)
        for feature, radius in zip(all_features[len(features) - len(radii):], radii):  # points come last
            feature.radius = radius
        self._take(create(lib.domain_create_features, len(outer), address(outer), len(features),
                          ctypes.addressof(all_features), progress=progress, threads=threads))

    @classmethod
    def from_mask(cls, mask: ArrayLike, *, progress: Optional[Progress] = None,
                  threads: Optional[int] = None) -> "Domain":
        """Makes a domain from the cells of a mask that are true. Cell (i, j, ..) covers [i, i + 1] x [j, j + 1] x ..,
        so axis k of the array is coordinate k."""
        return cls._wrap(_of_mask(np.asarray(mask), progress, threads))

    @classmethod
    def from_mesh(cls, vertices: ArrayLike, simplices: ArrayLike, facets: Optional[ArrayLike] = None, *,
                  regions: Optional[ArrayLike] = None, progress: Optional[Progress] = None,
                  threads: Optional[int] = None) -> "Domain":
        """Makes a domain with a conforming mesh of its inside. Method foliation works on it in every dimension.

        Args:
            vertices: (n, dim)
            simplices: (m, dim + 1) vertex indices
            facets: (k, dim) vertex indices of the boundary, in any order; or None
            regions: a number for each tetrahedron, or None. The surfaces between different numbers become features of
                kind "region", which a `Map` keeps; see `mesh_regions`
        """
        vertices = np.ascontiguousarray(vertices, dtype=np.float64)
        if vertices.ndim != 2:
            raise ValueError(f"vertices must have the shape (n, dim), not {vertices.shape}")
        dim = vertices.shape[1]
        simplices = indices(simplices, dim + 1, "simplices")
        facets = None if facets is None else indices(facets, dim, "facets")
        mesh = mesh_of(vertices, simplices)
        if regions is not None:
            numbers = np.ascontiguousarray(regions, dtype=np.int32)
            if numbers.shape != (len(simplices),):
                raise ValueError(f"regions must have the shape ({len(simplices)},), not {numbers.shape}")
            mesh.regions = address(numbers)
        return cls._wrap(create(lib.domain_create_mesh, ctypes.addressof(mesh), 0 if facets is None else len(facets),
                                address(facets), progress=progress, threads=threads))

    def filled(self, *, ratio: float = 0.0, max_points: int = 0, progress: Optional[Progress] = None,
               threads: Optional[int] = None) -> "Domain":
        """Fills this surface in 3-D with tetrahedra. Its vertices and facets stay, and vertices are added inside.

        Args:
            ratio: tetrahedra are refined until the circumradius is at most this many shortest edges; 0: the default
            max_points: refinement ends at this number of inner vertices; 0: no limit
        """
        options = structs.fill_options(ratio=ratio, max_points=max_points)
        options.size = ctypes.sizeof(options)
        return self._wrap(create(lib.domain_fill, self, ctypes.addressof(options), progress=progress,
                                 threads=threads))

    @property
    def mesh(self) -> Tuple[Floats, Indices]:
        """Copies of the vertices of the mesh of the inside, boundary vertices first, and of its simplices."""
        info = self._info("domain_get_info", "domain_info")
        vertices = np.empty((info.n_mesh_vertices, info.dim))
        simplices = np.empty((info.n_mesh_simplices, info.dim + 1), dtype=np.uint32)
        mesh = mesh_of(vertices, simplices)
        check(lib.domain_get_mesh(self, ctypes.addressof(mesh)))
        return vertices, simplices

    @property
    def mesh_regions(self) -> Indices:
        """The region of each simplex of the mesh: 0, or k within the k-th feature of kind "region" of a solid."""
        regions = np.empty(self._info("domain_get_info", "domain_info").n_mesh_simplices, dtype=np.uint32)
        check(lib.domain_get_regions(self, address(regions)))
        return regions

    @property
    def info(self) -> SimpleNamespace:
        """dim, orientation, n_vertices, n_facets, lower, upper, measure, n_features,
        n_mesh_vertices, n_mesh_simplices, n_junctions, n_pieces, n_faces, n_voids, genus, n_holes, n_lines, n_points,
        n_regions."""
        info = self._info("domain_get_info", "domain_info")
        return fields(info, info.dim)

    dim = dimension("domain_get_info", "domain_info")

    @property
    def vertices(self) -> Floats:
        """A copy of the vertices, (n, dim); those of the features come last."""
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

    @property
    def features(self) -> List[Tuple[str, Any]]:
        """The features, in order: "region", "hole", "line" or "point", and its vertices. A surface of a solid has a pair
        of vertices and triangles, in its own numbers."""
        vertices, features = self.vertices, []
        facets = self.facets if self.dim == 3 else np.empty((0, 3), dtype=np.uint32)
        for number in range(self._info("domain_get_info", "domain_info").n_features):
            info = new("feature_info")
            check(lib.domain_get_feature(self, number, ctypes.addressof(info)))
            own: Any = vertices[info.first_vertex:info.first_vertex + info.n_vertices]
            if self.dim == 3 and info.n_facets > 0:
                own = own, facets[info.first_facet:info.first_facet + info.n_facets] - np.uint32(info.first_vertex)
            features.append((name_of(info.kind, FEATURES) or "", own))
        return features

    @overload
    def locate(self, points: ArrayLike, *, nearest: Literal[False] = ..., progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Ints: ...
    @overload
    def locate(self, points: ArrayLike, *, nearest: Literal[True], progress: Optional[Progress] = ...,
               threads: Optional[int] = ...) -> Tuple[Ints, Indices, Floats]: ...

    def locate(self, points: ArrayLike, *, nearest: bool = False, progress: Optional[Progress] = None,
               threads: Optional[int] = None) -> Any:
        """Reports where points lie: an int32 array of INSIDE, BOUNDARY and OUTSIDE.

        With ``nearest`` it also returns the nearest facets (n,) and the barycentric coordinates (n, dim) of the nearest
        boundary points.
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

    @property
    def bounds(self) -> Tuple[float, ...]:
        """The smallest and then the largest coordinates, in the order of shapely's ``bounds``."""
        info = self.info
        return (*info.lower.tolist(), *info.upper.tolist())

    @property
    def __geo_interface__(self) -> Any:
        """A shape in the plane as a Polygon or MultiPolygon of GeoJSON, for ``shapely.geometry.shape`` and others. Lines
        and points inside are left out."""
        if self.dim != 2:
            raise AttributeError(f"GeoJSON is of the plane; this domain has dimension {self.dim}")
        from ._rings import geojson_of

        return geojson_of(self.vertices, self.facets)

    def plot(self, *, axis: Optional[Any] = None, **style: Any) -> Any:
        """Draws the shape with matplotlib, in the plane or in space, and what lies inside in the plane.

        Args:
            axis: a matplotlib axis to draw onto, in space with projection="3d"; None: a new one
            style: how the outline is drawn, as ``pyplot.plot`` takes it; in space how faces are drawn

        Returns:
            the axis
        """
        from ._plot import plot_domain

        return plot_domain(self, axis, style)

    def _repr_svg_(self) -> Optional[str]:
        from ._show import draw_domain

        return draw_domain(self)

    def __repr__(self) -> str:
        info = self.info
        return f"<libicc.Domain: {info.dim}-D, {info.n_vertices} vertices, {info.n_facets} facets>"


def as_domain(shape: ShapeLike) -> Domain:
    """Makes a domain from anything that describes one.

    >>> libicc.as_domain(numpy.ones((3, 2), dtype=bool)).info.measure
    6.0

    It takes a Domain; anything that `Domain` takes, such as an array of polygon vertices, a polygon of shapely,
    geopandas or GeoJSON (a dict), or a boolean mask; a pair (vertices, facets); or a meshio Mesh. A meshio Mesh of
    triangles or quads in space is a surface. One of triangles or quads in the plane, or of tetrahedra, is a conforming
    mesh. The name of a file is one that the front reads, such as "county.gpkg" (docs/howto/formats.md).
    """
    if isinstance(shape, Domain):
        return shape
    if isinstance(shape, (str, os.PathLike)):
        return as_domain(_from_file(shape))
    if hasattr(shape, "cells_dict"):
        return _from_meshio(shape)
    if isinstance(shape, tuple) and len(shape) == 2 and np.ndim(shape[0]) == 2:
        return Domain(*shape)
    return Domain(shape)


def _from_file(path: Any) -> Any:
    """A shape from a file."""
    from . import front

    try:
        return front.read(path, front.CAGES).outline()
    except front.FileError as error:
        raise ValueError(str(error)) from None


def as_domains(source: ShapeLike, target: ShapeLike) -> Tuple[Domain, Domain]:
    """Makes both domains of a pair. Errors say which one is at fault."""
    with blaming(1):
        first = as_domain(source)
    with blaming(2):
        return first, as_domain(target)


def _of_mask(mask: Bools, progress: Optional[Progress], threads: Optional[int]) -> int:
    """A new object of the library for the solid of the cells of a mask."""
    cells = np.asfortranarray(mask != 0).view(np.uint8)
    shape = (ctypes.c_size_t * mask.ndim)(*mask.shape)
    return create(lib.domain_create_mask, mask.ndim, ctypes.addressof(shape), cells.ctypes.data, progress=progress,
                  threads=threads)


def _plain(shape: Any) -> Any:
    """An array, or one of shapely's geometries, or what looks like one."""
    if hasattr(shape, "iloc") and hasattr(shape, "geometry"):  # a GeoSeries or a GeoDataFrame
        if len(shape) != 1:
            raise ValueError(f"the {type(shape).__name__} has {len(shape)} rows; choose one: shape.geometry.iloc[0]")
        return shape.geometry.iloc[0]
    if is_geometry(shape):
        return shape
    if isinstance(shape, dict) or hasattr(shape, "__geo_interface__"):
        return _from_geojson(shape if isinstance(shape, dict) else shape.__geo_interface__)
    if isinstance(shape, (str, os.PathLike)):
        raise TypeError(f"a Domain is not made of the name of a file; libicc.as_domain({str(shape)!r}) reads it")
    try:
        array = np.asarray(shape)
        return array if array.dtype == bool else np.ascontiguousarray(array, dtype=np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"a shape may be {_SHAPES}; this {type(shape).__name__} is none of these") from None


def _from_geojson(tree: Any) -> Any:
    """The polygon of a GeoJSON object, as `is_geometry` knows one."""
    kind = tree.get("type")
    if kind == "FeatureCollection" and len(tree.get("features", ())) == 1:
        return _from_geojson(tree["features"][0])
    if kind == "Feature" and tree.get("geometry"):
        return _from_geojson(tree["geometry"])
    rings = tree.get("coordinates", ())
    if kind == "MultiPolygon" and len(rings) > 1:
        return SimpleNamespace(geom_type=kind, geoms=[_from_geojson({"type": "Polygon", "coordinates": polygon})
                                                      for polygon in rings])
    if kind == "MultiPolygon" and len(rings) == 1:
        kind, rings = "Polygon", rings[0]
    if kind != "Polygon" or len(rings) == 0:
        raise ValueError(f"this {kind or 'dict'} is no shape; of GeoJSON, a shape is a Polygon or MultiPolygon, or a "
                         "Feature with one")
    outer, *holes = (SimpleNamespace(coords=ring) for ring in rings)
    return SimpleNamespace(geom_type=kind, exterior=outer, interiors=holes)


def _features(regions: Iterable[ArrayLike], holes: Iterable[ArrayLike], lines: Iterable[ArrayLike],
              points: Optional[ArrayLike]) -> List[Tuple[str, Floats]]:
    """The features inside: kinds and vertices."""
    features = [("region", points_of(_outline(region), 2)) for region in regions]
    features += [("hole", points_of(_outline(hole), 2)) for hole in holes]
    features += [("line", points_of(line, 2)) for line in lines]
    if points is not None and not (isinstance(points, (list, tuple)) and len(points) == 0):
        features += [("point", point.reshape(1, 2)) for point in points_of(points, 2)]
    return features


def _features_in_order(features: Iterable[Tuple[str, ArrayLike]]) -> List[Tuple[str, Floats]]:
    """The features that are given in order, with vertices as arrays."""
    result = []
    for number, (kind, vertices) in enumerate(features):
        if kind not in FEATURES:
            raise ValueError(f"feature {number} must be one of {', '.join(FEATURES)}, not {kind!r}")
        result.append((kind, points_of(np.reshape(vertices, (1, 2)) if kind == "point" else vertices, 2)))
    return result


def _regions_of(shape: Any) -> List[Tuple[str, Floats]]:
    """The polygons of a geometry of several, as regions with holes."""
    parts = parts_of(shape) if is_geometry(shape) else []
    features: List[Tuple[str, Floats]] = []
    for part in parts if len(parts) > 1 and all(_kind_of(part) == "Polygon" for part in parts) else ():
        features += _features([part.exterior], part.interiors, (), None)
    return features


def _holes_of(shape: Any) -> List[Any]:
    """The holes of a shapely polygon."""
    parts = parts_of(shape) if is_geometry(shape) else []
    return list(getattr(parts[0], "interiors", ())) if len(parts) == 1 else []


def _outline(shape: ArrayLike, without_holes: bool = False) -> Floats:
    """The vertices of a polygon, each once."""
    if is_geometry(shape):
        shape = _ring_of(shape, without_holes)
    vertices = np.ascontiguousarray(shape, dtype=np.float64)
    is_closed = vertices.ndim == 2 and len(vertices) > 3 and (vertices[0] == vertices[-1]).all()
    return vertices[:-1] if is_closed else vertices


def _ring_of(shape: Any, without_holes: bool) -> Floats:
    """The outline of a shapely geometry, without heights."""
    parts = parts_of(shape)
    if len(parts) != 1:
        raise ValueError(f"the {_kind_of(shape)} has {len(parts)} parts; make one map for each part")
    part = parts[0]
    if not without_holes and len(getattr(part, "interiors", ())) > 0:
        raise ValueError("the polygon has holes")
    if _kind_of(part) in ("Point", "MultiPoint", "MultiLineString"):
        raise ValueError(f"a {_kind_of(part)} is no outline; a domain is made of a Polygon")
    return coordinates([getattr(part, "exterior", part)])[:, :2]


def _kind_of(shape: Any) -> str:
    return getattr(shape, "geom_type", type(shape).__name__)


def _from_meshio(mesh: Any) -> Domain:
    points, cells = np.asarray(mesh.points, dtype=np.float64), mesh.cells_dict
    solid = [kind for kind in cells if kind.startswith(_SOLID_CELLS)]
    if solid == ["tetra"]:
        return Domain.from_mesh(points, cells["tetra"])
    if solid:
        raise ValueError(f"the mesh has cells of the kind {', '.join(solid)}; a shape is made of tetrahedra alone, or of "
                         "triangles and quads. Take the surface of the mesh, or carry all its points by a map of the "
                         "surface: mapping(mesh.points)")
    triangles = [cells["triangle"]] if "triangle" in cells else []
    triangles += [split_quads(cells["quad"])] if "quad" in cells else []
    if not triangles:
        raise ValueError(f"the mesh has {', '.join(cells) or 'no cells'}; a shape is made of tetrahedra, triangles or quads")
    flat = points.shape[1] == 2 or not points[:, 2].any()
    joined = np.concatenate(triangles)
    return Domain.from_mesh(points[:, :2], joined) if flat else Domain(points, joined)


def boundary_defects(vertices: ArrayLike) -> List[Tuple[str, int, int]]:
    """Lists the defects that keep a closed polygon (n, 2) from being a boundary, as (kind, a, b).

    >>> libicc.boundary_defects([[0, 0], [2, 2], [2, 0], [0, 2]])
    [('crossing', 0, 2)]
    """
    vertices = points_of(_outline(vertices), 2)
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
    """Repairs a mask in which cells touch only along an edge or a corner. Returns the repaired mask and the number of
    cells that were filled.

    >>> mended, n = libicc.repair_mask([[1, 0], [0, 1]])
    >>> int(mended.sum()), n
    (3, 1)
    """
    mask = np.asarray(mask)
    cells = np.array(mask != 0, order="F").view(np.uint8)
    shape = (ctypes.c_size_t * mask.ndim)(*mask.shape)
    call, n = Call(threads=1), ctypes.c_size_t()
    call.check(lib.mask_repair(mask.ndim, ctypes.addressof(shape), cells.ctypes.data,
                               ctypes.addressof(n), call.env, call.err))
    return cells.view(bool), n.value
