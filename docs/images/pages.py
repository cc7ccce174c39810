#!/usr/bin/env python3
"""Draws the pictures of the tutorials and how-to pages that no block of these pages draws.

    python3 docs/images/pages.py FOLDER [NAME..]      FOLDER: where the pictures go; NAME: only these

Needs the program `libicc` in PATH, libicc for Python, NumPy, Pillow and Matplotlib; for old_map also `gdalwarp`.
"""

import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace

import matplotlib
import numpy as np
from PIL import Image, ImageDraw

import libicc
import solids
from libicc import stages

matplotlib.use("Agg")
import matplotlib.pyplot as plt                                 # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection   # noqa: E402
from matplotlib.font_manager import FontProperties              # noqa: E402
from matplotlib.patches import PathPatch                        # noqa: E402
from matplotlib.path import Path as Path_                       # noqa: E402
from matplotlib.textpath import TextPath                        # noqa: E402
from mpl_toolkits.mplot3d.art3d import Poly3DCollection         # noqa: E402

TOP = Path(__file__).resolve().parents[2]
sys.path.append(str(TOP / "examples"))
INK, SHAPE, RED = "#334455", "#e8eef6", "#dd2222"


def run(*words):
    subprocess.run([str(word) for word in words], check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)


def block(page, name):
    """A file that a page shows."""
    text = (TOP / "docs" / page).read_text(encoding="utf-8")
    return re.search(rf"<!-- file: {name} -->\n```\w+\n(.*?)```", text, re.S)[1]


def names_of(page, n_blocks):
    """The names that the first Python blocks of a page define. They find the examples as on the page."""
    text, names = (TOP / "docs" / page).read_text(encoding="utf-8"), {}
    Path("examples").symlink_to(TOP / "examples")
    for code in re.findall(r"```python\n(.*?)```", text, re.S)[:n_blocks]:
        exec(code, names)
    return SimpleNamespace(**names)


def beside(pictures, width, gap=16):
    """Pictures of one height side by side, on white."""
    whole = Image.new("RGB", (sum(p.width + gap for p in pictures) - gap, pictures[0].height), "white")
    at = 0
    for picture in pictures:
        whole.paste(picture, (at, 0))
        at += picture.width + gap
    return whole.resize((width, round(whole.height * width / whole.width)), Image.LANCZOS).quantize(200, dither=0)


def twice(name):
    picture = Image.open(name).convert("RGB")
    return picture.resize((2 * picture.width, 2 * picture.height), Image.LANCZOS)


