#!/bin/sh
# Outlines that do not correspond: common vertices, maps between them in one command, and how refusals are told.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# A key, and the same turned by 20 degrees, begun elsewhere, the other way round, with a point on every edge.
printf '%s\n' '0 0' '4 0' '4 -1' '5 -1' '5 0' '6 0' '6 -2' '7 -2' '7 1' '1 1' '1 2' '-1 2' '-1 -1' '0 -1' >key.txt
awk '{ x[NR] = $1; y[NR] = $2 } END {
    for (k = 0; k < 2 * NR; k++) {
        i = (5 + 2 * NR - k) % (2 * NR); a = int(i / 2) + 1; b = a % NR + 1; f = (i % 2) * 0.4
        u = x[a] + f * (x[b] - x[a]); v = y[a] + f * (y[b] - y[a])
        printf "%.17g %.17g\n", 0.9396926207859084 * u - 0.3420201433256687 * v, 0.3420201433256687 * u + 0.9396926207859084 * v } }' \
    key.txt >turned.txt

# Both get the vertices of both, in the source's order; the given ones as they were.
run 0 match -s key.txt -t turned.txt -o a.txt --target-output b.txt
holds out 'common      28 vertices; 14 of them are of both outlines'
grep -qE '^turned +(19\.[5-9]|20\.[0-4])' out || complain "the turn is not 20 degrees: $(cat out)"
[ "$(wc -l <a.txt) $(wc -l <b.txt)" = '28 28' ] || complain 'not 28 vertices each'
sort turned.txt >expected
sort b.txt | cmp -s - expected || complain 'the target has other vertices than it was given'
awk 'NR == FNR { seen[$0 + 0 " " $2 + 0] = 1; next } !(($1 + 0 " " $2 + 0) in seen) { bad = 1 } END { exit bad }' a.txt key.txt ||
    complain 'a vertex of the source is gone'

# A file with both is a source for maps; what is mapped is turned.
run 0 match -s key.txt -t turned.txt -o both.geojson --json=report.json
holds report.json '"joined": 14'
printf '0.5 0.5\n6.5 0\n-0.5 1.5\n4.5 -0.5\n' >points.txt
awk '{ printf "%.17g %.17g\n", 0.9396926207859084 * $1 - 0.3420201433256687 * $2, 0.3420201433256687 * $1 + 0.9396926207859084 * $2 }' \
    points.txt >expected
run 0 map -s both.geojson -p points.txt
close_to out expected 0.01
cp out by_file
run 0 map -s key.txt -t turned.txt --match auto -p points.txt
same out by_file
run 0 map -s key.txt -t turned.txt --match auto --inverse -p expected
close_to out points.txt 0.01
run 0 check -s key.txt -t turned.txt --match auto
holds out 'one-to-one: yes, certified'
run 0 info -s key.txt -t turned.txt --match auto --json
holds out '"sure": '
run 0 plot -s key.txt -t turned.txt --match auto out.svg
[ "$(grep -c 'hsl(' out.svg)" -ge 40 ] || complain 'plot does not number pairs'
run 1 map -s key.txt -t turned.txt -p points.txt
says '28 vertices, but the source'

# A mask goes with an outline, too.
{
    # shellcheck disable=SC2086 # bytes
    bytes 147 78 85 77 80 89 1 0 118 0
    printf '%-117s\n' "{'descr': '|u1', 'fortran_order': False, 'shape': (3, 2), }"
    bytes 1 1 1 0 1 0
} >mask.npy
printf '0 0\n3 0\n3 1\n1 1\n1 2\n0 2\n' >el.txt
run 0 map -s mask.npy -t el.txt --match auto -p /dev/null

# Landmarks: on the outlines, and hit exactly; refused by their lines.
printf '# ends\n0 0 1 1\n1 1 0 0\n' >ends.txt
printf '0 0\n1 0\n1 1\n0 1\n' >square.txt
printf '0 0\n0.5 0\n1 0\n1 1\n0 1\n' >other.txt
run 0 match -s square.txt -t other.txt --landmarks ends.txt -o a.txt --target-output b.txt
paste -d ' ' a.txt b.txt >pairs
holds pairs '0 0 1 1'
holds pairs '1 1 0 0'
cp pairs by_option
run 0 match -s square.txt -t other.txt --match ends.txt -o a.txt --target-output b.txt
paste -d ' ' a.txt b.txt >pairs
same pairs by_option
printf '0 0 1 1\n0.5 0.5 0 0\n' >off.txt
run 1 map -s square.txt -t other.txt --match off.txt -p points.txt
says "off.txt:2: source: landmark 1 lies off the outline"
printf '0 0 1\n' >short.txt
run 1 match -s square.txt -t other.txt --landmarks short.txt
says 'short.txt:1'

