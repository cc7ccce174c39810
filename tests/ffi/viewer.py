"""The page that Python makes of a map is that of the command: the same template, and the same data.

usage: viewer.py LIBICC EXAMPLES FOLDER
"""

import json
import re
import subprocess
import sys
from pathlib import Path

import libicc
import numpy as np

DATA = re.compile(r'(<script id="data" type="application/json">)(.*?)(</script>)', re.S)


def halves(page):
    """The page without its data, and the data."""
    return DATA.sub(r"\1\3", page), json.loads(DATA.search(page).group(2))


def of_command(command, folder, names):
    subprocess.run([command, "plot", "--quiet", "-s", names[0], "-t", names[1], "page.html"], cwd=folder, check=True)
    return (folder / "page.html").read_text(encoding="utf-8")


def main():
    command, examples, folder = sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3])
    folder.mkdir(exist_ok=True)
    plane = [np.loadtxt(examples / f"tripus.{side}.txt") for side in ("src", "tgt")]
    corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], float)
    faces = np.array([[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3], [0, 4, 6],
                      [0, 6, 2], [1, 3, 7], [1, 7, 5]])
    solids = [corners, corners * [1, 2, 1] + [1000, 0, 0]]
    for name, places in zip(("a.txt", "b.txt"), plane):
        np.savetxt(folder / name, places, fmt="%.17g")
    for name, places in zip(("a.obj", "b.obj"), solids):
        with open(folder / name, "w", encoding="utf-8") as file:
            file.writelines("v %.17g %.17g %.17g\n" % tuple(place) for place in places)
            file.writelines("f %d %d %d\n" % tuple(face + 1) for face in faces)
    for names, mapping in ((("a.txt", "b.txt"), libicc.Map(*plane)),
                           (("a.obj", "b.obj"), libicc.Map(*((places, faces) for places in solids)))):
        own = halves(mapping.to_html(source=names[0], target=names[1]))
        other = halves(of_command(command, folder, names))
        assert own[0] == other[0], "the templates differ: tools/plot/page/embed.cmake and libicc/_viewer.py join them"
        odd = [key for key in {*own[1], *other[1]} if own[1].get(key) != other[1].get(key)]
        assert not odd, f"{names}: the pages differ in {odd}"
        print(*names, "->", len(own[1]["before"]), "bytes of positions")


if __name__ == "__main__":
    main()
