#!/bin/sh
# Cages of several polygons, islands in holes, and holes that are filled: one domain of several pieces.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

pictures=$scratch/pictures
"${CC:-cc}" -std=c11 -o "$pictures" "$here/pictures.c" -lpng || exit 1

# square X Y R: a ring round (X, Y).
square() {
    awk -v x="$1" -v y="$2" -v r="$3" 'BEGIN {
        printf "[[%g,%g],[%g,%g],[%g,%g],[%g,%g],[%g,%g]]", x - r, y - r, x + r, y - r, x + r, y + r, x - r, y + r, x - r, y - r }'
}

# feature ROLE TYPE COORDINATES [NUMBER]
feature() {
    printf '{"type": "Feature", "properties": {"role": "%s"%s}, "geometry": {"type": "%s", "coordinates": %s}}' \
        "$1" "${4:+, \"feature\": $4}" "$2" "$3"
}

collection() {
    separator=
    printf '{"type": "FeatureCollection", "features": ['
    for one in "$@"; do
        printf '%s%s' "$separator" "$one"
        separator=', '
    done
    printf ']}\n'
}

# A lake with an island, and another island beside the land. In the target the first island has moved in the lake.
land="$(square 5 5 4), $(square 5 5 3)"
source=$(feature source MultiPolygon "[[$land], [$(square 5 5 1)], [$(square 15 5 2)]]")
target=$(feature target MultiPolygon "[[$land], [$(square 6 5 1)], [$(square 15 8 2)]]")
towns="$(feature source Point '[5, 5]' 1), $(feature target Point '[6, 5.5]' 1), $(feature source LineString '[[14, 5], [16, 5]]' 2), \
$(feature target LineString '[[14, 8], [16, 8.5]]' 2)"
collection "$source" "$target" "$towns" >case.geojson

run 0 check -s case.geojson
[ "$(head -n 1 out)" = 'one-to-one: yes, certified' ] || complain "$(head -n 1 out)"
holds out 'case.geojson: 3 polygons, 16 vertices, area 48, with 1 hole, 1 line and 1 point inside'
holds out 'map: mesh, certified one-to-one: all '
run 0 check -s case.geojson --json
holds out '"polygons": 3'
holds out '"certified": true'

# Points go with the polygon they lie in. What is in none has no image; a hole that is filled has an inside.
printf '1.5 5\n5 5\n4 6\n15 5\n17 3\n3 5\n11 5\n' >points.txt
run 4 map -s case.geojson -p points.txt
printf '1.5 5\n6 5.5\n5 6\n15 8.25\n17 6\nnan nan\nnan nan\n' >expected
sed '1s/.*/1.5 5/' out >rest # the land is the same, but a point of it may be elsewhere by the last digit
same rest expected
holds err '2 of 7 points have no image: 2 outside the cage'
run 0 map -s case.geojson -p points.txt --frame 0.3
sed -n '2p;4p' out >framed
printf '6 5.5\n15 8.25\n' >expected
close_to framed expected 1e-9
grep -q nan out && complain "the plane around the polygons is not mapped: $(cat out)"
run 0 check -s case.geojson --frame 0.3
holds out 'one-to-one: yes, certified'
run 4 map -s case.geojson -p points.txt --fill-holes --triangulation all.json
[ "$(grep -c nan out)" -eq 1 ] || complain "the lake is not filled: $(cat out)"
mv out images
grep -v nan images >there
run 0 map -s case.geojson -p there --fill-holes --inverse
grep -v '^11 ' points.txt >expected
close_to out expected 1e-9
[ "$(grep -c 'idx_vertex1' all.json)" -eq 1 ] || complain "no triangulation"
run 0 check -s case.geojson --fill-holes
holds out 'case.geojson: 3 polygons, 12 vertices, area 80, with 1 line and 1 point inside'

