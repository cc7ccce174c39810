#!/bin/sh
# Surfaces as cages: OBJ, OFF and PLY, what is wrong with them and where, and points in space.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cubes

# The same cube in every format.
printf '0.31 0.42 0.53\n0.71 0.22 0.64\n0.51 0.56 0.9\n' >points.txt
run 0 map -s cube.obj -t moved.obj -n 12 -p points.txt -o expected
run 0 map -s cube.obj -t moved.obj -n 12 -p expected --inverse
close_to out points.txt 1e-9
run 0 map -s cube.obj -t moved.obj -n 12 -p corners.txt
close_to out moved.txt 1e-12
# Points on the planes and the diagonals of the grid are points like others.
awk 'BEGIN { for (i = 1; i < 8; i++) for (j = 1; j < 8; j++) print i / 8, j / 8, (i + j) / 16 }' >planes.txt
run 0 map -s cube.obj -t moved.obj -n 8 -p planes.txt -o there
run 0 map -s cube.obj -t moved.obj -n 8 -p there -i
close_to out planes.txt 1e-9

{
    printf '\357\273\277# a comment\r\nOFF\r\n8 12 18 # sizes\r\n'
    sed 's/$/\r/' corners.txt
    sed -n 's/^f //p' cube.obj | awk '{ print 3, $1 - 1, $2 - 1, $3 - 1, 255, 0, 0 }'
} >cube.off
{
    printf 'ply\nformat ascii 1.0\ncomment a cube\nelement vertex 8\nproperty float x\nproperty float y\n'
    printf 'property float z\nproperty uchar red\nelement face 12\nproperty list uchar int vertex_indices\n'
    printf 'element edge 1\nproperty int a\nend_header\n'
    sed 's/$/ 7/' corners.txt
    sed -n 's/^f //p' cube.obj | awk '{ print 3, $1 - 1, $2 - 1, $3 - 1 }'
    echo 5
} >cube.ply
awk '/^f/ { print "f", $2 - 9 "/1/1", $3 - 9 "//2", $4 - 9 "/3"; next } { print }
     END { print "vt 0 0\nvn 0 0 1\ng all" }' cube.obj >slashes.obj
binary little >little.ply
binary big >big.ply
for file in cube.off cube.ply slashes.obj little.ply big.ply; do
    run 0 map -s "$file" -t moved.obj -n 12 -p points.txt
    same out expected "$file"
done
run 0 map -s cube.obj -t moved.txt -n 12 -p points.txt
same out expected "a target as text"
grep -v '^f' cube.obj >quads.obj
printf 'f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n' >>quads.obj
run 0 map -s quads.obj -t quads.obj -n 12 -p points.txt
close_to out points.txt 1e-9

# Coordinates: three of the face, and the share.
run 0 encode -s cube.obj -n 12 -p points.txt -o coords
awk '{ if (NF != 5 || $1 != int($1) || $1 < 0 || $1 > 11 || $2 < 0 || $3 < 0 || $4 < 0 || $5 < 0 || $5 > 1 ||
           $2 + $3 + $4 < 1 - 1e-12 || $2 + $3 + $4 > 1 + 1e-12) bad = 1 } END { exit bad || NR != 3 }' coords ||
    complain "these are no coordinates: $(cat coords)"
run 0 decode -s cube.obj -n 12 --coords coords
close_to out points.txt 1e-9
printf '12 1 0 0 0.5\n' >bad
run 1 decode -s cube.obj -n 12 --coords bad
says 'libicc: bad:1: 12 is not a facet; the cage has the facets 0 to 11'

# Points without an image, and points with the wrong number of coordinates.
printf '0.51 0.52 0.53\n2 0 0\nnan 0 0\n' | run 4 map -s cube.obj -t moved.obj -n 12
holds err '2 of 3 points have no image: 1 outside the cage, 0 that the curves do not reach, 1 not finite'
[ "$(sed -n 2,3p out | sort -u)" = "nan nan nan" ] || complain "not nan: $(cat out)"
printf '0.5 0.5\n' >bad
run 1 map -s cube.obj -t moved.obj -n 12 -p bad
says 'libicc: bad:1: 2 numbers in this line; a point is'
run 0 map -s cube.obj -t moved.obj -n 12 -p points.txt --maximum 0.5,0.5,0.75
run 2 map -s cube.obj -t moved.obj -p points.txt --maximum 0.5,0.5
says '--maximum has 2 coordinates, but the cage 3'

