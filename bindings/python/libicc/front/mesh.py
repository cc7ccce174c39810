"""Meshes. meshio reads and writes them, with their fields and sets, and gmsh a few formats more."""

from __future__ import annotations

import contextlib
import io
import re
import sys
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np

from . import formats
from ._tally import Tally
from ._vectors import rotate
from .formats import FileError, Format, use
from .points import by_command

# Corners are numbered as in VTK and meshio. Faces look outward.
_FACES: Dict[str, Tuple[Tuple[int, ...], ...]] = {
    "tetra": ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)),
    "hexahedron": ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
    "wedge": ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    "pyramid": ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
}
_CORNERS: Dict[str, Tuple[Tuple[int, ...], ...]] = {
    "triangle": ((0, 1, 2),),
    "quad": ((0, 1, 3), (1, 2, 0), (2, 3, 1), (3, 0, 2)),
    "tetra": ((0, 1, 2, 3),),
    "hexahedron": ((0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7), (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2),
                   (7, 6, 4, 3)),
    "wedge": ((0, 1, 2, 3), (1, 2, 0, 4), (2, 0, 1, 5), (3, 5, 4, 0), (4, 3, 5, 1), (5, 4, 3, 2)),
    "pyramid": ((0, 1, 3, 4), (1, 2, 0, 4), (2, 3, 1, 4), (3, 0, 2, 4)),
}
"""The simplices at the corners of a cell. All of them keep their orientation if the cell is not inverted there."""

_NAMES = {"triangle": "triangles", "quad": "quadrilaterals", "tetra": "tetrahedra", "hexahedron": "hexahedra",
          "wedge": "prisms", "pyramid": "pyramids"}
_N_CORNERS = {"triangle": 3, "quad": 4, "tetra": 4, "hexahedron": 8, "wedge": 6, "pyramid": 5}


def _linear(kind: str) -> Tuple[str, bool]:
    """The kind of a cell with straight sides, and whether the cell has more nodes than corners: tetra10 is a tetra."""
    plain = re.sub(r"\d+$", "", kind)
    return plain, plain != kind


class Mesh:
    """A mesh of meshio. Only its points move."""

    kind = "mesh"

    def __init__(self, mesh: Any, path: Path):
        self.mesh, self._path = mesh, path

    def _cells(self, names: Any) -> List[Tuple[str, bool, Any]]:
        found = []
        for block in self.mesh.cells:
            kind, curved = _linear(block.type)
            if kind in names and len(block.data):
                found.append((kind, curved, np.asarray(block.data)[:, :_N_CORNERS[kind]]))
        return found

    def _is_flat(self) -> bool:
        points = self.mesh.points
        return points.shape[1] == 2 or not self._cells(_FACES) and bool((points[:, 2] == points[0, 2]).all())

    def outline(self) -> Any:
        """The boundary of a mesh of the plane or of solid cells, or else all faces, without other vertices."""
        cells = self._cells(_FACES)
        if cells:
            return self._surface(_once([face for kind, _, data in cells for face in _parts(data, _FACES[kind])]))
        faces = [data for _, _, data in self._cells(("triangle", "quad"))]
        if not faces:
            raise FileError(f"{self._path}: has no triangles, quadrilaterals or solid cells, so it is no cage")
        if self._is_flat():
            edges = [data[:, [at, (at + 1) % data.shape[1]]] for data in faces for at in range(data.shape[1])]
            return _polygon(self.mesh.points[:, :2], _once(edges)[0], self._path)
        return self._surface(faces)

    def _surface(self, faces: List[Any]) -> Any:
        triangles = np.vstack([data[:, [0, at, at + 1]] for data in faces for at in range(1, data.shape[1] - 1)])
        used, facets = np.unique(triangles, return_inverse=True)
        return self.mesh.points[used], facets.reshape(-1, 3)

    def carry(self, mapping: Any, how: Any) -> Tally:
        dim, points = mapping.dim, np.asarray(self.mesh.points, dtype=float)
        if dim == 3 and points.shape[1] == 2:
            raise FileError(f"{self._path}: is of the plane, but the cages are of space")
        images = mapping(points[:, :dim])
        kinds = self._cells([kind for kind, corners in _CORNERS.items() if len(corners[0]) == dim + 1])
        if how.untangle:
            images = self._untangled(mapping, points[:, :dim], kinds)
        texts: List[str] = []
        n_bad, certified = 0, True
        for kind, curved, data in kinds:
            text, bad, sure = _judge(mapping, points[:, :dim], images, kind, curved, data)
            texts, n_bad, certified = [*texts, text], n_bad + bad, certified and sure and len(kinds) == 1
        n_others = sum(len(block.data) for block in self.mesh.cells) - sum(len(data) for _, _, data in kinds)
        texts += [f"{n_others} other cells carried"] if n_others else []
        texts += [rotate(self.mesh, mapping, points[:, :dim])] if how.rotate_vectors else []
        used = np.zeros(len(points), bool)
        for block in self.mesh.cells:
            used[np.ravel(block.data)] = True
        used = used if used.any() else ~used
        lost = np.isnan(images).any(axis=1)
        moved = points.copy()
        moved[:, :dim] = np.where(lost[:, None], points[:, :dim], images)
        self.mesh.points = moved
        n_lost = int((lost & used).sum())
        texts += [f"{n_lost} of {used.sum()} vertices lie outside the cage"] if n_lost else []
        return Tally("\n".join(texts), n_lost, n_bad, certified)

    def _untangled(self, mapping: Any, points: Any, kinds: List[Tuple[str, bool, Any]]) -> Any:
        if len(kinds) != 1 or kinds[0][0] not in ("triangle", "tetra") or kinds[0][1]:
            raise FileError(f"{self._path}: --untangle is for meshes of triangles or tetrahedra with straight sides")
        used, cells = np.unique(kinds[0][2], return_inverse=True)
        images = mapping(points)
        images[used] = mapping.repair(points[used], cells.reshape(kinds[0][2].shape))[0]
        return images

    def save(self, path: Path, row: Format) -> None:
        meshio = use("meshio", path, row.name)
        if row.reader == "by_gmsh":
            _convert(self.mesh, path)
            return
        mesh = self.mesh
        if row.driver in ("stl", "off", "obj", "ply"):
            mesh = meshio.Mesh(mesh.points, [block for block in mesh.cells if block.type in ("triangle", "quad")])
            if not mesh.cells:
                raise FileError(f"{path}: {row.name} holds triangles, and the mesh has none")
        # Fields and sets of one format may have no place in another, and neither may its points and lines as cells.
        most = max((block.dim for block in mesh.cells), default=0)
        solid = [block for block in mesh.cells if block.dim == most]
        bare = [(mesh, ""), (meshio.Mesh(mesh.points, mesh.cells), "fields and sets"),
                (meshio.Mesh(mesh.points, solid), f"fields, sets and cells of less than {most} dimensions")]
        for at, (each, left_out) in enumerate(bare):
            try:
                # Version 4.1 of Gmsh's format wants the numbers of parts of a model.
                is_old = row.driver == "gmsh" and "gmsh:dim_tags" not in each.point_data
                _silently(meshio.write, path, each, file_format="gmsh22" if is_old else row.driver)
            except Exception:
                if at == len(bare) - 1:
                    raise
            else:
                if left_out:
                    print(f"libicc: {path}: {row.name} cannot hold {left_out} of {self._path}; they are left out",
                          file=sys.stderr)
                return


