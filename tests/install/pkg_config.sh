#!/bin/sh
# pkg-config libicc, shared and --static. It fails where libicc is not installed.
# usage: pkg_config.sh CMAKE STAGE WORK_DIR CC C_FLAGS CXX
set -eu
stage=$2 work=$3 cc=$4 flags=$5 cxx=$6
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$work"
mkdir -p "$work"
pc=$(find "$stage" -name libicc.pc)
lib=$(dirname "$(dirname "$pc")")

if PKG_CONFIG_LIBDIR="$work" pkg-config --exists libicc; then
    echo "pkg-config finds libicc although it is not there"
    exit 1
fi
if "$cc" "$here/consumer.c" -o "$work/without" -licc -L"$work" 2>"$work/without.log"; then
    echo "compiled although libicc is not there"
    exit 1
fi

export PKG_CONFIG_LIBDIR="${pc%/*}"
version=$(pkg-config --modversion libicc)

# The flags are lists of words.
# shellcheck disable=SC2046,SC2086
"$cc" $flags $(pkg-config --cflags libicc) "$here/consumer.c" -o "$work/shared" \
    $(pkg-config --libs libicc)
LD_LIBRARY_PATH=$lib "$work/shared" "$version"
if "$work/shared" "$version" 2>/dev/null; then
    echo "runs without the shared library"
    exit 1
fi

# shellcheck disable=SC2046,SC2086
"$cxx" -std=c++17 $flags $(pkg-config --cflags libicc) "$here/wrapper.cpp" -o "$work/wrapper" \
    $(pkg-config --libs libicc)
LD_LIBRARY_PATH=$lib "$work/wrapper"

# The linker takes the first folder that has any libicc, here one without libicc.so.
mkdir "$work/only_static"
cp "$lib/libicc.a" "$work/only_static"
# shellcheck disable=SC2046,SC2086
"$cc" $flags $(pkg-config --cflags libicc) "$here/consumer.c" -o "$work/static" \
    -L"$work/only_static" $(pkg-config --static --libs libicc)
"$work/static" "$version"
