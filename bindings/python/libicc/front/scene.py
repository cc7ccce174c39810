"""glTF scenes in several files become one file (.glb), which the command libicc reads."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path
from typing import Any
from urllib.parse import unquote


def pack(path: Path, folder: Path) -> Path:
    """Writes a scene in JSON as one binary file into a folder, with the bytes of all its buffers."""
    tree = json.loads(path.read_text(encoding="utf-8"))
    begins, content = [], b""
    for buffer in tree.get("buffers", []):
        begins.append(len(content))
        content += _bytes_of(buffer, path)
        content += b"\0" * (-len(content) % 4)
    for view in tree.get("bufferViews", []):
        view["byteOffset"] = view.get("byteOffset", 0) + begins[view["buffer"]]
        view["buffer"] = 0
    if begins:
        tree["buffers"] = [{"byteLength": len(content)}]
    text = json.dumps(tree).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(content), b"BIN\0") + content
    packed = folder / (path.stem + ".glb")
    packed.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)
    return packed


def _bytes_of(buffer: Any, path: Path) -> bytes:
    uri = buffer["uri"]
    if uri.startswith("data:"):
        return base64.b64decode(uri.partition(",")[2])
    return (path.parent / unquote(uri)).read_bytes()
