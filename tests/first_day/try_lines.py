"""Tries every line of the tables of docs/howto/first-day.md, and compares what works with what the page says.

usage: try_lines.py PAGE python | cpp STAGE COMPILER | js PACKAGE

STAGE is an installed library, and PACKAGE the npm package. Only the sections in one language are tried. A section is
left out, and named, if one of its packages is missing. The block of code in a section runs before its lines. `CHECKS`
says when a line has worked: an expression in the section's language, in which `_` is the value of the line. A line that
has no check is a mistake, and so is a check that has no line.
"""

import contextlib
import io
import json
import os
import re
import subprocess
import sys
import tempfile
import traceback
from pathlib import Path

CHECKS = {
    "NumPy, pyproj and shapely": {
        "an array of points": "_.shape == (3, 2) and near(m.inverse(_), points)",
        "a list of tuples": "near(_, m(points[:2]))",
        "one point": "near(_, m(points[:1]))",
        "a grid of points": "_.shape == (1, 3, 2) and near(_[0], m(points))",
        "float32 stays": "_.dtype == numpy.float32 and near(_, m(points), 1e-6)",
        "x and y, as pyproj does": "len(_) == 2 and near(numpy.transpose(_), m(points))",
        "x, y and heights": "list(_[2]) == [7, 8, 9] and near(_[0], m(points)[:, 0])",
        "a point outside gets NaN": "numpy.isnan(_).all()",
        "any geometry": "_.geom_type == 'Polygon' and near(m.inverse(_.exterior.coords), lot.exterior.coords)",
        "a point of shapely": "near(_.coords, m(points[:1]))",
        "a line of shapely": "near(_.coords, m(points))",
        "transform of shapely": "_.equals(m(lot))",
        "GeoJSON in and out": "_['type'] == 'Polygon' and shape(_).equals(m(lot))",
        "a shape as a geometry": "_.equals(Polygon(after))",
        "the way back": "near(_, points)",
        "a map after a map": "_.certified and near(_(points), points)",
        "its box": "_ == Polygon(before).bounds",
        "its shapes": "all(isinstance(one, libicc.Domain) for one in _)",
        "derivatives": "_.shape == (3, 2, 2) and near((m(points + [1e-5, 0]) - m(points)) / 1e-5, _[:, :, 0], 1e-6)",
        "pickle": "near(_(points), m(points))",
        "threads": "near(_[0], _[1]) and near(_[0], m(points))",
        "PROJ, GDAL and PostGIS": "near(numpy.transpose(_), m(points), 1e-12)",
        "errors are ValueErrors": ValueError,
    },
    "pandas and GeoPandas": {
        "a frame keeps CRS and columns": "_.crs == layer.crs and list(_.name) == ['well', 'lot'] and _.geometry[1].equals(m(lot))",
        "the same": "_.equals(layer.icc.map(m))",
        "a series": "_.crs == layer.crs and _[1].equals(m(lot))",
        "lines bend": "len(_.geometry[1].exterior.coords) > 4 and abs(_.geometry[1].area - exact_area()) < 0.01",
        "exact lines": "len(_.geometry[1].exterior.coords) > 4 and abs(_.geometry[1].area - exact_area()) < 1e-9",
        "geometries outside": "list(_.geometry.isna()) == [True, False]",
        "frames as shapes": "_.certified and near(_(points), m(points))",
        "series as shapes": "_.certified and near(_(points), m(points))",
        "a dict of GeoJSON": "_.certified and near(_(points), m(points))",
        "files as shapes": "_.certified and near(_(points), m(points))",
        "a clockwise shape": "_.certified",
        "a table of points": "list(_.index) == ['a', 'b', 'c'] and list(_) == ['x', 'y'] and near(_, m(points))",
    },
    "xarray": {
        "a raster": "_.dims == ground.dims and _.shape == ground.shape and bool(_.notnull().any())",
        "a dataset": "_['name'] == 'hill' and _.height.equals(ground.icc.warp(m)) and _.slope.equals(2 * _.height)",
        "the CRS of rioxarray stays": "_ == 0",
        "onto another grid": "_.shape == (1, 3, 6) and _.equals(ground.icc.warp(m)[:, 2:5, 1:7])",
        "classes": "_.dtype.kind == 'i' and set(_.values.flat) <= set(range(72))",
        "points with labels": "_.dims == places.dims and list(_.id) == [4, 5, 6] and near(_, m(points))",
    },
    "Dask": {
        "an array stays lazy": "isinstance(_, dask.array.Array) and near(_.compute(), m(points))",
        "a frame stays lazy": "isinstance(_, dask.dataframe.DataFrame) and near(_.compute(), m(points))",
        "a file of points": "_ == 3 and near(np.load('moved.npy'), m(points))",
    },
    "scikit-image and SciPy": {
        "warp": "_.shape == picture.shape and not near(_, picture)",
        "the way back": "near(_, t(pixels))",
        "one after another": "near(_(pixels), pixels)",
        "a transform of scikit-image after it": "near(_(pixels), 2 * t(pixels))",
        "from points": "near(_(pixels), pixels + 1)",
        "residuals": "near(_, [0, 0, 0])",
        "SciPy's warp": "near(_[1:-1, 1:-1], skimage.transform.warp(picture, t)[1:-1, 1:-1], 1e-9)",
        "libicc's own": "_.shape == picture.shape and near(_[1:-1, 1:-1], skimage.transform.warp(picture, t)[1:-1, 1:-1], 1e-3)",
    },
    "ITK, VTK, OpenCV and PyTorch": {
        "a displacement field": "_.shape == (9, 9, 9, 3) and _.dtype == numpy.float32",
        "its certificate": "_['certified'] and _['n_cells'] == 512",
        "a field of another program": "_['certified']",
        "on the grid of an image": "_.shape == (9, 9, 9) and near(_.images[3, 4, 5], solid([[3, 4, 5]])[0])",
        "for ANTs and ITK": "near(nibabel.load('field.nii.gz').get_fdata()[:, :, :, 0], field.displacements * [-1, -1, 1])",
        "for elastix and Slicer": "b'ElementNumberOfChannels = 3' in open('field.mha', 'rb').read()",
        "for VTK": "near(vtk_to_numpy(reader('field.vti').GetOutput().GetPointData().GetScalars()).reshape(9, 9, 9, 3)"
                   ".transpose(2, 1, 0, 3), field.displacements)",
        "vtkGridTransform": "near(_, field.images[3, 4, 5], 1e-6)",
        "for compositors": "open('stmap.pfm', 'rb').read().startswith(b'PF')",
        "cv2.remap": "all(one.shape == (9, 10) and one.dtype == numpy.float32 for one in _)",
        "derivatives by points": "_.shape == (1, 3, 3) and numpy.linalg.det(_[0]) > 0",
        "derivatives by the target's vertices": "callable(_)",
    },
    "Notebooks": {
        "a picture of a map": "_.startswith('<svg')",
        "the certificate in words": "'one-to-one' in _",
        "a picture of a shape": "_.startswith('<svg')",
        "a solid that turns, with a cut": "'Certified' in _ and '<iframe' in _",
        "the same as a page": "_.startswith('<!doctype html>')",
        "matplotlib": "len(_) == 2 and drawn(_[0])",
        "stretch as colours": "len(_) == 2 and drawn(_[0])",
        "a shape in matplotlib": "drawn(_)",
        "a solid in matplotlib": "len(_) == 2 and drawn(_[0])",
        "a bar of progress": "_.certified and '%' in said.getvalue()",
    },
    "C++": {
        **dict.fromkeys(("numbers in a row", "std::array", "Eigen's vectors", "Eigen's matrix", "glm's vectors",
                         "structs of x and y", "as a shape"), "same(_)"),
    },
    "JavaScript": {
        **dict.fromkeys(("a closed ring", "an open ring", "a geometry", "a feature"),
                        "_.certified && near(_.apply([[1, 1]]), m.apply([[1, 1]]))"),
        "GeoJSON in and out": "_.properties.id === 7 && near(_.geometry.coordinates[0].flat(), moved.flat())",
        "lines bend": "_.coordinates.length === 5 && near(_.coordinates[1], m.apply([[1.5, 1]]))",
        "points of x and y": "near(_, m.apply([[1, 1]]))",
        "the way back": "near(_, [1, 1])",
        "pixels": "_.width === 4 && _.data.length === 64",
        "three.js in, a surface": "_.vertices.length === 24 && _.facets.length === 36",
        "three.js out, bent": "_ === 0 && near([geometry.attributes.position.getX(7)], [2])",
        "a worker": "await _.close() === undefined",
    },
}
NEEDS = re.compile(r"<!-- needs: (.*?) -->")
ROW = re.compile(r"^\| (.+?) \| `(.+)` \| (Y|-) \|$", re.M)
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.M | re.S)


