#!/bin/sh
# The library on other machines: built by Debian's cross compilers, run by qemu's user mode emulation. On each,
# - unit tests pass,
# - the program of golden hashes prints the lines of tests/golden,
# - what it saves is loaded here, and what is saved here is loaded there, with the same hashes.
# What is linked to comes from Debian's packages for that machine, unpacked into a folder: nothing foreign is installed.
# Windows is one of them: built by mingw-w64, run by Wine, with tests/plain in place of Check, and a test of Rust's crate.
# usage: sh tests/ports.sh [--long] [arm64|armhf|i386|riscv64|s390x|windows ...]
# Without --long: the unit tests labelled `ports`, with 1 % of the cases of long sweeps instead of 4 %. Without
# machines: all. Logs are in build/ports/MACHINE.
set -eu
cd "$(dirname "$0")/.."
. cmake/deps.sh
tests=ports
export ICC_TEST_SHARE=1
if [ "${1:-}" = --long ]; then
    tests=all ICC_TEST_SHARE=4
    shift
fi
[ $# -gt 0 ] || set -- arm64 armhf i386 riscv64 s390x windows
golden=tests/golden
here=build/release/tests/golden
saved=$PWD/build/ports/saved
jobs=$(nproc)
need gcc libc6-dev make cmake pkg-config libpng-dev libjpeg-dev zlib1g-dev check libgmp-dev \
    qemu-user mmdebstrap

# Names of a machine: its compiler's, qemu's; and the release of Debian that has packages for it.
describe() {
    release=bookworm
    case $1 in
        arm64) triplet=aarch64-linux-gnu cpu=aarch64 ;;
        armhf) triplet=arm-linux-gnueabihf cpu=arm ;;
        i386) triplet=i686-linux-gnu cpu=i386 ;;
        riscv64) triplet=riscv64-linux-gnu cpu=riscv64 release=trixie ;;
        s390x) triplet=s390x-linux-gnu cpu=s390x ;;
        *) echo "ports.sh knows no machine $1" >&2 && exit 2 ;;
    esac
}

make_root() {
    foreign_root "$1" "$release" libc6-dev,check,libgmp-dev
}

build() {
    multiarch=$("$triplet-gcc" -print-multiarch)
    export PKG_CONFIG_SYSROOT_DIR="$root" PKG_CONFIG_LIBDIR="$root/usr/lib/$multiarch/pkgconfig"
    # What may be uninitialised GCC guesses, and differently for each machine.
    cmake -S . -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DICC_WERROR=ON -DCMAKE_C_FLAGS=-Wno-maybe-uninitialized \
        -DICC_BUILD_TOOLS=OFF -DICC_BUILD_TESTS=ON \
        -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR="$cpu" -DCMAKE_C_COMPILER="$triplet-gcc" \
        -DCMAKE_SYSROOT="$root" -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY \
        -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY -DCMAKE_CROSSCOMPILING_EMULATOR="qemu-$cpu;-L;$root"
    targets="golden tests_ports"
    [ $tests = ports ] || targets=all
    # The targets are a list of words.
    # shellcheck disable=SC2086
    cmake --build "$work/build" --parallel "$jobs" --target $targets
}

unit_tests() {
    wanted="--label-regex ^ports\$"
    [ $tests = ports ] || wanted="--tests-regex ^(unit|api)/"
    # An option and its value.
    # shellcheck disable=SC2086
    ctest --test-dir "$work/build" $wanted --no-tests=error --output-on-failure --parallel "$jobs"
}

# Nothing to unpack: mingw-w64 has the headers, and Wine the libraries. Wine makes its folder here, since two programs
# that both find none stand in each other's way.
make_root_windows() {
    need gcc-mingw-w64-x86-64-posix wine wine64 cargo rustc libstd-rust-dev-windows
    wine wineboot --init
    sh cmake/mingw_libraries.sh "$work/libraries"
}

