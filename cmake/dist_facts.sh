#!/bin/sh
# Compares what is written in several files with the one place of each: addresses and people with cmake/dist.conf, the
# version with lib/base/version.h. Prints the lines that differ.
# usage: sh cmake/dist_facts.sh [--write]     --write corrects them
set -eu
cd "$(dirname "$0")/.."
write=
case $#:${1:-} in
    0:) ;;
    1:--write) write=yes ;;
    *)
        echo "usage: sh cmake/dist_facts.sh [--write]" >&2
        exit 2
        ;;
esac
# shellcheck source=cmake/dist.conf
. cmake/dist.conf
version=$(sed -n 's/^#define ICCP_VERSION_.* //p' lib/base/version.h | paste -s -d .)
minor=${version%.*}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
status=0

fault() {
    echo "$*"
    status=1
}

# sound NAME VALUE PATTERN MEANING: a value of dist.conf is as PATTERN, a regular expression, says.
sound() {
    if printf '%s\n' "$2" | grep -qvx -e "$3"; then
        fault "cmake/dist.conf: $1 has to be $4, not '$2'"
    fi
}
address='https://[a-z0-9.-]*[a-z0-9]/[A-Za-z0-9._~%?=/-]*[A-Za-z0-9_~]'
person='[^]<>"\\[]*[^]<>"\\[ ] <[^]<>"\\@ []*@[^]<>"\\@ []*>'
sound url "$url" "$address" "https://HOST/PATH"
[ "$url" = "${url%.git}" ] || fault "cmake/dist.conf: url has to end without .git, not '$url'"
sound releases "$releases" "$address" "https://HOST/PATH"
sound contact "$contact" "$person" "'NAME <USER@HOST>'"
sound maintainer "$maintainer" "$person" "'NAME <USER@HOST>'"
[ $status -eq 0 ] || exit 1

# agree FILE BEFORE VALUE AFTER [LINES]: lines of the form BEFORE...AFTER, two regular expressions, have VALUE there.
# LINES is sed's address of the lines to look at. A tree without the file (Debian's folder is not in the archive of the
# sources) is all right.
agree() {
    [ -e "$1" ] || return 0
    value=$(printf '%s' "$3" | sed 's/[&|\\]/\\&/g')
    if [ -z "$(sed -n "${5:-}{\\|^$2.*$4\$|p;}" "$1")" ]; then
        fault "$1: no line is $2...$4"
        return 0
    fi
    sed "${5:-}s|^\($2\).*\($4\)\$|\1$value\2|" "$1" >"$work/new"
    if ! cmp -s "$1" "$work/new"; then
        if [ -n "$write" ]; then
            cat "$work/new" >"$1"
        else
            diff "$1" "$work/new" | sed "s|^|$1: |" || true
            status=1
        fi
    fi
}

agree debian/control 'Maintainer: ' "$maintainer" ''
agree debian/changelog ' -- ' "$maintainer" '  [A-Z].*' '1,/^ -- /'
agree debian/control 'Homepage: ' "$url" ''
agree debian/control 'Vcs-Browser: ' "$url" ''
agree debian/control 'Vcs-Git: ' "$url.git" ''
agree debian/copyright 'Upstream-Contact: ' "$contact" ''
agree debian/copyright 'Source: ' "$url" ''
agree debian/libicc-map-doc.doc-base 'Author: ' "${contact% <*}" ''
agree debian/upstream/metadata 'Bug-Database: ' "$url/issues" ''
agree debian/upstream/metadata 'Bug-Submit: ' "$url/issues/new" ''
agree debian/upstream/metadata 'Repository: ' "$url.git" ''
agree debian/upstream/metadata 'Repository-Browse: ' "$url" ''
agree SECURITY.md 'Contact: ' "$contact" ''
agree debian/watch '  ' "$releases" ' [\]'
agree bindings/python/pyproject.toml 'authors = ' \
    "[{ name = \"${contact% <*}\", email = \"$(echo "$contact" | sed 's/.*<\(.*\)>/\1/')\" }]" ''
