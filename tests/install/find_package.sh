#!/bin/sh
# find_package(libicc): C and C++, shared and static. It fails where libicc is not installed.
# usage: find_package.sh CMAKE STAGE WORK_DIR CC C_FLAGS CXX
set -eu
cmake=$1 stage=$2 work=$3 cc=$4 flags=$5 cxx=$6
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
version=$(sed -n 's/^Version: //p' "$(find "$stage" -name libicc.pc)")

configure() {
    "$cmake" -S "$here/find_package" -B "$1" -DCMAKE_PREFIX_PATH="$2" -DCMAKE_C_COMPILER="$cc" \
        -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_C_FLAGS="$flags" -DCMAKE_CXX_FLAGS="$flags" >"$1.log" 2>&1
}

if configure "$work/without" "$work/nowhere"; then
    echo "configured although libicc is not there"
    exit 1
fi
grep -q 'configuration file provided by "libicc"' "$work/without.log" || {
    cat "$work/without.log"
    exit 1
}

# A component that there is not is named.
mkdir "$work/odd"
printf 'cmake_minimum_required(VERSION 3.16)\nproject(odd C)\nfind_package(libicc REQUIRED COMPONENTS cpp)\n' \
    >"$work/odd/CMakeLists.txt"
if "$cmake" -S "$work/odd" -B "$work/odd/build" -DCMAKE_PREFIX_PATH="$stage" -DCMAKE_C_COMPILER="$cc" >"$work/odd.log" 2>&1; then
    echo "configured with a component that does not exist"
    exit 1
fi
grep -q 'libicc has no component cpp; it has shared and static' "$work/odd.log" || { cat "$work/odd.log"; exit 1; }

configure "$work/build" "$stage" || { cat "$work/build.log"; exit 1; }
"$cmake" --build "$work/build" >"$work/build.log" 2>&1 || { cat "$work/build.log"; exit 1; }
for program in shared_c shared_cpp shared_wrapper static_c static_cpp static_wrapper; do
    "$work/build/$program" "$version"
done

# The shared programs need the library at run time, the static ones do not.
for program in shared_c shared_cpp shared_wrapper; do
    objdump -p "$work/build/$program" | grep -q 'NEEDED *libicc.so.0'
done
for program in static_c static_cpp static_wrapper; do
    if objdump -p "$work/build/$program" | grep -q 'NEEDED *libicc'; then
        echo "$program is not static"
        exit 1
    fi
done
