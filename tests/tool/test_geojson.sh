#!/bin/sh
# map --geojson: every type of geometry, lines that bend, parts outside the cage, what is no GeoJSON; all but
# coordinates stays as it is.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

carry() { # EXIT OPTION...: the geometry on standard input
    expected=$1
    shift
    cat >in.geojson
    run "$expected" map -s source.txt -t target.txt --geojson "$@" in.geojson out.geojson
}
# stay EXIT OPTION...: the same from the source to itself, so that only what is done to lines shows.
stay() {
    expected=$1
    shift
    cat >in.geojson
    run "$expected" map -s source.txt -t source.txt --tolerance 9 --geojson "$@" in.geojson out.geojson
}
# gives TEXT: the result is that, and a new line.
gives() {
    printf '%s\n' "$1" >expected
    same out.geojson expected "$1"
}
# The coordinates of the result, two a line.
coordinates() {
    tr -d '\n' <out.geojson | sed 's/.*"coordinates": *//; s/}.*$//' | tr -s '[], ' '\n' | grep . | paste -d ' ' - -
}

# Points go where `map` takes them; all the rest stays byte for byte: order, layout, digits, escapes, members that
# only look like geometries, names twice, a byte order mark, CR LF, no new line at the end.
printf '2.5 3.25\n' | run 0 map -s source.txt -t target.txt
read -r x y <out
frame() {
    printf '\357\273\277\t{"features" :[\r\n {"type":"Feature","id":12345678901234567890,"id":-0.0,"x":[1.10,1E2,0.1000000000000000055511151231257827],'
    printf '"properties":{"coordinates":[1,2],"geometry":{"type":"Point","coordinates":[5,5]},"b":617700169958293503,"n":"\\u00e9\\/\\\\\\"","e":{},"l":[ ],"l":null},'
    printf '"geometry":{"coordinates": [ %s,\n%s , 1.10,9007199254740993] ,"type":"Poin\\u0074","bbox\\n":[1,2],"geometry":{"type":"Point","coordinates":[1,1]}},' "$1" "$2"
    printf '"features":[{"type":"Point","coordinates":[1,1]}],"geometries":7},\n{"properties":null,"geometry":null,"type":"Feature"}]'
    printf ',"type":"FeatureCollection","crs":{"type":"name"},"bbox":null } '
}
frame 2.5e0 3.25 | carry 0
shorter() { awk -v x="$1" 'BEGIN { s = sprintf("%.15g", x); print s + 0 == x + 0 ? s : x }'; }
frame "$(shorter "$x")" "$(shorter "$y")" >expected
same out.geojson expected "all but coordinates"
echo '{"type":"MultiPoint","coordinates":[[0,0,440],[10,0,-1.50,7]]}' | carry 0
gives '{"type":"MultiPoint","coordinates":[[0,0,440],[12,1,-1.50,7]]}'
for text in '{"type":"LineString","coordinates":[]}' '{"type":"MultiPolygon","coordinates":[ ]}' '{"type":"MultiLineString","coordinates":[[],[]]}' \
    '{"type":"GeometryCollection","geometries":[]}' '{"type":"FeatureCollection","features":[]}' '{"type":"Feature","id":1.0,"properties":{}}'; do
    echo "$text" | carry 0
    gives "$text"
done

# The cage as a polygon becomes the other cage, corner by corner; its bounding box follows, heights stay.
polygon='[[0,0],[10,0],[10,5],[5,5],[5,10],[0,10],[0,0]]'
printf '{"type":"Polygon","coordinates":[%s]}' "$polygon" | carry 0
coordinates >got
sed -n '1,6p;$a\0 0' target.txt >expected
close_to got expected 1e-12
point='{"type":"Point","coordinates":[10,5]}'
echo '{"type":"FeatureCollection","bbox":[0,0,-5,10,5,1.50],"features":[{"type":"Feature","geometry":{"type":"Point","bbox":[1,2,3,4], "coordinates":[0,10]}},
    {"type":"Feature","bbox":[1,2,3,4],"geometry":null},{"type":"Feature","geometry":null,"bbox":[1,2,3,4]},{"type":"Feature","geometry":'"$point"'}]}' | carry 0