def dot(pen, place, radius, line=(40, 70, 90)):
    pen.ellipse([*(place - radius), *(place + radius)], fill="white", outline=line, width=radius // 5 + 1)


def fish_pair():
    """The demo's fish before and after, in its cages."""
    run("libicc", "demo", "fish")
    run("libicc", "warp", "-s", "fish/before.txt", "-t", "fish/after.txt", "--background", "78b9d7", "fish/fish.png", "bent.png")
    pictures = [twice("fish/fish.png"), twice("bent.png")]
    for picture, cage in zip(pictures, ("before", "after")):
        corners, pen = 2 * np.loadtxt(f"fish/{cage}.txt"), ImageDraw.Draw(picture)
        pen.line([tuple(c) for c in [*corners, corners[0]]], fill="white", width=4)
        for corner in corners:
            dot(pen, corner, 9)
    return beside(pictures, 900)


def pins():
    """The fish, posed by the handles of the page."""
    for name in ("pins.json", "wag.json"):
        Path(name).write_text(block("howto/handles.md", name), encoding="utf-8")
    run("libicc", "demo", "fish")
    run("libicc", "pose", "-s", "fish/before.txt", "--handles", "pins.json", "--pose", "wag.json", "--certified",
        "--background", "78b9d7", "fish/fish.png", "posed.png")
    rest = np.array(json.load(open("pins.json"))["handles"], float)
    posed, turns = rest.copy(), np.zeros(len(rest))
    for move in json.load(open("wag.json"))["moves"]:
        posed[move["handle"]] += move["move"]
        turns[move["handle"]] = np.radians(move["turn"])
    pictures = [twice("fish/fish.png"), twice("posed.png")]
    for picture, places, angles in zip(pictures, (rest, posed), (0 * turns, turns)):
        pen = ImageDraw.Draw(picture)
        for place, angle in zip(2 * places, angles):
            pen.line([*place, *(place + 44 * np.array([np.cos(angle), np.sin(angle)]))], fill="white", width=6)
            dot(pen, place, 15, (20, 40, 60))
    return beside(pictures, 900)


def chessboard():
    """The page of the browser: the board at rest, and its corner dragged to two places."""
    row, column = np.indices((400, 400))
    board = np.where(((row // 20 + column // 20) % 2 == 1)[..., None], [70, 130, 180], [240, 230, 140]).astype(np.uint8)
    square = np.array([[100, 100], [300, 100], [300, 300], [100, 300]], float)
    pictures = []
    for corner in ([300, 300], [360, 350], [180, 190]):
        moved = square.copy()
        moved[2] = corner
        warped = libicc.warp_image(board, libicc.Map(square, square).retarget(moved), out=np.full_like(board, 255))
        pictures.append(Image.fromarray(warped[80:370, 80:380]))
    return beside(pictures, 900, 0)


def old_map():
    """The scan, and the scan fitted to the survey, with the known places."""
    run(sys.executable, TOP / "examples/cadastre.py", ".")
    run("libicc", "map", "-s", "parish.geojson", "--y-down=source", "--triangulation", "parish.json")
    left, upper, step = 2683080, 1247980, 0.6
    run("gdalwarp", "-q", "-t_srs", "EPSG:2056", "-te", left, 1247380, 2683880, upper, "-tr", step, step, "-dstnodata", 255, "-r",
        "cubic", "-to", "SRC_METHOD=NO_GEOTRANSFORM", "-ct", "+proj=tinshift +file=parish.json", "sheet.png", "sheet.tif")
    pictures = {"source": Image.open("sheet.png").convert("RGB"), "target": Image.open("sheet.tif").convert("RGB")}
    for feature in json.load(open("parish.geojson"))["features"]:
        role, places = feature["properties"]["role"], np.reshape(feature["geometry"]["coordinates"], (-1, 2))
        if role == "target":
            places = (places - [left, upper]) / [step, -step]
        for place in places:
            ImageDraw.Draw(pictures[role]).ellipse([*(place - 14), *(place + 14)], outline=RED, width=6)
    heights = [p.resize((round(p.width * 600 / p.height), 600), Image.LANCZOS) for p in pictures.values()]
    return beside(heights, 1000, 30)


def panels(n, size, **more):
    figure, axes = plt.subplots(1, n, figsize=size, **more)
    for ax in axes:
        ax.set_aspect("equal")
        ax.set_axis_off()
    return figure, axes


def island():
    """The island of the page with its layer, before and after."""
    for name in ("island.geojson", "data.geojson"):
        Path(name).write_text(block("howto/geojson.md", name), encoding="utf-8")
    subprocess.run(["libicc", "map", "-s", "island.geojson", "--tolerance", "0.01", "--geojson", "data.geojson", "moved.geojson"],
                   stderr=subprocess.DEVNULL, check=False)      # the buoy lies outside: exit code 4
    shores = [np.array(f["geometry"]["coordinates"][0]) for f in json.load(open("island.geojson"))["features"]]
    figure, axes = plt.subplots(1, 2, figsize=(9, 3.36))
    for ax, shore, layer in zip(axes, shores, ("data.geojson", "moved.geojson")):
        ax.set_facecolor("#cfe3f1")
        ax.fill(*shore.T, fc="#dfe8c8", ec="#4b5a2a", lw=2)
        if layer == "moved.geojson":
            ax.plot(*shores[0].T, color="#7a8a99", ls=":", lw=1.5)
        draw_layer(ax, json.load(open(layer))["features"])
        ax.set(xlim=(-2, 15.5), ylim=(-2, 11), xticks=[], yticks=[], aspect="equal")
    figure.subplots_adjust(.01, .01, .99, .99, .03)
    return figure


def draw_layer(ax, features):
    def say(place, text, colour="#222222"):
        ax.text(*place, text, color=colour, ha="right", fontsize=15)
    for feature in features:
        name, geometry = feature["properties"]["name"], feature["geometry"]
        places = np.reshape(geometry["coordinates"], (-1, 2)) if geometry else []
        if name == "road":
            ax.plot(*places.T, color="#b3401a", lw=3)
            say(places[0] + [2.6, 2.3], name, "#b3401a")
        elif name == "lake":
            ax.fill(*places.T, fc="#5b97c4", ec="#27557a")
            say(places.mean(0) + [3.2, -1.1], name, "#27557a")
        elif geometry:
            ax.plot(*places.T, "^" if name == "buoy" else "o", color="#222222", ms=9)
            say(places[0] + ([.8, .6] if name == "buoy" else [-.4, .35]), name)


def matched():
    """Two outlines that do not correspond, with equal numbers at places that go together."""
    before, after = (np.loadtxt(TOP / f"examples/data/tripus.{side}.txt") for side in ("src", "tgt"))
    after = np.array([after[(i + 20) % len(after)] for i in range(len(after), 0, -1) if i % 3])
    source, target, _ = libicc.match(before, after)
    figure, axes = panels(2, (9, 4.4))
    chosen = range(2, len(source), 6)
    for ax, own, common in zip(axes, (before, after), (source, target)):
        ax.fill(*common.T, fc=SHAPE, ec=INK, lw=1.5)
        ax.plot(*own.T, "o", color=INK, ms=4)
        for number, k in enumerate(chosen, 1):
            along = common[(k + 1) % len(common)] - common[k - 1]
            out = np.array([along[1], -along[0]]) / np.hypot(*along)
            ax.plot(*common[k], "o", color=plt.cm.turbo(.9 * number / len(chosen)), ms=9)
            ax.text(*(common[k] + .17 * out), str(number), ha="center", va="center", fontsize=17)
        (left, lower), (right, upper) = common.min(0) - .3, common.max(0) + .3
        ax.set(xlim=(left, right), ylim=(lower, upper))
    figure.subplots_adjust(0, 0, 1, 1, .02)
    return figure


def paint(ax, domain, to_source, colour, width=1.0):
    """Paints a domain: each place in the colour of the place of the source that it comes from."""
    rings = [ring for kind, ring in domain.features if kind in ("region", "hole")]
    outline = Path_.make_compound_path(*(Path_(np.vstack([ring, ring[:1]]), closed=True) for ring in rings))
    low, high = domain.vertices.min(0), domain.vertices.max(0)
    margin = .02 * (high - low).max()
    x, y = np.meshgrid(*(np.linspace(a, b, 900) for a, b in zip(low, high)))
    places = np.column_stack([x.ravel(), y.ravel()])
    picture = colour(to_source(places)).reshape(*x.shape, 3)
    image = ax.imshow(picture, extent=(low[0], high[0], low[1], high[1]), origin="lower", interpolation="antialiased")
    image.set_clip_path(PathPatch(outline, transform=ax.transData))
    for kind, ring in domain.features:
        closed = ring if kind == "line" else np.vstack([ring, ring[:1]])
        ax.plot(*closed.T, color=RED if kind == "line" else INK, lw=2 * width if kind == "line" else width,
                solid_capstyle="butt", solid_joinstyle="round", zorder=3 if kind == "line" else 4)
    ax.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin))


def glyph(text, family):
    """The rings of a glyph as regions and holes."""
    rings = [ring[:-1] for ring in TextPath((0, 0), text, size=100, prop=FontProperties(family=family))
             .to_polygons(closed_only=True)]
    rings = [ring[np.hypot(*(ring - np.roll(ring, 1, 0)).T) > 1e-6] for ring in rings]
    areas = [(ring[:, 0] * np.roll(ring[:, 1], -1) - ring[:, 1] * np.roll(ring[:, 0], -1)).sum() for ring in rings]
    largest = max(areas, key=abs)
    return libicc.Domain(None, features=[("region" if area * largest > 0 else "hole", ring)
                                         for area, ring in zip(areas, rings)])


def bands_of(domain):
    """Colours of the places of a domain: rows from blue to red, and a chequered pattern."""
    low, high = domain.vertices.min(0), domain.vertices.max(0)
    step = (high - low).max() / 14

    def colour(places):
        rows = (np.nan_to_num(places[:, 1]) - low[1]) / (high - low)[1]
        cells = np.floor((np.nan_to_num(places) - low) / step).sum(1) % 2
        return plt.cm.Spectral_r(.08 + .84 * rows)[:, :3] * (1 - .16 * cells[:, None])
    return colour


def glyphs():
    """Glyphs of two typefaces. Each place of the second has the colour of the place that it comes from."""
    figure, axes = panels(6, (12, 3))
    for k, text in enumerate("i%ä"):
        match = libicc.Match(glyph(text, "DejaVu Sans"), glyph(text, "DejaVu Serif"))
        mapping = libicc.Map(match.source, match.target)
        colour = bands_of(match.source)
        paint(axes[2 * k], match.source, lambda places: places, colour)
        paint(axes[2 * k + 1], match.target, mapping.apply_inverse, colour)
    figure.subplots_adjust(.01, .02, .99, .98, .08)
    return figure_picture(figure)


def bar_of(letter, axis, share, number):
    """The ends of a bar across a letter: where a line at a share of its size enters it and leaves it."""
    low, high = letter.vertices.min(0), letter.vertices.max(0)
    level, ends = low[axis] + share * (high - low)[axis], []
    for _, ring in letter.features:
        for a, b in zip(ring, np.roll(ring, -1, 0)):
            if (a[axis] < level) != (b[axis] < level):
                ends.append(a + (level - a[axis]) / (b - a)[axis] * (b - a))
    return sorted(ends, key=lambda end: end[1 - axis])[2 * number:2 * number + 2]


def letters():
    """Letters of two typefaces with bars from side to side, which go to their partners. Their ends are landmarks."""
    bars = {"A": [(1, .24, 0), (1, .24, 1), (1, .6, 0), (1, .6, 1), (0, .5, 0)],
            "e": [(1, .68, 0), (1, .68, 1), (0, .55, 0), (0, .5, 1)],
            "8": [(1, .28, 0), (1, .28, 1), (1, .75, 0), (1, .75, 1), (0, .5, 1)]}
    figure, axes = panels(6, (12, 3.2))
    for k, (text, places) in enumerate(bars.items()):
        sides = [glyph(text, family) for family in ("DejaVu Sans", "DejaVu Serif")]
        ends = [np.vstack([bar_of(side, *place) for place in places]) for side in sides]
        match = libicc.Match(*sides, landmarks=np.hstack(ends))
        lines = [np.hypot(*(match.source.vertices - end).T).argmin() for end in ends[0]]
        sides = [libicc.Domain(None, features=side.features + [("line", bar) for bar in side.vertices[lines].reshape(-1, 2, 2)])
                 for side in (match.source, match.target)]
        mapping = libicc.Map(*sides)
        colour = bands_of(sides[0])
        paint(axes[2 * k], sides[0], lambda places: places, colour)
        paint(axes[2 * k + 1], sides[1], mapping.apply_inverse, colour)
    figure.subplots_adjust(.01, .02, .99, .98, .08)
    return figure_picture(figure)


def states():
    """48 states with common borders, which all bend at once. A grid goes along."""
    features = json.loads((TOP / "examples/data/states.geojson").read_text())["features"]
    rings = [np.array(f["geometry"]["coordinates"][0][:-1]) for f in features]
    low, high = np.vstack(rings).min(0), np.vstack(rings).max(0)

    def bend(places):
        from_middle = places - (low + high) / 2
        turn, radius = from_middle[:, 0] / .8, .8 + from_middle[:, 1]
        return np.column_stack([radius * np.sin(turn), radius * np.cos(turn)])
    source = libicc.Domain(None, regions=rings)
    mapping = libicc.Map(source, libicc.Domain(None, regions=[bend(r) for r in rings]))

    def inside(places):
        return np.where((source.locate(places) == libicc.OUTSIDE)[:, None], np.nan, places)
    tints = ["#dce8f4", "#f6e6cf", "#e0efd8", "#f3dce4", "#e6def2", "#f7f1c9"]
    figure, axes = panels(2, (10, 3.6))
    fine = np.linspace(0, 1, 2000)[:, None]
    for ax, move in zip(axes, (inside, mapping)):
        for k, ring in enumerate(rings):
            ax.fill(*move(ring).T, fc=tints[k * 7 % 6], ec="none")
        for a in np.linspace(low[0], high[0], 40):
            ax.plot(*move(np.hstack([0 * fine + a, low[1] + fine * (high - low)[1]])).T, color="#8899aa", lw=.35)
        for b in np.linspace(low[1], high[1], 25):
            ax.plot(*move(np.hstack([low[0] + fine * (high - low)[0], 0 * fine + b])).T, color="#8899aa", lw=.35)
        for ring in rings:
            ax.plot(*move(np.vstack([ring, ring[:1]])).T, color=INK, lw=.9, solid_joinstyle="round")
    figure.subplots_adjust(.01, .01, .99, .99, .03)
    return figure_picture(figure)


def figure_picture(figure, colours=200):
    """A figure as a picture of few colours, which is small."""
    figure.canvas.draw()
    return Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3].copy()).quantize(colours, dither=0)


