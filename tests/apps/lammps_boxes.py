#!/usr/bin/env python3
"""Boxes that LAMMPS does not take as they are: rotated, left-handed, tilted, partly periodic.

The same energies, forces and positions must come back from LAMMPS, and the folder of
`trivalent lammps` must pass its own check.

    lammps_boxes.py TRIVALENT LMP [--count 30]
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy


def graphene(random):
    a = 2.46
    cell = numpy.array([[a, 0, 0], [-a / 2, a / 2 * 3**0.5, 0], [0, 0, 16.0]])
    atoms = [
        i * cell[0] + j * cell[1] + b * (cell[0] + 2 * cell[1]) / 3 + [0, 0, 7]
        for i in range(3)
        for j in range(4)
        for b in (0, 1)
    ]
    return numpy.array(atoms), cell * [[3], [4], [1]], [True, True, False]


def diamond(random):
    cell = 1.785 * numpy.array([[0.0, 1, 1], [1, 0, 1], [1, 1, 0]])
    atoms = [
        i * cell[0] + j * cell[1] + k * cell[2] + b * cell.sum(0) / 4
        for i in range(3)
        for j in range(2)
        for k in range(2)
        for b in (0, 1)
    ]
    return numpy.array(atoms), cell * [[3], [2], [2]], [True, True, True]


def tube(random):
    """(10,0), periodic along its axis; ASE gives such tubes zero vectors across."""
    n, bond = 10, 1.42
    radius = n * bond * 3**0.5 / (2 * numpy.pi)
    atoms = []
    for ring, z in enumerate([0, 0.5 * bond, 1.5 * bond, 2 * bond]):
        for k in range(n):
            angle = 2 * numpy.pi / n * (k + (0.5 if ring in (1, 2) else 0))
            atoms.append([radius * numpy.cos(angle), radius * numpy.sin(angle), z])
    cell = numpy.zeros((3, 3))
    cell[2, 2] = 3 * bond
    return numpy.array(atoms), cell, [False, False, True]


def rotation(random):
    q, r = numpy.linalg.qr(random.standard_normal((3, 3)))
    q = q * numpy.sign(numpy.diag(r))
    return q if numpy.linalg.det(q) > 0 else -q


def variant(index):
    random = numpy.random.default_rng(index)
    atoms, cell, pbc = (graphene, diamond, tube)[index % 3](random)
    atoms = atoms + 0.03 * random.standard_normal(atoms.shape)
    for i in range(3):
        j = (i + 1) % 3
        if pbc[i] and pbc[j]:
            cell[i] = cell[i] + random.integers(-2, 3) * cell[j]
    for i in range(3):
        if random.random() < 0.3:
            cell[i] = -cell[i]
        if not pbc[i] and random.random() < 0.5:
            cell[i] = 0
    if random.random() < 0.3:
        order = [1, 2, 0]
        cell, pbc = cell[order], [pbc[i] for i in order]
    turn = rotation(random)
    return atoms @ turn.T, cell @ turn.T, pbc


def write(path, atoms, cell, pbc):
    text = " ".join(f"{x:.17g}" for x in cell.ravel())
    flags = " ".join("T" if p else "F" for p in pbc)
    rows = ["C " + " ".join(f"{x:.17g}" for x in p) for p in atoms]
    head = f'Lattice="{text}" Properties=species:S:1:pos:R:3 pbc="{flags}"'
    path.write_text("\n".join([str(len(atoms)), head, *rows, ""]))


def read(path):
    lines = path.read_text().splitlines()
    return numpy.array([[float(x) for x in line.split()[1:4]] for line in lines[2:]])


def check(arguments, index, folder):
    atoms, cell, pbc = variant(index)
    write(folder / "in.extxyz", atoms, cell, pbc)

    def run(*words):
        command = [arguments.trivalent, *words]
        done = subprocess.run(command, capture_output=True, text=True, cwd=folder, timeout=100)
        if done.returncode != 0:
            raise RuntimeError(" ".join(words) + ": " + done.stderr.strip())
        return json.loads(done.stdout)

    energy = ["energy", "in.extxyz", "--forces", "--json"]
    ours, theirs = run(*energy), run(*energy, "--engine", "lammps")
    difference = max(abs(a - b) for a, b in zip(ours["energies"], theirs["energies"]))
    if difference > 1e-10:
        raise RuntimeError(f"energies differ by {difference} eV")
    forces = numpy.abs(numpy.array(ours["forces"]) - theirs["forces"]).max()
    if forces > 1e-8:
        raise RuntimeError(f"forces differ by {forces} eV/Å")
    relax = ["relax", "in.extxyz", "-o", "out.extxyz", "--digits", "17", "--json"]
    run(*relax, "--engine", "lammps", "--fix", f"ids:1-{len(atoms)}")  # LAMMPS always makes a step
    moved = numpy.abs(read(folder / "out.extxyz") - atoms).max()
    if moved > 1e-9:
        raise RuntimeError(f"positions come back {moved} Å away")
    run("lammps", "in.extxyz", "-o", "deck", "--json")
    deck = subprocess.run([arguments.lmp, "-in", "in.check"], capture_output=True, text=True, cwd=folder / "deck")
    if deck.returncode != 0:
        raise RuntimeError("in.check fails: " + deck.stdout[-300:])


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("trivalent")
    arguments.add_argument("lmp")
    arguments.add_argument("--count", type=int, default=30)
    arguments = arguments.parse_args()
    arguments.trivalent = str(pathlib.Path(arguments.trivalent).resolve())
    n_faults = 0
    for index in range(arguments.count):
        with tempfile.TemporaryDirectory() as folder:
            try:
                check(arguments, index, pathlib.Path(folder))
            except RuntimeError as fault:
                n_faults += 1
                print(f"box {index}: {fault}")
    print(f"{arguments.count} boxes, {n_faults} faults")
    return 1 if n_faults else 0


if __name__ == "__main__":
    sys.exit(main())
