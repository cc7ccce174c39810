"""The tables of the binding against the headers, which cffi reads."""

import ctypes
import pathlib
import re
import shutil
import subprocess

import pytest
from libicc import _abi

cffi = pytest.importorskip("cffi")

HEADERS = pathlib.Path(__file__).parents[3] / "include"
WORDS = {"int32_t": "i32", "uint32_t": "u32", "int64_t": "i64", "uint64_t": "u64", "size_t": "size",
         "double": "f64", "uint8_t": "u8", "char": "char", "void": "void", "icc_status": "i32"}


@pytest.fixture(scope="module")
def header():
    compiler = shutil.which("cc")
    if compiler is None or not HEADERS.is_dir():
        pytest.skip("no C compiler, or no headers")
    text = "".join(f"#include <icc/{path.name}>\n" for path in sorted((HEADERS / "icc").glob("*.h")))
    plain = subprocess.run([compiler, "-E", "-P", "-DICC_STATIC", f"-I{HEADERS}", "-"], input=text,
                           capture_output=True, text=True, check=True).stdout
    plain = plain[plain.index("typedef int32_t icc_status"):]
    ffi = cffi.FFI()
    ffi.cdef(plain)
    return ffi, plain


def short(kind: str) -> str:
    """'const icc_map * *' -> 'map**'."""
    words = kind.replace("const", " ").replace("*", " * ").split()
    stars = words.count("*")
    (name,) = (word for word in words if word != "*")
    return WORDS.get(name, name[4:] if name.startswith("icc_") else name) + "*" * stars


def test_functions(header):
    ffi, plain = header
    declared = {}
    for result, name, arguments in re.findall(r"^([\w ]+[\w*] ?\**)icc_(\w+)\(([^)]*)\);", plain, re.M):
        kinds = []
        for argument in arguments.split(","):
            argument = re.sub(r"(\w+)\[\d+\]$", r"*\1", argument.strip())
            if argument != "void":
                kinds.append(short(re.sub(r"\w+$", "", argument)))
        declared[name] = (short(result), kinds)
    table = {}
    for line in _abi.FUNCTIONS.split("\n"):
        if line:
            head, *kinds = line.split()
            result, _, name = head.rpartition(":")
            table[name] = (result or "i32", kinds)
    assert sorted(table) == sorted(declared)
    for name in declared:
        assert table[name] == declared[name], name


def test_functions_are_there():
    for name in list(_abi.lib._lines):
        getattr(_abi.lib, name)


def test_structs(header):
    ffi, plain = header
    declared = set(re.findall(r"^} icc_(\w+);", plain, re.M))
    table = set(_abi.structs._lines) | {"line"}  # icc_line has no size
    assert table == declared
    for name in _abi.structs._lines:
        kind, ours = ffi.typeof(f"icc_{name}"), getattr(_abi.structs, name)
        assert ctypes.sizeof(ours) == ffi.sizeof(kind), name
        for member, field in kind.fields:
            assert getattr(ours, member).offset == field.offset, (name, member)
            assert getattr(ours, member).size == ffi.sizeof(field.type), (name, member)
        assert len(kind.fields) == len(ours._fields_), name


def test_line_struct(header):
    from libicc.kernel import _Line

    kind = header[0].typeof("icc_line")
    assert ctypes.sizeof(_Line) == header[0].sizeof(kind)
    assert [f.offset for _, f in kind.fields] == [getattr(_Line, n).offset for n, _ in _Line._fields_]


def test_choices(header):
    """Numbers of enumerators."""
    from libicc import _chart, _domain, _map, kernel

    text = header[1]
    numbers = {name: int(value) for name, value in re.findall(r"ICC_(\w+) = (\d+)", text)}
    for prefix, choices in [("METHOD_", _chart.METHODS), ("FUNCTION_", _chart.FUNCTIONS),
                            ("CONSTRAINTS_", _chart.CONSTRAINTS), ("SOLVER_", _chart.SOLVERS),
                            ("TREE_", _chart.TREES), ("MAP_", _map.KINDS),
                            ("DEFECT_", _domain.DEFECTS), ("SAMPLING_", kernel.SAMPLINGS),
                            ("KERNEL_", kernel.KERNELS), ("INITIAL_", kernel.INITIALS),
                            ("WEIGHTS_", kernel.METHODS)]:
        ours = {prefix + name.upper().replace(" ", "_"): value for name, value in choices.items()}
        assert ours == {k: v for k, v in numbers.items() if k.startswith(prefix)}
    from libicc import Error

    errors = {k: v for k, v in vars(Error).items() if k.isupper()}
    assert errors == {k[4:]: v for k, v in numbers.items() if k.startswith("ERR_")}
    from libicc._errors import _ERRORS, ITEMS

    assert {(name or "none").upper().replace(" ", "_"): k for k, name in enumerate(ITEMS)} == {
        k[5:]: v for k, v in numbers.items() if k.startswith("ITEM_")}

    assert sorted(_ERRORS) == sorted(errors.values())
