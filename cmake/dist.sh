#!/bin/sh
# Makes the files of a release in dist/, from the last commit: two runs give the same bytes, wherever the clone is.
# Changes that are not committed stay out. Logs and build folders are in build/dist.
# usage: sh cmake/dist.sh PART...
#   source          the archive of the sources
#   linux-x86_64    the command for Linux, one file that needs no library
#   linux-arm64     the same for arm64, by Debian's cross compiler
#   windows         the command and the library for Windows, by mingw-w64
#   python          the Python wheels for both Linux machines, the source distribution, and the add-ons for QGIS and Blender
#   crates          the Rust crates
#   npm             the npm package, and the studio, which is one page
#   debian          the Debian packages; needs root
#   notes           checksums, and release.md, which says what to upload where
# A part that fails does not stop the others; the script then ends with 1. Each part installs the Debian packages that
# it needs, or names them (see need in cmake/deps.sh).
set -eu
cd "$(dirname "$0")/.."
top=$PWD
# shellcheck source=cmake/deps.sh
. cmake/deps.sh

# Each part is a run of its own, so that one can stop without the others.
if [ $# -ne 1 ]; then
    failed=
    for part in "$@"; do
        sh cmake/dist.sh "$part" || failed="$failed $part"
    done
    [ -n "$failed" ] || exit 0
    echo "dist: not made:$failed" >&2
    exit 1
fi

if ! commit=$(git rev-parse --verify --quiet HEAD); then
    echo "dist: a release is made from a commit, so this has to be a clone (and git to be installed)" >&2
    exit 1
fi
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH TZ=UTC LC_ALL=C.UTF-8
umask 022
jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}
version=$(sed -n 's/^#define ICCP_VERSION_.* //p' lib/base/version.h | paste -s -d .)
dist=$top/dist
made=$top/build/dist
tree=$made/tree
# step() has a variable `name`.
release=libicc-$version

# archive ARGUMENT...: the commit as tar. It says who may read the files, because git's settings differ.
archive() {
    git -c tar.umask=0022 archive HEAD "$@"
}

# The tree of the commit. What another commit has left behind goes, except for libraries of other machines.
prepare() {
    [ "$(cat "$made/commit" 2>/dev/null)" != "$commit" ] || return 0
    [ -z "$(git status --porcelain)" ] || echo "dist: changes that are not committed stay out" >&2
    rm -rf "$dist" "$tree" "$made"/*/build "$made"/*/libicc.so.0 "$made"/windows/libicc-*
    mkdir -p "$tree" "$dist"
    archive | tar -C "$tree" -x
    echo "$commit" >"$made/commit"
}

# all_alike FOLDER: files that differ only in when and by whom they were made become the same.
all_alike() {
    chmod -R u=rwX,go=rX "$1"
    find "$1" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +
}

# packed ARCHIVE.tar.gz FOLDER: the folder, which is in $work, as an archive.
packed() {
    all_alike "$work/$2"
    tar -C "$work" --sort=name --owner=0 --group=0 --numeric-owner --format=ustar -c "$2" | gzip -9n >"$dist/$1"
}

# licences FOLDER NAME=COPYRIGHT_FILE...: the licences of what is linked in.
licences() {
    texts=$1/licences
    shift
    mkdir "$texts"
    for pair in "$@"; do
        cp "${pair#*=}" "$texts/${pair%%=*}.txt"
    done
}

# Debian wants the archive of the sources without its own folder.
make_source() {
    need git xz-utils
    archive --prefix="$release/" -- . ':!debian' | xz -9 -T1 >"$dist/$release.tar.xz"
}

