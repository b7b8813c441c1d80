"""ASE calculators: forces and stresses are derivatives of the energy, and ASE's optimizers work."""

import ase.build
import numpy as np
import pytest
from ase import Atoms
from ase.calculators.test import numeric_force
from ase.constraints import ExpCellFilter
from ase.optimize import BFGS

import trivalent
from trivalent.ase import AIREBO, REBO, LennardJones

# Shaken by much less than a bond, so that no pair is near an end of a range.
shake = 0.03


def shaken(atoms: Atoms, seed: int = 1) -> Atoms:
    atoms.positions += np.random.default_rng(seed).normal(scale=shake, size=atoms.positions.shape)
    return atoms


def triclinic() -> Atoms:
    atoms = ase.build.graphene(size=(3, 3, 1), vacuum=5.0)
    atoms.set_cell(atoms.cell.array @ np.array([[1, 0.02, 0.01], [0.03, 0.98, 0.02], [0.01, 0.04, 1.0]]), scale_atoms=True)
    atoms.pbc = True
    return shaken(atoms)


def capped_ring() -> Atoms:
    return shaken(ase.build.molecule("C6H6", vacuum=6.0, pbc=True))


def tube() -> Atoms:
    return shaken(ase.build.nanotube(5, 0, length=2, vacuum=6.0))


structures = {"free": lambda: shaken(ase.build.molecule("C60")), "periodic": tube, "triclinic": triclinic, "CH": capped_ring}
calculators = {"rebo": REBO, "airebo": AIREBO, "lj": lambda: LennardJones(shift=True)}


@pytest.mark.parametrize("structure", structures)
@pytest.mark.parametrize("potential", calculators)
def test_forces_are_minus_the_gradient_of_the_energy(structure: str, potential: str) -> None:
    atoms = structures[structure]()
    atoms.calc = calculators[potential]()
    forces = atoms.get_forces()
    scale = max(1.0, np.abs(forces).max())
    for atom in range(0, len(atoms), max(1, len(atoms) // 6)):
        numeric = [numeric_force(atoms, atom, axis, d=1e-5) for axis in range(3)]
        assert forces[atom] == pytest.approx(numeric, abs=1e-6 * scale)


@pytest.mark.parametrize("structure", ["periodic", "triclinic", "CH"])
@pytest.mark.parametrize("potential", calculators)
def test_stress_is_the_derivative_by_strain(structure: str, potential: str) -> None:
    atoms = structures[structure]()
    atoms.pbc = True
    atoms.calc = calculators[potential]()
    numeric = atoms.calc.calculate_numerical_stress(atoms, d=1e-6)
    stress = atoms.get_stress()
    assert stress == pytest.approx(numeric, abs=1e-6 * max(1.0, np.abs(stress).max()))


def test_energies_sum_to_the_energy() -> None:
    atoms = capped_ring()
    atoms.calc = REBO()
    assert atoms.get_potential_energies().sum() == pytest.approx(atoms.get_potential_energy(), abs=1e-10)
    assert atoms.get_potential_energy(force_consistent=True) == atoms.get_potential_energy()


def test_graphene_has_its_energy() -> None:
    atoms = ase.build.graphene(a=1.42 * 3**0.5, vacuum=5.0)
    atoms.calc = REBO()
    # -7.3949 eV for each atom [Brenner2002].
    assert atoms.get_potential_energy() / 2 == pytest.approx(trivalent.graphene_energy, abs=1e-3)


def test_neighbors_follow_atoms_that_move() -> None:
    atoms = tube()
    kept = REBO()
    atoms.calc = kept
    for _ in range(5):
        atoms.positions += np.random.default_rng(7).normal(scale=0.1, size=atoms.positions.shape)
        fresh = atoms.copy()
        fresh.calc = REBO()
        assert atoms.get_potential_energy() == pytest.approx(fresh.get_potential_energy(), abs=1e-9)


def test_free_atoms_have_no_stress() -> None:
    atoms = ase.build.molecule("C60")
    atoms.calc = REBO()
    atoms.get_forces()
    assert "stress" not in atoms.calc.results


def test_elements_other_than_carbon_and_hydrogen_are_refused() -> None:
    atoms = ase.build.molecule("H2O")
    atoms.calc = REBO()
    with pytest.raises(trivalent.InvalidArray, match="atomic number 8"):
        atoms.get_potential_energy()


def test_bfgs_and_relax_find_the_same_rest() -> None:
    for atoms in (shaken(ase.build.molecule("C60")), tube()):
        own = trivalent.relax(atoms, max_force=1e-5)
        atoms.calc = REBO()
        assert BFGS(atoms, logfile=None).run(fmax=1e-4, steps=2000)
        assert own.energy / len(atoms) == pytest.approx(atoms.get_potential_energy() / len(atoms), abs=1e-7)


def test_cells_relax_as_ours_do() -> None:
    atoms = ase.build.graphene(size=(2, 2, 1), a=2.5, vacuum=5.0)
    atoms.pbc = True
    own = trivalent.relax(atoms, relax_box=True, max_force=1e-6)
    atoms.calc = REBO()
    # Only within the plane: nothing holds the cell along z.
    BFGS(ExpCellFilter(atoms, mask=[1, 1, 0, 0, 0, 1]), logfile=None).run(fmax=1e-6, steps=500)
    assert own.cell[:2, :2] == pytest.approx(atoms.cell.array[:2, :2], abs=1e-4)
    assert own.energy == pytest.approx(atoms.get_potential_energy(), abs=1e-6)
