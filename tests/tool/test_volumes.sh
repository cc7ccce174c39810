#!/bin/sh
# Tetrahedral meshes: Medit and VTK in, the same file with other coordinates out, and exact counts.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cubes

# Two tetrahedra inside the cube, one that is turned over, one that is flat.
printf '0.21 0.23 0.22\n0.71 0.24 0.27\n0.22 0.68 0.26\n0.24 0.27 0.75\n0.69 0.66 0.72\n0.26 0.31 0.29\n' >vertices
{
    printf 'MeshVersionFormatted 2\n# a comment\nDimension 3\nVertices\n6\n'
    sed 's/$/ 7/' vertices
    printf 'Triangles\n1\n1 2 3 5\nRidges\n1\n1\nTetrahedra\n4\n1 2 3 4 0\n2 3 4 5 0\n2 1 3 4 0\n1 1 2 3 0\nEnd\n'
} >in.mesh
run 0 map -s cube.obj -t moved.obj -n 12 -p vertices -o images
run 0 mesh -s cube.obj -t moved.obj -n 12 in.mesh out.mesh
holds out '4 tetrahedra: 3 keep their orientation, 0 inverted, 0 collapsed, 1 flat before, 0 without image'
sed -n 6,11p out.mesh >rows
sed 's/ 7$//' rows >kept
same kept images
[ "$(sed '6,11d' in.mesh)" = "$(sed '6,11d' out.mesh)" ] || complain "the rest of the mesh has changed"

# VTK, with the cells of version 2 and of version 5, and numbers that run on.
head='# vtk DataFile Version 3.0\nPOINTS of # a title\nASCII\nDATASET UNSTRUCTURED_GRID\n'
{
    # shellcheck disable=SC2059 # escapes
    printf "$head"
    printf 'POINTS 6 float\n'
    paste -s -d ' ' vertices
    printf 'CELLS 4 18\n4 0 1 2 3\n4 1 2 3 4\n4 1 0 2\n3\n3 0 1 2\nCELL_TYPES 4\n10\n10\n10\n5\nPOINT_DATA 6\n'
    printf 'SCALARS a float\nLOOKUP_TABLE default\n1\n2\n3\n4\n5\n6\n'
} >in.vtk
sed -e 's/^CELLS.*/CELLS 5 15\nOFFSETS vtktypeint64\n0 4 8\n12 15\nCONNECTIVITY vtktypeint64/' \
    -e 's/^[34] \([0-9] [0-9] [0-9]\)/\1/' in.vtk >new.vtk
for file in in.vtk new.vtk; do
    run 0 mesh -s cube.obj -t moved.obj -n 12 "$file" out.vtk
    holds out '3 tetrahedra: 3 keep their orientation, 0 inverted, 0 collapsed, 0 flat before, 0 without image'
    holds out.vtk 'POINTS 6 double'
    [ "$(sed -n 6p out.vtk)" = "$(paste -s -d ' ' images)" ] || complain "the coordinates of $file are wrong"
    [ "$(sed '5,6d' "$file")" = "$(sed '5,6d' out.vtk)" ] || complain "the rest of $file has changed"
done

# Vertices outside have no image, nor have their tetrahedra; the count is exact.
sed '6s/.*/5 5 5 7/' in.mesh >far.mesh
rm -f out.mesh
run 4 mesh -s cube.obj -t moved.obj -n 12 far.mesh out.mesh
says 'far.mesh: 1 of 6 vertices have no image, so nothing was written; the first is vertex 0'
[ ! -e out.mesh ] || complain "a mesh with vertices outside was written"
run 4 mesh -s cube.obj -t moved.obj -n 12 --outside fail --json far.mesh out.mesh
holds out '"without_image": 1'
[ ! -e out.mesh ] || complain "a mesh with vertices outside was written with a report"
run 4 mesh -s cube.obj -t moved.obj -n 12 --outside keep far.mesh out.mesh
holds out '4 tetrahedra: 1 keep their orientation, 0 inverted, 0 collapsed, 0 flat before, 3 without image'
holds out.mesh '5 5 5 7'
run 0 mesh -s cube.obj -t moved.obj -n 12 --json=report.json in.mesh out.mesh
holds report.json '"tetrahedra":'
holds report.json '"kept": 3'
run 0 mesh -s cube.obj -t moved.obj -n 12 in.mesh -
holds err '4 tetrahedra: 3 keep'
same out out.mesh

