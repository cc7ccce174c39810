#!/usr/bin/env python3
"""Runs notebooks without Jupyter, and compares what they print and draw with what is stored in them.

    python3 examples/notebooks/run.py [--write | --jupyter] [NOTEBOOK ...]

Without names it runs all notebooks of this folder. --write stores what was found. --jupyter runs them by Jupyter instead
(nbclient and ipykernel), and only asks that no cell fails. Pictures of matplotlib are stored, but not compared, because its
versions draw differently. A notebook whose packages are missing is left out, and named.
"""

import ast
import base64
import contextlib
import importlib.util
import io
import json
import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
DOTS_PER_INCH = 70
COLOURS = 255


def source_of(cell):
    return "".join(cell["source"])


def missing_of(notebook):
    """The packages that a notebook imports and that are not installed."""
    trees = [ast.parse(source_of(cell)) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    nodes = [node for tree in trees for node in ast.walk(tree)]
    names = [alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names]
    names += [node.module for node in nodes if isinstance(node, ast.ImportFrom)]
    wanted = {name.partition(".")[0] for name in names}
    return sorted(name for name in wanted if importlib.util.find_spec(name) is None and not (HERE.parent / f"{name}.py").exists())


def lines_of(text):
    return text.splitlines(keepends=True)


def result_of(value, number):
    """What a notebook keeps of the value of a cell's last line."""
    data = {"text/plain": lines_of(repr(value))}
    picture = value._repr_svg_() if hasattr(value, "_repr_svg_") else None
    if picture:
        data["image/svg+xml"] = lines_of(picture)
    return {"data": data, "execution_count": number, "metadata": {}, "output_type": "execute_result"}


def small_png(figure):
    """A figure as PNG with few colours."""
    from PIL import Image

    drawn, small = io.BytesIO(), io.BytesIO()
    figure.savefig(drawn, format="png", dpi=DOTS_PER_INCH)
    Image.open(drawn).convert("RGB").quantize(COLOURS).save(small, format="png", optimize=True)
    return small.getvalue()


def figures():
    """The figures that matplotlib has open, which it then closes."""
    if "matplotlib.pyplot" not in sys.modules:
        return []
    pyplot, found = sys.modules["matplotlib.pyplot"], []
    for number in pyplot.get_fignums():
        picture = base64.b64encode(small_png(pyplot.figure(number))).decode() + "\n"
        found.append({"data": {"image/png": picture}, "metadata": {}, "output_type": "display_data"})
    pyplot.close("all")
    return found


def outputs_of(source, names, number):
    """Runs a cell, and returns its outputs as Jupyter stores them."""
    body, said, outputs = ast.parse(source), io.StringIO(), []
    last = body.body.pop() if body.body and isinstance(body.body[-1], ast.Expr) else None
    with contextlib.redirect_stdout(said):
        exec(compile(body, f"cell {number}", "exec"), names)
        value = eval(compile(ast.Expression(last.value), f"cell {number}", "eval"), names) if last else None
    if said.getvalue():
        outputs.append({"name": "stdout", "output_type": "stream", "text": lines_of(said.getvalue())})
    if value is not None and not source.rstrip().endswith(";"):
        outputs.append(result_of(value, number))
    return outputs + figures()


def compared(outputs):
    return [output for output in outputs if "image/png" not in output.get("data", {})]


def run(path, write):
    """Runs a notebook, and returns what is wrong with it."""
    notebook = json.loads(path.read_text(encoding="utf-8"))
    names, faults = {"__name__": "__main__"}, []
    for number, cell in enumerate((cell for cell in notebook["cells"] if cell["cell_type"] == "code"), 1):
        outputs = outputs_of(source_of(cell), names, number)
        if not write and compared(outputs) != compared(cell["outputs"]):
            faults.append(f"{path.name}: cell {number} gives\n{json.dumps(compared(outputs))[:2000]}\nbut the notebook has\n"
                          f"{json.dumps(compared(cell['outputs']))[:2000]}")
        cell["outputs"], cell["execution_count"] = outputs, number
    if write:
        path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return faults


def run_by_jupyter(path):
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(path, as_version=4)
    nbformat.validate(notebook)
    NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": str(HERE)}}).execute()
    return []


def main():
    options = [word for word in sys.argv[1:] if word.startswith("-")]
    paths = [Path(word).resolve() for word in sys.argv[1:] if not word.startswith("-")] or sorted(HERE.glob("*.ipynb"))
    by_jupyter = "--jupyter" in options
    if by_jupyter and any(importlib.util.find_spec(name) is None for name in ("nbclient", "ipykernel")):
        print("notebooks left out: nbclient or ipykernel is missing")
        return None
    os.chdir(HERE)
    os.environ["MPLBACKEND"] = os.environ.get("MPLBACKEND", "Agg") if not by_jupyter else "module://matplotlib_inline.backend_inline"
    faults = []
    for path in paths:
        missing = missing_of(json.loads(path.read_text(encoding="utf-8")))
        if missing:
            print(f"{path.name}: left out: {', '.join(missing)} is missing")
            continue
        faults += run_by_jupyter(path) if by_jupyter else run(path, "--write" in options)
        print(f"{path.name}: ran")
    return "\n".join(faults) or None


if __name__ == "__main__":
    sys.exit(main())
