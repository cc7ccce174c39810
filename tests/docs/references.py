"""Everything that the pages point to is there: links and their anchors, pictures, files of the tree, and
functions, types and members of the public headers; and the pages that comments in the sources name.

usage: references.py ROOT PAGE...
"""

import os
import re
import sys
from pathlib import Path

LINK = re.compile(r"\]\(([^()\s]+)\)")
FOLDERS = "lib|include|tools|tests|examples|docs|cmake|bindings|debian"
PATH = re.compile(rf"`((?:{FOLDERS})/[\w./*-]*)`")
BARE = re.compile(r"`([\w-]+\.(?:c|h|hpp|py|sh|rs|md|cmake))`")
NAME = re.compile(r"\bicc_[a-z0-9_]+\b|\bICC_[A-Z0-9_]+\b(?!\*)")
PLACEHOLDERS = {"icc_noun", "icc_noun_verb", "ICC_NOUN"}
MEMBER = re.compile(r"\b(icc_[a-z_]+)::(\w+)")


def anchors(text):
    """The anchors of the headings of a page, as GitHub makes them."""
    headings = re.findall(r"^#+ +(.*?) *$", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def broken_links(page, text):
    prose = re.sub(r"^```.*?^```", "", text, flags=re.M | re.S)
    for link in LINK.findall(prose):
        if re.match(r"https?:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path) if path else page
        if not target.exists():
            yield f"{link} does not exist"
        elif anchor and anchor not in anchors(target.read_text(encoding="utf-8")):
            yield f"{target.name} has no heading #{anchor}"


def missing_files(root, names, text):
    for path in PATH.findall(text):
        if path.startswith("debian/") and not (root / "debian").exists():
            continue  # the archive of the sources has no such folder
        if not (any(root.glob(path)) if "*" in path else (root / path).exists()):
            yield f"there is no {path}"
    for name in BARE.findall(text):
        if name not in names and f"file: {name}" not in text:
            yield f"no file of the tree is called {name}"


def unknown_names(words, structs, text):
    for name in sorted(set(NAME.findall(text)) - words):
        yield f"the headers have no {name}"
    for struct, member in MEMBER.findall(text):
        if not re.search(rf"\b{member}\b", structs.get(struct, "")):
            yield f"{struct} has no member {member}"


def lost_pages(root):
    """Pages that comments of the sources name."""
    for folder in "lib", "include", "tools", "examples", "bindings", "cmake":
        for path in (root / folder).rglob("*"):
            if path.suffix in (".c", ".h", ".hpp", ".py", ".rs", ".sh", ".cmake") and "target" not in path.parts:
                for page in re.findall(r"\bdocs/[\w/-]+\.md\b", path.read_text(encoding="utf-8")):
                    if not (root / page).exists():
                        yield f"{path.relative_to(root)}: there is no {page}"


def names_in(root):
    """The names of all files of the tree; what was built is none of it."""
    names = set()
    for _, folders, files in os.walk(root):
        folders[:] = [folder for folder in folders if folder not in (".git", "build", "target")]
        names.update(files)
    return names


def main():
    root = Path(sys.argv[1])
    names = names_in(root)
    sources = "".join(path.read_text(encoding="utf-8") for path in root.glob("include/icc/*"))
    for path in ("CMakeLists.txt", "tools/CMakeLists.txt", "cmake/deps.sh", "cmake/libicc.map", "tests/CMakeLists.txt",
                 "tests/share.h", "tests/modes/modes.h"):
        sources += (root / path).read_text(encoding="utf-8")
    words = set(re.findall(r"\w+", sources)) | PLACEHOLDERS
    structs = {name: body for body, name in re.findall(r"typedef struct icc_\w+ \{(.*?)^\} (icc_\w+);", sources,
                                                        re.M | re.S)}
    wrong = list(lost_pages(root))
    for page in sys.argv[2:]:
        path = root / page
        text = path.read_text(encoding="utf-8")
        found = [*broken_links(path, text), *missing_files(root, names, text),
                 *unknown_names(words, structs, text)]
        wrong += [f"{page}: {what}" for what in found]
    print(f"{len(sys.argv) - 2} pages")
    sys.exit("\n".join(wrong) or None)


if __name__ == "__main__":
    main()
