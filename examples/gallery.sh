#!/usr/bin/env bash
# Makes the gallery of README.md: examples/gallery/*.png and, on standard output, its table.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake --build --preset release --target trivalent >&2
trivalent=build/release/bin/trivalent
meshes=build/release/data/meshes  # of Debian's libcgal-demo
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT

# draw NAME COLOR SHAPE OPTIONS...: builds a shell, draws it, and prints its row.
draw() {
  local name=$1 color=$2 shape=$3
  shift 3
  "$trivalent" build "$shape" -o "$folder/$name" "$@" --quiet >/dev/null
  "$trivalent" render "$folder/$name/shell.extxyz" --name "$name" --color "$color" --size 480x360 \
    -o "examples/gallery/$name.png" --quiet >/dev/null
  python3 - "$folder/$name/report.json" "$name" "trivalent build ${shape##*/} $*" <<'PYTHON'
import json, sys
report = json.load(open(sys.argv[1]))
energy, network = report["energy"]["after"], report["network"]
strain = f"{1000 * energy['excess_per_atom']:.1f} meV/atom above graphene"
if "walls" in report:
    walls = report["walls"]
    strain = f"{walls['count']} walls, bound by {-1000 * walls['energy'] / network['atoms']:.1f} meV/atom (AIREBO)"
edge = f"edges capped with {report['hydrogens']} H"  # the energies of C-H bonds are not to be compared
print(f"| ![{sys.argv[2]}](examples/gallery/{sys.argv[2]}.png) | `{sys.argv[3]}` | {network['atoms']} atoms, "
      f"{100 * network['hexagon_fraction']:.1f} % hexagons, {edge if report['hydrogens'] else strain} |")
PYTHON
}

echo '| | command | what it comes to |'
echo '|---|---|---|'
draw bunny excess_energy "$meshes/bunny00.off" --atoms 8000
draw gyroid ring_size gyroid --atoms 1536
draw onion wall sphere --walls 3 --atoms 1200
draw y-junction ring_size y-junction:length=5 --atoms 2100
draw wavy-sheet pyramidalization wavy-sheet --atoms 3000
draw femur excess_energy "$meshes/femur.off" --atoms 6000
