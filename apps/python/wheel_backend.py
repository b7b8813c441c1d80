"""Builds the wheel with CMake: what `pip install .` calls. Needs cmake, a compiler and the packages of
scripts/install_deps.sh; nothing is downloaded but the page's JavaScript (npm ci)."""

from __future__ import annotations

import os
import pathlib
import subprocess
import sys
import sysconfig
import tempfile
from typing import Any

from wheel.wheelfile import WheelFile

root = pathlib.Path(__file__).parents[2]


def _version() -> str:
    for line in (root / "pyproject.toml").read_text().splitlines():
        if line.startswith("version = "):
            return line.split('"')[1]
    raise ValueError("pyproject.toml tells no version")


def _install_package(folder: pathlib.Path) -> None:
    """Has CMake build the module and install it into a folder."""
    build = root / "build" / "wheel"
    configure = ["cmake", "-S", root, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"]
    configure += [f"-DTRIVALENT_PYTHON={sys.executable}", f"-DTRIVALENT_PYTHON_FOLDER={folder}"]
    configure += ["-DTRIVALENT_BUILD_TESTS=OFF", "-DTRIVALENT_WARNINGS_AS_ERRORS=OFF"]
    subprocess.run(configure, check=True)
    subprocess.run(["cmake", "--build", build, "--target", "trivalent_python"], check=True)
    subprocess.run(["cmake", "--install", build, "--component", "python", "--strip"], check=True)


def _write_metadata(folder: pathlib.Path, tag: str) -> None:
    folder.mkdir()
    (folder / "WHEEL").write_text(f"Wheel-Version: 1.0\nGenerator: trivalent\nRoot-Is-Purelib: false\nTag: {tag}\n")
    (folder / "METADATA").write_text(
        f"Metadata-Version: 2.1\nName: trivalent\nVersion: {_version()}\n"
        "Summary: Turns any surface into sp2 carbon\nLicense: GPL-3.0-or-later\nRequires-Python: >=3.9\n"
        "Requires-Dist: numpy\nProvides-Extra: ase\nRequires-Dist: ase; extra == 'ase'\n"
    )


def build_wheel(
    wheel_directory: str, config_settings: dict[str, Any] | None = None, metadata_directory: str | None = None
) -> str:
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    tag = f"{python}-{python}-{platform}"
    name = f"trivalent-{_version()}"
    with tempfile.TemporaryDirectory() as folder:
        _install_package(pathlib.Path(folder))
        _write_metadata(pathlib.Path(folder) / f"{name}.dist-info", tag)
        with WheelFile(os.path.join(wheel_directory, f"{name}-{tag}.whl"), "w") as wheel:
            wheel.write_files(folder)
    return f"{name}-{tag}.whl"
