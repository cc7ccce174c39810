#!/bin/sh
# Installs what is missing, builds the library with its tests and runs them, in one of three tiers:
# usage: sh tests/run.sh [--all | --long] [PRESET [CMAKE ARGUMENT ...]]      (presets: see CMakePresets.json)
# Without a tier: what takes less than ten seconds, with a share of the cases of long sweeps. A few minutes.
# --all: what CI runs: also tests labelled `all`, benchmarks compiled, what needs heavy packages, the layout of the
#        sources, the reference documentation, the Debian packages, built and tested in a system of their own, and
#        two other machines, emulated.
# --long: the same with all cases of every sweep, tests labelled `long`, a hundred times the variations of fuzzers'
#         inputs (10^6 where one takes microseconds), all other machines, and all of it under the sanitizers. Hours.
# ICC_TEST_SHARE=PERCENT in the environment sets the share of the cases.
set -eu
cd "$(dirname "$0")/.."
. cmake/deps.sh
tier=plain
case ${1:-} in
    --all | --long)
        tier=${1#--}
        shift
        ;;
esac
need gcc g++ libc6-dev make cmake pkg-config libpng-dev libjpeg-dev zlib1g-dev check libgmp-dev \
    abigail-tools python3-numpy python3-pytest python3-cffi tetgen
if [ "$tier" = long ]; then
    need clang libclang-rt-dev llvm python3-gmsh python3-h5py python3-netcdf4 python3-pydicom \
        python3-nbclient python3-ipykernel qgis python3-qgis blender
fi
if [ "$tier" != plain ]; then
    need libsuitesparse-dev cargo rustc mypy doxygen mandoc man-db clang-format netpbm librsvg2-bin proj-bin gdal-bin \
        assimp-utils zsh fish libeigen3-dev libglm-dev \
        python3-setuptools python3-wheel python3-pip python3-venv \
        python3-distributed python3-geopandas python3-matplotlib python3-meshio python3-nibabel python3-pil \
        python3-rasterio python3-shapely python3-skimage python3-vtk9 python3-xarray python3-zarr
fi

preset=${1:-release}
[ $# -eq 0 ] || shift
build=build/$preset
jobs=$(nproc)
mkdir -p "$build"
sanitized=no
case $preset in
    asan | tsan) sanitized=yes ;;
esac

# What of the sweeps is run, which tests there are, and whether benchmarks are compiled.
benchmarks=OFF
[ "$tier" = plain ] || [ "$sanitized" = yes ] || benchmarks=ON
case $tier in
    plain) share=4 left_to_others='all|long' ;;
    all) share=20 left_to_others=long ;;
    long) share=100 left_to_others=none ;;
esac
[ "$tier-$sanitized" = long-yes ] || [ "$sanitized" = no ] || share=4
[ "$tier-$preset" != plain-tsan ] || share=2
ICC_TEST_SHARE=${ICC_TEST_SHARE:-$share}
export ICC_TEST_SHARE

# Under the thread sanitizer what uses threads is of interest, without its cases about progress, and in the long tier
# everything.
target=all only=
[ "$tier" != plain ] || target=tests_plain
if [ "$tier-$preset" = plain-tsan ]; then
    target=tests_threads only='^threads$' left_to_others=long
    export CK_EXCLUDE_TAGS=progress
fi

echo "building in $build"
quietly "$build/configure.log" cmake --preset "$preset" -DICC_BUILD_BENCHMARKS=$benchmarks "$@"
quietly "$build/build.log" cmake --build "$build" --parallel "$jobs" --target "$target"
grep -A 4 'warning:' "$build/build.log" || true

failures=
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
        *)
            failed=$((failed + 1))
            failures="$failures
failed: $name"
            echo "failed: $name"
            ;;
    esac
}

# The packages are made while the tests run: on machines with several processors neither uses all of them.
packages=
if [ "$tier" != plain ] && [ "$sanitized" = no ]; then
    check=nocheck
    [ "$tier" != long ] || check=
    DEB_BUILD_OPTIONS=$check sh tests/debian.sh "$build" >"$build/debian.log" 2>&1 </dev/null &
    packages=$!
fi

# A program that never ends is stopped by the time that it has used itself, however busy the machine is.
most_seconds=1200
[ "$tier" != long ] || most_seconds=36000
status=0
(
    # shellcheck disable=SC3045 # dash and bash have it
    ulimit -t $most_seconds
    ctest --test-dir "$build" ${only:+--label-regex "$only"} --label-exclude "^($left_to_others)\$" \
        --output-on-failure --parallel "$jobs" --output-log "$build/ctest.log" </dev/null
) || status=$?
counts=$(awk '/tests? passed, .* tests? failed out of/ { last = $NF - $4 " " $4 } END { print last }' "$build/ctest.log")
counts=${counts:-0 1}
passed=${counts% *}
failed=${counts#* }

# What the failed tests of CTest printed, at most 100 lines of each: long output follows before the end of this script.
printed_by_failed() {
    awk '/^ *[0-9]+\/[0-9]+ Test +#/ { lines = /\*\*\*/ ? 100 : 0 }
         /^ +Start +[0-9]+:/ || /tests? passed, .* tests? failed out of/ { lines = 0 }
         lines-- > 0' "$build/ctest.log"
}

# Tests that CMake did not register for want of packages, and parts of tests that were skipped.
left_out() {
    sed -n 's/^-- \(.* missing: .*\)/\1/p' "$build/configure.log"
    grep -e '^SKIPPED' -e ' left out: .* is missing$' "$build/Testing/Temporary/LastTest.log" || true
}

reference() (
    quietly build/docs.log cmake --preset docs
    quietly build/docs.log cmake --build --preset docs
)

packages() {
    result=0
    wait "$packages" || result=$?
    cat "$build/debian.log"
    return $result
}

fuzz() (
    # shellcheck disable=SC3045 # dash and bash have it
    ulimit -t 36000
    ICC_FUZZ_TIMES=100 ctest --test-dir "$build" --tests-regex ^fuzz/ --output-on-failure --parallel "$jobs" </dev/null
)

left_out=$(left_out)
[ -z "$left_out" ] || printf 'left out, for want of packages:\n%s\n' "$left_out"
if [ "$tier" = plain ]; then
    [ -z "$left_out" ] || echo "sh tests/run.sh --all has them"
elif [ "$sanitized" = no ]; then
    also "nothing is left out" test -z "$left_out"
    also "reference documentation" reference
    [ "$preset" != release ] || also "examples" sh examples/run.sh
    also "Debian packages" packages
    if [ "$tier" = long ]; then
        also "JavaScript" sh bindings/js/test.sh --long
        also "the studio" sh examples/studio/test.sh --long
        also "other machines" sh tests/ports.sh --long
    else
        also "JavaScript" sh bindings/js/test.sh
        also "the studio" sh examples/studio/test.sh
        also "other machines" sh tests/ports.sh arm64 s390x windows
    fi
fi
if [ "$tier-$sanitized" = long-no ]; then
    also "all examples" sh examples/run.sh --all
    also "a hundred times the fuzzers' variations" fuzz
    also "address and undefined-behaviour sanitizers" env CC=clang sh tests/run.sh --long asan
    also "thread sanitizer" env CC=clang sh tests/run.sh --long tsan
fi
[ ! -e "$build/overhead.txt" ] || cat "$build/overhead.txt"
[ "$status" -eq 0 ] || printed_by_failed
printf '%s\n%d passed, %d failed\n' "$failures" "$passed" "$failed"
[ "$status" -eq 0 ] && [ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
