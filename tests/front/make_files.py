"""Makes files of the formats that people use, in a folder: python3 make_files.py FOLDER. Prints what it cannot make.

Most files are made by the libraries that the front uses. Those that need a missing library or program are left out.
"""

import base64
import json
import shutil
import struct
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np

ANGLES = np.linspace(0, 2 * np.pi, 13)[:-1]
BEFORE = np.c_[50 + 40 * np.cos(ANGLES), 50 + 30 * np.sin(ANGLES)].round(6)
AFTER = (BEFORE + np.c_[0.1 * (BEFORE[:, 1] - 50), 0.004 * (BEFORE[:, 0] - 50) ** 2]).round(6)


def ring(points):
    return [[float(x), float(y)] for x, y in points] + [[float(points[0, 0]), float(points[0, 1])]]


def feature(kind, coordinates, **properties):
    return {"type": "Feature", "properties": properties, "geometry": {"type": kind, "coordinates": coordinates}}


def collection(*features):
    return json.dumps({"type": "FeatureCollection", "features": features})


def cube(n, half):
    """The surface of a cube of n x n squares a side: vertices and triangles."""
    number, faces = {}, []
    for axis in range(3):
        for side in (-1, 1):
            for i in range(n):
                for j in range(n):
                    corners = []
                    for u, v in ((0, 0), (1, 0), (1, 1), (0, 1)):
                        point = np.zeros(3)
                        point[axis] = side * half
                        point[(axis + 1) % 3] = -half + 2 * half * (i + u) / n
                        point[(axis + 2) % 3] = -half + 2 * half * (j + v) / n
                        corners.append(number.setdefault(tuple(point.round(9)), len(number)))
                    a, b, c, d = corners if side > 0 else corners[::-1]
                    faces += [(a, b, c), (a, c, d)]
    return np.array(list(number)), np.array(faces)


def bent(points):
    turn = 0.15 * points[:, 2]
    return np.c_[points[:, 0] * np.cos(turn) - points[:, 1] * np.sin(turn),
                 points[:, 0] * np.sin(turn) + points[:, 1] * np.cos(turn), points[:, 2] + 0.05 * points[:, 0] ** 2]


def obj(points, faces):
    return ("".join("v {:.9g} {:.9g} {:.9g}\n".format(*point) for point in points)
            + "".join("f {} {} {}\n".format(*(face + 1)) for face in faces))


