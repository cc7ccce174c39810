#!/bin/sh
# Builds the npm package and tests it: the same bits as everywhere, and what its users call.
# usage: bindings/js/test.sh    (installs clang, lld, wasi-libc and libclang-rt-dev-wasm32; needs node and npm)
# ICC_MAPS=N in the environment: so many maps are made and freed (500).
set -eu
cd "$(dirname "$0")/../.."
. cmake/deps.sh
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
    echo "left out: node or npm is missing"
    exit 77
fi
need clang lld wasi-libc libclang-rt-dev-wasm32
mkdir -p build/wasm
quietly build/wasm/configure.log cmake --preset wasm
quietly build/wasm/build.log cmake --build --preset wasm --parallel "$(nproc)"
run="node --no-warnings bindings/js/tools/run.js build/wasm/bindings/js/golden.wasm"
for mode in objects results; do
    # The command is a list of words.
    # shellcheck disable=SC2086
    sh tests/golden/check.sh tests/golden/$mode.txt $run $mode
done
ICC_PACKAGE=$PWD/build/wasm/package node --test bindings/js/test
sh bindings/js/test/user/test.sh "$PWD"/build/wasm/libicc-*.tgz "$PWD/build/wasm/user"

# Built again, elsewhere: the same bytes.
again=build/wasm-again
rm -rf "$again"
quietly build/wasm/again.log env -u CMAKE_C_COMPILER_LAUNCHER cmake --preset wasm -B "$again"
quietly build/wasm/again.log cmake --build "$again" --parallel "$(nproc)"
for file in package/src/libicc.wasm package/src/layouts.js studio.html; do
    cmp "build/wasm/$file" "$again/$file"
done
cmp build/wasm/libicc-*.tgz "$again"/libicc-*.tgz
rm -rf "$again"
