#!/bin/sh
# Makes an sdist of the Python package, from that a wheel, and installs it into a fresh environment; all offline.
# usage: wheel.sh PYTHON LIBRARY WORK      an interpreter with setuptools, wheel, pip and NumPy; libicc.so.0; a folder
set -eu
python=$1
library=$2
work=$3
package=$(cd "$(dirname "$0")/../../bindings/python" && pwd)
unset LIBICC_LIBRARY PYTHONPATH
export PIP_CONFIG_FILE=/dev/null PIP_NO_INDEX=1 PIP_NO_CACHE_DIR=1 PIP_DISABLE_PIP_VERSION_CHECK=1
export PIP_ROOT_USER_ACTION=ignore PYTHONDONTWRITEBYTECODE=1

fail() {
    echo "wheel: $*" >&2
    exit 1
}

# Building leaves things beside the sources.
rm -rf "$work"
mkdir -p "$work/source/libicc" "$work/dist" "$work/elsewhere"
cp -rL "$package"/*.* "$package/LICENSE" "$package/tests" "$work/source"
cp "$package"/libicc/*.* "$work/source/libicc"
version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$package/pyproject.toml")

(cd "$work/source" && "$python" -c 'import setuptools.build_meta as build; build.build_sdist("../dist")') >"$work/log"
"$python" -m pip wheel --no-deps --no-build-isolation -w "$work/dist" "$work/dist/libicc-$version.tar.gz" >>"$work/log"
wheel=$work/dist/libicc-$version-py3-none-any.whl
[ -f "$wheel" ] || fail "there is no $wheel"

# The wheel holds the package, whatever Python finds in it, and nothing else.
{
    (cd "$package" && ls libicc/*.py libicc/py.typed)
    for name in LICENSE METADATA RECORD WHEEL top_level.txt; do
        echo "libicc-$version.dist-info/$name"
    done
} | sort >"$work/expected"
"$python" -c 'import sys, zipfile; print(*zipfile.ZipFile(sys.argv[1]).namelist(), sep="\n")' "$wheel" |
    sort >"$work/found"
diff "$work/expected" "$work/found" || fail "the wheel has other files than these"

"$python" -m venv --without-pip --system-site-packages "$work/venv"
"$python" -m pip --python "$work/venv/bin/python" install --no-deps "$wheel" >>"$work/log"

# check LIBRARY|"" imports what was installed, with LIBICC_LIBRARY set or not, and maps a point.
check() {
    (cd "$work/elsewhere" && env ${1:+"LIBICC_LIBRARY=$1"} "$work/venv/bin/python" -) <<EOF
import importlib.metadata
import libicc
assert libicc.__file__.startswith("$work/venv"), libicc.__file__
assert libicc.__version__ == importlib.metadata.version("libicc") == "$version", libicc.__version__
square = [[0, 0], [1, 0], [1, 1], [0, 1]]
image = libicc.Map(square, [[0, 0], [2, 0], [2, 2], [0, 2]])([[0.5, 0.25]])
assert abs(image - [1, 0.5]).max() < 1e-12, image
EOF
}

# Named; named, but not there; beside the package.
check "$library" || fail "the library is not found by LIBICC_LIBRARY"
if check "$work/nowhere.so" 2>"$work/error"; then fail "it runs without a library"; fi
grep -q "ImportError.*$work/nowhere.so.*LIBICC_LIBRARY" "$work/error" || fail "no good reason: $(cat "$work/error")"
cp "$library" "$(echo "$work"/venv/lib/python3*/site-packages/libicc)/libicc.so.0"
check "" || fail "the library is not found beside the package"
echo "$(basename "$wheel"): builds, installs and runs"
