#!/usr/bin/env python3
"""mesh --rotate-vectors: vectors in VTK, VTU and Gmsh get the rotation of the map, and nothing else changes.

usage: test_vectors.py TOOL SCRATCH
Needs the standard library only. The cages are a cube and its image under a rotation times a stretch, so the map is that.
"""
import itertools
import json
import math
import os
import shutil
import struct
import subprocess
import sys

TOOL, SCRATCH = os.path.abspath(sys.argv[1]), sys.argv[2]
N_FAILED = 0
FACES = [[0, 1, 2], [2, 1, 3], [4, 6, 5], [6, 7, 5], [0, 4, 1], [4, 5, 1], [2, 3, 6], [6, 3, 7], [0, 2, 4], [4, 2, 6], [1, 5, 3], [5, 7, 3]]
POINTS = [[.25, .25, .25], [.75, .25, .25], [.25, .75, .25], [.25, .25, .75]]
ROTATION = [[.48, -.8, .36], [.64, .6, .48], [-.6, 0, .8]]
STRETCH = [[1.5, .25, 0], [.25, 1, .125], [0, .125, .75]]
VALUES = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.5], [0.0, 0.0, 0.0], [-0.125, 0.25, 64.0]]


def complain(text):
    global N_FAILED
    N_FAILED += 1
    print("FAILED:", text, file=sys.stderr)


def product(a, b):
    return [[sum(x * y for x, y in zip(row, column)) for column in zip(*b)] for row in a]


def times(a, v):
    return [sum(x * y for x, y in zip(row, v)) for row in a]


def inverse_transpose(a):
    def cofactor(i, j):
        p, q = a[(i + 1) % 3], a[(i + 2) % 3]
        return p[(j + 1) % 3] * q[(j + 2) % 3] - p[(j + 2) % 3] * q[(j + 1) % 3]
    return [[cofactor(i, j) for j in range(3)] for i in range(3)]


MAP = product(ROTATION, STRETCH)


def rotated(v):
    return times(ROTATION, v)


def turned_normal(v):
    image = times(inverse_transpose(MAP), v)
    return [x * math.hypot(*v) / (math.hypot(*image) or 1) for x in image]


def run(expected, *words):
    got = subprocess.run([TOOL, *words], capture_output=True, text=True)
    if got.returncode != expected:
        complain(f"exit {got.returncode} instead of {expected}: libicc {' '.join(words)}\n    {got.stderr}")
    return got


