#!/bin/sh
# Installs what is missing, builds the library, installs it below build/, compiles the examples
# against it, and warps a picture.
set -eu
cd "$(dirname "$0")/.."
. cmake/deps.sh
need gcc libc6-dev make cmake pkg-config libpng-dev libcjson-dev

build=build/examples
stage=$PWD/$build/stage
data=examples/data
out=$build/out
mkdir -p "$build" "$out"

echo "building the library"
quietly "$build/configure.log" cmake -S . -B "$build/library" -DCMAKE_BUILD_TYPE=Release
quietly "$build/build.log" cmake --build "$build/library" --parallel "$(nproc)"
quietly "$build/install.log" cmake --install "$build/library" --prefix "$stage"

echo "building the examples"
quietly "$build/configure.log" cmake -S examples -B "$build/programs" -DCMAKE_PREFIX_PATH="$stage"
quietly "$build/build.log" cmake --build "$build/programs" --parallel "$(nproc)"

echo "warping $data/coffee.png"
"$build/programs/warp" "$data/coffee.src.txt" "$data/coffee.tgt.txt" "$data/coffee.png" \
    "$out/coffee.png"
echo "the result is $out/coffee.png"
