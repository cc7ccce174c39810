#!/bin/sh
# Tests the Rust crates with a library that is installed: layout, tests, doc tests, example; linked dynamically
# found by pkg-config, statically found by pkg-config, and both from a folder.
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

tell() { echo "== $*"; }

# Does the program need the shared library?
needs_shared() { readelf -d "$1" | grep -q 'NEEDED.*libicc\.so'; }

tell "layout"
sh check_layout.sh "$prefix"

if [ -e "$libdir/libicc.so" ]; then
    tell "dynamic"
    LD_LIBRARY_PATH=$libdir${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} "$CARGO" test --offline --quiet
    LD_LIBRARY_PATH=$libdir${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH} \
        "$CARGO" run --offline --quiet --release --example warp
    needs_shared "$CARGO_TARGET_DIR/release/examples/warp"
    LIBICC_DIR=$libdir "$CARGO" build --offline --quiet --release --example warp
fi

if [ -e "$libdir/libicc.a" ]; then
    tell "static"
    "$CARGO" test --offline --quiet --features libicc/static
    LIBICC_STATIC=1 "$CARGO" run --offline --quiet --release --example warp
    if needs_shared "$CARGO_TARGET_DIR/release/examples/warp"; then
        echo "the static program needs libicc.so" >&2
        exit 1
    fi
    LIBICC_DIR=$prefix LIBICC_STATIC=1 "$CARGO" build --offline --quiet --release --example warp
fi

# Comments are compiled, too.
tell "documentation"
RUSTDOCFLAGS="-D warnings" "$CARGO" doc --offline --quiet --no-deps
echo "the Rust crates pass"
