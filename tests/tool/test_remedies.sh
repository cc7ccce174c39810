#!/bin/sh
# What messages about foreign files advise works: each command in quotes is run, where its program is installed, and what
# it makes is read.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages
python=/usr/bin/python3

# Debian's module without its command: it is the same program.
mkdir bin
if ! command -v meshio >/dev/null && "$python" -c 'import meshio' 2>/dev/null; then
    printf '#!/bin/sh\nexec %s -c "from meshio._cli import main; main()" "$@"\n' "$python" >bin/meshio
    chmod +x bin/meshio
fi
PATH=$PWD/bin:$PATH

has() {
    case $1 in
    python3) "$python" -c "$(printf %s "$2" | sed 's/.*-c "\(import [^;]*\);.*/\1/')" 2>/dev/null ;;
    convert) convert -version 2>/dev/null | grep -q ImageMagick ;;
    *) command -v "$1" >/dev/null ;;
    esac
}

# follow FILE COMMAND..: the command refuses the file, and takes what the advice in the message makes of it. In the command
# FILE stands for either. With `then` set, that command takes it.
n_followed=0 skipped='' then='' 
follow() {
    file=$1
    shift
    # shellcheck disable=SC2046,SC2086 # words
    run 1 $(echo "$*" | sed "s/FILE/$file/")
    advice=$(sed -n "s/^[^']*'\(.*\)' makes .*/\1/p" err)
    program=${advice%% *}
    if [ -z "$advice" ]; then
        complain "no command for $file in: $(cat err)"
        return
    fi
    if ! has "$program" "$advice"; then
        [ "$program" != python3 ] || program=$(echo "$advice" | sed 's/.*import \([^;]*\);.*/(\1)/')
        case $skipped in *" $program"*) ;; *) skipped="$skipped $program" ;; esac
        return
    fi
    rm -f made.*
    advice=$(printf %s "$advice" | sed "s/FILE/$file/; s/OUT/made/; s|^python3|$python|")
    sh -c "$advice" >told 2>&1 || complain "$advice: $(tail -n 3 told)"
    made=$(find . -name 'made.*' ! -name '*.mtl' | sed 's|./||' | sort | head -n 1)
    # shellcheck disable=SC2046
    run 0 $(echo "${then:-$*}" | sed "s/FILE/${made:-nothing}/")
    n_followed=$((n_followed + 1))
}

