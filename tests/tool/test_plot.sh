#!/bin/sh
# plot: a drawing of well-formed XML with what it must hold.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"
make_cages

well_formed() {
    if command -v xmllint >/dev/null; then
        xmllint --noout "$1" || complain "$1 is not well-formed"
    fi
    [ "$(grep -o '<g[ >]' "$1" | wc -l)" -eq "$(grep -o '</g>' "$1" | wc -l)" ] || complain "$1 has open groups"
    if sed 's/base64,[^"]*//' "$1" | grep -qiE '[^a-z](nan|inf)[^a-z]'; then
        complain "$1 holds numbers that are none"
    fi
}

run 0 plot -s source.txt -m gradient drawing.svg
[ ! -s out ] || complain "plot writes to stdout"
for part in '<svg ' '<clipPath' 'image/png;base64' 'function and integral curves' 'fill="#dc2626"' '</svg>'; do
    holds drawing.svg "$part"
done
well_formed drawing.svg
run 0 plot -s source.txt -m gradient -
same out drawing.svg "on standard output"

# A certified method has leaves from every boundary point, and nothing without coordinates (rose).
for method in foliation disc; do
    run 0 plot -s source.txt -t target.txt -m "$method" --lines 77 drawing.svg
    for part in 'source: integral curves' 'target: checkerboard' 'target: uv map'; do
        holds drawing.svg "$part"
    done
    well_formed drawing.svg
    leaves=$(grep -A1 'stroke="#1d4ed8"' drawing.svg | grep -o M | wc -l)
    [ "$leaves" -ge 154 ] || complain "$leaves leaves instead of 77 in each shape with $method"
    run 2 plot -s source.txt -m "$method" --elevation drawing.svg
    says '--elevation needs --method gradient'
done

run 0 plot -s source.txt -t target.txt --triangles drawing.svg
holds drawing.svg 'target: triangles'
well_formed drawing.svg

run 0 plot -s source.txt -t target.txt -m gradient --elevation --compression --y-down --lines 20 drawing.svg
for part in 'source: checkerboard' 'target: uv map' 'target: elevation' 'source: function'; do
    holds drawing.svg "$part"
done
well_formed drawing.svg
run 0 plot -s source.txt -m gradient --cells 400 --elevation --function distance --tree paper drawing.svg
well_formed drawing.svg

# Shapes at odd places and of odd sizes.
awk '{ print $1 + 1e9, $2 - 1e9 }' OFMT=%.17g source.txt >far.txt
awk '{ print $1 "e-300", $2 "e-300" }' source.txt >small.txt
awk '{ print $1 * 1000, $2 }' source.txt >wide.txt
for cage in far.txt small.txt wide.txt; do
    run 0 plot -s "$cage" -m gradient --elevation drawing.svg
    well_formed drawing.svg
    run 0 plot -s "$cage" drawing.svg
    well_formed drawing.svg
done

echo old >drawing.svg
run 1 plot -s nowhere drawing.svg
holds drawing.svg old
run 1 plot -s source.txt no/where.svg
says 'libicc: no/where.svg: cannot be written'
finish
