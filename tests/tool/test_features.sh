#!/bin/sh
# Cages with holes, lines and points inside: how they are read, paired, and refused with the file, the side and the number.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

# collection FEATURE...: a FeatureCollection.
collection() {
    separator=
    printf '{"type": "FeatureCollection", "features": ['
    for one in "$@"; do
        printf '%s%s' "$separator" "$one"
        separator=', '
    done
    printf ']}\n'
}

# feature ROLE TYPE COORDINATES [NUMBER]
feature() {
    printf '{"type": "Feature", "properties": {"role": "%s"%s}, "geometry": {"type": "%s", "coordinates": %s}}' \
        "$1" "${4:+, \"feature\": $4}" "$2" "$3"
}

square='[[0,0],[10,0],[10,10],[0,10],[0,0]]'
hole='[[2,2],[4,2],[4,4],[2,4],[2,2]]'
source=$(feature source Polygon "[$square, $hole]")
target=$(feature target Polygon "[$square, $hole]")
line='[[6,2],[8,2],[8,5]]'
lines="$(feature source LineString "$line" 5), $(feature target LineString "$line" 5)"
point=$(feature source Point '[2,8]' 3)
partner=$(feature target Point '[3,8]' 3)

# refuses MESSAGE FEATURE...: a file with both sides, which is not named as a target.
refuses() {
    message=$1
    shift
    collection "$@" >bad
    run 1 map -s bad -p points.txt
    says 'libicc: bad: '
    says "$message"
    run 1 map -s bad -t bad -p points.txt
    says "$message"
}

# Partners.
refuses 'target: point 3 of the source has no partner' "$source" "$target" "$point"
refuses 'target: point 3 has no partner in the source' "$source" "$target" "$partner"
refuses 'target: point 3 has no partner in the source' "$partner" "$target" "$lines" "$source"
refuses 'target: feature 3 is a line, but in the source a point' "$source" "$target" "$point" \
    "$(feature target LineString "$line" 3)"
refuses 'target: line 3 has 3 vertices, but in the source 2' "$source" "$target" \
    "$(feature source LineString '[[6,2],[8,2]]' 3)" "$(feature target LineString "$line" 3)"
refuses 'source: two features have the number 3' "$source" "$target" "$point" "$(feature source LineString "$line" 3)"
refuses 'target: two features have the number 3' "$source" "$target" "$point" "$partner" "$partner"
refuses 'target: 0 holes, but the source has 1: hole 1 of the source has no partner' "$source" "$(feature target Polygon "[$square]")"
refuses 'target: hole 1 has 3 vertices, but in the source 4' "$source" \
    "$(feature target Polygon "[$square, [[2,2],[4,2],[4,4]]]")"
refuses 'target: 3 vertices, but the source bad has 4' "$source" "$(feature target Polygon "[[[0,0],[10,0],[10,10]], $hole]")"

# What they may be.
refuses 'source: a Point with a role has no whole number' "$source" "$target" "$(feature source Point '[2,8]')"
refuses 'source: a Point with a role has no whole number' "$source" "$target" "$(feature source Point '[2,8]' 1.5)"
refuses 'target: a LineString with a role has no whole number' "$source" "$target" "$(feature target LineString "$line" '"7"')"
refuses 'source: a Point with a role has no whole number' "$source" "$target" "$(feature source Point '[2,8]' 1e300)"
refuses "source: feature 4 is a 'MultiPoint'" "$source" "$target" "$(feature source MultiPoint '[[2,8]]' 4)"
refuses 'source: line 4 has 1 vertex' "$source" "$target" "$(feature source LineString '[[2,8]]' 4)"
refuses 'source: vertex 1 of line 4 is not a pair' "$source" "$target" "$(feature source LineString '[[2,8],[3]]' 4)"
refuses 'target: vertex 0 of point 4 is not a pair' "$source" "$target" "$(feature target Point '[]' 4)"
refuses 'source: the shape has 2 parts, but the target 1' "$source" "$target" "$source"
refuses 'target: none of the 2 features is a Polygon' "$source" "$partner"
refuses 'source: the shape has 2 parts' "$(feature source MultiPolygon "[[$square, $hole], [[[2.5,2.5],[3,2.5],[3,3]]]]")" "$target"

