#!/bin/sh
# Installs what is missing, builds everything and runs every test.
# usage: sh tests/run.sh [--all] [PRESET [CMAKE ARGUMENT ...]]      (presets: see CMakePresets.json)
# With --all also what needs heavy packages: Rust, Dask, scikit-image and others, the reference documentation, and
# the Debian packages, built and tested in a system of their own.
set -eu
cd "$(dirname "$0")/.."
. cmake/deps.sh
all=no
if [ "${1:-}" = --all ]; then
    all=yes
    shift
fi
need gcc g++ libc6-dev make cmake pkg-config libpng-dev libcjson-dev check libgmp-dev libsuitesparse-dev \
    abigail-tools python3-numpy python3-pytest python3-cffi tetgen
if [ "$all" = yes ]; then
    need cargo rustc python3-distributed python3-shapely python3-skimage python3-meshio python3-pil python3-matplotlib \
        python3-setuptools python3-wheel python3-pip python3-venv mypy netpbm librsvg2-bin doxygen \
        mandoc man-db
fi

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
counts=$(awk '/tests? passed, .* tests? failed out of/ { print $NF - $4, $4 }' "$build/ctest.log")
counts=${counts:-0 1}
passed=${counts% *}
failed=${counts#* }

# Tests that CMake did not register for want of packages, and parts of tests that were skipped.
left_out() {
    sed -n 's/^-- \(.* missing: .*\)/\1/p' "$build/configure.log"
    grep -e '^SKIPPED' -e ' left out: .* is missing$' "$build/Testing/Temporary/LastTest.log" || true
}

# also NAME COMMAND... counts as one more test; exit code 77 means that it cannot run here, and says why.
also() {
    name=$1
    shift
    echo "== $name"
    result=0
    "$@" || result=$?
    case $result in
        0) passed=$((passed + 1)) ;;
        77) ;;
        *) failed=$((failed + 1)) && echo "failed: $name" ;;
    esac
}

reference() (
    quietly build/docs.log cmake --preset docs
    quietly build/docs.log cmake --build --preset docs
)

left_out=$(left_out)
[ -z "$left_out" ] || printf 'left out, for want of packages:\n%s\n' "$left_out"
if [ "$all" = no ]; then
    [ -z "$left_out" ] || echo "sh tests/run.sh --all has them"
else
    also "nothing is left out" test -z "$left_out"
    also "reference documentation" reference
    also "Debian packages" sh tests/debian.sh "$build"
fi
[ ! -e "$build/overhead.txt" ] || cat "$build/overhead.txt"
printf '%d passed, %d failed\n' "$passed" "$failed"
[ "$status" -eq 0 ] && [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
