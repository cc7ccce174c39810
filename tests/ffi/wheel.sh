#!/bin/sh
# Makes an sdist of the Python package, from that a wheel that contains the library, and installs it into a fresh
# environment; then the same without the library. All offline.
# usage: wheel.sh PYTHON LIBRARY WORK      an interpreter with setuptools, wheel, pip and NumPy; libicc.so.0; a folder
set -eu
python=$1
library=$2
work=$3
top=$(cd "$(dirname "$0")/../.." && pwd)
package=$top/bindings/python
unset LIBICC_LIBRARY PYTHONPATH
export PIP_CONFIG_FILE=/dev/null PIP_NO_INDEX=1 PIP_NO_CACHE_DIR=1 PIP_DISABLE_PIP_VERSION_CHECK=1
export PIP_ROOT_USER_ACTION=ignore PYTHONDONTWRITEBYTECODE=1

fail() {
    echo "wheel: $*" >&2
    exit 1
}

# Building leaves things beside the sources.
rm -rf "$work"
source=$work/source/bindings/python
mkdir -p "$source/libicc/front" "$work/dist" "$work/elsewhere"
ln -s "$top/CMakeLists.txt" "$top/LICENSE" "$top/cmake" "$top/include" "$top/lib" "$top/tools" "$top/examples" "$work/source"
cp -rL "$package"/*.* "$package/LICENSE" "$package/tests" "$source"
cp "$package"/libicc/*.py "$package/libicc/py.typed" "$source/libicc"
cp "$package"/libicc/front/*.py "$source/libicc/front"
version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$package/pyproject.toml")
(cd "$source" && "$python" -c 'import setuptools.build_meta as build; build.build_sdist("../../../dist")') >"$work/log"

# wheel FOLDER FILE...: makes a wheel, which holds the package, what Python finds in it, and the files, and nothing else.
wheel() {
    folder=$work/$1
    shift
    "$python" -m pip wheel --no-deps --no-build-isolation -w "$folder" "$work/dist/libicc-$version.tar.gz" \
        >>"$work/log" 2>&1 || fail "there is no wheel: $(tail -n 20 "$work/log")"
    wheel=$(echo "$folder"/*.whl)
    {
        (cd "$package" && ls libicc/*.py libicc/front/*.py libicc/py.typed)
        printf '%s\n' "$@" libicc/viewer/gl.js libicc/viewer/gl3.js libicc/viewer/page.css libicc/viewer/page.html \
            libicc/viewer/page.js libicc/viewer/solid.js
        for name in LICENSE METADATA RECORD WHEEL top_level.txt; do
            echo "libicc-$version.dist-info/$name"
        done
    } | grep . | sort >"$work/expected"
    "$python" -c 'import sys, zipfile; print(*zipfile.ZipFile(sys.argv[1]).namelist(), sep="\n")' "$wheel" |
        sort >"$work/found"
    diff "$work/expected" "$work/found" || fail "$wheel has other files than these"
}

# install VENV: puts the wheel into an environment of its own.
install() {
    venv=$work/$1
    "$python" -m venv --without-pip --system-site-packages "$venv"
    "$python" -m pip --python "$venv/bin/python" install --no-deps "$wheel" >>"$work/log"
}

# check LIBRARY|"" imports what was installed, with LIBICC_LIBRARY set or not, and maps a point.
check() {
    (cd "$work/elsewhere" && env ${1:+"LIBICC_LIBRARY=$1"} "$venv/bin/python" -) <<EOF
import importlib.metadata
import libicc
assert libicc.__file__.startswith("$venv"), libicc.__file__
assert libicc.__version__ == importlib.metadata.version("libicc") == "$version", libicc.__version__
square = [[0, 0], [1, 0], [1, 1], [0, 1]]
image = libicc.Map(square, [[0, 0], [2, 0], [2, 2], [0, 2]])([[0.5, 0.25]])
assert abs(image - [1, 0.5]).max() < 1e-12, image
assert "</script>" in libicc.Map(square, square).to_html()
EOF
}

# With the library, for the machine it was compiled on and newer ones.
wheel whole libicc/libicc.so.0
case $wheel in
    */libicc-"$version"-py3-none-manylinux_2_[0-9]*_"$(uname -m)".whl) ;;
    *) fail "the name $wheel does not say what the wheel is for" ;;
esac
install with
check "" || fail "the library in the wheel is not found"
whole=$(basename "$wheel")

# Without: the library is named, or named and not there, or beside the package.
export LIBICC_LIBRARY=system
wheel pure ''
unset LIBICC_LIBRARY
case $wheel in
    */libicc-"$version"-py3-none-any.whl) ;;
    *) fail "the name $wheel does not say that the wheel is for all" ;;
esac
install without
check "$library" || fail "the library is not found by LIBICC_LIBRARY"
if check "$work/nowhere.so" 2>"$work/error"; then fail "it runs without a library"; fi
grep -q "ImportError.*$work/nowhere.so.*LIBICC_LIBRARY" "$work/error" || fail "no good reason: $(cat "$work/error")"
cp "$library" "$(echo "$venv"/lib/python3*/site-packages/libicc)/libicc.so.0"
check "" || fail "the library is not found beside the package"

# A library that has been compiled already.
export LIBICC_LIBRARY="$library"
wheel given libicc/libicc.so.0
echo "$whole, $(basename "$wheel"): built, installed and run"