# Ties.
refuses "target: tie 1 of the source has no partner" "$source" "$target" "$(feature source-tie LineString '[[0,0],[2,2]]' 1)"
refuses 'source: two ties have the number 1' "$source" "$target" "$(feature source-tie LineString '[[0,0],[2,2]]' 1)" \
    "$(feature source-tie LineString '[[0,0],[2,2]]' 1)"
refuses "source: tie 1 is a 'Point'" "$source" "$target" "$(feature source-tie Point '[0,0]' 1)"
refuses "target: line 1 has no partner in the source" "$source" "$target" "$(feature target LineString "$line" 1)" \
    "$(feature source-tie LineString '[[0,0],[2,2]]' 1)" "$(feature target-tie LineString '[[0,0],[2,2]]' 1)"

refuses 'source: tie 1 ends at (2, 3), where the cage and what is inside it have no vertex' "$source" "$target" \
    "$(feature source-tie LineString '[[0,0],[2,3]]' 1)" "$(feature target-tie LineString '[[0,0],[2,2]]' 1)"
refuses 'target: tie 1 joins other vertices than in the source' "$source" "$target" \
    "$(feature source-tie LineString '[[0,0],[2,2]]' 1)" "$(feature target-tie LineString '[[0,0],[2,4]]' 1)"
refuses 'target: tie 1 joins other vertices than in the source' "$source" "$target" \
    "$(feature source-tie LineString '[[0,0],[2,2]]' 1)" "$(feature target-tie LineString '[[2,2],[0,0]]' 1)"

# Where they lie: the number is that of the file, whatever the order.
refuses 'source: point 3, vertex 0, lies outside' "$source" "$target" "$lines" "$(feature source Point '[11,8]' 3)" "$partner"
refuses 'target: point 3, vertex 0, lies in hole 1' "$source" "$target" "$lines" "$point" "$(feature target Point '[3,3]' 3)"
refuses 'source: line 5' "$source" "$target" "$(feature source LineString '[[6,2],[8,2],[10,5]]' 5)" \
    "$(feature target LineString "$line" 5)" "$point" "$partner"
refuses 'point 3' "$source" "$target" "$lines" "$(feature source Point '[7,2]' 3)" "$partner"
refuses 'line 5' "$source" "$target" "$lines" "$(feature source Point '[7,2]' 3)" "$partner"
refuses 'source: hole 1' "$(feature source Polygon "[$square, [[2,2],[4,2],[4,4],[2,14]]]")" "$target"
refuses 'target: the edge from vertex 1 crosses the edge from vertex 3' "$source" \
    "$(feature target Polygon "[[[0,0],[10,0],[0,10],[10,10]], $hole]")"

# Two files: the file says which side.
collection "$source" "$point" "$lines" >a.geojson
collection "$target" "$partner" >b.geojson
run 1 map -s a.geojson -t b.geojson -p points.txt
says 'libicc: b.geojson: line 5 of the source has no partner in the target'
collection "$target" "$(feature target Point '[3,3]' 3)" "$lines" >b.geojson
run 1 check -s a.geojson -t b.geojson
says 'libicc: b.geojson: point 3, vertex 0, lies in hole 1'

# Other formats.
printf 'POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0), (2 2, 4 2, 4 4, 2 4, 2 2),\n (4 3, 6 3, 6 6))' >holes.wkt
run 1 check -s holes.wkt
says 'libicc: holes.wkt:2: hole 2'
printf '<svg><path d="M0 0H10V10H0zm2 2h2v2h-2zm3,0\nl12 0 0 2"/></svg>' >holes.svg
run 1 check -s holes.svg
says 'libicc: holes.svg:1: hole 2'

# What works on cages without features only.
collection "$source" "$point" >a.geojson
run 1 encode -s a.geojson -p points.txt
says 'libicc: a.geojson: a cage with holes, lines or points inside has maps, but no chart'
for command in "check -s a.geojson" "info -s a.geojson" "plot -s a.geojson out.svg"; do
    # shellcheck disable=SC2086 # words
    run 1 $command
    says 'has maps, but no chart; --target FILE is missing'
