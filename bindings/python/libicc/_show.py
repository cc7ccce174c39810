"""Pictures of maps and domains as SVG, which notebooks show. They need NumPy alone."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Dict, List, Optional, Tuple

import numpy as np

if TYPE_CHECKING:
    from ._domain import Domain
    from ._map import Map
    from ._types import Floats, Indices

_SIDE = 280.0
"""The longer side of a shape in pixels."""

_MOST_FACES = 5000
"""A surface of more facets is told in words only, because notebooks keep every picture."""

_MOST_SIMPLICES = 50000
"""A larger map is drawn from outside only, because notebooks keep every page."""

_OFF = 0.1
"""How far lines may be off in pixels, so that points on straight parts are left out."""

_GRID_LINES = 20

_ON_A_LINE = 200

_VIEW = np.array([[0.8, 0.6, 0.0], [-0.3, 0.4, 0.8660254037844386], [0.51961524, -0.69282032, 0.5]])
"""Rows: right, up, and towards the eye."""


def rings_of(facets: Any) -> List[List[int]]:
    """The closed rings that directed edges form, each as vertex numbers."""
    following: Dict[int, List[int]] = {}  # several where rings touch
    for a, b in sorted(facets.tolist()):
        following.setdefault(a, []).append(b)
    rings = []
    for first in sorted(following):
        while following[first]:
            ring, at = [first], following[first].pop()
            while at != first:
                ring.append(at)
                at = following[at].pop()
            rings.append(ring)
    return rings


def boundary_of(simplices: Indices) -> Any:
    """The facets (n, dim) that belong to one simplex only, with the inside on their left, or seen from outside."""
    dim = simplices.shape[1] - 1
    sides = [[0, 1], [1, 2], [2, 0]] if dim == 2 else [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
    facets = simplices[:, sides].reshape(-1, dim).astype(np.int64)
    _, first, count = np.unique(np.sort(facets, axis=1), axis=0, return_index=True, return_counts=True)
    return facets[np.sort(first[count == 1])]


def surfaces(mapping: Map) -> Tuple[Floats, Floats, Any]:
    """The vertices before and after, and the facets of the boundary."""
    if mapping.info.kind == "mesh":
        vertices, images, simplices = mapping.mesh()
        return vertices, images, boundary_of(simplices)
    return mapping.source.vertices, mapping.target.vertices, mapping.source.facets


def closed_lines(places: Floats, facets: Any) -> Floats:
    """The rings of edges as lines with NaN between, (n, 2)."""
    gap = np.full((1, 2), np.nan)
    parts: List[Floats] = []
    for ring in rings_of(facets):
        parts += [places[[*ring, ring[0]]], gap]
    return np.concatenate(parts[:-1]) if parts else gap


def grid_lines(low: Floats, high: Floats, lines: int, on_a_line: int = _ON_A_LINE) -> Floats:
    """Points on lines along both axes, one line after the other with NaN between, (n, 2)."""
    step, parts = (high - low).max() / lines, []
    for axis in (0, 1):
        along = np.linspace(low[1 - axis], high[1 - axis], on_a_line)
        for at in np.arange(low[axis] + step / 2, high[axis], step):
            line = np.empty((on_a_line + 1, 2))
            line[:-1, axis], line[:-1, 1 - axis] = at, along
            line[-1] = np.nan
            parts.append(line)
    return np.concatenate(parts)


def stretch_of(vertices: Floats, images: Floats, simplices: Indices) -> Floats:
    """The largest factor that lengths grow by in each simplex, (n,)."""
    before = vertices[simplices[:, 1:]] - vertices[simplices[:, :1]]
    after = images[simplices[:, 1:]] - images[simplices[:, :1]]
    factors: Floats = np.linalg.svd(np.linalg.solve(before, after), compute_uv=False)[:, 0]
    return factors


def _bends(line: Floats) -> List[int]:
    """The points of a line without which it would be off by more than `_OFF` pixels, after Douglas and Peucker, 1973."""
    kept, parts = {0, len(line) - 1}, [(0, len(line) - 1)]
    while parts:
        first, last = parts.pop()
        way, from_first = line[last] - line[first], line[first + 1:last] - line[first]
        if len(from_first) == 0:
            continue
        square = float(way @ way)
        along = np.clip(from_first @ way / square, 0, 1) if square > 0 else np.zeros(len(from_first))
        off = ((from_first - along[:, None] * way) ** 2).sum(axis=1)
        if off.max() > _OFF**2:
            middle = first + 1 + int(off.argmax())
            kept.add(middle)
            parts += [(first, middle), (middle, last)]
    return sorted(kept)


def _path(points: Floats, style: str) -> str:
    """Lines with NaN between as a path of SVG."""
    words, gaps = [], np.flatnonzero(np.isnan(points[:, 0])).tolist()
    for first, last in zip([-1, *gaps], [*gaps, len(points)]):
        line = points[first + 1:last]
        if len(line) > 1:
            words.append("M" + "L".join(f"{x:g} {y:g}" for x, y in line[_bends(line)].round(1).tolist()))
    return f'<path d="{"".join(words)}" {style}/>'


def _fitted(low: Floats, high: Floats, left: float) -> Any:
    """A function from coordinates to pixels of a square picture at `left`, with y upwards; and the scale."""
    scale = _SIDE / (float(np.max(high - low)) or 1.0)
    origin = np.array([left, 0.0]) + (_SIDE - scale * (high - low)) / 2 + 5

    def fit(points: Floats) -> Floats:
        flipped = (points - low) * scale
        flipped[:, 1] = scale * (high - low)[1] - flipped[:, 1]
        return flipped + origin

    return fit


def _svg(parts: List[str], n: int) -> str:
    width, height = n * (_SIDE + 10), _SIDE + 10
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}" height="{height:g}" '
            f'viewBox="0 0 {width:g} {height:g}">{"".join(parts)}</svg>')


_BLACK = 'fill="none" stroke="#222" stroke-width="1.5"'
_RED = 'fill="none" stroke="#c33" stroke-width="1.5"'
_BLUE = 'fill="none" stroke="#2a78c8" stroke-width="0.6"'


def _draw_solid(vertices: Floats, facets: Any, left: float) -> str:
    """A surface from the front and above, far facets first."""
    seen = vertices @ _VIEW.T
    used = seen[facets]
    fit = _fitted(used[..., :2].min(axis=(0, 1)), used[..., :2].max(axis=(0, 1)), left)
    places = fit(seen[:, :2].copy()).round(1)
    normals = np.cross(used[:, 1] - used[:, 0], used[:, 2] - used[:, 0])
    length = np.sqrt((normals**2).sum(axis=1))
    light = (110 + 130 * np.abs(normals[:, 2]) / np.where(length > 0, length, 1)).astype(int)
    order = np.argsort(used[..., 2].mean(axis=1), kind="stable")
    return "".join(f'<polygon points="{" ".join(f"{x:g},{y:g}" for x, y in places[facets[k]].tolist())}" '
                   f'fill="rgb({light[k] - 30},{light[k]},{light[k]})" stroke="#345" stroke-width="0.3"/>' for k in order)


def draw_map(mapping: Map) -> Optional[str]:
    """Both sides of a map as SVG, or None if it has too many facets or dimensions."""
    if mapping.dim not in (2, 3):
        return None
    before, after, facets = surfaces(mapping)
    if mapping.dim == 3:
        if len(facets) > _MOST_FACES:
            return None
        return _svg([_draw_solid(places, facets, k * (_SIDE + 10)) for k, places in enumerate((before, after))], 2)
    grid = grid_lines(before.min(axis=0), before.max(axis=0), _GRID_LINES)
    moved = mapping.apply(grid)
    grid[np.isnan(moved[:, 0])] = np.nan
    parts = []
    for k, (places, lines) in enumerate(((before, grid), (after, moved))):
        fit = _fitted(places.min(axis=0), places.max(axis=0), k * (_SIDE + 10))
        parts += [_path(fit(lines), _BLUE), _path(fit(closed_lines(places, facets)), _BLACK)]
    return _svg(parts, 2)


def show_map(mapping: Map) -> str:
    """The picture, and the certificate in words. In space the picture can be turned and cut, if the files of that page are
    installed."""
    info = mapping.info
    words = ("Certified: the map is one-to-one." if info.certified else "Not certified: the map may fold.")
    size = f" {info.n_simplices:,} simplices, energy {info.energy:.4g}." if info.kind == "mesh" else ""
    return f"<figure>{_turning(mapping) or draw_map(mapping) or ''}<figcaption>{words}{size}</figcaption></figure>"


def _turning(mapping: Map) -> Optional[str]:
    from . import _viewer

    info = mapping.info
    fits = info.dim == 3 and info.kind == "mesh" and info.n_simplices <= _MOST_SIMPLICES
    return _viewer.frame_of(mapping) if fits and _viewer.template() is not None else None


def draw_domain(domain: Domain) -> Optional[str]:
    """A domain as SVG, or None as for maps."""
    vertices, facets = domain.vertices, domain.facets.astype(np.int64)
    if domain.dim == 3 and len(facets) <= _MOST_FACES:
        return _svg([_draw_solid(vertices, facets, 0)], 1)
    if domain.dim != 2:
        return None
    fit = _fitted(vertices.min(axis=0), vertices.max(axis=0), 0)
    parts = [_path(fit(closed_lines(vertices, facets)), 'fill="#dde8f4" fill-rule="evenodd" stroke="#222"')]
    for kind, own in domain.features:
        if kind == "line":
            parts.append(_path(fit(own), _RED))
        elif kind == "point":
            x, y = fit(own)[0].tolist()
            parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="#c33"/>')
    return _svg(parts, 1)
