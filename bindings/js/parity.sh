#!/bin/sh
# Compares what the library gives for the shapes of a folder, here and as WebAssembly under node: meshes, 200,000
# points, pictures, dragged frames, weights, by their hashes; or times it, both in turns, three times: medians.
# usage: bindings/js/parity.sh hash|time FOLDER PROGRAM [SHAPE ...]     (after bindings/js/test.sh; paths are seen
#   from the folder above bindings)
#   FOLDER: has pairs 2d/*.src.txt, *.tgt.txt and 3d/*.src.obj, *.tgt.obj; without it nothing is compared
#   PROGRAM: tests/cages of a native build; SHAPE: d01 t05 ...; left out, all in the plane and three in space
set -eu
cd "$(dirname "$0")/../.."
mode=$1
data=$2
program=$3
shift 3
if [ ! -d "$data" ]; then
    echo "not compared: $data is missing"
    exit 77
fi
[ $# -gt 0 ] || set -- d t01 t05 t08
module=build/wasm/bindings/js/cages.wasm
flags=--no-warnings
# Times are those of code that has been compiled: all of it, before it runs.
[ "$mode" = hash ] || flags="$flags --no-liftoff --no-wasm-lazy-compilation --no-wasm-tier-up"

native() {
    "$program" "$mode" "$source" "$target"
}

wasm() {
    # The flags are a list of words.
    # shellcheck disable=SC2086
    node $flags bindings/js/tools/run.js $module "$mode" "$(realpath "$source")" "$(realpath "$target")"
}

# Reads lines of native and wasm in turns; prints medians of the times, and of the ratios of neighbours.
# shellcheck disable=SC2016 # for awk
medians='
    function median(list, n,    i, j, v) {
        for (i = 2; i <= n; ++i) {
            v = list[i]
            for (j = i - 1; j > 0 && list[j] > v; --j)
                list[j + 1] = list[j]
            list[j + 1] = v
        }
        return list[int((n + 1) / 2)]
    }
    { name = $1; parts = NF; for (k = 2; k < NF; k += 2) { word[k] = $k; time[k, NR] = $(k + 1) } }
    END {
        printf "%-26s", name
        for (k = 2; k < parts - 1; k += 2) {
            for (r = 1; r <= NR / 2; ++r) {
                here[r] = time[k, 2 * r - 1]
                there[r] = time[k, 2 * r]
                if (here[r] > 0)
                    ratio[r] = there[r] / here[r]
            }
            if (median(here, NR / 2) > 0.5)
                printf " %s %.1f -> %.1f (%.2f)", word[k], median(here, NR / 2), median(there, NR / 2), median(ratio, NR / 2)
        }
        print ""
    }'

different=0
compared=0
for shape in "$@"; do
    for source in "$data"/[23]d/"$shape"*.src.*; do
        target=$(echo "$source" | sed 's/\.src\./.tgt./')
        compared=$((compared + 1))
        if [ "$mode" = time ]; then
            for _ in 1 2 3; do
                native
                wasm
            done | awk "$medians"
            continue
        fi
        here=$(native)
        there=$(wasm)
        if [ "$here" != "$there" ]; then
            printf 'native: %s\nwasm:   %s\n' "$here" "$there"
            different=$((different + 1))
        fi
    done
done
[ "$mode" = time ] || echo "$compared shapes compared with $program, $different different"
[ "$different" -eq 0 ] && [ "$compared" -gt 0 ]