class Section:
    """A community: its code, and its lines with what the page says of them."""

    def __init__(self, text):
        self.name, _, body = text.partition("\n")
        needs = NEEDS.search(body)
        self.modules = [need.strip().split()[-1] for need in needs.group(1).split(",")] if needs else []
        self.language, self.code = BLOCK.search(body).groups()
        self.lines = ROW.findall(body)


def parts_of(page):
    """The code at the page's beginning, and the sections that have code: others point to other pages."""
    beginning, *parts = re.split(r"^## ", page.read_text(encoding="utf-8"), flags=re.M)
    return BLOCK.search(beginning).group(2), [Section(text) for text in parts if BLOCK.search(text)]


def lacking(modules):
    import importlib.util

    return [module for module in modules if importlib.util.find_spec(module) is None]


class Python:
    """Sections share their names, but need only those of the page's beginning."""

    def __init__(self):
        import numpy

        def near(a, b, most=1e-9):
            a, b = numpy.asarray(a, float), numpy.asarray(b, float)
            return a.shape == b.shape and bool((numpy.abs(a - b) <= most).all())

        self.said = io.StringIO()
        self.names = {"near": near, "numpy": numpy, "said": self.said, "drawn": self.drawn, "exact_area": self.exact_area}

    def drawn(self, axis):
        axis.figure.canvas.draw()
        self.names["matplotlib"].pyplot.close(axis.figure)
        return True

    def exact_area(self):
        """The area of the image of the lot, by cutting it along the triangles of the map."""
        from shapely.geometry import Polygon

        vertices, images, triangles = self.names["m"].mesh()
        total = 0.0
        for corners in triangles:
            piece, moved = Polygon(vertices[corners]), Polygon(images[corners])
            total += piece.intersection(self.names["lot"]).area / piece.area * moved.area
        return total

    def missing(self, section):
        return ", ".join(lacking(["numpy", *section.modules]))

    def begin(self, code):
        exec(compile(code, "the beginning", "exec"), self.names)

    def run(self, section):
        exec(compile(section.code, section.name, "exec"), self.names)
        return {what: self.works(line, CHECKS[section.name][what]) for what, line, _ in section.lines}

    def works(self, line, check):
        """None if the line works, else why not."""
        with contextlib.redirect_stderr(self.said):
            try:
                self.names["_"] = eval(line, self.names)
                good = isinstance(check, str) and eval(check, self.names)
                return None if good else f"the check failed: {check}"
            except Exception as error:
                if isinstance(check, type) and isinstance(error, check):
                    return None
                return "".join(traceback.format_exception_only(type(error), error)).strip()


