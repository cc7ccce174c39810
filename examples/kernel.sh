#!/bin/sh
# Kernel coordinates with the command: figures of weights as in the thesis' chapter 6, in linear and in
# logarithmic scale; a picture cut out as a butterfly that folds its wings; a face whose eyes stay as they are.
# Prints how good the weights are.
#
# usage: kernel.sh [FOLDER]      where the drawings go (default: .)
#        LIBICC=/path/to/libicc  which command (default: the one in PATH)
set -eu
libicc=${LIBICC:-libicc}
data=$(dirname "$0")/data
out=${1:-.}

member() {
    sed -n 's/^ *"'"$1"'": \([^,]*\),*$/\1/p' "$out/kernel.json"
}

# draw NAME HANDLE OPTION...: the weight of a handle, linear and logarithmic
draw() {
    name=$1
    handle=$2
    shift 2
    "$libicc" weights "$@" --handles "$data/$name.json" --handle "$handle" --picture "$out/$name.svg"
    "$libicc" weights "$@" --handles "$data/$name.json" --handle "$handle" --picture "$out/$name-log.svg" --log
}

# row NAME OPTION...: measured along a line
row() {
    name=$1
    shift
    "$libicc" weights "$@" --handles "$data/$name.json" --along "$along" --output /dev/null --json="$out/kernel.json"
    printf '%-10s %7d %6d %10d %9.1e %12.1e %9.1e %12.4f %7.0f ms\n' "$name" "$(member nodes)" \
        "$(member infeasible)" "$(member negative)" "$(member unity)" "$(member reproduction)" \
        "$(member lagrange)" "$(member least_weight)" "$(member make | awk '{ print 1000 * $1 }')"
}

draw star 0 --source "$data/star.txt"
draw stick 4
draw butterfly 4 --source "$data/butterfly.txt" --y-down
for scale in "" --log; do
    # shellcheck disable=SC2086 # none or one
    "$libicc" weights --source "$data/star.txt" --handles "$data/star.json" --along 0,-4.5,0,10 \
        --picture "$out/star-along${scale:+-log}.svg" $scale
done

echo "butterfly:"
"$libicc" pose --source "$data/butterfly.txt" --handles "$data/butterfly.json" --steps 40 \
    --pose "$data/butterfly-pose.json" --background ffffff00 "$data/chelsea.png" "$out/butterfly.png"
echo "cat, eyes rigid:"
"$libicc" pose --handles "$data/cat.json" --pose "$data/cat-pose.json" "$data/chelsea.png" "$out/cat-rigid.png"
echo "cat, eyes as soft as the rest:"
sed '/"rigid"/,$d' "$data/cat.json" | sed '$s/,$/}/' >"$out/cat-soft.json"
"$libicc" pose --handles "$out/cat-soft.json" --pose "$data/cat-pose.json" "$data/chelsea.png" "$out/cat-soft.png"
rm "$out/cat-soft.json"

echo
echo "along a line  nodes infeasible  negative     unity reproduction  lagrange least weight     made in"
along=0,-4.5,0,10
row star --source "$data/star.txt"
along=-1.6,3.4,0,4.6
row stick
along=60,100,300,130
row butterfly --source "$data/butterfly.txt"
row cat
rm "$out/kernel.json"
echo "the drawings are in $out: star, stick, butterfly and cat"
