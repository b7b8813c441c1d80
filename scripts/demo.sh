#!/usr/bin/env bash
# Installs what is missing, builds, and turns a built-in shape into a carbon shell.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_deps.sh
cmake --preset release
cmake --build --preset release --target trivalent

results=results/demo
build/release/bin/trivalent build double-torus --atoms 10000 -o "$results"

potentials=${LAMMPS_POTENTIALS:-/usr/share/lammps/potentials}
echo
echo "The results are in $results:"
echo "  surface.off    the remeshed surface: all edges of one length"
echo "  shell.extxyz   the atoms with energies, coordination and ring sizes (ASE, OVITO)"
echo "  shell.data     the same for LAMMPS, with the deck in.check that prints its REBO energy"
echo "  report.html    the shell in 3D, to be opened in a browser"
echo "  energy.ply     energy map: white atoms are as well off as in graphene, red ones are strained"
echo "  energy.vtp     the same for ParaView"
echo "  report.json    quality, distances, energies and timings"
if command -v lmp >/dev/null; then
  echo
  echo "LAMMPS on the same shell (lmp -in in.check):"
  (cd "$results" && LAMMPS_POTENTIALS=$potentials lmp -in in.check -log none | grep -E '^(energy|expected|passed|FAILED)')
fi
