#!/bin/sh
# Builds the npm package and tests it: the same bits as everywhere, and what its users call.
# usage: bindings/js/test.sh [--long]   (installs clang, lld, llvm, wasi-libc, libclang-rt-dev-wasm32 and binaryen; needs node and npm)
# --long: all shapes are compared with native builds, 10,000 maps are made and freed (else 500), a second build has to
# give the same bytes, and tests/unit is run by node, too
set -eu
long=${1:-}
cd "$(dirname "$0")/../.."
. cmake/deps.sh
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
    echo "left out: node or npm is missing"
    exit 77
fi
need clang lld llvm wasi-libc libclang-rt-dev-wasm32 binaryen
mkdir -p build/wasm
quietly build/wasm/configure.log cmake --preset wasm
quietly build/wasm/build.log cmake --build --preset wasm --parallel "$(nproc)"
# 450,000 without fits, networks and coverages. Fits take 44,000: the spline, the elastic model and the repair of folds.
# Networks of features, several outlines and coverages take 26,000, and sliding along them 7,000. Solids with things inside take
# 16,000. Starts without cuts, and regions of meshes, take 7,000. All of these are compiled for size. Vectors for pictures,
# and the quick test of polygons, take 3,000.
most=570000
bytes=$(gzip -9nc build/wasm/package/src/libicc.wasm | wc -c)
if [ "$bytes" -gt "$most" ]; then
    echo "libicc.wasm has $bytes bytes when gzipped, more than $most" >&2
    exit 1
fi
run="node --no-warnings bindings/js/tools/run.js build/wasm/bindings/js/golden.wasm"
for mode in objects results; do
    # The command is a list of words.
    # shellcheck disable=SC2086
    sh tests/golden/check.sh tests/golden/$mode.txt $run $mode
done
[ "$long" != --long ] || export ICC_MAPS=10000
ICC_PACKAGE=$PWD/build/wasm/package node --test bindings/js/test
python3 -B tests/first_day/try_lines.py docs/howto/first-day.md js build/wasm/package

# The same bits as those native builds that there are.
data=../shared/data
for program in build/*/tests/cages; do
    if [ ! -x "$program" ] || [ ! -d "$data" ]; then
        continue
    fi
    if [ "$long" = --long ]; then
        sh bindings/js/parity.sh hash "$data" "$program"
    else
        sh bindings/js/parity.sh hash "$data" "$program" d01 d02 d11 d18 t08
    fi
done
sh bindings/js/test/user/test.sh "$PWD"/build/wasm/libicc-*.tgz "$PWD/build/wasm/user"

[ "$long" = --long ] || exit 0

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

unit=build/wasm-unit
mkdir -p $unit
quietly $unit/configure.log cmake --preset wasm -B $unit -DICC_BUILD_PLAIN_TESTS=ON
quietly $unit/build.log cmake --build $unit --parallel "$(nproc)"
ctest --test-dir $unit --parallel "$(nproc)" --output-on-failure
