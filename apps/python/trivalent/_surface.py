"""Surfaces: what a shell is built on, out of files, formulas, arrays and other libraries' meshes."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import InvalidArray, InvalidOption

_max_numbers = 1_000_000_000

#: A path, a built-in shape ("torus:R=3,r=1"), "formula:" and a formula of x, y and z, a Surface, arrays
#: (vertices, faces) or (vertices, faces, cell), or any object with .vertices and .faces (trimesh), .points and .faces
#: or .cells (PyVista, meshio).
SurfaceLike = Any

#: Lengths a or (a, b, c) or (a, b, c, alpha, beta, gamma) with angles in degree, cell vectors as three rows, or a text
#: such as "2*pi" or "3,3,5,90,90,120".
CellLike = Any


class Surface:
    """A sound triangle mesh: an oriented 2-manifold, open or closed."""

    def __init__(self, core: _core.Surface, report: dict[str, Any] | None = None) -> None:
        self._core = core
        self.report: dict[str, Any] = {} if report is None else report
        """How it came about, as the program's JSON says it; empty if it was only read."""

    @property
    def vertices(self) -> npt.NDArray[np.float64]:
        """Positions, shape (n, 3), in the unit of the input; [Å] for the surface of a shell. Read-only."""
        return self._core.vertices

    @property
    def faces(self) -> npt.NDArray[np.int32]:
        """Corners of each triangle, shape (m, 3): indices of vertices, counter-clockwise seen from outside."""
        return self._core.faces

    @property
    def cell(self) -> npt.NDArray[np.float64]:
        """Cell vectors, shape (3, 3), one per row, in the unit of the vertices; zero for a free surface."""
        return self._core.cell

    @property
    def pbc(self) -> npt.NDArray[np.bool_]:
        """Whether the surface is periodic along each cell vector, shape (3,). Edges lead to nearest images."""
        return np.array(self._core.pbc, dtype=bool)

    @property
    def notes(self) -> list[str]:
        """What was changed on the way in, one sentence each."""
        return self._core.notes

    @property
    def wrap_offset(self) -> float:
        """Distance from the input to its wrap, in the unit of the input; 0 if it was not wrapped."""
        return self._core.wrap_offset

    def write(self, path: str | os.PathLike[str]) -> None:
        """Writes OFF, OBJ, PLY or STL, by extension; lengths in the surface's own unit."""
        self._core.write(os.fspath(path))

    def __repr__(self) -> str:
        return f"<trivalent.Surface of {len(self.vertices)} vertices and {len(self._core.faces)} faces>"


if TYPE_CHECKING:
    #: What _core takes: a text, or points and arrays of faces.
    _Source = str | _core.Surface | tuple[Any, list[Any]]


def source_of(surface: SurfaceLike) -> _Source:
    """The surface as _core takes it."""
    if isinstance(surface, (str, os.PathLike)):
        return os.fspath(surface)
    if isinstance(surface, Surface):
        return surface._core
    if isinstance(surface, tuple):
        return _source_of_tuple(surface)
    faces = getattr(surface, "faces", None)
    vertices = getattr(surface, "vertices", None)
    points = getattr(surface, "points", None)
    if vertices is not None and faces is not None:
        return (vertices, _face_arrays(faces))
    if points is not None and faces is not None:
        return (points, _face_arrays(faces))
    if points is not None and hasattr(surface, "cells"):
        return (points, _cell_arrays(surface))
    raise InvalidOption(
        f"a surface is a path, a built-in shape, (vertices, faces), or an object with .vertices and .faces "
        f"or .points and .cells, not {type(surface).__name__}"
    )


def name_of(surface: SurfaceLike) -> str:
    """What reports call the surface."""
    if isinstance(surface, (str, os.PathLike)):
        return os.fspath(surface)
    return "arrays" if isinstance(surface, tuple) else type(surface).__name__


def cell_of(surface: SurfaceLike, cell: CellLike | None) -> str | list[list[float]] | None:
    """The cell as _core takes it: of the option, or else of (vertices, faces, cell)."""
    if cell is None and isinstance(surface, tuple) and len(surface) == 3:
        cell = surface[2]
    if cell is None or isinstance(cell, str):
        return cell
    try:
        numbers = np.asarray(cell, dtype=float)
    except (TypeError, ValueError):
        numbers = np.empty((0, 0))
    if numbers.shape == (3, 3):
        return [[float(x) for x in row] for row in numbers]
    if numbers.ndim == 0 or numbers.shape in ((1,), (3,), (6,)):
        return ",".join(repr(float(x)) for x in numbers.ravel())
    raise InvalidOption("a cell is a, (a, b, c), (a, b, c, alpha, beta, gamma), three rows of vectors, or a text of these")


def _source_of_tuple(surface: tuple[Any, ...]) -> _Source:
    if len(surface) not in (2, 3):
        raise InvalidOption(f"a surface is (vertices, faces), not a tuple of {len(surface)}")
    return (surface[0], _face_arrays(surface[1]))


def _face_arrays(faces: Any) -> list[Any]:
    """Faces as a list of arrays, one per number of corners."""
    try:
        array = np.asarray(faces)
    except ValueError as error:
        raise InvalidArray(f"faces: {error}") from None
    if array.ndim == 1 and array.dtype.kind in "iu" and array.size > 0:
        return _padded_faces(array)
    return [array]


def _padded_faces(array: npt.NDArray[Any]) -> list[Any]:
    """VTK's way: the number of corners before each face's."""
    if array.size > _max_numbers:
        raise InvalidArray(f"faces: {array.size} numbers are more than a surface can have")
    width = int(array[0]) + 1
    if width > 1 and array.size % width == 0 and bool((array[::width] == width - 1).all()):
        return [array.reshape(-1, width)[:, 1:]]
    faces = []
    begin = 0
    while begin < array.size:
        end = begin + 1 + int(array[begin])
        if not begin + 3 < end <= array.size:
            raise InvalidArray("faces: the shape must be (n, 3), or VTK's list of faces with their sizes")
        faces.append(array[np.newaxis, begin + 1 : end])
        begin = end
    return faces


def _cell_arrays(mesh: Any) -> list[Any]:
    """The faces among the cells of meshio and PyVista."""
    vtk_triangle, vtk_quad = 5, 9
    by_type = getattr(mesh, "cells_dict", None)
    if not isinstance(by_type, dict):
        by_type = {getattr(block, "type", None): getattr(block, "data", None) for block in mesh.cells}
    faces = [by_type[name] for name in ("triangle", "quad", vtk_triangle, vtk_quad) if name in by_type]
    if not faces:
        raise InvalidArray(f"cells: there are no triangles or quads among {', '.join(map(str, by_type))}")
    return faces
