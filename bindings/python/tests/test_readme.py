"""What the texts show runs."""

import pathlib
import re

import pytest

HERE = pathlib.Path(__file__).parents[1]
TEXTS = [HERE / "README.md", HERE.parents[1] / "README.md"]


@pytest.mark.parametrize("path", TEXTS, ids=lambda path: path.parent.name)
def test_snippets(path):
    if not path.exists():
        pytest.skip(f"there is no {path}")
    snippets = re.findall(r"```python\n(.*?)```", path.read_text(), re.S)
    assert snippets
    for snippet in snippets:
        names = {}
        exec(compile(snippet, str(path), "exec"), names)
        assert abs(names["points"][0] - [1, 1]).max() < 1e-12
