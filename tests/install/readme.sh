#!/bin/sh
# The program in README.md compiles without a warning against the installed library, and runs.
# usage: readme.sh CMAKE STAGE WORK_DIR CC C_FLAGS
set -eu
stage=$2 work=$3 cc=$4 flags=$5
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
pc=$(find "$stage" -name libicc.pc)
export PKG_CONFIG_LIBDIR="${pc%/*}"
lib=$(dirname "${pc%/*}")

# The backticks are those of the text.
# shellcheck disable=SC2016
sed -n '/^```c$/,/^```$/p' "$here/../../README.md" | grep -v '^```' >"$work/readme.c"
# The flags are lists of words.
# shellcheck disable=SC2046,SC2086
"$cc" $flags -std=c99 -Wall -Wextra -Wpedantic -Werror $(pkg-config --cflags libicc) \
    "$work/readme.c" -o "$work/readme" $(pkg-config --libs libicc)
LD_LIBRARY_PATH=$lib "$work/readme" >"$work/out"
cat "$work/out"
[ -s "$work/out" ]
