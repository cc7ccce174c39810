#!/bin/sh
# Writes the expected hashes anew, after a change that changes bits on purpose.
# usage: sh tests/golden/update.sh [PROGRAM]
set -eu
cd "$(dirname "$0")"
program=${1:-../../build/release/tests/golden}
for mode in objects results; do
    "$program" $mode >$mode.new
    mv $mode.new $mode.txt
done
