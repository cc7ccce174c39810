#!/usr/bin/env python3
"""VTU as VTK and meshio write it, in every form, and as VTK reads what the command has written. Vectors in VTU and legacy VTK.

usage: test_vtu.py TOOL SCRATCH

Only the points may change, and the rest of each grid stays: cells, types, arrays of points, of cells and of the whole
grid. Without VTK (python3-vtk9) or meshio the parts that need them are skipped (exit code 77 if both are missing).
"""
import itertools
import os
import shutil
import subprocess
import sys

try:
    import numpy as np
except ImportError:
    sys.exit(77)
try:
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
except ImportError:
    vtk = None
try:
    import meshio
except ImportError:
    meshio = None

TOOL = os.path.abspath(sys.argv[1])
FAILURES = []
CORNERS = np.array(list(itertools.product((0.0, 1.0), repeat=3)))
FACES = [[0, 1, 2], [2, 1, 3], [4, 6, 5], [6, 7, 5], [0, 4, 1], [4, 5, 1], [2, 3, 6], [6, 3, 7], [0, 2, 4], [4, 2, 6], [1, 5, 3], [5, 7, 3]]
# The images of corners under an affine map, and a grid inside of all kinds of cells that VTK makes.
MATRIX = np.array([[1.25, 0.25, 0], [0, 1, 0.5], [0.125, 0, 1.5]])
SHIFT = np.array([2, -1, 0.5])


def check(good, what):
    if not good:
        FAILURES.append(what)
        print("FAILED:", what, file=sys.stderr)


def off(path, points):
    with open(path, "w") as file:
        file.write(f"OFF\n{len(points)} {len(FACES)} 0\n")
        file.writelines(" ".join(map(repr, map(float, p))) + "\n" for p in points)
        file.writelines("3 " + " ".join(map(str, f)) + "\n" for f in FACES)


def mapped(name, out, expected=0, words=()):
    run = subprocess.run([TOOL, "mesh", "-s", "before.off", "-t", "after.off", *words, name, out], capture_output=True, text=True)
    check(run.returncode == expected, f"{name}: exit {run.returncode}: {run.stderr}")
    return run.returncode == expected


def lattice(n):
    """n^3 points inside the cube, and the corners of its cells in VTK's order."""
    at = (np.arange(n) + 0.5) / n
    points = np.array([(x, y, z) for z in at for y in at for x in at])
    number = np.arange(n ** 3).reshape(n, n, n)
    cells = [number[[k, k, k, k, k + 1, k + 1, k + 1, k + 1], [j, j, j + 1, j + 1, j, j, j + 1, j + 1],
                    [i, i + 1, i + 1, i, i, i + 1, i + 1, i]].tolist()
             for k in range(n - 1) for j in range(n - 1) for i in range(n - 1)]
    return points, cells


def grid(kind):
    """A grid of tetrahedra, hexahedra, prisms, pyramids, polygons, lines and a polyhedron, with arrays of all sorts."""
    points, cells = lattice(4)
    out = vtk.vtkUnstructuredGrid()
    out.SetPoints(vtk.vtkPoints())
    array = numpy_to_vtk(points.astype(kind), deep=True)
    array.SetName("Points")
    out.GetPoints().SetData(array)
    for i, c in enumerate(cells):
        if i == 0:
            faces = [[c[k] for k in f] for f in ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))]
            stream = vtk.vtkIdList()
            for x in [len(faces)] + [x for f in faces for x in [len(f)] + f]:
                stream.InsertNextId(x)
            out.InsertNextCell(vtk.VTK_POLYHEDRON, stream)
        elif i % 5 == 1:
            out.InsertNextCell(vtk.VTK_HEXAHEDRON, 8, c)
        elif i % 5 == 2:
            for p in ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7)):
                out.InsertNextCell(vtk.VTK_WEDGE, 6, [c[k] for k in p])
        elif i % 5 == 3:
            out.InsertNextCell(vtk.VTK_PYRAMID, 5, [c[k] for k in (0, 1, 2, 3, 4)])
        else:
            for p in ((0, 1, 2, 6), (0, 5, 1, 6), (0, 4, 5, 6)):
                out.InsertNextCell(vtk.VTK_TETRA, 4, [c[k] for k in p])
    out.InsertNextCell(vtk.VTK_LINE, 2, [0, 1])
    out.InsertNextCell(vtk.VTK_POLYGON, 5, [0, 1, 5, 6, 4])
    for data, n in ((out.GetPointData(), out.GetNumberOfPoints()), (out.GetCellData(), out.GetNumberOfCells())):
        for name, values in (("velocity", np.sin(np.arange(3.0 * n)).reshape(n, 3).astype("f4")), ("id", np.arange(n, dtype="i8")),
                             ("stress", np.arange(9.0 * n).reshape(n, 9)), ("small", np.arange(n).astype("u1"))):
            array = numpy_to_vtk(values, deep=True)
            array.SetName(name)
            data.AddArray(array)
    names = vtk.vtkStringArray()
    names.SetName("names")
    names.InsertNextValue("one <two>")
    out.GetFieldData().AddArray(names)
    return out


