#!/bin/sh
# The library without threads of its own: it builds, takes nothing of POSIX threads and no library beyond that of C, and
# passes some unit tests.
# usage: check_options.sh CMAKE SOURCE_DIR WORK_DIR CC NM
set -eu
cmake=$1 source=$2 work=$3 cc=$4 nm=$5
tests="unit/base/test_base unit/math/test_ordering unit/map/compatible/test_plmap unit/map/test_distortion
    unit/kernel/weights/test_handle_weights"
mkdir -p "$work"

run() {
    "$@" >"$work/run.log" 2>&1 || {
        cat "$work/run.log"
        exit 1
    }
}

run "$cmake" -S "$source" -B "$work/build" -DCMAKE_BUILD_TYPE=None -DCMAKE_C_COMPILER="$cc" -DICC_WERROR=ON \
    -DICC_WITH_THREADS=OFF -DICC_BUILD_TOOLS=OFF -DICC_BUILD_TESTS=ON
targets=$(echo "$tests" | tr / _)
# The targets are a list of words.
# shellcheck disable=SC2086
run "$cmake" --build "$work/build" --parallel 2 --target icc $targets

if "$nm" -u "$work/build/lib/libicc.a" | grep pthread_; then
    echo "the static library asks for threads"
    exit 1
fi
objdump -p "$work/build/lib/libicc.so.0" | awk '$1 == "NEEDED" { print $2 }' >"$work/needed"
if grep -v -e '^libc\.so' -e '^libm\.so' -e '^ld-linux' "$work/needed"; then
    echo "the shared library needs more than that of C"
    exit 1
fi

regex=$(echo "$tests" | tr -s ' \n' '|')
ICC_TEST_SHARE=4 run ctest --test-dir "$work/build" --tests-regex "^($regex)\$" --output-on-failure
grep '^100% tests passed' "$work/run.log"
