#!/bin/sh
# Builds the Debian packages in a fresh chroot, checks them with lintian, and tests them installed in
# another one that has only what they depend on. Needs root and a mirror of Debian bookworm; where chroots
# are not allowed it exits with 77. Prints the seconds that each step took.
# usage: debian.sh BUILD_FOLDER             logs and packages go to BUILD_FOLDER/debian
#        LIBICC_DEBIAN_BASE=BASE.tar        the chroots begin as this; it is made if it is not there
#        LIBICC_DEBIAN_ORIG=FILE.tar.xz     the archive of the sources; else one is made of the tree
#        DEB_BUILD_OPTIONS=nocheck          the build leaves out its tests, which need not be run twice
set -eu
cd "$(dirname "$0")/.."
. cmake/deps.sh

if [ "$(id -u)" -ne 0 ]; then
    echo "Debian packages are not tested: that needs root, to make chroots"
    exit 77
fi
if ! unshare --mount --pid --fork true 2>/dev/null; then
    echo "Debian packages are not tested: namespaces cannot be made here"
    exit 77
fi
need mmdebstrap autopkgtest
if ! command -v mmdebstrap autopkgtest >/dev/null; then
    echo "Debian packages are not tested: that needs mmdebstrap and autopkgtest"
    exit 77
fi

# In the chroots there is no compiler cache.
unset CMAKE_C_COMPILER_LAUNCHER CMAKE_CXX_COMPILER_LAUNCHER

mkdir -p "$1"
work=$(cd "$1" && pwd)/debian
build_root=$work/build-root
test_root=$work/test-root
version=$(sed -n '1s/.*(\(.*\)).*/\1/p' debian/changelog)
source=libicc-${version%-*}

# Mounts are made in namespaces of their own, so nothing is mounted here.
remove_roots() {
    rm -rf --one-file-system "$build_root" "$test_root"
}
trap remove_roots EXIT
trap 'exit 1' HUP INT TERM
remove_roots
rm -rf "$work"
mkdir -p "$work"

# within ROOT COMMAND...: with /proc and /dev of the chroot there, but not in it.
within() {
    # shellcheck disable=SC2016 # for the shell inside
    unshare --mount --pid --fork sh -eu -c '
        mount -t proc proc "$1/proc"
        mount --rbind /dev "$1/dev"
        shift
        exec "$@"' within "$@"
}

make_base() {
    base=${LIBICC_DEBIAN_BASE:-$work/base.tar}
    if ! [ -e "$base" ]; then
        uri=$(debian_mirror)
        mmdebstrap --mode=root --variant=apt --dpkgopt=force-unsafe-io \
            --aptopt='APT::Install-Recommends "false"' bookworm "$base" "$uri"
    fi
    for root in "$build_root" "$test_root"; do
        mkdir "$root"
        tar -C "$root" -xf "$base"
        cp /etc/resolv.conf "$root/etc"
    done
    chroot "$build_root" apt-get -q update
    cp -r "$build_root/var/lib/apt/lists" "$test_root/var/lib/apt"
    [ -n "${LIBICC_DEBIAN_BASE:-}" ] || rm "$base"
}

# The tree as it is, without what is built in it, and the upstream archive that Debian wants of it.
unpack_source() {
    tree=$build_root/build/$source
    orig=$build_root/build/libicc_${version%-*}.orig.tar.xz
    mkdir -p "$tree"
    if [ -n "${LIBICC_DEBIAN_ORIG:-}" ]; then
        cp "$LIBICC_DEBIAN_ORIG" "$orig"
        tar -C "$tree" --strip-components=1 -xf "$orig"
    else
        pack_tree
    fi
    cp -r debian "$tree"
    chown -R 1000:1000 "$build_root/build"
}

pack_tree() {
    tar -c --exclude-vcs --exclude=./debian --exclude=./build --exclude='./build-*' --exclude=./dist --exclude=./out \
        --exclude=./bindings/rust/target --exclude='.*_cache' --exclude=__pycache__ . | tar -C "$tree" -x
    tar -C "$build_root/build" -cJf "$orig" "$source"
}

in_build_root() {
    within "$build_root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 HOME=/build \
        "$@"
}

# First the dependencies of a build for one machine alone. They have to suffice to clean and to plan it.
install_build_dependencies() {
    unpack_source
    in_build_root chroot "$build_root" apt-get -qy build-dep --arch-only "/build/$source"
    in_build_root chroot --userspec=1000:1000 "$build_root" \
        sh -c "cd /build/$source && debian/rules clean && dh build-arch --no-act && dh binary-arch --no-act"
    in_build_root chroot "$build_root" apt-get -qy build-dep "/build/$source"
}

# As an ordinary user and without a network.
build() {
    in_build_root DEB_BUILD_OPTIONS="${DEB_BUILD_OPTIONS:-}" unshare --net chroot --userspec=1000:1000 "$build_root" \
        sh -c "cd /build/$source && dpkg-buildpackage -us -uc"
    find "$build_root/build" -maxdepth 1 -type f -exec cp {} "$work" \;
}

# Anything that lintian says is too much, with two exceptions. A misspelling in a binary counts only if the same word
# stands in the sources, since bytes of machine code happen to be letters. The archive is signed after the packages are
# made.
lint() {
    in_build_root chroot "$build_root" apt-get -qy install lintian >"$work/lintian-install.log"
    in_build_root chroot --userspec=1000:1000 "$build_root" sh -c 'cd /build &&
        lintian --pedantic --display-info --display-experimental --fail-on none *.changes' >"$work/said"
    while read -r level package tag word rest; do
        [ "$tag" != orig-tarball-missing-upstream-signature ] || continue
        if [ "$tag" = spelling-error-in-binary ] && ! grep -rqwF -e "$word" lib tools include; then
            continue
        fi
        echo "$level $package $tag $word $rest"
    done <"$work/said" >"$work/tags"
    cat "$work/tags"
    [ ! -s "$work/tags" ]
}

test_installed() {
    within "$test_root" autopkgtest "$work"/*.changes -- chroot "$test_root"
}

step debian chroots make_base
step debian dependencies install_build_dependencies
step debian build build
step debian lintian lint &
lintian=$!
step debian autopkgtest test_installed &
autopkgtest=$!
status=0
wait $lintian || status=1
wait $autopkgtest || status=1
[ "$status" -eq 0 ]
