"""Maps from what is known only in part: control points, pins, a wall that moves, any warp of a mesh."""

from __future__ import annotations

import ctypes
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Iterable, List, Optional, Tuple, Union

import numpy as np

from ._abi import lib, new, structs
from ._core import Call, Handle, Progress, address, choose, create, fields, floats, indices, mesh_of, name_of, points_of
from ._domain import as_domain
from ._errors import check
from ._map import REPAIRS, Map

if TYPE_CHECKING:
    from ._types import Array, ArrayLike, Floats, Indices, ShapeLike

MODELS = {"spline": 1, "elastic": 2}
CONSTRAINTS = {"points": 1, "line": 2, "vertices": 3, "sliding": 4}


class _Fitted(Handle):
    """The ``icc_fit`` behind a `Fit`."""

    _free = "fit_free"


class Fit(Map):
    """A map that `libicc.fit` has made: a `Map` that also tells how far it is off its points.

    >>> mapping = libicc.fit([[0, 0], [4, 0], [4, 3], [0, 3]], [[1, 1], [9, 1], [9, 7], [1, 7]])
    >>> mapping
    <libicc.Fit: spline, 2-D, certified>
    >>> float(abs(mapping.residuals).max()) < 1e-9
    True

    Bytes and pickles keep the map alone. What comes back from them is a plain `Map`, and so is the result of `improve`
    and `retarget`.
    """

    _fit: _Fitted
    _targets: Floats

    def __init__(self, *_: Any, **__: Any) -> None:
        raise TypeError("a Fit is made by libicc.fit")

    @classmethod
    def _made(cls, handle: int, targets: Floats) -> "Fit":
        self = cls.__new__(cls)
        self._fit, self._targets = _Fitted._wrap(handle), targets
        self._take(lib.fit_map(self._fit), owner=self._fit)
        return self

    @classmethod
    def _wrap(cls, handle: int, owner: Optional[Handle] = None) -> Any:
        """Maps that are made from a fit are no fits."""
        return Map._wrap(handle, owner)

    def __reduce__(self) -> Any:
        return Map._unpickle, (self.to_bytes(),)

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_map_info`` and those of ``icc_fit_info``. The kind, the model and the repair are given
        by name. Distances are in units of the target."""
        result = super().info
        vars(result).update(vars(fields(self._fit._info("fit_get_info", "fit_info"))))
        result.model, result.repair = name_of(result.model, MODELS), name_of(result.repair, REPAIRS)
        return result

    @property
    def targets(self) -> Floats:
        """Where all items are wanted, (n, 2): points first, then the vertices of lines, then vertices, then sliding
        vertices."""
        return self._targets.copy()

    def _residuals(self, left_out: bool) -> Floats:
        result = np.empty_like(self._targets)
        check(lib.fit_get_residuals(self._fit, *((None, address(result)) if left_out else (address(result), None))))
        return result

    @property
    def residuals(self) -> Floats:
        """The image of each item minus its target, (n, 2), in the order of `targets`. Points without a tolerance have 0
        up to rounding, and sliding vertices have 0."""
        return self._residuals(False)

    @property
    def left_out(self) -> Floats:
        """Where the other points alone would take each point, minus its target, (n, 2). This is an honest estimate of
        the accuracy between the points. A wrong point stands out. NaN where it is not known: for items that are no
        points, and for the elastic model."""
        return self._residuals(True)

    def move(self, to: ArrayLike, *, progress: Optional[Progress] = None, threads: Optional[int] = None) -> "Fit":
        """Makes the fit to targets that have moved. It starts from this one and is made for dragging.

        Args:
            to: the new targets of the first items, such as all points, or of all items in the order of `targets`

        Raises:
            those of `libicc.fit`
        """
        to, targets = points_of(to, 2, "to"), self._targets.copy()
        if len(to) > len(targets):
            raise ValueError(f"to has {len(to)} points, but the fit has {len(targets)}")
        targets[:len(to)] = to
        return Fit._made(create(lib.fit_move, self._fit, address(targets), progress=progress, threads=threads), targets)

    def __repr__(self) -> str:
        info = self.info
        return f"<libicc.Fit: {info.model}, 2-D, {'certified' if info.certified else 'not certified'}>"


class _Constraints:
    """An array of ``icc_constraint``, what it points to, and the targets of all items."""

    def __init__(self) -> None:
        self._kept: List[Array] = []
        self._all: List[Any] = []
        self._targets: List[Floats] = []

    def add(self, kind: str, n: int, known: Floats, **arrays: Optional[Array]) -> None:
        """`known` are the targets, also where C finds them by itself."""
        self._kept += [array for array in arrays.values() if array is not None]
        self._all.append(new("constraint", kind=CONSTRAINTS[kind], n=n,
                             **{name: address(array) for name, array in arrays.items()}))
        self._targets.append(known)

    def array(self) -> Any:
        return (structs.constraint * len(self._all))(*self._all)

    def __len__(self) -> int:
        return len(self._all)

    @property
    def targets(self) -> Floats:
        return np.concatenate(self._targets)


def _pair(source: Any, target: Any, names: Tuple[str, str]) -> Tuple[Floats, Floats]:
    source, target = points_of(source, 2, names[0]), points_of(target, 2, names[1])
    if len(source) != len(target):
        raise ValueError(f"{names[0]} has {len(source)} points, but {names[1]} has {len(target)}")
    return source, target


def _spread(values: ArrayLike, shape: Tuple[int, ...], name: str) -> Floats:
    """Numbers of this shape, of which one may stand for all."""
    array = np.asarray(values, dtype=np.float64)
    try:
        return np.ascontiguousarray(np.broadcast_to(array, shape))
    except ValueError:
        raise ValueError(f"{name} must have the shape {shape}, not {array.shape}") from None


def _numbers(values: Any, name: str) -> Indices:
    return indices(np.atleast_1d(np.asarray(values)).reshape(-1, 1), 1, name).ravel()


def _add_sliding(constraints: _Constraints, sliding: Any, places: Optional[Floats]) -> None:
    is_pair = isinstance(sliding, tuple) and any(np.ndim(part) > 0 for part in sliding)
    given = sliding if is_pair else (sliding, None)
    if len(given) != 2:
        raise ValueError("sliding is a list of vertices, or a pair (vertices, directions)")
    numbers = _numbers(given[0], "sliding")
    if places is None:
        raise ValueError("sliding is for a domain or a mesh, which have vertices")
    if numbers.size and numbers.max() >= len(places):
        raise ValueError(f"sliding: there is no vertex {numbers.max()}, only {len(places)} vertices")
    along = None if given[1] is None else _spread(given[1], (len(numbers), 2), "directions")
    constraints.add("sliding", len(numbers), places[numbers], vertices=numbers, direction=along)


def _mesh(mesh: Any) -> Tuple[Floats, Indices]:
    """The arrays of a mesh of triangles or of quadrilaterals: a pair, or a mesh of meshio."""
    if hasattr(mesh, "cells_dict"):
        kinds = [kind for kind in ("triangle", "quad") if kind in mesh.cells_dict]
        if len(kinds) != 1:
            raise ValueError("the mesh needs cells of one kind: triangles or quadrilaterals")
        mesh = mesh.points[:, :2], mesh.cells_dict[kinds[0]]
    vertices, cells = mesh
    width = 4 if np.ndim(cells) == 2 and np.shape(cells)[1] == 4 else 3
    return points_of(vertices, 2, "the vertices of the mesh"), indices(cells, width, "cells")


def fit(points: Optional[ArrayLike] = None, to: Optional[ArrayLike] = None, domain: Optional[ShapeLike] = None, *,
        mesh: Optional[Any] = None, lines: Iterable[Tuple[ArrayLike, ArrayLike]] = (),
        vertices: Optional[Tuple[ArrayLike, ArrayLike]] = None,
        sliding: Union[None, ArrayLike, Tuple[ArrayLike, ArrayLike]] = None,
        tolerance: Optional[ArrayLike] = None, model: Optional[str] = None, box: Optional[ArrayLike] = None,
        margin: Optional[float] = None, smoothing: Optional[float] = None, reach: Optional[float] = None,
        stiffness: float = 0, cell_stiffness: Optional[ArrayLike] = None, cell: Optional[float] = None,
        contact: bool = True, progress: Optional[Progress] = None, threads: Optional[int] = None) -> Fit:
    """Makes a map of the plane from what you know of it, such as a few control points. libicc chooses the rest.

    Control points, also called landmarks or GCPs, on a map or a picture:

    >>> a = numpy.array([[10, 10], [90, 20], [80, 95], [15, 80], [50, 50]])
    >>> b = numpy.array([[12, 9], [95, 25], [80, 99], [10, 85], [50, 52]])
    >>> mapping = libicc.fit(a, b)
    >>> mapping.certified, numpy.allclose(mapping(a), b)
    (True, True)

    Pins in a figure, whose outline goes where it likes: ``libicc.fit(pins, places, outline)``. A mesh whose wall moves,
    with thin layers of cells along it: ``libicc.fit(mesh=(V, T), vertices=(wall, places), stiffness=1.5)``.

    Everything that is told exactly ends exactly at its target. The map is one-to-one, with a certificate.

    Args:
        points, to: (n, 2) each: points in the source and where they go. One gives a shift, two a similarity, three an
            affine map
        domain: what the map covers; anything that `as_domain` takes. Its outline is free except for `vertices` and
            `sliding`. It may have holes but no lines and points. None: a box around the points
        mesh: (vertices, cells), (n, 2) and (m, 3) triangles or (m, 4) convex quadrilaterals, or a mesh of meshio. It is
            kept as it is and may have holes. Quadrilaterals stay convex. It comes instead of `domain`
        lines: pairs (before, after) of polylines, (k, 2) each. Vertex goes to vertex, and each part along linearly. In
            a mesh they run along edges. Without a domain and mesh they may share vertices
        vertices: (numbers, places): vertices of the domain or the mesh, (k,), and where they go, (k, 2). An edge of the
            boundary goes along if both its ends are told
        sliding: vertices that may move along a straight line only: their numbers (k,), or a pair (numbers, directions)
            with directions (k, 2) or (2,). Without directions they move along the boundary, which must be straight
            there
        tolerance: spline: how far points may be off their targets, in units of the target: a number or (n,). None and
            0: not at all
        model: "spline" bends as little as possible. It takes points and lines and is for maps and pictures. "elastic"
            keeps the shape and size of every small piece and is for characters and moving meshes. None: spline without
            a domain and mesh, else elastic
        box: without a domain and mesh: (lower corner, upper corner) of what the map covers at least. None: the points
        margin: without a domain and mesh: how far the map reaches beyond the box, as a share of its longest side. None:
            chosen by leaving each point out in turn
        smoothing: spline: a factor for points with a tolerance, larger for smoother. None: chosen by leaving each point
            out in turn. 0: all points are exact
        reach: elastic: how far a point carries its surroundings along, a length in the source. None: as far as the mesh
            makes it, so a single point pulls a spike
        stiffness: elastic: triangles are stiffer by their area to the power of minus this number, from 0 to 3. With 1.5
            thin layers of cells move as if glued to their wall
        cell_stiffness: elastic, with a mesh: a further factor above 0 for each cell, (m,)
        cell: elastic: the longest edge of the mesh that libicc makes, a length in the source. None: chosen
        contact: elastic: parts of the free outline push each other away. False: the result is refused if they overlap
        progress, threads: as for `Domain`

    Returns:
        the map. It also has `Fit.residuals`, `Fit.left_out` and `Fit.move`. If an elastic shape cannot reach its
        targets without folding or overlapping, it ends as near as it got: check ``info.n_off`` and ``info.most_off``

    Raises:
        ArgumentError: for two points in one place with different targets, or if the targets mirror the points (change
            the sign of y); OutsideError: for a point outside the domain; BoundaryError: if told parts of the boundary
            cross; CertificateError: if no one-to-one map was found. ``index`` is the point or vertex at fault, counted
            in the order of `Fit.targets`
    """
    if domain is not None and mesh is not None:
        raise ValueError("pass a domain or a mesh, not both")
    shape = None if domain is None else as_domain(domain)
    net = None if mesh is None else _mesh(mesh)
    constraints = _Constraints()
    if points is not None or to is not None:
        if points is None or to is None:
            raise ValueError("points and to come together")
        source, target = _pair(points, to, ("points", "to"))
        loose = None if tolerance is None else _spread(tolerance, (len(source),), "tolerance")
        constraints.add("points", len(source), target, source=source, target=target, tolerance=loose)
    elif tolerance is not None:
        raise ValueError("a tolerance is for points")
    for before, after in lines:
        source, target = _pair(before, after, ("a line", "its target"))
        constraints.add("line", len(source), target, source=source, target=target)
    if vertices is not None:
        if len(vertices) != 2:
            raise ValueError("vertices must be a pair (numbers, places)")
        numbers, places = _numbers(vertices[0], "vertices"), points_of(vertices[1], 2, "the places of vertices")
        if len(numbers) != len(places):
            raise ValueError(f"vertices has {len(numbers)} numbers, but {len(places)} places")
        constraints.add("vertices", len(numbers), places, vertices=numbers, target=places)
    if sliding is not None:
        _add_sliding(constraints, sliding, shape.vertices if shape else net[0] if net else None)
    if len(constraints) == 0:
        raise ValueError("a fit needs points, lines or vertices")
    options = new("fit_options", model=choose(model, MODELS, "model"), margin=margin or 0,
                  smoothing=0 if smoothing is None else smoothing or -1, reach=reach or 0, stiffness=stiffness,
                  cell=cell or 0, no_contact=int(not contact))
    corners = None if box is None else floats(np.reshape(np.asarray(box, dtype=np.float64), -1), (4,), "box")
    if cell_stiffness is not None and net is None:
        raise ValueError("cell_stiffness is for a mesh")
    factors = None
    if cell_stiffness is not None and net is not None:
        factors = floats(cell_stiffness, (len(net[1]),), "cell_stiffness")
    options.box, options.cell_stiffness = address(corners), address(factors)
    own = None if net is None else mesh_of(*net)
    starts = None if net is None else np.arange(0, net[1].size + 1, net[1].shape[1], dtype=np.uintp)
    if own is not None and net is not None and net[1].shape[1] == 4:
        own.offsets = address(starts)
    all_constraints = constraints.array()
    made = create(lib.fit_create, shape, None if own is None else ctypes.addressof(own), len(constraints),
                  ctypes.addressof(all_constraints), ctypes.addressof(options), progress=progress, threads=threads)
    return Fit._made(made, constraints.targets)


def nearest(vertices: ArrayLike, triangles: ArrayLike, images: ArrayLike, held: Optional[ArrayLike] = None, *,
            progress: Optional[Progress] = None, threads: Optional[int] = None) -> Map:
    """Makes the one-to-one map that is nearest to any warp of a mesh, such as a thin plate, a polynomial, a
    displacement field or a pose, sampled at the vertices.

    >>> V = numpy.array([[0, 0], [4, 0], [4, 4], [0, 4], [1, 1], [3, 1], [3, 3], [1, 3]])
    >>> T = libicc.stages.triangulate(V, 4)
    >>> X = V.copy()
    >>> X[4] = [3, 2]                              # too far: triangles fold
    >>> mapping = libicc.nearest(V, T, X)
    >>> mapping.report.n_folded > 0, mapping.certified
    (True, True)

    Where the warp does not fold, it stays as it is: if every triangle keeps its orientation and the image of the
    boundary is simple, this is the given map, bit for bit. Otherwise the folded triangles and their surroundings are
    mapped anew on a finer mesh. Images of boundary vertices never change, so the boundary's image must be simple.

    Args:
        vertices: (n, 2)
        triangles: (m, 3) vertex indices of a conforming mesh in one piece, which may have holes
        images: (n, 2)
        held: numbers of further vertices whose images must not change, or None

    Returns:
        the map. Its `Map.report` also has the members of ``icc_nearest_report``: what was repaired, and by how much
        vertices have moved

    Raises:
        BoundaryError: if the mesh is not valid, or if the image of its boundary meets itself; TopologyError: if the
            mesh has several pieces; ArgumentError: also if the images are a mirror image (change the sign of y);
            CertificateError: if no one-to-one map was found
    """
    vertices, triangles = points_of(vertices, 2, "vertices"), indices(triangles, 3, "triangles")
    images = floats(images, vertices.shape, "images")
    numbers = _numbers(() if held is None else held, "held")
    options = new("nearest_options", n_held=len(numbers), held=address(numbers))
    mesh, report = mesh_of(vertices, triangles), new("nearest_report")
    call, out = Call(progress, threads), ctypes.c_void_p()
    call.check(lib.map_create_nearest(ctypes.addressof(out), ctypes.addressof(mesh), address(images),
                                      ctypes.addressof(options), ctypes.addressof(report), call.env, call.err))
    assert out.value is not None
    made = Map._wrap(out.value)
    made._repaired = fields(report)
    made._repaired.repair = name_of(made._repaired.repair, REPAIRS)
    return made
