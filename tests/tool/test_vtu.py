#!/usr/bin/env python3
"""VTU (VTK's XML format) in all its forms: only the points change, byte for byte, and spoilt files are named.

usage: test_vtu.py TOOL SCRATCH
Needs the standard library only; test_vtu_forms.py asks VTK and meshio.
"""
import base64
import itertools
import os
import shutil
import struct
import subprocess
import sys
import zlib

TOOL, SCRATCH = os.path.abspath(sys.argv[1]), sys.argv[2]
N_FAILED = 0
CORNERS = [list(p) for p in itertools.product((0.0, 1.0), repeat=3)]
MOVED = [[0, 0, 0], [0, .25, 1], [0, 1, 0], [0, 1.25, 1], [1, 0, 0], [1, .25, 1.25], [1, 1, 0], [1.5, 1.25, 1]]
FACES = [[0, 1, 2], [2, 1, 3], [4, 6, 5], [6, 7, 5], [0, 4, 1], [4, 5, 1], [2, 3, 6], [6, 3, 7], [0, 2, 4], [4, 2, 6], [1, 5, 3], [5, 7, 3]]
POINTS = [[.25, .25, .25], [.75, .25, .25], [.25, .75, .25], [.25, .25, .75]]
LETTERS = {"Float32": "f", "Float64": "d", "Int16": "h", "Int32": "i", "Int64": "q", "UInt8": "B"}


def complain(text):
    global N_FAILED
    N_FAILED += 1
    print("FAILED:", text, file=sys.stderr)


def run(expected, *words):
    got = subprocess.run([TOOL, *words], capture_output=True, text=True)
    if got.returncode != expected:
        complain(f"exit {got.returncode} instead of {expected}: libicc {' '.join(words)}\n    {got.stderr}")
    return got


def write(name, content):
    with open(name, "wb") as file:
        file.write(content if isinstance(content, bytes) else content.encode())


def off(points, faces):
    return f"OFF\n{len(points)} {len(faces)} 0\n" + "".join(" ".join(map(repr, p)) + "\n" for p in points) + \
        "".join("3 " + " ".join(map(str, f)) + "\n" for f in faces)


def shown(number):
    short = f"{number:.15g}"
    return short if float(short) == number else f"{number:.17g}"


class Form:
    """A way to write arrays: `kind` is ascii, binary (base64 in place), raw or base64 (appended)."""

    def __init__(self, kind, zipped=False, wide=False, big=False, block=40):
        self.kind, self.zipped, self.wide, self.big, self.block = kind, zipped, wide, big, block
        self.order = ">" if big else "<"

    def __str__(self):
        return f"{self.kind}{'_zipped' * self.zipped}{'_wide' * self.wide}{'_big' * self.big}"

    def words(self, *numbers):
        return struct.pack(f"{self.order}{len(numbers)}{'Q' if self.wide else 'I'}", *numbers)

    def block_of(self, data, coded):
        """Bytes with their sizes before them, perhaps as text."""
        code = base64.b64encode if coded else bytes
        if not self.zipped:
            return code(self.words(len(data)) + data)
        parts = [zlib.compress(data[i:i + self.block]) for i in range(0, len(data), self.block)]
        head = self.words(len(parts), self.block, len(data) % self.block, *map(len, parts))
        return code(head) + code(b"".join(parts))

    def file(self, pieces, is_plain=False):
        """A file of pieces, which are lists of (section, name, type, components, numbers)."""
        appended, out = b"", b""
        for piece in pieces:
            sections = {}
            for section, name, kind, n, numbers in piece:
                data = struct.pack(f"{self.order}{len(numbers)}{LETTERS[kind]}", *numbers)
                head = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{n}"'
                if self.kind == "ascii":
                    array = f'{head} format="ascii">\n' + " ".join(map(shown, numbers)) + "\n</DataArray>"
                elif self.kind == "binary":
                    array = f'{head} format="binary">\n  {self.block_of(data, True).decode()}\n</DataArray>'
                else:
                    array = f'{head} format="appended" offset="{len(appended)}"/>'
                    appended += self.block_of(data, self.kind == "base64")
                sections.setdefault(section, []).append(array)
            n_points, n_cells = len(piece[0][4]) // 3, [len(a[4]) for a in piece if a[1] == "types"][0]
            out += f'<Piece NumberOfPoints="{n_points}" NumberOfCells="{n_cells}">\n'.encode()
            out += "".join(f"<{s}>\n" + "\n".join(a) + f"\n</{s}>\n" for s, a in sections.items()).encode() + b"</Piece>\n"
        words = ' header_type="UInt64"' * self.wide + ' compressor="vtkZLibDataCompressor"' * self.zipped
        tail = b""
        if self.kind in ("raw", "base64"):
            tail = f'<AppendedData encoding="{self.kind}">\n _'.encode() + appended + b"\n</AppendedData>\n"
        return (f'<?xml version="1.0"?>\n<!-- a <mesh> -->\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="'
                f'{"Big" if self.big else "Little"}Endian"{words}>\n<UnstructuredGrid>\n').encode() + out + b"</UnstructuredGrid>\n" + \
            tail + b"</VTKFile>\n"


