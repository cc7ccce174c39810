#!/bin/sh
# Meshes that are carried along: PLY in and out, and files that say a thing twice or in the wrong order.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cubes
carry() { run "$1" mesh -s cube.obj -t moved.obj -m field -n 8 "$2" "$3"; }

# What OBJ gives, the vertices of the cage.
carry 0 cube.obj out.obj
holds out '12 triangles carried; only tetrahedra can be certified'
sed -n 's/^v //p' out.obj >expected

# PLY as text: the coordinates are replaced, in whatever order they stand; all else stays.
head='ply\r\nformat ascii 1.0\ncomment float x\nelement vertex 8\nproperty uchar red\nproperty float z\n'
head=$head'property list uchar int l\nproperty float32 x\nproperty double y\nelement face 12\nproperty list uchar int vertex_index\nend_header\n'
{
    # shellcheck disable=SC2059 # the head is a format
    printf "$head"
    awk '{ print "255", $3, "2 7 8", $1, $2 }' corners.txt
    awk '{ print 3, $2 - 1, $3 - 1, $4 - 1 }' faces
} >in.ply
carry 0 in.ply out.ply
holds out '12 triangles carried'
sed -n '13,20p' out.ply | awk '{ print $6, $7, $2 }' >got
same got expected 'the coordinates of PLY'
sed -n '13,20p' out.ply | awk '{ print $1, $3, $4, $5 }' | sort -u >rest
[ "$(cat rest)" = '255 2 7 8' ] || complain "what is no coordinate has changed: $(cat rest)"
sed '13,20d; s/^property float z/property double z/; s/float32/double/' in.ply >expected.ply
sed '13,20d' out.ply | cmp -s - expected.ply || complain "the rest of the PLY has changed"

# PLY as binary of both orders: doubles come out, which the reader takes as the same cage.
for order in little big; do
    binary $order >in.ply
    carry 0 in.ply out.ply
    run 0 info -s out.ply -m field -n 8
    grep '^cage\|^box' out >expected.txt
    run 0 info -s out.obj -m field -n 8
    grep '^cage\|^box' out >got
    same got expected.txt "$order PLY"
    [ "$(wc -c <in.ply)" = "$(wc -c <out.ply)" ] || complain "the size of a $order PLY of doubles has changed"
    sed 's/property double x/property float x/' in.ply | head -c 130 >short.ply
    carry 1 short.ply out.ply
done
# Floats become doubles. One vertex x = 1, y = z = 0.5 of four bytes each.
printf 'ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty uchar c\nproperty float z\nend_header\n' >in.ply
bytes 0 0 0 63 0 0 0 63 9 0 0 0 63 >>in.ply
carry 0 in.ply out.ply
[ "$(grep -ac '^property double' out.ply)" = 3 ] || complain "floats have stayed floats"
if ! { [ "$(tail -c 25 out.ply | wc -c)" = 25 ] && [ "$(wc -c <out.ply)" = $(($(wc -c <in.ply) + 12 + 3)) ]; }; then
    complain "the binary vertex has another size"
fi
[ "$(tail -c 9 out.ply | head -c 1 | od -An -tu1 | tr -d ' ')" = 9 ] || complain "the colour has moved"

# In the plane z is left alone.
printf '0 0\n4 0\n4 4\n0 4\n' >a.txt
printf '0 0\n8 0\n8 4\n0 4\n' >b.txt
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n' >in.ply
printf 'property list uchar int vertex_indices\nend_header\n1 1 7\n2 1 7.5\n2 2 8\n3 0 1 2\n' >>in.ply
run 0 mesh -s a.txt -t b.txt in.ply out.ply
holds out '1 triangles: 1 keep their orientation'
holds out.ply 'property float z'
[ "$(sed -n '10,12p' out.ply | cut -d ' ' -f 3 | tr '\n' ' ')" = '7 7.5 8 ' ] || complain "z has changed"

# Nothing may be said twice or too early, and nothing is written then.
refused() { # NAME PLACE MESSAGE
    rm -f "out.$1"
    cat >"in.$1"
    carry 1 "in.$1" "out.$1"
    says "libicc: in.$1:$2: $3"
    [ ! -e "out.$1" ] || complain "out.$1 was written"
}
vtk='# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n'
points='POINTS 4 double\n0.1 0.1 0.1\n0.9 0.1 0.1\n0.1 0.9 0.1\n0.1 0.1 0.9\n'
cells='CELLS 1 5\n4 0 1 2 3\n'
types='CELL_TYPES 1\n10\n'
# shellcheck disable=SC2059 # formats
{
    printf "$vtk$points$points$cells$types" | refused vtk 10 'a second section POINTS'
    printf "$vtk$points$cells$types$points" | refused vtk 14 'a second section POINTS'
    printf "$vtk$points$cells$cells$types" | refused vtk 12 'a second section CELLS'
    printf "$vtk$points$cells$types$types" | refused vtk 14 'a second section CELL_TYPES'
    printf "$vtk$points$cells$types$cells" | refused vtk 14 'a second section CELLS'
    printf "$vtk$cells$points$types" | refused vtk 5 'the section CELLS comes before POINTS'
    printf "$vtk$points$types$cells" | refused vtk 10 'the section CELL_TYPES comes before CELLS'
    printf "$vtk$points$cells${types}DATASET POLYDATA\n" | refused vtk 14 'a second DATASET'
    # An array of data may have such a name.
    printf "$vtk$points$cells${types}POINT_DATA 4\nFIELD FieldData 1\nPOINTS 1 4 double\n1 2 3 4\n" >in.vtk
    carry 0 in.vtk out.vtk

    medit='MeshVersionFormatted 2\nDimension 3\n'
    vertices='Vertices 4\n0.1 0.1 0.1 0\n0.9 0.1 0.1 0\n0.1 0.9 0.1 0\n0.1 0.1 0.9 0\n'
    elements='Tetrahedra 1\n1 2 3 4 0\n'
    printf "$medit$vertices$vertices$elements" | refused mesh 8 'a second section Vertices'
    printf "$medit$vertices$elements$elements" | refused mesh 10 'a second section Tetrahedra'
    printf "$medit$elements$vertices" | refused mesh 3 'the section Tetrahedra comes before Vertices'
    printf "${medit}Dimension 3\n$vertices" | refused mesh 3 'a second section Dimension'
    printf "$medit${vertices}Triangles 1\n1 2 3 0\nTriangles 1\n1 2 3 0\n" | refused mesh 10 'a second section Triangles'

    printf 'OFF\n3 1 0\n0.1 0.1 0.1\n0.9 0.1 0.1\n0.1 0.9 0.1\n3 0 1 2\n\n# end\nOFF\n3 1 0\n' |
        refused off 9 'there is more after the last of 1 faces'
    printf 'v 0.1 0.1 0.1\nf 1 2 3\nv 0.2 0.1 0.1\n' | refused obj 2 'the face has the vertex 2; there are 1 so far'
}
finish
