#!/bin/sh
# Each public header compiles by itself as C and C++ of every age, and is plain C for those who parse
# headers instead of compiling them. That for C++ compiles as C++17 and later, by itself and in use.
# usage: check_headers.sh INCLUDE_DIR
set -eu
include=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# check COMPILER LANGUAGE STANDARD FLAG... compiles $file.
check() {
    compiler=$1 language=$2 standard=$3
    shift 3
    if ! "$compiler" -x "$language" -std="$standard" -pedantic -Wall -Wextra -Werror "$@" \
        -I"$include" -fsyntax-only "$file" 2>"$work/log"; then
        echo "icc/$name does not compile with $compiler -std=$standard $*:"
        cat "$work/log"
        failed=1
    fi
}

for compiler in gcc clang; do
    command -v "$compiler" >/dev/null || continue
    file=$work/one.c
    for header in "$include"/icc/*.h; do
        name=${header##*/}
        {
            printf '#include <icc/%s>\n#include <icc/%s>\n' "$name" "$name"
            echo 'int icc_status_of_none(void);'
            echo 'int icc_status_of_none(void) { icc_error err = ICC_INIT(icc_error); return err.status; }'
        } >"$work/one.c"
        for standard in c99 c11 c17 c2x; do
            check "$compiler" c "$standard" -Wstrict-prototypes -Wundef
        done
        # C++98 has no <cstdint> and no long long; every compiler has both nevertheless.
        check "$compiler" c++ c++98 -Wno-long-long
        for standard in c++11 c++14 c++17 c++20; do
            check "$compiler" c++ "$standard" -Wundef
        done
        if "$compiler" -E -P -DICC_STATIC -I"$include" "$work/one.c" |
            sed -n '/icc_status/,$p' | grep -n '__attribute__\|__declspec\|__asm'; then
            echo "icc/$name is not plain C with -DICC_STATIC"
            failed=1
        fi
    done
    name=icc.hpp
    printf '#include <icc/icc.hpp>\n#include <icc/icc.hpp>\nint main() {}\n' >"$work/one.cpp"
    for file in "$work/one.cpp" "$(dirname "$0")/install/wrapper.cpp"; do
        for standard in c++17 c++20 c++2b; do
            check "$compiler" c++ "$standard" -Wundef -Wshadow -Wconversion -Wsign-conversion \
                -Wold-style-cast -Wnon-virtual-dtor
        done
    done
done
exit $failed
