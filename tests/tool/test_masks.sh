#!/bin/sh
# Masks: every form of .npy, what is wrong with them, their boundaries and what becomes of them.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# npy VERSION HEADER: what stands before the data.
npy() {
    printf '\223NUMPY'
    n=$((${#2} + 1))
    if [ "$1" = 1 ]; then
        bytes 1 0 $((n % 256)) $((n / 256))
    else
        bytes "$1" 0 $((n % 256)) $((n / 256)) 0 0
    fi
    printf '%s\n' "$2"
}

# An L of 3 x 2 cells: (0,0) (1,0) (2,0) (0,1), and its boundary, counter-clockwise.
{ npy 1 "{'descr': '|u1', 'fortran_order': False, 'shape': (3, 2), }" && bytes 1 1 7 0 255 0; } >l.npy
run 0 check -s l.npy --boundary l.txt
holds out 'l.npy: a mask of 3 x 2 cells, 4 of them inside, in one piece without holes; its boundary: 20 vertices, 20 facets'
holds err 'libicc: l.txt: the first coordinate is the row (axis 0 of the array), and the second is the column'
[ "$(wc -l <l.txt)" -eq 20 ] || complain "the boundary has not 20 vertices"
awk '{ x[NR] = $1; y[NR] = $2 } END { for (i = 1; i <= NR; i++) { j = i % NR + 1; a += x[i] * y[j] - x[j] * y[i] }
       exit a != 8 }' l.txt || complain "the area of the boundary is not 4"
run 0 check -s l.npy --json
holds out '"checked": "mask"'
holds out '"valid": true'

# The same mask in other forms.
{ npy 1 '{"shape": (3,2), "fortran_order": True, "descr": "<i4"}' &&
    bytes 1 0 0 0 0 1 0 0 0 0 0 255 0 0 0 1 0 0 0 0 0 0 0 0; } >other.npy
run 0 check -s other.npy --boundary fortran.txt
{ npy 1 "{'descr': '|b1', 'fortran_order': True, 'shape': (3, 2), }" && bytes 1 1 1 1 0 0; } >fortran.npy
run 0 check -s fortran.npy --boundary fortran.txt
same fortran.txt l.txt
{ npy 2 "{'descr': '|b1', 'fortran_order': False, 'shape': (3, 2), }" && bytes 1 1 1 0 1 0; } >two.npy
{ npy 3 "{ 'shape':(3,2) , 'descr':'>u2','fortran_order':False}" && bytes 0 1 1 0 1 1 0 0 0 2 0 0; } >three.npy
for file in two.npy three.npy; do
    run 0 check -s "$file" --boundary other.txt
    same other.txt l.txt
done

# A mask is a cage: its points go where its boundary goes.
awk '{ printf "%.17g %.17g\n", 2 * $1 + $2 / 4, $2 - $1 / 8 }' l.txt >moved.txt
printf '0.5 0.5\n1.7 0.3\n0.25 1.75\n' >points.txt
run 0 map -s l.npy -t l.txt -p points.txt
close_to out points.txt 1e-9
run 0 map -s l.npy -t moved.txt -p l.txt
close_to out moved.txt 1e-9
run 0 check -s l.npy -t moved.txt
holds out 'certified one-to-one'
run 0 info -s l.npy
holds out 'area 4'
run 0 plot -s l.npy -m gradient l.svg
head -n 19 l.txt >bad
run 1 map -s l.npy -t bad -p points.txt
says 'libicc: bad: 19 vertices, but the boundary of the mask l.npy has 20'
run 1 map -s l.npy -t l.npy -p points.txt
says 'libicc: l.npy: a mask cannot be a target'
run 1 map -s l.txt -t l.npy -p points.txt
says 'libicc: l.npy: a mask cannot be a target'
run 1 check -s l.txt --boundary out.txt
says 'libicc: l.txt: this is neither a mask nor a picture'

# A boundary whose columns are swapped is the cage of a picture that is laid out like the mask; the mask itself is not, and says so.
{ npy 1 "{'descr': '|u1', 'fortran_order': False, 'shape': (3, 4), }" && bytes 1 1 1 0 1 1 1 0 0 0 0 0; } >wide.npy
run 0 check -s wide.npy --boundary wide.txt
awk '{ print $2, $1 }' wide.txt >cage.txt
awk '{ print $1 + 1, $2 }' cage.txt >shifted.txt
printf 'P2 4 3 255\n10 20 30 40\n50 60 70 80\n90 90 90 90\n' >in.pgm
run 0 warp -s cage.txt -t shifted.txt in.pgm out.png
[ ! -s err ] || complain "$(cat err)"
run 0 warp -s wide.npy -t wide.txt in.pgm out.png
holds err 'libicc: wide.npy: x is axis 0 of a mask, its rows; in the picture x counts columns'

# In space and beyond. The first axis of the array is x.
{ npy 1 "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 1, 1), }" && bytes 1 1; } >bar.npy
run 0 check -s bar.npy --boundary bar.obj
run 0 check -s bar.npy --boundary bar.txt
holds err 'libicc: bar.txt: x is axis 0 of the array, y axis 1, z axis 2'
[ "$(grep -c '^v' bar.obj)" -eq "$(wc -l <bar.txt)" ] || complain "bar.obj and bar.txt differ"
[ "$(sort -n bar.txt | tail -n 1 | cut -d ' ' -f 1)" = 2 ] || complain "axis 0 is not x"
run 1 check -s bar.obj -m gradient
holds out 'facing outward, volume 2'
awk '/^v/ { printf "v %.17g %.17g %.17g\n", $2, $3 + $2 * $2 / 8, $4; next } { print }' bar.obj >bent.obj
printf '0.31 0.42 0.53\n1.71 0.22 0.64\n' >points.txt
run 0 map -s bar.npy -t bent.obj -p points.txt -o there
run 0 map -s bar.npy -t bent.obj -p there -i
close_to out points.txt 1e-9
sed -n 's/^v //p' bent.obj >bent.txt
run 0 map -s bar.npy -t bent.txt -p points.txt
same out there
{ npy 1 "{'descr': '|u1', 'fortran_order': False, 'shape': (1, 1, 1, 2), }" && bytes 1 1; } >four.npy
run 0 check -s four.npy --boundary four.txt
awk 'NF != 4 { bad = 1 } END { exit bad || NR < 16 }' four.txt || complain "four.txt has not 4 columns"
{ npy 1 "{'descr': '|u1', 'fortran_order': False, 'shape': (3,), }" && bytes 0 1 1; } >one.npy
run 0 check -s one.npy --boundary one.txt
run 1 warp -s bar.npy -t bent.obj a.png b.png
says 'libicc: bar.npy: 3 dimensions; warp needs cages in the plane'

# Contacts can be filled.
{ npy 1 "{'descr': '|u1', 'fortran_order': False, 'shape': (3, 3), }" && bytes 1 1 0 1 0 1 1 1 1; } >touch.npy
run 1 check -s touch.npy
says 'libicc: touch.npy: '
run 0 check -s touch.npy --repair mended.npy --json
holds out '"filled_cells": '
run 0 check -s mended.npy

# rejects MESSAGE: standard input is no mask.
rejects() {
    cat >bad
    run 1 check -s bad
    says 'libicc: bad: '
    says "$1"
}
good="{'descr': '|u1', 'fortran_order': False, 'shape': (2, 2), }"
{ npy 1 "$good" && bytes 0 0 0 0; } | rejects 'the mask is empty'
{ npy 1 "$good" && bytes 1 0 0 1; } | rejects 'not one piece'
{ npy 1 "$good" && bytes 1 1 1; } | rejects '3 bytes of data'
{ npy 1 "$good" && bytes 1 1 1 1 1; } | rejects '5 bytes of data'
{ npy 4 "$good" && bytes 1 1 1 1; } | rejects 'version 4'
{ npy 1 "$good" && bytes 1 1 1 1; } | head -c 40 | rejects 'ends within its header'
{ npy 1 "{'descr': '<f8', 'fortran_order': False, 'shape': (1,), }" && bytes 0 0 0 0 0 0 248 127; } |
    rejects "of type '<f8'"
for type in '|u3' 'u' '|b2' '|S1' '<c8' '|u1x' ''; do
    { npy 1 "{'descr': '$type', 'fortran_order': False, 'shape': (1,), }" && bytes 1; } | rejects "of type '$type'"
done
for entry in "'descr': [('a', 'u1')]|has fields" "'descr': 7|no name or type" "'shape': 4|lacks a '('" \
    "'shape': ()|no axes" "'shape': (0, 5)|axis 0 of the array has no cells" "'shape': (1,1,1,1,1,1,1)|more than 6 axes" \
    "'shape': (2 2)|not a list of numbers" "'shape': (-2, 2)|not a list of numbers" "'shape': (,)|not a list of numbers" \
    "'fortran_order': 1|neither True nor False" "'colour': 1|'colour' in it, which is unknown"; do
    { npy 1 "{${entry%|*}, }" && bytes 1 1 1 1; } | rejects "${entry#*|}"
done
for shape in '99999999999999999999, 2' '4294967296, 4294967296' '3, 1'; do
    { npy 1 "{'descr': '|u1', 'fortran_order': False, 'shape': ($shape)}" && bytes 1 1 1 1; } | rejects '4 bytes of data'
done
{ npy 1 "{'descr': '|u1', 'shape': (2, 2)}" && bytes 1 1 1 1; } | rejects 'lacks descr, fortran_order or shape'
{ npy 1 "{'descr': '|u1', 'descr': '|u1'}" && bytes 1 1 1 1; } | rejects "'descr' twice"
{ npy 1 "{'descr': '|u1'" && bytes 1 1 1 1; } | rejects "lacks a '}'"
{ npy 1 "['descr']" && bytes 1 1 1 1; } | rejects "lacks a '{'"
finish
