"""Points: tables, landmarks of 3D Slicer, and outlines of figures of games, which are lists of vertices."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import tempfile
from pathlib import Path
from typing import Any, Callable, List, Optional

import numpy as np

from . import formats
from ._tally import Tally
from .formats import FileError, Format

_COLUMNS = ({"x", "lon", "longitude", "easting"}, {"y", "lat", "latitude", "northing"}, {"z", "height", "elevation"})
_FOAM = re.compile(r"(\d+)\s*\(\s*((?:\([^()]*\)\s*)*)\)")


class Points:
    """Points (n, dim), and how to write them back to a file of their own format."""

    kind = "points"

    def __init__(self, points: Any, own: str = "", rewrite: Optional[Callable[[Any], str]] = None):
        self.points, self._own, self._rewrite = np.atleast_2d(np.asarray(points, dtype=float)), own, rewrite

    def outline(self) -> Any:
        return self.points

    def carry(self, mapping: Any, how: Any) -> Tally:
        points = self.points if self.points.shape[1] == mapping.dim else self.points[:, :mapping.dim]
        images = mapping.inverse(points) if how.inverse else mapping(points)
        lost = np.isnan(images).any(axis=1)
        if how.outside == "keep":
            images = np.where(lost[:, None], points, images)
        self.points = np.hstack([images, self.points[:, mapping.dim:]])
        return Tally(f"{lost.sum()} of {len(points)} points have no image" if lost.any() else "",
                     0 if how.outside == "keep" else int(lost.sum()))

    def save(self, path: Path, row: Format) -> None:
        if row.reader == "array":
            with open(path, "wb") as file:
                np.save(file, self.points)
        elif self._rewrite is not None and row.reader == self._own:
            path.write_text(self._rewrite(self.points))
        elif row.reader in ("text", "slicer_table"):
            gap = "," if path.suffix == ".csv" else " "
            path.write_text("".join(gap.join(map(repr, map(float, point))) + "\n" for point in self.points))
        else:
            raise FileError(f"{path}: only a file of this format can be rewritten; write .txt or .csv")


def text(path: Path, choice: str, row: Format) -> Points:
    """Lines of numbers. A heading tells which columns are coordinates."""
    lines = [re.split(r"[,;\s]+", line.strip()) for line in path.read_text(encoding="utf-8-sig").splitlines()
             if line.strip() and not line.lstrip().startswith("#")]
    names = [name.strip('"').lower() for name in lines[0]] if lines else []
    columns = [at for known in _COLUMNS for at, name in enumerate(names) if name in known]
    if columns:
        return Points([[float(line[at]) for at in columns] for line in lines[1:]])
    return Points([[float(number) for number in line if number] for line in lines])


def array(path: Path, choice: str, row: Format) -> Any:
    """An array (n, dim) of points. Other arrays are masks and volumes."""
    points = np.load(path)
    if points.ndim != 2 or points.dtype == bool:
        from . import volume

        return volume.arrays(path, choice, row)
    return Points(points)


def slicer_table(path: Path, choice: str, row: Format) -> Points:
    """.fcsv: columns 1 to 3 are coordinates, in the system that the file names."""
    lines = path.read_text().splitlines()
    rows = [at for at, line in enumerate(lines) if line.strip() and not line.startswith("#")]

    def rewrite(points: Any) -> str:
        for at, point in zip(rows, points):
            cells = lines[at].split(",")
            cells[1:4] = [repr(float(number)) for number in point]
            lines[at] = ",".join(cells)
        return "\n".join(lines) + "\n"

    return Points([[float(cell) for cell in lines[at].split(",")[1:4]] for at in rows], row.reader, rewrite)


def slicer_json(path: Path, choice: str, row: Format) -> Points:
    tree = json.loads(path.read_text())
    places = [point for markup in tree["markups"] for point in markup["controlPoints"]]

    def rewrite(points: Any) -> str:
        for place, point in zip(places, points.tolist()):
            place["position"] = point
        return json.dumps(tree, indent=1) + "\n"

    return Points([place["position"] for place in places], row.reader, rewrite)


def foam(path: Path, choice: str, row: Format) -> Points:
    """A list of vectors of OpenFOAM, as text."""
    content = path.read_text(errors="replace")
    found = _FOAM.search(content)
    if found is None:
        raise FileError(f"{path}: holds no list of points as text; 'foamFormatConvert' writes text")
    begin, end = found.span(2)
    points = [[float(number) for number in each.split()] for each in re.findall(r"\(([^()]*)\)", content[begin:end])]

    def rewrite(images: Any) -> str:
        lines = "\n".join("({!r} {!r} {!r})".format(*map(float, point)) for point in images)
        return content[:begin] + lines + "\n" + content[end:]

    return Points(points, row.reader, rewrite)


def spine(path: Path, choice: str, row: Format) -> Points:
    """The hull of the only attachment that is a mesh without weights, or of the one that is chosen."""
    skins: Any = json.loads(path.read_text()).get("skins", [])
    skins = skins if isinstance(skins, list) else [{"attachments": skin} for skin in skins.values()]
    hulls = {name: np.reshape(mesh["vertices"], (-1, 2))[:mesh["hull"]]
             for skin in skins for slot in skin.get("attachments", {}).values() for name, mesh in slot.items()
             if mesh.get("type") == "mesh" and len(mesh["vertices"]) == len(mesh["uvs"])}
    return Points(_chosen(path, hulls, choice))


def lottie(path: Path, choice: str, row: Format) -> Points:
    """The vertices of the only path that does not move, or of the one that is chosen by its number from 1."""
    found: List[Any] = []

    def search(tree: Any) -> None:
        if isinstance(tree, dict) and tree.get("ty") == "sh" and not tree["ks"].get("a"):
            found.append(tree["ks"]["k"]["v"])
        for part in tree.values() if isinstance(tree, dict) else tree if isinstance(tree, list) else ():
            search(part)

    search(json.loads(path.read_text()))
    return Points(_chosen(path, {str(n): each for n, each in enumerate(found, 1)}, choice))


def godot(path: Path, choice: str, row: Format) -> Points:
    """The polygon of the only node that has one, or of the one that is chosen by name."""
    nodes = re.split(r"^\[(?=node )", path.read_text(), flags=re.M)[1:]
    found = {}
    for node in nodes:
        name = re.match(r'node name="([^"]*)"', node)
        polygon = re.search(r"^polygon = (?:PackedVector2Array|PoolVector2Array)\(([^)]*)\)", node, flags=re.M)
        if name and polygon:
            found[name.group(1)] = np.reshape([float(number) for number in polygon.group(1).split(",")], (-1, 2))
    return Points(_chosen(path, found, choice))


def _chosen(path: Path, shapes: Any, choice: str) -> Any:
    if choice in shapes:
        return shapes[choice]
    if len(shapes) == 1 and not choice:
        return next(iter(shapes.values()))
    raise FileError(f"{path}: has {len(shapes)} outlines{f', none of them {choice!r}' if choice else ''}"
                    + (f"; choose one: {path}#{next(iter(shapes))}" if shapes else ""))


def by_command(path: Path, choice: str, ending: str) -> Any:
    """Reads a shape of a format that only the command libicc knows. The command writes it in another format."""
    command = shutil.which("libicc")
    if command is None:
        raise FileError(f"{path}: only the command libicc reads this format; install it (Debian: 'apt install "
                        "libicc-tools')")
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, "shape" + ending)
        done = subprocess.run([command, "check", "-q", "-s", f"{path}#{choice}" if choice else str(path), "--repair",
                               str(copy)], capture_output=True, text=True)
        if not copy.exists():
            raise FileError(done.stderr.strip().removeprefix("libicc: ") or f"{path}: cannot be read")
        return formats.read(copy)


def drawing(path: Path, choice: str, row: Format) -> Any:
    """SVG."""
    return by_command(path, choice, ".txt")