def stages_of_the_papers():
    """Grid, tree, function and integral curves of a shape with three legs."""
    shape = np.loadtxt(TOP / "examples/data/tripus.src.txt")
    grid = stages.Grid(shape, cells=24)
    root, _ = grid.maximum()
    tree = stages.Tree(grid, root)
    flat = [a.ravel(order="F") for a in (grid.inside, tree.generations, tree.parents, stages.Function(tree, "laplace").values)]
    inside = np.flatnonzero(flat[0])
    generations, parents, values = (a[inside] for a in flat[1:])
    places, up = grid.position(inside), (parents != inside) & (parents < len(flat[0]))
    figure, axes = panels(4, (12, 3.5))
    axes[0].plot(*places.T, "o", color="#5b97c4", ms=3)
    axes[1].add_collection(LineCollection(np.stack([places[up], grid.position(parents[up])], 1), array=generations[up],
                                          cmap="viridis_r", lw=1.6))
    axes[2].scatter(*places.T, c=np.log(np.maximum(values, 1e-6 * values.max())), s=26, marker="s")
    chart = libicc.Chart(shape, "gradient", cells=24)
    for start, end in zip(shape, np.roll(shape, -1, axis=0)):
        for share in (.25, .75):
            edge = (1 - share) * start + share * end
            axes[3].plot(*chart.trace(edge + .02 * (chart.info.maximum - edge)).T, color="#2b5fc2", lw=1)
    for ax, title in zip(axes, ("grid, maximum", "tree", "function", "integral curves")):
        ax.plot(*np.vstack([shape, shape[:1]]).T, color=INK, lw=1.5)
        ax.plot(*grid.position(root), "o", color=RED, ms=8)
        ax.set_title(title, fontsize=18)
    figure.subplots_adjust(0, 0, 1, .86, .03)
    return figure


