"""What a call costs from Python beyond the same call in C.

usage: bench_calls.py C_EMPTY C_POINT    nanoseconds that bindings/calls.c prints

Prints the least of many means, since whatever else runs makes them longer, never shorter.
"""

import pathlib
import sys
import timeit

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import libicc
import numpy as np
from libicc._abi import lib

CALLS, MEANS = 2000, 50


def nanoseconds(call) -> float:
    return 1e9 * min(timeit.repeat(call, number=CALLS, repeat=MEANS)) / CALLS


def main() -> None:
    c_empty, c_point = map(float, sys.argv[1:])
    before = np.array([[0, 0], [4, 0], [4, 3], [0, 3]], float)
    mapping = libicc.Map(before, before + [[0, 0], [0, 1], [0, 1], [0, 0]])
    point = np.array([[1.0, 1.0]])
    empty = max(nanoseconds(lib.version_number) - c_empty, 0)
    more = max(nanoseconds(lambda: mapping(point)) - c_point, 0)
    print(f"python: {more / 1e3:.2f} us a call for one point, {empty / 1e3:.2f} us an empty call, beyond C")


main()