build_windows() {
    cmake --preset mingw -B "$work/build" -DICC_WERROR=ON -DICC_BUILD_TOOLS=ON \
        "-DCMAKE_FIND_ROOT_PATH=/usr/x86_64-w64-mingw32;$work/libraries"
    targets="icc icc_static libicc_tool golden tests_ports"
    [ $tests = ports ] || targets=all
    # The targets are a list of words.
    # shellcheck disable=SC2086
    cmake --build "$work/build" --parallel "$jobs" --target $targets
    # Windows alone: no library of the compiler's, or of Debian's, has to lie beside them.
    for file in tools/libicc.exe lib/libicc.dll; do
        x86_64-w64-mingw32-objdump -p "$work/build/$file" >"$work/libicc.txt"
        [ "$(sed -n 's/.*DLL Name: //p' "$work/libicc.txt" | grep -civ -e '^kernel32\.dll$' -e '^msvcrt\.dll$')" = 0 ]
    done
    ! grep -q iccp_ "$work/libicc.txt"
}

unit_tests_windows() {
    wanted="--label-regex ^ports\$"
    [ $tests = ports ] || wanted="--tests-regex ."
    # An option and its value.
    # shellcheck disable=SC2086
    ctest --test-dir "$work/build" $wanted --no-tests=error --output-on-failure --parallel "$jobs"
    # The command: once; and with --long by its own tests but for those that make links, terminals, pipes of one file and
    # programs that are scripts, which Wine does not hand on. They run hundreds of programs, of which Wine's server fails
    # one now and then on a loaded machine.
    printf '#!/bin/sh\nexec wine "%s" "$@"\n' "$work/build/tools/libicc.exe" >"$work/libicc"
    chmod +x "$work/libicc"
    rm -rf "$work/demo"
    "$work/libicc" demo "$work/demo"
    "$work/libicc" check -s "$work/demo/before.txt" -t "$work/demo/after.txt"
    commands="animate arrays chosen features formats meshes pictures surfaces warp"
    [ $tests = all ] || commands=
    for name in $commands; do
        echo "tool/test_$name"
        sh "tests/tool/test_$name.sh" "$work/libicc" "$work/scratch"
    done
    # Rust's crate, by Debian's Rust, which has what programs for Windows are made with.
    LIBICC_DIR=$work/build LIBICC_STATIC=1 CARGO_TARGET_DIR=$work/rust RUSTC=/usr/bin/rustc \
        CARGO_TARGET_X86_64_PC_WINDOWS_GNU_LINKER=x86_64-w64-mingw32-gcc-posix \
        CARGO_TARGET_X86_64_PC_WINDOWS_GNU_RUNNER=wine /usr/bin/cargo test --offline --quiet \
        --manifest-path bindings/rust/Cargo.toml --target x86_64-pc-windows-gnu --test map
}

# Hashes of both kinds there; then objects of either side on the other one.
there() {
    mkdir -p "$saved/$1"
    # A command and its arguments.
    # shellcheck disable=SC2086
    {
        sh $golden/check.sh $golden/objects.txt $emulated objects "$saved/$1"
        sh $golden/check.sh $golden/results.txt $emulated results
        sh $golden/check.sh $golden/objects.txt $emulated load "$saved/here"
        sh $golden/check.sh $golden/objects.txt $here load "$saved/$1"
    }
}

native() {
    [ -e build/release/CMakeCache.txt ] || cmake --preset release
    cmake --build build/release --parallel "$jobs" --target golden
    mkdir -p "$saved/here"
    sh $golden/check.sh $golden/objects.txt $here objects "$saved/here"
}

work=$PWD/build/ports
mkdir -p "$work"
step "this machine" golden native
for machine in "$@"; do
    work=$PWD/build/ports/$machine
    root=$work/root
    mkdir -p "$work"
    if [ "$machine" = windows ]; then
        kind=_windows
        emulated="wine $work/build/tests/plain/golden.exe"
        export WINEPREFIX="$root" WINEDEBUG=-all
    else
        kind=
        describe "$machine"
        emulated="qemu-$cpu -L $root $work/build/tests/golden"
        need "gcc-$triplet"
    fi
    step "$machine" packages "make_root$kind" "$machine"
    step "$machine" build "build$kind"
    step "$machine" tests "unit_tests$kind"
    step "$machine" golden there "$machine"
done
