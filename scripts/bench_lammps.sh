#!/bin/sh
# Times force evaluations of REBO here and in LAMMPS (pair_style rebo), in turns on the same machine,
# one core each; two threads against one; then AIREBO (airebo 3.0 1 1). Needs Debian's lammps and a build with
# -DTRIVALENT_BUILD_BENCHMARKS=ON.
# usage: scripts/bench_lammps.sh [BUILD_FOLDER [SHELL.xyz]]     SHELL: a network to use as the shell;
# without one, the dual of a remeshed double torus of 50,000 atoms
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=${1:-$here/../build/release}
rounds=${ROUNDS:-5}
potentials=${LAMMPS_POTENTIALS:-/usr/share/lammps/potentials}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
shell=${2:-$folder/shell/shell.extxyz}
[ $# -ge 2 ] || "$build/bin/trivalent" build double-torus --atoms 50000 -o "$folder/shell" --quiet >/dev/null

median() { sort -g "$1" | awk '{v[NR] = $1} END {print (NR % 2) ? v[(NR+1)/2] : (v[NR/2] + v[NR/2+1]) / 2}'; }

# Positions stand still and neighbors are never searched again: force evaluations and nothing else.
lammps_time() {  # NAME PAIR_STYLE EVALUATIONS -> microseconds per atom and evaluation
  cat > "$folder/in" <<END
units metal
atom_style atomic
boundary $(cat "$folder/$1.boundary")
read_data $folder/$1.data
pair_style $2
pair_coeff * * $potentials/CH.${2%% *} C H
neigh_modify delay 100000 every 100000 check no
thermo 100000
run $3
END
  OMP_NUM_THREADS=1 lmp -in "$folder/in" -log none |
    awk '/Loop time of/ {printf "%.5f\n", 1e6 * $4 / ($9 * $12)}'
}

# STRUCTURE THREADS EVALUATIONS POTENTIAL
our_time() { "$build/bin/rebo_time" "$1" "$2" "$3" "$4" | awk '{print $1}'; }

compare() {  # NAME STRUCTURE BOUNDARY
  "$build/bin/rebo_time" "$2" data "$folder/$1.data"
  echo "$3" > "$folder/$1.boundary"
  for round in $(seq "$rounds"); do
    ours=$(our_time "$2" 1 50 rebo)
    two=$(our_time "$2" 2 50 rebo)
    theirs=$(lammps_time "$1" rebo 20)
    echo "$ours" >> "$folder/$1.ours"
    awk "BEGIN {print $theirs / $ours}" >> "$folder/$1.speedup"
    awk "BEGIN {print $ours / $two}" >> "$folder/$1.threads"
    echo "$1, round $round: LAMMPS $theirs, here $ours, two threads $two us per atom and evaluation"
  done
  echo "$1: $(median "$folder/$1.ours") us per atom and evaluation," \
    "two threads $(median "$folder/$1.threads") times as fast as one"
}

# Ours with its search for neighbors, as it has none that is kept.
compare_airebo() {  # NAME STRUCTURE
  for round in $(seq "$rounds"); do
    ours=$(our_time "$2" 1 3 airebo)
    theirs=$(lammps_time "$1" "airebo 3.0 1 1" 4)
    awk "BEGIN {print $ours / $theirs}" >> "$folder/$1.airebo"
    echo "$1, AIREBO, round $round: LAMMPS $theirs, here $ours us per atom and evaluation"
  done
  echo "$1: AIREBO takes $(median "$folder/$1.airebo") of LAMMPS's time"
}

compare graphene graphene "p p s"
compare shell "$shell" "s s s"
compare_airebo graphene graphene
compare_airebo shell "$shell"
echo "speedup over LAMMPS rebo: graphene $(median "$folder/graphene.speedup")," \
  "shell $(median "$folder/shell.speedup")"
