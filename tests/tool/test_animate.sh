#!/bin/sh
# demo: what it writes, and every command that it prints. animate: a picture a frame, each that of a call of the library by
# itself; paths that cross themselves, wrong usage.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

run 0 demo
cp out told
for file in before.txt after.txt fish.png; do
    [ -s "libicc-demo/$file" ] || complain "demo has not written $file"
done
run 1 demo
says "libicc-demo: cannot be made"
run 1 demo nowhere/folder
says "nowhere/folder: cannot be made: No such file or directory"
run 2 demo one two
says "'two' is one argument too many"
run 0 demo 'a demo'
cmp -s 'a demo/fish.png' libicc-demo/fish.png || complain "two demos differ"
holds out " -s 'a demo/before.txt' -t 'a demo/after.txt'"

# What is printed to try next is tried.
mkdir bin
ln -s "$(cd "$(dirname "$tool")" && pwd)/$(basename "$tool")" bin/libicc
grep '^  ' told >commands.sh
PATH=$PWD/bin:$PATH sh -eu commands.sh >out 2>err || complain "a command of demo fails: $(cat err)"
holds out "one-to-one: yes, certified"
grep -q '^358\(\.0*\)\? 140\(\.0*\)\?$\|^3[0-9.]* 1[0-9.]*$' out || complain "the eye does not come back: $(cat out)"
cd libicc-demo || exit 1
for file in bent.png map.svg film-0000.png film-0024.png; do
    [ -s $file ] || complain "a command of demo has not written $file"
done
[ ! -e film-0025.png ] || complain "the film is too long"
paste -d ' ' before.txt after.txt | awk '{ print ($1 + $3) / 2, ($2 + $4) / 2 }' >half.txt

# Frames are numbered before the extension, in any folder; steps may be left out.
mkdir 'with.dot'
run 0 animate -s before.txt --json=report.json fish.png with.dot/f before.txt half.txt after.txt
[ "$(ls with.dot)" = "$(printf 'f-0000\nf-0001\nf-0002\n')" ] || complain "the frames are $(ls with.dot)"
holds report.json '"without_image": 0'
[ "$(grep -c '"certified": true' report.json)" = 3 ] || complain "not each frame is reported as certified"
holds report.json '"file": "with.dot/f-0002"'
# One cage is a single picture, as warp makes it.
run 0 animate -s before.txt fish.png one.png after.txt
run 0 warp -s before.txt -t after.txt fish.png warped.png
same one-0000.png warped.png "a path of one cage"
# Formats by the name, as warp.
run 0 animate -s before.txt --quality 80 fish.png f.jpg after.txt
[ "$(head -c 2 f-0000.jpg | od -An -tx1 | tr -d ' ')" = ffd8 ] || complain "f-0000.jpg is no JPEG"
run 0 animate -s before.txt --background 00ff0080 fish.png clear.png after.txt
run 0 warp -s before.txt -t after.txt --background 00ff0080 fish.png warped.png
same clear-0000.png warped.png "with a background"

# A film: one file, whose first picture is a PNG of its own.
run 0 animate -s before.txt --steps 2 --rate 10 fish.png film.apng before.txt after.txt
run 0 animate -s before.txt --steps 2 fish.png single.png before.txt after.txt
[ "$(grep -ac fcTL film.apng)" -ge 1 ] || complain "film.apng is no film"
run 0 warp -s before.txt -t after.txt film.apng of_film.png
run 0 warp -s before.txt -t after.txt single-0000.png of_single.png
same of_film.png of_single.png "the first picture of a film"
if /usr/bin/python3 -c 'import PIL' 2>/dev/null; then
    /usr/bin/python3 - <<'END' || complain "a film has other pictures than single files"
from PIL import Image
film = Image.open("film.apng")
assert film.n_frames == 3 and film.info["duration"] == 100
for k in range(3):
    film.seek(k)
    assert film.convert("RGBA").tobytes() == Image.open("single-%04d.png" % k).convert("RGBA").tobytes()
