"""Tries each file of a folder that make_files.py has made in its role, by the command and by the front, one call each.

usage: try_files.py LIBICC FOLDER [--page formats.md [--write]]

Prints which files are taken. With --page the table in the page has to say the same about every file whose libraries are
here; --write puts the table into the page.
"""

import contextlib
import io
import os
import re
import subprocess
import sys
import warnings
from pathlib import Path

FAMILIES = {
    "Outlines and layers": "cage:a.txt cage:a.csv cage:a.geojson cage:a3.geojson cage:a.geojsonl cage:a.wkt cage:a.ewkt "
    "cage:a.wkb cage:a.ewkb cage:a.hexewkb cage:awkt.csv cage:a.topojson cage:a.shp cage:a_shp.zip cage:a.gpkg "
    "cage:a.sqlite cage:a.kml cage:a.kmz cage:a.fgb cage:a.gml cage:a.tab cage:a.dxf cage:a2.dxf cage:a.dgn cage:t.gpx "
    "cage:a.sql cage:a.pdf layer:layer.geojson layer:layer.gpkg layer:layer.kml",
    "Drawings and figures": "cage:poly.svg cage:ink.svg cage:ai.svg#1 cage:figma.svg#2 cage:spine.json cage:player.tscn "
    "cage:wall.tscn cage:lottie.json",
    "Pictures": "picture:rgb.png picture:g16.png picture:pal.png picture:pic.jpg picture:cmyk.jpg picture:pic.webp "
    "picture:pic.tiff picture:pic16.tif picture:picf.tif picture:geo.tif picture:dem.tif picture:pic.psd picture:pic.ora "
    "picture:pic.bmp picture:pic.gif picture:pic.jp2 picture:pic.tga picture:pic.avif picture:pic.heic picture:pic.exr "
    "picture:pic.jxl",
    "Finite elements": "mesh:ball2.2.msh mesh:ball2.2b.msh mesh:ball4.1.msh mesh:ball4.1b.msh mesh:ball.vtk mesh:ballb.vtk "
    "mesh:m51.vtk mesh:m51b.vtk mesh:ball2.vtk mesh:hex.vtk mesh:prism.vtk mesh:m_ascii.vtu mesh:m_bin.vtu mesh:m_zlib.vtu "
    "mesh:m_lzma.vtu mesh:m.xdmf mesh:m.e mesh:m.cgns mesh:m.med mesh:ball.inp mesh:ball2.inp mesh:ball.bdf mesh:ball.unv "
    "mesh:ball.su2 mesh:ball.key mesh:m.node mesh:m.ugrid mesh:m.avs mesh:m.f3grid mesh:m.dat mesh:m.tec mesh:m.vol "
    "mesh:m.feb mesh:polyMesh/points mesh:ball.mesh mesh:m.meshb mesh:hex.mesh",
    "Surfaces and scenes": "mesh:m.stl mesh:ballb.stl mesh:m.ply mesh:m.off mesh:m.obj mesh:quads.obj mesh:pent.obj "
    "mesh:one.glb mesh:two.glb mesh:skin.glb mesh:morph.glb mesh:one.gltf mesh:apart.gltf mesh:m.fbx mesh:m.dae mesh:m.x3d "
    "mesh:m.usda",
    "Volumes and landmarks": "voxels:mask.npy voxels:z.npz voxels:s.dcm volume:label.nii volume:label.nii.gz "
    "volume:disp.nii.gz volume:label.nrrd volume:label.mha volume:label.mhd points:pts.fcsv points:pts.mrk.json",
}
IN_SPACE = ("mesh", "volume", "points")


def result_name(role, name):
    """A file of the same format as the one that is read, or of one that is near."""
    ending = name.partition(".")[2] if role == "volume" else name.rpartition(".")[2]
    return {"kml": "gpkg", "psd": "png", "ora": "webp", "feb": "vtu", "polyMesh/points": "txt",
            "pic16.tif": "tif"}.get(ending, ending)