# rejects PLACE MESSAGE: standard input is no surface.
rejects() {
    cat >bad
    run 1 map -s bad -t bad -p points.txt
    says "libicc: bad:$1"
    says "$2"
}
sed '10d' cube.obj | rejects 9: 'belongs to no other face'
sed 's/^f 1 2 3$/f 1 3 2/' cube.obj | rejects 9: 'in the same direction'
sed 's/^f 1 2 3$/f 0 2 3/' cube.obj | rejects 9: 'the face has the vertex 0; there are 8 so far, counted from 1'
sed 's/^f 1 2 3$/f 1 9 2/' cube.obj | rejects 9: 'the face has the vertex 9; there are 8 so far'
sed 's/^f 1 2 3$/f -9 3 2/' cube.obj | rejects 9: 'the face has the vertex -9'
sed 's/^f 1 2 3$/f 1 3/' cube.obj | rejects 9: 'the face has 2 corners'
sed 's/^f 1 2 3$/f 1 3 two/' cube.obj | rejects 9: "'two' is not a corner"
sed '3s/.*/v 0 nan 0/' cube.obj | rejects 3: "'nan' is not a finite number"
sed '3s/.*/v 0 1/' cube.obj | rejects 3: "'' is not a finite number"
sed '3s/.*/v 0,5 1 0/' cube.obj | rejects 3: "'0,5' is not a finite number"
sed '8s/.*/v 0.4 0.4 -1/' cube.obj | rejects '' 'the surface meets itself'
sed '2s/.*/v 0 0 0/' cube.obj | rejects '' 'area 0'
grep -v '^f' cube.obj | rejects ' ' 'there are no faces'
sed '$d' cube.off | rejects 23: 'the file ends early'
sed '5s/.*/0 0 x/' cube.off | rejects 5: "'x"
sed 's/^3 0 1 2.*/3 0 1 8/' cube.off | rejects 12: '8 where a whole number below 8'
sed '$d' cube.ply | rejects '' 'the file ends early'
sed 's/ascii/asci/' cube.ply | rejects 2: "'asci' is not a form of PLY"
sed 's/uchar red/byte red/' cube.ply | rejects 8: "'byte' is not a type of PLY"
sed 's/element vertex 8/element vertex -8/' cube.ply | rejects 4: "'-8' is not a number of items"
sed '/^format/d' cube.ply | rejects 12: 'the header does not name a format'
sed '/^end_header/d' cube.ply | rejects 13: "'0' does not belong in the header"
sed 's/^3 0 1 2$/3 0 1 8/' cube.ply | rejects 22: 'the face has the vertex 8; there are 8'
sed 's/^3 0 1 2$/2 0 1/' cube.ply | rejects 22: 'the face has 2 corners'
sed '14s/.*/0 0 inf 7/' cube.ply | rejects 14: 'vertex 0 is not finite'
head -c 300 little.ply | rejects ' ' 'the file ends early'
printf 'ply\n' | rejects 2: 'the file ends early'
sed 's/^property float y$/property float x/' cube.ply | rejects 6: 'the property x is declared twice'
sed '/^property float y$/d' cube.ply | rejects 12: 'the vertices have no property y'
sed 's/^end_header/element vertex 1\n&/' cube.ply | rejects 13: 'the element vertex is declared twice'
sed 's/^end_header/format ascii 1.0\n&/' cube.ply | rejects 13: 'the format is named twice'
printf '3 0 1 2\n' | cat cube.ply - | rejects 34: 'there is more after the last element'
printf 'x' | cat little.ply - | rejects ' ' 'there is more after the last element'

# Faces that do not share their vertices: the hint, and what it says mends them.
awk '/^v/ { v[++n] = $0 } /^f/ { for (i = 2; i <= 4; i++) print v[$i]; m += 3; print "f", m - 2, m - 1, m }' cube.obj >loose.obj
run 1 check -s loose.obj --method field -n 8
says '28 vertices coincide with others, as those of STL do: --weld joins them'
run 1 map -s loose.obj -t loose.obj -p points.txt
says '28 vertices coincide'
"$tool" check -s loose.obj --method field -n 8 --json=report.json --repair joined.obj >out 2>err
holds report.json '"joined_vertices": 28'
[ "$(grep -c '^v' joined.obj)" = 8 ] || complain "the vertices are not joined"
run 0 info -s joined.obj --method field -n 8
holds out 'cage        8 vertices, 12 facets'
# A face that collapses goes; a surface that is still open is not written.
printf 'v 0 0 0\nv 0 0 0\nf 1 2 3\n' | sed '3s/.*/f 1 37 5/' >>loose.obj
"$tool" check -s loose.obj --method field -n 8 --repair joined.obj >out 2>err
[ "$(grep -c '^f' joined.obj)" = 12 ] || complain "the collapsed face has stayed"
rm joined.obj
sed '/^f/{x;s/^/x/;/^x\{3\}$/{x;d;};x;}' loose.obj >open.obj
run 1 check -s open.obj --method field --repair joined.obj
says 'too large to be filled'
[ ! -e joined.obj ] || complain "an open surface was written"
run 1 check -s loose.obj -t loose.obj --repair joined.obj
says '--repair is for'

