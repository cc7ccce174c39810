#!/bin/sh
# Installs what is missing, builds everything and runs every test.
# usage: sh tests/run.sh [PRESET [CMAKE ARGUMENT ...]]      (presets: see CMakePresets.json)
set -eu
cd "$(dirname "$0")/.."
. cmake/deps.sh
need gcc g++ libc6-dev make cmake pkg-config libpng-dev libcjson-dev check libgmp-dev libsuitesparse-dev tetgen

preset=${1:-release}
[ $# -eq 0 ] || shift
build=build/$preset
jobs=$(nproc)
mkdir -p "$build"

echo "building in $build"
quietly "$build/configure.log" cmake --preset "$preset" "$@"
quietly "$build/build.log" cmake --build "$build" --parallel "$jobs"
grep -A 4 'warning:' "$build/build.log" || true

status=0
ctest --test-dir "$build" --output-on-failure --parallel "$jobs" --output-log "$build/ctest.log" \
    </dev/null || status=$?
awk '/tests? passed, .* tests? failed out of/ { passed = $(NF) - $4; failed = $4 }
     END { printf "%d passed, %d failed\n", passed, failed; exit failed > 0 || passed == 0 }' \
    "$build/ctest.log" || status=1
exit "$status"
