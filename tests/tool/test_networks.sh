#!/bin/sh
# Networks: lines that meet, closed lines, regions that share sides, and vertices on sides of others.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

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

# both TYPE SOURCE TARGET [NUMBER]
both() {
    printf '%s, %s' "$(feature source "$1" "$2" "$4")" "$(feature target "$1" "$3" "$4")"
}

refuses() { # MESSAGE FEATURE...
    message=$1
    shift
    collection "$@" >bad.geojson
    run 1 map -s bad.geojson -p points.txt
    says 'libicc: bad.geojson: '
    says "$message"
}

printf '1 1\n' >points.txt
ring='[[0,0],[8,0],[8,8],[0,8],[0,0]]'
outline=$(both Polygon "[$ring]" "[$ring]" '')

# Partners: a region is named by its number, its holes by theirs in it.
small='[[1,1],[4,1],[4,4],[1,4],[1,1]]'
five='[[1,1],[4,1],[4,4],[2,4],[1,4],[1,1]]'
hole='[[2,2],[3,2],[3,3],[2,2]]'
refuses 'target: region 3 has 5 vertices, but in the source 4' "$outline" "$(both Polygon "[$small]" "[$five]" 3)"
refuses 'region 3 of the source has no partner in the target' "$outline" "$(feature source Polygon "[$small]" 3)"
refuses 'target: region 3 has no partner in the source' "$outline" "$(feature target Polygon "[$small]" 3)"
refuses 'target: hole 1 of region 3 has no partner in the source' "$outline" "$(both Polygon "[$small]" "[$small,$hole]" 3)"
refuses 'target: hole 1 of region 3 has 3 vertices, but in the source 4' "$outline" \
    "$(both Polygon "[$small,[[2,2],[3,2],[3,3],[2,3],[2,2]]]" "[$small,$hole]" 3)"
refuses 'part 2 of region 3 of the source has no partner in the target' "$outline" \
    "$(both MultiPolygon "[[$small],[[[5,5],[6,5],[6,6]]]]" "[[$small]]" 3)"
refuses 'feature 3 is a region, but in the source a line' "$outline" "$(feature source LineString "$small" 3)" \
    "$(feature target Polygon "[$small]" 3)"
refuses 'two features have the number 3' "$outline" "$(both Polygon "[$small]" "[$small]" 3)" "$(both Point '[6,6]' '[6,6]' 3)"
refuses 'two features have the number 3' "$outline" "$(both Polygon "[$small]" "[$small]" 3)" "$(both Polygon "[$small]" "[$small]" 3)"
refuses 'source: region 3 has 2 vertices; a ring has at least 3' "$outline" "$(both Polygon '[[[1,1],[2,1]]]' "[$small]" 3)"
refuses 'source: vertex 1 of hole 1 of region 3 is not a pair' "$outline" "$(both Polygon "[$small,[[2,2],[3]]]" "[$small]" 3)"
refuses 'target: an outline, but the source has only regions' "$(feature target Polygon "[$ring]")" \
    "$(both Polygon "[$small]" "[$small]" 3)"
refuses 'target: no outline, but the source has one' "$(feature source Polygon "[$ring]")" "$(both Polygon "[$small]" "[$small]" 3)"

# A vertex on a side of another feature in one cage only.
long='[[1,4],[7,4]]'
refuses 'source: line 5, vertex 1, lies on a side of line 3 at (4, 4), but not in the target' "$outline" \
    "$(both LineString "$long" '[[1,4],[7,5]]' 3)" "$(both LineString '[[4,1],[4,4]]' '[[4,1],[4,3]]' 5)"
refuses 'target: line 5, vertex 1, lies on a side of line 3 at (4, 4), but not in the source' "$outline" \
    "$(both LineString '[[1,4],[7,5]]' "$long" 3)" "$(both LineString '[[4,1],[4,3]]' '[[4,1],[4,4]]' 5)"
refuses 'target: line 5, vertex 1, lies on a side of region 3 at (4, 2), but not in the source' "$outline" \
    "$(both Polygon "[$small]" "[$small]" 3)" "$(both LineString '[[6,2],[5,2]]' '[[6,2],[4,2]]' 5)"
refuses 'source: line 5, vertex 0, lies on a side of the outline at (4, 0), but not in the target' "$outline" \
    "$(both LineString '[[4,0],[4,3]]' '[[4,1],[4,3]]' 5)"

# In both it becomes a vertex of that side, also up to rounding, and at one place once.
collection "$outline" "$(both LineString "$long" '[[1,4],[7,5]]' 3)" "$(both LineString '[[3,0],[3,4]]' '[[4,0],[4,4.5]]' 5)" \
    "$(both LineString '[[3,4],[3,8]]' '[[4,4.5],[4,8]]' 6)" "$(both Point '[5,4]' '[5.3,4.716666666666667]' 7)" >tee.geojson