def plain(folder):
    """Cages, layers and landmarks as text."""
    for name, points in (("a", BEFORE), ("b", AFTER)):
        np.savetxt(folder / f"{name}.txt", points, fmt="%.6f")
        (folder / f"{name}.geojson").write_text(collection(feature("Polygon", [ring(points)], name=name)))
        (folder / f"{name.upper()}.obj").write_text(obj(*(cube(4, 3.0) if name == "a" else
                                                          (bent(cube(4, 3.0)[0]), cube(4, 3.0)[1]))))
    np.savetxt(folder / "a.csv", BEFORE, fmt="%.6f", delimiter=",", header="x,y", comments="")
    heights = [[*point, 7.0] for point in ring(BEFORE)]
    (folder / "a3.geojson").write_text(collection(feature("Polygon", [heights])))
    (folder / "a.geojsonl").write_text(json.dumps(feature("Polygon", [ring(BEFORE)])) + "\n")
    small = 4 * np.c_[np.cos(ANGLES), np.sin(ANGLES)]
    parcels = [feature("Polygon", [ring(small + [30 + 9 * i, 45 + 2 * i])], id=i, owner=f"p{i}") for i in range(5)]
    stones = [feature("Point", [35.0 + 5 * i, 50.0 + i], id=100 + i, owner="q") for i in range(5)]
    (folder / "layer.geojson").write_text(collection(*parcels, *stones))
    wkt = "POLYGON ((" + ", ".join(f"{x!r} {y!r}" for x, y in ring(BEFORE)) + "))"
    (folder / "a.wkt").write_text(wkt)
    (folder / "a.ewkt").write_text("SRID=2056;" + wkt)
    (folder / "awkt.csv").write_text(f'id,shape\n1,"{wkt}"\n')
    vertices = b"".join(struct.pack("<dd", *point) for point in ring(BEFORE))
    (folder / "a.wkb").write_bytes(struct.pack("<BIII", 1, 3, 1, 13) + vertices)
    extended = struct.pack("<BIIII", 1, 3 | 0x20000000, 2056, 1, 13) + vertices
    (folder / "a.ewkb").write_bytes(extended)
    (folder / "a.hexewkb").write_text(extended.hex().upper())
    (folder / "a.topojson").write_text(json.dumps({
        "type": "Topology", "arcs": [ring(BEFORE)],
        "objects": {"l": {"type": "GeometryCollection", "geometries": [{"type": "Polygon", "arcs": [[0]]}]}}}))
    track = "".join(f'<trkpt lat="{y:g}" lon="{x:g}"/>' for x, y in ring(BEFORE))
    (folder / "t.gpx").write_text('<?xml version="1.0"?><gpx version="1.1" creator="x" '
                                  'xmlns="http://www.topografix.com/GPX/1/1"><trk><trkseg>' + track
                                  + "</trkseg></trk></gpx>")
    head = "0\nSECTION\n2\nENTITIES\n0\nPOLYLINE\n8\n0\n66\n1\n70\n1\n"
    vertex = "".join(f"0\nVERTEX\n8\n0\n10\n{x!r}\n20\n{y!r}\n" for x, y in BEFORE.tolist())
    (folder / "a.dxf").write_text(head + vertex + "0\nSEQEND\n8\n0\n0\nENDSEC\n0\nEOF\n")
    places = [[0.5 * i - 1, 0.2 * i, 0.1 * i] for i in range(5)]
    (folder / "pts.fcsv").write_text("# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n" + "".join(
        "n{},{:g},{:g},{:g},0,0,0,1,1,1,0,F-{},,\n".format(i, *p, i) for i, p in enumerate(places)))
    (folder / "pts.mrk.json").write_text(json.dumps({"markups": [{"type": "Fiducial", "controlPoints": [
        {"id": str(i), "label": f"F-{i}", "position": p} for i, p in enumerate(places)]}]}))


def drawings(folder):
    """Drawings, and figures of games."""
    points = " ".join("{:.3f},{:.3f}".format(*point) for point in BEFORE)
    root = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 100 100"'
    (folder / "poly.svg").write_text(f'{root}><polygon id="a" points="{points}"/></svg>')
    (folder / "ink.svg").write_text(
        f'{root} xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"><g inkscape:groupmode="layer" '
        'transform="translate(3,4)"><g transform="rotate(10 50 50)"><path inkscape:label="before" d="m 20,20 h 40 '
        'c 10,0 20,10 20,20 v 30 a 10 10 0 0 1 -10,10 H 20 Z"/></g><text x="5" y="5">hello</text></g></svg>')
    (folder / "ai.svg").write_text(f'{root}><style>.st0{{fill:#FFF;}}</style><polygon class="st0" points="{points} "/>'
                                   '<path class="st0" d="M10,10c3-2,5-2,8,0s6,2,9,0v10H10V10z"/></svg>')
    (folder / "figma.svg").write_text(f'{root}><g clip-path="url(#c)"><rect width="100" height="100"/><path d="M10 10H90V90'
                                      'H10V10ZM30 30V70H70V30H30Z"/></g><defs><clipPath id="c"><rect width="100" '
                                      'height="100"/></clipPath></defs></svg>')
    flat = [float(number) for number in BEFORE.ravel()]
    (folder / "spine.json").write_text(json.dumps({
        "skeleton": {"spine": "4.2.22"}, "bones": [{"name": "root"}],
        "slots": [{"name": "torso", "bone": "root", "attachment": "torso"}],
        "skins": [{"name": "default", "attachments": {"torso": {"torso": {
            "type": "mesh", "uvs": [number / 100 for number in flat], "vertices": flat, "hull": 12,
            "triangles": [v for i in range(1, 11) for v in (0, i, i + 1)]}}}}]}))
    numbers = ", ".join(map(str, flat))
    for name, kind in (("player", "Polygon2D"), ("wall", "CollisionPolygon2D")):
        (folder / f"{name}.tscn").write_text(f'[gd_scene format=3]\n\n[node name="Player" type="Node2D"]\n\n[node name='
                                             f'"{kind}" type="{kind}" parent="."]\npolygon = PackedVector2Array({numbers})\n')
    zero = [[0, 0]] * 12
    (folder / "lottie.json").write_text(json.dumps({"v": "5.12.0", "fr": 30, "layers": [{"ty": 4, "shapes": [{
        "ty": "gr", "it": [{"ty": "sh", "ks": {"a": 0, "k": {
            "i": zero, "o": zero, "v": BEFORE.tolist(), "c": True}}}]}]}]}))


