#!/bin/sh
# A mesh can be its own cage: the boundary of tetrahedra, in the plane of triangles and larger faces.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# A cube of eight cells in six tetrahedra each, by its corners and one vertex in the middle; the first tetrahedron is listed
# the other way round. moved.mesh: the same, pulled and sheared.
cubes() { # HEAD SCALE
    awk -v s="$1" 'BEGIN { print "MeshVersionFormatted 2\nDimension 3\nVertices 27"
        for (k = 0; k < 3; k++) for (j = 0; j < 3; j++) for (i = 0; i < 3; i++)
            printf "%.17g %.17g %.17g 0\n", i / 2 * s + (s > 1) * k * k / 9, j / 2 + (s > 1) * i / 5, k / 2
        print "Tetrahedra 48"; n = split("1 2 4 8 1 4 3 8 1 3 7 8 1 7 5 8 1 5 6 8 1 6 2 8", t)
        for (k = 0; k < 2; k++) for (j = 0; j < 2; j++) for (i = 0; i < 2; i++) {
            for (c = 0; c < 8; c++) v[c + 1] = 1 + (i + c % 2) + 3 * (j + int(c / 2) % 2) + 9 * (k + int(c / 4))
            for (e = 1; e <= n; e += 4) {
                turn = i + j + k == 0 && e == 1
                print v[t[e]], v[t[e + 1]], v[t[turn ? e + 3 : e + 2]], v[t[turn ? e + 2 : e + 3]], 0 } }
        print "End" }'
}
cubes 1 >a.mesh
cubes 1.5 >b.mesh
run 0 check -s a.mesh
holds out 'a closed surface that does not meet itself, 26 vertices, 48 faces, facing outward, volume 1'
run 0 check -s a.mesh -t b.mesh
holds out 'one-to-one: yes, certified'
run 0 mesh -s a.mesh -t b.mesh a.mesh out.mesh
holds out '48 tetrahedra: 48 keep their orientation'
grep '^[-0-9.e]* [-0-9.e]* [-0-9.e]* 0$' b.mesh | sed '14d' >expected
grep '^[-0-9.e]* [-0-9.e]* [-0-9.e]* 0$' out.mesh | sed '14d' >got
close_to got expected 1e-12
# Without -s; then the mesh is the inside, too.
run 0 mesh --mesh a.mesh --target-mesh b.mesh a.mesh out.mesh
grep '^[-0-9.e]* [-0-9.e]* [-0-9.e]* 0$' out.mesh | sed '14d' >got
close_to got expected 1e-12
run 0 check --mesh a.mesh --target-mesh b.mesh
holds out 'one-to-one: yes, certified'
# An inner vertex that has not moved along turns tetrahedra over, at the boundary, too: the boundary stays the same.
awk 'NR == 17 { print "0.9 0.02 0.05 0"; next } { print }' b.mesh >tangled.mesh
run 0 mesh -s a.mesh -t tangled.mesh a.mesh out.mesh
grep '^[-0-9.e]* [-0-9.e]* [-0-9.e]* 0$' out.mesh | sed '14d' >got
close_to got expected 1e-12
# The order of the elements does not matter, nor do the elements inside.
awk 'NF == 5 { row[++n] = $0; next } { for (; n > 0; n--) print row[n]; print }' b.mesh >shuffled.mesh
run 0 mesh -s a.mesh -t shuffled.mesh a.mesh out.mesh
grep '^[-0-9.e]* [-0-9.e]* [-0-9.e]* 0$' out.mesh | sed '14d' >got
close_to got expected 1e-12
data=$here/../../examples/data
run 0 mesh -s "$data/beam.mesh" -t "$data/bent.mesh" "$data/beam.mesh" out.mesh
holds out '648 tetrahedra: 648 keep their orientation'
run 4 mesh -s "$data/beam.mesh" -t "$data/bent.mesh" --map curves "$data/beam.mesh" out.mesh
n=$(sed -n 's/.*orientation, \([0-9]*\) inverted.*/\1/p' out)
run 0 mesh -s "$data/beam.mesh" -t "$data/bent.mesh" --map curves --untangle "$data/beam.mesh" out.mesh
holds out "; $n were inverted before untangling, $n repaired; mesh and image are certified"
run 0 mesh -s "$data/beam.mesh" -t "$data/bent.mesh" --map curves --untangle --json "$data/beam.mesh" out.mesh
holds out "\"inverted_before\": $n"
holds out "\"repaired\": $n"
echo '5 1 1' >points
run 0 map -s "$data/beam.mesh" -t "$data/bent.mesh" -p points
run 0 check -s "$data/beam.mesh" -t "$data/bent.mesh"
holds out 'one-to-one: yes, certified'
# What has no such boundary is refused by name.
printf 'MeshVersionFormatted 2\nDimension 3\nVertices 8\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n1 1 1 0\n0 1 1 0\n' >hex.mesh
printf 'Hexahedra 1\n1 2 3 4 5 6 7 8 0\nEnd\n' >>hex.mesh
run 1 check -s hex.mesh
says 'the mesh has hexahedra; a cage is the boundary of tetrahedra'
sed 's/^Tetrahedra 48/Tetrahedra 49/; s/^End/1 2 5 14 0\nEnd/' a.mesh >thrice.mesh
run 1 check -s thrice.mesh
says 'faces belong to more than two tetrahedra'
# Two that meet at an edge have no surface.
printf 'MeshVersionFormatted 2\nDimension 3\nVertices 6\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 -1 0 0\n0 0 -1 0\n' >edge.mesh
printf 'Tetrahedra 2\n1 2 3 4 0\n1 2 5 6 0\nEnd\n' >>edge.mesh
run 1 check -s edge.mesh
says 'libicc: edge.mesh: '

