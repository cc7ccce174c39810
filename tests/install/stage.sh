#!/bin/sh
# Installs a build into an empty folder and looks at what is there.
# usage: stage.sh CMAKE BUILD_DIR STAGE
set -eu
cmake=$1 build=$2 stage=$3
rm -rf "$stage"
"$cmake" --install "$build" --prefix "$stage" >"$stage.log"

lib=$(dirname "$(find "$stage" -name libicc.so.0)")
for file in libicc.so libicc.so.0 libicc.a pkgconfig/libicc.pc cmake/libicc/libiccConfig.cmake \
    cmake/libicc/libiccConfigVersion.cmake; do
    [ -e "$lib/$file" ] || { echo "not installed: $file"; exit 1; }
done
for header in "$(dirname "$0")"/../../include/icc/*; do
    cmp "$header" "$stage/include/icc/${header##*/}"
done

# Nothing belongs to another component, or to none.
parts=$stage.parts
rm -rf "$parts"
for component in Runtime Development Tools; do
    "$cmake" --install "$build" --prefix "$parts" --component "$component" >"$stage.log"
done
files() {
    find "$1" ! -type d -printf '%P\n' | sort
}
files "$stage" >"$stage.all"
files "$parts" | diff "$stage.all" -

soname=$(objdump -p "$lib/libicc.so" | awk '$1 == "SONAME" { print $2 }')
[ "$soname" = libicc.so.0 ] || { echo "the soname is $soname"; exit 1; }
if grep -rn "$build" "$stage/include" "$lib/pkgconfig" "$lib/cmake" |
    grep -vE "=$stage(/|\$)"; then
    echo "an installed file names the build folder"
    exit 1
fi