# The vertices of a surface go along, too.
printf 'v 0.26 0.31 0.29\nv 0.51 0.27 0.22\nv 0.24 0.52 0.23\nf 1 2 3\n' >surface.obj
run 0 mesh -s cube.obj -t moved.obj -n 12 surface.obj out.obj
holds out '1 triangle carried; only tetrahedra can be certified'
holds out.obj 'f 1 2 3'

# Back again.
run 0 mesh -s cube.obj -t moved.obj -n 12 in.mesh out.mesh
run 0 mesh -s cube.obj -t moved.obj -n 12 -i out.mesh back.mesh
sed -n 6,11p back.mesh | sed 's/ 7$//' >back
close_to back vertices 1e-9

# rejects PLACE MESSAGE: standard input is no mesh.
rejects() {
    cat >bad
    run 1 mesh -s cube.obj -t moved.obj -n 8 bad out.mesh
    says "libicc: bad:$1"
    says "$2"
}
printf '' | rejects ' ' 'the file is empty'
printf 'MeshVersionFormatted 2\n\000\n' | rejects ' ' 'not a text file'
sed 's/^Dimension 3/Dimension 2/' in.mesh | rejects 3: 'a mesh of dimension 2, but the cages have 3'
sed 's/^1 2 3 4 0/0 2 3 4 0/' in.mesh | rejects 20: 'there is no vertex 0'
sed 's/^1 2 3 4 0/1 2 7 4 0/' in.mesh | rejects 20: '7 where a whole number below 7'
sed '8s/.*/0.1 x 0.2 7/' in.mesh | rejects 8: "'x' is not a finite number"
sed '20,$d' in.mesh | rejects 20: 'the file ends early'
sed 's/ASCII/BINARY/' in.vtk | rejects ' ' 'byte 196'
sed 's/UNSTRUCTURED_GRID/POLYDATA/' in.vtk | rejects 4: "this is a 'POLYDATA'; libicc reads an UNSTRUCTURED_GRID"
sed 's/^4 0 1 2 3/4 0 1 2 6/' in.vtk | rejects 8: '6 where a whole number below 6'
sed 's/^4 0 1 2 3/30 0 1 2 3/' in.vtk | rejects 8: '30 where a whole number below'
sed 's/^CELLS 4 18/CELLS 4000000 18/' in.vtk | rejects 8: 'the file has no room for so many cells'
sed 's/^CELL_TYPES 4/CELL_TYPES 3/' in.vtk | rejects 13: '3 types for 4 cells'
sed 's/^5$/10/' in.vtk | rejects '' 'cell 3 has 3 corners, but type 10'
sed 's/^0 4 8$/0 4 3/' new.vtk | rejects '' 'offset 2 is less than the one before'
sed '/^CELL_TYPES/,$d' in.vtk | rejects '' 'the file ends early'
printf '0.5 0.5 0.5\n' | rejects ' ' 'there are no vertices'

# A mesh that the map turns partly inside out is mended.
run 0 mesh -s cube.obj -t moved.obj --repair in.mesh mended.mesh
holds out '0 inverted'
run 0 mesh -s cube.obj -t moved.obj --repair --json in.mesh mended.mesh
holds out '"turned": []'

# A surface filled: the mesh fits the surface that it was made of, in both formats.
for file in filled.mesh filled.vtk; do
    run 0 mesh --fill cube.obj "$file"
    holds out ' tetrahedra, '
    run 0 info -s cube.obj --mesh "$file"
    holds out 'method      foliation, certified'
done
run 0 mesh --fill cube.obj -
holds out 'MeshVersionFormatted 2'
run 2 mesh --fill cube.obj filled.png
run 2 mesh --fill -s cube.obj cube.obj filled.mesh
holds err '--source does not go with --fill'
run 2 mesh --fill cube.obj
sed '$d' cube.obj >open.obj
run 1 mesh --fill open.obj none.mesh
[ ! -e none.mesh ] || complain "a mesh of an open surface was written"
printf '0 0\n1 0\n0 1\n' >flat.txt
run 1 mesh --fill flat.txt none.mesh
holds err 'only such a surface can be filled'

finish
