#!/bin/sh
# The manual pages are well-formed. Each command has a page, whose options are those of its --help-all. Examples use
# options that their commands have. An option that several pages describe is described in the same words.
# usage: man.sh LIBICC MAN_FOLDER
set -eu
libicc=$1 folder=$2
wrong=0
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

complain() {
    echo "$*"
    wrong=1
}

# The text of a page without its escapes.
plain() {
    sed 's/\\-/-/g; s/\\f[BIR]//g; s/\\&//g' "$1"
}

# A line for each option of a command: its names and value, a tab, what --help-all says of it.
helped() {
    "$libicc" "$1" --help-all | awk '
        /^(Options|Further options).*:$/ { on = 1; next }
        !on { next }
        function flush() { if (name != "") print name "\t" text; name = text = "" }
        { match($0, /^ */); depth = RLENGTH; line = substr($0, depth + 1) }
        depth > 20 { text = text (text == "" ? "" : " ") line; next }
        line ~ /^-/ {
            flush()
            at = match(line, /  +/)
            name = at ? substr(line, 1, at - 1) : line
            text = at ? substr(line, at + RLENGTH) : ""
        }
        END { flush() }'
}

# The same of its page.
described() {
    plain "$folder/libicc-$1.1" | awk '
        function flush() { if (name != "") print name "\t" text; name = text = "" }
        /^\.SH / { flush(); on = $0 == ".SH OPTIONS"; next }
        !on { next }
        /^\.SS / { flush(); next }
        /^\.RS/ { depth++ }
        /^\.RE/ { depth-- }
        /^\.TP/ && !depth { flush(); head = 1; next }
        head { name = $0; head = 0; next }
        { text = text (text == "" ? "" : " ") $0 }
        END { flush() }'
}

commands=$("$libicc" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[ -n "$commands" ] || complain "--help lists no commands"
for command in $commands; do
    page=$folder/libicc-$command.1
    [ -f "$page" ] || { complain "there is no page libicc-$command.1" && continue; }
    plain "$folder/libicc.1" | grep -q "^\.BR libicc-$command (1)" || complain "libicc.1 does not list $command"
    awk '/^\.SH / { n++ } /^\.SH EXAMPLES/ { at = n } END { exit !at || at > 3 }' "$page" ||
        complain "libicc-$command.1 has no examples near its top"
    helped "$command" >"$work/helped"
    described "$command" >"$work/described"
    cut -f1 "$work/helped" >"$work/expected"
    cut -f1 "$work/described" >"$work/found"
    grep -q . "$work/expected" || complain "$command has no options"
    diff "$work/expected" "$work/found" || complain "libicc-$command.1 and 'libicc $command --help-all' differ"
    grep -oE -- '--[a-z]+(-[a-z]+)*' "$work/expected" >"$work/options.$command"
    paste "$work/helped" "$work/described" >>"$work/all"
done
cat "$work"/options.* >"$work/options"
printf '%s\n' --help --help-all --version >>"$work/options"

# The short text of an option tells which of them are the same one: then the long text is the same.
cut -f1,2,4 "$work/all" | sort -u | cut -f1,2 | uniq -d | while read -r option; do
    complain "pages describe this in different words: $option"
    echo >"$work/differ"
done
[ ! -f "$work/differ" ] || wrong=1

# No page speaks of an option that nobody has, and no example gives a command what it does not take.
for page in "$folder"/libicc*.[15]; do
    for option in $(plain "$page" | grep -oE -- '--[a-z]+(-[a-z]+)*' | sort -u); do
        grep -qx -- "$option" "$work/options" || complain "$page speaks of $option, which no command has"
    done
    for command in $commands; do
        for option in $(plain "$page" | grep -E "^libicc $command " | grep -oE -- '--[a-z]+(-[a-z]+)*' | sort -u); do
            grep -qx -- "$option" "$work/options.$command" || complain "$page: $command has no $option"
        done
    done
done

# Words that a page runs together: prose behind .BR and its like, which drop the blanks between their words. A word of
# more than 25 letters is one unless it has a character that only names and synopses have.
run_together() {
    groff -man -Tutf8 -rLL=120n "$1" | sed 's/\x1b\[[0-9;]*m//g; s/.\x08//g' | tr -s '[:space:]' '\n' |
        grep -E '.{26}' | grep -vE '[][|<>"#{}()/_=-]' | grep -vE '^[a-z]+,[a-z]+:[a-z]+,[a-z]+$' || :
}

for file in "$folder"/*.[135]; do
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