run 0 check -s tee.geojson
head -n 1 out | grep -qx 'one-to-one: yes, certified' || complain "not certified: $(head -n 1 out)"
holds out '4 vertices were added to sides on which others lie'
printf '1 4\n3 4\n5 4\n7 4\n2 4\n6 4\n3 0\n1.5 0\n3 2\n' >points.txt
printf '1 4\n4 4.5\n5.3 4.716666666666667\n7 5\n2.5 4.25\n6.15 4.858333333333333\n4 0\n2 0\n4 2.25\n' >expected
run 0 map -s tee.geojson -p points.txt
close_to out expected 1e-9
run 0 map -s tee.geojson -p expected --inverse
close_to out points.txt 1e-9

# Junctions, a closed line, and a region with a hole, which is no hole of the outline.
closed='[[1,1],[3,1],[3,3],[1,3],[1,1]]'
square='[[5,5],[7,5],[7,7],[5,7],[5,5]]'
in_square='[[5.5,5.5],[6.5,5.5],[6.5,6.5],[5.5,6.5],[5.5,5.5]]'
collection "$outline" "$(both LineString "$closed" "$closed" 1)" "$(both LineString '[[0,8],[1,3]]' '[[0,8],[1,3]]' 2)" \
    "$(both LineString '[[3,3],[5,5]]' '[[3,3],[5,5]]' 3)" "$(both Polygon "[$square,$in_square]" "[$square,$in_square]" 4)" \
    "$(both LineString '[[3,3],[4,2]]' '[[3,3],[4,2]]' 9)" >net.geojson
run 0 check -s net.geojson
holds out 'with 1 region and 4 lines inside'
printf '4 4\n6 6\n' >points.txt
run 0 map -s net.geojson -p points.txt
close_to out points.txt 1e-12
run 0 plot -s net.geojson net.svg
run 0 info -s net.geojson --json
holds out '"regions": 1'
run 0 map -s net.geojson -p /dev/null --ties own.geojson
run 0 check -s own.geojson

# A coverage without an outline. One state is of two parts, and the border moves.
left='[[0,0],[4,0],[4,6],[0,6],[0,0]]'
right='[[4,0],[9,0],[9,6],[4,6],[4,0]]'
moved='[[0,0],[5,0],[4,6],[0,6],[0,0]]'
rest='[[5,0],[9,0],[9,6],[4,6],[5,0]]'
island='[[10,0],[11,0],[11,1],[10,0]]'
collection "$(both Polygon "[$left]" "[$moved]" 2)" "$(both MultiPolygon "[[$right],[$island]]" "[[$rest],[$island]]" 1)" \
    "$(both MultiPolygon '[]' '[]' 7)" >states.geojson
run 0 check -s states.geojson
holds out ': 2 regions, 11 vertices, area 54.5'
printf '4 3\n10.9 0.2\n9.5 3\n' >points.txt
run 4 map -s states.geojson -p points.txt
sed 2q out >few
printf '4.5 3\n10.9 0.2\n' >expected
close_to few expected 1e-9
[ "$(sed -n 3p out)" = 'nan nan' ] || complain "a place outside all regions has an image"
run 0 plot -s states.geojson states.svg

# An interface whose vertices are spaced otherwise in the target.
outline='[[[0,0],[8,0],[8,2],[8,4],[0,4],[0,2],[0,0]]]'
collection "$(both Polygon "$outline" "$outline")" \
    "$(both LineString '[[0,2],[2,2],[4,2],[6,2],[8,2]]' '[[0,2],[0.6,2],[2,2],[4,2],[8,2]]' 1)" >slide.geojson
run 0 info -s slide.geojson --json
! grep -q '"slid"' out || complain "vertices slide without --slide"
run 0 info -s slide.geojson --slide --json
holds out '"slid": 3'
run 0 info -s slide.geojson --slide
holds out 'slid        3 places'
printf '2 2\n6 2\n1 3\n' >points.txt
run 0 map -s slide.geojson --slide=all -p points.txt
close_to out points.txt 1e-6
run 2 map -s slide.geojson --slide --improve 0 -p points.txt
says '--slide does not go with --improve 0'
run 2 map -s slide.geojson --slide --ties own.geojson -p points.txt
says '--slide does not go with --ties'
run 2 map -s slide.geojson --slide=none -p points.txt
printf '0 0\n8 0\n8 4\n0 4\n' >plain.txt
run 1 map -s plain.txt -t plain.txt --slide -p points.txt
says 'slide: only lines, holes and regions'
finish
