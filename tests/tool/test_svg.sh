#!/bin/sh
# SVG: arcs, transforms and basic shapes as librsvg draws them, and which shape of a drawing is taken.
# usage: test_svg.sh TOOL SCRATCH
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
if ! command -v rsvg-convert >/dev/null || ! /usr/bin/python3 -c 'import numpy, PIL' 2>/dev/null; then
    echo "skipped: rsvg-convert or Pillow is missing"
    exit 77
fi

# draw NAME: the body of a drawing of 400 by 400 pixels, from standard input.
draw() {
    { printf '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="400" height="400">\n' && cat && printf '\n</svg>\n'; } >"$1.svg"
}

# looks_alike NAME [OFF]: what is read of NAME.svg, drawn as one polygon, covers the same pixels but for OFF of the area.
looks_alike() {
    run 0 check -s "$1.svg" --repair "$1.txt"
    tr '\n' ' ' <"$1.txt" | sed 's/.*/<polygon points="&"\/>/' | draw "$1-read"
    rsvg-convert "$1.svg" -o "$1.png"
    rsvg-convert "$1-read.svg" -o "$1-read.png"
    /usr/bin/python3 - "$1" "${2:-0.002}" <<'END' || complain "$1.svg is read as something else"
import sys
import numpy as np
from PIL import Image
drawn, read = (np.asarray(Image.open(sys.argv[1] + end).convert('RGBA'))[..., 3] / 255 for end in ('.png', '-read.png'))
off = np.abs(drawn - read).sum() / drawn.sum()
assert drawn.sum() > 1000 and off < float(sys.argv[2]), (drawn.sum(), off)
END
}

# Arcs: small and large, both ways, turned, with radii that are too small, with flags that touch.
for flags in 00 01 10 11; do
    printf '<path d="M150 200A100 60 30 %s 250 180z"/>' "$(echo $flags | sed 's/./& /g')" | draw "arc$flags"
    looks_alike "arc$flags" 0.004
done
printf '<path d="M100 200a10,5 20 01200,0l-100 150z"/>' | draw small
looks_alike small
printf '<path d="m100 200a-90-90 0 0110e1 90 0 10 0 1 1 50 50h-60z"/>' | draw list
looks_alike list
printf '<path d="M100 100A0 50 0 0 1 300 100A50 50 0 1 1 300 100L200 300Z"/>' | draw line
run 0 check -s line.svg --repair line.txt
[ "$(wc -l <line.txt)" -eq 3 ] || complain "an arc without a radius, and one to where it begins, are lines"

# Basic shapes.
printf '<circle cx="200" cy="190" r="150"/>' | draw circle
printf '<ellipse cx="200" cy="200px" rx="180" ry="60"/>' | draw ellipse
printf '<rect x="30" y="40" width="300" height="200"/>' | draw rect
printf '<rect x="30" y="40" width="300" height="200" rx="40"/>' | draw round
printf '<rect x="30" y="40" width="300" height="200" rx="40" ry="900"/>' | draw oval
printf '<rect width="300" height="200" rx="auto" ry="20"/>' | draw auto
printf '<polyline points="30,30 300,50 200,300"/>' | draw polyline
for name in circle ellipse rect round oval auto polyline; do
    looks_alike $name
done

# Transforms: each kind, lists, groups in groups; what is beside the shape does not count.
i=0
while read -r list; do
    i=$((i + 1))
    printf '<g transform="translate(9,9)"><rect/></g><g transform="%s"><path d="M10 10H90V60L50 30 10 70z"/></g>' "$list" | draw "move$i"
    looks_alike "move$i"
    printf '<g transform="translate(100 90)"><path transform="%s" d="M10 10H90V60L50 30 10 70z"/></g>' "$list" | draw "inner$i"
    looks_alike "inner$i"
done <<'END'
translate(50)
translate(30,-5)
scale(2)
scale(1.5 , 2)
rotate(30)
rotate(-33.3 50 50)
rotate(450,50,50)
skewX(20)
skewY(-10)
matrix(1 .2 -.1 1.5 30 10)
translate(100 50) rotate(20) skewX(10),scale(1.1)
END
printf '<path transform="rotate(90)" d="M0 0H2V1z"/>' | draw quarter
run 0 check -s quarter.svg --repair quarter.txt
printf '0 0\n0 2\n-1 2\n' | sed 's/-0$/0/' >expected
sed 's/^-0 /0 /; s/ -0$/ 0/' quarter.txt >got
same got expected 'a quarter of a turn is exact'

# Curves within a tolerance: no vertex is farther from the true one, and no edge; both cages get what either needs.
printf '<circle cx="200" cy="190" r="150"/>' | draw circle
printf '<g transform="scale(3 .5) rotate(20)"><path d="M0 0C90 10 20 90 100 30Q150 90 40 120A60 30 25 0 1 0 90z"/></g>' | draw curved
printf '<path d="M0 0C90 10 20 90 100 30Q150 90 40 120C20 130 5 120 0 90z"/>' | draw other
for length in 5 .3 .02 .004; do
    run 0 check -s circle.svg --flatten $length --repair circle.txt
    run 0 check -s curved.svg --flatten $length --repair curved.txt
    run 0 check -s curved.svg --flatten 1e-3 --repair true.txt
    /usr/bin/python3 - $length <<'END' || complain "--flatten $length is not kept"
