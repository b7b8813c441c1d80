"""The examples run, and the notebook's cells."""

import json
import os
import pathlib
import subprocess
import sys

import pytest

examples = pathlib.Path(__file__).parents[2] / "examples"


@pytest.mark.parametrize("path", sorted(examples.glob("*.py")), ids=lambda path: path.name)
def test_examples_run(path: pathlib.Path, tmp_path: pathlib.Path) -> None:
    subprocess.run([sys.executable, path], check=True, cwd=tmp_path, env={**os.environ, "MPLCONFIGDIR": str(tmp_path)})


@pytest.mark.parametrize("path", sorted(examples.glob("*.ipynb")), ids=lambda path: path.name)
def test_notebooks_run(path: pathlib.Path) -> None:
    cells = json.loads(path.read_text())["cells"]
    names: dict[str, object] = {}
    for cell in cells:
        assert not cell.get("outputs"), "notebooks are kept without their outputs"
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), str(path), "exec"), names)
