#!/usr/bin/env bash
# Figure 7 of the paper: energies of the bunny's dual before and after remeshing, in the same colors,
# as pictures and as pages to be opened in a browser, under REBO and under Lennard-Jones.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_deps.sh
cmake --preset release >/dev/null
cmake --build --preset release --target trivalent

trivalent=build/release/bin/trivalent
bunny=build/release/data/meshes/bunny00.off  # of Debian's libcgal-demo
results=results/figure7
mkdir -p "$results"
"$trivalent" build "$bunny" -o "$results/shell" --atoms "${ATOMS:-20000}" --quiet >/dev/null

for potential in rebo lj; do
  states=("$bunny" "$results/shell/surface.off" --name 'dual of the input' --name 'dual of the remeshed surface'
    --potential "$potential" --quiet)
  "$trivalent" render "${states[@]}" --size 1600x860 --azimuth 0 --elevation 8 -o "$results/figure7_$potential.png"
  "$trivalent" view "${states[@]}" --title "Figure 7, $potential" -o "$results/figure7_$potential.html"
done
echo
echo "Energies of the bunny's dual before and after remeshing are in $results:"
ls -1 "$results"/figure7_*
