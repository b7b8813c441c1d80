"""Pages and pictures of shells."""

from __future__ import annotations

import html
import os
from typing import TYPE_CHECKING, Literal

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import InvalidOption
from ._shell import ShellLike, shell_of
from ._surface import Surface, SurfaceLike
from ._workflows import _given, _repair

if TYPE_CHECKING:
    from collections.abc import Sequence as _Sequence
    from ._workflows import _Potential

    _Color = Literal[
        "energy", "excess_energy", "ring_size", "coordination", "bond_strain", "pyramidalization", "displacement"
    ]


class Page:
    """A page that shows shells in 3D; a notebook shows it, a browser opens it from disk."""

    def __init__(self, text: str) -> None:
        self.html = text

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the page into a file, .html."""
        with open(path, "w", encoding="utf-8", newline="") as file:
            file.write(self.html)

    def _repr_html_(self) -> str:
        return f'<iframe srcdoc="{html.escape(self.html)}" style="width: 100%; height: 480px; border: 0"></iframe>'


class Picture:
    """A picture of shells; a notebook shows it."""

    def __init__(self, core: _core.Picture) -> None:
        self._core = core

    @property
    def pixels(self) -> npt.NDArray[np.uint8]:
        """Red, green and blue (0 to 255), shape (height, width, 3), in units of the screen. Read-only."""
        return self._core.pixels

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes the picture into a file, .png."""
        with open(path, "wb") as file:
            file.write(self._core.png())

    def _repr_png_(self) -> bytes:
        return self._core.png()


def view(
    *shells: ShellLike,
    names: _Sequence[str] | None = None,
    title: str | None = None,
    surface: SurfaceLike | None = None,
    potential: _Potential = "rebo",
    lj_epsilon: float | None = None,
    lj_sigma: float | None = None,
    lj_cutoff: float | None = None,
    lj_shift: bool | None = None,
) -> Page:
    """A page that shows atoms in 3D, colored by energy [eV] and more; several shells are states to compare.

    names: what to call the shells, one each
    title: heading of the page
    surface: a surface in Å to be shown as a ghost
    potential, lj_...: as in `energy`
    """
    options = _given(locals())
    mesh = None if surface is None else surface if isinstance(surface, Surface) else _repair(surface)
    return Page(_core.view(_states(shells, names), None if mesh is None else mesh._core, options).decode())


def render(
    *shells: ShellLike,
    names: _Sequence[str] | None = None,
    color: _Color = "energy",
    style: Literal["atoms", "rings"] = "atoms",
    size: tuple[int, int] = (1200, 900),
    azimuth: float = -30.0,
    elevation: float = 18.0,
    roll: float = 0.0,
    zoom: float = 1.0,
    low: float | None = None,
    high: float | None = None,
    dark: bool = False,
    potential: _Potential = "rebo",
    lj_epsilon: float | None = None,
    lj_sigma: float | None = None,
    lj_cutoff: float | None = None,
    lj_shift: bool | None = None,
) -> Picture:
    """Draws atoms as a picture, colored by energy [eV] and more; several shells stand side by side.

    names: what to call the shells, one each
    color: "energy" [eV], "excess_energy" [eV], "ring_size", "coordination", "bond_strain", "pyramidalization" [degree]
        or "displacement" [Å]
    style: "atoms" draws balls and sticks, "rings" polygons
    size: width and height [pixel]
    azimuth, elevation, roll: turn about the vertical y axis, then tilt towards the viewer, then turn in the picture
        [degree]
    zoom: 1 fits the whole shell
    low, high: ends of the color scale, in the unit of the color; None: from the values
    dark: draw on a dark background
    potential, lj_...: as in `energy`
    """
    options = {**_given(locals()), "width": size[0], "height": size[1]}
    return Picture(_core.render(_states(shells, names), options))


def _states(shells: _Sequence[ShellLike], names: _Sequence[str] | None) -> list[tuple[str, _core.Structure]]:
    if names is None:
        names = [
            os.path.basename(shell) if isinstance(shell, (str, os.PathLike)) else f"shell {i}"
            for i, shell in enumerate(shells, 1)
        ]
    if len(names) != len(shells) or not shells:
        raise InvalidOption("names: there must be one for every shell, and at least one shell")
    return [(name, shell_of(shell, {})._core) for name, shell in zip(names, shells)]
