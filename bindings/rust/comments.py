"""Copies the comments of the C headers to libicc-sys, where they become Rust documentation.

usage: comments.py INCLUDE           rewrites the comments of libicc-sys/src/lib.rs
       comments.py INCLUDE --check   fails if they are not up to date
"""

import re
import sys
import textwrap
from pathlib import Path

HEADERS = ["base", "map", "chart", "stages", "kernel", "fit", "coverage"]
SOURCE = Path(__file__).parent / "libicc-sys" / "src" / "lib.rs"
WIDTH = 110  # max_width in rustfmt.toml

COMMENT = r"/\*\*(?P<doc>(?!<)(?:(?!\*/).)*)\*/\s*"
GROUP = re.compile(COMMENT + r"(?P<kind>enum|typedef struct (?P<name>\w+)) \{(?P<body>.*?)\n\}", re.S)
SINGLE = re.compile(COMMENT + r"(?:ICC_API [^;(]*?(?P<function>icc_\w+)\(|typedef struct (?P<opaque>icc_\w+) \w+;"
                    r"|typedef \w+ (?P<type>icc_\w+);|typedef void \(\*(?P<callback>icc_\w+)\))", re.S)
MEMBER = re.compile(r"(?:/\*\*(?P<above>(?!<)(?:(?!\*/).)*)\*/\s*)?(?P<text>[^,;/(]+(?:\(\*\w+\)\([^;]*)?)[,;]?"
                    r"(?:\s*/\*\*<(?P<behind>(?:(?!\*/).)*)\*/)?", re.S)


def member_name(text):
    found = re.search(r"(ICC_\w+) = |\(\*(\w+)\)|(\w+)(?:\[\w+\])?\s*$", text)
    return found and next(filter(None, found.groups()))


def header_comments(include):
    """Name of an item, or 'STRUCT.MEMBER', or 'enum FIRST' -> comment."""
    result = {}
    for header in HEADERS:
        text = (include / "icc" / f"{header}.h").read_text(encoding="utf-8")
        for found in SINGLE.finditer(text):
            name = next(filter(None, (found[g] for g in ("function", "opaque", "type", "callback"))))
            result[name] = found["doc"]
        for found in GROUP.finditer(text):
            members = [(member_name(m["text"].strip()), m["behind"] or m["above"])
                       for m in MEMBER.finditer(found["body"]) if m["text"].strip()]
            result[found["name"] or f"enum {members[0][0]}"] = found["doc"]
            for name, doc in members:
                result[f"{found['name']}.{name}" if found["name"] else name] = doc
    return result


def marked(text):
    """Markdown of Rust: names as code, brackets that are no links."""
    parts = re.split(r"(`[^`]*`)", text)
    for i in range(0, len(parts), 2):
        part = re.sub(r"([\[\]<])", r"\\\1", parts[i])
        part = re.sub(r"::(ICC_\w+)", r"`\1`", part)
        part = re.sub(r"\b(icc_\w+)::(\w+)", r"`\1.\2`", part)
        parts[i] = re.sub(r"(?<![`/\w])(icc_\w+(?:\(\))?)(?!`|\w|/|\.\w)", r"`\1`", part)
    return re.sub(r"::(icc_\w+)", r"\1", "".join(parts))


def blocks(doc):
    """Paragraphs and items of lists, each as one line; an empty line where a comment has one."""
    result, fresh = [], True
    for line in re.sub(r"(?m)^\s*\* ?", "", doc.strip().lstrip("<")).splitlines():
        line = line.strip()
        starts = re.match(r"- |@", line)
        if not line or fresh or starts or not result[-1]:
            result.append(line)
        else:
            result[-1] += " " + line
        fresh = not line
    return result


def rust_comment(doc, indent, mark):
    lines, last = [], ""
    for block in blocks(doc):
        block = re.sub(r"^@param(?:\[([\w,]+)\])? (\w+)\s*", lambda m: f"- `{m[2]}`" + (
            {"out": " (out)", "in,out": " (in and out)"}.get(m[1], "")) + ": ", block)
        returns = block.startswith("@return")
        block = re.sub(r"^@return\s*", "Returns ", block)
        if returns and last or block.startswith("- ") and last and not last.startswith("- "):
            lines.append("")
        lines += textwrap.wrap(marked(block), WIDTH - indent - len(mark) - 1, break_long_words=False,
                               break_on_hyphens=False, subsequent_indent="  " if block.startswith("- ") else "") or [""]
        last = block
    return [(" " * indent + f"{mark} {line}").rstrip() for line in lines]


def rewritten(text, comments):
    """Replaces each comment that stands before an item of the headers."""
    lines, result, struct, used = text.splitlines(), [], "", set()
    at = 0
    while at < len(lines):
        begin = at
        while re.match(r" *//( |$)", lines[at]):
            at += 1
        group = lines[begin:at]
        begin = at
        while lines[at].lstrip().startswith("///"):
            at += 1
        old = lines[begin:at]
        attributes = at
        while lines[attributes].lstrip().startswith("#["):
            attributes += 1
        item = lines[attributes]
        indent = len(item) - len(item.lstrip())
        found = re.match(r" *pub (const|struct|fn|type) (\w+)", item)
        field = re.match(r"    pub (?:r#)?(\w+):", item)
        if found and found[1] == "struct":
            struct = found[2]
        name = found[2] if found else f"{struct}.{field[1]}" if field else item.strip()
        if group and f"enum {name}" in comments:
            group = rust_comment(comments[f"enum {name}"], indent, "//")
        if old and comments.get(name):
            old = rust_comment(comments[name], indent, "///")
            used.add(name)
        result += group + old
        result.append(lines[at])
        at += 1
    missing = {name for name, doc in comments.items() if doc and not name.startswith("enum ")} - used
    if missing:
        sys.exit(f"no comment in {SOURCE.name} for {', '.join(sorted(missing))}")
    return "\n".join(result) + "\n"


def main():
    text = SOURCE.read_text(encoding="utf-8")
    new = rewritten(text, header_comments(Path(sys.argv[1])))
    if "--check" not in sys.argv:
        SOURCE.write_text(new, encoding="utf-8")
    elif new != text:
        sys.exit(f"the comments of {SOURCE} are not those of the headers: python3 bindings/rust/comments.py include")


main()
