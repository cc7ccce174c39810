#!/bin/sh
# Prints release.md: what to upload where, with the names of the files that are in dist/, and what is missing there.
# usage: sh cmake/dist_notes.sh VERSION
set -eu
cd "$(dirname "$0")/.."
# shellcheck source=cmake/dist.conf
. cmake/dist.conf
version=$1
name=libicc-$version
cd dist

# found PATTERN PART: the names of the files, or the part that has to be made.
found() {
    files=$(find . -maxdepth 1 -name "$1" | sed 's|^\./||' | sort | paste -s -d ' ')
    echo "${files:-(missing: dist_$2)}"
}

# row FILE PART TEXT: a row of the table of the release page's files.
row() {
    if [ -e "$1" ]; then
        echo "| \`$1\` | $3 |"
    else
        echo "| \`$1\` **is missing** | $3; \`cmake --build --preset dist --target dist_$2\` makes it |"
    fi
}

echo "# Release $version"
echo
case $url in
    *example.org*)
        echo "**Stop.** \`cmake/dist.conf\` does not say yet where the project lives. Fill it in, run"
        echo "\`sh cmake/dist_facts.sh --write\`, commit, and make \`dist/\` again."
        echo
        ;;
esac
cat <<END
Made from commit $(git rev-parse HEAD).

## 1. Sign

\`\`\`sh
git tag -s v$version -m "libicc $version" $(git rev-parse --short HEAD)
gpg --armor --detach-sign $name.tar.xz      # writes $name.tar.xz.asc
gpg --armor --detach-sign SHA256SUMS        # writes SHA256SUMS.asc
git push origin v$version
\`\`\`

## 2. The release page of v$version at $url

Upload these files, and the first section of \`NEWS.md\` as text.

| file | what it is for |
|---|---|
END
row "$name-linux-x86_64.tar.gz" linux-x86_64 "the command for Linux on x86-64; unpack and run \`libicc demo\`"
row "$name-linux-arm64.tar.gz" linux-arm64 "the command for Linux on arm64"
row "$name-windows-x86_64.zip" windows "the command and the library for Windows"
row studio.html npm "the studio; open it in a browser"
row "$name.tar.xz" source "the sources"
cat <<END
| \`$name.tar.xz.asc\` | their signature, from step 1 |
| \`SHA256SUMS\` | checksums of all files here |
| \`SHA256SUMS.asc\` | their signature, from step 1 |

Put \`studio.html\` on the project's web pages as well.

## 3. Registries

Each line needs an account there. The order matters for the crates: the second needs the first.

\`\`\`sh
twine upload $(found '*.whl' python) $(found "$name.tar.gz" python)
# from the tag, as Cargo uploads no files that it has not packed itself; compare with the .crate files here
cargo publish -p libicc-sys --manifest-path bindings/rust/Cargo.toml
cargo publish -p libicc --manifest-path bindings/rust/Cargo.toml
npm publish $(found "$name.tgz" npm)
\`\`\`

## 4. Debian

\`debian/\` holds the source package and the packages for this machine. Give the source package to a sponsor, or put the
\`.deb\` files on the release page. \`dch --release\` closes the entry in \`debian/changelog\` before that.

## 5. Afterwards

Raise the version in \`lib/base/version.h\`, run \`sh cmake/dist_facts.sh --write\`, and open new entries in \`NEWS.md\`
and \`debian/changelog\`.
END
