#!/bin/sh
# Foliations of conforming meshes: --mesh, --target-mesh, and what is wrong with them.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cubes

# fill CORNERS CENTRE: tetrahedra from the centre to the faces, with the vertices in reverse order.
fill() {
    printf 'MeshVersionFormatted 2\nDimension 3\nVertices\n9\n'
    { echo "$2" && tac "$1"; } | sed 's/$/ 0/'
    printf 'Tetrahedra\n12\n'
    sed 's/^f //' faces | while read -r a b c; do
        echo "$((10 - a)) $((10 - b)) $((10 - c)) 1 0"
    done
    echo End
}
fill corners.txt '0.5 0.5 0.5' >in.mesh
fill moved.txt '0.55 0.6 0.55' >out.mesh

# All tetrahedra meet at one point inside. So the map is linear in each, and before it is improved the image of that point
# is the harmonic one.
printf '0.75 0.75 0.75\n0.5 0.5 0.5\n0.25 0.5 0.5\n0 0 0\n1 1 1\n' >points
printf '1 0.9375 0.7708333333333334\n0.5 0.625 0.5416666666666667\n0.25 0.625 0.5208333333333334\n0 0 0\n1.5 1.25 1\n' >expected
run 0 map -s cube.obj -t moved.obj --mesh in.mesh --target-mesh out.mesh --improve 0 -p points -o images
close_to images expected 1e-15
run 0 map -s cube.obj -t moved.obj --mesh in.mesh --target-mesh out.mesh --improve 0 --inverse -p images -o back
close_to back points 1e-15
run 0 check -s cube.obj -t moved.obj --mesh in.mesh --target-mesh out.mesh -m foliation
holds out 'foliation chart certified: 12 tetrahedra, none of them inverted; every leaf runs from the boundary to the maximum'
holds out 'map: mesh, certified one-to-one: all 12 tetrahedra keep'
run 0 check -s cube.obj -t moved.obj --mesh in.mesh --target-mesh out.mesh --map curves
holds out 'map: curves, certified one-to-one'
run 0 check -s cube.obj -t moved.obj --mesh in.mesh --target-mesh out.mesh
holds out 'map: mesh, certified one-to-one: all 12 tetrahedra keep'
run 0 info -s cube.obj -t moved.obj --mesh in.mesh --target-mesh out.mesh -m foliation
holds out 'mesh        9 vertices, 8 of them on the boundary, 12 tetrahedra'
holds out 'maximum     0.5 0.5 0.5'
holds out '; 2 complete ones to choose from'
holds out 'tetrahedra  12, 9 vertices'
run 0 info -s cube.obj --mesh in.mesh --json=report.json
holds report.json '"mesh_triangles": 12'
holds report.json '"complete": 2'
run 0 encode -s cube.obj --mesh in.mesh -p points -o coordinates
run 0 decode -s cube.obj --mesh in.mesh --coords coordinates -o back
close_to back points 1e-15

# Vertices that no face has need not be in the mesh.
for name in cube moved; do
    { echo 'v 7 7 7' && cat $name.obj; } | awk '$1 == "f" { print $1, $2 + 1, $3 + 1, $4 + 1; next } { print }' >$name-more.obj
done
run 0 map -s cube-more.obj -t moved-more.obj --mesh in.mesh --target-mesh out.mesh --improve 0 -p points -o images
close_to images expected 1e-15
run 0 map -s cube-more.obj -t moved-more.obj -p points -o images
run 0 map -s cube-more.obj -t moved-more.obj --mesh in.mesh -p points -o images

sed 's/^0.5 0.5 0.5 0$/0 0.5 0.25 0/' in.mesh >flat.mesh
run 1 map -s cube.obj -t moved.obj --mesh flat.mesh --target-mesh out.mesh -p points
says 'libicc: flat.mesh: '
sed 's/^0.5 0.5 0.5 0$/2 2 2 0/' in.mesh >folded.mesh
run 1 map -s cube.obj -t moved.obj --mesh folded.mesh --target-mesh out.mesh -p points
says 'libicc: folded.mesh: '
sed 's/^1 1 1 0$/1 1 0.99 0/' in.mesh >other.mesh
run 1 map -s cube.obj -t moved.obj --mesh other.mesh --target-mesh out.mesh -p points
says 'no vertex of the mesh lies at vertex 7 of the cage'
sed -e 's/^12$/11/' -e '/^9 8 7 1 0$/d' in.mesh >open.mesh
run 1 map -s cube.obj -t moved.obj --mesh open.mesh --target-mesh out.mesh -p points
says 'libicc: open.mesh: '
run 1 map -s cube.obj -t moved.obj --mesh cube.obj --target-mesh out.mesh -p points
says 'there are no tetrahedra'
run 2 check -s cube.obj --mesh in.mesh --target-mesh out.mesh
says '--target-mesh needs --target'

# Surfaces without a mesh are filled, whatever programs there are.
printf '0.51 0.52 0.53\n' >inner
printf '#!/bin/sh\nPATH=/nowhere exec "%s" "$@"\n' "$tool" >bare
chmod +x bare
real=$tool
tool=./bare
run 0 map -s cube.obj -t moved.obj -p points -o images
run 0 map -s cube.obj -t moved.obj --inverse -p images -o back
close_to back points 1e-12
run 0 check -s cube.obj -t moved.obj
holds out 'map: mesh, certified one-to-one'
run 0 info -s cube.obj -t moved.obj
holds out 'map         mesh, certified'
run 0 info -s cube.obj
holds out 'method      foliation, certified'
run 0 map -s cube.obj -t moved.obj --mesh in.mesh -p inner -o images
run 0 map -s cube.obj -t moved.obj --method field -n 12 -p inner -o images
tool=$real
finish