def mesh():
    """The beam of the page before and after, its surface in stripes."""
    lines = (TOP / "examples/data/beam.mesh").read_text(encoding="utf-8").split("\n")

    def table(word, width, kind):
        at = lines.index(word) + 2
        return np.array([line.split()[:width] for line in lines[at:at + int(lines[at - 1])]], kind)
    nodes, tetrahedra = table("Vertices", 3, float), table("Tetrahedra", 4, int) - 1
    source = libicc.Domain.from_mesh(nodes, tetrahedra)
    rest, faces = source.vertices, source.facets
    angle, radius = rest[:, 0] / 12 * np.pi / 2, 8.4 - rest[:, 2]
    bent = np.column_stack([radius * np.sin(angle), rest[:, 1], 8.4 - radius * np.cos(angle)])
    stripe = (rest[faces].mean(1)[:, 0].astype(int) % 2 == 0)[:, None]
    colours = np.where(stripe, [.98, .80, .45], [.55, .70, .85])
    figure = plt.figure(figsize=(9, 3.6))
    for k, places in enumerate((rest, bent)):
        corners = places[faces]
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        light = np.clip(.62 + .38 * normals @ [.1, -.6, .8] / np.linalg.norm(normals, axis=1), .3, 1)[:, None]
        ax = figure.add_subplot(1, 2, k + 1, projection="3d")
        ax.add_collection3d(Poly3DCollection(corners, facecolors=colours * light, edgecolors=(.2, .25, .3), linewidths=.6))
        ax.auto_scale_xyz(*places.T)
        ax.set_box_aspect(np.ptp(places, axis=0), zoom=(1.05, 1.3)[k])
        ax.set_axis_off()
        ax.view_init(22, -75)
    figure.subplots_adjust(0, 0, 1, 1, 0)
    return figure


