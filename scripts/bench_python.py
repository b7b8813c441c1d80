#!/usr/bin/python3
"""Time of a step of ASE's calculator, and of the evaluation in C++ that it asks for, paired.

usage: scripts/bench_python.py [ROUNDS]   (5; after a build with -DTRIVALENT_BUILD_BENCHMARKS=ON)

Graphene of 100,352 atoms that move a little in every step, on all cores. Prints microseconds per atom
and step: energy and forces from ASE, the same from C++, and the medians' ratio.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

build = Path(__file__).resolve().parent.parent / "build" / "release"
sys.path.insert(0, str(build / "python"))

import ase.build  # noqa: E402
import ase.io  # noqa: E402

from trivalent.ase import REBO  # noqa: E402

n_steps = 50
rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 5

atoms = ase.build.graphene(size=(224, 224, 1), vacuum=5.0)
atoms.pbc = True
places = [atoms.positions.copy(), atoms.positions * (1 + 1e-6)]


def time_of_python() -> float:
    atoms.calc = REBO()
    atoms.get_potential_energy()
    seconds = 0.0
    for step in range(n_steps):
        atoms.positions = places[step % 2]
        begin = time.perf_counter()
        atoms.get_potential_energy()
        atoms.get_forces()
        seconds += time.perf_counter() - begin
    return 1e6 * seconds / (n_steps * len(atoms))


def time_of_cpp(file: Path) -> float:
    words = [build / "bin" / "rebo_time", file, str(os.cpu_count()), str(n_steps), "moving"]
    return float(subprocess.run(words, check=True, capture_output=True, text=True).stdout.split()[0])


with tempfile.TemporaryDirectory() as folder:
    file = Path(folder) / "graphene.xyz"
    ase.io.write(file, atoms, format="extxyz")
    pairs = [(time_of_python(), time_of_cpp(file)) for _ in range(rounds)]
for of_python, of_cpp in pairs:
    print(f"python {of_python:.4f}  C++ {of_cpp:.4f}")
medians = [statistics.median(column) for column in zip(*pairs, strict=True)]
print(f"medians: python {medians[0]:.4f}  C++ {medians[1]:.4f}  ratio {medians[0] / medians[1]:.2f}")
