#!/bin/sh
# What depends on the kind of a map stands in the folder of the kind, behind the table in
# lib/map/kind/kind.h. So no file of lib/map itself or lib/api asks which kind a map is: none reads a
# map's state as that of a kind, or compares the table of a map with that of a kind.
# usage: check_seam.sh ROOT
set -eu
cd "$1"
files=$(ls lib/map/*.[ch] lib/api/*.[ch])
[ -n "$files" ] || { echo "no sources found in lib/map and lib/api"; exit 1; }
# shellcheck disable=SC2086
if grep -nE -e '->solid\b|\bis_(solid|plane)\b|\biccp_plane_of\b|kind [!=]= *&?iccp_|(map|next|fresh|better|info)(->|\.)kind [!=]=' $files; then
    echo "these lines ask for the kind of a map; an operation of lib/map/kind/kind.h should answer"
    exit 1
fi
