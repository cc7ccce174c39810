#!/bin/sh
# A source file may include only files listed above it in the CMakeLists.txt of its tree (lib, tools), and every
# file is listed. That makes cycles between modules impossible. No two files of the command, or of the command
# and the library, share a base name, so that a name in a message or a debugger means one file.
# usage: check_order.sh ROOT
set -eu
cd "$1"
failed=0

complain() {
    echo "$*"
    failed=1
}

# The sources that TREE/CMakeLists.txt lists in the variable VARIABLE, in their order.
listed() {
    sed -n "/^set($2\$/,/)/p" "$1/CMakeLists.txt" | tr -d ')' | tr -s ' ' '\n' | grep '\.[ch]$'
}

included() {
    sed -n 's|^[[:space:]]*#[[:space:]]*include[[:space:]]*"\([^"]*\)".*|\1|p' "$1"
}

check_tree() {
    tree=$1
    list=$(listed "$tree" "$2") || true
    # A rule that finds nothing to look at holds for the wrong reason.
    [ -n "$list" ] || complain "no sources found in $tree"
    for file in $(cd "$tree" && find . -name '*.[ch]' | sed 's|^\./||'); do
        echo "$list" | grep -qx "$file" || complain "$tree/CMakeLists.txt lacks $file"
    done
    above=
    for file in $list; do
        [ -f "$tree/$file" ] || { complain "$tree/CMakeLists.txt lists $file, which does not exist"; continue; }
        for name in $(included "$tree/$file"); do
            case $name in
                icc/*) continue ;;
            esac
            case " $above " in
                *" $name "*) ;;
                *) complain "$tree/$file includes \"$name\", which is not listed above it" ;;
            esac
        done
        above="$above $file"
    done
}

# The base names below a folder, each as often as different folders have it.
base_names() {
    find "$1" -name '*.[ch]' | sed 's|\.[ch]$||' | sort -u | sed 's|.*/||'
}

check_tree lib ICC_SOURCES
check_tree tools ICC_TOOL_SOURCES
# A name says what a file is without its folder; and headers guard themselves by it.
for name in $( (base_names tools && base_names lib) | sort | uniq -d); do
    complain "two files are called $name: $(find lib tools -name "$name.[ch]" | tr '\n' ' ')"
done
for guard in $(grep -rh '^#ifndef [A-Z_0-9]*_H$' lib tools --include='*.h' | sort | uniq -d | sed 's/.* //'); do
    complain "two headers are guarded by $guard: $(grep -rl "^#ifndef $guard\$" lib tools | tr '\n' ' ')"
done
exit $failed
