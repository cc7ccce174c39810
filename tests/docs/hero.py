"""The moving picture of the README: the committed file loops for four seconds and is small, and its script still draws
folds in the right panel only.

usage: hero.py ROOT LIBICC WORK
"""

import subprocess
import sys
from pathlib import Path

try:
    import numpy as np
    from PIL import Image, ImageFont, ImageSequence
    ImageFont.truetype("DejaVuSans-Bold.ttf", 17)
except (ImportError, OSError) as reason:
    print(f"left out: {reason}")
    sys.exit(77)

RED = np.array([214, 40, 40])


def frames(name):
    with Image.open(name) as film:
        assert film.info["loop"] == 0, f"{name} does not loop for ever"
        found = [(np.asarray(frame.convert("RGB"), int), frame.info["duration"])
                 for frame in ImageSequence.Iterator(film)]
    return [frame for frame, _ in found], sum(duration for _, duration in found)


def red(panel):
    """How many pixels of a panel, below its label, are red."""
    return int((abs(panel[34:] - RED).max(axis=2) < 30).sum())


def check(name):
    """The middle frame has folds on the right, none on the left; the first one has none."""
    film, _ = frames(name)
    first, middle = film[0], film[len(film) // 2]
    assert first.shape[1] == 600, f"{name} is {first.shape[1]} pixels wide"
    half = first.shape[1] // 2
    counts = [red(panel) for panel in (first[:, :half], first[:, half:], middle[:, :half], middle[:, half:])]
    assert max(counts[:3]) == 0 and counts[3] > 500, f"{name}: red pixels {counts}"


def main():
    root, libicc, work = sys.argv[1:]
    committed, drawn = Path(root, "docs/images/hero.gif"), Path(work, "hero.gif")
    check(committed)
    assert frames(committed)[1] == 4000 and committed.stat().st_size < 1e6
    drawn.parent.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, "-B", f"{root}/docs/images/hero.py", drawn, "--libicc", libicc, "--steps", "3"],
                   check=True)
    check(drawn)


if __name__ == "__main__":
    main()
