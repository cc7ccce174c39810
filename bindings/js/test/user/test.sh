#!/bin/sh
# The package as a new user gets it: installed from the archive, the README's example run, the types taken by
# `tsc --strict`. Needs npm's registry.
# usage: bindings/js/test/user/test.sh ARCHIVE FOLDER
set -eu
cd "$(dirname "$0")/../../../.."
archive=$1
folder=$2
here=bindings/js/test/user
. cmake/deps.sh
rm -rf "$folder/node_modules/libicc" "$folder/package-lock.json"
mkdir -p "$folder"
echo '{ "private": true, "type": "module" }' >"$folder/package.json"
quietly "$folder/npm.log" npm install --silent --no-audit --no-fund --prefix "$folder" "$archive" typescript@5
sed -n '/^    import/,/^$/s/^    //p' bindings/js/README.md >"$folder/example.js"
printed=$(cd "$folder" && node example.js)
case $printed in
    true*Float64Array*) ;;
    *)
        echo "the README's example printed: $printed" >&2
        exit 1
        ;;
esac
if grep -n '](\.\./' "$folder/node_modules/libicc/README.md"; then
    echo "the package's README links to files that are not in the package" >&2
    exit 1
fi
cp "$here/strict.ts" "$folder"
"$folder/node_modules/.bin/tsc" --strict --noEmit --noUncheckedIndexedAccess --exactOptionalPropertyTypes \
    --target es2022 --module nodenext --lib es2022,dom,dom.iterable "$folder/strict.ts"