import sys
import numpy as np
length = float(sys.argv[1])
circle, curved, true = (np.loadtxt(name + ".txt") for name in ("circle", "curved", "true"))
def off(p):
    return np.abs(np.hypot(*(p - [200, 190]).T) - 150).max()
middles = (circle + np.roll(circle, -1, 0)) / 2
assert off(circle) < 1e-10 and length / 5 < off(middles) <= length, off(middles)
a, b = curved, np.roll(curved, -1, 0) - curved
share = np.clip(((true[:, None] - a) * b).sum(2) / (b * b).sum(1), 0, 1)
far = np.hypot(*np.moveaxis(true[:, None] - a - share[..., None] * b, 2, 0)).min(1).max()
assert length / 20 < far <= length + 1e-3, far
END
done
vertices() {
    sed -n 's/^ *cage  *\([0-9]*\) vertices.*/\1/p' out
}
run 0 info -s curved.svg --flatten .01
curved=$(vertices)
run 0 info -s other.svg --flatten .01
other=$(vertices)
[ "$curved" -ne "$other" ] || complain "both have $other vertices by themselves: this tests nothing"
run 0 info -s curved.svg -t other.svg --flatten .01
both=$(vertices)
if [ "$both" -lt "$curved" ] || [ "$both" -lt "$other" ]; then
    complain "$both vertices, $curved and $other by themselves"
fi
run 0 info -s other.svg -t curved.svg --flatten .01
[ "$(vertices)" -eq "$both" ] || complain "the other way round there are $(vertices) vertices, not $both"
printf '0 0\n1 0\n0 1\n' >corners.txt
# What is matched does not correspond, so its curves have nothing to do with those of the other; one side may have none.
printf '<path d="M0 0C90 10 20 90 100 30L90 90 10 95z"/>' | draw large
printf '<path d="M1 1C1 .9 1.1 .9 1.1 1L100 31 91 89C60 80 50 99 9 94z"/>' | draw small
run 0 check -s small.svg --flatten .01 --repair small.txt
run 0 match -s small.svg -t large.svg --flatten .01 -o a.txt --target-output b.txt
run 0 match -s small.txt -t large.svg --flatten .01 -o c.txt --target-output d.txt
same c.txt a.txt 'edges of the source are those it has by itself'
same d.txt b.txt 'the target does not depend on them'
run 1 match -s corners.txt -t corners.txt --flatten 1 -o a.txt --target-output b.txt
says "libicc: corners.txt: there are no curves to flatten; only SVG and outlines of pictures have them"

run 1 check -s circle.svg --flatten 1e-9
says "libicc: circle.svg:2: --flatten makes more than 1024 edges of a curve"
run 1 check -s corners.txt --flatten 1
says "libicc: corners.txt: there are no curves to flatten; only SVG and outlines of pictures have them"

# Among several: by the role, by id, by label, by another attribute; one path or polygon counts before other shapes.
printf '<rect width="9" height="9"/><path d="M0 0H5V5z"/>' | draw before
run 0 info -s before.svg
holds out 'cage        3 vertices'
printf '<rect id="a" width="9" height="9"/><path id="b" class="x y" d="M0 0H5V5z"/><circle id="source" r="9"/>' | draw several
for pair in '#a 4' '#id=b 3' '#class=x_y 3' ' 128'; do
    name=several.svg$(echo "${pair% *}" | tr '_' ' ')
    run 0 info -s "${name% }"
    holds out "cage        ${pair##* } vertices"
done
run 1 info -s several.svg#c
says 'libicc: several.svg#c: 0 of the 3 shapes have the id "c"; exactly one must'
cp several.svg 'odd#a.svg'
run 0 info -s 'odd#a.svg'
run 0 info -s 'odd#a.svg#b'
holds out 'cage        3 vertices'
run 0 info -s '-#b' <several.svg

rejects() { # MESSAGE: the body of a drawing
    draw bad
    run 1 info -s bad.svg
    says "libicc: bad.svg:$1"
}
printf '<path d="M0 0A1 1 0 2 0 3 3z"/>' | rejects "2: '2' in the path where 0 or 1 is expected"
printf '<path d="M0 0A1 1 0 0 0 3z"/>' | rejects "2: 'z\"/>' in the path where a finite number"
printf '<rect width="9mm" height="9"/>' | rejects "2: width is '9mm"
printf '<rect width="9"/>' | rejects '2: the rectangle has no width or no height'
printf '<circle cx="9"/>' | rejects '2: the circle has no radius'
for list in 'turn(3)' 'rotate(3' 'rotate(1 2)' 'scale(x)' 'matrix(1 2 3 4 5 6 7)'; do
    printf '<path transform="%s" d="M0 0H5V5z"/>' "$list" | rejects "2: the shape has, or is in, a transform that SVG does not have"
done
printf '<g transform="scale(1e300)"><path transform="scale(1e300)" d="M0 0H5V5z"/></g>' | rejects '2: the transform takes the shape beyond'
finish
