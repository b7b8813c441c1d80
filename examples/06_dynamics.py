"""C60 at constant energy: molecular dynamics by ASE, forces by trivalent."""

import ase.build
import ase.units
import numpy as np
from ase.md.velocitydistribution import MaxwellBoltzmannDistribution, Stationary
from ase.md.verlet import VelocityVerlet

import trivalent
import trivalent.ase

atoms = trivalent.relax(ase.build.molecule("C60")).to_ase()
atoms.calc = trivalent.ase.REBO()
MaxwellBoltzmannDistribution(atoms, temperature_K=600, rng=np.random.default_rng(1))
Stationary(atoms)

dynamics = VelocityVerlet(atoms, timestep=0.25 * ase.units.fs)
energies = []
dynamics.attach(lambda: energies.append(atoms.get_total_energy() / len(atoms)), interval=10)
dynamics.run(1000)

drift = max(energies) - min(energies)
print(f"0.25 ps: total energy {energies[0]:.5f} eV/atom, within {1e6 * drift:.1f} µeV/atom")
assert drift < 1e-4
