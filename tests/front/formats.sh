#!/bin/sh
# Makes files of many formats, and checks that the table of the page tells which of them are taken.
# usage: formats.sh PYTHON LIBICC FOLDER PAGE
set -eu
here=$(cd "$(dirname "$0")" && pwd)
rm -rf "$3"
"$1" -W ignore "$here/make_files.py" "$3" 2>/dev/null
"$1" -W ignore "$here/try_files.py" "$2" "$3" --page "$4"
rm -rf "$3"
