#!/bin/sh
# What --triangulation writes, applied by those who read it: PROJ's own command to points, GDAL to a layer of a GeoPackage
# and to a GeoTIFF. All of it agrees with what the command itself makes of them.
# usage: test_proj.sh TOOL SCRATCH
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
for program in cct ogr2ogr gdalwarp; do
    if ! command -v "$program" >/dev/null; then
        echo "skipped: $program is missing"
        exit 77
    fi
done

# In Swiss coordinates, so that what gets lost of 2.6 million shows.
east=2600000 north=1200000
make_cages
for file in source target points; do
    awk -v east="$east" -v north="$north" '{ printf "%.17g %.17g\n", east + $1, north + $2 }' "$file.txt" >"$file.geo"
done
run 0 map -s source.geo -t target.geo -p points.geo --triangulation mesh.json \
    --source-crs EPSG:2056 --target-crs 'a "local" system'
cp out images.geo
holds mesh.json '"input_crs": "EPSG:2056"'
holds mesh.json '"output_crs": "a \"local\" system"'
run 2 map -s source.geo -t target.geo -p points.geo --source-crs EPSG:2056
says '--source-crs needs --triangulation'
run 0 map -s source.geo -t target.geo -p points.geo --triangulation mesh.json \
    --source-crs EPSG:2056 --target-crs EPSG:2056
tin="+proj=tinshift +file=$PWD/mesh.json"

# There and back; what is printed has nine digits behind the point.
plane() {
    awk '{ print $1, $2 }'
}
# shellcheck disable=SC2086 # two words
cct -d 9 -z 0 -t 0 $tin points.geo | plane >theirs
close_to theirs images.geo 5e-9
# shellcheck disable=SC2086
cct -I -d 9 -z 0 -t 0 $tin images.geo | plane >theirs
close_to theirs points.geo 5e-9

# A layer: every vertex; numbers of 2^53 and more, names and the reference system stay.
cat >layer.geojson <<'EOF'
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::2056"}},
 "features": [
  {"type": "Feature", "properties": {"parcel": 9007199254740993, "name": "corner"}, "geometry": {"type": "Polygon",
   "coordinates": [[[2600001, 1200001], [2600003, 1200001], [2600003, 1200004], [2600001, 1200001]]]}},
  {"type": "Feature", "properties": {"parcel": 2, "name": "well"}, "geometry": {"type": "Point",
   "coordinates": [2600007, 1200002]}}]}
EOF
ogr2ogr layer.gpkg layer.geojson || complain "no GeoPackage"
ogr2ogr -a_srs EPSG:2056 -ct "$tin" moved.gpkg layer.gpkg || complain "ogr2ogr failed"
ogr2ogr -lco COORDINATE_PRECISION=9 moved.geojson moved.gpkg
ogr2ogr -lco COORDINATE_PRECISION=9 -ct "$tin" -a_srs EPSG:2056 direct.geojson layer.geojson
run 0 map -s source.geo -t target.geo --tolerance 1000 --geojson layer.geojson own.geojson
numbers() {
    grep -o '"coordinates": *\[[^a-z}]*' "$1" | tr -cs '0-9.\n' ' ' | tr -s ' ' '\n' | grep .
}
numbers own.geojson >ours
[ "$(wc -l <ours)" -eq 10 ] || complain "not all coordinates are in our result"
for file in moved direct; do
    numbers "$file.geojson" >theirs
    close_to theirs ours 5e-9
    holds "$file.geojson" '9007199254740993'
    holds "$file.geojson" 'EPSG::2056'
done
ogr2ogr -a_srs EPSG:2056 -ct "+proj=pipeline +step +inv $tin" back.gpkg moved.gpkg || complain "no way back"
ogr2ogr -lco COORDINATE_PRECISION=6 back.geojson back.gpkg
numbers layer.geojson >given
numbers back.geojson >theirs
close_to theirs given 1e-6