END
fi
run 2 animate -s before.txt --rate 10 fish.png f.png after.txt
says "--rate is for films, whose OUT is named .apng"
run 1 animate -s before.txt fish.png crossed.apng before.txt source_of_nothing.txt
[ ! -e crossed.apng ] || complain "a film that failed is left behind"

# Each frame beside a chain of single calls from Python.
export PYTHONPATH="$here/../../bindings/python" PYTHONDONTWRITEBYTECODE=1
if /usr/bin/python3 -c 'import libicc, PIL' 2>/dev/null; then
    run 0 animate -s before.txt --steps 3 fish.png path.png before.txt half.txt after.txt
    /usr/bin/python3 - <<'END' || complain "a frame is not what single calls give"
import libicc, numpy as np
from PIL import Image
keys = [np.loadtxt(name + ".txt") for name in ("before", "half", "after")]
image = np.asarray(Image.open("fish.png"))
mapping, frame = libicc.Map(keys[0], keys[0]), 0
def check():
    drawn = np.asarray(Image.open(f"path-{frame:04d}.png"))
    assert np.array_equal(drawn, libicc.warp_image(image, mapping)), frame
check()
for a, b in zip(keys, keys[1:]):
    for i in (1, 2, 3):
        mapping, frame = mapping.retarget(a + i / 3 * (b - a) if i < 3 else b), frame + 1
        assert mapping.certified
        check()
assert frame == 6
END
else
    echo "left out: NumPy or Pillow is missing, or a sanitizer does not let Python load the library"
fi

# What lies inside goes along.
cat >ring.geojson <<'END'
{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":
[[[20, 20], [400, 20], [400, 300], [20, 300]], [[100, 100], [100, 160], [160, 160], [160, 100]]]}}
END
sed 's/100, 1/130, 1/g; s/160, 1/190, 1/g' ring.geojson >moved.geojson
run 0 animate -s ring.geojson --steps 4 fish.png ring.png ring.geojson moved.geojson
[ -s ring-0004.png ] || complain "a cage with a hole is not animated"

# A path that cannot be gone is refused with the frame, and the frames before it are there.
awk '{ print 450 - $1, 330 - $2 }' before.txt >turned.txt
run 1 animate -s before.txt --steps 2 fish.png turn.png before.txt turned.txt
says "frame 1, 0.5 of the way from before.txt: "
[ -s turn-0000.png ] || complain "the first frame of a path that ends is missing"
[ ! -e turn-0001.png ] || complain "a frame without a map is written"

# Wrong usage, and files that are wrong, before anything is written.
run 2 animate -s before.txt fish.png out.png
says "usage: libicc animate"
run 2 animate -s before.txt fish.png - after.txt
says "only the source or IN may be standard input"
run 2 animate -s before.txt fish.png o.png after.txt -
says "only the source or IN may be standard input"
run 2 animate -s - - o.png after.txt
says "only one input can be standard input"
run 1 animate -s nowhere.txt fish.png o.png after.txt
says "nowhere.txt: cannot be opened"
run 2 animate -s before.txt fish.png o.svg after.txt
says "'o.svg' is a name for SVG"
run 2 animate -s before.txt --steps 0 fish.png o.png after.txt
says "--steps '0' must be a whole number from 1"
head -n 11 after.txt >short.txt
run 1 animate -s before.txt fish.png o.png before.txt short.txt
says "short.txt: 11 vertices"
run 1 animate -s before.txt fish.png o.png before.txt nowhere.txt
says "nowhere.txt: cannot be opened"
run 1 animate -s before.txt before.txt o.png before.txt
says "before.txt: this is not a PNG"
[ ! -e o-0000.png ] || complain "a frame is written though a cage is wrong"
run 0 animate -s before.txt - o.png after.txt <fish.png
same o-0000.png one-0000.png "a picture from standard input"
run 0 animate -s - fish.png piped.png after.txt half.txt <before.txt
run 0 animate -s before.txt fish.png file.png after.txt half.txt
for frame in 0000 0001; do
    same piped-$frame.png file-$frame.png "frame $frame of a source from standard input"
done
finish