# A contour in a picture is a hole that is filled.
collection "$(feature source Polygon "[$(square 16 16 16), $(square 16 16 8)]")" \
    "$(feature target Polygon "[$(square 16 16 16), $(square 16 16 8)]")" "$(feature source Point '[16, 16]' 1)" \
    "$(feature target Point '[16, 16]' 1)" >frame.geojson
"$pictures" make in.png 32 32 3 8 ramp
run 0 warp -s frame.geojson -t frame.geojson --fill-holes --background ff0000 in.png out.png
"$pictures" same in.png out.png || complain "the identity changes a picture"
run 1 warp -s frame.geojson -t frame.geojson in.png out.png
says 'source: point 1, vertex 0, lies in hole 1'

# GeoJSON: across the shore, across the lake, from polygon to polygon.
collection "$(feature none LineString '[[1.5,5],[8.5,5]]')" "$(feature none LineString '[[8,2],[15,4]]')" \
    "$(feature none Point '[15,4]')" >in.geojson
run 4 map -s case.geojson --geojson in.geojson out.geojson
holds err '2 of 3 features are not carried as they were'
run 4 map -s case.geojson --geojson in.geojson out.geojson --outside clip
[ "$(grep -o MultiLineString out.geojson | wc -l)" -eq 2 ] || complain "not clipped: $(cat out.geojson)"
run 4 map -s case.geojson --geojson in.geojson out.geojson --fill-holes
holds err '1 of 3 features are not carried as they were, 0 of 5 positions have no image: feature 1'

# An island in a lake covers no lake, whether it lies apart, splits the lake, or fills all but a corner.
clips() { # REGIONS FATES POLYGON...: which of the polygons, from 0, are not carried as they are
    cage=$1
    fates=$2
    shift 2
    collection "$(feature source MultiPolygon "[$cage]")" "$(feature target MultiPolygon "[$cage]")" >lake.geojson
    layer=
    for one in "$@"; do
        layer="$layer${layer:+, }$(feature none Polygon "[$one]")"
    done
    collection "$layer" >in.geojson
    run 4 map -s lake.geojson --geojson in.geojson out.geojson --outside clip --tolerance 1e9
    found=$(sed 's/.*: feature /feature /; s/feature //g; s/ (line 1)//g' err)
    [ "$found" = "$fates" ] || complain "$found instead of $fates"
}
land="[$(square 5 5 5), $(square 5 5 3)]"
clips "$land, [$(square 5 5 1)]" '2: clipped' "$(square 5 5 1)" "$(square 5 5 0.5)" "$(square 5 5 4)" "$(square 1 5 0.5)"
clips "$land, [[[2,2],[5,4],[8,8],[4,5],[2,2]]]" '1: null, 2: null' '[[2,2],[5,4],[8,8],[4,5],[2,2]]' '[[2,2],[8,2],[8,8],[5,4],[2,2]]' \
    '[[2,2],[4,5],[8,8],[2,8],[2,2]]'
clips "$land, [[[2,2],[8,2],[8,8],[4,8],[2,5],[2,2]]]" '1: clipped' '[[2,2],[8,2],[8,8],[4,8],[2,5],[2,2]]' "$(square 5 5 3)"
# A lake between regions is no hole of any.
clips '[[[0,0],[9,0],[6,3],[3,3],[0,0]]], [[[9,0],[9,9],[6,6],[6,3],[9,0]]], [[[9,9],[0,9],[0,0],[3,3],[3,6],[6,6],[9,9]]]' '0: clipped' \
    '[[0,0],[9,0],[9,9],[0,9],[0,0]]' '[[0,0],[9,0],[6,3],[3,3],[0,0]]'

# Islands in islands, and polygons in another order of nesting than of the file.
deep() { # ROLE X: an island at X in the lake of the island in the lake
    feature "$1" MultiPolygon "[[$(square "$2" 5 0.5)], [$(square 5 5 9), $(square 5 5 7)], [$(square 5 5 4), $(square 5 5 3)]]"
}
collection "$(deep source 5)" "$(deep target 6)" >deep.geojson
run 0 check -s deep.geojson
run 0 check -s deep.geojson --fill-holes
printf '5 5\n' >points.txt
run 0 map -s deep.geojson -p points.txt
close_to out points.txt 1.1

