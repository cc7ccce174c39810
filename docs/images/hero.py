#!/usr/bin/env python3
"""Draws the moving picture on top of the README: somebody drags one corner of the demo's cage. The left panel is
warped by libicc, the right one by a thin-plate spline. Places that the spline turns over are red.

    python3 docs/images/hero.py OUT.gif [--libicc PROGRAM] [--steps N]

The program `libicc` makes the picture and warps it: it runs `demo` and `animate`. Needs libicc for Python, NumPy,
Pillow, and the font DejaVu (Debian: fonts-dejavu-core).
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw, ImageFont

import libicc

sys.path.append(str(Path(__file__).resolve().parents[2] / "examples"))
import thin_plate

CORNER, PLACE = 7, np.array([262, 104])          # which corner is dragged, and where to, in pixels of the fish
CROP, WIDTH, GAP, BAR = (14, 22, 441, 293), 294, 12, 34
WATER, INK, PAPER = (120, 185, 215), (30, 40, 60), (255, 255, 255)
SECONDS, HOLD = 4.0, 0.4                        # of the loop, and at least of the rest at either end
CURSOR = np.array([[0, 0], [0, 17], [4, 13], [7, 20], [10, 19], [7, 12], [12, 12]])


def cages(before, steps):
    """The cage along the way, slow at both ends."""
    for share in np.linspace(0, 1, steps):
        cage = before.copy()
        cage[CORNER] += (1 - np.cos(np.pi * share)) / 2 * (PLACE - cage[CORNER])
        yield cage


def by_libicc(program, folder, path):
    """A warped picture for each cage. Each map has to be certified."""
    names = []
    for k, cage in enumerate(path):
        names.append(str(folder / f"{k}.txt"))
        np.savetxt(names[-1], cage)
    done = subprocess.run([program, "animate", "--json", "--source", folder / "before.txt", "--background", "78b9d7",
                           folder / "fish.png", folder / "film.png", *names], check=True, stdout=subprocess.PIPE)
    report = json.loads(done.stdout)["frames"]
    assert len(report) == len(names) and all(one["certified"] for one in report)
    return [Image.open(one["file"]).convert("RGB") for one in report]


def by_spline(picture, before, cage):
    """The same by a thin-plate spline through the cage, and the share that it turns over."""
    spline = thin_plate.spline(*(thin_plate.controls([("ring", side)]) for side in (before, cage)))
    shape = libicc.Domain(before)
    canvas, _ = thin_plate.draw_spline(picture, spline, shape, WATER)
    return canvas, thin_plate.folded(spline, *thin_plate.evenly(shape))


def panel(picture, cage):
    """A warped picture with its cage, and with a cursor at the corner that is dragged."""
    scale = WIDTH / (CROP[2] - CROP[0])
    size = WIDTH, round(scale * (CROP[3] - CROP[1]))
    fine = picture.resize((2 * size[0], 2 * size[1]), Image.LANCZOS,
                          box=tuple(side * picture.width / 480 for side in CROP))
    drawing = ImageDraw.Draw(fine)
    corners = [tuple(2 * scale * (corner - CROP[:2])) for corner in cage]
    drawing.line(corners + corners[:2], fill=INK, width=3)
    for k, (x, y) in enumerate(corners):
        r = 9 if k == CORNER else 6
        drawing.ellipse([x - r, y - r, x + r, y + r], fill=PAPER, outline=INK, width=3)
    cursor = [tuple(np.array(corners[CORNER]) + 2.2 * spot) for spot in CURSOR]
    drawing.polygon(cursor, fill=INK)
    drawing.line(cursor + cursor[:1], fill=PAPER, width=2)
    return fine.resize(size, Image.LANCZOS)


def frame(left, right, share):
    """Two panels with what they are above, and how much is folded."""
    font = ImageFont.truetype("DejaVuSans-Bold.ttf", 17)
    sheet = Image.new("RGB", (2 * WIDTH + GAP, BAR + left.height), PAPER)
    drawing = ImageDraw.Draw(sheet)
    folded = f"{100 * share:.0f} % folded" if share >= 0.005 else ""
    labels = (0, left, "libicc", "nothing folds", INK), \
        (WIDTH + GAP, right, "thin-plate spline", folded, thin_plate.RED)
    for x, picture, name, words, colour in labels:
        sheet.paste(picture, (x, BAR))
        drawing.text((x + 2, BAR / 2), name, INK, font, anchor="lm")
        drawing.text((x + WIDTH - 2, BAR / 2), words, colour, font, anchor="rm")
    return sheet


def save(name, frames):
    """There and back as a GIF. All frames share one palette, so still places cost nothing."""
    board = Image.new("RGB", (frames[0].width, 3 * frames[0].height))
    for k in range(3):
        board.paste(frames[k * (len(frames) - 1) // 2], (0, k * frames[0].height))
    palette = board.quantize(64, Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    flat = [picture.quantize(palette=palette, dither=Image.Dither.NONE) for picture in frames]
    there_and_back = flat + flat[-2:0:-1]
    step = 10 * int(100 * (SECONDS - 2 * HOLD) / len(there_and_back))
    durations = [step] * len(there_and_back)
    for end in (0, len(flat) - 1):
        durations[end] += (round(1000 * SECONDS) - step * len(there_and_back)) // 2
    there_and_back[0].save(name, save_all=True, append_images=there_and_back[1:], duration=durations, loop=0,
                           disposal=1, optimize=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out")
    parser.add_argument("--libicc", default="libicc")
    parser.add_argument("--steps", type=int, default=27)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name) / "demo"
        subprocess.run([options.libicc, "demo", folder], check=True, stdout=subprocess.DEVNULL)
        before = np.loadtxt(folder / "before.txt")
        path = list(cages(before, options.steps))
        picture = np.asarray(Image.open(folder / "fish.png").convert("RGB"))
        frames = []
        for cage, warped in zip(path, by_libicc(options.libicc, folder, path)):
            splined, share = by_spline(picture, before, cage)
            frames.append(frame(panel(warped, cage), panel(splined, cage), share))
    save(options.out, frames)


if __name__ == "__main__":
    main()
