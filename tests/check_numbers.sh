#!/bin/sh
# Counts the numbers that the sources of the library choose, by folder, and compares them with tests/numbers.txt. Such a number
# was tuned on some input, so a folder gains one only if the commit names that input. There are three kinds:
#   named     values of static constants, unnamed enumerations and macros
#   tabled    entries of constant arrays and structs, except -1, 0 and 1
#   unnamed   decimal numbers elsewhere in the code, except 0.5 and whole ones
# usage: check_numbers.sh TOP [list|update]
#   list      prints the numbers one by one, with their files
#   update    writes tests/numbers.txt anew
set -eu
cd "$1"
task=${2:-check}
table=tests/numbers.txt

# shellcheck disable=SC2016 # awk's variables
count='
# Removes comments and quoted text. in_comment tells whether the line ends within a comment.
function strip(text,   out, at, two, quote) {
    if (!in_comment && text !~ /\/[*\/]|["\047]/)
        return text
    out = ""
    for (at = 1; at <= length(text); ++at) {
        two = substr(text, at, 2)
        if (in_comment && two == "*/") { in_comment = 0; ++at }
        else if (in_comment) continue
        else if (two == "/*") { in_comment = 1; ++at }
        else if (two == "//") break
        else if (two ~ /^["\047]/) {
            quote = substr(text, at, 1)
            for (++at; at <= length(text) && substr(text, at, 1) != quote; ++at)
                if (substr(text, at, 1) == "\\") ++at
        } else out = out substr(text, at, 1)
    }
    return out
}

# Finds the numbers of a text. Digits of names do not count.
function numbers(text,   n, word) {
    n = 0
    while (match(text, /[A-Za-z_][A-Za-z_0-9]*|0[xX][0-9a-fA-F.]+([pP][+-]?[0-9]+)?|([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?/)) {
        word = substr(text, RSTART, RLENGTH)
        text = substr(text, RSTART + RLENGTH)
        if (word !~ /^[A-Za-z_]/) number[++n] = word
    }
    return n
}

function tell(kind, n, what) {
    gsub(/[ \t]+/, " ", what)
    sub(/^ /, "", what)
    total[kind, folder] += n
    if (n > 0 && task == "list") print FILENAME ": " kind " " n ": " what
}

function unnamed(text,   n, k, found) {
    if (text !~ /[0-9]/) return
    n = numbers(text)
    found = 0
    for (k = 1; k <= n; ++k)
        if (number[k] ~ /[.eE]/ && number[k] !~ /^0[xX]/ && number[k] !~ /^(0?[.]5|[0-9]+[.]0?)$/) ++found
    tell("unnamed", found, text)
}

function table(text,   n, k, found, entry) {
    n = split(text, entry, ",")
    found = 0
    for (k = 1; k <= n; ++k) {
        gsub(/[{} \t]|\[[^\]]*\]|[.][a-z_]+=/, "", entry[k])
        if (entry[k] !~ /^-?[01]?$/ && numbers(entry[k]) > 0) ++found
    }
    return found
}

# Counts one constant, NAME = VALUE.
function one(text,   value) {
    if (!index(text, "=")) return
    value = substr(text, index(text, "=") + 1)
    if (value ~ /^[ \t]*[{]/) tell("tabled", table(value), text)
    else tell("named", numbers(value) > 0, text)
}

# Counts the constants of a list that commas separate, those within brackets left out.
function list(text,   at, depth, c, from) {
    depth = 0
    from = 1
    for (at = 1; at <= length(text); ++at) {
        c = substr(text, at, 1)
        if (c ~ /[{(\[]/) ++depth
        if (c ~ /[})\]]/) --depth
        if (c == "," && depth == 0) { one(substr(text, from, at - from)); from = at + 1 }
    }
    one(substr(text, from))
}

function macro(text) {
    sub(/^[ \t]*#[ \t]*define[ \t]+/, "", text)
    if (text ~ /^[A-Za-z_0-9]+[ \t]/) {
        sub(/[ \t]/, "=", text)
        one(text)
    } else unnamed(text)
}

function is_closed(text) {
    return gsub(/[{]/, "", text) == gsub(/[}]/, "", text)
}

FNR == 1 {
    in_comment = 0
    pending = ""
    folder = FILENAME
    sub(/\/[^\/]*$/, "", folder)
    total["named", folder] += 0
}
{
    line = strip($0)
    if (pending == "" && line !~ /^[ \t]*(#|static const |const [a-z_0-9]+ iccp_|enum [{])/) { unnamed(line); next }
    pending = pending " " line
}
pending ~ /^[ \t]*#/ {
    if (pending ~ /\\$/) { sub(/\\$/, "", pending); next }
    if (pending ~ /^[ \t]*#[ \t]*define/) macro(pending)
    pending = ""
    next
}
pending ~ /^[ \t]*enum/ {
    if (pending !~ /[}]/) next
    sub(/[^{]*[{]/, "", pending)
    sub(/[}].*/, "", pending)
    list(pending)
    pending = ""
    next
}
# A function that returns a constant pointer is none.
pending ~ /^[^={;]*\)[ \t]*([{;]|$)/ { unnamed(pending); pending = ""; next }
pending ~ /;/ && is_closed(pending) { list(pending); pending = "" }

END {
    if (task != "list")
        for (key in total) {
            split(key, part, SUBSEP)
            if (part[1] == "named")
                print part[2], total[key], total["tabled", part[2]] + 0, total["unnamed", part[2]] + 0
        }
}
'
now=$(find lib -name '*.[ch]' | LC_ALL=C sort | xargs awk -v task="$task" "$count")
# A rule that finds nothing to look at holds for the wrong reason.
[ -n "$now" ] || { echo "no sources found in lib"; exit 1; }

case $task in
    list) echo "$now" ;;
    update)
        {
            echo "# Folder; named, tabled and unnamed numbers. check_numbers.sh says what they are, and when a line may rise."
            echo "$now" | LC_ALL=C sort
        } >"$table"
        ;;
    *)
        # shellcheck disable=SC2016 # awk's variables
        echo "$now" | LC_ALL=C sort | awk -v table="$table" '
            FILENAME == table { if ($0 !~ /^#/) listed[$1] = $0; next }
            {
                rises = falls = 0
                split(listed[$1] == "" ? $1 " 0 0 0" : listed[$1], most)
                for (k = 2; k <= 4; ++k) { rises += $k > most[k]; falls += $k < most[k] }
                delete listed[$1]
                failed += rises + falls
            }
            rises > 0 {
                printf "%s has %d named, %d tabled and %d unnamed numbers; %s allows %d, %d and %d.\n", $1, $2, $3, $4, table,
                    most[2], most[3], most[4]
                print "Remove one. Otherwise raise the line, in a commit whose message names the input that needs the number."
            }
            falls > 0 && rises == 0 {
                printf "%s has fewer numbers than %s says. Run sh tests/check_numbers.sh . update\n", $1, table
            }
            END {
                for (folder in listed) { printf "%s names %s, which is not there\n", table, folder; failed = 1 }
                exit failed > 0
            }' "$table" -
        ;;
esac
