#!/bin/sh
# The progress bar: one for the whole command, on one line, and its share never falls.
# shellcheck source-path=SCRIPTDIR source=lib.sh
. "$(dirname "$0")/lib.sh"

if ! script -q -e -c true /dev/null </dev/null >/dev/null 2>&1; then
    echo "skipped: no script(1) to make a terminal" >&2
    exit 77
fi

awk 'BEGIN { n = 20000; for (i = 0; i < n; i++) { t = 6.283185307179586 * i / n
    r = 1 + .2 * cos(3 * t) + .05 * cos(17 * t); print r * cos(t), r * sin(t) } }' >wavy.txt
awk 'BEGIN { n = 20000; for (i = 0; i < n; i++) { t = 6.283185307179586 * i / n
    r = 1 + .2 * cos(2 * t + 1) + .05 * cos(13 * t); print r * cos(t), r * sin(t) } }' >other.txt

for columns in 80 40 16 8; do
    script -q -e -c "stty cols $columns; '$tool' check -s wavy.txt -t other.txt -j 1 2>&1 >out" seen \
        </dev/null >/dev/null 2>&1 || complain "exit $? on $columns columns"
    # Pictures of the bar, without the codes that move the cursor.
    tr '\r' '\n' <seen | sed 's/\x1b\[[0-9;]*[A-Za-z]//g' | grep '[0-9] %' >pictures
    [ "$(wc -l <pictures)" -ge 2 ] || complain "$columns columns: no progress is shown"
    awk -v most=$columns 'length($0) >= most { wide = 1 } END { exit wide }' pictures ||
        complain "$columns columns: too wide: $(head -1 pictures)"
    sed 's/ *%.*//; s/.*[^0-9]//' pictures | sort -n -c 2>/dev/null ||
        complain "$columns columns: the share falls"
done

finish
