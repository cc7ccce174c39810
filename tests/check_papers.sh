#!/bin/sh
# The papers alone (ICC_PAPERS_ONLY): the library builds, passes the tests of its stages, and is used once installed, by CMake
# and by pkg-config. It has every call of the stages, and none of maps, matches, pictures and kernel coordinates.
# usage: check_papers.sh CMAKE SOURCE_DIR WORK_DIR CC NM
set -eu
cmake=$1 source=$2 work=$3 cc=$4 nm=$5
mkdir -p "$work"

run() {
    "$@" >"$work/run.log" 2>&1 || {
        cat "$work/run.log"
        exit 1
    }
}

run "$cmake" -S "$source" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER="$cc" -DICC_WERROR=ON \
    -DICC_PAPERS_ONLY=ON -DICC_BUILD_TESTS=ON
run "$cmake" --build "$work/build" --parallel 2
ICC_TEST_SHARE=4 run ctest --test-dir "$work/build" --tests-regex '^(unit/gradient|property)/' --label-exclude '^(all|long)$' \
    --output-on-failure --parallel 2
grep '^100% tests passed' "$work/run.log"

# calls HEADER... lists the functions that they declare.
calls() {
    for header in "$@"; do
        sed -n 's/^ICC_API .*[^a-z0-9_]\(icc_[a-z0-9_]*\)(.*/\1/p' "$source/include/icc/$header.h"
    done
}
"$nm" -D --defined-only "$work/build/lib/libicc.so.0" | sed 's/.* //; s/@.*//' | grep '^icc_' | sort >"$work/there"
calls base stages | sort >"$work/wanted"
calls kernel fit >"$work/unwanted"
calls map chart | grep -E '^icc_((map|match)_|domain_fill$)' >>"$work/unwanted"
[ -s "$work/wanted" ] || { echo "no functions found in the headers"; exit 1; }
if comm -23 "$work/wanted" "$work/there" | grep .; then
    echo "the papers alone lack these"
    exit 1
fi
if sort "$work/unwanted" | comm -12 - "$work/there" | grep .; then
    echo "the papers alone should not have these"
    exit 1
fi

stage=$work/stage
rm -rf "$stage" "$work/consumer"
run "$cmake" --install "$work/build" --prefix "$stage"
run "$cmake" -S "$source/tests/papers" -B "$work/consumer" -DCMAKE_PREFIX_PATH="$stage" -DCMAKE_C_COMPILER="$cc"
run "$cmake" --build "$work/consumer"
"$work/consumer/shared"
"$work/consumer/static"
PKG_CONFIG_LIBDIR=$(dirname "$(find "$stage" -name libicc.pc)")
export PKG_CONFIG_LIBDIR
# The flags are lists of words.
# shellcheck disable=SC2046
run "$cc" $(pkg-config --cflags libicc) "$source/tests/papers/stages.c" -o "$work/by_pkg_config" $(pkg-config --libs libicc) -lm
LD_LIBRARY_PATH=$(pkg-config --variable=libdir libicc) "$work/by_pkg_config"