done
run 1 check -s a.geojson --repair b.geojson
says 'libicc: a.geojson: --repair is for cages without'
run 1 plot -s a.geojson out.vtk
says 'libicc: a.geojson: there are holes, lines or points inside'
printf '{"handles": [[1, 1], [9, 9]]}' >handles.json
run 1 weights -s a.geojson -a handles.json -p points.txt
says 'libicc: a.geojson: there are holes, lines or points inside'
collection "$source" "$target" >both.geojson
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >mesh.off
run 1 map -s both.geojson --mesh mesh.off -p points.txt
says 'libicc: both.geojson: there are holes, lines or points inside'

# Features go to features, whatever their order and format, there and back; holes have no inside.
moved='[[1,2],[3,2],[3,4],[1,4],[1,2]]'
bent='[[6,2],[8,2],[9,4]]'
target=$(feature target Polygon "[$square, $moved]")
lines="$(feature source LineString "$line" 5), $(feature target LineString "$bent" 5)"
collection "$source" "$target" "$point" "$partner" "$lines" >case.geojson
collection "$partner" "$lines" "$point" "$target" "$source" >other.geojson
printf '%s\n' 0,0 10,0 10,10 0,10 2,2 4,2 4,4 2,4 6,2 8,2 8,5 2,8 7,2 8,3.5 3,2 | tr , ' ' >given.txt
printf '%s\n' 0,0 10,0 10,10 0,10 1,2 3,2 3,4 1,4 6,2 8,2 9,4 3,8 7,2 8.5,3 2,2 | tr , ' ' >images.txt
run 0 map -s case.geojson -p given.txt
close_to out images.txt 1e-12
cp out expected
run 0 map -s case.geojson -p images.txt --inverse
close_to out given.txt 1e-12
for files in "case.geojson -t case.geojson" "other.geojson" "case.geojson -t other.geojson"; do
    # shellcheck disable=SC2086 # words
    run 0 map -s $files -p given.txt
    same out expected "$files"
done
run 0 map -s - -p given.txt <case.geojson
same out expected "standard input"
printf '3 3\n1.5 3\n11 1\n' | run 4 map -s case.geojson
[ "$(sed -n '1p;3p' out | sort -u)" = "nan nan" ] || complain "a point in a hole has an image: $(cat out)"
holds err '2 of 3 points have no image: 2 outside the cage'
printf '3.5 3\n2 3\n' | run 4 map -s case.geojson --inverse
[ "$(sed -n '2p' out)" = "nan nan" ] || complain "a point in the target's hole comes back: $(cat out)"

collection "$source" >a.geojson
collection "$target" >b.geojson
awk 'NR <= 5' given.txt >few.txt
run 0 map -s a.geojson -t b.geojson -p few.txt
cp out expected
printf 'POLYGON((0 0,10 0,10 10,0 10,0 0),(2 2,4 2,4 4,2 4,2 2))' >a.wkt
printf '<svg><path d="M0 0H10V10H0zm1 2h2v2h-2z"/></svg>' >b.svg
run 0 map -s a.wkt -t b.svg -p few.txt
same out expected "WKT and SVG"
printf '<svg><path id="source" d="M0 0H10V10H0zM2 2h2v2h-2"/><path id="target" d="M0 0H10V10H0M1 2h2v2h-2z"/></svg>' >both.svg
run 0 map -s both.svg -p few.txt
same out expected "both in one SVG"

# Triangles: two sheets of them along the line, none in the holes.
run 0 map -s case.geojson -p given.txt --triangulation mesh.json
holds mesh.json '[8, 5, 9, 4]'
holds mesh.json '[2, 8, 3, 8]'

# Ties: any bends, in the numbers of the file.
ends=$(feature source-tie LineString '[[10,0],[6,2]]' 12)
collection "$source" "$target" "$point" "$partner" "$lines" "$ends" "$(feature target-tie LineString '[[10,0],[6,2]]' 12)" \
    "$(feature source-tie LineString '[[0,0],[2,2]]' 11)" "$(feature target-tie LineString '[[0,0],[1,2]]' 11)" \
    "$(feature target-tie LineString '[[0,10],[3,8]]' 13)" "$(feature source-tie LineString '[[0,10],[1,9],[2,8]]' 13)" >tied.geojson
