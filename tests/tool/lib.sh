# shellcheck shell=sh
# What the tests of the command share. Sourced: `. lib.sh` with TOOL and SCRATCH from the arguments.
# Each test is called as: sh test_NAME.sh TOOL SCRATCH

tool=$1
scratch=$2

# shellcheck disable=SC2034 # for those that source this
here=$(cd "$(dirname "$0")" && pwd)

rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch" || exit 1

complain() {
    echo "FAILED: $*" >&2
    : >"$scratch/failed" # a file, since pipelines run in subshells
}

# run EXPECTED_EXIT ARGUMENT...: stdin is the caller's, stdout and stderr go to `out` and `err`.
run() {
    expected=$1
    shift
    "$tool" "$@" >out 2>err
    got=$?
    if [ "$got" -ne "$expected" ]; then
        complain "exit $got instead of $expected: libicc $*"
        sed 's/^/    /' err >&2
    fi
}

# One line on stderr that begins `libicc: ` and holds $1; nothing on stdout.
says() {
    [ "$(wc -l <err)" -eq 1 ] || complain "stderr is not one line: $(cat err)"
    grep -q '^libicc: ' err || complain "stderr does not begin 'libicc: ': $(cat err)"
    grep -qF -- "$1" err || complain "'$1' is not in: $(cat err)"
    [ ! -s out ] || complain "there is output beside the error: $(head -n 1 out)"
}

same() {
    cmp -s "$1" "$2" || complain "$1 and $2 differ${3:+ ($3)}"
}

holds() {
    grep -qF -- "$2" "$1" || complain "'$2' is not in $1"
}

# close_to A B TOLERANCE: two files of numbers, with the same number of words.
close_to() {
    paste -d ' ' "$1" "$2" | awk -v tolerance="$3" '
        { n = NF / 2; if (n != int(n)) bad = 1
          for (i = 1; i <= n; i++) { d = $i - $(i + n); if (d < 0) d = -d; if (!(d <= tolerance)) bad = 1 } }
        END { exit bad || NR == 0 }' || complain "$1 and $2 are farther apart than $3"
}

finish() {
    [ ! -e "$scratch/failed" ] || exit 1
    cd / && rm -rf "$scratch"
    exit 0
}

# An L, and what becomes of it: six vertices each, counter-clockwise.
make_cages() {
    printf '0 0\n10 0\n10 5\n5 5\n5 10\n0 10\n' >source.txt
    printf '0 0\n12 1\n12 6\n6.5 7\n5 12\n-1 10\n' >target.txt
    printf '1 1\n2.5 3.25\n7 2\n2 8\n4.5 4.5\n' >points.txt
}
