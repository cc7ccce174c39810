#!/bin/sh
# FetchContent(libicc): the kind of library follows BUILD_SHARED_LIBS, and the library is optimised even where the project
# has no build type.
# usage: subproject.sh CMAKE STAGE WORK_DIR CC C_FLAGS
set -eu
cmake=$1 stage=$2 work=$3 cc=$4 flags=$5
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
version=$(sed -n 's/^Version: //p' "$(find "$stage" -name libicc.pc)")

# compiled EXPECTED OPTION..: how lib/api/api_map.c is optimised, in a project with these options.
compiled() {
    expected=$1
    shift
    "$cmake" -S "$here/subproject" -B "$work/flags" --fresh -DICC_SOURCE_DIR="$here/../.." -DCMAKE_C_COMPILER="$cc" \
        -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "$@" >"$work/flags.log" 2>&1 || { cat "$work/flags.log"; exit 1; }
    found=$(grep '"command".*api_map\.c' "$work/flags/compile_commands.json" | grep -oE ' -(O[^ ]*|DNDEBUG)' | tr -d '\n')
    [ "$found" = "$expected" ] || { echo "with '$*' flags are '$found', not '$expected'"; exit 1; }
}
compiled ' -O3 -DNDEBUG' -DCMAKE_BUILD_TYPE=
compiled ' -O3 -DNDEBUG' -DCMAKE_BUILD_TYPE=Release
compiled '' -DCMAKE_BUILD_TYPE=Debug
compiled ' -O1' -DCMAKE_BUILD_TYPE= -DCMAKE_C_FLAGS=-O1

# Both kinds have the same objects, so the second build in one folder only links.
for shared in OFF ON; do
    if ! { "$cmake" -S "$here/subproject" -B "$work/build" --fresh -DBUILD_SHARED_LIBS=$shared \
        -DICC_SOURCE_DIR="$here/../.." -DCMAKE_C_COMPILER="$cc" -DCMAKE_C_FLAGS="$flags -O0" &&
        "$cmake" --build "$work/build"; } >"$work/build.log" 2>&1; then
        cat "$work/build.log"
        exit 1
    fi
    "$work/build/consumer" "$version"
done