class Cpp:
    TOOLS = """
#include <algorithm>
#include <cstdio>

// Whether the coordinates are those of `plain`, in the order of memory.
template <class Points> bool same(const Points &points)
{
    const auto *numbers = reinterpret_cast<const double *>(points.data());
    return points.size() * sizeof *points.data() == 8 * sizeof(double) && std::equal(plain.begin(), plain.end(), numbers);
}
"""

    def __init__(self, stage, compiler):
        self.stage, self.compiler = Path(stage).resolve(), compiler

    def missing(self, section):
        headers = ["/usr/include/eigen3/Eigen/Core", "/usr/include/glm/vec2.hpp", self.stage / "include/icc/icc.hpp"]
        return ", ".join(str(header) for header in headers if not Path(header).exists())

    def program(self, section, lines):
        tests = "".join(f"    {{ const auto _ = {line};\n      std::puts({check} ? \"Y\" : \"-\"); }}\n"
                        for line, check in lines)
        return f"{section.code}{self.TOOLS}\nint main()\n{{\n{tests}}}\n"

    def answers(self, section, lines):
        """What a program with these lines prints, or why it cannot be compiled."""
        library = next(self.stage.glob("lib*/**/libicc.so"))
        Path("lines.cpp").write_text(self.program(section, lines), encoding="utf-8")
        made = subprocess.run([self.compiler, "-std=c++17", f"-I{self.stage / 'include'}", "lines.cpp", "-o", "lines",
                               library, f"-Wl,-rpath,{library.parent}"], capture_output=True, text=True)
        if made.returncode:
            return None, next((line for line in made.stderr.splitlines() if "error:" in line), made.stderr)
        return subprocess.run(["./lines"], capture_output=True, text=True, check=True).stdout.split(), ""

    def run(self, section):
        """All lines at once; one by one only if they do not compile together."""
        pairs = {what: (line, CHECKS[section.name][what]) for what, line, _ in section.lines}
        found, _ = self.answers(section, list(pairs.values()))
        if found is None:
            found = {what: self.answers(section, [pair]) for what, pair in pairs.items()}
            return {what: why if said is None else (None if said == ["Y"] else "the check failed")
                    for what, (said, why) in found.items()}
        return {what: None if said == "Y" else "the check failed" for what, said in zip(pairs, found)}


