"""The page that shows a mesh map in a browser: that of ``libicc plot OUT.html``, filled with a map.

The page is made of the same files as the command's, and in the same way: see tools/plot/page/embed.cmake. They lie in the
folder ``viewer`` of the installed package, or in the source tree around it.
"""

from __future__ import annotations

import base64
import html
import json
import pathlib
import re
from typing import TYPE_CHECKING, Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from ._show import boundary_of

if TYPE_CHECKING:
    from ._map import Map
    from ._types import Floats

SCRIPTS = ("gl.js", "gl3.js", "solid.js", "page.js")

_HEIGHT = 670
"""Of the page in a notebook, in pixels."""


def _folders() -> List[pathlib.Path]:
    """Where the files of the page may be."""
    here = pathlib.Path(__file__).resolve().parent
    tree = here.parents[2]
    return [here / "viewer", tree / "tools/plot/page", tree / "examples/studio/src"]


def _read(name: str) -> Optional[str]:
    for folder in _folders():
        if (folder / name).is_file():
            return (folder / name).read_text(encoding="utf-8")
    return None


def _script(name: str, text: str) -> str:
    """A module without imports and exports, for all of them are joined to one script."""
    text = re.sub(r"(^|\n)export ", r"\1", re.sub(r"(^|\n)import [^\n]*", r"\1", text))
    if name == "gl.js":  # its shaders have the names of those of gl3.js
        text = ("const { programOf, buffersOf, contextOf } = (() => {\n" + text
                + "\nreturn { programOf, buffersOf, contextOf }\n})()\n")
    return text + "\n"


def template() -> Optional[str]:
    """The page without data, or None if its files are not installed."""
    page, style = _read("page.html"), _read("page.css")
    scripts = [_read(name) for name in SCRIPTS]
    if page is None or style is None or None in scripts:
        return None
    program = "".join(_script(name, text or "") for name, text in zip(SCRIPTS, scripts))
    return page.replace("/*style*/", style).replace("/*program*/", program)


def _packed(numbers: Any, kind: str) -> str:
    return base64.b64encode(np.ascontiguousarray(numbers, kind).tobytes()).decode()


def _centred(both: Sequence[Floats]) -> List[Any]:
    """Positions with the middle of each box at the origin, in units of the longest side, so that floats can tell vertices
    apart."""
    lows, highs = ([getattr(places, side)(axis=0) for places in both] for side in ("min", "max"))
    unit = max(float((high - low).max()) for low, high in zip(lows, highs)) or 1.0
    return [(places - (low / 2 + high / 2)) / unit for places, low, high in zip(both, lows, highs)]


def _parts(mapping: Map, simplices: Any) -> List[Dict[str, Any]]:
    """The surfaces of regions inside a solid."""
    if mapping.dim != 3:
        return []
    regions = mapping.mesh_regions()
    return [{"name": f"region {number}", "kind": "region", "facets": _packed(boundary_of(simplices[regions == number]), "<u4")}
            for number in np.unique(regions[regions > 0]).tolist()]


def page_of(mapping: Map, names: Tuple[str, str], y_down: bool) -> str:
    """The page with a map in it."""
    info = mapping.info
    if info.kind != "mesh" or info.dim not in (2, 3):
        raise ValueError("a page shows the cells of a mesh map in the plane or in space; this map has none")
    page = template()
    if page is None:
        raise FileNotFoundError("the files of the page are not installed with this package; 'libicc plot OUT.html' makes "
                                "the same page")
    vertices, images, simplices = mapping.mesh()
    before, after = _centred((vertices, images))
    cells = f"{info.n_simplices} {'tetrahedra' if info.dim == 3 else 'triangles'}"
    words = (f"The map is linear on each of {cells}. Exact signs prove that all of them keep their orientation, so the map "
             "is one-to-one." if info.certified else f"The map has {cells}. It is not certified.")
    data = {"dim": info.dim, "source": names[0], "target": names[1], "certified": bool(info.certified), "y_down": y_down,
            "vertices": info.n_vertices, "simplices": info.n_simplices, "words": words, "parts": _parts(mapping, simplices),
            "before": _packed(before, "<f4"), "after": _packed(after, "<f4"), "cells": _packed(simplices, "<u4")}
    return page.replace("/*data*/", json.dumps(data).replace("<", "\\u003c"))


def frame_of(mapping: Map) -> str:
    """The page within a notebook."""
    page = html.escape(page_of(mapping, ("source", "target"), False))
    return f'<iframe srcdoc="{page}" style="width: 100%; height: {_HEIGHT}px; border: 0" title="Map of libicc"></iframe>'
