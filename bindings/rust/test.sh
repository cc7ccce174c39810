#!/bin/sh
# Tests the Rust crates with a library that is installed: layout, tests, doc tests, example; linked dynamically
# found by pkg-config, statically found by pkg-config, and both from a folder; and with the C library compiled from
# the sources in the crate.
# usage: test.sh PREFIX          where `cmake --install` has put libicc
#        CARGO, RUSTC and RUSTDOC choose the tools, CARGO_TARGET_DIR where things are built.
set -eu
prefix=$(cd "$1" && pwd)
cd "$(dirname "$0")"

PATH=$PATH:$HOME/.cargo/bin
CARGO=${CARGO:-cargo}
CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$PWD/target}
export PATH CARGO_TARGET_DIR
unset LIBICC_DIR LIBICC_STATIC LIBICC_PRIVATE_LIBS

file=$(find "$prefix" -name libicc.pc | head -n 1)
[ -n "$file" ] || { echo "there is no libicc.pc in $prefix" >&2; exit 1; }
PKG_CONFIG_PATH=$(dirname "$file")
libdir=$(dirname "$PKG_CONFIG_PATH")
export PKG_CONFIG_PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

tell() { echo "== $*"; }

# Does the example need the shared library?
needs_shared() { readelf -d "$CARGO_TARGET_DIR/release/examples/warp_picture" | grep -q 'NEEDED.*libicc\.so'; }

# A black picture in the cages of the example; the rest becomes white.
data=../../examples/data
{ printf 'P6\n324 270\n255\n' && head -c 262440 /dev/zero; } >"$work/in.ppm"
warp() {
    "$CARGO" run --offline --quiet --release --example warp_picture -- \
        "$data/chelsea.src.txt" "$data/chelsea.tgt.txt" "$work/in.ppm" "$work/$1.ppm"
    tail -c +16 "$work/$1.ppm" | od -A n -t u1 -v -w1 | sort | uniq -c >"$work/$1.bytes"
    awk '{ n += $1; seen[$2 + 0] = $1 }
         END { exit !(n == 262440 && NR == 2 && seen[0] > seen[255] && seen[255] > 0) }' "$work/$1.bytes"
}

tell "layout and comments"
sh check_layout.sh "$prefix"
python3 comments.py "$prefix/include" --check

if [ -e "$libdir/libicc.so" ]; then
    tell "dynamic"
    (
        export LD_LIBRARY_PATH="$libdir${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
        "$CARGO" test --offline --quiet
        warp shared
    )
    needs_shared
    LIBICC_DIR=$libdir "$CARGO" build --offline --quiet --release --example warp_picture
fi

if [ -e "$libdir/libicc.a" ]; then
    tell "static"
    "$CARGO" test --offline --quiet --features libicc/static
    LIBICC_STATIC=1 warp static
    if needs_shared; then
        echo "the static program needs libicc.so" >&2
        exit 1
    fi
    LIBICC_DIR=$prefix LIBICC_STATIC=1 "$CARGO" build --offline --quiet --release --example warp_picture
fi

# As somebody gets them who has nothing else: the crates as they are packed, and the C sources in one of them.
tell "vendored"
crates=$work/crates
(
    cd libicc-sys
    "$CARGO" package --offline --quiet --allow-dirty --no-verify --target-dir "$work/packed" 2>"$work/package.log" ||
        { cat "$work/package.log" >&2; exit 1; }
)
mkdir "$crates"
tar -C "$crates" -xzf "$work"/packed/package/libicc-sys-*.crate
mv "$crates"/libicc-sys-* "$crates/libicc-sys"
cp -rL libicc "$crates"
(
    unset PKG_CONFIG_PATH
    cd "$crates/libicc"
    "$CARGO" test --offline --quiet --features vendored --test map
)

# Comments are compiled, too.
tell "documentation"
RUSTDOCFLAGS="-D warnings" "$CARGO" doc --offline --quiet --no-deps
echo "the Rust crates pass"
