#!/bin/sh
# Drives the studio, and the package over a worker, in Debian's chromium, without a network but for npm's puppeteer-core; screenshots in
# build/wasm/studio/shots.
# usage: examples/studio/test.sh [--long]    (after bindings/js/test.sh, which builds the page; installs chromium)
set -eu
cd "$(dirname "$0")/../.."
. cmake/deps.sh
need chromium
folder=$PWD/build/wasm/studio
for program in chromium node npm; do
    if ! command -v "$program" >/dev/null; then
        echo "the studio is not tested: $program is missing"
        exit 77
    fi
done
mkdir -p "$folder/shots"
cp examples/studio/test/*.js "$folder"
if [ ! -d "$folder/node_modules/puppeteer-core" ]; then
    echo '{ "private": true, "type": "module" }' >"$folder/package.json"
    quietly "$folder/npm.log" npm install --silent --no-audit --no-fund --prefix "$folder" puppeteer-core@24
fi
[ "${1:-}" != --long ] || export STUDIO_LONG=1
# A native build, if there is one, has to give the same poses, and the same maps from control points.
poses=
for program in "$PWD"/build/*/tests/poses; do
    [ ! -x "$program" ] || poses=$program
done
libicc=
for program in "$PWD"/build/*/tools/libicc; do
    [ ! -x "$program" ] || libicc=$program
done
STUDIO=$PWD/build/wasm/studio.html STUDIO_PACKAGE=$PWD/build/wasm/package \
    TUTORIAL=$PWD/docs/tutorials/browser.md CHROMIUM=$(command -v chromium) \
    SHOTS=$folder/shots LIVE=$PWD/docs/live.js POSES=$poses LIBICC=$libicc \
    node --test --test-reporter=spec "$folder"/*.test.js
