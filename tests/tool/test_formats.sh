#!/bin/sh
# The same cage in every format is the same domain, to the last bit.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

# same_domain FILE: the file holds the cage of source.txt.
run 0 map -s source.txt -t target.txt -p points.txt
cp out expected
same_domain() {
    run 0 map -s "$1" -t target.txt -p points.txt
    same out expected "$1"
}

printf '0 0\r\n10 0\r\n10 5\r\n5 5\r\n5 10\r\n0 10\r\n' >crlf.txt
printf '\357\273\2770 0\n10 0\n10 5\n5 5\n5 10\n0 10' >bom.txt
printf '# an L\n\n  0\t0 \n+1e1 0.0\n10. 5\n\n5 .5e+1\n5 10\n0 1.0E1\n0 0\n\n\n' >odd.txt
printf 'POLYGON ((0 0, 10 0, 10 5, 5 5, 5 10, 0 10, 0 0))' >a.wkt
printf 'SRID=4326; Polygon((0 0,10 0,10 5,5 5,5 10,0 10))\n' >b.wkt
printf '{"type":"Polygon","coordinates":[[[0,0],[10,0],[10,5],[5,5],[5,10],[0,10],[0,0]]]}' >polygon.json
printf '{"type":"MultiPolygon","coordinates":[[[[0,0],[10,0],[10,5],[5,5],[5,10],[0,10],[0,0]]]]}' >multi.json
printf '{"type":"LineString","coordinates":[[0,0],[10,0],[10,5],[5,5],[5,10],[0,10],[0,0]]}' >line.json
printf '{"type":"Feature","properties":null,"geometry":%s}' "$(cat polygon.json)" >feature.json
printf '{"type":"FeatureCollection","features":[%s]}' "$(cat feature.json)" >collection.json
other='{"type":"Polygon","coordinates":[[[0,0],[12,1],[12,6],[6.5,7],[5,12],[-1,10]]]}'
printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"role":"target"},"geometry":%s},
    {"type":"Feature","properties":{"role":"source"},"geometry":%s}]}' "$other" "$(cat polygon.json)" >roles.json
printf '<svg xmlns="x"><polygon points="0,0 10,0 10,5 5,5 5,10 0,10"/></svg>' >polygon.svg
printf '<?xml version="1.0"?>\n<!-- <path d="M0 0"/> -->\n<svg><g id="a>b"><path\n d="M0 0 L10 0 10,5\nL5 5 5 10 0 10Z"/></g></svg>' >path.svg
printf "<svg><path d='m0,0 h10v5l-5 0 0,5-5-0z'/></svg>" >relative.svg
printf '<svg><path d="M0,0H10V5H5V10H0V0z"/></svg>' >axes.svg
printf '<svg><path id="other" d="M0 0L1 0 1 1z"/><path id="source" d="M0,0H10V5H5V10H0z"/><g transform="scale(2)">
    <path id="none" d="M0 0L1 0 1 1z"/></g><polygon id="target" points="0 0 12 1 12 6 6.5 7 5 12 -1 10"/></svg>' >roles.svg
printf 'MULTIPOLYGON(((0 0, 10 0, 10 5, 5 5, 5 10, 0 10, 0 0)));' >one.wkt
printf '<svg><path id="p" d="M0 0L1 0 1 1z"/><path id="q" inkscape:label="source" d="M0,0H10V5H5V10H0z"/></svg>' >label.svg

printf '0,0\n10,0\n10,5\n5,5\n5,10\n0,10\n' >comma.csv
printf '\357\273\277"Y";"X"\r\n"0";"0"\r\n0; 10 \r\n;\r\n5;10\r\n5;5\r\n10;5\r\n10;0\r\n' >turned.csv
printf 'id,LAT,lon,name\n1,0,0,"a, b"\n2,0,10,\n3,5,10,\n\n# more\n4,5,5,c\n5,10,5,d\n6,1e1,0,e\n' >extra.csv
printf 'a,b\n0,0\n10,0\n10,5\n5,5\n5,10\n0,10' >names.csv
printf 'POINT_X,POINT_Y\n0,0\n10,0\n10,5\n5,5\n5,10\n0,10\n' >arc.csv

for file in line.json comma.csv turned.csv extra.csv names.csv arc.csv crlf.txt bom.txt odd.txt a.wkt b.wkt polygon.json multi.json feature.json collection.json roles.json \
    polygon.svg path.svg relative.svg axes.svg roles.svg one.wkt label.svg; do
    same_domain "$file"
done
for file in roles.json roles.svg; do
    run 0 map -s "$file" -t "$file" -p points.txt
    same out expected "both cages from $file"
done

# Points, too.
(echo 'y,x,name' && awk '{ print $2 "," $1 ",p" }' points.txt) >points.csv
run 0 map -s source.txt -t target.txt -p points.csv
same out expected 'points with commas'

# Heights and measures are left out, and this is told.
printf 'POLYGON Z ((0 0 1, 10 0 1, 10 5 1, 5 5 1, 5 10 1, 0 10 1, 0 0 1))' >z.wkt
printf 'Polygonzm((0 0 1 2,10 0 1 2,10 5 1 2,5 5 1 2,5 10 1 2,0 10 1 2))' >zm.wkt
printf 'SRID=1;MULTIPOLYGON M (((0 0 9, 10 0 9, 10 5 9, 5 5 9, 5 10 9, 0 10 9, 0 0 9)))' >m.wkt
printf 'POLYGON((0 0 1, 10 0 1, 10 5 1, 5 5 1, 5 10 1, 0 10 1))' >plain.wkt
printf '{"type":"Polygon","coordinates":[[[0,0,1],[10,0],[10,5,1],[5,5],[5,10],[0,10],[0,0,1]]]}' >z.json
for file in z.wkt zm.wkt m.wkt plain.wkt z.json; do
    same_domain "$file"
    holds err "libicc: $file: heights are left out"
done
run 0 map -s - -t target.txt -p points.txt <source.txt
same out expected "source from standard input"

# A curve is 16 edges, at the same parameters whatever its size; S mirrors the handle of C.
printf '<svg><path d="M0 0C0 -4 4 -4 4 0S8 4 8 0L8 9 0 9"/></svg>' >short.svg
printf '<svg><path d="m0 0c0-4 4-4 4 0c0 4 4 4 4 0l0 9-8 0z"/></svg>' >long.svg
printf '<svg><path d="M0 0Q2 -4 4 0T8 0L8 9 0 9"/></svg>' >quadratic.svg
printf '2 4\n6 5\n' >few.txt
run 0 encode -s short.svg -p few.txt
cp out expected
run 0 encode -s long.svg -p few.txt
same out expected "S and C"
for file in short.svg quadratic.svg; do
    run 0 info -s "$file"
    holds out "cage        35 vertices"
done
finish
