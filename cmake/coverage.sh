#!/bin/sh
# Line coverage of lib/ by the whole test suite. Prints a line per file and the lines that no test
# reaches; fails below the limit.
# usage: sh cmake/coverage.sh [PERCENT]
set -eu
cd "$(dirname "$0")/.."
limit=${1:-95}
build=build/coverage
root=$PWD

if [ -d "$build" ]; then
    find "$build" -name '*.gcda' -delete
fi
ICC_TEST_SHARE=100 sh tests/run.sh coverage >"$build.log" 2>&1 || { tail -n 40 "$build.log"; exit 1; }
tail -n 1 "$build.log"

rm -rf "$build/gcov"
mkdir "$build/gcov"
cd "$build/gcov"
find "$root/$build/lib" -name '*.gcda' -exec gcov --preserve-paths {} + >gcov.log 2>&1

# Lines of a .gcov file read COUNT:NUMBER:TEXT; the count is - for no code and ##### for never run.
# A header is in many files, each telling what one source made of it: a line ran if it ran once.
for report in *"#lib#"*.gcov; do
    name=$(sed -n '1s/.*Source:.*\/lib\//lib\//p' "$report")
    [ -z "$name" ] || sed "s|^|$name:|" "$report"
done | tr -d ' ' | awk -F: -v limit="$limit" '
    $3 > 0 && $2 != "-" {
        line = $1 ":" $3
        if (!(line in ran)) { ran[line] = 0; total[$1]++ }
        if ($2 !~ /^[#=]/ && !ran[line]) { ran[line] = 1; hit[$1]++ }
    }
    END {
        for (line in ran) if (!ran[line]) print "never run: " line | "sort -t: -k2,2 -k3,3n"
        close("sort -t: -k2,2 -k3,3n")
        for (file in total) {
            all += total[file]; run += hit[file]
            printf "%6.1f %%  %5d lines  %s\n", 100 * hit[file] / total[file], total[file], file | "sort -k5"
        }
        close("sort -k5")
        if (all == 0) { print "nothing was measured"; exit 1 }
        percent = 100 * run / all
        printf "%6.1f %%  %5d lines  in all (at least %g %% wanted)\n", percent, all, limit
        exit percent < limit
    }'
