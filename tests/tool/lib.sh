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

# A cube as cube.obj (its vertices alone: corners.txt), and what becomes of it: moved.obj, moved.txt.
make_cubes() {
    printf '0 0 0\n0 0 1\n0 1 0\n0 1 1\n1 0 0\n1 0 1\n1 1 0\n1 1 1\n' >corners.txt
    printf '0 0 0\n0 0.25 1\n0 1 0\n0 1.25 1\n1 0 0\n1 0.25 1.25\n1 1 0\n1.5 1.25 1\n' >moved.txt
    printf 'f 1 2 3\nf 3 2 4\nf 5 7 6\nf 7 8 6\nf 1 5 2\nf 5 6 2\n' >faces
    printf 'f 3 4 7\nf 7 4 8\nf 1 3 5\nf 5 3 7\nf 2 6 4\nf 6 8 4\n' >>faces
    sed 's/^/v /' corners.txt | cat - faces >cube.obj
    sed 's/^/v /' moved.txt | cat - faces >moved.obj
}

# bytes NUMBER...: each as one byte.
bytes() {
    for byte in "$@"; do
        # shellcheck disable=SC2059 # the format is the byte
        printf "\\$(printf %03o "$byte")"
    done
}

# binary little|big: cube.obj as a binary PLY file; its coordinates are 0 and 1.
binary() {
    printf 'ply\nformat binary_%s_endian 1.0\nelement vertex 8\nproperty double x\nproperty double y\n' "$1"
    printf 'property double z\nelement face 12\nproperty list uchar ushort vertex_index\nend_header\n'
    one='0 0 0 0 0 0 240 63'
    [ "$1" = big ] && one='63 240 0 0 0 0 0 0'
    tr ' ' '\n' <corners.txt | while read -r x; do
        # shellcheck disable=SC2086 # bytes
        if [ "$x" = 1 ]; then bytes $one; else bytes 0 0 0 0 0 0 0 0; fi
    done
    sed 's/^f //' faces | while read -r a b c; do
        bytes 3
        for corner in $((a - 1)) $((b - 1)) $((c - 1)); do
            if [ "$1" = big ]; then bytes 0 "$corner"; else bytes "$corner" 0; fi
        done
    done
}
