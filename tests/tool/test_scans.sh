#!/bin/sh
# `check --repair` mends scans: repeated faces, small pieces, faces turned over, small holes. Each is named.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# torus SIDES: a torus of 2 * SIDES^2 faces, as `vertices` and `faces`.
torus() {
    awk -v n="$1" 'BEGIN {
        turn = 8 * atan2(1, 1) / n
        for (i = 0; i < n; i++) for (j = 0; j < n; j++) {
            r = 3 + cos(j * turn)
            printf "%.17g %.17g %.17g\n", r * cos(i * turn), r * sin(i * turn), sin(j * turn) > "vertices"
            a = i * n + j; b = (i + 1) % n * n + j; c = (i + 1) % n * n + (j + 1) % n; d = i * n + (j + 1) % n
            print 3, a, b, c > "faces"
            print 3, a, c, d > "faces"
        }
    }'
}

# off NAME FACES VERTICES: writes them as OFF.
off() {
    { echo OFF; echo "$(wc -l <"$3") $(wc -l <"$2") 0"; cat "$3" "$2"; } >"$1"
}

# mends NAME FACES TEXT: the file becomes a surface with that many faces, and the message holds the text.
mends() {
    rm -f mended.off
    run 0 check -s "$1" --repair mended.off
    [ "$(awk 'NR == 2 { print $2 }' mended.off)" = "$2" ] || complain "$1: $(sed -n 2p mended.off), not $2 faces"
    [ -z "$3" ] || holds err "$3"
    run 0 check -s mended.off
}

# refuses NAME TEXT: nothing is written.
refuses() {
    rm -f mended.off
    run 1 check -s "$1" --repair mended.off
    holds err "$2"
    [ ! -e mended.off ] || complain "$1: a file was written"
}

torus 12
off whole.off faces vertices
mends whole.off 288 ''
cp mended.off whole_again.off

sed -n '5p;9p' faces | cat faces - >repeated
sed -n 20p faces | awk '{ print 3, $3, $2, $4 }' >>repeated
off repeated.off repeated vertices
run 1 check -s repeated.off
mends repeated.off 288 '3 faces left out, because earlier ones have the same corners: 288, 289, 290'

awk 'NR % 40 == 7 { print 3, $2, $4, $3; next } { print }' faces >turned
off turned.off turned vertices
mends turned.off 288 '8 faces turned over, like the others around: 6, 46, 86'
same mended.off whole_again.off
awk '{ print 3, $2, $4, $3 }' faces >outside_in
off outside_in.off outside_in vertices
mends outside_in.off 288 ''

# The star of a vertex, and two holes that meet at a vertex.
awk '$2 != 40 && $3 != 40 && $4 != 40' faces >holed
off holed.off holed vertices
mends holed.off 286 'a hole of 6 sides is filled'
awk 'NR != 100 && NR != 103' faces >pinched
off pinched.off pinched vertices
mends pinched.off 288 'a hole of 3 sides is filled'
run 0 check -s pinched.off --repair mended.off --json=report.json
holds report.json '"filled_holes": 2'
awk '$2 > 40' faces >open
off open.off open vertices
refuses open.off 'is too large to be filled: more than 5 % of the surface'

# A crumb beside the body goes, a piece inside it is a void, and a large one is refused.
printf '9 9 9\n9.1 9 9\n9 9.1 9\n9 9 9.1\n' | cat vertices - >with_crumb
printf '3 144 146 145\n3 144 145 147\n3 145 146 147\n3 144 147 146\n' | cat faces - >five
off crumb.off five with_crumb
mends crumb.off 288 '4 faces left out, in 1 small piece beside the body: 288, 289, 290, 291'
[ "$(awk 'NR == 2 { print $1 }' mended.off)" = 144 ] || complain "the vertices of the crumb are kept"
printf '3 0 0\n3.1 0 0\n3 0.1 0\n3 0 0.1\n' | cat vertices - >with_void
awk 'NR > 288 { print 3, $2, $4, $3; next } { print }' five >inward
off void.off inward with_void
mends void.off 292 ''
{ cat vertices; awk '{ print $1 + 20, $2, $3 }' vertices; } >twice
{ cat faces; awk '{ print 3, $2 + 144, $3 + 144, $4 + 144 }' faces; } >twice_faces
off twice.off twice_faces twice
refuses twice.off 'more than one component'

# A Moebius strip.
awk 'BEGIN { turn = 8 * atan2(1, 1) / 20
    for (i = 0; i < 20; i++) for (s = -1; s <= 1; s += 2) {
        r = 3 + s * cos(i * turn / 2) / 2
        printf "%.17g %.17g %.17g\n", r * cos(i * turn), r * sin(i * turn), s * sin(i * turn / 2) / 2 } }' >moebius
awk 'BEGIN { for (i = 0; i < 20; i++) { a = 2 * i; b = a + 1; c = a + 2; d = a + 3
    if (i == 19) { c = 1; d = 0 }
    print 3, a, c, b; print 3, b, c, d } }' >strip_faces
off strip.off strip_faces moebius
refuses strip.off 'has one side only'
finish
