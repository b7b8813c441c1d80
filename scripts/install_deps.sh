#!/usr/bin/env bash
# Installs what building, testing and checking need: Debian 12 packages, as root or with sudo.
# Says nothing when nothing is missing.
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache git
  libopenmesh-dev libcgal-dev libeigen3-dev libtbb-dev zlib1g-dev libpugixml-dev liblz4-dev pkg-config gemmi-dev libmuparser-dev tao-pegtl-dev libsymspg-dev
  libboost-program-options-dev libboost-filesystem-dev nlohmann-json3-dev libcairo2-dev fonts-dejavu-core
  libgtest-dev libbenchmark-dev
  clang-14 libclang-rt-14-dev  # the fuzz targets
  clang-format-14 clang-tidy-14  # scripts/format.sh and scripts/lint.sh
  chromium                  # opens the pages in the tests
  libcgal-demo              # real meshes for the tests
  lammps lammps-data        # the reference for energies
  python3 python3-ase python3-numpy python3-vtk9 python3-gemmi python3-mdanalysis openbabel  # read our files back in the tests
  pybind11-dev python3-dev  # the Python module
  python3-pytest python3-mypy python3-matplotlib python3-tqdm  # its tests and examples
  python3-pip python3-wheel  # pip install .
)

# The page that shows shells is made by npm; any Node.js from 18 on will do, whoever packaged it.
command -v node >/dev/null || packages+=(nodejs)
command -v npm >/dev/null || packages+=(npm)

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null || true)
  [[ $status == 'install ok installed' ]] || missing+=("$package")
done
[[ ${#missing[@]} -eq 0 ]] && exit 0

as_root=()
if [[ $EUID -ne 0 ]]; then
  command -v sudo >/dev/null || {
    echo "install_deps.sh: these packages are missing: ${missing[*]}; install them as root" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "installing: ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
# A slim system leaves /usr/share/doc out, where the meshes of libcgal-demo live.
keep_meshes=(-o 'Dpkg::Options::=--path-include=/usr/share/doc/libcgal-demo/*')
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" apt-get install -y -qq --no-install-recommends "${keep_meshes[@]}" "${missing[@]}" >/dev/null