def control_points():
    """The scan with its points, and the fitted scan with the distances of left-out points, five times as long."""
    wrong = block("howto/control-points.md", "sheet.csv")
    Path("corrected.csv").write_text(wrong.replace("2683690.82", "2683590.82"), encoding="utf-8")
    run(sys.executable, TOP / "examples/cadastre.py", ".")
    page = names_of("howto/control-points.md", 1)
    left, lower, right, upper, step = 2683080, 1247340, 2683920, 1247980, 0.6
    run("libicc", "fit", "corrected.csv", "--box", "0,0,1420,1080", "--triangulation", "sheet.json")
    run("gdalwarp", "-q", "-t_srs", "EPSG:2056", "-te", left, lower, right, upper, "-tr", step, step, "-dstnodata", 255, "-r",
        "cubic", "-to", "SRC_METHOD=NO_GEOTRANSFORM", "-ct", "+proj=tinshift +file=./sheet.json", "sheet.png", "sheet.tif")
    scan, fitted = Image.open("sheet.png").convert("RGB"), Image.open("sheet.tif").convert("RGB")
    pens = ImageDraw.Draw(scan), ImageDraw.Draw(fitted)
    for pixel, place, off in zip(page.pixels * [1, -1], page.places, page.mapping.left_out):
        at = (place - [left, upper]) / [step, -step]
        pens[1].line([*at, *(at + 5 * off / [step, -step])], fill=RED, width=6)
        dot(pens[0], pixel, 13, RED)
        dot(pens[1], at, 13, RED)
    heights = [p.resize((round(p.width * 600 / p.height), 600), Image.LANCZOS) for p in (scan, fitted)]
    return beside(heights, 1000, 30)


