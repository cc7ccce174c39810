#!/bin/sh
# Compares what is written in several files with the one place of each: the project's address and its maintainer with
# cmake/dist.conf, the version with lib/base/version.h. Prints the lines that differ.
# usage: sh cmake/dist_facts.sh [--write]     --write corrects them
set -eu
cd "$(dirname "$0")/.."
# shellcheck source=cmake/dist.conf
. cmake/dist.conf
version=$(sed -n 's/^#define ICCP_VERSION_.* //p' lib/base/version.h | paste -s -d .)
write=${1:-}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0

# agree FILE START VALUE END: a line that begins with START, a regular expression, goes on with VALUE and END. A tree
# without the file (Debian's folder is not in the archive of the sources) is all right.
agree() {
    [ -e "$1" ] || return 0
    if ! grep -q -e "^$2" "$1"; then
        echo "$1: no line begins with $2"
        status=1
        return 0
    fi
    sed "s|^\($2\).*|\1$3$4|" "$1" >"$work/new"
    if ! cmp -s "$1" "$work/new"; then
        if [ "$write" = --write ]; then
            cat "$work/new" >"$1"
        else
            diff "$1" "$work/new" | sed "s|^|$1: |" || true
            status=1
        fi
    fi
}

agree debian/control 'Maintainer: ' "$maintainer" ''
agree debian/control 'Homepage: ' "$url" ''
agree debian/control 'Vcs-Browser: ' "$url" ''
agree debian/control 'Vcs-Git: ' "$url.git" ''
agree debian/copyright 'Source: ' "$url" ''
agree debian/upstream/metadata 'Bug-Database: ' "$url/issues" ''
agree debian/upstream/metadata 'Bug-Submit: ' "$url/issues/new" ''
agree debian/upstream/metadata 'Repository: ' "$url.git" ''
agree debian/upstream/metadata 'Repository-Browse: ' "$url" ''
agree debian/watch ' *https*:' "${url#*:}" '.git refs/tags/v@ANY_VERSION@'
agree bindings/python/pyproject.toml 'Homepage = ' "\"$url\"" ''
agree bindings/rust/libicc/Cargo.toml 'repository = ' "\"$url\"" ''
agree bindings/rust/libicc-sys/Cargo.toml 'repository = ' "\"$url\"" ''
agree bindings/js/package.json '  "homepage": ' "\"$url\"" ,
agree bindings/js/package.json '  "repository": ' "{ \"type\": \"git\", \"url\": \"git+$url.git\" }" ,

agree bindings/python/pyproject.toml 'version = ' "\"$version\"" ''
agree bindings/rust/libicc/Cargo.toml 'version = ' "\"$version\"" ''
agree bindings/rust/libicc-sys/Cargo.toml 'version = ' "\"$version\"" ''
agree bindings/rust/libicc-sys/build.rs 'const VERSION: &str = ' "\"$version\"" ';'
agree bindings/js/package.json '  "version": ' "\"$version\"" ,

if [ -e debian/changelog ] && ! head -n 1 debian/changelog | grep -q "($version-"; then
    echo "debian/changelog: the first entry is not of version $version"
    status=1
fi

# Pictures that have an author of their own are named one by one.
if [ -e debian/copyright ]; then
    sed -n 's/^ \([a-z]*\/.*\.png\)$/\1/p' debian/copyright | while read -r file; do
        [ -e "$file" ] || echo "debian/copyright: there is no $file"
    done >"$work/missing"
    cat "$work/missing"
    [ ! -s "$work/missing" ] || status=1
fi
exit $status
