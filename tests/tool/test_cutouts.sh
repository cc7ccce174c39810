#!/bin/sh
# A picture with a transparent ground is the outline of what is opaque in it: one part, several, with holes, within a distance.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# A black picture, and what `warp` cuts out of it: all but the target cage becomes transparent.
{ printf 'P6\n60 40\n255\n' && head -c 7200 /dev/zero; } >black.ppm
printf '0 0\n60 0\n60 40\n0 40\n' >all.txt

# area FILE: of the picture's shape. The first number after the word.
area() {
    run 0 check -s "$1"
    sed -n 's/.*area \([0-9.]*\).*/\1/p' out
}
# is_near A B SHARE
is_near() {
    awk -v a="$1" -v b="$2" -v share="$3" 'BEGIN { d = a / b - 1; exit !(d < share && -d < share) }' || complain "$1 is not near $2"
}

printf '10.5 5\n52 9\n47 36\n12 31.5\n' >leaning.txt
run 0 warp -s all.txt -t leaning.txt --outside null black.ppm leaning.png
wanted=$(area leaning.txt)
is_near "$(area leaning.png)" "$wanted" 0.03
run 0 check -s leaning.png --boundary outline.txt
[ "$(wc -l <outline.txt)" -le 16 ] || complain "the outline has $(wc -l <outline.txt) vertices"
is_near "$(area outline.txt)" "$wanted" 0.03
run 0 check -s leaning.png --flatten 0.1 --boundary fine.txt
[ "$(wc -l <fine.txt)" -gt "$(wc -l <outline.txt)" ] || complain "a smaller distance needs no more vertices"
# It is a cage like any other.
run 0 warp -s outline.txt -t outline.txt leaning.png same.png
run 0 warp -s leaning.png -t leaning.png leaning.png same.png
run 0 check -s leaning.png -t outline.txt
holds out 'one-to-one: yes, certified'

# Two parts and a hole, drawn by the pixels of a PAM.
awk 'BEGIN { printf "P7\nWIDTH 60\nHEIGHT 40\nDEPTH 2\nMAXVAL 255\nTUPLTYPE GRAYSCALE_ALPHA\nENDHDR\n"
    for (y = 0; y < 40; y++) for (x = 0; x < 60; x++) {
        inside = (x >= 5 && x < 30 && y >= 5 && y < 35 && !(x >= 12 && x < 20 && y >= 15 && y < 25)) || (x >= 40 && x < 55 && y >= 8 && y < 20)
        printf "A%c", inside ? "B" : "!" } }' | tr 'B!' '\377\000' >parts.pam
run 0 warp -s all.txt -t all.txt parts.pam parts.png
is_near "$(area parts.png)" 850 0.05
holds out '2 polygons'
holds out 'with 1 hole inside'
run 0 check -s parts.png --boundary parts.geojson
[ "$(grep -c '"Polygon"' parts.geojson)" = 2 ] || complain "parts.geojson has other polygons than 2"
run 1 check -s parts.png --boundary parts.txt
says 'the picture has several parts or holes'

run 1 check -s black.ppm
holds err 'which only warp, fit, animate and pose read'
run 0 warp -s all.txt -t all.txt black.ppm black.png
run 1 check -s black.png
says 'black.png: the picture has no transparent ground'
printf '1 1\n2 1\n2 2\n' >corner.txt
run 1 check -s leaning.txt --boundary outline.txt
says 'this is neither a mask nor a picture'
head -c 100 leaning.png >cut.png
run 1 check -s cut.png
says 'cut.png: the PNG picture is damaged'
finish
