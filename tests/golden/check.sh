#!/bin/sh
# Runs the program of golden hashes, and compares what it prints with the lines that are expected, whatever these end in.
# usage: check.sh EXPECTED COMMAND...
set -eu
expected=$1
shift
printed=$("$@")
echo "$printed" | tr -d '\r' | diff "$expected" -
