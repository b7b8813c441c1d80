"""Shells: atoms and all that is known of them."""

from __future__ import annotations

import html
import os
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from . import _core
from ._errors import Error, InvalidArray
from ._surface import Surface

if TYPE_CHECKING:
    from collections.abc import Mapping as _Mapping, Sequence as _Sequence
    import ase as _ase

    _Digits = Literal["decimals", "17"]
    _AtomStyle = Literal["atomic", "molecular"]
    _Periodic = bool | _Sequence[bool]

#: A Shell, a path to a file of atoms or a mesh (whose dual is taken), a Surface, or ASE's Atoms.
ShellLike = Any

_numbers = {"C": 6, "H": 1}
_symbols = {6: "C", 1: "H"}


class Shell:
    """Atoms, their box, bonds, rings and values; a shell from `build`, or any atoms of carbon and hydrogen.

    Arrays are read-only views of the shell's own memory, not copies; they stay valid when the shell is gone.
    """

    def __init__(
        self,
        positions: npt.ArrayLike,
        species: _Sequence[str] | npt.ArrayLike | None = None,
        *,
        cell: npt.ArrayLike | None = None,
        pbc: _Periodic | None = None,
        bonds: npt.ArrayLike | None = None,
    ) -> None:
        """Atoms out of arrays.

        positions: [Å], shape (n, 3)
        species: symbols ("C", "H") or atomic numbers, one per atom; None: all carbon
        cell: cell vectors as rows [Å], shape (3, 3), or three lengths [Å]; None: no cell
        pbc: which cell vectors are periodic; None: all if there is a cell
        bonds: pairs of atoms, shape (m, 2), each once, to the nearest image; None: unknown
        """
        array = _array(positions, "positions")
        self._core = _core.Structure(
            array, _numbers_of(species, len(array)), _cell_of(cell), _pbc_of(pbc, cell is not None), bonds
        )
        self.report: dict[str, Any] = {}
        """How it came about, as the program's report.json says it; empty if it was only read."""
        self.notes: list[str] = []
        """What was found on the way, one sentence each."""
        self._surface: Surface | None = None

    @classmethod
    def _of(
        cls,
        core: _core.Structure,
        report: dict[str, Any] | None = None,
        notes: _Sequence[str] = (),
        surface: Surface | None = None,
    ) -> Shell:
        shell = cls.__new__(cls)
        shell._core = core
        shell.report = {} if report is None else report
        shell.notes = list(notes)
        shell._surface = surface
        return shell

    @property
    def positions(self) -> npt.NDArray[np.float64]:
        """[Å], shape (n, 3)."""
        return self._core.positions

    @property
    def numbers(self) -> npt.NDArray[np.int32]:
        """Atomic numbers, shape (n,)."""
        return self._core.numbers

    @property
    def species(self) -> npt.NDArray[np.str_]:
        """Symbols of the elements, "C" or "H", shape (n,)."""
        return np.where(self._core.numbers == 6, "C", "H")

    @property
    def cell(self) -> npt.NDArray[np.float64]:
        """Cell vectors as rows [Å], shape (3, 3); zero without a cell."""
        return self._core.cell

    @property
    def origin(self) -> npt.NDArray[np.float64]:
        """Lower corner of the cell [Å], shape (3,)."""
        return self._core.origin

    @property
    def pbc(self) -> npt.NDArray[np.bool_]:
        """Which cell vectors are periodic, shape (3,)."""
        return np.array(self._core.pbc, dtype=bool)

    @property
    def bonds(self) -> npt.NDArray[np.uint32]:
        """Pairs of atoms, each bond once, shape (m, 2); empty if unknown."""
        return self._core.bonds

    @property
    def bond_images(self) -> npt.NDArray[np.int32]:
        """How many cell vectors lie between a bond's second atom and where the bond ends, shape (m, 3)."""
        return self._core.bond_images

    @property
    def rings(self) -> list[npt.NDArray[np.int32]]:
        """Atoms in order around each ring; empty if unknown."""
        return self._core.rings

    @property
    def columns(self) -> dict[str, npt.NDArray[Any]]:
        """All values per atom by name, shape (n,) or (n, 3): energies [eV], forces [eV/Å], displacement [Å], ..."""
        return self._core.columns

    @property
    def header(self) -> dict[str, Any]:
        """Values of the whole by name: energy [eV] and what a file says."""
        return self._core.header

    @property
    def energies(self) -> npt.NDArray[np.float64]:
        """Of the atoms [eV], shape (n,). Raises Error if unknown; `trivalent.energy` evaluates them."""
        return self._column("energies")

    @property
    def forces(self) -> npt.NDArray[np.float64]:
        """On the atoms [eV/Å], shape (n, 3). Raises Error if unknown; `trivalent.energy` evaluates them."""
        return self._column("forces")

    @property
    def energy(self) -> float:
        """Total potential energy [eV]. Raises Error if unknown; `trivalent.energy` evaluates it."""
        energy = self._core.header.get("energy")
        if energy is None:
            raise Error("the shell has no energy yet; trivalent.energy() evaluates it")
        return float(energy)

    @property
    def surface(self) -> Surface:
        """The surface that the shell is the dual of [Å]. Raises Error if it was not built."""
        if self._surface is None:
            raise Error("the shell has no surface: it does not come from trivalent.build()")
        return self._surface

    def write(
        self, path: str | os.PathLike[str], *, digits: _Digits = "decimals", atom_style: _AtomStyle = "atomic"
    ) -> list[str]:
        """Writes the atoms [Å, eV] into a file, by extension: .extxyz, .xyz or .data (LAMMPS).

        digits: "decimals" for ten decimals, "17" for 17 significant digits, which keep every bit
        atom_style: of LAMMPS data: "atomic", or "molecular" with the bonds

        Returns notes on what the format changes, such as a rotation to LAMMPS's frame; usually none.
        """
        return _core.write(self._core, os.fspath(path), {"digits": digits, "atom_style": atom_style})

    def to_ase(self) -> _ase.Atoms:
        """ASE's Atoms [Å] with all columns as arrays; energy [eV] and forces [eV/Å] in a calculator."""
        from ase import Atoms
        from ase.calculators.singlepoint import SinglePointCalculator

        cell = self.cell if self.cell.any() else None
        atoms = Atoms(numbers=self.numbers, positions=self.positions, cell=cell, pbc=self.pbc)
        columns = self.columns
        known = {name: columns.pop(name) for name in ("energies", "forces") if name in columns}
        for name, values in columns.items():
            atoms.set_array(name, values)
        if "energy" in self.header and known:
            atoms.calc = SinglePointCalculator(atoms, energy=self.energy, **known)
        return atoms

    @classmethod
    def from_ase(cls, atoms: _ase.Atoms) -> Shell:
        """The atoms [Å] of ASE's Atoms with their cell and arrays; energies and forces are left behind."""
        cell = np.asarray(atoms.cell)
        core = _core.Structure(
            atoms.positions, atoms.numbers, cell if cell.any() else None, [bool(each) for each in atoms.pbc], None
        )
        kept = {
            name: values
            for name, values in atoms.arrays.items()
            if name not in ("numbers", "positions") and _is_column(values)
        }
        return cls._of(core.with_columns(kept))

    def __len__(self) -> int:
        return len(self._core.positions)

    def __repr__(self) -> str:
        rings = f", {len(self._core.rings)} rings" if self._core.rings else ""
        has_energy = "energy" in self._core.header and len(self) > 0
        per_atom = f", {self.energy / len(self):.4f} eV/atom" if has_energy else ""
        return f"<trivalent.Shell of {len(self)} atoms, {len(self.bonds)} bonds{rings}{per_atom}>"

    def _repr_html_(self) -> str:
        page = html.escape(_core.view([("shell", self._core)], None, {}).decode())
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 480px; border: 0"></iframe>'

    def _repr_png_(self) -> bytes:
        return _core.render([("shell", self._core)], {"width": 640, "height": 480}).png()

    def _column(self, name: str) -> npt.NDArray[Any]:
        columns = self._core.columns
        if name not in columns:
            raise Error(f"the shell has no {name} yet; trivalent.energy() evaluates them")
        return columns[name]


