"""Images of the lines and rings of a whole layer, exact or within a tolerance.

A mesh map is linear in each of its triangles. So the image of a line is exact if the line gets a vertex wherever it
crosses an edge of these triangles. Sides that neighbours share are cut once, from their smaller end, and a vertex on
another's side is put into it first. So a layer without gaps stays one, bit by bit.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Callable, Iterable, List, NamedTuple, Tuple

import numpy as np

from ._map import Map

if TYPE_CHECKING:
    from ._transform import Transform
    from ._types import Array, ArrayLike, Floats

_NEAR = 1e-9
"""A vertex this close to a side, as a share of the map's size, lies on it."""

_SAME = 1e-12
"""Places this close are one: some thousand roundings, as a share of the map's size or of a side."""


_MOST_ROUNDS = 12
_QUARTERS = np.array([0.25, 0.5, 0.75])[:, None]


def move_lines(lines: Iterable[ArrayLike], mapping: Transform, *, inverse: bool = False, tolerance: float = 0,
               exact: bool = False) -> List[Floats]:
    """Moves lines, rings and points by a map of the plane. Lines get more vertices where the map bends them.

    >>> before, after = [[0, 0], [4, 0], [4, 3], [0, 3]], [[0, 0], [4, 1], [5, 4], [0, 3]]
    >>> line, point = [[0.5, 1], [3.5, 1]], [[2, 2, 410]]              # a third coordinate stays
    >>> moved = libicc.move_lines([line, point], libicc.Map(before, after), exact=True)
    >>> len(moved[0]) > 2, moved[1].shape, float(moved[1][0, 2])
    (True, (1, 3), 410.0)

    Args:
        lines: arrays (n, 2) or wider. Coordinates beyond the first two stay, and are interpolated at new vertices
        mapping: a map of the plane
        inverse: map from the target to the source
        tolerance: edges get more vertices, at most 4095 each, until their quarter points are within this distance of
            the true images; 0: no more vertices
        exact: edges get a vertex wherever they cross an edge of the map's triangles, so their images are exact. A vertex
            on another line's edge becomes a vertex of that edge, too. So rings that share edges stay without gaps and
            overlaps. Only for mesh maps

    Returns:
        the lines in their order. Where a vertex, or an edge from it, has no image, x and y are NaN
    """
    if mapping.dim != 2:
        raise ValueError(f"lines are of the plane; this map has dimension {mapping.dim}")
    if exact and tolerance > 0:
        raise ValueError("exact and tolerance exclude each other")
    if exact and not (isinstance(mapping, Map) and mapping.info.kind == "mesh"):
        raise ValueError("exact needs the triangles of a mesh map; for an inverse give the map itself and inverse=True, "
                         "for others a tolerance")
    arrays = [np.asarray(line, dtype=float) for line in lines]
    if not arrays:
        return []
    width = max(line.shape[1] for line in arrays)
    points = np.concatenate([np.pad(line, ((0, 0), (0, width - line.shape[1]))) for line in arrays])
    number = np.repeat(np.arange(len(arrays)), [len(line) for line in arrays])
    if exact:
        assert isinstance(mapping, Map)
        points, images, number = exact_images(points, number, mapping, inverse)
    else:
        points, images, number = _bent(points, number, mapping.apply_inverse if inverse else mapping.apply, tolerance)
    points[:, :2] = images
    parts = np.split(points, np.searchsorted(number, np.arange(1, len(arrays))))
    return [part[:, :line.shape[1]] for part, line in zip(parts, arrays)]


class _Sides(NamedTuple):
    """The sides of lines. Each is listed once, from its smaller node."""
    ends: Array     # (n, 2) nodes
    begins: Array   # of each side of a line: the position where it begins
    which: Array    # and its number in `ends`
    flipped: Array  # and whether it goes from the larger node to the smaller one


class _Places(NamedTuple):
    """Places on sides, to be put in as vertices."""
    side: Array
    share: Floats  # of the way from the smaller node


def exact_images(points: Floats, number: Array, mapping: Map, inverse: bool) -> Tuple[Floats, Floats, Array]:
    """Cuts lines at the edges of a map.

    Args:
        points: positions of all lines, in their order. Coordinates beyond the first two are interpolated
        number: the line of each position

    Returns:
        The positions with those that are put in, their images, and the line of each. Images are NaN where there are
        none. If part of a side has none, the image where it begins is NaN.
    """
    before, after, triangles = mapping.mesh()
    if inverse:
        before, after = after, before
    carry = mapping.apply_inverse if inverse else mapping.apply
    size = float(np.ptp(before, axis=0).max())
    nodes, node = _distinct(points[:, :2])

    sides = _sides_of(node, number)
    places, on = _nodes_on(nodes, sides.ends, _NEAR * size)
    at, item, new = _between(points, sides, places)
    new[:, :2] = nodes[on[item]]
    points, number, node = (np.insert(points, at, new, axis=0), np.insert(number, at, number[at - 1]),
                            np.insert(node, at, on[item]))

    sides = _sides_of(node, number)
    places, cuts = _cuts(nodes[sides.ends], before, after, triangles, size)
    at, item, new = _between(points, sides, places)
    images = np.insert(carry(nodes)[node], at, cuts[item], axis=0)
    points, number = np.insert(points, at, new, axis=0), np.insert(number, at, number[at - 1])

    pieces = np.flatnonzero(number[:-1] == number[1:])
    middles = (points[pieces, :2] + points[pieces + 1, :2]) / 2
    images[pieces[np.isnan(carry(middles)).any(axis=1)]] = np.nan
    return points, images, number


