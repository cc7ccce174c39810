#!/bin/sh
# Solids with voids, surfaces, points and lines inside: the ways to give them, how they correspond, and what is wrong with
# them, by their names.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# box NAME X SIZE FIRST: an object of OBJ, a cube from (X, X, X) on. FIRST vertices come before it.
box() {
    awk -v name="$1" -v x="$2" -v size="$3" -v n="$4" 'BEGIN {
        if (name != "") print "o " name
        for (i = 0; i < 8; i++) print "v", x + size * (i % 2), x + size * (int(i / 2) % 2), x + size * int(i / 4)
        split("1 3 4 1 4 2 5 6 8 5 8 7 1 2 6 1 6 5 3 7 8 3 8 4 1 5 7 1 7 3 2 4 8 2 8 6", v, " ")
        for (i = 1; i <= 36; i += 3) print "f", n + v[i], n + v[i + 1], n + v[i + 2] }'
}

{ box outer 0 10 0; box void.1 1 1 8; box surface.1 3 2 16; printf 'o nerve\nv 7 7 7\nv 8 8 8\nl 25 26\n'; } >solid.obj
{ box surface.1 3 2 0; box outer 0 10 8; box void.1 1 1 16; printf 'o nerve\nv 7 7 7\nv 8 8 8\nl 25 26\n'; } >turned.obj

run 0 check -s solid.obj --json=report.json
tr -d ' \n' <report.json >line
holds line '"vertices":8,"inside":{"holes":1,"regions":1,"lines":1,"points":0,"vertices":18,"facets":24,'
holds line '"facets":12,'
run 0 check -s solid.obj
holds out '8 vertices, 12 faces, facing outward, volume 999, with 1 void, 1 surface and 1 line inside: 18 vertices, 24 faces'

# The same solid from several files.
box "" 0 10 0 >outer.obj
box "" 1 1 0 >void.obj
box "" 3 2 0 >surface.obj
printf '[{"name": "nerve", "source": [[7, 7, 7], [8, 8, 8]], "target": [[7, 7, 7], [8, 8, 8]]}]\n' >lines.json
printf 'name,x,y,z\ntip,8,2,2\n' >points.csv
run 0 check -s outer.obj --void=void.obj --surface surface.obj --feature-lines lines.json --feature-points points.csv \
    --json=report.json
tr -d ' \n' <report.json >line
holds line '"inside":{"holes":1,"regions":1,"lines":1,"points":1'

# What meets, by its name.
{ box outer 0 10 0; box void.1 1 2 8; box void.2 2 2 16; } >meets.obj
run 1 check -s meets.obj
grep -q 'void.2' err || complain "void.2 is not named: $(cat err)"
grep -q 'void.1' err || complain "void.1 is not named: $(cat err)"
printf 'tip,1.5,1.5,1.5\n' >inside.csv
run 1 check -s solid.obj --feature-points inside.csv
holds err tip

# Objects correspond by name, whatever their order; each needs a partner, with the same faces.
{ box outer 0 10 0; box void.2 1 1 8; } >other.obj
run 1 map -s solid.obj -t other.obj -p points.csv
says "'void.1' of the source has no partner in the target"
{ cat solid.obj; box void.2 6 1 26; } >more.obj
run 1 map -s solid.obj -t more.obj -p points.csv
says "target: 'void.2' has no partner in the source"
{ box outer 0 10 0; box void.1 1 1 8 | sed 's/^f 9 11 12$/f 11 12 9/'; box surface.1 3 2 16; printf 'o nerve\nv 7 7 7\nv 8 8 8\nl 25 26\n'; } >faces.obj
run 1 map -s solid.obj -t faces.obj -p points.csv
says "'void.1' has other faces than in the source"

