"""docs/papers.md has each figure, table and algorithm of the papers once, each with a command that can be run.

usage: papers.py ROOT
"""

import re
import sys
from pathlib import Path


def numbers(chapter, last, first=1):
    return [f"{chapter}.{k}" for k in range(first, last + 1)]


# Sections of the page in their order, and what the papers have.
WANTED = (
    {"Figure": ["3.1", *numbers(4, 5), *numbers(5, 2), *numbers(6, 13), "A.1"], "Table": ["5.1", "6.1"],
     "Algorithm": [str(k) for k in range(1, 9)]},
    {"Figure": [str(k) for k in range(1, 11)], "Table": ["1"], "Algorithm": []},
    {"Figure": [*numbers(3, 9), *numbers(4, 6), *numbers(5, 2), *numbers(6, 40)],
     "Table": ["4.1", *numbers(6, 7)], "Algorithm": []},
)
ROW = re.compile(r"\| (Figure|Table|Algorithm)s? ([^|]*) \|[^|]*\| `([^|`]*)` \|[^|]*\|$")
# What a command runs, and the file that it is made of.
SOURCES = (
    (r"build/release/tests/bench/(bench_\w+)$", "tests/bench/{}.c"),
    (r"build/examples/programs/(\w+)( |$)", "examples/{}.c"),
    (r"ctest --test-dir build/release -R (\S+?)\$?$", "tests/{}.c"),
    (r"(?:python3|sh) (\S+)", "{}"),
)


def listed(text):
    """The numbers that "3.2, 3.4-3.6" names."""
    for part in text.split(", "):
        first, _, last = part.partition("-")
        *chapter, begin = first.split(".")
        end = last.split(".")[-1] or begin
        if begin == end:
            yield first
            continue
        for k in range(int(begin), int(end) + 1):
            yield ".".join([*chapter, str(k)])


def missing(root, command):
    """What a command needs and the tree has not; None: nothing."""
    lost = [name for name in re.findall(r"\bexamples/[\w./-]+", command)
            if not name.startswith("examples/programs/") and not (root / name).is_file()]
    if lost:
        return f"there is no {lost[0]}"
    for pattern, source in SOURCES:
        if found := re.match(pattern, command):
            return None if (root / source.format(found[1])).is_file() else f"there is no {source.format(found[1])}"
    name, verb, *words = command.split()
    page = root / f"docs/man/libicc-{verb}.1"
    if name != "libicc" or not page.is_file():
        return "no such command"
    manual = page.read_text(encoding="utf-8").replace("\\-", "-")
    return next((f"the manual has no {word}" for word in words
                 if word.startswith("--") and not re.search(rf"{word}\b", manual)), None)


def main():
    root = Path(sys.argv[1])
    sections = (root / "docs/papers.md").read_text(encoding="utf-8").split("\n## ")
    sections = [section for section in sections if "\n| Figure" in section]
    wrong = [] if len(sections) == len(WANTED) else [f"{len(sections)} sections"]
    for section, wanted in zip(sections, WANTED):
        title, found = section.split("\n")[0], {kind: [] for kind in wanted}
        rows = [line for line in section.split("\n") if line.startswith(("| Figure", "| Table", "| Algorithm"))]
        for line in rows:
            row = ROW.match(line)
            if not row:
                wrong.append(f"not a row of four with a command: {line}")
                continue
            found[row[1]] += listed(row[2])
            if fault := missing(root, row[3]):
                wrong.append(f"{row[1]} {row[2]}: {row[3]}: {fault}")
        for kind, numbers_ in wanted.items():
            if sorted(found[kind]) != sorted(numbers_):
                odd = sorted(set(found[kind]) ^ set(numbers_)) or "one is there twice"
                wrong.append(f"{title}: {kind}s: {odd}")
    print("\n".join(wrong) if wrong else "all there")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