def calls(role, name, folder, command):
    """The words of the call that gives a file to the command or to the front."""
    cages = ["-s", "A.obj", "-t", "B.obj"] if role in IN_SPACE else ["-s", "a.txt", "-t", "b.txt"]
    out = str(folder / "out" / ("result." + result_name(role, name)))
    if role in ("cage", "voxels"):
        return ["check", "-q", "-s", name]
    if role in ("layer", "points") and command:
        return ["map", *cages, *(["--geojson", name, out] if role == "layer" else ["-p", name, "-o", out])]
    verb = {"layer": "map", "points": "map", "mesh": "mesh"}.get(role, "warp")
    return [verb, *cages, name, out]


def by_command(command, role, name, folder):
    done = subprocess.run([command, *calls(role, name, folder, True)], capture_output=True, stdin=subprocess.DEVNULL,
                          cwd=folder)
    return done.returncode in (0, 4)


def by_front(role, name, folder):
    """Whether the front takes a file. Otherwise it says why in one line that names the file."""
    from libicc.front import main

    said = io.StringIO()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        code = main(calls(role, name, folder, False))
    text = said.getvalue()
    if code == 1 and not text.startswith("libicc: "):
        sys.exit(f"{name}: no good message: {text}")
    return code in (0, 4), text


def told(page):
    """What the table of a page says of each file: by the command, by the front."""
    rows = re.findall(r"^\| `([^`]*)` \| (Y|-) \| (Y|-) \|$", Path(page).read_text(encoding="utf-8"), flags=re.M)
    return {name: (command == "Y", front == "Y") for name, command, front in rows}


def table(found):
    lines = []
    for family, results in found.items():
        n = sum(command or front for command, front, _ in results.values())
        lines += [f"### {family}: {n} of {len(results)}", "", "| file | command | front |", "|---|---|---|"]
        lines += [f"| `{name}` | {'Y' if command else '-'} | {'Y' if front else '-'} |"
                  for name, (command, front, _) in results.items()]
        lines.append("")
    return "\n".join(lines)


def write_table(page, found):
    text = Path(page).read_text(encoding="utf-8")
    before, mark, _ = text.partition("tries each of them in its role, by one call.\n\n")
    n = sum(command or front for results in found.values() for command, front, _ in results.values())
    head = f"The command takes the files of the first column, and the front those of the second; together {n} of "
    head += f"{sum(map(len, found.values()))}.\n\n"
    Path(page).write_text(before + mark + head + table(found), encoding="utf-8")


def main():
    command, folder = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve()
    page = Path(sys.argv[4]).resolve() if "--page" in sys.argv else None
    os.environ["PATH"] = f"{command.parent}{os.pathsep}{os.environ['PATH']}"
    (folder / "out").mkdir(exist_ok=True)
    os.chdir(folder)
    found, faults = {}, []
    for family, files in FAMILIES.items():
        found[family] = {}
        for each in files.split():
            role, _, name = each.partition(":")
            is_there = (folder / name.partition("#")[0]).exists()
            taken, text = by_front(role, name, folder) if is_there else (False, "")
            found[family][name] = (is_there and by_command(command, role, name, folder), taken,
                                   not is_there or "not installed" in text)
            if not taken:
                print(f"{name}: {text.strip() or 'not made'}")
    if page and "--write" in sys.argv:
        write_table(page, found)
    elif page:
        says = told(page)
        for name, (by, front, skipped) in (item for results in found.values() for item in results.items()):
            if not skipped and says.get(name) != (by, front):
                faults.append(f"{page}: {name}: found command {by}, front {front}; the page says {says.get(name)}")
    for family, results in found.items():
        both = [command or front for command, front, _ in results.values()]
        print(f"{family}: {sum(both)} of {len(both)}, "
              f"{sum(skipped for _, _, skipped in results.values())} skipped")
    print("all:", sum(command or front for results in found.values() for command, front, _ in results.values()), "of",
          sum(map(len, found.values())))
    sys.exit("\n".join(faults) or None)


if __name__ == "__main__":
    main()