class JavaScript:
    TOOLS = """
const near = (a, b) => a.length === b.length && Array.from(a).every((v, i) => Math.abs(v - b[i]) < 1e-9);
const corner = (i) => [i & 1, i >> 1 & 1, i >> 2];
const numbers = (all) => ({ count: all.length, getX: (i) => all[i], all });
class Positions {
  itemSize = 3; count = 8; places = Array.from({ length: 8 }, (_, i) => corner(i));
  getX(i) { return this.places[i][0]; } getY(i) { return this.places[i][1]; } getZ(i) { return this.places[i][2]; }
  setXYZ(i, ...place) { this.places[i] = place; }
}
const sides = [0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5];
const geometry = { attributes: { position: new Positions() }, index: numbers(sides) };
const cube = (scale) => icc.Domain.surface(Array.from({ length: 8 }, (_, i) => corner(i).map((v) => scale * v)), sides);
const solid = new icc.Map(cube(1), cube(2));
const found = [];
const attempt = async (work) => {
  try { found.push(await work() ? null : 'the check failed'); } catch (error) { found.push(String(error)); }
};
"""

    def __init__(self, package):
        self.package = Path(package).resolve()

    def missing(self, section):
        return "" if (self.package / "package.json").exists() else "the npm package"

    def run(self, section):
        Path("node_modules").mkdir(exist_ok=True)
        Path("node_modules/libicc").symlink_to(self.package)
        tries = "".join(f"await attempt(async () => {{ const _ = {line}; return {CHECKS[section.name][what]}; }});\n"
                        for what, line, _ in section.lines)
        text = f"{section.code}{self.TOOLS}{tries}console.log(JSON.stringify(found));\n"
        Path("lines.mjs").write_text(text, encoding="utf-8")
        done = subprocess.run(["node", "--no-warnings", "lines.mjs"], capture_output=True, text=True)
        if done.returncode:
            sys.exit(done.stderr)
        return dict(zip((what for what, _, _ in section.lines), json.loads(done.stdout)))


def faults_of(section, found):
    """Where the page and what was found differ."""
    for what, line, says in section.lines:
        works = found[what] is None
        if works != (says == "Y"):
            yield f"{section.name}: {what}: `{line}`: {'it works' if works else found[what]}; the page says {says}"


def strangers(sections):
    """Lines of the page that have no check, and checks that have no line."""
    known = {section.name: [what for what, _, _ in section.lines] for section in sections}
    for name in sorted({*known, *CHECKS}):
        if sorted(known.get(name, [])) != sorted(CHECKS.get(name, {})):
            odd = set(known.get(name, [])) ^ set(CHECKS.get(name, {}))
            yield f"{name}: not both in the page and in CHECKS, or twice: {', '.join(sorted(odd))}"


def main():
    page, language = Path(sys.argv[1]).resolve(), sys.argv[2]
    runner = {"python": Python, "cpp": Cpp, "js": JavaScript}[language](*sys.argv[3:])
    beginning, sections = parts_of(page)
    faults = list(strangers(sections))
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        if language == "python":
            runner.begin(beginning)
        for section in sections if not faults else ():
            if section.language != language:
                continue
            missing = runner.missing(section)
            if missing:
                print(f"{section.name}: left out: {missing} is missing")
                continue
            found = runner.run(section)
            print(f"{section.name}: {sum(why is None for why in found.values())} of {len(found)}")
            faults += faults_of(section, found)
        os.chdir("/")
    sys.exit("\n".join(faults) or None)


if __name__ == "__main__":
    main()