def puppet():
    """The figure of the page at rest and posed, with its pins."""
    Path("pins.txt").write_text(block("howto/pins.md", "pins.txt"), encoding="utf-8")
    page = names_of("howto/pins.md", 2)
    pictures = [twice("figure.png"), twice("posed.png")]
    for picture, places in zip(pictures, (page.pins[:, :2], page.pins[:, 2:])):
        pen = ImageDraw.Draw(picture)
        for place in 2 * places:
            dot(pen, place, 15, (20, 40, 60))
    return beside(pictures, 700)


def wave():
    """The drawing of the page and its pose, with the pins."""
    run(sys.executable, TOP / "examples/hero.py", ".")
    pins = json.loads(block("howto/pose-a-png.md", "pins.json"))["pins"]
    assert pins == json.loads(Path("pins.json").read_text(encoding="utf-8"))["pins"]
    run("libicc", "pose", "--pins", "pins.json", "--background", "ffffff", "hero.png", "posed.png")
    pictures = [Image.new("RGB", (800, 880), "white"), twice("posed.png")]
    rest = Image.open("hero.png").resize((800, 880), Image.LANCZOS)
    pictures[0].paste(rest, mask=rest)
    for picture, place in zip(pictures, ("at", "to")):
        pen = ImageDraw.Draw(picture)
        for pin in pins:
            dot(pen, np.multiply(2, pin.get(place, pin["at"])), 15, (20, 40, 60))
    return beside(pictures, 700)


def few_colours(figure):
    """A figure of thin lines as a picture."""
    return figure_picture(figure, 24)


def moving_mesh():
    """The airfoil of the page before and after its turn, and its nose close up."""
    page = names_of("howto/moving-mesh.md", 2)
    figure, axes = panels(3, (12, 4.1))
    nose = page.turn @ [-.52, 0]
    for ax, places, (x, y), size in zip(axes, (page.vertices, page.after, page.after), ((0, 0), (0, 0), nose), (1, 1, .09)):
        ax.triplot(*places.T, page.triangles, color=INK, lw=.5)
        ax.fill(*places[page.wall].T, fc=SHAPE, ec=INK, lw=1.2)
        ax.set(xlim=(x - size, x + size), ylim=(y - size, y + size))
    figure.subplots_adjust(0, 0, 1, 1, .03)
    return few_colours(figure)


def certify():
    """The displacement field of the page with its folds, and its nearest one-to-one map."""
    page = names_of("howto/certify.md", 3)
    _, images, triangles = page.warp.mesh()
    figure, axes = panels(2, (10, 5))
    for ax, places, cells in zip(axes, (page.images, images), (page.triangles, triangles)):
        p = places[cells]
        a, b = p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
        lines = [page.warp(np.column_stack(line)) if places is images else places[numbers] for line, numbers in grid_lines(page.n)]
        ax.add_collection(LineCollection(lines, color=INK, lw=.6))
        wrong = a[:, 0] * b[:, 1] <= a[:, 1] * b[:, 0]
        ax.add_collection(PolyCollection(p[wrong], facecolors=RED, edgecolors=RED, lw=.3, zorder=3))
        ax.set(xlim=(-1, page.n + 1), ylim=(page.n + 1, -1))
    figure.subplots_adjust(0, 0, 1, 1, .02)
    return few_colours(figure)


def two_surveys():
    """The two surveys of the page, and a grid of the old one carried along."""
    page = names_of("tutorials/two-surveys.md", 4)
    figure, axes = panels(3, (9, 2.6))
    colours = ["#dce8f4", "#f4e8d4", "#e2f0dc", "#f0dce8"]
    for ax, layer, dots in zip(axes, (page.old, page.new, page.new), (True, True, False)):
        ax.add_collection(PolyCollection(list(layer.values()), facecolors=colours, edgecolors=INK, linewidths=1))
        for ring in layer.values() if dots else ():
            ax.plot(*ring.T, ".", color=RED, markersize=3)
        ax.set(xlim=(-1.2, 10.2), ylim=(-0.9, 7.9))
    fine = np.linspace(-1, 10, 800)
    for at in np.arange(-1, 10.1, 0.5):
        for line in (np.stack([fine, 0 * fine + at], 1), np.stack([0 * fine + at, fine], 1)):
            axes[2].plot(*page.m(line).T, color=INK, linewidth=0.4)
    for ax, title in zip(axes, ("old", "new", "a grid of the old one")):
        ax.set_title(title, fontsize=9, color=INK)
    return figure