gives '{"type":"FeatureCollection","bbox":[-1,6,-5,12,10,1.50],"features":[{"type":"Feature","geometry":{"type":"Point","bbox":[-1,10,-1,10], "coordinates":[-1,10]}},
    {"type":"Feature","geometry":null},{"type":"Feature","geometry":null},{"type":"Feature","geometry":{"type":"Point","coordinates":[12,6]}}]}'

# A line bends; a finer tolerance takes more vertices, and all of them are on the image of the line. Heights go along.
line='{"type":"LineString","coordinates":[[1,1],[2,9]]}'
last=2
for tolerance in 1 0.1 0.01 0.001; do
    echo "$line" | carry 0 --tolerance "$tolerance"
    coordinates >images
    n=$(wc -l <images)
    [ "$n" -ge "$last" ] || complain "$n positions at $tolerance, $last before"
    last=$n
    run 0 map -s source.txt -t target.txt -p images -i
    awk '{ d = 8 * ($1 - 1) - ($2 - 1); if (d > 1e-9 || d < -1e-9) bad = 1 } END { exit bad }' out ||
        complain "positions beside the line"
done
[ "$last" -gt 8 ] || complain "$last positions are few"
run 0 map -s source.txt -t target.txt --geojson --inverse out.geojson back.geojson
holds back.geojson LineString
cp out.geojson expected
run 0 map -s source.txt -t target.txt --geojson --tolerance 0.001 - - <in.geojson
same out expected "through the standard streams"
printf '{"type":"LineString","coordinates":[\n  [1,1, 7.0,0],\n  [2,9, 7.0,8]\n]}' | carry 0 --tolerance 0.1
tr -d '\n' <out.geojson | grep -Eq '\[[^]]*, 7\.0,4\],  \[' || complain "no height half-way: $(cat out.geojson)"
[ "$(grep -c '^  \[[^]]*\],*$' out.geojson)" -gt 2 ] || complain "the layout of positions is lost: $(cat out.geojson)"

# What is outside: a geometry in part outside becomes null, and is told by its number and id.
line='{"type":"Feature","id":"road","properties":{"n":1.10},"geometry":{"type":"LineString","coordinates":[[4,9],[9,4]]}}'
outside='{"type":"Feature","geometry":{"coordinates":[8,8],"type":"Point"}}'
echo '{"type":"FeatureCollection","features":['"$line,$outside"',{"type":"Feature","geometry":'"$point"'}]}' >three.geojson
stay 4 <three.geojson
says '2 of 3 features are not carried as they were, 1 of 4 positions have no image: feature 0 (id "road"): null, feature 1 (line 1): null'
gives '{"type":"FeatureCollection","features":[{"type":"Feature","id":"road","properties":{"n":1.10},"geometry":null},{"type":"Feature","geometry":null},{"type":"Feature","geometry":'"$point"'}]}'
stay 4 --outside null --json=report.json <three.geojson
tr -d ' \n' <report.json >tight
holds tight '"not_carried":[{"feature":0,"id":"road","line":1,"without_image":0,"result":"null"},{"feature":1,"line":1,"without_image":1,"result":"null"}]'
stay 4 --outside keep <three.geojson
says 'feature 0 (id "road"): kept, feature 1 (line 1): kept'
gives '{"type":"FeatureCollection","features":[{"type":"Feature","id":"road","properties":{"n":1.10},"geometry":{"type":"LineString","coordinates":[[4,9],[5,8],[8,5],[9,4]]}},'"$outside"',{"type":"Feature","geometry":'"$point"'}]}'
stay 4 --outside clip <three.geojson
says 'feature 0 (id "road"): clipped, feature 1 (line 1): null'
gives '{"type":"FeatureCollection","features":[{"type":"Feature","id":"road","properties":{"n":1.10},"geometry":{"type":"MultiLineString","coordinates":[[[4,9], [5,8]], [[8,5], [9,4]]]}},{"type":"Feature","geometry":null},{"type":"Feature","geometry":'"$point"'}]}'
echo old >out.geojson
stay 1 --outside fail <three.geojson
says 'not all of it lies in the cage, so nothing is written: feature 0 (id "road"): refused, feature 1 (line 1): refused'
gives old
run 1 map -s source.txt -t source.txt --outside fail --geojson three.geojson -
[ ! -s out ] || complain "half a result on standard output"
printf '{"type":"Point","coordinates":[2,2]}' | stay 0 --outside fail
: >many
for _ in 1 2 3 4 5 6 7 8 9 10 11 12; do printf '%s\n' "$outside," >>many; done
printf '{"type":"FeatureCollection","features":[%s{"type":"Feature","geometry":null}]}' "$(cat many)" | stay 4
says 'feature 9 (line 10): null and 2 more, which --json=FILE lists'

