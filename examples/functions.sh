#!/bin/sh
# The functions of method gradient side by side, as in figure 6 of the paper and figure 6.13 of the
# thesis, and what each costs: expansion edges (in all, and those away from the boundary), compression
# edges, area that no curve enters, coordinates on merged curves.
#
# usage: functions.sh [FOLDER]   where the drawings go (default: .)
#        LIBICC=/path/to/libicc  which command (default: the one in PATH)
#        SOURCE=..., TARGET=...  the cages (default: the shape with three legs in examples/data)
set -eu
libicc=${LIBICC:-libicc}
data=$(dirname "$0")/data
source=${SOURCE:-$data/tripus.src.txt}
target=${TARGET:-$data/tripus.tgt.txt}
out=${1:-.}

member() {
    sed -n 's/^ *"'"$1"'": \([^,]*\),*$/\1/p' "$out/functions.json"
}

# row CAGE FUNCTION
row() {
    "$libicc" info --method gradient --source "$1" --function "$2" --json="$out/functions.json"
    printf '%-12s %-24s %9d %6d %11d %8.1f %% %8.1f %% %6d %d %d\n' "$(basename "$1" .txt)" "$2" \
        "$(member expansion_edges)" "$(member expansion_edges_inside)" "$(member compression_edges)" \
        "$(member uncovered | awk '{ print 100 * $1 }')" "$(member collapsed | awk '{ print 100 * $1 }')" \
        "$(member maxima)" "$(member minima)" "$(member saddles)"
}

"$libicc" plot --method gradient --source "$source" --target "$target" \
    --function distance,bilaplace:constrained,laplace:constrained,laplace:unconstrained "$out/functions.svg"
"$libicc" plot --method gradient --source "$source" \
    --function laplace:unconstrained,bilaplace:unconstrained "$out/unconstrained.svg"

echo "cage         function                 expansion inside compression  uncovered  collapsed critical"
for cage in "$source" "$target"; do
    for function in distance bilaplace:constrained laplace:constrained laplace:unconstrained bilaplace:unconstrained; do
        row "$cage" "$function"
    done
done
rm "$out/functions.json"
echo "the drawings are $out/functions.svg and $out/unconstrained.svg"
