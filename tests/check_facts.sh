#!/bin/sh
# Rehearses a release in a copy of the tree: the next minor version, another address and other people. Afterwards no file
# may name the old ones, except for those that tell of them (below). Bad values in cmake/dist.conf are refused, and
# release.md names what is left to do.
# usage: check_facts.sh TOP FOLDER      the copy goes to FOLDER
set -eu
cd "$1"
copy=$2
rm -rf "$copy"
mkdir -p "$copy"
debian=
[ ! -e debian ] || debian=debian
# shellcheck disable=SC2086 # one word, or none
tar -c --exclude=build --exclude=target --exclude=__pycache__ --exclude=golden --exclude=fuzz -- *.md CMakeLists.txt \
    cmake docs examples bindings include lib tests tools $debian | tar -C "$copy" -x
cd "$copy"
version=$(sed -n 's/^#define ICCP_VERSION_.* //p' lib/base/version.h | paste -s -d .)
minor=$(echo "$version" | cut -d. -f2)
# shellcheck source=cmake/dist.conf
. ./cmake/dist.conf
next=${version%%.*}.$((minor + 1)).0
failed=0

fault() {
    echo "$*"
    failed=1
}

facts() {
    sh cmake/dist_facts.sh "$@" >said.txt 2>&1
}

# set_value NAME VALUE: a line of dist.conf.
set_value() {
    grep -v "^$1=" cmake/dist.conf >conf.txt
    printf "%s='%s'\n" "$1" "$2" >>conf.txt
    mv conf.txt cmake/dist.conf
}

# left WHAT OLD [FILE...]: complains about files that still have OLD as a word, but for the FILEs.
left() {
    what=$1
    grep -rIlwF -e "$2" --exclude=said.txt . | sed 's|^\./||' | sort >left.txt
    shift 2
    printf '%s\n' "$@" | grep -vxFf - left.txt >wrong.txt || true
    [ ! -s wrong.txt ] || fault "these files still have the old $what: $(paste -s -d ' ' wrong.txt)"
    rm left.txt wrong.txt
}

facts || fault "the tree does not agree with itself: $(cat said.txt)"

# Refused, and nothing is written.
refused() {
    cp cmake/dist.conf before.txt
    set_value "$1" "$2"
    if facts --write || ! grep -q "^cmake/dist.conf: $1 " said.txt; then
        fault "$1='$2' is not refused: $(cat said.txt)"
    fi
    mv before.txt cmake/dist.conf
}
for address in x.test/libicc git@x.test:me/libicc.git http://x.test/libicc https://x.test/libicc/ https://x.test \
    https://x.test/libicc.git 'https://x.test/a|b' 'https://x.test/a&b' 'https://x.test/a b' ''; do
    refused url "$address"
done
for person in Me me@x.test 'Me <me>' 'Me me@x.test' '<me@x.test>' 'M"e <me@x.test>' 'Me <me@x.test> and you'; do
    refused contact "$person"
    refused maintainer "$person"
done
facts || fault "a refused value was written: $(cat said.txt)"
for option in --wrte "--write --write" --help; do
    status=0
    # One or two options.
    # shellcheck disable=SC2086
    facts $option || status=$?
    [ $status -eq 2 ] || fault "dist_facts.sh $option ends with $status"
done

# The rehearsal.
set_value url https://host.test/me/libicc
set_value releases https://api.host.test/repos/me/releases
set_value contact 'A & B <both@host.test>'
set_value maintainer 'C | D \ E <third@host.test>'
if facts; then
    fault "differences are not found"
fi
refused maintainer 'C | D \ E <third@host.test>'
set_value maintainer 'C | D <third@host.test>'
sed -i "s/\(_MINOR\) .*/\1 $((minor + 1))/; s/\(_PATCH\) .*/\1 0/" lib/base/version.h
sed -i "0,/^## /s/^## /## $next (not yet released)\n\n&/" NEWS.md
if [ -e debian ]; then
    {
        printf 'libicc (%s-1) UNRELEASED; urgency=medium\n\n  * Next.\n\n' "$next"
        printf ' -- Nobody <nobody@nowhere.test>  Mon, 30 Nov 2026 00:00:00 +0000\n\n'
        cat debian/changelog
    } >changelog.txt
    mv changelog.txt debian/changelog
    touch debian/upstream/signing-key.asc
