#!/bin/sh
# Makes tests/data/lammps: structures and what LAMMPS says about them. Needs Debian's lammps,
# lammps-data, python3-ase and python3-numpy; takes some minutes.
# usage: scripts/make_references.sh [FOLDER]
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=${1:-$here/../tests/data/lammps}
mkdir -p "$folder"
# Debian's own python has the Debian packages, whatever else is installed.
exec /usr/bin/python3 "$here/references/make_references.py" "$folder"
