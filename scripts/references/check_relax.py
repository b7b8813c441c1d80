#!/usr/bin/python3
"""Relaxes rattled structures with trivalent and with LAMMPS's minimizer and compares: see check_relax.sh."""
import argparse
import json
import os
import subprocess
import sys
import tempfile

import numpy as np
from ase.build import molecule
from ase.io import write

import lammps
import structures

TOLERANCE = 1e-4  # of the energy [eV/atom]
HYDROCARBONS = ("CH4", "C2H2", "C2H4", "C2H6", "C3H8", "C6H6", "isobutane", "butadiene", "cyclobutene", "trans-butane")
TUBES = ((5, 5, 4), (10, 0, 2), (6, 6, 3), (8, 0, 3))
SHEETS = ((4, 3), (6, 4), (5, 3))
MINIMIZE = ["min_style cg", "minimize 0 1e-6 3000 30000"]


def make(family, k):
    if family == "C60":
        return structures.fullerene_60(1)
    if family == "tube":
        return structures.nanotube(*TUBES[k % len(TUBES)])
    if family == "hydrocarbon":
        return molecule(HYDROCARBONS[k % len(HYDROCARBONS)])
    return structures.graphene(*SHEETS[k % len(SHEETS)])


def rattled(count):
    """(name, atoms): the families in turn, normal displacements of 0.05 to 0.25 Å along every axis."""
    families = ("C60", "tube", "hydrocarbon", "sheet")
    for n in range(count):
        family, k = families[n % len(families)], n // len(families)
        deviation = 0.05 + 0.20 * (k % 9) / 8
        yield f"{family}_{k:03d}_{round(1000 * deviation):03d}", structures.displaced(make(family, k), deviation, 1000 + n)


def lammps_energy(atoms):
    rows, _ = lammps.run(atoms, "rebo", ["compute e all pe/atom", *MINIMIZE, *lammps.DUMP, "run 0"])
    return rows[:, 3].sum()


def program_json(*words):
    done = subprocess.run(words, capture_output=True, text=True)
    try:
        return json.loads(done.stdout)
    except json.JSONDecodeError:
        raise RuntimeError(f"{' '.join(words)}: exit code {done.returncode}: {done.stderr.strip()}") from None


def compare(program, folder, name, atoms, theirs):
    start, end = f"{folder}/{name}.xyz", f"{folder}/{name}.out.extxyz"
    write(start, atoms, format="extxyz")
    result = program_json(program, "relax", start, "-o", end, "--digits", "17", "--json", "--quiet", "--threads", "1")
    again = program_json(program, "energy", end, "--forces", "--json", "--quiet")
    claimed, found = result["relaxation"]["largest_force"], again["largest_force"]
    return {"name": name, "claimed": claimed, "found": found, "honest": abs(claimed - found) <= 1e-6 + 1e-3 * found,
            "converged": result["relaxation"]["converged"],
            "excess": (result["energy"] - theirs) / len(atoms)}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--share", type=float, default=0.95)
    parser.add_argument("--cache", help="folder that keeps LAMMPS's energies from run to run")
    parser.add_argument("--verbose", action="store_true")
    options = parser.parse_args()
    known = {}
    cache = options.cache and f"{options.cache}/lammps.json"
    if cache and os.path.exists(cache):
        known = json.load(open(cache))
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for name, atoms in rattled(options.count):
            if name not in known:
                known[name] = lammps_energy(atoms)
            rows.append(compare(options.program, folder, name, atoms, known[name]))
            row = rows[-1]
            if options.verbose or row["excess"] > TOLERANCE or not row["honest"]:
                print(f"{name:24} trivalent - LAMMPS {row['excess']:+.6f} eV/atom, largest force claimed "
                      f"{row['claimed']:.2e}, found {row['found']:.2e} eV/Å, converged {row['converged']}", flush=True)
    if cache:
        os.makedirs(options.cache, exist_ok=True)
        json.dump(known, open(cache, "w"))
    honest = sum(row["honest"] for row in rows)
    low = sum(row["excess"] <= TOLERANCE for row in rows)
    lower = sum(row["excess"] < -TOLERANCE for row in rows)
    converged = sum(row["converged"] for row in rows)
    print(f"{len(rows)} structures: the claimed force is the force in {honest}; at rest {converged}; energy at most "
          f"LAMMPS's + {TOLERANCE} eV/atom in {low} ({100 * low / len(rows):.1f} %), lower by more than that in {lower}")
    return 0 if honest == len(rows) and low >= options.share * len(rows) else 1


if __name__ == "__main__":
    sys.exit(main())
