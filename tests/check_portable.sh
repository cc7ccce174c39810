#!/bin/sh
# What is not ISO C11 is listed: every file of the library and the command that includes a header of another standard, or
# asks for POSIX, is named in CONTRIBUTING.md under "Other systems", and what is named there exists.
# usage: check_portable.sh TOP
set -eu
cd "$1"
standard='assert|complex|ctype|errno|fenv|float|inttypes|iso646|limits|locale|math|setjmp|signal|stdalign|stdarg|stdatomic'
standard="$standard|stdbool|stddef|stdint|stdio|stdlib|stdnoreturn|string|tgmath|threads|time|uchar|wchar|wctype"
others='icc/|png|jpeglib|jerror|zlib' # our own, and libraries that CMake looks for
# shellcheck disable=SC2016 # Markdown's quotes
listed=$(sed -n '/^## Other systems/,/^## Benchmarks/p' CONTRIBUTING.md | grep -oE '`[a-z]+/[a-z0-9_/]+[.][a-z]+`' | tr -d '`' | sort -u)

failed=0
[ -n "$listed" ] || failed=1
for file in $listed; do
    [ -e "$file" ] || { echo "CONTRIBUTING.md names $file, which is not there"; failed=1; }
done
# shellcheck disable=SC2016 # awk's variables
foreign='/^#include </ && $0 !~ mine || /^#define _(POSIX|XOPEN|GNU|DARWIN)/ { if (!told[FILENAME]++) print FILENAME }'
found=$(find lib tools -name '*.[ch]' -exec awk -v mine="^#include <(($standard)[.]h|($others).*)>" "$foreign" {} +)
for file in $found; do
    echo "$listed" | grep -qx "$file" || { echo "$file is not ISO C11, and CONTRIBUTING.md does not name it"; failed=1; }
done
exit $failed