# A system with latitude first: GDAL takes the pipeline that the command names, and then the longitude comes out first, as
# GeoJSON has it. What is not known is said; with east first there is nothing to say.
printf '0 0\n100 0\n100 100\n0 100\n' >sheet.txt
printf '8 47\n9 47\n9 48\n8 48\n' >degrees.txt
printf '50 25\n' >place.txt
run 0 map -s sheet.txt -t degrees.txt -p place.txt --triangulation degrees.json --target-crs EPSG:4326
grep -q 'degrees.json: x comes first, but in EPSG:4326 latitude or northing does' err || complain "no word of axes: $(cat err)"
pipeline=$(sed -n "s/.*-ct needs '\([^']*\)'.*/\1/p" err)
printf '{"type": "Point", "coordinates": [50, 25]}\n' >place.geojson
ogr2ogr -a_srs 'ENGCRS["s",EDATUM["s"],CS[Cartesian,2],AXIS["x",east],AXIS["y",north],LENGTHUNIT["metre",1]]' \
    place.gpkg place.geojson
ogr2ogr -a_srs EPSG:4326 -ct "$pipeline" there.gpkg place.gpkg || complain "GDAL does not take: $pipeline"
ogr2ogr -lco COORDINATE_PRECISION=9 there.geojson there.gpkg
numbers there.geojson | tail -n 2 >theirs
printf '8.5\n47.25\n' >expected
close_to theirs expected 1e-9
run 0 map -s sheet.txt -t degrees.txt -p place.txt --triangulation degrees.json --source-crs EPSG:3035 --target-crs EPSG:4326
grep -q 'pipeline +step +proj=axisswap +order=2,1 +step +proj=tinshift' err || complain "no swap before: $(cat err)"
run 0 map -s sheet.txt -t degrees.txt -p place.txt --triangulation degrees.json --target-crs 'a local system'
grep -q 'libicc does not know the order of the axes of a local system' err || complain "not said: $(cat err)"
for crs in EPSG:2056 EPSG:32632 EPSG:3857 OGC:CRS84; do
    run 0 map -s sheet.txt -t degrees.txt -p place.txt --triangulation degrees.json --target-crs $crs
    [ ! -s err ] || complain "words about $crs: $(cat err)"
done

# A picture of 20 pixels a metre: GDAL's georeferenced one, and ours with cages in pixels.
awk 'BEGIN {
    print "ncols 320\nnrows 280\nxllcorner 2599998\nyllcorner 1199999\ncellsize 0.05"
    for (y = 0; y < 280; y++) {
        for (x = 0; x < 320; x++)
            printf "%d ", 128 + 99 * sin(x / 9) * cos(y / 13)
        print ""
    }
}' >picture.asc
gdal_translate -q -ot Byte -a_srs EPSG:2056 picture.asc picture.tif
gdal_translate -q -of PNG picture.tif picture.png
gdalwarp -q -r bilinear -ct "$tin" -t_srs EPSG:2056 -te 2599998 1199999 2600014 1200013 -ts 320 280 -dstnodata 0 \
    picture.tif warped.tif || complain "gdalwarp failed"
for side in source target; do
    awk -v east="$east" -v north="$north" '{ print ($1 - east + 2) * 20, (north + 13 - $2) * 20 }' "$side.geo" \
        >"$side.pixels"
done
run 0 warp -s source.pixels -t target.pixels --background 000000 picture.png own.png
gdal_translate -q -of XYZ warped.tif theirs
gdal_translate -q -of XYZ own.png ours
# They differ along the rim, where only the command mixes in what is outside; elsewhere by the rounding of grey values.
paste -d ' ' theirs ours | awk '
    $3 > 0 && $6 > 0 { n++; d = $3 - $6; if (d < -2 || d > 2) far++ }
    END { exit !(n > 41000 && far < .01 * n) }' || complain "gdalwarp and warp make different pictures"
finish