def pieces_of(points, kind="Float64"):
    """Two pieces: a tetrahedron and a face, and the tetrahedron again. The points come between other arrays."""
    flat = [x for p in points for x in p]
    one = [("Points", "Points", kind, 3, flat),
           ("PointData", "velocity", "Float32", 3, [0.5 * i for i in range(12)]), ("CellData", "part", "Int16", 1, [-7, 300]),
           ("Cells", "connectivity", "Int64", 1, [0, 1, 2, 3, 0, 2, 1]), ("Cells", "offsets", "Int32", 1, [4, 7]),
           ("Cells", "types", "UInt8", 1, [10, 5])]
    two = [one[0], ("Cells", "connectivity", "Int32", 1, [0, 1, 2, 3]), ("Cells", "offsets", "Int64", 1, [4]), ("Cells", "types", "UInt8", 1, [10])]
    return [one, two]


def inflated(form, content):
    """A file with all that is compressed inflated, for comparison."""
    out, data = [], content
    while (at := data.find(b"\x78\x9c")) >= 0:
        inflate = zlib.decompressobj()
        try:
            out += [data[:at], inflate.decompress(data[at:])]
            data = inflate.unused_data
        except zlib.error:
            out.append(data[:at + 1])
            data = data[at + 1:]
    return out + [data]


def require_forms():
    images = run(0, "map", "-s", "before.off", "-t", "after.off", "-p", "points.txt").stdout.split("\n")[:4]
    images = [list(map(float, line.split())) for line in images]
    forms = [Form("ascii")] + [Form(kind, zipped, wide, big) for kind in ("binary", "raw", "base64") for zipped in (False, True)
                               for wide, big in ((False, zipped), (True, not zipped))]
    for form in forms:
        name = f"{form}.vtu"
        write(name, form.file(pieces_of(POINTS)))
        got = run(0, "mesh", "-s", "before.off", "-t", "after.off", name, "out.vtu")
        if "2 tetrahedra: 2 keep their orientation" not in got.stdout:
            complain(f"{name}: {got.stdout}")
        expected, written = form.file(pieces_of(images)), open("out.vtu", "rb").read()
        if form.zipped: # another library may deflate otherwise
            if form.kind == "raw" and inflated(form, written)[1::2] != inflated(form, expected)[1::2]:
                complain(f"{name}: other numbers than expected")
            run(0, "mesh", "-s", "after.off", "-t", "before.off", "out.vtu", "back.vtu")
        elif written != expected:
            complain(f"{name}: other bytes than expected")
        # Points of floats become doubles, and what comes after them moves.
        write("float.vtu", form.file(pieces_of(POINTS, "Float32")))
        run(0, "mesh", "-s", "before.off", "-t", "after.off", "float.vtu", "double.vtu")
        if open("double.vtu", "rb").read() != written:
            complain(f"{name}: floats give other bytes than doubles")