def _bent(points: Floats, number: Array, carry: Callable[[Floats], Floats],
          tolerance: float) -> Tuple[Floats, Floats, Array]:
    """Adds vertices until all lines are right to a tolerance: the positions, their images, and the line of each."""
    images = carry(points[:, :2])
    begins = np.flatnonzero(number[:-1] == number[1:]) if tolerance > 0 else np.empty(0, int)
    for _ in range(_MOST_ROUNDS):
        begins, points, images, number = _split(begins, points, images, number, carry, tolerance)
        if len(begins) == 0:
            break
    return points, images, number


def _split(begins: Array, points: Floats, images: Floats, number: Array, carry: Callable[[Floats], Floats],
           tolerance: float) -> Tuple[Array, Floats, Floats, Array]:
    """Halves the edges that begin at these points where their images bend. Returns where the halves begin, and all
    points with those between. A quarter without an image takes that of its edge away."""
    edges = points[begins, None] + _QUARTERS * (points[begins + 1] - points[begins])[:, None]
    checks = carry(edges[:, :, :2]) if len(begins) else np.empty((0, 3, 2))
    lost = np.isnan(checks).any(axis=(1, 2))
    images[begins[lost]] = np.nan
    far = ~lost & (_off(images[begins], images[begins + 1], checks) > tolerance)
    at = begins[far] + 1
    first = at + np.arange(len(at))
    return (np.sort(np.concatenate([first - 1, first])), np.insert(points, at, edges[far, 1], axis=0),
            np.insert(images, at, checks[far, 1], axis=0), np.insert(number, at, number[begins[far]]))


def _off(a: Floats, b: Floats, checks: Floats) -> Floats:
    """Distance from each segment a b to the farthest of its checks (n, 3, 2)."""
    along = (b - a)[:, None]
    square = (along**2).sum(-1)
    share = ((checks - a[:, None]) * along).sum(-1) / np.where(square > 0, square, 1)
    nearest = a[:, None] + np.clip(share, 0, 1)[..., None] * along
    return np.sqrt(((checks - nearest) ** 2).sum(-1)).max(axis=1)


def _sides_of(node: Array, number: Array) -> _Sides:
    begins = np.flatnonzero((number[:-1] == number[1:]) & (node[:-1] != node[1:]))
    ends = np.stack([node[begins], node[begins + 1]], axis=1)
    sides, which = _distinct(np.sort(ends, axis=1))
    return _Sides(sides, begins, which, ends[:, 0] > ends[:, 1])


def _between(points: Floats, sides: _Sides, places: _Places) -> Tuple[Array, Array, Floats]:
    """Where to insert places into the positions, for each side of a line: an index for `numpy.insert`, the number of
    the place, and its position."""
    order = np.lexsort((places.share, places.side))
    count = np.bincount(places.side, minlength=len(sides.ends))
    n = count[sides.which]
    own = np.repeat(np.arange(len(n)), n)
    k = np.arange(len(own)) - np.repeat(np.cumsum(n) - n, n)
    k = np.where(sides.flipped[own], n[own] - 1 - k, k)
    item = order[(np.cumsum(count) - count)[sides.which[own]] + k]
    begins, share = sides.begins[own], places.share[item]
    share = np.where(sides.flipped[own], 1 - share, share)[:, None]
    return begins + 1, item, points[begins] + share * (points[begins + 1] - points[begins])


def _nodes_on(nodes: Floats, sides: Array, near: float) -> Tuple[_Places, Array]:
    """The nodes that lie on sides of others, and where."""
    ends = np.unique(sides)
    own, side = _close(np.repeat(nodes[ends][:, None], 2, axis=1), nodes[sides], near)
    node = ends[own]
    a, b, p = nodes[sides[side, 0]], nodes[sides[side, 1]], nodes[node]
    length = np.linalg.norm(b - a, axis=1)
    along = ((p - a) * (b - a)).sum(axis=1) / length
    on = (along > near) & (along < length - near) & (np.abs(_cross(b - a, p - a)) <= near * length)
    return _Places(side[on], along[on] / length[on]), node[on]


