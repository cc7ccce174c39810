#!/bin/sh
# Maps from control points alone: every format of points gives the same map, which goes through them; the table of
# residuals; layers, pictures and triangulations; pixel rows that run down; figures by pins; how mistakes are told.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# A sheet of 1000 x 800 pixels, a little warped, and one map of it in every format.
awk 'BEGIN { srand(7); for (j = 0; j < 4; j++) for (i = 0; i < 5; i++) {
    x = 40 + 230 * i + int(40 * rand()); y = 30 + 240 * j + int(40 * rand())
    printf "%d %d %.3f %.3f\n", x, -y, 5000 + 2.5 * x + 0.1 * y + 20 * sin(x / 300 + y / 500), 9000 - 2.4 * y + 0.2 * x + 15 * cos(y / 350) } }' >points.txt
awk '{ print $1, $2 }' points.txt >from.txt
awk '{ print $3, $4 }' points.txt >to.txt
awk '{ print $1, -$2 }' points.txt >pixels.txt
{
    echo '#CRS: EPSG:25832'
    echo 'mapX,mapY,sourceX,sourceY,enable,dX,dY,residual'
    awk -v OFS=, '{ print $3, $4, $1, $2, 1, 0, 0, 0 }' points.txt
    echo '1,2,3,4,0,0,0,0'
} >sheet.points
awk 'BEGIN { print "name,longitude,latitude,col,row" } { print "p" NR "," $3 "," $4 "," $1 "," $2 }' points.txt >sheet.csv
awk 'BEGIN { printf "{\"type\": \"FeatureCollection\", \"features\": [" }
    { printf "%s\n{\"type\": \"Feature\", \"properties\": {\"id\": %d}, \"geometry\": {\"type\": \"LineString\", \"coordinates\": [[%s, %s], [%s, %s]]}}", (NR > 1 ? "," : ""), NR, $1, $2, $3, $4 }
    END { print "]}" }' points.txt >links.geojson
awk '{ printf "-gcp %s %s %s %s ", $1, -$2, $3, $4 } END { print "in.tif" }' points.txt >gcps.txt
awk 'BEGIN { print "<VRTDataset><GCPList>" } { printf "<GCP Id=\"%d\" Pixel=\"%s\" Line=\"%s\" X=\"%s\" Y=\"%s\"/>\n", NR, $1, -$2, $3, $4 }
    END { print "</GCPList></VRTDataset>" }' points.txt >sheet.vrt
awk 'BEGIN { printf "{\"type\": \"Annotation\", \"body\": {\"type\": \"FeatureCollection\", \"features\": [" }
    { printf "%s{\"type\": \"Feature\", \"properties\": {\"resourceCoords\": [%s, %s]}, \"geometry\": {\"type\": \"Point\", \"coordinates\": [%s, %s]}}\n", (NR > 1 ? "," : ""), $1, -$2, $3, $4 }
    END { print "]}}" }' points.txt >annotation.json

for file in points.txt sheet.points sheet.csv links.geojson; do
    run 0 fit "$file" -p from.txt
    close_to out to.txt 1e-6
    cp out "images.${file##*.}"
    [ ! -s err ] || complain "$file: $(cat err)"
done
same images.txt images.points 'QGIS'
same images.txt images.csv 'CSV'
same images.txt images.geojson 'links'
# Pixel rows that run down are turned over, and points keep the y of the file.
for file in gcps.txt sheet.vrt annotation.json; do
    run 0 fit "$file" -p pixels.txt
    close_to out to.txt 1e-6
    same out images.txt "$file"
    holds err 'y points down in the source only'
done
run 0 fit points.txt --inverse -o back.txt <to.txt
close_to back.txt from.txt 1e-6
printf '500 -400\n' >middle.txt
run 0 fit points.txt -p middle.txt
cp out middle.out
run 0 fit sheet.vrt --inverse -p middle.out
printf '500 400\n' >expected
close_to out expected 1e-6