# In the plane: a ring with a hole as VTK with a quadrilateral, with z; the hole is a hole of the domain.
ring() { # TURN
    printf '# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 16 double\n'
    awk -v turn="$1" 'BEGIN { for (r = 3; r > 0; r -= 2) for (i = 0; i < 8; i++) {
            a = i * 3.14159265358979 / 4 + (r == 1) * turn; printf "%.17g %.17g 7\n", r * cos(a), r * sin(a) }
        print "CELLS 15 61"; print 4, 0, 1, 9, 8
        for (i = 1; i < 8; i++) { j = (i + 1) % 8; print 3, i, j, i + 8; print 3, j, j + 8, i + 8 }
        print "CELL_TYPES 15\n9"; for (i = 0; i < 14; i++) print 5 }'
}
ring 0 >ring.vtk
ring 0.3 >turned.vtk
run 0 check -s ring.vtk -t turned.vtk
holds out 'one-to-one: yes, certified'
holds out 'with 1 hole inside'
holds err 'heights are left out'
run 0 mesh -s ring.vtk -t turned.vtk ring.vtk out.vtk
sed -n '6,21p' turned.vtk >expected
sed -n '6,21p' out.vtk >got
close_to got expected 1e-12
printf '2 0\n0 2.5\n' >points
run 0 map -s ring.vtk -t turned.vtk -p points
run 1 check --mesh ring.vtk --target-mesh turned.vtk
holds err '--source takes the boundary of a mesh alone'
# OBJ without a third coordinate; a mesh without holes may be the inside, too.
printf 'v 0 0\nv 4 0\nv 4 4\nv 0 4\nv 1 2\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n' >a.obj
sed 's/^v 4 4/v 5 6/' a.obj >b.obj
run 0 check -s a.obj -t b.obj
holds out 'one-to-one: yes, certified'
run 0 check --mesh a.obj --target-mesh b.obj
holds out 'foliation chart certified'
run 0 check -s a.obj -m foliation
# Parts, and outlines that touch themselves, are no cage.
printf 'v 0 0\nv 1 0\nv 0 1\nv 5 5\nv 6 5\nv 5 6\nf 1 2 3\nf 4 5 6\n' >parts.obj
run 1 check -s parts.obj
says 'the mesh has 2 parts; a cage is one'
printf 'v 0 0\nv 1 0\nv 0 1\nv -1 0\nv 0 -1\nf 1 2 3\nf 1 4 5\n' >bow.obj
run 1 check -s bow.obj
says 'the boundary of the mesh passes vertex 0 (from 0) twice'
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 3 0 0\nv 3 1 0\nf 1 2 3\nf 4 5 4\n' >twice.obj
run 1 check -s twice.obj
says 'libicc: twice.obj:4: a face has vertex 3 (from 0) twice'
printf 'v 0 0\nv 1 0\nv 0 1\nv 1 1\nv 2 2\nf 1 2 3\nf 1 2 4\nf 1 2 5\n' >book.obj
run 1 check -s book.obj
says '1 edges belong to more than two triangles'
run 2 map --mesh -
says '--source FILE is missing'
finish
