#!/bin/sh
# How much of the static library programs link that call only a few functions. The linker's map tells: code and data of each
# object of the library, without what debuggers read. tests/links.txt has the functions and the most bytes.
# usage: check_links.sh LINKS.TXT LIBICC.A WORK_DIR CC [list]
#   list      prints the objects of each program, too
set -eu
table=$1 library=$2 work=$3 cc=$4 task=${5:-check}
mkdir -p "$work"

# The sizes of a map's sections: " .text 0x.. 0xSIZE ..libicc.a(OBJECT)", on two lines if the name is long.
sizes() {
    awk '
        function digits(hex,   n, k) {
            n = 0
            for (k = 3; k <= length(hex); ++k) n = 16 * n + index("0123456789abcdef", substr(hex, k, 1)) - 1
            return n
        }
        /^Linker script and memory map/ { in_map = 1; next }
        !in_map { next }
        /^ \.[^ ]+$/ { name = $1; next }
        { if (/^ \./) { name = $1; at = 2 } else at = 1 }
        $at ~ /^0x/ && $(at + 1) ~ /^0x/ && match($(at + 2), /libicc\.a\([^)]*\)$/) && name !~ /^\.(comment|note|debug)/ {
            object = substr($(at + 2), RSTART + 10, RLENGTH - 11)
            bytes[object] += digits($(at + 1))
        }
        { name = "" }
        END { for (object in bytes) print bytes[object], object }' "$1"
}

failed=0
n_programs=0
while read -r most functions; do
    case $most in \#*) continue ;; esac
    {
        echo '#include <stdint.h>'
        for function in $functions; do
            echo "void $function(void);"
        done
        echo 'int main(void)'
        echo '{'
        echo '    uintptr_t sum = 0;'
        for function in $functions; do
            echo "    sum += (uintptr_t)&$function;"
        done
        echo '    return sum == 0;'
        echo '}'
    } >"$work/program.c"
    "$cc" "$work/program.c" "$library" -o "$work/program" -lm -lpthread "-Wl,-Map=$work/map"
    sizes "$work/map" | sort -rn >"$work/sizes"
    [ "$task" != list ] || cat "$work/sizes"
    n_bytes=$(awk '{ n += $1 } END { print n + 0 }' "$work/sizes")
    echo "$n_bytes bytes of at most $most, $(wc -l <"$work/sizes") objects: $functions"
    # A map in which nothing is found holds for the wrong reason.
    if [ "$n_bytes" -eq 0 ] || [ "$n_bytes" -gt "$most" ]; then
        echo "that is not within 1 to $most"
        failed=1
    fi
    n_programs=$((n_programs + 1))
done <"$table"
[ "$n_programs" -gt 0 ] || { echo "no programs in $table"; exit 1; }
exit $failed
