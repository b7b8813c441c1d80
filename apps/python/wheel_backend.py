"""Builds the wheel with CMake: what `pip install .` calls. Needs cmake, a compiler and the packages of
scripts/install_deps.sh; nothing is downloaded but the page's JavaScript (npm ci).

    pip install . --no-build-isolation                                         # builds in build/wheel
    pip install . --no-build-isolation --config-settings build-dir=build/release  # uses a build tree that is there
"""

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


def _install_package(build: pathlib.Path, folder: str) -> pathlib.Path:
    """Has CMake build the module and install it below a folder; returns where the package then is."""
    if not (build / "CMakeCache.txt").exists():
        configure = ["cmake", "-S", str(root), "-B", str(build), "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"]
        configure += [f"-DTRIVALENT_PYTHON={_interpreter()}", "-DTRIVALENT_BUILD_TESTS=OFF"]
        configure += ["-DTRIVALENT_WARNINGS_AS_ERRORS=OFF"]
        configure += ["-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_UNITY_BUILD_BATCH_SIZE=16"]  # as the presets: half the time
        subprocess.run(configure, check=True)
    subprocess.run(["cmake", "--build", str(build), "--target", "trivalent_python"], check=True)
    install = ["cmake", "--install", str(build), "--component", "python", "--strip", "--prefix", folder]
    subprocess.run(install, check=True)
    return next(pathlib.Path(folder).rglob("trivalent")).parent


def _interpreter() -> str:
    """The Python that pip runs, not the environment around it: the module is for all of its kind."""
    return os.path.realpath(sys.executable)


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
        build = root / (config_settings or {}).get("build-dir", "build/wheel")
        packages = _install_package(build, folder)
        _write_metadata(packages / f"{name}.dist-info", tag)
        with WheelFile(os.path.join(wheel_directory, f"{name}-{tag}.whl"), "w") as wheel:
            wheel.write_files(str(packages))
    return f"{name}-{tag}.whl"
