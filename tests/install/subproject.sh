#!/bin/sh
# FetchContent(libicc): the kind of library follows BUILD_SHARED_LIBS.
# usage: subproject.sh CMAKE STAGE WORK_DIR CC C_FLAGS
set -eu
cmake=$1 stage=$2 work=$3 cc=$4 flags=$5
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
version=$(sed -n 's/^Version: //p' "$(find "$stage" -name libicc.pc)")

for shared in OFF ON; do
    build=$work/$shared
    if ! { "$cmake" -S "$here/subproject" -B "$build" -DBUILD_SHARED_LIBS=$shared \
        -DICC_SOURCE_DIR="$here/../.." -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS="$flags" &&
        "$cmake" --build "$build"; } >"$build.log" 2>&1; then
        cat "$build.log"
        exit 1
    fi
    "$build/consumer" "$version"
done
