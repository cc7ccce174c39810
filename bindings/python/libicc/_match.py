"""Outlines and surfaces that do not correspond."""

from __future__ import annotations

import ctypes
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Optional, Tuple, Union

import numpy as np

from ._abi import lib, new
from ._core import Progress, Saved, address, bulk, choose, create, dimension, fields, floats, grid_of
from ._domain import Domain, as_domains
from ._errors import ArgumentError, check

if TYPE_CHECKING:
    from ._types import ArrayLike, Floats, Ints, ShapeLike

TURNING = {"upright": 1, "free": 2}
BETWEEN = {"elastic": 1, "arc": 2}


class Match(Saved):
    """Two domains of the same shapes as those given, with common vertices: ``Map(match.source, match.target)``.

    >>> ell, other = [[0, 0], [9, 0], [9, 3], [4, 3], [4, 8], [0, 8]], [[4, 4], [4, 9], [0, 9], [0, 0], [5, 0], [10, 0], [10, 4]]
    >>> found = libicc.Match(ell, other)
    >>> found.source, found.info.n_vertices
    (<libicc.Domain: 2-D, 7 vertices, 7 facets>, 7)

    The outlines may differ in number of vertices, in first vertex and in direction. Without landmarks all starting
        points are compared by shape. This is a heuristic, so look at the result. Every given vertex is in the result,
        bit for bit. Others are added on edges.

    Args:
        source, target: Domains of the plane, or anything that `as_domain` takes. Their features are paired as well. Or
            surfaces in space, which get common triangles
        landmarks: (n, 2, 2) or (n, 4): points of the source with their partners in the target. For surfaces (n, 2, 3):
            each point stands for the nearest vertex
        turning: without landmarks: "upright" prefers small rotations, "free" has no preference
        between: "elastic": by shape. "arc": by arc length. Without landmarks "arc" starts where the two outlines are
            nearest when laid on one another unturned
        least_sure: pairings whose ``info.sure`` is less are refused; None: 1.06; 1: none is refused
        drop: vertices that lie within this share of the perimeter become one
        tolerance: in space, how far the common surfaces may be off the given ones, as a share of the diagonal; None:
            1e-3; 0: not at all
        keep_source: in space, the source keeps all its vertices and edges, and gets more vertices where the target
            needs them. ``match.source`` begins with the source's vertices
        progress, threads: as for `Domain`

    Raises:
        AmbiguousError if another pairing is as good; ArgumentError if landmarks are off the outlines or come in a
        different order on the two
    """

    _free = "match_free"
    _name = "match"
    dim = dimension("match_get_info", "match_info")

    def __init__(self, source: ShapeLike, target: ShapeLike, landmarks: Optional[ArrayLike] = None, *,
                 turning: Optional[str] = None, between: Optional[str] = None, least_sure: Optional[float] = None,
                 drop: float = 0, tolerance: Optional[float] = None, keep_source: bool = False,
                 progress: Optional[Progress] = None, threads: Optional[int] = None):
        source, target = as_domains(source, target)
        options = new("match_options", turning=choose(turning, TURNING, "turning"),
                      between=choose(between, BETWEEN, "between"), least_sure=least_sure or 0, drop=drop,
                      tolerance=0 if tolerance is None else tolerance if tolerance > 0 else -1,
                      keep_source=int(keep_source))
        pairs = _pairs(landmarks, source.dim)
        self._take(create(lib.match_create, source, target, len(pairs), address(pairs),
                          ctypes.addressof(options), progress=progress, threads=threads))

    @property
    def source(self) -> Domain:
        """The source with the common vertices."""
        return Domain._wrap(lib.match_source(self), self)

    @property
    def target(self) -> Domain:
        """The target with the common vertices."""
        return Domain._wrap(lib.match_target(self), self)

    @property
    def info(self) -> SimpleNamespace:
        """The members of ``icc_match_info``."""
        info = new("match_info")
        check(lib.match_get_info(self, ctypes.addressof(info)))
        return fields(info)

    def __repr__(self) -> str:
        info = self.info
        return f"<libicc.Match: {info.dim}-D, {info.n_vertices} common vertices, sure {info.sure:.3g}>"

    def origins(self) -> Tuple[Ints, Ints]:
        """For every common vertex its number in the given source and in the given target; -1: it was added."""
        n = self.info.n_vertices
        given = np.empty((2, n), dtype=np.uint32)
        check(lib.match_get_origins(self, address(given[0]), address(given[1])))
        source, target = given.astype(np.int32)
        return source, target

    def _follow(self, function: Any, points: ArrayLike, progress: Optional[Progress],
                threads: Optional[int]) -> Tuple[Floats, Floats]:
        points, shape = grid_of(points, self.dim)
        images, off = np.empty((*shape, self.dim)), np.empty(shape)
        env, done = bulk(len(points), progress, threads)
        done(function(self, len(points), address(points), address(images), address(off), env))
        return images, off

    def apply(self, points: ArrayLike, *, progress: Optional[Progress] = None,
              threads: Optional[int] = None) -> Tuple[Floats, Floats]:
        """Takes points of the source's boundary to the target's. Returns the images, and the distance of each point
        from the common boundary.

        Each point first moves to the nearest point of `source`'s boundary, then to the same place on the same facet of
        `target`. Common vertices go to their partners bit for bit. Points that are not finite give NaN.

        >>> square, other = [[0, 0], [4, 0], [4, 2], [0, 2]], [[4, 0], [8, 0], [8, 4], [0, 4], [0, 0]]
        >>> images, off = libicc.Match(square, other).apply([[1, 0], [4, 2.5]])
        >>> images.tolist(), off.tolist()
        ([[2.0, 0.0], [8.0, 4.0]], [0.0, 0.5])
        """
        return self._follow(lib.match_apply, points, progress, threads)

    def apply_inverse(self, points: ArrayLike, *, progress: Optional[Progress] = None,
                      threads: Optional[int] = None) -> Tuple[Floats, Floats]:
        """Takes points of the target's boundary to the source's; otherwise like `apply`."""
        return self._follow(lib.match_apply_inverse, points, progress, threads)


