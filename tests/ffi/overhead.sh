#!/bin/sh
# Prints what a call costs from Python and from Rust beyond C, also into a file.
# usage: overhead.sh OUTPUT C_PROGRAM LIBRARY PYTHON CARGO TARGET     the last three may be empty: not measured then
set -eu
output=$1
library=$3
python=$4
cargo=$5
export CARGO_TARGET_DIR="$6"
bindings=$(cd "$(dirname "$0")/../../bindings" && pwd)

measured=$("$2")
empty=${measured% *}
point=${measured#* }

{
    printf 'C: %s ns a call for one point, %s ns an empty call\n' "$point" "$empty"
    if [ -n "$python" ]; then
        LIBICC_LIBRARY=$library PYTHONDONTWRITEBYTECODE=1 "$python" "$bindings/python/bench_calls.py" "$empty" "$point"
    fi
    if [ -n "$cargo" ]; then
        cd "$bindings/rust"
        LIBICC_DIR=$(dirname "$library") "$cargo" build --offline --quiet --release --example calls
        LD_LIBRARY_PATH=$(dirname "$library")${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} \
            "$CARGO_TARGET_DIR/release/examples/calls" "$empty" "$point"
    fi
} >"$output.new"
mv "$output.new" "$output"
cat "$output"
