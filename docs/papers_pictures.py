#!/usr/bin/env python3
"""Draws the pictures of docs/papers.md: figures of the papers with their method, beside libicc's default map.

usage: papers_pictures.py FOLDER      LIBICC=/path/to/libicc

Writes FOLDER/papers-NAME.png. Needs rsvg-convert and Pillow (Debian: librsvg2-bin, python3-pil).
"""

import os
import re
import subprocess
import sys
from pathlib import Path

from PIL import Image

LIBICC = os.environ.get("LIBICC", "libicc")
DATA = Path(__file__).resolve().parent.parent / "examples/data"
SIDE, GAP, FONT, WIDTH = 300, 16, 21, 240


class Drawing:
    """What a command draws as SVG."""

    n = 0

    def __init__(self, folder, *command):
        Drawing.n += 1
        path = folder / f"drawing{Drawing.n}.svg"
        subprocess.run([LIBICC, *map(str, command), path], check=True, capture_output=True)
        # Drawings come together in one file, where names must differ.
        text = re.sub(r'(id="|#)(?=box"|shape|box\))', f"\\g<1>d{Drawing.n}-", path.read_text(encoding="utf-8"))
        path.unlink()
        self.width, self.height = (float(x) for x in re.search(r'viewBox="0 0 (\S+) (\S+)"', text).groups())
        self.body = re.search(r"<svg[^>]*>(.*)</svg>", text, re.S)[1]
        number = r'="([-\d.]+)"'
        self.images = [tuple(map(float, found)) for found in re.findall(
            rf"<image x{number} y{number} width{number} height{number}", self.body)]

    def image(self, k, rows_below=0):
        """The drawing round its k-th picture, or of a place so many rows below it."""
        x, y, width, height = self.images[k]
        pitch = next(b[1] - a[1] for a, b in zip(self.images, self.images[1:]) if b[0] == a[0] and b[3] == a[3])
        return self.part(x - 8, y + rows_below * pitch - 8, width + 16, height + 16)

    def part(self, x, y, width, height):
        return f'viewBox="{x} {y} {width} {height}"', height / width, self.body

    def between_captions(self):
        """Where the last drawing begins, below the captions of the one above, and where it ends."""
        lines = [(text, float(y)) for y, text in re.findall(r'<text x="[^"]*" y="([^"]*)"[^>]*>\s*([^<]*)', self.body)]
        end = next(y for text, y in lines if text.startswith("elevation"))
        self.body = re.sub(r"<text.*?</text>", "", self.body, flags=re.S)
        return max(y for _, y in lines if y < end) + 6, end - 16


def write(folder, name, columns, panels):
    """Panels, each a title and a part of a drawing, in rows."""
    tall = SIDE * max(shape for _, (_, shape, _) in panels)
    height = tall + FONT + 2 * GAP
    width, total = columns * (SIDE + GAP) + GAP, -(-len(panels) // columns) * height + GAP
    path = folder / f"papers-{name}.svg"
    with path.open("w", encoding="utf-8") as out:
        out.write('<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
                  f' viewBox="0 0 {width} {total}" font-family="sans-serif"><rect width="{width}" height="{total}" fill="white"/>\n')
        for k, (title, (box, _, body)) in enumerate(panels):
            left, top = GAP + k % columns * (SIDE + GAP), GAP + k // columns * height
            out.write(f'<text x="{left + SIDE / 2}" y="{top + FONT - 4}" font-size="{FONT}"'
                      f' text-anchor="middle">{title}</text>\n<svg x="{left}" y="{top + FONT + 4}" width="{SIDE}" height="{tall}" {box}>{body}</svg>\n')
        out.write("</svg>\n")
    subprocess.run(["rsvg-convert", "-w", str(columns * WIDTH), path, "-o", path.with_suffix(".png")], check=True)
    path.unlink()
    with Image.open(path.with_suffix(".png")) as picture:
        smaller = picture.convert("RGB").quantize(256, Image.Quantize.MAXCOVERAGE)
    smaller.save(path.with_suffix(".png"), optimize=True)
    print(path.with_suffix(".png"))


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    cages = ["--source", DATA / "l.src.txt", "--target", DATA / "l.tgt.txt"]
    papers, ours = Drawing(folder, "plot", "--method", "gradient", *cages), Drawing(folder, "plot", *cages)
    write(folder, "l", 3, [("L", papers.image(1)), ("the papers' method", papers.image(4)),
                           ("libicc's default", ours.image(3))])

    cages = ["--source", DATA / "tripus.src.txt", "--target", DATA / "tripus.tgt.txt"]
    papers = Drawing(folder, "plot", "--method", "gradient", "--function", "distance,laplace:unconstrained", *cages)
    ours = Drawing(folder, "plot", *cages)
    write(folder, "legs", 3, [("L1 distance", papers.image(3)), ("Laplace", papers.image(6)),
                              ("libicc's default", ours.image(3)), ("its curves", papers.image(4)),
                              ("its curves", papers.image(7)), ("its triangles", ours.image(3, 1))])

    tripus = ["plot", "--method", "gradient", "--elevation", "--source", DATA / "tripus.src.txt"]
    panels = []
    for name, function in ("decay", "decay"), ("Laplace, logarithm", "laplace"):
        steps = Drawing(folder, *tripus, "--function", function)
        top, bottom = steps.between_captions()
        panels.append((name, steps.part(0, top, steps.width, bottom - top)))
    write(folder, "landscape", 2, panels)

    star = ["weights", "--source", DATA / "star.txt", "--handles", DATA / "star.json", "--handle", "0",
            "--sampling", "grid"]
    options = ["--thesis"], ["--thesis", "--log"], ["--log"]
    drawings = [Drawing(folder, *star, *words, "--picture") for words in options]
    titles = "thesis", "thesis, logarithmic", "default, logarithmic"
    write(folder, "star", 3, [(title, d.part(0, 0, d.width, d.height)) for title, d in zip(titles, drawings)])


if __name__ == "__main__":
    main()