TISSUE, LUNG, HEART, BONE, MARK, TUMOUR = "#f7e3d3", "#efb0a6", "#c9463d", "#efe6cf", "#2a6bb5", "#4b2a86"


def smooth(pictures, gap=80):
    """Pictures as arrays side by side, at half their size."""
    space = np.ones((len(pictures[0]), gap, 3))
    row = np.hstack([part for picture in pictures for part in (picture, space)][:-1])
    picture = Image.fromarray((255 * row).astype(np.uint8))
    return picture.resize((picture.width // 2, picture.height // 2), Image.LANCZOS)


def torso():
    """The body of the page as if its skin were of glass, before and after."""
    page = names_of("tutorials/solid-inside.md", 1)
    ball, faces = sys.modules["torso"].ball(2)
    rgb = matplotlib.colors.to_rgb
    bodies = page.before, page.after
    places = np.vstack([body["skin"][0] for body in bodies])
    pictures, eyes = [], []
    for body in bodies:
        shown = np.vstack([body["skin"][0], [[0, 0, places[:, 2].max()]]])     # so both have the same scale
        eye = solids.Eye((-.25, -1, .14), shown, 1500)
        things = [(rgb(paint), (*organ, solids.normals_of(*organ)))
                  for paint, organ in zip((LUNG, LUNG, HEART), body["organs"])]
        things += [(rgb(BONE), solids.tube(body["spine"], .9))]
        things += [(rgb(MARK), (place + .75 * ball, faces, ball)) for place in body["landmarks"]]
        pictures.append(solids.glass(eye, body["skin"], things))
        eyes.append(eye)
    picture = smooth(pictures, 160)
    figure = plt.figure(figsize=(picture.width / 100, picture.height / 100), dpi=100)
    ax = figure.add_axes([0, 0, 1, 1])
    ax.imshow(picture)
    ax.set_axis_off()
    label_organs(ax, eyes[0], page.before)
    figure.canvas.draw()
    shades = np.asarray(figure.canvas.buffer_rgba())[..., :3] / 2          # a few hundred colours would show steps
    return Image.fromarray(np.minimum(2 * np.round(shades), 255).astype(np.uint8))


def label_organs(ax, eye, body):
    """Names on the organs, and beside the spine and a landmark."""
    for organ, name, colour in zip(body["organs"], ("lung", "lung", "heart"), ("#5a1f1a", "#5a1f1a", "white")):
        place = organ[0].mean(axis=0) + [0, 0, 2.5 * (name == "lung")]
        ax.text(*eye.flat(place)[0] / 2, name, fontsize=17, color=colour, ha="center", va="center")
    for place, name, off in ((body["spine"][2], "spine", (46, 0)), (body["landmarks"][4], "landmark", (0, 24))):
        ax.text(*(eye.flat(place)[0] / 2 + off), name, fontsize=17, color="#222222", ha="center", va="center")


def torso_cut():
    """The body of the page cut from side to side, with a grid of the body before."""
    page = names_of("tutorials/solid-inside.md", 3)
    organs = [libicc.Domain(*organ) for organ in page.before["organs"]]
    figure, axes = plt.subplots(1, 2, figsize=(10, 6.4), width_ratios=[40, 48])

    def stay(places):
        return np.where((page.source.locate(places) == libicc.OUTSIDE)[:, None], np.nan, places)
    for ax, body, outline, to_source in zip(axes, (page.before, page.after), (page.tumour, page.moved),
                                            (stay, page.m.apply_inverse)):
        (left, _, low), (right, _, high) = body["skin"][0].min(0) - 1, body["skin"][0].max(0) + 1
        x, z = np.meshgrid(np.linspace(left, right, 900), np.linspace(low, high, 1200))
        source = to_source(np.column_stack([x.ravel(), np.full(x.size, -2.), z.ravel()]))
        nowhere = np.isnan(source).any(axis=1)
        source[nowhere] = [0, 0, -100]
        colours = np.tile(matplotlib.colors.to_rgb(TISSUE), (len(source), 1))
        for organ, colour in zip(organs, (LUNG, LUNG, HEART)):
            colours[organ.locate(source) == libicc.INSIDE] = matplotlib.colors.to_rgb(colour)
        colours *= 1 - .07 * (np.floor(source[:, ::2] / 3).sum(axis=1) % 2)[:, None]
        colours[nowhere] = 1
        ax.imshow(colours.reshape(*x.shape, 3), extent=(left, right, low, high), origin="lower", interpolation="antialiased")
        source[nowhere] = np.nan
        for values in source[:, ::2].T:
            ax.contour(x, z, values.reshape(x.shape), np.arange(-30, 70, 3), colors="#5b4a44", linewidths=.7,
                       linestyles="solid", alpha=.7)
        for surface, colour in ((body["skin"], "#7a6250"), *((organ, "#7c2320") for organ in body["organs"]),
                                ((outline, page.faces), TUMOUR)):
            cut = solids.section(*surface, 1, -2.000001)[..., ::2]
            ax.add_collection(LineCollection(cut, colors=colour, linewidths=2.6 if colour == TUMOUR else 1.6, capstyle="round"))
        ax.set_axis_off()
        ax.set(xlim=(left, right), ylim=(-1, 65), aspect="equal")
    axes[0].annotate("tumour", page.tumour.mean(0)[::2] + [-1.5, 1.7], (-16, 58), fontsize=16, ha="center", color=TUMOUR,
                     arrowprops={"arrowstyle": "-", "color": TUMOUR, "lw": 1.4})
    figure.subplots_adjust(0, 0, 1, 1, .02)
    return figure_picture(figure)


STEEL, GREY, ORANGE, AIR = (.58, .70, .83), (.45, .55, .67), (.93, .45, .16), (.82, .89, .96)


def bracket():
    """The bracket of the page before and after. The walls of the hole that moves are orange."""
    page = names_of("howto/solid-parts.md", 1)
    vertices, faces = page.part
    middle = vertices[faces[:, 0]]
    across = np.ptp(vertices[faces][:, :, 0], axis=1) > .9          # from the front of the upright to its back
    within = (abs(middle[:, 1] - 6) < 5) & (abs(middle[:, 2] - 9.6) < 3)
    paints = np.where((across & within)[:, None], ORANGE, STEEL)
    eye = solids.Eye((-1, -.75, .6), vertices, 1200)
    return smooth([solids.facets(eye, places, faces, paints, 1.6) for places in (vertices, page.wanted[0])]).quantize(255)


def wing():
    """Half of the air of the page, with the wing, before and after."""
    page = names_of("howto/solid-parts.md", 3)
    n_box, n_wing = len(page.box()[0]), len(page.wing()[0])
    faces = solids.skin_of(page.tetrahedra[page.rest[page.tetrahedra].mean(1)[:, 1] > 0])
    faces = faces[~((faces >= n_box) & (faces < n_box + n_wing)).all(axis=1)]
    walls = page.wing()[1] + n_box
    paints = [*np.where((faces < n_box).all(axis=1)[:, None], GREY, AIR), *np.tile(ORANGE, (len(walls), 1))]
    faces = np.concatenate([faces, walls])
    eye = solids.Eye((-.4, -1, .35), page.rest[np.unique(faces)], 1200)
    return smooth([solids.facets(eye, places, faces, paints, 1.6) for places in (page.rest, page.turned)]).quantize(255)


def grid_lines(n):
    """Lines of a grid of n x n cells: finely sampled places, and the numbers of their vertices."""
    fine, k = np.linspace(0, n, 8 * n + 1), np.arange(n + 1)
    for at in range(n + 1):
        yield (fine, 0 * fine + at), at * (n + 1) + k
        yield (0 * fine + at, fine), k * (n + 1) + at


PICTURES = {"control-points": control_points, "puppet": puppet, "wave": wave,
            "moving-mesh": moving_mesh, "certify": certify,
            "fish-pair": fish_pair, "pins": pins, "chessboard": chessboard, "old-map": old_map, "island": island,
            "matched": matched, "glyphs": glyphs, "letters": letters, "states": states, "two-surveys": two_surveys,
            "stages": stages_of_the_papers, "mesh": mesh, "torso": torso, "torso-cut": torso_cut, "bracket": bracket,
            "wing": wing}


def main():
    folder, names = Path(sys.argv[1]).resolve(), sys.argv[2:] or list(PICTURES)
    for name in names:
        with tempfile.TemporaryDirectory() as scratch:
            os.chdir(scratch)
            picture, file = PICTURES[name](), folder / f"{name}.png"
            if isinstance(picture, Image.Image):
                picture.save(file, optimize=True)
            else:
                picture.savefig(file)
            os.chdir(TOP)
        print(file)


if __name__ == "__main__":
    main()
