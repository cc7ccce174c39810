#!/bin/sh
# Malformed input gives exit code 1 and one line that names the file and the line, and says what is wrong.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

# rejects PLACE MESSAGE: the file `bad` on standard input of this function is no cage.
rejects() {
    cat >bad
    run 1 map -s bad -t target.txt -p points.txt
    says "libicc: bad:$1"
    says "$2"
    run 1 map -s source.txt -t bad -p points.txt
    says "libicc: bad:$1"
}

# Text.
printf '' | rejects ' ' '0 vertices'
printf '0 0\n' | rejects ' ' '1 vertex;'
printf '0 0\n1 0\n0 0\n' | rejects ' ' '2 vertices'
printf '0 0\n1 abc\n1 1\n' | rejects 2: "'abc' is not a number"
printf '0 0\n1,5 2\n1 1\n' | rejects 2: "'1,5' has a comma"
printf '1,5 0\n2,5 0\n1 1\n' | rejects 1: "'1,5' has a comma"
printf '1,5,0,0\n2,5,0,0\n' | rejects 1: "'1,5,0,0' has a comma"
printf '1,5;0,0\n2,5;0,0\n' | rejects 1: "has a comma"
printf '0,0\n1,0,0\n' | rejects 2: '3 columns in this line, not 2'
printf '0,0\n1,zero\n' | rejects 2: "'zero' is not a finite number"
printf '0,0\n1,inf\n' | rejects 2: "'inf' is not a finite number"
printf '# a\n\nname,y\n1,2\n' | rejects 3: 'the heading has 2 columns; a vertex is '
printf 'x,lon,y\n1,2,3\n' | rejects 1: 'two columns are called x or the like'
printf 'x y\n0 0\n' | rejects 1: "'x' is not a number"
printf '0 0\n\n# c\n1 0 0\n1 1\n' | rejects 4: '3 numbers in this line'
printf '0 0\n1\n1 1\n' | rejects 2: '1 number in this line'
printf '0 0\nnan 1\n1 1\n' | rejects 2: "'nan' is not a finite number"
printf '0 0\n1 -Infinity\n1 1\n' | rejects 2: 'is not a finite number'
printf '0 0\n1 1e999\n1 1\n' | rejects 2: 'is not a finite number'
printf '0 0\n0x10 0\n1 1\n' | rejects 2: "'0x10' is not a number"
printf '0 0\n1 1e\n1 1\n' | rejects 2: "'1e' is not a number"
printf '0 0\n1 .\n1 1\n' | rejects 2: "'.' is not a number"
printf '0 0\n\000\n1 1\n' | rejects 2: 'zero byte'
printf '0 0\n\001\377\n1 1\n' | rejects 2: "'??' is not a number"
printf 'OFF\n3 1 0\n' | rejects 3: 'the file ends early'
printf '\223NUMPY\001' | rejects ' ' 'this .npy file has version 0'
printf '\211PNG\r\n' | rejects ' ' 'the PNG picture is damaged'

# Geometry.
printf '0 0\n10 0\n10 10\n5 -5\n0 10\n3 3\n' | rejects 1: 'the edge from vertex 0 crosses the edge from vertex 2 (line 3)'
printf '\n0 0\n4 0\n4 4\n4 4\n0 4\n-1 1\n' | rejects 4: 'vertex 2 coincides with vertex 3 (line 5)'
printf '0 0\n1 1\n2 2\n3 3\n4 4\n5 5\n' | rejects 1: 'defects in all'
printf '0 0\n0 1\n1 0\n' >bad
run 1 map -s source.txt -t bad -p points.txt
says 'libicc: bad: 3 vertices, but the source source.txt has 6'
printf -- '-1 10\n5 12\n6.5 7\n12 6\n12 1\n0 0\n' >bad
run 1 map -s source.txt -t bad -p points.txt
says 'libicc: bad:'
says 'clockwise'
run 1 map -s nowhere -t target.txt -p points.txt
says 'libicc: nowhere: cannot be opened'
run 1 map -s . -t target.txt -p points.txt
says 'libicc: .: cannot be read'
run 1 info -s source.txt --maximum 8,8
says 'libicc: source.txt:'