# What does not correspond, or meets, is refused by name.
refuses() { # MESSAGE FEATURE...
    message=$1
    shift
    collection "$@" >bad.geojson
    run 1 check -s bad.geojson -t bad.geojson
    says 'libicc: bad.geojson: '
    says "$message"
}
two() { # ROLE X: two squares, the second at X
    feature "$1" MultiPolygon "[[$(square 5 5 4)], [$(square "$2" 5 2)]]"
}
refuses 'source: the shape has 2 parts, but the target 1' "$(two source 15)" "$(feature target Polygon "[$(square 5 5 4)]")"
refuses 'target: the shape has 2 parts, but the source 1' "$(two target 15)" "$(feature source Polygon "[$(square 5 5 4)]")"
refuses 'target: polygon 2, edge 0, and polygon 1, edge 1, cross near (9, 3)' "$(two source 15)" "$(two target 8)"
refuses '' "$(two source 5)" "$(two target 15)"
refuses '' "$(two source 15)" "$(two target 15)" \
    "$(feature source Point '[15, 5]' 1)" "$(feature target Point '[5, 5]' 1)"
refuses 'target: point 1, vertex 0, lies outside all regions' "$(two source 15)" "$(two target 15)" \
    "$(feature source Point '[5, 5]' 1)" "$(feature target Point '[11, 5]' 1)"
refuses 'target: polygon 2 has 3 vertices, but in the source 4' "$(two source 15)" \
    "$(feature target MultiPolygon "[[$(square 5 5 4)], [[[13,3],[17,3],[17,7]]]]")"
refuses 'hole 1 of polygon 2 of the source has no partner in the target' \
    "$(feature source MultiPolygon "[[$(square 5 5 4)], [$(square 15 5 4), $(square 15 5 2)]]")" \
    "$(feature target MultiPolygon "[[$(square 5 5 4)], [$(square 15 5 4)]]")"
collection "$(two source 15)" "$(two target 15)" "$(feature source Point '[5, 5]' 1)" \
    "$(feature target Point '[5, 5]' 1)" "$(feature source-tie LineString '[[1, 1], [5, 5]]' 1)" \
    "$(feature target-tie LineString '[[1, 1], [5, 5]]' 1)" >tied.geojson
run 0 check -s tied.geojson
refuses 'polygon 2 has 2 vertices; it has at least 3' "$(two target 15)" \
    "$(feature source MultiPolygon "[[$(square 5 5 4)], [[[0,0],[1,1]]]]")"
refuses 'the MultiPolygon has no polygons' "$(two target 15)" "$(feature source MultiPolygon '[]')"
feature source MultiPolygon "[[$(square 5 5 4)], [$(square 15 5 2)]]" >one.geojson
run 1 check -s one.geojson
says 'the shape has 2 parts; only maps take several, and --target FILE is missing'
run 0 info -s case.geojson -t case.geojson
holds out 'cage        3 polygons, 16 vertices, area 48, with 1 hole, 1 line and 1 point inside'
run 0 plot -s case.geojson -t case.geojson out.svg
run 0 map -s case.geojson -p /dev/null --ties ties.geojson
run 0 check -s ties.geojson
run 1 check -s case.geojson --repair mended.geojson
says '--repair is for cages'
printf '0 0\n4 0\n4 4\n0 4\n' >text.txt
printf '1 1\n' >points.txt
run 0 map -s text.txt -t text.txt --fill-holes -p points.txt

