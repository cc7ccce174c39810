"""docs/papers.md has each figure, table and algorithm of the papers once, and what its rows name is there.

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
ROW = re.compile(r"\| (Figure|Table|Algorithm)s? ([^|]*) \|[^|]*\| ([^|]*) \|[^|]*\|$")


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


def missing(root, named):
    """What is wrong with the file, benchmark or command that a row names; None: nothing."""
    if named.startswith("bench_"):
        return None if (root / "tests/bench" / f"{named}.c").is_file() else "no such benchmark"
    if not named.startswith("libicc "):
        return None if (root / named).is_file() else "no such file"
    manual = "".join(page.read_text(encoding="utf-8") for page in (root / "docs/man").glob("*.1")).replace("\\-", "-")
    return next((f"the manual has no {word}" for word in named.split()[1:] if word not in manual), None)


def main():
    root = Path(sys.argv[1])
    sections = (root / "docs/papers.md").read_text(encoding="utf-8").split("\n## ")[1:]
    wrong = [] if len(sections) == len(WANTED) else [f"{len(sections)} sections"]
    for section, wanted in zip(sections, WANTED):
        title, found = section.split("\n")[0], {kind: [] for kind in wanted}
        rows = [line for line in section.split("\n") if line.startswith(("| Figure", "| Table", "| Algorithm"))]
        for line in rows:
            row = ROW.match(line)
            if not row:
                wrong.append(f"not a row of four: {line}")
                continue
            found[row[1]] += listed(row[2])
            names = re.findall("`([^`]*)`", row[3])
            if not names and row[3] != "-":
                wrong.append(f"neither a name nor -: {line}")
            wrong += [f"{row[1]} {row[2]}: {name}: {fault}" for name in names if (fault := missing(root, name))]
        for kind, numbers_ in wanted.items():
            if sorted(found[kind]) != sorted(numbers_):
                odd = sorted(set(found[kind]) ^ set(numbers_)) or "one is there twice"
                wrong.append(f"{title}: {kind}s: {odd}")
    print("\n".join(wrong) if wrong else "all there")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
