"""The fenced blocks of a page of Markdown, and what invisible comments in front of them say.

    <!-- output -->            what the block before prints; "..." stands for anything
    <!-- file: NAME -->        the block is a file that later blocks use
    <!-- in: NAME -->          the block is put into the frame tests/docs/NAME, in place of its line SNIPPET
    <!-- needs: A, module B --> the block wants the command A and the Python module B
    <!-- not run: REASON -->   the block cannot be run here
    <!-- check: NAME -->       by itself: what has been made so far passes the Python program tests/docs/NAME
    <!-- live: NAME -->        by itself: here the site has the studio with these shapes (docs/live.sed)
"""

import re
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
RUN = ("c", "cpp", "html", "js", "python", "rust", "sh", "cmake")
SHOWN = ("text", "json")
COMMENT = re.compile(r"<!-- (?:(output)|(file|in|needs|not run|check|live): (\S.*?)) -->\s*$")
# Commands in a block that is only indented would go untested.
INDENTED = re.compile(r" {4}(sudo|apt|libicc|sh|cc|cmake|python3|cargo|PYTHONPATH)\b")


class Mistake(Exception):
    """What is wrong with a page, and in which line."""


@dataclass
class Block:
    language: str
    text: str
    line: int
    says: dict = field(default_factory=dict)


def blocks_of(path):
    """All blocks of a page in their order."""
    blocks, block, says, lines = [], None, {}, None
    for number, line in enumerate(path.read_text(encoding="utf-8").split("\n"), 1):
        if lines is not None:
            if line.rstrip() == "```":
                block.text = "\n".join(lines) + "\n"
                blocks.append(block)
                lines = None
            else:
                lines.append(line)
        elif line.startswith("```"):
            block, lines, says = Block(line[3:].strip(), "", number, says), [], {}
            _check(path, block)
        elif line.startswith("<!--"):
            word, value = _comment(path, number, line)
            if word == "live":
                continue
            says[word] = value
            if word == "check":
                blocks.append(Block("python", (HERE / value).read_text(encoding="utf-8"), number, says))
                says = {}
        elif says and line.strip():
            raise Mistake(f"{path}:{number}: the comment above belongs to no block")
        elif INDENTED.match(line):
            raise Mistake(f"{path}:{number}: commands belong into a block of ```sh")
    if lines is not None:
        raise Mistake(f"{path}:{block.line}: the block does not end")
    return blocks


def _comment(path, number, line):
    found = COMMENT.match(line)
    if not found:
        raise Mistake(f"{path}:{number}: the comment must be output, file, in, needs, not run, check or live, with what that takes")
    return found[1] or found[2], found[3] or ""


def _check(path, block):
    where = f"{path}:{block.line}"
    if block.language not in RUN + SHOWN:
        raise Mistake(f"{where}: '{block.language}' is none of {', '.join(RUN + SHOWN)}")
    if block.language in SHOWN and not {"output", "file"} & set(block.says):
        raise Mistake(f"{where}: is this output, or a file?")
    if "output" in block.says and block.language not in SHOWN:
        raise Mistake(f"{where}: output is text or json")
