#!/bin/sh
# Each exported function that returns a status, or numbers, begins with ICCP_ENTER (lib/base/fpenv.h): so it computes the
# same bits in every floating-point environment of its caller.
# usage: check_entries.sh ROOT
set -eu
cd "$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat include/icc/*.h | sed -n 's/^ICC_API \(icc_status \|const double \*\)\(icc_[a-z0-9_]*\)(.*/\2/p' | sort >"$work/declared"
# The function whose body begins: its head stands before the brace, in one line or several.
awk '/^[a-z].*[^a-z0-9_]icc_[a-z0-9_]*\(/ { head = $0 }
    /^\{/ { begins = 1; next }
    begins && /^    ICCP_ENTER;$/ { sub(/\(.*/, "", head); sub(/.*[^a-z0-9_]/, "", head); print head }
    { begins = 0 }' lib/api/*.c | sort >"$work/entered"
[ -s "$work/declared" ] || { echo "no functions found in include/icc" && exit 1; }
comm -23 "$work/declared" "$work/entered" >"$work/without"
if [ -s "$work/without" ]; then
    echo "these do not begin with ICCP_ENTER:"
    cat "$work/without"
    exit 1
fi
