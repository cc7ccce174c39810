#!/usr/bin/env python3
"""Makes the plugin for QGIS and the add-on for Blender: zip files with the Python package and the library inside.

    python3 examples/addons.py FOLDER [LIBRARY...]      writes libicc-qgis.zip and libicc-blender.zip

LIBRARY is a compiled library, one for each system that the zip files are for: libicc.so.0, libicc.dll or
libicc.0.dylib. Licences in a folder beside it are packed, too. Without one, the library is compiled for this machine,
which needs CMake and a C compiler. The script needs setuptools and wheel.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
SOURCES = ("CMakeLists.txt", "LICENSE", "cmake", "include", "lib", "bindings/python")
BUILT = shutil.ignore_patterns("__pycache__", "build", "*.egg-info", "libicc.so.0")
ADDONS = {"libicc-qgis.zip": "qgis/libicc_processing", "libicc-blender.zip": "blender/libicc_cage"}
DATE = time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", time.time())))[:6]


def make_wheel(folder, has_library):
    """From a copy of the sources, because building leaves files beside them."""
    for name in SOURCES:
        source, copy = TOP / name, folder / "source" / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, copy, ignore=BUILT)
        else:
            shutil.copy(source, copy)
    subprocess.run([sys.executable, "setup.py", "-q", "bdist_wheel", "--dist-dir", folder], check=True,
                   env={**os.environ, "LIBICC_LIBRARY": "system" if has_library else ""},
                   cwd=folder / "source/bindings/python", stdout=subprocess.DEVNULL)
    return next(folder.glob("*.whl"))


def contents(addon, wheel, libraries):
    """The names and bytes of the files of an add-on. In its folder `wheel` lies what a wheel would install."""
    yield "LICENSE", (TOP / "LICENSE").read_bytes()
    for file in sorted(addon.glob("*.*")):
        yield file.name, file.read_bytes()
    with zipfile.ZipFile(wheel) as package:
        for name in package.namelist():
            yield f"wheel/{name}", package.read(name)
    for library in libraries:
        yield f"wheel/libicc/{library.name}", library.read_bytes()
        for licence in sorted(library.parent.glob("licences/*")):
            yield f"licences/{licence.name}", licence.read_bytes()


def main(folder, *libraries):
    Path(folder).mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        wheel = make_wheel(Path(scratch), bool(libraries))
        for name, addon in ADDONS.items():
            path = TOP / "examples" / addon
            with zipfile.ZipFile(Path(folder, name), "w", zipfile.ZIP_DEFLATED) as packed:
                for file, data in contents(path, wheel, list(map(Path, libraries))):
                    packed.writestr(zipfile.ZipInfo(f"{path.name}/{file}", DATE), data, zipfile.ZIP_DEFLATED)
            print(Path(folder, name))


main(*sys.argv[1:])
