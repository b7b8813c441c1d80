"""ASE calculators: REBO, AIREBO and Lennard-Jones.

    atoms.calc = trivalent.ase.REBO()
    atoms.get_potential_energy()        # [eV]

Energies are in eV, forces in eV/Å, stresses in eV/Å³ in ASE's order and sign. Neighbors are kept from
one step to the next.
"""

from __future__ import annotations

import abc
from typing import TYPE_CHECKING, Any

import numpy as np
from ase import Atoms
from ase.calculators.calculator import Calculator, all_changes
from ase.stress import full_3x3_to_voigt_6_stress

from . import _core

if TYPE_CHECKING:
    from collections.abc import Sequence as _Sequence

__all__ = ["REBO", "AIREBO", "LennardJones"]


class _Potential(Calculator, metaclass=abc.ABCMeta):  # type: ignore[misc]
    """What the three have in common."""

    atoms: Any
    results: dict[str, Any]
    implemented_properties = ["energy", "free_energy", "energies", "forces", "stress"]

    def __init__(self, potential: _core.Calculator, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        self._potential = potential

    def reset(self) -> None:
        """Clears the results; the atoms' memory is kept for the next ones."""
        self.results = {}

    def check_state(self, atoms: Atoms, tol: float = 0.0) -> list[str]:
        """What has changed of the atoms, to the bit: faster than ASE's comparison within a tolerance."""
        known = self.atoms
        if known is None:
            return list(all_changes)
        pairs = {
            "positions": (known.positions, atoms.positions),
            "numbers": (known.numbers, atoms.numbers),
            "cell": (known.cell.array, atoms.cell.array),
            "pbc": (known.pbc, atoms.pbc),
        }
        return [name for name, (old, new) in pairs.items() if not _core.are_same_bytes(old, new)]

    def calculate(
        self,
        atoms: Atoms | None = None,
        properties: _Sequence[str] = ("energy",),
        system_changes: _Sequence[str] = all_changes,
    ) -> None:
        """Evaluates energy [eV], forces [eV/Å] and, if there is a cell, stress [eV/Å³], all at once."""
        if atoms is not None:
            if self.atoms is not None and list(system_changes) == ["positions"]:
                self.atoms.positions[:] = atoms.positions
            else:
                self.atoms = atoms.copy()
        cell = self.atoms.cell
        found = self._potential.evaluate(self.atoms.positions, self.atoms.numbers, cell.array, list(self.atoms.pbc))
        self.results = {
            "energy": found.energy,
            "free_energy": found.energy,
            "energies": found.energies,
            "forces": found.forces,
        }
        if cell.rank == 3:
            self.results["stress"] = full_3x3_to_voigt_6_stress(-found.virial / cell.volume)


class REBO(_Potential):
    """Second-generation REBO for carbon and hydrogen [Brenner2002], as LAMMPS's pair_style rebo.

    Energies [eV], forces [eV/Å], stress [eV/Å³].
    """

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(_core.Calculator("rebo"), **kwargs)


class AIREBO(_Potential):
    """AIREBO for carbon and hydrogen [Stuart2000], as LAMMPS's pair_style airebo 3.0 1 1.

    Energies [eV], forces [eV/Å], stress [eV/Å³].
    """

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(_core.Calculator("airebo"), **kwargs)


class LennardJones(_Potential):
    """Lennard-Jones between all pairs, bonded or not.

    epsilon: depth of the well [eV]; sigma: distance of zero energy [Å]; cutoff: range [Å];
    shift: subtract the energy at the cutoff, so that it is continuous there.
    """

    def __init__(
        self,
        epsilon: float = 0.00284,
        sigma: float = 3.4,
        cutoff: float = 10.2,
        shift: bool = False,
        **kwargs: Any,
    ) -> None:
        potential = _core.Calculator("lj", epsilon=epsilon, sigma=sigma, cutoff=cutoff, shift=shift)
        super().__init__(potential, **kwargs)


