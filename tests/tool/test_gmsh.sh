#!/bin/sh
# Gmsh's .msh, 2.2 and 4.1, as text and as bytes: read in place, all but the coordinates stays; what is spoilt is named.
# shellcheck source-path=SCRIPTDIR source=lib.sh disable=SC2016,SC2317 # $ in names; functions called by name
. "$(dirname "$0")/lib.sh"
make_cubes

points='0.25 0.25 0.25\n0.75 0.25 0.25\n0.25 0.75 0.25\n0.25 0.25 0.75\n'
# shellcheck disable=SC2059 # a format
printf "$points" >vertices
run 0 map -s cube.obj -t moved.obj -p vertices -o images

# Tags are not consecutive; nodes on surfaces have parameters.
old() {
    printf '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n3 7 "part"\n$EndPhysicalNames\n$Nodes\n4\n'
    paste -d ' ' tags "$1"
    printf '$EndNodes\n$Elements\n2\n1 15 2 7 -1 40\n9 4 2 7 -1 3 10 20 40\n$EndElements\n'
    printf '$NodeData\n1\n"t"\n0\n3\n0\n1\n1\n3 0.5\n$EndNodeData\n'
}
new() {
    printf '$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 4 3 40\n2 1 1 2\n3\n10\n'
    sed -n '1,2s/$/ 8 9/p' "$1"
    printf '3 1 0 2\n20\n40\n'
    sed -n '3,4p' "$1"
    printf '$EndNodes\n$Elements\n1 1 9 9\n3 1 4 1\n9 3 10 20 40\n$EndElements\n'
}
printf '3\n10\n20\n40\n' >tags
for version in old new; do
    $version vertices >$version.msh
    run 0 mesh -s cube.obj -t moved.obj $version.msh out.msh
    holds out '1 tetrahedra: 1 keep their orientation'
    $version images >expected.msh
    same out.msh expected.msh "text of version $version"
done

# Bytes, in the other order than this machine's, too. All numbers are below 256.
whole() { # SIZE NUMBER..., in the order $order
    size=$1
    shift
    for number in "$@"; do
        zeros=$(printf '\\000%.0s' $(seq 2 "$size"))
        byte=$(printf '\\%03o' "$number")
        # shellcheck disable=SC2059 # a format
        if [ "$order" = big ]; then printf "$zeros$byte"; else printf "$byte$zeros"; fi
    done
}
# shellcheck disable=SC2059 # a format
quarters() { # 1 or 3 of them
    for number in "$@"; do
        last=$([ "$number" = 1 ] && echo 320 || echo 350)
        if [ "$order" = big ]; then printf "\\077\\$last\\0\\0\\0\\0\\0\\0"; else printf "\\0\\0\\0\\0\\0\\0\\$last\\077"; fi
    done
}
for order in little big; do
    {
        printf '$MeshFormat\n4.1 1 8\n' && whole 4 1 && printf '\n$EndMeshFormat\n$Nodes\n'
        whole 8 1 4 3 40 && whole 4 3 1 0 && whole 8 4 3 10 20 40
        quarters 1 1 1 3 1 1 1 3 1 1 1 3
        printf '\n$EndNodes\n$Elements\n'
        whole 8 1 1 9 9 && whole 4 3 1 4 && whole 8 1 9 3 10 20 40
        printf '\n$EndElements\n'
    } >new.$order.msh
    {
        printf '$MeshFormat\n2.2 1 8\n' && whole 4 1 && printf '\n$EndMeshFormat\n$Nodes\n4\n'
        whole 4 3 && quarters 1 1 1 && whole 4 10 && quarters 3 1 1
        whole 4 20 && quarters 1 3 1 && whole 4 40 && quarters 1 1 3
        printf '\n$EndNodes\n$Elements\n1\n'
        whole 4 4 1 2 9 7 1 3 10 20 40
        printf '\n$EndElements\n'
    } >old.$order.msh
    run 0 mesh -s cube.obj -t moved.obj old.$order.msh out.msh
    holds out '1 tetrahedra: 1 keep their orientation'
    run 0 mesh -s cube.obj -t moved.obj new.$order.msh out.msh
    holds out '1 tetrahedra: 1 keep their orientation'
    at=$(LC_ALL=C grep -abo 'EndNodes' out.msh | cut -d: -f1)
    tail -c +$((at - 97)) out.msh | head -c 96 | od -An -v -t f8 --endian=$order -w24 >got
    close_to got images 1e-15
    head -c 150 new.$order.msh >cut.msh
    run 1 mesh -s cube.obj -t moved.obj cut.msh out.msh
    says 'libicc: cut.msh: byte 14'
done

# spoilt EDIT WORDS: what is wrong is named with its line.
spoilt() {
    sed "$1" old.msh >spoilt.msh
    run 1 mesh -s cube.obj -t moved.obj spoilt.msh out.msh
    says "spoilt.msh:$2"
}
spoilt 's/^2\.2/1.0/' "2: version 1 of Gmsh's format"
spoilt 's/ 10 20 40$/ 10 20 41/' '18: an element has a node with the tag 41'
spoilt 's/^9 4 2/9 29 2/' "18: an element of Gmsh's type 29"
spoilt 's/^10 /3 /' ' two nodes have the tag 3'
spoilt '/EndNodeData/d' "20: the section 'NodeData' has no end"
# A mesh is its own cage: its boundary, in space and in the plane.
cage() {
    printf '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 %s 0 0\n3 %s 1 0\n4 0 %s\n$EndNodes\n' "$1" "$2" "$3"
    printf '$Elements\n%s\n$EndElements\n' "$4"
}
cage 1 0 '0 1' '1
1 4 2 0 1 1 2 3 4' >corner.msh
cage 2 0 '0 1' '1
1 4 2 0 1 1 2 3 4' >stretched.msh
echo '0.25 0.25 0.25' >one.txt
run 0 map -s corner.msh -t stretched.msh -p one.txt
echo '0.5 0.25 0.25' | close_to out - 1e-12
cage 1 1 '1 0' '2
1 2 2 0 1 1 2 3
2 2 2 0 1 1 3 4' >square.msh
run 0 check -s square.msh
holds out 'a simple polygon, 4 vertices, counter-clockwise, area 1'
finish
