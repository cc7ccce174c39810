#!/bin/sh
# Static libraries that the command needs on Windows and Debian does not have for mingw-w64, from Debian's sources of them:
# libpng and libjpeg-turbo. Afterwards, at the top of the tree,
#   cmake --preset mingw -DICC_BUILD_TOOLS=ON "-DCMAKE_FIND_ROOT_PATH=/usr/x86_64-w64-mingw32;$PWD/FOLDER"
# usage: sh cmake/mingw_libraries.sh FOLDER
set -eu
top=$(cd "$(dirname "$0")/.." && pwd)
# shellcheck source=cmake/deps.sh
. "$top/cmake/deps.sh"
mkdir -p "$1/lib" "$1/include" "$1/sources/lists/partial"
cd "$1"
[ ! -e complete ] || exit 0
need gcc-mingw-w64-x86-64-posix libz-mingw-w64-dev cmake make dpkg-dev
root=$PWD
cd sources

# apt's own lists may be without sources.
echo "deb-src $(debian_mirror) bookworm main" >sources.list
for step in update "source libpng1.6 libjpeg-turbo"; do
    # shellcheck disable=SC2086 # a command and its arguments
    apt-get -qq -o Dir::Etc::sourcelist="$PWD/sources.list" -o Dir::Etc::sourceparts=/nowhere \
        -o Dir::State::lists="$PWD/lists" -o Dir::Cache="$PWD" -o APT::Sandbox::User=root $step
done

# build NAME TARGET OPTION...: one library of the sources that are unpacked as NAME-VERSION.
build() {
    name=$1 target=$2
    shift 2
    cmake -S "$name"-[0-9]*[0-9] -B "build-$name" -DCMAKE_TOOLCHAIN_FILE="$top/cmake/x86_64-w64-mingw32.cmake" \
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$root" "$@"
    cmake --build "build-$name" --parallel "$(nproc)" --target "$target"
}
build libjpeg-turbo jpeg-static -DENABLE_SHARED=OFF -DWITH_SIMD=OFF -DWITH_TURBOJPEG=OFF -DCMAKE_SYSTEM_PROCESSOR=AMD64
build libpng1.6 png_static -DPNG_SHARED=OFF -DPNG_TESTS=OFF

cp build-libjpeg-turbo/libjpeg.a "$root/lib"
cp build-libpng1.6/libpng16.a "$root/lib/libpng.a"
for header in build-libjpeg-turbo/jconfig.h libjpeg-turbo-*/jerror.h libjpeg-turbo-*/jmorecfg.h libjpeg-turbo-*/jpeglib.h \
    build-libpng1.6/pnglibconf.h libpng1.6-*/png.h libpng1.6-*/pngconf.h; do
    cp "$header" "$root/include"
done
cd "$root"
rm -r sources
touch complete
