#!/bin/sh
# What docs/style.md asks of source files and a machine can see: no line of lib/ and include/ is longer than 100 columns,
# every START_TEST has its END_TEST (without it Check compiles and tests/plain does not), and, given clang-format, every C
# file is as .clang-format says. Names of files are for check_order.sh.
# usage: check_style.sh TOP [CLANG_FORMAT]
set -eu
cd "$1"
clang_format=${2:-}
failed=0

sources() {
    find "$@" -name build -prune -o -name target -prune -o -name '*.[ch]' -print
}

# A rule that finds nothing to look at holds for the wrong reason.
for folder in bindings examples include lib tests tools; do
    [ -n "$(sources "$folder")" ] || { echo "no sources found in $folder"; exit 1; }
done

if sources include lib | LC_ALL=C.UTF-8 xargs grep -nE '^.{101}'; then
    echo "these lines are longer than 100 columns"
    failed=1
fi
unended=$(grep -rl '^START_TEST(' --include='*.c' tests | while read -r file; do
    [ "$(grep -c '^START_TEST(' "$file")" -eq "$(grep -c '^END_TEST$' "$file")" ] || echo "$file"
done)
if [ -n "$unended" ]; then
    echo "not every START_TEST has its END_TEST in $unended"
    failed=1
fi
if [ -n "$clang_format" ]; then
    sources bindings examples include lib tests tools | xargs "$clang_format" --dry-run -Werror || failed=1
fi
exit $failed
