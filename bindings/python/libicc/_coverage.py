"""Layers of regions that share borders."""

from __future__ import annotations

import ctypes
import re
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Dict, Hashable, Iterable, Iterator, List, Optional, Tuple, Union

import numpy as np

from ._abi import lib, new, structs
from ._core import Handle, Progress, address, choose, create, fields, points_of
from ._domain import Domain
from ._errors import Error, check
from ._match import BETWEEN

if TYPE_CHECKING:
    from ._types import Floats

UNMATCHED = {"refuse": 1, "leave out": 2}
KINDS = {1: "region", 2: "border", 3: "island"}


class Coverage(Handle):
    """Two layers of the same regions, with common vertices: ``Map(coverage.source, coverage.target)``.

    >>> old = {"north": [[0, 1], [4, 1], [4, 2], [0, 2]], "south": [[0, 0], [4, 0], [4, 1], [0, 1]]}
    >>> new = {"south": [[0, 0], [4, 0], [4, 1], [2, 1.4], [0, 1]], "north": [[0, 1], [2, 1.4], [4, 1], [4, 2], [0, 2]]}
    >>> coverage = libicc.Coverage(old, new)
    >>> coverage.info.n_nodes, coverage.info.n_sides
    (2, 3)

    The layers may have different vertices. Regions are paired by their names, borders by the regions on both sides, and
    vertices along a border by its shape.

    Args:
        source, target: layers. A layer is a mapping from names to polygons, a GeoJSON FeatureCollection (a dict), or a
            GeoDataFrame. A polygon is a ring of vertices, a list of rings whose later ones are holes, a GeoJSON geometry,
            or a shapely Polygon or MultiPolygon. Several of one name are one region
        by: the property, or the column, that holds the names; None: the member ``id``, or the index
        weld: in the layers' coordinates: vertices within this length become one, and a vertex within this length of a
            side becomes part of it. A pair: one length for each layer. 0: only where this is exact
        unmatched: what happens to a border that only one layer has. "refuse": an error names it. "leave out": the
            regions at it are left out
        left_out: names of regions that are left out of both layers
        between: "elastic": pairs the vertices along borders by shape. "arc": by arc length
        progress, threads: as for `Domain`

    Raises:
        TopologyError if the layers differ; BoundaryError if regions of a layer overlap
    """

    _free = "coverage_free"

    def __init__(self, source: Any, target: Any, by: Optional[str] = None, *,
                 weld: Union[float, Tuple[float, float]] = 0, unmatched: Optional[str] = None,
                 left_out: Iterable[Hashable] = (), between: Optional[str] = None,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        layers = [list(_regions(layer, by)) for layer in (source, target)]
        left_out = list(left_out)
        self._names = _sorted({name for layer in layers for name, _ in layer} | set(left_out))
        number = {name: k for k, name in enumerate(self._names)}
        given = [_Layer(layer, number) for layer in layers]
        gone = np.array([number[name] for name in left_out], dtype=np.int64)
        options = new("coverage_options", between=choose(between, BETWEEN, "between"),
                      unmatched=choose(unmatched, UNMATCHED, "unmatched"), n_left_out=len(gone),
                      left_out=address(gone))
        options.weld[:] = np.broadcast_to(np.asarray(weld, dtype=float), 2).tolist()
        try:
            self._take(create(lib.coverage_create, given[0].address, given[1].address, ctypes.addressof(options),
                              progress=progress, threads=threads))
        except Error as error:
            error.args = (_with_names(str(error), self._names),)
            raise

    @property
    def source(self) -> Domain:
        """The source with the common vertices. Each ring is a feature."""
        return Domain._wrap(lib.coverage_source(self), self)

    @property
    def target(self) -> Domain:
        """The target with the common vertices."""
        return Domain._wrap(lib.coverage_target(self), self)

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_coverage_info``. Of arrays, the first half belongs to the source."""
        info = new("coverage_info")
        check(lib.coverage_get_info(self, ctypes.addressof(info)))
        return fields(info)

    @property
    def regions(self) -> List[Hashable]:
        """The name of each feature's region."""
        ids = np.empty(self.info.n_features, dtype=np.int64)
        check(lib.coverage_get_ids(self, address(ids)))
        return [self._names[k] for k in ids]

    @property
    def rings(self) -> List[Tuple[Hashable, bool, Floats, Floats]]:
        """For each feature the name of its region, whether it is a hole, and its vertices in source and target."""
        pointers = [ctypes.c_void_p(), ctypes.c_void_p()]
        check(lib.coverage_get_features(self, *(ctypes.addressof(pointer) for pointer in pointers)))
        result, regions = [], self.regions
        both = [(structs.feature * len(regions)).from_address(pointer.value or 0) for pointer in pointers]
        for name, a, b in zip(regions, *both):
            rings = [np.ctypeslib.as_array(ctypes.cast(f.vertices, ctypes.POINTER(ctypes.c_double)),
                                           (f.n_vertices, 2)).copy() for f in (a, b)]
            result.append((name, a.kind == 1, rings[0], rings[1]))
        return result

    @property
    def differences(self) -> List[SimpleNamespace]:
        """What only one layer has. Each has a ``kind`` ("region", "border" or "island"), a ``side`` (1: only the source
        has it, 2: only the target), ``regions`` with one or two names, and a ``place`` in that layer."""
        result = []
        for k in range(self.info.n_differences):
            one = new("coverage_difference")
            check(lib.coverage_get_difference(self, k, ctypes.addressof(one)))
            result.append(SimpleNamespace(kind=KINDS[one.kind], side=one.side, place=tuple(one.place),
                                          regions=tuple(self._names[name] for name in one.ids[:one.n_ids])))
        return result

    def __repr__(self) -> str:
        info = self.info
        return f"<libicc.Coverage: {info.n_regions} regions, {info.n_nodes} nodes, {info.n_vertices} vertices>"


class _Layer:
    """An icc_layer, and the arrays that it points to."""

    def __init__(self, regions: List[Tuple[Hashable, Any]], number: Dict[Hashable, int]):
        rings, ids, holes = [], [], []
        for name, polygon in regions:
            for k, ring in enumerate(polygon):
                points = points_of(ring, 2, f"a ring of {name}")
                rings.append(points[:-1] if len(points) > 1 and (points[0] == points[-1]).all() else points)
                ids.append(number[name])
                holes.append(k > 0)
        self.vertices = np.concatenate(rings) if rings else np.empty((0, 2))
        self.first = np.cumsum([0, *map(len, rings)]).astype(np.uintp)
        self.ids, self.holes = np.array(ids, dtype=np.int64), np.array(holes, dtype=np.uint8)
        self.struct = new("layer", n_rings=len(rings), first=address(self.first), vertices=address(self.vertices),
                          ids=address(self.ids), holes=address(self.holes))
        self.address = ctypes.addressof(self.struct)


def _sorted(names: Any) -> List[Hashable]:
    try:
        return sorted(names)
    except TypeError:
        return sorted(names, key=lambda name: (type(name).__name__, str(name)))


def _with_names(message: str, names: List[Hashable]) -> str:
    """A message with names instead of the numbers of regions."""
    def name(match: Any) -> str:
        return str(names[int(match.group())])
    return re.sub(r"\bregions? -?\d+(?: and -?\d+)?", lambda match: re.sub(r"-?\d+", name, match.group()), message)


def _regions(layer: Any, by: Optional[str]) -> Iterator[Tuple[Hashable, Any]]:
    """The polygons of a layer with their names: lists of rings."""
    if isinstance(layer, dict) and layer.get("type") == "FeatureCollection":
        for feature in layer["features"]:
            owner = feature if by is None else feature.get("properties") or {}
            key = by or "id"
            if key not in owner:
                raise ValueError(f"a feature has no {'property' if by else 'member'} {key!r}")
            for polygon in _polygons(feature["geometry"]):
                yield owner[key], polygon
        return
    if hasattr(layer, "geometry"):
        names = layer.index if by is None else layer[by]
        items: Any = zip(names, layer.geometry)
    else:
        items = layer.items()
    for name, shape in items:
        for polygon in _polygons(shape):
            yield name, polygon


def _polygons(shape: Any) -> List[Any]:
    if isinstance(shape, dict):
        kind, rings = shape.get("type"), shape.get("coordinates", ())
        if kind not in ("Polygon", "MultiPolygon"):
            raise ValueError(f"a region must be a Polygon or a MultiPolygon, not a {kind}")
        return [rings] if kind == "Polygon" else list(rings)
    if hasattr(shape, "geom_type"):
        parts = getattr(shape, "geoms", (shape,))
        return [[np.asarray(ring.coords)[:, :2] for ring in (part.exterior, *part.interiors)] for part in parts]
    is_ring = np.ndim(shape[0][0]) == 0
    return [[shape] if is_ring else shape]