# The table: a summary, then a row for each point. A mistake of 60 stands out where the point is left out, not in the map.
run 0 fit sheet.points
holds out 'points      20, from control points of QGIS; 1 disabled'
holds out 'one-to-one  yes, certified; nothing folded'
grep -qE '^accuracy +[0-9.e-]+, root mean square' out || complain "no accuracy: $(cat out)"
awk '/^point /{ on = 1; next } on { n++; if (NF != 5 || $2 != n + 2 || $5 > 1e-6 || $3 <= 0 || $4 <= 0) bad = 1 } END { exit bad || n != 20 }' out ||
    complain "the table is wrong: $(cat out)"
awk 'NR == 8 { $3 += 60 } { print }' points.txt >wrong.txt
run 0 fit wrong.txt
[ "$(grep -c 'point 8 (line 8)' out)" -eq 2 ] || complain "the mistake is not named: $(head -n 6 out)"
run 0 fit sheet.csv --residuals -p from.txt -o images.txt
holds out 'p20'
run 0 fit sheet.points --json
holds out '"format": "control points of QGIS"'
holds out '"certified": true'
[ "$(grep -c '"left_out"' out)" -eq 21 ] || complain 'the report does not list 20 points'

# Few points: a shift, a similarity, an affine map; tolerances smooth, unless all are to be exact.
printf '1 1 11 21\n' >one.txt
printf '2 3\n' >at.txt
run 0 fit one.txt -p at.txt --box 0,0,4,4
printf '12 23\n' >expected
close_to out expected 1e-9
printf '0 0 1 1\n1 0 1 3\n' >two.txt
run 0 fit two.txt -p at.txt --box 0,0,4,4
printf '%s\n' '-5 5' >expected
close_to out expected 1e-9
printf '0 0 1 1\n2 0 5 1\n0 4 1 3\n' >three.txt
run 0 fit three.txt -p at.txt
printf '5 2.5\n' >expected
close_to out expected 1e-9
awk '{ print $0, 5 }' points.txt >tolerant.txt
run 0 fit tolerant.txt --exact -p from.txt
close_to out to.txt 1e-6
run 0 fit tolerant.txt
run 0 fit points.txt --smooth=1000 -p from.txt

# Frames: a box and a margin make the map reach farther; what lies outside has no image.
printf '500 -400\n3000 -400\n' >far.txt
run 4 fit points.txt -p far.txt --margin 0.1
holds err '1 of 2 points have no image: 1 outside the frame (--box or --margin makes the frame larger)'
run 0 fit points.txt -p far.txt --margin 0.1 --box 0,-800,3000,0
run 1 fit points.txt -p far.txt --margin 0.1 --outside fail
says 'far.txt:2: this point lies outside the frame'

# Layers and triangulations. The system of the target is that of the file.
awk 'BEGIN { printf "{\"type\": \"MultiPoint\", \"coordinates\": [" } { printf "%s[%s, %s]", (NR > 1 ? ", " : ""), $1, $2 } END { print "]}" }' points.txt >layer.geojson
run 0 fit sheet.points --geojson layer.geojson moved.geojson --json=report.json --plot sheet.svg
holds report.json '"residuals": ['
[ -s sheet.svg ] || complain 'no drawing'
grep -o '\[[-0-9.e]*, [-0-9.e]*\]' moved.geojson | tr -d '[],' >out
close_to out to.txt 1e-6
run 0 fit sheet.points --triangulation sheet.json
holds sheet.json '"output_crs": "EPSG:25832"'
[ ! -s out ] || complain 'a table beside the triangulation'
run 0 fit sheet.points --triangulation sheet.json --target-crs EPSG:3857 --residuals --fallback nearest_side
holds sheet.json '"fallback_strategy": "nearest_side"'
holds sheet.json '"output_crs": "EPSG:3857"'
holds out 'accuracy'

