"""Which public functions can be reached from C++, Python, Rust and JavaScript.

usage: reach.py TOP [--table]    every one has to be, or to be left out below with a reason, and no reason may be stale
"""

import json
import re
import sys
from pathlib import Path

SOURCES = {
    "C++": ["include/icc/icc.hpp"],
    "Python": ["bindings/python/libicc/*.py"],
    "Rust": ["bindings/rust/libicc/src/*.rs"],
    "JavaScript": ["bindings/js/src/*.js"],
}
# Declarations and words about functions are no uses.
NOT_USES = ("_abi.py", "names.js")
COMMENT = re.compile(r'/\*.*?\*/|//[^\n]*|""".*?"""', re.S)

OTHER_HEADER = "of icc/kernel.h and icc/stages.h, which icc.hpp leaves to icc::call() and icc::handle"
SHAPES = "maps take shapes themselves"
FLAGS = {name: name + "_flags() without flags" for name in ("icc_chart_decode", "icc_chart_encode")}
LEFT_OUT = {
    "C++": {"icc_map_create_polygons": "icc::map of two icc::domain::polygon",
            **{name: "called as in C, since it makes no object" for name in ("icc_version", "icc_version_number")},
            **{name: OTHER_HEADER for name in ("icc_chart_function", "icc_triangulate")}},
    "Python": {"icc_map_create_polygons": SHAPES, "icc_version_number": "__version__ says it", **FLAGS},
    "Rust": {"icc_map_create_polygons": SHAPES},
    "JavaScript": {"icc_map_create_polygons": SHAPES, **FLAGS,
                   "icc_coverage_get_features": "the coverage's domains have these features"},
}
OF_OTHER_HEADERS = re.compile("icc_(binding|curves|function|grid|pose|sampling|shape|tree|weights)_")


def used_in(top, patterns):
    """The names that are used, and those that are put together from a class's own name and an ending."""
    files = [path for pattern in patterns for path in sorted(top.glob(pattern)) if path.name not in NOT_USES]
    assert files, patterns
    text = COMMENT.sub("", "\n".join(path.read_text() for path in files))
    names = set(re.findall(r"\w+", text))
    for saved in re.findall(r'_name = "(\w+)"', text):
        names |= {saved + ending for ending in re.findall(r'_name \+ "(_\w+)"', text)}
    for before, after in re.findall(r'f"(\w+_)\{name\}(_\w+)"', text):
        names |= {before + name + after for name in re.findall(r'"(\w+)"', text)}
    return names


def main():
    top = Path(sys.argv[1])
    functions = sorted(json.loads((top / "include/icc/api.json").read_text())["functions"])
    assert len(functions) > 100
    faults, table = [], []
    used = {language: used_in(top, patterns) for language, patterns in SOURCES.items()}
    for function in functions:
        row = [function]
        for language, names in used.items():
            reached = function in names or function[4:] in names
            reason = LEFT_OUT[language].get(function)
            if reason is None and language == "C++" and OF_OTHER_HEADERS.match(function):
                reason = OTHER_HEADER
            if not reached and reason is None:
                faults.append(f"{function} cannot be reached from {language}")
            if reached and reason is not None:
                faults.append(f"{function} is reached from {language}; it need not be left out")
            row.append("yes" if reached else reason or "")
        table.append(row)
    for language, reasons in LEFT_OUT.items():
        faults += [f"{language}: there is no {function}" for function in reasons if function not in functions]
    if "--table" in sys.argv:
        for row in [["function", *SOURCES], *table]:
            print(" | ".join(row))
    sys.exit("\n".join(faults) or None)


main()