def by_gdal(folder):
    """Layers that GDAL writes."""
    make = shutil.which("ogr2ogr")
    if make is None:
        raise ImportError("ogr2ogr is missing")
    for name in "a.gpkg a.shp a.sqlite a.kml a.kmz a.fgb a.gml a.tab a2.dxf a.dgn layer.gpkg layer.kml".split():
        driver = {"shp": "ESRI Shapefile", "tab": "MapInfo File", "sqlite": "SQLite", "kmz": "LIBKML", "fgb": "FlatGeobuf",
                  }.get(name.split(".")[1], name.split(".")[1].upper())
        source = "layer.geojson" if name.startswith("layer") else "a.geojson"
        subprocess.run([make, "-f", driver, name, source, *(["-nln", "a"] if driver != "DGN" else [])],
                       cwd=folder, stderr=subprocess.DEVNULL)
    with zipfile.ZipFile(folder / "a_shp.zip", "w") as archive:
        for part in folder.glob("a.[spd][hrb][pxfj]"):
            archive.write(part, part.name)


def pictures(folder):
    """Pictures that Pillow writes, and a few that it only reads."""
    from PIL import Image

    noise = np.random.default_rng(0).integers(0, 255, (100, 100, 3), np.uint8)
    image = Image.fromarray(noise)
    for name in "pic.jpg pic.webp pic.tiff pic.bmp pic.gif pic.jp2 pic.tga rgb.png".split():
        image.save(folder / name)
    image.convert("P").save(folder / "pal.png")
    image.convert("CMYK").save(folder / "cmyk.jpg")
    deep = Image.fromarray(noise[:, :, 0].astype(np.uint16) * 256)
    deep.save(folder / "g16.png")
    deep.save(folder / "pic16.tif")
    Image.fromarray(noise[:, :, 0].astype(np.float32)).save(folder / "picf.tif")
    channels = b"".join(noise[:, :, c].tobytes() for c in range(3))
    (folder / "pic.psd").write_bytes(struct.pack(">4sH6sHIIHH", b"8BPS", 1, b"", 3, 100, 100, 8, 3)
                                     + struct.pack(">IIIH", 0, 0, 0, 0) + channels)
    with zipfile.ZipFile(folder / "pic.ora", "w") as archive:
        archive.writestr("mimetype", "image/openraster")
        archive.write(folder / "rgb.png", "mergedimage.png")


def rasters(folder):
    import rasterio
    from rasterio.transform import from_origin

    heights = np.random.default_rng(0).random((3, 200, 200)) * 255
    for name, bands, kind, nodata in (("geo.tif", 3, "uint8", None), ("dem.tif", 1, "float32", -9999)):
        with rasterio.open(folder / name, "w", driver="GTiff", height=200, width=200, count=bands, dtype=kind,
                           crs="EPSG:2056", transform=from_origin(0, 100, 0.5, 0.5), nodata=nodata) as target:
            target.write(heights[:bands].astype(kind))