# Source and target belong together.
sed 's/^f 1 2 3$/f 2 3 1/' moved.obj >bad
run 1 map -s cube.obj -t bad -p points.txt
says 'libicc: bad:9: face 0 has the vertices 1 2 0 (from 0), but 0 1 2 in the source cube.obj'
sed '$d' moved.obj >bad
run 1 map -s cube.obj -t bad -p points.txt
says 'libicc: bad: 11 faces, but the source cube.obj has 12'
sed 7d moved.txt >bad
run 1 map -s cube.obj -t bad -p points.txt
says 'libicc: bad: 7 vertices, but the source cube.obj has 8'
awk '/^v/ { print "v", -$2, $3, $4; next } { print }' moved.obj >bad
run 1 map -s cube.obj -t bad -p points.txt
says 'libicc: bad:'
make_cages
run 1 map -s source.txt -t moved.obj -p points.txt
says 'libicc: moved.obj: 3 dimensions, but the source source.txt has 2'

# What needs the plane says so.
for command in "warp a.png b.png" "map --geojson a b" "check --repair a"; do
    # shellcheck disable=SC2086 # options and operands
    run 1 $command -s cube.obj -t moved.obj
    says 'libicc: cube.obj: '
    says 'plane'
done

# check and info. A surface by itself is only checked to be valid, and that is said; a method or a mesh asks for more.
run 0 check -s cube.obj
holds out 'cube.obj: a closed surface that does not meet itself, 8 vertices, 12 faces, facing outward, volume 1'
holds out 'only the surface was checked: --method foliation'
grep -qE 'one-to-one|certified' out && complain "more than the surface: $(cat out)"
run 0 check -s cube.obj --json
holds out '"valid": true'
holds out '"checked": "surface"'
grep -q '"certified"' out && complain "certified, but what"
for more in "-m foliation" "--maximum 0.5,0.5,0.6"; do
    # shellcheck disable=SC2086 # options
    run 0 check -s cube.obj $more
    holds out 'one-to-one: yes, certified'
    holds out 'foliation chart certified'
done
run 0 check -s cube.obj -m foliation --json
holds out '"certified": true'
grep -q '"checked"' out && complain "only a part was checked"
sed '8s/.*/v 0.4 0.4 -1/' cube.obj >bad
run 1 check -s bad
says 'the surface meets itself'
run 1 check -s cube.obj -m gradient -n 8
holds err 'the method gradient is not certifiable'
holds out 'a closed surface that does not meet itself, 8 vertices, 12 faces, facing outward, volume 1'
"${tool:?}" check -s cube.obj -t moved.obj -m field -n 12 --json >out 2>err
case $? in
0) holds out '"certified": true' ;;
1) holds out '"certified": false' && holds err 'not certified' ;;
*) complain "check: neither 0 nor 1" ;;
esac
holds out '"valid": true'
holds out '"infeasible_vertices":'
run 0 info -s cube.obj -t moved.obj -m field -n 12
for word in 'cage        8 vertices, 12 facets, facing outward, volume 1' 'method      field' 'given up' \
    'cousin violations' 'critical vertices in its order' 'order  ' 'vectors  ' 'contacts  ' 'distortion' 'seconds'; do
    holds out "$word"
done
run 0 info -s cube.obj -m field -n 12 --json
holds out '"critical_in_tree_order":'
holds out '"dimension": 3'
awk '/^f/ { print $1, $2, $4, $3; next } { print }' cube.obj >inward.obj
run 0 info -s inward.obj -n 12
holds out 'facing inward, volume 1'

# The pieces for ParaView: every cell's corners are points, and each part is there.
run 0 plot -s cube.obj -t moved.obj -m field -n 12 --lines 20 cube.vtk
awk '$1 == "POINTS" { points = $2 } $1 == "CELLS" { cells = $2; size = $3; at = NR }
     cells && NR > at && NR <= at + cells { used += NF; if (NF != $1 + 1) bad = 1
         for (i = 2; i <= NF; i++) if ($i >= points) bad = 1 }
     $2 == "part" { part = NR + 1 } part && NR > part && NR <= part + cells { parts[$1]++ }
     END { exit bad || used != size || parts[0] == 0 || parts[1] == 0 || parts[2] != 12 || parts[3] == 0 }' cube.vtk ||
    complain "cube.vtk is not what it says"
holds cube.vtk 'VECTORS displacement double'
finish
