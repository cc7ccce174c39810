#!/bin/sh
# One feature of a layer as a cage, layers and cages as sequences of GeoJSON, landmarks from QGIS; with ogr2ogr on the other
# side of the sequences.
# usage: test_chosen.sh TOOL SCRATCH
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages
run 0 map -s source.txt -t target.txt -p points.txt
cp out expected

ring() { sed -n '1,$p; 1h; ${x;p}' "$1" | awk -v ORS=, '{ print "[" $1 "," $2 "]" }' | sed 's/,$//'; }
feature() { # RING PROPERTIES
    printf '{"type":"Feature","properties":{%s},"geometry":{"type":"Polygon","coordinates":[[%s]]}' "$2" "$(ring "$1")"
}
{
    feature source.txt '"name":"Kent","code":7,"old":true' && printf ',"id":"a"}\n'
    feature target.txt '"name":"Essex","code":8,"old":false' && printf ',"id":2}\n'
    feature target.txt '"name":"Essex","code":9.5,"x=y":"a=b"' && printf '}\n'
} >lines.geojsonl
{ printf '{"type":"FeatureCollection","features":[' && paste -s -d , lines.geojsonl && printf ']}'; } >layer.geojson
sed "s/^/$(printf '\036')/" lines.geojsonl >separated.geojsons

# By property, whatever its type, and by id; the same from a list and from sequences.
for file in layer.geojson lines.geojsonl separated.geojsons; do
    for kent in name=Kent code=7 code=7.0 a id=a; do
        for essex in code=8 2 id=2 old=false x=y; do
            [ $essex != x=y ] || continue
            run 0 map -s "$file#$kent" -t "$file#$essex" -p points.txt
            same out expected "$file#$kent to $file#$essex"
        done
    done
done
run 0 map -s '-#name=Kent' -t target.txt -p points.txt <lines.geojsonl
same out expected 'from standard input'
run 2 map -s '-#name=Kent' -t target.txt <lines.geojsonl
run 1 map -s 'layer.geojson#name=Essex' -t target.txt -p points.txt
says 'libicc: layer.geojson#name=Essex: 2 of the 3 features have name "Essex"; exactly one must'
run 1 map -s 'layer.geojson#code=11' -t target.txt -p points.txt
says '0 of the 3 features have code "11"; exactly one must'
run 1 map -s 'layer.geojson#b' -t target.txt -p points.txt
says '0 of the 3 features have the id "b"; exactly one must'
run 1 map -s 'nowhere#name=Kent' -t target.txt -p points.txt
says 'libicc: nowhere#name=Kent: cannot be opened'
run 1 map -s 'source.txt#name=Kent' -t target.txt -p points.txt
says 'only GeoJSON and SVG have names of shapes; name "Kent" was asked for'
printf '{"type":"Polygon","coordinates":[[%s]]}' "$(ring source.txt)" >bare.json
run 1 map -s 'bare.json#name=Kent' -t target.txt -p points.txt
says 'there is no list of features to look for name "Kent" in'
run 0 map -s bare.json -t target.txt -p points.txt

# Shapes of SVG without ids, by number in the order of the file, whatever they are; an id that looks like one comes first.
polygon() { printf '<polygon points="%s"%s/>' "$(paste -s -d ' ' "$1")" "$2"; }
{ printf '<svg><g>\n' && polygon source.txt && printf '</g><rect width="3" height="2"/>' && polygon target.txt && printf '</svg>\n'; } >drawing.svg
run 0 map -s 'drawing.svg#1' -t 'drawing.svg#3' -p points.txt
same out expected 'shapes by number'
run 0 map -s '-#1' -t 'drawing.svg#3' -p points.txt <drawing.svg
same out expected 'from standard input'
run 0 info -s 'drawing.svg#2'
holds out 'cage        4 vertices'
for number in 0 4 01 +1 1.0 99999999999999999999999; do
    run 1 map -s "drawing.svg#$number" -t target.txt -p points.txt
    says "libicc: drawing.svg#$number: 0 of the 3 shapes have the id \"$number\"; exactly one must, or choose by number: FILE#1 to FILE#3"
done
run 1 info -s drawing.svg
says 'libicc: drawing.svg: 0 of the 3 shapes have the id or label "source"; exactly one must, or choose by number: FILE#1 to FILE#3'
sed 's/<rect/<rect id="3"/' drawing.svg >numbered.svg
run 0 info -s 'numbered.svg#3'
holds out 'cage        4 vertices'
{ printf '<svg>' && polygon source.txt && printf '</svg>'; } >lone.svg
run 1 info -s 'lone.svg#b'
says 'libicc: lone.svg#b: the only shape does not have the id "b"; leave #.. out'