# Geometries of no feature become empty, those of a collection in a feature take it with them.
collection='{"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[8,8]},{"type":"Point","coordinates":[2,2]}]}'
echo "$collection" | stay 4
says 'the geometry in line 1: null'
gives '{"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[]},{"type":"Point","coordinates":[2,2]}]}'
echo '{"type":"Feature","bbox":[1,1,2,2],"geometry":'"$collection"'}' | stay 4
gives '{"type":"Feature","geometry":null}'
echo '{"type":"Feature","geometry":'"$collection"'}' | stay 4 --outside clip
gives '{"type":"Feature","geometry":{"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[]},{"type":"Point","coordinates":[2,2]}]}}'
echo '{"type":"MultiPoint","coordinates":[[8,8],[2,2,5.0]]}' | stay 4 --outside clip
gives '{"type":"MultiPoint","coordinates":[[2,2,5.0]]}'
echo '{"type":"MultiPoint","coordinates":[[8,8.0],[2,2,5.0]]}' | stay 4 --outside keep
gives '{"type":"MultiPoint","coordinates":[[8,8.0],[2,2,5.0]]}'

# Clipped polygons: across the notch, with a hole that is cut, in two parts, around the cage, along its edges.
clips() { # IN OUT
    echo '{"type":"Polygon","coordinates":'"$1"'}' | stay 4 --outside clip
    gives "$2"
}
clips '[[[1,1],[9,1],[9,9],[1,9],[1,1]],[[4,4],[6,4],[6,6],[4,6],[4,4]]]' '{"type":"Polygon","coordinates":[[[1,1], [9,1], [9,5], [6,5], [6,4], [4,4], [4,6], [5,6], [5,9], [1,9], [1,1]]]}'
clips '[[[1,1],[1,9],[9,9],[9,1],[1,1]],[[2,2],[3,2],[3,3],[2,2]]]' '{"type":"Polygon","coordinates":[[[1,9], [5,9], [5,5], [9,5], [9,1], [1,1], [1,9]], [[3,2], [3,3], [2,2], [3,2]]]}'
clips '[[[4,9],[9,4],[9,9],[4,9]]]' '{"type":"MultiPolygon","coordinates":[[[[4,9], [5,8], [5,9], [4,9]]], [[[8,5], [9,4], [9,5], [8,5]]]]}'
clips '[[[-1,-1,5.0],[20,-1,5.0],[20,20,5.0],[-1,20,5.0],[-1,-1,5.0]]]' '{"type":"Polygon","coordinates":[[[0,0,5.0], [10,0,5.0], [10,5,5.0], [5,5,5.0], [5,10,5.0], [0,10,5.0], [0,0,5.0]]]}'
clips '[[[5,5],[7,5],[7,7],[5,7],[5,5]]]' '{"type":"Polygon","coordinates":[]}'
clips '[[[4,5],[7,5],[7,7],[5,7],[4,5]]]' '{"type":"Polygon","coordinates":[[[4,5], [5,5], [5,7], [4,5]]]}'
echo '{"type":"MultiPolygon","coordinates":[[[[1,1],[2,1],[2,2],[1,1]]],[[[6,6],[7,6],[7,7],[6,6]]],[[[9,4],[11,4],[9,6],[9,4]]]]}' | stay 4 --outside clip
gives '{"type":"MultiPolygon","coordinates":[[[[1,1], [2,1], [2,2], [1,1]]], [[[9,4], [10,4], [10,5], [9,5], [9,4]]]]}'
# Through the map the cut goes along the other cage.
echo '{"type":"Polygon","coordinates":[[[-1,-1],[20,-1],[20,20],[-1,20],[-1,-1]]]}' | carry 4 --outside clip
coordinates >got
sed -n '1,6p;$a\0 0' target.txt >expected
close_to got expected 1e-12