# Maps: cages, and layers that are carried along.
polygon='{"type":"Polygon","coordinates":[[[1,1],[4,1],[4,4],[1,4],[1,1]]]}'
printf '{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"a":1},"geometry":%s}]}' "$polygon" >l.geojson
printf '{"type":"Topology","arcs":[[[1,1],[4,1],[4,4],[1,4],[1,1]]],"objects":{"l":{"type":"Polygon","arcs":[[0]]}}}' >l.topojson
printf '{"fieldAliases":{"a":"a"},"geometryType":"esriGeometryPolygon","spatialReference":{"wkid":4326},"fields":[{"name":"a",
"type":"esriFieldTypeInteger"}],"features":[{"attributes":{"a":1},"geometry":{"rings":[[[1,1],[1,4],[4,4],[4,1],[1,1]]]}}]}' >l.json
printf 'id,WKT\n1,"POLYGON((1 1, 4 1, 4 4, 1 4, 1 1))"\n' >l.csv
cat >l.gpx <<'END'
<?xml version="1.0"?>
<gpx version="1.1" creator="x" xmlns="http://www.topografix.com/GPX/1/1"><trk><trkseg><trkpt lat="1" lon="1"/>
<trkpt lat="1" lon="4"/><trkpt lat="4" lon="4"/></trkseg></trk></gpx>
END
cat >l.osm <<'END'
<?xml version="1.0"?>
<osm version="0.6"><node id="1" lat="1" lon="1"/><node id="2" lat="1" lon="4"/><node id="3" lat="4" lon="4"/>
<way id="4"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="building" v="yes"/></way></osm>
END
if command -v ogr2ogr >/dev/null; then
    for format in GPKG:gpkg KML:kml "ESRI Shapefile:shp" FlatGeobuf:fgb GML:gml "MapInfo File:mif" SQLite:sqlite LIBKML:kmz DXF:dxf; do
        name=l.${format##*:}
        fields=
        [ "$name" != l.dxf ] || fields='-select Layer'
        # shellcheck disable=SC2086
        ogr2ogr -f "${format%:*}" $fields "$name" l.geojson >told 2>&1 || rm -f "$name"
    done
fi
for name in gpkg kml shp fgb gml mif sqlite kmz topojson json csv; do
    [ -e l.$name ] || continue
    follow l.$name check -s FILE
    follow l.$name map -s source.txt -t target.txt --geojson FILE out.geojson
done
[ ! -e l.dxf ] || follow l.dxf check -s FILE
for name in gpx osm dxf; do
    [ -e l.$name ] || continue
    follow l.$name map -s source.txt -t target.txt --geojson FILE out.geojson
done
printf 'id,x,y\n1,2,3\n' >points.csv
follow points.csv map -s source.txt -t target.txt --geojson FILE out.geojson
printf '\001\003\000\000\000\001\000\000\000\003\000\000\000' >a.wkb
"$python" -c '
import struct, sys
rings = [(0, 0), (4, 0), (4, 3), (0, 0)]
b = struct.pack("<BIII", 1, 0x20000003, 4326, 1) + struct.pack("<I8d", 4, *(x for p in rings for x in p))
open("a.wkb", "wb").write(b); open("b.wkb", "w").write(b.hex())' && for name in a.wkb b.wkb; do
    follow $name check -s FILE
done
printf '\377\376' >u.txt
iconv -f UTF-8 -t UTF-16LE source.txt >>u.txt
follow u.txt check -s FILE

# Surfaces, scenes and meshes.
printf 'v 0 0 0\nv 3 0 0\nv 0 3 0\nv 0 0 3\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >c.obj
if command -v assimp >/dev/null; then
    for format in collada:dae x3d:x3d 3ds:3ds x:x; do
        assimp export c.obj "c.${format#*:}" "-f${format%:*}" >told 2>&1
        [ ! -e "c.${format#*:}" ] || follow "c.${format#*:}" check -s FILE
    done
fi
if [ -e bin/meshio ] || command -v meshio >/dev/null; then
    printf 'MeshVersionFormatted 2\nDimension 3\nVertices\n4\n0 0 0 0\n3 0 0 0\n0 3 0 0\n0 0 3 0\nTetrahedra\n1\n1 2 3 4 0\nEnd\n' >t.mesh
    for format in ansys:ta.msh abaqus:t.inp su2:t.su2 dolfin-xml:t.xml flac3d:t.f3grid \
        xdmf:t.xdmf exodus:t.exo cgns:t.cgns med:t.med; do
        meshio convert --output-format "${format%:*}" t.mesh "${format#*:}" >told 2>&1 || rm -f "${format#*:}"
        [ ! -e "${format#*:}" ] || follow "${format#*:}" mesh -s c.obj -t c.obj FILE out.vtk
    done
fi
printf 'mesh3d\ndimension\n3\ngeomtype\n0\n\nsurfaceelements\n0\n\nvolumeelements\n1\n1 4 1 2 3 4\n\npoints\n4\n0 0 0\n3 0 0\n0 3 0\n0 0 3\nendmesh\n' >t.vol
follow t.vol mesh -s c.obj -t c.obj FILE out.vtk

# Landmarks and scans.
printf '# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n# columns = id,x,y,z,ow\nF_0,.5,.5,.5,0,0,0,1,1,1,0,F-1,,\nF_1,1,.5,.25,0,0,0,1,1,1,0,F-2,,\n' >p.fcsv
printf '{"@schema": "x#", "markups": [{"type": "Fiducial", "controlPoints": [{"id": "1", "position": [0.5, 0.5, 0.5]}, {"id": "2", "position": [1, 0.5, 0.25]}]}]}' >p.mrk.json
for name in p.fcsv p.mrk.json; do
    follow $name map -s c.obj -t c.obj -p FILE
done
printf 'ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n\001\001\001\001\001\001\001\001' >m.mha
printf 'NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n\001\001\001\001\001\001\001\001' >m.nrrd
for name in m.mha m.nrrd; do
    follow $name check -s FILE
done

# Links from corners to their images are landmarks, beside outlines.
cat >links.geojson <<'END'
{"type":"FeatureCollection","features":[
{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,0],[0,0]]}},
{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[10,0],[12,1]]}}]}
END
then='map -s source.txt -t target.txt --match auto --landmarks FILE -p points.txt'
follow links.geojson check -s FILE
then=''

# Pictures and documents.
if "$python" -c 'import PIL' 2>/dev/null; then
    "$python" -c '
from PIL import Image
p = Image.new("RGB", (10, 10), (9, 99, 200))
for name in ("gif", "bmp", "tif", "webp"):
    try: p.save("q." + name)
    except Exception: pass'
    for name in gif bmp tif webp; do
        [ ! -e q.$name ] || follow q.$name warp -s source.txt -t target.txt FILE warped.png
    done
fi

[ -z "$skipped" ] || echo "not installed, and so not tried:$skipped"
echo "$n_followed remedies work"
[ $n_followed -gt 0 ] || complain "none was tried"
finish