def read(name):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(name)
    reader.Update()
    return reader.GetOutput()


def arrays(data):
    out = {}
    for i in range(data.GetNumberOfArrays()):
        array = data.GetAbstractArray(i)
        is_text = array.IsA("vtkStringArray")
        out[array.GetName()] = [array.GetValue(k) for k in range(array.GetNumberOfValues())] if is_text else vtk_to_numpy(array)
    return out


def same_arrays(one, two):
    a, b = arrays(one), arrays(two)
    return a.keys() == b.keys() and all(np.array_equal(a[k], b[k]) for k in a)


def compare(name, before, after):
    """Only the points have changed, and these are images."""
    points = vtk_to_numpy(before.GetPoints().GetData()).astype(float)
    images = vtk_to_numpy(after.GetPoints().GetData())
    check(images.dtype == np.float64, f"{name}: points are {images.dtype}")
    check(images.shape == points.shape and np.abs(images - points @ MATRIX.T - SHIFT).max() < 1e-12, f"{name}: points")
    check(before.GetNumberOfCells() == after.GetNumberOfCells(), f"{name}: cells")
    for what in ("GetConnectivityArray", "GetOffsetsArray"):
        check(np.array_equal(*(vtk_to_numpy(getattr(g.GetCells(), what)()) for g in (before, after))), f"{name}: {what}")
    check(np.array_equal(*(vtk_to_numpy(g.GetCellTypesArray()) for g in (before, after))), f"{name}: types")
    for what in ("GetPointData", "GetCellData", "GetFieldData"):
        check(same_arrays(getattr(before, what)(), getattr(after, what)()), f"{name}: {what}")


def of_vtk():
    writer = vtk.vtkXMLUnstructuredGridWriter()
    outputs = []
    for kind in ("f4", "f8"):
        writer.SetInputData(grid(kind))
        for mode, coded, zipped, wide, big in itertools.product(("Ascii", "Binary", "Appended"), (False, True), (False, True), (False, True),
                                                                (False, True)):
            if (mode != "Appended" and coded) or (mode == "Ascii" and (zipped or wide or big)):
                continue
            getattr(writer, "SetDataModeTo" + mode)()
            writer.SetEncodeAppendedData(coded)
            getattr(writer, "SetCompressorTypeTo" + ("ZLib" if zipped else "None"))()
            writer.SetBlockSize(264) # several blocks
            getattr(writer, "SetHeaderTypeTo" + ("UInt64" if wide else "UInt32"))()
            getattr(writer, "SetByteOrderTo" + ("BigEndian" if big else "LittleEndian"))()
            name = f"{kind}{mode}{'Coded' * coded}{'Zipped' * zipped}{'Wide' * wide}{'Big' * big}.vtu"
            writer.SetFileName(name)
            writer.Write()
            if mapped(name, "out_" + name, 4): # a polyhedron is undecided
                compare(name, read(name), read("out_" + name))
                outputs.append(name)
                text = [open(n, "rb").read() for n in (name, "out_" + name)]
                for word in (b'format="ascii"', b'format="binary"', b'format="appended"', b'encoding="raw"', b"vtkZLibDataCompressor",
                             b'"UInt64"', b'"BigEndian"'):
                    check(text[0].count(word) == text[1].count(word), f"{name}: {word}")
    # Several pieces.
    if outputs:
        writer.SetNumberOfPieces(3)
        writer.SetFileName("pieces.vtu")
        writer.Write()
        if mapped("pieces.vtu", "out_pieces.vtu", 4):
            compare("pieces.vtu", read("pieces.vtu"), read("out_pieces.vtu"))