# Discs are ambiguous by shape; by arc length only where that is said.
awk 'BEGIN { for (k = 0; k < 40; k++) printf "%.17g %.17g\n", cos(k * 0.15707963267948966), sin(k * 0.15707963267948966) }' >disc.txt
awk 'BEGIN { for (k = 9; k < 46; k++) printf "%.17g %.17g\n", 2 * cos(k * 0.16981581722698587), 2 * sin(k * 0.16981581722698587) }' >larger.txt
run 1 match -s disc.txt -t larger.txt --turning free
says '--match arc'
printf '0.5 0\n0 -0.25\n' >inside.txt
printf '1 0\n0 -0.5\n' >expected
run 0 map -s disc.txt -t larger.txt --match arc -p inside.txt
close_to out expected 0.02
run 0 match -s disc.txt -t larger.txt --match arc
holds out 'paired by arc length'

# A mirror image is said to be one.
awk '{ print -$1, $2 }' key.txt >mirrored.txt
run 0 match -s key.txt -t mirrored.txt --landmarks /dev/null
holds out 'the mirror image fits better'
run 0 check -s key.txt -t mirrored.txt --match /dev/null
holds out 'mirrored: the mirror image fits better'
run 0 check -s key.txt -t mirrored.txt --match /dev/null --json
holds out '"mirrored": true'

# Holes, lines and points inside go together, whatever their order and vertices; results can be mapped.
printf '{"type": "FeatureCollection", "features": [%s]}\n' \
    '{"type": "Feature", "properties": {"role": "source"}, "geometry": {"type": "Polygon", "coordinates": [
        [[0, 0], [8, 0], [8, 4], [1, 5], [0, 0]], [[1, 1], [2, 1], [2, 2], [1, 2], [1, 1]], [[5, 1], [7, 1], [5, 2], [5, 1]]]}},
     {"type": "Feature", "properties": {"role": "source", "feature": 4}, "geometry": {"type": "Point", "coordinates": [3, 3]}},
     {"type": "Feature", "properties": {"role": "source", "feature": 7}, "geometry": {"type": "LineString", "coordinates": [[3, 1], [4, 2], [4, 3]]}},
     {"type": "Feature", "properties": {"role": "target"}, "geometry": {"type": "Polygon", "coordinates": [
        [[1, 5], [0, 0], [4, 0], [8, 0], [8, 4], [1, 5]], [[5.1, 2], [7.1, 1], [6, 1], [5.1, 1], [5.1, 2]], [[2, 2.1], [1, 2.1], [1, 1.1], [2, 1.1], [2, 2.1]]]}},
     {"type": "Feature", "properties": {"role": "target", "feature": 1}, "geometry": {"type": "LineString", "coordinates": [[4, 3], [4, 2.5], [4, 2], [3, 1.1]]}},
     {"type": "Feature", "properties": {"role": "target", "feature": 2}, "geometry": {"type": "Point", "coordinates": [3.1, 3]}}' >inside.geojson
run 0 match -s inside.geojson -t inside.geojson -o common.geojson
holds out 'common      18 vertices; 15 of them are of both outlines'
[ "$(grep -c '"feature": [47]' common.geojson)" -eq 4 ] || complain 'Points and LineStrings are not written with their numbers'
run 0 match -s inside.geojson --json
holds out '"vertices": 18'
run 1 match -s inside.geojson -o a.txt --target-output b.geojson
says 'a.txt: text holds one outline and no holes, lines or points'
run 0 check -s common.geojson -t common.geojson
holds out 'one-to-one: yes, certified'
printf '3 3\n1 1\n3 1\n4 3\n5 1\n' >points.txt
printf '3.1 3\n1 1.1\n3 1.1\n4 3\n5.1 1\n' >expected
run 0 map -s inside.geojson --match auto -p points.txt
close_to out expected 1e-12
run 0 map -s common.geojson -p points.txt
close_to out expected 1e-12
run 0 plot -s inside.geojson --match auto out.svg
[ "$(grep -c 'hsl(' out.svg)" -eq $((2 * (5 + 4))) ] || complain 'plot does not number features'
printf '1 1 2 2.1\n5 1 5.1 1\n' >inside.txt
run 0 match -s inside.geojson --landmarks inside.txt
sed 's/\(, \[\[5.1.*5.1, 2\]\]\)/ /' inside.geojson | sed 's/^\( *\[\[1, 5\].*\]\]\).*, \[\[2, 2.1/\1, [[2, 2.1/' >one.geojson
run 1 match -s inside.geojson -t one.geojson
says 'the source has 2 holes, the target 1'

# Several outlines: a percent sign as SVG, in another order, and as a MultiPolygon.
echo '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0,0 L6,0 L36,40 L30,40 Z M0,30 A10,10 0 0 1 20,30
    A10,10 0 0 1 0,30 Z M4,30 A6,6 0 0 0 16,30 A6,6 0 0 0 4,30 Z M20,10 A10,10 0 0 1 40,10 A10,10 0 0 1 20,10 Z
    M24,10 A6,6 0 0 0 36,10 A6,6 0 0 0 24,10 Z"/></svg>' >percent.svg
