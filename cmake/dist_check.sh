#!/bin/sh
# Tries what is in dist/, as somebody does who has only the file: the command in a system that holds nothing else, the
# wheel and the source distribution in virtual environments, the crates and the npm package from other projects, and
# the program for Windows by Wine. All of them bend the same fish or map the same point.
# usage: sh cmake/dist_check.sh [CHECK...]     source, linux-x86_64, linux-arm64, windows, wheel, sdist, crates, npm;
#                                              without any: what is there
# tests/debian.sh, which makes the Debian packages, has tried them.
set -eu
cd "$(dirname "$0")/.."
# shellcheck source=cmake/deps.sh
. cmake/deps.sh
top=$PWD
dist=$top/dist
version=$(sed -n 's/^#define ICCP_VERSION_.* //p' lib/base/version.h | paste -s -d .)
release=libicc-$version
work=$top/build/dist/check
mkdir -p "$work"

# fresh NAME: an empty folder, where the rest of a check works.
fresh() {
    rm -rf "${work:?}/$1"
    mkdir "$work/$1"
    cd "$work/$1"
}

# use COMMAND...: the first five minutes with the command, in the folder `fish`.
use() {
    "$@" demo fish >demo.txt
    "$@" check -s fish/before.txt -t fish/after.txt
    "$@" warp -s fish/before.txt -t fish/after.txt --background 78b9d7 fish/fish.png fish/bent.png
    echo 358 140 >fish/eye.txt
    "$@" map -s fish/before.txt -t fish/after.txt <fish/eye.txt >fish/there.txt
}

# The bits are the same on all machines: the first one that is checked tells what the others have to give.
same_result() {
    if [ -e "$work/bent.png" ]; then
        cmp fish/bent.png "$work/bent.png"
        cmp fish/there.txt "$work/there.txt"
    else
        cp fish/bent.png fish/there.txt "$work"
    fi
}

in_chroot() {
    if [ "$(id -u)" -eq 0 ]; then
        env -i /usr/sbin/chroot . /libicc "$@"
    else
        env -i /usr/bin/unshare --user --map-root-user /usr/sbin/chroot . /libicc "$@"
    fi
}

check_linux_x86_64() {
    fresh linux-x86_64
    tar -xzf "$dist/$release-linux-x86_64.tar.gz" --strip-components=1
    grep -q 'source package glibc, version [0-9]' licences/README.txt
    use in_chroot
    same_result
}

# An empty folder stands for the other machine's system.
check_linux_arm64() {
    need qemu-user
    fresh linux-arm64
    tar -xzf "$dist/$release-linux-arm64.tar.gz" --strip-components=1
    grep -q 'source package glibc, version [0-9]' licences/README.txt
    mkdir nothing
    use env -i /usr/bin/qemu-aarch64 -L nothing ./libicc
    same_result
}

check_windows() {
    need wine wine64 python3 binutils-mingw-w64-x86-64
    fresh windows
    export WINEPREFIX="$work/windows/wine" WINEDEBUG=-all
    wine wineboot --init
    /usr/bin/python3 -m zipfile -e "$dist/$release-windows-x86_64.zip" .
    mv "$release-windows-x86_64/libicc.exe" .
    # Debian's Wine has libraries that Windows lacks.
    for file in libicc.exe "$release-windows-x86_64/libicc.dll"; do
        x86_64-w64-mingw32-objdump -p "$file" | sed -n 's/.*DLL Name: //p' >needs.txt
        if grep -ivx -e 'kernel32\.dll' -e 'msvcrt\.dll' needs.txt; then
            return 1
        fi
    done
    use wine ./libicc.exe
    tr -d '\r' <fish/there.txt >fish/unix.txt
    mv fish/unix.txt fish/there.txt
    same_result
}

# A square becomes a larger one: its centre goes to the other's centre.
try_python() {
    cat >try.py <<'END'
import libicc
import numpy as np
square = np.array([[0, 0], [4, 0], [4, 4], [0, 4]], float)
m = libicc.Map(square, 2 * square)
assert m.certified
assert np.allclose(m(np.array([[2.0, 2.0]])), [[4, 4]]), m(np.array([[2.0, 2.0]]))
END
    env -i HOME="$PWD" PATH=/nowhere "$PWD/venv/bin/python" try.py
}

# Without a compiler in reach. NumPy is Debian's, so that no network is needed.
check_wheel() {
    need python3-venv python3-numpy
    fresh wheel
    /usr/bin/python3 -m venv venv
    ln -s /usr/lib/python3/dist-packages/numpy venv/lib/python3*/site-packages
    PATH=$PWD/venv/bin venv/bin/pip -q install --no-index --no-deps "$dist/$release"-py3-none-*_x86_64.whl
    try_python
}

