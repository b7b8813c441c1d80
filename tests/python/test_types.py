"""The types are complete: examples pass mypy --strict, and the stubs are those of the module."""

import os
import pathlib
import subprocess
import sys

import pytest

pytest.importorskip("mypy")
root = pathlib.Path(__file__).parents[2]


def run(module: str, *words: object) -> None:
    environment = {**os.environ, "MYPYPATH": os.environ["PYTHONPATH"]}
    command = [sys.executable, "-m", module, *map(str, words)]
    result = subprocess.run(command, cwd=root, env=environment, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr


def test_the_package_and_the_examples_are_strictly_typed(tmp_path: pathlib.Path) -> None:
    paths = [root / "apps/python/trivalent", *sorted((root / "examples").glob("*.py"))]
    for path in paths:
        run("mypy", "--strict", "--config-file", root / "pyproject.toml", "--cache-dir", tmp_path, path)


def test_the_stubs_are_complete() -> None:
    run("mypy.stubtest", "--mypy-config-file", root / "pyproject.toml", "trivalent")
