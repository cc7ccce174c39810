#!/usr/bin/env python3
"""Makes the plugin for QGIS and the add-on for Blender: zip files with the Python package and the library inside.

    python3 examples/addons.py FOLDER [WHEEL]      writes libicc-qgis.zip and libicc-blender.zip

Without a wheel one is made, for machines like this one. It needs setuptools, wheel, CMake and a C compiler.
LIBICC_LIBRARY=FILE in the environment takes a library that has been compiled already.
"""

import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
SOURCES = ("CMakeLists.txt", "LICENSE", "cmake", "include", "lib", "bindings/python")
ADDONS = {"libicc-qgis.zip": "qgis/libicc_processing", "libicc-blender.zip": "blender/libicc_cage"}


def make_wheel(folder):
    """From a copy of the sources, because building leaves files beside them."""
    for name in SOURCES:
        source, copy = TOP / name, folder / "source" / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, copy, ignore=shutil.ignore_patterns("__pycache__", "build", "*.egg-info"))
        else:
            shutil.copy(source, copy)
    environment = dict(os.environ)
    if environment.get("LIBICC_LIBRARY"):
        environment["LIBICC_LIBRARY"] = str(Path(environment["LIBICC_LIBRARY"]).resolve())
    subprocess.run([sys.executable, "setup.py", "-q", "bdist_wheel", "--dist-dir", folder], check=True, env=environment,
                   cwd=folder / "source/bindings/python", stdout=subprocess.DEVNULL)
    return next(folder.glob("*.whl"))


def pack(path, addon, wheel):
    """The files of an add-on. In its folder `wheel` lies what the wheel installs."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as packed, zipfile.ZipFile(wheel) as package:
        packed.write(TOP / "LICENSE", f"{addon.name}/LICENSE")
        for file in sorted(addon.iterdir()):
            if file.is_file():
                packed.write(file, f"{addon.name}/{file.name}")
        for name in package.namelist():
            packed.writestr(f"{addon.name}/wheel/{name}", package.read(name))


def main(folder, wheel=None):
    Path(folder).mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as scratch:
        wheel = wheel or make_wheel(Path(scratch))
        for name, addon in ADDONS.items():
            pack(Path(folder, name), TOP / "examples" / addon, wheel)
            print(Path(folder, name))


main(*sys.argv[1:])
