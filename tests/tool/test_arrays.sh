#!/bin/sh
# Pictures that are arrays of NumPy: what it writes and reads beside PNG and beside the library called from Python, and what
# is refused.
# usage: test_arrays.sh TOOL SCRATCH
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
export PYTHONPATH="$here/../../bindings/python" PYTHONDONTWRITEBYTECODE=1
if ! /usr/bin/python3 -c 'import libicc, numpy, PIL' 2>/dev/null; then
    echo "skipped: NumPy, Pillow or the library is missing"
    exit 77
fi

printf '0 0\n40 0\n40 30\n0 30\n' >before.txt
printf '2.3 1.1\n36 3\n38 27.7\n1 29\n' >after.txt
/usr/bin/python3 - <<'END' || complain "NumPy writes no pictures"
import numpy as np
from PIL import Image
y, x = np.mgrid[:30, :40]
rgba = np.stack([x * 6, y * 8, (x * y) % 256, 255 - 4 * x], axis=2).astype(np.uint8)
Image.fromarray(rgba).save("rgba.png")
Image.fromarray(rgba[..., 0]).save("grey.png")
np.save("rgba", rgba)
np.save("grey", rgba[..., 0])
np.save("axis", rgba[..., :1])
bands = np.stack([x * (k + 1) + np.sin(y + k) for k in range(9)], axis=2)
for kind in ("<u2", ">u2", "<f4", ">f4", "<f8", ">f8"):
    np.save("bands" + kind[1:] + "<>"[kind[0] == ">"].replace("<", "l").replace(">", "b"), bands.astype(kind))
holes = bands[..., :2].copy()
holes[10:12, 15:20] = np.nan
np.save("holes", holes)
for name, array in {"int": x, "fortran": np.asfortranarray(rgba), "long": bands.reshape(-1), "four": bands[None],
                    "wide": np.zeros((3, 3, 65)), "complex": x.astype(complex), "bool": x > 1}.items():
    np.save("bad-" + name, array)
with open("bad-short.npy", "wb") as f:
    f.write(open("rgba.npy", "rb").read()[:-1])
END

warp() { # IN OUT
    run 0 warp -s before.txt -t after.txt "$1" "$2"
}
for name in rgba grey; do
    warp $name.png "$name-out.png"
    warp $name.npy "$name-out.npy"
    warp $name.npy "$name-crossed.png"
    warp $name.png "$name-crossed.npy"
    same $name-out.png $name-crossed.png
    same $name-out.npy $name-crossed.npy
done
warp axis.npy axis-out.npy
run 0 warp -s before.txt -t after.txt - - <rgba.npy
same out rgba-out.npy "through pipes"
for bands in u2l u2b f4l f4b f8l f8b; do
    warp bands$bands.npy bands$bands-out.npy
done
warp holes.npy holes-out.npy
run 0 warp -s before.txt -t after.txt --outside null holes.npy holes-null.npy
run 0 animate -s before.txt bandsf4l.npy film.npy after.txt
same film-0000.npy bandsf4l-out.npy "a film of arrays"
printf '{"handles": [[10, 10], [30, 20], [30, 8], [12, 22]]}' >handles.json
printf '{"moves": [{"handle": 0, "move": [1, 1]}, {"handle": 1, "move": [1, 1]}, {"handle": 2, "move": [1, 1]}, {"handle": 3, "move": [1, 1]}]}' >pose.json
for in in rgba.npy rgba.png bandsf8b.npy bandsu2l.npy; do
    run 0 pose -s before.txt -a handles.json -t pose.json "$in" "posed-$in"
done

/usr/bin/python3 - <<'END' || complain "an array is not what it should be"
import libicc
import numpy as np
from PIL import Image
from libicc import Map, warp_image
mapping = Map(np.loadtxt("before.txt"), np.loadtxt("after.txt"))
for name in ("rgba", "grey"):
    result = np.load(name + "-out.npy")
    assert result.dtype == np.uint8 and np.array_equal(result, np.asarray(Image.open(name + "-out.png"))), name
assert np.array_equal(np.load("axis-out.npy"), np.load("grey-out.npy")[..., None])
for kind in ("u2", "f4", "f8"):
    image, result = np.load(f"bands{kind}l.npy"), np.load(f"bands{kind}l-out.npy")
    assert result.dtype == "<" + kind and result.shape == (30, 40, 9)
    assert np.array_equal(result, warp_image(image, mapping)), kind
    assert open(f"bands{kind}l-out.npy", "rb").read() == open(f"bands{kind}b-out.npy", "rb").read(), kind
holes = np.load("holes.npy")
assert np.array_equal(np.load("holes-out.npy"), warp_image(holes, mapping, nodata=np.nan), equal_nan=True)
null = np.load("holes-null.npy")
assert np.isnan(null[0]).all() and np.isfinite(null[5, 5:30]).all()
posed = np.load("posed-rgba.npy")
assert np.array_equal(posed, np.asarray(Image.open("posed-rgba.png")))
bands, source = np.load("posed-bandsf8b.npy"), np.load("bandsf8b.npy")
assert np.allclose(bands[4:26, 4:36], source[3:25, 3:35], atol=1e-6)
assert np.array_equal(np.load("posed-bandsu2l.npy")[4:26, 4:36], np.load("bandsu2l.npy")[3:25, 3:35])
END

while IFS='|' read -r name message; do
    run 1 warp -s before.txt -t after.txt "bad-$name.npy" out.npy
    says "bad-$name.npy: $message"
    [ ! -e out.npy ] || complain "something is written of bad-$name.npy"
done <<'END'
int|the array is of type '<i8'; a picture has uint8, uint16, float32 or float64
bool|the array is of type '|b1'
complex|the array is of type '<c16'
fortran|the array is in Fortran's order; save numpy.ascontiguousarray(array)
long|the array has 1 axis; a picture has rows, columns and perhaps channels
four|the array has 4 axes
wide|the array has 65 channels, in its last axis; there may be 1 to 64
short|the .npy file has 4799 bytes of data, which is not what its shape says
END
run 1 warp -s before.txt -t after.txt bandsf4l.npy out.png
says 'out.png: the picture has floats, which PNG cannot hold; .npy can'
run 1 warp -s before.txt -t after.txt bandsu2l.npy out.png
says 'out.png: the picture has more than four channels, which PNG cannot hold; .npy can'
run 2 warp -s before.txt -t after.txt --background ff0000 bandsf4l.npy out.npy
says '--background is a colour, and the picture is an array of floats'
run 2 warp -s before.txt -t after.txt --outside null bandsu2l.npy out.npy
says 'an array of whole numbers with more than four channels has no value for pixels without an image'
finish