# What is outside by rounding is on the cage, also along an edge; how much that is may be told.
hair='[[1,1],[10.0000000001,1],[10.000000001,4],[5.0000000001,5.0000000001],[1,9],[1,1]]'
printf '{"type":"Polygon","coordinates":[%s]}' "$hair" | carry 0
printf '{"type":"Polygon","coordinates":[%s]}' "$hair" | carry 4 --snap 0
says 'the geometry in line 1: null'
echo '{"type":"LineString","coordinates":[[10.4,1],[10.4,4],[5.3,5.4]]}' | stay 0 --snap 0.5
gives '{"type":"LineString","coordinates":[[10,1],[10,4],[5,5.4]]}'
echo '{"type":"LineString","coordinates":[[10.4,1],[10.4,4]]}' | stay 4 --snap 0.3
printf '10.0000000001 1\n10.1 1\n' | run 4 map -s source.txt -t source.txt
printf '10 1\nnan nan\n' >expected
same out expected "points that are snapped"
printf '10.0000000001 1\n10.1 1\n' | run 0 map -s source.txt -t source.txt --snap 0.2
printf '10 1\n10 1\n' >expected
same out expected "points that are snapped far"
printf '1 1\n11 1\n' >p.txt
run 4 map -s source.txt -t source.txt -p p.txt --outside keep
close_to out p.txt 1e-12
run 1 map -s source.txt -t source.txt -p p.txt --outside fail
says 'p.txt:2: this point lies outside the cage (1 of 2 have no image), so nothing is written'

# The only copy of what is not carried is not overwritten, by whatever name; what is carried whole may be.
cp p.txt expected
for name in p.txt ./p.txt; do
    run 1 map -s source.txt -t source.txt -p "$name" -o p.txt
    says "$name:2: this point lies outside the cage"
    same p.txt expected "points over themselves"
done
cp three.geojson expected
mkdir -p folder
ln -s "$PWD/three.geojson" folder/link
ln three.geojson folder/hard
for to in three.geojson ./three.geojson folder/link folder/../three.geojson folder/hard; do
    for policy in null keep clip; do
        run 1 map -s source.txt -t target.txt --outside $policy --geojson three.geojson "$to"
        says 'three.geojson: would be overwritten, and not all of it can be carried: feature 0 (id "road"): '
        same three.geojson expected "$to"
    done