# Two sides of points and lines.
run 1 map -s outer.obj -t outer.obj --feature-points points.csv -p points.csv
says '--target-feature-points FILE is missing'
run 1 map -s outer.obj -t outer.obj --feature-lines lines.json --target-feature-lines lines.json -p points.csv
says '--target-feature-lines must be left out'
printf '# Markups fiducial file version = 4.11\n# CoordinateSystem = RAS\n1,8,2,2,0,0,0,1,1,1,0,tip,,\n' >ras.fcsv
sed 's/RAS/LPS/' ras.fcsv >lps.fcsv
run 1 map -s outer.obj -t outer.obj --feature-points ras.fcsv --target-feature-points lps.fcsv -p points.csv
says 'the axes are LPS, but RAS'

# The map's tetrahedra, before and after, without points. A mesh of the source's file is one of its inside.
box "" 0 12 0 >moved.obj
run 0 map -s outer.obj -t moved.obj --mesh-out before.mesh --target-mesh-out after.mesh
[ ! -s out ] || complain "points were read: $(cat out)"
for side in before after; do
    sed -n '/^Tetrahedra/,$p' $side.mesh >$side.cells
    awk '/^Vertices/ { getline; n = $1; for (i = 1; i <= 8; i++) { getline; print $1, $2, $3 } exit }' $side.mesh >$side.txt
done
same before.cells after.cells
sed -n 's/^v //p' outer.obj >before.expected
sed -n 's/^v //p' moved.obj >after.expected
same before.txt before.expected
same after.txt after.expected
awk 'NF == 5 && $5 != 1 { bad = 1 } END { exit bad }' before.cells || complain "a solid without surfaces inside has regions"
run 0 check -s outer.obj --mesh before.mesh
printf '5 5 5\n' >middle.txt
run 0 map -s outer.obj -t moved.obj --mesh-out before.mesh -p middle.txt
[ "$(wc -l <out)" -eq 1 ] || complain "no image of a point: $(cat out)"

# A surface inside divides the tetrahedra: 1 outside of it, 2 within. The objects may come in another order.
run 0 map -s solid.obj -t turned.obj --mesh-out before.mesh --target-mesh-out after.mesh
awk 'NF == 5 { n[$5]++; if ($5 != 1 && $5 != 2) bad = 1 } END { exit bad || !n[1] || !n[2] }' before.mesh || complain "regions are wrong"

