#!/bin/sh
# Relaxes 200 rattled structures (C60, tubes, hydrocarbons, sheets; 0.05 to 0.25 Å) with trivalent and with
# LAMMPS's minimizer (cg). Fails unless the largest force that `relax` claims is the one that `energy` finds,
# always, and the energy is at most LAMMPS's + 1e-4 eV/atom in 95 % of them. Needs Debian's lammps,
# lammps-data, python3-ase and python3-numpy.
# usage: scripts/check_relax.sh [--count N] [--verbose] [--cache FOLDER]     BUILD=FOLDER, default build/release
set -eu
here=$(cd "$(dirname "$0")" && pwd)
export OMP_NUM_THREADS=1
# Debian's own python has the Debian packages, whatever else is installed.
exec /usr/bin/python3 "$here/references/check_relax.py" \
  --program "${BUILD:-$here/../build/release}/bin/trivalent" "$@"
