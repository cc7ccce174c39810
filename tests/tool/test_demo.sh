#!/bin/sh
# The commands that demo prints work as they stand, wherever the program is and however it is called.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

# try NAME: the commands of `said`, one after the other as somebody types them; then what they make is there.
try() {
    sed -n 's/^  //p' "$scratch/said" >"$scratch/commands"
    [ "$(grep -c . "$scratch/commands")" -ge 7 ] || complain "$1: few commands: $(cat "$scratch/said")"
    sh -eu "$scratch/commands" >"$scratch/printed" 2>&1 || complain "$1: $(cat "$scratch/printed")"
    grep -q '^one-to-one: yes, certified' "$scratch/printed" || complain "$1: $(cat "$scratch/printed")"
    for file in bent.png map.svg eye.txt film-0000.png film-0024.png; do
        [ -s "$2/$file" ] || complain "$1: no $file"
    done
    awk 'length > 80 && !/^  / { print; bad = 1 } END { exit bad }' "$scratch/said" || complain "$1: wide lines"
}

"$tool" demo >said
try "by its whole name" libicc-demo

mkdir "it's here" bin
ln -s "$tool" "it's here/lib icc"
ln -s "$tool" bin/libicc
"it's here/lib icc" demo 'a folder' >said
try "by a path that needs quotes" 'a folder'
(cd bin && ../bin/libicc demo ../other >../said && cd . && try "from elsewhere" ../other)

PATH=$PWD/bin:$PATH
export PATH
libicc demo found >said
holds said "  libicc check -s found/before.txt -t found/after.txt"
try "by PATH" found

run 1 demo found
says "found: cannot be made"
finish
