"""Trivalent turns any surface into sp2 carbon.

    shell = trivalent.build("bunny.off", atoms=20000)   # a shape in, a carbon shell out, at rest
    shell.energies                                      # [eV], a numpy array
    shell.write("bunny.extxyz")

Lengths are in Å, energies in eV, forces in eV/Å. ASE calculators stand in `trivalent.ase`.
"""

from ._core import graphene_energy
from ._core import version as __version__
from ._errors import Error, FileError, InvalidArray, InvalidAtoms, InvalidMesh, InvalidNetwork, InvalidOption
from ._shell import Shell
from ._surface import Surface
from ._views import Page, Picture, render, view
from ._workflows import build, check, dual, energy, inspect, lammps_package, plan, read, relax, remesh, repair, shape

__all__ = [
    "Error",
    "FileError",
    "InvalidArray",
    "InvalidAtoms",
    "InvalidMesh",
    "InvalidNetwork",
    "InvalidOption",
    "Page",
    "Picture",
    "Shell",
    "Surface",
    "__version__",
    "build",
    "check",
    "dual",
    "energy",
    "graphene_energy",
    "inspect",
    "lammps_package",
    "plan",
    "read",
    "relax",
    "remesh",
    "render",
    "repair",
    "shape",
    "view",
]
