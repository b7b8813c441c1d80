"""The stiffness of a periodic carbon tube along its axis, by straining its cell."""

import ase.build
import numpy as np
from ase.optimize import BFGS

import trivalent
import trivalent.ase

tube = ase.build.nanotube(10, 0, length=2, vacuum=8.0)
tube.pbc = True
rest = trivalent.relax(tube, relax_box=True, max_force=1e-5)
length = rest.cell[2, 2]  # [Å]
radius = np.linalg.norm(rest.positions[:, :2] - rest.positions[:, :2].mean(axis=0), axis=1).mean()

strains = np.linspace(-0.01, 0.01, 5)
energies = []  # [eV]
for strain in strains:
    atoms = rest.to_ase()
    atoms.calc = trivalent.ase.REBO()
    cell = atoms.cell.array.copy()
    cell[2, 2] = length * (1 + strain)
    atoms.set_cell(cell, scale_atoms=True)
    BFGS(atoms, logfile=None).run(fmax=1e-4, steps=500)
    energies.append(atoms.get_potential_energy())

curvature = 2 * np.polyfit(strains, energies, 2)[0]  # d²E/dε² [eV]
stiffness = curvature / (2 * np.pi * radius * length)  # [eV/Å²], per area of the wall
print(f"tube of radius {radius:.2f} Å: {16.0218 * stiffness:.0f} N/m along its axis (graphene under REBO: about 240)")
assert 150 < 16.0218 * stiffness < 350