check_sdist() {
    need python3-venv python3-numpy python3-setuptools python3-wheel cmake gcc libc6-dev make
    fresh sdist
    /usr/bin/python3 -m venv --system-site-packages venv
    venv/bin/pip -q install --no-build-isolation --no-index --no-deps "$dist/$release.tar.gz"
    try_python
}

# A program that depends on the crate, which compiles the C library that is in it.
check_crates() {
    need cargo rustc cmake gcc libc6-dev make
    fresh crates
    mkdir -p registry program/src
    for crate in "$dist"/*.crate; do
        tar -C registry -xzf "$crate"
        printf '{"files":{},"package":"%s"}' "$(sha256sum <"$crate" | cut -d' ' -f1)" \
            >"registry/$(basename "$crate" .crate)/.cargo-checksum.json"
    done
    cat >program/Cargo.toml <<END
[package]
name = "program"
version = "1.0.0"
edition = "2021"
[dependencies]
libicc = { version = "$version", features = ["vendored"] }
[workspace]
END
    cat >program/src/main.rs <<'END'
use libicc::{flat, rows, Domain, Env, Map, MapOptions};
fn main() -> libicc::Result<()> {
    let mut env = Env::new();
    let before = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
    let after = [[0.0, 0.0], [8.0, 0.0], [8.0, 8.0], [0.0, 8.0]];
    let source = Domain::polygon(flat(&before), &mut env)?;
    let target = Domain::polygon(flat(&after), &mut env)?;
    let map = Map::new(&source, &target, &MapOptions::default(), &mut env)?;
    let images = map.apply(flat(&[[2.0, 2.0]]), &mut env)?;
    let image = rows::<2>(&images.points)[0];
    assert!((image[0] - 4.0).abs() < 1e-9 && (image[1] - 4.0).abs() < 1e-9);
    println!("mapped");
    Ok(())
}
END
    RUSTC=/usr/bin/rustc CARGO_HOME=$PWD/home /usr/bin/cargo run --offline --quiet --manifest-path program/Cargo.toml \
        --config 'source.crates-io.replace-with="here"' --config "source.here.directory=\"$PWD/registry\"" >said.txt
    grep -qx mapped said.txt
}

check_npm() {
    fresh npm
    echo '{ "name": "program", "version": "1.0.0", "private": true }' >package.json
    npm install --silent --offline --no-audit --no-fund "$dist/$release.tgz"
    ls node_modules/libicc/licences/wasi-libc.txt node_modules/libicc/licences/libclang-rt-*.txt
    cat >try.mjs <<'END'
import { load } from "libicc";
const { Map } = await load();
const map = new Map([[0, 0], [4, 0], [4, 4], [0, 4]], [[0, 0], [8, 0], [8, 8], [0, 8]]);
const [x, y] = map.apply([[2, 2]]);
if (!map.certified || Math.hypot(x - 4, y - 4) > 1e-9) throw new Error(`${x} ${y}`);
END
    node --no-warnings try.mjs
    grep -q '</html>' "$dist/studio.html"
}

# The archive has the tree of the commit, without Debian's folder, and its owner alone may write. The checksums are right.
check_source() {
    fresh source
    tar -xJf "$dist/$release.tar.xz"
    git -C "$top" ls-tree -r --name-only HEAD | grep -v '^debian/' | sort >wanted
    (cd "$release" && find . ! -type d | sed 's|^\./||' | sort) | cmp - wanted
    tar -tvJf "$dist/$release.tar.xz" >list
    [ "$(grep -cv -e '^[d-]rwxr-xr-x ' -e '^-rw-r--r-- ' -e '^l' list)" -eq 0 ]
    [ ! -e "$dist/SHA256SUMS" ] || (cd "$dist" && sha256sum --quiet -c SHA256SUMS)
}

if [ $# -eq 0 ]; then
    [ ! -e "$dist/$release.tar.xz" ] || set -- source
    [ ! -e "$dist/$release-linux-x86_64.tar.gz" ] || set -- "$@" linux-x86_64
    [ ! -e "$dist/$release-linux-arm64.tar.gz" ] || set -- "$@" linux-arm64
    [ ! -e "$dist/$release-windows-x86_64.zip" ] || set -- "$@" windows
    [ ! -e "$dist/$release.tar.gz" ] || set -- "$@" wheel sdist
    [ ! -e "$dist/libicc-sys-$version.crate" ] || set -- "$@" crates
    [ ! -e "$dist/$release.tgz" ] || set -- "$@" npm
fi
rm -f "$work/bent.png" "$work/there.txt"
for part in "$@"; do
    case $part in
        source | linux-x86_64 | linux-arm64 | windows | wheel | sdist | crates | npm) ;;
        *) echo "dist_check.sh knows no part $part" >&2 && exit 2 ;;
    esac
    step check "$part" "check_$(echo "$part" | tr - _)"
done
