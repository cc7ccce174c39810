#!/bin/sh
# Runs a test program in one of the modes of tests/modes/modes.h, with a twentieth of its cases unless all are asked for.
# usage: run.sh MODE COMMAND...
set -eu
export ICC_TEST_MODE="$1"
shift
[ "${ICC_TEST_SHARE:-100}" -ge 100 ] || export ICC_TEST_SHARE=5
"$@"