def _pairs(landmarks: Optional[ArrayLike], dim: int) -> Floats:
    """Landmarks as an array (n, 2 dim): points of the source with their partners."""
    given = np.asarray([] if landmarks is None else landmarks, dtype=float)
    if given.size > 0 and given.shape[1:] not in ((2, dim), (2 * dim,)):
        raise ArgumentError(f"landmarks must have the shape (n, 2, {dim}) or (n, {2 * dim}), not {given.shape}")
    given = given.reshape(-1, 2 * dim)
    return floats(given, given.shape, "landmarks")


def match(source: ShapeLike, target: ShapeLike, landmarks: Optional[ArrayLike] = None,
          **options: Any) -> Tuple[Floats, Floats, SimpleNamespace]:
    """Gives two outlines common vertices. Returns the vertices of both and `Match.info`. Options are those of `Match`.

    >>> a, b, info = libicc.match([[0, 0], [9, 0], [9, 3], [4, 3], [4, 8], [0, 8]], [[4, 4], [4, 9], [0, 9], [0, 0], [10, 0], [10, 4]])
    >>> a.tolist()[3], b.tolist()[3]
    ([4.0, 3.0], [4.0, 4.0])
    """
    found = Match(source, target, landmarks, **options)
    return found.source.vertices, found.target.vertices, found.info


def match_for(source: Domain, target: Domain, how: Union[bool, str, ArrayLike]) -> Match:
    """Handles the argument ``match`` of `Map`: True or "auto", "arc", or landmarks."""
    if isinstance(how, str) and how not in ("auto", "arc"):
        raise ArgumentError(f"match is {how!r}; it may be True, 'auto', 'arc' or landmarks")
    if isinstance(how, (bool, str)):
        return Match(source, target, between="arc" if how == "arc" else None)
    return Match(source, target, how)
