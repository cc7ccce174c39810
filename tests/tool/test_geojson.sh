#!/bin/sh
# map --geojson: every type of geometry, lines that bend, parts without an image, what is no GeoJSON.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

carry() { # EXIT OPTION...: the geometry on standard input
    expected=$1
    shift
    cat >in.geojson
    run "$expected" map -s source.txt -t target.txt --geojson "$@" in.geojson out.geojson
}
# The coordinates of the result, two a line.
coordinates() {
    tr -d '\n' <out.geojson | sed 's/.*"coordinates": //; s/}$//' | tr -s '[], ' '\n' | grep . | paste -d ' ' - -
}

# Points go where `map` takes them; the rest of the file stays, bounding boxes do not.
printf '{"type":"FeatureCollection","bbox":[0,0,1,1],"features":[{"type":"Feature","id":"a","properties":
    {"name":"\\u00e9 \\"x\\"\\n","share":0.1,"list":[1,null,true,{}]},"geometry":{"type":"Point","coordinates":[2.5,3.25]}},
    {"type":"Feature","properties":null,"geometry":null}]}' | carry 0
for part in '"id": "a"' '"name": "é \"x\"\u000a"' '"share": 0.1,' '"list": [1, null, true' '"properties": null, "geometry": null'; do
    holds out.geojson "$part"
done
grep -q bbox out.geojson && complain "a bounding box that is wrong now"
printf '2.5 3.25\n' | run 0 map -s source.txt -t target.txt
read -r x y <out
holds out.geojson "[$x, $y]"
printf '{"type":"MultiPoint","coordinates":[[0,0,440],[10,0,-1.5]]}' | carry 0
holds out.geojson '[[0, 0, 440], [12, 1, -1.5]]'

# The cage as a polygon becomes the other cage, corner by corner.
polygon='[[0,0],[10,0],[10,5],[5,5],[5,10],[0,10],[0,0]]'
printf '{"type":"Polygon","coordinates":[%s]}' "$polygon" | carry 0
coordinates >got
sed -n '1,6p;$a\0 0' target.txt >expected
close_to got expected 1e-12

# A line bends; a finer tolerance takes more vertices, and all of them are on the image of the line.
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

# Through the notch of the L a line falls apart where it leaves the cage.
echo '{"type":"LineString","coordinates":[[4,9],[9,4]]}' | carry 4
holds err "libicc: 0 of 2 positions have no image; 1 geometries are cut or empty"
holds out.geojson '"type": "MultiLineString"'
coordinates >got
run 0 map -s source.txt -t target.txt -p got -i
awk '$1 > 5.01 && $2 > 5.01 { bad = 1 } $1 > 4.99 && $1 < 5.01 { near = 1 } END { exit bad || !near }' out ||
    complain "the line ends somewhere else"
printf '{"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[8,8]},{"type":"Polygon","coordinates":[[[1,1],
    [9,1],[9,9],[1,1]]]},{"type":"MultiPolygon","coordinates":[[%s],[[[8,8],[9,9],[8,9],[8,8]]]]},{"type":"MultiPoint",
    "coordinates":[[8,8],[0,0]]},{"type":"MultiLineString","coordinates":[[[8,8],[9,9]],[[0,0],[10,0]]]}]}' "$polygon" |
    carry 4 --json=report.json
holds err "9 of 22 positions have no image; 5 geometries are cut or empty"
holds report.json '"without_image": 9'
for part in '"Point", "coordinates": []' '"Polygon", "coordinates": []' '"MultiPoint", "coordinates": [[0, 0]]'; do
    holds out.geojson "$part"
done
printf '{"type":"LineString","coordinates":[]}' | carry 0

# What is no GeoJSON; the old result stays.
echo old >out.geojson
rejects() {
    carry 1
    says "libicc: in.geojson"
    says "$1"
    holds out.geojson old
}
printf '{"type":"Point",\n"coordinates":[1,' | rejects ':2: the JSON ends early'
printf '{"coordinates":[1,1]}' | rejects 'a type is missing'
printf '[1,1]' | rejects 'a type is missing'
printf '{"type":"Circle","coordinates":[1,1]}' | rejects "'Circle' is no type"
printf '{"type":"Point"}' | rejects 'has no coordinates'
for bad in '[1]' '[1,"a"]' '[1,null]' '[1e999,1]' '[1,1,"z"]'; do
    printf '{"type":"Point","coordinates":%s}' "$bad" | rejects 'position 0, in a Point, is not'
    printf '{"type":"LineString","coordinates":[[0,0],%s]}' "$bad" | rejects 'position 1, in a LineString, is not'
done
printf '{"type":"LineString","coordinates":[1,1]}' | rejects 'position 0, in a LineString'
finish
