#!/bin/sh
# Compares what the library gives for the shapes of ../shared/data, here and as WebAssembly under node: meshes, 200,000
# points, pictures, dragged frames, weights, by their hashes; or times it, both in turns.
# usage: bindings/js/parity.sh hash|time PROGRAM [SHAPE ...]     (after bindings/js/test.sh)
#   PROGRAM: tests/cages of a native build; SHAPE: d01 t05 ...; left out, all 20 in the plane and three in space
set -eu
cd "$(dirname "$0")/../.."
mode=$1
program=$2
shift 2
data=../shared/data
if [ ! -d $data ]; then
    echo "not compared: $data is missing"
    exit 77
fi
[ $# -gt 0 ] || set -- d t01 t05 t08
module=build/wasm/bindings/js/cages.wasm
flags=--no-warnings
# Times are those of code that has been compiled: all of it, before it runs.
[ "$mode" = hash ] || flags="$flags --no-liftoff --no-wasm-lazy-compilation --no-wasm-tier-up"
different=0
compared=0
for shape in "$@"; do
    for source in "$data"/[23]d/"$shape"*.src.*; do
        target=$(echo "$source" | sed 's/\.src\./.tgt./')
        native=$("$program" "$mode" "$source" "$target")
        # The flags are a list of words.
        # shellcheck disable=SC2086
        wasm=$(node $flags bindings/js/tools/run.js $module "$mode" "$(realpath "$source")" "$(realpath "$target")")
        compared=$((compared + 1))
        if [ "$mode" = time ]; then
            echo "$native $wasm" | awk '{
                printf "%-26s", $1
                half = NF / 2
                for (k = 2; k < half - 1; k += 2)
                    if ($(k + 1) > 0.5)
                        printf " %s %.1f -> %.1f (%.2f)", $k, $(k + 1), $(half + k + 1), $(half + k + 1) / $(k + 1)
                print ""
            }'
        elif [ "$native" != "$wasm" ]; then
            printf 'native: %s\nwasm:   %s\n' "$native" "$wasm"
            different=$((different + 1))
        fi
    done
done
[ "$mode" = time ] || echo "$compared shapes compared with $program, $different different"
[ "$different" -eq 0 ] && [ "$compared" -gt 0 ]
