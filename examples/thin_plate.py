#!/usr/bin/env python3
"""The usual way to carry a map or a picture along with control points, beside libicc's: a thin-plate spline
(F. L. Bookstein, Principal warps, IEEE Transactions on Pattern Analysis and Machine Intelligence 11, 1989). It is
smooth and goes through all points, but it is not one-to-one: where points move far, it folds over. How much of the
shape does is counted.

    python3 examples/thin_plate.py CASE.geojson [OUT.png [--picture IN.png] [--layer LAYER.geojson]]

CASE.geojson holds both sides, as `libicc map` reads them: Polygons with holes, Points and LineStrings. The spline
gets all their vertices, and points on their edges. OUT.png has three panels: before, by the spline, by libicc; what
the spline turns over is red. With a picture the coordinates are its pixels, y down. Lines of a layer, such as roads,
are carried along in each panel. Needs libicc for Python and NumPy; to draw, Pillow.
"""

import argparse
import json

import libicc
import numpy as np


def read(name):
    """The features of both sides: lists of (kind, vertices) in one order, the rings first."""
    sides = {"source": [], "target": []}
    for feature in json.load(open(name, encoding="utf-8"))["features"]:
        role, kind = feature["properties"].get("role"), feature["geometry"]["type"]
        places = feature["geometry"]["coordinates"]
        if role not in sides:
            continue
        if kind == "Polygon":
            sides[role] += [(-1, k, "ring", np.array(ring[:-1], float)) for k, ring in enumerate(places)]
        else:
            sides[role].append((0, feature["properties"]["feature"], kind, np.array(places, float).reshape(-1, 2)))
    return [[feature[2:] for feature in sorted(side, key=lambda f: f[:2])] for side in sides.values()]


def read_layer(name):
    """The lines of a layer, with as many vertices as it takes to look smooth when they are bent."""
    shapes = [feature["geometry"] for feature in json.load(open(name, encoding="utf-8"))["features"]]
    return [("road", along(np.array(shape["coordinates"], float), False, 40)) for shape in shapes
            if shape["type"] == "LineString"]


def carried(function, layer):
    return [(kind, function(places)) for kind, places in layer]


def domain(features):
    """What libicc makes of one side."""
    rings = [places for kind, places in features if kind == "ring"]
    return libicc.Domain(rings[0], holes=rings[1:], lines=[f[1] for f in features if f[0] == "LineString"],
                         points=[f[1][0] for f in features if f[0] == "Point"])


def along(vertices, closed, pieces=4):
    """The vertices of a ring or line, and points that cut its edges into pieces."""
    ends = np.roll(vertices, -1, axis=0) if closed else vertices[1:]
    starts = vertices if closed else vertices[:-1]
    shares = np.arange(pieces)[:, None, None] / pieces
    inner = (starts * (1 - shares) + ends * shares).transpose(1, 0, 2).reshape(-1, 2)
    return inner if closed else np.vstack([inner, vertices[-1:]])


def controls(features):
    """All points that a spline has to go through. Where lines meet, points are listed more than once."""
    return np.vstack([along(places, kind == "ring") for kind, places in features])


def spline(points, images):
    """The spline that takes points (n, 2) to their images, as a function of points (m, 2)."""
    points, once = np.unique(points, axis=0, return_index=True)
    images = images[once]
    middle, size = points.mean(axis=0), np.ptp(points)
    points = (points - middle) / size

    def kernel(at):
        squares = ((at[:, None] - points) ** 2).sum(axis=2)
        return squares * np.log(np.where(squares > 0, squares, 1))

    def linear(at):
        return np.column_stack([np.ones(len(at)), at])

    system = np.block([[kernel(points), linear(points)], [linear(points).T, np.zeros((3, 3))]])
    weights = np.linalg.solve(system, np.vstack([images, np.zeros((3, 2))]))

    def function(at):
        blocks = np.array_split((np.asarray(at, float) - middle) / size, 1 + len(at) // 4096)
        return np.vstack([kernel(block) @ weights[:-3] + linear(block) @ weights[-3:] for block in blocks])
    return function


def evenly(shape, n=150):
    """Evenly spread points of a domain, and how far apart they are."""
    low, high = shape.vertices.min(axis=0), shape.vertices.max(axis=0)
    step = (high - low).max() / n
    x, y = np.meshgrid(np.arange(low[0] + step / 2, high[0], step), np.arange(low[1] + step / 2, high[1], step))
    points = np.column_stack([x.ravel(), y.ravel()])
    return points[shape.locate(points) == libicc.INSIDE], step


def folded(function, points, step):
    """The share of the points round which the function turns over."""
    right, up = np.array([step / 20, 0]), np.array([0, step / 20])
    x, y = function(points + right) - function(points - right), function(points + up) - function(points - up)
    return np.mean(x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0] <= 0)


