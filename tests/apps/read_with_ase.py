"""Reads the results of `trivalent build` with ASE and compares them with each other.

Usage: python3 read_with_ase.py FOLDER
"""
import json
import sys

import ase.io
import numpy as np

folder = sys.argv[1]
report = json.load(open(folder + "/report.json"))
shell = ase.io.read(folder + "/shell.extxyz")
data = ase.io.read(folder + "/shell.data", format="lammps-data", style="atomic", Z_of_type={1: 6})
rows = [line.split() for line in open(folder + "/shell.extxyz").readlines()[2:]]

assert len(shell) == len(data) == report["network"]["atoms"]
assert set(shell.get_chemical_symbols()) == {"C"}
assert np.array_equal(shell.positions, np.array([row[1:4] for row in rows], dtype=float))
assert not shell.pbc.any()

after = report["energy"]["after"]
energies = shell.get_potential_energies()
assert abs(shell.get_potential_energy() - after["energy"]) < 1e-9
assert abs(energies.sum() - after["energy"]) < 1e-9 * len(shell)  # 10 decimals per atom
assert abs(energies.max() - after["highest"]) < 1e-9
assert shell.get_forces().shape == (len(shell), 3)
assert abs(shell.get_forces().sum(axis=0)).max() < 1e-6

assert (shell.arrays["coordination"] == 3).all()
rings = shell.arrays["rings"]
assert rings.shape == (len(shell), 3)
assert (np.diff(rings, axis=1) <= 0).all()  # largest first
sizes = report["network"]["ring_sizes"]
assert {int(size): count * int(size) for size, count in sizes.items()} == dict(
    zip(*(column.tolist() for column in np.unique(rings, return_counts=True))))

# The data file's box has its corner at the origin for ASE; distances do not care.
assert np.allclose(data.positions - data.positions[0], shell.positions - shell.positions[0], atol=2e-9)
inside = shell.positions - np.array(shell.info["Origin"])
assert (inside > 5.0).all() and (inside < shell.cell.lengths() - 5.0).all()
