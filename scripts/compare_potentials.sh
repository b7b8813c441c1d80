#!/usr/bin/env bash
# Other potentials judge our shells: C60, a sphere of 720 atoms and a torus of 800, at rest under REBO, and
# further structures that are named, are relaxed by LAMMPS under AIREBO, Tersoff (BNC.tersoff) and LCBOP,
# cells too where they are periodic. One table: energy per atom, how far atoms moved, bonds broken and
# formed. Where xtb is installed, GFN-FF and GFN2 do the same for up to 200 free atoms; their energies have
# another zero.
#
#   scripts/compare_potentials.sh [FILE...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

program=$PWD/build/release/bin/trivalent
results=$PWD/results/potentials
mkdir -p "$results"
export LAMMPS_POTENTIALS=${LAMMPS_POTENTIALS:-/usr/share/lammps/potentials}
command -v lmp >/dev/null || { echo "compare_potentials.sh: lmp is missing (Debian: apt install lammps)" >&2; exit 1; }

make_shell() {
  rm -rf "${results:?}/$1"
  "$program" build "$2" --atoms "$3" -o "$results/$1" --quiet >/dev/null
}
make_shell c60 sphere 60
make_shell sphere-720 sphere 720
make_shell torus-800 torus 800

/usr/bin/python3 - "$program" "$results" "$@" <<'END'
import json
import math
import os
import re
import shutil
import subprocess
import sys

import numpy as np

program, results, *files = sys.argv[1:]
files = [os.path.join(results, name, 'shell.extxyz') for name in ('c60', 'sphere-720', 'torus-800')] + files
HARTREE = 27.211386  # [eV]
POTENTIALS = {'REBO': [],
              'AIREBO': ['--pair-style', 'airebo 3.0 1 1', '--pair-coeff', '* * CH.airebo C'],
              'Tersoff': ['--pair-style', 'tersoff', '--pair-coeff', '* * BNC.tersoff C'],
              'LCBOP': ['--pair-style', 'lcbop', '--pair-coeff', '* * C.lcbop C']}


def name_of(path):
    base = os.path.basename(path)
    return os.path.basename(os.path.dirname(path)) if base == 'shell.extxyz' else os.path.splitext(base)[0]


def relax(path, potential, options):
    out = os.path.join(results, f'{name_of(path)}.{potential}.extxyz')
    command = [program, 'relax', path, '-o', out, '--engine', 'lammps', '--max-force', '1e-3', '--json', '--quiet', *options]
    with open(path) as file:
        next(file)
        is_periodic = 'pbc="T T T"' in (header := next(file)) or ('attice' in header and 'pbc' not in header)
    if is_periodic:
        command.append('--relax-box')
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode not in (0, 3):
        return f'{done.stderr.strip().splitlines()[-1]}'
    result = json.loads(done.stdout)
    rest = '' if done.returncode == 0 else '  not at rest'
    return (f'{result["energy_per_atom"]:10.5f}  {result["relaxation"]["displacement_largest"]:8.3f}  {len(result["relaxation"]["bonds_broken"]):6d}  '
            f'{len(result["relaxation"]["bonds_formed"]):6d}{rest}')


def moved(before, after):
    """The farthest that an atom has moved, once the structures lie on each other [Kabsch1976]."""
    a, b = (np.array(x) - np.mean(x, axis=0) for x in (before, after))
    u, _, v = np.linalg.svd(a.T @ b)
    turn = np.diag([1, 1, np.sign(np.linalg.det(u @ v))])
    return np.linalg.norm(a @ (u @ turn @ v) - b, axis=1).max()


def xtb(path, method):
    """Optimizes free atoms by xtb, which may turn them; its energies have another zero."""
    folder = os.path.join(results, f'{name_of(path)}.{method}')
    os.makedirs(folder, exist_ok=True)
    plain = os.path.join(folder, 'atoms.xyz')
    subprocess.run([program, 'convert', path, os.path.join(folder, 'atoms.gen'), '--quiet'], check=True, stdout=subprocess.DEVNULL)
    rows = open(os.path.join(folder, 'atoms.gen')).read().split('\n')
    count, kind = rows[0].split()
    if kind != 'C' or int(count) > 200:
        return None
    before = [[float(x) for x in row.split()[2:5]] for row in rows[2:2 + int(count)]]
    with open(plain, 'w') as file:
        file.write(f'{count}\n\n' + ''.join(f'C {x[0]} {x[1]} {x[2]}\n' for x in before))
    done = subprocess.run(['xtb', plain, *method.split(), '--opt'], cwd=folder, check=True, capture_output=True, text=True)
    energy = float(re.findall(r'TOTAL ENERGY +(-?[0-9.]+) Eh', done.stdout)[-1]) * HARTREE / int(count)
    after = [[float(x) for x in row.split()[1:4]] for row in open(os.path.join(folder, 'xtbopt.xyz')).read().split('\n')[2:2 + int(count)]]

    def bonds(x):
        return {(i, j) for i in range(len(x)) for j in range(i) if math.dist(x[i], x[j]) < 1.85}
    return f'{energy:10.5f}  {moved(before, after):8.3f}  {len(bonds(before) - bonds(after)):6d}  {len(bonds(after) - bonds(before)):6d}'


print('structure         potential   eV/atom   moved [Å]  broken  formed')
for path in files:
    for potential, options in POTENTIALS.items():
        print(f'{name_of(path):16}  {potential:9} {relax(path, potential, options)}', flush=True)
    for method in ('--gfnff', '--gfn 2') if shutil.which('xtb') else ():
        row = xtb(path, method)
        if row:
            print(f'{name_of(path):16}  {method[2:]:9} {row}', flush=True)
END
