"""Large arrays pass in both directions without a copy, and builds give their memory back."""

import subprocess
import sys

import numpy as np

import trivalent

# The box is flat: the potential refuses it before it allocates anything, so that all memory that the
# call has taken is what passing the atoms costs.
passes_a_million_atoms = """
import resource
import sys
import numpy as np
import trivalent
from trivalent import _core

positions = np.ones((1_000_000, 3), order=sys.argv[1])
numbers = np.full(len(positions), 6)
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
try:
    _core.Calculator("lj").evaluate(positions, numbers, np.ones((3, 3)), [True, True, True])
except trivalent.Error:
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    print(1024 * (after - before) / positions.nbytes)
"""


def copies_made(order: str) -> float:
    run = subprocess.run(
        [sys.executable, "-c", passes_a_million_atoms, order], capture_output=True, check=True, text=True
    )
    return float(run.stdout)


def test_positions_of_a_million_atoms_pass_without_a_copy() -> None:
    assert copies_made("C") < 0.2
    assert copies_made("F") > 0.9  # columns one after the other must be copied into rows


def test_results_of_a_million_atoms_are_views() -> None:
    side = np.arange(100.0)
    positions = np.stack(np.meshgrid(side, side, side), axis=-1).reshape(-1, 3) * 5.0
    shell = trivalent.energy(trivalent.Shell(positions), potential="lj", lj_cutoff=4.0)
    for take in (lambda: shell.positions, lambda: shell.energies, lambda: shell.forces):
        array = take()
        assert len(array) == 1_000_000
        assert array.__array_interface__["data"] == take().__array_interface__["data"]


def resident_pages() -> int:
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1])


def test_builds_do_not_grow_the_memory() -> None:
    n_builds = 30

    def build() -> None:
        trivalent.build("sphere", atoms=60, method="paper", relax=False, progress=False)

    for _ in range(10):
        build()
    before = resident_pages()
    for _ in range(n_builds):
        build()
    assert resident_pages() - before < 250, "pages of 4 KiB: at most 33 KiB a build"