# linux MACHINE LIBRARIES DOC STRIP GLIBC OPTION...: the command, with static libraries from the folder LIBRARIES, whose
# licences are in DOC; and the shared library for Python. GLIBC is the version of the GNU C library's source package.
linux() {
    machine=$1 libraries=$2 doc=$3 strip=$4 glibc=${5:?}
    shift 5
    cmake -S "$tree" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXE_LINKER_FLAGS=-static \
        -DPNG_LIBRARY="$libraries/libpng.a" -DZLIB_LIBRARY="$libraries/libz.a" -DJPEG_LIBRARY="$libraries/libjpeg.a" "$@"
    cmake --build "$work/build" --parallel "$jobs" --target libicc_tool icc
    folder=$release-linux-$machine
    rm -rf "${work:?}/$folder"
    mkdir "$work/$folder"
    "$strip" -o "$work/$folder/libicc" "$work/build/tools/libicc"
    "$strip" -o "$work/libicc.so.0" "$work/build/lib/libicc.so.0"
    mkdir "$work/$folder/man"
    cp "$tree/LICENSE" "$work/$folder"
    cp "$tree"/docs/man/*.[15] "$work/$folder/man"
    licences "$work/$folder" glibc="$doc/libc6-dev/copyright" libpng="$doc/libpng-dev/copyright" \
        libjpeg-turbo="$doc/libjpeg62-turbo-dev/copyright" zlib="$doc/zlib1g-dev/copyright"
    # The LGPL asks where the library's source is, and how to link with another version of it.
    cat >"$work/$folder/licences/README.txt" <<END
The program libicc holds parts of the projects whose licences are in this folder.

One of them is the GNU C library, under the LGPL. Its source is Debian's source package glibc, version $glibc:
    https://snapshot.debian.org/package/glibc/$glibc/
To link libicc with another version of it, unpack the sources of this release, $release.tar.xz. Then run there
    cmake -S . -B build -DCMAKE_EXE_LINKER_FLAGS=-static
    cmake --build build --target libicc_tool
END
    packed "$folder.tar.gz" "$folder"
}

make_linux_x86_64() {
    if [ "$(uname -m)" != x86_64 ]; then
        echo "this part needs a machine with an x86-64 processor" >&2
        return 1
    fi
    need gcc libc6-dev make cmake libpng-dev libjpeg-dev zlib1g-dev
    glibc=$(dpkg-query -W -f '${source:Version}' libc6-dev)
    linux x86_64 /usr/lib/x86_64-linux-gnu /usr/share/doc strip "$glibc"
}

make_linux_arm64() {
    need gcc-aarch64-linux-gnu libc6-dev make cmake mmdebstrap
    root=$work/root
    foreign_root arm64 bookworm libc6-dev,libpng-dev,libjpeg-dev
    doc=$root/usr/share/doc
    glibc=$(zcat "$doc/libc6-dev/changelog.Debian.gz" | sed -n '1{s/^glibc (\(.*\)).*/\1/p;q;}')
    linux arm64 "$root/usr/lib/aarch64-linux-gnu" "$doc" aarch64-linux-gnu-strip "$glibc" \
        -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_C_COMPILER=aarch64-linux-gnu-gcc \
        -DCMAKE_SYSROOT="$root" -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY \
        -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY
}

# One program, and the library for other programs. The archive holds its files in the order of their names.
make_windows() {
    need gcc-mingw-w64-x86-64-posix libz-mingw-w64-dev dpkg-dev cmake make libpng-dev libjpeg-dev python3
    sh "$tree/cmake/mingw_libraries.sh" "$work/libraries"
    cmake -S "$tree" --preset mingw -B "$work/build" -DICC_BUILD_TOOLS=ON -DICC_BUILD_PLAIN_TESTS=OFF \
        "-DCMAKE_FIND_ROOT_PATH=/usr/x86_64-w64-mingw32;$work/libraries"
    cmake --build "$work/build" --parallel "$jobs" --target libicc_tool icc
    folder=$release-windows-x86_64
    rm -rf "${work:?}/$folder" "$dist/$folder.zip"
    mkdir -p "$work/$folder/include"
    x86_64-w64-mingw32-strip -o "$work/$folder/libicc.exe" "$work/build/tools/libicc.exe"
    x86_64-w64-mingw32-strip -o "$work/$folder/libicc.dll" "$work/build/lib/libicc.dll"
    cp "$work/build/lib/libicc.dll.a" "$work/$folder"
    cp -r "$tree/include/icc" "$work/$folder/include"
    cp "$tree/LICENSE" "$work/$folder"
    doc=/usr/share/doc
    licences "$work/$folder" libpng=$doc/libpng-dev/copyright libjpeg-turbo=$doc/libjpeg62-turbo-dev/copyright \
        zlib=$doc/libz-mingw-w64-dev/copyright mingw-w64=$doc/mingw-w64-x86-64-dev/copyright \
        gcc=$doc/gcc-mingw-w64-base/copyright
    all_alike "$work/$folder"
    (cd "$work" && /usr/bin/python3 -m zipfile -c "$dist/$folder.zip" "$folder")
}