def shell_of(source: ShellLike, size: _Mapping[str, Any]) -> Shell:
    """Atoms out of whatever holds some.

    size: bond, length or scale of the dual of a mesh, and periodic
    """
    if isinstance(source, Shell):
        return source
    if isinstance(source, (str, os.PathLike)):
        core, notes = _core.read(os.fspath(source), dict(size))
        return Shell._of(core, notes=notes)
    if isinstance(source, Surface):
        return Shell._of(_core.dual(source._core, dict(size)))
    if all(hasattr(source, name) for name in ("positions", "numbers", "cell", "pbc", "arrays")):
        return Shell.from_ase(source)
    raise InvalidArray(f"atoms are a Shell, a path, a Surface or ASE's Atoms, not {type(source).__name__}")


def _array(values: npt.ArrayLike, name: str) -> npt.NDArray[Any]:
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise InvalidArray(f"{name}: {error}") from None
    if array.ndim == 0:
        raise InvalidArray(f"{name}: not an array of numbers")
    return array


def _numbers_of(species: Any, n_atoms: int) -> npt.NDArray[Any]:
    if species is None:
        return np.full(n_atoms, 6)
    array = _array(list(species) if isinstance(species, str) else species, "species")
    if array.dtype.kind != "U":
        return array
    unknown = set(array.ravel().tolist()) - set(_numbers)
    if unknown:
        raise InvalidArray(f"species: only C and H are known, not {', '.join(sorted(unknown))}")
    return np.where(array == "C", 6, 1)


def _cell_of(cell: Any) -> Any:
    if cell is None:
        return None
    array = _array(cell, "cell")
    return np.diag(array) if array.shape == (3,) else array


def _pbc_of(pbc: _Periodic | None, has_cell: bool) -> list[bool]:
    if pbc is None:
        return [has_cell] * 3
    if isinstance(pbc, (bool, np.bool_)):
        return [bool(pbc)] * 3
    try:
        flags = [bool(each) for each in pbc]
    except (TypeError, ValueError):
        flags = []
    if len(flags) != 3:
        raise InvalidArray("pbc: a bool, or three of them")
    return flags


def _is_column(values: npt.NDArray[Any]) -> bool:
    return values.dtype.kind in "iuf" and (values.ndim == 1 or values.shape[1:] == (3,))