# A scan is brought into the coordinates of the target; a world file tells where it lies. Pixels at the points agree.
{
    echo 'P2 1000 800 255'
    awk 'BEGIN { for (y = 0; y < 800; y++) { for (x = 0; x < 1000; x++) printf "%d ", 20 + 0.1 * x + 0.15 * y; print "" } }'
} >scan.pgm
run 0 fit sheet.points --rectify scan.pgm flat.pam
holds err 'flat.pmw says where they lie, in EPSG:25832'
run 0 fit sheet.vrt --rectify scan.pgm flat.pgm --resolution 5 --background ffffff
# The raster of a PGM: its bytes behind the third line, 16 a row of od.
sed -n 1,3p flat.pgm | tr '\n' ' ' | awk '{ print $2, $3 }' >size
tail -c "$(awk '{ print $1 * $2 }' size)" flat.pgm | od -An -v -tu1 | tr -s ' \n' '\n' | sed '/^$/d' >bytes
awk 'FILENAME == "size" { w = $1; next } FILENAME == "flat.pmw" { world[++n] = $1; next } FILENAME == "bytes" { grey[m++] = $1; next }
    $1 > 990 { next } # half covered
    { c = int(($3 - world[5]) / 5 + 0.5); r = int((world[6] - $4) / 5 + 0.5); d = grey[r * w + c] - (20 + 0.1 * $1 - 0.15 * $2)
      if (d > 3 || d < -3) { print "FAILED at", $0, d; bad = 1 } }
    END { exit bad || world[1] != 5 || world[4] != -5 || grey[0] != 255 }' size flat.pmw bytes points.txt ||
    complain 'the rectified scan is not at its place'
run 1 fit points.txt --rectify scan.pgm out.pgm --resolution 1e-9
says 'choose their size by --resolution'
awk 'NR == 4 { $1 = 1200 } { print }' points.txt >beyond.txt
run 1 fit beyond.txt --rectify scan.pgm out.pgm
says 'beyond.txt:4: this point is not in the picture of 1000 x 800 pixels'
run 2 fit sheet.points --resolution 5
says '--resolution goes with --rectify'

# A figure by pins: its outline is free. Its picture goes along.
printf '%s\n' '40 0' '55 0' '55 70' '65 70' '65 0' '80 0' '85 110' '125 110' '125 125' '82 128' '60 175' '38 128' '-5 125' '-5 110' '35 110' >figure.txt
printf '%s\n' '48 5 48 5' '72 5 72 5' '60 100 60 100' '60 150 60 150' '118 117 102 145' '2 117 18 145' >pins.txt
awk '{ print $1, $2 }' pins.txt >from.txt
awk '{ print $3, $4 }' pins.txt >to.txt
run 0 fit pins.txt --outline figure.txt -p from.txt
close_to out to.txt 1e-6
run 0 fit pins.txt --outline figure.txt --reach 10
holds out 'one-to-one  yes, certified; all points are at their places'
{
    echo 'P2 130 180 255'
    awk 'BEGIN { for (i = 0; i < 130 * 180; i++) print i % 251 }'
} >figure.pgm
run 0 fit pins.txt --outline figure.txt --warp figure.pgm posed.pgm --background 000000
[ -s posed.pgm ] || complain 'no picture'
run 1 fit sheet.vrt --warp figure.pgm posed.pgm
says '--rectify'