def _cuts(segments: Floats, before: Floats, after: Floats, triangles: Array, size: float) -> Tuple[_Places, Floats]:
    """Where segments cross the edges of triangles, and the images there.

    A vertex as close to a segment as rounding counts as on it. It is so for all its edges. So no triangle is passed
    without a cut."""
    edges, _ = _distinct(np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1))
    side, edge = _close(segments, before[edges], _SAME * size)
    (a, b), (p, q) = segments[side].swapaxes(0, 1), before[edges[edge]].swapaxes(0, 1)
    length = np.linalg.norm(b - a, axis=1)
    heights = np.stack([_cross(b - a, p - a), _cross(b - a, q - a)]) / length
    heights[np.abs(heights) <= _SAME * size] = 0
    crossed = (np.sign(heights).prod(axis=0) <= 0) & heights.any(axis=0)
    side, edge, a, b, p, q, length = (x[crossed] for x in (side, edge, a, b, p, q, length))
    on_edge = (heights[0, crossed] / (heights[0, crossed] - heights[1, crossed]))[:, None]
    share = ((p + on_edge * (q - p) - a) * (b - a)).sum(axis=1) / length**2
    first, last = after[edges[edge]].swapaxes(0, 1)
    images = first + on_edge * (last - first)

    order = np.lexsort((images[:, 1], images[:, 0], share, side))
    order = order[(share[order] > _SAME) & (share[order] < 1 - _SAME)]
    side, share, images = side[order], share[order], images[order]
    new = np.ones(len(side), dtype=bool)
    new[1:] = (side[1:] != side[:-1]) | (np.diff(share) > _SAME)
    return _Places(side[new], share[new]), images[new]


def _distinct(pairs: Array) -> Tuple[Array, Array]:
    """Different pairs, sorted, and the number of each pair among them. (`numpy.unique` takes ten times as long.)"""
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))
    new = np.ones(len(pairs), dtype=bool)
    new[1:] = (pairs[order[1:]] != pairs[order[:-1]]).any(axis=1)
    number = np.empty(len(pairs), dtype=np.int64)
    number[order] = np.cumsum(new) - 1
    return pairs[order[new]], number


def _cross(a: Floats, b: Floats) -> Floats:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def _close(segments: Floats, others: Floats, near: float) -> Tuple[Array, Array]:
    """Pairs of a segment and another (n, 2, 2) that may be within `near`: a binary tree of boxes over the others, asked
    level by level."""
    own, at = np.arange(len(segments) if len(others) else 0), np.zeros(len(segments) if len(others) else 0, dtype=int)
    order = np.argsort(_morton_codes(others.mean(axis=1)), kind="stable")
    n = 1 << max(len(others) - 1, 0).bit_length()
    empty = np.full((n - len(others), 2), np.inf)
    levels = [(np.concatenate([others[order].min(axis=1) - near, empty]),
               np.concatenate([others[order].max(axis=1) + near, -empty]))]
    while len(levels[-1][0]) > 1:
        low, high = levels[-1]
        levels.append((low.reshape(-1, 2, 2).min(axis=1), high.reshape(-1, 2, 2).max(axis=1)))
    for depth, (low, high) in enumerate(reversed(levels)):
        if depth > 0:
            own, at = np.repeat(own, 2), np.stack([2 * at, 2 * at + 1], axis=1).reshape(-1)
        for meets in (_overlap, _pass):
            near_enough = meets(segments, own, low, high, at)
            own, at = own[near_enough], at[near_enough]
    return own, order[at]


def _overlap(segments: Floats, own: Array, low: Floats, high: Floats, at: Array) -> Array:
    """Whether the boxes of segments overlap others."""
    lower, upper = segments.min(axis=1), segments.max(axis=1)
    result = np.ones(len(own), dtype=bool)
    for k in range(2):
        result &= (upper[own, k] >= low[at, k]) & (lower[own, k] <= high[at, k])
    return result


def _pass(segments: Floats, own: Array, low: Floats, high: Floats, at: Array) -> Array:
    """Whether the lines through segments meet boxes."""
    (ax, ay), (bx, by) = segments[own].transpose(1, 2, 0)
    (lx, ly), (hx, hy) = low[at].T, high[at].T
    dx, dy = bx - ax, by - ay
    off = np.abs(dx * ((ly + hy) / 2 - ay) - dy * ((lx + hx) / 2 - ax))
    reach: Array = np.abs(dx) * (hy - ly) / 2 + np.abs(dy) * (hx - lx) / 2
    return off <= reach


def _morton_codes(points: Floats) -> Array:
    """Numbers that are close for most points that are: the bits of both coordinates, in turn."""
    bits = 24
    span = np.ptp(points, axis=0) if len(points) else np.ones(2)
    shares = (points - points.min(axis=0, initial=np.inf)) / np.where(span > 0, span, 1)
    cells = (shares * (2**bits - 1)).astype(np.int64)
    codes = np.zeros(len(points), dtype=np.int64)
    for bit in reversed(range(bits)):
        codes = codes << 2 | (cells[:, 0] >> bit & 1) << 1 | (cells[:, 1] >> bit & 1)
    return codes
