#!/bin/sh
# Elements of all kinds: counted by name, positive, inverted or undecided, and the exit code says so; legacy VTK as bytes.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cubes

# The surface of a column, and of the same column when it is bent by an angle.
column() { # LAYERS ANGLE
    awk -v n="$1" -v angle="$2" 'BEGIN {
        for (k = 0; k <= n; k++) for (j = 0; j < 2; j++) for (i = 0; i < 2; i++) {
            a = angle * k / n; x = i - 0.5; y = j - 0.5; r = angle > 0 ? 3 / angle : 0
            printf "v %.17g %.17g %.17g\n", (angle > 0 ? r - (r - x) * cos(a) : x), y,
                (angle > 0 ? (r - x) * sin(a) : 3 * k / n) }
        for (k = 0; k < n; k++) { a = 4 * k + 1; b = a + 4
            split("0 1 3 2 0", ring)
            for (e = 1; e <= 4; e++) { p = ring[e]; q = ring[e + 1]
                printf "f %d %d %d\nf %d %d %d\n", a + p, a + q, b + q, a + p, b + q, b + p } }
        print "f 1 3 2\nf 2 3 4"; a = 4 * n
        printf "f %d %d %d\nf %d %d %d\n", a + 1, a + 2, a + 3, a + 2, a + 4, a + 3 }'
}
column 8 0 >straight.obj
column 8 3.5 >bent.obj
vtk='# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n'
# hexahedra M: the whole column in M hexahedra.
hexahedra() {
    # shellcheck disable=SC2059 # a format
    printf "$vtk"
    awk -v m="$1" 'BEGIN { printf "POINTS %d double\n", 4 * (m + 1)
        for (k = 0; k <= m; k++) print -0.5, -0.5, 3 * k / m, 0.5, -0.5, 3 * k / m, 0.5, 0.5, 3 * k / m, -0.5, 0.5, 3 * k / m
        printf "CELLS %d %d\n", m, 9 * m
        for (k = 0; k < m; k++) { printf "8"; for (i = 0; i < 8; i++) printf " %d", 4 * k + i; print "" }
        printf "CELL_TYPES %d\n", m; for (k = 0; k < m; k++) print 12 }'
}
hexahedra 8 >fine.vtk
run 0 mesh -s straight.obj -t straight.obj fine.vtk out.vtk
holds out '8 hexahedra: 8 positive, 0 inverted, 0 undecided, 0 not positive before, 0 without image; only tetrahedra can be certified'
run 1 mesh -s straight.obj -t straight.obj --require certified fine.vtk out.vtk
holds err 'not certified; only tetrahedra can be certified, so nothing was written'
run 0 mesh -s straight.obj -t bent.obj fine.vtk out.vtk
holds out '8 hexahedra: 8 positive'
hexahedra 1 >coarse.vtk
for option in '' --untangle; do
    # shellcheck disable=SC2086 # an option or none
    run 4 mesh -s straight.obj -t bent.obj $option coarse.vtk out.vtk
    holds out '1 hexahedra: 0 positive, 1 inverted'
    holds err '1 of 1 hexahedra is inverted (numbers from 0: 0)'
    holds err 'elements of this kind are not untangled'
done
run 4 mesh -s straight.obj -t bent.obj --json coarse.vtk out.vtk
tr -d ' \n' <out >flat.json
holds flat.json '"hexahedra":{"all":1,"positive":0,"inverted":1,"undecided":0,"not_positive_before":0,"without_image":0,"turned":[0]'