def require_cages():
    """A VTU is its own cage: the boundary of its tetrahedra, or its faces."""
    tetrahedron = [[0., 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    piece = pieces_of(tetrahedron)[1]
    write("small.vtu", Form("raw", True).file([piece]))
    piece[0] = (*piece[0][:4], [2 * x for x in piece[0][4]])
    write("large.vtu", Form("binary").file([piece]))
    write("one.txt", "0.25 0.25 0.25\n")
    for words in ((), ("--mesh", "small.vtu", "--target-mesh", "large.vtu")):
        got = run(0, "map", "-s", "small.vtu", "-t", "large.vtu", *words, "-p", "one.txt").stdout
        if [float(x) for x in got.split()] != [.5, .5, .5]:
            complain(f"a cage of VTU: {got}")
    square = [("Points", "Points", "Float32", 3, [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]), ("Cells", "connectivity", "Int32", 1, [0, 1, 2, 3]),
              ("Cells", "offsets", "Int32", 1, [4]), ("Cells", "types", "UInt8", 1, [9])]
    write("square.vtu", Form("base64").file([square]))
    got = run(0, "check", "-s", "square.vtu").stdout
    if "a simple polygon, 4 vertices, counter-clockwise, area 1" not in got:
        complain(f"a square of VTU: {got}")


def spoilt(content, *words):
    write("spoilt.vtu", content)
    got = run(1, "mesh", "-s", "before.off", "-t", "after.off", "spoilt.vtu", "none.vtu")
    if not got.stderr.startswith("libicc: spoilt.vtu:") or len(got.stderr.splitlines()) != 1 or not all(w in got.stderr for w in words):
        complain(f"not told {words}: {got.stderr}")
    if os.path.exists("none.vtu"):
        complain(f"written although spoilt: {words}")
        os.remove("none.vtu")


def require_refusals():
    text = Form("ascii").file(pieces_of(POINTS)).decode()
    for old, new, *words in (
            ("0.75 0.25 0.25", "0.75 x 0.25", ":", "'x' where number 4 of 12 of the array 'Points' is expected"),
            ("0.75 0.25 0.25", "0.75 nan 0.25", "vertex 1 is not finite"),
            ("0.75 0.25 0.25", "0.75 0.25", "where number 11 of 12"),
            ("0.75 0.25 0.25", "0.75 0.25 0.25 1", "has more than 12 numbers"),
            ('NumberOfPoints="4"', 'NumberOfPoints="3999999999"', "has no room for"),
            ('NumberOfPoints="4"', 'NumberOfPoints="-4"', "'-4' where a whole number"),
            ('NumberOfPoints="4"', '', "has no NumberOfPoints"),
            ('NumberOfComponents="3"', 'NumberOfComponents="2"', "the points have 2 components"),
            ('Name="offsets"', 'Name="ends"', "piece 0 has no array 'offsets'"),
            ("\n4 7\n", "\n8 7\n", "the array 'offsets' is 8; it lies in 0..7"),
            ("0 1 2 3 0 2 1", "0 1 2 3 0 2 4", "the array 'connectivity' is 4; it lies in 0..3"),
            ("0 1 2 3 0 2 1", "0 1 2 3 0 2 0.5", "is 0.5; it lies"),
            ("\n10 5\n", "\n10 9\n", "cell 1 has 3 corners, but type 9"),
            ('type="Float64"', 'type="String"', "is not of a type of numbers"),
            ("</Points>", '<DataArray type="Float32"/></Points>', "several arrays of points"),
            ("</VTKFile>", "", "the file ends early"),
            ("UnstructuredGrid", "PolyData", "a VTK file in XML", "ParaView")):
        spoilt(text.replace(old, new, 1), *words)
    lzma = Form("raw", True).file(pieces_of(POINTS)).replace(b"vtkZLibDataCompressor", b"vtkLZMADataCompressor")
    spoilt(lzma, "compressed by 'vtkLZMADataCompressor'", "ZLib", "python3 -m libicc")
    raw = Form("raw").file(pieces_of(POINTS))
    spoilt(raw.replace(b'Name="Points" NumberOfComponents="3" format="appended" offset="0"',
                       b'Name="Points" NumberOfComponents="3" format="appended" offset="999999"'), "offset '999999' where a whole number")
    spoilt(raw.replace(b'offset="0"', b'offset="900"'), "the bytes of the array 'Points' end early")
    spoilt(raw.replace(b'Name="velocity" NumberOfComponents="3" format="appended" offset="100"',
                       b'Name="velocity" NumberOfComponents="3" format="appended" offset="50"'), "'Points' and 'velocity' share their bytes")
    spoilt(raw.replace(b"\n _", b"\n "), "do not begin with an underscore")
    spoilt(raw[:raw.index(b"<AppendedData")] + b"</VTKFile>", "there are no AppendedData")
    spoilt(raw.replace(b"_" + struct.pack("<I", 96), b"_" + struct.pack("<I", 95)), "has 95 bytes where 96 are expected")
    coded = Form("binary").file(pieces_of(POINTS))
    at = coded.index(b"Points", coded.index(b"<DataArray")) + 120
    for bad in (coded[:at] + b"*" + coded[at + 1:], coded[:at] + coded[at + 1:], coded[:at] + b"=" + coded[at + 1:]):
        spoilt(bad, "the bytes of the array 'Points' end early, or are not base64")
    spoilt(coded[:at], "the file ends early")
    # Blocks that would become larger or smaller than they are declared, and sizes that no file can have.
    zipped = Form("raw", True, block=96).file(pieces_of(POINTS))
    begin = zipped.index(b"\n _") + 3
    head, rest = struct.unpack("<4I", zipped[begin:begin + 16]), zipped[begin + 16:]
    bomb = zlib.compress(bytes(1 << 20))
    for numbers, packed, *words in (
            (head[:3] + (len(bomb),), bomb, "a compressed block of the array 'Points' is not 96 bytes of zlib"),
            (head[:3] + (head[3] - 1,), rest, "is not 96 bytes of zlib"),
            (head[:3] + (1 << 31,), rest, "end early"),
            ((1, 1 << 31, 0, head[3]), rest, "has 2147483648 bytes where 96 are expected"),
            ((1 << 31, 96, 0, head[3]), rest, "end early"),
            ((1, 95, 96, head[3]), rest, "end early")):
        spoilt(zipped[:begin] + struct.pack("<4I", *numbers) + packed, *words)
    # So many points that only a bomb could hold them: nothing is allocated for them.
    many = zipped.replace(b'NumberOfPoints="4"', b'NumberOfPoints="400000000"', 1)
    spoilt(many, "has no room for")


def main():
    shutil.rmtree(SCRATCH, ignore_errors=True)
    os.makedirs(SCRATCH)
    os.chdir(SCRATCH)
    write("before.off", off(CORNERS, FACES))
    write("after.off", off(MOVED, FACES))
    write("points.txt", "".join(" ".join(map(repr, p)) + "\n" for p in POINTS))
    require_forms()
    require_cages()
    require_refusals()
    os.chdir("/")
    if N_FAILED == 0:
        shutil.rmtree(SCRATCH)
    sys.exit(N_FAILED > 0)


main()
