"""What the tests have in common: the program, real meshes, and a folder."""

import os
import pathlib
import subprocess
from typing import Callable

import pytest


@pytest.fixture(scope="session")
def meshes() -> pathlib.Path:
    """The example meshes of CGAL."""
    return pathlib.Path(os.environ["TRIVALENT_MESHES"])


@pytest.fixture(scope="session")
def program() -> Callable[..., str]:
    """Runs the program `trivalent` and returns what it printed."""

    def run(*words: object) -> str:
        command = [os.environ["TRIVALENT_PROGRAM"], *map(str, words)]
        return subprocess.run(command, check=True, capture_output=True, text=True).stdout

    return run
