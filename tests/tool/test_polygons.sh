#!/bin/sh
# Cages of several polygons, islands in holes, and holes that are filled: each polygon has a map of its own.
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
holds out 'case.geojson: polygon 2: a simple polygon, 4 vertices, counter-clockwise, area 4, with 1 point inside'
holds out 'polygon 3: map: mesh, certified one-to-one: all '
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
run 4 map -s case.geojson -p points.txt --fill-holes --triangulation all.json
[ "$(grep -c nan out)" -eq 1 ] || complain "the lake is not filled: $(cat out)"
mv out images
grep -v nan images >there
run 0 map -s case.geojson -p there --fill-holes --inverse
grep -v '^11 ' points.txt >expected
close_to out expected 1e-9
[ "$(grep -c 'idx_vertex1' all.json)" -eq 1 ] || complain "no triangulation"
run 0 check -s case.geojson --fill-holes
holds out 'inside of hole 1: map: mesh, certified one-to-one'
holds out 'inside of hole 1: a simple polygon, 4 vertices, counter-clockwise, area 32, with 1 hole inside'

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

# Islands in islands, and polygons in another order of nesting than of the file.
deep() { # ROLE X: an island at X in the lake of the island in the lake
    feature "$1" MultiPolygon "[[$(square "$2" 5 0.5)], [$(square 5 5 9), $(square 5 5 7)], [$(square 5 5 4), $(square 5 5 3)]]"
}
collection "$(deep source 5)" "$(deep target 6)" >deep.geojson
run 0 check -s deep.geojson
run 0 check -s deep.geojson --fill-holes
holds out 'inside of hole 2: map'
printf '5 5\n' >points.txt
run 0 map -s deep.geojson -p points.txt
close_to out points.txt 1.1
collection "$(deep source 5)" "$(deep target 11)" >bad.geojson
run 1 check -s bad.geojson
says 'target: polygon 1 lies in another hole than in the source'

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
refuses 'source: the MultiPolygon has 2 parts, but the target 1' "$(two source 15)" "$(feature target Polygon "[$(square 5 5 4)]")"
refuses 'target: the MultiPolygon has 2 parts, but the source 1' "$(two target 15)" "$(feature source Polygon "[$(square 5 5 4)]")"
refuses 'target: polygon 2 meets another one' "$(two source 15)" "$(two target 8)"
refuses 'source: polygon 2 meets another one' "$(two source 5)" "$(two target 15)"
refuses 'target: point 1 is in another polygon than in the source' "$(two source 15)" "$(two target 15)" \
    "$(feature source Point '[15, 5]' 1)" "$(feature target Point '[5, 5]' 1)"
refuses 'target: polygon 1: point 1, vertex 0, lies outside' "$(two source 15)" "$(two target 15)" \
    "$(feature source Point '[5, 5]' 1)" "$(feature target Point '[11, 5]' 1)"
refuses 'target: polygon 2: 3 vertices, but the source' "$(two source 15)" \
    "$(feature target MultiPolygon "[[$(square 5 5 4)], [[[13,3],[17,3],[17,7]]]]")"
refuses 'target: polygon 2 has other holes than in the source' \
    "$(feature source MultiPolygon "[[$(square 5 5 4)], [$(square 15 5 4), $(square 15 5 2)]]")" \
    "$(feature target MultiPolygon "[[$(square 5 5 4)], [$(square 15 5 4)]]")"
refuses 'ties are for cages of a single polygon' "$(two source 15)" "$(two target 15)" "$(feature source Point '[5, 5]' 1)" \
    "$(feature target Point '[5, 5]' 1)" "$(feature source-tie LineString '[[1, 1], [5, 5]]' 1)" \
    "$(feature target-tie LineString '[[1, 1], [5, 5]]' 1)"
refuses 'polygon 2 has 2 vertices; it has at least 3' "$(two target 15)" \
    "$(feature source MultiPolygon "[[$(square 5 5 4)], [[[0,0],[1,1]]]]")"
refuses 'the MultiPolygon has no polygons' "$(two target 15)" "$(feature source MultiPolygon '[]')"
feature source MultiPolygon "[[$(square 5 5 4)], [$(square 15 5 2)]]" >one.geojson
run 1 check -s one.geojson
says 'the MultiPolygon has 2 parts; only maps take several, and --target FILE is missing'
run 1 info -s case.geojson -t case.geojson
says 'the MultiPolygon has 3 parts; make one map per part for libicc info'
run 1 map -s case.geojson -p points.txt --ties ties.geojson
says '--ties is for cages of a single polygon'
run 1 check -s case.geojson --repair mended.geojson
says '--repair is for cages'
printf '0 0\n4 0\n4 4\n0 4\n' >text.txt
printf '1 1\n' >points.txt
run 0 map -s text.txt -t text.txt --fill-holes -p points.txt
finish
