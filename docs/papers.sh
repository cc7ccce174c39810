#!/bin/sh
# Makes everything that docs/papers.md shows: runs the command of each row, the blocks of the page, and draws its
# pictures. What commands print and draw is in build/papers; a table says how long each took. On one core of 2026 it
# takes a few minutes after the build.
# usage: sh docs/papers.sh [--pictures]      --pictures: only draws the pictures anew, into docs/images
set -eu
cd "$(dirname "$0")/.."
. cmake/deps.sh
need gcc g++ libc6-dev make cmake pkg-config libpng-dev libjpeg-dev zlib1g-dev check libgmp-dev python3-numpy python3-pil librsvg2-bin

page=docs/papers.md
out=build/papers
build=build/release
mkdir -p "$out"

# Commands run in a folder of their own that looks like the top of the tree, so what they write stays there.
for folder in build examples bindings; do
    ln -sfn "$PWD/$folder" "$out/$folder"
done
mkdir -p "$out/bin"
ln -sfn /usr/bin/python3 "$out/bin/python3"
PATH=$PWD/$out/bin:$PWD/$build/tools:$PATH
PYTHONPATH=$PWD/bindings/python
LIBICC_LIBRARY=$PWD/$build/lib/libicc.so.0
PYTHONUNBUFFERED=1
PYTHONDONTWRITEBYTECODE=1
export PATH PYTHONPATH LIBICC_LIBRARY PYTHONUNBUFFERED PYTHONDONTWRITEBYTECODE

# made NAME COMMAND... says that it runs a command, whose output goes to $out/NAME.txt, and adds its seconds to the table.
made() {
    name=$1
    shift
    begin=$(date +%s.%N)
    echo "$name: running; tail -f $out/$name.txt shows how far it is"
    quietly "$out/$name.txt" "$@"
    date +%s.%N | awk -v begin="$begin" -v name="$name" -v command="$*" \
        '{ printf "%-12s %6.1f s  %s\n", name, $1 - begin, command }' | tee -a "$out/table.txt"
}

pictures() {
    /usr/bin/python3 docs/papers_pictures.py "$1"
}

if [ "${1:-}" = --pictures ]; then
    pictures docs/images
    exit
fi

: >"$out/table.txt"
made examples sh examples/run.sh --all
# The studio's session needs a browser. Backquotes are the page's.
# shellcheck disable=SC2016
sed -n 's/^| [FTA][^|]*|[^|]*| `\([^`]*\)` |.*/\1/p' "$page" | grep -v '^sh examples/studio/' | sort -u >"$out/commands"
[ -s "$out/commands" ] || { echo "$page has no commands" >&2; exit 1; }

# The programs of benchmarks and tests are called as their files are.
targets=$(sed -n 's,^build/release/tests/bench/\([a-z_]*\).*,\1,p; s,^ctest .* -R \([^$]*\).*,\1,p' "$out/commands" | tr / _)
made configure cmake -S . -B "$build" -DICC_BUILD_BENCHMARKS=ON
# The names are words.
# shellcheck disable=SC2086
made build cmake --build "$build" --parallel "$(nproc)" --target $targets

number=0
while read -r command; do
    number=$((number + 1))
    made "$number" sh -euc "cd $out && $command"
done <"$out/commands"
made pictures pictures "$out"
made page /usr/bin/python3 -B tests/docs/snippets.py "$PWD" "$PWD/build/examples/stage" "$PWD/$out/page" cc c++ "" "$PWD/$page"
echo "all of it is in $out and build/examples/out; the table is $out/table.txt"