# Mistakes are told: the file and the line, and what to do.
printf '0 0 1 1\n1 0 2 1\nx 1 1 2\n' >bad.txt
run 1 fit bad.txt
says "bad.txt:3: 'x' is not a finite number"
: >empty.txt
run 1 fit empty.txt
says 'empty.txt: there are no control points'
printf 'mapX,mapY,sourceX,sourceY,enable\n1,2,3,4,0\n' >disabled.points
run 1 fit disabled.points
says 'all of them are disabled'
printf '0 0 1 1\n5 0 6 1\n0 5 1 6\n5 0 7 7\n' >twice.txt
run 1 fit twice.txt
says 'twice.txt:4: '
run 1 fit nowhere.points
says 'nowhere.points'
run 1 map -s sheet.points
says "'libicc fit sheet.points' makes a map from it alone"
run 1 map -s links.geojson
says "'libicc fit links.geojson'"
run 1 check -s sheet.vrt
says "'libicc fit sheet.vrt'"
run 1 check -s annotation.json
says "'libicc fit annotation.json'"
run 2 fit
says 'usage: libicc fit'
run 2 fit sheet.points more
says "'more' is one argument too many"
run 2 fit sheet.points --geojson in.geojson
says '--geojson needs two files, IN and OUT, after POINTS'
run 2 fit sheet.points --box 0,0,1
says '--box must be X0,Y0,X1,Y1'
run 2 fit sheet.points --reach 3
says '--reach goes with --outline'
run 2 fit sheet.points --exact --smooth
says '--exact and --smooth exclude each other'
run 2 fit sheet.points --residuals -p far.txt
says 'use -o FILE'
run 2 fit points.txt -p far.txt -o points.txt
says '--output would be written over an input'
run 2 fit points.txt --geojson layer.geojson out.txt
says "'out.txt' is a name for text"

# Vertices of a target may slide along their walls.
awk 'BEGIN { for (i = 0; i <= 10; i++) print i / 5, 0; for (i = 1; i < 5; i++) print 2, i / 5
    for (i = 0; i <= 10; i++) print 2 - i / 5, 1; for (i = 1; i < 5; i++) print 0, 1 - i / 5 }' >source.txt
awk '($1 == 0 || $1 == 2) && $2 > 0 && $2 < 1 { print "slide"; next } $2 == 1 { print $1, 1 - 0.35 * (1 - $1 / 2); next } { print }' source.txt >target.txt
run 0 check -s source.txt -t target.txt
holds out 'one-to-one: yes, certified'
awk '($1 == 0 || $1 == 2) && $2 > 0 && $2 < 1' source.txt >walls.txt
run 0 map -s source.txt -t target.txt -p walls.txt
paste -d ' ' walls.txt out | awk '{ d = $1 - $3; if (d < -1e-9 || d > 1e-9 || $4 <= 0 || $4 >= 1) bad = 1 } END { exit bad || NR != 8 }' ||
    complain "vertices leave their walls: $(cat out)"
cp out slid.txt
run 0 map -s source.txt -t target.txt --inverse -p slid.txt
close_to out walls.txt 1e-9
sed 's/^2 0$/slide/' target.txt >corner.txt
run 1 check -s source.txt -t corner.txt
says 'corner.txt:11: this vertex cannot slide: the source has a corner there'
run 1 check -s target.txt
says "target.txt:12: 'slide' is not a number"
run 0 plot -s source.txt -t target.txt out.svg

# Points inside with a reach carry their surroundings along: 0.02 beside one the map's derivative is moderate.
cat >inside.geojson <<'END'
{"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"role": "source"}, "geometry": {"type": "Polygon", "coordinates": [[[0,0],[1,0],[1,1],[0,1],[0,0]]]}},
{"type": "Feature", "properties": {"role": "target"}, "geometry": {"type": "Polygon", "coordinates": [[[0,0],[1,0],[1,1],[0,1],[0,0]]]}},
{"type": "Feature", "properties": {"role": "source", "feature": 1}, "geometry": {"type": "Point", "coordinates": [0.5,0.5]}},
{"type": "Feature", "properties": {"role": "target", "feature": 1}, "geometry": {"type": "Point", "coordinates": [0.6,0.5]}}]}
END
printf '0.5 0.5\n0.52 0.5\n0.52 0.505\n' >probe.txt
run 0 map -s inside.geojson --reach 0.2 -p probe.txt
head -n 1 out >first
printf '0.6 0.5\n' >expected
close_to first expected 1e-6
awk 'NR == 2 { x = $1; y = $2 } NR == 3 { d = sqrt(($1 - x) ^ 2 + ($2 - y) ^ 2); exit !(d > 0.003 && d < 0.01) }' out ||
    complain "a spike in spite of the reach: $(cat out)"
run 0 check -s inside.geojson --reach 0.2
run 2 map -s inside.geojson --reach 0.2 --method foliation
says '--method does not go with --reach'

finish