echo '{"type": "MultiPolygon", "coordinates": [
    [[[28, 20], [40, 8], [52, 20], [40, 32], [28, 20]], [[34, 20], [40, 26], [46, 20], [40, 14], [34, 20]]],
    [[[0, 0], [4, 0], [52, 50], [48, 50], [0, 0]]],
    [[[0, 36], [12, 24], [24, 36], [12, 48], [0, 36]], [[6, 36], [12, 42], [18, 36], [12, 30], [6, 36]]]]}' >percent.geojson
run 0 match -s percent.svg -t percent.geojson -o glyphs.geojson
holds out 'common      '
[ "$(grep -c '"role"' glyphs.geojson)" -eq 6 ] || complain 'the match does not write three polygons for each side'
run 0 check -s glyphs.geojson
holds out 'certified'
printf '0 0\n2 30\n38 10\n10 30\n' >points.txt # corner, left and right ring, a hole
run 4 map -s percent.svg -t percent.geojson --match auto -p points.txt
awk 'NR == 1 { exit !($1 == 0 && $2 == 0) } NR == 2 { exit !($1 < 8 && $2 > 30) } NR == 3 { exit !($1 > 45 && $2 < 25) }
    NR == 4 { exit $1 != "nan" }' out || complain "parts are not paired: $(cat out)"
run 1 match -s percent.svg -t key.txt
says 'the source has 3 parts, the target 1'
run 0 map -s percent.svg -t percent.geojson --match auto --fill-holes -p points.txt
sed -n 4p out | grep -q nan && complain "a filled hole has no inside: $(cat out)"

# Wrong usage.
run 2 match -s key.txt -t turned.txt -o a.txt
says '--target-output FILE is missing'
run 2 match -s key.txt -t turned.txt -o - --target-output -
says 'cannot both go to standard output'
run 2 match -s key.txt
says '--target FILE is missing'
run 2 match -s key.txt -t turned.txt -o a.png --target-output b.txt
says 'is a name for PNG'
run 2 map -s key.txt -t turned.txt --landmarks ends.txt
says '--landmarks goes with --match'
run 2 check -s key.txt -t turned.txt --match auto --repair x.geojson
says '--repair does not go with --match'
make_cubes
printf '.5 .5 .5\n' >points.txt
run 0 map -s cube.obj -t moved.obj --match auto -p points.txt
# The same cube with the other diagonals, and one more vertex.
printf 'v 0 0 0\nv 0 0 1\nv 0 1 0\nv 0 1 1\nv 1 0 0\nv 1 0 1\nv 1 1 0\nv 1 1 1\nv 0 .5 .4\n' >other.obj
printf 'f 1 2 9\nf 2 4 9\nf 4 3 9\nf 3 1 9\nf 5 7 8\nf 5 8 6\nf 1 5 6\nf 1 6 2\n' >>other.obj
printf 'f 3 4 8\nf 3 8 7\nf 1 3 7\nf 1 7 5\nf 2 6 8\nf 2 8 4\n' >>other.obj
run 0 match -s cube.obj -t other.obj -o a.obj --target-output b.obj
holds out 'energy'
run 0 check -s a.obj -t b.obj
holds out 'one-to-one: yes, certified'
printf '0 0 0 0 0 0\n1 0 0 1 0 0\n0 1 0 0 1 0\n0 0 1 0 0 1\n1 1 1 1 1 1\n' >corners.lm
run 0 match -s cube.obj -t other.obj --landmarks corners.lm -o a.obj --target-output b.obj
grep -qx 'v 1 1 1' a.obj || complain 'a landmark is not in the result'
printf '1 1 1 0 0 1\n' >corners.lm
run 0 match -s cube.obj -t other.obj --landmarks corners.lm -o a.obj --target-output b.obj
[ "$(grep '^v' a.obj | grep -nx 'v 1 1 1')" = "$(grep '^v' b.obj | grep -nx 'v 0 0 1' | sed 's/0 0 1/1 1 1/')" ] ||
    complain 'the one landmark is not at its partner'
run 0 match -s cube.obj -t other.obj --keep-source -o a.obj --target-output b.obj
[ "$(grep '^v' cube.obj)" = "$(grep '^v' a.obj | head -n 8)" ] || complain 'the source has not kept its vertices'
run 2 check -s cube.obj -t cube.obj --keep-source
says '--keep-source goes with --match'
printf '0 0 0 0\n' >corners.lm
run 1 match -s cube.obj -t other.obj --landmarks corners.lm
says "landmarks are \`x y z x' y' z'\`"
run 0 match -s cube.obj -t other.obj --json
holds out '"overlay"'
finish