def meshes(folder):
    """Meshes that meshio writes."""
    import meshio

    import libicc

    points, faces = cube(3, 1.5)
    nodes, tetra = libicc.Domain(points, faces).filled().mesh
    tetra, faces = tetra.astype(np.int64), faces.astype(np.int64)
    both = [("tetra", tetra), ("triangle", faces)]
    solid = meshio.Mesh(nodes, [("tetra", tetra)], point_data={"temperature": nodes[:, 0]})
    skin = meshio.Mesh(points, [("triangle", faces)])
    edges, back = np.unique(np.sort(tetra[:, [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]]].reshape(-1, 2)), axis=0,
                            return_inverse=True)
    quadratic = meshio.Mesh(np.vstack([nodes, nodes[edges].mean(axis=1)]),
                            [("tetra10", np.hstack([tetra, len(nodes) + back.reshape(-1, 6)]))])
    at = np.arange(64).reshape(4, 4, 4)
    lattice = np.stack(np.meshgrid(*[np.linspace(-1, 1, 4)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    low, high = (slice(0, 3), slice(1, 4))
    square = [(low, low), (high, low), (high, high), (low, high)]
    bricks = np.stack([at[(*xy, z)].ravel() for z in (low, high) for xy in square], axis=1)
    wedges = np.vstack([bricks[:, [0, 1, 2, 4, 5, 6]], bricks[:, [0, 2, 3, 4, 6, 7]]])

    def write(name, mesh, **options):
        try:
            meshio.write(folder / name, mesh, **options)
        except Exception as error:
            print(f"not made: {name}: {error}")

    for kind, driver in (("2.2", "gmsh22"), ("4.1", "gmsh")):
        for letter, binary in (("", False), ("b", True)):
            write(f"ball{kind}{letter}.msh", meshio.Mesh(nodes, both if driver == "gmsh22" else both[:1]),
                  file_format=driver, binary=binary)
    write("ball.vtk", meshio.Mesh(nodes, both), binary=False, file_format="vtk42")
    write("ballb.vtk", meshio.Mesh(nodes, both), binary=True, file_format="vtk42")
    write("m51.vtk", solid, binary=False)
    write("m51b.vtk", solid, binary=True)
    write("ball2.vtk", quadratic, binary=False, file_format="vtk42")
    write("ball2.inp", quadratic)
    write("hex.vtk", meshio.Mesh(lattice, [("hexahedron", bricks)]), binary=False, file_format="vtk42")
    write("hex.mesh", meshio.Mesh(lattice, [("hexahedron", bricks)]))
    write("prism.vtk", meshio.Mesh(lattice, [("wedge", wedges)]), binary=False, file_format="vtk42")
    write("m_ascii.vtu", solid, binary=False)
    write("m_bin.vtu", solid, compression=None)
    write("m_zlib.vtu", solid, compression="zlib")
    write("m_lzma.vtu", solid, compression="lzma")
    bare = meshio.Mesh(nodes, [("tetra", tetra)])
    for name in "m.cgns m.med ball.inp ball.su2 m.node m.ugrid m.f3grid m.tec m.dat m.meshb ball.mesh m.vol".split():
        write(name, bare, **({"file_format": "tecplot"} if name == "m.dat" else {}))
    for name in "m.xdmf m.e m.avs".split():
        write(name, solid)
    for name, driver in (("m.stl", "stl"), ("m.ply", "ply"), ("m.off", "off"), ("m.obj", "obj")):
        write(name, skin, file_format=driver)
    write("ballb.stl", skin, file_format="stl", binary=True)
    try:
        from libicc.front import write as convert
        from libicc.front.mesh import Mesh

        for name in ("ball.unv", "ball.bdf"):
            convert(Mesh(meshio.Mesh(nodes, [("tetra", tetra)]), folder / name), folder / name)
    except Exception as error:
        print(f"not made: ball.unv, ball.bdf: {error}")


def by_hand(folder):
    """Meshes and scenes as text or JSON."""
    four = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)
    nodes = "".join('<node id="{}">{:g},{:g},{:g}</node>'.format(i, *p) for i, p in enumerate(four, 1))
    (folder / "m.feb").write_text(f'<?xml version="1.0"?>\n<febio_spec version="4.0"><Mesh><Nodes name="n">{nodes}</Nodes>'
                                  '<Elements type="tet4" name="e"><elem id="1">1,2,3,4</elem></Elements></Mesh></febio_spec>')
    (folder / "polyMesh").mkdir(exist_ok=True)
    (folder / "polyMesh/points").write_text("FoamFile\n{\n    version 2.0;\n    format ascii;\n    class vectorField;\n"
                                            "    object points;\n}\n8\n(\n(0 0 0)\n(1 0 0)\n(1 1 0)\n(0 1 0)\n(0 0 1)\n"
                                            "(1 0 1)\n(1 1 1)\n(0 1 1)\n)\n")
    (folder / "ball.key").write_text("*KEYWORD\n*NODE\n       1             0.0             0.0             0.0\n*END\n")
    corners = [(x, y, z) for z in (-1, 1) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    (folder / "quads.obj").write_text("o a\n" + "".join("v {} {} {}\n".format(*p) for p in corners)
                                      + "vn 0 0 1\nf 1//1 4//1 3//1 2//1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\n"
                                      "f 4 1 5 8\n")
    (folder / "pent.obj").write_text("v 1.5 1 1\nv 2 1 1\nv 2 1.5 1\nv 1.7 1.9 1\nv 1.4 1.5 1\nf 1 2 3 4 5\n")
    (folder / "m.usda").write_text("#usda 1.0\n")
    (folder / "m.fbx").write_bytes(b"Kaydara FBX Binary  \0")
    (folder / "m.dae").write_text('<?xml version="1.0"?>\n<COLLADA version="1.4.1"></COLLADA>\n')
    (folder / "m.x3d").write_text('<?xml version="1.0"?>\n<X3D version="3.3"></X3D>\n')
    (folder / "a.sql").write_text("CREATE TABLE a();\n")
    (folder / "a.pdf").write_bytes(b"%PDF-1.4\n")
    for name, head in (("avif", b"\0\0\0\x20ftypavif"), ("heic", b"\0\0\0\x18ftypheic"), ("exr", b"\x76\x2f\x31\x01"),
                       ("jxl", b"\xff\x0a")):
        (folder / f"pic.{name}").write_bytes(head + b"\0" * 32)
    scenes(folder, four)


def scenes(folder, four):
    faces = np.array([0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2], np.uint16)
    deltas = np.array([[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0.5]], np.float32)
    joints, weights = np.zeros((4, 4), np.uint8), np.eye(4, dtype=np.float32)[[0, 0, 0, 0]]
    views, content = [], b""
    for array in (four, faces, deltas, joints, weights, np.eye(4, dtype=np.float32)):
        views.append({"buffer": 0, "byteOffset": len(content), "byteLength": array.nbytes})
        content += array.tobytes() + b"\0" * (-array.nbytes % 4)
    accessors = [{"bufferView": at, "componentType": component, "count": count, "type": kind, **more}
                 for at, (component, count, kind, more) in enumerate((
                     (5126, 4, "VEC3", {"min": [0, 0, 0], "max": [1, 1, 1]}), (5123, 12, "SCALAR", {}),
                     (5126, 4, "VEC3", {"min": [0, 0, 0], "max": [0, 0, 0.5]}), (5121, 4, "VEC4", {}),
                     (5126, 4, "VEC4", {}), (5126, 1, "MAT4", {})))]
    part = {"attributes": {"POSITION": 0}, "indices": 1}
    skinned = {"attributes": {"POSITION": 0, "JOINTS_0": 3, "WEIGHTS_0": 4}, "indices": 1}

    def scene(meshes, nodes, **more):
        return {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
                "meshes": meshes, "accessors": accessors, "bufferViews": views,
                "buffers": [{"byteLength": len(content)}], **more}

    def binary(name, tree):
        text = json.dumps(tree).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(content), b"BIN\0") + content
        (folder / name).write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)

    one = scene([{"primitives": [part]}], [{"mesh": 0}])
    binary("one.glb", one)
    binary("two.glb", scene([{"primitives": [part]}] * 2, [{"mesh": 0}, {"mesh": 1, "translation": [1.2, 0, 0]}]))
    binary("skin.glb", scene([{"primitives": [skinned]}], [{"mesh": 0, "skin": 0}, {"name": "joint"}],
                             skins=[{"joints": [1], "inverseBindMatrices": 5}]))
    binary("morph.glb", scene([{"primitives": [{**part, "targets": [{"POSITION": 2}]}], "weights": [0.5]}],
                              [{"mesh": 0}]))
    one["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(content).decode()
    (folder / "one.gltf").write_text(json.dumps(one))
    one["buffers"][0]["uri"] = "one.bin"
    (folder / "one.bin").write_bytes(content)
    (folder / "apart.gltf").write_text(json.dumps(one))


def ellipsoid():
    z, y, x = np.mgrid[:12, :14, :16]
    return ((x - 8) / 5.5) ** 2 + ((y - 7) / 4.5) ** 2 + ((z - 6) / 4.0) ** 2 < 1


def volumes(folder):
    """Volumes with a header of lines, and arrays."""
    mask = ellipsoid()
    raw = mask.astype(np.uint8).tobytes()
    np.save(folder / "mask.npy", mask)
    np.savez(folder / "z.npz", mask=mask)
    (folder / "label.nrrd").write_bytes(b"NRRD0004\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\nsizes: 16 14 "
                                        b"12\nspace directions: (.5,0,0) (0,.5,0) (0,0,.5)\nkinds: domain domain domain\n"
                                        b"encoding: raw\nspace origin: (-4,-3.5,-3)\n\n" + raw)
    head = ("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nOffset = -4 -3.5 -3\n"
            "ElementSpacing = .5 .5 .5\nDimSize = 16 14 12\nElementType = MET_UCHAR\nElementDataFile = ")
    (folder / "label.mha").write_bytes(head.encode() + b"LOCAL\n" + raw)
    (folder / "label.mhd").write_text(head + "label.raw\n")
    (folder / "label.raw").write_bytes(raw)


def scans(folder):
    import nibabel

    affine = np.array([[0.5, 0, 0, -4], [0, 0.5, 0, -3.5], [0, 0, 0.5, -3], [0, 0, 0, 1]])
    labels = ellipsoid().transpose(2, 1, 0).astype(np.uint8)
    for name in ("label.nii", "label.nii.gz"):
        nibabel.save(nibabel.Nifti1Image(labels, affine), folder / name)
    field = nibabel.Nifti1Image(np.full((*labels.shape, 1, 3), 0.25, np.float32), affine)
    field.header.set_intent("vector")
    nibabel.save(field, folder / "disp.nii.gz")


def slices(folder):
    import pydicom
    from pydicom.dataset import Dataset, FileMetaDataset

    image = (ellipsoid()[6].astype(np.uint16) * 1000)
    scan, meta = Dataset(), FileMetaDataset()
    meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = "1.2.840.10008.5.1.4.1.1.2", "1.2.3"
    meta.TransferSyntaxUID = "1.2.840.10008.1.2.1"
    scan.file_meta, scan.SOPClassUID, scan.SOPInstanceUID = meta, meta.MediaStorageSOPClassUID, "1.2.3"
    scan.Rows, scan.Columns = image.shape
    scan.BitsAllocated = scan.BitsStored = 16
    scan.HighBit, scan.PixelRepresentation, scan.SamplesPerPixel = 15, 0, 1
    scan.PhotometricInterpretation, scan.PixelData = "MONOCHROME2", image.tobytes()
    scan.is_little_endian, scan.is_implicit_VR = True, False
    pydicom.dcmwrite(folder / "s.dcm", scan, write_like_original=False)


def make(folder):
    """Makes all files that can be made here."""
    folder.mkdir(parents=True, exist_ok=True)
    for part in (plain, drawings, by_gdal, pictures, rasters, by_hand, meshes, volumes, scans, slices):
        try:
            part(folder)
        except ImportError as error:
            print(f"not made: {part.__name__}: {error}")


if __name__ == "__main__":
    make(Path(sys.argv[1]))