fi
facts --write || fault "--write fails: $(cat said.txt)"
facts || fault "--write leaves differences: $(cat said.txt)"
facts --write || fault "a second --write fails: $(cat said.txt)"
facts || fault "a second --write makes differences: $(cat said.txt)"

# Examples of a version, and what happened in the old one.
left version "$version" NEWS.md debian/changelog debian/libicc0.symbols include/icc/base.h include/icc/api.json \
    bindings/rust/libicc-sys/src/lib.rs bindings/rust/libicc/src/lib.rs
left version "libicc ${version%.*}"
left address "$url" debian/changelog tests/check_facts.sh
left address "$releases" debian/changelog
for person in "$contact" "$maintainer"; do
    user=${person##*<}
    left person "${user%>}" debian/changelog
done
for file in bindings/rust/Cargo.lock bindings/rust/libicc/Cargo.toml; do
    [ "$(grep -c "version = \"$next\"" $file)" -eq 2 ] || fault "$file does not have version $next twice"
done
if [ -e debian ]; then
    grep -qx 'Maintainer: C | D <third@host.test>' debian/control || fault "the maintainer is not there"
    [ "$(grep -c '^ -- C | D <third@host.test>  Mon, 30 Nov' debian/changelog)" -eq 1 ] ||
        fault "the first entry of debian/changelog, and only that, has to have the maintainer"
    grep -q 'pgpsigurlmangle=s/\$/\.asc/' debian/watch || fault "uscan does not check signatures"
    ! grep -q '^libicc source: debian-watch-does-not' debian/source/lintian-overrides ||
        fault "lintian is told that signatures are not checked"
fi
grep -q '^authors = \["A & B <both@host.test>"\]$' bindings/rust/libicc/Cargo.toml || fault "the author is not there"
grep -q 'name = "A & B", email = "both@host.test"' bindings/python/pyproject.toml || fault "the author is not there"

# The notes of a release say what has to be done before it, and say it no more when it is done.
stops() {
    sh cmake/dist_notes.sh "$copy/dist" 0123abc >notes.txt
    if [ "$(grep -c 'Stop' notes.txt)" -ne "$1" ]; then
        fault "the notes have to say Stop $1 times: $(grep Stop notes.txt)"
    fi
}
if [ -e debian ]; then
    mkdir dist
    : >"dist/libicc-$next-py3-none-manylinux_2_34_x86_64.whl"
    rm debian/upstream/signing-key.asc
    set_value url https://example.org/libicc
    set_value contact 'A <a@b.invalid>'
    sed -i '1,/^## /s/^\(## .* (\).*/\1not yet released)/' NEWS.md
    echo "libicc is not released yet." | tee -a README.md >>SECURITY.md
    stops 7
    ! grep -q '^\(twine\|npm\).*missing' notes.txt || fault "commands for missing files are not comments"
    grep -q "^twine upload libicc-$next-py3-none-manylinux_2_34_x86_64.whl\$" notes.txt || fault "the wheel is not uploaded"
    grep -q "^# npm publish" notes.txt || fault "there is no word about the npm package, which is missing"
    touch debian/upstream/signing-key.asc
    set_value url https://host.test/me/libicc
    set_value contact 'A & B <both@host.test>'
    sed -i '1,/^## /s/(not yet released)/(2027-01-01)/' NEWS.md
    sed -i '/not released yet/d' README.md SECURITY.md
    sed -i '1s/UNRELEASED/unstable/' debian/changelog
    stops 0
fi
[ $failed -ne 0 ] || rm -rf "$copy"
exit $failed