# All the kinds of a file, each by its name; quadratic ones and pyramids, too.
points='POINTS 14 double\n0.2 0.2 0.2\n0.6 0.2 0.2\n0.6 0.6 0.2\n0.2 0.6 0.2\n0.2 0.2 0.6\n0.6 0.2 0.6\n0.6 0.6 0.6\n0.2 0.6 0.6\n'
points=$points'0.4 0.2 0.2\n0.4 0.4 0.2\n0.2 0.4 0.2\n0.2 0.2 0.4\n0.4 0.2 0.4\n0.2 0.4 0.4\n'
cells='8 0 1 2 3 4 5 6 7\n6 0 1 3 4 5 7\n5 0 1 2 3 4\n10 0 1 3 4 8 9 10 11 12 13\n4 0 1 3 4\n4 0 1 2 3\n3 0 1 2\n2 0 1\n1 0\n8 0 1 3 2 4 5 7 6\n4 0 1 2 6\n'
# shellcheck disable=SC2059 # formats
printf "$vtk${points}CELLS 11 66\n${cells}CELL_TYPES 11\n12\n13\n14\n24\n10\n9\n5\n3\n1\n11\n42\n" >kinds.vtk
run 4 mesh -s cube.obj -t cube.obj kinds.vtk out.vtk
for line in '1 tetrahedra: 1 keep' '1 hexahedra: 1 positive' '1 voxels: 1 positive' '1 prisms (wedges): 1 positive' \
    '1 pyramids: 1 positive' '1 quadratic tetrahedra: 1 positive' '1 polyhedra: 0 positive, 0 inverted, 1 undecided' \
    '1 triangle, 1 quadrilateral, 1 line, 1 vertex carried'; do
    holds out "$line"
done
holds err '1 of 1 polyhedra is undecided (numbers from 0: 0): nothing is proved of this kind'
grep -q 'certified one-to-one' out && complain "a mesh of all kinds was certified"
sed 's/^10 0 1 3 4 8/9 0 1 3 4/; s/CELLS 11 66/CELLS 11 65/' kinds.vtk >short.vtk
run 1 mesh -s cube.obj -t cube.obj short.vtk out.vtk
says 'cell 3 has 9 corners, but type 24'

# Medit has names for them. Nodes 9 and 10 of a quadratic tetrahedron come in either order.
medit() {
    # shellcheck disable=SC2059 # a format
    printf "MeshVersionFormatted 2\nDimension 3\nVertices 14\n${points#*double?n}" | sed '4,$s/$/ 0/'
    printf 'Hexahedra 1\n1 2 3 4 5 6 7 8 0\nPrisms 1\n1 2 4 5 6 8 0\nPyramids 1\n1 2 3 4 5 0\nQuadrilaterals 1\n1 2 3 4 0\n'
    printf 'TetrahedraP2 2\n1 2 4 5 9 10 11 12 13 14 0\n1 2 4 5 9 10 11 12 14 13 0\nEnd\n'
}
medit >kinds.mesh
run 0 mesh -s cube.obj -t cube.obj kinds.mesh out.mesh
for line in '1 hexahedra: 1 positive' '1 prisms (wedges): 1 positive' '1 pyramids: 1 positive' '2 quadratic tetrahedra: 2 positive' \
    '1 quadrilateral carried'; do
    holds out "$line"
done

# In the plane: a quadrilateral can lose its corner while its fan does not turn, a polygon can meet itself.
printf '0 0\n4 0\n4 4\n0 4\n' >square.txt
printf '0 0\n4 0\n1 1\n0 4\n' >dart.txt
printf 'v 0 0\nv 4 0\nv 4 4\nv 0 4\nf 1 2 3 4\n' >quad.obj
run 4 mesh -s square.txt -t dart.txt quad.obj out.obj
holds out '1 quadrilaterals: 0 positive, 1 inverted'
holds err 'all four corners lie on the boundary'
grep -q 'certified one-to-one' out && complain "a quadrilateral with a corner inward was certified"
# A hexagon like an L, with a vertex in the middle of a side, is positive.
printf 'v 0 0\nv 2 0\nv 4 0\nv 4 1\nv 1 1\nv 1 4\nv 0 4\nf 1 2 3 4 5 6 7\n' >polygon.obj
run 0 mesh -s square.txt -t square.txt polygon.obj out.obj
holds out '1 polygons: 1 positive'
printf 'v 0 0\nv 2 2\nv 2 0\nv 0 2\nv -0 1\nf 1 2 3 4 5\n' >bow.obj
run 0 mesh -s square.txt -t square.txt bow.obj out.obj
holds out '1 polygons: 0 positive, 0 inverted, 0 undecided, 1 not positive before'