# A layer as a sequence: each text is carried as it would be in a list, and what is between them stays.
point() { printf '{"type":"Feature","properties":{"n":%s},"geometry":{"type":"Point","coordinates":[%s,%s]}}' "$3" "$1" "$2"; }
{
    point 1 1 1 && printf '\n\n' && point 2.5 3.25 2 && printf '\r\n'
    printf '{"type":"LineString","coordinates":[[1,1],[1,9]]}\n'
} >in.geojsonl
run 0 map -s source.txt -t target.txt --geojson --tolerance 9 in.geojsonl out.geojsonl
# shellcheck disable=SC2046 # four words
set -- $(head -n 2 expected)
{
    point "$1" "$2" 1 && printf '\n\n' && point "$3" "$4" 2 && printf '\r\n'
} >head.expected
head -c "$(wc -c <head.expected)" out.geojsonl >head.got
same head.got head.expected 'a sequence that is carried along'
[ "$(wc -l <out.geojsonl)" -eq 4 ] || complain "the lines of a sequence are others: $(cat out.geojsonl)"
sed "s/^{/$(printf '\036')&/" in.geojsonl >in.geojsons
run 0 map -s source.txt -t target.txt --geojson --tolerance 9 in.geojsons out.geojsons
tr -d '\036' <out.geojsons >got
same got out.geojsonl 'with record separators'
run 2 map -s source.txt -t target.txt --geojson in.geojsonl out.geojson
[ ! -e out.geojson ] || complain "a sequence was written as GeoJSON"
sed 's/\[2.5,/[99,/' in.geojsonl >far.geojsonl
run 4 map -s source.txt -t target.txt --geojson --json=report.json far.geojsonl out.geojsonl
tr -d ' \n' <report.json | grep -q '"not_carried":\[{"feature":1,' || complain "the feature of a sequence is not named: $(cat report.json)"
if command -v ogr2ogr >/dev/null; then
    for rs in NO YES; do
        rm -f ogr.geojsonl
        ogr2ogr -f GeoJSONSeq -lco RS=$rs -lco COORDINATE_PRECISION=15 ogr.geojsonl layer.geojson || complain "ogr2ogr writes no sequence"
        run 0 map -s 'ogr.geojsonl#name=Kent' -t 'ogr.geojsonl#code=8' -p points.txt
        same out expected "what ogr2ogr writes with RS=$rs"
    done
    run 0 map -s source.txt -t target.txt --geojson --tolerance 9 in.geojsons out.geojsons
    ogr2ogr -f CSV -lco GEOMETRY=AS_XY -where 'n = 2' ogr.csv GeoJSONSeq:out.geojsons 2>log || complain "ogr2ogr does not read it: $(cat log)"
    tail -n 1 ogr.csv | tr ',' ' ' | cut -d ' ' -f 1,2 >got
    sed -n 2p expected >second
    close_to got second 1e-12
fi

# Landmarks of QGIS: the source's columns come second, what is not enabled is left out.
printf '0 0\n4 0\n4 4\n0 4\n' >square.txt
printf '4 0\n4 4\n0 4\n0 0\n' >turned.txt
printf '0 0 4 4\n4 0 0 4\n' >pairs.txt
run 0 match -s square.txt -t turned.txt --landmarks pairs.txt -o a.txt --target-output b.txt
qgis='#CRS: GEOGCRS["WGS 84", x]\n'
rows='4,4,0,0,1,0,0,0\n9,9,4,4,0,0,0,0\n\n0, 4, 4.0 ,0,1,-0.5,1e-3,0.1\r\n'
# shellcheck disable=SC2059 # formats
for form in "${qgis}mapX,mapY,sourceX,sourceY,enable,dX,dY,residual\n$rows" "mapX,mapY,pixelX,pixelY,enable\n$rows" \
    "\357\273\277${qgis}mapX,mapY,sourceX,sourceY,enable,dX,dY,residual\r\n$rows"; do
    printf "$form" >gcp.points
    run 0 match -s square.txt -t turned.txt --landmarks gcp.points -o a2.txt --target-output b2.txt
    same a2.txt a.txt 'landmarks of QGIS'
    same b2.txt b.txt 'landmarks of QGIS'
done
printf 'mapX,mapY,pixelX,pixelY,enable\n4,4,0,0,1\n4,x,0,0,1\n' >gcp.points
run 1 match -s square.txt -t turned.txt --landmarks gcp.points
says "libicc: gcp.points:3: 'x,0,0,1' is not a finite number"
printf 'mapX,mapY,pixelX,pixelY,enable\n4,4,0,0\n' >gcp.points
run 1 match -s square.txt -t turned.txt --landmarks gcp.points
says 'libicc: gcp.points:2: a row begins with mapX, mapY, sourceX, sourceY, enable'
finish
