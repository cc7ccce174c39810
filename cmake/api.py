"""Describes the C interface in include/icc/api.json, from the headers. It lists functions with their parameters and who
owns what, structs with the offsets of their members, and enumerations with names. Bindings and their tests read it.

usage: api.py INCLUDE           writes INCLUDE/icc/api.json
       api.py INCLUDE CC..      checks that it is up to date, and that CC lays out structs as it says
"""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

HEADERS = ["base", "map", "chart", "stages", "kernel", "fit", "coverage"]
# Offsets are those of every machine that aligns a type to its own size: with 8 bytes for pointers, and with 4.
POINTERS = {"lp64": 8, "ilp32": 4}
SIZES = {"int32_t": 4, "uint32_t": 4, "int64_t": 8, "uint64_t": 8, "double": 8, "char": 1, "uint8_t": 1,
         "icc_status": 4}

# Where the prefix alone is the name of an object, or of nothing.
ENUM_NAMES = {"ICC_ERR_": "icc_status", "ICC_MAX_DIM": "icc_limit", "ICC_": "icc_place", "ICC_MAP_": "icc_map_kind",
              "ICC_FEATURE_": "icc_feature_kind", "ICC_FUNCTION_": "icc_function_kind", "ICC_TREE_": "icc_tree_form",
              "ICC_SAMPLING_": "icc_sampling_kind", "ICC_WEIGHTS_": "icc_weights_method",
              "ICC_CONSTRAINT_": "icc_constraint_kind", "ICC_FIT_": "icc_fit_model"}

COMMENT = r"/\*\*(?P<doc>(?:(?!\*/).)*)\*/\s*"
ENUM = re.compile(COMMENT + r"enum \{(?P<body>.*?)\n\};", re.S)
STRUCT = re.compile(COMMENT + r"typedef struct (?P<name>icc_\w+) \{(?P<body>.*?)\n\} \w+;", re.S)
OPAQUE = re.compile(r"^typedef struct (icc_\w+) \1;", re.M)
FUNCTION = re.compile(COMMENT + r"ICC_API (?P<result>[\w\s]+?\**)(?P<name>icc_\w+)\((?P<list>[^)]*)\);", re.S)
MEMBER = re.compile(r"(?:/\*\*(?P<above>(?:(?!\*/).)*)\*/\s*)?(?P<text>[^;/]+);"
                    r"(?:\s*/\*\*<(?P<behind>(?:(?!\*/).)*)\*/)?", re.S)
WORDS = re.compile(r"`(ICC_[A-Z]+)_(?:\*|[A-Z]+)`")


def plain(comment):
    """A comment as one line."""
    return re.sub(r"\s*\n\s*\*?\s*", " ", comment).strip().lstrip("<").strip()


def without_comments(text):
    return re.sub(r"/\*.*?\*/", " ", text, flags=re.S)


def declaration(text):
    """'const double *points' -> ('points', 'const double *', None); an array's length is the last one."""
    found = re.fullmatch(r"(.*?)(\w+)(?:\[(\w+)\])?", " ".join(text.split()))
    kind = re.sub(r"\s*\*\s*", "*", found[1]).strip().replace("struct ", "")
    return found[2], kind.replace("*", " *", 1), found[3]


def enumeration_name(names):
    """Enumerators have a type in C only by their names: ICC_METHOD_* is icc_method."""
    prefix = os.path.commonprefix([name for name in names if name != "ICC_OK"])
    prefix = prefix[:prefix.rindex("_") + 1] if len(names) > 1 else names[0]
    return prefix, ENUM_NAMES.get(prefix, prefix.rstrip("_").lower())


def enumerations(text, header):
    for found in ENUM.finditer(text):
        body = without_comments(found["body"])
        values = {name: int(value) for name, value in re.findall(r"\b(ICC_\w+) = (\d+)", body)}
        prefix, name = enumeration_name(list(values))
        yield name, {"header": header, "prefix": prefix, "values": values}


def members(body):
    """Declarations with the comments behind or above them."""
    for found in MEMBER.finditer(body):
        callback = re.match(r"\s*(\w+ \*?)\(\*(\w+)\)\((.*)\)", found["text"], re.S)
        name, kind, length = (callback[2], "callback", None) if callback else declaration(found["text"])
        yield name, kind, length, plain(found["behind"] or found["above"] or "")


def lay_out(struct):
    """Adds sizes and offsets."""
    struct["size"], ends = {}, {}
    for model, pointer in POINTERS.items():
        end, most = 0, 1
        for member in struct["members"]:
            kind = member["type"]
            width = pointer if "*" in kind or kind in ("callback", "size_t") else SIZES[kind.replace("const ", "")]
            end = (end + width - 1) // width * width
            member.setdefault("offset", {})[model] = end
            end, most = end + width * member.get("length", 1), max(most, width)
        struct["size"][model] = (end + most - 1) // most * most


def structs(text, header, limits):
    for found in STRUCT.finditer(text):
        listed = []
        for name, kind, length, doc in members(found["body"]):
            member = {"name": name, "type": kind}
            if length is not None:
                member["length"] = limits[length] if length in limits else int(length)
            words = WORDS.search(doc)
            if words and kind == "int32_t":
                member["enum"] = words[1] + "_"
            listed.append(member)
        struct = {"header": header, "members": listed}
        lay_out(struct)
        yield found["name"], struct


def told_of(doc):
    """The @param paragraphs of a comment: name -> (direction or None, text)."""
    lines = re.sub(r"\n\s*\* ?", "\n", doc)
    return {found[2]: (found[1], " ".join(found[3].split()))
            for found in re.finditer(r"@param(?:\[([\w,]+)\])?\s+(\w+)\s+(.*?)(?=\n\s*@|\n\s*\n|\Z)", lines, re.S)}


