"""Builds the C library into the package, so that a wheel needs nothing but NumPy.

LIBICC_LIBRARY=FILE in the environment takes a library that has been built already, and LIBICC_LIBRARY=system none: the
package then is for every platform, and the system's library is looked for when it is imported.
"""

import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist
from wheel.bdist_wheel import bdist_wheel

HERE = pathlib.Path(__file__).resolve().parent
BESIDE, ABOVE = HERE / "c", HERE.parent.parent  # an sdist has the C sources in a folder of its own
SOURCES = BESIDE if BESIDE.exists() else ABOVE
PARTS = ("CMakeLists.txt", "LICENSE", "cmake", "include", "lib")
NAME = {"win32": "libicc.dll", "darwin": "libicc.0.dylib"}.get(sys.platform, "libicc.so.0")
PAGE = ("tools/plot/page/page.html", "tools/plot/page/page.css", "tools/plot/page/page.js", "examples/studio/src/gl.js",
        "examples/studio/src/gl3.js", "examples/studio/src/solid.js")
GIVEN = os.environ.get("LIBICC_LIBRARY", "")
MACHINES = {62: "x86_64", 183: "aarch64"}  # as the header of a library (ELF) names them


def compiled(folder: pathlib.Path) -> pathlib.Path:
    """The library, compiled in a folder."""
    options = ["-DCMAKE_BUILD_TYPE=Release", "-DICC_BUILD_STATIC=OFF", "-DICC_BUILD_TOOLS=OFF"]
    if sys.platform == "linux":
        options.append("-DCMAKE_SHARED_LINKER_FLAGS=-s")
    subprocess.run(["cmake", "-S", SOURCES, "-B", folder, *options], check=True)
    subprocess.run(["cmake", "--build", folder, "--config", "Release", "--target", "icc",
                    "--parallel", str(os.cpu_count() or 1)], check=True)
    # Microsoft's compiler calls it icc.dll, in a folder Release.
    return next((folder / "lib").rglob(NAME.replace("lib", "*")))


class BuildWithLibrary(build_py):
    def run(self) -> None:
        super().run()
        folder = HERE if self.editable_mode else pathlib.Path(self.build_lib)
        viewer = folder / "libicc" / "viewer"
        if not self.editable_mode:
            viewer.mkdir(exist_ok=True)
            for part in PAGE:
                shutil.copy(SOURCES / part, viewer)
        if GIVEN != "system":
            library = pathlib.Path(GIVEN) if GIVEN else compiled(pathlib.Path(self.get_finalized_command("build").build_temp))
            shutil.copy(library, folder / "libicc" / NAME)


class WithLibrary(Distribution):
    """Not pure Python, though nothing is compiled for Python."""

    def has_ext_modules(self) -> bool:
        return GIVEN != "system"


class PlatformWheel(bdist_wheel):
    """Any Python 3 will do, on the platform that the library is for."""

    def get_tag(self):
        tag = super().get_tag()
        return tag if self.root_is_pure else ("py3", "none", self.platform_tag())

    def platform_tag(self) -> str:
        """For the GNU C library: manylinux, of the newest of its versions that the library asks for."""
        library = pathlib.Path(self.bdist_dir, "libicc", NAME).read_bytes()
        versions = [int(minor) for minor in re.findall(rb"GLIBC_2\.(\d+)", library)]
        if not versions:
            return re.sub("[^0-9a-z]", "_", sysconfig.get_platform())
        machine = MACHINES.get(int.from_bytes(library[18:20], "little"), platform.machine())
        return f"manylinux_2_{max(versions)}_{machine}"


class SourcesOfBoth(sdist):
    def make_release_tree(self, base_dir, files) -> None:
        super().make_release_tree(base_dir, files)
        for part in PARTS + PAGE:
            source, target = SOURCES / part, pathlib.Path(base_dir, BESIDE.name, part)
            target.parent.mkdir(parents=True, exist_ok=True)
            (shutil.copytree if source.is_dir() else shutil.copy)(source, target)


setup(distclass=WithLibrary,
      cmdclass={"build_py": BuildWithLibrary, "bdist_wheel": PlatformWheel, "sdist": SourcesOfBoth})
