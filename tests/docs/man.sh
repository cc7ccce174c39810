#!/bin/sh
# The manual pages are well-formed, and libicc.1 tells of every command and every option that --help lists, and of no
# other.
# usage: man.sh LIBICC MAN_FOLDER
set -eu
libicc=$1 folder=$2
wrong=0

complain() {
    echo "$*"
    wrong=1
}

commands=$("$libicc" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ -n "$commands" ] || complain "--help lists no commands"
page=$(sed 's/\\-/-/g; s/\\fB//g; s/\\fR//g' "$folder/libicc.1")
told=
for command in $commands; do
    echo "$page" | grep -qx "\.B $command" || complain "libicc.1 does not describe the command $command"
    told="$told $("$libicc" "$command" --help | grep -oE '^ +(-[a-z], )?--[a-z-]+' | grep -oE -- '--?[a-z-]+')"
done
for option in $told; do
    echo "$page" | grep -qE -- "(^|[^a-z-])$option([^a-z-]|\$)" || complain "libicc.1 does not tell of $option"
done
for option in $(echo "$page" | grep -oE -- '--[a-z]+(-[a-z]+)*' | sort -u); do
    case " $(echo "$told" | tr '\n' ' ') --version " in
        *" $option "*) ;;
        *) complain "libicc.1 tells of $option, which --help does not" ;;
    esac
done

# Words that a page runs together: prose behind .BR and its like, which drop the blanks between their words. A word of
# more than 25 letters is one unless it has a character that only names and synopses have.
run_together() {
    groff -man -Tutf8 -rLL=120n "$1" | sed 's/\x1b\[[0-9;]*m//g; s/.\x08//g' | tr -s '[:space:]' '\n' |
        grep -E '.{26}' | grep -vE '[][|<>"#{}()/_=-]' | grep -vE '^[a-z]+,[a-z]+:[a-z]+,[a-z]+$' || :
}

for file in "$folder"/*.[13]; do
    if command -v groff >/dev/null; then
        words=$(run_together "$file")
        [ -z "$words" ] || complain "$file runs words together: $words"
        ! grep -nE '^\.(BR|RB|IR|RI|BI|IB) .* [.,;:)]+ [A-Za-z]' "$file" || complain "$file: prose on a line of its macro"
    else
        echo "$file: left out: groff is missing"
    fi
    if command -v mandoc >/dev/null; then
        mandoc -T lint -W warning "$file" || complain "mandoc: $file"
    else
        echo "$file: left out: mandoc is missing"
    fi
    if command -v man >/dev/null; then
        said=$(LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -l "$file" 2>&1 >/dev/null) || said="man fails: $said"
        [ -z "$said" ] || complain "man: $file: $said"
    else
        echo "$file: left out: man is missing"
    fi
done
exit $wrong
