#!/bin/sh
# Meshes that move without a cage: told vertices, sliding and free boundaries, layers that keep their shape; and the
# one-to-one map nearest to a warp.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# A unit square of n x n cells of triangles as OFF; each vertex goes through the program `moved`, which sets x and y.
grid() {
    awk -v n="$1" "BEGIN { print \"OFF\"; print (n + 1) * (n + 1), 2 * n * n, 0
        for (j = 0; j <= n; j++) for (i = 0; i <= n; i++) { x = i / n; y = j / n; $2; printf \"%.17g %.17g 0\\n\", x, y }
        for (j = 0; j < n; j++) for (i = 0; i < n; i++) { a = j * (n + 1) + i
            print 3, a, a + 1, a + n + 2; print 3, a, a + n + 2, a + n + 1 } }"
}
vertices() {
    sed -n '3,$p' "$1" | awk 'NF == 3 { print $1, $2 }'
}

# The top of a box is told: it sinks in the middle, and the other vertices of the boundary stay.
grid 8 '' >box.off
awk 'BEGIN { for (i = 1; i < 8; i++) { x = i / 8; printf "%d %.17g %.17g\n", 72 + i, x, 1 - 1.2 * x * (1 - x) } }' >bump.txt
run 0 mesh --fit bump.txt box.off fixed.off
holds out 'certified one-to-one'
vertices box.off >before
vertices fixed.off >after
paste -d ' ' before after | awk '{ told = $2 == 1; d = $4 - (told ? 1 - 1.2 * $1 * (1 - $1) : $2); if (d < 0) d = -d; e = $3 - $1; if (e < 0) e = -e
    rim = $1 == 0 || $1 == 1 || $2 == 0; if ((told || rim) && (d > 1e-12 || e > 1e-12)) { print; bad = 1 } } END { exit bad }' ||
    complain 'told or fixed vertices have moved'
# It becomes a slope, to whose end the vertices of the wall below slide or move freely. Fixed ones are in its way.
awk 'BEGIN { for (i = 0; i <= 8; i++) printf "%d %.17g %.17g\n", 72 + i, i / 8, 1 - 0.3 * i / 8 }' >moves.txt
run 4 mesh --fit moves.txt box.off out.off
holds err 'vertices are not at their places'
run 1 mesh --fit moves.txt box.off out.off --require certified
run 0 mesh --fit moves.txt --slide box.off slid.off
vertices slid.off >after
paste -d ' ' before after | awk '($1 == 0 || $1 == 1) && $3 != $1 { bad = 1 } $1 == 1 && $2 > 0 && $2 < 1 && $4 < $2 - 1e-3 { moved++ }
    END { exit bad || moved < 5 }' || complain 'vertices do not slide along their walls'
run 0 mesh --fit moves.txt --free --stiffness 1.5 --reach 0.3 box.off free.off
holds out 'certified one-to-one'

# Vertices by their places, one that slides by its row, and a report.
awk '{ print $2, 1, $2, $3 }' bump.txt >places.txt
run 0 mesh --fit places.txt box.off placed.off
same placed.off fixed.off
{
    cat bump.txt
    echo '71 slide'
} >with_slide.txt
run 0 mesh --fit with_slide.txt box.off slid.off --json
holds out '"certified": true'

# The nearest map: what does not fold stays bit by bit; folds go, and the rest stays.
grid 8 'x += 0.05 * sin(6 * y)' >smooth.off
run 0 mesh --nearest smooth.off box.off out.off
same out.off smooth.off
holds err 'nothing folded, so nothing has changed'
grid 16 '' >fine.off
grid 16 'if (i > 5 && i < 11 && j > 5 && j < 11) { t = x; x = 1 - y; y = t; x = 1 - x }' >folded.off
run 0 mesh --nearest folded.off fine.off out.off
holds err 'faces folded'
holds out 'certified one-to-one'
same fine.off fine.off

# Mistakes.
printf '0 0 0\n200 1 1\n' >bad.txt
run 1 mesh --fit bad.txt box.off out.off
says "bad.txt:2: '200' is no vertex; the mesh has 81, counted from 0"
printf '0 0 0\n0 1 1\n' >bad.txt
run 1 mesh --fit bad.txt box.off out.off
says 'bad.txt:2: vertex 0 is in line 1 already'
printf '0 0 0\n1 slip\n' >bad.txt
run 1 mesh --fit bad.txt box.off out.off
says 'bad.txt:2: a move is'
printf '0 slide\n' >bad.txt
run 1 mesh --fit bad.txt box.off out.off
says 'bad.txt:1: this vertex cannot slide: the boundary has a corner there'
printf '40 slide\n' >bad.txt
run 1 mesh --fit bad.txt box.off out.off
says 'bad.txt:1: this vertex cannot slide: it is not on the boundary'
run 1 mesh --nearest fine.off box.off out.off
says 'fine.off: 289 vertices, but box.off has 81'
make_cubes
run 1 mesh --fit moves.txt cube.obj out.obj
says 'cube.obj: --fit is for meshes in the plane'
run 2 mesh --fit moves.txt -s box.off box.off out.off
says '--source does not go with --fit'
run 2 mesh --slide -s box.off -t box.off box.off out.off
says '--slide goes with --fit'
run 2 mesh --fit moves.txt --slide --free box.off out.off
says '--slide and --free exclude each other'
cp moves.txt moves.off
run 2 mesh --fit moves.off box.off moves.off
says 'OUT would be written over an input'

finish
