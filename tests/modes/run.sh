#!/bin/sh
# Runs a test program in one of the modes of tests/modes/modes.h, with a quarter of the cases that it has otherwise.
# usage: run.sh MODE COMMAND...
set -eu
export ICC_TEST_MODE="$1"
shift
share=${ICC_TEST_SHARE:-100}
[ "$share" -ge 100 ] || export ICC_TEST_SHARE=$(((share + 3) / 4))
"$@"