def with_vectors():
    """The grid with vectors, normals and what legacy VTK has sections of its own for."""
    out = grid("f8")
    n, n_cells = out.GetNumberOfPoints(), out.GetNumberOfCells()
    normals = np.random.default_rng(1).normal(size=(n, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    ids = vtk.vtkIdTypeArray()
    for i in range(n):
        ids.InsertNextValue(i)
    ids.SetName("ids")
    out.GetPointData().SetGlobalIds(ids)
    for data, call, name, values in (
            (out.GetPointData(), "SetNormals", "Normals", normals.astype("f4")), (out.GetPointData(), "SetVectors", "a vector", normals),
            (out.GetPointData(), "SetScalars", "s", normals[:, 0].copy()), (out.GetPointData(), "SetTCoords", "uv", normals[:, :2].copy()),
            (out.GetPointData(), "SetTensors", "t", np.arange(9.0 * n).reshape(n, 9)),
            (out.GetCellData(), "SetScalars", "colours", np.arange(3 * n_cells).reshape(n_cells, 3).astype("u1"))):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        getattr(data, call)(array)
    out.GetFieldData().Initialize()
    return out


def of_vectors():
    u, _, v = np.linalg.svd(MATRIX)
    rotation, cofactors = u @ v, np.linalg.inv(MATRIX).T

    def read_legacy(name):
        reader = vtk.vtkUnstructuredGridReader()
        reader.SetFileName(name)
        for what in ("Scalars", "Vectors", "Normals", "Tensors", "TCoords", "Fields"):
            getattr(reader, f"ReadAll{what}On")()
        reader.Update()
        return reader.GetOutput()

    legacy, xml = vtk.vtkUnstructuredGridWriter(), vtk.vtkXMLUnstructuredGridWriter()
    for name, writer, how in [(f"v{v}{'b' * b}.vtk", legacy, (v, b)) for v in (42, 51) for b in (0, 1)] + [("v.vtu", xml, None)]:
        writer.SetInputData(with_vectors())
        writer.SetFileName(name)
        if how:
            writer.SetFileVersion(how[0])
            writer.SetFileType(how[1] + 1)
        writer.Write()
        if not mapped(name, "out_" + name, 4, ("--rotate-vectors",)):
            continue
        before, after = ((read_legacy if how else read)(n) for n in (name, "out_" + name))
        for what in ("GetPointData", "GetCellData"):
            one, two = (arrays(getattr(g, what)()) for g in (before, after))
            check(sorted(one) == sorted(two), f"{name}: {sorted(two)}")
            for key in one:
                if key == "Normals":
                    images = one[key] @ cofactors.T
                    check(np.abs(images / np.linalg.norm(images, axis=1)[:, None] - two[key]).max() < 1e-6, f"{name}: normals")
                elif key in ("velocity", "a vector"):
                    check(np.abs(one[key] @ rotation.T - two[key]).max() < (1e-6 if key == "velocity" else 1e-12), f"{name}: {key}")
                else:
                    check(np.array_equal(one[key], two[key]), f"{name}: {key}")


def of_meshio():
    points, cells = lattice(3)
    mesh = meshio.Mesh(points, [("hexahedron", cells)], point_data={"v": points * 2, "s": points[:, 0]}, cell_data={"c": [np.arange(len(cells))]})
    for name, how in (("text.vtu", {"binary": False}), ("plain.vtu", {"compression": None}), ("zlib.vtu", {"compression": "zlib"})):
        meshio.write(name, mesh, **how)
        if mapped(name, "out_" + name):
            back, first = meshio.read("out_" + name), meshio.read(name)
            check(np.abs(back.points - points @ MATRIX.T - SHIFT).max() < 1e-12, f"{name}: points")
            check(np.array_equal(back.cells[0].data, first.cells[0].data), f"{name}: cells")
            check(np.array_equal(back.point_data["v"], first.point_data["v"]) and np.array_equal(back.cell_data["c"][0], first.cell_data["c"][0]),
                  f"{name}: data")


def main():
    if vtk is None and meshio is None:
        sys.exit(77)
    shutil.rmtree(sys.argv[2], ignore_errors=True)
    os.makedirs(sys.argv[2])
    os.chdir(sys.argv[2])
    off("before.off", CORNERS)
    off("after.off", CORNERS @ MATRIX.T + SHIFT)
    if vtk is not None:
        of_vtk()
        of_vectors()
    if meshio is not None:
        of_meshio()
    if not FAILURES:
        os.chdir("/")
        shutil.rmtree(sys.argv[2])
    sys.exit(len(FAILURES) > 0)


main()