# A path of SVG: contours beside one another are polygons, those inside are holes and islands, in whatever order they come.
# What is a single place draws nothing: at the beginning, in between, at the end, and twice closed.
svg() { # NAME PATH..
    printf '<svg><path d="%s"/></svg>\n' "$2" >"$1.svg"
}
box() { # X Y R, and the other way round: a contour round (X, Y)
    awk -v x="$1" -v y="$2" -v r="$3" 'BEGIN { printf "M%g %gh%gv%gh%gz", x - r, y - r, 2 * r, 2 * r, -2 * r }'
}
xob() {
    awk -v x="$1" -v y="$2" -v r="$3" 'BEGIN { printf "M%g %gv%gh%gv%gz", x - r, y - r, 2 * r, 2 * r, -2 * r }'
}
areas() { # what `check` says of a drawing: its polygons, their area, their holes
    cp "$1.svg" target.svg
    run 0 check -s "$1.svg" -t target.svg
    sed -n "/^$1.*, area /{s/a simple polygon/1 polygons/; s/.*: \([0-9]*\) polygons.*, area \([0-9.]*\)/\1: \2/; s/, with \([0-9]*\) hole.*/-\1/; p; }" out
}
expects() { # AREAS NAME
    got=$(areas "$2")
    [ "$got" = "$1" ] || complain "$2.svg has the polygons $got, not $1"
}
for d in 'M0 0H10V10H0Z m 12 12' 'M0 0H10V10H0Z m 12 12z' 'M5 5 m -5 -5 H10 V10 H0 Z' 'm3 3M9 9zM0 0H10V10H0Z' 'M0 0H10V10H0ZZz' \
    'M0 0H10V10H0Zm2 2h0v0l0 0zm0 0c0 0 0 0 0 0zM1 1'; do
    svg dots "$d"
    expects '1: 100' dots
done
svg dots 'M0 0H10V10H0Z M7 7z M2 2 V4 H4 V2 Z M 7 7 z'
expects '1: 96-1' dots
svg beside "$(box 5 5 5)$(box 25 5 4)"
expects '2: 164' beside
svg beside "$(box 5 5 5)$(xob 25 5 4)$(box 5 25 3)$(xob 25 5 2)$(box 5 5 1)"
expects '3: 180-2' beside
svg hole "$(xob 5 5 1)$(box 5 5 5)"
expects '1: 96-1' hole
svg islands "$(box 10 10 1)$(box 10 10 2)$(box 10 10 3)$(xob 10 10 4)$(xob 10 10 5)$(box 30 10 1)"
expects '4: 64-2' islands
# In a notch, where boxes overlap.
svg notch 'M0 0H10V2H2V10H0Z M4 4h2v2h-2z M0.5 0.5v1h1v-1z'
expects '2: 39-1' notch
printf '1 1\n15 15\n7 5\n25 7\n' >points.txt
svg before "$(box 5 5 5)$(box 25 5 4)$(xob 5 5 1)"
{ printf '<svg><g transform="translate(0, 2)">' && sed 's/<svg>//; s/<.svg>//' before.svg && printf '</g></svg>'; } >after.svg
run 4 map -s before.svg -t after.svg -p points.txt
printf '1 3\nnan nan\n7 7\n25 9\n' >expected
grep -v nan expected >there
grep -v nan out >got
close_to got there 1e-9
run 1 info -s beside.svg
says 'libicc: beside.svg: the shape has 3 parts; only maps take several, and --target FILE is missing'
svg other "$(box 5 5 5)$(box 25 5 4)"
run 1 check -s beside.svg -t other.svg
says 'the shape has 3 parts, but the target 2; they correspond one by one'
# Contours that cross are refused, whichever comes first.
for d in "$(box 5 5 5)$(box 8 8 5)" "$(box 8 8 5)$(box 5 5 5)"; do
    svg cross "$d"
    run 1 check -s cross.svg -t cross.svg
done
# Many: the time is that of sorting.
awk 'BEGIN { printf "<svg><path d=\""; n = 20000; for (i = 0; i < n; i++) printf "M%d %dh%dv%dh%dz", i, i, w = 4 * n - 2 * i, w, -w; print "\"/></svg>" }' >deep.svg
run 1 info -s deep.svg
says 'the shape has 10000 parts'
finish