def write(name, content):
    with open(name, "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())


def off(points, faces):
    return f"OFF\n{len(points)} {len(faces)} 0\n" + "".join(" ".join(map(repr, map(float, p))) + "\n" for p in points) + \
        "".join("3 " + " ".join(map(str, f)) + "\n" for f in faces)


# --- files, whose vectors are given by functions of what they are in the source ------------------------------------------

def vtk(is_binary, is_new, vector, normal):
    """Legacy VTK with data of all sorts. Floats of 4 bytes hold few digits, so only doubles are vectors here."""
    def numbers(letter, values):
        values = list(itertools.chain(*values)) if values and isinstance(values[0], (list, tuple)) else list(values)
        return struct.pack(f">{len(values)}{letter}", *values) + b"\n" if is_binary else (" ".join(map(repr, values)) + "\n").encode()
    out = f"# vtk DataFile Version {'5.1' if is_new else '3.0'}\nVECTORS of all sorts\n{'BINARY' if is_binary else 'ASCII'}\n".encode()
    out += b"DATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n" + numbers("d", POINTS)
    if is_new:
        out += b"CELLS 3 7\nOFFSETS vtktypeint64\n" + numbers("q", [0, 4, 7]) + b"CONNECTIVITY vtktypeint64\n" + numbers("q", [0, 1, 2, 3, 0, 2, 1])
    else:
        out += b"CELLS 2 9\n" + numbers("i", [4, 0, 1, 2, 3, 3, 0, 2, 1])
    out += b"CELL_TYPES 2\n" + numbers("i", [10, 5])
    out += b"CELL_DATA 2\nSCALARS part int 1\nLOOKUP_TABLE default\n" + numbers("i", [7, -3])
    out += b"VECTORS flux double\n" + numbers("d", [vector(v) for v in VALUES[:2]])
    out += b"METADATA\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\nDATA 2 0 1\n\n"
    out += b"POINT_DATA 4\nNORMALS n double\n" + numbers("d", [normal(v) for v in VALUES])
    out += b"VECTORS velocity%20u double\n" + numbers("d", [vector(v) for v in VALUES])
    out += b"VECTORS steps int\n" + numbers("i", range(12)) + b"TENSORS t double\n" + numbers("d", [float(i) for i in range(36)])
    out += b"SCALARS s double\nLOOKUP_TABLE colours\n" + numbers("d", [1.0, 2, 3, 4])
    colours = [0, 255, 127, 63] if is_binary else [0.0, 1.0, 0.5, 0.25]
    out += b"LOOKUP_TABLE colours 1\n" + numbers("B", colours) + b"COLOR_SCALARS c 1\n" + numbers("B", colours)
    out += b"TEXTURE_COORDINATES uv 2 double\n" + numbers("d", [0.5 * i for i in range(8)])
    out += b"FIELD FieldData 3\nid 1 4 long\n" + numbers("q", [1, 2, 3, 4]) + b"w 3 4 double\n" + numbers("d", [vector(v) for v in VALUES])
    out += b"METADATA\nCOMPONENT_NAMES\nX\nY\nZ\n\n" + b"whole 3 1 double\n" + numbers("d", VALUES[:1])
    return out


def gmsh(is_binary, is_new, vector, normal):
    del normal

    def pack(letters, *values):
        return struct.pack("<" + letters, *values) if is_binary else (" ".join(map(repr, values)) + "\n").encode()
    tags = [3, 10, 20, 40]
    out = f"$MeshFormat\n{'4.1' if is_new else '2.2'} {int(is_binary)} 8\n".encode()
    out += (struct.pack("<i", 1) + b"\n") * is_binary + b"$EndMeshFormat\n"
    if is_new:
        out += b"$Nodes\n" + pack("4Q", 1, 4, 3, 40) + pack("3iQ", 3, 1, 0, 4) + b"".join(pack("Q", t) for t in tags) + b"".join(pack("3d", *p) for p in POINTS)
        out += b"\n$EndNodes\n$Elements\n" + pack("4Q", 2, 2, 5, 9) + pack("3iQ", 3, 1, 4, 1) + pack("5Q", 9, *tags)
        out += pack("3iQ", 2, 1, 2, 1) + pack("4Q", 5, 3, 20, 10)
    else:
        out += b"$Nodes\n4\n" + b"".join(pack("i3d", t, *p) for t, p in zip(tags, POINTS)) + b"\n$EndNodes\n$Elements\n2\n"
        if is_binary:
            out += pack("3i", 4, 1, 2) + pack("7i", 9, 7, 1, *tags) + pack("3i", 2, 1, 2) + pack("6i", 5, 7, 1, 3, 20, 10)
        else:
            out += pack("", 9, 4, 2, 7, 1, *tags) + pack("", 5, 2, 2, 7, 1, 3, 20, 10)
    out += b"\n$EndElements\n"
    for name, at in (("NodeData", list(zip([40, 3, 20], VALUES))), ("ElementData", list(zip([5, 9], VALUES)))):
        for n in (1, 3):
            out += f'${name}\n1\n"a {n} $ b"\n1\n0.5\n3\n2\n{n}\n{len(at)}\n'.encode()
            out += b"".join(pack(f"i{n}d", tag, *(vector(v) if n == 3 else v[:1])) for tag, v in at) + b"\n" * is_binary + f"$End{name}\n".encode()
    return out


def vtu(is_binary, is_new, vector, normal):
    """Raw bytes or text. `is_new`: sizes of 8 bytes."""
    data = b""

    def array(kind, name, n, values):
        nonlocal data
        values = list(itertools.chain(*values)) if isinstance(values[0], list) else values
        letter = {"Float64": "d", "Float32": "f", "Int32": "i", "UInt8": "B"}[kind]
        head = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{n}" format='
        if not is_binary:
            return head + '"ascii">' + " ".join(map(repr, values)) + "</DataArray>\n"
        packed = struct.pack(f"<{len(values)}{letter}", *values)
        offset = len(data)
        data += struct.pack("<Q" if is_new else "<I", len(packed)) + packed
        return head + f'"appended" offset="{offset}"/>\n'
    wide = ' header_type="UInt64"' * is_new
    out = f'<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"{wide}>\n<UnstructuredGrid>\n<Piece NumberOfPoints="4" NumberOfCells="2">\n'
    out += '<PointData Normals="n">\n' + array("Float64", "n", 3, [normal(v) for v in VALUES]) + array("Float64", "u", 3, [vector(v) for v in VALUES])
    out += array("Int32", "steps", 3, list(range(12))) + array("Float64", "s", 1, [1.0, 2.0, 3.0, 4.0]) + "</PointData>\n<CellData>\n"
    out += array("Float64", "flux", 3, [vector(v) for v in VALUES[:2]]) + "</CellData>\n<Points>" + array("Float64", "Points", 3, POINTS) + "</Points>\n<Cells>\n"
    out += array("Int32", "connectivity", 1, [0, 1, 2, 3, 0, 2, 1]) + array("Int32", "offsets", 1, [4, 7]) + array("UInt8", "types", 1, [10, 5])
    out += "</Cells>\n</Piece>\n</UnstructuredGrid>\n"
    return out.encode() + (b'<AppendedData encoding="raw">\n_' + data + b"\n</AppendedData>\n") * is_binary + b"</VTKFile>\n"


# --- checks ------------------------------------------------------------------------------------------------------------

def same_words(one, two):
    """Texts with the same words, where numbers may differ by rounding."""
    a, b = one.replace(b"<", b" < ").replace(b">", b" > ").split(), two.replace(b"<", b" < ").replace(b">", b" > ").split()

    def close(x, y):
        try:
            return x == y or abs(float(x) - float(y)) <= 1e-12 * (1 + abs(float(y)))
        except ValueError:
            return False
    return len(a) == len(b) and all(map(close, a, b))


def same_doubles(one, two):
    """Bytes that agree but for doubles that differ by rounding, wherever these begin."""
    if len(one) != len(two):
        return False
    at = 0
    while at < len(one):
        if one[at] == two[at]:
            at += 1
            continue
        begins = [k for k in range(max(0, at - 7), at + 1) for order in "<>" if k + 8 <= len(one) and
                  abs(struct.unpack_from(order + "d", one, k)[0] - struct.unpack_from(order + "d", two, k)[0]) <= 1e-9]
        if not begins:
            return False
        at = min(begins) + 8
    return True


def require_rotated():
    for make, name, counts in ((vtk, "a.vtk", (14, 4)), (gmsh, "a.msh", (5, 2)), (vtu, "a.vtu", (10, 3))):
        for is_binary, is_new in itertools.product((False, True), repeat=2):
            what = f"{name}, {'bytes' if is_binary else 'text'}, {'new' if is_new else 'old'}"
            write(name, make(is_binary, is_new, list, list))
            run(0, "mesh", "-s", "before.off", "-t", "after.off", name, "plain" + name)
            got = run(0, "mesh", "-s", "before.off", "-t", "after.off", "--rotate-vectors", name, "out" + name)
            line = f"{counts[0]} vectors in {counts[1]} arrays: {counts[0]} rotated, 0 not rotated\n"
            if line not in got.stdout or got.stderr:
                complain(f"{what}: {got.stdout}{got.stderr}")
            out, plain = open("out" + name, "rb").read(), open("plain" + name, "rb").read()
            images = run(0, "map", "-s", "before.off", "-t", "after.off", "-p", "points.txt").stdout.split()
            images = [list(map(float, images[i:i + 3])) for i in (0, 3, 6, 9)]
            old, POINTS[:] = [p[:] for p in POINTS], images
            for content, expected in ((plain, make(is_binary, is_new, list, list)), (out, make(is_binary, is_new, rotated, turned_normal))):
                if not (same_doubles if is_binary else same_words)(content, expected):
                    complain(f"{what}: {'other vectors than expected' if content is out else 'without the option, other bytes than expected'}")
            POINTS[:] = old
            if out == plain:
                complain(f"{what}: nothing was rotated")
            report = json.loads(run(0, "mesh", "-s", "before.off", "-t", "after.off", "--rotate-vectors", "--json", name, "out" + name).stdout)
            if (report["vectors"], report["vectors_not_rotated"]) != (counts[0], 0):
                complain(f"{what}: {report}")
            # There and back again.
            run(0, "mesh", "-s", "before.off", "-t", "after.off", "-i", "--rotate-vectors", "out" + name, "back" + name)
            back = open("back" + name, "rb").read()
            if not (same_doubles if is_binary else same_words)(back, open(name, "rb").read()):
                complain(f"{what}: not the same there and back")


def require_plane():
    """In the plane the third component stays, and a picture's y, which points down, is heeded."""
    for down, y_source, y_target, expected in (((), 1, 1, [4, 3, 7]), (("--y-down", "target"), 1, -1, [4, -3, 7]),
                                               (("--y-down", "source"), -1, 1, [4, 3, 7])):
        write("flat.vtk", f"# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 3 float\n1 {y_source} 0 3 {y_source} 0 "
                          f"1 {3 * y_source} 0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\nCELL_DATA 1\nFIELD f 1\nv 3 1 float\n5 0 7\n")
        for name, y, points in (("s.txt", y_source, [(0, 0), (4, 0), (4, 4), (0, 4)]),
                                ("t.txt", y_target, [(0, 0), (6.4, 4.8), (1.6, 11.2), (-4.8, 6.4)])):
            write(name, "".join(f"{px} {y * py}\n" for px, py in points))
        run(0, "mesh", "-s", "s.txt", "-t", "t.txt", *down, "--rotate-vectors", "flat.vtk", "turned.vtk")
        got = list(map(float, open("turned.vtk").read().split("float\n")[-1].split()))
        if any(abs(a - b) > 1e-12 for a, b in zip(got, expected)):
            complain(f"in the plane, {down}: {got}")


def require_refusals():
    text = vtk(False, False, list, list).decode()
    for old, new, *words in (("VECTORS flux double", "SPINORS flux double", "SPINORS"), ("POINT_DATA 4", "POINT_DATA 5", "data of 5 points; there are 4"),
                             ("0.5 0.0 0.0 0.0 -0.125 0.25", "0.5 0.0 x 0.0 -0.125 0.25", "'x' is not a number"),
                             ("id 1 4 long", "id 1 4 string", "an array of the type 'string'"),
                             ("whole 3 1 double\n1.0 0.0 0.0", "whole 3 1 double\n1.0 0.0", "the file ends early")):
        write("spoilt.vtk", text.replace(old, new, 1))
        got = run(1, "mesh", "-s", "before.off", "-t", "after.off", "--rotate-vectors", "spoilt.vtk", "none.vtk")
        if not got.stderr.startswith("libicc: spoilt.vtk:") or not all(w in got.stderr for w in words) or os.path.exists("none.vtk"):
            complain(f"not told {words}: {got.stderr}")
    raw = vtk(True, True, list, list)
    write("spoilt.vtk", raw[:-10])
    got = run(1, "mesh", "-s", "before.off", "-t", "after.off", "--rotate-vectors", "spoilt.vtk", "none.vtk")
    if "the file ends early" not in got.stderr:
        complain(f"a short file: {got.stderr}")
    # Values that are not finite stay, and a file without vectors has none.
    write("nan.vtk", text.replace("VECTORS velocity%20u double\n1.0", "VECTORS velocity%20u double\nnan"))
    run(0, "mesh", "-s", "before.off", "-t", "after.off", "--rotate-vectors", "nan.vtk", "out.vtk")
    if "double\nnan 0.0 0.0 " not in open("out.vtk").read():
        complain("a vector that is not finite has changed")
    got = run(0, "mesh", "-s", "before.off", "-t", "after.off", "--rotate-vectors", "before.off", "out.off")
    if "0 vectors in 0 arrays: 0 rotated, 0 not rotated" not in got.stdout:
        complain(f"no vectors: {got.stdout}")
    run(2, "mesh", "--fill", "--rotate-vectors", "before.off", "out.vtk")


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    corners = [list(p) for p in itertools.product((0.0, 1.0), repeat=3)]
    write("before.off", off(corners, FACES))
    write("after.off", off([times(MAP, p) for p in corners], FACES))
    write("points.txt", "".join(" ".join(map(repr, p)) + "\n" for p in POINTS))
    require_rotated()
    require_plane()
    require_refusals()
    os.chdir("/")
    if N_FAILED == 0:
        shutil.rmtree(SCRATCH)
    sys.exit(N_FAILED > 0)


main()
