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

# Reads the sources found in a tree. Reads the list in TREE/CMakeLists.txt, and the files that it lists, by itself.
# shellcheck disable=SC2016 # awk's variables
order='
function complain(text) {
    print text
    failed = 1
}

# Complains about each include in a listed file that names no file above it.
function check_includes(file,   path, line, answer) {
    path = tree "/" file
    while ((answer = (getline line < path)) > 0) {
        if (line !~ /^[ \t]*#[ \t]*include[ \t]*"/) continue
        split(line, part, "\"")
        if (part[2] !~ /^icc\// && !(part[2] in listed))
            complain(path " includes \"" part[2] "\", which is not listed above it")
    }
    close(path)
    if (answer < 0) complain(tree "/CMakeLists.txt lists " file ", which does not exist")
    else listed[file]
}

BEGIN {
    table = tree "/CMakeLists.txt"
    while ((getline line < table) > 0) {
        if (line == "set(" variable) in_list = 1
        if (!in_list) continue
        n = split(line, word, /[ \t)]+/)
        for (k = 1; k <= n; ++k)
            if (word[k] ~ /[.][ch]$/) {
                check_includes(word[k])
                ++n_listed
            }
        if (line ~ /\)/) in_list = 0
    }
    # A rule that finds nothing to look at holds for the wrong reason.
    if (n_listed == 0) complain("no sources found in " tree)
}
!($0 in listed) { complain(tree "/CMakeLists.txt lacks " $0) }
END { exit failed }
'

check_tree() {
    (cd "$1" && find . -name '*.[ch]' | sed 's|^\./||') | awk -v tree="$1" -v variable="$2" "$order" || failed=1
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
