#!/bin/sh
# Prints release.md: what to upload where, with the names of the files that are in dist/, and what is missing there.
# usage: sh cmake/dist_notes.sh DIST COMMIT     from the tree of that commit
set -eu
cd "$(dirname "$0")/.."
# shellcheck source=cmake/dist.conf
. cmake/dist.conf
dist=$1
commit=$2
version=$(sed -n 's/^#define ICCP_VERSION_.* //p' lib/base/version.h | paste -s -d .)
name=libicc-$version

# upload COMMAND PATTERN PART: the command with the names of the files, or a comment on the part that makes them.
upload() {
    files=$(find "$dist" -maxdepth 1 -name "$2" -printf '%f\n' | sort | paste -s -d ' ')
    if [ -n "$files" ]; then
        echo "$1 $files"
    else
        echo "# $1 $2      (missing; made by dist_$3)"
    fi
}

# row FILE PART TEXT: a row of the table of the release page's files.
row() {
    if [ -e "$dist/$1" ]; then
        echo "| \`$1\` | $3 |"
    else
        echo "| \`$1\` **is missing** | $3; \`cmake --build --preset dist --target dist_$2\` makes it |"
    fi
}

stopped=
stop() {
    stopped=yes
    echo "- **Stop.** $*"
}

echo "# Release $version"
echo
case $url$releases in
    *//example.org*) stop "\`cmake/dist.conf\` does not say yet where the project lives." ;;
esac
case $contact$maintainer in
    *.invalid*) stop "\`cmake/dist.conf\` does not say yet who answers." ;;
esac
[ -e debian/upstream/signing-key.asc ] || stop "\`debian/upstream/signing-key.asc\` is missing, the key for signatures."
if sed -n '/^## /{p;q;}' NEWS.md | grep -q 'not yet released'; then
    stop "\`NEWS.md\` says \"not yet released\" instead of the date."
fi
for page in README.md SECURITY.md; do
    ! grep -q 'not released yet' $page || stop "\`$page\` says that libicc is not released yet."
done
if head -n 1 debian/changelog | grep -q UNRELEASED; then
    stop "The first entry of \`debian/changelog\` is UNRELEASED."
fi
[ -z "$stopped" ] || cat <<'END'

Do what `docs/packaging.md` lists under "Before each release". Commit, and make `dist/` again, since all files change.

END
cat <<END
Made from commit $commit.

## 1. Sign

In \`dist/\`:

\`\`\`sh
git tag -s v$version -m "libicc $version" $commit
gpg --armor --detach-sign $name.tar.xz      # writes $name.tar.xz.asc
gpg --armor --detach-sign SHA256SUMS        # writes SHA256SUMS.asc
git push origin v$version
\`\`\`

## 2. The release page of v$version at $url

Upload these files, with \`news.md\` as text.

| file | what it is for |
|---|---|
END
row "$name-linux-x86_64.tar.gz" linux-x86_64 "the command for Linux on x86-64; unpack and run \`libicc demo\`"
row "$name-linux-arm64.tar.gz" linux-arm64 "the command for Linux on arm64"
row "$name-windows-x86_64.zip" windows "the command and the library for Windows"
row "$name-qgis.zip" python "the plugin for QGIS on Windows and on Linux on x86-64; *Install from ZIP*"
row "$name-blender.zip" python "the add-on for Blender on the same systems; *Install* under *Add-ons*"
row studio.html npm "the studio; open it in a browser"
row "$name.tar.xz" source "the sources"
cat <<END
| \`$name.tar.xz.asc\` | their signature, from step 1 |
| \`SHA256SUMS\` | checksums of all files here |
| \`SHA256SUMS.asc\` | their signature, from step 1 |

Put \`studio.html\` on the project's web pages as well. Leave out \`$name.tar.gz\`, which holds Python's package and would
pass for the sources.

## 3. Registries

Each line needs an account there. The order matters for the crates: the second needs the first. In \`dist/\`, with the
tag checked out:

\`\`\`sh
$(upload "twine upload" "*_x86_64.whl" "linux-x86_64 and dist_python")
$(upload "twine upload" "*_aarch64.whl" "linux-arm64 and dist_python")
$(upload "twine upload" "$name.tar.gz" python)
cargo publish -p libicc-sys --manifest-path ../bindings/rust/Cargo.toml
cargo publish -p libicc --manifest-path ../bindings/rust/Cargo.toml
$(upload "npm publish" "$name.tgz" npm)
\`\`\`

Cargo uploads only crates that it packs itself. They hold two files that the \`.crate\` files here lack:
\`.cargo_vcs_info.json\`, which names the commit, and with newer versions of Cargo \`Cargo.lock\`.

## 4. Debian

\`debian/\` holds the source package and the packages for this machine. Give the source package to a sponsor, or put the
\`.deb\` files on the release page.

## 5. Afterwards

Open the next version as \`docs/packaging.md\` says under "A later version, a fix".
END