def _silently(function: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
    """Calls meshio, which prints what its users know."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        return function(*arguments, **options)


def _parts(data: Any, parts: Any) -> List[Any]:
    return [data[:, list(part)] for part in parts]


def _once(faces: List[Any]) -> List[Any]:
    """The faces, or edges, that only one cell has, by their number of corners."""
    kept = []
    for width in sorted({face.shape[1] for face in faces}):
        every = np.vstack([face for face in faces if face.shape[1] == width])
        _, back, count = np.unique(np.sort(every, axis=1), axis=0, return_inverse=True, return_counts=True)
        kept.append(every[count[np.ravel(back)] == 1])
    return [face for face in kept if len(face)]


def _polygon(points: Any, edges: Any, path: Path) -> Any:
    """The outlines that edges make: the largest one, and the others as holes."""
    import libicc

    after = dict(edges.tolist())
    if len(after) < len(edges):
        raise FileError(f"{path}: its boundary meets itself in a vertex")
    rings = []
    while after:
        first, ring = next(iter(after)), []
        while first in after:
            ring.append(first)
            first = after.pop(first)
        rings.append(points[ring])
    rings.sort(key=lambda ring: -abs(_area(ring)))
    return libicc.Domain(rings[0], holes=rings[1:]) if len(rings) > 1 else rings[0]


def _area(ring: Any) -> float:
    x, y = ring.T
    return float(x @ np.roll(y, -1) - y @ np.roll(x, -1)) / 2


def _judge(mapping: Any, points: Any, images: Any, kind: str, curved: bool, data: Any) -> Tuple[str, int, bool]:
    """Checks cells of one kind by the exact signs of the simplices at their corners."""
    from .._core import indices

    corners = _CORNERS[kind]
    simplices = indices(np.concatenate(_parts(data, corners)), mapping.dim + 1, "simplices")
    given = np.isfinite(images[data]).all(axis=(1, 2))
    before, after = signs(points, simplices), signs(images, simplices)
    turned = (before * after).reshape(len(corners), -1)
    flat = (before.reshape(len(corners), -1) == 0).any(axis=0)
    inverted = (turned < 0).any(axis=0) & given
    collapsed = (turned == 0).any(axis=0) & given & ~inverted & ~flat
    kept = given & ~inverted & ~collapsed & ~flat
    is_simplex = len(corners) == 1 and not curved
    where = "" if is_simplex else " at their corners"
    bad = int(inverted.sum() + collapsed.sum())
    text = (f"{len(data)} {_NAMES[kind]}: {kept.sum()} keep their orientation{where}, {inverted.sum()} inverted, "
            f"{collapsed.sum()} collapsed, {flat.sum()} flat before, {(~given).sum()} without image")
    sure = False
    if is_simplex and bad == 0 and given.all():
        used, cells = np.unique(data, return_inverse=True)
        sure = bool(mapping.certify(points[used], cells.reshape(data.shape))[1].certified)
    text += "; mesh and image are certified one-to-one" if sure else "" if is_simplex else "; only simplices are certified"
    return text, bad, sure


def signs(points: Any, simplices: Any) -> Any:
    """The orientation of simplices, exactly: 1, -1 or 0 if flat."""
    edges = points[simplices[:, 1:]] - points[simplices[:, :1]]
    with np.errstate(invalid="ignore"):
        values = np.linalg.det(edges)
        # Far above what rounding may add; the few others are settled in fractions.
        size = np.abs(points[np.isfinite(points).all(axis=1)]).max(initial=0.0)
        unsure = np.flatnonzero(~(np.abs(values) > 1e-10 * size * np.abs(edges).max(axis=(1, 2)) ** (edges.shape[1] - 1)))
    result = np.where(np.isnan(values), 0, np.sign(values)).astype(int)
    for at in unsure:
        if np.isfinite(points[simplices[at]]).all():
            result[at] = _exact_sign(points[simplices[at]])
    return result


def _exact_sign(corners: Any) -> int:
    from fractions import Fraction

    rows = [[Fraction(float(x)) - Fraction(float(o)) for x, o in zip(corner, corners[0])] for corner in corners[1:]]
    if len(rows) == 2:
        value = rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0]
    else:
        (a, b, c), (d, e, f), (g, h, i) = rows
        value = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return (value > 0) - (value < 0)


def file(path: Path, choice: str, row: Format) -> Mesh:
    meshio = use("meshio", path, row.name)
    try:
        mesh = _silently(meshio.read, path)
    except SystemExit as error:  # meshio's way to refuse a file
        raise FileError(f"{path}: meshio cannot read it as {row.name}") from error
    return Mesh(mesh, path)


def obj(path: Path, choice: str, row: Format) -> Mesh:
    """OBJ, whose faces may have any number of corners. They become fans of triangles."""
    points: List[List[float]] = []
    triangles: List[List[int]] = []
    for line in path.read_text(errors="replace").splitlines():
        words = line.split()
        if words[:1] == ["v"]:
            points.append([float(word) for word in words[1:4]])
        elif words[:1] == ["f"]:
            face = [int(word.split("/")[0]) for word in words[1:]]
            face = [at - 1 if at > 0 else len(points) + at for at in face]
            triangles += [[face[0], *pair] for pair in zip(face[1:], face[2:])]
    meshio = use("meshio", path, row.name)
    return Mesh(meshio.Mesh(np.array(points), [("triangle", np.array(triangles))]), path)


def febio(path: Path, choice: str, row: Format) -> Mesh:
    """A FEBio model, of which nodes and elements count."""
    kinds = {"tet4": "tetra", "hex8": "hexahedron", "penta6": "wedge", "pyra5": "pyramid", "tri3": "triangle",
             "quad4": "quad", "tet10": "tetra10"}
    tree, cells = xml.parse(path).getroot(), []
    nodes = [node for part in tree.iter("Nodes") for node in part.iter("node")]
    number = {node.get("id"): at for at, node in enumerate(nodes)}
    for part in tree.iter("Elements"):
        kind = kinds.get(str(part.get("type")))
        if kind is None:
            raise FileError(f"{path}: elements of the type {part.get('type')} are not known; known are {', '.join(kinds)}")
        cells.append((kind, np.array([[number[at.strip()] for at in str(one.text).split(",")] for one in part])))
    points = np.array([[float(number) for number in str(node.text).split(",")] for node in nodes])
    return Mesh(use("meshio", path, row.name).Mesh(points, cells), path)


def by_gmsh(path: Path, choice: str, row: Format) -> Mesh:
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, "mesh.msh")
        _through_gmsh(path, copy)
        return Mesh(_silently(use("meshio", path, row.name).read, copy), path)


def _convert(mesh: Any, path: Path) -> None:
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder, "mesh.msh")
        _silently(use("meshio", path, "a mesh").write, copy, mesh, file_format="gmsh22", binary=False)
        _through_gmsh(copy, path)


def _through_gmsh(source: Path, target: Path) -> None:
    gmsh = use("gmsh", source, "this mesh")
    gmsh.initialize()
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("Mesh.SaveAll", 1)
        gmsh.option.setNumber("Mesh.MshFileVersion", 2.2)
        gmsh.open(str(source))
        gmsh.write(str(target))
    finally:
        gmsh.finalize()


def scene(path: Path, choice: str, row: Format) -> Any:
    """A glTF scene, as the command reads it."""
    return by_command(path, choice, ".obj")


def write_shape(domain: Any, path: Path) -> Optional[Any]:
    """Writes the boundary of a domain of space as a mesh."""
    meshio = use("meshio", path, "a surface")
    formats.write(Mesh(meshio.Mesh(domain.vertices, [("triangle", domain.facets.astype(np.int64))]), path), path)
    return None
