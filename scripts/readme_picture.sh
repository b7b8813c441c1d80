#!/usr/bin/env bash
# Draws examples/bunny.png, the picture at the top of README.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

cmake --build --preset release --target trivalent
trivalent=build/release/bin/trivalent
bunny=build/release/data/meshes/bunny00.off  # of Debian's libcgal-demo
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
"$trivalent" build "$bunny" -o "$folder" --atoms 20000 --quiet >/dev/null
"$trivalent" render "$bunny" "$folder/surface.off" --name 'dual of the scan' --name 'dual of the remeshed surface' \
  --size 660x380 --azimuth 0 --elevation 8 -o examples/bunny.png --quiet
