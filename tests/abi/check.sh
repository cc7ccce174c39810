#!/bin/sh
# Nothing in the binary interface has been removed or changed since the baseline, libicc.so.0.xml. What has been
# added is listed. Numbers of enumerators, which abidiff cannot see, are pinned in tests/api/test_abi.c, and sizes
# and offsets once more: it must not miss any.
# usage: check.sh CC SOURCE_DIR LIBRARY_WITH_DEBUG_INFORMATION LIBRARY [--update]
set -eu
cc=$1 source=$2 debug=$3 library=$4 update=${5:-}
baseline=$source/tests/abi/libicc.so.0.xml
pins=$source/tests/api/test_abi.c
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Without paths, lines and whatever else differs from one machine to the next.
abidw --suppressions "$source/tests/abi/public.suppr" --drop-private-types --drop-undefined-syms --exported-interfaces-only \
    --no-corpus-path --no-comp-dir-path --no-show-locs --no-elf-needed --no-parameter-names \
    --no-write-default-sizes --type-id-style hash --out-file "$work/now.xml" "$debug"

failed=0
fail() {
    echo "$1"
    cat "$2"
    failed=1
}

symbols() {
    sed -n "s/.*<elf-symbol name='\([^']*\)' version='ICC_0'.*/\1/p" "$1" | sort
}
symbols "$work/now.xml" >"$work/now"
nm -D --defined-only "$library" | sed -n 's/.* \(.*\)@@ICC_0$/\1/p' | sort >"$work/exported"
diff "$work/exported" "$work/now" >"$work/elsewhere" ||
    fail "these functions are not defined in lib/api/, so their types cannot be seen:" "$work/elsewhere"
if grep "name='iccp_" "$work/now.xml" >"$work/private"; then
    fail "internal types are part of the interface:" "$work/private"
fi

# Every constant and every member that the headers have.
{
    for header in "$source"/include/icc/*.h; do
        "$cc" -E -P -I"$source/include" "$header" | grep -o '\<ICC_[A-Z0-9_]*' | sed 's/.*/IS(&,/'
    done
    awk -F "'" '/<class-decl/ { type = $2; if (!/is-declaration-only/) print "SIZE(" type "," }
                /<data-member/ { member = 1 }
                /<var-decl/ && member { print "AT(" type ", " $2 ","; member = 0 }' "$work/now.xml"
} | sort -u >"$work/wanted"
while read -r pin; do
    grep -qF "$pin" "$pins" || echo "$pin"
done <"$work/wanted" >"$work/unpinned"
[ ! -s "$work/unpinned" ] || fail "not pinned in tests/api/test_abi.c:" "$work/unpinned"

if [ "$update" = --update ]; then
    [ "$failed" -eq 0 ] || exit 1
    cp "$work/now.xml" "$baseline"
    exit
fi

architecture() {
    sed -n "s/.*<abi-corpus .*architecture='\([^']*\)'.*/\1/p" "$1"
}
if [ "$(architecture "$work/now.xml")" != "$(architecture "$baseline")" ]; then
    echo "the baseline is for $(architecture "$baseline"), this is $(architecture "$work/now.xml"): not compared"
    [ "$failed" -eq 0 ] || exit 1
    exit 77
fi
abidiff --no-added-syms --harmless "$baseline" "$work/now.xml" >"$work/report" ||
    fail "the binary interface has changed (see docs/reference/abi.md):" "$work/report"
symbols "$baseline" | comm -13 - "$work/now" >"$work/added"
if [ -s "$work/added" ]; then
    echo "not in the baseline (cmake --build BUILD --target update_abi puts them there):"
    cat "$work/added"
fi
exit "$failed"
