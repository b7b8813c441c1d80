#!/bin/bash
# Relaxes the dual of each mesh here and with LAMMPS's minimizers (cg and fire), one core each, one
# after the other, and prints energies, atoms without three neighbors, and user seconds.
# Needs Debian's lammps and jq. usage: scripts/bench_relax.sh MESH...     BUILD: the build folder
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
trivalent=${BUILD:-$here/../build/release}/bin/trivalent
potentials=${LAMMPS_POTENTIALS:-/usr/share/lammps/potentials}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
TIMEFORMAT=%U
export OMP_NUM_THREADS=1

lammps() {  # STYLE -> meV/atom above graphene, atoms without three neighbors
  cat > "$folder/in" <<END
units metal
atom_style atomic
boundary s s s
read_data $folder/dual.data
pair_style rebo
pair_coeff * * $potentials/CH.rebo C
neighbor 1.0 bin
neigh_modify every 1 delay 0 check yes
compute near all coord/atom cutoff 2.0
variable is_bad atom "c_near != 3"
compute bad all reduce sum v_is_bad
thermo_style custom step pe c_bad fmax
thermo_modify format float %.12g
thermo 100000
min_style $1
minimize 1e-10 1e-8 2000 20000
print "result \$(1000*(pe/atoms+7.394997)) \$(c_bad) \$(fmax)"
END
  lmp -in "$folder/in" -log none | awk '$1 == "result" {printf "%.3f meV/atom, %d bad atoms, largest force %.2g\n", $2, $3, $4}'
}

for mesh in "$@"; do
  "$trivalent" dual "$mesh" "$folder/dual.data" --digits 17 --quiet > /dev/null
  echo "$mesh"
  ours=$( { time "$trivalent" relax "$mesh" -o "$folder/out.extxyz" --threads 1 --quiet --json \
    > "$folder/out.json"; } 2>&1 )
  jq -r '"  here: \(1000 * .excess_per_atom) meV/atom, \(.atoms - (.relaxation.coordinations["3"] // 0)) bad atoms, largest force \(.relaxation.largest_force), \(.relaxation.bonds_broken | length) bonds broken"' "$folder/out.json"
  echo "  here: $ours s"
  for style in cg fire; do
    theirs=$( { time lammps $style > "$folder/result"; } 2>&1 )
    echo "  LAMMPS $style: $(cat "$folder/result"), $theirs s," \
      "$(awk "BEGIN {printf \"%.1f\", $theirs / $ours}") times ours"
  done
done