done
# shellcheck disable=SC2094 # that is the point
run 1 map -s source.txt -t target.txt --geojson - three.geojson <three.geojson
same three.geojson expected "through standard input"
echo "$point" >one.geojson
ln -s one.geojson one.link
run 0 map -s source.txt -t target.txt --geojson one.geojson one.link
[ -L one.link ] || complain "the link was replaced"
holds one.geojson '[12,6]'
echo "$point" >one.geojson
run 1 map -s source.txt -t target.txt --geojson one.geojson one.geojson --json=no/where
holds one.geojson '[10,5]'
ls ./*.part 2>/dev/null && complain "a temporary file was left behind"

# Depth costs memory only.
deep() { awk -v n="$1" -v a="$2" -v b="$3" 'BEGIN { for (i = 0; i < n; i++) printf "%s", a; printf "%s", b }'; }
{ printf '{"type":"Feature","geometry":null,"properties":'; deep 300000 '[' ''; deep 300000 ']' '}'; } | carry 0
same in.geojson out.geojson "deep lists"
{ deep 100000 '{"type":"GeometryCollection","geometries":[' "$point"; deep 100000 ']}' ''; } | carry 0
[ "$(tr -cd '[' <out.geojson | wc -c)" -eq 100001 ] || complain "deep collections"
deep 300000 '[' '' | carry 1
says 'in.geojson:1: the JSON ends early'

# What is no GeoJSON; the old result stays.
echo old >out.geojson
rejects() {
    carry 1
    says "libicc: in.geojson"
    says "$1"
    gives old
}
printf '{"type":"Point",\n"coordinates":[1,' | rejects ':2: the JSON ends early'
for bad in '{"type":"Point","coordinates":[1,1]}\n,' '\n{"type":"Point","coordinates":[1,1],}' '\n{"type":"Point","coordinates":[1,1,]}' \
    '\n{"type":"Point","coordinates":[01,1]}' '\n{"type":"Point","coordinates":[1.,1]}' '\n{"type":"Point","coordinates":[+1,1]}' \
    '\n{"type":"Point","coordinates":[1,NaN]}' '\n{"type":"Point","x":"\\x","coordinates":[1,1]}' '\n{"type":"Point","x":"\t","coordinates":[1,1]}' \
    '\n{"type":"Point" "coordinates":[1,1]}' '\n{"type":"Point","coordinates":[1,1}]' '\n{type:"Point","coordinates":[1,1]}' '\n[}' \
    '\n{"type":"Point","coordinates":[1,1],"x":"\\u12g4"}' '{"type":"Point","coordinates":[1,1]}\n,{"type":"Point","coordinates":[1,1]}'; do
    # shellcheck disable=SC2059 # the format is the text
    printf "$bad" | rejects ':2: '
done
printf '' | rejects ':1: the JSON ends early'
printf '{"coordinates":[1,1]}' | rejects 'a type is missing'
printf '[1,1]' | rejects 'a type is missing'
printf '{"type":"Circle","coordinates":[1,1]}' | rejects "'Circle' is no type of GeoJSON"
printf '{"type":"Feature","geometry":{"type":"Feature"}}' | rejects "'Feature' is no type of geometry"
printf '{"type":"Feature",\n"geometry":[]}' | rejects ":2: in this Feature something else stands where 'geometry' should be"
printf '{"type":"FeatureCollection","features":\n[null]}' | rejects ":2: in this FeatureCollection something else stands where 'features' should be"
printf '{"type":"FeatureCollection"}' | rejects "has no features"
printf '{"type":"Point"}' | rejects 'has no coordinates'
printf '{"type":"Point","coordinates":null}' | rejects 'has no coordinates'
printf '{"type":"Point","coordinates":[1,1],"coordinates":[2,2]}' | rejects "this Point has more than one member 'coordinates'"
printf '{"type":"Point","bbox":[1,2,3],"coordinates":[1,1]}' | rejects 'this bbox is not a list of 4 numbers, or 6'
for bad in '[1]' '[1,"a"]' '[1,null]' '[1e999,1]' '[1,1,"z"]' '[[1,1]]' '[1,1,[1]]' '{}'; do
    [ "$bad" = '{}' ] || printf '{"type":"Point","coordinates":%s}' "$bad" | rejects 'position 0, in a Point, is not'
    printf '{"type":"LineString","coordinates":[[0,0],%s]}' "$bad" | rejects 'position 1, in a LineString, is not'
done
printf '{"type":"LineString","coordinates":[1,1]}' | rejects 'position 0, in a LineString'
printf '{"type":"Polygon","coordinates":[[1,1],[2,2],[3,3]]}' | rejects 'position 0, in a Polygon'
finish
