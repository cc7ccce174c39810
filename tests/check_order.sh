#!/bin/sh
# A source file may include only files listed above it in lib/CMakeLists.txt, and every file is
# listed. That makes cycles between modules impossible.
# usage: check_order.sh LIB_DIR
set -eu
cd "$1"

listed=$(sed -n '/^set(ICC_SOURCES/,/)/p' CMakeLists.txt | tr -d ')' | tr -s ' ' '\n' |
    grep '\.[ch]$')
failed=0

included() {
    sed -n 's|^[[:space:]]*#[[:space:]]*include[[:space:]]*"\([^"]*\)".*|\1|p' "$1"
}

for file in $listed; do
    [ -f "$file" ] || { echo "lib/CMakeLists.txt lists $file, which does not exist"; failed=1; }
done
for file in $(find . -name '*.[ch]' | sed 's|^\./||'); do
    echo "$listed" | grep -qx "$file" || { echo "lib/CMakeLists.txt lacks $file"; failed=1; }
done

above=
for file in $listed; do
    [ -f "$file" ] || continue
    for name in $(included "$file"); do
        case $name in
            icc/*) continue ;;
        esac
        case " $above " in
            *" $name "*) ;;
            *) echo "lib/$file includes \"$name\", which is not listed above it"; failed=1 ;;
        esac
    done
    above="$above $file"
done

# A rule that finds nothing to look at holds for the wrong reason.
[ -n "$above" ] || { echo "no sources found in $1"; failed=1; }
exit $failed