# WKT.
printf 'POLYGON ((0 0, 1 0, 1 1' | rejects 1: "')' is missing"
printf 'POLYGON ((0 0,\n 1 zero, 1 1))' | rejects 2: "'zero,' is not a number"
printf 'POLYGON ((0 0, 9 0, 9 9),\n(1 1, 2 1, 1 1))' | rejects 2: 'hole 1 has 2 vertices'
printf 'MULTIPOLYGON (((0 0, 9 0, 9 9)), ((0 0, 9 0, 9 9), (1 1, 2 1, 2 2)),\n((0 0, 1 1, 1 0)))' | rejects '' '3 parts'
printf 'MULTIPOLYGON (((0 0, 9 0, 9 9), (1 1, 2 1, 2 2), (3 3)))' | rejects 1: 'hole 2 has 1 vertex;'
printf 'MULTIPOLYGON (((0 0, 9 0, 9 9))' | rejects 1: "')' is missing"
printf 'MULTIPOLYGON EMPTY' | rejects 1: 'is empty'
printf 'MULTILINESTRING ((0 0, 1 1))' | rejects 1: 'a cage is a POLYGON'
printf 'POLYGON Z ((0 0 0,\n9 0, 9 9 0))' | rejects 2: '2 numbers where a vertex has 3'
printf 'POLYGON ZM ((0 0 0, 9 0 0, 9 9 0))' | rejects 1: '3 numbers where a vertex has 4'
printf 'POLYGON ((0, 9 0, 9 9))' | rejects 1: '1 number where a vertex has 2'
printf 'POLYGON ((0 0 1 2 3, 9 0, 9 9))' | rejects 1: "'3,' where ')' is expected"
printf 'POLYGON EMPTY' | rejects 1: 'is empty'
printf 'LINESTRING (0 0, 1 1)' | rejects 1: 'a cage is a POLYGON'
printf 'POLYGON ((0 0, 1 0, 1 1)) POINT (1 1)' | rejects 1: 'more text after'

# GeoJSON.
printf '{"type":"Polygon",\n"coordinates":[[[0,0],' | rejects 2: 'the JSON ends early'
printf '{"type":"Polygon",\n"coordinates":[[[0,0] [1,1]]]}' | rejects 2: 'not valid JSON'
printf '{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1]],[[0,0],[1,0],[0,0]]]}' | rejects ' ' 'hole 1 has 2 vertices'
printf '{"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9]],[],[[0,0]]]}' | rejects ' ' 'hole 1 has 0 vertices'
printf '{"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9]],[[1,1],[2]]]}' | rejects ' ' 'vertex 1 of hole 1 is not a pair'
printf '{"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1]]],[[[0,0],[1,0],[1,1]]]]}' | rejects ' ' '2 parts'
printf '{"type":"Polygon","coordinates":[[[0,0],[1,"a"],[1,1]]]}' | rejects ' ' 'vertex 1 is not a pair'
printf '{"type":"Polygon","coordinates":[[[0,0],[1e999,0],[1,1]]]}' | rejects ' ' 'vertex 1 is not finite'
printf '{"type":"Polygon"}' | rejects ' ' 'no coordinates'
printf '{"type":"Point","coordinates":[0,0]}' | rejects ' ' "'Point'"
printf '{"type":"FeatureCollection","features":[]}' | rejects ' ' 'none of the 0 features'
printf '{"type":"FeatureCollection","features":[{},{}]}' | rejects ' ' 'none of the 2 features'
printf '[1,2,3]' | rejects ' ' 'a cage is a Polygon'