# ---- a picture of it

RED, WHITE, DARK, ROAD = (214, 40, 40), (255, 255, 255), (30, 40, 60), (245, 140, 0)


def checkerboard(width, height, cells=24):
    """Squares whose colour changes from left to right and from top to bottom."""
    y, x = np.mgrid[0:height, 0:width]
    cell = max(width, height) / cells
    light = 0.8 + 0.2 * ((x // cell + y // cell) % 2)
    colours = np.stack([150 + 100 * x / width, 215 + 0 * x, 250 - 120 * y / height], axis=2)
    return (colours * light[:, :, None]).astype(np.uint8)


def outline(drawing, features, scale=1):
    for kind, places in features:
        path = [tuple(scale * p) for p in places]
        if kind == "Point":
            x, y = path[0]
            r = 3.5 * scale
            drawing.ellipse([x - r, y - r, x + r, y + r], fill=DARK, outline=WHITE)
        else:
            colour = ROAD if kind == "road" else DARK
            drawing.line(path + path[:1] if kind == "ring" else path, fill=colour, width=2 * scale)


def draw_spline(picture, function, shape, ground=WHITE):
    """Small squares of the shape where the spline takes them, on a ground; those that turn over last, in red."""
    from PIL import Image, ImageDraw
    height, width = picture.shape[:2]
    places, step = evenly(shape, 240)
    corners = [function(places + step / 2 * np.array(way)) for way in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    squares = 2 * np.stack(corners, axis=1)
    x, y = squares[:, 2] - squares[:, 0], squares[:, 3] - squares[:, 1]
    turned = x[:, 0] * y[:, 1] - x[:, 1] * y[:, 0] <= 0
    canvas = Image.new("RGB", (2 * width, 2 * height), ground)
    drawing = ImageDraw.Draw(canvas)
    for i in np.argsort(turned, kind="stable"):
        column, row = (np.clip(places[i], 0, [width - 1, height - 1])).astype(int)
        colour = RED if turned[i] else tuple(int(c) for c in picture[row, column])
        drawing.polygon([tuple(corner) for corner in squares[i]], fill=colour)
    return canvas, drawing


def draw(name, before, after, picture, layer=()):
    """Three panels side by side."""
    from PIL import Image, ImageDraw
    height, width = picture.shape[:2]
    source, target = domain(before), domain(after)
    blank = np.full_like(picture, 255)
    maps = libicc.Map(source, source), libicc.Map(source, target)
    panels = [Image.fromarray(libicc.warp_image(picture, mapping, out=blank)).resize((2 * width, 2 * height))
              for mapping in maps]
    bent = spline(controls(before), controls(after))
    spread, drawing = draw_spline(picture, bent, source)
    outline(drawing, carried(bent, layer) + after, 2)
    for panel, mapping, features in zip(panels, maps, (before, after)):
        outline(ImageDraw.Draw(panel), carried(mapping, layer) + features, 2)
    sheet = Image.new("RGB", (3 * width + 24, height), WHITE)
    for k, panel in enumerate((panels[0], spread, panels[1])):
        sheet.paste(panel.resize((width, height), Image.LANCZOS), (k * (width + 12), 0))
    sheet.save(name)


def to_pixels(sides, size=300, margin=6):
    """The features in pixels of a panel, y down, and what is drawn on it."""
    corners = np.vstack([places for side in sides for _, places in side])
    low, high = corners.min(axis=0), corners.max(axis=0)
    scale = (size - 2 * margin) / (high - low).max()
    width, height = ((high - low) * scale).astype(int) + 2 * margin
    moved = [[(kind, (places - [low[0], high[1]]) * [scale, -scale] + margin) for kind, places in side]
             for side in sides]
    return moved, checkerboard(width, height)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("case")
    parser.add_argument("out", nargs="?")
    parser.add_argument("--picture")
    parser.add_argument("--layer")
    options = parser.parse_args()
    before, after = read(options.case)
    source, target = domain(before), domain(after)
    mapping = libicc.Map(source, target)
    share = folded(spline(controls(before), controls(after)), *evenly(source))
    print(f"thin-plate spline through {len(np.unique(controls(before), axis=0))} points: {100 * share:.1f} % of the shape is turned over")
    proof = "certified, none" if mapping.certified else "not certified"
    print(f"libicc: {mapping.info.n_simplices} triangles, {proof}")
    layer = read_layer(options.layer) if options.layer else []
    if options.out is not None:
        if options.picture is not None:
            from PIL import Image
            picture = np.asarray(Image.open(options.picture).convert("RGB"))
        else:
            (before, after, layer), picture = to_pixels((before, after, layer))
        draw(options.out, before, after, picture, layer)


if __name__ == "__main__":
    main()