agree bindings/python/pyproject.toml 'Homepage = ' "\"$url\"" ''
for crate in libicc libicc-sys; do
    agree bindings/rust/$crate/Cargo.toml 'authors = ' "[\"$contact\"]" ''
    agree bindings/rust/$crate/Cargo.toml 'repository = ' "\"$url\"" ''
    agree bindings/rust/$crate/Cargo.toml 'version = ' "\"$version\"" ''
    agree bindings/rust/Cargo.lock 'version = ' "\"$version\"" '' "/^name = \"$crate\"/,/^version/"
done
agree bindings/rust/libicc/Cargo.toml 'libicc-sys = .* version = ' "\"$version\"" ' }'
agree bindings/rust/libicc-sys/build.rs 'const VERSION: &str = ' "\"$version\"" ';'
agree bindings/js/package.json '  "author": ' "\"$contact\"" ,
agree bindings/js/package.json '  "homepage": ' "\"$url\"" ,
agree bindings/js/package.json '  "repository": ' "{ \"type\": \"git\", \"url\": \"git+$url.git\" }" ,
agree bindings/js/package.json '  "version": ' "\"$version\"" ,
agree docs/howto/link.md 'FetchContent_Declare(libicc GIT_REPOSITORY ' "$url.git" ' GIT_TAG .*'

agree bindings/python/pyproject.toml 'version = ' "\"$version\"" ''
agree tools/libicc.manifest '  <assemblyIdentity .* version="' "$version.0" '"/>'
agree examples/blender/libicc_cage/__init__.py '    "version": (' "$(echo "$version" | sed 's/[.]/, /g')" '),'
plugin=examples/qgis/libicc_processing/metadata.txt
agree $plugin 'version=' "$version" ''
agree $plugin 'author=' "${contact% <*}" ''
agree $plugin 'email=' "$(echo "$contact" | sed 's/.*<\(.*\)>/\1/')" ''
for field in homepage repository; do
    agree $plugin $field= "$url" ''
done
agree $plugin 'tracker=' "$url/issues" ''
for page in docs/man/*.[135]; do
    agree "$page" '\.TH [^"]* "[^"]*" "libicc ' "$version" '" "[A-Za-z ]*"'
done
for page in bindings/js/README.md docs/tutorials/browser.md; do
    agree $page ' *npm install \.\./build/wasm/libicc-' "$version" '\.tgz'
done
for file in examples/CMakeLists.txt tests/install/find_package/CMakeLists.txt tests/papers/CMakeLists.txt \
    docs/howto/link.md; do
    agree $file 'find_package(libicc ' "$minor" ' REQUIRED.*'
done

# uscan checks an archive's signature if there is a key. Without one, lintian is told so.
if [ -e debian/upstream/signing-key.asc ]; then
    # shellcheck disable=SC2016 # the end of an address
    signature='pgpsigurlmangle=s/$/.asc/' told='# '
else
    signature=pgpmode=none told=
fi
agree debian/watch 'opts="searchmode=plain, ' "$signature" '" [\]'
agree debian/source/lintian-overrides '' "$told" 'libicc source: debian-watch-does-not-check-openpgp-signature .*'

# Who makes the release writes these two.
if [ -e debian/changelog ] && ! head -n 1 debian/changelog | grep -q "($version-"; then
    fault "debian/changelog: the first entry is not of version $version"
fi
if ! sed -n '/^## /{p;q;}' NEWS.md | grep -q "^## $version ("; then
    fault "NEWS.md: the first section is not of version $version"
fi

# Pictures that have an author of their own are named one by one, here and there.
# shellcheck disable=SC2016 # the marks of a file's name
sed -n 's/^| `\([a-z]*\/.*\.png\)` .*/\1/p' LICENSES.md | sort >"$work/named"
[ -s "$work/named" ] || fault "LICENSES.md names no picture"
while read -r file; do
    [ -e "$file" ] || fault "LICENSES.md: there is no $file"
done <"$work/named"
if [ -e debian/copyright ]; then
    sed -n 's/^ \([a-z]*\/.*\.png\)$/\1/p' debian/copyright | sort >"$work/there"
    diff "$work/named" "$work/there" >"$work/differ" ||
        fault "LICENSES.md and debian/copyright name different pictures: $(grep '^[<>]' "$work/differ")"
fi
exit $status