# Other formats: what they are, and what makes a readable file of them.
names() {
    cat >bad
    run 1 check -s bad
    says "this is $1"
    says "${2:-ogr2ogr -f GeoJSON}"
    for reader in '-p bad' '--geojson bad out.geojson' '--match auto --landmarks bad -p points.txt'; do
        # shellcheck disable=SC2086 # words
        run 1 map -s source.txt -t target.txt $reader
        says "libicc: bad: this is $1"
    done
    run 1 mesh -s source.txt -t target.txt bad out.obj
    says "libicc: bad: this is $1"
}
printf '<?xml version="1.0"?>\n<!-- a > b -->\n<kml xmlns="x"><Placemark/></kml>' | names 'a KML file'
printf '<gpx/>' | names 'a GPX file'
printf '<wfs:FeatureCollection xmlns:gml="x">\n</wfs:FeatureCollection>' | names 'a GML file'
printf '<COLLADA version="1"/>' | names 'a COLLADA file' 'makes OBJ'
printf 'SQLite format 3\000%052dGPKG' 0 | names 'a GeoPackage'
printf 'SQLite format 3\000%052dxxxx' 0 | names 'an SQLite database'
printf 'PK\003\004%022d\007\000\000\000doc.kml' 0 | names 'a KMZ file'
printf 'PK\003\004%022d\007\000\000\000a/b.txt' 0 | names 'a zip archive' 'unpack it first'
printf '\000\000\047\012\000\000' | names 'a shapefile'
printf 'fgb\003fgb\000' | names 'a FlatGeobuf file'
printf '999\r\na comment\r\n  0\r\nSECTION\r\n' | names 'a DXF drawing'
printf 'Version 300\nCharset "Neutral"\nDelimiter ","\n' | names 'a MapInfo file'
printf 'id,WKT\n1,"POLYGON((0 0, 9 0, 9 9))"\n' | names 'a comma-separated table (CSV) of shapes'
printf '{"objects":{},"arcs":[],"type":"Topology"}' | names 'a TopoJSON file'
printf '#CRS: x\nmapX,mapY,sourceX,sourceY,enable\n1,2,3,4,1\n' | rejects ' ' 'this is a list of control points (QGIS)'
says '--landmarks takes it'
printf 'id,x,y\n1,2,3\n' >bad
run 1 map -s source.txt -t target.txt --geojson bad out.geojson
says 'this is a table (CSV), not GeoJSON; '
printf '{"asset":{"version":"2.0"}}' | rejects ' ' 'there are no vertices'
printf '{"asset":{"version":"2.0"}}' >bad
run 1 map -s source.txt -t target.txt -p bad
says 'this is a glTF scene, which is read only as a cage or a mesh'
printf '{"skeleton":{"spine":"4"}}' | names 'a Spine skeleton' "lines of \`x y\`"
printf '{"v":"5","fr":30}' | names 'a Lottie animation' "lines of \`x y\`"
printf '[gd_scene format=3]\n' | names 'a Godot scene' "lines of \`x y\`"
printf '{"markups":[]}' | names 'a list of landmarks of 3D Slicer' 'makes points'
printf '# Markups fiducial file version = 4.11\n' | names 'a list of landmarks of 3D Slicer' 'makes points'
printf 'ObjectType = Image\n' | names 'a MetaImage file' 'makes a mask'
printf 'NRRD0004\n' | names 'an NRRD file' 'makes a mask'
printf '%0344dn+1\000' 0 | names 'a NIfTI file' 'makes a mask'
printf 'mesh3d\n' | names 'a Netgen mesh' 'makes VTK'
printf '/* of a\n * tool */\nFoamFile\n{\n}\n' | names 'an OpenFOAM file' 'foamToVTK'
printf '<febio_spec version="4.0"/>' | names 'a FEBio file' 'exports VTK'
printf '<VTKFile type="ImageData"/>' | names 'a VTK file in XML' 'ParaView'
printf '<VTKFile type="PolyData"/>' | names 'a VTK file in XML' 'ParaView'
printf '\211HDF\r\n' | names 'an HDF5 file' 'makes VTK'
printf 'Kaydara FBX Binary' | names 'an FBX file' 'Blender imports it'
printf 'PXR-USDC' | names 'a USD file' 'Blender imports it'
printf 'ISO-10303-21;\n' | names 'a STEP file' 'makes STL'
printf '\166\057\061\001' | names 'an OpenEXR picture' '.npy'
printf '\001\003\000\000\040\346\020\000\000' | names 'well-known binary' 'makes text'
printf 'glTF\002\000\000\000\034\000\000\000\010\000\000\000BIN\000%08d' 0 | rejects ' ' 'is not the part JSON of a glTF file'
printf 'solid cube\n facet normal 0 0 1\n' | rejects 3: 'the file ends early'
printf 'solid\nendsolid\n' | rejects ' ' 'there are no vertices'
printf 'glTF\002\000\000\000' | rejects ' ' 'the file ends early'
printf '\377\330\377\340' | names 'a JPEG picture' 'only warp, fit, animate and pose read'
printf 'II*\000' | names 'a TIFF picture' 'makes a plain PNG'
printf 'RIFF\000\000\000\000WEBP' | names 'a WebP picture' 'makes a PNG'
printf 'P3\n1 1\n255\n0 0 0\n' | names 'a PNM picture' 'only warp, fit, animate and pose read'
printf 'BM%04d\000\000\000\000%020d' 0 0 | names 'a BMP picture' 'makes a PNG'
printf '\037\213\010' | names 'a gzip archive' 'unpack it first'
printf '\3757zXZ\000' | names 'an xz archive' 'unpack it first'
printf 'BZh9' | names 'a bzip2 archive' 'unpack it first'
printf '\377\3760\000' | names 'a text in UTF-16' 'UTF-8'
printf '0106000020E6100000010000000103000000' | names 'well-known binary' 'ST_AsText'
one='{"type":"Feature","geometry":{"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9]]]}}'
printf '%s\n%s\n' "$one" "$one" | rejects ' ' 'none of the 2 features of the sequence is a Polygon with the property "role"'
printf '%s %s\n' "$one" "$one" | rejects 1: 'this is not valid JSON'
printf '%s\n{"type":"Polygon"}\n' "$one" | rejects ' ' "text 2 of 2 is a 'Polygon'; in a sequence each is a Feature"
printf '\036%s\n\036{"type":\n' "$one" | rejects 3: 'the JSON ends early'
printf '{"rings":[[[0,0],[1,0],[1,1]]]}' | rejects ' ' 'this is an Esri JSON geometry'
printf '# vtk DataFile Version 3.0\n' | rejects 2: 'the file ends early'
printf 'MeshVersionFormatted 2\n' | rejects ' ' 'there are no vertices'