def parameters(text, doc, opaque):
    told = told_of(doc)
    for part in [] if text.strip() == "void" else text.split(","):
        name, kind, length = declaration(part)
        direction, words = told.get(name, (None, ""))
        pointer = kind if length is None else kind + " *"
        written = "*" in pointer and not pointer.startswith("const ") and pointer.split()[0] not in opaque
        parameter = {"name": name, "type": pointer}
        if length is not None:
            parameter["length"] = int(length)
        if "*" in pointer:
            made = pointer.endswith("**") and pointer.split()[0] in opaque and not pointer.startswith("const ")
            guess = "out" if written or made else "in"
            parameter["direction"] = {"in,out": "inout", "out": "out"}.get(direction, guess)
            if made:
                parameter["ownership"] = "caller, " + pointer.split()[0] + "_free"
            parameter["nullable"] = bool(re.search(r"NULL", words)) or name in ("env", "err")
        enum = WORDS.search(words) or (WORDS.search(doc) if name == "method" else None)
        if enum and kind.replace(" *", "") == "int32_t":
            parameter["enum"] = enum[1] + "_"
        yield parameter


def functions(text, header, opaque):
    for found in FUNCTION.finditer(text):
        _, result, _ = declaration(found["result"] + " _")
        function = {"header": header, "returns": result,
                    "parameters": list(parameters(found["list"], found["doc"], opaque))}
        if result.startswith("const ") and "*" in result:
            lender = "borrowed from " + function["parameters"][0]["name"] if function["parameters"] else ""
            function["ownership"] = "library, static" if "char" in result else lender
        elif found["name"].endswith("_free"):
            function["ownership"] = "frees " + function["parameters"][0]["name"]
        yield found["name"], function


def describe(include):
    texts = {name: (include / "icc" / f"{name}.h").read_text(encoding="utf-8") for name in HEADERS}
    result = {"from": "the headers, by cmake/api.py", "enums": {}, "opaque": [], "structs": {}, "functions": {}}
    for header, text in texts.items():
        result["enums"].update(enumerations(text, f"{header}.h"))
        result["opaque"] += OPAQUE.findall(text)
    limits = result["enums"]["icc_limit"]["values"]
    for header, text in texts.items():
        result["structs"].update(structs(text, f"{header}.h", limits))
        result["functions"].update(functions(text, f"{header}.h", result["opaque"]))
    types = {enum["prefix"]: name for name, enum in result["enums"].items()}
    listed = [m for s in result["structs"].values() for m in s["members"]]
    for item in listed + [p for f in result["functions"].values() for p in f["parameters"]]:
        if "enum" in item:
            item["enum"] = types[item["enum"]]
    return result


def check_layout(api, include, compiler):
    """The compiler agrees, and nothing that the headers declare is missing."""
    told = subprocess.run([*compiler, "-E", "-P", "-x", "c", "-"], input="__SIZEOF_POINTER__ __i386__",
                          capture_output=True, text=True, check=True).stdout.split()
    if told[1] == "1":
        return  # aligns doubles to 4 bytes
    model = {str(width): name for name, width in POINTERS.items()}[told[0]]
    lines = [f"#include <icc/{name}.h>" for name in HEADERS] + ["#define SAME(a, b) _Static_assert((a) == (b), #a)"]
    for name, struct in api["structs"].items():
        lines.append(f"SAME(sizeof({name}), {struct['size'][model]});")
        lines += [f"SAME(offsetof({name}, {m['name']}), {m['offset'][model]});" for m in struct["members"]]
    for enum in api["enums"].values():
        lines += [f"SAME({name}, {value});" for name, value in enum["values"].items()]
    subprocess.run([*compiler, "-std=c11", f"-I{include}", "-fsyntax-only", "-x", "c", "-"], text=True, check=True,
                   input="\n".join(lines) + "\n")
    text = "".join(without_comments(path.read_text(encoding="utf-8")) for path in sorted((include / "icc").glob("*.h")))
    assert sorted(api["functions"]) == sorted(set(re.findall(r"\bICC_API [^;(]*?\b(icc_\w+)\(", text)))
    assert sorted(api["structs"]) == sorted(set(re.findall(r"typedef struct (icc_\w+) \{", text)))
    names = [name for enum in api["enums"].values() for name in enum["values"]]
    assert sorted(names) == sorted(set(re.findall(r"\b(ICC_\w+) = \d+", text)))


def written(value, depth=0):
    """JSON with a line for each member, parameter and enumeration."""
    if depth < 3 and isinstance(value, dict) and any(isinstance(item, (dict, list)) for item in value.values()):
        rows = [f'{json.dumps(key)}: {written(item, depth + 1)}' for key, item in value.items()]
        return "{\n" + ",\n".join(" " * (depth + 1) + row for row in rows) + "\n" + " " * depth + "}"
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return "[\n" + ",\n".join(" " * (depth + 1) + json.dumps(item) for item in value) + "\n" + " " * depth + "]"
    return json.dumps(value)


def main():
    include = Path(sys.argv[1])
    path = include / "icc" / "api.json"
    api = describe(include)
    text = written(api) + "\n"
    if len(sys.argv) == 2:
        path.write_text(text, encoding="utf-8")
    elif path.read_text(encoding="utf-8") != text:
        sys.exit(f"{path} is not up to date: python3 cmake/api.py include")
    else:
        check_layout(api, include, sys.argv[2:])


main()