# The same numbers in all formats. Each line is a tetrahedron: its corners from 1, and its region.
medit() { awk '$1 == "Tetrahedra" || $1 == "Triangles" { on = 1; getline; next } on && NF > 3' "$1"; }
# shellcheck disable=SC2317 # called by name
gmsh() { awk '$1 == "$Elements" { on = 1; getline; next } on && NF > 3 { if ($4 != $5) print "tags differ"; $1 = $2 = $3 = $4 = ""; r = $5; $5 = ""; print $0, r }' "$1"; }
# shellcheck disable=SC2317 # called by name
vtk() { awk '$1 == "CELLS" { on = 1; next } $1 == "CELL_TYPES" { on = 0 } $1 == "LOOKUP_TABLE" { on = 2; next }
    on == 1 { c = $2 + 1; for (i = 3; i <= NF; i++) c = c " " $i + 1; cell[++n] = c } on == 2 { print cell[++k], $1 }' "$1"; }
# shellcheck disable=SC2317 # called by name
vtu() { awk '/Name=/ { split($0, a, "\""); for (i in a) if (a[i] ~ / Name=/) name = a[i + 1]; k = 0; next } /^</ { name = ""; next }
    name == "connectivity" { c = $1 + 1; for (i = 2; i <= NF; i++) c = c " " $i + 1; cell[++n] = c } name == "region" { print cell[++k], $1 }' "$1"; }
formats_agree() {
    medit "$1.mesh" >expected
    [ -s expected ] || complain "$1.mesh has no elements"
    for form in "gmsh msh" "vtk vtk" "vtu vtu"; do
        ${form% *} "$1.${form#* }" | awk '{ $1 = $1; print }' >found
        same found expected
    done
}
for end in msh vtk vtu; do
    run 0 map -s solid.obj -t turned.obj --mesh-out before.$end --target-mesh-out after.$end
done
formats_agree before
formats_agree after

# Read again, they give the same regions, whatever the format. Those of one mesh alone, and those that touch, are not kept.
awk 'NF == 5 { n[$5]++ } END { print n[1], n[2] }' before.mesh >wanted
for end in mesh msh vtk vtu; do
    run 0 map --mesh before.$end --target-mesh after.$end --mesh-out again.mesh
    awk 'NF == 5 { n[$5]++ } END { print n[1], n[2] }' again.mesh >found
    same found wanted
done
run 0 check --mesh before.msh --target-mesh after.msh
holds out 'with 1 region inside: 8 vertices, 12 faces'
run 0 mesh --mesh before.vtu --target-mesh after.vtu before.mesh again.mesh
sed 's/ 2 2 2 / 2 1 1 /' after.msh >one.msh
run 0 map --mesh before.msh --target-mesh one.msh --mesh-out again.mesh
says 'the map does not keep the regions, because the meshes do not have the same number of them'
awk '/^Tetrahedra/ { on = 1 } on && NF == 5 { $5 = NR % 2 + 1 } { print }' before.mesh >touch.mesh
run 0 map --mesh touch.mesh --target-mesh touch.mesh --mesh-out again.mesh
says 'the map does not keep the regions: a surface between regions touches the boundary'
for end in mesh msh vtk vtu; do
    run 0 check -s before.$end
    grep -q 'volume 999' out || complain "$end: $(cat out)"
done
printf '0 0\n4 0\n4 3\n0 4\n' >flat.txt
for end in mesh msh vtk vtu; do
    run 0 map -s flat.txt -t flat.txt --mesh-out flat.$end
done
formats_agree flat
run 0 mesh -s flat.txt -t flat.txt flat.msh same.msh

# What lies inside, for other commands: filled, carried and drawn.
for end in mesh msh vtk vtu; do
    run 0 mesh --fill --void void.obj --surface surface.obj --feature-lines lines.json --feature-points points.csv outer.obj filled.$end
done
sed -i '/^Triangles/,/^Tetrahedra/{/^Tetrahedra/!d}' filled.mesh
formats_agree filled
awk 'NF == 5 { n[$5]++; if ($5 != 1 && $5 != 2) bad = 1 } END { exit bad || !n[1] || !n[2] }' filled.mesh || complain "filled regions are wrong"
run 0 mesh -s outer.obj -t outer.obj --void void.obj --target-void void.obj --surface surface.obj --target-surface surface.obj \
    before.mesh again.mesh
medit again.mesh >found
medit before.mesh >expected
same found expected
run 0 plot -s outer.obj -t outer.obj --void void.obj --target-void void.obj out.svg
run 2 mesh --fill --target-void void.obj outer.obj out.mesh
says '--target-void needs --target'
run 2 mesh --fit lines.json --surface surface.obj flat.msh out.msh
says '--surface does not go with --fit'

printf '4 4 4\n7.5 7.5 7.5\n9 9 1\n' >some.txt
run 0 map -s solid.obj -t turned.obj -p some.txt
close_to out some.txt 1e-9

# Wrong uses.
printf '0 0\n1 0\n1 1\n' >plane.txt
run 1 check -s plane.txt --void void.obj
says 'this is no surface in space'
printf '0 0 0\n1 0 0\n0 1 0\n0 0 1\n' >corners.txt
run 1 check -s outer.obj --void corners.txt
says '--void takes one closed surface a file'
run 1 check -s outer.obj --surface solid.obj
says 'there are several objects'
run 1 map -s solid.obj -t turned.obj -p points.csv --fill-holes
says '--fill-holes is for cages in the plane'
run 2 check -s outer.obj --target-void void.obj
says '--target-void needs --target'
run 2 check -s outer.obj --target-feature-points points.csv
says '--target-feature-points needs --feature-points'
run 2 map -s solid.obj -t turned.obj --mesh-out out.mesh --map curves
says '--mesh-out needs a mesh map'
run 2 map -s solid.obj -t turned.obj --mesh-out out.json
run 2 map -s outer.obj -t outer.obj --void void.obj --target-void void.obj --mesh-out void.obj

finish