# VTK as bytes: cells of both forms, floats and doubles, a field before and after; the rest stays.
# shellcheck disable=SC2317 # called by name
double() { # of 0.25, 0.5 or 0.75
    case $1 in 0.25) bytes 63 208 ;; 0.5) bytes 63 224 ;; 0.75) bytes 63 232 ;; esac
    bytes 0 0 0 0 0 0
}
# shellcheck disable=SC2317
float() {
    case $1 in 0.25) bytes 62 128 ;; 0.5) bytes 63 0 ;; 0.75) bytes 63 64 ;; esac
    bytes 0 0
}
# shellcheck disable=SC2317
int() { bytes 0 0 0 "$1"; }
# shellcheck disable=SC2317
long() { bytes 0 0 0 0 0 0 0 "$1"; }
list='0.25 0.25 0.25 0.75 0.25 0.25 0.25 0.75 0.25 0.25 0.25 0.75 0.5 0.75 0.5'
all() { # FUNCTION NUMBER...
    function=$1
    shift
    for number in "$@"; do $function "$number"; done
}
vtk_head() {
    printf '# vtk DataFile Version %s\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\nTIME 1 1 double\n' "$1"
    printf '\nPOINTS\n\nPOINTS 5 %s\n' "$2" # eight bytes that look like a section
}
tail_of() {
    printf '\nCELL_TYPES 2\n'
    all int 10 10
    printf '\nPOINT_DATA 5\nSCALARS CELLS int 1\nLOOKUP_TABLE default\n'
    all int 1 2 3 4 0
    printf '\n'
}
# shellcheck disable=SC2086 # numbers
for type in float double; do
    {
        vtk_head 3.0 $type
        all $type $list
        printf '\nMETADATA\nINFORMATION 0\n\nCELLS 2 10\n'
        all int 4 0 1 2 3 4 0 4 2 3
        tail_of
    } >old.$type.vtk
    {
        vtk_head 5.1 $type
        all $type $list
        printf '\nCELLS 3 8\nOFFSETS vtktypeint64\n'
        all long 0 4 8
        printf '\nCONNECTIVITY vtktypeint64\n'
        all long 0 1 2 3 0 4 2 3
        tail_of
    } >new.$type.vtk
done
echo "$list" | tr ' ' '\n' | paste - - - >vertices
run 0 map -s cube.obj -t moved.obj -p vertices -o images
for name in old.float old.double new.float new.double; do
    run 0 mesh -s cube.obj -t moved.obj $name.vtk out.vtk
    holds out '2 tetrahedra: 2 keep their orientation'
    n=$(LC_ALL=C awk '{ n += length($0) + 1 } /^POINTS 5 double$/ { print n; exit }' out.vtk)
    tail -c +$((n + 1)) out.vtk | head -c 120 | od -An -v -t f8 --endian=big -w24 >got
    close_to got images 1e-15
    head -c "$n" out.vtk | sed 's/^POINTS 5 double/POINTS 5 '"${name#*.}"'/' >begin
    size=$([ "${name#*.}" = float ] && echo 60 || echo 120)
    head -c "$(wc -c <begin)" $name.vtk | cmp -s - begin || complain "the head of $name has changed"
    tail -c +$((n + 121)) out.vtk >rest
    tail -c +$(($(wc -c <begin) + size + 1)) $name.vtk | cmp -s - rest || complain "the rest of $name has changed"
done
# In the plane the third coordinate becomes a double, too.
run 0 mesh -s square.txt -t square.txt old.float.vtk out.vtk
n=$(LC_ALL=C awk '{ n += length($0) + 1 } /^POINTS 5 double$/ { print n; exit }' out.vtk)
tail -c +$((n + 1)) out.vtk | head -c 120 | od -An -v -t f8 --endian=big -w24 >got
close_to got vertices 1e-15
# What is cut off, or is no number, is refused.
for n in 100 200 260 290 330; do
    head -c $n old.double.vtk >cut.vtk
    run 1 mesh -s cube.obj -t moved.obj cut.vtk out.vtk
    says 'libicc: cut.vtk: '
done
for type in int doubly; do
    sed "s/^POINTS 5 double/POINTS 5 $type/" old.double.vtk >other.vtk
    run 1 mesh -s cube.obj -t moved.obj other.vtk out.vtk
    says 'the points must be of type float or double'
done
finish
