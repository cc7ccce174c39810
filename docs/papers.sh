#!/bin/sh
# Makes everything that docs/papers.md names: builds the library and the benchmarks, runs each benchmark of the page, the
# examples, and the blocks of the page itself. What they print and draw is in build/papers.
# usage: sh docs/papers.sh
set -eu
cd "$(dirname "$0")/.."
. cmake/deps.sh
need gcc g++ libc6-dev make cmake pkg-config libpng-dev libjpeg-dev libcjson-dev python3-numpy

page=docs/papers.md
out=build/papers
mkdir -p "$out"

echo "building the library and the benchmarks"
quietly "$out/configure.log" cmake --preset release -DICC_BUILD_BENCHMARKS=ON
named=$(grep -ow 'bench_[a-z_]*' "$page" | sort -u)
[ -n "$named" ] || { echo "$page names no benchmark" >&2; exit 1; }
# The names are words.
# shellcheck disable=SC2086
quietly "$out/build.log" cmake --build --preset release --parallel "$(nproc)" --target icc $named
for name in $named; do
    echo "$name"
    "build/release/tests/bench/$name" >"$out/$name.txt"
done

echo "the examples"
sh examples/run.sh >"$out/examples.txt"

echo "the page's own blocks"
/usr/bin/python3 -B tests/docs/snippets.py "$PWD" "$PWD/build/examples/stage" "$PWD/$out/page" cc c++ "" "$PWD/$page" >"$out/page.txt"
echo "all of it is in $out and build/examples/out"
