# The front page: all ways lead to the same picture, which is not the one before, nor empty.
import shutil

import numpy as np
from PIL import Image


def picture(name):
    return np.asarray(Image.open(name).convert("RGBA"), int)


names = ["c.png", "python.png"]
if shutil.which("cargo") and shutil.which("pngtopnm"):
    names.append("rust.png")
before, shell = picture("examples/data/chelsea.png"), picture("warped.png")
inside = shell[..., 3] == 255
assert inside.any() and not inside.all()
assert abs(shell - before)[inside].max() > 50
for name in names:
    difference = abs(picture(name) - shell)[inside].max()
    assert difference <= 1, f"{name} differs by {difference} of 255"