# The zip files for QGIS and Blender serve Linux on x86-64 and Windows at once.
addons() {
    set --
    for library in "$made/linux-x86_64/libicc.so.0" "$made/windows/$release-windows-x86_64/libicc.dll"; do
        if [ -e "$library" ]; then
            set -- "$@" "$library"
        else
            echo "left out: ${library##*/} in the add-ons, because it has not been made"
        fi
    done
    [ $# -gt 0 ] || return 0
    /usr/bin/python3 -B "$tree/examples/addons.py" "$work" "$@"
    for program in qgis blender; do
        mv "$work/libicc-$program.zip" "$dist/$release-$program.zip"
    done
}

# The wheels hold the shared libraries that have been made for the command's machines.
make_python() {
    need python3-setuptools python3-wheel cmake
    for machine in x86_64 arm64; do
        library=$made/linux-$machine/libicc.so.0
        if ! [ -e "$library" ]; then
            echo "left out: the wheel for $machine, because the part linux-$machine has not been made"
            continue
        fi
        rm -rf "$work/source"
        cp -r "$tree" "$work/source"
        (
            cd "$work/source/bindings/python"
            LIBICC_LIBRARY=$library /usr/bin/python3 setup.py -q bdist_wheel --dist-dir "$dist"
        )
    done
    addons
    rm -rf "$work/source" "$work/sdist"
    cp -r "$tree" "$work/source"
    (
        cd "$work/source/bindings/python"
        /usr/bin/python3 setup.py -q sdist --formats=tar --dist-dir "$work/sdist"
    )
    tar -C "$work/sdist" -xf "$work/sdist/$release.tar"
    rm -rf "${work:?}/$release"
    mv "$work/sdist/$release" "$work"
    # PyPI wants this name; the archive of the sources ends with .tar.xz.
    packed "$release.tar.gz" "$release"
}

# package_crate NAME ARGUMENT...: by Debian's Cargo, so that the crates are known to build with Rust 1.63.
package_crate() {
    (
        cd "$work/rust/$1"
        shift
        RUSTC=/usr/bin/rustc CARGO_HOME=$work/home /usr/bin/cargo package --offline --quiet --allow-dirty --no-verify \
            --target-dir "$work/target" "$@"
    )
}

# The second crate needs the first one in a registry: a folder is one. It needs no compiler.
make_crates() {
    need cargo rustc
    rm -rf "$work/rust" "$work/target" "$work/registry"
    mkdir -p "$work/rust" "$work/registry"
    cp -rL "$tree/bindings/rust/." "$work/rust"
    package_crate libicc-sys
    tar -C "$work/registry" -xzf "$work/target/package/libicc-sys-$version.crate"
    printf '{"files":{},"package":"%s"}' "$(sha256sum <"$work/target/package/libicc-sys-$version.crate" | cut -d' ' -f1)" \
        >"$work/registry/libicc-sys-$version/.cargo-checksum.json"
    package_crate libicc --config 'source.crates-io.replace-with="here"' \
        --config "source.here.directory=\"$work/registry\""
    cp "$work"/target/package/*.crate "$dist"
}

make_npm() {
    need clang lld llvm wasi-libc libclang-rt-dev-wasm32 binaryen cmake make
    command -v node >/dev/null || need nodejs
    command -v npm >/dev/null || need npm
    cmake -S "$tree" --preset wasm -B "$work/build"
    cmake --build "$work/build" --parallel "$jobs"
    cp "$work/build/$release.tgz" "$work/build/studio.html" "$dist"
}

make_debian() {
    [ -e "$dist/$release.tar.xz" ] || make_source
    status=0
    LIBICC_DEBIAN_ORIG=$dist/$release.tar.xz DEB_BUILD_OPTIONS=${DEB_BUILD_OPTIONS:-nocheck} \
        sh "$tree/tests/debian.sh" "$work" || status=$?
    # It says why it cannot do it here.
    [ "$status" -eq 0 ] || return 1
    rm -rf "$dist/debian"
    mkdir "$dist/debian"
    find "$work/debian" -maxdepth 1 -type f \( -name '*.deb' -o -name '*.dsc' -o -name '*.debian.tar.*' \
        -o -name '*.orig.tar.*' -o -name '*.changes' -o -name '*.buildinfo' \) -exec cp {} "$dist/debian" \;
}

# news.md is the first section of NEWS.md for the release page, where relative links would lead nowhere.
make_notes() {
    rm -f "$dist/SHA256SUMS"
    (
        cd "$dist"
        find . -type f ! -name '*.md' ! -name '*.asc' | sed 's|^\./||' | sort | xargs sha256sum
    ) >"$work/sums"
    mv "$work/sums" "$dist/SHA256SUMS"
    sed -n '/^## /{:line;n;/^## /q;p;b line;}' "$tree/NEWS.md" | sed -z 's/\[\([^]]*\)\]([^):]*)/\1/g' >"$dist/news.md"
    sh "$tree/cmake/dist_notes.sh" "$dist" "$commit" >"$dist/release.md"
}

case $1 in
    source | linux-x86_64 | linux-arm64 | windows | python | crates | npm | debian | notes) ;;
    *)
        echo "dist.sh knows no part $1" >&2
        exit 2
        ;;
esac
prepare
work=$made/$1
mkdir -p "$work"
step dist "$1" "make_$(echo "$1" | tr - _)"
sed -n 's/^left out: /dist: &/p' "$work/$1.log"
