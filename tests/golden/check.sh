#!/bin/sh
# Runs the program of golden hashes and compares what it prints with the file of expected lines. An expected hash of `?`
# is not compared.
# usage: check.sh EXPECTED COMMAND...
set -eu
expected=$1
shift
printed=$("$@")
echo "$printed" | awk '
    NR == FNR { expected[$1] = $2 " " $3; left[$1] = 1; next }
    { delete left[$1] }
    !($1 in expected) { print $1 ": a new case"; bad = 1; next }
    expected[$1] !~ /^\?/ && expected[$1] != $2 " " $3 { print $1 ": " $2 " " $3 " instead of " expected[$1]; bad = 1 }
    END {
        for (name in left) { print name ": is missing"; bad = 1 }
        exit bad
    }' "$expected" -
