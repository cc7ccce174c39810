"""The tables of the binding against include/icc/api.json."""

import ctypes
import json
import pathlib

import pytest
from libicc import _abi

API = pathlib.Path(__file__).parents[3] / "include/icc/api.json"
WORDS = {"int32_t": "i32", "uint32_t": "u32", "int64_t": "i64", "uint64_t": "u64", "size_t": "size",
         "double": "f64", "uint8_t": "u8", "char": "char", "void": "void", "icc_status": "i32"}
MODEL = {8: "lp64", 4: "ilp32"}[ctypes.sizeof(ctypes.c_void_p)]


@pytest.fixture(scope="module")
def api():
    if not API.is_file():
        pytest.skip("no headers")
    return json.loads(API.read_text(encoding="utf-8"))


def short(kind: str) -> str:
    """'const icc_map **' -> 'map**'."""
    words = [word for word in kind.replace("*", " * ").split() if word != "const"]
    stars = words.count("*")
    (name,) = (word for word in words if word != "*")
    return WORDS.get(name, name[4:] if name.startswith("icc_") else name) + "*" * stars


def test_functions(api):
    declared = {name[4:]: (short(function["returns"]), [short(p["type"]) for p in function["parameters"]])
                for name, function in api["functions"].items()}
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


def assert_same(ours, struct, name):
    assert ctypes.sizeof(ours) == struct["size"][MODEL], name
    offsets = {n: getattr(ours, n).offset for n, *_ in ours._fields_}
    assert offsets == {m["name"]: m["offset"][MODEL] for m in struct["members"]}, name


def test_structs(api):
    assert {f"icc_{name}" for name in _abi.structs._lines} | {"icc_line"} == set(api["structs"])  # it has no size
    for name in _abi.structs._lines:
        assert_same(getattr(_abi.structs, name), api["structs"][f"icc_{name}"], name)


def test_line_struct(api):
    from libicc.kernel import _Line

    struct = api["structs"]["icc_line"]
    assert ctypes.sizeof(_Line) == struct["size"][MODEL]
    assert [getattr(_Line, n).offset for n, _ in _Line._fields_] == [m["offset"][MODEL] for m in struct["members"]]


def test_choices(api):
    """Numbers of enumerators."""
    from libicc import _chart, _domain, _fit, _map, kernel

    numbers = {name[4:]: value for enum in api["enums"].values() for name, value in enum["values"].items()}
    for prefix, choices in [("METHOD_", _chart.METHODS), ("FUNCTION_", _chart.FUNCTIONS),
                            ("CONSTRAINTS_", _chart.CONSTRAINTS), ("SOLVER_", _chart.SOLVERS),
                            ("TREE_", _chart.TREES), ("MAP_", _map.KINDS),
                            ("REPAIR_", _map.REPAIRS), ("FIT_", _fit.MODELS), ("CONSTRAINT_", _fit.CONSTRAINTS),
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
