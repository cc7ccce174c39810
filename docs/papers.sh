#!/bin/sh
# Makes everything that docs/papers.md names: builds the library, runs the examples, each benchmark of the page, and the
# blocks of the page itself. What they print and draw is in build/papers; a table says what each took. On one core of
# 2026 all of it takes less than five minutes.
# usage: sh docs/papers.sh
set -eu
cd "$(dirname "$0")/.."
. cmake/deps.sh
need gcc g++ libc6-dev make cmake pkg-config libpng-dev libjpeg-dev python3-numpy python3-pil

page=docs/papers.md
out=build/papers
library=build/release
mkdir -p "$out"
: >"$out/table.txt"

# Programs in Python print line by line, as the benchmarks do, so a file shows how far its program is.
export PYTHONUNBUFFERED=1

# made NAME COMMAND... says that it runs a command, whose output goes to $out/NAME.txt, and adds its seconds to the table.
made() {
    name=$1
    shift
    begin=$(date +%s.%N)
    echo "$name: running; tail -f $out/$name.txt shows how far it is"
    "$@" >"$out/$name.txt"
    date +%s.%N | awk -v begin="$begin" -v name="$name" -v file="$out/$name.txt" \
        '{ printf "%-20s %6.1f s  %s\n", name, $1 - begin, file }' | tee -a "$out/table.txt"
}

benchmarks() {
    quietly "$out/configure.log" cmake -S . -B "$library" -DICC_BUILD_BENCHMARKS=ON
    # The names are words.
    # shellcheck disable=SC2086
    quietly "$out/build.log" cmake --build "$library" --parallel "$(nproc)" --target $named
}

named=$(grep -ow 'bench_[a-z_]*' "$page" | sort -u)
[ -n "$named" ] || { echo "$page names no benchmark" >&2; exit 1; }
made examples sh examples/run.sh --all
made benchmarks benchmarks
for name in $named; do
    made "$name" "$library/tests/bench/$name"
done
made page /usr/bin/python3 -B tests/docs/snippets.py "$PWD" "$PWD/build/examples/stage" "$PWD/$out/page" cc c++ "" "$PWD/$page"
echo "all of it is in $out and build/examples/out; the table is $out/table.txt"