run 0 map -s tied.geojson -p given.txt
close_to out images.txt 1e-12
sed 's/\[\[10,0\],\[6,2\]\]/[[10,0],[2,3],[6,2]]/2' tied.geojson >bad
run 1 map -s bad -p given.txt
says 'libicc: bad: target: tie 12 meets'
collection "$source" "$target" "$point" "$partner" "$ends" "$(feature target-tie LineString '[[10,0],[6,2]]' 12)" "$lines" >bad
run 1 map -s bad -p given.txt
says 'there must be 3, which join all rings, lines and points'

# The map's own ties, in a file that makes a map of the same ties.
run 0 map -s case.geojson -p given.txt --ties own.geojson
[ "$(grep -c -- '-tie"' own.geojson)" -eq 6 ] || complain "not three ties on each side: $(cat own.geojson)"
run 0 map -s own.geojson -p given.txt --ties again.geojson
close_to out images.txt 1e-12
same own.geojson again.geojson
run 0 info -s tied.geojson --ties own.geojson
holds out 'ties        3, '
run 0 info -s own.geojson --json --ties again.geojson
holds out '"ties": 3,'
holds out '"class_kept": true'
same own.geojson again.geojson
run 2 map -s case.geojson -p given.txt --ties -
says '--ties goes to a file'
run 2 map -s case.geojson -p given.txt --ties own.png
run 1 map -s source.txt -t target.txt -p points.txt --ties own.geojson
says 'no ties to write'

# The other commands.
run 0 check -s case.geojson
head -n 1 out | grep -qx 'one-to-one: yes, certified' || complain "not certified: $(head -n 1 out)"
holds out 'a simple polygon, 4 vertices, counter-clockwise, area 96, with 1 hole, 1 line and 1 point inside'
run 0 check -s case.geojson --json
holds out '"certified": true'
holds out '"holes": 1,'
run 0 info -s case.geojson
holds out 'map         mesh, certified'
holds out 'with 1 hole, 1 line and 1 point inside'
run 0 info -s case.geojson --json
holds out '"certified": true'
run 0 plot -s case.geojson out.svg
holds out.svg '<clipPath id='
holds out.svg 'target: triangles'
run 0 plot -s case.geojson --triangles out.svg
[ "$(grep -c stroke-dasharray out.svg)" -eq 18 ] || complain "the map's own ties are not drawn"
run 0 plot -s tied.geojson out.svg
[ "$(grep -c stroke-dasharray out.svg)" -eq 18 ] || complain "three ties are not drawn in each of six panels"
collection "$(feature none Polygon "[$square, $hole]")" "$(feature none LineString "$line")" "$(feature none Point '[2,8]')" >in.geojson
run 0 map -s case.geojson --geojson in.geojson out.geojson --tolerance 100
for pair in '1,2' '3,4' '9,4' '3,8'; do
    tr -d ' ' <out.geojson | grep -qF "[$pair]" || complain "$pair is not in $(cat out.geojson)"
done

# A point with a radius takes the circle round it along, a larger or smaller one if need be.
sized() { # ROLE COORDINATES RADIUS [NUMBER]
    feature "$1" Point "$2" "${4:-3}" | sed "s/}, \"geometry\"/, \"radius\": $3&/"
}
collection "$source" "$target" "$(sized source '[2,8]' 1)" "$(sized target '[3,7]' 1.5)" >sized.geojson
printf '2 8\n3 8\n2 9\n1 8\n2 7\n1.29289321881345248 8.70710678118654752\n' >on.txt
printf '3 7\n4.5 7\n3 8.5\n1.5 7\n3 5.5\n1.93933982822017872 8.06066017177982128\n' >expected
run 0 map -s sized.geojson -p on.txt
close_to out expected 1e-12
run 0 check -s sized.geojson
holds out ', with 1 hole and 1 point inside'
refuses 'source: the radius of point 3 must be a number of at least 0' "$source" "$target" "$(sized source '[2,8]' -1)" "$partner"
refuses 'source: the radius of point 3 must be a number of at least 0' "$source" "$target" "$(sized source '[2,8]' '"1"')" "$partner"
refuses 'target: point 3 has no radius, but in the source one' "$source" "$target" "$(sized source '[2,8]' 1)" "$partner"
refuses 'source: circle of point 3, vertex' "$source" "$target" "$(sized source '[2,8]' 4)" "$(sized target '[2,8]' 1)"
refuses 'points with a radius cannot be combined with ties' "$source" "$target" "$(sized source '[2,8]' 1)" \
    "$(sized target '[2,8]' 1)" "$(feature source-tie LineString '[[0,10],[2,8]]' 1)"
run 1 map -s sized.geojson -p on.txt --ties ties.geojson
says 'points with a radius cannot be combined with ties'
collection "$source" "$target" "$(sized source '[2,8]' 0)" "$(sized target '[3,8]' null)" >none.geojson
printf '2 8\n' >on.txt
run 0 map -s none.geojson -p on.txt

# Lines and polygons are cut at holes.
collection "$(feature none LineString '[[1,3],[9,3]]')" "$(feature none Polygon '[[[1,1],[3,1],[3,3],[1,3],[1,1]]]')" >in.geojson
collection "$source" "$(feature target Polygon "[$square, $hole]")" >same.geojson
run 4 map -s same.geojson --geojson in.geojson out.geojson --outside clip --tolerance 100
holds out.geojson '"MultiLineString"'
holds out.geojson '[3,2], [2,2], [2,3]'

# Also where nothing of a polygon but the inside of a hole lies outside; its outline alone can be carried.
around='[[1,1],[5,1],[5,5],[1,5],[1,1]]'
collection "$(feature none Polygon "[$around]")" "$(feature none Polygon "[$around, $hole]")" "$(feature none Polygon "[$hole]")" \
    "$(feature none MultiPolygon "[[[[6,6],[7,6],[7,7],[6,6]]], [$around]]")" >in.geojson
run 4 map -s same.geojson --geojson in.geojson out.geojson --outside clip --tolerance 100
holds err '3 of 4 features are not carried as they were, 0 of 29 positions have no image: feature 0'
holds err 'feature 2 (line 1): null, feature 3'
[ "$(grep -oF ', [[2,2], [2,4], [4,4], [4,2], [2,2]]]' out.geojson | wc -l)" -eq 2 ] || complain "a hole is missing: $(cat out.geojson)"
run 0 map -s same.geojson --geojson in.geojson out.geojson --outside fail --tolerance 100

# A file with both sides needs no target, also for check, info and plot; a name chooses one side alone.
collection "$(feature source Polygon "[$square]")" "$(feature target Polygon "[$square]")" >both.geojson
run 0 map -s both.geojson -p points.txt
close_to out points.txt 1e-12
run 0 check -s both.geojson
[ "$(grep -c 'a simple polygon' out)" -eq 2 ] || complain "check did not take both cages"
run 0 info -s both.geojson
holds out 'map         mesh, certified'
run 0 plot -s both.geojson --triangles both-plot.svg
run 0 check -s both.geojson#role=target
[ "$(grep -c 'a simple polygon' out)" -eq 1 ] || complain "check took a target beside a named cage"
collection "$(feature source Polygon "[$square]")" "$(feature target Polygon '[[[0,0],[10,10],[10,0],[0,10],[0,0]]]')" >crossed.geojson
run 1 check -s crossed.geojson
holds out 'one-to-one: not proved: 1 defect'
run 1 info -s crossed.geojson
run 1 plot -s crossed.geojson both-plot.svg
printf '<svg><path id="source" d="M0 0H10V10H0z"/><path id="target" d="M0 0H10V10H0z"/></svg>' >both.svg
run 0 map -s both.svg -p points.txt
close_to out points.txt 1e-12
run 0 map -s - -p points.txt <both.geojson
close_to out points.txt 1e-12
run 2 map -s source.txt -p points.txt
says '--target FILE is missing'
finish