# SVG.
printf '<svg></svg>' | rejects ' ' 'no complete <path>, <polygon>'
printf '<svg><path d="M0 0L1 0' | rejects ' ' 'no complete <path>, <polygon>'
printf '<svg><path d="M0 0L1 0 1 1z"/><polygon points="0 0 1 0 1 1"/></svg>' | rejects ' ' '0 of the 2 shapes'
printf '<svg>\n<path d="M0 0L1 0\n1 one z"/></svg>' | rejects 3: "'one'"
printf '<svg><path d="M0 0L9 0 9 9zL2 1 2 2z"/></svg>' | rejects 1: 'continues after Z'
printf '<svg><path d="M0 0L9 0 9 9M1 1\nM2 1 2 2z"/></svg>' | rejects 2: 'contour 2 of the path has 2 vertices'
printf '<svg><path d="M0 0L9 0z"/></svg>' | rejects ' ' '2 vertices; a cage has at least 3'
printf '<svg><path d="M5 5zm1 1M3 3h0v0z"/></svg>' | rejects 1: 'the path draws nothing'
printf '<svg><path d="z"/></svg>' | rejects 1: 'does not begin with M'
printf '<svg><path d="M0 0A1 1 0 0 5 5z"/></svg>' | rejects 1: "'5' in the path where 0 or 1 is expected"
printf '<svg><path d="L0 0 1 1 1 0"/></svg>' | rejects 1: 'does not begin with M'
printf '<svg><path d="M0 0B1 1"/></svg>' | rejects 1: "'B' is not a command"
printf '<svg><path/></svg>' | rejects 1: 'has no outline'
printf '<svg><g transform="scale(2"><g><path d="M0 0L1 0 1 1z"/></g></g></svg>' | rejects 1: 'a transform that SVG does not have'
printf '<svg><polygon points="0 0 1 0 1"/></svg>' | rejects 1: 'lacks its y'
printf '<svg><polygon points="0 0 1 x 1 1"/></svg>' | rejects 1: "'x'"

# Points and coordinates.
printf '1 1\n1 2 3\n' >bad
run 1 map -s source.txt -t target.txt -p bad
says 'libicc: bad:2: 3 numbers in this line; a point is'
printf '1 1\n1 2 3\n' | run 1 map -s source.txt -t target.txt
says 'libicc: standard input:2:'
printf '0 0.5 0.5 0.5\n6 0.5 0.5 0.5\n' >bad
run 1 decode -s source.txt --coords bad
says 'libicc: bad:2: 6 is not an edge; the cage has the edges 0 to 5'
printf '0.5 0.5 0.5 0.5\n' >bad
run 1 decode -s source.txt --coords bad
says 'libicc: bad:1: 0.5 is not an edge'
finish
